#include "obj_file.h"

#include <inttypes.h>
#include <stdio.h>

#include "output.h"

/* Millimetres: finer than any code can tell. */
static bool write_mesh(FILE *stream, const void *context)
{
    const yb_mesh_t *mesh = context;
    fputs("# metres, x east, y north, z up\n", stream);
    for (uint32_t i = 0; i < mesh->point_count; i++)
        fprintf(stream, "v %.3f %.3f %.3f\n", mesh->point[i].x, mesh->point[i].y, mesh->point[i].z);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->triangle[i];
        fprintf(stream, "f %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", corner[0] + 1, corner[1] + 1,
                corner[2] + 1);
    }
    return ferror(stream) == 0;
}

bool yb_obj_file_write(const char *path, bool force, const yb_mesh_t *mesh, yb_error_t *error)
{
    return yb_output_stream(path, force, write_mesh, mesh, error);
}
