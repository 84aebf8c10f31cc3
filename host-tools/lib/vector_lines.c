/* Contour lines from vector files (contour_lines.h). */
#include "contour_lines.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include "ground.h"
#include "line_cut.h"

/* Names of attributes that hold a height, the surest first. */
static const char *const field_names[] = {
    "elevation", "elev", "ele",   "height", "contour",     "contour_m", "elev_m",
    "altitude",  "alt",  "level", "hoehe",  "h\xc3\xb6he", "hoehe_m",   "quota",
    "altitud",   "kote", "z",     "z_m",    "value",       "cote",      "h"};
enum {
    FIELD_NAMES = sizeof(field_names) / sizeof(field_names[0])
};

/* Ends of lines nearer to the frame than this share of its size are taken to lie on it. */
static const double snap_share = 0.02;
/* In metres, feet or degrees: beyond any place on earth. */
static const double most_coordinate = 1e9;
/* More is a mark that there is no height. */
static const double most_height_m = 30000;
static const char blanks[] = " \t\r\n";
static const double degree_m = 111320;
enum {
    MOST_DECIMALS = 9
};
/* Room round lines that are all closed. */
static const double margin_share = 0.06;

typedef struct {
    double height_m;
    OGRGeometryH geometry; /* line strings and points, ours */
} shape_t;

typedef struct {
    const char *path;
    GDALDatasetH dataset;
    OGRLayerH layer;
    int field; /* index, or -1: the z coordinate */
    OGRSpatialReferenceH local;
    shape_t *shape;
    int count, room;
    double box[4];
    int decimals; /* of the coordinates, at most */
} reader_t;

bool yb_lines_is_vector(const char *path)
{
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDatasetH dataset =
        GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    bool vector = dataset != NULL && GDALGetRasterCount(dataset) == 0 &&
                  GDALDatasetGetLayerCount(dataset) > 0;
    if (dataset != NULL)
        GDALClose(dataset);
    CPLPopErrorHandler();
    return vector;
}

static int field_of(OGRLayerH layer, const char *name)
{
    OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
    if (name != NULL)
        return OGR_FD_GetFieldIndex(definition, name);
    for (int i = 0; i < FIELD_NAMES; i++)
        for (int k = 0; k < OGR_FD_GetFieldCount(definition); k++)
            if (EQUAL(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, k)), field_names[i]))
                return k;
    return -1;
}

static bool has_z(OGRLayerH layer)
{
    OGR_L_ResetReading(layer);
    OGRFeatureH feature = OGR_L_GetNextFeature(layer);
    bool found = false;
    if (feature != NULL) {
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        found = geometry != NULL && OGR_G_Is3D(geometry) != 0;
        OGR_F_Destroy(feature);
    }
    OGR_L_ResetReading(layer);
    return found;
}

/* The first layer with heights. */
static bool choose_layer(reader_t *reader, const char *field, yb_error_t *error)
{
    for (int i = 0; i < GDALDatasetGetLayerCount(reader->dataset); i++) {
        OGRLayerH layer = GDALDatasetGetLayer(reader->dataset, i);
        reader->field = field_of(layer, field);
        if (reader->field >= 0 || (field == NULL && has_z(layer))) {
            reader->layer = layer;
            return true;
        }
    }
    if (field != NULL)
        return yb_error_set(error, "%s has no attribute '%s'", reader->path, field);
    return yb_error_set(error,
                        "no attribute of %s sounds like a height, and its lines have no z: name "
                        "the attribute by --field",
                        reader->path);
}

static double mean_z(OGRGeometryH geometry)
{
    int parts = OGR_G_GetGeometryCount(geometry);
    if (parts > 0)
        return mean_z(OGR_G_GetGeometryRef(geometry, 0));
    int points = OGR_G_GetPointCount(geometry);
    double sum = 0;
    for (int i = 0; i < points; i++)
        sum += OGR_G_GetZ(geometry, i) / points;
    return sum;
}

