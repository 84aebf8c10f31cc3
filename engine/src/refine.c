#include "refine.h"

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "relief.h"
#include "shade.h"

/* --- Edges ------------------------------------------------------------------------------------ */

/* Under water all along, however it is refined? Then it is seen as a straight line on a plane. */
static bool drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b, int class)
{
    int32_t highest = fix_max(a->z_q8, b->z_q8);
    if (highest >= frame->view.water_q8)
        return false;
    int32_t rise = fix_abs(relief_bulge(
        relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope),
        relief_dx(a->place, b->place), relief_dy(a->place, b->place)));
    const relief_bound_t bound = {rise + (rise >> 1) + 16, class};
    return highest + relief_reach(frame->map, &bound, 0) < frame->view.water_q8;
}

/* The nearest of an edge's ends, as 1/depth. Beyond the near distance, for what is behind it. */
static uint32_t nearest(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t depth = INT32_MAX;
    const yb_point_t *end[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        camera_point_t at;
        camera_view(frame, end[i]->place, end[i]->top_q8, &at);
        depth = fix_min(depth, at.depth);
    }
    return (uint32_t)camera_near(frame, fix_max(depth, frame->near));
}

/* How often an edge is halved, with REFINE_AGAIN if its halves are to be asked.
 *
 * length_q7 has 16 bits and 1/depth too. Where both ends have spots and 1/depth changes by so little
 * that the middle of the edge, halved and halved again, is seen in the middle of its spots to a
 * fraction of frame->longest, the one number will do for all of the edge.
 */
static uint8_t ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   const yb_edge_t *edge)
{
    uint32_t parity = a->place ^ b->place;
    parity |= parity >> 16;
    uint32_t near = (uint32_t)fix_max(a->spot.near, b->spot.near);
    uint32_t change = (uint32_t)fix_abs(a->spot.near - b->spot.near);
    bool seen = a->spot.near > 0 && b->spot.near > 0;
    if (!seen)
        near = nearest(frame, a, b);
    uint32_t size = edge->length_q7 * near;
    uint8_t often = 0;
    for (; size > frame->longest && (parity & 1) == 0; size >>= 1, parity >>= 1)
        often++;
    if (often == 0 || drowned(frame, a, b, edge->class))
        return 0;
    return seen && change << (often + 2) <= near ? often : 1 | REFINE_AGAIN;
}

bool refine_splits(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_edge_t *edge)
{
    if (edge->splits == REFINE_ASK)
        edge->splits = ask(frame, a, b, edge);
    return edge->splits != 0;
}

void refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                 yb_edge_t *edge)
{
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    /* Below 2^16 each, times 2^13, which has the length of a unit vector: below 2^30. */
    int32_t across = fix_abs(dx * frame->across_x + dy * frame->across_y) >> 14;
    int32_t along = fix_abs(dx * frame->along_x + dy * frame->along_y) >> 14;
    edge->length_q7 = (uint16_t)fix_length(across, along);
    edge->class = (uint8_t)relief_class(dx, dy);
    edge->splits = REFINE_ASK;
    edge->splits = ask(frame, a, b, edge);
}

/* Each half's mean of two numbers, rounded down. */
static inline uint32_t mean2(uint32_t a, uint32_t b)
{
    return (a & b) + ((a ^ b) >> 1 & 0x7fff7fff);
}

