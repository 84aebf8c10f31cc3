#include "refine.h"

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "relief.h"
#include "shade.h"
#include "split.h"

/* Under water all along, however it is refined? Then it is seen as a straight line on a plane. */
static bool drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t highest = fix_max(a->at.z_q8, b->at.z_q8);
    if (highest >= frame->view.water_q8)
        return false;
    relief_bound_t bound;
    relief_bound(frame->map, &a->at, &b->at, &b->at, &bound);
    return highest + relief_reach(frame->map, &bound, 0) < frame->view.water_q8;
}

bool refine_splits(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t dx = fix_minus(b->at.x_q8, a->at.x_q8);
    int32_t dy = fix_minus(b->at.y_q8, a->at.y_q8);
    if (!relief_splits(dx, dy))
        return false;
    /* By plan length over the nearest depth; both ends as they are, unclipped. Length < 2^17 and
     * split_q4 < 2^14; depth < 2^24. */
    int32_t depth = fix_max(fix_min(a->depth_q8, b->depth_q8), frame->near_q8);
    return fix_length(dx, dy) * frame->split_q4 > depth << 4 && !drowned(frame, a, b);
}

void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_point_t *middle)
{
    relief_middle(frame->map, &a->at, &b->at, &middle->at);
    /* Half way between the ends, and up by what the midpoint strays from the chord: within 2^18,
     * times the lift's 2^12. */
    int32_t rise = middle->at.z_q8 - ((a->at.z_q8 + b->at.z_q8) >> 1);
    middle->right_q8 = (a->right_q8 + b->right_q8) >> 1;
    middle->up_q8 = ((a->up_q8 + b->up_q8) >> 1) + ((rise * frame->lift_up_q9) >> 9);
    middle->depth_q8 = ((a->depth_q8 + b->depth_q8) >> 1) - ((rise * frame->lift_back_q9) >> 9);
    camera_see(frame, middle);
}

void refine_root(const yb_frame_t *frame, yb_index_t i, yb_point_t *point)
{
    point->at = frame->map->vertex[i];
    point->right_q8 = frame->seen[i].right_q8;
    point->up_q8 = frame->seen[i].up_q8;
    point->depth_q8 = frame->seen[i].depth_q8;
    camera_see(frame, point);
}

/* --- What lies outside the picture ------------------------------------------------------------ */

/* A plane of the pyramid that a band is seen through: inside is across . (right, up) + slope *
 * depth
 * - near >= 0, in q8, with the slope in 1/256.
 */
static int32_t plane_value(const refine_plane_t *plane, const yb_point_t *p)
{
    /* depth < 2^24 and |slope| <= 2 * 2^8: the product is within 2^29. Dropping 4 bits of the depth
     * loses at most 2 * 16, the last shift 1: planes lie 34 farther out than they should. */
    return plane->right * p->right_q8 + plane->up * p->up_q8 +
           (((p->depth_q8 >> 4) * plane->slope_q8) >> 4) - plane->near_q8;
}

/* The lowest length class of which an edge may be split at this depth or farther. The test of
 * refine_splits asks for length > depth * 16 / split_q4, and fix_length is up to 1/14 too long.
 */
static int shortest_split(const yb_frame_t *frame, int32_t depth)
{
    depth = fix_max(depth, frame->near_q8);
    int32_t length = (depth >> 6) * 14 / fix_max(frame->split_q4, 1) << 6;
    return relief_class(fix_min(length, 65535), 0);
}

int32_t refine_stray(const yb_frame_t *frame, const yb_point_t *const p[3])
{
    relief_bound_t bound;
    relief_bound(frame->map, &p[0]->at, &p[1]->at, &p[2]->at, &bound);
    int32_t back = ((relief_reach(frame->map, &bound, 0) >> 4) + 1) * fix_abs(frame->lift_back_q9);
    int32_t depth = fix_min(p[0]->depth_q8, fix_min(p[1]->depth_q8, p[2]->depth_q8));
    int32_t reach =
        relief_reach(frame->map, &bound, shortest_split(frame, depth - (back >> 5) - 1));
    int32_t lowest = fix_min(p[0]->at.z_q8, fix_min(p[1]->at.z_q8, p[2]->at.z_q8));
    int32_t water = frame->view.water_q8;
    return lowest - reach < water ? fix_max(reach, water - lowest) : reach;
}

bool refine_misses(const refine_view_t *view, const yb_point_t *const *p, int count, int32_t stray,
                   uint8_t *planes)
{
    for (int i = 0; i < REFINE_PLANES; i++) {
        if ((*planes & 1 << i) == 0)
            continue;
        const refine_plane_t *plane = &view->plane[i];
        /* stray < 2^19 and lift < 2^14: within 2^29 after the shift by 4. */
        int32_t margin = (((stray >> 4) + 1) * plane->lift_q9 >> 5) + 34;
        int32_t least = INT32_MAX;
        int32_t most = INT32_MIN;
        for (int k = 0; k < count; k++) {
            int32_t value = plane_value(plane, p[k]);
            least = fix_min(least, value);
            most = fix_max(most, value);
        }
        if (most < -margin)
            return true;
        if (least > margin)
            *planes &= (uint8_t) ~(1 << i);
    }
    return false;
}

/* Does nothing of what a triangle can become lie inside these planes? */
static bool outside(const yb_frame_t *frame, const refine_view_t *view,
                    const yb_point_t *const p[3], uint8_t *planes)
{
    return *planes != 0 && refine_misses(view, p, 3, refine_stray(frame, p), planes);
}

/* A slope of the picture's pyramid, in 1/256, for a line `off` sixteenths of a pixel from the
 * middle: off / focal, rounded up. The picture lies within a slope of 2.
 */
