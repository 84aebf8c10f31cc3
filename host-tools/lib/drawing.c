#include "drawing.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cairo.h>

#include "output.h"

struct yb_drawing {
    yb_output_t *output;
    const char *target;
    FILE *svg;      /* this … */
    cairo_t *cairo; /* … or this */
    double left, top, scale;
    yb_ink_t ink;
    bool grouped;   /* SVG: a group in the units of the place is open */
    bool in_path;   /* SVG: a path's data are open; Cairo: there is something to paint */
    char head[256]; /* SVG: the path's beginning, written when it has a point */
};

/* A number in as few letters as it takes. */
typedef struct {
    char text[32];
} number_t;

static number_t number(double value, int decimals)
{
    number_t written;
    snprintf(written.text, sizeof(written.text), "%.*f", decimals, value);
    if (strchr(written.text, '.') != NULL) {
        char *end = written.text + strlen(written.text);
        while (end[-1] == '0')
            *--end = '\0';
        if (end[-1] == '.')
            end[-1] = '\0';
    }
    return strcmp(written.text, "-0") == 0 ? (number_t){"0"} : written;
}

static number_t place(double value)
{
    return number(value, 2);
}

/* Pixels in the units of the place. */
static number_t pixels(const yb_drawing_t *drawing, double value)
{
    return number(value / drawing->scale, 3);
}

/* Bytes of the character at `text`; 0: it is not UTF-8. */
static size_t utf8_bytes(const char *text)
{
    const unsigned char first = (unsigned char)*text;
    const size_t bytes = first < 0x80                    ? 1
                         : first >= 0xc2 && first < 0xe0 ? 2
                         : first >= 0xe0 && first < 0xf0 ? 3
                         : first >= 0xf0 && first < 0xf5 ? 4
                                                         : 0;
    for (size_t i = 1; i < bytes; i++)
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            return 0;
    return bytes;
}

enum {
    MOST_TEXT = 512
};

/* Names of files may hold anything; XML and Cairo want UTF-8 without control characters. */
static void clean(const char *text, char cleaned[MOST_TEXT])
{
    size_t at = 0;
    while (*text != '\0' && at + 5 < MOST_TEXT) {
        const size_t bytes = utf8_bytes(text);
        const bool good = bytes > 0 && (unsigned char)*text >= ' ';
        for (size_t i = 0; good && i < bytes; i++)
            cleaned[at++] = text[i];
        if (!good)
            cleaned[at++] = '?';
        text += bytes == 0 ? 1 : bytes;
    }
    cleaned[at] = '\0';
}

static void write_escaped(FILE *stream, const char *text)
{
    char cleaned[MOST_TEXT];
    clean(text, cleaned);
    for (const char *at = cleaned; *at != '\0'; at++) {
        if (*at == '&')
            fputs("&amp;", stream);
        else if (*at == '<')
            fputs("&lt;", stream);
        else if (*at == '>')
            fputs("&gt;", stream);
        else
            fputc(*at, stream);
    }
}

static bool begin_svg(yb_drawing_t *drawing, const yb_page_t *page)
{
    drawing->svg = fopen(yb_output_path(drawing->output), "w");
    if (drawing->svg == NULL)
        return false;
    const number_t width = place(page->width), height = place(page->height);
    fprintf(drawing->svg,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%s\" height=\"%s\" "
            "viewBox=\"0 0 %s %s\" font-family=\"sans-serif\" stroke-linejoin=\"round\">\n<title>",
            width.text, height.text, width.text, height.text);
    write_escaped(drawing->svg, page->title);
    fputs("</title>\n<path class=\"page\" fill=\"#ffffff\" d=\"M0 0H", drawing->svg);
    fprintf(drawing->svg, "%sV%sH0z\"/>\n", width.text, height.text);
    return true;
}

static bool begin_png(yb_drawing_t *drawing, const yb_page_t *page)
{
    cairo_surface_t *surface = cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, (int)lround(page->width), (int)lround(page->height));
    drawing->cairo = cairo_create(surface);
    cairo_surface_destroy(surface); /* the context keeps it */
    cairo_set_source_rgb(drawing->cairo, 1, 1, 1);
    cairo_paint(drawing->cairo);
    cairo_set_line_join(drawing->cairo, CAIRO_LINE_JOIN_ROUND);
    return cairo_status(drawing->cairo) == CAIRO_STATUS_SUCCESS;
}

