#include "similarity.h"

#include <math.h>
#include <stdlib.h>

#include "region.h"

/* A line by its arc length: distance from the first point to every point, the total last. */
typedef struct {
    const yb_region_t *region;
    double *at; /* count + 1 values; for an open line the last two are equal */
    double length;
} arc_t;

/* Turning less than this (as a sine) is rounding, not a turn. */
static const double least_turn = 1e-9;

static double distance(yb_point2_t a, yb_point2_t b)
{
    return hypot(b.x - a.x, b.y - a.y);
}

static bool arc_make(arc_t *arc, const yb_region_t *region)
{
    *arc = (arc_t){.region = region, .at = malloc((region->count + 1) * sizeof(*arc->at))};
    if (arc->at == NULL)
        return false;
    arc->at[0] = 0;
    for (size_t i = 0; i < region->count; i++) {
        const bool last = i + 1 == region->count;
        const yb_point2_t next = region->point[last ? 0 : i + 1];
        const double step = last && !region->closed ? 0 : distance(region->point[i], next);
        arc->at[i + 1] = arc->at[i] + step;
    }
    arc->length = arc->at[region->count];
    return true;
}

/* The point at an arc length; past its ends an open line stops and a closed one goes on. */
static yb_point2_t arc_point(const arc_t *arc, double length)
{
    const yb_region_t *region = arc->region;
    if (region->closed)
        length -= floor(length / arc->length) * arc->length;
    length = fmin(fmax(length, 0), arc->length);
    size_t low = 0, high = region->count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (arc->at[middle] <= length)
            low = middle;
        else
            high = middle;
    }
    const yb_point2_t a = region->point[low];
    const yb_point2_t b = region->point[high == region->count && region->closed ? 0
                                        : high == region->count                 ? low
                                                                                : high];
    const double step = arc->at[high] - arc->at[low];
    const double share = step > 0 ? (length - arc->at[low]) / step : 0;
    return (yb_point2_t){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

/* Arc length of the point of the line that is nearest to a place; the first of equals. */
static double arc_nearest(const arc_t *arc, yb_point2_t place)
{
    const yb_region_t *region = arc->region;
    const size_t segments = region->count - (region->closed ? 0 : 1);
    double best = HUGE_VAL, nearest = 0;
    for (size_t i = 0; i < segments; i++) {
        const yb_point2_t a = region->point[i], b = region->point[(i + 1) % region->count];
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double square = dx * dx + dy * dy;
        const double along =
            square > 0 ? ((place.x - a.x) * dx + (place.y - a.y) * dy) / square : 0;
        const double share = fmin(fmax(along, 0), 1);
        const double away = distance(place, (yb_point2_t){a.x + dx * share, a.y + dy * share});
        if (away < best) {
            best = away;
            nearest = arc->at[i] + (arc->at[i + 1] - arc->at[i]) * share;
        }
    }
    return nearest;
}

/* +1, -1 or 0: which way the line turns from the first to the second half of a piece of it. */
static int turning(const arc_t *arc, double first, double length)
{
    const yb_point2_t a = arc_point(arc, first);
    const yb_point2_t b = arc_point(arc, first + length / 2);
    const yb_point2_t c = arc_point(arc, first + length);
    const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    const double least = least_turn * distance(a, b) * distance(b, c);
    return (cross > least) - (cross < -least);
}

/* Where the steps of an original begin: an open line's start, a closed line's easternmost point
 * (of several the southernmost).
 */
static double first_step(const arc_t *arc)
{
    size_t first = 0;
    for (size_t i = 1; arc->region->closed && i < arc->region->count; i++) {
        const yb_point2_t here = arc->region->point[i], best = arc->region->point[first];
        if (here.x > best.x || (here.x == best.x && here.y < best.y))
            first = i;
    }
    return arc->at[first];
}

static double curvature_agreement(const arc_t *original, const arc_t *reproduced)
{
    const double step = original->length / YB_SIMILARITY_STEPS;
    const double piece = fmin(step, reproduced->length);
    const double start = first_step(original);
    int agree = 0;
    for (int i = 0; i < YB_SIMILARITY_STEPS; i++) {
        const double at = start + i * step;
        const double nearest = arc_nearest(reproduced, arc_point(original, at + step / 2));
        double first = nearest - piece / 2;
        if (!reproduced->region->closed)
            first = fmin(fmax(first, 0), reproduced->length - piece);
        agree += turning(original, at, step) == turning(reproduced, first, piece);
    }
    return (double)agree / YB_SIMILARITY_STEPS;
}

/* The line whose region overlaps `target` most, by *overlap. False if none does. */
static bool match(GEOSContextHandle_t geos, const yb_region_t *target, const yb_isolines_t *lines,
                  double east, double north, yb_region_t *best, size_t *index, double *overlap)
{
    *best = (yb_region_t){0};
    *index = YB_NO_LINE;
    *overlap = 0;
    for (size_t i = 0; i < lines->count; i++) {
        yb_region_t region[2] = {{0}};
        const int count = yb_region_make(geos, region, &lines->line[i], east, north);
        const double left = region[0].area, right = region[1].area;
        for (int side = 0; side < count; side++) {
            /* No overlap is better than the ratio of the areas: that spares most intersections. */
            const double area = side == 0 ? left : right;
            const double limit = fmin(area, target->area) / fmax(area, target->area);
            const double here =
                limit > *overlap ? yb_region_overlap(geos, target, &region[side]) : 0;
            if (count == 2 && area > fmin(left, right) && here < YB_SIMILARITY_LARGER_PART)
                continue;
            if (here > *overlap) {
                yb_region_free(geos, best);
                *best = region[side];
                region[side] = (yb_region_t){0};
                *index = i;
                *overlap = here;
            }
        }
        yb_region_free(geos, &region[0]);
        yb_region_free(geos, &region[1]);
    }
    return best->point != NULL;
}

static double polygon_length(const yb_isoline_t *line)
{
    double length = 0;
    for (size_t i = 1; i < line->count; i++)
        length += distance(line->point[i - 1], line->point[i]);
    if (line->closed && line->count > 1)
        length += distance(line->point[line->count - 1], line->point[0]);
    return length;
}

static bool compare(GEOSContextHandle_t geos, yb_similarity_t *similarity,
                    const yb_region_t *original, const yb_region_t *reproduced)
{
    arc_t first = {0}, second = {0};
    const bool good = arc_make(&first, original) && arc_make(&second, reproduced);
    similarity->hausdorff = yb_region_distance(geos, original, reproduced);
    if (good && similarity->hausdorff >= 0) {
        const double radius = sqrt(original->area / acos(-1.0));
        similarity->distance = 1 - fmin(1, similarity->hausdorff / radius);
        similarity->curvature = curvature_agreement(&first, &second);
        similarity->k = (similarity->area + similarity->distance + similarity->curvature) / 3;
    }
    free(first.at);
    free(second.at);
    return good && similarity->hausdorff >= 0;
}

/* The coded polygon's region: of an open one the smaller part of the frame, the left of equals. */
static bool coded_region(GEOSContextHandle_t geos, const yb_isoline_t *coded, double east,
                         double north, yb_region_t *region)
{
    yb_region_t part[2] = {{0}};
    const int count = yb_region_make(geos, part, coded, east, north);
    const int smaller = count == 2 && part[1].area < part[0].area ? 1 : 0;
    *region = part[smaller];
    yb_region_free(geos, &part[1 - smaller]);
    return count != 0;
}

bool yb_similarity_measure(yb_similarity_t *similarity, const yb_isoline_t *coded,
                           const yb_isolines_t *originals, const yb_isolines_t *reproductions,
                           double east, double north)
{
    *similarity = (yb_similarity_t){
        .length = polygon_length(coded), .original = YB_NO_LINE, .reproduced = YB_NO_LINE};
    GEOSContextHandle_t geos = yb_region_geos();
    if (geos == NULL)
        return false;
    bool good = true;
    double overlap = 0;
    yb_region_t polygon = {0}, original = {0}, reproduced = {0};
    if (coded_region(geos, coded, east, north, &polygon) &&
        match(geos, &polygon, originals, east, north, &original, &similarity->original, &overlap) &&
        match(geos, &original, reproductions, east, north, &reproduced, &similarity->reproduced,
              &similarity->area))
        good = compare(geos, similarity, &original, &reproduced);
    yb_region_free(geos, &polygon);
    yb_region_free(geos, &original);
    yb_region_free(geos, &reproduced);
    GEOS_finish_r(geos);
    return good;
}

double yb_similarity_mean(const yb_similarity_t *similarity, size_t count)
{
    double sum = 0, length = 0;
    for (size_t i = 0; i < count; i++) {
        sum += similarity[i].k * similarity[i].length;
        length += similarity[i].length;
    }
    return length > 0 ? sum / length : 0;
}
