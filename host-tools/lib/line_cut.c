#include "line_cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <geos_c.h>

#include "line_join.h"

/* A gap of up to this share of a line's length is closed. */
static const double most_gap = 0.1;
/* A line whose end is moved to the frame by more than this share of `snap_m` counts as mended. The
 * border of a sheet in degrees is no rectangle in metres: its ends all move a little.
 */
static const double least_mend = 0.001;
static const double least_mend_bent = 0.25;

static GEOSGeometry *from_ogr(GEOSContextHandle_t geos, OGRGeometryH geometry)
{
    int size = OGR_G_WkbSize(geometry);
    unsigned char *bytes = malloc((size_t)size);
    GEOSGeometry *result = NULL;
    if (bytes != NULL && OGR_G_ExportToWkb(geometry, wkbNDR, bytes) == OGRERR_NONE)
        result = GEOSGeomFromWKB_buf_r(geos, bytes, (size_t)size);
    free(bytes);
    return result;
}

/* The parts of the lines in the frame, as long as they can be joined. */
static GEOSGeometry *cut_and_join(GEOSContextHandle_t geos, const yb_lines_t *lines,
                                  OGRGeometryH geometry)
{
    GEOSGeometry *whole = from_ogr(geos, geometry);
    GEOSGeometry *frame = GEOSGeom_createRectangle_r(geos, 0, 0, lines->width_m, lines->depth_m);
    GEOSGeometry *inside = NULL;
    GEOSGeometry *joined = NULL;
    if (whole != NULL && frame != NULL)
        inside = GEOSIntersection_r(geos, whole, frame);
    if (inside != NULL)
        joined = GEOSLineMerge_r(geos, inside);
    if (whole != NULL)
        GEOSGeom_destroy_r(geos, whole);
    if (frame != NULL)
        GEOSGeom_destroy_r(geos, frame);
    if (inside != NULL)
        GEOSGeom_destroy_r(geos, inside);
    return joined;
}

/* Moves a place onto the nearest side of the frame if it is within `snap`. */
static bool snap_to_frame(const yb_lines_t *lines, yb_place_t *at, double snap)
{
    double west = fabs(at->x_m);
    double east = fabs(lines->width_m - at->x_m);
    double south = fabs(at->y_m);
    double north = fabs(lines->depth_m - at->y_m);
    double nearest = fmin(fmin(west, east), fmin(south, north));
    if (nearest > snap)
        return false;
    if (nearest == west)
        at->x_m = 0;
    else if (nearest == east)
        at->x_m = lines->width_m;
    else if (nearest == south)
        at->y_m = 0;
    else
        at->y_m = lines->depth_m;
    return true;
}

static double distance(yb_place_t a, yb_place_t b)
{
    return hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

static bool add_line(yb_lines_t *lines, double height_m, yb_place_t *place, int count,
                     double snap_m)
{
    yb_place_t first_place = place[0];
    yb_place_t last_place = place[count - 1];
    bool closed = distance(first_place, last_place) == 0;
    if (closed) {
        count--;
    } else {
        bool first = snap_to_frame(lines, &place[0], snap_m);
        bool last = snap_to_frame(lines, &place[count - 1], snap_m);
        if (!first || !last) {
            yb_line_t line = {.count = count, .place = place};
            closed = distance(place[0], place[count - 1]) < most_gap * yb_line_length_m(&line);
            if (!closed) {
                lines->dropped++;
                return true;
            }
        }
    }
    if (count < (closed ? 3 : 2))
        return true;
    double least_m = (lines->input_system != NULL ? least_mend_bent : least_mend) * snap_m;
    bool mended = distance(first_place, place[0]) > least_m ||
                  (closed && distance(first_place, last_place) > 0);
    if (!closed)
        mended = mended || distance(last_place, place[count - 1]) > least_m;
    if (!yb_lines_add(lines, height_m, closed, place, count))
        return false;
    lines->line[lines->count - 1].mended = mended;
    return true;
}

/* The places of a line string; none of a point, which is what a line that only touched the frame
 * leaves. False: out of memory.
 */
static bool take_piece(GEOSContextHandle_t geos, const GEOSGeometry *geometry, yb_piece_t *piece)
{
    *piece = (yb_piece_t){NULL, 0};
    if (GEOSGeomTypeId_r(geos, geometry) != GEOS_LINESTRING)
        return true;
    const GEOSCoordSequence *sequence = GEOSGeom_getCoordSeq_r(geos, geometry);
    unsigned count = 0;
    if (sequence == NULL || GEOSCoordSeq_getSize_r(geos, sequence, &count) == 0)
        return false;
    if (count < 2)
        return true;
    piece->place = calloc(count, sizeof(*piece->place));
    if (piece->place == NULL)
        return false;
    piece->count = (int)count;
    bool good = true;
    for (int i = 0; i < piece->count && good; i++)
        good = GEOSCoordSeq_getXY_r(geos, sequence, (unsigned)i, &piece->place[i].x_m,
                                    &piece->place[i].y_m) != 0;
    return good;
}

/* Adds the lines that the parts of a geometry become, joined wherever they meet. */
static bool add_parts(GEOSContextHandle_t geos, yb_lines_t *lines, double height_m,
                      const GEOSGeometry *geometry, double snap_m)
{
    int parts = GEOSGetNumGeometries_r(geos, geometry);
    int pieces = 0;
    yb_piece_t *piece = calloc((size_t)parts + 1, sizeof(*piece));
    bool good = piece != NULL;
    for (int i = 0; i < parts && good; i++) {
        good = take_piece(geos, GEOSGetGeometryN_r(geos, geometry, i), &piece[pieces]);
        pieces += piece[pieces].place != NULL;
    }
    int joined = good ? yb_line_join(piece, pieces) : -1;
    good = joined >= 0;
    pieces = good ? joined : pieces;
    for (int i = 0; i < pieces; i++) {
        good = good && add_line(lines, height_m, piece[i].place, piece[i].count, snap_m);
        free(piece[i].place);
    }
    free(piece);
    return good;
}

bool yb_line_cut(yb_lines_t *lines, double height_m, OGRGeometryH geometry, double snap_m,
                 yb_error_t *error)
{
    GEOSContextHandle_t geos = GEOS_init_r();
    GEOSGeometry *joined = geos != NULL ? cut_and_join(geos, lines, geometry) : NULL;
    bool good = joined != NULL && add_parts(geos, lines, height_m, joined, snap_m);
    if (joined != NULL)
        GEOSGeom_destroy_r(geos, joined);
    if (geos != NULL)
        GEOS_finish_r(geos);
    if (!good)
        return yb_error_set(error, "cannot cut the contour lines at %g m to the frame", height_m);
    return true;
}
