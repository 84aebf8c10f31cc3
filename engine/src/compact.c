/* The compact profile: a range coder whose models learn, lines as starts and turning steps, heights
 * as differences from the nearest known point (docs/SPEC.md 1.3).
 *
 * Each byte that comes in widens the interval; while it is wide enough, binary decisions are taken
 * from it. A few decisions make an element (a bit, a number, a turn, one of n), an element is a
 * field, and what a field says settles which element comes next.
 */
#include "code.h"
#include "mesh.h"
#include "model.h"

enum element {
    UNIFORM, /* one of n, all alike */
    BIT,
    NUMBER,
    TURN
};

enum field {
    CELL_EXPONENT,
    CELL_MANTISSA,
    SPACING,
    OBLONG,
    SHORTER,
    SHORT_SIDE,
    UNIT_EXPONENT,
    UNIT_MANTISSA,
    COARSE,
    INTERVAL,
    BASE,
    BASE_DOWN,
    DIMENSION,
    GAIN,
    STRAIGHT,
    VERTICES,
    LINE_COUNT,
    CLOSED,
    START_X,
    START_Y,
    WAY,
    LINE_HEIGHT,
    LINE_DOWN,
    LENGTH,
    SECTOR,
    PLACE,
    END_OF_LINE,
    CORNER,
    CORNER_HEIGHT,
    CORNER_DOWN,
    SPOT_COUNT,
    GAP,
    CELL,
    SPOT_HEIGHT,
    SPOT_DOWN,
    SECTIONS,
    END_OF_RELIEF
};

/* --- Elements ------------------------------------------------------------------------------- */

static yb_status_t expect(yb_load_t *load, enum field field, enum element element, int model)
{
    load->state = (uint8_t)field;
    load->element = (uint8_t)element;
    load->at = (uint16_t)model;
    load->value = element == TURN ? 1 : 0;
    load->classes = 0;
    load->left = 0;
    return YB_MORE;
}

static yb_status_t expect_one_of(yb_load_t *load, enum field field, int count)
{
    return expect(load, field, UNIFORM, count);
}

static int decide(yb_load_t *load, int model_index)
{
    uint16_t *model = &load->model[model_index];
    uint32_t bound = model_bound(*model, load->range);
    int bit = load->code >= bound;
    if (bit != 0) {
        load->code -= bound;
        load->range -= bound;
    } else {
        load->range = bound;
    }
    *model = model_learn(*model, bit);
    return bit;
}

static uint16_t decide_uniform(yb_load_t *load, uint32_t count)
{
    uint32_t part = load->range / count;
    uint32_t value = (uint32_t)fix_min((int32_t)(load->code / part), (int32_t)count - 1);
    load->code -= value * part;
    load->range = part;
    return (uint16_t)value;
}

/* First the class, in unary, then the bits within it. True when the number is there. */
static bool decide_number(yb_load_t *load)
{
    if (load->left == 0) {
        int model = load->at + fix_min(load->classes, NUMBER_MODELS - 1);
        if (load->classes < MOST_CLASS && decide(load, model) != 0) {
            load->classes++;
            return false;
        }
        load->left = load->classes + 1u;
        load->value = 1;
    } else {
        load->value = (uint16_t)(load->value << 1 | decide_uniform(load, 2));
    }
    load->left--;
    if (load->left > 0)
        return false;
    load->value--;
    return true;
}

/* One decision. True when the element is complete in load->value. */
static bool decide_element(yb_load_t *load)
{
    switch ((enum element)load->element) {
    case UNIFORM:
        load->value = decide_uniform(load, load->at);
        return true;
    case BIT:
        load->value = (uint16_t)decide(load, load->at);
        return true;
    case NUMBER:
        return decide_number(load);
    default:
        load->value = (uint16_t)(load->value << 1 | decide(load, load->at + load->value - 1));
        if (load->value < 8)
            return false;
        load->value -= 8;
        return true;
    }
}

