#include "compact_plan.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

/* --- Decisions -------------------------------------------------------------------------------- */

static_assert((int)MODELS <= (int)COMPACT_MODELS, "room for all models");

void compact_begin_code(compact_pen_t *pen)
{
    memset(pen, 0, sizeof *pen);
    pen->low[0] = 0x21;
    pen->count = 1;
    pen->range = 1;
    for (int i = 0; i < MODELS; i++)
        pen->model[i] = model_first(i);
}

static void fill(compact_pen_t *pen)
{
    for (; pen->range < RANGE_LEAST; pen->range <<= 8) {
        assert(pen->count < COMPACT_MOST_BYTES);
        pen->low[pen->count++] = 0;
    }
}

static void add(compact_pen_t *pen, uint32_t part)
{
    for (size_t i = pen->count; part > 0; part >>= 8) {
        part += pen->low[--i];
        pen->low[i] = (uint8_t)part;
    }
}

void compact_one_of(compact_pen_t *pen, uint32_t count, uint32_t value)
{
    assert(value < count);
    fill(pen);
    pen->range /= count;
    add(pen, value * pen->range);
}

void compact_bit(compact_pen_t *pen, int model, bool bit)
{
    fill(pen);
    uint32_t bound = model_bound(pen->model[model], pen->range);
    if (bit)
        add(pen, bound);
    pen->range = bit ? pen->range - bound : bound;
    pen->model[model] = model_learn(pen->model[model], bit);
}

void compact_number(compact_pen_t *pen, int model, int value)
{
    int class = fix_log2_floor((uint32_t)value + 1);
    for (int i = 0; i <= class && i < MOST_CLASS; i++)
        compact_bit(pen, model + fix_min(i, NUMBER_MODELS - 1), i < class);
    for (int i = class; i-- > 0;)
        compact_one_of(pen, 2, (uint32_t)(value + 1) >> i & 1);
}

void compact_signed(compact_pen_t *pen, int model, int value)
{
    compact_number(pen, model, value < 0 ? -2 * value - 1 : 2 * value);
}

void compact_difference(compact_pen_t *pen, int model, int down, int value)
{
    compact_number(pen, model, abs(value));
    if (value != 0)
        compact_bit(pen, down, value < 0);
}

size_t compact_end_code(compact_pen_t *pen, int seed, const uint8_t *sections, size_t size,
                        uint8_t *code)
{
    compact_bit(pen, MODEL_SECTIONS, size > 0);
    fill(pen);
    /* The last byte is what follows; the seed's bits stand before it. */
    add(pen, 0x7fff);
    size_t count = pen->count - 1;
    memcpy(code, pen->low, count);
    code[count - 1] = (uint8_t)((code[count - 1] & 0x80) | seed);
    for (size_t i = 0; i < size; i++)
        code[count++] = sections[i];
    plan_mend(code, ++count);
    return count;
}

/* --- The header ------------------------------------------------------------------------------- */

void compact_put_head(compact_pen_t *pen, const compact_head_t *head, const plan_t *plan)
{
    int longer = 255 / head->spacing;
    int east = plan->east / head->spacing;
    int north = plan->north / head->spacing;
    compact_one_of(pen, 16, (uint32_t)head->cell_exponent);
    compact_one_of(pen, 256, (uint32_t)head->cell_mantissa);
    compact_one_of(pen, 16, (uint32_t)head->spacing - 1);
    compact_bit(pen, MODEL_OBLONG, east != north);
    if (east != north) {
        compact_one_of(pen, 2, east < north);
        compact_one_of(pen, (uint32_t)longer, (uint32_t)fix_min(east, north) - 1);
    }
    compact_one_of(pen, 16, (uint32_t)head->unit_exponent);
    compact_one_of(pen, 16, (uint32_t)head->unit_mantissa);
    compact_bit(pen, MODEL_COARSE, head->interval > 1);
    if (head->interval > 1)
        compact_one_of(pen, 3, (uint32_t)fix_log2_floor((uint32_t)head->interval) - 1);
    compact_number(pen, MODEL_BASE, abs(head->base));
    if (head->base != 0)
        compact_one_of(pen, 2, head->base < 0);
    compact_one_of(pen, 32, (uint32_t)head->dimension);
    compact_one_of(pen, 16, (uint32_t)head->gain);
    compact_bit(pen, MODEL_STRAIGHT, plan->straight);
    compact_one_of(pen, 16, (uint32_t)head->vertices);
}

