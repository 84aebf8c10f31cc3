#include "map_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "detailed_map.h"

/* Up to one point in so many may be missing without a word. */
enum {
    FEW = 100
};

static void write_note(yb_map_note_t *note, const char *path, const yb_lines_t *given, int points,
                       const yb_line_loss_t *loss, double thinned_m)
{
    int lines = given->dropped + loss->lines;
    if (lines > 0 || FEW * loss->points > points)
        snprintf(note->text, sizeof(note->text),
                 "%s: %d lines and %d points of others are left out: they cross, touch or end away "
                 "from the frame",
                 path, lines, loss->points);
    else if (thinned_m > 0)
        snprintf(note->text, sizeof(note->text),
                 "%s: there are too many points, the lines are kept to %.2g m", path, thinned_m);
}

static yb_code_file_t *build(const char *path, yb_lines_t *lines, yb_map_note_t *note,
                             yb_error_t *error)
{
    yb_code_file_t *file = calloc(1, sizeof(*file));
    yb_line_loss_t loss;
    yb_error_t why;
    double thinned_m = 0;
    if (file == NULL) {
        yb_error_set(error, "%s: out of memory", path);
        return NULL;
    }
    if (!yb_detailed_map(lines, &file->map, &file->load, &loss, &thinned_m, &why)) {
        yb_error_set(error, "%s: %s", path, why.text);
        free(file);
        return NULL;
    }
    file->origin = lines->origin;
    lines->origin.projection = NULL;
    write_note(note, path, lines, file->load.point_count, &loss, thinned_m);
    return file;
}

yb_code_file_t *yb_map_file_read(const char *path, const char *field, const yb_window_t *window,
                                 yb_map_note_t *note, yb_error_t *error)
{
    note->text[0] = '\0';
    yb_code_file_t *file = yb_code_file_read(path, error);
    if (file != NULL || strcmp(path, "-") == 0 || !yb_lines_is_vector(path))
        return file;
    yb_lines_t *lines = yb_lines_from_vector(path, field, window, error);
    if (lines != NULL)
        file = build(path, lines, note, error);
    yb_lines_free(lines);
    return file;
}