/* --- Header --------------------------------------------------------------------------------- */

static int columns_of(const yb_map_t *map, const yb_load_t *load)
{
    return (map->east_q8 >> 8) / load->spacing;
}

static int rows_of(const yb_map_t *map, const yb_load_t *load)
{
    return (map->north_q8 >> 8) / load->spacing;
}

/* 0, then about half octaves from 1 to 181. */
static uint8_t gain_of(int coded)
{
    return (uint8_t)(coded == 0 ? 0 : (coded & 1 ? 181 : 128) >> (7 - coded / 2));
}

static yb_status_t take_short_side(yb_map_t *map, yb_load_t *load, int value)
{
    uint16_t side_q8 = (uint16_t)((value + 1) * load->spacing << 8);
    if (load->narrow)
        map->east_q8 = side_q8;
    else
        map->north_q8 = side_q8;
    return expect_one_of(load, UNIT_EXPONENT, 16);
}

static yb_status_t take_vertices(yb_load_t *load, int value)
{
    uint32_t vertices = value < 8 ? 32u * ((uint32_t)value + 1) : 512u << (value - 8);
    vertices -= (value & 7) == 7 ? 1 : 0; /* 255 and 65535: what an index can count */
    if (vertices > YB_MAX_VERTICES)
        return YB_ERR_LIMIT;
    load->vertices_promised = (uint16_t)vertices;
    return expect(load, LINE_COUNT, NUMBER, MODEL_LINES);
}

static yb_status_t take_header(yb_map_t *map, yb_load_t *load, int value)
{
    switch ((enum field)load->state) {
    case CELL_EXPONENT:
        map->cell = (uint16_t)value;
        return expect_one_of(load, CELL_MANTISSA, 256);
    case CELL_MANTISSA:
        /* Exponent 0: 0 to 255 64ths of a metre; else a ninth bit stands before the mantissa. */
        map->cell = (uint16_t)(map->cell == 0 ? value : (map->cell - 1) << 12 | 256 | value);
        return map->cell == 0 ? YB_ERR_CORRUPT : expect_one_of(load, SPACING, 16);
    case SPACING:
        load->spacing = (uint8_t)(value + 1);
        map->east_q8 = (uint16_t)(255 / load->spacing * load->spacing << 8);
        map->north_q8 = map->east_q8;
        return expect(load, OBLONG, BIT, MODEL_OBLONG);
    case OBLONG:
        return value == 0 ? expect_one_of(load, UNIT_EXPONENT, 16)
                          : expect_one_of(load, SHORTER, 2);
    case SHORTER:
        load->narrow = value != 0;
        return expect_one_of(load, SHORT_SIDE, columns_of(map, load));
    case SHORT_SIDE:
        return take_short_side(map, load, value);
    case UNIT_EXPONENT:
        map->unit = (uint16_t)(value << 12);
        return expect_one_of(load, UNIT_MANTISSA, 16);
    case UNIT_MANTISSA:
        map->unit = (uint16_t)(map->unit | 16 | value);
        return expect(load, COARSE, BIT, MODEL_COARSE);
    case COARSE:
        load->interval = 0;
        return value == 0 ? expect(load, BASE, NUMBER, MODEL_BASE)
                          : expect_one_of(load, INTERVAL, 3);
    case INTERVAL:
        load->interval = (uint8_t)(value + 1);
        return expect(load, BASE, NUMBER, MODEL_BASE);
    case BASE:
        load->base = value;
        return value != 0 ? expect_one_of(load, BASE_DOWN, 2) : expect_one_of(load, DIMENSION, 32);
    case BASE_DOWN:
        load->base = value != 0 ? -load->base : load->base;
        return expect_one_of(load, DIMENSION, 32);
    case DIMENSION:
        map->hurst_q8m1 = (uint8_t)(255 - 8 * value);
        return expect_one_of(load, GAIN, 16);
    case GAIN:
        load->gain = gain_of(value);
        return expect(load, STRAIGHT, BIT, MODEL_STRAIGHT);
    case STRAIGHT:
        map->smooth = value == 0;
        return expect_one_of(load, VERTICES, 16);
    default:
        return take_vertices(load, value);
    }
}

