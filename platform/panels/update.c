#include "update.h"

#include <string.h>

enum {
    OPEN_MOST = 8, /* rectangles that may still grow downwards */
};

/* Half open, in pixels. */
typedef struct {
    uint16_t x0, x1, y0, y1;
} rect_t;

/* What it takes to find rectangles: the smallest piece that can be written is a cell. */
typedef struct {
    yb_update_t *update;
    size_t pitch;
    uint8_t pixel_bits;
    uint16_t cells; /* in a row */
    uint16_t x_step, y_step;
    uint16_t gap_cells; /* so many equal cells cost less than another window */
    rect_t open[OPEN_MOST];
    uint8_t opened;
    bool well;
} search_t;

/* In bytes. */
static size_t cost(const search_t *search, const rect_t *rect)
{
    const yb_panel_t *panel = search->update->display->panel;
    const size_t rows = (size_t)(rect->y1 - rect->y0);
    const size_t row_bits = (size_t)(rect->x1 - rect->x0) * search->pixel_bits;
    return panel->window_bytes + rows * panel->row_bytes + rows * row_bits / 8;
}

static void send(search_t *search, const rect_t *rect)
{
    const yb_panel_window_t window = {
        .x = rect->x0,
        .y = rect->y0,
        .width = (uint16_t)(rect->x1 - rect->x0),
        .rows = (uint16_t)(rect->y1 - rect->y0),
        .pixels = search->update->shown + rect->y0 * search->pitch +
                  (size_t)rect->x0 * search->pixel_bits / 8,
        .pitch_bytes = search->pitch,
    };
    search->well = search->well && yb_display_write(search->update->display, &window);
}

static rect_t around(const rect_t *a, const rect_t *b)
{
    return (rect_t){.x0 = a->x0 < b->x0 ? a->x0 : b->x0,
                    .x1 = a->x1 > b->x1 ? a->x1 : b->x1,
                    .y0 = a->y0,
                    .y1 = b->y1};
}

static void close_rect(search_t *search, uint8_t index)
{
    send(search, &search->open[index]);
    search->opened--;
    memmove(&search->open[index], &search->open[index + 1],
            (search->opened - index) * sizeof search->open[0]);
}

/* Closes one that ended above `y`. Those that reach farther must wait: their last rows are not in
 * `shown` yet. */
static bool make_room(search_t *search, uint16_t y)
{
    for (uint8_t i = 0; i < search->opened; i++) {
        if (search->open[i].y1 <= y) {
            close_rect(search, i);
            return true;
        }
    }
    return false;
}

/* A run of differences becomes part of an open rectangle if that costs no more than a window of its
 * own, or else opens one. */
static void add_run(search_t *search, const rect_t *run)
{
    for (uint8_t i = 0; i < search->opened; i++) {
        const rect_t both = around(&search->open[i], run);
        if (cost(search, &both) <= cost(search, &search->open[i]) + cost(search, run)) {
            search->open[i] = both;
            return;
        }
    }
    if (search->opened == OPEN_MOST && !make_room(search, run->y0)) {
        rect_t *last = &search->open[OPEN_MOST - 1];
        *last = around(last, run);
        return;
    }
    search->open[search->opened++] = *run;
}

/* A cell is some whole bytes, or some bits of one. Not memcmp: cells are short, and our
 * freestanding targets have none. */
static bool cell_differs(const search_t *search, const uint8_t *pixels, uint16_t y, uint16_t cell)
{
    const size_t bits = (size_t)search->x_step * search->pixel_bits;
    const size_t at = cell * bits / 8;
    const size_t bytes = bits < 8 ? 1 : bits / 8;
    const uint8_t mask =
        bits < 8 ? (uint8_t)(((1U << bits) - 1) << (8 - bits - cell * bits % 8)) : 0xFF;
    const uint8_t *shown = search->update->shown + y * search->pitch + at;
    pixels += at;

    for (uint16_t row = 0; row < search->y_step; row++) {
        for (size_t i = 0; i < bytes; i++) {
            if (((shown[i] ^ pixels[i]) & mask) != 0)
                return true;
        }
        shown += search->pitch;
        pixels += search->pitch;
    }
    return false;
}

/* One row of cells: its runs of differences, those over small gaps as one. */
static void find_runs(search_t *search, const uint8_t *pixels, uint16_t y)
{
    uint16_t cell = 0;

    while (cell < search->cells) {
        if (!cell_differs(search, pixels, y, cell)) {
            cell++;
            continue;
        }
        const uint16_t first = cell;
        uint16_t end = ++cell;
        while (cell < search->cells && cell - end <= search->gap_cells) {
            if (cell_differs(search, pixels, y, cell++))
                end = cell;
        }
        const rect_t run = {.x0 = (uint16_t)(first * search->x_step),
                            .x1 = (uint16_t)(end * search->x_step),
                            .y0 = y,
                            .y1 = (uint16_t)(y + search->y_step)};
        add_run(search, &run);
    }
}

static void close_ended(search_t *search, uint16_t y)
{
    for (uint8_t i = search->opened; i > 0; i--) {
        if (search->open[i - 1].y1 != y)
            close_rect(search, (uint8_t)(i - 1));
    }
}

static search_t search_of(yb_update_t *update, const yb_screen_t *screen)
{
    search_t search = {.update = update,
                       .pitch = yb_screen_pitch(screen),
                       .pixel_bits = yb_pixel_bits(screen->format),
                       .x_step = yb_display_x_step(update->display),
                       .y_step = yb_display_y_step(update->display),
                       .well = true};
    const uint32_t cell_bits = (uint32_t)search.x_step * search.y_step * search.pixel_bits;
    search.cells = (uint16_t)(screen->width / search.x_step);
    search.gap_cells = (uint16_t)(8U * update->display->panel->window_bytes / cell_bits);
    return search;
}

static bool band_fits(const yb_update_t *update, const yb_screen_t *screen, uint16_t y,
                      uint16_t rows)
{
    const uint16_t step = yb_display_y_step(update->display);
    return rows <= screen->height && y <= screen->height - rows && y % step == 0 &&
           rows % step == 0;
}

bool yb_update_rows(yb_update_t *update, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    const yb_screen_t screen = yb_display_screen(update->display);
    search_t search = search_of(update, &screen);

    /* `shown` may still be on its way. */
    if (!band_fits(update, &screen, y, rows) || !yb_display_finish(update->display))
        return false;
    const uint16_t end = (uint16_t)(y + rows);
    for (; y < end; y = (uint16_t)(y + search.y_step)) {
        const size_t bytes = search.y_step * search.pitch;
        find_runs(&search, pixels, y);
        close_ended(&search, (uint16_t)(y + search.y_step));
        memcpy(update->shown + y * search.pitch, pixels, bytes);
        pixels += bytes;
    }
    while (search.opened > 0)
        close_rect(&search, 0);
    return search.well;
}

bool yb_update_rows_whole(yb_update_t *update, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    const yb_screen_t screen = yb_display_screen(update->display);
    const size_t pitch = yb_screen_pitch(&screen);

    if (!band_fits(update, &screen, y, rows) || !yb_display_finish(update->display))
        return false;
    memcpy(update->shown + y * pitch, pixels, rows * pitch);
    return yb_display_write_rows(update->display, y, rows, update->shown + y * pitch);
}
