#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contour_code.h"
#include "paper_code.h"

/* Inner points keep so many steps away from the frame: nearer ones would stand for heights of the
 * frame itself, with a cliff along its side.
 */
enum {
    MARGIN = 8,
    REPORTED = 512 /* trials */
};

/* Share of the moves that go to a neighbouring place of the lattice, or stay. */
static const double near_share = 0.7;
/* By what share a bit makes a code worse: within the budget, and beyond it. */
static const double bit_cost = 1e-4;
static const double bit_fine = 2e-3;

/* Where the search stands. */
typedef struct {
    const yb_search_t *task;
    uint64_t random;
    double heat; /* 1 at the start, 0 at the end: how far changes go */
    yb_contour_set_t now, next, best;
} state_t;

typedef bool (*change_fn)(state_t *state);

/* splitmix64 */
static uint64_t random_bits(state_t *state)
{
    state->random += 0x9e3779b97f4a7c15U;
    uint64_t z = state->random;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
    z = (z ^ z >> 27) * 0x94d049bb133111ebU;
    return z ^ z >> 31;
}

/* 0 to 1 */
static double random_share(state_t *state)
{
    return (double)(random_bits(state) >> 11) * 0x1p-53;
}

/* 0 to count - 1 */
static int random_below(state_t *state, int count)
{
    return (int)(random_share(state) * count);
}

/* Symmetric round 0, more often small than large; mostly within ±size. */
static double random_bell(state_t *state, double size)
{
    double sum = random_share(state) + random_share(state) + random_share(state) - 1.5;
    return sum * size;
}

/* On small frames a point may lie anywhere inside. */
static int margin_of(int size)
{
    return size > 4 * MARGIN ? MARGIN : 1;
}

/* Whether an inner point may lie there. */
static bool is_inner(const yb_contour_set_t *set, int x, int y)
{
    int margin_x = margin_of(set->east);
    int margin_y = margin_of(set->north);
    return x >= margin_x && y >= margin_y && x <= set->east - margin_x &&
           y <= set->north - margin_y;
}

static int contour_of(const yb_contour_set_t *set, int point)
{
    int contour = 0;
    while (point >= set->contour[contour].count)
        point -= set->contour[contour++].count;
    return contour;
}

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* A move in multiples of the lattice's spacing: mostly to a neighbouring place, which is what finds
 * nearly all that is better, else of up to `reach` steps.
 */
static int random_move(state_t *state, double reach)
{
    int unit = state->next.spacing;
    if (random_share(state) < near_share)
        return (random_below(state, 3) - 1) * unit;
    return (int)lround(random_bell(state, 2 * reach) / unit) * unit;
}

static double reach_now(const state_t *state)
{
    return state->next.spacing * 1.5 + 40 * state->heat;
}

static bool is_frame_end(const yb_contour_set_t *set, int contour, int first, int point)
{
    return set->contour[contour].open &&
           (point == first || point == first + set->contour[contour].count - 1);
}

/* Slides an end along its side of the frame, not into a corner. */
static bool slide_end(state_t *state, yb_step_t *at)
{
    int move = random_move(state, reach_now(state));
    yb_contour_set_t *set = &state->next;
    if (at->x == 0 || at->x == set->east) {
        int y = at->y + move;
        if (y <= 0 || y >= set->north)
            return false;
        at->y = (uint8_t)y;
    } else {
        int x = at->x + move;
        if (x <= 0 || x >= set->east)
            return false;
        at->x = (uint8_t)x;
    }
    return move != 0;
}

/* One of all points, its contour, and that one's first point. False: there is none. */
static bool random_point(state_t *state, int *point, int *contour, int *first)
{
    if (state->next.point_count == 0)
        return false;
    *point = random_below(state, state->next.point_count);
    *contour = contour_of(&state->next, *point);
    *first = yb_contour_set_first(&state->next, *contour);
    return true;
}

