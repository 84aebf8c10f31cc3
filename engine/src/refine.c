#include "refine.h"

#include "camera.h"
#include "fix.h"
#include "relief.h"
#include "shade.h"
#include "split.h"

/* Under water all along, however it is refined? Then it is seen as a straight line on a plane. */
static bool drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t highest = fix_max(a->at.z_q8, b->at.z_q8);
    return highest < frame->view.water_q8 &&
           highest + relief_reach(frame->map, &a->at, &b->at, &b->at) < frame->view.water_q8;
}

bool refine_splits(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t dx = b->at.x_q8 - a->at.x_q8;
    int32_t dy = b->at.y_q8 - a->at.y_q8;
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

/* --- Bounds ----------------------------------------------------------------------------------- */

/* Where all that a triangle becomes may be drawn, in 1/16 pixel. */
typedef struct {
    enum { NOWHERE, SOMEWHERE, ANYWHERE } where; /* ANYWHERE: near the eye, no bounds known */
    int32_t left, right, top, bottom;            /* for SOMEWHERE */
} extent_t;

/* Height a point may gain or lose until it is drawn: refinement, and the water over it. */
static int32_t stray_of(const yb_frame_t *frame, const yb_point_t *const p[3])
{
    int32_t reach = relief_reach(frame->map, &p[0]->at, &p[1]->at, &p[2]->at);
    int32_t water = frame->view.water_q8;
    int32_t lowest = fix_min(p[0]->at.z_q8, fix_min(p[1]->at.z_q8, p[2]->at.z_q8));
    return lowest - reach < water ? fix_max(reach, water - lowest + reach) : reach;
}

/* Is everything within `up` and `back` of the corners behind the eye, or beyond one side of the
 * pyramid of slope 2?
 */
static bool out_of_pyramid(const yb_frame_t *frame, const yb_point_t *const p[3], int32_t up,
                           int32_t back)
{
    uint32_t out = 31;
    for (int i = 0; i < 3; i++) {
        int32_t depth = p[i]->depth_q8 + back;
        uint32_t side = depth < frame->near_q8 ? 1 : 0;
        side |= p[i]->right_q8 > 2 * depth ? 2 : 0;
        side |= -p[i]->right_q8 > 2 * depth ? 4 : 0;
        side |= p[i]->up_q8 - up > 2 * depth ? 8 : 0;
        side |= -p[i]->up_q8 - up > 2 * depth ? 16 : 0;
        out &= side;
    }
    return out != 0;
}

static void find_extent(const yb_frame_t *frame, const yb_point_t *const p[3], extent_t *extent)
{
    int32_t stray = stray_of(frame, p);
    /* Below 2^19 * 2^12 >> 9, in halves so that it fits; one more for rounding. */
    int32_t up = ((stray >> 1) * frame->lift_up_q9 >> 8) + frame->lift_up_q9 / 256 + 1;
    int32_t lift_back = fix_abs(frame->lift_back_q9);
    int32_t back = ((stray >> 1) * lift_back >> 8) + lift_back / 256 + 1;
    extent->where = NOWHERE;
    if (out_of_pyramid(frame, p, up, back))
        return;
    extent->where = ANYWHERE;
    if (!p[0]->visible || !p[1]->visible || !p[2]->visible)
        return;
    /* What comes nearer than the near distance is not drawn. */
    int32_t nearest = fix_min(p[0]->depth_q8, fix_min(p[1]->depth_q8, p[2]->depth_q8)) - back;
    nearest = fix_max(nearest, frame->near_q8);
    int32_t left = fix_min(p[0]->x_q4, fix_min(p[1]->x_q4, p[2]->x_q4));
    int32_t right = fix_max(p[0]->x_q4, fix_max(p[1]->x_q4, p[2]->x_q4));
    int32_t top = fix_min(p[0]->y_q4, fix_min(p[1]->y_q4, p[2]->y_q4));
    int32_t bottom = fix_max(p[0]->y_q4, fix_max(p[1]->y_q4, p[2]->y_q4));
    /* A point at `off` focal lengths from the axis strays by at most (up + off * back) / depth focal
     * lengths. off is at most 2; mostly below 1/2, on the screen. */
    int32_t off_x = fix_max(fix_abs(left - frame->screen.width * 8),
                            fix_abs(right - frame->screen.width * 8));
    int32_t off_y = fix_max(fix_abs(top - frame->screen.height * 8),
                            fix_abs(bottom - frame->screen.height * 8));
    bool central = 2 * fix_max(off_x, off_y) <= frame->focal_q4;
    int32_t stray_q8 = up + (central ? back >> 1 : 2 * back) + 1;
    if (stray_q8 >= 1 << 20 || stray_q8 >= nearest)
        return;
    int32_t ratio_q10 = (stray_q8 << 10) / nearest; /* below 1: below 2^10 */
    int32_t margin = ((frame->focal_q4 * ratio_q10) >> 10) + (frame->focal_q4 >> 10) + 4;
    extent->where = SOMEWHERE;
    extent->left = left - margin;
    extent->right = right + margin;
    extent->top = top - margin;
    extent->bottom = bottom + margin;
    if (extent->right < 0 || extent->left > frame->screen.width * 16 || extent->bottom < 0 ||
        extent->top > frame->screen.height * 16)
        extent->where = NOWHERE;
}

void refine_bin(yb_frame_t *frame, uint16_t triangle)
{
    const yb_point_t *const p[3] = {&frame->root[0], &frame->root[1], &frame->root[2]};
    for (int i = 0; i < 3; i++)
        refine_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
    extent_t extent;
    find_extent(frame, p, &extent);
    int32_t first = 0;
    int32_t last = frame->screen.height - 1;
    if (extent.where == NOWHERE) {
        last = 0;
        first = 1 << YB_ROW_SHIFT;
    } else if (extent.where == SOMEWHERE) {
        first = fix_max(extent.top >> 4, 0);
        last = fix_min(extent.bottom >> 4, last);
    }
    frame->first_row[triangle] = (uint8_t)(first >> YB_ROW_SHIFT);
    frame->last_row[triangle] = (uint8_t)(last >> YB_ROW_SHIFT);
}

/* --- Refinement ------------------------------------------------------------------------------- */

/* What bounds say about a triangle that is about to be split. */
static bool drop(const yb_frame_t *frame, const raster_t *raster, yb_level_t *level)
{
    if (level->inside)
        return false;
    extent_t extent;
    find_extent(frame, level->corner, &extent);
    if (extent.where != SOMEWHERE)
        return extent.where == NOWHERE;
    int32_t first = raster != NULL ? raster->first_row * 16 : 0;
    int32_t end = raster != NULL ? raster->end_row * 16 : frame->screen.height * 16;
    if (extent.bottom < first || extent.top > end)
        return true;
    level->inside = extent.left >= 0 && extent.right <= frame->screen.width * 16 &&
                    extent.top >= first && extent.bottom <= end;
    return false;
}

static void leaf(yb_frame_t *frame, const raster_t *raster, const yb_point_t *const p[3])
{
    frame->stats.refined++;
    if (raster == NULL)
        return;
    uint16_t pixel = shade_ground(frame, &p[0]->at, &p[1]->at, &p[2]->at);
    if (clip_draw(frame, raster, p, pixel))
        frame->stats.drawn++;
}

/* Splits the edges of a level that look long; false if the triangle is done with. */
static bool open_level(yb_frame_t *frame, const raster_t *raster, yb_level_t *level)
{
    level->child = 0;
    level->pattern = 0;
    for (int i = 0; i < 3; i++) {
        if (refine_splits(frame, level->corner[i], level->corner[i == 2 ? 0 : i + 1]))
            level->pattern |= (uint8_t)(1 << i);
    }
    if (level->pattern != 0 && drop(frame, raster, level))
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

void refine_draw(yb_frame_t *frame, const raster_t *raster, uint16_t triangle)
{
    yb_level_t *level = frame->level;
    for (int i = 0; i < 3; i++) {
        refine_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
        level->corner[i] = &frame->root[i];
    }
    level->inside = false;
    bool down = open_level(frame, raster, level);
    for (;;) {
        if (raster == NULL && frame->stats.refined > frame->view.max_leaves)
            return; /* counted enough: too many */
        const uint8_t *child = split_child[level->pattern][level->child & 3];
        if (!down || level->child == SPLIT_CHILDREN || *child == SPLIT_END) {
            if (level == frame->level)
                return;
            level--;
            level->child++;
            down = true;
            continue;
        }
        yb_level_t *below = level + 1;
        for (int i = 0; i < 3; i++)
            below->corner[i] = child[i] < 3 ? level->corner[child[i]] : &level->middle[child[i] - 3];
        below->inside = level->inside;
        level = below;
        down = open_level(frame, raster, level);
    }
}
