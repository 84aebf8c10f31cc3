#include "line_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <geos_c.h>

enum {
    GRID_SIDE = 256,
    SMOOTHINGS = 3
};

static const float unknown = -99999.0F;

static int by_value(const void *a, const void *b)
{
    double first = *(const double *)a;
    double second = *(const double *)b;
    return (first > second) - (first < second);
}

/* All distinct heights of the lines, rising; the caller frees them. */
static double *distinct_heights(const yb_lines_t *lines, int *count)
{
    double *height_m = malloc(((size_t)lines->count + 1) * sizeof(*height_m));
    int used = 0;
    *count = 0;
    if (height_m == NULL)
        return NULL;
    for (int i = 0; i < lines->count; i++)
        if (lines->line[i].count > 1)
            height_m[used++] = lines->line[i].height_m;
    if (used > 1)
        qsort(height_m, (size_t)used, sizeof(*height_m), by_value);
    for (int i = 0; i < used; i++)
        if (*count == 0 || height_m[i] != height_m[*count - 1])
            height_m[(*count)++] = height_m[i];
    return height_m;
}

int yb_line_grid_levels(const yb_lines_t *lines, double *level_m, int most)
{
    int count = 0;
    double *height_m = distinct_heights(lines, &count);
    if (height_m == NULL)
        return 0;
    int used = count < most ? count : most;
    for (int i = 0; i < used; i++)
        level_m[i] = height_m[used == 1 ? 0 : (long)i * (count - 1) / (used - 1)];
    free(height_m);
    return used;
}

/* The usual step from one height to the next: the middle one of all steps, unless it is known. */
static double usual_interval(const yb_lines_t *lines)
{
    if (lines->interval_m > 0)
        return lines->interval_m;
    int count = 0;
    double *height_m = distinct_heights(lines, &count);
    double interval = 0;
    if (height_m != NULL && count > 1) {
        for (int i = 0; i + 1 < count; i++)
            height_m[i] = height_m[i + 1] - height_m[i];
        qsort(height_m, (size_t)(count - 1), sizeof(*height_m), by_value);
        interval = height_m[(count - 1) / 2];
    } else if (height_m != NULL && count == 1) {
        interval = fmax(lines->width_m, lines->depth_m) / 10; /* nothing else is known */
    }
    free(height_m);
    return interval;
}

static void burn_place(yb_grid_t *grid, yb_place_t at, double height_m)
{
    int column = (int)lround(at.x_m / grid->cell_m);
    int row = grid->rows - 1 - (int)lround(at.y_m / grid->cell_m);
    if (column >= 0 && row >= 0 && column < grid->columns && row < grid->rows)
        grid->height_m[row * grid->columns + column] = (float)height_m;
}

static void burn_line(yb_grid_t *grid, const yb_line_t *line)
{
    int segments = line->closed ? line->count : line->count - 1;
    if (line->count == 1)
        burn_place(grid, line->place[0], line->height_m);
    for (int i = 0; i < segments; i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[i + 1 == line->count ? 0 : i + 1];
        int parts = 1 + (int)(2 * hypot(b.x_m - a.x_m, b.y_m - a.y_m) / grid->cell_m);
        for (int part = 0; part <= parts; part++) {
            double along = (double)part / parts;
            yb_place_t at = {a.x_m + along * (b.x_m - a.x_m), a.y_m + along * (b.y_m - a.y_m)};
            burn_place(grid, at, line->height_m);
        }
    }
}

/* Even-odd rule. */
static bool is_inside(const yb_line_t *line, yb_place_t at)
{
    bool inside = false;
    for (int i = 0, k = line->count - 1; i < line->count; k = i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[k];
        if ((a.y_m > at.y_m) != (b.y_m > at.y_m) &&
            at.x_m < (b.x_m - a.x_m) * (at.y_m - a.y_m) / (b.y_m - a.y_m) + a.x_m)
            inside = !inside;
    }
    return inside;
}

static bool is_innermost(const yb_lines_t *lines, const yb_line_t *line)
{
    for (int i = 0; i < lines->count; i++)
        if (&lines->line[i] != line && is_inside(line, lines->line[i].place[0]))
            return false;
    return true;
}

/* The smallest closed line round another one; NULL if there is none. */
static const yb_line_t *line_around(const yb_lines_t *lines, const yb_line_t *line)
{
    const yb_line_t *best = NULL;
    for (int i = 0; i < lines->count; i++) {
        const yb_line_t *other = &lines->line[i];
        if (other != line && other->closed && is_inside(other, line->place[0]) &&
            (best == NULL || yb_line_area_m2(other) < yb_line_area_m2(best)))
            best = other;
    }
    return best;
}