static bool change_point(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int point = 0;
    int contour = 0;
    int first = 0;
    if (!random_point(state, &point, &contour, &first))
        return false;
    yb_step_t *at = &set->point[point];
    if (is_frame_end(set, contour, first, point))
        return slide_end(state, at);
    double reach = reach_now(state);
    int move_x = random_move(state, reach);
    int move_y = random_move(state, reach);
    int x = at->x + move_x;
    int y = at->y + move_y;
    if (!is_inner(set, x, y))
        return false;
    at->x = (uint8_t)x;
    at->y = (uint8_t)y;
    return move_x != 0 || move_y != 0;
}

/* Moves a whole closed contour. */
static bool change_place(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int contours = set->contour_count;
    if (contours <= 0)
        return false;
    int contour = random_below(state, contours);
    if (set->contour[contour].open)
        return false;
    int x = random_move(state, 6 + 10 * state->heat);
    int y = random_move(state, 6 + 10 * state->heat);
    int first = yb_contour_set_first(set, contour);
    for (int i = first; i < first + set->contour[contour].count; i++) {
        int new_x = set->point[i].x + x;
        int new_y = set->point[i].y + y;
        if (!is_inner(set, new_x, new_y))
            return false;
        set->point[i] = (yb_step_t){(uint8_t)new_x, (uint8_t)new_y};
    }
    return x != 0 || y != 0;
}

/* By a multiple of `unit` that is not 0. */
static uint16_t moved_height(state_t *state, uint16_t height, int unit)
{
    double std = state->task->grid->std_m / yb_unit_m(state->next.unit) / unit;
    int move = (int)lround(random_bell(state, std * (0.08 + 0.6 * state->heat)));
    if (move == 0)
        move = random_below(state, 2) == 0 ? -1 : 1;
    return (uint16_t)clamp(height + move * unit, 0, UINT16_MAX);
}

/* Index of the given level nearest to a height. */
static int nearest_level(const yb_search_t *task, double height)
{
    int best = 0;
    for (int i = 1; i < task->levels; i++)
        if (fabs(task->level[i] - height) < fabs(task->level[best] - height))
            best = i;
    return best;
}

/* The height of a new line that should lie at `height`. */
static uint16_t line_height(const state_t *state, double height)
{
    const yb_search_t *task = state->task;
    int interval = 1 << state->next.interval;
    return task->levels > 0 ? task->level[nearest_level(task, height)]
                            : (uint16_t)(lround(height / interval) * interval);
}

/* The next level above or below. */
static uint16_t other_level(state_t *state, uint16_t height)
{
    const yb_search_t *task = state->task;
    int step = random_below(state, 2) == 0 ? -1 : 1;
    return task->level[clamp(nearest_level(task, height) + step, 0, task->levels - 1)];
}

static bool change_height(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int contours = set->contour_count;
    if (contours <= 0)
        return false;
    int contour = random_below(state, contours);
    uint16_t *height = &set->contour[contour].height;
    uint16_t before = *height;
    if (set->contour[contour].count > 1 && state->task->levels > 0)
        *height = other_level(state, before);
    else
        *height =
            moved_height(state, before, set->contour[contour].count > 1 ? 1 << set->interval : 1);
    return *height != before;
}

static bool change_corner(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int corner = random_below(state, YB_CORNERS);
    if (set->corners == 0)
        set->frame = moved_height(state, set->frame, 1);
    else if ((set->corners >> corner & 1) != 0)
        set->corner[corner] = moved_height(state, set->corner[corner], 1);
    else
        return false;
    return true;
}

/* Codes a corner's height, or no longer. */
static bool toggle_corner(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    set->corners = (uint8_t)(set->corners ^ 1U << random_below(state, YB_CORNERS));
    return true;
}