static int32_t slope_q8(const yb_frame_t *frame, int32_t off_q4)
{
    return off_q4 >= 0 ? (off_q4 * 256 + frame->focal_q4 - 1) / frame->focal_q4
                       : -(-off_q4 * 256 / frame->focal_q4);
}

void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view)
{
    int32_t wide = slope_q8(frame, frame->screen.width * 8 + 16);
    int32_t middle = frame->screen.height * 8;
    const refine_plane_t planes[REFINE_PLANES] = {
        {.slope_q8 = 256, .near_q8 = frame->near_q8},
        {.right = 1, .slope_q8 = wide},
        {.right = -1, .slope_q8 = wide},
        {.up = -1, .slope_q8 = slope_q8(frame, middle - first_row * 16 + 16)},
        {.up = 1, .slope_q8 = slope_q8(frame, end_row * 16 - middle + 16)},
    };
    for (int i = 0; i < REFINE_PLANES; i++) {
        view->plane[i] = planes[i];
        view->plane[i].lift_q9 = fix_abs(planes[i].up * frame->lift_up_q9 -
                                         ((planes[i].slope_q8 * frame->lift_back_q9) >> 8)) +
                                 2;
    }
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    const yb_point_t *const p[3] = {&frame->root[0], &frame->root[1], &frame->root[2]};
    for (int i = 0; i < 3; i++)
        refine_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
    int32_t first = 0;
    int32_t last = frame->screen.height - 1;
    uint8_t planes = REFINE_ALL_PLANES;
    if (outside(frame, whole, p, &planes)) {
        last = 0;
        first = 1 << YB_ROW_SHIFT;
    } else {
        /* All it can become lies in the prism of its corners moved up and down. */
        int32_t stray = refine_stray(frame, p);
        int32_t top = INT32_MAX;
        int32_t bottom = INT32_MIN;
        bool known = true;
        for (int k = 0; k < 6 && known; k++) {
            yb_point_t end;
            camera_drop(frame, p[k >> 1], p[k >> 1]->at.z_q8 + ((k & 1) != 0 ? stray : -stray),
                        &end);
            known = end.visible;
            top = fix_min(top, end.y_q4);
            bottom = fix_max(bottom, end.y_q4);
        }
        if (known) {
            first = fix_clamp((top >> 4) - 1, 0, last);
            last = fix_clamp((bottom >> 4) + 1, 0, last);
        }
    }
    frame->first_row[triangle] = (uint8_t)(first >> YB_ROW_SHIFT);
    frame->last_row[triangle] = (uint8_t)(last >> YB_ROW_SHIFT);
}

/* --- Refinement ------------------------------------------------------------------------------- */

/* Draws a triangle that is not split any more: lit only if it covers a pixel. */
static void leaf(yb_frame_t *frame, const raster_t *raster, const yb_point_t *const p[3])
{
    frame->stats.refined++;
    if (raster == NULL)
        return;
    raster_point_t corner[3];
    raster_setup_t setup;
    uint16_t pixel = 0;
    if (clip_needs(frame, p, corner)) {
        pixel = shade_ground(frame, &p[0]->at, &p[1]->at, &p[2]->at);
        frame->stats.drawn += clip_draw(frame, raster, p, pixel) ? 1 : 0;
    } else if (raster_setup(raster, corner, &setup)) {
        pixel = shade_ground(frame, &p[0]->at, &p[1]->at, &p[2]->at);
        raster_fill(raster, &setup, pixel);
        frame->stats.drawn++;
    }
}

/* Splits the edges of a level that look long; false if the triangle is done with. */
static bool open_level(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                       yb_level_t *level)
{
    level->child = 0;
    level->pattern = 0;
    for (int i = 0; i < 3; i++) {
        if (refine_splits(frame, level->corner[i], level->corner[i == 2 ? 0 : i + 1]))
            level->pattern = (uint8_t)(level->pattern | 1 << i);
    }
    if (level->pattern != 0 && outside(frame, view, level->corner, &level->planes))
        return false;
    if (level->pattern != 0 && level == &frame->level[YB_MAX_LEVELS - 1]) {
        frame->stats.depth_limited++;
        level->pattern = 0;
    }
    if (level->pattern == 0) {
        leaf(frame, raster, level->corner);
        return false;
    }
    for (int i = 0; i < 3; i++) {
        if ((level->pattern & 1 << i) != 0)
            refine_middle(frame, level->corner[i], level->corner[i == 2 ? 0 : i + 1],
                          &level->middle[i]);
    }
    return true;
}

void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle)
{
    yb_level_t *level = frame->level;
    for (int i = 0; i < 3; i++) {
        refine_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
        level->corner[i] = &frame->root[i];
    }
    level->planes = REFINE_ALL_PLANES;
    bool down = open_level(frame, view, raster, level);
    for (;;) {
        if (raster == NULL && frame->stats.refined > frame->view.max_leaves)
            return; /* counted enough: too many */
        const uint8_t *child = split_child[level->pattern][level->child & 3];
        if (!down || level->child == SPLIT_CHILDREN || yb_rom_u8(child) == SPLIT_END) {
            if (level == frame->level)
                return;
            level--;
            level->child++;
            down = true;
            continue;
        }
        yb_level_t *below = level + 1;
        for (int i = 0; i < 3; i++) {
            uint8_t k = yb_rom_u8(&child[i]);
            below->corner[i] = k < 3 ? level->corner[k] : &level->middle[k - 3];
        }
        below->planes = level->planes;
        level = below;
        down = open_level(frame, view, raster, level);
    }
}
