/* The surface by itself, without a camera: refined to an even length, or asked for one height. */
#include "surface.h"

#include <string.h>

#include "fix.h"
#include "relief.h"
#include "split.h"

const uint8_t split_child[8 + 1][SPLIT_CHILDREN][3] YB_ROM = {
    {{SPLIT_END}},
    {{0, 3, 2}, {3, 1, 2}, {SPLIT_END}},
    {{1, 4, 0}, {4, 2, 0}, {SPLIT_END}},
    {{4, 3, 1}, {2, 0, 3}, {2, 3, 4}, {SPLIT_END}},
    {{2, 5, 1}, {5, 0, 1}, {SPLIT_END}},
    {{3, 5, 0}, {1, 2, 5}, {1, 5, 3}, {SPLIT_END}},
    {{5, 4, 2}, {0, 1, 4}, {0, 4, 5}, {SPLIT_END}},
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
    {{SPLIT_END}},
};

/* Each level at least halves the area, which twice over is a whole number of square 1/256 steps
 * below 2^33: a triangle that is still split 32 levels down cannot be. So this holds for any limit.
 */
enum {
    LEVELS = 34
};

/* Which edges are longer than `longest` and can be split; their midpoints. */
static uint8_t split_edges(const yb_map_t *map, const yb_vertex_t *const corner[3], int32_t longest,
                           yb_vertex_t middle[3])
{
    uint8_t pattern = 0;
    const yb_vertex_t *b = corner[0];
    for (int i = 2; i >= 0; i--) {
        const yb_vertex_t *a = corner[i];
        int32_t dx = fix_minus(b->x_q8, a->x_q8);
        int32_t dy = fix_minus(b->y_q8, a->y_q8);
        if (fix_length(dx, dy) > longest && relief_splits(dx, dy)) {
            relief_middle(map, a, b, &middle[i]);
            pattern = (uint8_t)(pattern | 1 << i);
        }
        b = a;
    }
    return pattern;
}

static void pick(const yb_vertex_t *const corner[3], const yb_vertex_t middle[3],
                 const uint8_t child[3], const yb_vertex_t *picked[3])
{
    for (int i = 0; i < 3; i++) {
        uint8_t k = yb_rom_u8(&child[i]);
        picked[i] = k < 3 ? corner[k] : &middle[k - 3];
    }
}

void surface_refine(const yb_map_t *map, yb_triangle_t triangle, uint16_t longest_q8,
                    surface_level_t *levels, int count, yb_triangle_fn fn, void *context)
{
    surface_level_t *level = levels;
    relief_corners(map, triangle, level->corner);
    for (;;) {
        uint8_t pattern = 0;
        if (level != &levels[count - 1])
            pattern = split_edges(map, level->corner, longest_q8, level->middle);
        if (pattern == 0)
            fn(context, level->corner[0], level->corner[1], level->corner[2]);
        level->child = split_child[pattern][0];
        /* Up to the next level that has a child left, and down into it. */
        while (yb_rom_u8(level->child) == SPLIT_END) {
            if (level == levels)
                return;
            level--;
        }
        pick(level->corner, level->middle, level->child, level[1].corner);
        level->child += 3;
        level++;
    }
}

void yb_map_refine(const yb_map_t *map, yb_triangle_t triangle, uint16_t longest_q8,
                   yb_triangle_fn fn, void *context)
{
    surface_level_t levels[LEVELS];
    surface_refine(map, triangle, longest_q8, levels, LEVELS, fn, context);
}

/* How near a place is to each corner: twice the signed area, below 2^33, that it makes with the two
 * others in plan. Is it in the triangle?
 */
static bool weigh(const yb_vertex_t *const p[3], int32_t x, int32_t y, int64_t weight[3])
{
    bool inside = true;
    const yb_vertex_t *a = p[1];
    const yb_vertex_t *b = p[2];
    for (int i = 0; i < 3; i++) {
        weight[i] = fix_add(fix_wide(fix_minus(b->x_q8, a->x_q8), y - a->y_q8),
                            fix_minus(b->y_q8, a->y_q8), a->x_q8 - x);
        inside = inside && weight[i] >= 0;
        a = b;
        b = p[i];
    }
    return inside;
}

/* Height of the plane through three points at a place inside them; no triangle of a map is flat in
 * plan. Heights are below 2^19 and areas below 2^33: each product is below 2^53, and counted from
 * the lowest height, so that the division rounds down.
 */
static int32_t plane_height(const yb_vertex_t *const p[3], const int64_t weight[3])
{
    const int32_t lowest = -((int32_t)1 << 19);
    uint64_t whole = 0;
    uint64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        whole += (uint64_t)weight[i];
        sum += (uint64_t)weight[i] * (uint32_t)(p[i]->z_q8 - lowest);
    }
    return (int32_t)(sum / whole) + lowest;
}

int32_t yb_map_height(const yb_map_t *map, uint16_t x_q8, uint16_t y_q8)
{
    int32_t x = fix_min(x_q8, map->east_q8);
    int32_t y = fix_min(y_q8, map->north_q8);
    yb_vertex_t corner[3];
    const yb_vertex_t *const p[3] = {&corner[0], &corner[1], &corner[2]};
    yb_vertex_t middle[3];
    const yb_vertex_t *part[3]; /* of those */
    int64_t weight[3];
    yb_triangle_t t = 0;
    do {
        relief_corners(map, t, part);
    } while (!weigh(part, x, y, weight) && ++t < map->triangle_count); /* they tile the frame */
    for (;;) {
        const yb_vertex_t next[3] = {*part[0], *part[1], *part[2]};
        memcpy(corner, next, sizeof corner);
        uint8_t pattern = split_edges(map, p, YB_REFERENCE_Q8, middle);
        if (pattern == 0)
            return plane_height(p, weight);
        int k = 0;
        do {
            pick(p, middle, split_child[pattern][k], part);
        } while (!weigh(part, x, y, weight) && ++k < SPLIT_CHILDREN); /* they tile the whole */
    }
}
