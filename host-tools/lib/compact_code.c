#include "compact_code.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model.h"

/* Lattice steps that the end of an open line may lie outside. */
enum {
    MOST_BEYOND = 12
};

/* The range coder's other side: what is written is a number of as many bytes as have begun, to
 * whose end the parts of the interval are added.
 */
typedef struct {
    uint8_t *code;
    size_t size, room;
    uint32_t range;
    uint16_t model[MODELS];
    yb_bits_t *bits; /* may be NULL */
    yb_bits_kind_t kind;
    bool failed;
} coder_t;

/* Where a line's writing stands, in lattice steps. */
typedef struct {
    int x, y;
    yb_ring_t last;
    int turn_context, length_context;
} pen_t;

/* Notes a decision that narrows the interval to `share`. */
static void spend(coder_t *coder, double share)
{
    if (coder->bits != NULL && coder->bits->by_kind)
        coder->bits->of[coder->kind] -= log2(share);
}

static void add(coder_t *coder, uint32_t value)
{
    size_t at = coder->size;
    uint32_t carry = value;
    while (carry != 0 && at > 0) {
        carry += coder->code[--at];
        coder->code[at] = (uint8_t)carry;
        carry >>= 8;
    }
}

static void begin_byte(coder_t *coder)
{
    if (coder->size >= coder->room) {
        coder->failed = true;
        return;
    }
    coder->code[coder->size++] = 0;
}

static void narrow(coder_t *coder, uint32_t from, uint32_t range)
{
    add(coder, from);
    coder->range = range;
    while (coder->range < RANGE_LEAST) {
        begin_byte(coder);
        coder->range <<= 8;
    }
}

static void put_bit(coder_t *coder, int model, int bit)
{
    uint32_t range = coder->range;
    uint32_t bound = model_bound(coder->model[model], range);
    coder->model[model] = model_learn(coder->model[model], bit);
    spend(coder, (double)(bit != 0 ? range - bound : bound) / range);
    if (bit != 0)
        narrow(coder, bound, range - bound);
    else
        narrow(coder, 0, bound);
}

static void put_uniform(coder_t *coder, int value, int count)
{
    if (value < 0 || value >= count) {
        coder->failed = true;
        return;
    }
    uint32_t part = coder->range / (uint32_t)count;
    spend(coder, (double)part / coder->range);
    narrow(coder, (uint32_t)value * part, part);
}

static void put_number(coder_t *coder, int model, int value)
{
    int class = 0;
    while (value + 1 >= 2 << class)
        class ++;
    if (value < 0 || class > MOST_CLASS) {
        coder->failed = true;
        return;
    }
    for (int i = 0; i < class; i++)
        put_bit(coder, model + fix_min(i, NUMBER_MODELS - 1), 1);
    if (class < MOST_CLASS)
        put_bit(coder, model + fix_min(class, NUMBER_MODELS - 1), 0);
    for (int i = class - 1; i >= 0; i--)
        put_uniform(coder, (value + 1) >> i & 1, 2);
}

static void put_signed(coder_t *coder, int model, int value)
{
    put_number(coder, model, value < 0 ? -2 * value - 1 : 2 * value);
}

static void put_difference(coder_t *coder, int model, int down, int value)
{
    put_number(coder, model, abs(value));
    if (value != 0)
        put_bit(coder, down, value < 0);
}

static int columns_of(const yb_contour_set_t *set)
{
    return set->east / set->spacing;
}

static int rows_of(const yb_contour_set_t *set)
{
    return set->north / set->spacing;
}

static void put_shape(coder_t *coder, const yb_contour_set_t *set)
{
    int most = 255 / set->spacing;
    int columns = columns_of(set);
    int rows = rows_of(set);
    if (fix_max(columns, rows) != most)
        coder->failed = true;
    put_bit(coder, MODEL_OBLONG, rows != columns);
    if (rows == columns)
        return;
    put_uniform(coder, columns < rows, 2);
    put_uniform(coder, fix_min(columns, rows) - 1, most);
}

