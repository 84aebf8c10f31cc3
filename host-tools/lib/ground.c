#include "ground.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>

enum {
    SIDE_SAMPLES = 21
};

OGRSpatialReferenceH yb_ground_lon_lat(void)
{
    OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    OSRSetWellKnownGeogCS(srs, "WGS84");
    OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
    return srs;
}

bool yb_ground_in_metres(OGRSpatialReferenceH srs)
{
    if (srs == NULL || OSRIsLocal(srs) != 0)
        return true;
    if (OSRIsProjected(srs) == 0)
        return false;
    const char *projection = OSRGetAttrValue(srs, "PROJECTION", 0);
    if (projection != NULL && strstr(projection, "Mercator") != NULL &&
        strstr(projection, "Transverse") == NULL && strstr(projection, "Oblique") == NULL)
        return false;
    return fabs(OSRGetLinearUnits(srs, NULL) - 1.0) < 1e-6;
}

bool yb_ground_transform(OGRSpatialReferenceH from, OGRSpatialReferenceH to, double *x, double *y)
{
    OGRCoordinateTransformationH transformation = OCTNewCoordinateTransformation(from, to);
    if (transformation == NULL)
        return false;
    bool good = OCTTransform(transformation, 1, x, y, NULL) != 0 && isfinite(*x) && isfinite(*y);
    OCTDestroyCoordinateTransformation(transformation);
    return good;
}

OGRSpatialReferenceH yb_ground_local(OGRSpatialReferenceH srs, double x, double y)
{
    OGRSpatialReferenceH local = yb_ground_lon_lat();
    if (!yb_ground_transform(srs, local, &x, &y) || fabs(x) > 360 || fabs(y) > 90) {
        OSRDestroySpatialReference(local);
        return NULL;
    }
    OSRSetProjCS(local, "local transverse Mercator");
    OSRSetTM(local, y, x, 1, 0, 0);
    OSRSetLinearUnits(local, SRS_UL_METER, 1);
    return local;
}

char *yb_ground_local_wkt(double lon_deg, double lat_deg)
{
    OGRSpatialReferenceH degrees = yb_ground_lon_lat();
    OGRSpatialReferenceH local = yb_ground_local(degrees, lon_deg, lat_deg);
    char *text = NULL;
    char *copy = NULL;
    if (local != NULL && OSRExportToWkt(local, &text) == OGRERR_NONE)
        copy = strdup(text);
    CPLFree(text);
    OSRDestroySpatialReference(local);
    OSRDestroySpatialReference(degrees);
    return copy;
}

bool yb_ground_place(const char *projection, double x, double y, double *lon_deg, double *lat_deg)
{
    if (projection == NULL)
        return false;
    OGRSpatialReferenceH from = OSRNewSpatialReference(projection);
    OGRSpatialReferenceH degrees = yb_ground_lon_lat();
    bool good = from != NULL && OSRIsLocal(from) == 0;
    if (good) {
        OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
        good = yb_ground_transform(from, degrees, &x, &y);
    }
    if (from != NULL)
        OSRDestroySpatialReference(from);
    OSRDestroySpatialReference(degrees);
    *lon_deg = x;
    *lat_deg = y;
    return good;
}

bool yb_ground_box_inside(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const double box[4],
                          double inner[4])
{
    OGRCoordinateTransformationH transformation = OCTNewCoordinateTransformation(from, to);
    if (transformation == NULL)
        return false;
    bool good = true;
    for (int side = 0; side < 4; side++)
        for (int i = 0; i < SIDE_SAMPLES; i++) {
            double along = (double)i / (SIDE_SAMPLES - 1);
            double x = side % 2 == 0 ? box[side] : box[0] + along * (box[2] - box[0]);
            double y = side % 2 == 1 ? box[side] : box[1] + along * (box[3] - box[1]);
            if (OCTTransform(transformation, 1, &x, &y, NULL) == 0 || !isfinite(x) || !isfinite(y))
                good = false;
            double value = side % 2 == 0 ? x : y;
            if (i == 0)
                inner[side] = value;
            else
                inner[side] = side < 2 ? fmax(inner[side], value) : fmin(inner[side], value);
        }
    OCTDestroyCoordinateTransformation(transformation);
    return good && inner[0] < inner[2] && inner[1] < inner[3];
}
