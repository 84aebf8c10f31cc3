#include "search_moves.h"

#include <math.h>

#include "paper_code.h"
#include "random.h"
#include "set_moves.h"

/* Inner points keep so many steps away from the frame: nearer ones would stand for heights of the
 * frame itself, with a cliff along its side.
 */
enum {
    MARGIN = 8
};

/* Share of the moves that go to a neighbouring place of the lattice, or stay. */
static const double near_share = 0.7;

/* Where there are many points: share of those that are chosen because the surface is wrong there.
 */
static const double wrong_share = 0.6;

typedef bool (*pick_fn)(yb_search_mover_t *mover);
typedef bool (*change_fn)(yb_search_mover_t *mover);

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

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

/* A move in multiples of the lattice's spacing: mostly to a neighbouring place, which is what finds
 * nearly all that is better, else of up to `reach` steps.
 */
static int random_move(yb_search_mover_t *mover, double reach)
{
    int unit = mover->set->spacing;
    if (yb_random_share(&mover->random) < near_share)
        return (yb_random_below(&mover->random, 3) - 1) * unit;
    return (int)lround(yb_random_bell(&mover->random, 2 * reach) / unit) * unit;
}

static double reach_now(const yb_search_mover_t *mover)
{
    return mover->set->spacing * 1.5 + 40 * mover->heat;
}

/* How far heights go, in units: by the relief's own deviation. */
static double height_spread(const yb_search_mover_t *mover)
{
    return mover->search->grid->std_m / yb_unit_m(mover->set->unit) * (0.08 + 0.6 * mover->heat);
}

/* Draws a place, more often where the surface is wrong; in steps. */
static void wrong_place(yb_search_mover_t *mover, double *x, double *y)
{
    const yb_grid_t *grid = mover->search->grid;
    yb_judge_worst(mover->search->judge, yb_random_share(&mover->random), x, y);
    *x = *x / yb_grid_width_m(grid) * mover->set->east;
    *y = *y / yb_grid_depth_m(grid) * mover->set->north;
}

/* The point nearest to a wrong place. */
static int wrong_point(yb_search_mover_t *mover)
{
    const yb_contour_set_t *set = mover->set;
    double x = 0;
    double y = 0;
    wrong_place(mover, &x, &y);
    double least = HUGE_VAL;
    int nearest = 0;
    for (int i = 0; i < set->point_count; i++) {
        double dx = set->point[i].x - x;
        double dy = set->point[i].y - y;
        if (dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            nearest = i;
        }
    }
    return nearest;
}

/* Chooses what a change is for: a point, and its contour. False: there is none. */
static bool pick_point(yb_search_mover_t *mover)
{
    const yb_contour_set_t *set = mover->set;
    if (set->point_count == 0)
        return false;
    mover->point = mover->search->many && yb_random_share(&mover->random) < wrong_share
                       ? wrong_point(mover)
                       : yb_random_below(&mover->random, set->point_count);
    mover->contour = 0;
    mover->first = 0;
    while (mover->point >= mover->first + set->contour[mover->contour].count)
        mover->first += set->contour[mover->contour++].count;
    return true;
}

/* One of all contours, and its first point. */
static bool pick_contour(yb_search_mover_t *mover)
{
    if (mover->set->contour_count == 0)
        return false;
    mover->contour = yb_random_below(&mover->random, mover->set->contour_count);
    mover->first = yb_contour_set_first(mover->set, mover->contour);
    mover->point = mover->first;
    return true;
}

static bool is_frame_end(const yb_search_mover_t *mover)
{
    return yb_contour_set_is_end(mover->set, mover->contour, mover->point - mover->first);
}

