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
    NUMBER,
    BIT = 2, /* one of two, … */
    REST,    /* of a number: the bits within its class */
    TURN = 8 /* … one of eight, by a tree of models */
};

/* What takes a field answers which one comes next, or with an error, below 0. */
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
    LENGTH,
    SECTOR,
    PLACE,
    END_OF_LINE,
    CORNER,
    SPOT_COUNT,
    GAP,
    CELL,
    /* from here on heights, each followed by its sign */
    LINE_HEIGHT,
    LINE_DOWN,
    CORNER_HEIGHT,
    CORNER_DOWN,
    SPOT_HEIGHT,
    SPOT_DOWN,
    SECTIONS,
    END_OF_RELIEF
};

/* The element that says a field, and its first model or, of one of n, n - 1. What takes the field
 * before may add to that: it leaves the sum's other part in load->at, which is 0 before.
 */
static const struct {
    uint8_t element, argument;
} question[] YB_ROM = {
    [CELL_EXPONENT] = {UNIFORM, 15},
    [CELL_MANTISSA] = {UNIFORM, 255},
    [SPACING] = {UNIFORM, 15},
    [OBLONG] = {BIT, MODEL_OBLONG},
    [SHORTER] = {UNIFORM, 1},
    [SHORT_SIDE] = {UNIFORM, 0},
    [UNIT_EXPONENT] = {UNIFORM, 15},
    [UNIT_MANTISSA] = {UNIFORM, 15},
    [COARSE] = {BIT, MODEL_COARSE},
    [INTERVAL] = {UNIFORM, 2},
    [BASE] = {NUMBER, MODEL_BASE},
    [BASE_DOWN] = {UNIFORM, 1},
    [DIMENSION] = {UNIFORM, 31},
    [GAIN] = {UNIFORM, 15},
    [STRAIGHT] = {BIT, MODEL_STRAIGHT},
    [VERTICES] = {UNIFORM, 15},
    [LINE_COUNT] = {NUMBER, MODEL_LINES},
    [CLOSED] = {BIT, MODEL_CLOSED},
    [START_X] = {NUMBER, MODEL_START},
    [START_Y] = {NUMBER, MODEL_START},
    [WAY] = {NUMBER, MODEL_WAY},
    [LENGTH] = {NUMBER, MODEL_LENGTH},
    [SECTOR] = {TURN, MODEL_TURN},
    [PLACE] = {UNIFORM, 0},
    [END_OF_LINE] = {BIT, MODEL_END},
    [CORNER] = {BIT, MODEL_CORNER},
    [SPOT_COUNT] = {NUMBER, MODEL_SPOTS},
    [GAP] = {BIT, MODEL_GAP},
    [CELL] = {UNIFORM, 0},
    [LINE_HEIGHT] = {NUMBER, MODEL_LINE_HEIGHT},
    [LINE_DOWN] = {BIT, MODEL_LINE_DOWN},
    [CORNER_HEIGHT] = {NUMBER, MODEL_CORNER_HEIGHT},
    [CORNER_DOWN] = {BIT, MODEL_CORNER_DOWN},
    [SPOT_HEIGHT] = {NUMBER, MODEL_SPOT_HEIGHT},
    [SPOT_DOWN] = {BIT, MODEL_SPOT_DOWN},
    [SECTIONS] = {BIT, MODEL_SECTIONS},
    [END_OF_RELIEF] = {UNIFORM, 0},
};

/* --- Elements ------------------------------------------------------------------------------- */

static void ask(yb_load_t *load, int field)
{
    load->state = (uint8_t)field;
    load->element = yb_rom_u8(&question[field].element);
    load->at = (uint16_t)(load->at + yb_rom_u8(&question[field].argument));
    load->value = load->element == UNIFORM ? 0 : 1; /* before the bits of what has some */
    load->classes = 0;
}