void compact_head_of_plan(const compact_head_t *head, plan_t *plan)
{
    static const int gain[16] = {0, 1, 2, 2, 4, 5, 8, 11, 16, 22, 32, 45, 64, 90, 128, 181};
    plan->cell = head->cell_exponent == 0
                     ? head->cell_mantissa
                     : (head->cell_exponent - 1) << 12 | 256 | head->cell_mantissa;
    plan->unit = head->unit_exponent << 12 | 16 | head->unit_mantissa;
    plan->base = (int)((int64_t)head->base * yb_unit_64th_m((uint16_t)plan->unit) / 64);
    plan->dimension = 8 * head->dimension;
    plan->gain = gain[head->gain];
}

/* --- Contours --------------------------------------------------------------------------------- */

typedef struct {
    compact_pen_t pen;
    const plan_t *plan;
    const compact_head_t *head;
    plan_point_t known[PLAN_MAX_POINTS];
    int height[PLAN_MAX_POINTS];
    int count;
} sheet_t;

static int near_height(const sheet_t *sheet, int x, int y)
{
    int nearest = INT32_MAX;
    int height = 0;
    for (int i = 0; i < sheet->count; i++) {
        int dx = sheet->known[i].x - x;
        int dy = sheet->known[i].y - y;
        if (dx * dx + dy * dy < nearest) {
            nearest = dx * dx + dy * dy;
            height = sheet->height[i];
        }
    }
    return height;
}

static void know(sheet_t *sheet, const plan_contour_t *contour)
{
    for (int i = 0; i < contour->count; i++) {
        sheet->known[sheet->count] = sheet->plan->point[contour->first + i];
        sheet->height[sheet->count++] = contour->height;
    }
}

static int way_of(const plan_t *plan, plan_point_t p)
{
    if (p.y == 0)
        return p.x;
    if (p.x == plan->east)
        return plan->east + p.y;
    if (p.y == plan->north)
        return 2 * plan->east + plan->north - p.x;
    return 2 * (plan->east + plan->north) - p.y;
}

/* Which of the ways of the corners lies behind: the side. */
static int side_of(const plan_t *plan, int way)
{
    return way < plan->east                     ? 0
           : way < plan->east + plan->north     ? 1
           : way < 2 * plan->east + plan->north ? 2
                                                : 3;
}

static void put_steps(sheet_t *sheet, const plan_contour_t *contour, bool open)
{
    compact_pen_t *pen = &sheet->pen;
    int spacing = sheet->head->spacing;
    const plan_point_t *p = &sheet->plan->point[contour->first];
    static const int16_t inwards[4] = {2, 4, 6, 0};
    yb_ring_t last = {1, open ? inwards[side_of(sheet->plan, way_of(sheet->plan, p[0]))] : 0};
    int turned = open ? TURN_INWARD : TURN_FIRST;
    int before = 0;
    for (int i = 1; i < contour->count; i++) {
        yb_ring_t ring = ring_of((p[i].x - p[i - 1].x) / spacing, (p[i].y - p[i - 1].y) / spacing);
        int n = ring.length;
        int turn = ((ring.place - ring_ahead(last, n)) % (8 * n) + 8 * n) % (8 * n);
        int sector = turn / n;
        int tree = MODEL_TURN + turned * TURN_MODELS;
        compact_number(pen, MODEL_LENGTH + before * NUMBER_MODELS, n - 1);
        compact_bit(pen, tree, sector >> 2 & 1);
        compact_bit(pen, tree + 1 + (sector >> 2), sector >> 1 & 1);
        compact_bit(pen, tree + 3 + (sector >> 1), sector & 1);
        compact_one_of(pen, (uint32_t)n, (uint32_t)(turn % n));
        last = ring;
        turned = turn_context(sector);
        before = length_context(n);
        int away = fix_max(abs(p[i].x - p[0].x), abs(p[i].y - p[0].y));
        if (!open && i >= 2)
            compact_bit(pen, MODEL_END + (away <= 2 * n * spacing ? 1 : 0),
                        i + 1 == contour->count);
    }
}

