#include "clip.h"

#include "camera.h"
#include "fix.h"

enum {
    PLANES = 5,
    MOST_CORNERS = 3 + PLANES
};

typedef struct {
    camera_point_t at;
    const yb_spot_t *spot; /* a corner's own, NULL where it was cut or has none */
} corner_t;

typedef struct {
    corner_t corner[MOST_CORNERS];
    int count;
} polygon_t;

/* How far inside a plane a point is; any unit. Coordinates are below 2^18, factors 2^17. Whatever
 * has a spot is inside, however it was rounded: else of two triangles with a common edge one would
 * be cut and the other not.
 */
static int64_t inside_of(const yb_frame_t *frame, const corner_t *corner, int plane)
{
    const camera_point_t *p = &corner->at;
    int64_t inside = p->depth - frame->near;
    if (plane > 0) {
        /* One screen size beyond each side: 3/2 from the middle. But never beyond |right|, |up| =
         * 2 depth. */
        bool aside = plane < 3;
        int32_t size = aside ? frame->screen.width : frame->screen.height;
        int32_t off = aside ? p->right : p->up;
        if ((plane & 1) != 0)
            off = -off;
        inside = fix_wide(p->depth, fix_min(size * 24, 2 * frame->focal_q4)) +
                 fix_wide(off, frame->focal_q4);
    }
    return corner->spot != NULL && inside < 0 ? 0 : inside;
}

/* An end of a polygon's side, and how far inside a plane it is. */
typedef struct {
    corner_t corner;
    int64_t inside;
} end_t;

/* Where the way from an end inside to one outside meets the plane. */
static void cut(const end_t *from, const end_t *to, corner_t *cut_at)
{
    const camera_point_t *a = &from->corner.at;
    const camera_point_t *b = &to->corner.at;
    uint64_t whole = (uint64_t)(from->inside - to->inside);
    int32_t part_q20 = (int32_t)(((uint64_t)from->inside << 20) / whole);
    cut_at->at.right = a->right + fix_product(b->right - a->right, part_q20, 20);
    cut_at->at.up = a->up + fix_product(b->up - a->up, part_q20, 20);
    cut_at->at.depth = a->depth + fix_product(b->depth - a->depth, part_q20, 20);
    cut_at->spot = NULL;
}

/* Cuts off what is outside a plane, in place: a convex polygon leaves a plane's inner side once, so
 * what is written is at most one corner ahead of what is read, and that one is held.
 */
static void clip_plane(const yb_frame_t *frame, polygon_t *polygon, int plane)
{
    int count = polygon->count;
    corner_t *corner = polygon->corner;
    corner[count] = corner[0]; /* before the last plane too there is room for one more */
    end_t p = {corner[0], inside_of(frame, &corner[0], plane)};
    polygon->count = 0;
    for (int i = 1; i <= count; i++) {
        end_t q = {corner[i], inside_of(frame, &corner[i], plane)};
        if (p.inside >= 0)
            corner[polygon->count++] = p.corner;
        if ((p.inside ^ q.inside) < 0) {
            const end_t *from = p.inside >= 0 ? &p : &q;
            cut(from, from == &p ? &q : &p, &corner[polygon->count++]);
        }
        p = q;
    }
}

/* A corner with a spot may lie beyond a plane that it counts as inside of, and so may what was cut
 * between it and another: camera_project wants the pyramid itself. Both are off the screen, and
 * triangles with a common edge cut it alike.
 */
static void see_corner(const yb_frame_t *frame, corner_t *corner, yb_spot_t *spot)
{
    camera_point_t *at = &corner->at;
    if (corner->spot != NULL) {
        *spot = *corner->spot;
        return;
    }
    at->right = fix_clamp(at->right, -2 * at->depth, 2 * at->depth);
    at->up = fix_clamp(at->up, -2 * at->depth, 2 * at->depth);
    camera_project(frame, at, spot);
}

bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               uint16_t pixel)
{
    polygon_t polygon = {.count = 3};
    for (int i = 0; i < 3; i++) {
        corner_t *to = &polygon.corner[i];
        camera_view(frame, corner[i]->place, corner[i]->top_q8, &to->at);
        to->spot = corner[i]->spot.near > 0 ? &corner[i]->spot : NULL;
    }
    for (int plane = 0; plane < PLANES && polygon.count > 0; plane++)
        clip_plane(frame, &polygon, plane);
    yb_spot_t fan[3];
    bool drawn = false;
    for (int i = 0; i < polygon.count; i++) {
        see_corner(frame, &polygon.corner[i], &fan[fix_min(i, 2)]);
        if (i < 2)
            continue;
        if (raster_draw(raster, &fan[0], &fan[1], &fan[2], pixel) != RASTER_NOTHING)
            drawn = true;
        fan[1] = fan[2];
    }
    return drawn;
}
