#include "code_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ground.h"
#include "surface.h"

/* Far above YB_MAX_CODE_BYTES, so that a slightly longer file is told from a wrong one. */
enum {
    MOST_BYTES = 4096
};

static bool load_failed(yb_error_t *error, const char *name, const uint8_t *bytes, size_t size,
                        yb_status_t status)
{
    switch (status) {
    case YB_ERR_TRUNCATED:
    case YB_MORE:
        if (size == 0)
            return yb_error_set(error, "%s is empty", name);
        return yb_error_set(error, "%s ends too early: the code was cut off", name);
    case YB_ERR_VERSION:
        return yb_error_set(error,
                            "%s is no code of format %d, the only one read here (its first byte is "
                            "%02x)",
                            name, YB_FORMAT_VERSION, bytes[0]);
    case YB_ERR_LIMIT:
        return yb_error_set(error,
                            "%s is damaged or comes from a faulty encoder: its mesh has more "
                            "vertices than the code says",
                            name);
    default:
        return yb_error_set(error,
                            "%s is damaged or no Yamabiko code: its check byte is wrong or its "
                            "contours are impossible",
                            name);
    }
}

/* What the sections say; a place becomes the origin of a projection, the frame's centre. */
static bool take_sections(yb_code_file_t *file)
{
    size_t relief = file->load.relief_size;
    yb_sections_read(&file->sections, file->bytes + relief, file->size - relief - 1);
    if (!file->sections.placed)
        return true;
    file->origin.west_m = -yb_map_east_m(&file->map) / 2;
    file->origin.south_m = -yb_map_north_m(&file->map) / 2;
    file->origin.projection = yb_ground_local_wkt(file->sections.lon_deg, file->sections.lat_deg);
    return file->origin.projection != NULL;
}

yb_code_file_t *yb_code_file_from_bytes(const char *name, const uint8_t *bytes, size_t size,
                                        yb_error_t *error)
{
    yb_code_file_t *file = calloc(1, sizeof(*file) + size);
    if (file == NULL) {
        yb_error_set(error, "%s: out of memory", name);
        return NULL;
    }
    file->size = size;
    if (size > 0)
        memcpy(file->bytes, bytes, size);
    yb_status_t status = yb_map_load(&file->map, &file->load, file->bytes, size);
    if (status != YB_OK) {
        load_failed(error, name, bytes, size, status);
        free(file);
        return NULL;
    }
    if (!take_sections(file)) {
        yb_error_set(error, "%s: there is no projection round its place", name);
        free(file);
        return NULL;
    }
    return file;
}

yb_code_file_t *yb_code_file_read(const char *path, yb_error_t *error)
{
    bool standard = strcmp(path, "-") == 0;
    const char *name = standard ? "the standard input" : path;
    FILE *stream = standard ? stdin : fopen(path, "rb");
    if (stream == NULL) {
        yb_error_set(error, "cannot open %s: %s", name, strerror(errno));
        return NULL;
    }
    uint8_t bytes[MOST_BYTES];
    errno = 0;
    size_t size = fread(bytes, 1, sizeof(bytes), stream);
    int problem = ferror(stream) != 0 ? errno : 0;
    bool whole = feof(stream) != 0;
    if (!standard)
        fclose(stream);
    if (problem != 0) {
        yb_error_set(error, "cannot read %s: %s", name, strerror(problem));
        return NULL;
    }
    if (!whole) {
        yb_error_set(error, "%s is no Yamabiko code: it is longer than any (%d bytes)", name,
                     YB_MAX_CODE_BYTES);
        return NULL;
    }
    return yb_code_file_from_bytes(name, bytes, size, error);
}

void yb_code_file_free(yb_code_file_t *file)
{
    if (file != NULL)
        free(file->origin.projection);
    free(file);
}
