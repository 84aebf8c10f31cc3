/* nftw */
#define _XOPEN_SOURCE 700
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <dirent.h>
#include <ftw.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include <gdal.h>
#include <ogr_srs_api.h>

#include "picture.h"

static char directory[256];

static int remove_entry(const char *path, const struct stat *status, int type, struct FTW *where)
{
    (void)status;
    (void)type;
    (void)where;
    return remove(path);
}

int scratch_begin(void **state)
{
    (void)state;
    const char *temporary = getenv("TMPDIR");
    snprintf(directory, sizeof(directory), "%s/yamabiko-test-XXXXXX",
             temporary != NULL ? temporary : "/tmp");
    GDALAllRegister();
    return mkdtemp(directory) == NULL ? -1 : 0;
}

int scratch_end(void **state)
{
    (void)state;
    return nftw(directory, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

const char *scratch_path(const char *name)
{
    static char paths[8][512];
    static int next;
    char *path = paths[next];
    next = (next + 1) % 8;
    snprintf(path, sizeof(paths[0]), "%s/%s", directory, name);
    return path;
}

bool scratch_exists(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0;
}

int scratch_files(void)
{
    DIR *entries = opendir(directory);
    int count = -2;
    assert_non_null(entries);
    while (readdir(entries) != NULL)
        count++;
    closedir(entries);
    return count;
}

double relief_cone(double east, double north)
{
    return 1000 - 1800 * hypot(east - 0.5, north - 0.5);
}

double relief_range(double east, double north)
{
    double first = 700 * exp(-12 * (pow(east - 0.3, 2) + pow(north - 0.6, 2)));
    double second = 900 * exp(-16 * (pow(east - 0.7, 2) + pow(north - 0.35, 2)));
    return 300 + first + second + 200 * north;
}

double relief_flat(double east, double north)
{
    (void)east;
    (void)north;
    return 5;
}

static void relief_cells(float *cell, int columns, int rows, relief_fn relief)
{
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++)
            cell[row * columns + column] = (float)relief((double)column / (columns - 1),
                                                         (double)(rows - 1 - row) / (rows - 1));
}

static void write_raster(const char *path, int columns, int rows, relief_fn relief, int epsg,
                         double *transform)
{
    float *cell = calloc((size_t)columns * (size_t)rows, sizeof(float));
    assert_non_null(cell);
    relief_cells(cell, columns, rows, relief);
    GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), path, columns, rows, 1, GDT_Float32, NULL);
    assert_non_null(dataset);
    GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, epsg), OGRERR_NONE);
    GDALSetSpatialRef(dataset, srs);
    GDALSetGeoTransform(dataset, transform);
    GDALSetRasterNoDataValue(band, -9999);
    for (int i = 0; i < columns * rows; i++)
        if (isnan(cell[i]))
            cell[i] = -9999;
    assert_int_equal(
        GDALRasterIO(band, GF_Write, 0, 0, columns, rows, cell, columns, rows, GDT_Float32, 0, 0),
        CE_None);
    GDALClose(dataset);
    OSRDestroySpatialReference(srs);
    free(cell);
}

void scratch_raster(const char *path, int columns, int rows, relief_fn relief)
{
    double transform[6] = {500000, 30, 0, 5000000 + 30.0 * rows, 0, -30};
    write_raster(path, columns, rows, relief, 32632, transform);
}

void scratch_raster_degrees(const char *path, int columns, int rows, relief_fn relief)
{
    double second = 1.0 / 3600;
    double transform[6] = {9, second, 0, 46 + second * rows, 0, -second};
    write_raster(path, columns, rows, relief, 4326, transform);
}

void scratch_raster_bare(const char *path, int columns, int rows, relief_fn relief)
{
    float *cell = calloc((size_t)columns * (size_t)rows, sizeof(float));
    assert_non_null(cell);
    relief_cells(cell, columns, rows, relief);
    GDALDatasetH memory =
        GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, GDT_UInt16, NULL);
    assert_non_null(memory);
    assert_int_equal(GDALRasterIO(GDALGetRasterBand(memory, 1), GF_Write, 0, 0, columns, rows, cell,
                                  columns, rows, GDT_Float32, 0, 0),
                     CE_None);
    GDALDatasetH picture =
        GDALCreateCopy(GDALGetDriverByName("PNG"), path, memory, 0, NULL, NULL, NULL);
    assert_non_null(picture);
    GDALClose(picture);
    GDALClose(memory);
    free(cell);
}

void scratch_sheet(const char *path, int rings)
{
    yb_picture_t picture;
    assert_true(yb_picture_init(&picture, 120, 100, 1));
    for (int y = 0; y < 100; y++)
        for (int x = 0; x < 120; x++) {
            double away = hypot(x - 60, y - 50) / 10;
            bool ink = away > 0.5 && away < rings + 0.5 && fabs(away - round(away)) < 0.12;
            picture.samples[y * 120 + x] = ink ? 30 : 240;
        }
    size_t size = 0;
    uint8_t *bytes = yb_picture_png(&picture, &size);
    FILE *file = fopen(path, "wb");
    assert_true(bytes != NULL && file != NULL);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    free(bytes);
    yb_picture_free(&picture);
}

yb_grid_t *scratch_grid(int columns, int rows, relief_fn relief)
{
    yb_grid_t *grid = yb_grid_new(columns, rows, 30);
    assert_non_null(grid);
    relief_cells(grid->height_m, columns, rows, relief);
    yb_grid_measure(grid);
    return grid;
}

void scratch_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}
