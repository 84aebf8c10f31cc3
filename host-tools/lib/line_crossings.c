#include "line_crossings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <geos_c.h>

#include "ground.h"

enum {
    MOST_TOLD = 3,
    ARC_SEGMENTS = 2 /* of a quarter circle round a buffer's corners */
};

/* Overlaps up to this share of the frame's longer side are touches; so are those of two lines that
 * were rounded to the same grid, each by up to half its diagonal.
 */
static const double most_overlap = 1 / 25500.0;
static const double most_rounding = 1.5;
/* … within reason: a tenth of a lattice step. */
static const double most_rounded = 1 / 2550.0;

typedef struct {
    double height_m[2];
    yb_place_t at;
} crossing_t;

typedef struct {
    GEOSContextHandle_t geos;
    const yb_lines_t *lines;
    GEOSGeometry **drawn; /* of each line; NULL of those that are not looked at */
    double overlap_m;
    int line;                             /* the one that others are compared with … */
    const GEOSPreparedGeometry *prepared; /* … quickly … */
    GEOSGeometry *inside, *beyond;        /* … one side of it, less and more the overlap */
    crossing_t found[MOST_TOLD];
    int count; /* of all that were found, one more than there is room for at most */
    bool failed;
} finder_t;

/* --- The two sides of a line ------------------------------------------------------------------ */

/* The places as coordinates, then `more` others, then, if it is `closed`, the first one again. */
static GEOSCoordSequence *sequence_of(GEOSContextHandle_t geos, const yb_line_t *line,
                                      const yb_place_t *other, int more, bool closed)
{
    int count = line->count + more;
    GEOSCoordSequence *sequence =
        GEOSCoordSeq_create_r(geos, (unsigned)(count + (closed ? 1 : 0)), 2);
    for (int i = 0; sequence != NULL && i < count + (closed ? 1 : 0); i++) {
        yb_place_t at = i == count        ? line->place[0]
                        : i < line->count ? line->place[i]
                                          : other[i - line->count];
        GEOSCoordSeq_setXY_r(geos, sequence, (unsigned)i, at.x_m, at.y_m);
    }
    return sequence;
}

/* What lies inside a closed line, or to the left of an open one. */
static GEOSGeometry *side_of(const finder_t *finder, const yb_line_t *line)
{
    yb_place_t corner[YB_FRAME_CORNERS];
    int corners = line->closed ? 0 : yb_lines_corners_back(finder->lines, line, corner);
    if (line->count + corners < 3)
        return GEOSGeom_createEmptyPolygon_r(finder->geos);
    GEOSCoordSequence *sequence = sequence_of(finder->geos, line, corner, corners, true);
    GEOSGeometry *ring =
        sequence != NULL ? GEOSGeom_createLinearRing_r(finder->geos, sequence) : NULL;
    GEOSGeometry *area =
        ring != NULL ? GEOSGeom_createPolygon_r(finder->geos, ring, NULL, 0) : NULL;
    GEOSGeometry *valid = area != NULL ? GEOSMakeValid_r(finder->geos, area) : NULL;
    if (area != NULL)
        GEOSGeom_destroy_r(finder->geos, area);
    return valid;
}

/* --- Crossings -------------------------------------------------------------------------------- */

static void destroy(const finder_t *finder, GEOSGeometry *geometry)
{
    if (geometry != NULL)
        GEOSGeom_destroy_r(finder->geos, geometry);
}

/* One of the places where two lines meet, the nearest to where the other runs inside. */
static bool meeting_place(const finder_t *finder, int other, yb_place_t *at)
{
    GEOSContextHandle_t geos = finder->geos;
    GEOSGeometry *met = GEOSIntersection_r(geos, finder->drawn[finder->line], finder->drawn[other]);
    GEOSGeometry *part = GEOSIntersection_r(geos, finder->drawn[other], finder->inside);
    GEOSCoordSequence *nearest =
        met != NULL && part != NULL ? GEOSNearestPoints_r(geos, met, part) : NULL;
    bool good = nearest != NULL && GEOSCoordSeq_getXY_r(geos, nearest, 0, &at->x_m, &at->y_m) != 0;
    if (nearest != NULL)
        GEOSCoordSeq_destroy_r(geos, nearest);
    destroy(finder, met);
    destroy(finder, part);
    return good;
}

/* Prepares the sides of the line that others are compared with, once it is needed. */
static bool find_sides(finder_t *finder)
{
    if (finder->inside != NULL)
        return true;
    GEOSGeometry *side = side_of(finder, &finder->lines->line[finder->line]);
    if (side == NULL)
        return false;
    finder->inside = GEOSBuffer_r(finder->geos, side, -finder->overlap_m, ARC_SEGMENTS);
    finder->beyond = GEOSBuffer_r(finder->geos, side, finder->overlap_m, ARC_SEGMENTS);
    destroy(finder, side);
    return finder->inside != NULL && finder->beyond != NULL;
}

