#include "target_moves.h"

#include <math.h>

#include "random.h"
#include "set_moves.h"
#include "target_shapes.h"

typedef bool (*move_fn)(yb_target_mover_t *mover);

bool yb_target_is_inner(const yb_contour_set_t *set, int x, int y)
{
    int margin = set->spacing;
    return x >= margin && y >= margin && x <= set->east - margin && y <= set->north - margin;
}

/* A line (with `spot` a spot height, but not the summit) at random; -1: there is none. */
static int any_contour(yb_target_mover_t *mover, bool spot)
{
    const yb_contour_set_t *set = mover->set;
    int found = 0;
    for (int i = 1; i < set->contour_count; i++)
        found += (set->contour[i].count == 1) == spot;
    int left = found > 0 ? yb_random_below(&mover->random, found) : 0;
    for (int i = 1; i < set->contour_count; i++)
        if ((set->contour[i].count == 1) == spot && left-- == 0)
            return i;
    return -1;
}

static bool pick_line(yb_target_mover_t *mover)
{
    mover->contour = any_contour(mover, false);
    return mover->contour >= 0;
}

static bool pick_spot(yb_target_mover_t *mover)
{
    mover->contour = any_contour(mover, true);
    return mover->contour >= 0;
}

int yb_target_step(yb_target_mover_t *mover)
{
    int spacing = mover->set->spacing;
    double reach = spacing * 1.2 + 20 * mover->heat;
    return (int)lround(yb_random_bell(&mover->random, reach) / spacing) * spacing;
}

bool yb_target_shift(yb_target_mover_t *mover, int line, int at, int x, int y)
{
    yb_contour_set_t *set = mover->set;
    yb_step_t *point = &set->point[yb_contour_set_first(set, line) + at];
    if (yb_contour_set_is_end(set, line, at)) {
        bool upright = point->x == 0 || point->x == set->east;
        x = upright ? 0 : x;
        y = upright ? y : 0;
        int along = upright ? point->y + y : point->x + x;
        if (along <= 0 || along >= (upright ? set->north : set->east))
            return false;
    } else if (!yb_target_is_inner(set, point->x + x, point->y + y)) {
        return false;
    }
    point->x = (uint8_t)(point->x + x);
    point->y = (uint8_t)(point->y + y);
    return x != 0 || y != 0;
}

static bool move_point(yb_target_mover_t *mover)
{
    int line = mover->contour;
    int at = yb_random_below(&mover->random, mover->set->contour[line].count);
    int x = yb_target_step(mover);
    int y = yb_target_step(mover);
    return yb_target_shift(mover, line, at, x, y);
}

/* Two neighbours the same way, so that their segment keeps its direction. */
static bool move_segment(yb_target_mover_t *mover)
{
    int line = mover->contour;
    int count = mover->set->contour[line].count;
    int at = yb_random_below(&mover->random, count);
    int x = yb_target_step(mover);
    int y = yb_target_step(mover);
    return yb_target_shift(mover, line, at, x, y) &&
           yb_target_shift(mover, line, (at + 1) % count, x, y);
}

/* Two points of one line, each its own way. */
static bool move_two(yb_target_mover_t *mover)
{
    bool first = move_point(mover);
    bool second = pick_line(mover) && move_point(mover);
    return first || second;
}

static bool add_point(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = mover->contour;
    if (set->contour[line].count >= 200)
        return false;
    int count = set->contour[line].count;
    int at = yb_random_below(&mover->random, set->contour[line].open ? count - 1 : count);
    int first = yb_contour_set_first(set, line);
    yb_step_t a = set->point[first + at];
    yb_step_t b = set->point[first + (at + 1) % count];
    int spacing = set->spacing;
    double along = 0.25 + 0.5 * yb_random_share(&mover->random);
    double side = yb_random_bell(&mover->random, 0.5);
    int x = (int)lround((a.x + along * (b.x - a.x) - side * (b.y - a.y)) / spacing) * spacing;
    int y = (int)lround((a.y + along * (b.y - a.y) + side * (b.x - a.x)) / spacing) * spacing;
    return yb_target_is_inner(set, x, y) &&
           yb_contour_set_insert(set, line, first + at + 1, (yb_step_t){(uint8_t)x, (uint8_t)y});
}

static bool remove_point(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = mover->contour;
    int at = yb_random_below(&mover->random, set->contour[line].count);
    if (yb_contour_set_is_end(set, line, at) ||
        (!set->contour[line].open && set->contour[line].count <= 4))
        return false;
    yb_contour_set_remove(set, line, yb_contour_set_first(set, line) + at);
    return true;
}

