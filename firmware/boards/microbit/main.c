/* A micro:bit without a display: draws the handheld's very frames and tells their hashes. */
#include "board.h"
#include "turntable.h"

static yb_turntable_t table;

int main(void)
{
    yb_board_init();
    const yb_turntable_port_t port = {.board = yb_board_name,
                                      .read = yb_board_read,
                                      .write = yb_board_write,
                                      .slot = yb_slot,
                                      .slot_bytes = YB_SLOT_BYTES,
                                      .built_in = yb_built_in_map,
                                      .built_in_bytes = yb_built_in_map_bytes,
                                      .report = true};
    yb_turntable_begin(&table, &port);
    for (;;)
        yb_turntable_step(&table);
}
