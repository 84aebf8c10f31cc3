/* Contour lines from drawn sheets: each test draws the sheet that it reads, by Cairo. */
#include "scan.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <cairo.h>
#include <gdal.h>
#include <math.h>

#include "rng.h"

#define TURN 6.283185307179586

static const yb_scan_scale_t scale = {.base_m = 100, .interval_m = 20, .cell_m = 1};

/* A sheet being drawn. */
typedef struct {
    cairo_surface_t *surface;
    cairo_t *pen;
    int width, height;
} sheet_t;

static sheet_t sheet_new(int width, int height, double thickness)
{
    sheet_t sheet = {.width = width, .height = height};
    sheet.surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    sheet.pen = cairo_create(sheet.surface);
    cairo_set_source_rgb(sheet.pen, 1, 1, 1);
    cairo_paint(sheet.pen);
    cairo_set_source_rgb(sheet.pen, 0.1, 0.1, 0.2);
    cairo_set_line_width(sheet.pen, thickness);
    return sheet;
}

static const char *sheet_save(sheet_t *sheet)
{
    const char *path = scratch_path("sheet.png");
    assert_int_equal(cairo_surface_write_to_png(sheet->surface, path), CAIRO_STATUS_SUCCESS);
    cairo_destroy(sheet->pen);
    cairo_surface_destroy(sheet->surface);
    return path;
}

static yb_lines_t *read_scaled(sheet_t *sheet, yb_scan_scale_t how)
{
    yb_error_t error;
    yb_lines_t *lines = yb_lines_from_scan(sheet_save(sheet), &how, &error);
    if (lines == NULL)
        fail_msg("%s", error.text);
    return lines;
}

static yb_lines_t *read_sheet(sheet_t *sheet)
{
    return read_scaled(sheet, scale);
}

static void expect_error(const char *path, const char *sentence)
{
    yb_error_t error;
    yb_lines_t *lines = yb_lines_from_scan(path, &scale, &error);
    if (lines != NULL)
        fail_msg("%d lines were found, expected \"%s\"", lines->count, sentence);
    if (strstr(error.text, sentence) == NULL)
        fail_msg("\"%s\" instead of \"%s\"", error.text, sentence);
}

/* A ring of some radius, bent in and out `lobes` times. */
typedef struct {
    double x, y, radius;
    int lobes;
} ring_t;

static double ring_radius(ring_t ring, double angle)
{
    return ring.radius * (1 + (ring.lobes > 0 ? 0.12 * sin(ring.lobes * angle) : 0));
}

static yb_place_t ring_place(ring_t ring, double angle)
{
    double radius = ring_radius(ring, angle);
    return (yb_place_t){ring.x + radius * cos(angle), ring.y + radius * sin(angle)};
}

static void draw_arc(const sheet_t *sheet, ring_t ring, double from, double to)
{
    for (int i = 0; i <= 400; i++) {
        yb_place_t at = ring_place(ring, from + (to - from) * i / 400);
        cairo_line_to(sheet->pen, at.x_m, at.y_m);
    }
    cairo_stroke(sheet->pen);
}

static void draw_ring(const sheet_t *sheet, ring_t ring)
{
    draw_arc(sheet, ring, 0, TURN);
}

static void draw_dot(const sheet_t *sheet, double x, double y, double radius)
{
    cairo_arc(sheet->pen, x, y, radius, 0, TURN);
    cairo_fill(sheet->pen);
}

static void draw_line(const sheet_t *sheet, double x0, double y0, double x1, double y1)
{
    cairo_move_to(sheet->pen, x0, y0);
    cairo_line_to(sheet->pen, x1, y1);
    cairo_stroke(sheet->pen);
}

static double away(const yb_line_t *line, yb_place_t at)
{
    double nearest = HUGE_VAL;
    for (int i = 0; i < (line->closed ? line->count : line->count - 1); i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[(i + 1) % line->count];
        double x = b.x_m - a.x_m;
        double y = b.y_m - a.y_m;
        double square = x * x + y * y;
        double along = square > 0 ? ((at.x_m - a.x_m) * x + (at.y_m - a.y_m) * y) / square : 0;
        along = fmin(fmax(along, 0), 1);
        nearest = fmin(nearest, hypot(a.x_m + along * x - at.x_m, a.y_m + along * y - at.y_m));
    }
    return nearest;
}

