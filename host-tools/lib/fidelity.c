#include "fidelity.h"

#include <math.h>
#include <stdlib.h>

#include "roughness.h"

static int compare_floats(const void *a, const void *b)
{
    const float first = *(const float *)a, second = *(const float *)b;
    return (first > second) - (first < second);
}

static double standard_deviation(const float *value, size_t count)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += (double)value[i];
    const double mean = sum / (double)count;
    for (size_t i = 0; i < count; i++)
        squares += ((double)value[i] - mean) * ((double)value[i] - mean);
    return sqrt(squares / (double)count);
}

/* Slope in degrees of the square whose south-western cell is at `sw`. */
static double square_slope(const yb_comparison_t *comparison, const float *z_m, size_t sw)
{
    const uint32_t columns = comparison->columns;
    const double cell_x_m = comparison->east_m / (columns - 1);
    const double cell_y_m = comparison->north_m / (comparison->rows - 1);
    const double a = (double)z_m[sw], b = (double)z_m[sw + 1];
    const double c = (double)z_m[sw + columns], d = (double)z_m[sw + columns + 1];
    const double east = (b + d - a - c) / (2 * cell_x_m), north = (c + d - a - b) / (2 * cell_y_m);
    return atan(hypot(east, north)) * 180 / acos(-1.0);
}

static double slope_error(const yb_comparison_t *comparison, const float *z_m)
{
    double sum = 0;
    for (uint32_t j = 0; j + 1 < comparison->rows; j++) {
        for (uint32_t i = 0; i + 1 < comparison->columns; i++) {
            const size_t sw = (size_t)j * comparison->columns + i;
            sum += fabs(square_slope(comparison, z_m, sw) -
                        square_slope(comparison, comparison->reference_m, sw));
        }
    }
    return sum / ((double)(comparison->columns - 1) * (comparison->rows - 1));
}

static bool measure_misfit(yb_misfit_t *misfit, const yb_comparison_t *comparison, const float *z_m,
                           double std_m)
{
    const size_t cells = (size_t)comparison->columns * comparison->rows;
    float *error = malloc(cells * sizeof(*error));
    double squares = 0;
    if (error == NULL)
        return false;
    for (size_t i = 0; i < cells; i++) {
        error[i] = fabsf(z_m[i] - comparison->reference_m[i]);
        squares += (double)error[i] * (double)error[i];
    }
    qsort(error, cells, sizeof(*error), compare_floats);
    misfit->rmse_m = sqrt(squares / (double)cells);
    misfit->nrmse = std_m > 0 ? misfit->rmse_m / std_m : 0;
    misfit->p90_m = (double)error[(cells * 9 + 9) / 10 - 1];
    misfit->max_m = (double)error[cells - 1];
    misfit->slope_deg = slope_error(comparison, z_m);
    free(error);
    return true;
}

static double rise(const yb_comparison_t *comparison, const float *z_m, uint32_t lag)
{
    return yb_roughness_rise_m(z_m, comparison->columns, comparison->rows, lag);
}

static void measure_roughness(yb_fidelity_t *fidelity, const yb_comparison_t *comparison)
{
    const uint32_t longer =
        comparison->columns > comparison->rows ? comparison->columns : comparison->rows;
    for (int i = 0; i < YB_ROUGHNESS_LAGS && (1u << i) < longer; i++) {
        fidelity->lag_m[i] = comparison->east_m / (comparison->columns - 1) * (1 << i);
        fidelity->reference_rise_m[i] = rise(comparison, comparison->reference_m, 1u << i);
        fidelity->smooth_rise_m[i] = rise(comparison, comparison->smooth_m, 1u << i);
        fidelity->detail_rise_m[i] = rise(comparison, comparison->detail_m, 1u << i);
        fidelity->lag_count++;
    }
    fidelity->smooth_spectrum = yb_roughness_octaves(
        fidelity->smooth_rise_m, fidelity->reference_rise_m, fidelity->lag_count);
    fidelity->detail_spectrum = yb_roughness_octaves(
        fidelity->detail_rise_m, fidelity->reference_rise_m, fidelity->lag_count);
}

