/* Feature points: the corners and bends of a contour line that stand for all of it, and their
 * places on the lattice of a code.
 */
#ifndef YB_SIMPLIFY_H
#define YB_SIMPLIFY_H

#include "contour_lines.h"
#include "contour_set.h"

/* Chooses the places of a line such that no other is farther than tolerance_m from the polygon
 * through them (Ramer, Douglas and Peucker). A closed line is first cut at its two places that are
 * farthest apart, which are ends of its longest spurs. Answers how many, their indices in `kept` in
 * rising order; kept has room for line->count. A closed line keeps at least 3. 0: out of memory.
 */
int yb_simplify(const yb_line_t *line, double tolerance_m, int *kept);

/* How metres on the frame become lattice steps. */
typedef struct {
    double width_m, depth_m;
    int east, north, spacing;
} yb_lattice_t;

/* Simplifies a line and lays it on the lattice: all points are multiples of
 * the spacing, the ends of an open one lie on the frame, all others inside. Answers how many
 * points, at most `room`; 0 if the line collapses or needs more.
 */
int yb_simplify_to_lattice(const yb_line_t *line, double tolerance_m, const yb_lattice_t *lattice,
                           yb_step_t *point, int room);

/* Whether a new contour (count points, closed or open) crosses or touches itself or one of the
 * paper's: exact, in integers.
 */
bool yb_simplify_fits(const yb_contour_set_t *set, const yb_step_t *point, int count, bool open);

/* The same for a point that has been moved within the set: do its segments cross or touch any? */
bool yb_simplify_point_fits(const yb_contour_set_t *set, int contour, int at);

#endif
