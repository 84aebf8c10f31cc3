#include "mesh_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "surface.h"

const yb_mesh_rule_t yb_mesh_rules[YB_MESH_RULES] = {
    {"none", "none points", "completing edges", 0x8c8c8c, 0.5},
    {"contour", "contour points", "coded, and corners", 0x5b3a1e, 1.4},
    {"summit", "summit points", "summits, pits, fans", 0xd7191c, 0.9},
    {"saddle", "saddle points", "links between peaks", 0x7b2fbf, 1.3},
    {"slope", "slope points", "links down the slope", 0xe08a00, 0.9},
    {"skeleton", "skeleton points", "valleys and ridges", 0x1565d8, 1.2},
};
/* The lesser ones first. */
static const yb_rule_t edge_order[] = {YB_RULE_NONE, YB_RULE_SUMMIT, YB_RULE_SLOPE,
                                       YB_RULE_SKELETON, YB_RULE_SADDLE};

static double plan_x(const yb_vertex_t *vertex)
{
    return vertex->x_q8 / 256.0;
}

static double plan_y(const yb_mesh_plan_t *plan, const yb_vertex_t *vertex)
{
    return (plan->map->north_q8 - vertex->y_q8) / 256.0;
}

static void move_to(const yb_mesh_plan_t *plan, const yb_vertex_t *vertex)
{
    yb_drawing_move(plan->drawing, plan_x(vertex), plan_y(plan, vertex));
}

static void line_to(const yb_mesh_plan_t *plan, const yb_vertex_t *vertex)
{
    yb_drawing_line(plan->drawing, plan_x(vertex), plan_y(plan, vertex));
}

/* --- Colours ---------------------------------------------------------------------------------- */

const int32_t yb_mesh_tints[YB_MESH_STOPS] = {0x9fc69a, 0xc6d9a0, 0xece5b4,
                                              0xe0c193, 0xc99f7b, 0xe8e2de};
const int32_t yb_mesh_inks[YB_MESH_STOPS] = {0x1f6b3a, 0x5f7d1c, 0x9a7a10,
                                             0xa5560f, 0x9c2f16, 0x6e1440};

int32_t yb_mesh_ramp(const int32_t stops[YB_MESH_STOPS], double share, double light)
{
    const double at = fmin(fmax(share, 0), 1) * (YB_MESH_STOPS - 1);
    const int low = at >= YB_MESH_STOPS - 1 ? YB_MESH_STOPS - 2 : (int)at;
    int32_t colour = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const int a = stops[low] >> shift & 255, b = stops[low + 1] >> shift & 255;
        const double channel = (a + (b - a) * (at - low)) * light;
        colour |= (int32_t)lround(fmin(channel, 255)) << shift;
    }
    return colour;
}

static double share_of(const yb_map_t *map, double z_q8)
{
    return map->high_q8 > map->low_q8 ? (z_q8 - map->low_q8) / (map->high_q8 - map->low_q8) : 0.5;
}

/* Light from the north-west on a relief stretched to half as high as it is wide. */
static double light_on(const yb_mesh_plan_t *plan, const yb_vertex_t *const corner[3])
{
    const yb_map_t *map = plan->map;
    const double relief = fmax(map->high_q8 - map->low_q8, 1);
    const double stretch = 0.5 * fmax(map->east_q8, map->north_q8) / relief;
    const double ux = corner[1]->x_q8 - corner[0]->x_q8, uy = corner[1]->y_q8 - corner[0]->y_q8;
    const double vx = corner[2]->x_q8 - corner[0]->x_q8, vy = corner[2]->y_q8 - corner[0]->y_q8;
    const double uz = (corner[1]->z_q8 - corner[0]->z_q8) * stretch;
    const double vz = (corner[2]->z_q8 - corner[0]->z_q8) * stretch;
    const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const double cosine = (-nx + ny + 1.4 * nz) / (1.72 * sqrt(nx * nx + ny * ny + nz * nz));
    return 0.78 + 0.32 * cosine;
}

/* --- Lines ------------------------------------------------------------------------------------ */

static int next_point(const yb_contour_t *contour, int k)
{
    return contour->first + (k + 1) % contour->count;
}

static int segment_count(const yb_mesh_plan_t *plan, const yb_contour_t *contour)
{
    return contour->count - (yb_contour_is_open(plan->map, contour) ? 1 : 0);
}

