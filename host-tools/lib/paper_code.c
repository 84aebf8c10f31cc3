#include "paper_code.h"

enum {
    HEADER_BYTES = 14,
    LEAST_DIFFERENCE = -32,
    MOST_DIFFERENCE = 31,
    DIFFERENCE_BITS = 6
};

typedef struct {
    uint8_t *code;
    size_t size;
    uint32_t bits;
    int held;
} writer_t;

static int corners_coded(const yb_contour_set_t *set)
{
    int coded = 0;
    for (int i = 0; i < YB_CORNERS; i++)
        coded += (set->corners >> i) & 1;
    return coded;
}

size_t yb_paper_size(const yb_contour_set_t *set)
{
    int coded = corners_coded(set);
    size_t contours = (size_t)set->contour_count;
    size_t body = 12 * (size_t)set->point_count + 20 * contours + 8;
    return HEADER_BYTES + 2 * (size_t)(coded > 0 ? coded : 1) + contours + (body + 7) / 8 + 1;
}

static void put_byte(writer_t *writer, unsigned value)
{
    writer->code[writer->size++] = (uint8_t)value;
}

static void put_pair(writer_t *writer, unsigned value)
{
    put_byte(writer, value >> 8 & 0xff);
    put_byte(writer, value & 0xff);
}

static void put_bits(writer_t *writer, unsigned value, int count)
{
    writer->bits = writer->bits << count | (value & ((1U << count) - 1));
    writer->held += count;
    while (writer->held >= 8) {
        writer->held -= 8;
        put_byte(writer, writer->bits >> writer->held & 0xff);
    }
}

static int promised_vertices(const yb_contour_set_t *set)
{
    int vertices = set->vertices > 0 ? set->vertices : yb_contour_set_most_vertices(set);
    return vertices < UINT8_MAX ? vertices : UINT8_MAX;
}

static void put_header(writer_t *writer, const yb_contour_set_t *set)
{
    unsigned flags = set->shift | (set->straight ? 4U : 0U);
    for (int i = 0; i < YB_CORNERS; i++)
        if ((set->corners >> i & 1) != 0)
            flags |= 0x80U >> i;
    put_byte(writer, YB_FORMAT_VERSION << 4);
    put_byte(writer, flags);
    put_byte(writer, (unsigned)set->contour_count);
    put_byte(writer, (unsigned)promised_vertices(set));
    put_byte(writer, set->east);
    put_byte(writer, set->north);
    put_pair(writer, set->cell);
    put_pair(writer, set->unit);
    put_pair(writer, (uint16_t)set->base_m);
    put_byte(writer, set->seed);
    put_byte(writer, set->gain);
    for (int i = 0; i < YB_CORNERS; i++)
        if ((set->corners >> i & 1) != 0)
            put_pair(writer, set->corner[i]);
    if (set->corners == 0)
        put_pair(writer, set->frame);
    for (int i = 0; i < set->contour_count; i++)
        put_byte(writer, set->contour[i].count);
}

static bool put_difference(writer_t *writer, int difference, int shift)
{
    int unit = 1 << shift;
    if (difference % unit != 0)
        return false;
    int steps = difference / unit;
    if (steps < LEAST_DIFFERENCE || steps > MOST_DIFFERENCE)
        return false;
    put_bits(writer, (unsigned)steps, DIFFERENCE_BITS);
    return true;
}

static bool put_contours(writer_t *writer, const yb_contour_set_t *set)
{
    const yb_step_t *at = set->point;
    for (int i = 0; i < set->contour_count; i++) {
        put_bits(writer, set->contour[i].height, 16);
        put_bits(writer, at->x, 8);
        put_bits(writer, at->y, 8);
        for (int k = 1; k < set->contour[i].count; k++)
            if (!put_difference(writer, at[k].x - at[k - 1].x, set->shift) ||
                !put_difference(writer, at[k].y - at[k - 1].y, set->shift))
                return false;
        at += set->contour[i].count;
    }
    return true;
}

size_t yb_paper_write(const yb_contour_set_t *set, uint8_t code[YB_MAX_CODE_BYTES])
{
    writer_t writer = {.code = code};
    put_header(&writer, set);
    put_bits(&writer, set->dimension, 8);
    if (!put_contours(&writer, set))
        return 0;
    if (writer.held > 0)
        put_bits(&writer, 0, 8 - writer.held);
    put_byte(&writer, yb_sections_check(code, writer.size));
    return writer.size;
}

/* Whether the difference b - a can be coded, but for its remainder. */
static bool in_reach(yb_step_t a, yb_step_t b, int shift)
{
    int x = b.x - a.x;
    int y = b.y - a.y;
    int least = LEAST_DIFFERENCE * (1 << shift);
    int most = MOST_DIFFERENCE * (1 << shift);
    return x >= least && x <= most && y >= least && y <= most;
}

bool yb_paper_split(yb_contour_set_t *set)
{
    int first = 0;
    int unit = 1 << set->shift;
    for (int i = 0; i < set->contour_count && set->profile == YB_PAPER; i++) {
        for (int k = first + 1; k < first + set->contour[i].count; k++) {
            yb_step_t a = set->point[k - 1];
            yb_step_t b = set->point[k];
            if (in_reach(a, b, set->shift))
                continue;
            int x = (b.x - a.x) / unit / 2 * unit;
            int y = (b.y - a.y) / unit / 2 * unit;
            yb_step_t middle = {(uint8_t)(a.x + x), (uint8_t)(a.y + y)};
            if (!yb_contour_set_insert(set, i, k, middle))
                return false;
            k--;
        }
        first += set->contour[i].count;
    }
    return true;
}
