#include "fractional.h"

#include <math.h>
#include <stdlib.h>

/* The period of the embedding in cells, and how many cells are its unit of length: the diagonal of
 * the surface, 362 cells, must be shorter than a unit.
 */
enum {
    PERIOD = 1024,
    UNIT = 363,
    BITS = 10
};

typedef struct {
    double re, im;
} complex_t;

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

/* Box and Muller: two normal numbers. */
static complex_t normals(uint64_t *state)
{
    const double size = sqrt(-2 * log(uniform(state)));
    const double turn = 2 * acos(-1.0) * uniform(state);
    return (complex_t){size * cos(turn), size * sin(turn)};
}

/* In place, PERIOD values that lie `stride` apart; root[k] = exp(-2 pi i k / PERIOD). */
static void transform_line(complex_t *value, int stride, const complex_t *root)
{
    complex_t line[PERIOD];
    for (int i = 0; i < PERIOD; i++) {
        int mirrored = 0;
        for (int bit = 0; bit < BITS; bit++)
            mirrored |= (i >> bit & 1) << (BITS - 1 - bit);
        line[mirrored] = value[i * stride];
    }
    for (int half = 1; half < PERIOD; half *= 2) {
        for (int from = 0; from < PERIOD; from += 2 * half) {
            for (int k = 0; k < half; k++) {
                const complex_t w = root[k * (PERIOD / 2 / half)];
                const complex_t a = line[from + k], b = line[from + k + half];
                const complex_t turned = {b.re * w.re - b.im * w.im, b.re * w.im + b.im * w.re};
                line[from + k] = (complex_t){a.re + turned.re, a.im + turned.im};
                line[from + k + half] = (complex_t){a.re - turned.re, a.im - turned.im};
            }
        }
    }
    for (int i = 0; i < PERIOD; i++)
        value[i * stride] = line[i];
}

static void transform(complex_t *plane)
{
    complex_t root[PERIOD / 2];
    for (int k = 0; k < PERIOD / 2; k++) {
        const double turn = -2 * acos(-1.0) * k / PERIOD;
        root[k] = (complex_t){cos(turn), sin(turn)};
    }
    for (int i = 0; i < PERIOD; i++)
        transform_line(plane + (long)i * PERIOD, 1, root);
    for (int i = 0; i < PERIOD; i++)
        transform_line(plane + i, PERIOD, root);
}

/* The covariance of the periodic part at a distance in units; *plane is c2, half the variance of
 * the random plane's slope.
 */
static double covariance(double hurst, double r, double *plane)
{
    const double power = 2 * hurst;
    const double far = PERIOD / 2.0 / UNIT; /* where it ends */
    double beta = 0;
    if (hurst <= 0.75) {
        *plane = power / 2;
    } else {
        beta = power * (2 - power) / (3 * far * (far * far - 1));
        *plane = (power - beta * (far - 1) * (far - 1) * (far + 2)) / 2;
    }
    const double middle = beta * pow(far - 1, 3) + 1 - *plane;
    if (r <= 1)
        return middle - pow(r, power) + *plane * r * r;
    return r <= far ? beta * pow(far - r, 3) / r : 0;
}

/* Eigenvalues of the covariance on the torus, in the real parts; answers c2. */
static double eigenvalues(complex_t *plane, double hurst)
{
    double slope = 0;
    for (int j = 0; j < PERIOD; j++) {
        for (int i = 0; i < PERIOD; i++) {
            const int x = i < PERIOD / 2 ? i : PERIOD - i;
            const int y = j < PERIOD / 2 ? j : PERIOD - j;
            const double r = hypot(x, y) / UNIT;
            plane[j * PERIOD + i] = (complex_t){covariance(hurst, r, &slope), 0};
        }
    }
    transform(plane);
    return slope;
}

static void cut_out(float *z, const complex_t *plane, bool imaginary, complex_t slope, double scale)
{
    double mean = 0;
    for (int j = 0; j < FRACTIONAL_SIDE; j++) {
        for (int i = 0; i < FRACTIONAL_SIDE; i++) {
            const complex_t *at = &plane[j * PERIOD + i];
            const double height =
                (imaginary ? at->im : at->re) / PERIOD + (slope.re * i + slope.im * j) / UNIT;
            z[j * FRACTIONAL_SIDE + i] = (float)(scale * height);
            mean += scale * height / (FRACTIONAL_SIDE * FRACTIONAL_SIDE);
        }
    }
    for (int i = 0; i < FRACTIONAL_SIDE * FRACTIONAL_SIDE; i++)
        z[i] -= (float)mean;
}

bool fractional_surfaces(double hurst, uint32_t seed, float scale, float *first, float *second)
{
    complex_t *plane = malloc((size_t)PERIOD * PERIOD * sizeof(*plane));
    uint64_t state = seed * 2654435761U + 1;
    if (plane == NULL)
        return false;
    const double slope = sqrt(2 * eigenvalues(plane, hurst));
    for (int i = 0; i < PERIOD * PERIOD; i++) {
        /* Rounding leaves some of them at -1e-12. */
        const double size = sqrt(fmax(plane[i].re, 0));
        const complex_t noise = normals(&state);
        plane[i] = (complex_t){size * noise.re, size * noise.im};
    }
    transform(plane);
    /* Increments over a unit have the mean square 2. */
    const double metres = (double)scale / sqrt(2) * pow(UNIT / 512.0, hurst);
    for (int i = 0; i < 2; i++) {
        const complex_t tilt = normals(&state);
        cut_out(i == 0 ? first : second, plane, i == 1,
                (complex_t){slope * tilt.re, slope * tilt.im}, metres);
    }
    free(plane);
    return true;
}