/* The base is the height of the first line, or of the frame. */
static int zero_of(const yb_contour_set_t *set)
{
    for (int i = 0; i < set->contour_count; i++)
        if (set->contour[i].count > 1)
            return set->contour[i].height;
    return set->frame;
}

static void put_header(coder_t *coder, const yb_contour_set_t *set)
{
    int base = set->base + zero_of(set);
    int exponent = set->cell >> 12;
    int mantissa = set->cell & 0xfff;
    bool small = exponent == 0 && mantissa < 256;
    put_uniform(coder, small ? 0 : exponent + 1, 16);
    put_uniform(coder, small ? mantissa : mantissa - 256, 256);
    put_uniform(coder, set->spacing - 1, 16);
    put_shape(coder, set);
    put_uniform(coder, set->unit >> 12, 16);
    put_uniform(coder, (set->unit & 0xfff) - 16, 16);
    put_bit(coder, MODEL_COARSE, set->interval > 0);
    if (set->interval > 0)
        put_uniform(coder, set->interval - 1, 3);
    put_number(coder, MODEL_BASE, abs(base));
    if (base != 0)
        put_uniform(coder, base < 0, 2);
    put_uniform(coder, set->dimension / 8, 32);
    put_uniform(coder, yb_compact_gain_code(set->gain), 16);
    put_bit(coder, MODEL_STRAIGHT, set->straight);
    put_uniform(coder,
                set->vertices > 0
                    ? yb_compact_vertex_class(set->vertices)
                    : yb_compact_vertex_class_within(yb_contour_set_most_vertices(set)),
                16);
}

/* Height of the point nearest to (x, y), in steps, of those written: the first `lines` contours
 * that are lines in the set's order, then spot heights in the order given.
 */
typedef struct {
    int x, y, height;
} known_t;

typedef struct {
    known_t *point;
    int count;
    int zero; /* height of the base */
} known_points_t;

static int height_near(const known_points_t *known, int x, int y)
{
    int nearest = INT32_MAX;
    int height = known->zero;
    for (int i = 0; i < known->count; i++) {
        int dx = known->point[i].x - x;
        int dy = known->point[i].y - y;
        int d = dx * dx + dy * dy;
        if (d < nearest) {
            nearest = d;
            height = known->point[i].height;
        }
    }
    return height;
}

static void know(known_points_t *known, yb_step_t at, int height)
{
    known->point[known->count++] = (known_t){at.x, at.y, height};
}

/* Lattice steps along the frame, counter-clockwise from the south-west. */
static int way_of(const yb_contour_set_t *set, int x, int y)
{
    int east = columns_of(set);
    int north = rows_of(set);
    if (y == 0)
        return x;
    if (x == east)
        return east + y;
    if (y == north)
        return 2 * east + north - x;
    return 2 * (east + north) - y;
}

static yb_ring_t inward(const yb_contour_set_t *set, int x, int y)
{
    int way = way_of(set, x, y);
    int east = columns_of(set);
    int north = rows_of(set);
    int place = way < east ? 2 : way < east + north ? 4 : way < 2 * east + north ? 6 : 0;
    return (yb_ring_t){1, place};
}

static void put_step(coder_t *coder, pen_t *pen, int dx, int dy)
{
    yb_ring_t ring = ring_of(dx, dy);
    int n = ring.length;
    if (n == 0) {
        coder->failed = true;
        return;
    }
    int turn = (ring.place - ring_ahead(pen->last, n) % (8 * n) + 8 * n) % (8 * n);
    int sector = turn / n;
    coder->kind = YB_BITS_LENGTHS;
    put_number(coder, MODEL_LENGTH + pen->length_context * NUMBER_MODELS, n - 1);
    coder->kind = YB_BITS_TURNS;
    int model = MODEL_TURN + pen->turn_context * TURN_MODELS - 1;
    for (int node = 1, bit = 2; bit >= 0; bit--) {
        put_bit(coder, model + node, sector >> bit & 1);
        node = node << 1 | (sector >> bit & 1);
    }
    put_uniform(coder, turn % n, n);
    pen->last = ring;
    pen->turn_context = turn_context(sector);
    pen->length_context = length_context(n);
    pen->x += dx;
    pen->y += dy;
}

