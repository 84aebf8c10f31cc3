#include "maps.h"

#include <string.h>

#include "mesh.h"
#include "random_plan.h"

static int32_t height_q8(const plan_t *plan, int coded)
{
    uint64_t cell = yb_unit_64th_m((uint16_t)plan->cell);
    uint64_t unit = yb_unit_64th_m((uint16_t)plan->unit);
    return (int32_t)(((uint64_t)coded * unit * 256 + cell / 2) / cell);
}

void map_set(yb_map_t *map, yb_load_t *load, const plan_t *plan)
{
    yb_map_begin(map, load);
    map->east_q8 = (uint16_t)(plan->east * 256);
    map->north_q8 = (uint16_t)(plan->north * 256);
    map->cell = (uint16_t)plan->cell;
    map->unit = (uint16_t)plan->unit;
    map->base_m = (int16_t)plan->base;
    map->hurst_q8m1 = (uint8_t)(255 - plan->dimension);
    map->smooth = !plan->straight;
    map->seed = (uint8_t)plan->seed;
    load->gain = (uint8_t)plan->gain;
    load->point_count = (uint16_t)plan->points;
    load->contour_count = (uint16_t)plan->contours;
    bool any = false;
    for (int k = 0; k < 4; k++) {
        if (plan->corner_height[k] >= 0) {
            load->corner_height[k] = height_q8(plan, plan->corner_height[k]);
            any = true;
        }
    }
    load->frame_height = any ? 0 : height_q8(plan, plan->frame_height);
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *c = &plan->contour[i];
        load->contour[i].first = (yb_index_t)c->first;
        load->contour[i].count = (yb_index_t)c->count;
        for (int k = c->first; k < c->first + c->count; k++) {
            yb_vertex_t *v = &map->vertex[k];
            *v = (yb_vertex_t){.x_q8 = (uint16_t)(plan->point[k].x * 256),
                               .y_q8 = (uint16_t)(plan->point[k].y * 256),
                               .z_q8 = height_q8(plan, c->height)};
        }
    }
}

yb_status_t map_triangulate(yb_map_t *map, yb_load_t *load, const plan_t *plan)
{
    map_set(map, load, plan);
    load->vertex_count = load->point_count;
    bool fits = border_close(load) && mesh_triangulate(load);
    map->vertex_count = load->vertex_count;
    if (!fits)
        return YB_ERR_CORRUPT;
    regions_find(load);
    return YB_OK;
}

yb_status_t map_link(yb_map_t *map, yb_load_t *load, const plan_t *plan)
{
    yb_status_t status = map_triangulate(map, load, plan);
    if (status == YB_OK && (!summits_add(load) || !links_add(load)))
        status = YB_ERR_LIMIT;
    load->first_skeleton = map->vertex_count = load->vertex_count;
    return status;
}

bool map_same(const yb_map_t *a, const yb_map_t *b)
{
    return memcmp(a, b, offsetof(yb_map_t, vertex)) == 0 &&
           memcmp(a->vertex, b->vertex, a->vertex_count * sizeof *a->vertex) == 0 &&
           memcmp(a->triangle, b->triangle, a->triangle_count * sizeof *a->triangle) == 0;
}

bool map_fits(const plan_t *plan)
{
    static yb_map_t map;
    static yb_load_t load;
    uint8_t bytes[PLAN_MAX_BYTES];
    return yb_map_load(&map, &load, bytes, plan_write(plan, bytes)) == YB_OK;
}

void random_fitting_plan(plan_t *plan, rng_t *rng)
{
    do
        random_plan(plan, rng);
    while (!map_fits(plan));
}

void random_gentle_plan(plan_t *plan, rng_t *rng, int most_gain)
{
    do {
        random_fitting_plan(plan, rng);
        plan->gain = plan->gain > most_gain ? most_gain : plan->gain;
        plan->unit = plan->unit > plan->cell / 4 ? plan->cell / 4 : plan->unit;
    } while (!map_fits(plan));
}

int map_vertex_at(const yb_map_t *map, double x, double y)
{
    for (int i = 0; i < map->vertex_count; i++) {
        if (map->vertex[i].x_q8 == (int)(x * 256) && map->vertex[i].y_q8 == (int)(y * 256))
            return i;
    }
    return -1;
}

int map_edge(const yb_map_t *map, const yb_load_t *load, int a, int b)
{
    for (int t = 0; t < (int)map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            int p = map->triangle[t][i];
            int q = map->triangle[t][(i + 1) % 3];
            if ((p == a && q == b) || (p == b && q == a))
                return (int)yb_edge_rule(map, load, (yb_triangle_t)t, i);
        }
    }
    return -1;
}
