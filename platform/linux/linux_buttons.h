/* Buttons on GPIO lines: to ground, with the pull-up that the line has (asked for where the kernel
 * can set it). A press is a falling edge after 30 ms without any: what contacts do while they
 * bounce, when they close and when they open, is none.
 *
 *     yb_linux_buttons_t *buttons = yb_linux_buttons_open("gpiochip0", lines, 2, why);
 *     poll yb_linux_buttons_fd(buttons) for POLLIN, then
 *     while ((pressed = yb_linux_buttons_read(buttons)) >= 0)
 *         act(pressed);
 */
#ifndef YB_LINUX_BUTTONS_H
#define YB_LINUX_BUTTONS_H

#include <stdbool.h>
#include <stddef.h>

enum {
    YB_LINUX_BUTTONS_MAX = 16,
};

typedef struct yb_linux_buttons yb_linux_buttons_t;

/* Lines by number or name on a chip (NULL: gpiochip0). NULL with one sentence in `error`
 * (YB_LINUX_ERROR_BYTES) as yb_linux_bus_open says it. */
yb_linux_buttons_t *yb_linux_buttons_open(const char *chip, const char *const *lines, size_t count,
                                          char *error);

/* A descriptor that can be read, for poll, while edges wait, of which some may be presses. Some
 * kernels do not wake who waits for it when the chip goes away: look with `read` now and then.
 */
int yb_linux_buttons_fd(const yb_linux_buttons_t *buttons);

/* The index of the next line that was pressed; -1: none waits; -2: the chip is gone. Does not wait.
 */
int yb_linux_buttons_read(yb_linux_buttons_t *buttons);

void yb_linux_buttons_close(yb_linux_buttons_t *buttons);

#endif