/* A plain number, perhaps with the unit m: "1200", " -3.5 m"; not "1.200,5", "0x20" or "900 ft". */
static bool text_height(const char *text, double *height_m)
{
    text += strspn(text, blanks);
    size_t digits = strspn(text, "+-.0123456789eE");
    char *end = NULL;
    *height_m = strtod(text, &end);
    if (end == text || end != text + digits)
        return false;
    end += strspn(end, blanks);
    end += *end == 'm';
    return end[strspn(end, blanks)] == '\0';
}

static bool no_number(const reader_t *reader, OGRFeatureH feature, yb_error_t *error)
{
    char shown[40];
    snprintf(shown, sizeof(shown), "%s", OGR_F_GetFieldAsString(feature, reader->field));
    for (char *at = shown; *at != '\0'; at++)
        if ((unsigned char)*at < ' ' || *at == 0x7f)
            *at = '?';
    return yb_error_set(error,
                        "the height of feature %lld of %s is the text '%s' (attribute %s): only a "
                        "plain number of metres can be read, such as 1200, -3.5 or 1200 m",
                        (long long)OGR_F_GetFID(feature), reader->path, shown,
                        OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, reader->field)));
}

/* The feature's height; *found is false if it has none. False: it has one that is no number. */
static bool feature_height(const reader_t *reader, OGRFeatureH feature, double *height_m,
                           bool *found, yb_error_t *error)
{
    *found = false;
    if (reader->field < 0) {
        *height_m = mean_z(OGR_F_GetGeometryRef(feature));
        *found = isfinite(*height_m);
        return true;
    }
    if (OGR_F_IsFieldSetAndNotNull(feature, reader->field) == 0)
        return true;
    OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, reader->field));
    const char *text = OGR_F_GetFieldAsString(feature, reader->field);
    if (text[strspn(text, blanks)] == '\0')
        return true;
    if (type == OFTInteger || type == OFTInteger64 || type == OFTReal)
        *height_m = OGR_F_GetFieldAsDouble(feature, reader->field);
    else if (!text_height(text, height_m))
        return no_number(reader, feature, error);
    *found = isfinite(*height_m) && fabs(*height_m) < most_height_m;
    return true;
}

static bool add_shape(reader_t *reader, double height_m, OGRGeometryH geometry)
{
    if (reader->count == reader->room) {
        int room = reader->room == 0 ? 64 : 2 * reader->room;
        shape_t *shape = realloc(reader->shape, (size_t)room * sizeof(*shape));
        if (shape == NULL)
            return false;
        reader->shape = shape;
        reader->room = room;
    }
    reader->shape[reader->count++] = (shape_t){height_m, geometry};
    return true;
}

/* Lines as they are, areas by their outlines, all flat and in metres. Takes the geometry. */
static bool take_geometry(reader_t *reader, double height_m, OGRGeometryH geometry)
{
    OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    OGR_G_FlattenTo2D(geometry);
    if (type == wkbPolygon || type == wkbMultiPolygon) {
        OGRGeometryH outline = OGR_G_Boundary(geometry);
        OGR_G_DestroyGeometry(geometry);
        geometry = outline;
    }
    if (geometry == NULL)
        return false;
    if (add_shape(reader, height_m, geometry))
        return true;
    OGR_G_DestroyGeometry(geometry);
    return false;
}

static bool read_shapes(reader_t *reader, yb_error_t *error)
{
    OGR_L_ResetReading(reader->layer);
    OGRFeatureH feature = OGR_L_GetNextFeature(reader->layer);
    while (feature != NULL) {
        double height_m = 0;
        bool good = true;
        bool found = false;
        OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        if (geometry != NULL && OGR_G_IsEmpty(geometry) == 0)
            good = feature_height(reader, feature, &height_m, &found, error);
        if (found && !take_geometry(reader, height_m, OGR_F_StealGeometry(feature)))
            good = yb_error_set(error, "%s: out of memory", reader->path);
        OGR_F_Destroy(feature);
        if (!good)
            return false;
        feature = OGR_L_GetNextFeature(reader->layer);
    }
    if (reader->count == 0)
        return yb_error_set(error, "%s holds no line with a height", reader->path);
    return true;
}

