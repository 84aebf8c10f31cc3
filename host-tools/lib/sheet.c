#include "sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <cairo.h>

#include "relief_picture.h"
#include "still.h"

enum {
    PANEL_WIDTH = 420,
    PANEL_HEIGHT = 340,
    GAP = 20,
    TITLE = 44,
    CAPTION = 24,
    FOOT = 64,
    ACROSS = 3,
    DOWN = 2,
    WIDTH = ACROSS * (PANEL_WIDTH + GAP) + GAP,
    HEIGHT = TITLE + DOWN * (CAPTION + PANEL_HEIGHT + GAP) + FOOT
};

typedef struct {
    cairo_t *cairo;
    const yb_code_file_t *file;
    const yb_comparison_t *comparison;
    const yb_fidelity_t *fidelity;
    double left, top;      /* of the panel that is being drawn */
    double pixels_a_metre; /* of its plan */
    double plan_left, plan_bottom;
} page_t;

static void write_text(const page_t *page, double x, double y, double size, const char *text)
{
    cairo_set_source_rgb(page->cairo, 0, 0, 0);
    cairo_set_font_size(page->cairo, size);
    cairo_move_to(page->cairo, x, y);
    cairo_show_text(page->cairo, text);
}

static void begin_panel(page_t *page, int column, int row, const char *caption)
{
    const yb_comparison_t *comparison = page->comparison;
    page->left = GAP + column * (PANEL_WIDTH + GAP);
    page->top = TITLE + CAPTION + row * (CAPTION + PANEL_HEIGHT + GAP);
    page->pixels_a_metre =
        fmin(PANEL_WIDTH / comparison->east_m, PANEL_HEIGHT / comparison->north_m);
    page->plan_left = page->left + (PANEL_WIDTH - comparison->east_m * page->pixels_a_metre) / 2;
    page->plan_bottom =
        page->top + PANEL_HEIGHT - (PANEL_HEIGHT - comparison->north_m * page->pixels_a_metre) / 2;
    write_text(page, page->left, page->top - 8, 14, caption);
}

/* Low contours brown, high ones red: which is which stays visible in black and white. */
static void set_ink(const page_t *page, double height_m)
{
    const yb_map_t *map = &page->file->map;
    const double low_m = yb_map_z_m(map, map->low_q8), high_m = yb_map_z_m(map, map->high_q8);
    const double share = high_m > low_m ? (height_m - low_m) / (high_m - low_m) : 0;
    cairo_set_source_rgb(page->cairo, 0.2 + 0.6 * fmin(fmax(share, 0), 1), 0.2, 0.1);
}

static void plan_to(const page_t *page, double x_m, double y_m, bool first)
{
    const double x = page->plan_left + x_m * page->pixels_a_metre;
    const double y = page->plan_bottom - y_m * page->pixels_a_metre;
    if (first)
        cairo_move_to(page->cairo, x, y);
    else
        cairo_line_to(page->cairo, x, y);
}

static void draw_frame(const page_t *page)
{
    const yb_comparison_t *comparison = page->comparison;
    plan_to(page, 0, 0, true);
    plan_to(page, comparison->east_m, 0, false);
    plan_to(page, comparison->east_m, comparison->north_m, false);
    plan_to(page, 0, comparison->north_m, false);
    cairo_close_path(page->cairo);
    cairo_set_source_rgb(page->cairo, 0, 0, 0);
    cairo_set_line_width(page->cairo, 1);
    cairo_stroke(page->cairo);
}

static void draw_lines(const page_t *page, const yb_isolines_t *lines)
{
    cairo_set_line_width(page->cairo, 1);
    for (size_t i = 0; i < lines->count; i++) {
        const yb_isoline_t *line = &lines->line[i];
        for (size_t k = 0; k < line->count; k++)
            plan_to(page, line->point[k].x, line->point[k].y, k == 0);
        if (line->closed)
            cairo_close_path(page->cairo);
        set_ink(page, line->height_m);
        cairo_stroke(page->cairo);
    }
    draw_frame(page);
}

