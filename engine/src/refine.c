#include "refine.h"

#include <yamabiko/rom.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "relief.h"
#include "shade.h"

/* --- Edges ------------------------------------------------------------------------------------ */

static inline int32_t bulge_of(const yb_point_t *a, const yb_point_t *b)
{
    return relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope),
                        relief_dx(a->place, b->place), relief_dy(a->place, b->place));
}

/* Under water all along, however it is refined? Then it is seen as a straight line on a plane. */
static bool drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b, int class)
{
    int32_t rise = fix_abs(bulge_of(a, b));
    const relief_bound_t bound = {rise + (rise >> 1) + 16, class};
    return fix_max(a->z_q8, b->z_q8) + relief_reach(frame->map, &bound, 0) < frame->view.water_q8;
}

/* The nearest of an edge's ends, as 1/depth. Beyond the near distance, for what is behind it. */
static int32_t nearest(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    camera_point_t at[2];
    camera_view(frame, a->place, a->top_q8, &at[0]);
    camera_view(frame, b->place, b->top_q8, &at[1]);
    return camera_near(frame, fix_max(fix_min(at[0].depth, at[1].depth), frame->near));
}

/* Length and 1/depth have 16 bits each. With 1/depth from v to w > v, the middle of an edge of s
 * pixels is seen s/2 (w - v) / (w + v) from the middle of its spots. Where w - v is no more than a
 * quarter of w, nor s (w - v) more than 2 w, that is at most 16/7/4 pixel, and a quarter of it for
 * its halves: 0.77 in all (SPARE_Q4), and one number will do for all of the edge.
 */
yb_edge_t refine_ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                     yb_edge_t edge)
{
    int32_t change = fix_abs(a->spot.near - b->spot.near);
    int32_t near = fix_max(a->spot.near, b->spot.near);
    bool seen = change < near;
    if (!seen)
        near = nearest(frame, a, b);
    edge &= 0xffffff;
    uint32_t size = (edge & 0xffff) * (uint32_t)near;
    if (size <= frame->longest)
        return edge;
    uint32_t parity = a->place ^ b->place;
    parity |= parity >> 16;
    yb_edge_t asked = edge;
    for (; size > frame->longest && (parity & 1) == 0; size >>= 1, parity >>= 1)
        asked += REFINE_ONCE;
    if (asked == edge || (frame->even_water && fix_max(a->z_q8, b->z_q8) < frame->view.water_q8 &&
                          drowned(frame, a, b, refine_class(edge))))
        return edge;
    if (!seen || change << 2 > near) /* or there are no spots */
        return edge | REFINE_AGAIN;
    int32_t wide = fix_abs(a->spot.x_q4 - b->spot.x_q4);
    int32_t high = fix_abs(a->spot.y_q4 - b->spot.y_q4);
    return (fix_max(wide, high) >> 4) * change <= 2 * near ? asked : edge | REFINE_AGAIN;
}

yb_edge_t refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    /* Below 2^16 each, times 2^13, which has the length of a unit vector: below 2^30. */
    int32_t across = fix_abs(dx * frame->across_x + dy * frame->across_y) >> 14;
    int32_t along = fix_abs(dx * frame->along_x + dy * frame->along_y) >> 14;
    return refine_ask(frame, a, b,
                      (yb_edge_t)fix_length(across, along) | (yb_edge_t)(relief_class(dx, dy) + 4)
                                                                 << 16);
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
    int32_t z = (a->z_q8 + b->z_q8) >> 1;
    if (map->smooth)
        z += relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope), dx, dy);
    middle->place = mean2(a->place, b->place);
    middle->slope = mean2(a->slope, b->slope);
    z += relief_rough(map, middle->place, refine_class(edge), dx, dy, b->z_q8 - a->z_q8);
    middle->z_q8 = z;
    middle->top_q8 = fix_max(z, frame->view.water_q8);
    int32_t rise = middle->top_q8 - ((a->top_q8 + b->top_q8) >> 1);
    /* Half way between the ends' spots, and up by the rise. What needs more than that, and what
     * comes to lie more than a screen size off, is placed exactly. */
    if (edge < REFINE_AGAIN && a->spot.near > 0 && b->spot.near > 0 && fix_abs(rise) < 1 << 14) {
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
    SPARE_Q4 = 14 /* by which spots may be off where they should be */
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

/* For points without spots. Inside a plane is across . (right, up) + slope * depth - near >= 0;
 * depth < 2^18 and |slope| <= 2 * 2^8 make 2^27.
 */
static bool misses_planes(const yb_frame_t *frame, const refine_view_t *view,
                          const yb_point_t *const *p, int count, int32_t stray)
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
        if (most < -((((stray >> 4) + 1) * plane->lift_q9 >> 5) + 12))
            return true;
    }
    return false;
}

