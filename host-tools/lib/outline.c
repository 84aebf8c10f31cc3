#include "outline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "region.h"
#include "similarity.h"

/* As in similarity.c. */
static const double least_turn = 1e-9;

static double squared(yb_point2_t a, yb_point2_t b)
{
    double x = b.x - a.x;
    double y = b.y - a.y;
    return x * x + y * y;
}

static double twice_area(const yb_point2_t *ring, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        yb_point2_t a = ring[i];
        yb_point2_t b = ring[i + 1 == count ? 0 : i + 1];
        sum += a.x * b.y - b.x * a.y;
    }
    return sum;
}

double yb_outline_area(const yb_isoline_t *line)
{
    return fabs(twice_area(line->point, line->count)) / 2;
}

/* The rows from *first up to *end that an edge crosses; rows lie half a row off whole ones. */
static void rows_of(yb_point2_t a, yb_point2_t b, double scale, int *first, int *end)
{
    int from = (int)(a.y * scale + 0.5);
    int to = (int)(b.y * scale + 0.5);
    *first = from < to ? from : to;
    *end = from < to ? to : from;
    *end = *end > YB_OUTLINE_ROWS ? YB_OUTLINE_ROWS : *end;
}

static void sort_row(float *x, int count)
{
    for (int i = 1; i < count; i++) {
        float moved = x[i];
        int at = i;
        for (; at > 0 && x[at - 1] > moved; at--)
            x[at] = x[at - 1];
        x[at] = moved;
    }
}

static void measure_boundary(yb_outline_t *outline)
{
    double longest = 0;
    for (size_t i = 0; i < outline->boundary; i++) {
        double square =
            squared(outline->point[i], outline->point[i + 1 == outline->boundary ? 0 : i + 1]);
        longest = square > longest ? square : longest;
    }
    outline->longest = sqrt(longest);
    outline->area = twice_area(outline->point, outline->boundary) / 2;
}

static bool cross_rows(yb_outline_t *outline, double north)
{
    int filled[YB_OUTLINE_ROWS + 1] = {0};
    double scale = YB_OUTLINE_ROWS / north;
    int first = 0;
    int end = 0;
    for (size_t i = 0; i < outline->boundary; i++) {
        rows_of(outline->point[i], outline->point[(i + 1) % outline->boundary], scale, &first,
                &end);
        for (; first < end; first++)
            filled[first + 1]++;
    }
    for (int row = 0; row < YB_OUTLINE_ROWS; row++)
        filled[row + 1] += filled[row];
    outline->first = malloc(sizeof(filled));
    outline->cross = malloc(((size_t)filled[YB_OUTLINE_ROWS] + 1) * sizeof(*outline->cross));
    if (outline->first == NULL || outline->cross == NULL)
        return false;
    memcpy(outline->first, filled, sizeof(filled));
    for (size_t i = 0; i < outline->boundary; i++) {
        yb_point2_t a = outline->point[i];
        yb_point2_t b = outline->point[(i + 1) % outline->boundary];
        rows_of(a, b, scale, &first, &end);
        for (; first < end; first++) {
            double share = ((first + 0.5) / scale - a.y) / (b.y - a.y);
            outline->cross[filled[first]++] = (float)(a.x + (b.x - a.x) * share);
        }
    }
    for (int row = 0; row < YB_OUTLINE_ROWS; row++)
        sort_row(outline->cross + outline->first[row],
                 outline->first[row + 1] - outline->first[row]);
    return true;
}

static void measure_line(yb_outline_t *outline)
{
    outline->at[0] = 0;
    for (size_t i = 0; i < outline->count; i++) {
        bool last = i + 1 == outline->count;
        double step = last && !outline->closed
                          ? 0
                          : sqrt(squared(outline->point[i], outline->point[last ? 0 : i + 1]));
        outline->at[i + 1] = outline->at[i] + step;
    }
    outline->length = outline->at[outline->count];
}

bool yb_outline_make(yb_outline_t *outline, const yb_isoline_t *line, bool turned, double east,
                     double north)
{
    *outline = (yb_outline_t){.count = line->count, .closed = line->closed};
    if (line->closed)
        turned = twice_area(line->point, line->count) < 0;
    size_t room = line->count + (line->closed ? 0 : YB_REGION_FRAME_POINTS);
    outline->point = malloc((room + 1) * sizeof(*outline->point));
    outline->at = malloc((line->count + 1) * sizeof(*outline->at));
    bool good = outline->point != NULL && outline->at != NULL && line->count > 1;
    if (good) {
        for (size_t i = 0; i < line->count; i++)
            outline->point[i] = line->point[turned ? line->count - 1 - i : i];
        outline->boundary = line->count;
        if (!line->closed)
            outline->boundary +=
                yb_region_frame_points(outline->point[line->count - 1], outline->point[0], east,
                                       north, outline->point + line->count);
        measure_boundary(outline);
        measure_line(outline);
        good = outline->area > 0 && outline->length > 0 && cross_rows(outline, north);
    }
    if (!good)
        yb_outline_free(outline);
    return good;
}

void yb_outline_free(yb_outline_t *outline)
{
    free(outline->point);
    free(outline->at);
    free(outline->first);
    free(outline->cross);
    *outline = (yb_outline_t){0};
}

/* Length that two rows have in common; their crossings come in pairs. */
static double common_length(const float *a, int a_count, const float *b, int b_count)
{
    double sum = 0;
    for (int i = 0, k = 0; i + 1 < a_count && k + 1 < b_count;) {
        float from = fmaxf(a[i], b[k]);
        float to = fminf(a[i + 1], b[k + 1]);
        if (to > from)
            sum += (double)(to - from);
        if (a[i + 1] < b[k + 1])
            i += 2;
        else
            k += 2;
    }
    return sum;
}

