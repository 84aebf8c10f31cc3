#include "paper_code.h"

#include <math.h>
#include <string.h>

#include "compact_code.h"

enum {
    HEADER_BYTES = 14,
    LEAST_DIFFERENCE = -32,
    MOST_DIFFERENCE = 31,
    DIFFERENCE_BITS = 6,
    MOST_MANTISSA = 0xfff,
    MOST_EXPONENT = 15
};

typedef struct {
    uint8_t *code;
    size_t size;
    uint32_t bits;
    int held;
} writer_t;

uint16_t yb_paper_unit(double metres)
{
    double scaled = metres * 64;
    int exponent = 0;
    while (exponent < MOST_EXPONENT && scaled >= MOST_MANTISSA + 0.5) {
        scaled /= 2;
        exponent++;
    }
    long mantissa = lround(fmin(fmax(scaled, 1), MOST_MANTISSA));
    return (uint16_t)(((unsigned)exponent << 12) | (unsigned)mantissa);
}

double yb_paper_metres(uint16_t coded)
{
    return yb_unit_64th_m(coded) / 64.0;
}

static double base_m(const yb_paper_t *paper)
{
    return paper->profile == YB_COMPACT ? paper->base * yb_paper_metres(paper->unit)
                                        : paper->base_m;
}

static uint16_t nearest_height(const yb_paper_t *paper, double height_m, int multiple)
{
    double unit_m = yb_paper_metres(paper->unit) * multiple;
    double units = (height_m - base_m(paper)) / unit_m;
    return (uint16_t)(lround(fmin(fmax(units, 0), UINT16_MAX / multiple)) * multiple);
}

uint16_t yb_paper_height(const yb_paper_t *paper, double height_m)
{
    return nearest_height(paper, height_m, 1);
}

uint16_t yb_paper_line_height(const yb_paper_t *paper, double height_m)
{
    return nearest_height(paper, height_m, 1 << paper->interval);
}

int yb_paper_first(const yb_paper_t *paper, int contour)
{
    int first = 0;
    for (int i = 0; i < contour; i++)
        first += paper->contour[i].count;
    return first;
}

static int corners_coded(const yb_paper_t *paper)
{
    int coded = 0;
    for (int i = 0; i < YB_CORNERS; i++)
        coded += (paper->corners >> i) & 1;
    return coded;
}

