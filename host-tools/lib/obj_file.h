/* A mesh as a Wavefront OBJ file: metres, x east, y north, z up, shared corners once. */
#ifndef YB_OBJ_FILE_H
#define YB_OBJ_FILE_H

#include "error.h"
#include "surface.h"

bool yb_obj_file_write(const char *path, bool force, const yb_mesh_t *mesh, yb_error_t *error);

#endif