/* A new point near the middle of a segment, off it to one side. */
static bool add_point(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int point = 0;
    int contour = 0;
    int first = 0;
    if (!random_point(state, &point, &contour, &first))
        return false;
    int count = set->contour[contour].count;
    bool last = point == first + count - 1;
    if (count == 1 || (last && set->contour[contour].open))
        return false;
    yb_step_t a = set->point[point];
    yb_step_t b = set->point[last ? first : point + 1];
    int unit = set->spacing;
    double along = 0.3 + 0.4 * random_share(state);
    double side = random_bell(state, 0.6);
    double off_x = along * (b.x - a.x) - side * (b.y - a.y);
    double off_y = along * (b.y - a.y) + side * (b.x - a.x);
    int x = a.x + (int)lround(off_x / unit) * unit;
    int y = a.y + (int)lround(off_y / unit) * unit;
    if (!is_inner(set, x, y))
        return false;
    return yb_contour_set_insert(set, contour, point + 1, (yb_step_t){(uint8_t)x, (uint8_t)y});
}

static bool remove_point(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int point = 0;
    int contour = 0;
    int first = 0;
    if (!random_point(state, &point, &contour, &first))
        return false;
    if (is_frame_end(set, contour, first, point))
        return false;
    if (set->contour[contour].count <= 3 && !set->contour[contour].open)
        return false;
    yb_contour_set_remove(set, contour, point);
    return true;
}

static bool transfer_point(state_t *state)
{
    return remove_point(state) && add_point(state);
}

static bool remove_contour(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int contours = set->contour_count;
    if (contours <= 0)
        return false;
    yb_contour_set_drop(set, random_below(state, contours));
    return true;
}

/* Somewhere, more often where the surface is wrong; strictly inside the frame. */
static yb_step_t wanted_place(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    double east_m = 0;
    double north_m = 0;
    yb_judge_worst(state->task->judge, random_share(state), &east_m, &north_m);
    double width = yb_grid_width_m(state->task->grid);
    double depth = yb_grid_depth_m(state->task->grid);
    int x = (int)lround(east_m / width * set->east + random_bell(state, 8));
    int y = (int)lround(north_m / depth * set->north + random_bell(state, 8));
    int margin_x = margin_of(set->east);
    int margin_y = margin_of(set->north);
    int unit = set->spacing;
    x = clamp(x, margin_x, set->east - margin_x) / unit * unit;
    y = clamp(y, margin_y, set->north - margin_y) / unit * unit;
    return (yb_step_t){(uint8_t)(x < unit ? unit : x), (uint8_t)(y < unit ? unit : y)};
}

static uint16_t true_height(const state_t *state, double x, double y)
{
    const yb_grid_t *grid = state->task->grid;
    const yb_contour_set_t *set = &state->next;
    return yb_contour_set_height(set, yb_grid_height(grid, x / set->east * yb_grid_width_m(grid),
                                                     y / set->north * yb_grid_depth_m(grid)));
}

static bool add_spot(state_t *state)
{
    yb_step_t at = wanted_place(state);
    return yb_contour_set_append(&state->next, true_height(state, at.x, at.y), false, &at, 1);
}

static bool transfer_spot(state_t *state)
{
    return remove_contour(state) && add_spot(state);
}

/* A ring of three or four points at one height. */
static bool add_ring(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    yb_step_t middle = wanted_place(state);
    int unit = set->spacing;
    int count = 3 + random_below(state, 2);
    double radius = 8 + 50 * random_share(state);
    double turn = 6.2831853 * random_share(state);
    yb_step_t point[4];
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double angle = turn + 6.2831853 * i / count;
        int x = middle.x + (int)lround(radius * cos(angle) / unit) * unit;
        int y = middle.y + (int)lround(radius * sin(angle) / unit) * unit;
        if (!is_inner(set, x, y))
            return false;
        point[i] = (yb_step_t){(uint8_t)x, (uint8_t)y};
        sum += true_height(state, x, y);
    }
    return yb_contour_set_append(set, line_height(state, sum / count), false, point, count);
}