static bool measure_k(yb_fidelity_t *fidelity, const yb_comparison_t *comparison)
{
    const size_t count = comparison->coded.count;
    fidelity->contour = calloc(count + 1, sizeof(*fidelity->contour));
    yb_similarity_t *all = calloc(count + 1, sizeof(*all));
    bool good = fidelity->contour != NULL && all != NULL;
    for (size_t i = 0; good && i < count; i++) {
        const yb_isoline_t *coded = &comparison->coded.line[i];
        const yb_isolines_t original = yb_isolines_at(&comparison->original, coded->height_m);
        const yb_isolines_t reproduced = yb_isolines_at(&comparison->reproduced, coded->height_m);
        good = yb_similarity_measure(&all[i], coded, &original, &reproduced, comparison->east_m,
                                     comparison->north_m);
        fidelity->contour[i] = (yb_fidelity_contour_t){coded->height_m, !coded->closed, all[i]};
    }
    fidelity->contour_count = count;
    fidelity->k = good ? yb_similarity_mean(all, count) : 0;
    free(all);
    return good;
}

bool yb_fidelity_measure(yb_fidelity_t *fidelity, const yb_code_file_t *file,
                         const yb_comparison_t *comparison)
{
    const size_t cells = (size_t)comparison->columns * comparison->rows;
    *fidelity = (yb_fidelity_t){.bytes = file->size, .contours = file->load.contour_count};
    for (uint16_t i = 0; i < file->load.contour_count; i++)
        fidelity->points += file->load.contour[i].count;
    fidelity->body_bits = 12 * fidelity->points + 20 * fidelity->contours + 8;
    fidelity->reference_std_m = standard_deviation(comparison->reference_m, cells);
    const double std_m = fidelity->reference_std_m;
    if (measure_misfit(&fidelity->smooth, comparison, comparison->smooth_m, std_m) &&
        measure_misfit(&fidelity->detail, comparison, comparison->detail_m, std_m) &&
        measure_k(fidelity, comparison)) {
        measure_roughness(fidelity, comparison);
        return true;
    }
    yb_fidelity_free(fidelity);
    return false;
}

void yb_fidelity_free(yb_fidelity_t *fidelity)
{
    free(fidelity->contour);
    *fidelity = (yb_fidelity_t){0};
}

static json_t *misfit_json(const yb_misfit_t *misfit)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:f}", "rmse_m", misfit->rmse_m, "nrmse", misfit->nrmse,
                     "p90_m", misfit->p90_m, "max_m", misfit->max_m, "slope_deg",
                     misfit->slope_deg);
}

static json_t *contours_json(const yb_fidelity_t *fidelity)
{
    json_t *list = json_array();
    for (size_t i = 0; i < fidelity->contour_count; i++) {
        const yb_fidelity_contour_t *contour = &fidelity->contour[i];
        const yb_similarity_t *similarity = &contour->similarity;
        json_array_append_new(list, json_pack("{s:f, s:b, s:f, s:f, s:f, s:f, s:f, s:f}",
                                              "height_m", contour->height_m, "open", contour->open,
                                              "k", similarity->k, "area", similarity->area,
                                              "distance", similarity->distance, "curvature",
                                              similarity->curvature, "length_m", similarity->length,
                                              "hausdorff_m", similarity->hausdorff));
    }
    return list;
}

json_t *yb_fidelity_json(const yb_fidelity_t *fidelity)
{
    json_t *roughness = json_array();
    for (uint32_t i = 0; i < fidelity->lag_count; i++)
        json_array_append_new(roughness,
                              json_pack("{s:f, s:f, s:f, s:f}", "lag_m", fidelity->lag_m[i],
                                        "reference_m", fidelity->reference_rise_m[i], "smooth_m",
                                        fidelity->smooth_rise_m[i], "detail_m",
                                        fidelity->detail_rise_m[i]));
    return json_pack("{s:I, s:I, s:I, s:I, s:f, s:o, s:o, s:f, s:o, s:o, s:{s:f, s:f}}", "bytes",
                     (json_int_t)fidelity->bytes, "points", (json_int_t)fidelity->points,
                     "contours", (json_int_t)fidelity->contours, "body_bits",
                     (json_int_t)fidelity->body_bits, "reference_std_m", fidelity->reference_std_m,
                     "smooth", misfit_json(&fidelity->smooth), "detail",
                     misfit_json(&fidelity->detail), "k", fidelity->k, "contour",
                     contours_json(fidelity), "roughness", roughness, "spectrum", "smooth",
                     fidelity->smooth_spectrum, "detail", fidelity->detail_spectrum);
}
