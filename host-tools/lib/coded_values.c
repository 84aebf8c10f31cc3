#include "coded_values.h"

#include <math.h>

#include <yamabiko/yamabiko.h>

/* Metres as a mantissa from `least` to `most` and an exponent, in 1/64 m. */
static uint16_t nearest(double metres, int least, int most, int most_exponent)
{
    double scaled = metres * 64;
    int exponent = 0;
    while (exponent < most_exponent && scaled >= most + 0.5) {
        scaled /= 2;
        exponent++;
    }
    long mantissa = lround(fmin(fmax(scaled, least), most));
    return (uint16_t)((unsigned)exponent << 12 | (unsigned)mantissa);
}

uint16_t yb_unit_coded(double metres)
{
    return nearest(metres, 1, 4095, 15);
}

double yb_unit_m(uint16_t coded)
{
    return yb_unit_64th_m(coded) / 64.0;
}

uint16_t yb_compact_cell(double metres)
{
    return nearest(metres, 1, 511, 14);
}

uint16_t yb_compact_unit(double metres)
{
    return nearest(metres, 16, 31, 15);
}

static int gain_value(int coded)
{
    return coded == 0 ? 0 : (coded % 2 != 0 ? 181 : 128) >> (7 - coded / 2);
}

int yb_compact_gain_code(double gain)
{
    int best = 0;
    for (int i = 1; i < 16; i++)
        if (fabs(gain_value(i) - gain) < fabs(gain_value(best) - gain))
            best = i;
    return best;
}

uint8_t yb_compact_gain(double gain)
{
    return (uint8_t)gain_value(yb_compact_gain_code(gain));
}

uint8_t yb_compact_dimension(uint8_t dimension)
{
    int eighth = (dimension + 4) / 8;
    return (uint8_t)(8 * (eighth > 31 ? 31 : eighth));
}

int yb_compact_vertex_class(int vertices)
{
    if (vertices <= 255)
        return (vertices > 1 ? vertices - 1 : 0) / 32;
    int class = 8;
    while (class < 15 && 512 << (class - 8) < vertices)
        class ++;
    return class;
}

int yb_compact_vertex_class_within(int most)
{
    int class = yb_compact_vertex_class(most);
    int held = class < 8 ? 32 * (class + 1) : 2 << class;
    if (class == 7 || class == 15)
        held--;
    return class > 0 && held > most ? class - 1 : class;
}