/* --- Points --------------------------------------------------------------------------------- */

/* Heights farther from the base, in units, are too high in every unit. */
enum {
    MOST_UNITS = 1 << 29
};

/* Until the relief is complete a vertex's z is in units above the base; cut, so that sums of
 * however many differences below 2^18 fit.
 */
static yb_status_t add_point(yb_map_t *map, yb_load_t *load, int32_t units)
{
    if (load->point_count >= load->vertices_promised || load->x < 0 || load->y < 0 ||
        load->x > columns_of(map, load) || load->y > rows_of(map, load))
        return YB_ERR_CORRUPT;
    yb_vertex_t *point = &map->vertex[load->point_count];
    point->x_q8 = (uint16_t)(load->x * load->spacing << 8);
    point->y_q8 = (uint16_t)(load->y * load->spacing << 8);
    point->z_q8 = fix_clamp(units, -MOST_UNITS, MOST_UNITS);
    load->point_count++;
    return YB_MORE;
}

static yb_status_t begin_contour(yb_map_t *map, yb_load_t *load, int32_t units, bool open)
{
    if (load->contour_count >= YB_MAX_CONTOURS)
        return YB_ERR_CORRUPT;
    yb_contour_t *contour = &load->contour[load->contour_count++];
    contour->first = (yb_index_t)load->point_count;
    contour->count = 1;
    contour->open = open;
    return add_point(map, load, units);
}

/* Height of the point nearest to (x, y), in lattice steps, of those known so far; 0 if none is. */
static int32_t height_near(const yb_map_t *map, const yb_load_t *load, int x, int y)
{
    int32_t nearest = INT32_MAX;
    int32_t units = 0;
    for (int i = 0; i < load->point_count; i++) {
        const yb_vertex_t *v = &map->vertex[i];
        int32_t dx = (v->x_q8 >> 8) - x * load->spacing;
        int32_t dy = (v->y_q8 >> 8) - y * load->spacing;
        int32_t d = dx * dx + dy * dy;
        if (d < nearest) {
            nearest = d;
            units = v->z_q8;
        }
    }
    return units;
}

/* --- Lines ---------------------------------------------------------------------------------- */

static yb_status_t next_line(yb_load_t *load)
{
    if (load->lines > 0) {
        load->lines--;
        return expect(load, CLOSED, BIT, MODEL_CLOSED);
    }
    load->corner_at = 0;
    return expect(load, CORNER, BIT, MODEL_CORNER);
}

static yb_status_t next_step(yb_load_t *load)
{
    return expect(load, LENGTH, NUMBER, MODEL_LENGTH + load->length_context * NUMBER_MODELS);
}

/* A number that may be negative: 0, -1, 1, -2, 2 … */
static int signed_of(int value)
{
    return (value & 1) != 0 ? -(value / 2) - 1 : value / 2;
}

/* The start of an open line: `way` lattice steps along the frame, counter-clockwise from the
 * south-west; its first step is expected to lead straight into the map.
 */
static yb_status_t take_way(yb_map_t *map, yb_load_t *load, int way)
{
    int east = columns_of(map, load);
    int north = rows_of(map, load);
    int round = 2 * (east + north);
    way = (load->way + way) % round;
    way = way < 0 ? way + round : way;
    load->way = (int16_t)way;
    load->last = (yb_ring_t){1, 2};
    if (way < east) {
        load->x = (int16_t)way;
        load->y = 0;
    } else if (way < east + north) {
        load->x = (int16_t)east;
        load->y = (int16_t)(way - east);
        load->last.place = 4;
    } else if (way < 2 * east + north) {
        load->x = (int16_t)(2 * east + north - way);
        load->y = (int16_t)north;
        load->last.place = 6;
    } else {
        load->x = 0;
        load->y = (int16_t)(round - way);
        load->last.place = 0;
    }
    load->turn_context = TURN_INWARD;
    return expect(load, LINE_HEIGHT, NUMBER, MODEL_LINE_HEIGHT);
}