static void extent_of(const reader_t *reader, double box[4])
{
    for (int i = 0; i < reader->count; i++) {
        OGREnvelope envelope;
        OGR_G_GetEnvelope(reader->shape[i].geometry, &envelope);
        box[0] = i == 0 ? envelope.MinX : fmin(box[0], envelope.MinX);
        box[1] = i == 0 ? envelope.MinY : fmin(box[1], envelope.MinY);
        box[2] = i == 0 ? envelope.MaxX : fmax(box[2], envelope.MaxX);
        box[3] = i == 0 ? envelope.MaxY : fmax(box[3], envelope.MaxY);
    }
}

/* Whether many line ends lie at the border of the extent: then it is the edge of a sheet. */
static bool cut_by_extent(const reader_t *reader)
{
    double near =
        snap_share * fmax(reader->box[2] - reader->box[0], reader->box[3] - reader->box[1]);
    int ends = 0;
    for (int i = 0; i < reader->count; i++) {
        OGRGeometryH line = reader->shape[i].geometry;
        int points = OGR_G_GetPointCount(line);
        if (points < 2 || OGR_G_GetGeometryCount(line) > 0)
            continue;
        for (int end = 0; end < 2; end++) {
            double x = OGR_G_GetX(line, end == 0 ? 0 : points - 1);
            double y = OGR_G_GetY(line, end == 0 ? 0 : points - 1);
            bool closed = x == OGR_G_GetX(line, end == 0 ? points - 1 : 0) &&
                          y == OGR_G_GetY(line, end == 0 ? points - 1 : 0);
            if (!closed && (x - reader->box[0] < near || y - reader->box[1] < near ||
                            reader->box[2] - x < near || reader->box[3] - y < near))
                ends++;
        }
    }
    return ends >= 2;
}

/* Counts the decimals that the coordinates of a geometry need. */
static void count_decimals(reader_t *reader, OGRGeometryH geometry)
{
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); i++)
        count_decimals(reader, OGR_G_GetGeometryRef(geometry, i));
    for (int i = 0; i < 2 * OGR_G_GetPointCount(geometry); i++) {
        double value = i % 2 == 0 ? OGR_G_GetX(geometry, i / 2) : OGR_G_GetY(geometry, i / 2);
        double scaled = value * pow(10, reader->decimals);
        while (reader->decimals < MOST_DECIMALS && fabs(scaled - round(scaled)) > 1e-3)
            scaled = value * pow(10, ++reader->decimals);
    }
}

/* What that is on the ground; `srs` is the file's own system. */
static double precision_m(const reader_t *reader, OGRSpatialReferenceH srs)
{
    double unit_m = srs == NULL || OSRIsLocal(srs) != 0 ? 1
                    : OSRIsGeographic(srs) != 0         ? degree_m
                                                        : OSRGetLinearUnits(srs, NULL);
    return unit_m * pow(10, -reader->decimals);
}

/* Brings all shapes to metres if their coordinates are not. */
static bool to_metres(reader_t *reader, OGRSpatialReferenceH srs, yb_error_t *error)
{
    double box[4] = {0};
    extent_of(reader, box);
    for (int i = 0; i < 4; i++)
        if (!(fabs(box[i]) < most_coordinate)) /* GDAL would turn round the earth for ever */
            return yb_error_set(error, "the coordinates of %s reach %g: that is no place on earth",
                                reader->path, box[i]);
    for (int i = 0; i < reader->count; i++)
        count_decimals(reader, reader->shape[i].geometry);
    if (yb_ground_in_metres(srs))
        return true;
    reader->local = yb_ground_local(srs, (box[0] + box[2]) / 2, (box[1] + box[3]) / 2);
    OGRCoordinateTransformationH transformation =
        reader->local != NULL ? OCTNewCoordinateTransformation(srs, reader->local) : NULL;
    bool good = transformation != NULL;
    for (int i = 0; i < reader->count && good; i++)
        good = OGR_G_Transform(reader->shape[i].geometry, transformation) == OGRERR_NONE;
    if (transformation != NULL)
        OCTDestroyCoordinateTransformation(transformation);
    if (!good)
        return yb_error_set(error, "cannot find metres for the coordinates of %s", reader->path);
    return true;
}