/* Bits that a decision would cost. */
static double bit_price(const coder_t *coder, int model, int bit)
{
    double zero = coder->model[model] / 65536.0;
    return -log2(bit != 0 ? 1 - zero : zero);
}

/* Bits that a step would cost, but for those that all steps of its length cost alike. */
static double step_price(const coder_t *coder, const pen_t *pen, int dx, int dy)
{
    yb_ring_t ring = ring_of(dx, dy);
    int n = ring.length;
    if (n == 0)
        return HUGE_VAL;
    int sector = (ring.place - ring_ahead(pen->last, n) % (8 * n) + 8 * n) % (8 * n) / n;
    double bits = log2(n);
    int class = fix_log2_floor((uint32_t)n);
    int model = MODEL_LENGTH + pen->length_context * NUMBER_MODELS;
    for (int i = 0; i <= class; i++)
        bits += bit_price(coder, model + fix_min(i, NUMBER_MODELS - 1), i < class) + (i < class);
    model = MODEL_TURN + pen->turn_context * TURN_MODELS - 1;
    for (int node = 1, bit = 2; bit >= 0; bit--) {
        bits += bit_price(coder, model + node, sector >> bit & 1);
        node = node << 1 | (sector >> bit & 1);
    }
    return bits;
}

/* An open line ends where it would leave the map, so its last step may go beyond: by what is
 * cheapest.
 */
static void put_last_step(coder_t *coder, const yb_contour_set_t *set, pen_t *pen, int dx, int dy)
{
    int x = pen->x + dx;
    int y = pen->y + dy;
    int out_x = x == 0 ? -1 : x == columns_of(set) ? 1 : 0;
    int out_y = y == 0 ? -1 : y == rows_of(set) ? 1 : 0;
    int best = 0;
    double least = step_price(coder, pen, dx, dy);
    for (int beyond = 1; beyond <= MOST_BEYOND; beyond++) {
        double price = step_price(coder, pen, dx + beyond * out_x, dy + beyond * out_y);
        if (price < least) {
            least = price;
            best = beyond;
        }
    }
    put_step(coder, pen, dx + best * out_x, dy + best * out_y);
}

typedef struct {
    int x, y, way; /* of the line before */
} starts_t;

static void put_start(coder_t *coder, const yb_contour_set_t *set, pen_t *pen, starts_t *starts,
                      bool open)
{
    coder->kind = YB_BITS_STARTS;
    put_bit(coder, MODEL_CLOSED, open);
    *pen = (pen_t){.x = pen->x, .y = pen->y, .last = {1, 0}, .turn_context = TURN_FIRST};
    if (!open) {
        put_signed(coder, MODEL_START, pen->x - starts->x);
        put_signed(coder, MODEL_START, pen->y - starts->y);
        starts->x = pen->x;
        starts->y = pen->y;
        return;
    }
    int round = 2 * (columns_of(set) + rows_of(set));
    int way = way_of(set, pen->x, pen->y);
    int ahead = (way - starts->way + round) % round;
    put_signed(coder, MODEL_WAY, ahead > round / 2 ? ahead - round : ahead);
    starts->way = way;
    pen->last = inward(set, pen->x, pen->y);
    pen->turn_context = TURN_INWARD;
}

static void put_line(coder_t *coder, const yb_contour_set_t *set, int contour, int first,
                     starts_t *starts, known_points_t *known)
{
    const yb_coded_contour_t *line = &set->contour[contour];
    const yb_step_t *point = &set->point[first];
    int spacing = set->spacing;
    pen_t pen = {.x = point->x / spacing, .y = point->y / spacing};
    int start_x = pen.x;
    int start_y = pen.y;
    put_start(coder, set, &pen, starts, line->open);
    int off = (int)line->height - height_near(known, point->x, point->y);
    if (off % (1 << set->interval) != 0)
        coder->failed = true;
    coder->kind = YB_BITS_HEIGHTS;
    put_difference(coder, MODEL_LINE_HEIGHT, MODEL_LINE_DOWN, off / (1 << set->interval));
    for (int i = 1; i < line->count && !coder->failed; i++) {
        int dx = point[i].x / spacing - pen.x;
        int dy = point[i].y / spacing - pen.y;
        if (line->open && i == line->count - 1 && (dx != 0 || dy != 0))
            put_last_step(coder, set, &pen, dx, dy);
        else
            put_step(coder, &pen, dx, dy);
        int away = fix_max(abs(pen.x - start_x), abs(pen.y - start_y));
        coder->kind = YB_BITS_LENGTHS;
        if (!line->open && i >= 2)
            put_bit(coder, MODEL_END + (away <= 2 * pen.last.length ? 1 : 0), i == line->count - 1);
    }
    for (int i = 0; i < line->count; i++)
        know(known, point[i], line->height);
}