size_t yb_paper_size(const yb_paper_t *paper)
{
    int coded = corners_coded(paper);
    size_t contours = (size_t)paper->contour_count;
    size_t body = 12 * (size_t)paper->point_count + 20 * contours + 8;
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

static void put_header(writer_t *writer, const yb_paper_t *paper)
{
    unsigned flags = paper->shift | (paper->straight ? 4U : 0U);
    for (int i = 0; i < YB_CORNERS; i++)
        if ((paper->corners >> i & 1) != 0)
            flags |= 0x80U >> i;
    put_byte(writer, YB_FORMAT_VERSION << 4);
    put_byte(writer, flags);
    put_byte(writer, (unsigned)paper->contour_count);
    put_byte(writer, paper->vertices > 0 ? (unsigned)paper->vertices : YB_PAPER_POINTS);
    put_byte(writer, paper->east);
    put_byte(writer, paper->north);
    put_pair(writer, paper->cell);
    put_pair(writer, paper->unit);
    put_pair(writer, (uint16_t)paper->base_m);
    put_byte(writer, paper->seed);
    put_byte(writer, paper->gain);
    for (int i = 0; i < YB_CORNERS; i++)
        if ((paper->corners >> i & 1) != 0)
            put_pair(writer, paper->corner[i]);
    if (paper->corners == 0)
        put_pair(writer, paper->frame);
    for (int i = 0; i < paper->contour_count; i++)
        put_byte(writer, paper->contour[i].count);
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

static bool put_contours(writer_t *writer, const yb_paper_t *paper)
{
    const yb_step_t *at = paper->point;
    for (int i = 0; i < paper->contour_count; i++) {
        put_bits(writer, paper->contour[i].height, 16);
        put_bits(writer, at->x, 8);
        put_bits(writer, at->y, 8);
        for (int k = 1; k < paper->contour[i].count; k++)
            if (!put_difference(writer, at[k].x - at[k - 1].x, paper->shift) ||
                !put_difference(writer, at[k].y - at[k - 1].y, paper->shift))
                return false;
        at += paper->contour[i].count;
    }
    return true;
}

size_t yb_paper_write(const yb_paper_t *paper, uint8_t code[YB_MAX_CODE_BYTES])
{
    writer_t writer = {.code = code};
    put_header(&writer, paper);
    put_bits(&writer, paper->dimension, 8);
    if (!put_contours(&writer, paper))
        return 0;
    if (writer.held > 0)
        put_bits(&writer, 0, 8 - writer.held);
    put_byte(&writer, yb_sections_check(code, writer.size));
    return writer.size;
}

bool yb_paper_insert(yb_paper_t *paper, int contour, int at, yb_step_t point)
{
    if (paper->point_count >= YB_PAPER_POINTS)
        return false;
    memmove(&paper->point[at + 1], &paper->point[at],
            (size_t)(paper->point_count - at) * sizeof(paper->point[0]));
    paper->point[at] = point;
    paper->point_count++;
    paper->contour[contour].count++;
    return true;
}

void yb_paper_remove(yb_paper_t *paper, int contour, int at)
{
    paper->point_count--;
    memmove(&paper->point[at], &paper->point[at + 1],
            (size_t)(paper->point_count - at) * sizeof(paper->point[0]));
    paper->contour[contour].count--;
}

bool yb_paper_append(yb_paper_t *paper, uint16_t height, bool open, const yb_step_t *point,
                     int count)
{
    if (paper->contour_count >= YB_PAPER_CONTOURS || paper->point_count + count > YB_PAPER_POINTS)
        return false;
    paper->contour[paper->contour_count++] =
        (yb_paper_contour_t){.height = height, .count = (uint8_t)count, .open = open};
    memcpy(&paper->point[paper->point_count], point, (size_t)count * sizeof(*point));
    paper->point_count += count;
    return true;
}

void yb_paper_drop(yb_paper_t *paper, int contour)
{
    int first = yb_paper_first(paper, contour);
    int count = paper->contour[contour].count;
    memmove(&paper->point[first], &paper->point[first + count],
            (size_t)(paper->point_count - first - count) * sizeof(paper->point[0]));
    paper->point_count -= count;
    paper->contour_count--;
    memmove(&paper->contour[contour], &paper->contour[contour + 1],
            (size_t)(paper->contour_count - contour) * sizeof(paper->contour[0]));
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

bool yb_paper_split(yb_paper_t *paper)
{
    int first = 0;
    int unit = 1 << paper->shift;
    for (int i = 0; i < paper->contour_count && paper->profile == YB_PAPER; i++) {
        for (int k = first + 1; k < first + paper->contour[i].count; k++) {
            yb_step_t a = paper->point[k - 1];
            yb_step_t b = paper->point[k];
            if (in_reach(a, b, paper->shift))
                continue;
            int x = (b.x - a.x) / unit / 2 * unit;
            int y = (b.y - a.y) / unit / 2 * unit;
            yb_step_t middle = {(uint8_t)(a.x + x), (uint8_t)(a.y + y)};
            if (!yb_paper_insert(paper, i, k, middle))
                return false;
            k--;
        }
        first += paper->contour[i].count;
    }
    return true;
}

bool yb_paper_reorder(yb_paper_t *paper, int contour, int to)
{
    if (contour == to)
        return false;
    yb_paper_contour_t moved = paper->contour[contour];
    yb_step_t point[YB_PAPER_POINTS];
    memcpy(point, &paper->point[yb_paper_first(paper, contour)], moved.count * sizeof(*point));
    yb_paper_drop(paper, contour);
    int first = yb_paper_first(paper, to);
    memmove(&paper->point[first + moved.count], &paper->point[first],
            (size_t)(paper->point_count - first) * sizeof(*point));
    memcpy(&paper->point[first], point, moved.count * sizeof(*point));
    paper->point_count += moved.count;
    memmove(&paper->contour[to + 1], &paper->contour[to],
            (size_t)(paper->contour_count - to) * sizeof(moved));
    paper->contour[to] = moved;
    paper->contour_count++;
    return true;
}

bool yb_paper_rescale(yb_paper_t *paper, double unit_m)
{
    yb_paper_t before = *paper;
    double old_m = yb_paper_metres(before.unit);
    paper->unit = yb_compact_unit(unit_m);
    if (paper->unit == before.unit)
        return false;
    paper->base = (int)floor(base_m(&before) / yb_paper_metres(paper->unit));
    for (int i = 0; i < paper->contour_count; i++) {
        double height_m = base_m(&before) + before.contour[i].height * old_m;
        paper->contour[i].height = paper->contour[i].count > 1
                                       ? yb_paper_line_height(paper, height_m)
                                       : yb_paper_height(paper, height_m);
    }
    for (int i = 0; i < YB_CORNERS; i++)
        paper->corner[i] = yb_paper_height(paper, base_m(&before) + before.corner[i] * old_m);
    paper->frame = yb_paper_height(paper, base_m(&before) + before.frame * old_m);
    return true;
}

size_t yb_paper_code(const yb_paper_t *paper, uint8_t *code, size_t room, yb_bits_t *bits)
{
    if (paper->profile == YB_COMPACT)
        return yb_compact_write(paper, code, room, bits);
    size_t size = yb_paper_size(paper);
    if (bits != NULL)
        bits->all = (double)size * 8;
    return size <= room && paper->point_count <= 255 ? yb_paper_write(paper, code) : 0;
}

bool yb_paper_fits(const yb_paper_t *paper, size_t most_bytes)
{
    uint8_t code[YB_PAPER_MOST_BYTES];
    return yb_paper_code(paper, code, most_bytes, NULL) > 0;
}

yb_code_file_t *yb_paper_check(const yb_paper_t *paper, yb_error_t *error)
{
    yb_paper_t counted = *paper;
    uint8_t code[YB_PAPER_MOST_BYTES];
    size_t size = yb_paper_code(&counted, code, sizeof(code), NULL);
    if (size == 0) {
        yb_error_set(error, "the contours do not fit the format");
        return NULL;
    }
    yb_code_file_t *file = yb_code_file_from_bytes("the new code", code, size, error);
    if (file == NULL || counted.vertices > 0)
        return file;
    counted.vertices = file->map.vertex_count;
    yb_code_file_free(file);
    size = yb_paper_code(&counted, code, sizeof(code), NULL);
    return yb_code_file_from_bytes("the new code", code, size, error);
}