/* The box on the screen that holds some points and what lies between them, 1/16 pixel. */
typedef struct {
    int32_t left, right, top, bottom;
    int32_t near; /* greatest 1/depth */
} box_t;

/* False: not all of them have spots. */
static inline bool find_box(const yb_point_t *const *p, int count, box_t *box)
{
    box->near = p[0]->spot.near;
    box->left = box->right = p[0]->spot.x_q4;
    box->top = box->bottom = p[0]->spot.y_q4;
    for (int k = 1; k < count; k++) {
        const yb_spot_t *spot = &p[k]->spot;
        box->near = fix_max(box->near, spot->near);
        box->left = fix_min(box->left, spot->x_q4);
        box->right = fix_max(box->right, spot->x_q4);
        box->top = fix_min(box->top, spot->y_q4);
        box->bottom = fix_max(box->bottom, spot->y_q4);
    }
    return box->top != INT32_MIN;
}

/* Widens it for points that may move by `stray`. False: they may come nearer by more than an
 * eighth.
 */
static bool widen_box(const yb_frame_t *frame, int32_t stray, box_t *box)
{
    if (stray >= 1 << 14 || (stray * box->near) >> 3 > frame->most_bend)
        return false;
    int32_t sway = ((stray * box->near) >> 10) + 1;
    int32_t spare = SPARE_Q4 + (box->near * frame->spare_q4 >> 16);
    int32_t x = (sway * frame->sway_x_q4 >> frame->lift_shift) + spare;
    int32_t y = (sway * frame->sway_y_q4 >> frame->lift_shift) + spare;
    box->left -= x;
    box->right += x;
    box->top -= y;
    box->bottom += y;
    return true;
}

static inline bool box_misses(const refine_view_t *view, const box_t *box)
{
    return box->bottom < view->top_q4 || box->top > view->bottom_q4 || box->right < view->left_q4 ||
           box->left > view->right_q4;
}

bool refine_misses(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *const *p,
                   int count, int32_t stray)
{
    box_t box;
    if (view == NULL)
        return false;
    if (!find_box(p, count, &box) || !widen_box(frame, stray, &box))
        return misses_planes(frame, view, p, count, stray);
    return box_misses(view, &box);
}

/* How far refinement can move a point of a triangle, of which the edges of level->pattern are
 * split: by their midpoints now, and by what its parts do then. None of them has an edge that is
 * longer than the mean of the longest of all and the longest that is left whole: halves are no
 * longer, and a line from a corner to a midpoint no longer than the mean of the sides beside it.
 *
 * None of it comes nearer by more than an eighth; else the caller has to know of no limit.
 */