void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_edge_t edge, yb_point_t *middle)
{
    const yb_map_t *map = frame->map;
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    middle->place = mean2(a->place, b->place);
    middle->slope = mean2(a->slope, b->slope);
    int32_t z = (a->z_q8 + b->z_q8) >> 1;
    if (map->smooth)
        z += relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope), dx, dy);
    z += relief_rough(map, middle->place, edge.class, dx, dy, b->z_q8 - a->z_q8);
    middle->z_q8 = z;
    middle->top_q8 = fix_max(z, frame->view.water_q8);
    int32_t rise = middle->top_q8 - ((a->top_q8 + b->top_q8) >> 1);
    /* Half way between the ends' spots, and up by the rise. What needs more than that, and what
     * comes to lie more than a screen size off, is placed exactly. */
    if ((edge.splits & REFINE_AGAIN) == 0 && a->spot.near > 0 && b->spot.near > 0 &&
        fix_abs(rise) < 1 << 14) {
        int32_t near = (a->spot.near + b->spot.near) >> 1;
        int32_t turn = rise * near; /* below 2^30 */
        int32_t y = ((a->spot.y_q4 + b->spot.y_q4) >> 1) -
                    ((turn >> 10) * frame->lift >> frame->lift_shift);
        uint32_t high = frame->screen.height * (uint32_t)16;
        if (fix_abs(turn) <= frame->most_bend && (uint32_t)y + high <= 3 * high) {
            middle->spot.x_q4 = (a->spot.x_q4 + b->spot.x_q4) >> 1;
            middle->spot.y_q4 = y;
            middle->spot.near = near;
            return;
        }
    }
    camera_see(frame, middle);
}

/* --- What lies outside the picture ------------------------------------------------------------ */

/* A slope of the picture's pyramid, in 1/256, for a line `off` sixteenths of a pixel from the
 * middle: off / focal, rounded up. The picture lies within a slope of 2.
 */
static int32_t slope_q8(const yb_frame_t *frame, int32_t off_q4)
{
    return off_q4 >= 0 ? (off_q4 * 256 + frame->focal_q4 - 1) / frame->focal_q4
                       : -(-off_q4 * 256 / frame->focal_q4);
}

enum {
    SPARE_Q4 = 16 /* by which spots may be off where they should be */
};

void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view)
{
    /* What meets no pixel's centre draws nothing. */
    view->left_q4 = 8;
    view->right_q4 = frame->screen.width * 16 - 8;
    view->top_q4 = first_row * 16 + 8;
    view->bottom_q4 = end_row * 16 - 8;
    int32_t wide = slope_q8(frame, frame->screen.width * 8 + SPARE_Q4);
    int32_t middle = frame->screen.height * 8;
    const refine_plane_t planes[REFINE_PLANES] = {
        {.slope_q8 = 256, .near = frame->near},
        {.right = 1, .slope_q8 = wide},
        {.right = -1, .slope_q8 = wide},
        {.up = -1, .slope_q8 = slope_q8(frame, middle - first_row * 16 + SPARE_Q4)},
        {.up = 1, .slope_q8 = slope_q8(frame, end_row * 16 - middle + SPARE_Q4)},
    };
    int32_t up_q9 = (frame->up_z * frame->view.exaggerate_q8) >> 13;
    int32_t deep_q9 = (frame->depth_z * frame->view.exaggerate_q8) >> 13;
    for (int i = 0; i < REFINE_PLANES; i++) {
        refine_plane_t *plane = &view->plane[i];
        *plane = planes[i];
        int32_t lift = plane->up * up_q9 + ((plane->slope_q8 * deep_q9) >> 8);
        plane->lift_q9 = (fix_abs(lift) >> frame->eye_shift) + 2;
    }
}

/* For points without spots: does nothing lie inside one of the planes? Inside is across . (right,
 * up) + slope * depth - near >= 0; depth < 2^18 and |slope| <= 2 * 2^8 make 2^27.
 */
static bool misses(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *const *p,
                   int count, int32_t stray)
{
    camera_point_t at[4];
    for (int k = 0; k < count; k++)
        camera_view(frame, p[k]->place, p[k]->top_q8, &at[k]);
    for (int i = 0; i < REFINE_PLANES; i++) {
        const refine_plane_t *plane = &view->plane[i];
        int32_t most = INT32_MIN;
        for (int k = 0; k < count; k++)
            most = fix_max(most, plane->right * at[k].right + plane->up * at[k].up +
                                     ((at[k].depth * plane->slope_q8) >> 8) - plane->near);
        /* stray < 2^19 and lift < 2^14: within 2^29 after the shift by 4. */
        if (most < -((((stray >> 4) + 1) * plane->lift_q9 >> 5) + 4))
            return true;
    }
    return false;
}

