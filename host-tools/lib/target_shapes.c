#include "target_shapes.h"

#include <math.h>
#include <stdlib.h>

#include "paper_code.h"
#include "random.h"
#include "set_moves.h"
#include "simplify.h"

static double any_height_m(yb_target_mover_t *mover)
{
    const yb_grid_t *grid = mover->search->grid;
    double share = 0.05 + 0.85 * yb_random_share(&mover->random);
    return (double)grid->low_m + share * (double)(grid->high_m - grid->low_m);
}

bool yb_target_drop_contour(yb_target_mover_t *mover)
{
    yb_contour_set_drop(mover->set, mover->contour);
    return true;
}

bool yb_target_add_line(yb_target_mover_t *mover, double height_m, double tolerance, bool random)
{
    yb_contour_set_t *set = mover->set;
    uint16_t height = yb_target_allowed(mover, height_m);
    yb_line_level_t level = yb_line_judge_level(
        mover->search->lines, yb_contour_set_height_m(set, height), yb_unit_m(set->unit));
    double longest = 0;
    const yb_outline_t *chosen = NULL;
    for (int i = 0; i < level.count; i++) {
        double length = level.outline[i].length;
        length *= random ? yb_random_share(&mover->random) : 1;
        if (length > longest) {
            longest = length;
            chosen = &level.outline[i];
        }
    }
    yb_place_t *place = chosen != NULL ? malloc(chosen->count * sizeof(*place)) : NULL;
    if (place == NULL)
        return false;
    for (size_t i = 0; i < chosen->count; i++)
        place[i] = (yb_place_t){chosen->point[i].x, chosen->point[i].y};
    yb_line_t line = {.closed = chosen->closed, .count = (int)chosen->count, .place = place};
    yb_lattice_t lattice = {.width_m = set->east,
                            .depth_m = set->north,
                            .east = set->east,
                            .north = set->north,
                            .spacing = set->spacing};
    yb_step_t point[YB_SET_POINTS];
    int count = yb_simplify_to_lattice(&line, tolerance, &lattice, point, 200);
    free(place);
    return count > 0 && yb_simplify_fits(set, point, count, !chosen->closed) &&
           yb_contour_set_append(set, height, !chosen->closed, point, count) && yb_paper_split(set);
}

static double any_tolerance(yb_target_mover_t *mover)
{
    const yb_contour_set_t *set = mover->set;
    double side = set->east > set->north ? set->east : set->north;
    return side * (0.012 + 0.03 * yb_random_share(&mover->random));
}

bool yb_target_new_line(yb_target_mover_t *mover)
{
    double height_m = any_height_m(mover);
    return yb_target_add_line(mover, height_m, any_tolerance(mover), true);
}

bool yb_target_other_line(yb_target_mover_t *mover)
{
    return yb_target_drop_contour(mover) && yb_target_new_line(mover);
}

bool yb_target_redraw_line(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int line = mover->contour;
    double height_m = yb_contour_set_height_m(set, set->contour[line].height);
    height_m +=
        yb_random_bell(&mover->random, mover->search->grid->std_m * (0.1 + 0.5 * mover->heat));
    yb_contour_set_drop(set, line);
    return yb_target_add_line(mover, height_m, any_tolerance(mover), false);
}

bool yb_target_add_spot(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    const yb_grid_t *grid = mover->search->grid;
    double east_m = 0;
    double north_m = 0;
    yb_judge_worst(mover->search->judge, yb_random_share(&mover->random), &east_m, &north_m);
    double width_m = yb_grid_width_m(grid);
    double depth_m = yb_grid_depth_m(grid);
    int spacing = set->spacing;
    int x = (int)lround(east_m / width_m * set->east / spacing) * spacing;
    int y = (int)lround(north_m / depth_m * set->north / spacing) * spacing;
    if (!yb_target_is_inner(set, x, y))
        return false;
    yb_step_t at = {(uint8_t)x, (uint8_t)y};
    uint16_t height =
        yb_contour_set_height(set, yb_grid_height(grid, (double)x / set->east * width_m,
                                                  (double)y / set->north * depth_m));
    return yb_contour_set_append(set, height, false, &at, 1);
}

bool yb_target_change_spot(yb_target_mover_t *mover)
{
    yb_contour_set_t *set = mover->set;
    int spot = mover->contour;
    if (yb_random_below(&mover->random, 2) == 0) {
        set->contour[spot].height =
            yb_move_height(&mover->random, set->contour[spot].height, yb_target_spread(mover), 1);
        return true;
    }
    int x = yb_target_step(mover);
    int y = yb_target_step(mover);
    return yb_target_shift(mover, spot, 0, x, y);
}