static bool choose_box(reader_t *reader, OGRSpatialReferenceH srs, const yb_window_t *window,
                       yb_error_t *error)
{
    double extent[4] = {0};
    extent_of(reader, extent);
    memcpy(reader->box, extent, sizeof(extent));
    if (window->kind == YB_WINDOW_BOX) {
        memcpy(reader->box, window->box, sizeof(reader->box));
        if (reader->local != NULL &&
            !yb_ground_box_inside(srs, reader->local, window->box, reader->box))
            return yb_error_set(error, "the window does not fit the coordinates of %s",
                                reader->path);
    } else if (window->kind == YB_WINDOW_CENTER) {
        OGRSpatialReferenceH degrees = yb_ground_lon_lat();
        double x = window->lon_deg;
        double y = window->lat_deg;
        bool good =
            srs != NULL &&
            yb_ground_transform(degrees, reader->local != NULL ? reader->local : srs, &x, &y);
        OSRDestroySpatialReference(degrees);
        if (!good)
            return yb_error_set(error, "%s does not say where on earth it lies; use --window",
                                reader->path);
        for (int side = 0; side < 4; side++)
            reader->box[side] = (side % 2 == 0 ? x : y) + (side < 2 ? -0.5 : 0.5) * window->side_m;
    } else if (!cut_by_extent(reader)) {
        double margin = margin_share * fmax(extent[2] - extent[0], extent[3] - extent[1]);
        for (int side = 0; side < 4; side++)
            reader->box[side] += side < 2 ? -margin : margin;
    }
    if (reader->box[0] > extent[2] || reader->box[2] < extent[0] || reader->box[1] > extent[3] ||
        reader->box[3] < extent[1])
        return yb_error_set(error, "the window lies outside the lines of %s", reader->path);
    if (!(reader->box[2] > reader->box[0] && reader->box[3] > reader->box[1]))
        return yb_error_set(error, "the lines of %s have no extent", reader->path);
    return true;
}

static int by_height(const void *a, const void *b)
{
    const shape_t *first = a;
    const shape_t *second = b;
    return (first->height_m > second->height_m) - (first->height_m < second->height_m);
}

/* Collects the line strings of a geometry, moved to the frame, and adds its points as spots. */
static bool gather(const reader_t *reader, yb_lines_t *lines, double height_m,
                   OGRGeometryH geometry, OGRGeometryH all)
{
    int parts = OGR_G_GetGeometryCount(geometry);
    int points = OGR_G_GetPointCount(geometry);
    for (int i = 0; i < parts; i++)
        if (!gather(reader, lines, height_m, OGR_G_GetGeometryRef(geometry, i), all))
            return false;
    if (points == 1) {
        yb_place_t at = {OGR_G_GetX(geometry, 0) - reader->box[0],
                         OGR_G_GetY(geometry, 0) - reader->box[1]};
        bool inside =
            at.x_m > 0 && at.y_m > 0 && at.x_m < lines->width_m && at.y_m < lines->depth_m;
        return !inside || yb_lines_add(lines, height_m, false, &at, 1);
    }
    if (points > 1) {
        OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
        for (int i = 0; i < points; i++)
            OGR_G_AddPoint_2D(line, OGR_G_GetX(geometry, i) - reader->box[0],
                              OGR_G_GetY(geometry, i) - reader->box[1]);
        OGR_G_AddGeometryDirectly(all, line);
    }
    return true;
}

