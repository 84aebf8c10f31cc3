#include "target_draft.h"

#include <math.h>

#include "contour_code.h"
#include "fractal.h"
#include "sketch.h"
#include "target_moves.h"

enum {
    START_GAIN = 16,
    UNITS_BELOW = 20, /* the lowest height, for the corners */
    MOST_SPACING = 16,
    MOST_STEPS = 255
};

/* A frame may be so much wider or narrower than the relief. */
static const double most_bent = 0.006;

/* Of the lines, as shares of the frame's longer side: finer where a line does not fit beside the
 * others; coarser where the mesh would have too many vertices.
 */
static const double tolerances[] = {0.025, 0.0125, 0.00625, 0.05, 0.1, 0.2};
enum {
    TOLERANCES = sizeof(tolerances) / sizeof(tolerances[0]),
    FINE_ONES = 3
};

int yb_target_draft_spacing(const yb_target_draft_t *draft, int wanted)
{
    double longest_m = fmax(yb_grid_width_m(draft->grid), yb_grid_depth_m(draft->grid));
    double shortest_m = fmin(yb_grid_width_m(draft->grid), yb_grid_depth_m(draft->grid));
    bool paper = draft->task->profile == YB_PAPER;
    int best = wanted;
    double least = HUGE_VAL;
    for (int i = 0; i <= 2 * MOST_SPACING; i++) {
        int spacing = wanted + (i % 2 == 0 ? -i / 2 : i / 2 + 1); /* wanted, + 1, - 1, + 2 … */
        if (spacing < 1 || spacing > MOST_SPACING || (paper && (8 % spacing) != 0))
            continue;
        int longest = MOST_STEPS / spacing;
        double steps = shortest_m / longest_m * longest;
        double bent = fabs(round(steps) / steps - 1);
        if (bent < least) {
            least = bent;
            best = spacing;
        }
        if (bent < most_bent)
            return spacing;
    }
    return best;
}

/* Units of height between an eighth and a fifteenth of the standard deviation (and at most half the
 * least distance of given levels): the one that hits the summit best.
 */
static uint16_t choose_unit(const yb_target_draft_t *draft)
{
    double most_m = draft->grid->std_m / 8;
    for (int i = 1; i < draft->levels->count; i++)
        most_m = fmin(most_m, (draft->levels->height_m[i] - draft->levels->height_m[i - 1]) / 2);
    uint16_t best = yb_compact_unit(most_m);
    double least = HUGE_VAL;
    double high_m = (double)draft->grid->high_m;
    for (int i = 0; i <= 32; i++) {
        uint16_t unit = yb_compact_unit(most_m / (1 + i / 32.0));
        double unit_m = yb_unit_m(unit);
        double off_m = fabs(high_m - round(high_m / unit_m) * unit_m);
        if (off_m < least - 1e-9) {
            least = off_m;
            best = unit;
        }
    }
    return best;
}

bool yb_target_draft_begin(const yb_target_draft_t *draft, yb_contour_set_t *set, int spacing)
{
    const yb_grid_t *grid = draft->grid;
    yb_sketch_task(set, grid, draft->task, spacing);
    yb_fractal_dimension_of(set, draft->dimension);
    set->gain = set->profile == YB_COMPACT ? yb_compact_gain(START_GAIN) : START_GAIN;
    if (set->profile == YB_COMPACT) {
        uint16_t unit = choose_unit(draft);
        yb_sketch_units(set, unit, 0, (double)grid->low_m - UNITS_BELOW * yb_unit_m(unit));
    }
    yb_sketch_corners(set, grid);
    set->corners = 0xf;
    yb_lines_t frame = {.width_m = yb_grid_width_m(grid), .depth_m = yb_grid_depth_m(grid)};
    return yb_sketch_spot(set, &frame, yb_sketch_summit(grid), (double)grid->high_m,
                          YB_CONTOUR_CODE_BYTES);
}

static void draft_line(yb_target_mover_t *mover, double height_m)
{
    yb_contour_set_t *set = mover->set;
    const yb_contour_set_t before = *set;
    double side = fmax(set->east, set->north);
    bool refused = false;
    for (int i = 0; i < TOLERANCES && (i < FINE_ONES || refused); i++) {
        bool fits = yb_target_add_line(mover, height_m, tolerances[i] * side, false);
        if (fits && yb_target_possible(mover->search, set))
            return;
        refused = refused || fits;
        *set = before;
    }
}

/* The heights: even steps of height and of area, half and half. */
void yb_target_draft_lines(const yb_target_search_t *search, yb_contour_set_t *set, int count)
{
    yb_target_mover_t mover = {.search = search, .set = set};
    double low_m = (double)search->grid->low_m;
    double high_m = (double)search->grid->high_m;
    for (int i = 0; i < count; i++) {
        double share = (i + 0.5) / count;
        double height_m =
            (yb_sketch_quantile(search->grid, share) + low_m + (high_m - low_m) * share) / 2;
        if (search->levels > 0)
            height_m = search->level_m[(int)(share * search->levels)];
        draft_line(&mover, height_m);
    }
}
