/* Coordinates on earth: which are metres already, and metres for those that are not. */
#ifndef YB_GROUND_H
#define YB_GROUND_H

#include <stdbool.h>

#include <ogr_srs_api.h>

/* Longitude and latitude in degrees, in this order, WGS 84. The caller destroys it. */
OGRSpatialReferenceH yb_ground_lon_lat(void);

/* Whether a length in these coordinates is a length on the ground, in metres: false for degrees,
 * feet, and for Mercator, whose scale grows with the latitude. True for NULL and local coordinates.
 */
bool yb_ground_in_metres(OGRSpatialReferenceH srs);

/* A transverse Mercator projection with its origin at (x, y) of `srs`, true to scale there. NULL if
 * there is no way from srs to longitude and latitude. The caller destroys it.
 */
OGRSpatialReferenceH yb_ground_local(OGRSpatialReferenceH srs, double x, double y);

/* The same at a longitude and latitude, as WKT that the caller frees by free. NULL: no memory. */
char *yb_ground_local_wkt(double lon_deg, double lat_deg);

/* Longitude and latitude of a place in a projection, WKT; false if it is NULL, local, or without a
 * way there.
 */
bool yb_ground_place(const char *projection, double x, double y, double *lon_deg, double *lat_deg);

/* Moves a point from one system to another; false if that is impossible. */
bool yb_ground_transform(OGRSpatialReferenceH from, OGRSpatialReferenceH to, double *x, double *y);

/* The largest upright box (x min, y min, x max, y max) inside the image of `box`. */
bool yb_ground_box_inside(OGRSpatialReferenceH from, OGRSpatialReferenceH to, const double box[4],
                          double inner[4]);

#endif
