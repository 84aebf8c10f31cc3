#include "region.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FRAME_CORNERS = 4,
    SIDE_PARTS = 256,
    FRAME_POINTS = YB_REGION_FRAME_POINTS
};

/* Areas below this share of the frame are no regions. */
static const double least_share = 1e-12;

static void say_nothing(const char *format, ...)
{
    (void)format;
}

GEOSContextHandle_t yb_region_geos(void)
{
    GEOSContextHandle_t geos = GEOS_init_r();
    if (geos != NULL) {
        GEOSContext_setNoticeHandler_r(geos, say_nothing);
        GEOSContext_setErrorHandler_r(geos, say_nothing);
    }
    return geos;
}

/* How far along the frame a point on it lies, counter-clockwise from the south-west corner. */
static double along_frame(yb_point2_t point, double east, double north)
{
    const double off[4] = {fabs(point.y), fabs(east - point.x), fabs(north - point.y),
                           fabs(point.x)};
    const double along[4] = {point.x, east + point.y, east + north + (east - point.x),
                             east + north + east + (north - point.y)};
    int side = 0;
    for (int i = 1; i < 4; i++) {
        if (off[i] < off[side])
            side = i;
    }
    return along[side];
}

/* The point of the frame at such a distance, which may be more than once round. */
static yb_point2_t frame_point(double along, double east, double north)
{
    const double round = 2 * (east + north);
    if (along >= round)
        along -= round;
    if (along < east)
        return (yb_point2_t){along, 0};
    if (along < east + north)
        return (yb_point2_t){east, along - east};
    if (along < east + north + east)
        return (yb_point2_t){east - (along - east - north), north};
    return (yb_point2_t){0, fmax(north - (along - east - north - east), 0)};
}

size_t yb_region_frame_points(yb_point2_t from, yb_point2_t to, double east, double north,
                              yb_point2_t *point)
{
    const double corner[FRAME_CORNERS] = {east, east + north, east + north + east,
                                          2 * (east + north)};
    const double step = fmax(east, north) / SIDE_PARTS;
    const double round = 2 * (east + north);
    double at = along_frame(from, east, north), end = along_frame(to, east, north);
    size_t count = 0;
    if (end <= at)
        end += round;
    for (int i = 0; i <= 2 * FRAME_CORNERS && at < end; i++) {
        const double next =
            i == 2 * FRAME_CORNERS
                ? end
                : fmin(corner[i % FRAME_CORNERS] + (i < FRAME_CORNERS ? 0 : round), end);
        if (next <= at)
            continue;
        const int parts = (int)ceil((next - at) / step);
        for (int k = 1; k <= parts && count < FRAME_POINTS; k++)
            point[count++] = frame_point(at + (next - at) * k / parts, east, north);
        at = next;
    }
    /* The last one is where the frame's part ends. */
    return count > 0 ? count - 1 : 0;
}

/* A valid polygon from a ring of points, which need not be simple. */
static GEOSGeometry *make_shape(GEOSContextHandle_t geos, const yb_point2_t *ring, size_t count)
{
    GEOSCoordSequence *sequence = GEOSCoordSeq_create_r(geos, (unsigned)count + 1, 2);
    if (sequence == NULL)
        return NULL;
    for (size_t i = 0; i <= count; i++)
        GEOSCoordSeq_setXY_r(geos, sequence, (unsigned)i, ring[i % count].x, ring[i % count].y);
    GEOSGeometry *shell = GEOSGeom_createLinearRing_r(geos, sequence);
    GEOSGeometry *polygon = shell != NULL ? GEOSGeom_createPolygon_r(geos, shell, NULL, 0) : NULL;
    if (polygon == NULL || GEOSisValid_r(geos, polygon) == 1)
        return polygon;
    GEOSMakeValidParams *how = GEOSMakeValidParams_create_r(geos);
    GEOSMakeValidParams_setMethod_r(geos, how, GEOS_MAKE_VALID_STRUCTURE);
    GEOSMakeValidParams_setKeepCollapsed_r(geos, how, 0);
    GEOSGeometry *valid = GEOSMakeValidWithParams_r(geos, polygon, how);
    GEOSMakeValidParams_destroy_r(geos, how);
    GEOSGeom_destroy_r(geos, polygon);
    return valid;
}