static void put_corners(coder_t *coder, const yb_contour_set_t *set, const known_points_t *known)
{
    coder->kind = YB_BITS_FRAME;
    for (int i = 0; i < YB_CORNERS; i++) {
        int coded = set->corners >> i & 1;
        put_bit(coder, MODEL_CORNER, coded);
        int x = i == 1 || i == 2 ? set->east : 0;
        int y = i >= 2 ? set->north : 0;
        if (coded != 0)
            put_difference(coder, MODEL_CORNER_HEIGHT, MODEL_CORNER_DOWN,
                           (int)set->corner[i] - height_near(known, x, y));
    }
    if (set->corners == 0)
        put_difference(coder, MODEL_CORNER_HEIGHT, MODEL_CORNER_DOWN,
                       (int)set->frame - height_near(known, 0, 0));
}

static int by_row(const void *a, const void *b)
{
    const known_t *first = a;
    const known_t *second = b;
    return first->y != second->y ? first->y - second->y : first->x - second->x;
}

static void put_gap(coder_t *coder, int gap, int run)
{
    for (; gap >= run; gap -= run)
        put_bit(coder, MODEL_GAP, 1);
    put_bit(coder, MODEL_GAP, 0);
    put_uniform(coder, gap, run);
}

static void put_spots(coder_t *coder, const yb_contour_set_t *set, known_t *spot, int count,
                      known_points_t *known)
{
    int columns = columns_of(set) - 1;
    int points = columns * (rows_of(set) - 1);
    int next = 0;
    qsort(spot, (size_t)count, sizeof(*spot), by_row);
    coder->kind = YB_BITS_SPOT_PLACES;
    put_number(coder, MODEL_SPOTS, count);
    for (int i = 0; i < count && !coder->failed; i++) {
        int cell = spot[i].x / set->spacing - 1 + columns * (spot[i].y / set->spacing - 1);
        if (cell < next || cell >= points) {
            coder->failed = true;
            return;
        }
        coder->kind = YB_BITS_SPOT_PLACES;
        put_gap(coder, cell - next, (int)gap_run((uint32_t)(points - next), (uint32_t)(count - i)));
        coder->kind = YB_BITS_SPOT_HEIGHTS;
        put_difference(coder, MODEL_SPOT_HEIGHT, MODEL_SPOT_DOWN,
                       spot[i].height - height_near(known, spot[i].x, spot[i].y));
        known->point[known->count++] = spot[i];
        next = cell + 1;
    }
}

static void put_contours(coder_t *coder, const yb_contour_set_t *set)
{
    known_t point[YB_SET_POINTS];
    known_t spot[YB_SET_POINTS];
    known_points_t known = {.point = point, .zero = zero_of(set)};
    starts_t starts = {.x = columns_of(set) / 2, .y = rows_of(set) / 2};
    int spots = 0;
    int first = 0;
    for (int i = 0; i < set->contour_count; first += set->contour[i++].count)
        if (set->contour[i].count == 1)
            spot[spots++] =
                (known_t){set->point[first].x, set->point[first].y, set->contour[i].height};
    coder->kind = YB_BITS_STARTS;
    put_number(coder, MODEL_LINES, set->contour_count - spots);
    first = 0;
    for (int i = 0; i < set->contour_count; first += set->contour[i++].count)
        if (set->contour[i].count > 1)
            put_line(coder, set, i, first, &starts, &known);
    put_corners(coder, set, &known);
    put_spots(coder, set, spot, spots, &known);
}

