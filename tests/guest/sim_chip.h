/* Simulated GPIO chips for tests in the guest, by the kernel's gpio-sim, and what the kernel itself
 * says of their lines: without libgpiod, whose versions are what is tested. Failures end the test.
 */
#ifndef YB_SIM_CHIP_H
#define YB_SIM_CHIP_H

typedef struct {
    char label[32];
    char path[64];   /* "/dev/gpiochip1" */
    char lines[160]; /* the folder where its lines' levels are set from outside */
} yb_sim_chip_t;

/* Makes a chip of 16 lines; `names` are those of the first lines and end with NULL, or are NULL. */
void yb_sim_chip_make(yb_sim_chip_t *chip, const char *label, const char *const *names);

/* Pulls the chip out. */
void yb_sim_chip_unplug(const yb_sim_chip_t *chip);

/* Sets the level of an input from outside: 0 or 1. */
void yb_sim_chip_pull(const yb_sim_chip_t *chip, unsigned line, int level);

/* Takes a line as an input under that name, and returns the descriptor that holds it. */
int yb_sim_chip_hold(const yb_sim_chip_t *chip, unsigned line, const char *holder);

/* Who holds a line, until the next call: "" when nobody does. */
const char *yb_sim_chip_holder(const yb_sim_chip_t *chip, unsigned line);

/* The level of a line, whoever holds it. */
int yb_sim_chip_level(const yb_sim_chip_t *chip, unsigned line);

#endif