static bool cut_shapes(reader_t *reader, yb_lines_t *lines, yb_error_t *error)
{
    if (reader->count > 1)
        qsort(reader->shape, (size_t)reader->count, sizeof(shape_t), by_height);
    double snap_m = snap_share * fmax(lines->width_m, lines->depth_m);
    for (int from = 0, to = 0; from < reader->count; from = to) {
        double height_m = reader->shape[from].height_m;
        OGRGeometryH all = OGR_G_CreateGeometry(wkbMultiLineString);
        bool good = true;
        for (to = from; to < reader->count && reader->shape[to].height_m == height_m; to++)
            good = good && gather(reader, lines, height_m, reader->shape[to].geometry, all);
        if (!good)
            yb_error_set(error, "%s: out of memory", reader->path);
        good = good && (OGR_G_GetGeometryCount(all) == 0 ||
                        yb_line_cut(lines, height_m, all, snap_m, error));
        OGR_G_DestroyGeometry(all);
        if (!good)
            return false;
    }
    if (lines->count == 0)
        return yb_error_set(error,
                            "no line of %s is closed or runs through the window from side to side",
                            reader->path);
    return true;
}

static bool reader_open(reader_t *reader, const char *field, yb_error_t *error)
{
    reader->dataset = GDALOpenEx(reader->path, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    if (reader->dataset == NULL) {
        VSILFILE *file = VSIFOpenL(reader->path, "rb");
        if (file == NULL)
            return yb_error_set(error, "cannot open %s: %s", reader->path, strerror(errno));
        VSIFCloseL(file);
        return yb_error_set(error, "%s is no raster and no vector file that GDAL can read",
                            reader->path);
    }
    return choose_layer(reader, field, error);
}

static void reader_close(reader_t *reader)
{
    for (int i = 0; i < reader->count; i++)
        OGR_G_DestroyGeometry(reader->shape[i].geometry);
    free(reader->shape);
    if (reader->local != NULL)
        OSRDestroySpatialReference(reader->local);
    if (reader->dataset != NULL)
        GDALClose(reader->dataset);
}

/* As text that is freed by free; *text stays NULL without a system. False: no memory. */
static bool copy_system(OGRSpatialReferenceH srs, char **text)
{
    char *wkt = NULL;
    if (srs != NULL && OSRExportToWkt(srs, &wkt) == OGRERR_NONE)
        *text = strdup(wkt);
    bool good = wkt == NULL || *text != NULL;
    CPLFree(wkt);
    return good;
}

/* Where the frame lies, in the file's own projection or the local one. */
static bool set_origin(const reader_t *reader, OGRSpatialReferenceH srs, yb_lines_t *lines)
{
    lines->origin.west_m = reader->box[0];
    lines->origin.south_m = reader->box[1];
    lines->precision_m = precision_m(reader, srs);
    if (reader->local == NULL)
        return copy_system(srs, &lines->origin.projection);
    return copy_system(reader->local, &lines->origin.projection) &&
           copy_system(srs, &lines->input_system);
}

yb_lines_t *yb_lines_from_vector(const char *path, const char *field, const yb_window_t *window,
                                 yb_error_t *error)
{
    reader_t reader = {.path = path};
    yb_lines_t *lines = NULL;
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    bool good = reader_open(&reader, field, error) && read_shapes(&reader, error);
    OGRSpatialReferenceH srs = good ? OGR_L_GetSpatialRef(reader.layer) : NULL;
    good = good && to_metres(&reader, srs, error) && choose_box(&reader, srs, window, error);
    if (good) {
        lines = yb_lines_new(reader.box[2] - reader.box[0], reader.box[3] - reader.box[1]);
        good = lines != NULL && set_origin(&reader, srs, lines)
                   ? cut_shapes(&reader, lines, error)
                   : yb_error_set(error, "%s: out of memory", path);
    }
    reader_close(&reader);
    CPLPopErrorHandler();
    if (!good) {
        yb_lines_free(lines);
        return NULL;
    }
    return lines;
}