/* Slides an end along its side of the frame, not into a corner. */
static bool slide_end(yb_search_mover_t *mover, yb_step_t *at)
{
    int move = random_move(mover, reach_now(mover));
    yb_contour_set_t *set = mover->set;
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

static bool change_point(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    yb_step_t *at = &set->point[mover->point];
    if (is_frame_end(mover))
        return slide_end(mover, at);
    double reach = reach_now(mover);
    int move_x = random_move(mover, reach);
    int move_y = random_move(mover, reach);
    int x = at->x + move_x;
    int y = at->y + move_y;
    if (!is_inner(set, x, y))
        return false;
    at->x = (uint8_t)x;
    at->y = (uint8_t)y;
    return move_x != 0 || move_y != 0;
}

/* Moves a whole closed contour. */
static bool change_place(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (set->contour[mover->contour].open)
        return false;
    int x = random_move(mover, 6 + 10 * mover->heat);
    int y = random_move(mover, 6 + 10 * mover->heat);
    for (int i = mover->first; i < mover->first + set->contour[mover->contour].count; i++) {
        int new_x = set->point[i].x + x;
        int new_y = set->point[i].y + y;
        if (!is_inner(set, new_x, new_y))
            return false;
        set->point[i] = (yb_step_t){(uint8_t)new_x, (uint8_t)new_y};
    }
    return x != 0 || y != 0;
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
static uint16_t line_height(const yb_search_mover_t *mover, double height)
{
    const yb_search_t *task = mover->search;
    int interval = 1 << mover->set->interval;
    return task->levels > 0 ? task->level[nearest_level(task, height)]
                            : (uint16_t)(lround(height / interval) * interval);
}

/* The next level above or below. */
static uint16_t other_level(yb_search_mover_t *mover, uint16_t height)
{
    const yb_search_t *task = mover->search;
    int step = yb_random_below(&mover->random, 2) == 0 ? -1 : 1;
    return task->level[clamp(nearest_level(task, height) + step, 0, task->levels - 1)];
}

static bool change_height(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    uint16_t *height = &set->contour[mover->contour].height;
    uint16_t before = *height;
    bool line = set->contour[mover->contour].count > 1;
    int unit = line ? 1 << set->interval : 1;
    if (line && mover->search->levels > 0)
        *height = other_level(mover, before);
    else
        *height = yb_move_height(&mover->random, before, height_spread(mover) / unit, unit);
    return *height != before;
}

static bool change_corner(yb_search_mover_t *mover)
{
    return yb_move_corner(&mover->random, mover->set, height_spread(mover));
}

static bool toggle_corner(yb_search_mover_t *mover)
{
    yb_move_toggle_corner(&mover->random, mover->set);
    return true;
}

/* A new point near the middle of a segment, off it to one side. */
static bool add_point(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int point = mover->point;
    int count = set->contour[mover->contour].count;
    bool last = point == mover->first + count - 1;
    if (count == 1 || (last && set->contour[mover->contour].open))
        return false;
    yb_step_t a = set->point[point];
    yb_step_t b = set->point[last ? mover->first : point + 1];
    int unit = set->spacing;
    double along = 0.3 + 0.4 * yb_random_share(&mover->random);
    double side = yb_random_bell(&mover->random, 0.6);
    double off_x = along * (b.x - a.x) - side * (b.y - a.y);
    double off_y = along * (b.y - a.y) + side * (b.x - a.x);
    int x = a.x + (int)lround(off_x / unit) * unit;
    int y = a.y + (int)lround(off_y / unit) * unit;
    if (!is_inner(set, x, y))
        return false;
    return yb_contour_set_insert(set, mover->contour, point + 1,
                                 (yb_step_t){(uint8_t)x, (uint8_t)y});
}

static bool remove_point(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (is_frame_end(mover))
        return false;
    if (set->contour[mover->contour].count <= 3 && !set->contour[mover->contour].open)
        return false;
    yb_contour_set_remove(set, mover->contour, mover->point);
    return true;
}

static bool transfer_point(yb_search_mover_t *mover)
{
    return remove_point(mover) && pick_point(mover) && add_point(mover);
}

static bool remove_contour(yb_search_mover_t *mover)
{
    yb_contour_set_drop(mover->set, mover->contour);
    return true;
}

/* Somewhere, more often where the surface is wrong; strictly inside the frame. */
static yb_step_t wanted_place(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    double wrong_x = 0;
    double wrong_y = 0;
    wrong_place(mover, &wrong_x, &wrong_y);
    int x = (int)lround(wrong_x + yb_random_bell(&mover->random, 8));
    int y = (int)lround(wrong_y + yb_random_bell(&mover->random, 8));
    int margin_x = margin_of(set->east);
    int margin_y = margin_of(set->north);
    int unit = set->spacing;
    x = clamp(x, margin_x, set->east - margin_x) / unit * unit;
    y = clamp(y, margin_y, set->north - margin_y) / unit * unit;
    return (yb_step_t){(uint8_t)(x < unit ? unit : x), (uint8_t)(y < unit ? unit : y)};
}

static uint16_t true_height(const yb_search_mover_t *mover, double x, double y)
{
    const yb_grid_t *grid = mover->search->grid;
    const yb_contour_set_t *set = mover->set;
    return yb_contour_set_height(set, yb_grid_height(grid, x / set->east * yb_grid_width_m(grid),
                                                     y / set->north * yb_grid_depth_m(grid)));
}

static bool add_spot(yb_search_mover_t *mover)
{
    yb_step_t at = wanted_place(mover);
    return yb_contour_set_append(mover->set, true_height(mover, at.x, at.y), false, &at, 1);
}

static bool transfer_spot(yb_search_mover_t *mover)
{
    return remove_contour(mover) && add_spot(mover);
}

/* A ring of three or four points at one height. */
static bool add_ring(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    yb_step_t middle = wanted_place(mover);
    int unit = set->spacing;
    int count = 3 + yb_random_below(&mover->random, 2);
    double radius = 8 + 50 * yb_random_share(&mover->random);
    double turn = 6.2831853 * yb_random_share(&mover->random);
    yb_step_t point[4];
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double angle = turn + 6.2831853 * i / count;
        int x = middle.x + (int)lround(radius * cos(angle) / unit) * unit;
        int y = middle.y + (int)lround(radius * sin(angle) / unit) * unit;
        if (!is_inner(set, x, y))
            return false;
        point[i] = (yb_step_t){(uint8_t)x, (uint8_t)y};
        sum += true_height(mover, x, y);
    }
    return yb_contour_set_append(set, line_height(mover, sum / count), false, point, count);
}

/* A place on one of the four sides, whose coordinates are multiples of the lattice's difference. */
static yb_step_t frame_place(yb_search_mover_t *mover, int side)
{
    yb_contour_set_t *set = mover->set;
    int unit = set->spacing;
    int along = side % 2 == 0 ? set->east : set->north;
    int at = (1 + yb_random_below(&mover->random, (along - 1) / unit - 1)) * unit;
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
static bool add_crossing(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int side = yb_random_below(&mover->random, 4);
    int other = (side + 1 + yb_random_below(&mover->random, 3)) % 4;
    yb_step_t point[2];
    point[0] = frame_place(mover, side);
    point[1] = frame_place(mover, other);
    double x = (point[0].x + point[1].x) / 2.0;
    double y = (point[0].y + point[1].y) / 2.0;
    double sum = true_height(mover, x, y);
    for (int i = 0; i < 2; i++)
        sum += true_height(mover, point[i].x, point[i].y);
    return yb_contour_set_append(set, line_height(mover, sum / 3), true, point, 2) &&
           yb_paper_split(set);
}

static bool transfer_ring(yb_search_mover_t *mover)
{
    return remove_contour(mover) && add_ring(mover);
}

static bool transfer_crossing(yb_search_mover_t *mover)
{
    return remove_contour(mover) && add_crossing(mover);
}

/* A line of three points that cuts a piece off one side: it says how high the frame is there. */
static bool add_bay(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int side = yb_random_below(&mover->random, 4);
    int unit = set->spacing;
    yb_step_t middle = frame_place(mover, side);
    int half = (1 + yb_random_below(&mover->random, 4)) * unit;
    int deep = (2 + yb_random_below(&mover->random, 3)) * unit;
    int aside = (yb_random_below(&mover->random, 3) - 1) * unit;
    bool level = side % 2 == 0;
    int at = level ? middle.x : middle.y;
    if (at - half <= 0 || at + half >= (level ? set->east : set->north))
        return false;
    int inward = side == 0 || side == 3 ? deep : -deep;
    int x = middle.x + (level ? aside : inward);
    int y = middle.y + (level ? inward : aside);
    if (!is_inner(set, x, y))
        return false;
    int along_x = level ? half : 0;
    int along_y = level ? 0 : half;
    const yb_step_t point[3] = {{(uint8_t)(middle.x - along_x), (uint8_t)(middle.y - along_y)},
                                {(uint8_t)x, (uint8_t)y},
                                {(uint8_t)(middle.x + along_x), (uint8_t)(middle.y + along_y)}};
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += true_height(mover, point[i].x, point[i].y);
    return yb_contour_set_append(set, line_height(mover, sum / 3), true, point, 3) &&
           yb_paper_split(set);
}

static bool transfer_bay(yb_search_mover_t *mover)
{
    return remove_contour(mover) && add_bay(mover);
}

/* A line's point becomes a spot height of its own. */
static bool detach_point(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int count = set->contour[mover->contour].count;
    if (count < 3 || (count == 3 && !set->contour[mover->contour].open) || is_frame_end(mover))
        return false;
    yb_step_t at = set->point[mover->point];
    yb_contour_set_remove(set, mover->contour, mover->point);
    return yb_contour_set_append(set, true_height(mover, at.x, at.y), false, &at, 1);
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
static bool attach_spot(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (set->contour[mover->contour].count != 1)
        return false;
    yb_step_t at = set->point[mover->point];
    yb_contour_set_drop(set, mover->contour);
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

static bool turn_line(yb_search_mover_t *mover)
{
    if (mover->set->contour[mover->contour].count < 2)
        return false;
    yb_move_turn(&mover->random, mover->set, mover->contour);
    return true;
}

/* Another place in the order of the lines. */
static bool reorder(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (set->contour_count <= 1)
        return false;
    int contour = yb_random_below(&mover->random, set->contour_count);
    int to = yb_random_below(&mover->random, set->contour_count);
    return yb_contour_set_reorder(set, contour, to);
}

/* Another unit of height: all heights are rounded to it. */
static bool change_unit(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (set->profile != YB_COMPACT || mover->search->levels > 0)
        return false;
    return yb_contour_set_rescale(
        set, yb_compact_unit(yb_unit_m(set->unit) * exp2(yb_random_bell(&mover->random, 0.7))));
}

/* Lifts or lowers all of it. */
static bool change_base(yb_search_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    if (set->profile != YB_COMPACT || mover->search->levels > 0)
        return false;
    set->base += yb_random_below(&mover->random, 2) == 0 ? -1 : 1;
    return true;
}

/* Two changes in one. */
static bool change_twice(yb_search_mover_t *mover)
{
    bool first = change_point(mover);
    bool second = pick_point(mover) && change_point(mover);
    return first || second;
}

/* A spot height where the surface is wrong, a point of a line, or a bay. */
static bool grow(yb_search_mover_t *mover)
{
    double kind = yb_random_share(&mover->random);
    if (kind < 0.6)
        return add_spot(mover);
    if (mover->search->many && kind > 0.8)
        return add_bay(mover);
    return pick_point(mover) && add_point(mover);
}

bool yb_search_move_locally(yb_search_mover_t *mover, yb_local_move_t kind)
{
    switch (kind) {
    case YB_MOVE_POINT:
        return pick_point(mover) && change_point(mover);
    case YB_MOVE_HEIGHT:
        return pick_point(mover) && change_height(mover);
    case YB_MOVE_INSERT:
        return pick_point(mover) && add_point(mover);
    case YB_MOVE_REMOVE:
        return pick_point(mover) && mover->set->contour[mover->contour].count > 1 &&
               remove_point(mover);
    default:
        return add_spot(mover);
    }
}

bool yb_search_move(yb_search_mover_t *mover)
{
    static const struct {
        int weight;   /* of 224, of 216 without bays */
        pick_fn pick; /* what it is for; NULL: that is its own choice */
        change_fn change;
    } moves[] = {{70, pick_point, change_point},
                 {8, pick_point, change_twice},
                 {10, pick_contour, change_place},
                 {32, pick_contour, change_height},
                 {10, NULL, change_corner},
                 {2, NULL, toggle_corner},
                 {16, pick_point, add_point},
                 {8, pick_point, remove_point},
                 {8, pick_point, transfer_point},
                 {7, pick_contour, remove_contour},
                 {8, NULL, add_spot},
                 {10, pick_contour, transfer_spot},
                 {5, pick_point, detach_point},
                 {8, pick_contour, attach_spot},
                 {1, NULL, add_ring},
                 {1, pick_contour, transfer_ring},
                 {1, NULL, add_crossing},
                 {1, pick_contour, transfer_crossing},
                 {4, pick_contour, turn_line},
                 {2, NULL, reorder},
                 {3, NULL, change_unit},
                 {1, NULL, change_base},
                 {4, NULL, add_bay},
                 {4, pick_contour, transfer_bay}};
    if (mover->grows && yb_random_share(&mover->random) < 0.5)
        return grow(mover);
    int ticket = yb_random_below(&mover->random, mover->search->many ? 224 : 216);
    int i = 0;
    while (ticket >= moves[i].weight)
        ticket -= moves[i++].weight;
    return (moves[i].pick == NULL || moves[i].pick(mover)) && moves[i].change(mover);
}
