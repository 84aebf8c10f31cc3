/* What the verbs hand to the user's other programs, through GDAL: rasters and lines in any format
 * whose driver writes one file, chosen by the file's ending. Places are metres from the south-west
 * corner of the map's frame, or in the projection of `origin` if that is not NULL: contour lines
 * and codes may say where on earth they lie.
 */
#ifndef YB_GEOFILE_H
#define YB_GEOFILE_H

#include "contour_lines.h"
#include "error.h"
#include "isolines.h"
#include "surface.h"

/* Heights, row 0 in the south, as 32-bit floats; GeoTIFF if the path is "-". */
bool yb_geofile_write_raster(const char *path, bool force, const yb_raster_t *raster,
                             const float *z_m, const yb_origin_t *origin, yb_error_t *error);

/* Lines with a field `elevation`; closed ones repeat their first point. GeoJSON if the path is
 * "-"; that is in degrees if the projection has no number of its own (EPSG).
 */
bool yb_geofile_write_lines(const char *path, bool force, const yb_isolines_t *lines,
                            const yb_origin_t *origin, yb_error_t *error);

#endif
