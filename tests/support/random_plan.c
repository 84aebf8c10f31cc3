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
