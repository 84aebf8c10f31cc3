/* The rectangle drawn round a sheet. */
#ifndef YB_BORDER_H
#define YB_BORDER_H

#include "ink.h"

/* If straight lines run along all four sides of the picture, each in its outer quarter, cuts the
 * picture to what lies inside them. They may be askew by a line's thickness and two pixels. False:
 * out of memory.
 */
bool yb_border_cut(yb_ink_t *ink);

#endif