static void put_lines(sheet_t *sheet)
{
    const plan_t *plan = sheet->plan;
    compact_pen_t *pen = &sheet->pen;
    int spacing = sheet->head->spacing;
    plan_point_t start = {plan->east / spacing / 2 * spacing, plan->north / spacing / 2 * spacing};
    int way = 0;
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *contour = &plan->contour[i];
        plan_point_t first = plan->point[contour->first];
        bool open = plan_open(plan, i);
        if (contour->count == 1)
            continue;
        compact_bit(pen, MODEL_CLOSED, open);
        if (open) {
            compact_signed(pen, MODEL_WAY, (way_of(plan, first) - way) / spacing);
            way = way_of(plan, first);
        } else {
            compact_signed(pen, MODEL_START, (first.x - start.x) / spacing);
            compact_signed(pen, MODEL_START, (first.y - start.y) / spacing);
            start = first;
        }
        int rise = contour->height - near_height(sheet, first.x, first.y);
        compact_difference(pen, MODEL_LINE_HEIGHT, MODEL_LINE_DOWN, rise / sheet->head->interval);
        put_steps(sheet, contour, open);
        know(sheet, contour);
    }
}

static void put_corners(sheet_t *sheet)
{
    const plan_t *plan = sheet->plan;
    bool any = false;
    for (int k = 0; k < 4; k++) {
        int x = k == 1 || k == 2 ? plan->east : 0;
        int y = k >= 2 ? plan->north : 0;
        bool coded = plan->corner_height[k] != -1;
        any = any || coded;
        compact_bit(&sheet->pen, MODEL_CORNER, coded);
        if (coded)
            compact_difference(&sheet->pen, MODEL_CORNER_HEIGHT, MODEL_CORNER_DOWN,
                               plan->corner_height[k] - near_height(sheet, x, y));
    }
    if (!any)
        compact_difference(&sheet->pen, MODEL_CORNER_HEIGHT, MODEL_CORNER_DOWN,
                           plan->frame_height - near_height(sheet, 0, 0));
}

static void put_spots(sheet_t *sheet, int spots)
{
    const plan_t *plan = sheet->plan;
    int spacing = sheet->head->spacing;
    int across = plan->east / spacing - 1;
    int places = across * (plan->north / spacing - 1);
    int passed = 0;
    compact_number(&sheet->pen, MODEL_SPOTS, spots);
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *contour = &plan->contour[i];
        plan_point_t p = plan->point[contour->first];
        if (contour->count > 1)
            continue;
        int place = (p.y / spacing - 1) * across + p.x / spacing - 1;
        uint32_t run = gap_run((uint32_t)(places - passed), (uint32_t)spots--);
        uint32_t gap = (uint32_t)(place - passed);
        for (; gap >= run; gap -= run)
            compact_bit(&sheet->pen, MODEL_GAP, true);
        compact_bit(&sheet->pen, MODEL_GAP, false);
        compact_one_of(&sheet->pen, run, gap);
        compact_difference(&sheet->pen, MODEL_SPOT_HEIGHT, MODEL_SPOT_DOWN,
                           contour->height - near_height(sheet, p.x, p.y));
        know(sheet, contour);
        passed = place + 1;
    }
}

size_t compact_write(const plan_t *plan, const compact_head_t *head, uint8_t *code)
{
    static sheet_t sheet;
    sheet.plan = plan;
    sheet.head = head;
    sheet.count = 0;
    int spots = 0;
    for (int i = 0; i < plan->contours; i++)
        spots += plan->contour[i].count == 1 ? 1 : 0;
    compact_begin_code(&sheet.pen);
    compact_put_head(&sheet.pen, head, plan);
    compact_number(&sheet.pen, MODEL_LINES, plan->contours - spots);
    put_lines(&sheet);
    put_corners(&sheet);
    put_spots(&sheet, spots);
    return compact_end_code(&sheet.pen, plan->seed, NULL, 0, code);
}

/* --- Order ------------------------------------------------------------------------------------ */

typedef struct {
    plan_contour_t contour;
    plan_point_t at;
    int number;
} ranked_t;

static int compare(const void *a, const void *b)
{
    const ranked_t *one = a;
    const ranked_t *other = b;
    bool spot = one->contour.count == 1;
    if (spot != (other->contour.count == 1))
        return spot ? 1 : -1;
    if (spot && one->at.y != other->at.y)
        return one->at.y - other->at.y;
    return spot ? one->at.x - other->at.x : one->number - other->number;
}

void compact_sort(plan_t *plan)
{
    ranked_t ranked[PLAN_MAX_CONTOURS];
    plan_t old = *plan;
    for (int i = 0; i < plan->contours; i++)
        ranked[i] = (ranked_t){plan->contour[i], plan->point[plan->contour[i].first], i};
    qsort(ranked, (size_t)plan->contours, sizeof *ranked, compare);
    plan->contours = plan->points = 0;
    for (int i = 0; i < old.contours; i++)
        (void)plan_add(plan, &old.point[ranked[i].contour.first], ranked[i].contour.count,
                       ranked[i].contour.height);
}