static int32_t limited_stray(const yb_frame_t *frame, const yb_level_t *level, int32_t near)
{
    const yb_edge_t *edge = level->edge;
    yb_edge_t longest = 0;
    yb_edge_t class = 0;
    yb_edge_t whole = 0;
    int32_t bulge = 0;
    for (int i = 0; i < 3; i++) {
        yb_edge_t length = edge[i] & 0xffff;
        longest = length > longest ? length : longest;
        whole = edge[i] < REFINE_ONCE && length > whole ? length : whole;
        class = (edge[i] & 0xff0000) > class ? edge[i] & 0xff0000 : class;
        bulge =
            fix_max(bulge, fix_abs(bulge_of(level->point[i], level->point[i == 2 ? 0 : i + 1])));
    }
    const yb_map_t *map = frame->map;
    int c = refine_class(class);
    int32_t now = (map->noise[c] * (int32_t)RELIEF_HASH_MOST >> RELIEF_NOISE_SHIFT) + 1;
    uint32_t size = (((longest + whole) >> 1) + 1) * (uint32_t)near;
    size += size >> 3;
    /* The parabola through the midpoints bulges at most 4/3 of the largest rise; rounding of 16
     * levels adds at most as many units. */
    bulge += (bulge >> 1) + 16;
    if (size <= frame->longest)
        return bulge + now;
    int often = 0;
    for (; size > frame->longest && often < 16; size >>= 1)
        often++;
    if (whole == 0)
        c = (int)fix_max(c - 4, 0);
    const relief_bound_t bound = {bulge, c};
    return now + relief_reach(map, &bound, c + 4 - 4 * often);
}

int32_t refine_stray(const yb_frame_t *frame, const yb_level_t *level)
{
    const yb_point_t *const *p = level->point;
    int32_t near = fix_max(p[0]->spot.near, fix_max(p[1]->spot.near, p[2]->spot.near));
    int32_t stray = 0;
    if (level->pattern != 0) {
        bool seen = p[0]->spot.near > 0 && p[1]->spot.near > 0 && p[2]->spot.near > 0;
        stray = limited_stray(frame, level, seen ? near : 65535);
        if (stray >= 1 << 14 || (stray * near) >> 3 > frame->most_bend)
            stray = limited_stray(frame, level, 65535);
    }
    /* What is above the water may sink to it where the ground between dips under it. */
    int32_t water = frame->view.water_q8;
    if (p[0]->z_q8 < water || p[1]->z_q8 < water || p[2]->z_q8 < water)
        stray = fix_max(stray, fix_max(p[0]->top_q8, fix_max(p[1]->top_q8, p[2]->top_q8)) - water);
    return stray;
}

/* Is nothing that a level can become in the view? Most levels lie in it as they are. */
static inline bool level_misses(const yb_frame_t *frame, const refine_view_t *view,
                                const yb_level_t *level)
{
    box_t box;
    if (!find_box(level->point, 3, &box))
        return misses_planes(frame, view, level->point, 3, refine_stray(frame, level));
    if (!box_misses(view, &box))
        return false;
    int32_t stray = refine_stray(frame, level);
    if (!widen_box(frame, stray, &box))
        return misses_planes(frame, view, level->point, 3, stray);
    return box_misses(view, &box);
}

/* --- Triangles -------------------------------------------------------------------------------- */

/* part_table[pattern] + 3 k: part k of a triangle whose edges of `pattern` are split, by its
 * corners (0 to 2: the triangle's; 3 to 5: the midpoints of edges 0 to 2) and, in the upper half,
 * its edges (0 to 2: an edge of the triangle; 3 to 5: a half of it; 6 to 8: one of those between
 * the parts). As SPEC 3.4.
 */
enum {
    PARTS = 4,
    PART_END = 6
};
static const uint8_t part_table[8][3 * PARTS + 1] YB_ROM = {
    {PART_END},
    {0x30, 0x63, 0x22, 0x33, 0x11, 0x62, PART_END},
    {0x41, 0x64, 0x00, 0x44, 0x22, 0x60, PART_END},
    {0x64, 0x33, 0x41, 0x22, 0x30, 0x73, 0x72, 0x63, 0x44, PART_END},
    {0x52, 0x65, 0x11, 0x55, 0x00, 0x61, PART_END},
    {0x63, 0x55, 0x30, 0x11, 0x52, 0x75, 0x71, 0x65, 0x33, PART_END},
    {0x65, 0x44, 0x52, 0x00, 0x41, 0x74, 0x70, 0x64, 0x55, PART_END},
    {0x30, 0x73, 0x55, 0x33, 0x41, 0x84, 0x65, 0x44, 0x52, 0x64, 0x75, 0x83, PART_END},
};
/* The ends of the edges between the parts; 0: there is none. Where all three edges are split edge i
 * is half as long as, and parallel to, edge i of the triangle.
 */