static double twice_area(const yb_point2_t *ring, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const yb_point2_t a = ring[i], b = ring[(i + 1) % count];
        sum += a.x * b.y - b.x * a.y;
    }
    return sum;
}

/* Fills one region; the line is turned round first if asked. False: it bounds no area. */
static bool make_region(GEOSContextHandle_t geos, yb_region_t *region, const yb_isoline_t *line,
                        bool turned, double east, double north)
{
    const size_t room = line->count + (line->closed ? 0 : FRAME_POINTS);
    *region = (yb_region_t){.count = line->count, .boundary = line->count, .closed = line->closed};
    region->point = calloc(room, sizeof(*region->point));
    if (region->point == NULL)
        return false;
    for (size_t i = 0; i < line->count; i++)
        region->point[i] = line->point[turned ? line->count - 1 - i : i];
    if (!region->closed)
        region->boundary += yb_region_frame_points(region->point[line->count - 1], region->point[0],
                                                   east, north, region->point + line->count);
    if (region->boundary >= 3)
        region->shape = make_shape(geos, region->point, region->boundary);
    if (region->shape != NULL && GEOSArea_r(geos, region->shape, &region->area) == 1 &&
        region->area > east * north * least_share)
        return true;
    yb_region_free(geos, region);
    return false;
}

int yb_region_make(GEOSContextHandle_t geos, yb_region_t regions[2], const yb_isoline_t *line,
                   double east, double north)
{
    if (line->count < 2)
        return 0;
    if (line->closed) {
        const bool clockwise = twice_area(line->point, line->count) < 0;
        return make_region(geos, &regions[0], line, clockwise, east, north) ? 1 : 0;
    }
    int count = 0;
    for (int turned = 0; turned < 2; turned++)
        count += make_region(geos, &regions[count], line, turned == 1, east, north) ? 1 : 0;
    return count;
}

void yb_region_free(GEOSContextHandle_t geos, yb_region_t *region)
{
    if (region->shape != NULL)
        GEOSGeom_destroy_r(geos, region->shape);
    free(region->point);
    *region = (yb_region_t){0};
}

double yb_region_overlap(GEOSContextHandle_t geos, const yb_region_t *a, const yb_region_t *b)
{
    double common = 0;
    GEOSGeometry *shape = GEOSIntersection_r(geos, a->shape, b->shape);
    if (shape == NULL)
        return 0;
    const bool good = GEOSArea_r(geos, shape, &common) == 1;
    GEOSGeom_destroy_r(geos, shape);
    const double both = a->area + b->area - common;
    return good && both > 0 ? fmin(common / both, 1) : 0;
}

static GEOSGeometry *boundary_of(GEOSContextHandle_t geos, const yb_region_t *region)
{
    GEOSCoordSequence *sequence = GEOSCoordSeq_create_r(geos, (unsigned)region->boundary + 1, 2);
    if (sequence == NULL)
        return NULL;
    for (size_t i = 0; i <= region->boundary; i++) {
        const yb_point2_t point = region->point[i % region->boundary];
        GEOSCoordSeq_setXY_r(geos, sequence, (unsigned)i, point.x, point.y);
    }
    return GEOSGeom_createLineString_r(geos, sequence);
}

double yb_region_distance(GEOSContextHandle_t geos, const yb_region_t *a, const yb_region_t *b)
{
    double distance = 0;
    GEOSGeometry *first = boundary_of(geos, a), *second = boundary_of(geos, b);
    const bool good = first != NULL && second != NULL &&
                      GEOSHausdorffDistance_r(geos, first, second, &distance) == 1;
    if (first != NULL)
        GEOSGeom_destroy_r(geos, first);
    if (second != NULL)
        GEOSGeom_destroy_r(geos, second);
    return good ? distance : -1;
}
