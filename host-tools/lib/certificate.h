/* The certificate of a code: how near it is to the relief, measured and written into it. */
#ifndef YB_CERTIFICATE_H
#define YB_CERTIFICATE_H

#include "code_file.h"
#include "contour_lines.h"
#include "grid.h"

/* Compares a code whose sections hold an empty certificate with the relief, as yb_fidelity_measure
 * does, and fills the certificate in: the p90 error with detail, rounded up, and K, rounded down.
 * `lines` are those that the relief was made from, or NULL. *code is replaced. False with a
 * sentence: no memory.
 */
bool yb_certificate_fill(yb_code_file_t **code, const yb_grid_t *relief, const yb_lines_t *lines,
                         yb_error_t *error);

#endif
