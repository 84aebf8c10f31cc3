/* Rebuilds and draws the golden codes on a board, to be compared with the PC line by line.
 *
 * The console tells the lines of tests/golden/expected.txt that belong to the mesh and the frames,
 *
 *     CODE WHAT HASH
 *
 * in their order; the instructions of each lie between yb_mark_begin and yb_mark_end. Then
 *
 *     size NAME BYTES        a struct of the engine, or a band's memory
 *     stack NAME BYTES       the deepest the stack has been
 *     done
 *
 * tests/targets reads this, and ends the emulator.
 */
#include <yamabiko/rom.h>
#include <yamabiko/yamabiko.h>

#include "board.h"
#include "codes.h"
#include "fnv.h"
#include "report.h"
#include "views.h"

#if !defined(GOLDEN_ROWS) || !defined(GOLDEN_LARGE)
#error "GOLDEN_ROWS, GOLDEN_LARGE: the board's CMake file gives them"
#endif

typedef struct {
    const char *name;
    yb_screen_t screen;
    uint16_t rows;
} setting_t;

static const setting_t settings[] = {
    {"128x64", {128, 64, YB_GREY4}, GOLDEN_ROWS > 64 ? 64 : GOLDEN_ROWS},
#if GOLDEN_LARGE
    {"320x240", {320, 240, YB_RGB565}, GOLDEN_ROWS},
#endif
};

enum {
    SETTINGS = sizeof settings / sizeof settings[0],
    MOST_WIDTH = GOLDEN_LARGE ? 320 : 128,
    MOST_PITCH = GOLDEN_LARGE ? 640 : 64
};

static yb_map_t map;
static union {
    yb_load_t load;
    uint8_t shadow[YB_SHADOW_WORK(GOLDEN_SHADOW_SIDE)];
    struct {
        yb_frame_t frame;
        uint8_t pixels[(size_t)MOST_PITCH * GOLDEN_ROWS];
        uint8_t greys[(size_t)MOST_WIDTH / 2 * GOLDEN_ROWS];
    } drawing;
} work;

static uint32_t load_stack;
static uint32_t frame_stack[SETTINGS];

static void keep_most(uint32_t *most)
{
    uint32_t used = report_stack_used();
    if (used > *most)
        *most = used;
}

/* `screen` may be NULL. */
static void say_hash(const char *code, const char *what, const char *screen, uint64_t hash)
{
    report_text(code);
    report_text(" ");
    report_text(what);
    if (screen != NULL) {
        report_text("-");
        report_text(screen);
    }
    report_text(" ");
    for (int shift = 60; shift >= 0; shift -= 4)
        yb_board_write(NULL, "0123456789abcdef"[(uint8_t)(hash >> shift) & 15]);
    report_text("\r\n");
}

static yb_status_t load_code(const golden_code_t *code)
{
    yb_status_t status = YB_MORE;
    report_paint_stack();
    yb_mark_begin();
    yb_map_begin(&map, &work.load);
    for (size_t i = 0; i < code->count && status == YB_MORE; i++) {
        uint8_t byte = yb_rom_u8(&code->bytes[i]);
        status = yb_map_feed(&map, &work.load, &byte, 1);
    }
    yb_mark_end();
    keep_most(&load_stack);
    return status;
}

/* A triangle as one number, whichever of its corners is the first. */
static uint32_t triangle_key(yb_triangle_t t)
{
    const yb_index_t *v = map.triangle[t];
    int first = v[0] < v[1] && v[0] < v[2] ? 0 : v[1] < v[2] ? 1 : 2;
    return (uint32_t)v[first] << 16 | (uint32_t)v[(first + 1) % 3] << 8 | v[(first + 2) % 3];
}

/* The triangles in order, each found anew: there is no memory to sort them in. */
static uint64_t add_triangles(uint64_t hash)
{
    uint32_t last = 0; /* below every key: the corners of a triangle differ */
    for (yb_triangle_t n = 0; n < map.triangle_count; n++) {
        uint32_t next = UINT32_MAX;
        for (yb_triangle_t t = 0; t < map.triangle_count; t++) {
            uint32_t key = triangle_key(t);
            if (key > last && key < next)
                next = key;
        }
        hash = fnv_number(hash, next);
        last = next;
    }
    return hash;
}

/* As mesh_hash of tests/support. */
static uint64_t hash_mesh(void)
{
    uint64_t hash = fnv_number(FNV_START, map.vertex_count);
    for (size_t i = 0; i < map.vertex_count; i++) {
        const yb_vertex_t *v = &map.vertex[i];
        hash = fnv_number(fnv_number(hash, v->x_q8), v->y_q8);
        hash = fnv_number(hash, v->z_q8);
        hash = fnv_number(fnv_number(hash, v->gx_q11), v->gy_q11);
    }
    hash = add_triangles(fnv_number(hash, map.triangle_count));
    for (int c = 0; c < YB_LENGTH_CLASSES; c++)
        hash = fnv_number(hash, map.noise[c]);
    return hash;
}

static uint64_t draw(const yb_screen_t *screen, uint16_t rows, const yb_view_t *view)
{
    yb_frame_t *frame = &work.drawing.frame;
    yb_band_t band = {.rows = rows,
                      .pixels = work.drawing.pixels,
                      .pitch = yb_screen_pitch(screen),
                      .greys = work.drawing.greys};
    uint64_t hash = FNV_START;
    yb_frame_begin(frame, &map, view, screen);
    for (; band.y < screen->height; band.y = (uint16_t)(band.y + band.rows)) {
        yb_frame_band(frame, &band);
        /* The last band may stick out of the screen. */
        size_t left = screen->height - band.y;
        hash = fnv_bytes(hash, band.pixels, band.pitch * (left < rows ? left : rows));
    }
    return hash;
}

static void draw_views(const char *code)
{
    for (int which = 0; which < GOLDEN_VIEWS; which++) {
        yb_view_t view;
        golden_view_set(which, &view, &map, work.shadow);
        for (size_t k = 0; k < SETTINGS; k++) {
            yb_screen_t screen = settings[k].screen;
            screen.format = golden_view_format(which, screen.format);
            report_paint_stack();
            yb_mark_begin();
            uint64_t hash = draw(&screen, settings[k].rows, &view);
            yb_mark_end();
            keep_most(&frame_stack[k]);
            say_hash(code, golden_view_name(which), settings[k].name, hash);
        }
    }
}

int main(void)
{
    yb_board_init();
    for (size_t i = 0; i < golden_code_count; i++) {
        const golden_code_t *code = &golden_codes[i];
        yb_status_t status = load_code(code);
        if (status != YB_OK) {
            report_text(code->name);
            report_text(" ");
            report_text(yb_status_text(status));
            report_text("\r\n");
            break;
        }
        say_hash(code->name, "mesh", NULL, hash_mesh());
        draw_views(code->name);
    }
    report_line("size", "yb_map_t", "", sizeof map);
    report_line("size", "yb_load_t", "", sizeof work.load);
    report_line("size", "yb_frame_t", "", sizeof work.drawing.frame);
    report_line("stack", "load", "", load_stack);
    for (size_t k = 0; k < SETTINGS; k++) {
        report_line("size", "band-", settings[k].name,
                    (uint32_t)(settings[k].rows * yb_band_row_bytes(&settings[k].screen)));
        report_line("stack", "frame-", settings[k].name, frame_stack[k]);
    }
    report_text("done\r\n");
    return 0;
}