static bool transfer_point(yb_target_mover_t *mover)
{
    return remove_point(mover) && pick_line(mover) && add_point(mover);
}

uint16_t yb_target_allowed(const yb_target_mover_t *mover, double height_m)
{
    const yb_target_search_t *search = mover->search;
    for (int i = 1; i < search->levels; i++)
        if (i + 1 == search->levels ||
            height_m < (search->level_m[i - 1] + search->level_m[i]) / 2) {
            int nearest = height_m < (search->level_m[i - 1] + search->level_m[i]) / 2 ? i - 1 : i;
            return yb_contour_set_line_height(mover->set, search->level_m[nearest]);
        }
    return yb_contour_set_line_height(mover->set,
                                      search->levels == 1 ? search->level_m[0] : height_m);
}

static bool change_height(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = mover->contour;
    uint16_t *height = &set->contour[line].height;
    uint16_t before = *height;
    double unit_m = yb_unit_m(set->unit) * (1 << set->interval);
    double move_m =
        yb_random_bell(&mover->random, mover->search->grid->std_m * (0.15 + 0.4 * mover->heat));
    if (mover->search->levels == 0 && fabs(move_m) < unit_m)
        move_m = move_m < 0 ? -unit_m : unit_m;
    *height = yb_target_allowed(mover, yb_contour_set_height_m(set, before) + move_m);
    return *height != before;
}

double yb_target_spread(const yb_target_mover_t *mover)
{
    return mover->search->grid->std_m / yb_unit_m(mover->set->unit) * (0.1 + 0.4 * mover->heat);
}

static bool change_frame(yb_target_mover_t *mover)
{
    return yb_move_corner(&mover->random, mover->set, yb_target_spread(mover));
}

static bool toggle_corner(yb_target_mover_t *mover)
{
    yb_move_toggle_corner(&mover->random, mover->set);
    return true;
}

static bool turn_line(yb_target_mover_t *mover)
{
    yb_move_turn(&mover->random, mover->set, mover->contour);
    return true;
}

static bool reorder(yb_target_mover_t *mover)
{
    int line = any_contour(mover, false);
    int other = any_contour(mover, false);
    return line > 0 && other > 0 && yb_contour_set_reorder(mover->set, line, other);
}

static bool change_seed(yb_target_mover_t *mover)
{
    uint8_t before = mover->set->seed;
    mover->set->seed = (uint8_t)yb_random_below(&mover->random, 128);
    return mover->set->seed != before;
}

static bool change_gain(yb_target_mover_t *mover)
{
    uint8_t before = mover->set->gain;
    double gain = before * exp2(yb_random_bell(&mover->random, 0.8));
    gain = fmin(fmax(gain, mover->search->least_gain), mover->search->most_gain);
    mover->set->gain =
        mover->set->profile == YB_COMPACT ? yb_compact_gain(gain) : (uint8_t)lround(gain);
    return mover->set->gain != before;
}

bool yb_target_move(yb_target_mover_t *mover)
{
    static const struct {
        int weight;   /* of 1000 */
        move_fn pick; /* what it is for; NULL: that is its own choice */
        move_fn change;
    } moves[] = {{250, pick_line, move_point},
                 {70, pick_line, move_segment},
                 {80, pick_line, move_two},
                 {100, pick_line, change_height},
                 {80, pick_line, add_point},
                 {90, pick_line, remove_point},
                 {70, pick_line, transfer_point},
                 {25, NULL, change_frame},
                 {5, NULL, toggle_corner},
                 {15, NULL, yb_target_new_line},
                 {15, pick_line, yb_target_drop_contour},
                 {15, pick_line, yb_target_other_line},
                 {40, pick_line, yb_target_redraw_line},
                 {15, NULL, yb_target_add_spot},
                 {15, pick_spot, yb_target_drop_contour},
                 {25, pick_spot, yb_target_change_spot},
                 {40, pick_line, turn_line},
                 {20, NULL, reorder},
                 {20, NULL, change_seed},
                 {10, NULL, change_gain}};
    int ticket = yb_random_below(&mover->random, 1000);
    int i = 0;
    while (ticket >= moves[i].weight)
        ticket -= moves[i++].weight;
    return (moves[i].pick == NULL || moves[i].pick(mover)) && moves[i].change(mover);
}
