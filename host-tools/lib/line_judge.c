#include "line_judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "level_cut.h"
#include "similarity.h"
#include "surface.h"

enum {
    MOST_HEIGHT_Q8 = 1 << 17
};

typedef struct {
    double height_m, unit_m;
    yb_outline_t *outline;
    int count, room;
} level_t;

struct yb_line_judge {
    const yb_lines_t *lines;
    double width_m, depth_m; /* of the truth */
    double east, north;
    yb_mesh_t mesh; /* of the truth, in steps; none if there are lines */
    yb_level_cut_t *cut;
    level_t *level;
    int levels, level_room;
    yb_map_t map;
    yb_load_t load;
};

static bool mesh_truth(yb_line_judge_t *judge, const yb_grid_t *grid)
{
    size_t columns = (size_t)grid->columns;
    size_t rows = (size_t)grid->rows;
    float *z_m = malloc(columns * rows * sizeof(*z_m));
    if (z_m == NULL)
        return false;
    for (size_t row = 0; row < rows; row++)
        memcpy(z_m + row * columns, grid->height_m + (rows - 1 - row) * columns,
               columns * sizeof(*z_m));
    bool good = yb_mesh_from_lattice(&judge->mesh, z_m, (uint32_t)columns, (uint32_t)rows,
                                     judge->east, judge->north);
    free(z_m);
    return good;
}

yb_line_judge_t *yb_line_judge_new(const yb_grid_t *grid, const yb_lines_t *lines, int east,
                                   int north)
{
    yb_line_judge_t *judge = calloc(1, sizeof(*judge));
    if (judge == NULL)
        return NULL;
    judge->lines = lines;
    judge->width_m = lines != NULL ? lines->width_m : yb_grid_width_m(grid);
    judge->depth_m = lines != NULL ? lines->depth_m : yb_grid_depth_m(grid);
    judge->east = east;
    judge->north = north;
    judge->cut = yb_level_cut_new();
    if (judge->cut != NULL && (lines != NULL || mesh_truth(judge, grid)))
        return judge;
    yb_line_judge_free(judge);
    return NULL;
}

void yb_line_judge_free(yb_line_judge_t *judge)
{
    if (judge == NULL)
        return;
    for (int i = 0; i < judge->levels; i++) {
        for (int k = 0; k < judge->level[i].count; k++)
            yb_outline_free(&judge->level[i].outline[k]);
        free(judge->level[i].outline);
    }
    free(judge->level);
    yb_mesh_free(&judge->mesh);
    yb_level_cut_free(judge->cut);
    free(judge);
}

static bool add_outline(level_t *level, const yb_isoline_t *line, bool turned, double east,
                        double north)
{
    yb_outline_t outline;
    if (!yb_outline_make(&outline, line, turned, east, north))
        return true; /* a line without area is no original */
    if (level->count == level->room) {
        int room = level->room == 0 ? 4 : 2 * level->room;
        yb_outline_t *grown = realloc(level->outline, (size_t)room * sizeof(*grown));
        if (grown == NULL) {
            yb_outline_free(&outline);
            return false;
        }
        memset(grown + level->count, 0, (size_t)(room - level->count) * sizeof(*grown));
        level->outline = grown;
        level->room = room;
    }
    level->outline[level->count++] = outline;
    return true;
}

static bool add_original(const yb_line_judge_t *judge, level_t *level, const yb_isoline_t *line)
{
    return add_outline(level, line, false, judge->east, judge->north) &&
           (line->closed || add_outline(level, line, true, judge->east, judge->north));
}