/* The line of a set, closed, that follows a ring within `most` pixels both ways; its height. */
static double height_of_ring(const yb_lines_t *lines, ring_t ring, double most)
{
    double least = HUGE_VAL;
    for (int i = 0; i < lines->count; i++) {
        const yb_line_t *line = &lines->line[i];
        double worst = 0;
        for (int k = 0; k < 400 && line->closed; k++) {
            yb_place_t at = ring_place(ring, TURN * k / 400);
            at.y_m = lines->depth_m - at.y_m;
            worst = fmax(worst, away(line, at));
        }
        for (int k = 0; k < line->count && line->closed; k++) {
            double x = line->place[k].x_m - ring.x;
            double y = lines->depth_m - line->place[k].y_m - ring.y;
            worst = fmax(worst, fabs(hypot(x, y) - ring_radius(ring, atan2(y, x))));
        }
        if (line->closed && worst <= most)
            return line->height_m;
        if (line->closed)
            least = fmin(least, worst);
    }
    fail_msg("no line follows the ring of %g at %g, %g: the nearest is %g away", ring.radius,
             ring.x, ring.y, least);
    return 0;
}

static int count_kind(const yb_lines_t *lines, bool spots, bool closed)
{
    int count = 0;
    for (int i = 0; i < lines->count; i++)
        count += (lines->line[i].count == 1) == spots && lines->line[i].closed == closed;
    return count;
}

static void test_rings_of_any_thickness(void **state)
{
    (void)state;
    const double thickness[] = {1, 2, 3, 5, 7, 12};
    for (int i = 0; i < 6; i++) {
        ring_t outer = {200, 170, 120, 5};
        ring_t inner = {190, 180, 60, 3};
        sheet_t sheet = sheet_new(400, 340, thickness[i]);
        draw_ring(&sheet, outer);
        draw_ring(&sheet, inner);
        yb_lines_t *lines = read_sheet(&sheet);
        assert_int_equal(lines->count, 2);
        assert_true(lines->width_m == 400 && lines->depth_m == 340);
        assert_true(height_of_ring(lines, outer, 1.5) == 100);
        assert_true(height_of_ring(lines, inner, 1.5) == 120);
        yb_lines_free(lines);
    }
}

static void test_small_rings_are_lines(void **state)
{
    (void)state;
    for (int radius = 5; radius <= 12; radius++) {
        ring_t ring = {50.3, 40.7, radius, 0};
        sheet_t sheet = sheet_new(100, 80, 2);
        draw_ring(&sheet, ring);
        yb_lines_t *lines = read_sheet(&sheet);
        assert_int_equal(lines->count, 1);
        assert_true(height_of_ring(lines, ring, 1) == 100);
        yb_lines_free(lines);
    }
}

static void test_gaps_are_closed(void **state)
{
    (void)state;
    const double thickness[] = {1, 3, 7, 12};
    for (int i = 0; i < 4; i++) {
        ring_t ring = {250, 230, 180, 4};
        sheet_t sheet = sheet_new(500, 460, thickness[i]);
        double gap = (2 * thickness[i] + 3) / ring.radius;
        for (int part = 0; part < 5; part++)
            draw_arc(&sheet, ring, TURN * part / 5 + gap / 2, TURN * (part + 1) / 5 - gap / 2);
        yb_lines_t *lines = read_sheet(&sheet);
        assert_int_equal(lines->count, 1);
        /* What a wide gap hides is a guess. */
        height_of_ring(lines, ring, 1.5 + thickness[i] / 20);
        yb_lines_free(lines);
    }
}

static void test_gaps_between_neighbours(void **state)
{
    (void)state;
    ring_t outer = {150, 150, 100, 0};
    ring_t inner = {150, 150, 90, 0};
    sheet_t sheet = sheet_new(300, 300, 3);
    draw_arc(&sheet, outer, 0.05, TURN - 0.05);
    draw_arc(&sheet, inner, 0.06, TURN - 0.04);
    yb_lines_t *lines = read_sheet(&sheet);
    assert_int_equal(lines->count, 2);
    assert_true(height_of_ring(lines, outer, 1.5) == 100);
    assert_true(height_of_ring(lines, inner, 1.5) == 120);
    yb_lines_free(lines);
}