static void draw_dot(const page_t *page, double x_m, double y_m, double radius)
{
    cairo_arc(page->cairo, page->plan_left + x_m * page->pixels_a_metre,
              page->plan_bottom - y_m * page->pixels_a_metre, radius, 0, 2 * acos(-1.0));
    cairo_fill(page->cairo);
}

/* Feature points as dots; spot heights as larger ones. */
static void draw_points(const page_t *page)
{
    const yb_map_t *map = &page->file->map;
    const yb_load_t *load = &page->file->load;
    const double step_m = yb_map_cell_m(map) / 256;
    for (uint16_t i = 0; i < load->contour_count; i++) {
        const yb_contour_t *contour = &load->contour[i];
        for (int k = 0; k < contour->count; k++) {
            const yb_vertex_t *vertex = &map->vertex[contour->first + k];
            set_ink(page, yb_map_z_m(map, vertex->z_q8));
            draw_dot(page, vertex->x_q8 * step_m, vertex->y_q8 * step_m,
                     contour->count == 1 ? 4 : 2.2);
        }
    }
}

/* Puts a picture of one or three channels at a place, `scale` times as large. */
static bool paint(const page_t *page, const yb_picture_t *picture, double x, double y, double scale)
{
    cairo_surface_t *image =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)picture->width, (int)picture->height);
    if (cairo_surface_status(image) != CAIRO_STATUS_SUCCESS) {
        cairo_surface_destroy(image);
        return false;
    }
    const uint8_t *sample = picture->samples;
    unsigned char *row = cairo_image_surface_get_data(image);
    for (uint32_t j = 0; j < picture->height; j++) {
        uint32_t *pixel = (uint32_t *)(void *)row;
        for (uint32_t i = 0; i < picture->width; i++, sample += picture->channels) {
            const int colour = picture->channels == 3;
            pixel[i] =
                (uint32_t)sample[0] << 16 | (uint32_t)sample[colour] << 8 | sample[2 * colour];
        }
        row += cairo_image_surface_get_stride(image);
    }
    cairo_surface_mark_dirty(image);
    cairo_save(page->cairo);
    cairo_translate(page->cairo, x, y);
    cairo_scale(page->cairo, scale, scale);
    cairo_set_source_surface(page->cairo, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(page->cairo), CAIRO_FILTER_NEAREST);
    cairo_paint(page->cairo);
    cairo_restore(page->cairo);
    cairo_surface_destroy(image);
    return true;
}

static bool draw_rebuilt(const page_t *page, const yb_view_t *view)
{
    const yb_screen_t screen = {.width = PANEL_WIDTH, .height = PANEL_HEIGHT, .format = YB_RGB565};
    yb_still_t still;
    yb_picture_t picture = {0};
    if (!yb_still_draw(&still, &page->file->map, view, &screen, 0, 0))
        return false;
    const bool good = yb_picture_from_frame(&picture, &screen, still.pixels) &&
                      paint(page, &picture, page->left, page->top, 1);
    yb_picture_free(&picture);
    yb_still_free(&still);
    return good;
}

static bool draw_real(const page_t *page, const yb_view_t *view)
{
    yb_picture_t picture;
    const bool good =
        yb_picture_init(&picture, PANEL_WIDTH, PANEL_HEIGHT, 3) &&
        yb_relief_picture_draw(&picture, &page->comparison->reference, &page->file->map, view) &&
        paint(page, &picture, page->left, page->top, 1);
    yb_picture_free(&picture);
    return good;
}

/* Red where the map is too high, blue where it is too low, full colour at twice the RMSE. */
static bool draw_difference(const page_t *page)
{
    const yb_comparison_t *comparison = page->comparison;
    const double full_m = fmax(2 * page->fidelity->smooth.rmse_m, 1e-9);
    yb_picture_t picture;
    if (!yb_picture_init(&picture, comparison->columns, comparison->rows, 3))
        return false;
    uint8_t *sample = picture.samples;
    for (uint32_t j = comparison->rows; j-- > 0;) {
        for (uint32_t i = 0; i < comparison->columns; i++, sample += 3) {
            const size_t at = (size_t)j * comparison->columns + i;
            const double error =
                (double)(comparison->smooth_m[at] - comparison->reference_m[at]) / full_m;
            const double pale = 255 * (1 - fmin(fabs(error), 1));
            sample[0] = (uint8_t)(error > 0 ? 255 : pale);
            sample[1] = (uint8_t)pale;
            sample[2] = (uint8_t)(error > 0 ? pale : 255);
        }
    }
    const double scale = page->pixels_a_metre * comparison->east_m / comparison->columns;
    const bool good = paint(page, &picture, page->plan_left,
                            page->plan_bottom - comparison->north_m * page->pixels_a_metre, scale);
    yb_picture_free(&picture);
    draw_frame(page);
    return good;
}

