#include "clip.h"

#include "camera.h"
#include "fix.h"

enum {
    PLANES = 5,
    MOST_CORNERS = 3 + PLANES
};

typedef struct {
    camera_point_t corner[MOST_CORNERS];
    int count;
} polygon_t;

/* How far inside a plane a point is; any unit. Coordinates are below 2^24, factors 2^17: 2^42. */
static int64_t inside_of(const yb_frame_t *frame, const camera_point_t *p, int plane)
{
    /* One screen size beyond each side: 3/2 from the middle, and two pixels more, so that whatever
     * is within_reach is inside however it was rounded: else of two triangles with a common edge
     * one would be cut and the other not. But never beyond |right|, |up| = 2 depth. */
    int32_t wide = fix_min(frame->screen.width * 24 + 32, 2 * frame->focal_q4);
    int32_t high = fix_min(frame->screen.height * 24 + 32, 2 * frame->focal_q4);
    switch (plane) {
    case 0:
        return p->depth_q8 - frame->near_q8;
    case 1:
        return (int64_t)p->depth_q8 * wide - (int64_t)p->right_q8 * frame->focal_q4;
    case 2:
        return (int64_t)p->depth_q8 * wide + (int64_t)p->right_q8 * frame->focal_q4;
    case 3:
        return (int64_t)p->depth_q8 * high - (int64_t)p->up_q8 * frame->focal_q4;
    default:
        return (int64_t)p->depth_q8 * high + (int64_t)p->up_q8 * frame->focal_q4;
    }
}

/* Where the way from p, `from` inside, to q, `to` outside, meets the plane. */
static void cut(const camera_point_t *p, const camera_point_t *q, int64_t from, int64_t to,
                camera_point_t *at)
{
    int64_t part_q20 = from * ((int32_t)1 << 20) / (from - to);
    at->right_q8 = p->right_q8 + (int32_t)(((int64_t)(q->right_q8 - p->right_q8) * part_q20) >> 20);
    at->up_q8 = p->up_q8 + (int32_t)(((int64_t)(q->up_q8 - p->up_q8) * part_q20) >> 20);
    at->depth_q8 = p->depth_q8 + (int32_t)(((int64_t)(q->depth_q8 - p->depth_q8) * part_q20) >> 20);
}

static void clip_plane(const yb_frame_t *frame, const polygon_t *in, int plane, polygon_t *out)
{
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        const camera_point_t *p = &in->corner[i];
        const camera_point_t *q = &in->corner[i + 1 == in->count ? 0 : i + 1];
        int64_t p_in = inside_of(frame, p, plane);
        int64_t q_in = inside_of(frame, q, plane);
        if (p_in >= 0)
            out->corner[out->count++] = *p;
        if (p_in >= 0 && q_in < 0)
            cut(p, q, p_in, q_in, &out->corner[out->count++]);
        else if (p_in < 0 && q_in >= 0)
            cut(q, p, q_in, p_in, &out->corner[out->count++]);
    }
}

bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               uint16_t pixel)
{
    polygon_t polygon[2];
    polygon[0].count = 3;
    for (int i = 0; i < 3; i++)
        camera_place(frame, corner[i], &polygon[0].corner[i]);
    int now = 0;
    for (int plane = 0; plane < PLANES; plane++, now ^= 1)
        clip_plane(frame, &polygon[now], plane, &polygon[now ^ 1]);
    raster_point_t fan[3];
    raster_setup_t setup;
    bool drawn = false;
    for (int i = 0; i < polygon[now].count; i++) {
        raster_point_t *to = &fan[fix_min(i, 2)];
        camera_project(frame, &polygon[now].corner[i], to);
        if (i < 2)
            continue;
        if (raster_setup(raster, fan, &setup)) {
            raster_fill(raster, &setup, pixel);
            drawn = true;
        }
        fan[1] = fan[2];
    }
    return drawn;
}

/* Within a screen size of the screen, where the rasteriser works? */
static bool within_reach(const yb_frame_t *frame, const yb_point_t *point)
{
    uint32_t wide = frame->screen.width * 16u;
    uint32_t high = frame->screen.height * 16u;
    return point->visible && (uint32_t)point->x_q4 + wide <= 3 * wide &&
           (uint32_t)point->y_q4 + high <= 3 * high;
}

bool clip_needs(const yb_frame_t *frame, const yb_point_t *const corner[3], raster_point_t to[3])
{
    for (int i = 0; i < 3; i++) {
        if (!within_reach(frame, corner[i]))
            return true;
        to[i] = (raster_point_t){corner[i]->x_q4, corner[i]->y_q4, corner[i]->near};
    }
    return false;
}
