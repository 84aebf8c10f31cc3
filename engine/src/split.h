/* How a triangle is split: 0, 1, 2 or 3 split edges give 1, 2, 3 or 4 triangles. */
#ifndef YB_SPLIT_H
#define YB_SPLIT_H

#include <yamabiko/rom.h>

/* split_child[pattern][k]: corners of child k of a triangle whose edges of `pattern` are split (bit
 * i: the edge from corner i to corner i + 1). 0 to 2 are the corners, 3 to 5 the midpoints of edges
 * 0 to 2; a child that begins with SPLIT_END is one too many, as is what follows the last
 * pattern's. All counter-clockwise.
 */
enum {
    SPLIT_END = 6,
    SPLIT_CHILDREN = 4
};
extern const uint8_t split_child[8 + 1][SPLIT_CHILDREN][3] YB_ROM;

#endif
