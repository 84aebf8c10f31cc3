#include "detailed_map.h"

#include <math.h>
#include <stdlib.h>

#include "contour_set.h"
#include "simplify.h"

enum {
    STEPS = 255,
    GRAIN_Q8 = 16, /* the lattice of points */
    GRAINS = 256 / GRAIN_Q8,
    MOST_POINTS = YB_MAX_VERTICES - 4 /* the frame's corners */
};

typedef struct {
    const yb_lines_t *lines;
    yb_map_t *map;
    yb_load_t *load;
    yb_line_lattice_t *lattice;
    double cell_m;
    double thinned_m;
    yb_node_t *node;   /* room for the longest line */
    int *kept;         /* and for its points that are not left out … */
    yb_place_t *place; /* … and their places */
} builder_t;

static bool no_memory(yb_error_t *error)
{
    return yb_error_set(error, "not enough memory for the contour lines");
}

/* The least length of a step that a code can name and at which the frame has at most STEPS. */
static uint16_t cell_of(double longest_m)
{
    double cell_m = longest_m / STEPS;
    uint16_t coded = yb_unit_coded(cell_m);
    while (yb_unit_m(coded) * STEPS < longest_m) {
        cell_m *= 1.0001;
        coded = yb_unit_coded(cell_m);
    }
    return coded;
}

/* Far more than the earth's circumference, far less than what a code can name. */
static const double most_side_m = 1e8;

/* Height of a frame that no line meets: half an interval below the lowest line. An interval is what
 * lies between that and the next line, or, where there is none, the highest spot; or else a metre.
 */
static double frame_height_m(const yb_lines_t *lines)
{
    double low_m = HUGE_VAL;
    for (int i = 0; i < lines->count; i++)
        if (lines->line[i].count > 1)
            low_m = fmin(low_m, lines->line[i].height_m);
    double line_m = HUGE_VAL;
    double spot_m = low_m;
    for (int i = 0; i < lines->count; i++) {
        double height_m = lines->line[i].height_m;
        if (lines->line[i].count > 1 && height_m > low_m)
            line_m = fmin(line_m, height_m);
        spot_m = fmax(spot_m, height_m);
    }
    if (!isfinite(low_m))
        return lines->line[0].height_m; /* spot heights alone */
    double next_m = isfinite(line_m) ? line_m : spot_m > low_m ? spot_m : low_m + 1;
    return low_m - (next_m - low_m) / 2;
}

/* The header that the map would have as a code. */
static bool begin_map(builder_t *builder, yb_error_t *error)
{
    const yb_lines_t *lines = builder->lines;
    yb_map_t *map = builder->map;
    double low_m = lines->line[0].height_m;
    double high_m = low_m;
    for (int i = 1; i < lines->count; i++) {
        low_m = fmin(low_m, lines->line[i].height_m);
        high_m = fmax(high_m, lines->line[i].height_m);
    }
    if (!(lines->width_m < most_side_m && lines->depth_m < most_side_m))
        return yb_error_set(error, "the lines' frame is %g m by %g m: more than the earth is round",
                            lines->width_m, lines->depth_m);
    yb_map_begin(map, builder->load);
    map->cell = cell_of(fmax(lines->width_m, lines->depth_m));
    map->unit = yb_unit_coded(1);
    double frame_m = frame_height_m(lines);
    map->base_m = (int16_t)fmin(fmax(floor(fmin(low_m, frame_m)), INT16_MIN), INT16_MAX);
    map->smooth = true;
    map->detail = false;
    map->hurst_q8m1 = UINT8_MAX;
    builder->cell_m = yb_unit_m(map->cell);
    double frame_q8 = round((frame_m - map->base_m) / builder->cell_m * 256);
    builder->load->frame_height = (int32_t)fmin(fmax(frame_q8, 0), YB_MAX_HEIGHT_Q8);
    map->east_q8 = (uint16_t)(lround(lines->width_m / builder->cell_m * GRAINS) * GRAIN_Q8);
    map->north_q8 = (uint16_t)(lround(lines->depth_m / builder->cell_m * GRAINS) * GRAIN_Q8);
    if (map->east_q8 < 256 || map->north_q8 < 256)
        return yb_error_set(error,
                            "the lines' frame is %g m by %g m: its shorter side must have at least "
                            "a hundredth of the longer one, and a metre",
                            lines->width_m, lines->depth_m);
    if ((high_m - map->base_m) / builder->cell_m * 256 >= YB_MAX_HEIGHT_Q8)
        return yb_error_set(
            error,
            "the heights of the lines go from %g to %g, in a frame of %g m by %g m: "
            "are they metres?",
            low_m, high_m, lines->width_m, lines->depth_m);
    return true;
}

