#include "plan.h"

#include <stdlib.h>
#include <string.h>

void plan_init(plan_t *plan, int east, int north)
{
    memset(plan, 0, sizeof *plan);
    plan->east = east;
    plan->north = north;
    plan->cell = plan->unit = 64;
    plan->gain = 32;
    plan->dimension = 64;
    plan->vertices = PLAN_COUNT;
    for (int k = 0; k < 4; k++)
        plan->corner_height[k] = -1;
}

bool plan_add(plan_t *plan, const plan_point_t *points, int count, int height)
{
    if (plan->points + count > PLAN_MAX_POINTS || plan->contours == PLAN_MAX_CONTOURS)
        return false;
    plan->contour[plan->contours++] = (plan_contour_t){plan->points, count, height};
    for (int i = 0; i < count; i++)
        plan->point[plan->points++] = points[i];
    return true;
}

/* --- What is legal ---------------------------------------------------------------------------- */

static bool on_frame(const plan_t *plan, plan_point_t p)
{
    return p.x == 0 || p.y == 0 || p.x == plan->east || p.y == plan->north;
}

bool plan_open(const plan_t *plan, int contour)
{
    const plan_contour_t *c = &plan->contour[contour];
    return c->count > 1 && on_frame(plan, plan->point[c->first]) &&
           on_frame(plan, plan->point[c->first + c->count - 1]);
}

int plan_edges(const plan_t *plan, int contour)
{
    int count = plan->contour[contour].count;
    return count == 1 ? 0 : plan_open(plan, contour) ? count - 1 : count;
}

void plan_edge(const plan_t *plan, int contour, int k, int *a, int *b)
{
    const plan_contour_t *c = &plan->contour[contour];
    *a = c->first + k;
    *b = c->first + (k + 1) % c->count;
}

static long turn(plan_point_t a, plan_point_t b, plan_point_t c)
{
    return (long)(b.x - a.x) * (c.y - a.y) - (long)(b.y - a.y) * (c.x - a.x);
}

