/* Rays from the eye in floating point, and where they meet the front of a leaf: independent of how
 * the engine draws it.
 */
#ifndef TEST_RAYS_H
#define TEST_RAYS_H

#include <math.h>

#include <yamabiko/yamabiko.h>

#include "camera.h"

/* A corner in view space, right, up and depth: where its spot says, if it has one. */
static inline void ray_corner(const yb_frame_t *frame, const yb_point_t *corner, double p[3])
{
    camera_point_t place;
    camera_view_finely(frame, corner->place, corner->top_q8, &place);
    p[0] = place.right * pow(2, -CAMERA_FINER);
    p[1] = place.up * pow(2, -CAMERA_FINER);
    p[2] = place.depth * pow(2, -CAMERA_FINER);
    if (corner->spot.near == 0)
        return;
    p[0] = (corner->spot.x_q4 - frame->screen.width * 8) * p[2] / frame->focal_q4;
    p[1] = (frame->screen.height * 8 - corner->spot.y_q4) * p[2] / frame->focal_q4;
}

static inline double ray_determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The depth at which the ray through a place of the screen, in pixels, meets the plane of a
 * triangle from its front, or infinity; met: between its corners.
 */
static inline double ray_depth(const yb_frame_t *frame, double p[3][3], double x, double y,
                               bool *met)
{
    const double ray[3] = {(x - frame->screen.width / 2.) * 16,
                           (frame->screen.height / 2. - y) * 16, frame->focal_q4};
    /* Right, up and depth are left-handed: the front is positive. */
    const double volume = ray_determinant(p[0], p[1], p[2]);
    const double a = ray_determinant(ray, p[1], p[2]);
    const double b = ray_determinant(p[0], ray, p[2]);
    const double c = ray_determinant(p[0], p[1], ray);
    *met = volume > 0 && a >= 0 && b >= 0 && c >= 0;
    return volume > 0 && a + b + c > 0 ? volume / (a + b + c) * frame->focal_q4 : (double)INFINITY;
}

#endif