static const uint8_t inner_table[8][3] YB_ROM = {
    {0, 0, 0},    {0x32, 0, 0},    {0x40, 0, 0},    {0x43, 0x32, 0},
    {0x51, 0, 0}, {0x53, 0x51, 0}, {0x54, 0x40, 0}, {0x54, 0x53, 0x43},
};

static inline int next_of(int i)
{
    return i == 2 ? 0 : i + 1;
}

void refine_root(yb_frame_t *frame, yb_level_t *level, yb_triangle_t triangle)
{
    for (int i = 0; i < 3; i++) {
        camera_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
        level->point[i] = &frame->root[i];
    }
    for (int i = 0; i < 3; i++)
        level->edge[i] = refine_edge(frame, level->point[i], level->point[next_of(i)]);
}

uint8_t refine_pattern(const yb_frame_t *frame, yb_level_t *level)
{
    for (int i = 0; i < 3; i++) {
        if (level->edge[i] >= REFINE_ASK)
            level->edge[i] =
                refine_ask(frame, level->point[i], level->point[next_of(i)], level->edge[i]);
    }
    level->pattern = (uint8_t)((level->edge[0] >= REFINE_ONCE ? 1 : 0) |
                               (level->edge[1] >= REFINE_ONCE ? 2 : 0) |
                               (level->edge[2] >= REFINE_ONCE ? 4 : 0));
    return level->pattern;
}

void refine_split(const yb_frame_t *frame, yb_level_t *level)
{
    for (int i = 0; i < 3; i++) {
        if ((level->pattern & 1 << i) == 0)
            continue;
        level->point[3 + i] = &level->middle[i];
        level->edge[3 + i] = refine_half(level->edge[i]);
        refine_middle(frame, level->point[i], level->point[next_of(i)], level->edge[i],
                      &level->middle[i]);
    }
    const uint8_t *ends = inner_table[level->pattern];
    for (int i = 0; i < 3; i++) {
        uint8_t end = yb_rom_u8(&ends[i]);
        if (end == 0)
            break;
        const yb_point_t *a = level->point[end & 15];
        const yb_point_t *b = level->point[end >> 4];
        level->edge[6 + i] = level->pattern == 7
                                 ? refine_ask(frame, a, b, refine_half(level->edge[i]))
                                 : refine_edge(frame, a, b);
    }
}

bool refine_part(const yb_level_t *level, int k, yb_level_t *part)
{
    const uint8_t *table = &part_table[level->pattern][3 * k];
    if (yb_rom_u8(&table[0]) == PART_END)
        return false;
    for (int i = 0; i < 3; i++) {
        uint8_t entry = yb_rom_u8(&table[i]);
        part->point[i] = level->point[entry & 15];
        part->edge[i] = level->edge[entry >> 4];
    }
    return true;
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    yb_level_t *level = frame->level;
    refine_root(frame, level, triangle);
    (void)refine_pattern(frame, level);
    int32_t stray = refine_stray(frame, level);
    int32_t last = frame->screen.height - 1;
    int32_t first = 0;
    box_t box;
    if (refine_misses(frame, whole, level->point, 3, stray)) {
        first = last;
        last = 0;
    } else if (find_box(level->point, 3, &box) && widen_box(frame, stray, &box)) {
        first = fix_clamp(box.top >> 4, 0, last);
        last = fix_clamp(box.bottom >> 4, 0, last);
    }
    frame->rows[triangle] = (uint8_t)(first >> frame->row_shift << 4 | last >> frame->row_shift);
}

/* --- Refinement ------------------------------------------------------------------------------- */

static void hand_out(const raster_t *raster, const yb_point_t *const p[3])
{
    yb_vertex_t corner[3];
    for (int i = 0; i < 3; i++) {
        corner[i].x_q8 = (uint16_t)p[i]->place;
        corner[i].y_q8 = (uint16_t)(p[i]->place >> 16);
        corner[i].z_q8 = p[i]->top_q8;
        corner[i].gx_q11 = (int16_t)((int32_t)(p[i]->slope & 0xffff) - 32768);
        corner[i].gy_q11 = (int16_t)((int32_t)(p[i]->slope >> 16) - 32768);
    }
    raster->each(raster->context, &corner[0], &corner[1], &corner[2]);
}