/* A shadow from edge to edge, a stain, and grain. */
static void test_uneven_paper(void **state)
{
    (void)state;
    ring_t outer = {200, 170, 120, 5};
    ring_t inner = {190, 180, 60, 3};
    sheet_t sheet = sheet_new(400, 340, 3);
    cairo_pattern_t *shadow = cairo_pattern_create_linear(0, 0, 400, 340);
    cairo_pattern_add_color_stop_rgb(shadow, 0, 1, 1, 0.9);
    cairo_pattern_add_color_stop_rgb(shadow, 1, 0.5, 0.48, 0.4);
    cairo_set_source(sheet.pen, shadow);
    cairo_paint(sheet.pen);
    cairo_pattern_destroy(shadow);
    cairo_set_source_rgba(sheet.pen, 0.5, 0.4, 0.2, 0.1);
    draw_dot(&sheet, 90, 80, 50);
    cairo_set_source_rgb(sheet.pen, 0.15, 0.15, 0.2);
    draw_ring(&sheet, outer);
    draw_ring(&sheet, inner);
    rng_t rng = {7};
    for (int i = 0; i < 60000; i++) {
        double grey = rng_range(&rng, 0, 1);
        double x = rng_range(&rng, 0, 399);
        double y = rng_range(&rng, 0, 339);
        cairo_set_source_rgba(sheet.pen, grey, grey, grey, 0.06);
        cairo_rectangle(sheet.pen, x, y, 1, 1);
        cairo_fill(sheet.pen);
    }
    yb_lines_t *lines = read_sheet(&sheet);
    assert_int_equal(lines->count, 2);
    assert_true(height_of_ring(lines, outer, 1.5) == 100);
    assert_true(height_of_ring(lines, inner, 1.5) == 120);
    yb_lines_free(lines);
}

static void test_two_peaks_and_their_marks(void **state)
{
    (void)state;
    ring_t around = {200, 150, 130, 0};
    ring_t west = {140, 150, 40, 3};
    ring_t east = {260, 150, 45, 2};
    ring_t top = {262, 152, 18, 0};
    sheet_t sheet = sheet_new(400, 300, 3);
    draw_ring(&sheet, around);
    draw_ring(&sheet, west);
    draw_ring(&sheet, east);
    draw_ring(&sheet, top);
    draw_dot(&sheet, 262, 152, 5);
    draw_line(&sheet, 132, 142, 148, 158);
    draw_line(&sheet, 132, 158, 148, 142);
    cairo_move_to(sheet.pen, 200, 60);
    cairo_line_to(sheet.pen, 209, 75);
    cairo_line_to(sheet.pen, 191, 75);
    cairo_fill(sheet.pen);
    draw_dot(&sheet, 30, 30, 4);
    yb_lines_t *lines = read_scaled(&sheet, (yb_scan_scale_t){1000, 50, 10});
    assert_int_equal(count_kind(lines, false, true), 4);
    assert_int_equal(count_kind(lines, true, false), 4);
    assert_true(lines->width_m == 4000 && lines->depth_m == 3000);
    const double expected[4][3] = {
        {30, 30, 975}, {200, 70, 1025}, {140, 150, 1075}, {262, 152, 1125}};
    for (int i = 0; i < 4; i++) {
        bool found = false;
        for (int k = 0; k < lines->count; k++)
            if (lines->line[k].count == 1 &&
                hypot(lines->line[k].place[0].x_m / 10 - expected[i][0],
                      300 - lines->line[k].place[0].y_m / 10 - expected[i][1]) < 1.5)
                found = lines->line[k].height_m == expected[i][2];
        assert_true(found);
    }
    yb_lines_free(lines);
}

static bool on_frame(const yb_lines_t *lines, yb_place_t at)
{
    return at.x_m == 0 || at.y_m == 0 || at.x_m == lines->width_m || at.y_m == lines->depth_m;
}

/* A slope that rises to the north, with a hill on it, drawn to the edge or nearly so. */
static void test_lines_from_side_to_side(void **state)
{
    (void)state;
    for (int short_of = 0; short_of <= 4; short_of += 2) {
        sheet_t sheet = sheet_new(300, 260, 3);
        for (int i = 0; i < 3; i++)
            draw_line(&sheet, short_of, 150 - 40 * i, 300 - short_of, 130 - 40 * i);
        draw_ring(&sheet, (ring_t){150, 26, 12, 0});
        yb_lines_t *lines = read_sheet(&sheet);
        assert_int_equal(lines->count, 4);
        assert_true(height_of_ring(lines, (ring_t){150, 26, 12, 0}, 1.5) == 160);
        int open = 0;
        for (int i = 0; i < lines->count; i++) {
            const yb_line_t *line = &lines->line[i];
            if (line->closed)
                continue;
            open++;
            assert_true(on_frame(lines, line->place[0]));
            assert_true(on_frame(lines, line->place[line->count - 1]));
            double step = round((line->height_m - 100) / 20);
            for (int k = 0; k < line->count; k++)
                assert_true(fabs(260 - line->place[k].y_m -
                                 (150 - 40 * step - line->place[k].x_m / 15)) < 1.5);
        }
        assert_int_equal(open, 3);
        yb_lines_free(lines);
    }
}

