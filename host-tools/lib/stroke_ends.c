#include "stroke_ends.h"

#include <math.h>
#include <stdlib.h>

/* Ends beyond this number are no gaps in lines. */
enum {
    MOST_LOOSE = 20000
};

/* A line and the gap after it lie within this cosine of one direction; less is asked of gaps that
 * are hardly wider than the line.
 */
static const double least_cosine = 0.35;
/* An end leads to the edge if it runs towards it at this cosine or more to the outward normal. */
static const double edge_cosine = 0.25;
static const double last_edge_cosine = -0.3;

typedef struct {
    int a, b;
    double cost;
} pair_t;

typedef struct {
    pair_t *pair;
    int count, room;
} pairs_t;

typedef struct {
    yb_end_t *end;
    const yb_ink_t *ink;
    double reach; /* the widest gap */
} joiner_t;

/* The direction of an end, from a place some way back. */
static void end_direction(yb_end_t *end, const yb_stroke_t *stroke, bool last, double thickness)
{
    int far = 4 + (int)thickness;
    far = far < stroke->count - 1 ? far : stroke->count - 1;
    yb_place_t a = stroke->place[last ? stroke->count - 1 - far : far];
    yb_place_t b = end->at;
    double length = hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    end->dx = length > 0 ? (b.x_m - a.x_m) / length : 0;
    end->dy = length > 0 ? (b.y_m - a.y_m) / length : 0;
}

/* Leads an end to the nearest side of the sheet if it is close enough and runs there. */
static bool lead_to_edge(yb_end_t *end, const yb_ink_t *ink, double most, double cosine)
{
    const double outwards[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const double away[4] = {end->at.x_m, ink->width - end->at.x_m, end->at.y_m,
                            ink->height - end->at.y_m};
    int best = -1;
    for (int side = 0; side < 4; side++) {
        double towards = end->dx * outwards[side][0] + end->dy * outwards[side][1];
        if (away[side] <= most && towards >= cosine && (best < 0 || away[side] < away[best]))
            best = side;
    }
    if (best < 0)
        return false;
    /* Straight on, unless that would run along the side. */
    double towards = end->dx * outwards[best][0] + end->dy * outwards[best][1];
    double along = towards > edge_cosine ? away[best] / towards : 0;
    double x = end->at.x_m + along * end->dx;
    double y = end->at.y_m + along * end->dy;
    x = best == 0 ? 0 : best == 1 ? ink->width : fmin(fmax(x, 0), ink->width);
    y = best == 2 ? 0 : best == 3 ? ink->height : fmin(fmax(y, 0), ink->height);
    end->edge = (yb_place_t){x, y};
    end->partner = YB_END_EDGE;
    return true;
}

/* Whether another line lies between two ends. */
static bool is_blocked(const yb_ink_t *ink, yb_place_t a, yb_place_t b)
{
    double length = hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    int steps = (int)(2 * length);
    for (int i = 4; i <= steps - 4; i++) {
        int x = (int)(a.x_m + i / (2 * length) * (b.x_m - a.x_m));
        int y = (int)(a.y_m + i / (2 * length) * (b.y_m - a.y_m));
        if (ink->pixel[yb_ink_index(ink, x, y)] != 0)
            return true;
    }
    return false;
}

/* What it costs to join two ends: the gap's width, more if the lines must bend. Negative: cannot
 * be joined.
 */
static double join_cost(const joiner_t *joiner, const yb_end_t *a, const yb_end_t *b)
{
    double x = b->at.x_m - a->at.x_m;
    double y = b->at.y_m - a->at.y_m;
    double gap = hypot(x, y);
    if (gap > joiner->reach || gap == 0)
        return -1;
    double first = (a->dx * x + a->dy * y) / gap;
    double second = -(b->dx * x + b->dy * y) / gap;
    double least = gap > joiner->ink->thickness + 2 ? least_cosine : 0;
    if (first < least || second < least || is_blocked(joiner->ink, a->at, b->at))
        return -1;
    return gap + joiner->reach / 2 * (2 - first - second);
}

static bool add_pair(pairs_t *pairs, pair_t pair)
{
    if (pairs->count == pairs->room) {
        int room = pairs->room == 0 ? 64 : 2 * pairs->room;
        pair_t *grown = realloc(pairs->pair, (size_t)room * sizeof(*grown));
        if (grown == NULL)
            return false;
        pairs->pair = grown;
        pairs->room = room;
    }
    pairs->pair[pairs->count++] = pair;
    return true;
}

static int by_cost(const void *a, const void *b)
{
    const pair_t *first = a;
    const pair_t *second = b;
    if (first->cost != second->cost)
        return first->cost < second->cost ? -1 : 1;
    return first->a != second->a ? first->a - second->a : first->b - second->b;
}

/* An end and its height on the sheet, to find those near it. */
typedef struct {
    double y;
    int end;
} row_t;

static int by_row(const void *a, const void *b)
{
    const row_t *first = a;
    const row_t *second = b;
    if (first->y != second->y)
        return first->y < second->y ? -1 : 1;
    return first->end - second->end;
}

static bool find_pairs(const joiner_t *joiner, const row_t *row, int count, pairs_t *pairs)
{
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count && row[k].y - row[i].y <= joiner->reach; k++) {
            pair_t pair = {row[i].end, row[k].end, 0};
            pair.cost = join_cost(joiner, &joiner->end[pair.a], &joiner->end[pair.b]);
            if (pair.cost >= 0 && !add_pair(pairs, pair))
                return false;
        }
    if (pairs->count > 1)
        qsort(pairs->pair, (size_t)pairs->count, sizeof(pair_t), by_cost);
    return true;
}

