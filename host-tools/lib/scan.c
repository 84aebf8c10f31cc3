#include "scan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_error.h>
#include <gdal.h>

#include "blots.h"
#include "grid.h"
#include "ink.h"
#include "nesting.h"
#include "strokes.h"
#include "thin.h"

enum {
    MOST_LINES = 4000,
    MOST_NAMED = 3
};

/* A line that fills so much of its own extent, and that so much of the sheet, is no contour. */
static const double border_share = 0.94;
static const double border_side = 0.6;

typedef struct {
    double west, north, east, south;
} extent_t;

bool yb_scan_is(const char *path)
{
    const char *const drivers[] = {"PNG", NULL};
    double transform[6];
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, NULL, NULL);
    bool scan = dataset != NULL && GDALGetRasterCount(dataset) > 0 &&
                GDALGetRasterDataType(GDALGetRasterBand(dataset, 1)) == GDT_Byte &&
                GDALGetGeoTransform(dataset, transform) != CE_None;
    if (dataset != NULL)
        GDALClose(dataset);
    CPLPopErrorHandler();
    return scan;
}

/* Whether a fork lies close to one that has been named. */
static bool is_named(int (*named)[2], int count, int x, int y, double near)
{
    for (int i = 0; i < count; i++)
        if (abs(named[i][0] - x) <= near && abs(named[i][1] - y) <= near)
            return true;
    return false;
}

static bool without_forks(const yb_ink_t *ink, const char *path, yb_error_t *error)
{
    int named[MOST_NAMED][2];
    int count = 0;
    bool more = false;
    int32_t step[8];
    yb_ink_around(ink, step);
    for (int y = 0; y < ink->height && !more; y++)
        for (int x = 0; x < ink->width && !more; x++) {
            int32_t at = yb_ink_index(ink, x, y);
            if (ink->pixel[at] == 0 || yb_thin_neighbours(ink, step, at) < 3 ||
                is_named(named, count, x, y, 4 * ink->thickness))
                continue;
            more = count == MOST_NAMED;
            if (!more) {
                named[count][0] = x;
                named[count++][1] = y;
            }
        }
    char places[128] = "";
    int length = 0;
    for (int i = 0; i < count; i++)
        length += snprintf(places + length, sizeof(places) - (size_t)length, "%s(%d, %d)",
                           i == 0 ? "" : ", ", named[i][0] + ink->left, named[i][1] + ink->top);
    if (count == 0)
        return true;
    return yb_error_set(error,
                        "lines of %s meet at pixel %s%s: contour lines neither cross nor touch, "
                        "part them",
                        path, places, more ? " and more" : "");
}

/* From pixels, y down, to metres, y up. */
static yb_place_t to_metres(const yb_ink_t *ink, double cell_m, yb_place_t at)
{
    return (yb_place_t){at.x_m * cell_m, (ink->height - at.y_m) * cell_m};
}

static yb_lines_t *to_lines(const yb_ink_t *ink, const yb_strokes_t *strokes,
                            const yb_blots_t *marks, double cell_m)
{
    yb_lines_t *lines = yb_lines_new(ink->width * cell_m, ink->height * cell_m);
    bool good = lines != NULL;
    for (int i = 0; i < strokes->count && good; i++) {
        yb_stroke_t *stroke = &strokes->stroke[i];
        for (int k = 0; k < stroke->count; k++)
            stroke->place[k] = to_metres(ink, cell_m, stroke->place[k]);
        good = yb_lines_add(lines, 0, stroke->closed, stroke->place, stroke->count);
    }
    for (int i = 0; i < marks->count && good; i++) {
        yb_place_t at = to_metres(ink, cell_m, marks->place[i]);
        good = yb_lines_add(lines, 0, false, &at, 1);
    }
    if (!good) {
        yb_lines_free(lines);
        return NULL;
    }
    return lines;
}

static extent_t extent_of(const yb_stroke_t *stroke)
{
    extent_t extent = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < stroke->count; i++) {
        extent.west = fmin(extent.west, stroke->place[i].x_m);
        extent.east = fmax(extent.east, stroke->place[i].x_m);
        extent.north = fmin(extent.north, stroke->place[i].y_m);
        extent.south = fmax(extent.south, stroke->place[i].y_m);
    }
    return extent;
}

/* Whether a stroke is a rectangle, a little crooked perhaps, along the sides of the sheet. */
static bool is_rectangle(const yb_stroke_t *stroke, const yb_ink_t *ink)
{
    extent_t extent = extent_of(stroke);
    double width = extent.east - extent.west;
    double depth = extent.south - extent.north;
    const yb_line_t line = {
        .closed = stroke->closed, .count = stroke->count, .place = stroke->place};
    return stroke->closed && width > border_side * ink->width &&
           depth > border_side * ink->height &&
           yb_line_area_m2(&line) > border_share * width * depth;
}

/* A rectangle round all other lines, too crooked for yb_ink_read to cut along it, would lift
 * everything in it by an interval: it is left out.
 */
static void drop_border(yb_strokes_t *strokes, const yb_ink_t *ink)
{
    for (int i = 0; i < strokes->count; i++) {
        yb_stroke_t *stroke = &strokes->stroke[i];
        extent_t outer = extent_of(stroke);
        bool border = strokes->count > 1 && is_rectangle(stroke, ink);
        for (int k = 0; k < strokes->count && border; k++) {
            extent_t inner = extent_of(&strokes->stroke[k]);
            border = k == i || (inner.west > outer.west && inner.east < outer.east &&
                                inner.north > outer.north && inner.south < outer.south);
        }
        if (border) {
            free(stroke->place);
            *stroke = strokes->stroke[--strokes->count];
            i = -1; /* there may be one within */
        }
    }
}

static bool check_strokes(const yb_strokes_t *strokes, const yb_blots_t *marks, const char *path,
                          yb_error_t *error)
{
    if (strokes->count == 0)
        return yb_error_set(error, "no line of %s is closed or runs from side to side", path);
    if (strokes->count > MOST_LINES || marks->count > MOST_LINES)
        return yb_error_set(error, "%s holds %d lines and %d marks: more than %d are no contours",
                            path, strokes->count, marks->count, MOST_LINES);
    return true;
}

yb_lines_t *yb_lines_from_scan(const char *path, const yb_scan_scale_t *scale, yb_error_t *error)
{
    double cell_m = scale->cell_m > 0 ? scale->cell_m : YB_GRID_DEFAULT_CELL_M;
    yb_ink_t ink = {0};
    yb_blots_t marks = {0};
    yb_strokes_t strokes = {0};
    yb_lines_t *lines = NULL;
    yb_error_t why;
    bool good = yb_ink_read(&ink, path, error);
    if (good && (!yb_blots_take(&ink, &marks) || !yb_thin(&ink)))
        good = yb_error_set(error, "%s: out of memory", path);
    good = good && without_forks(&ink, path, error) &&
           yb_strokes_follow(&strokes, &ink, &marks, path, error);
    if (good)
        drop_border(&strokes, &ink);
    good = good && check_strokes(&strokes, &marks, path, error);
    if (good && (lines = to_lines(&ink, &strokes, &marks, cell_m)) == NULL)
        good = yb_error_set(error, "%s: out of memory", path);
    if (good && !yb_nesting_heights(lines, scale->base_m, scale->interval_m, &why))
        good = yb_error_set(error, "%s: %s", path, why.text);
    yb_strokes_free(&strokes);
    free(marks.place);
    yb_ink_free(&ink);
    if (!good || lines == NULL) {
        yb_lines_free(lines);
        return NULL;
    }
    lines->interval_m = scale->interval_m;
    return lines;
}