/* Corners cut off: the land between them has most of the frame. */
static void test_corners_rise(void **state)
{
    (void)state;
    sheet_t sheet = sheet_new(300, 300, 2);
    draw_line(&sheet, 80, 0, 0, 70);
    draw_line(&sheet, 40, 0, 0, 35);
    draw_line(&sheet, 230, 300, 300, 210);
    draw_ring(&sheet, (ring_t){150, 150, 30, 0});
    yb_lines_t *lines = read_sheet(&sheet);
    assert_int_equal(lines->count, 4);
    int high = 0;
    for (int i = 0; i < lines->count; i++) {
        assert_true(lines->line[i].height_m == 100 || lines->line[i].height_m == 120);
        high += lines->line[i].height_m == 120;
    }
    assert_int_equal(high, 1);
    yb_lines_free(lines);
}

static void test_drawn_border(void **state)
{
    (void)state;
    ring_t ring = {200, 150, 60, 4};
    sheet_t sheet = sheet_new(400, 300, 3);
    cairo_rectangle(sheet.pen, 20, 15, 350, 270);
    cairo_stroke(sheet.pen);
    draw_ring(&sheet, ring);
    draw_line(&sheet, 20, 260, 370, 240);
    yb_lines_t *lines = read_sheet(&sheet);
    assert_int_equal(lines->count, 2);
    assert_int_equal(count_kind(lines, false, true), 1);
    assert_true(fabs(lines->width_m - 350) < 8 && fabs(lines->depth_m - 270) < 8);
    for (int i = 0; i < lines->count; i++)
        assert_true(lines->line[i].height_m == 100);
    yb_lines_free(lines);
}

static void test_crooked_border(void **state)
{
    (void)state;
    ring_t ring = {400, 300, 150, 4};
    sheet_t sheet = sheet_new(800, 600, 3);
    cairo_move_to(sheet.pen, 20, 15);
    cairo_line_to(sheet.pen, 780, 28);
    cairo_line_to(sheet.pen, 770, 585);
    cairo_line_to(sheet.pen, 10, 572);
    cairo_close_path(sheet.pen);
    cairo_stroke(sheet.pen);
    draw_ring(&sheet, ring);
    yb_lines_t *lines = read_sheet(&sheet);
    assert_int_equal(lines->count, 1);
    assert_true(height_of_ring(lines, ring, 1.5) == 100);
    yb_lines_free(lines);
}

/* Stored in another way: grey, grey with alpha, colours of a palette, one bit. */
static void test_any_kind_of_png(void **state)
{
    (void)state;
    enum {
        SIDE = 120
    };
    for (int kind = 0; kind < 4; kind++) {
        static uint8_t pixel[2][SIDE * SIDE];
        for (int i = 0; i < SIDE * SIDE; i++) {
            bool ink = fabs(hypot(i % SIDE - 60, i / SIDE - 60.0) - 40) < 1.6;
            pixel[0][i] = kind == 1 || (ink && kind < 2) ? 0 : kind < 2 ? 250 : ink;
            pixel[1][i] = ink ? 255 : 0;
        }
        GDALDatasetH memory = GDALCreate(GDALGetDriverByName("MEM"), "", SIDE, SIDE,
                                         kind == 1 ? 2 : 1, GDT_Byte, NULL);
        for (int band = 0; band < (kind == 1 ? 2 : 1); band++)
            assert_int_equal(GDALRasterIO(GDALGetRasterBand(memory, band + 1), GF_Write, 0, 0, SIDE,
                                          SIDE, pixel[band], SIDE, SIDE, GDT_Byte, 0, 0),
                             CE_None);
        GDALColorTableH colours = GDALCreateColorTable(GPI_RGB);
        const GDALColorEntry paper = {240, 230, 200, 255};
        const GDALColorEntry brown = {110, 60, 20, 255};
        GDALSetColorEntry(colours, 0, &paper);
        GDALSetColorEntry(colours, 1, &brown);
        if (kind >= 2)
            GDALSetRasterColorTable(GDALGetRasterBand(memory, 1), colours);
        char bits[] = "NBITS=1";
        char *options[] = {bits, NULL};
        const char *path = scratch_path("kind.png");
        GDALDatasetH picture = GDALCreateCopy(GDALGetDriverByName("PNG"), path, memory, 0,
                                              kind == 3 ? options : NULL, NULL, NULL);
        assert_non_null(picture);
        GDALClose(picture);
        GDALClose(memory);
        GDALDestroyColorTable(colours);
        assert_true(yb_scan_is(path));
        yb_error_t error;
        yb_lines_t *lines = yb_lines_from_scan(path, &scale, &error);
        if (lines == NULL)
            fail_msg("kind %d: %s", kind, error.text);
        height_of_ring(lines, (ring_t){60.5, 60.5, 40, 0}, 1.5);
        yb_lines_free(lines);
    }
}