/* The line itself, or what is left of it after thinning; points to the builder's memory then. */
static bool thin(builder_t *builder, const yb_line_t *line, yb_line_t *thinned)
{
    *thinned = *line;
    if (builder->thinned_m <= 0 || line->count < 4)
        return true;
    thinned->count = yb_simplify(line, builder->thinned_m, builder->kept);
    thinned->place = builder->place;
    for (int i = 0; i < thinned->count; i++)
        builder->place[i] = line->place[builder->kept[i]];
    return thinned->count > 0;
}

static yb_status_t add_line(builder_t *builder, const yb_line_t *whole)
{
    yb_map_t *map = builder->map;
    yb_load_t *load = builder->load;
    yb_line_t line;
    if (!thin(builder, whole, &line))
        return YB_MORE;
    int count = yb_line_lattice_lay(builder->lattice, &line, builder->node);
    if (count < 0)
        return YB_MORE;
    if (load->point_count + count > MOST_POINTS || load->contour_count == YB_MAX_CONTOURS)
        return YB_ERR_LIMIT;
    double height_q8 = (line.height_m - map->base_m) / builder->cell_m * 256;
    if (count > 0)
        load->contour[load->contour_count++] =
            (yb_contour_t){.first = (yb_index_t)load->point_count, .count = (yb_index_t)count};
    for (int i = 0; i < count; i++)
        map->vertex[load->point_count++] =
            (yb_vertex_t){.x_q8 = (uint16_t)(builder->node[i].x * GRAIN_Q8),
                          .y_q8 = (uint16_t)(builder->node[i].y * GRAIN_Q8),
                          .z_q8 = (int32_t)lround(height_q8)};
    return YB_OK;
}

/* Lays all lines, spot heights last, and lets the engine build the map. YB_MORE: out of memory. */
static yb_status_t build(builder_t *builder, yb_line_loss_t *loss)
{
    const yb_lines_t *lines = builder->lines;
    yb_status_t status = YB_OK;
    builder->lattice =
        yb_line_lattice_new(lines->width_m, lines->depth_m, builder->map->east_q8 / GRAIN_Q8,
                            builder->map->north_q8 / GRAIN_Q8);
    if (builder->lattice == NULL)
        return YB_MORE;
    for (int spots = 0; spots < 2; spots++)
        for (int i = 0; i < lines->count && status == YB_OK; i++)
            if ((lines->line[i].count == 1) == (spots == 1))
                status = add_line(builder, &lines->line[i]);
    *loss = yb_line_lattice_loss(builder->lattice);
    yb_line_lattice_free(builder->lattice);
    return status == YB_OK ? yb_map_build(builder->map, builder->load) : status;
}

/* Leaves out more points each time until the map is not too large any more. */
static bool build_thinner(builder_t *builder, yb_line_loss_t *loss, yb_error_t *error)
{
    yb_status_t status = YB_ERR_LIMIT;
    for (int half = 0; status == YB_ERR_LIMIT && half < 2 * GRAINS * STEPS;
         half = half == 0 ? 1 : 2 * half) {
        builder->thinned_m = half * builder->cell_m / (2 * GRAINS);
        if (!begin_map(builder, error))
            return false;
        status = build(builder, loss);
    }
    switch (status) {
    case YB_OK:
        return builder->load->contour_count > 0 ||
               yb_error_set(error, "none of the lines is closed or runs from side to side without "
                                   "crossing itself");
    case YB_MORE:
        return no_memory(error);
    case YB_ERR_LIMIT:
        return yb_error_set(error,
                            "there are too many lines for one map of %d points: take a "
                            "smaller window",
                            YB_MAX_VERTICES);
    default:
        return yb_error_set(error, "the contour lines cannot be made a map: %s",
                            yb_status_text(status));
    }
}

bool yb_detailed_map(const yb_lines_t *lines, yb_map_t *map, yb_load_t *load, yb_line_loss_t *loss,
                     double *thinned_m, yb_error_t *error)
{
    yb_line_loss_t lost = {0};
    int longest = 1;
    for (int i = 0; i < lines->count; i++)
        longest = lines->line[i].count > longest ? lines->line[i].count : longest;
    builder_t builder = {.lines = lines,
                         .map = map,
                         .load = load,
                         .node = malloc((size_t)longest * sizeof(yb_node_t)),
                         .kept = malloc((size_t)longest * sizeof(int)),
                         .place = malloc((size_t)longest * sizeof(yb_place_t))};
    bool good = builder.node != NULL && builder.kept != NULL && builder.place != NULL;
    if (!good)
        no_memory(error);
    else if (lines->count == 0)
        good = yb_error_set(error, "there are no contour lines");
    else
        good = build_thinner(&builder, &lost, error);
    free(builder.node);
    free(builder.kept);
    free(builder.place);
    if (loss != NULL)
        *loss = lost;
    if (thinned_m != NULL)
        *thinned_m = builder.thinned_m;
    return good;
}