yb_drawing_t *yb_drawing_open(const yb_page_t *page, yb_error_t *error)
{
    yb_output_t *output = yb_output_open(page->path, page->force, error);
    if (output == NULL)
        return NULL;
    yb_drawing_t *drawing = calloc(1, sizeof(*drawing));
    if (drawing != NULL) {
        *drawing = (yb_drawing_t){.output = output, .target = page->path, .scale = 1};
        if (page->png ? begin_png(drawing, page) : begin_svg(drawing, page))
            return drawing;
        if (drawing->cairo != NULL)
            cairo_destroy(drawing->cairo);
    }
    yb_error_set(error, "cannot write %s: %s", page->path, strerror(ENOMEM));
    yb_output_close(output);
    free(drawing);
    return NULL;
}

static void set_colour(cairo_t *cairo, int32_t colour)
{
    cairo_set_source_rgb(cairo, (colour >> 16 & 255) / 255.0, (colour >> 8 & 255) / 255.0,
                         (colour & 255) / 255.0);
}

/* Cairo paints each line by itself, or it would look for crossings in all of them. */
static void paint(yb_drawing_t *drawing)
{
    cairo_t *cairo = drawing->cairo;
    const yb_ink_t *ink = &drawing->ink;
    cairo_set_antialias(cairo, ink->crisp ? CAIRO_ANTIALIAS_NONE : CAIRO_ANTIALIAS_DEFAULT);
    cairo_set_line_width(cairo, ink->width);
    if (ink->fill != YB_NO_INK) {
        set_colour(cairo, ink->fill);
        cairo_fill_preserve(cairo);
    }
    if (ink->stroke != YB_NO_INK) {
        set_colour(cairo, ink->stroke);
        cairo_stroke_preserve(cairo);
    }
    cairo_new_path(cairo);
}

static void end_path(yb_drawing_t *drawing)
{
    if (drawing->in_path && drawing->cairo != NULL)
        paint(drawing);
    else if (drawing->in_path)
        fputs("\"/>\n", drawing->svg);
    drawing->in_path = false;
}

static void end_group(yb_drawing_t *drawing)
{
    if (drawing->grouped)
        fputs("</g>\n", drawing->svg);
    drawing->grouped = false;
}

static void begin_group(yb_drawing_t *drawing)
{
    const bool placed = drawing->scale != 1 || drawing->left != 0 || drawing->top != 0;
    if (!drawing->grouped && placed)
        fprintf(drawing->svg, "<g transform=\"translate(%s %s) scale(%s)\">\n",
                place(drawing->left).text, place(drawing->top).text,
                number(drawing->scale, 6).text);
    drawing->grouped = placed;
}

void yb_drawing_place(yb_drawing_t *drawing, double left, double top, double scale)
{
    end_path(drawing);
    if (drawing->cairo == NULL)
        end_group(drawing);
    drawing->left = left;
    drawing->top = top;
    drawing->scale = scale;
}

static void write_colour(char text[8], int32_t colour)
{
    if (colour == YB_NO_INK)
        snprintf(text, 8, "none");
    else
        snprintf(text, 8, "#%06x", (unsigned)colour & 0xffffffU);
}

void yb_drawing_begin(yb_drawing_t *drawing, const char *name, yb_ink_t ink)
{
    end_path(drawing);
    drawing->ink = ink;
    if (drawing->cairo != NULL)
        return;
    char fill[8], stroke[8], outline[96] = "";
    write_colour(fill, ink.fill);
    write_colour(stroke, ink.stroke);
    if (ink.stroke != YB_NO_INK)
        snprintf(outline, sizeof(outline), " stroke=\"%s\" stroke-width=\"%s\"", stroke,
                 pixels(drawing, ink.width).text);
    snprintf(drawing->head, sizeof(drawing->head), "<path class=\"%s\" fill=\"%s\"%s%s d=\"", name,
             fill, outline, ink.crisp ? " shape-rendering=\"crispEdges\"" : "");
}

/* The beginning of the first line, or of one more. */
static void next_line(yb_drawing_t *drawing)
{
    if (drawing->cairo != NULL) {
        if (drawing->in_path)
            paint(drawing);
    } else {
        begin_group(drawing);
        fputs(drawing->in_path ? "\n" : drawing->head, drawing->svg);
    }
    drawing->in_path = true;
}

static double page_x(const yb_drawing_t *drawing, double x)
{
    return drawing->left + x * drawing->scale;
}

static double page_y(const yb_drawing_t *drawing, double y)
{
    return drawing->top + y * drawing->scale;
}

void yb_drawing_move(yb_drawing_t *drawing, double x, double y)
{
    next_line(drawing);
    if (drawing->cairo != NULL)
        cairo_move_to(drawing->cairo, page_x(drawing, x), page_y(drawing, y));
    else
        fprintf(drawing->svg, "M%s %s", place(x).text, place(y).text);
}

void yb_drawing_line(yb_drawing_t *drawing, double x, double y)
{
    if (drawing->cairo != NULL)
        cairo_line_to(drawing->cairo, page_x(drawing, x), page_y(drawing, y));
    else
        fprintf(drawing->svg, " %s %s", place(x).text, place(y).text);
}