/* The lines given, scaled to the frame. */
static bool take_lines(const yb_line_judge_t *judge, level_t *level)
{
    bool good = true;
    double near_m = level->unit_m / 2 * 1.01;
    for (int i = 0; good && i < judge->lines->count; i++) {
        const yb_line_t *line = &judge->lines->line[i];
        if (line->count < 2 || fabs(line->height_m - level->height_m) > near_m)
            continue;
        yb_isoline_t scaled = {.point = malloc((size_t)line->count * sizeof(yb_point2_t)),
                               .count = (size_t)line->count,
                               .closed = line->closed};
        good = scaled.point != NULL;
        for (int k = 0; good && k < line->count; k++)
            scaled.point[k] = (yb_point2_t){line->place[k].x_m / judge->width_m * judge->east,
                                            line->place[k].y_m / judge->depth_m * judge->north};
        good = good && add_original(judge, level, &scaled);
        free(scaled.point);
    }
    return good;
}

static bool take_isolines(const yb_line_judge_t *judge, level_t *level)
{
    yb_isolines_t isolines = {0};
    bool good = yb_isolines_add(&isolines, &judge->mesh, level->height_m);
    for (size_t i = 0; good && i < isolines.count; i++)
        good = add_original(judge, level, &isolines.line[i]);
    yb_isolines_free(&isolines);
    return good;
}

static const level_t *level_at(yb_line_judge_t *judge, double height_m, double unit_m)
{
    for (int i = 0; i < judge->levels; i++)
        if (judge->level[i].height_m == height_m && judge->level[i].unit_m == unit_m)
            return &judge->level[i];
    if (judge->levels == judge->level_room) {
        int room = judge->level_room == 0 ? 16 : 2 * judge->level_room;
        level_t *grown = realloc(judge->level, (size_t)room * sizeof(*grown));
        if (grown == NULL)
            return NULL;
        judge->level = grown;
        judge->level_room = room;
    }
    level_t *level = &judge->level[judge->levels++];
    *level = (level_t){.height_m = height_m, .unit_m = unit_m};
    bool good = judge->lines != NULL ? take_lines(judge, level) : take_isolines(judge, level);
    return good ? level : NULL;
}

yb_line_level_t yb_line_judge_level(yb_line_judge_t *judge, double height_m, double unit_m)
{
    const level_t *level = level_at(judge, height_m, unit_m);
    return level == NULL ? (yb_line_level_t){0}
                         : (yb_line_level_t){level->outline, level->count, height_m};
}

static double ratio(double a, double b)
{
    return fmin(a, b) / fmax(a, b);
}

/* Whether a region is the larger part of the frame, which must overlap well to count. */
static bool too_large(const yb_line_judge_t *judge, const yb_outline_t *outline, double overlap)
{
    return !outline->closed && outline->area > judge->east * judge->north / 2 &&
           overlap < YB_SIMILARITY_LARGER_PART;
}

static const yb_outline_t *match_original(const yb_line_judge_t *judge, const level_t *level,
                                          const yb_outline_t *polygon)
{
    const yb_outline_t *best = NULL;
    double most = 0;
    for (int i = 0; i < level->count; i++) {
        const yb_outline_t *outline = &level->outline[i];
        if (ratio(outline->area, polygon->area) <= most)
            continue;
        double overlap = yb_outline_overlap(polygon, outline, judge->north);
        if (overlap > most && !too_large(judge, outline, overlap)) {
            most = overlap;
            best = outline;
        }
    }
    return best;
}

/* The reproduced region that overlaps the original's most; *overlap is 0 if there is none. */
static void match_reproduced(const yb_line_judge_t *judge, const yb_isolines_t *lines,
                             const yb_outline_t *original, yb_outline_t *best, double *overlap)
{
    *best = (yb_outline_t){0};
    *overlap = 0;
    for (size_t i = 0; i < lines->count; i++) {
        const yb_isoline_t *line = &lines->line[i];
        if (line->closed && ratio(yb_outline_area(line), original->area) <= *overlap)
            continue;
        for (int turned = 0; turned < (line->closed ? 1 : 2); turned++) {
            yb_outline_t outline;
            if (!yb_outline_make(&outline, line, turned == 1, judge->east, judge->north))
                continue;
            double here = ratio(outline.area, original->area) > *overlap
                              ? yb_outline_overlap(original, &outline, judge->north)
                              : 0;
            if (here <= *overlap || too_large(judge, &outline, here)) {
                yb_outline_free(&outline);
                continue;
            }
            yb_outline_free(best);
            *best = outline;
            *overlap = here;
        }
    }
}