static void write_figures(const page_t *page, const char *name)
{
    const yb_fidelity_t *fidelity = page->fidelity;
    char text[256];
    write_text(page, GAP, TITLE - 14, 20, name);
    char code[64] = "no code";
    if (fidelity->bytes > 0)
        snprintf(code, sizeof(code), "F = %u bits   %zu bytes", (unsigned)fidelity->body_bits,
                 fidelity->bytes);
    snprintf(text, sizeof(text), "N = %u points   M = %u contours   %s   K = %.3f",
             (unsigned)fidelity->points, (unsigned)fidelity->contours, code, fidelity->k);
    write_text(page, GAP, HEIGHT - FOOT + 20, 16, text);
    snprintf(text, sizeof(text),
             "smooth: RMSE %.1f m (%.3f of the relief's deviation)   with detail: RMSE %.1f m "
             "(%.3f), slope error %.1f degrees",
             fidelity->smooth.rmse_m, fidelity->smooth.nrmse, fidelity->detail.rmse_m,
             fidelity->detail.nrmse, fidelity->detail.slope_deg);
    write_text(page, GAP, HEIGHT - FOOT + 44, 14, text);
}

static bool draw_panels(page_t *page, const yb_view_t *view)
{
    const yb_comparison_t *comparison = page->comparison;
    char caption[64];
    begin_panel(page, 0, 0, "given contours");
    draw_lines(page, &comparison->original);
    begin_panel(page, 1, 0, "feature polygons");
    draw_lines(page, &comparison->coded);
    draw_points(page);
    begin_panel(page, 2, 0, "extracted contours");
    draw_lines(page, &comparison->reproduced);
    begin_panel(page, 0, 1, "rebuilt relief");
    bool good = draw_rebuilt(page, view);
    begin_panel(page, 1, 1, "real relief");
    good = good && draw_real(page, view);
    snprintf(caption, sizeof(caption), "difference of height, blue to red: -%.0f to +%.0f m",
             2 * page->fidelity->smooth.rmse_m, 2 * page->fidelity->smooth.rmse_m);
    begin_panel(page, 2, 1, caption);
    return good && draw_difference(page);
}

static bool copy_page(yb_picture_t *sheet, cairo_surface_t *surface)
{
    cairo_surface_flush(surface);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    if (data == NULL || !yb_picture_init(sheet, WIDTH, HEIGHT, 3))
        return false;
    const int stride = cairo_image_surface_get_stride(surface);
    uint8_t *sample = sheet->samples;
    for (int j = 0; j < HEIGHT; j++) {
        const uint32_t *pixel = (const uint32_t *)(const void *)(data + (size_t)j * (size_t)stride);
        for (int i = 0; i < WIDTH; i++, sample += 3) {
            sample[0] = (uint8_t)(pixel[i] >> 16);
            sample[1] = (uint8_t)(pixel[i] >> 8);
            sample[2] = (uint8_t)pixel[i];
        }
    }
    return true;
}

bool yb_sheet_draw(yb_picture_t *sheet, const char *name, const yb_code_file_t *file,
                   const yb_comparison_t *comparison, const yb_fidelity_t *fidelity,
                   const yb_view_t *view)
{
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, HEIGHT);
    page_t page = {.cairo = cairo_create(surface),
                   .file = file,
                   .comparison = comparison,
                   .fidelity = fidelity};
    cairo_set_source_rgb(page.cairo, 1, 1, 1);
    cairo_paint(page.cairo);
    cairo_select_font_face(page.cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    write_figures(&page, name);
    const bool good = draw_panels(&page, view) && copy_page(sheet, surface);
    cairo_destroy(page.cairo);
    cairo_surface_destroy(surface);
    return good;
}
