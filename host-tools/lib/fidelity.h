/* How faithful a code is to the real relief, in figures.
 *
 * Heights are compared at the cells of the real relief, at most 256 a side; e is a height of the
 * code's reference surface minus the real one.
 *   RMSE      root of the mean of e²
 *   NRMSE     RMSE over the standard deviation of the real heights
 *   p90, max  of |e|; p90: the least value that nine tenths of the cells do not exceed
 *   slope     mean over the squares between four cells of |slope - real slope| in degrees; the
 *             slope of a square is that of the mean rise along its opposite sides
 *   roughness root of the mean squared rise between cells that lie 1, 2, 4 … 64 cells apart, east
 *             or north: the real relief beside the map with detail
 *   spectrum  mean over those distances of |log2(rise of the map / real rise)|, in octaves: 0 if
 * the map is as rough as the land at every scale, 1 if it is twice or half as rough; of the smooth
 * surface and of that with detail. A rise below 1/100 m counts as 1/100 m K and K_i:
 * docs/similarity.md. N points, M contours (spot heights among both), F = 12N + 20M + 8 bits: the
 * size of the 1985 paper's body, whatever the file's profile.
 */
#ifndef YB_FIDELITY_H
#define YB_FIDELITY_H

#include <jansson.h>

#include "code_file.h"
#include "comparison.h"
#include "similarity.h"

enum {
    YB_ROUGHNESS_LAGS = 7
};

typedef struct {
    double rmse_m, nrmse, p90_m, max_m, slope_deg;
} yb_misfit_t;

typedef struct {
    double height_m;
    bool open;
    yb_similarity_t similarity;
} yb_fidelity_contour_t;

typedef struct {
    size_t bytes;                         /* of the whole file */
    uint32_t points, contours, body_bits; /* N, M, F */
    double reference_std_m;
    yb_misfit_t smooth, detail;
    double k;
    yb_fidelity_contour_t *contour; /* in code order, spot heights left out */
    size_t contour_count;
    uint32_t lag_count; /* lags that fit into the frame */
    double lag_m[YB_ROUGHNESS_LAGS];
    double reference_rise_m[YB_ROUGHNESS_LAGS];
    double smooth_rise_m[YB_ROUGHNESS_LAGS];
    double detail_rise_m[YB_ROUGHNESS_LAGS];
    double smooth_spectrum, detail_spectrum; /* octaves */
} yb_fidelity_t;

/* False: no memory. */
bool yb_fidelity_measure(yb_fidelity_t *fidelity, const yb_code_file_t *file,
                         const yb_comparison_t *comparison);

void yb_fidelity_free(yb_fidelity_t *fidelity);

/* All of it; lengths in metres, as the fields above are called. A new reference. */
json_t *yb_fidelity_json(const yb_fidelity_t *fidelity);

#endif
