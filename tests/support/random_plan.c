#include "random_plan.h"

#include <math.h>
#include <stdlib.h>

static const double turn = 6.283185307179586;

/* --- From a drawn line to one that the bytes can say ------------------------------------------ */

typedef struct {
    plan_point_t point[PLAN_MAX_POINTS];
    int count;
} sketch_t;

static void dot(sketch_t *sketch, double x, double y)
{
    if (sketch->count < PLAN_MAX_POINTS)
        sketch->point[sketch->count++] = (plan_point_t){(int)lround(x), (int)lround(y)};
}

/* Goes from the last point of `line` to (x, y) by steps of at most 31 · 2^s. */
static void go_to(const plan_t *plan, sketch_t *line, plan_point_t to)
{
    int unit = 1 << plan->shift;
    if (line->count == 0) {
        dot(line, to.x, to.y);
        return;
    }
    for (;;) {
        plan_point_t at = line->point[line->count - 1];
        int dx = to.x - at.x;
        int dy = to.y - at.y;
        int longest = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
        int pieces = (longest + 31 * unit - 1) / (31 * unit);
        if (pieces < 1 || line->count == PLAN_MAX_POINTS)
            return;
        dot(line, at.x + round((double)dx / pieces / unit) * unit,
            at.y + round((double)dy / pieces / unit) * unit);
        if (pieces == 1)
            return;
    }
}

static bool finish(plan_t *plan, const sketch_t *sketch, int height)
{
    sketch_t line = {.count = 0};
    for (int i = 0; i < sketch->count; i++)
        go_to(plan, &line, sketch->point[i]);
    return line.count >= 2 && line.count <= 255 && plan_try(plan, line.point, line.count, height);
}

/* --- Shapes ----------------------------------------------------------------------------------- */

bool shape_blob(plan_t *plan, rng_t *rng, int x, int y, int radius, int height)
{
    sketch_t sketch = {.count = 0};
    int corners = rng_range(rng, 3, 20);
    double wild = rng_unit(rng) * 0.5;
    double phase = rng_unit(rng) * turn;
    bool clockwise = rng_one_in(rng, 2);
    for (int i = 0; i < corners; i++) {
        double angle = phase + (clockwise ? -i : i) * turn / corners;
        double r = radius * (1 - wild * rng_unit(rng));
        dot(&sketch, x + r * cos(angle), y + r * sin(angle));
    }
    return finish(plan, &sketch, height);
}

static bool shape_bow(plan_t *plan, rng_t *rng, int x, int y, int radius, int height)
{
    sketch_t sketch = {.count = 0};
    int corners = rng_range(rng, 3, 12);
    double from = rng_unit(rng) * turn;
    double span = turn * (0.4 + 0.55 * rng_unit(rng));
    double inner = radius * (0.5 + 0.4 * rng_unit(rng));
    for (int i = 0; i <= corners; i++) {
        double angle = from + span * i / corners;
        dot(&sketch, x + radius * cos(angle), y + radius * sin(angle));
    }
    for (int i = corners; i >= 0; i--) {
        double angle = from + span * i / corners;
        dot(&sketch, x + inner * cos(angle), y + inner * sin(angle));
    }
    return finish(plan, &sketch, height);
}

/* A round contour with deep dents (canyons) or thin spurs. */
static bool shape_star(plan_t *plan, rng_t *rng, int x, int y, int radius, int height)
{
    sketch_t sketch = {.count = 0};
    int corners = 2 * rng_range(rng, 3, 12);
    double inner = radius * (0.1 + 0.8 * rng_unit(rng));
    double lean = (rng_unit(rng) - 0.5) * 0.8;
    for (int i = 0; i < corners; i++) {
        double angle = (i + (i % 2 == 1 ? lean : 0)) * turn / corners;
        double r = i % 2 == 0 ? radius : inner;
        dot(&sketch, x + r * cos(angle), y + r * sin(angle));
    }
    return finish(plan, &sketch, height);
}