static bool between(plan_point_t a, plan_point_t b, plan_point_t p)
{
    return turn(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

static bool cross(plan_point_t a, plan_point_t b, plan_point_t c, plan_point_t d)
{
    long abc = turn(a, b, c);
    long abd = turn(a, b, d);
    long cda = turn(c, d, a);
    long cdb = turn(c, d, b);
    return ((abc > 0 && abd < 0) || (abc < 0 && abd > 0)) &&
           ((cda > 0 && cdb < 0) || (cda < 0 && cdb > 0));
}

/* The contour by itself: inside the frame, and on it only where it may be. */
static bool contour_legal(const plan_t *plan, int contour)
{
    const plan_contour_t *c = &plan->contour[contour];
    const plan_point_t *p = &plan->point[c->first];
    bool open = plan_open(plan, contour);
    for (int i = 0; i < c->count; i++) {
        if (p[i].x < 0 || p[i].y < 0 || p[i].x > plan->east || p[i].y > plan->north)
            return false;
        bool end = open && (i == 0 || i == c->count - 1);
        if (!end && on_frame(plan, p[i]))
            return false;
    }
    if (c->count != 2)
        return c->count > 0;
    bool upright = p[0].x == p[1].x && (p[0].x == 0 || p[0].x == plan->east);
    bool level = p[0].y == p[1].y && (p[0].y == 0 || p[0].y == plan->north);
    return open && !upright && !level;
}

/* Contour i against contour j <= i. */
static bool pair_legal(const plan_t *plan, int i, int j)
{
    const plan_contour_t *c = &plan->contour[i];
    const plan_contour_t *d = &plan->contour[j];
    const plan_point_t *p = plan->point;
    for (int m = c->first; m < c->first + c->count; m++) {
        for (int n = d->first; n < d->first + d->count; n++) {
            if (m != n && p[m].x == p[n].x && p[m].y == p[n].y)
                return false;
        }
    }
    for (int side = 0; side < 2; side++) {
        int line = side == 0 ? i : j;
        const plan_contour_t *dots = side == 0 ? d : c;
        for (int k = 0; k < plan_edges(plan, line); k++) {
            int a, b;
            plan_edge(plan, line, k, &a, &b);
            for (int n = dots->first; n < dots->first + dots->count; n++) {
                if (n != a && n != b && between(p[a], p[b], p[n]))
                    return false;
            }
        }
    }
    for (int k = 0; k < plan_edges(plan, i); k++) {
        for (int l = 0; l < plan_edges(plan, j); l++) {
            int a, b, e, f;
            plan_edge(plan, i, k, &a, &b);
            plan_edge(plan, j, l, &e, &f);
            if (cross(p[a], p[b], p[e], p[f]))
                return false;
        }
    }
    return true;
}

static int point_at(const plan_t *plan, int x, int y)
{
    for (int i = 0; i < plan->points; i++) {
        if (plan->point[i].x == x && plan->point[i].y == y)
            return i;
    }
    return -1;
}

static int point_at_corner(const plan_t *plan, int k)
{
    return point_at(plan, k == 1 || k == 2 ? plan->east : 0, k >= 2 ? plan->north : 0);
}

/* Heights within 512 steps: coded * unit / cell, rounded, in 1/256 step. */
static bool height_legal(const plan_t *plan, int height)
{
    uint64_t cell = (uint64_t)(plan->cell & 0xfff) << (plan->cell >> 12);
    uint64_t unit = (uint64_t)(plan->unit & 0xfff) << (plan->unit >> 12);
    return ((uint64_t)height * unit * 256 + cell / 2) / cell <= 131072;
}

static bool frame_legal(const plan_t *plan)
{
    bool any = false;
    for (int k = 0; k < 4; k++) {
        if (plan->corner_height[k] < 0)
            continue;
        any = true;
        if (point_at_corner(plan, k) >= 0 || !height_legal(plan, plan->corner_height[k]))
            return false;
    }
    return any || height_legal(plan, plan->frame_height);
}

bool plan_valid(const plan_t *plan)
{
    if (!frame_legal(plan))
        return false;
    for (int i = 0; i < plan->contours; i++) {
        if (!contour_legal(plan, i) || !height_legal(plan, plan->contour[i].height))
            return false;
        for (int j = 0; j <= i; j++) {
            if (!pair_legal(plan, i, j))
                return false;
        }
    }
    return true;
}

int plan_vertices(const plan_t *plan)
{
    int count = plan->points;
    for (int k = 0; k < 4; k++)
        count += point_at_corner(plan, k) < 0 ? 1 : 0;
    return count;
}

static bool steps_codable(const plan_t *plan, int contour)
{
    const plan_contour_t *c = &plan->contour[contour];
    int unit = 1 << plan->shift;
    for (int i = c->first + 1; i < c->first + c->count; i++) {
        int dx = plan->point[i].x - plan->point[i - 1].x;
        int dy = plan->point[i].y - plan->point[i - 1].y;
        if (dx % unit != 0 || dy % unit != 0 || dx / unit < -32 || dx / unit > 31 ||
            dy / unit < -32 || dy / unit > 31)
            return false;
    }
    return true;
}

bool plan_codable(const plan_t *plan, int most)
{
    if (plan_vertices(plan) > most)
        return false;
    for (int i = 0; i < plan->contours; i++) {
        if (!steps_codable(plan, i))
            return false;
    }
    return true;
}

bool plan_try(plan_t *plan, const plan_point_t *points, int count, int height)
{
    int contours = plan->contours;
    int before = plan->points;
    if (!plan_add(plan, points, count, height))
        return false;
    bool good = steps_codable(plan, contours) && contour_legal(plan, contours) &&
                height_legal(plan, height) && plan_vertices(plan) <= 255;
    for (int j = 0; good && j <= contours; j++)
        good = pair_legal(plan, contours, j);
    if (!good || !frame_legal(plan)) {
        plan->contours = contours;
        plan->points = before;
        return false;
    }
    return true;
}

/* --- Bytes ------------------------------------------------------------------------------------ */

typedef struct {
    uint8_t *bytes;
    size_t count; /* bits */
} bits_t;

static void put(bits_t *bits, unsigned width, int value)
{
    for (unsigned i = width; i-- > 0; bits->count++) {
        unsigned bit = (unsigned)value >> i & 1;
        bits->bytes[bits->count / 8] |= (uint8_t)(bit << (7 - bits->count % 8));
    }
}

static uint8_t check_of(const uint8_t *bytes, size_t count)
{
    /* Division of polynomials, bit by bit. */
    unsigned rest = 0;
    for (size_t i = 0; i < count * 8; i++) {
        unsigned top = rest >> 7 ^ (bytes[i / 8] >> (7 - i % 8) & 1u);
        rest = (rest << 1 & 255) ^ (top & 1 ? 0x07u : 0u);
    }
    return (uint8_t)rest;
}

void plan_mend(uint8_t *bytes, size_t count)
{
    bytes[count - 1] = check_of(bytes, count - 1);
}

static void put_header(const plan_t *plan, bits_t *bits)
{
    put(bits, 8, 0x20);
    for (int k = 0; k < 4; k++)
        put(bits, 1, plan->corner_height[k] >= 0 ? 1 : 0);
    put(bits, 2, plan->straight ? 1 : 0);
    put(bits, 2, plan->shift);
    put(bits, 8, plan->contours);
    put(bits, 8, plan->vertices == PLAN_COUNT ? 255 : plan->vertices);
    put(bits, 8, plan->east);
    put(bits, 8, plan->north);
    put(bits, 16, plan->cell);
    put(bits, 16, plan->unit);
    put(bits, 16, plan->base);
    put(bits, 8, plan->seed);
    put(bits, 8, plan->gain);
    bool any = false;
    for (int k = 0; k < 4; k++) {
        if (plan->corner_height[k] >= 0) {
            put(bits, 16, plan->corner_height[k]);
            any = true;
        }
    }
    if (!any)
        put(bits, 16, plan->frame_height);
}

size_t plan_write(const plan_t *plan, uint8_t bytes[PLAN_MAX_BYTES])
{
    memset(bytes, 0, PLAN_MAX_BYTES);
    bits_t bits = {bytes, 0};
    put_header(plan, &bits);
    for (int i = 0; i < plan->contours; i++)
        put(&bits, 8, plan->contour[i].count);
    put(&bits, 8, plan->dimension);
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *c = &plan->contour[i];
        const plan_point_t *p = &plan->point[c->first];
        put(&bits, 16, c->height);
        put(&bits, 8, p[0].x);
        put(&bits, 8, p[0].y);
        for (int k = 1; k < c->count; k++) {
            put(&bits, 6, (p[k].x - p[k - 1].x) / (1 << plan->shift));
            put(&bits, 6, (p[k].y - p[k - 1].y) / (1 << plan->shift));
        }
    }
    size_t count = (bits.count + 7) / 8 + 1;
    plan_mend(bytes, count);
    return count;
}
