#include "relief_picture.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    double x, y; /* pixels */
    double near; /* 1 / depth; 0: not in front of the eye */
} seen_t;

typedef struct {
    yb_picture_t *picture;
    float *near; /* of each pixel */
    yb_point3_t eye, right, up, ahead;
    double focal; /* pixels */
    yb_point3_t sun;
    double step_m, base_m, scale;
    double low_m, high_m;
} scene_t;

/* Woods, meadows, soil, rock, snow; and the sky. */
static const double hues[][3] = {{62, 112, 66},  {125, 154, 82},  {176, 165, 102},
                                 {152, 121, 88}, {148, 136, 128}, {248, 248, 252}};
enum {
    HUES = sizeof(hues) / sizeof(hues[0])
};
static const uint8_t sky[3] = {206, 222, 236};
static const double nearest_steps = 0.5, skylight = 0.18;

static double dot(yb_point3_t a, yb_point3_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static yb_point3_t cross(yb_point3_t a, yb_point3_t b)
{
    return (yb_point3_t){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static yb_point3_t difference(yb_point3_t a, yb_point3_t b)
{
    return (yb_point3_t){a.x - b.x, a.y - b.y, a.z - b.z};
}

static yb_point3_t unit(yb_point3_t a)
{
    const double length = sqrt(dot(a, a));
    return length > 0 ? (yb_point3_t){a.x / length, a.y / length, a.z / length} : a;
}

static yb_point3_t from_q8(const int32_t *q8)
{
    return (yb_point3_t){q8[0] / 256.0, q8[1] / 256.0, q8[2] / 256.0};
}

static void aim(scene_t *scene, const yb_view_t *view)
{
    const double azimuth = view->azimuth_bam * acos(-1.0) / 32768;
    const yb_point3_t look = difference(from_q8(view->look_q8), from_q8(view->eye_q8));
    yb_point3_t flat = {look.x, look.y, 0};
    scene->eye = from_q8(view->eye_q8);
    scene->ahead = unit(look);
    if (dot(flat, flat) == 0)
        flat = (yb_point3_t){sin(azimuth), cos(azimuth), 0};
    scene->right = unit((yb_point3_t){flat.y, -flat.x, 0});
    scene->up = cross(scene->right, scene->ahead);
    scene->focal = view->zoom_q12 / 4096.0 * scene->picture->width;
    scene->sun = unit((yb_point3_t){view->sun_q14[0], view->sun_q14[1], view->sun_q14[2]});
}

/* Metres to steps, as the view sees them. */
static yb_point3_t place(const scene_t *scene, const yb_point3_t *point)
{
    return (yb_point3_t){point->x / scene->step_m, point->y / scene->step_m,
                         (point->z - scene->base_m) / scene->step_m * scene->scale};
}

static seen_t project(const scene_t *scene, yb_point3_t point)
{
    const yb_point3_t away = difference(point, scene->eye);
    const double depth = dot(away, scene->ahead);
    if (depth < nearest_steps)
        return (seen_t){0, 0, 0};
    return (seen_t){scene->picture->width / 2.0 + scene->focal * dot(away, scene->right) / depth,
                    scene->picture->height / 2.0 - scene->focal * dot(away, scene->up) / depth,
                    1 / depth};
}

static void tint(const scene_t *scene, yb_point3_t normal, double height_m, uint8_t colour[3])
{
    const double light = fmin(1, skylight + (1 - skylight) * fmax(0, dot(normal, scene->sun)));
    const double span = fmax(scene->high_m - scene->low_m, 1e-9);
    const double at = fmin(fmax((height_m - scene->low_m) / span, 0), 1) * (HUES - 1);
    const int hue = (int)fmin(at, HUES - 2);
    for (int i = 0; i < 3; i++)
        colour[i] =
            (uint8_t)((hues[hue][i] + (hues[hue + 1][i] - hues[hue][i]) * (at - hue)) * light);
}

static double side(seen_t a, seen_t b, double x, double y)
{
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/* Pixels whose centres lie in the triangle; 1/depth is linear on the screen. */
static void fill(const scene_t *scene, const seen_t p[3], const uint8_t colour[3])
{
    const yb_picture_t *picture = scene->picture;
    const double area = side(p[0], p[1], p[2].x, p[2].y);
    const double left = floor(fmin(fmin(p[0].x, p[1].x), p[2].x));
    const double right = ceil(fmax(fmax(p[0].x, p[1].x), p[2].x));
    const double top = floor(fmin(fmin(p[0].y, p[1].y), p[2].y));
    const double bottom = ceil(fmax(fmax(p[0].y, p[1].y), p[2].y));
    if (area == 0)
        return;
    for (int y = (int)fmax(top, 0); y < (int)fmin(bottom, picture->height); y++) {
        for (int x = (int)fmax(left, 0); x < (int)fmin(right, picture->width); x++) {
            const double a = side(p[1], p[2], x + 0.5, y + 0.5) / area;
            const double b = side(p[2], p[0], x + 0.5, y + 0.5) / area;
            const double c = 1 - a - b;
            const float near = (float)(a * p[0].near + b * p[1].near + c * p[2].near);
            const size_t at = (size_t)y * picture->width + (size_t)x;
            if (a < 0 || b < 0 || c < 0 || near <= scene->near[at])
                continue;
            scene->near[at] = near;
            for (int i = 0; i < 3; i++)
                picture->samples[at * 3 + (size_t)i] = colour[i];
        }
    }
}

static void draw_triangle(const scene_t *scene, const yb_mesh_t *mesh, const uint32_t corner[3])
{
    yb_point3_t at[3];
    seen_t seen[3];
    uint8_t colour[3];
    double height_m = 0;
    for (int i = 0; i < 3; i++) {
        at[i] = place(scene, &mesh->point[corner[i]]);
        seen[i] = project(scene, at[i]);
        height_m += mesh->point[corner[i]].z / 3;
        if (seen[i].near == 0)
            return;
    }
    const yb_point3_t normal = unit(cross(difference(at[1], at[0]), difference(at[2], at[0])));
    if (dot(normal, difference(scene->eye, at[0])) <= 0)
        return;
    tint(scene, normal, height_m, colour);
    fill(scene, seen, colour);
}

bool yb_relief_picture_draw(yb_picture_t *picture, const yb_mesh_t *mesh, const yb_map_t *map,
                            const yb_view_t *view)
{
    const size_t pixels = (size_t)picture->width * picture->height;
    scene_t scene = {.picture = picture,
                     .step_m = yb_map_cell_m(map),
                     .base_m = map->base_m,
                     .scale = view->exaggerate_q8 / 256.0,
                     .low_m = yb_map_z_m(map, map->low_q8),
                     .high_m = yb_map_z_m(map, map->high_q8),
                     .near = calloc(pixels, sizeof(float))};
    if (scene.near == NULL)
        return false;
    for (size_t i = 0; i < pixels * 3; i++)
        picture->samples[i] = sky[i % 3];
    aim(&scene, view);
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        draw_triangle(&scene, mesh, mesh->triangle[i]);
    free(scene.near);
    return true;
}
