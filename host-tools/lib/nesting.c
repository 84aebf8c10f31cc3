#include "nesting.h"

#include <math.h>
#include <stdlib.h>

static const double highest_m = 30000;

/* What a line parts from the rest. Places along the frame are counted from its south-western
 * corner, counterclockwise.
 */
typedef struct {
    const yb_line_t *line;
    double low_x, low_y, high_x, high_y;
    double begin, end;                   /* of an open line, along the frame */
    yb_place_t corner[YB_FRAME_CORNERS]; /* of the frame, from its end back to its begin */
    int corners;
    bool holds_land; /* the land outside all lines lies in its inside */
} fence_t;

/* One end of an open line. */
typedef struct {
    double along;
    int fence;
} post_t;

typedef struct {
    const yb_lines_t *lines;
    fence_t *fence;
    int fences;
    double round; /* the frame's length */
} nesting_t;

/* Whether a place of the frame is met on the way from one place counterclockwise to another. */
static bool on_way(double from, double to, double at)
{
    return from <= to ? at > from && at < to : at > from || at < to;
}

static void fence_bound(fence_t *fence)
{
    const yb_line_t *line = fence->line;
    fence->low_x = fence->low_y = HUGE_VAL;
    fence->high_x = fence->high_y = -HUGE_VAL;
    for (int i = 0; i < line->count + fence->corners; i++) {
        yb_place_t at = i < line->count ? line->place[i] : fence->corner[i - line->count];
        fence->low_x = fmin(fence->low_x, at.x_m);
        fence->low_y = fmin(fence->low_y, at.y_m);
        fence->high_x = fmax(fence->high_x, at.x_m);
        fence->high_y = fmax(fence->high_y, at.y_m);
    }
}

static fence_t fence_of(const nesting_t *nesting, const yb_line_t *line)
{
    const yb_lines_t *lines = nesting->lines;
    fence_t fence = {.line = line};
    if (!line->closed) {
        fence.begin = yb_lines_frame_way_m(lines, line->place[0]);
        fence.end = yb_lines_frame_way_m(lines, line->place[line->count - 1]);
        fence.corners = yb_lines_corners_back(lines, line, fence.corner);
    }
    fence_bound(&fence);
    return fence;
}

/* Even-odd rule over the line and the corners of the frame that belong to its inside. */
static bool is_inside(const fence_t *fence, yb_place_t at)
{
    if (at.x_m < fence->low_x || at.x_m > fence->high_x || at.y_m < fence->low_y ||
        at.y_m > fence->high_y)
        return false;
    const yb_line_t *line = fence->line;
    int count = line->count + fence->corners;
    bool inside = false;
    yb_place_t b = fence->corners > 0 ? fence->corner[fence->corners - 1] : line->place[count - 1];
    for (int i = 0; i < count; i++) {
        yb_place_t a = i < line->count ? line->place[i] : fence->corner[i - line->count];
        if ((a.y_m > at.y_m) != (b.y_m > at.y_m) &&
            at.x_m < (b.x_m - a.x_m) * (at.y_m - a.y_m) / (b.y_m - a.y_m) + a.x_m)
            inside = !inside;
        b = a;
    }
    return inside;
}

static int by_along(const void *a, const void *b)
{
    const post_t *first = a;
    const post_t *second = b;
    if (first->along != second->along)
        return first->along < second->along ? -1 : 1;
    return first->fence - second->fence;
}

/* Walks round the frame. Each line entered opens a region, the same line met again leads back to
 * the one before; `land` becomes a place of the region that has most of the frame. False: lines
 * are met in an order that only crossing lines can have.
 */
static bool walk_frame(const nesting_t *nesting, const post_t *post, int posts, int *stack,
                       double *share, double *seen, double *land)
{
    int deep = 0;
    stack[0] = 0; /* region 0 has the south-western corner, region i + 1 is opened by line i */
    for (int i = 0; i <= posts; i++) {
        double from = i == 0 ? 0 : post[i - 1].along;
        double to = i == posts ? nesting->round : post[i].along;
        int region = stack[deep];
        if (share[region] == 0)
            seen[region] = (from + to) / 2;
        share[region] += to - from;
        if (i == posts)
            break;
        int entered = post[i].fence + 1;
        if (region == entered)
            deep--;
        else
            stack[++deep] = entered;
    }
    if (deep > 0)
        return false;
    int best = 0;
    for (int i = 1; i <= nesting->fences; i++)
        if (share[i] > share[best])
            best = i;
    *land = seen[best];
    return true;
}

/* Finds the land outside all lines and on which side of the open lines it lies. */
static bool find_land(nesting_t *nesting, bool *crossed)
{
    size_t count = (size_t)nesting->fences + 1;
    post_t *post = calloc(2 * count, sizeof(*post));
    int *stack = calloc(2 * count, sizeof(*stack)); /* crossing lines open twice */
    double *share = calloc(2 * count, sizeof(*share));
    bool good = post != NULL && stack != NULL && share != NULL;
    int posts = 0;
    for (int i = 0; i < nesting->fences && good; i++) {
        if (nesting->fence[i].line->closed)
            continue;
        post[posts++] = (post_t){nesting->fence[i].begin, i};
        post[posts++] = (post_t){nesting->fence[i].end, i};
    }
    if (posts > 0) {
        double land = 0;
        qsort(post, (size_t)posts, sizeof(*post), by_along);
        *crossed = !walk_frame(nesting, post, posts, stack, share, share + count, &land);
        for (int i = 0; i < nesting->fences; i++) {
            fence_t *fence = &nesting->fence[i];
            fence->holds_land = !fence->line->closed && on_way(fence->end, fence->begin, land);
        }
    }
    free(post);
    free(stack);
    free(share);
    return good;
}

static int lines_crossed(const nesting_t *nesting, const yb_line_t *line)
{
    yb_place_t at = line->place[line->count / 2];
    int crossed = 0;
    for (int i = 0; i < nesting->fences; i++) {
        const fence_t *fence = &nesting->fence[i];
        crossed += fence->line != line && is_inside(fence, at) != fence->holds_land;
    }
    return crossed;
}

bool yb_nesting_heights(yb_lines_t *lines, double base_m, double interval_m, yb_error_t *error)
{
    nesting_t nesting = {.lines = lines, .round = 2 * (lines->width_m + lines->depth_m)};
    bool crossed = false;
    nesting.fence = calloc((size_t)lines->count + 1, sizeof(fence_t));
    if (nesting.fence == NULL)
        return yb_error_set(error, "out of memory");
    for (int i = 0; i < lines->count; i++)
        if (lines->line[i].count > 1)
            nesting.fence[nesting.fences++] = fence_of(&nesting, &lines->line[i]);
    bool good = find_land(&nesting, &crossed);
    if (!good)
        yb_error_set(error, "out of memory");
    else if (crossed)
        good = yb_error_set(error, "two lines that run from side to side cross each other");
    for (int i = 0; i < lines->count && good; i++) {
        yb_line_t *line = &lines->line[i];
        int depth = lines_crossed(&nesting, line);
        line->height_m = base_m + interval_m * (line->count > 1 ? depth : depth - 0.5);
        if (!(fabs(line->height_m) < highest_m))
            good =
                yb_error_set(error, "a line would lie at %g m: no map is so high", line->height_m);
    }
    free(nesting.fence);
    return good;
}
