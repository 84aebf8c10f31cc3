#include "simplify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The line's places between two kept ones, waiting to be looked at; indices may run past the end
 * of a closed line.
 */
typedef struct {
    int from, to;
} span_t;

static const yb_place_t *place_at(const yb_line_t *line, int index)
{
    return &line->place[index % line->count];
}

static double squared_distance(const yb_place_t *a, const yb_place_t *b)
{
    double x = b->x_m - a->x_m;
    double y = b->y_m - a->y_m;
    return x * x + y * y;
}

/* Squared distance of p from the segment ab. */
static double squared_from_segment(const yb_place_t *p, const yb_place_t *a, const yb_place_t *b)
{
    double length = squared_distance(a, b);
    if (length == 0)
        return squared_distance(p, a);
    double along = (p->x_m - a->x_m) * (b->x_m - a->x_m) + (p->y_m - a->y_m) * (b->y_m - a->y_m);
    along = fmin(fmax(along / length, 0), 1);
    yb_place_t foot = {a->x_m + along * (b->x_m - a->x_m), a->y_m + along * (b->y_m - a->y_m)};
    return squared_distance(p, &foot);
}

static int farthest_from(const yb_line_t *line, int from)
{
    int best = from;
    for (int i = 0; i < line->count; i++)
        if (squared_distance(&line->place[i], &line->place[from]) >
            squared_distance(&line->place[best], &line->place[from]))
            best = i;
    return best;
}

/* The place between the ends of a span that is farthest from its chord. */
static int farthest_in(const yb_line_t *line, span_t span, double *squared)
{
    int best = span.from;
    *squared = -1;
    for (int i = span.from + 1; i < span.to; i++) {
        double d = squared_from_segment(place_at(line, i), place_at(line, span.from),
                                        place_at(line, span.to));
        if (d > *squared) {
            *squared = d;
            best = i;
        }
    }
    return best;
}

static int collect(const yb_line_t *line, const bool *keep, int *kept)
{
    int count = 0;
    for (int i = 0; i < line->count; i++)
        if (keep[i])
            kept[count++] = i;
    return count;
}

/* Splits the spans on the stack until none leaves the tolerance. */
static void split_spans(const yb_line_t *line, double squared_tolerance, span_t *stack, int depth,
                        bool *keep)
{
    while (depth > 0) {
        span_t span = stack[--depth];
        double squared = 0;
        int middle = farthest_in(line, span, &squared);
        if (squared <= squared_tolerance)
            continue;
        keep[middle % line->count] = true;
        stack[depth++] = (span_t){span.from, middle};
        stack[depth++] = (span_t){middle, span.to};
    }
}

int yb_simplify(const yb_line_t *line, double tolerance_m, int *kept)
{
    bool *keep = calloc((size_t)line->count, sizeof(*keep));
    span_t *stack = calloc((size_t)line->count + 2, sizeof(*stack));
    int count = 0;
    if (keep != NULL && stack != NULL && line->count > 0) {
        int depth = 0;
        int from = 0;
        int to = line->count - 1;
        if (line->closed) {
            from = farthest_from(line, farthest_from(line, 0));
            to = farthest_from(line, from);
            to = to < from ? to + line->count : to;
            stack[depth++] = (span_t){to, from + line->count};
        }
        stack[depth++] = (span_t){from, to};
        keep[from] = true;
        keep[to % line->count] = true;
        split_spans(line, tolerance_m * tolerance_m, stack, depth, keep);
        count = collect(line, keep, kept);
        if (line->closed && count == 2 && line->count > 2) {
            double first = 0;
            double second = 0;
            int a = farthest_in(line, (span_t){from, to}, &first);
            int b = farthest_in(line, (span_t){to, from + line->count}, &second);
            keep[(first >= second ? a : b) % line->count] = true;
            count = collect(line, keep, kept);
        }
    }
    free(keep);
    free(stack);
    return count;
}

/* The multiple of `unit` nearest to `wanted`, from low to high. */
static int snap(double wanted, int unit, int low, int high)
{
    int value = (int)lround(wanted / unit) * unit;
    while (value < low)
        value += unit;
    while (value > high)
        value -= unit;
    return value;
}

typedef struct {
    double x, y;
} wanted_t;

static wanted_t to_steps(const yb_lattice_t *lattice, const yb_place_t *place)
{
    return (wanted_t){place->x_m / lattice->width_m * lattice->east,
                      place->y_m / lattice->depth_m * lattice->north};
}

/* Takes out points that repeat the one before, or lie on the way between their neighbours. */
static int tidy(yb_step_t *point, int count, bool open)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        if (kept > 0 && point[kept - 1].x == point[i].x && point[kept - 1].y == point[i].y)
            continue;
        point[kept++] = point[i];
    }
    if (!open)
        while (kept > 1 && point[kept - 1].x == point[0].x && point[kept - 1].y == point[0].y)
            kept--;
    return kept;
}