/* Joins loose ends, the surest first. */
static bool join_loose(const joiner_t *joiner, row_t *row, int count)
{
    pairs_t pairs = {0};
    if (count > 1)
        qsort(row, (size_t)count, sizeof(*row), by_row);
    bool good = find_pairs(joiner, row, count, &pairs);
    for (int i = 0; i < pairs.count && good; i++) {
        yb_end_t *a = &joiner->end[pairs.pair[i].a];
        yb_end_t *b = &joiner->end[pairs.pair[i].b];
        if (a->partner == YB_END_LOOSE && b->partner == YB_END_LOOSE) {
            a->partner = pairs.pair[i].b;
            b->partner = pairs.pair[i].a;
        }
    }
    free(pairs.pair);
    return good;
}

bool yb_ends_find(yb_end_t *end, const yb_strokes_t *strokes, const yb_ink_t *ink, bool *many)
{
    int ends = 2 * strokes->count;
    double edge = 1.5 * ink->thickness + 4;
    /* Half a thickness has been taken off each end. */
    joiner_t joiner = {end, ink, 3.5 * ink->thickness + 6};
    row_t *row = calloc((size_t)ends + 1, sizeof(*row));
    int loose = 0;
    if (row == NULL)
        return false;
    for (int i = 0; i < ends; i++) {
        const yb_stroke_t *stroke = &strokes->stroke[i / 2];
        end[i] = (yb_end_t){.partner = YB_END_LOOSE, .used = !stroke->closed};
        if (stroke->closed)
            continue;
        end[i].at = stroke->place[i % 2 == 0 ? 0 : stroke->count - 1];
        end_direction(&end[i], stroke, i % 2 == 1, ink->thickness);
        if (!lead_to_edge(&end[i], ink, edge, edge_cosine))
            row[loose++] = (row_t){end[i].at.y_m, i};
    }
    *many = loose > MOST_LOOSE;
    bool good = !*many && join_loose(&joiner, row, loose);
    free(row);
    for (int i = 0; i < ends && good; i++)
        if (end[i].used && end[i].partner == YB_END_LOOSE)
            lead_to_edge(&end[i], ink, edge, last_edge_cosine);
    return good;
}