/* Called for each line whose box meets that of the finder's. Each pair is looked at once. */
static void compare(void *item, void *context)
{
    finder_t *finder = context;
    int other = (int)((GEOSGeometry **)item - finder->drawn);
    double height_m = finder->lines->line[finder->line].height_m;
    double other_m = finder->lines->line[other].height_m;
    if (other <= finder->line || other_m == height_m || finder->count > MOST_TOLD ||
        finder->failed ||
        GEOSPreparedIntersects_r(finder->geos, finder->prepared, finder->drawn[other]) == 0)
        return;
    if (!find_sides(finder)) {
        finder->failed = true;
        return;
    }
    if (GEOSIntersects_r(finder->geos, finder->inside, finder->drawn[other]) != 1 ||
        GEOSCovers_r(finder->geos, finder->beyond, finder->drawn[other]) != 0)
        return;
    crossing_t crossing = {.height_m = {height_m, other_m}};
    finder->failed = !meeting_place(finder, other, &crossing.at);
    if (finder->count < MOST_TOLD)
        finder->found[finder->count] = crossing;
    finder->count++;
}

static void compare_line(finder_t *finder, GEOSSTRtree *tree, int line)
{
    finder->line = line;
    finder->prepared = GEOSPrepare_r(finder->geos, finder->drawn[line]);
    if (finder->prepared == NULL) {
        finder->failed = true;
        return;
    }
    GEOSSTRtree_query_r(finder->geos, tree, finder->drawn[line], compare, finder);
    GEOSPreparedGeom_destroy_r(finder->geos, finder->prepared);
    destroy(finder, finder->inside);
    destroy(finder, finder->beyond);
    finder->inside = NULL;
    finder->beyond = NULL;
}

/* Draws all lines and compares each with those near it. */
static void find(finder_t *finder)
{
    const yb_lines_t *lines = finder->lines;
    GEOSSTRtree *tree = GEOSSTRtree_create_r(finder->geos, 10);
    finder->failed = tree == NULL;
    for (int i = 0; i < lines->count && !finder->failed; i++) {
        if (lines->line[i].count < 2 || lines->line[i].mended)
            continue;
        GEOSCoordSequence *sequence =
            sequence_of(finder->geos, &lines->line[i], NULL, 0, lines->line[i].closed);
        if (sequence != NULL)
            finder->drawn[i] = GEOSGeom_createLineString_r(finder->geos, sequence);
        finder->failed = finder->drawn[i] == NULL;
        if (!finder->failed)
            GEOSSTRtree_insert_r(finder->geos, tree, finder->drawn[i], &finder->drawn[i]);
    }
    for (int i = 0; i < lines->count && !finder->failed; i++)
        if (finder->drawn[i] != NULL)
            compare_line(finder, tree, i);
    for (int i = 0; i < lines->count; i++)
        destroy(finder, finder->drawn[i]);
    if (tree != NULL)
        GEOSSTRtree_destroy_r(finder->geos, tree);
}

/* --- The sentence ----------------------------------------------------------------------------- */

/* From the frame to the file's own coordinates. */
static yb_place_t own_place(const yb_lines_t *lines, yb_place_t at)
{
    at.x_m += lines->origin.west_m;
    at.y_m += lines->origin.south_m;
    if (lines->input_system == NULL)
        return at;
    OGRSpatialReferenceH from = OSRNewSpatialReference(lines->origin.projection);
    OGRSpatialReferenceH to = OSRNewSpatialReference(lines->input_system);
    if (from != NULL && to != NULL) {
        OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(to, OAMS_TRADITIONAL_GIS_ORDER);
        (void)yb_ground_transform(from, to, &at.x_m, &at.y_m);
    }
    OSRDestroySpatialReference(from);
    OSRDestroySpatialReference(to);
    return at;
}

static bool tell(const finder_t *finder, const char *path, yb_error_t *error)
{
    char list[256] = "";
    int told = finder->count < MOST_TOLD ? finder->count : MOST_TOLD;
    for (int i = 0; i < told; i++) {
        const crossing_t *crossing = &finder->found[i];
        yb_place_t at = own_place(finder->lines, crossing->at);
        size_t used = strlen(list);
        snprintf(list + used, sizeof(list) - used, "%s %g m and %g m at %.9g, %.9g",
                 i > 0 ? ";" : "", crossing->height_m[0], crossing->height_m[1], at.x_m, at.y_m);
    }
    return yb_error_set(error,
                        "contour lines of %s cross:%s%s; lines of different heights cannot, mend "
                        "them or choose a window without",
                        path, list, finder->count > MOST_TOLD ? "; and others" : "");
}

bool yb_line_crossings_none(const yb_lines_t *lines, const char *path, yb_error_t *error)
{
    double longest_m = fmax(lines->width_m, lines->depth_m);
    finder_t finder = {
        .geos = GEOS_init_r(),
        .lines = lines,
        .drawn = calloc((size_t)lines->count + 1, sizeof(GEOSGeometry *)),
        .overlap_m = fmax(most_overlap * longest_m,
                          fmin(most_rounding * lines->precision_m, most_rounded * longest_m))};
    finder.failed = finder.geos == NULL || finder.drawn == NULL;
    if (!finder.failed)
        find(&finder);
    free(finder.drawn);
    if (finder.geos != NULL)
        GEOS_finish_r(finder.geos);
    if (finder.failed)
        return yb_error_set(error, "%s: cannot look for lines that cross", path);
    return finder.count == 0 || tell(&finder, path, error);
}