static bool shape_spiral(plan_t *plan, rng_t *rng, int x, int y, int radius, int height)
{
    sketch_t sketch = {.count = 0};
    int corners = rng_range(rng, 10, 40);
    double turns = 1 + 2 * rng_unit(rng);
    double gap = radius / turns * 0.45;
    for (int i = 0; i <= corners; i++) {
        double part = (double)i / corners;
        dot(&sketch, x + radius * part * cos(part * turns * turn),
            y + radius * part * sin(part * turns * turn));
    }
    for (int i = corners; i >= 1; i--) {
        double part = (double)i / corners;
        double r = radius * part + gap;
        dot(&sketch, x + r * cos(part * turns * turn), y + r * sin(part * turns * turn));
    }
    return finish(plan, &sketch, height);
}

bool shape_comb(plan_t *plan, int x, int y, int teeth, int pitch, int length, int height)
{
    sketch_t sketch = {.count = 0};
    for (int i = 0; i < teeth; i++) {
        dot(&sketch, x + i * pitch, y + length);
        dot(&sketch, x + i * pitch + pitch / 2.0, y + 1);
    }
    dot(&sketch, x + teeth * pitch, y + length);
    dot(&sketch, x + teeth * pitch, y);
    dot(&sketch, x, y);
    return finish(plan, &sketch, height);
}

/* A place on the frame. */
static plan_point_t frame_place(const plan_t *plan, rng_t *rng)
{
    plan_point_t p;
    p.x = rng_range(rng, 0, plan->east);
    p.y = rng_range(rng, 0, plan->north);
    if (rng_one_in(rng, 5)) {
        p.x = rng_one_in(rng, 2) ? 0 : plan->east;
        p.y = rng_one_in(rng, 2) ? 0 : plan->north;
    } else if (rng_one_in(rng, 2)) {
        p.x = rng_one_in(rng, 2) ? 0 : plan->east;
    } else {
        p.y = rng_one_in(rng, 2) ? 0 : plan->north;
    }
    return p;
}

bool random_open_line(plan_t *plan, rng_t *rng, int height)
{
    plan_point_t from = frame_place(plan, rng);
    plan_point_t to = frame_place(plan, rng);
    int bends = rng_range(rng, 0, 6);
    double wild = rng_unit(rng) * 0.3 * (plan->east < plan->north ? plan->east : plan->north);
    sketch_t sketch = {.count = 0};
    dot(&sketch, from.x, from.y);
    for (int i = 1; i <= bends; i++) {
        double part = (double)i / (bends + 1);
        double aside = wild * (rng_unit(rng) - 0.5);
        double on = wild * (rng_unit(rng) - 0.5);
        dot(&sketch, from.x + part * (to.x - from.x) + aside, from.y + part * (to.y - from.y) + on);
    }
    dot(&sketch, to.x, to.y);
    return finish(plan, &sketch, height);
}

/* --- Spot heights ----------------------------------------------------------------------------- */

