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
    /* One screen size beyond each side: 3/2 from the middle. But never beyond |right|, |up| = 2
     * depth. */
    const camera_point_t *p = &corner->at;
    int32_t focal = frame->focal_q4;
    int32_t wide = fix_min(frame->screen.width * 24, 2 * focal);
    int32_t high = fix_min(frame->screen.height * 24, 2 * focal);
    int64_t inside = 0;
    switch (plane) {
    case 0:
        inside = p->depth - frame->near;
        break;
    case 1:
        inside = (int64_t)p->depth * wide - (int64_t)p->right * focal;
        break;
    case 2:
        inside = (int64_t)p->depth * wide + (int64_t)p->right * focal;
        break;
    case 3:
        inside = (int64_t)p->depth * high - (int64_t)p->up * focal;
        break;
    default:
        inside = (int64_t)p->depth * high + (int64_t)p->up * focal;
    }
    return corner->spot != NULL && inside < 0 ? 0 : inside;
}

/* Where the way from p, `from` inside, to q, `to` outside, meets the plane. */
static void cut(const corner_t *p, const corner_t *q, int64_t from, int64_t to, corner_t *cut_at)
{
    const camera_point_t *a = &p->at;
    const camera_point_t *b = &q->at;
    int64_t part_q20 = from * ((int32_t)1 << 20) / (from - to);
    cut_at->at.right = a->right + (int32_t)(((b->right - a->right) * part_q20) >> 20);
    cut_at->at.up = a->up + (int32_t)(((b->up - a->up) * part_q20) >> 20);
    cut_at->at.depth = a->depth + (int32_t)(((b->depth - a->depth) * part_q20) >> 20);
    cut_at->spot = NULL;
}

/* Cuts off what is outside a plane, in place: a convex polygon leaves a plane's inner side once, so
 * what is written is at most one corner ahead of what is read, and that one is held.
 */
static void clip_plane(const yb_frame_t *frame, polygon_t *polygon, int plane)
{
    int count = polygon->count;
    corner_t *corner = polygon->corner;
    corner_t first = corner[0];
    corner_t p = first;
    int64_t p_in = inside_of(frame, &p, plane);
    polygon->count = 0;
    for (int i = 1; i <= count; i++) {
        corner_t q = i < count ? corner[i] : first;
        int64_t q_in = inside_of(frame, &q, plane);
        if (p_in >= 0)
            corner[polygon->count++] = p;
        if (p_in >= 0 && q_in < 0)
            cut(&p, &q, p_in, q_in, &corner[polygon->count++]);
        else if (p_in < 0 && q_in >= 0)
            cut(&q, &p, q_in, p_in, &corner[polygon->count++]);
        p = q;
        p_in = q_in;
    }
}

/* A corner with a spot may lie beyond a plane that it counts as inside of, and so may what was cut
 * between it and another: camera_project wants the pyramid itself. Both are off the screen, and
 * triangles with a common edge cut it alike.
 */
static void keep_in_pyramid(polygon_t *polygon)
{
    for (int i = 0; i < polygon->count; i++) {
        camera_point_t *at = &polygon->corner[i].at;
        at->right = fix_clamp(at->right, -2 * at->depth, 2 * at->depth);
        at->up = fix_clamp(at->up, -2 * at->depth, 2 * at->depth);
    }
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
    keep_in_pyramid(&polygon);
    yb_spot_t fan[3];
    bool drawn = false;
    for (int i = 0; i < polygon.count; i++) {
        yb_spot_t *to = &fan[fix_min(i, 2)];
        const corner_t *from = &polygon.corner[i];
        if (from->spot != NULL)
            *to = *from->spot;
        else
            camera_project(frame, &from->at, to);
        if (i < 2)
            continue;
        if (raster_draw(raster, &fan[0], &fan[1], &fan[2], pixel) != RASTER_NOTHING)
            drawn = true;
        fan[1] = fan[2];
    }
    return drawn;
}
