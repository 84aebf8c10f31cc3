/* What a header can say: the nearest of its metres, gains, dimensions and mesh sizes. */
#ifndef YB_CODED_VALUES_H
#define YB_CODED_VALUES_H

#include <stdint.h>

/* Metres as a header codes them, rounded to the nearest of about 4000 steps an octave, and back.
 * Beyond the range (1/64 m to 2 million m) the nearest end.
 */
uint16_t yb_unit_coded(double metres);
double yb_unit_m(uint16_t coded);

/* The nearest of the compact profile's cells and units of height, as coded. */
uint16_t yb_compact_cell(double metres);
uint16_t yb_compact_unit(double metres);

/* The nearest of its gains (0 to 181), and which of its sixteen that is; of its dimensions, in
 * 1/256 above 1.
 */
uint8_t yb_compact_gain(double gain);
int yb_compact_gain_code(double gain);
uint8_t yb_compact_dimension(uint8_t dimension);

/* The class of a mesh with so many vertices; and the largest class whose meshes have no more than
 * `most`, at least 32.
 */
int yb_compact_vertex_class(int vertices);
int yb_compact_vertex_class_within(int most);

#endif