typedef struct {
    int32_t left, right, top, bottom; /* 1/16 pixel */
} box_t;

/* The box that holds some points, each of which may move by `stray` in height, and what lies
 * between them. False: they have no spots, or may come nearer by more than an eighth.
 */
static bool find_box(const yb_frame_t *frame, const yb_point_t *const *p, int count, int32_t stray,
                     box_t *box)
{
    int32_t near = 0;
    *box = (box_t){INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (int k = 0; k < count; k++) {
        const yb_spot_t *spot = &p[k]->spot;
        if (spot->near == 0)
            return false;
        near = fix_max(near, spot->near);
        box->left = fix_min(box->left, spot->x_q4);
        box->right = fix_max(box->right, spot->x_q4);
        box->top = fix_min(box->top, spot->y_q4);
        box->bottom = fix_max(box->bottom, spot->y_q4);
    }
    if (stray >= 1 << 14 || (stray * near) >> 3 > frame->most_bend)
        return false;
    int32_t sway = ((stray * near) >> 10) + 1;
    int32_t x = (sway * frame->sway_x_q4 >> frame->lift_shift) + SPARE_Q4;
    int32_t y = (sway * frame->sway_y_q4 >> frame->lift_shift) + SPARE_Q4;
    box->left -= x;
    box->right += x;
    box->top -= y;
    box->bottom += y;
    return true;
}

refine_where_t refine_where(const yb_frame_t *frame, const refine_view_t *view,
                            const yb_point_t *const *p, int count, int32_t stray)
{
    box_t box;
    if (view == NULL)
        return REFINE_BOTH;
    if (!find_box(frame, p, count, stray, &box))
        return misses(frame, view, p, count, stray) ? REFINE_OUT : REFINE_BOTH;
    if (box.right < view->left_q4 || box.left > view->right_q4 || box.bottom < view->top_q4 ||
        box.top > view->bottom_q4)
        return REFINE_OUT;
    return box.left > view->left_q4 && box.right < view->right_q4 && box.top > view->top_q4 &&
                   box.bottom < view->bottom_q4
               ? REFINE_IN
               : REFINE_BOTH;
}

int32_t refine_stray(const yb_frame_t *frame, const yb_level_t *level)
{
    const yb_point_t *const *p = level->corner;
    uint32_t longest = 0;
    uint32_t near = 0;
    bool seen = true;
    bool wet = false;
    int32_t top = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        longest = (uint32_t)fix_max((int32_t)longest, level->edge[i].length_q7);
        near = (uint32_t)fix_max((int32_t)near, p[i]->spot.near);
        seen = seen && p[i]->spot.near > 0;
        wet = wet || p[i]->z_q8 < frame->view.water_q8;
        top = fix_max(top, p[i]->top_q8);
    }
    /* How often its edges can be halved: no part has a longer edge than its whole, and none comes
     * nearer by more than an eighth where that matters. */
    uint32_t size = longest * (seen ? near : 65535);
    size += size >> 3;
    int often = 0;
    for (; size > frame->longest; size >>= 1)
        often++;
    const relief_bound_t bound = {level->bulge_q8, level->longest};
    int32_t stray = relief_reach(frame->map, &bound, level->longest + 4 - 4 * often);
    /* What is above the water may sink to it where the ground between dips under it. */
    return wet ? fix_max(stray, top - frame->view.water_q8) : stray;
}

/* --- Triangles -------------------------------------------------------------------------------- */