static void test_heights_are_no_scan(void **state)
{
    (void)state;
    scratch_raster_bare(scratch_path("bare.png"), 40, 40, relief_cone);
    assert_false(yb_scan_is(scratch_path("bare.png")));
    scratch_raster(scratch_path("cone.tif"), 40, 40, relief_cone);
    assert_false(yb_scan_is(scratch_path("cone.tif")));
    assert_false(yb_scan_is(scratch_path("none.png")));
    sheet_t sheet = sheet_new(40, 40, 2);
    const char *path = sheet_save(&sheet);
    assert_true(yb_scan_is(path));
    scratch_text(scratch_path("sheet.pgw"), "30\n0\n0\n-30\n500000\n5000000\n");
    assert_false(yb_scan_is(path));
    remove(scratch_path("sheet.pgw"));
}

static void test_lines_that_meet(void **state)
{
    (void)state;
    sheet_t sheet = sheet_new(300, 200, 3);
    draw_ring(&sheet, (ring_t){100, 100, 60, 0});
    draw_line(&sheet, 160, 100, 299, 100);
    expect_error(sheet_save(&sheet), "meet at pixel (1");
    sheet = sheet_new(400, 200, 3);
    for (int i = 0; i < 4; i++)
        draw_ring(&sheet, (ring_t){70 + 80 * i, 100, 50, 0});
    expect_error(sheet_save(&sheet), "and more");
}

static void test_open_lines(void **state)
{
    (void)state;
    sheet_t sheet = sheet_new(300, 300, 3);
    for (int i = 0; i <= 800; i++) {
        double angle = 3 * TURN * i / 800;
        cairo_line_to(sheet.pen, 150 + (20 + 6 * angle) * cos(angle),
                      150 + (20 + 6 * angle) * sin(angle));
    }
    cairo_stroke(sheet.pen);
    expect_error(sheet_save(&sheet), "left open in the middle of the sheet, at pixel (");
    sheet = sheet_new(300, 300, 3);
    draw_arc(&sheet, (ring_t){150, 150, 80, 0}, 0, 0.9 * TURN);
    expect_error(sheet_save(&sheet), "left open");
}

static void test_nothing_to_read(void **state)
{
    (void)state;
    sheet_t sheet = sheet_new(100, 100, 3);
    expect_error(sheet_save(&sheet), "is blank");
    sheet = sheet_new(100, 100, 3);
    draw_dot(&sheet, 50, 50, 8);
    expect_error(sheet_save(&sheet), "no line of");
    sheet = sheet_new(15, 100, 1);
    expect_error(sheet_save(&sheet), "at least 16 x 16");
    sheet = sheet_new(100, 100, 1);
    cairo_paint(sheet.pen);
    cairo_set_source_rgb(sheet.pen, 1, 1, 1);
    draw_ring(&sheet, (ring_t){50, 50, 30, 0});
    expect_error(sheet_save(&sheet), "dark on light");
    expect_error(scratch_path("none.png"), "cannot read");
    scratch_text(scratch_path("text.png"), "no picture");
    expect_error(scratch_path("text.png"), "cannot read");
    sheet = sheet_new(9000, 7200, 1);
    expect_error(sheet_save(&sheet), "more than 64 million");
}