void yb_drawing_loop(yb_drawing_t *drawing)
{
    if (drawing->cairo != NULL)
        cairo_close_path(drawing->cairo);
    else
        fputc('z', drawing->svg);
}

void yb_drawing_dot(yb_drawing_t *drawing, double x, double y, double radius)
{
    next_line(drawing);
    if (drawing->cairo != NULL) {
        cairo_arc(drawing->cairo, page_x(drawing, x), page_y(drawing, y), radius, 0,
                  2 * acos(-1.0));
        return;
    }
    const number_t r = pixels(drawing, radius), wide = pixels(drawing, 2 * radius);
    fprintf(drawing->svg, "M%s %sa%s %s 0 1 0 %s 0a%s %s 0 1 0 -%s 0z",
            number(x - radius / drawing->scale, 3).text, place(y).text, r.text, r.text, wide.text,
            r.text, r.text, wide.text);
}

double yb_drawing_text_width(double size, const char *text)
{
    return 0.6 * size * (double)strlen(text);
}

static void paint_text(yb_drawing_t *drawing, const yb_label_t *label, const char *text)
{
    static const double share[] = {0, 0.5, 1};
    cairo_t *cairo = drawing->cairo;
    cairo_text_extents_t extents;
    char cleaned[MOST_TEXT];
    clean(text, cleaned);
    cairo_save(cairo);
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           label->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, label->size);
    cairo_text_extents(cairo, cleaned, &extents);
    cairo_translate(cairo, page_x(drawing, label->x), page_y(drawing, label->y));
    cairo_rotate(cairo, label->turned * acos(-1.0) / 180);
    cairo_set_antialias(cairo, CAIRO_ANTIALIAS_DEFAULT);
    cairo_move_to(cairo, -share[label->anchor] * extents.x_advance, 0);
    cairo_text_path(cairo, cleaned);
    if (label->halo != YB_NO_INK) {
        set_colour(cairo, label->halo);
        cairo_set_line_width(cairo, 3);
        cairo_stroke_preserve(cairo);
    }
    set_colour(cairo, label->colour);
    cairo_fill(cairo);
    cairo_restore(cairo);
}

void yb_drawing_text(yb_drawing_t *drawing, const yb_label_t *label, const char *text)
{
    static const char *const anchor[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    end_path(drawing);
    if (drawing->cairo != NULL) {
        paint_text(drawing, label, text);
        return;
    }
    end_group(drawing); /* browsers want letters in pixels */
    FILE *svg = drawing->svg;
    char colour[8];
    write_colour(colour, label->colour);
    const number_t x = place(page_x(drawing, label->x)), y = place(page_y(drawing, label->y));
    fprintf(svg, "<text x=\"%s\" y=\"%s\" font-size=\"%s\" fill=\"%s\"%s", x.text, y.text,
            place(label->size).text, colour, anchor[label->anchor]);
    if (label->bold)
        fputs(" font-weight=\"bold\"", svg);
    if (label->turned != 0)
        fprintf(svg, " transform=\"rotate(%s %s %s)\"", number(label->turned, 1).text, x.text,
                y.text);
    if (label->halo != YB_NO_INK) {
        write_colour(colour, label->halo);
        fprintf(svg, " paint-order=\"stroke\" stroke=\"%s\" stroke-width=\"3\"", colour);
    }
    fputc('>', svg);
    write_escaped(svg, text);
    fputs("</text>\n", svg);
}

/* What was wrong, or NULL. */
static const char *end_svg(yb_drawing_t *drawing)
{
    end_group(drawing);
    fputs("</svg>\n", drawing->svg);
    const bool good = ferror(drawing->svg) == 0;
    return fclose(drawing->svg) == 0 && good ? NULL : strerror(errno);
}

static const char *end_png(yb_drawing_t *drawing)
{
    cairo_status_t status = cairo_status(drawing->cairo);
    if (status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_write_to_png(cairo_get_target(drawing->cairo),
                                            yb_output_path(drawing->output));
    cairo_destroy(drawing->cairo);
    return status == CAIRO_STATUS_SUCCESS ? NULL : cairo_status_to_string(status);
}

bool yb_drawing_close(yb_drawing_t *drawing, yb_error_t *error)
{
    end_path(drawing);
    const char *wrong = drawing->cairo != NULL ? end_png(drawing) : end_svg(drawing);
    if (wrong != NULL)
        yb_error_set(error, "cannot write %s: %s", drawing->target, wrong);
    const bool good = wrong == NULL && yb_output_commit(drawing->output, error);
    yb_output_close(drawing->output);
    free(drawing);
    return good;
}