static int decide(yb_load_t *load, int model_index)
{
    uint16_t *model = &load->scratch->model[model_index];
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

static int decide_uniform(yb_load_t *load, uint32_t count)
{
    uint32_t part = load->range / count;
    uint32_t value = (uint32_t)fix_min((int32_t)(load->code / part), (int32_t)count - 1);
    load->code -= value * part;
    load->range = part;
    return (int)value;
}

/* One decision. True when the element is complete in load->value. */
static bool decide_element(yb_load_t *load)
{
    switch ((enum element)load->element) {
    case BIT:
    case TURN:
        load->value = (uint16_t)(load->value << 1 | decide(load, load->at + load->value - 1));
        if (load->value < load->element)
            return false;
        load->value = (uint16_t)(load->value - load->element);
        return true;
    case NUMBER: /* the class, in unary */
        if (load->classes < MOST_CLASS &&
            decide(load, load->at + (int)fix_min(load->classes, NUMBER_MODELS - 1)) != 0) {
            load->classes++;
            return false;
        }
        load->element = REST;
        load->at = 1; /* a bit of the rest is one of two */
        break;
    default:
        load->value = (uint16_t)(load->value << 1 | decide_uniform(load, load->at + 1u));
        if (load->element == UNIFORM)
            return true;
    }
    if (load->value >> load->classes == 0)
        return false;
    load->value--;
    return true;
}

/* --- Header --------------------------------------------------------------------------------- */

/* 0, then about half octaves from 1 to 181. */
static uint8_t gain_of(int coded)
{
    return (uint8_t)(coded == 0 ? 0 : (coded & 1 ? 181 : 128) >> (7 - coded / 2));
}

static int take_vertices(yb_load_t *load, int value)
{
    uint32_t vertices = value < 8 ? 32 * ((uint32_t)value + 1) : (uint32_t)512 << (value - 8);
    vertices -= (value & 7) == 7 ? 1 : 0; /* 255 and 65535: what an index can count */
    if (vertices > YB_MAX_VERTICES)
        return YB_ERR_LIMIT;
    load->vertices_promised = (uint16_t)vertices;
    load->map->east_q8 = (uint16_t)((uint32_t)(load->columns * load->spacing) << 8);
    load->map->north_q8 = (uint16_t)((uint32_t)(load->rows * load->spacing) << 8);
    load->start_x = load->columns / 2;
    load->start_y = load->rows / 2;
    return LINE_COUNT;
}

/* Fields follow each other in the enum's order, but for those that are left out. */
static int take_header(yb_load_t *load, int value)
{
    yb_map_t *map = load->map;
    int next = load->state + 1;
    switch ((enum field)load->state) {
    case CELL_EXPONENT:
        map->cell = (uint16_t)value;
        break;
    case CELL_MANTISSA:
        /* Exponent 0: 0 to 255 64ths of a metre; else a ninth bit stands before the mantissa. */
        map->cell = (uint16_t)(map->cell == 0 ? value : (map->cell - 1) << 12 | 256 | value);
        return map->cell == 0 ? YB_ERR_CORRUPT : next;
    case SPACING:
        load->spacing = (uint8_t)(value + 1);
        load->columns = load->rows = (uint8_t)(255 / load->spacing);
        break;
    case OBLONG:
        return value == 0 ? UNIT_EXPONENT : next;
    case SHORTER:
        load->narrow = value != 0;
        load->at = (uint16_t)(load->columns - 1);
        break;
    case SHORT_SIDE:
        *(load->narrow ? &load->columns : &load->rows) = (uint8_t)(value + 1);
        break;
    case UNIT_EXPONENT:
        map->unit = (uint16_t)((unsigned)value << 12);
        break;
    case UNIT_MANTISSA:
        map->unit = (uint16_t)(map->unit | 16 | value);
        break;
    case COARSE:
        return value == 0 ? BASE : next;
    case INTERVAL:
        load->interval = (uint8_t)(value + 1);
        break;
    case BASE:
        load->base = value;
        return value == 0 ? DIMENSION : next;
    case BASE_DOWN:
        load->base = value != 0 ? -load->base : load->base;
        break;
    case DIMENSION:
        map->hurst_q8m1 = (uint8_t)(255 - 8 * value);
        break;
    case GAIN:
        load->gain = gain_of(value);
        break;
    case STRAIGHT:
        map->smooth = value == 0;
        break;
    default:
        return take_vertices(load, value);
    }
    return next;
}

/* --- Points --------------------------------------------------------------------------------- */

/* Heights farther from the base, in units, are too high in every unit. */
#define MOST_UNITS ((int32_t)1 << 29)

/* Until the relief is complete a vertex's z is in units above the base; cut, so that sums of
 * however many differences below 2^18 fit.
 */
APART bool add_here(yb_load_t *load, int32_t units)
{
    return add_point(load, (int32_t)load->x * load->spacing, (int32_t)load->y * load->spacing,
                     fix_clamp(units, -MOST_UNITS, MOST_UNITS));
}

/* There are at most as many contours as points, so that there is room for one if for its point. */
static bool begin_contour(yb_load_t *load, int32_t units)
{
    int first = load->vertex_count;
    if (!add_here(load, units))
        return false;
    yb_contour_t *contour = &load->contour[load->contour_count++];
    contour->first = (yb_index_t)first;
    contour->count = 1;
    return true;
}

/* Height of the point nearest to the present place, of those known so far; 0 if none is. */
static int32_t height_near(const yb_load_t *load)
{
    int32_t nearest = INT32_MAX;
    int32_t units = 0;
    for (int i = 0; i < load->vertex_count; i++) {
        const yb_vertex_t *v = vertex_of(load, i);
        int32_t dx = (int32_t)(v->x_q8 >> 8) - load->x * load->spacing;
        int32_t dy = (int32_t)(v->y_q8 >> 8) - load->y * load->spacing;
        int32_t d = dx * dx + dy * dy;
        if (d < nearest) {
            nearest = d;
            units = v->z_q8;
        }
    }
    return units;
}

/* --- Lines ---------------------------------------------------------------------------------- */

/* Sets the place to the corner that comes next. */
static int next_corner(yb_load_t *load)
{
    int k = load->corner_at;
    load->x = ((k + 1) & 2) != 0 ? load->columns : 0;
    load->y = (k & 2) != 0 ? load->rows : 0;
    if (k < 4)
        return CORNER;
    for (int i = 0; i < 4; i++)
        if (load->corner_height[i] != UNKNOWN_HEIGHT)
            return SPOT_COUNT;
    return CORNER_HEIGHT; /* one for the whole frame, told from the first corner's place */
}

static int next_line(yb_load_t *load)
{
    if (load->lines == 0)
        return next_corner(load);
    load->lines--;
    return CLOSED;
}

static int next_step(yb_load_t *load)
{
    load->at = (uint16_t)(load->length_context * NUMBER_MODELS);
    return LENGTH;
}

/* A number that may be negative: 0, -1, 1, -2, 2 … */
APART int signed_of(int value)
{
    return value >> 1 ^ -(value & 1);
}

/* The start of an open line: `way` lattice steps along the frame, counter-clockwise from the
 * south-west; its first step is expected to lead straight into the map.
 */
static int take_way(yb_load_t *load, int way)
{
    int half = load->columns + load->rows;
    way = (load->start_way + way) % (2 * half);
    way = way < 0 ? way + 2 * half : way;
    load->start_way = way;
    bool far = way >= half;
    way -= far ? half : 0;
    load->x = (int)fix_min(way, load->columns);
    load->y = way - load->x;
    int inward = way < load->columns ? 2 : 4; /* north, or west; then south, or east */
    if (far) {
        load->x = load->columns - load->x;
        load->y = load->rows - load->y;
        inward = (inward + 4) & 7;
    }
    load->last = (yb_ring_t){1, inward};
    load->turn_context = TURN_INWARD;
    return LINE_HEIGHT;
}

static int take_start(yb_load_t *load)
{
    load->x = load->start_x;
    load->y = load->start_y;
    load->last = (yb_ring_t){1, 0};
    load->turn_context = TURN_FIRST;
    /* As unsigned numbers, what is below zero is far beyond the other sides. */
    bool outside = (unsigned)load->x > load->columns || (unsigned)load->y > load->rows;
    return outside ? YB_ERR_CORRUPT : (int)LINE_HEIGHT;
}

static int take_place(yb_load_t *load, int rest)
{
    int n = load->number;
    int dx = 0;
    int dy = 0;
    int place = (ring_ahead(load->last, n) + load->sector * n + rest) % (8 * n);
    load->last = (yb_ring_t){n, place};
    ring_step(load->last, &dx, &dy);
    load->turn_context = (uint8_t)turn_context(load->sector);
    load->length_context = (uint8_t)length_context(n);
    load->x = load->x + dx;
    load->y = load->y + dy;
    yb_contour_t *contour = &load->contour[load->contour_count - 1];
    if (load->open) { /* it ends where it would leave the map */
        load->x = (int)fix_clamp(load->x, 0, load->columns);
        load->y = (int)fix_clamp(load->y, 0, load->rows);
    }
    contour->count++;
    if (!add_here(load, load->vertex[contour->first].z_q8))
        return YB_ERR_CORRUPT;
    if (load->open)
        return on_frame(load, &load->vertex[load->vertex_count - 1]) ? next_line(load)
                                                                     : next_step(load);
    if (contour->count < 3)
        return next_step(load);
    int32_t away = fix_max(fix_abs(load->x - load->start_x), fix_abs(load->y - load->start_y));
    load->at = away <= 2 * n ? 1 : 0;
    return END_OF_LINE;
}

static int take_line(yb_load_t *load, int value)
{
    int next = load->state + 1;
    switch ((enum field)load->state) {
    case LINE_COUNT:
        load->lines = (uint16_t)value;
        return next_line(load);
    case CLOSED:
        load->open = value != 0;
        return load->open ? WAY : next;
    case START_X:
        load->start_x = load->start_x + signed_of(value);
        return next;
    case START_Y:
        load->start_y = load->start_y + signed_of(value);
        return take_start(load);
    case WAY:
        return take_way(load, signed_of(value));
    case LENGTH:
        load->number = value + 1;
        load->at = (uint16_t)(load->turn_context * TURN_MODELS);
        return value < 255 ? next : YB_ERR_CORRUPT;
    case SECTOR:
        load->sector = (uint8_t)value;
        load->at = (uint16_t)(load->number - 1);
        return next;
    case PLACE:
        return take_place(load, value);
    default:
        return value != 0 ? next_line(load) : next_step(load);
    }
}

/* --- Corners and spot heights --------------------------------------------------------------- */

static int32_t inner_places(const yb_load_t *load)
{
    return (load->columns - 1) * ((int32_t)load->rows - 1);
}

/* Spot heights lie in the inner lattice points' order, row by row. The gap to the next one is
 * coded in runs of about its median, from how many points and spots are left.
 */
static int next_spot(yb_load_t *load)
{
    if (load->spots == 0)
        return SECTIONS;
    if (load->places_left <= 0)
        return YB_ERR_CORRUPT;
    load->run = (uint16_t)gap_run((uint32_t)load->places_left, load->spots);
    return GAP;
}

static int take_gap(yb_load_t *load, int more)
{
    if (more == 0) {
        load->at = (uint16_t)(load->run - 1);
        return CELL;
    }
    load->places_left -= load->run;
    return load->places_left > 0 ? (int)GAP : YB_ERR_CORRUPT;
}

static int take_cell(yb_load_t *load, int value)
{
    load->places_left -= value;
    if (load->places_left <= 0)
        return YB_ERR_CORRUPT;
    uint32_t columns = load->columns - 1u;
    uint32_t place = (uint32_t)(inner_places(load) - load->places_left);
    load->x = (int)(1 + place % columns);
    load->y = (int)(1 + place / columns);
    load->places_left--;
    load->spots--;
    return SPOT_HEIGHT;
}

static int take_corner_or_spot(yb_load_t *load, int value)
{
    switch ((enum field)load->state) {
    case CORNER:
        if (value != 0)
            return CORNER_HEIGHT;
        load->corner_at++;
        return next_corner(load);
    case SPOT_COUNT:
        load->spots = (uint16_t)value;
        load->places_left = inner_places(load);
        return next_spot(load);
    case GAP:
        return take_gap(load, value);
    default:
        return take_cell(load, value);
    }
}

/* --- Heights -------------------------------------------------------------------------------- */

static int take_corner_height(yb_load_t *load, int32_t units)
{
    if (load->corner_at == 4) {
        load->frame_height = units;
        return SPOT_COUNT;
    }
    load->corner_height[load->corner_at++] = units;
    return next_corner(load);
}

static int take_height(yb_load_t *load, int value)
{
    int state = load->state;
    if ((state - LINE_HEIGHT) % 2 == 0) {
        load->number = value;
        if (value != 0)
            return state + 1;
    } else if (value != 0) {
        load->number = -load->number;
    }
    bool of_line = state <= LINE_DOWN;
    int32_t units =
        height_near(load) + (int32_t)load->number * (1 << (of_line ? load->interval : 0));
    if (state >= CORNER_HEIGHT && state <= CORNER_DOWN)
        return take_corner_height(load, units);
    if (!begin_contour(load, units))
        return YB_ERR_CORRUPT;
    load->length_context = 0;
    return of_line ? next_step(load) : next_spot(load);
}

/* --- The end -------------------------------------------------------------------------------- */

static yb_status_t end_relief(yb_load_t *load)
{
    yb_map_t *map = load->map;
    /* From 2^15 m below the datum on: |base| < 2^15 units below 2^20 64ths of a metre. */
    uint64_t base_64th_m =
        (uint64_t)fix_add((int32_t)1 << 21, load->base, (int32_t)yb_unit_64th_m(map->unit));
    uint32_t rest = (uint32_t)base_64th_m & 63;
    map->base_m = (int16_t)((int32_t)((uint32_t)base_64th_m / 64) - 32768);
    map->seed = load->recent >> 8 & 127;
    if (base_64th_m >> 22 != 0)
        return YB_ERR_CORRUPT;
    const int count = load->vertex_count; /* signed, also where an int has 16 bits */
    load->point_count = load->vertex_count;
    /* The frame's height, those of its corners that the code has, and the points'. */
    for (int i = -5; i < count; i++) {
        int32_t *height = i == -5 ? &load->frame_height
                          : i < 0 ? &load->corner_height[i + 4]
                                  : &load->vertex[i].z_q8;
        if (*height != UNKNOWN_HEIGHT && !settle_height(map, rest, height))
            return YB_ERR_CORRUPT;
    }
    return YB_OK;
}

static int take_field(yb_load_t *load)
{
    int value = load->value;
    load->at = 0;
    if (load->state < LINE_COUNT)
        return take_header(load, value);
    if (load->state < CORNER)
        return take_line(load, value);
    if (load->state < LINE_HEIGHT)
        return take_corner_or_spot(load, value);
    if (load->state < SECTIONS)
        return take_height(load, value);
    if (value != 0)
        load->section = 0;
    return END_OF_RELIEF;
}

void compact_begin(yb_load_t *load)
{
    for (int i = 0; i < MODELS; i++)
        load->scratch->model[i] = model_first(i);
    load->range = 1;
    ask(load, CELL_EXPONENT);
}

yb_status_t compact_take(yb_load_t *load, uint8_t byte)
{
    load->recent = (uint16_t)(load->recent << 8 | byte);
    load->range <<= 8;
    load->code = load->code << 8 | byte;
    while (load->range >= RANGE_LEAST) {
        if (load->state == END_OF_RELIEF)
            return end_relief(load);
        if (!decide_element(load))
            continue;
        int next = take_field(load);
        if (next < 0)
            return (yb_status_t)next;
        ask(load, next);
    }
    return YB_MORE;
}