/* The place in a closed line that is farthest from it. */
static bool deepest_place(GEOSContextHandle_t geos, const yb_line_t *line, yb_place_t *at)
{
    if (line->count < 3)
        return false;
    GEOSCoordSequence *sequence = GEOSCoordSeq_create_r(geos, (unsigned)line->count + 1, 2);
    if (sequence == NULL)
        return false;
    for (int i = 0; i <= line->count; i++)
        GEOSCoordSeq_setXY_r(geos, sequence, (unsigned)i, line->place[i % line->count].x_m,
                             line->place[i % line->count].y_m);
    GEOSGeometry *ring = GEOSGeom_createLinearRing_r(geos, sequence);
    GEOSGeometry *area = ring != NULL ? GEOSGeom_createPolygon_r(geos, ring, NULL, 0) : NULL;
    double tolerance = sqrt(yb_line_area_m2(line)) / 50;
    GEOSGeometry *circle =
        area != NULL && tolerance > 0 ? GEOSMaximumInscribedCircle_r(geos, area, tolerance) : NULL;
    GEOSGeometry *center = circle != NULL ? GEOSGeomGetStartPoint_r(geos, circle) : NULL;
    bool good = center != NULL && GEOSGeomGetX_r(geos, center, &at->x_m) == 1 &&
                GEOSGeomGetY_r(geos, center, &at->y_m) == 1;
    if (center != NULL)
        GEOSGeom_destroy_r(geos, center);
    if (circle != NULL)
        GEOSGeom_destroy_r(geos, circle);
    if (area != NULL)
        GEOSGeom_destroy_r(geos, area);
    return good;
}

static void burn_summits(yb_grid_t *grid, const yb_lines_t *lines)
{
    GEOSContextHandle_t geos = GEOS_init_r();
    double half = usual_interval(lines) / 2;
    for (int i = 0; i < lines->count && geos != NULL; i++) {
        const yb_line_t *line = &lines->line[i];
        yb_place_t at;
        if (!line->closed || !is_innermost(lines, line) || !deepest_place(geos, line, &at))
            continue;
        const yb_line_t *around = line_around(lines, line);
        bool down = around != NULL && around->height_m > line->height_m;
        burn_place(grid, at, line->height_m + (down ? -half : half));
    }
    if (geos != NULL)
        GEOS_finish_r(geos);
}

/* If no line meets the frame, the land outside the outermost lines falls half an interval. */
static void burn_frame(yb_grid_t *grid, const yb_lines_t *lines)
{
    double lowest = HUGE_VAL;
    for (int i = 0; i < lines->count; i++) {
        if (lines->line[i].count > 1 && !lines->line[i].closed)
            return;
        if (lines->line[i].count > 1)
            lowest = fmin(lowest, lines->line[i].height_m);
    }
    if (!isfinite(lowest))
        return;
    float height = (float)(lowest - usual_interval(lines) / 2);
    for (int row = 0; row < grid->rows; row++)
        for (int column = 0; column < grid->columns; column++)
            if (row == 0 || column == 0 || row == grid->rows - 1 || column == grid->columns - 1)
                grid->height_m[row * grid->columns + column] = height;
}

static bool interpolate(yb_grid_t *grid)
{
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("MEM"), "", grid->columns, grid->rows, 1, GDT_Float32, NULL);
    bool good = false;
    if (dataset != NULL) {
        GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
        char **options = CSLSetNameValue(NULL, "TEMP_FILE_DRIVER", "MEM");
        good = GDALSetRasterNoDataValue(band, (double)unknown) == CE_None &&
               GDALRasterIO(band, GF_Write, 0, 0, grid->columns, grid->rows, grid->height_m,
                            grid->columns, grid->rows, GDT_Float32, 0, 0) == CE_None &&
               GDALFillNodata(band, NULL, grid->columns + grid->rows, 0, SMOOTHINGS, options, NULL,
                              NULL) == CE_None &&
               GDALRasterIO(band, GF_Read, 0, 0, grid->columns, grid->rows, grid->height_m,
                            grid->columns, grid->rows, GDT_Float32, 0, 0) == CE_None;
        CSLDestroy(options);
        GDALClose(dataset);
    }
    CPLPopErrorHandler();
    for (int i = 0; i < grid->columns * grid->rows && good; i++)
        good = grid->height_m[i] > unknown;
    return good;
}

yb_grid_t *yb_line_grid_new(const yb_lines_t *lines, yb_error_t *error)
{
    double cell_m = fmax(lines->width_m, lines->depth_m) / (GRID_SIDE - 1);
    int columns = 1 + (int)lround(lines->width_m / cell_m);
    int rows = 1 + (int)lround(lines->depth_m / cell_m);
    yb_grid_t *grid = yb_grid_new(columns < 2 ? 2 : columns, rows < 2 ? 2 : rows, cell_m);
    if (grid == NULL) {
        yb_error_set(error, "out of memory");
        return NULL;
    }
    for (int i = 0; i < grid->columns * grid->rows; i++)
        grid->height_m[i] = unknown;
    burn_frame(grid, lines);
    for (int i = 0; i < lines->count; i++)
        burn_line(grid, &lines->line[i]);
    burn_summits(grid, lines);
    bool good = interpolate(grid);
    if (good)
        yb_grid_measure(grid);
    else
        yb_error_set(error, "cannot interpolate between the contour lines");
    if (good && !(grid->high_m > grid->low_m)) {
        good = yb_error_set(error, "the contour lines are all at %g m and none is closed",
                            (double)grid->low_m);
    }
    if (!good) {
        yb_grid_free(grid);
        return NULL;
    }
    return grid;
}