static yb_status_t take_start(yb_map_t *map, yb_load_t *load)
{
    if (load->start_x < 0 || load->start_y < 0 || load->start_x > columns_of(map, load) ||
        load->start_y > rows_of(map, load))
        return YB_ERR_CORRUPT;
    load->x = load->start_x;
    load->y = load->start_y;
    load->last = (yb_ring_t){1, 0};
    load->turn_context = TURN_FIRST;
    return expect(load, LINE_HEIGHT, NUMBER, MODEL_LINE_HEIGHT);
}

static yb_status_t take_line_height(yb_map_t *map, yb_load_t *load, int32_t intervals)
{
    int32_t units = height_near(map, load, load->x, load->y) + intervals * (1 << load->interval);
    load->length_context = 0;
    yb_status_t status = begin_contour(map, load, units, load->open);
    return status == YB_MORE ? next_step(load) : status;
}

static yb_status_t take_place(yb_map_t *map, yb_load_t *load, int rest)
{
    int n = load->length;
    int dx = 0;
    int dy = 0;
    int place = (ring_ahead(load->last, n) + load->sector * n + rest) % (8 * n);
    load->last = (yb_ring_t){(int16_t)n, (int16_t)place};
    ring_step(load->last, &dx, &dy);
    load->turn_context = (uint8_t)turn_context(load->sector);
    load->length_context = (uint8_t)length_context(n);
    load->x = (int16_t)(load->x + dx);
    load->y = (int16_t)(load->y + dy);
    yb_contour_t *contour = &load->contour[load->contour_count - 1];
    if (contour->open) { /* it ends where it would leave the map */
        load->x = (int16_t)fix_clamp(load->x, 0, columns_of(map, load));
        load->y = (int16_t)fix_clamp(load->y, 0, rows_of(map, load));
    }
    contour->count++;
    if (add_point(map, load, map->vertex[contour->first].z_q8) != YB_MORE)
        return YB_ERR_CORRUPT;
    if (contour->open)
        return on_frame(map, &map->vertex[load->point_count - 1]) ? next_line(load)
                                                                  : next_step(load);
    if (contour->count < 3)
        return next_step(load);
    int away = fix_max(fix_abs(load->x - load->start_x), fix_abs(load->y - load->start_y));
    return expect(load, END_OF_LINE, BIT, MODEL_END + (away <= 2 * n ? 1 : 0));
}

static yb_status_t take_line(yb_map_t *map, yb_load_t *load, int value)
{
    switch ((enum field)load->state) {
    case LINE_COUNT:
        load->lines = (uint16_t)value;
        load->start_x = (int16_t)(columns_of(map, load) / 2);
        load->start_y = (int16_t)(rows_of(map, load) / 2);
        return next_line(load);
    case CLOSED:
        load->open = value != 0;
        return load->open ? expect(load, WAY, NUMBER, MODEL_WAY)
                          : expect(load, START_X, NUMBER, MODEL_START);
    case START_X:
        load->start_x = (int16_t)(load->start_x + signed_of(value));
        return expect(load, START_Y, NUMBER, MODEL_START);
    case START_Y:
        load->start_y = (int16_t)(load->start_y + signed_of(value));
        return take_start(map, load);
    case WAY:
        return take_way(map, load, signed_of(value));
    case LINE_HEIGHT:
        load->height = (int16_t)value;
        return value != 0 ? expect(load, LINE_DOWN, BIT, MODEL_LINE_DOWN)
                          : take_line_height(map, load, 0);
    case LINE_DOWN:
        return take_line_height(map, load, value != 0 ? -load->height : load->height);
    case LENGTH:
        load->length = (int16_t)(value + 1);
        if (value >= 255)
            return YB_ERR_CORRUPT;
        return expect(load, SECTOR, TURN, MODEL_TURN + load->turn_context * TURN_MODELS);
    case SECTOR:
        load->sector = (uint8_t)value;
        return expect_one_of(load, PLACE, load->length);
    case PLACE:
        return take_place(map, load, value);
    default:
        return value != 0 ? next_line(load) : next_step(load);
    }
}

