/* What the models of panels have in common: the handle, commands with their arguments, windows.
 *
 * panel_model.h is the face; a family of chips is a yb_model_family_t behind it. A family's
 * functions answer false when they have said what is wrong by yb_model_fail. */
#ifndef YB_MODEL_PARTS_H
#define YB_MODEL_PARTS_H

#include "panel_model.h"

typedef struct {
    size_t chip_bytes;     /* of the family's own state, zeroed before `reset` */
    bool must_be_selected; /* it frames its bytes by chip select, so it must hear of it */
    void (*reset)(yb_panel_model_t *model);
    bool (*byte)(yb_panel_model_t *model, bool is_data, uint8_t byte);
    /* It became selected or not; NULL where that changes nothing. */
    bool (*select)(yb_panel_model_t *model, bool selected);
    /* `now_us` has moved; NULL where nothing falls due. */
    bool (*wait)(yb_panel_model_t *model);
    bool (*lit)(const yb_panel_model_t *model);
    /* Whether nothing is unfinished, lit or not. */
    bool (*finished)(yb_panel_model_t *model);
    /* Fills `rgb`; asked only when lit. */
    bool (*picture)(yb_panel_model_t *model);
} yb_model_family_t;

typedef struct {
    const char *name;
    const yb_model_family_t *family;
    const void *glass; /* the family's */
    uint16_t width;
    uint16_t height;
} yb_model_kind_t;

struct yb_panel_model {
    const yb_model_kind_t *kind;
    void *chip; /* the family's state */
    uint8_t *rgb;
    uint64_t bytes;
    uint64_t now_us;
    uint32_t noise;
    bool timed; /* yb_panel_model_wait was called since the last reset */
    bool select_told;
    bool selected;
    bool failed;
    char error[160];
};

/* Says what is wrong, for good; always false. */
bool yb_model_fail(yb_panel_model_t *model, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* What memory holds when the supply comes up. Not zeros: a driver that does not clear the screen
 * must not look as if it had. */
void yb_model_noise(yb_panel_model_t *model, void *memory, size_t bytes);

/* Puts a pixel into `rgb`. */
void yb_model_put(yb_panel_model_t *model, unsigned x, unsigned y, uint8_t red, uint8_t green,
                  uint8_t blue);

/* Red in the five bits at the top, then six of green and five of blue. */
void yb_model_put_565(yb_panel_model_t *model, unsigned x, unsigned y, uint16_t pixel);

/* ---- Commands and their arguments ------------------------------------------------------------ */

enum {
    YB_MODEL_ARGS = 64, /* the most that a command takes */
};

/* A line of a chip's command table. `run` is called when all arguments are there; NULL where a
 * command changes no pixel (voltages, times). */
typedef struct {
    uint8_t first; /* codes */
    uint8_t last;
    uint8_t args;
    uint8_t least; /* what the first argument may be */
    uint8_t most;
    bool (*run)(yb_panel_model_t *model, uint8_t code, const uint8_t *args);
} yb_model_command_t;

typedef struct {
    const yb_model_command_t *commands;
    size_t count;
} yb_model_table_t;

typedef struct {
    yb_model_command_t command; /* the one that waits for its arguments, or was the last */
    uint8_t code;
    uint8_t got;
    uint8_t args[YB_MODEL_ARGS];
} yb_model_decoder_t;

/* NULL: the table has no such command. */
const yb_model_command_t *yb_model_find(yb_model_table_t table, uint8_t code);

bool yb_model_unfinished(const yb_model_decoder_t *decoder);

/* True, or an error that says what is still wanted. */
bool yb_model_finished(yb_panel_model_t *model, const yb_model_decoder_t *decoder);

/* A command begins; NULL: the chip has none of that code. It is run at once if it has no arguments.
 */
bool yb_model_begin(yb_panel_model_t *model, yb_model_decoder_t *decoder,
                    const yb_model_command_t *command, uint8_t code);

/* An argument of the command that is unfinished. */
bool yb_model_argument(yb_panel_model_t *model, yb_model_decoder_t *decoder, uint8_t byte);

/* ---- Windows --------------------------------------------------------------------------------- */

typedef struct {
    uint16_t first;
    uint16_t last;
    uint16_t at;
} yb_model_range_t;

typedef struct {
    yb_model_range_t column;
    yb_model_range_t row;
    bool full; /* every pixel of it was written */
} yb_model_window_t;

void yb_model_window_reset(yb_model_window_t *window, uint16_t columns, uint16_t rows);

/* `what` is "column", "row" or "page"; the memory has `count` of them. */
bool yb_model_range_set(yb_panel_model_t *model, yb_model_range_t *range, const char *what,
                        unsigned first, unsigned last, unsigned count);

/* False, with an error, when the window is full. */
bool yb_model_window_open(yb_panel_model_t *model, const yb_model_window_t *window);

/* To the next place, row by row, or if `vertical` column by column. */
void yb_model_window_step(yb_model_window_t *window, bool vertical);

/* ---- The families ---------------------------------------------------------------------------- */

extern const yb_model_family_t yb_model_ssd0323;
extern const yb_model_family_t yb_model_ssd1306; /* no glass: the size says which */
extern const yb_model_family_t yb_model_ssd1351;
extern const yb_model_family_t yb_model_mipi; /* glass: yb_mipi_glass_t */
extern const yb_model_family_t yb_model_sharp;

#endif