/* Draws a triangle that is not split any more and has a corner without a spot. */
static void draw_clipped(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                         const yb_point_t *const p[3])
{
    /* Where corners with spots lie in view space is known less well. */
    if (p[0]->spot.near == 0 && p[1]->spot.near == 0 && p[2]->spot.near == 0 &&
        misses_planes(frame, view, p, 3, 0))
        return;
    if (!clip_draw(frame, raster, p, shade_ground(frame, p)))
        return;
    frame->stats.drawn++;
    if (raster->band == NULL)
        hand_out(raster, p);
}

/* Draws a triangle that a line crosses, of the shore or of a contour; false: none does. */
static bool draw_lines(const yb_frame_t *frame, const raster_t *raster,
                       const yb_point_t *const p[3], raster_look_t look, uint16_t pixel)
{
    raster_cut_t cut;
    if (!shade_cut(frame, p, pixel, &cut))
        return false;
    raster_t cutting = *raster;
    cutting.cut = &cut;
    raster_fill(&cutting, &p[0]->spot, &p[1]->spot, &p[2]->spot, look, pixel);
    return true;
}

static inline void leaf(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                        const yb_point_t *const p[3])
{
    frame->stats.refined++;
    if (raster == NULL)
        return;
    raster_look_t look = raster_look(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot);
    if (look == RASTER_NOTHING)
        return;
    if (look == RASTER_BEYOND) {
        draw_clipped(frame, view, raster, p);
        return;
    }
    frame->stats.drawn++;
    if (raster->band == NULL) {
        hand_out(raster, p);
        return;
    }
    uint16_t pixel = shade_ground(frame, p);
    if (frame->lines && draw_lines(frame, raster, p, look, pixel))
        return;
    raster_fill(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, look, pixel);
}

/* What becomes of a triangle with an edge that may be split. */
typedef enum {
    DROPPED,
    SPLIT,
    LEAF
} fate_t;

static inline fate_t open_level(yb_frame_t *frame, const refine_view_t *view, yb_level_t *level)
{
    if (refine_pattern(frame, level) == 0)
        return LEAF;
    if (level_misses(frame, view, level))
        return DROPPED;
    if (level == &frame->level[YB_MAX_LEVELS - 1]) {
        frame->stats.depth_limited++;
        return LEAF;
    }
    refine_split(frame, level);
    level->next = part_table[level->pattern];
    return SPLIT;
}

void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle)
{
    /* The first level has one part: the base triangle as it is. */
    static const uint8_t whole[4] YB_ROM = {0x00, 0x11, 0x22, PART_END};
    yb_level_t *level = frame->level;
    refine_root(frame, level, triangle);
    level->next = whole;
    for (;;) {
        const uint8_t *next = level->next;
        uint8_t first = yb_rom_u8(&next[0]);
        if (first == PART_END) {
            if (level == frame->level)
                return;
            level--;
            continue;
        }
        if (raster == NULL && frame->stats.refined > frame->view.max_leaves)
            return; /* counted enough: too many */
        level->next = next + 3;
        const uint8_t entry[3] = {first, yb_rom_u8(&next[1]), yb_rom_u8(&next[2])};
        const yb_point_t *const p[3] = {level->point[entry[0] & 15], level->point[entry[1] & 15],
                                        level->point[entry[2] & 15]};
        const yb_edge_t edge[3] = {level->edge[entry[0] >> 4], level->edge[entry[1] >> 4],
                                   level->edge[entry[2] >> 4]};
        fate_t fate = LEAF;
        if ((edge[0] | edge[1] | edge[2]) >= REFINE_ONCE) {
            for (int i = 0; i < 3; i++) {
                level[1].point[i] = p[i];
                level[1].edge[i] = edge[i];
            }
            fate = open_level(frame, view, level + 1);
        }
        if (fate == LEAF)
            leaf(frame, view, raster, p);
        level += fate == SPLIT ? 1 : 0;
    }
}
