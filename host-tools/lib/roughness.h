/* Roughness of a relief by scale: its spectrum as rises over distances. */
#ifndef YB_ROUGHNESS_H
#define YB_ROUGHNESS_H

#include <stdint.h>

/* Root of the mean squared rise between cells that lie `lag` cells apart, along rows or columns, of
 * columns * rows heights; 0 if none do.
 */
double yb_roughness_rise_m(const float *z_m, uint32_t columns, uint32_t rows, uint32_t lag);

/* Mean of |log2(rise / real rise)| over `count` lags, in octaves: 0 if a map is as rough as the
 * land at every scale, 1 if it is twice or half as rough. A rise below 1/100 m counts as 1/100 m.
 */
double yb_roughness_octaves(const double *rise_m, const double *real_m, uint32_t count);

#endif