double yb_outline_overlap(const yb_outline_t *a, const yb_outline_t *b, double north)
{
    double common = 0;
    for (int row = 0; row < YB_OUTLINE_ROWS; row++)
        common += common_length(a->cross + a->first[row], a->first[row + 1] - a->first[row],
                                b->cross + b->first[row], b->first[row + 1] - b->first[row]);
    common *= north / YB_OUTLINE_ROWS;
    return fmin(common / (a->area + b->area - common), 1);
}

/* Squared distance of a place from the segment ab. */
static double squared_from(yb_point2_t place, yb_point2_t a, yb_point2_t b, double *share)
{
    double dx = b.x - a.x;
    double dy = b.y - a.y;
    double square = dx * dx + dy * dy;
    double along = (place.x - a.x) * dx + (place.y - a.y) * dy;
    along = along <= 0 || square <= 0 ? 0 : along >= square ? 1 : along / square;
    *share = along;
    return squared(place, (yb_point2_t){a.x + dx * along, a.y + dy * along});
}

/* Segments to go on by, from one that is `here` away (squared), to the next that can be nearer than
 * `nearest`: each is at most as far off from the one before as it is long.
 */
static size_t stride(const yb_outline_t *outline, double here, double nearest)
{
    if (here <= nearest)
        return 1;
    double skip = (sqrt(here) - sqrt(nearest)) / outline->longest;
    return skip < 1 ? 1 : (size_t)skip;
}

/* Squared distance of the place farthest from the other boundary, or `most` if none is farther. The
 * search for the nearest segment begins before the last one found, and ends as soon as the place
 * cannot be the farthest.
 */
static double squared_farthest(const yb_outline_t *from, const yb_outline_t *to, double most)
{
    enum {
        BACK = 3
    };
    size_t last = 0;
    for (size_t i = 0; i < from->boundary; i++) {
        double nearest = HUGE_VAL;
        size_t first = (last + to->boundary - BACK % to->boundary) % to->boundary;
        for (size_t k = 0; k < to->boundary && nearest > most;) {
            size_t at = first + k < to->boundary ? first + k : first + k - to->boundary;
            double share = 0;
            double here = squared_from(from->point[i], to->point[at],
                                       to->point[at + 1 == to->boundary ? 0 : at + 1], &share);
            if (here < nearest) {
                nearest = here;
                last = at;
            }
            k += stride(to, here, nearest);
        }
        most = nearest > most ? nearest : most;
    }
    return most;
}

double yb_outline_distance(const yb_outline_t *original, const yb_outline_t *reproduced)
{
    double most = squared_farthest(original, reproduced, 0);
    most = squared_farthest(reproduced, original, most);
    double radius = sqrt(original->area / acos(-1.0));
    return 1 - fmin(1, sqrt(most) / radius);
}

/* The point at a distance along the line; past its ends an open one stops, a closed one goes on. */
static yb_point2_t point_at(const yb_outline_t *outline, double at)
{
    if (outline->closed)
        at -= floor(at / outline->length) * outline->length;
    at = fmin(fmax(at, 0), outline->length);
    size_t low = 0;
    size_t high = outline->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (outline->at[middle] <= at)
            low = middle;
        else
            high = middle;
    }
    size_t next = high < outline->count ? high : outline->closed ? 0 : low;
    yb_point2_t a = outline->point[low];
    yb_point2_t b = outline->point[next];
    double step = outline->at[high] - outline->at[low];
    double share = step > 0 ? (at - outline->at[low]) / step : 0;
    return (yb_point2_t){a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

static int turning(const yb_outline_t *outline, double first, double length)
{
    yb_point2_t a = point_at(outline, first);
    yb_point2_t b = point_at(outline, first + length / 2);
    yb_point2_t c = point_at(outline, first + length);
    double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    double least = least_turn * sqrt(squared(a, b) * squared(b, c));
    return (cross > least) - (cross < -least);
}

static double nearest_at(const yb_outline_t *outline, yb_point2_t place)
{
    size_t segments = outline->count - (outline->closed ? 0 : 1);
    double best = HUGE_VAL;
    double nearest = 0;
    for (size_t i = 0; i < segments;) {
        double share = 0;
        double here = squared_from(place, outline->point[i],
                                   outline->point[i + 1 == outline->count ? 0 : i + 1], &share);
        if (here < best) {
            best = here;
            nearest = outline->at[i] + (outline->at[i + 1] - outline->at[i]) * share;
        }
        i += stride(outline, here, best);
    }
    return nearest;
}

static double first_step(const yb_outline_t *outline)
{
    size_t first = 0;
    for (size_t i = 1; outline->closed && i < outline->count; i++) {
        yb_point2_t here = outline->point[i];
        yb_point2_t best = outline->point[first];
        if (here.x > best.x || (here.x == best.x && here.y < best.y))
            first = i;
    }
    return outline->at[first];
}

double yb_outline_curvature(const yb_outline_t *original, const yb_outline_t *reproduced)
{
    double step = original->length / YB_SIMILARITY_STEPS;
    double piece = fmin(step, reproduced->length);
    double start = first_step(original);
    int agree = 0;
    for (int i = 0; i < YB_SIMILARITY_STEPS; i++) {
        double at = start + i * step;
        double nearest = nearest_at(reproduced, point_at(original, at + step / 2));
        double first = nearest - piece / 2;
        if (!reproduced->closed)
            first = fmin(fmax(first, 0), reproduced->length - piece);
        agree += turning(original, at, step) == turning(reproduced, first, piece);
    }
    return (double)agree / YB_SIMILARITY_STEPS;
}