/* For each contour how many triangles say that its left side is the lower one, less those that say
 * the right one. NULL: no memory.
 */
static int32_t *lower_sides(const yb_mesh_plan_t *plan)
{
    const yb_map_t *map = plan->map;
    const yb_load_t *load = plan->load;
    int32_t *lower = calloc((size_t)load->contour_count + 1, sizeof(*lower));
    uint16_t *contour_of = calloc((size_t)map->vertex_count + 1, sizeof(*contour_of));
    for (uint16_t i = 0; contour_of != NULL && i < load->contour_count; i++)
        for (int k = 0; k < load->contour[i].count; k++)
            contour_of[load->contour[i].first + k] = (uint16_t)(i + 1);
    for (yb_triangle_t t = 0; contour_of != NULL && lower != NULL && t < map->triangle_count; t++) {
        for (int edge = 0; edge < 3; edge++) {
            const yb_index_t a = map->triangle[t][edge], b = map->triangle[t][(edge + 1) % 3];
            if (yb_edge_rule(map, load, t, edge) != YB_RULE_CONTOUR || contour_of[a] == 0 ||
                contour_of[a] != contour_of[b])
                continue;
            const int i = contour_of[a] - 1;
            const int32_t rise =
                map->vertex[map->triangle[t][(edge + 2) % 3]].z_q8 - map->vertex[a].z_q8;
            const int falls = (rise < 0) - (rise > 0);
            const yb_contour_t *contour = &load->contour[i];
            /* in the line's direction, or, of two points, not back */
            const bool along = yb_contour_is_open(map, contour)
                                   ? b == a + 1
                                   : next_point(contour, a - contour->first) == b;
            lower[i] += along ? falls : -falls;
        }
    }
    free(contour_of);
    return lower;
}

/* Ticks of some pixels every so many pixels; side 1 is the line's left, -1 its right. */
static void draw_ticks(const yb_mesh_plan_t *plan, const yb_contour_t *contour, int side)
{
    const double every = 18 / plan->scale, length = 5 / plan->scale;
    double way = every / 2;
    const int segments = segment_count(plan, contour);
    for (int k = 0; k < segments; k++) {
        const yb_vertex_t *a = &plan->map->vertex[contour->first + k];
        const yb_vertex_t *b = &plan->map->vertex[next_point(contour, k)];
        const double x = plan_x(a), y = plan_y(plan, a);
        const double dx = plan_x(b) - x, dy = plan_y(plan, b) - y;
        const double segment = hypot(dx, dy);
        const int ticks = way < segment ? (int)ceil((segment - way) / every) : 0;
        for (int i = 0; i < ticks; i++) {
            const double share = (way + i * every) / segment;
            const double at_x = x + dx * share, at_y = y + dy * share;
            yb_drawing_move(plan->drawing, at_x, at_y);
            yb_drawing_line(plan->drawing, at_x + side * dy / segment * length,
                            at_y - side * dx / segment * length);
        }
        way += ticks * every - segment;
    }
}

static void draw_contours(const yb_mesh_plan_t *plan)
{
    const yb_map_t *map = plan->map;
    for (uint16_t i = 0; i < plan->load->contour_count; i++) {
        const yb_contour_t *contour = &plan->load->contour[i];
        if (contour->count == 1)
            continue;
        int32_t colour = yb_mesh_rules[YB_RULE_CONTOUR].colour;
        if (plan->request->stage == YB_STAGE_CONTOURS)
            colour = yb_mesh_ramp(yb_mesh_inks, share_of(map, map->vertex[contour->first].z_q8), 1);
        else if (plan->request->stage == YB_STAGE_LINKS)
            colour = YB_MESH_GREY;
        yb_ink_t ink = {.fill = YB_NO_INK,
                        .stroke = colour,
                        .width = yb_mesh_rules[YB_RULE_CONTOUR].width * plan->thin};
        yb_drawing_begin(plan->drawing, "contour", ink);
        for (int k = 0; k < contour->count; k++) {
            const yb_vertex_t *vertex = &map->vertex[contour->first + k];
            if (k == 0)
                move_to(plan, vertex);
            else
                line_to(plan, vertex);
        }
        if (!yb_contour_is_open(map, contour))
            yb_drawing_loop(plan->drawing);
        if (plan->request->stage == YB_STAGE_CONTOURS && plan->lower[i] != 0) {
            ink.width *= 0.7;
            yb_drawing_begin(plan->drawing, "lower", ink);
            draw_ticks(plan, contour, plan->lower[i] > 0 ? 1 : -1);
        }
    }
}