/* A place on one of the four sides, whose coordinates are multiples of the lattice's difference. */
static yb_step_t frame_place(state_t *state, int side)
{
    yb_contour_set_t *set = &state->next;
    int unit = set->spacing;
    int along = side % 2 == 0 ? set->east : set->north;
    int at = (1 + random_below(state, (along - 1) / unit - 1)) * unit;
    switch (side) {
    case 0:
        return (yb_step_t){(uint8_t)at, 0};
    case 1:
        return (yb_step_t){set->east, (uint8_t)at};
    case 2:
        return (yb_step_t){(uint8_t)at, set->north};
    default:
        return (yb_step_t){0, (uint8_t)at};
    }
}

/* A straight line from one side to another. */
static bool add_crossing(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int side = random_below(state, 4);
    int other = (side + 1 + random_below(state, 3)) % 4;
    yb_step_t point[2] = {frame_place(state, side), frame_place(state, other)};
    double x = (point[0].x + point[1].x) / 2.0;
    double y = (point[0].y + point[1].y) / 2.0;
    double sum = true_height(state, x, y);
    for (int i = 0; i < 2; i++)
        sum += true_height(state, point[i].x, point[i].y);
    return yb_contour_set_append(set, line_height(state, sum / 3), true, point, 2) &&
           yb_paper_split(set);
}

static bool transfer_ring(state_t *state)
{
    return remove_contour(state) && add_ring(state);
}

static bool transfer_crossing(state_t *state)
{
    return remove_contour(state) && add_crossing(state);
}

/* A line's point becomes a spot height of its own. */
static bool detach_point(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int point = 0;
    int contour = 0;
    int first = 0;
    if (!random_point(state, &point, &contour, &first))
        return false;
    int count = set->contour[contour].count;
    if (count < 3 || (count == 3 && !set->contour[contour].open) ||
        is_frame_end(set, contour, first, point))
        return false;
    yb_step_t at = set->point[point];
    yb_contour_set_remove(set, contour, point);
    return yb_contour_set_append(set, true_height(state, at.x, at.y), false, &at, 1);
}

/* Square of the distance from p to the segment ab. */
static double distance_to(yb_step_t p, yb_step_t a, yb_step_t b)
{
    double x = b.x - a.x;
    double y = b.y - a.y;
    double along = ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y);
    along = fmin(fmax(along, 0), 1);
    double off_x = a.x + along * x - p.x;
    double off_y = a.y + along * y - p.y;
    return off_x * off_x + off_y * off_y;
}

/* A spot height becomes a point of the line nearest to it. */
static bool attach_spot(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    if (set->contour_count == 0)
        return false;
    int spot = random_below(state, set->contour_count);
    if (set->contour[spot].count != 1)
        return false;
    yb_step_t at = set->point[yb_contour_set_first(set, spot)];
    yb_contour_set_drop(set, spot);
    double nearest = HUGE_VAL;
    int line = -1;
    int before = 0;
    for (int i = 0, first = 0; i < set->contour_count; first += set->contour[i++].count) {
        int count = set->contour[i].count;
        int segments = count == 1 ? 0 : set->contour[i].open ? count - 1 : count;
        for (int k = 0; k < segments; k++) {
            double away =
                distance_to(at, set->point[first + k], set->point[first + (k + 1) % count]);
            if (away < nearest) {
                nearest = away;
                line = i;
                before = first + k + 1;
            }
        }
    }
    return line >= 0 && yb_contour_set_insert(set, line, before, at);
}

/* Another start or direction for a closed line, another direction for an open one: the surface
 * stays, the size does not.
 */
static bool turn_line(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int contours = set->contour_count;
    if (contours <= 0)
        return false;
    int contour = random_below(state, contours);
    int count = set->contour[contour].count;
    if (count < 2)
        return false;
    yb_step_t *point = &set->point[yb_contour_set_first(set, contour)];
    yb_step_t before[YB_SET_POINTS];
    memcpy(before, point, (size_t)count * sizeof(*point));
    bool open = set->contour[contour].open;
    int from = open ? count - 1 : random_below(state, count);
    bool back = open || random_below(state, 3) == 0;
    for (int i = 0; i < count; i++)
        point[i] = before[(from + (back ? count - i : i)) % count];
    return true;
}

