#include "clip.h"

#include <string.h>

#include "camera.h"
#include "fix.h"

enum {
    PLANES = 5,
    MOST_CORNERS = 3 + PLANES
};

typedef struct {
    camera_point_t at;
    int32_t z_q8;
    const yb_spot_t *spot; /* a corner's own, NULL where it was cut or has none */
} corner_t;

/* How far inside a plane a point is; any unit. Coordinates are below 2^20, factors 2^17. Whatever
 * has a spot is inside, however it was rounded: else of two triangles with a common edge one would
 * be cut and the other not.
 */
static int64_t inside_of(const yb_frame_t *frame, const corner_t *corner, int plane)
{
    const camera_point_t *p = &corner->at;
    int64_t inside = p->depth - (camera_least(frame) << CAMERA_FINER);
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

/* A part of the way from one corner to another, maybe in the place of either. */
static void cut(const corner_t *from, const corner_t *to, int32_t part_q20, corner_t *cut_at)
{
    cut_at->at.right = from->at.right + fix_product(to->at.right - from->at.right, part_q20, 20);
    cut_at->at.up = from->at.up + fix_product(to->at.up - from->at.up, part_q20, 20);
    cut_at->at.depth = from->at.depth + fix_product(to->at.depth - from->at.depth, part_q20, 20);
    cut_at->z_q8 = from->z_q8 + fix_product(to->z_q8 - from->z_q8, part_q20, 20);
    cut_at->spot = NULL;
}

/* Cuts off what is outside a plane, in place: a convex polygon leaves a plane's inner side once, so
 * what is written is at most one corner ahead of what is read, and that has moved up by one. How
 * many corners are left?
 */
static int clip_plane(const yb_frame_t *frame, corner_t *corner, int count, int plane)
{
    memmove(&corner[1], &corner[0], (size_t)count * sizeof *corner);
    corner[count + 1] = corner[1];
    corner_t *left = corner;
    int64_t inside = inside_of(frame, &corner[1], plane);
    for (const corner_t *p = &corner[1]; p <= &corner[count]; p++) {
        const corner_t *q = p + 1;
        int64_t next = inside_of(frame, q, plane);
        if (inside >= 0)
            *left++ = *p;
        /* From inside to outside, so that it does not matter which is p. */
        if ((inside ^ next) < 0) {
            int64_t most = next;
            int64_t across = next - inside;
            const corner_t *from = q;
            const corner_t *to = p;
            if (next < 0) {
                most = inside;
                across = -across;
                from = p;
                to = q;
            }
            cut(from, to, (int32_t)(((uint64_t)most << 20) / (uint64_t)across), left++);
        }
        inside = next;
    }
    return (int)(left - corner);
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
    camera_project(frame, at, spot); /* but for its 1/depth, of a quarter as much */
    spot->near = (uint16_t)camera_near(frame, fix_max(at->depth >> CAMERA_FINER, frame->near));
}

bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               shade_t shade, bool lines)
{
    corner_t polygon[MOST_CORNERS + 1]; /* before the last plane room for two more */
    int count = 3;
    for (int i = 0; i < 3; i++) {
        corner_t *to = &polygon[i];
        camera_view_finely(frame, corner[i]->place, corner[i]->top_q8, &to->at);
        to->z_q8 = corner[i]->z_q8;
        to->spot = corner[i]->spot.near > 0 ? &corner[i]->spot : NULL;
    }
    for (int plane = 0; plane < PLANES && count > 0; plane++)
        count = clip_plane(frame, polygon, count, plane);
    yb_point_t fan[3];
    const yb_point_t *const p[3] = {&fan[0], &fan[1], &fan[2]};
    bool drawn = false;
    for (int i = 0; i < count; i++) {
        yb_point_t *const to = &fan[fix_min(i, 2)];
        to->place = corner[0]->place; /* of a small triangle any will do */
        to->top_q8 = corner[0]->top_q8;
        to->z_q8 = polygon[i].z_q8;
        see_corner(frame, &polygon[i], &to->spot);
        if (i < 2)
            continue;
        raster_cut_t cut;
        const bool cuts = lines && shade_cut(frame, p, shade, &cut);
        if (raster_draw(raster, &fan[0].spot, &fan[1].spot, &fan[2].spot, shade_pixel(shade),
                        cuts ? &cut : NULL) != RASTER_NOTHING)
            drawn = true;
        fan[1] = fan[2];
    }
    return drawn;
}