/* --- Corners and spot heights --------------------------------------------------------------- */

static yb_status_t next_corner(yb_load_t *load)
{
    load->corner_at++;
    if (load->corner_at < 4)
        return expect(load, CORNER, BIT, MODEL_CORNER);
    for (int i = 0; i < 4; i++)
        if (load->corner_height[i] != UNKNOWN_HEIGHT)
            return expect(load, SPOT_COUNT, NUMBER, MODEL_SPOTS);
    return expect(load, CORNER_HEIGHT, NUMBER, MODEL_CORNER_HEIGHT); /* one for the whole frame */
}

static yb_status_t take_corner_height(yb_map_t *map, yb_load_t *load, int32_t difference)
{
    int k = load->corner_at & 3; /* the whole frame is compared with the first one's place */
    int x = k == 1 || k == 2 ? columns_of(map, load) : 0;
    int y = k >= 2 ? rows_of(map, load) : 0;
    int32_t units = height_near(map, load, x, y) + difference;
    if (load->corner_at < 4) {
        load->corner_height[k] = units;
        return next_corner(load);
    }
    load->frame_height = units;
    return expect(load, SPOT_COUNT, NUMBER, MODEL_SPOTS);
}

static uint32_t inner_places(const yb_map_t *map, const yb_load_t *load)
{
    return (uint32_t)((columns_of(map, load) - 1) * (rows_of(map, load) - 1));
}

/* Spot heights lie in the inner lattice points' order, row by row. The gap to the next one is
 * coded in runs of about its median, from how many points and spots are left.
 */
static yb_status_t next_spot(const yb_map_t *map, yb_load_t *load)
{
    if (load->spots == 0)
        return expect(load, SECTIONS, BIT, MODEL_SECTIONS);
    uint32_t places = inner_places(map, load);
    if (load->cell >= places)
        return YB_ERR_CORRUPT;
    load->run = (uint16_t)gap_run(places - load->cell, load->spots);
    return expect(load, GAP, BIT, MODEL_GAP);
}

static yb_status_t take_gap(const yb_map_t *map, yb_load_t *load, int more)
{
    if (more == 0)
        return expect_one_of(load, CELL, load->run);
    load->cell += load->run;
    return load->cell < inner_places(map, load) ? expect(load, GAP, BIT, MODEL_GAP)
                                                : YB_ERR_CORRUPT;
}

static yb_status_t take_cell(const yb_map_t *map, yb_load_t *load, int value)
{
    uint32_t columns = (uint32_t)columns_of(map, load) - 1;
    load->cell += (uint32_t)value;
    if (load->cell >= inner_places(map, load))
        return YB_ERR_CORRUPT;
    load->x = (int16_t)(1 + load->cell % columns);
    load->y = (int16_t)(1 + load->cell / columns);
    load->cell++;
    load->spots--;
    return expect(load, SPOT_HEIGHT, NUMBER, MODEL_SPOT_HEIGHT);
}

static yb_status_t take_spot_height(yb_map_t *map, yb_load_t *load, int32_t difference)
{
    int32_t units = height_near(map, load, load->x, load->y) + difference;
    yb_status_t status = begin_contour(map, load, units, false);
    return status == YB_MORE ? next_spot(map, load) : status;
}

