#include "target_moves.h"

#include <math.h>
#include <string.h>

#include "target_shapes.h"

typedef bool (*move_fn)(yb_target_mover_t *mover);

double yb_target_random(yb_target_mover_t *mover)
{
    mover->random += 0x9e3779b97f4a7c15U;
    uint64_t z = mover->random;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
    z = (z ^ z >> 27) * 0x94d049bb133111ebU;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

int yb_target_below(yb_target_mover_t *mover, int count)
{
    return (int)(yb_target_random(mover) * count);
}

double yb_target_bell(yb_target_mover_t *mover, double size)
{
    double sum = yb_target_random(mover) + yb_target_random(mover) + yb_target_random(mover);
    return (sum - 1.5) * size;
}

static int clamp(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

bool yb_target_is_inner(const yb_contour_set_t *set, int x, int y)
{
    int margin = set->spacing;
    return x >= margin && y >= margin && x <= set->east - margin && y <= set->north - margin;
}

int yb_target_any(yb_target_mover_t *mover, bool spot)
{
    const yb_contour_set_t *set = mover->set;
    int found = 0;
    for (int i = 1; i < set->contour_count; i++)
        found += (set->contour[i].count == 1) == spot;
    int left = found > 0 ? yb_target_below(mover, found) : 0;
    for (int i = 1; i < set->contour_count; i++)
        if ((set->contour[i].count == 1) == spot && left-- == 0)
            return i;
    return -1;
}

static bool is_end(const yb_coded_contour_t *line, int at)
{
    return line->open && (at == 0 || at == line->count - 1);
}

int yb_target_step(yb_target_mover_t *mover)
{
    int spacing = mover->set->spacing;
    double reach = spacing * 1.2 + 20 * mover->heat;
    return (int)lround(yb_target_bell(mover, reach) / spacing) * spacing;
}

bool yb_target_shift(yb_target_mover_t *mover, int line, int at, int x, int y)
{
    yb_contour_set_t *set = mover->set;
    yb_step_t *point = &set->point[yb_contour_set_first(set, line) + at];
    if (is_end(&set->contour[line], at)) {
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
    int line = yb_target_any(mover, false);
    if (line < 0)
        return false;
    int at = yb_target_below(mover, mover->set->contour[line].count);
    int x = yb_target_step(mover);
    int y = yb_target_step(mover);
    return yb_target_shift(mover, line, at, x, y);
}

/* Two neighbours the same way, so that their segment keeps its direction. */
static bool move_segment(yb_target_mover_t *mover)
{
    int line = yb_target_any(mover, false);
    if (line < 0)
        return false;
    int count = mover->set->contour[line].count;
    int at = yb_target_below(mover, count);
    int x = yb_target_step(mover);
    int y = yb_target_step(mover);
    return yb_target_shift(mover, line, at, x, y) &&
           yb_target_shift(mover, line, (at + 1) % count, x, y);
}

/* Two points of one line, each its own way. */
static bool move_two(yb_target_mover_t *mover)
{
    bool first = move_point(mover);
    bool second = move_point(mover);
    return first || second;
}

static bool add_point(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = yb_target_any(mover, false);
    if (line < 0 || set->contour[line].count >= 200)
        return false;
    int count = set->contour[line].count;
    int at = yb_target_below(mover, set->contour[line].open ? count - 1 : count);
    int first = yb_contour_set_first(set, line);
    yb_step_t a = set->point[first + at];
    yb_step_t b = set->point[first + (at + 1) % count];
    int spacing = set->spacing;
    double along = 0.25 + 0.5 * yb_target_random(mover);
    double side = yb_target_bell(mover, 0.5);
    int x = (int)lround((a.x + along * (b.x - a.x) - side * (b.y - a.y)) / spacing) * spacing;
    int y = (int)lround((a.y + along * (b.y - a.y) + side * (b.x - a.x)) / spacing) * spacing;
    return yb_target_is_inner(set, x, y) &&
           yb_contour_set_insert(set, line, first + at + 1, (yb_step_t){(uint8_t)x, (uint8_t)y});
}

static bool remove_point(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = yb_target_any(mover, false);
    if (line < 0)
        return false;
    int at = yb_target_below(mover, set->contour[line].count);
    if (is_end(&set->contour[line], at) ||
        (!set->contour[line].open && set->contour[line].count <= 4))
        return false;
    yb_contour_set_remove(set, line, yb_contour_set_first(set, line) + at);
    return true;
}

static bool transfer_point(yb_target_mover_t *mover)
{
    return remove_point(mover) && add_point(mover);
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
    int line = yb_target_any(mover, false);
    if (line < 0)
        return false;
    uint16_t *height = &set->contour[line].height;
    uint16_t before = *height;
    double unit_m = yb_unit_m(set->unit) * (1 << set->interval);
    double move_m = yb_target_bell(mover, mover->search->grid->std_m * (0.15 + 0.4 * mover->heat));
    if (mover->search->levels == 0 && fabs(move_m) < unit_m)
        move_m = move_m < 0 ? -unit_m : unit_m;
    *height = yb_target_allowed(mover, yb_contour_set_height_m(set, before) + move_m);
    return *height != before;
}

uint16_t yb_target_moved(yb_target_mover_t *mover, uint16_t height)
{
    double std = mover->search->grid->std_m / yb_unit_m(mover->set->unit);
    int move = (int)lround(yb_target_bell(mover, std * (0.1 + 0.4 * mover->heat)));
    if (move == 0)
        move = yb_target_below(mover, 2) == 0 ? -1 : 1;
    return (uint16_t)clamp(height + move, 0, UINT16_MAX);
}

static bool change_frame(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int corner = yb_target_below(mover, YB_CORNERS);
    if (set->corners == 0)
        set->frame = yb_target_moved(mover, set->frame);
    else if ((set->corners >> corner & 1) != 0)
        set->corner[corner] = yb_target_moved(mover, set->corner[corner]);
    else
        return false;
    return true;
}

static bool toggle_corner(yb_target_mover_t *mover)
{
    mover->set->corners = (uint8_t)(mover->set->corners ^ 1U << yb_target_below(mover, YB_CORNERS));
    return true;
}

/* Another start or direction, or another place in the order: the surface stays, the size does not.
 */
static bool turn_line(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = yb_target_any(mover, false);
    if (line < 0)
        return false;
    int count = set->contour[line].count;
    yb_step_t *point = &set->point[yb_contour_set_first(set, line)];
    yb_step_t before[YB_SET_POINTS];
    memcpy(before, point, (size_t)count * sizeof(*point));
    bool open = set->contour[line].open;
    int from = open ? count - 1 : yb_target_below(mover, count);
    bool back = open || yb_target_below(mover, 3) == 0;
    for (int i = 0; i < count; i++)
        point[i] = before[(from + (back ? count - i : i)) % count];
    return true;
}

static bool reorder(yb_target_mover_t *mover)
{
    int line = yb_target_any(mover, false);
    int other = yb_target_any(mover, false);
    return line > 0 && other > 0 && yb_contour_set_reorder(mover->set, line, other);
}

static bool change_seed(yb_target_mover_t *mover)
{
    uint8_t before = mover->set->seed;
    mover->set->seed = (uint8_t)yb_target_below(mover, 128);
    return mover->set->seed != before;
}

static bool change_gain(yb_target_mover_t *mover)
{
    uint8_t before = mover->set->gain;
    double gain = before * exp2(yb_target_bell(mover, 0.8));
    gain = fmin(fmax(gain, mover->search->least_gain), mover->search->most_gain);
    mover->set->gain =
        mover->set->profile == YB_COMPACT ? yb_compact_gain(gain) : (uint8_t)lround(gain);
    return mover->set->gain != before;
}

bool yb_target_move(yb_target_mover_t *mover)
{
    static const struct {
        int weight; /* of 1000 */
        move_fn fn;
    } moves[] = {{250, move_point},           {70, move_segment},        {80, move_two},
                 {100, change_height},        {80, add_point},           {90, remove_point},
                 {70, transfer_point},        {25, change_frame},        {5, toggle_corner},
                 {15, yb_target_new_line},    {15, yb_target_drop_line}, {15, yb_target_other_line},
                 {40, yb_target_redraw_line}, {15, yb_target_add_spot},  {15, yb_target_drop_spot},
                 {25, yb_target_change_spot}, {40, turn_line},           {20, reorder},
                 {20, change_seed},           {10, change_gain}};
    int ticket = yb_target_below(mover, 1000);
    int i = 0;
    while (ticket >= moves[i].weight)
        ticket -= moves[i++].weight;
    return moves[i].fn(mover);
}
