#include "set_moves.h"

#include <math.h>

#include "random.h"

uint16_t yb_move_height(uint64_t *random, uint16_t height, double spread, int unit)
{
    int move = (int)lround(yb_random_bell(random, spread));
    if (move == 0)
        move = yb_random_below(random, 2) == 0 ? -1 : 1;
    int moved = height + move * unit;
    return (uint16_t)(moved < 0 ? 0 : moved > UINT16_MAX ? UINT16_MAX : moved);
}

bool yb_move_corner(uint64_t *random, yb_contour_set_t *set, double spread)
{
    int corner = yb_random_below(random, YB_CORNERS);
    if (set->corners == 0)
        set->frame = yb_move_height(random, set->frame, spread, 1);
    else if ((set->corners >> corner & 1) != 0)
        set->corner[corner] = yb_move_height(random, set->corner[corner], spread, 1);
    else
        return false;
    return true;
}

void yb_move_toggle_corner(uint64_t *random, yb_contour_set_t *set)
{
    set->corners = (uint8_t)(set->corners ^ 1U << yb_random_below(random, YB_CORNERS));
}

void yb_move_turn(uint64_t *random, yb_contour_set_t *set, int line)
{
    int count = set->contour[line].count;
    bool open = set->contour[line].open;
    int from = open ? count - 1 : yb_random_below(random, count);
    bool back = open || yb_random_below(random, 3) == 0;
    yb_contour_set_turn(set, line, from, back);
}