/* Another place in the order of the lines. */
static bool reorder(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    int contours = set->contour_count;
    if (contours <= 1)
        return false;
    int contour = random_below(state, contours);
    int to = random_below(state, contours);
    return yb_contour_set_reorder(set, contour, to);
}

/* Another unit of height: all heights are rounded to it. */
static bool change_unit(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    if (set->profile != YB_COMPACT || state->task->levels > 0)
        return false;
    return yb_contour_set_rescale(
        set, yb_compact_unit(yb_unit_m(set->unit) * exp2(random_bell(state, 0.7))));
}

/* Lifts or lowers all of it. */
static bool change_base(state_t *state)
{
    yb_contour_set_t *set = &state->next;
    if (set->profile != YB_COMPACT || state->task->levels > 0)
        return false;
    set->base += random_below(state, 2) == 0 ? -1 : 1;
    return true;
}

/* Two changes in one. */
static bool change_twice(state_t *state)
{
    bool first = change_point(state);
    bool second = change_point(state);
    return first || second;
}

static bool choose_change(state_t *state)
{
    static const struct {
        int weight; /* of 216 */
        change_fn fn;
    } changes[] = {
        {70, change_point},  {8, change_twice},      {10, change_place}, {32, change_height},
        {10, change_corner}, {2, toggle_corner},     {16, add_point},    {8, remove_point},
        {8, transfer_point}, {7, remove_contour},    {8, add_spot},      {10, transfer_spot},
        {5, detach_point},   {8, attach_spot},       {1, add_ring},      {1, transfer_ring},
        {1, add_crossing},   {1, transfer_crossing}, {4, turn_line},     {2, reorder},
        {3, change_unit},    {1, change_base}};
    int ticket = random_below(state, 216);
    int i = 0;
    while (ticket >= changes[i].weight)
        ticket -= changes[i++].weight;
    return changes[i].fn(state);
}

/* What a code costs: how far it is from the truth, and so much for each bit. Codes that are a
 * little too long are let by, for a fine: the way to a better one may lead over them.
 */
static double cost_of(state_t *state, const yb_contour_set_t *set, bool *fits)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    yb_bits_t bits = {0};
    size_t most = state->task->most_bytes;
    size_t size = yb_contour_code_write(set, code, most + most / 8, &bits);
    if (size == 0)
        return -1;
    *fits = size <= most;
    double score = yb_judge_score_m(state->task->judge, code, size);
    double over = fmax(bits.all - 8.0 * (double)most, 0);
    return score < 0 ? -1 : score * exp(bit_cost * bits.all + bit_fine * over);
}

static void report(yb_progress_t *progress, double share)
{
    pthread_mutex_lock(progress->lock);
    progress->begun += share * progress->part;
    if (progress->report != NULL)
        progress->report(progress->context, fmin(progress->begun, 1));
    pthread_mutex_unlock(progress->lock);
}

double yb_search_run(const yb_search_t *search, yb_contour_set_t *set)
{
    state_t *state = calloc(1, sizeof(*state));
    if (state == NULL)
        return -1;
    state->task = search;
    state->random = search->seed;
    state->now = *set;
    state->best = *set;
    bool fits = false;
    double now = cost_of(state, set, &fits);
    double best = now;
    for (long trial = 0; trial < search->trials && best >= 0; trial++) {
        double done = (double)trial / (double)search->trials;
        double heat = search->hot * pow(search->cold / search->hot, done);
        state->heat = (1 - done) * (1 - done);
        if (search->progress != NULL && trial % REPORTED == 0)
            report(search->progress, (double)REPORTED / (double)search->trials);
        do
            state->next = state->now;
        while (!choose_change(state));
        double next = cost_of(state, &state->next, &fits);
        if (next < 0)
            continue;
        double worse = log(next / now) / heat;
        if (worse > 0 && random_share(state) >= exp(-worse))
            continue;
        state->now = state->next;
        now = next;
        if (now < best && fits) {
            best = now;
            state->best = state->now;
        }
    }
    *set = state->best;
    free(state);
    return best;
}
