/* The handheld: the mountain turns on the OLED, the console can hold it still. Only what changed is
 * sent, while the next band is drawn. */
#include "board.h"
#include "oled.h"
#include "turntable.h"
#include "update.h"

static yb_turntable_t table;
static yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &yb_oled_bus};
/* A started display is black, and so is this. */
static uint8_t shown[YB_VIEWER_PITCH * YB_VIEWER_HEIGHT];
static yb_update_t update = {.display = &display, .shown = shown};

static void show_band(void *context, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    (void)context;
    /* The bus never fails, and the band lies on the panel. */
    (void)yb_update_rows(&update, y, rows, pixels);
}

int main(void)
{
    yb_board_init();
    yb_oled_start();
    (void)yb_display_start(&display);

    const yb_turntable_port_t port = {.board = yb_board_name,
                                      .read = yb_board_read,
                                      .write = yb_board_write,
                                      .band = show_band,
                                      .slot = yb_slot,
                                      .slot_bytes = YB_SLOT_BYTES,
                                      .built_in = yb_built_in_map,
                                      .built_in_bytes = yb_built_in_map_bytes};
    yb_turntable_begin(&table, &port);
    for (;;)
        yb_turntable_step(&table);
}
