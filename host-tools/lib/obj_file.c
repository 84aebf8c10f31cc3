#include "obj_file.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "output.h"

/* Millimetres: finer than any code can tell. */
static bool write_mesh(FILE *stream, const yb_mesh_t *mesh)
{
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
    yb_output_t *output = yb_output_open(path, force, error);
    if (output == NULL)
        return false;
    FILE *stream = fopen(yb_output_path(output), "w");
    bool good = stream != NULL && write_mesh(stream, mesh);
    if (stream != NULL && fclose(stream) != 0)
        good = false;
    if (!good)
        yb_error_set(error, "cannot write %s: %s", path, strerror(errno));
    good = good && yb_output_commit(output, error);
    yb_output_close(output);
    return good;
}
