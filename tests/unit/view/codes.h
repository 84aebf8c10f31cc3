/* Small codes of known shape for the tests of what is drawn and measured. */
#ifndef CODES_H
#define CODES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "code_file.h"

/* 255 x 255 steps of 30 m, heights in metres above a base of 100 m: an outer contour at 100 above
 * the base, an inner one at 600, a summit of 1000 at (128, 128), the frame at 50. Without noise.
 */
yb_code_file_t *code_hill(void);

/* The same with its summit and inner contour in the eastern half: (192, 128). */
yb_code_file_t *code_eastern_hill(void);

/* The hill with noise. */
yb_code_file_t *code_rough_hill(void);

/* 100 x 60 steps, one open contour from the western to the eastern side, south low, north high. */
yb_code_file_t *code_slope(void);

#endif
