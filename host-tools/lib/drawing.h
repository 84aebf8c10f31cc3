/* Drawings: paths and text, written as an SVG file or painted into a PNG file by the same calls.
 *
 *     yb_page_t page = {.path = "map.svg", .width = 1000, .height = 800, .title = "map.yb"};
 *     yb_drawing_t *drawing = yb_drawing_open(&page, &error);
 *     if (drawing == NULL)
 *         return false;
 *     yb_drawing_place(drawing, 20, 40, 3.5);
 *     yb_drawing_begin(drawing, "contour", (yb_ink_t){.fill = YB_NO_INK, .stroke = 0x5b3a1e,
 *                                                     .width = 1});
 *     yb_drawing_move(drawing, 0, 0);
 *     yb_drawing_line(drawing, 10, 10);
 *     return yb_drawing_close(drawing, &error);
 *
 * x runs to the right, y down. Places are in the units of yb_drawing_place, pixels of the page
 * until then; widths of lines, radii and sizes of letters are pixels always. The bytes depend on
 * the calls alone (those of a PNG also on the fonts of the machine). Files are never half-written:
 * output.h.
 */
#ifndef YB_DRAWING_H
#define YB_DRAWING_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"

typedef struct yb_drawing yb_drawing_t;

typedef struct {
    const char *path;
    bool png; /* else SVG */
    bool force;
    double width, height; /* pixels */
    const char *title;
} yb_page_t;

enum {
    YB_NO_INK = -1
};

/* Colours are 0xrrggbb or YB_NO_INK. */
typedef struct {
    int32_t fill, stroke;
    double width;
    bool crisp; /* without soft edges: areas that touch leave no seam */
} yb_ink_t;

/* Where the text's place lies along its line. */
typedef enum {
    YB_TEXT_START,
    YB_TEXT_MIDDLE,
    YB_TEXT_END
} yb_anchor_t;

typedef struct {
    double x, y; /* of the base line */
    double size;
    double turned; /* degrees, clockwise */
    yb_anchor_t anchor;
    int32_t colour;
    int32_t halo; /* an outline that keeps it readable on lines */
    bool bold;
} yb_label_t;

/* A white page. NULL with a sentence if the file may not be written or memory is short. */
yb_drawing_t *yb_drawing_open(const yb_page_t *page, yb_error_t *error);

/* From here on one unit is `scale` pixels and (0, 0) lies at a place of the page, in pixels. */
void yb_drawing_place(yb_drawing_t *drawing, double left, double top, double scale);

/* From here on lines have this ink. In SVG they are one path of class `name`, until the next. */
void yb_drawing_begin(yb_drawing_t *drawing, const char *name, yb_ink_t ink);
void yb_drawing_move(yb_drawing_t *drawing, double x, double y);
void yb_drawing_line(yb_drawing_t *drawing, double x, double y);
void yb_drawing_loop(yb_drawing_t *drawing); /* back to where the line began */
void yb_drawing_dot(yb_drawing_t *drawing, double x, double y, double radius);

void yb_drawing_text(yb_drawing_t *drawing, const yb_label_t *label, const char *text);

/* How wide a text will be, roughly and the same everywhere. */
double yb_drawing_text_width(double size, const char *text);

/* Writes the file and frees the drawing. */
bool yb_drawing_close(yb_drawing_t *drawing, yb_error_t *error);

#endif