static bool on_lattice(const yb_contour_set_t *set)
{
    for (int i = 0; i < set->point_count; i++)
        if (set->point[i].x % set->spacing != 0 || set->point[i].y % set->spacing != 0)
            return false;
    return true;
}

/* The last 15 bits are free: any value of them lies in what is left of the interval. Seven of them
 * are the seed, eight the first byte of what follows.
 */
static void put_seed(coder_t *coder, uint8_t seed)
{
    add(coder, 0x7fff);
    uint8_t *end = coder->code + coder->size;
    end[-2] = (uint8_t)((end[-2] & 0x80) | (seed & 0x7f));
    end[-1] = 0;
    coder->size--;
}

size_t yb_compact_write(const yb_contour_set_t *set, uint8_t *code, size_t room, yb_bits_t *bits)
{
    coder_t coder = {.code = code, .room = room, .range = 1, .bits = bits};
    if (room < 4 || !on_lattice(set))
        return 0;
    for (int i = 0; i < MODELS; i++)
        coder.model[i] = model_first(i);
    code[coder.size++] = YB_FORMAT_VERSION << 4 | YB_COMPACT;
    narrow(&coder, 0, 1);
    put_header(&coder, set);
    put_contours(&coder, set);
    coder.kind = YB_BITS_HEADER;
    put_bit(&coder, MODEL_SECTIONS, yb_sections_size(set->sections) > 0);
    if (coder.failed)
        return 0;
    if (bits != NULL)
        bits->all = (double)coder.size * 8 - log2((double)coder.range / RANGE_LEAST) +
                    8 * (double)yb_sections_size(set->sections);
    put_seed(&coder, set->seed);
    return yb_sections_end(set->sections, code, coder.size, room);
}

/* Units that the base of a set lies below that of the code it is read from: low enough for all
 * heights. */
enum {
    READ_DEPTH = 32768
};

static uint16_t read_height(const yb_code_file_t *file, int32_t z_q8)
{
    const yb_map_t *map = &file->map;
    double height_m = map->base_m + z_q8 / 256.0 * yb_unit_m(map->cell);
    double units = height_m / yb_unit_m(map->unit) - file->load.base;
    return (uint16_t)(lround(units) + READ_DEPTH);
}

void yb_compact_read(const yb_code_file_t *file, yb_contour_set_t *set)
{
    const yb_map_t *map = &file->map;
    const yb_load_t *load = &file->load;
    *set = (yb_contour_set_t){.profile = YB_COMPACT,
                              .east = (uint8_t)(map->east_q8 >> 8),
                              .north = (uint8_t)(map->north_q8 >> 8),
                              .spacing = load->spacing,
                              .interval = load->interval,
                              .most_vertices = load->vertices_promised,
                              .cell = map->cell,
                              .unit = map->unit,
                              .base = load->base - READ_DEPTH,
                              .seed = map->seed,
                              .gain = load->gain,
                              .dimension = (uint8_t)(255 - map->hurst_q8m1),
                              .straight = !map->smooth,
                              .frame = read_height(file, load->frame_height),
                              .sections = &file->sections};
    for (int i = 0; i < YB_CORNERS; i++)
        if (load->corner_height[i] != INT32_MIN) {
            set->corners |= (uint8_t)(1U << i);
            set->corner[i] = read_height(file, load->corner_height[i]);
        }
    for (int i = 0; i < load->contour_count; i++) {
        const yb_contour_t *contour = &load->contour[i];
        const yb_vertex_t *vertex = &map->vertex[contour->first];
        yb_step_t point[YB_SET_POINTS];
        for (int k = 0; k < contour->count && k < YB_SET_POINTS; k++)
            point[k] = (yb_step_t){(uint8_t)(vertex[k].x_q8 >> 8), (uint8_t)(vertex[k].y_q8 >> 8)};
        yb_contour_set_append(set, read_height(file, vertex->z_q8),
                              yb_contour_is_open(map, contour), point, contour->count);
    }
}
