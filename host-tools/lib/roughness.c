#include "roughness.h"

#include <math.h>
#include <stddef.h>

double yb_roughness_rise_m(const float *z_m, uint32_t columns, uint32_t rows, uint32_t lag)
{
    double squares = 0, count = 0;
    for (uint32_t j = 0; j < rows; j++) {
        for (uint32_t i = 0; i < columns; i++) {
            const size_t at = (size_t)j * columns + i;
            if (i + lag < columns) {
                const double east = (double)(z_m[at + lag] - z_m[at]);
                squares += east * east;
                count++;
            }
            if (j + lag < rows) {
                const double north = (double)(z_m[at + (size_t)lag * columns] - z_m[at]);
                squares += north * north;
                count++;
            }
        }
    }
    return count > 0 ? sqrt(squares / count) : 0;
}

double yb_roughness_octaves(const double *rise_m, const double *real_m, uint32_t count)
{
    static const double least_m = 0.01;
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += fabs(log2(fmax(rise_m[i], least_m) / fmax(real_m[i], least_m)));
    return count > 0 ? sum / count : 0;
}