static void test_half_a_file(void **state)
{
    (void)state;
    static char bytes[65536];
    sheet_t sheet = sheet_new(200, 200, 3);
    draw_ring(&sheet, (ring_t){100, 100, 60, 0});
    FILE *file = fopen(sheet_save(&sheet), "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof(bytes), file);
    fclose(file);
    file = fopen(scratch_path("half.png"), "wb");
    assert_non_null(file);
    fwrite(bytes, 1, size / 2, file);
    fclose(file);
    expect_error(scratch_path("half.png"), "cannot read");
}

static void test_heights_out_of_reach(void **state)
{
    (void)state;
    sheet_t sheet = sheet_new(100, 100, 3);
    draw_ring(&sheet, (ring_t){50, 50, 30, 0});
    yb_scan_scale_t high = {.base_m = 40000, .interval_m = 20};
    yb_error_t error;
    assert_null(yb_lines_from_scan(sheet_save(&sheet), &high, &error));
    assert_non_null(strstr(error.text, "no map is so high"));
}

/* The sheet of the examples: a hill of two summits with gaps in its lines, a slope in a corner. */
static void test_example(void **state)
{
    (void)state;
    yb_error_t error;
    const double expected[] = {100, 100, 120, 120, 140, 140, 160,
                               180, 200, 220, 220, 230, 240, 250};
    yb_lines_t *lines = yb_lines_from_scan(YB_EXAMPLES "/sheet.png", &scale, &error);
    if (lines == NULL)
        fail_msg("%s", error.text);
    assert_int_equal(lines->count, 14);
    assert_int_equal(count_kind(lines, false, false), 3);
    assert_int_equal(count_kind(lines, true, false), 2);
    for (int i = 0; i < 14; i++) {
        int lower = 0;
        int level = 0;
        for (int k = 0; k < 14; k++) {
            lower += lines->line[k].height_m < expected[i];
            level += lines->line[k].height_m == expected[i];
        }
        assert_true(lower <= i && i < lower + level);
    }
    yb_lines_free(lines);
}

/* Dots, dashes, blocks and scribbles of any density: an error or lines, and soon. */
static void test_noise(void **state)
{
    (void)state;
    rng_t rng = {3};
    int read = 0;
    for (int i = 0; i < 120; i++) {
        int side = rng_range(&rng, 16, 215);
        int strokes = 1 << rng_range(&rng, 0, 10);
        sheet_t sheet = sheet_new(side, side + 7, rng_range(&rng, 1, 6));
        for (int k = 0; k < strokes; k++) {
            double x = side * rng_unit(&rng);
            double y = side * rng_unit(&rng);
            double length = (2 << i % 7) * rng_unit(&rng);
            double angle = TURN * rng_unit(&rng);
            if (i % 3 == 0)
                draw_ring(&sheet, (ring_t){x, y, length, 3});
            else
                draw_line(&sheet, x, y, x + length * cos(angle), y + length * sin(angle));
        }
        yb_error_t error = {""};
        yb_lines_t *lines = yb_lines_from_scan(sheet_save(&sheet), &scale, &error);
        assert_true(lines != NULL || error.text[0] != '\0');
        read += lines != NULL;
        for (int k = 0; lines != NULL && k < lines->count; k++)
            assert_true(lines->line[k].closed || lines->line[k].count == 1 ||
                        on_frame(lines, lines->line[k].place[0]));
        yb_lines_free(lines);
    }
    assert_true(read > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rings_of_any_thickness),
        cmocka_unit_test(test_small_rings_are_lines),
        cmocka_unit_test(test_gaps_are_closed),
        cmocka_unit_test(test_gaps_between_neighbours),
        cmocka_unit_test(test_uneven_paper),
        cmocka_unit_test(test_two_peaks_and_their_marks),
        cmocka_unit_test(test_lines_from_side_to_side),
        cmocka_unit_test(test_corners_rise),
        cmocka_unit_test(test_drawn_border),
        cmocka_unit_test(test_crooked_border),
        cmocka_unit_test(test_any_kind_of_png),
        cmocka_unit_test(test_heights_are_no_scan),
        cmocka_unit_test(test_lines_that_meet),
        cmocka_unit_test(test_open_lines),
        cmocka_unit_test(test_nothing_to_read),
        cmocka_unit_test(test_half_a_file),
        cmocka_unit_test(test_heights_out_of_reach),
        cmocka_unit_test(test_example),
        cmocka_unit_test(test_noise),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