/* part[pattern][k]: part k of a triangle whose edges of `pattern` are split, by its corners (0 to 2:
 * the triangle's; 3 to 5: the midpoints of edges 0 to 2) and, in the upper half, its edges (0 to 2:
 * an edge of the triangle; 3 to 5: a half of it; 6 to 8: one of those between the parts). As SPEC
 * 3.4.
 */
enum {
    PARTS = 4,
    PART_END = 6
};
static const uint8_t part_table[8][PARTS][3] = {
    {{PART_END}},
    {{0x30, 0x63, 0x22}, {0x33, 0x11, 0x62}, {PART_END}},
    {{0x41, 0x64, 0x00}, {0x44, 0x22, 0x60}, {PART_END}},
    {{0x64, 0x33, 0x41}, {0x22, 0x30, 0x73}, {0x72, 0x63, 0x44}, {PART_END}},
    {{0x52, 0x65, 0x11}, {0x55, 0x00, 0x61}, {PART_END}},
    {{0x63, 0x55, 0x30}, {0x11, 0x52, 0x75}, {0x71, 0x65, 0x33}, {PART_END}},
    {{0x65, 0x44, 0x52}, {0x00, 0x41, 0x74}, {0x70, 0x64, 0x55}, {PART_END}},
    {{0x30, 0x73, 0x55}, {0x33, 0x41, 0x84}, {0x65, 0x44, 0x52}, {0x64, 0x75, 0x83}},
};
/* The ends of the edges between the parts; 0: there is none. Where all three edges are split edge i
 * is half as long as, and parallel to, edge i of the triangle.
 */
static const uint8_t inner_table[8][3] = {
    {0, 0, 0},    {0x32, 0, 0},    {0x40, 0, 0},    {0x43, 0x32, 0},
    {0x51, 0, 0}, {0x53, 0x51, 0}, {0x54, 0x40, 0}, {0x54, 0x53, 0x43},
};

static const yb_point_t *point_of(const yb_level_t *level, int i)
{
    return i < 3 ? level->corner[i] : &level->middle[i - 3];
}

static inline int next_of(int i)
{
    return i == 2 ? 0 : i + 1;
}

void refine_root(yb_frame_t *frame, yb_level_t *level, yb_triangle_t triangle)
{
    for (int i = 0; i < 3; i++) {
        camera_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
        level->corner[i] = &frame->root[i];
    }
    int32_t rise = 0;
    level->longest = 0;
    for (int i = 0; i < 3; i++) {
        const yb_point_t *a = level->corner[i];
        const yb_point_t *b = level->corner[next_of(i)];
        refine_edge(frame, a, b, &level->edge[i]);
        level->longest = (uint8_t)fix_max(level->longest, level->edge[i].class);
        rise = fix_max(rise, fix_abs(relief_bulge(
                                 relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope),
                                 relief_dx(a->place, b->place), relief_dy(a->place, b->place))));
    }
    level->bulge_q8 = frame->map->smooth ? rise + (rise >> 1) + 16 : 16;
    level->inside = false;
}

uint8_t refine_pattern(const yb_frame_t *frame, yb_level_t *level)
{
    level->pattern = 0;
    for (int i = 0; i < 3; i++) {
        if (refine_splits(frame, level->corner[i], level->corner[next_of(i)], &level->edge[i]))
            level->pattern |= (uint8_t)(1 << i);
    }
    return level->pattern;
}

void refine_split(const yb_frame_t *frame, yb_level_t *level)
{
    for (int i = 0; i < 3; i++) {
        if ((level->pattern & 1 << i) != 0)
            refine_middle(frame, level->corner[i], level->corner[next_of(i)], level->edge[i],
                          &level->middle[i]);
    }
    for (int i = 0; i < 3; i++) {
        uint8_t ends = inner_table[level->pattern][i];
        if (ends == 0)
            return;
        const yb_point_t *a = point_of(level, ends & 15);
        const yb_point_t *b = point_of(level, ends >> 4);
        yb_edge_t *edge = &level->edge[3 + i];
        if (level->pattern != 7) {
            refine_edge(frame, a, b, edge);
            continue;
        }
        *edge = refine_half(level->edge[i]);
        edge->splits = REFINE_ASK;
        (void)refine_splits(frame, a, b, edge);
    }
}

