/* A window on the desktop (SDL) that shows a picture, each pixel as a square of whole pixels of the
 * screen. For one thread, the program's first.
 *
 *     yb_sim_window_t *window = yb_sim_window_open("st7789", 240, 240, 0, false, error);
 *     yb_sim_window_show(window, rgb, false);
 *     key = yb_sim_window_wait(window, 40);
 *     yb_sim_window_close(window);
 */
#ifndef YB_WINDOW_H
#define YB_WINDOW_H

#include <stdbool.h>
#include <stdint.h>

enum {
    YB_WINDOW_ERROR_BYTES = 240,

    /* Keys beside the characters. */
    YB_KEY_NONE = 0,
    YB_KEY_LEFT = 0x100,
    YB_KEY_RIGHT,
    YB_KEY_UP,
    YB_KEY_DOWN,
    YB_KEY_SHOT,  /* F12: the picture is wanted as a file */
    YB_KEY_CLOSE, /* the window was closed, or Escape */
};

typedef struct yb_sim_window yb_sim_window_t;

/* `scale` screen pixels to one of the picture; 0: as many as leave room on the desktop. NULL, with
 * one sentence in `error` (YB_WINDOW_ERROR_BYTES), where there is no desktop. */
yb_sim_window_t *yb_sim_window_open(const char *title, int width, int height, int scale,
                                    bool full_screen, char *error);

/* Shows a picture, row by row: a grey byte a pixel, or red, green and blue. False if the desktop is
 * gone. */
bool yb_sim_window_show(yb_sim_window_t *window, const uint8_t *samples, bool grey);

/* The next key, or YB_KEY_NONE after so many milliseconds (0: does not wait). F11 goes to the full
 * screen and back by itself. */
int yb_sim_window_wait(yb_sim_window_t *window, int timeout_ms);

void yb_sim_window_close(yb_sim_window_t *window);

#endif