int yb_simplify_to_lattice(const yb_line_t *line, double tolerance_m, const yb_lattice_t *lattice,
                           yb_step_t *point, int room)
{
    int *kept = calloc((size_t)line->count, sizeof(*kept));
    int count = kept != NULL ? yb_simplify(line, tolerance_m, kept) : 0;
    bool open = !line->closed && line->count > 1;
    if (count > room)
        count = 0;
    for (int i = 0; i < count; i++) {
        wanted_t at = to_steps(lattice, &line->place[kept[i]]);
        bool end = open && (i == 0 || i == count - 1);
        bool end_x = end && (at.x <= 0 || at.x >= lattice->east);
        bool end_y = end && (at.y <= 0 || at.y >= lattice->north);
        int x = snap(at.x, lattice->spacing, end_x ? 0 : 1, lattice->east - (end_x ? 0 : 1));
        int y = snap(at.y, lattice->spacing, end_y ? 0 : 1, lattice->north - (end_y ? 0 : 1));
        point[i] = (yb_step_t){(uint8_t)x, (uint8_t)y};
    }
    free(kept);
    count = tidy(point, count, open);
    int least = open ? 2 : line->closed ? 3 : 1;
    return count < least ? 0 : count;
}

static int turn(yb_step_t a, yb_step_t b, yb_step_t c)
{
    int area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return (area > 0) - (area < 0);
}

/* p on the segment ab, ends included. */
static bool on_segment(yb_step_t p, yb_step_t a, yb_step_t b)
{
    return turn(a, b, p) == 0 && p.x >= (a.x < b.x ? a.x : b.x) && p.x <= (a.x > b.x ? a.x : b.x) &&
           p.y >= (a.y < b.y ? a.y : b.y) && p.y <= (a.y > b.y ? a.y : b.y);
}

static bool segments_meet(yb_step_t a, yb_step_t b, yb_step_t c, yb_step_t d)
{
    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
        return true;
    return on_segment(c, a, b) || on_segment(d, a, b) || on_segment(a, c, d) || on_segment(b, c, d);
}

static int segment_count(int count, bool open)
{
    return count == 1 ? 1 : open ? count - 1 : count;
}

/* A spot height counts as a segment of no length. */
static bool contours_meet(const yb_step_t *a, int a_count, bool a_open, const yb_step_t *b,
                          int b_count, bool b_open)
{
    for (int i = 0; i < segment_count(a_count, a_open); i++)
        for (int k = 0; k < segment_count(b_count, b_open); k++)
            if (segments_meet(a[i], a[(i + 1) % a_count], b[k], b[(k + 1) % b_count]))
                return true;
    return false;
}

/* Two segments from one to the next that run back over each other. */
static bool folds(yb_step_t before, yb_step_t shared, yb_step_t after)
{
    return on_segment(after, before, shared) || on_segment(before, shared, after);
}

static bool meets_itself(const yb_step_t *point, int count, bool open)
{
    int segments = segment_count(count, open);
    for (int i = 0; i < segments; i++)
        for (int k = i + 1; k < segments; k++) {
            yb_step_t a = point[i];
            yb_step_t b = point[(i + 1) % count];
            yb_step_t c = point[k];
            yb_step_t d = point[(k + 1) % count];
            if (k == i + 1) {
                if (folds(a, b, d))
                    return true;
            } else if (!open && i == 0 && k == segments - 1) {
                if (folds(c, a, b))
                    return true;
            } else if (segments_meet(a, b, c, d)) {
                return true;
            }
        }
    return false;
}

/* Both on the same side of the frame. */
static bool along_frame(const yb_contour_set_t *set, yb_step_t a, yb_step_t b)
{
    return (a.x == b.x && (a.x == 0 || a.x == set->east)) ||
           (a.y == b.y && (a.y == 0 || a.y == set->north));
}

bool yb_simplify_fits(const yb_contour_set_t *set, const yb_step_t *point, int count, bool open)
{
    if (open && count == 2 && along_frame(set, point[0], point[1]))
        return false;
    if (count > 1 && meets_itself(point, count, open))
        return false;
    const yb_step_t *other = set->point;
    for (int i = 0; i < set->contour_count; i++) {
        if (contours_meet(point, count, open, other, set->contour[i].count, set->contour[i].open))
            return false;
        other += set->contour[i].count;
    }
    return true;
}

/* Whether one segment of a contour meets another of the same. */
static bool meets_own(const yb_step_t *point, int count, bool open, int one)
{
    yb_step_t a = point[one];
    yb_step_t b = point[(one + 1) % count];
    for (int k = 0; k < segment_count(count, open); k++) {
        yb_step_t c = point[k];
        yb_step_t d = point[(k + 1) % count];
        if (k == one)
            continue;
        if (k == (one + 1) % count   ? folds(a, b, d)
            : one == (k + 1) % count ? folds(c, a, b)
                                     : segments_meet(a, b, c, d))
            return true;
    }
    return false;
}

/* Whether the segment ab meets another contour than its own. */
static bool meets_others(const yb_contour_set_t *set, int own, yb_step_t a, yb_step_t b)
{
    const yb_step_t *point = set->point;
    for (int i = 0; i < set->contour_count; point += set->contour[i++].count) {
        int count = set->contour[i].count;
        for (int k = 0; k < segment_count(count, set->contour[i].open) && i != own; k++)
            if (segments_meet(a, b, point[k], point[(k + 1) % count]))
                return true;
    }
    return false;
}

bool yb_simplify_point_fits(const yb_contour_set_t *set, int contour, int at)
{
    int count = set->contour[contour].count;
    bool open = set->contour[contour].open;
    const yb_step_t *point = &set->point[yb_contour_set_first(set, contour)];
    if (open && count == 2 && along_frame(set, point[0], point[1]))
        return false;
    for (int back = 0; back < (count > 1 ? 2 : 1); back++) {
        int one = (at + count - back) % count;
        if (one >= segment_count(count, open))
            continue;
        if ((count > 1 && meets_own(point, count, open, one)) ||
            meets_others(set, contour, point[one], point[(one + 1) % count]))
            return false;
    }
    return true;
}