static void draw_frame(const yb_mesh_plan_t *plan)
{
    const double east = plan->map->east_q8 / 256.0, north = plan->map->north_q8 / 256.0;
    yb_drawing_begin(plan->drawing, "frame",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = YB_MESH_BLACK, .width = 1.2});
    yb_drawing_move(plan->drawing, 0, 0);
    yb_drawing_line(plan->drawing, east, 0);
    yb_drawing_line(plan->drawing, east, north);
    yb_drawing_line(plan->drawing, 0, north);
    yb_drawing_loop(plan->drawing);
}

/* --- Triangles and edges ---------------------------------------------------------------------- */

static bool is_flat(const yb_map_t *map, yb_triangle_t t)
{
    const yb_index_t *corner = map->triangle[t];
    return map->vertex[corner[0]].z_q8 == map->vertex[corner[1]].z_q8 &&
           map->vertex[corner[0]].z_q8 == map->vertex[corner[2]].z_q8;
}

static void draw_triangles(const yb_mesh_plan_t *plan)
{
    const yb_map_t *map = plan->map;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        const yb_vertex_t *corner[3];
        for (int i = 0; i < 3; i++)
            corner[i] = &map->vertex[map->triangle[t][i]];
        const bool flat = is_flat(map, t);
        const double mean = ((double)corner[0]->z_q8 + corner[1]->z_q8 + corner[2]->z_q8) / 3;
        const int32_t colour =
            flat ? YB_MESH_FLAT
                 : yb_mesh_ramp(yb_mesh_tints, share_of(map, mean), light_on(plan, corner));
        yb_drawing_begin(plan->drawing, flat ? "flat" : "triangle",
                         (yb_ink_t){.fill = colour, .stroke = YB_NO_INK, .crisp = true});
        move_to(plan, corner[0]);
        line_to(plan, corner[1]);
        line_to(plan, corner[2]);
        yb_drawing_loop(plan->drawing);
    }
}

static bool same_side(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b)
{
    return (a->x_q8 == b->x_q8 && (a->x_q8 == 0 || a->x_q8 == map->east_q8)) ||
           (a->y_q8 == b->y_q8 && (a->y_q8 == 0 || a->y_q8 == map->north_q8));
}

/* Of the two triangles at an edge one draws it; the frame has but one. */
static bool draws(const yb_map_t *map, yb_triangle_t t, int edge)
{
    const yb_index_t a = map->triangle[t][edge], b = map->triangle[t][(edge + 1) % 3];
    return a < b || same_side(map, &map->vertex[a], &map->vertex[b]);
}

static void draw_edges(const yb_mesh_plan_t *plan, yb_rule_t rule)
{
    const yb_map_t *map = plan->map;
    yb_drawing_begin(plan->drawing, yb_mesh_rules[rule].name,
                     (yb_ink_t){.fill = YB_NO_INK,
                                .stroke = yb_mesh_rules[rule].colour,
                                .width = yb_mesh_rules[rule].width * plan->thin});
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int edge = 0; edge < 3; edge++) {
            if (!draws(map, t, edge) || yb_edge_rule(map, plan->load, t, edge) != rule)
                continue;
            move_to(plan, &map->vertex[map->triangle[t][edge]]);
            line_to(plan, &map->vertex[map->triangle[t][(edge + 1) % 3]]);
        }
    }
}

bool yb_mesh_plan_count(yb_mesh_plan_t *plan)
{
    const yb_map_t *map = plan->map;
    for (uint16_t v = 0; v < map->vertex_count; v++)
        plan->points[yb_vertex_rule(plan->load, (yb_index_t)v)]++;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        plan->flat += is_flat(map, t);
        for (int edge = 0; edge < 3; edge++)
            if (draws(map, t, edge))
                plan->edges[yb_edge_rule(map, plan->load, t, edge)]++;
    }
    plan->lower = lower_sides(plan);
    return plan->lower != NULL;
}

/* --- Points and heights ----------------------------------------------------------------------- */

