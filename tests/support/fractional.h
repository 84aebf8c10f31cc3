/* Fractional Brownian surfaces: reliefs whose Hurst exponent is known, because they are made so.
 *
 * Stein's intrinsic embedding (Stein 2002; Kroese and Botev, Spatial process generation, 2015): the
 * wanted increments, E (z(a) - z(b))^2 proportional to |a - b|^2H, are those of a stationary
 * periodic surface plus a plane that slopes at random, and the former is one Fourier transform of
 * white noise. So the increments are exact and stationary at every lag, which midpoint displacement
 * cannot give and a plain power-law spectrum only between its ends.
 */
#ifndef TEST_FRACTIONAL_H
#define TEST_FRACTIONAL_H

#include <stdbool.h>
#include <stdint.h>

enum {
    FRACTIONAL_SIDE = 257
};

/* Two independent surfaces of FRACTIONAL_SIDE x FRACTIONAL_SIDE heights, their mean about 0; over
 * 512 cells the root of the mean squared rise is scale. hurst from 0.1 to 0.9. The same seed gives
 * the same surfaces. False: no memory.
 */
bool fractional_surfaces(double hurst, uint32_t seed, float scale, float *first, float *second);

#endif