bool refine_part(const yb_level_t *level, int k, yb_level_t *part)
{
    if (k == PARTS || part_table[level->pattern][k][0] == PART_END)
        return false;
    const uint8_t *table = part_table[level->pattern][k];
    for (int i = 0; i < 3; i++) {
        int edge = table[i] >> 4;
        part->corner[i] = point_of(level, table[i] & 15);
        part->edge[i] = edge < 3   ? level->edge[edge]
                        : edge < 6 ? refine_half(level->edge[edge - 3])
                                   : level->edge[edge - 3];
    }
    part->inside = level->inside;
    part->bulge_q8 = level->bulge_q8;
    part->longest = level->longest;
    if (level->pattern == 7) { /* all edges are halved, and the smooth part is a parabola */
        part->bulge_q8 = (level->bulge_q8 >> 2) + 12;
        part->longest = (uint8_t)fix_max(level->longest - 4, 0);
    }
    return true;
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    yb_level_t *level = frame->level;
    refine_root(frame, level, triangle);
    int32_t stray = refine_stray(frame, level);
    int32_t last = frame->screen.height - 1;
    int32_t first = 0;
    box_t box;
    if (refine_where(frame, whole, level->corner, 3, stray) == REFINE_OUT) {
        first = last;
        last = 0;
    } else if (find_box(frame, level->corner, 3, stray, &box)) {
        first = fix_clamp(box.top >> 4, 0, last);
        last = fix_clamp(box.bottom >> 4, 0, last);
    }
    frame->rows[triangle] =
        (uint8_t)(first >> frame->row_shift << 4 | last >> frame->row_shift);
}

/* --- Refinement ------------------------------------------------------------------------------- */

/* Draws a triangle that is not split any more: lit only if it covers a pixel. */
static void leaf(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 const yb_point_t *const p[3])
{
    frame->stats.refined++;
    if (raster == NULL)
        return;
    raster_setup_t setup;
    if (p[0]->spot.near == 0 || p[1]->spot.near == 0 || p[2]->spot.near == 0) {
        if (!misses(frame, view, p, 3, 0))
            frame->stats.drawn += clip_draw(frame, raster, p, shade_ground(frame, p)) ? 1 : 0;
    } else if (raster_setup(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, &setup)) {
        raster_fill(raster, &setup, shade_ground(frame, p));
        frame->stats.drawn++;
    }
}

/* Splits the edges of a level that look long; false if the triangle is done with. */
static bool open_level(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                       yb_level_t *level)
{
    level->child = 0;
    if (refine_pattern(frame, level) != 0 && !level->inside) {
        refine_where_t where =
            refine_where(frame, view, level->corner, 3, refine_stray(frame, level));
        if (where == REFINE_OUT)
            return false;
        level->inside = where == REFINE_IN;
    }
    if (level->pattern != 0 && level == &frame->level[YB_MAX_LEVELS - 1]) {
        frame->stats.depth_limited++;
        level->pattern = 0;
    }
    if (level->pattern == 0) {
        leaf(frame, view, raster, level->corner);
        return false;
    }
    refine_split(frame, level);
    return true;
}

void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle)
{
    yb_level_t *level = frame->level;
    refine_root(frame, level, triangle);
    if (!open_level(frame, view, raster, level))
        return;
    for (;;) {
        if (raster == NULL && frame->stats.refined > frame->view.max_leaves)
            return; /* counted enough: too many */
        if (refine_part(level, level->child++, level + 1)) {
            level += open_level(frame, view, raster, level + 1) ? 1 : 0;
        } else {
            if (level == frame->level)
                return;
            level--;
        }
    }
}