void yb_mesh_plan_height(const yb_mesh_plan_t *plan, int32_t z_q8, char text[16])
{
    const yb_map_t *map = plan->map;
    const bool low = yb_map_z_m(map, map->high_q8) - yb_map_z_m(map, map->low_q8) < 30;
    snprintf(text, 16, "%.*f", low ? 1 : 0, yb_map_z_m(map, z_q8));
}

/* On the line, along a segment of it, if there is room. */
static bool label_segment(yb_mesh_plan_t *plan, const yb_contour_t *contour, int k, int32_t colour)
{
    const yb_vertex_t *a = &plan->map->vertex[contour->first + k];
    const yb_vertex_t *b = &plan->map->vertex[next_point(contour, k)];
    const double x = (plan_x(a) + plan_x(b)) / 2, y = (plan_y(plan, a) + plan_y(plan, b)) / 2;
    double angle = atan2(plan_y(plan, b) - plan_y(plan, a), plan_x(b) - plan_x(a));
    if (angle > acos(0.0))
        angle -= acos(-1.0);
    if (angle < -acos(0.0))
        angle += acos(-1.0);
    yb_label_t label = {.size = 10,
                        .turned = angle * 180 / acos(-1.0),
                        .anchor = YB_TEXT_MIDDLE,
                        .colour = colour,
                        .halo = YB_MESH_WHITE};
    char text[16];
    yb_mesh_plan_height(plan, a->z_q8, text);
    const double across = yb_drawing_text_width(label.size, text), up = label.size;
    const double wide = across * fabs(cos(angle)) + up * fabs(sin(angle));
    const double high = across * fabs(sin(angle)) + up * fabs(cos(angle));
    if (!yb_label_room_take(&plan->room, x * plan->scale, y * plan->scale, wide + 2, high + 2))
        return false;
    const double down = 0.35 * label.size / plan->scale; /* the letters' middle on the line */
    label.x = x - down * sin(angle);
    label.y = y + down * cos(angle);
    yb_drawing_text(plan->drawing, &label, text);
    return true;
}

/* At the longest segment, or one of eight along the line. */
static void label_contour(yb_mesh_plan_t *plan, const yb_contour_t *contour)
{
    const yb_vertex_t *vertex = plan->map->vertex;
    const int segments = segment_count(plan, contour);
    double longest = 0;
    int best = 0;
    for (int k = 0; k < segments; k++) {
        const yb_vertex_t *a = &vertex[contour->first + k], *b = &vertex[next_point(contour, k)];
        const double length = hypot(a->x_q8 - b->x_q8, a->y_q8 - b->y_q8);
        if (length > longest) {
            longest = length;
            best = k;
        }
    }
    int32_t colour = 0x606060;
    if (plan->request->stage == YB_STAGE_CONTOURS)
        colour = yb_mesh_ramp(yb_mesh_inks, share_of(plan->map, vertex[contour->first].z_q8), 1);
    else if (plan->request->stage == YB_STAGE_TRIANGLES)
        colour = yb_mesh_rules[YB_RULE_CONTOUR].colour;
    for (int i = 0; i < 8; i++)
        if (label_segment(plan, contour, (best + i * segments / 8) % segments, colour))
            return;
}

/* Beside a point, on the first side that is free. */
static void label_point(yb_mesh_plan_t *plan, const yb_vertex_t *vertex, double size, double away,
                        int32_t colour, bool bold)
{
    static const int sides[][2] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, 1}};
    char text[16];
    yb_mesh_plan_height(plan, vertex->z_q8, text);
    const double wide = yb_drawing_text_width(size, text), high = size;
    for (size_t i = 0; i < sizeof(sides) / sizeof(sides[0]); i++) {
        const double x = plan_x(vertex) * plan->scale + sides[i][0] * (away + wide / 2);
        const double y = plan_y(plan, vertex) * plan->scale + sides[i][1] * (away + high / 2);
        if (!yb_label_room_take(&plan->room, x, y, wide, high))
            continue;
        const yb_label_t label = {.x = x / plan->scale,
                                  .y = (y + 0.35 * size) / plan->scale,
                                  .size = size,
                                  .anchor = YB_TEXT_MIDDLE,
                                  .colour = colour,
                                  .halo = YB_MESH_WHITE,
                                  .bold = bold};
        yb_drawing_text(plan->drawing, &label, text);
        return;
    }
}