/* K_i of a coded polygon; 0: a line is missing. */
static double score_line(yb_line_judge_t *judge, const yb_isoline_t *coded,
                         const yb_isolines_t *reproductions, const level_t *level)
{
    yb_outline_t polygon = {0};
    if (!yb_outline_make(&polygon, coded, false, judge->east, judge->north))
        return 0;
    if (!coded->closed && polygon.area > judge->east * judge->north / 2) {
        yb_outline_free(&polygon);
        if (!yb_outline_make(&polygon, coded, true, judge->east, judge->north))
            return 0;
    }
    const yb_outline_t *original = match_original(judge, level, &polygon);
    yb_outline_free(&polygon);
    if (original == NULL)
        return 0;
    double k = 0;
    double overlap = 0;
    yb_outline_t reproduced;
    match_reproduced(judge, reproductions, original, &reproduced, &overlap);
    if (overlap > 0)
        k = (overlap + yb_outline_distance(original, &reproduced) +
             yb_outline_curvature(original, &reproduced)) /
            3;
    yb_outline_free(&reproduced);
    return k;
}

static double polygon_length(const yb_isoline_t *line)
{
    double length = 0;
    for (size_t i = 0; i + 1 < line->count + (line->closed ? 1 : 0); i++) {
        yb_point2_t a = line->point[i];
        yb_point2_t b = line->point[(i + 1) % line->count];
        length += hypot(b.x - a.x, b.y - a.y);
    }
    return length;
}

/* Heights that the engine's arithmetic has no room for would come of a decoder's mistake. */
static bool heights_are_sane(const yb_map_t *map)
{
    for (int i = 0; i < map->vertex_count; i++)
        if (abs(map->vertex[i].z_q8) > 2 * MOST_HEIGHT_Q8)
            return false;
    return true;
}

bool yb_line_judge_score(yb_line_judge_t *judge, const uint8_t *code, size_t size,
                         uint16_t longest_q8, yb_line_score_t *score, double *each)
{
    yb_map_t *map = &judge->map;
    if (yb_map_load(map, &judge->load, code, size) != YB_OK || !heights_are_sane(map))
        return false;
    *score = (yb_line_score_t){0};
    double sum = 0;
    double lengths = 0;
    double unit_m = yb_unit_m(map->unit);
    const yb_contour_t *contour = judge->load.contour;
    const yb_isolines_t *reproductions = NULL;
    int32_t cut_q8 = INT32_MIN;
    for (int i = 0; i < judge->load.contour_count; i++) {
        yb_point2_t point[YB_SET_POINTS];
        yb_isoline_t coded = {.point = point,
                              .count = contour[i].count,
                              .closed = !yb_contour_is_open(map, &contour[i])};
        if (each != NULL)
            each[i] = 0;
        if (coded.count < 2 || coded.count > YB_SET_POINTS)
            continue;
        for (size_t k = 0; k < coded.count; k++) {
            const yb_vertex_t *vertex = &map->vertex[contour[i].first + k];
            point[k] = (yb_point2_t){vertex->x_q8 / 256.0, vertex->y_q8 / 256.0};
        }
        int32_t z_q8 = map->vertex[contour[i].first].z_q8;
        if (reproductions == NULL || z_q8 != cut_q8)
            reproductions = yb_level_cut_lines(judge->cut, map, z_q8, longest_q8);
        cut_q8 = z_q8;
        const level_t *level = level_at(judge, yb_map_z_m(map, z_q8), unit_m);
        if (reproductions == NULL || level == NULL)
            return false;
        double k = score_line(judge, &coded, reproductions, level);
        double length = polygon_length(&coded);
        sum += k * length;
        lengths += length;
        score->lines++;
        score->missing += k <= 0;
        if (each != NULL)
            each[i] = k;
    }
    score->k = lengths > 0 ? sum / lengths : 0;
    return true;
}