static void spots(plan_t *plan, rng_t *rng, int count, int height)
{
    int kind = rng_range(rng, 0, 4);
    int x = rng_range(rng, 1, plan->east);
    int y = rng_range(rng, 1, plan->north);
    int dx = rng_range(rng, -6, 6);
    int dy = rng_range(rng, -6, 6);
    int pitch = rng_range(rng, 1, 12);
    static const int ring[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                    {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
    for (int i = 0; i < count; i++) {
        plan_point_t p;
        p.x = rng_range(rng, kind == 1 ? x - 8 : 1, kind == 1 ? x + 8 : plan->east);
        p.y = rng_range(rng, kind == 1 ? y - 8 : 1, kind == 1 ? y + 8 : plan->north);
        if (kind == 2)
            p = (plan_point_t){x + i * dx, y + i * dy};
        else if (kind == 3)
            p = (plan_point_t){x + ring[i % 12][0] * (pitch + i / 12),
                               y + ring[i % 12][1] * (pitch + i / 12)};
        else if (kind == 4)
            p = (plan_point_t){x + i % 8 * pitch, y + i / 8 * pitch};
        (void)plan_try(plan, &p, 1, height + rng_range(rng, 0, 40));
    }
}

/* --- Whole plans ------------------------------------------------------------------------------ */

static void random_header(plan_t *plan, rng_t *rng)
{
    static const int sides[] = {255, 255, 255, 128, 200, 64, 24, 9, 3};
    int east = sides[rng_range(rng, 0, 8)];
    int north = sides[rng_range(rng, 0, 8)];
    plan_init(plan, east, north);
    plan->shift = rng_one_in(rng, 3) ? rng_range(rng, 1, 3) : 0;
    plan->cell = rng_range(rng, 32, 512);
    plan->unit = rng_range(rng, 16, 128);
    plan->base = rng_range(rng, -100, 1000);
    plan->seed = rng_range(rng, 0, 255);
    plan->gain = rng_one_in(rng, 4) ? 0 : rng_range(rng, 1, 64);
    plan->dimension = rng_range(rng, 0, 255);
    plan->straight = rng_one_in(rng, 3);
    plan->frame_height = rng_range(rng, 0, 50);
}

static void random_shape(plan_t *plan, rng_t *rng)
{
    int side = plan->east < plan->north ? plan->east : plan->north;
    int x = rng_range(rng, 1, plan->east);
    int y = rng_range(rng, 1, plan->north);
    int radius = rng_range(rng, 1, side / 2 + 1);
    int height = rng_range(rng, 0, 200);
    int pitch;
    int count;
    switch (rng_range(rng, 0, 7)) {
    case 0:
        for (int r = radius; r > 1 && shape_blob(plan, rng, x, y, r, height); r = r * 3 / 5)
            height += 20;
        break;
    case 1:
        (void)shape_bow(plan, rng, x, y, radius, height);
        break;
    case 2:
        (void)shape_star(plan, rng, x, y, radius, height);
        break;
    case 3:
        (void)shape_spiral(plan, rng, x, y, radius, height);
        break;
    case 4:
        pitch = rng_range(rng, 2, 8);
        (void)shape_comb(plan, x, y, rng_range(rng, 2, 20), pitch, radius, height);
        break;
    case 5:
    case 6:
        (void)random_open_line(plan, rng, height);
        break;
    default:
        count = rng_one_in(rng, 8) ? 200 : 16;
        spots(plan, rng, rng_range(rng, 1, count), height);
        break;
    }
}

/* Heights at some of those corners that no line ends at. */
static void random_corners(plan_t *plan, rng_t *rng)
{
    for (int k = 0; k < 4; k++) {
        if (rng_one_in(rng, 3)) {
            plan->corner_height[k] = rng_range(rng, 0, 120);
            if (!plan_valid(plan))
                plan->corner_height[k] = -1;
        }
    }
}

void random_plan(plan_t *plan, rng_t *rng)
{
    random_header(plan, rng);
    int tries = rng_one_in(rng, 10) ? 60 : rng_range(rng, 0, 14);
    for (int i = 0; i < tries && plan->points < 240; i++)
        random_shape(plan, rng);
    random_corners(plan, rng);
}

/* --- Mountains -------------------------------------------------------------------------------- */

static void spot(plan_t *plan, int x, int y, int height)
{
    const plan_point_t p = {x, y};
    (void)plan_try(plan, &p, 1, height < 0 ? 0 : height);
}

/* How much higher the next line is than one before it: `step`, now and then nothing, or back. */
static int next_step(rng_t *rng, int step)
{
    return rng_one_in(rng, 6) ? 0 : rng_one_in(rng, 8) ? -step : step;
}

static int above_zero(int height)
{
    return height < 0 ? 0 : height;
}

/* Lines inside each other, and perhaps a summit, or two, inside the last. */
static void peak(plan_t *plan, rng_t *rng, int x, int y, int radius, int height, int step)
{
    int lines = rng_range(rng, 1, 3);
    for (int i = 0; i < lines && radius > 1; i++) {
        if (!shape_blob(plan, rng, x, y, radius, height))
            break;
        radius = radius * rng_range(rng, 3, 6) / 8;
        if (i + 1 < lines)
            height = above_zero(height + next_step(rng, step));
    }
    if (rng_one_in(rng, 2))
        spot(plan, x, y, height + next_step(rng, step) / 2);
    if (rng_one_in(rng, 8))
        spot(plan, x + radius / 3, y + radius / 4, height + next_step(rng, step) / 2);
}

/* A round contour with one deep and narrow dent, or a thin spur. */
static bool shape_canyon(plan_t *plan, rng_t *rng, int x, int y, int radius, int height)
{
    sketch_t sketch = {.count = 0};
    int corners = rng_range(rng, 6, 16);
    double phase = rng_unit(rng) * turn;
    double half = turn / corners / rng_range(rng, 2, 5);
    double head = rng_one_in(rng, 4) ? 1.3 + rng_unit(rng) : 0.8 * rng_unit(rng);
    int bends = rng_range(rng, 0, 3);
    double lean = rng_unit(rng) - 0.5;
    for (int i = 1; i < corners; i++)
        dot(&sketch, x + radius * cos(phase + i * turn / corners),
            y + radius * sin(phase + i * turn / corners));
    /* In along one side of the canyon to its head, and out again. */
    for (int k = 0; k <= 2 * bends + 2; k++) {
        int in = k <= bends ? k : 2 * bends + 2 - k;
        double part = (double)in / (bends + 1);
        double r = radius * (1 + (head - 1) * part);
        double off = k == bends + 1 ? 0 : k <= bends ? -half : half;
        double angle = phase + off * (1 - part * 0.7) + lean * part * (1 - part);
        dot(&sketch, x + r * cos(angle), y + r * sin(angle));
    }
    return finish(plan, &sketch, height);
}

/* Two to seven peaks, most of them of one height, in what has been drawn round (x, y). */
static void siblings(plan_t *plan, rng_t *rng, int x, int y, int radius, int height, int step)
{
    int count = rng_one_in(rng, 3) ? rng_range(rng, 4, 7) : rng_range(rng, 2, 3);
    double phase = rng_unit(rng) * turn;
    for (int i = 0; i < count; i++) {
        double angle = phase + i * turn / count + rng_unit(rng) - 0.5;
        double away = radius * (0.35 + 0.35 * rng_unit(rng));
        int size = radius * rng_range(rng, 1, 4) / 10;
        int high = height + (rng_one_in(rng, 5) ? next_step(rng, step) : 0);
        if (size > 0)
            peak(plan, rng, x + (int)(away * cos(angle)), y + (int)(away * sin(angle)), size,
                 above_zero(high), step);
    }
}

/* A line from one side of a corner of the frame to another, or to the corner itself. */
static void round_corner(plan_t *plan, rng_t *rng, int height)
{
    int k = rng_range(rng, 0, 3);
    int side = plan->east < plan->north ? plan->east : plan->north;
    for (int lines = rng_range(rng, 1, 3); lines > 0; lines--) {
        int a = rng_range(rng, 1, side - 1);
        int b = rng_range(rng, 1, side - 1);
        int x = k == 1 || k == 2 ? plan->east : 0;
        int y = k >= 2 ? plan->north : 0;
        sketch_t sketch = {.count = 0};
        dot(&sketch, abs(x - a), y);
        if (rng_one_in(rng, 2))
            dot(&sketch, abs(x - a / 2 - 1), abs(y - b / 2 - 1));
        dot(&sketch, rng_one_in(rng, 6) ? plan->east - x : x, abs(y - b));
        (void)finish(plan, &sketch, height);
        height += next_step(rng, 10);
        height = above_zero(height);
    }
}

static void mountain(plan_t *plan, rng_t *rng)
{
    int side = plan->east < plan->north ? plan->east : plan->north;
    int x = rng_range(rng, side / 4, plan->east - side / 4);
    int y = rng_range(rng, side / 4, plan->north - side / 4);
    int radius = rng_range(rng, side / 12 + 2, side / 2 + 1);
    int step = rng_one_in(rng, 4) ? -20 : 20;
    int height = rng_range(rng, 1, 8) * 20;
    int inside = height + next_step(rng, step);
    bool drawn = false;
    switch (rng_range(rng, 0, 9)) {
    case 0:
    case 1:
        drawn = shape_blob(plan, rng, x, y, radius, height);
        siblings(plan, rng, x, y, radius, inside, step);
        break;
    case 2:
    case 3:
        if (rng_one_in(rng, 2))
            (void)shape_blob(plan, rng, x, y, radius * 5 / 4 + 2, height - step);
        drawn = shape_canyon(plan, rng, x, y, radius, height);
        if (rng_one_in(rng, 2))
            peak(plan, rng, x, y, radius / 2, inside, step);
        break;
    case 4:
        drawn = shape_bow(plan, rng, x, y, radius, height);
        for (int i = 0; i < 6; i++) {
            double angle = rng_unit(rng) * turn;
            double away = radius * (0.6 + 0.3 * rng_unit(rng));
            peak(plan, rng, x + (int)(away * cos(angle)), y + (int)(away * sin(angle)),
                 radius / 10 + 1, inside, step);
        }
        break;
    case 5:
        drawn = rng_one_in(rng, 2) ? shape_star(plan, rng, x, y, radius, height)
                                   : shape_spiral(plan, rng, x, y, radius, height);
        siblings(plan, rng, x, y, radius / 2, inside, step);
        break;
    case 6:
        drawn =
            shape_comb(plan, x, y, rng_range(rng, 2, 12), rng_range(rng, 2, 10), radius, height);
        break;
    case 7:
        height = rng_one_in(rng, 2) ? 0 : height;
        for (int i = rng_range(rng, 1, 4); i > 0; i--) {
            drawn = random_open_line(plan, rng, height) || drawn;
            height = above_zero(height + next_step(rng, step));
        }
        break;
    case 8:
        round_corner(plan, rng, height);
        break;
    default:
        peak(plan, rng, x, y, radius, height, step);
        break;
    }
    if (drawn && rng_one_in(rng, 4))
        spot(plan, x + rng_range(rng, -radius, radius), y + rng_range(rng, -radius, radius),
             height);
}

void random_mountain(plan_t *plan, rng_t *rng)
{
    random_header(plan, rng);
    if (rng_one_in(rng, 2)) /* many mountains want room */
        plan->east = plan->north = 255;
    if (rng_one_in(rng, 2))
        plan->frame_height = 0;
    if (rng_one_in(rng, 12)) { /* next to no relief: heights that differ by a unit or not at all */
        plan->cell = 0x4fff;
        plan->unit = rng_range(rng, 1, 40);
    } else if (rng_one_in(rng, 20)) { /* up to the highest height there is */
        plan->cell = 40;
        plan->unit = 128;
    }
    for (int i = rng_range(rng, 1, 5); i > 0 && plan->points < 120; i--)
        mountain(plan, rng);
    if (rng_one_in(rng, 6))
        spots(plan, rng, rng_range(rng, 1, 6), rng_range(rng, 0, 8) * 20);
    if (rng_one_in(rng, 3))
        random_corners(plan, rng);
}

void random_mess(plan_t *plan, rng_t *rng)
{
    random_header(plan, rng);
    plan->shift = 0;
    int contours = rng_range(rng, 1, 6);
    for (int i = 0; i < contours; i++) {
        sketch_t sketch = {.count = 0};
        plan_point_t at = frame_place(plan, rng);
        if (!rng_one_in(rng, 3)) {
            at.x = rng_range(rng, 1, plan->east - 1);
            at.y = rng_range(rng, 1, plan->north - 1);
        }
        int count = rng_range(rng, 1, 8);
        int reach = rng_range(rng, 1, 31);
        for (int k = 0; k < count; k++) {
            dot(&sketch, at.x, at.y);
            at.x = at.x + rng_range(rng, -reach, reach);
            at.y = at.y + rng_range(rng, -reach, reach);
            if (rng_one_in(rng, 40) || k + 2 < count) {
                at.x = at.x < 1 ? 1 : at.x >= plan->east ? plan->east - 1 : at.x;
                at.y = at.y < 1 ? 1 : at.y >= plan->north ? plan->north - 1 : at.y;
            } else {
                at.x = at.x < 0 ? 0 : at.x > plan->east ? plan->east : at.x;
                at.y = at.y < 0 ? 0 : at.y > plan->north ? plan->north : at.y;
            }
        }
        (void)plan_add(plan, sketch.point, sketch.count, rng_range(rng, 0, 100));
    }
    if (rng_one_in(rng, 6))
        plan->corner_height[rng_range(rng, 0, 3)] = 7;
}

void random_map(plan_t *plan, uint64_t seed)
{
    rng_t rng = {seed};
    if (seed % 4 == 0)
        random_plan(plan, &rng);
    else
        random_mountain(plan, &rng);
}