static void draw_spots(const yb_mesh_plan_t *plan, int32_t colour)
{
    const double r = 5 / plan->scale;
    yb_drawing_begin(plan->drawing, "spot",
                     (yb_ink_t){.fill = colour, .stroke = YB_MESH_WHITE, .width = 0.8});
    for (uint16_t i = 0; i < plan->load->contour_count; i++) {
        if (plan->load->contour[i].count != 1)
            continue;
        const yb_vertex_t *vertex = &plan->map->vertex[plan->load->contour[i].first];
        const double x = plan_x(vertex), y = plan_y(plan, vertex);
        yb_drawing_move(plan->drawing, x, y - r);
        yb_drawing_line(plan->drawing, x + 0.87 * r, y + 0.5 * r);
        yb_drawing_line(plan->drawing, x - 0.87 * r, y + 0.5 * r);
        yb_drawing_loop(plan->drawing);
    }
}

static void draw_added_points(const yb_mesh_plan_t *plan)
{
    for (int rule = YB_RULE_SUMMIT; rule < YB_MESH_RULES; rule++) {
        if (plan->points[rule] == 0)
            continue;
        yb_drawing_begin(plan->drawing, yb_mesh_rules[rule].points,
                         (yb_ink_t){.fill = yb_mesh_rules[rule].colour,
                                    .stroke = YB_MESH_WHITE,
                                    .width = 0.5 * plan->thin});
        for (uint16_t v = 0; v < plan->map->vertex_count; v++) {
            if ((int)yb_vertex_rule(plan->load, (yb_index_t)v) != rule)
                continue;
            const yb_vertex_t *vertex = &plan->map->vertex[v];
            yb_drawing_dot(plan->drawing, plan_x(vertex), plan_y(plan, vertex), 3.4 * plan->thin);
        }
    }
}

static void block_point(yb_mesh_plan_t *plan, const yb_vertex_t *vertex, double size)
{
    yb_label_room_block(&plan->room, plan_x(vertex) * plan->scale,
                        plan_y(plan, vertex) * plan->scale, size, size);
}

/* Labels go round the points: these first, then spot heights, contours, points that were added. */
static void write_heights(yb_mesh_plan_t *plan)
{
    const yb_map_t *map = plan->map;
    const yb_load_t *load = plan->load;
    const bool added = plan->request->stage != YB_STAGE_CONTOURS && plan->thin > 0.4;
    for (uint16_t i = 0; i < load->contour_count; i++)
        if (load->contour[i].count == 1)
            block_point(plan, &map->vertex[load->contour[i].first], 9);
    for (uint16_t v = load->first_summit; added && v < map->vertex_count; v++)
        block_point(plan, &map->vertex[v], 4 * plan->thin);
    for (uint16_t i = 0; i < load->contour_count; i++)
        if (load->contour[i].count == 1)
            label_point(plan, &map->vertex[load->contour[i].first], 11, 8, YB_MESH_BLACK, true);
    for (uint16_t i = 0; i < load->contour_count; i++)
        if (load->contour[i].count > 1)
            label_contour(plan, &load->contour[i]);
    for (uint16_t v = load->first_summit; added && v < map->vertex_count; v++)
        label_point(plan, &map->vertex[v], 8, 6,
                    yb_mesh_rules[yb_vertex_rule(load, (yb_index_t)v)].colour, false);
}

void yb_mesh_plan_draw(yb_mesh_plan_t *plan)
{
    const yb_stage_t stage = plan->request->stage;
    yb_drawing_place(plan->drawing, plan->left, plan->top, plan->scale);
    if (stage == YB_STAGE_TRIANGLES)
        draw_triangles(plan);
    if (stage == YB_STAGE_LINKS)
        draw_contours(plan);
    for (size_t i = 0; i < sizeof(edge_order) / sizeof(edge_order[0]); i++)
        if (stage != YB_STAGE_CONTOURS && plan->edges[edge_order[i]] > 0 &&
            (stage == YB_STAGE_TRIANGLES || edge_order[i] != YB_RULE_NONE))
            draw_edges(plan, edge_order[i]);
    if (stage != YB_STAGE_LINKS)
        draw_contours(plan);
    draw_frame(plan);
    draw_spots(plan, stage == YB_STAGE_LINKS ? 0x606060 : YB_MESH_BLACK);
    if (stage != YB_STAGE_CONTOURS)
        draw_added_points(plan);
    write_heights(plan);
}