static yb_status_t take_corner_or_spot(yb_map_t *map, yb_load_t *load, int value)
{
    switch ((enum field)load->state) {
    case CORNER:
        return value != 0 ? expect(load, CORNER_HEIGHT, NUMBER, MODEL_CORNER_HEIGHT)
                          : next_corner(load);
    case CORNER_HEIGHT:
        load->height = (int16_t)value;
        return value != 0 ? expect(load, CORNER_DOWN, BIT, MODEL_CORNER_DOWN)
                          : take_corner_height(map, load, 0);
    case CORNER_DOWN:
        return take_corner_height(map, load, value != 0 ? -load->height : load->height);
    case SPOT_COUNT:
        load->spots = (uint16_t)value;
        return next_spot(map, load);
    case GAP:
        return take_gap(map, load, value);
    case CELL:
        return take_cell(map, load, value);
    case SPOT_HEIGHT:
        load->height = (int16_t)value;
        return value != 0 ? expect(load, SPOT_DOWN, BIT, MODEL_SPOT_DOWN)
                          : take_spot_height(map, load, 0);
    default:
        return take_spot_height(map, load, value != 0 ? -load->height : load->height);
    }
}

/* --- The end -------------------------------------------------------------------------------- */

static int64_t floor_div(int64_t a, int64_t b)
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/* From units above the base to q8 steps; rest_64th_m is what base_m leaves of the base. Units are
 * below 2^30, a unit is below 2^20 64ths of a metre: 2^58 with the fraction bits. False: too high.
 */
static bool settle_height(const yb_map_t *map, int64_t rest_64th_m, int32_t *height)
{
    int64_t cell = yb_unit_64th_m(map->cell);
    int64_t z_64th_m = (int64_t)*height * yb_unit_64th_m(map->unit) + rest_64th_m;
    int64_t z_q8 = floor_div(z_64th_m * 256 + cell / 2, cell);
    *height = (int32_t)z_q8;
    return z_q8 >= -YB_MAX_HEIGHT_Q8 && z_q8 <= YB_MAX_HEIGHT_Q8;
}

static yb_status_t end_relief(yb_map_t *map, yb_load_t *load)
{
    int64_t base_64th_m = (int64_t)load->base * yb_unit_64th_m(map->unit);
    int64_t base_m = floor_div(base_64th_m, 64);
    int64_t rest = base_64th_m - base_m * 64;
    bool good = base_m >= INT16_MIN && base_m <= INT16_MAX;
    map->base_m = (int16_t)base_m;
    map->seed = load->recent >> 8 & 127;
    good = good && settle_height(map, rest, &load->frame_height);
    for (int i = 0; i < 4 && good; i++)
        good = load->corner_height[i] == UNKNOWN_HEIGHT ||
               settle_height(map, rest, &load->corner_height[i]);
    for (int i = 0; i < load->point_count && good; i++)
        good = settle_height(map, rest, &map->vertex[i].z_q8);
    return good ? YB_OK : YB_ERR_CORRUPT;
}

static yb_status_t take_field(yb_map_t *map, yb_load_t *load)
{
    if (load->state < LINE_COUNT)
        return take_header(map, load, load->value);
    if (load->state < CORNER)
        return take_line(map, load, load->value);
    if (load->state < SECTIONS)
        return take_corner_or_spot(map, load, load->value);
    load->section = load->value != 0 ? 0 : SECTION_LAST;
    load->state = END_OF_RELIEF;
    return YB_MORE;
}

void compact_begin(yb_load_t *load)
{
    for (int i = 0; i < MODELS; i++)
        load->model[i] = model_first(i);
    load->range = 1;
    (void)expect_one_of(load, CELL_EXPONENT, 16);
}

yb_status_t compact_take(yb_map_t *map, yb_load_t *load, uint8_t byte)
{
    load->recent = (uint16_t)(load->recent << 8 | byte);
    load->range <<= 8;
    load->code = load->code << 8 | byte;
    yb_status_t status = YB_MORE;
    while (status == YB_MORE && load->range >= RANGE_LEAST) {
        if (load->state == END_OF_RELIEF)
            return end_relief(map, load);
        if (decide_element(load))
            status = take_field(map, load);
    }
    return status;
}
