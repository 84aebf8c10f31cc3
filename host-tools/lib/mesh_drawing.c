#include "mesh_drawing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "drawing.h"
#include "label_room.h"
#include "surface.h"

enum {
    RULES = YB_RULE_SKELETON + 1,
    MARGIN = 16,
    PLAIN_MARGIN = 2,
    TITLE = 34,
    LEGEND = 236,
    LEGEND_HEIGHT = 330,
    ROW = 20,
    GREY = 0xa8a8a8,
    BLACK = 0x202020,
    WHITE = 0xffffff,
    FLAT = 0xff2fd0
};

/* By yb_rule_t; the lesser ones are drawn first. */
static const struct {
    const char *name, *points, *what;
    int32_t colour;
    double width;
} rules[RULES] = {
    {"none", "none points", "completing edges", 0x8c8c8c, 0.5},
    {"contour", "contour points", "coded, and corners", 0x5b3a1e, 1.4},
    {"summit", "summit points", "summits, pits, fans", 0xd7191c, 0.9},
    {"saddle", "saddle points", "links between peaks", 0x7b2fbf, 1.3},
    {"slope", "slope points", "links down the slope", 0xe08a00, 0.9},
    {"skeleton", "skeleton points", "valleys and ridges", 0x1565d8, 1.2},
};
static const yb_rule_t edge_order[] = {YB_RULE_NONE, YB_RULE_SUMMIT, YB_RULE_SLOPE,
                                       YB_RULE_SKELETON, YB_RULE_SADDLE};

typedef struct {
    const yb_map_t *map;
    const yb_load_t *load;
    const yb_mesh_drawing_t *request;
    yb_drawing_t *drawing;
    yb_label_room_t room; /* of the plan, in pixels from its corner */
    double left, top;     /* of the plan, in pixels */
    double scale;         /* pixels a step */
    double width, height; /* of the page */
    double thin;          /* lines get thinner where there are many */
    int edges[RULES], points[RULES];
    int flat;
} plan_t;

bool yb_mesh_drawing_named(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && (strcasecmp(dot, ".svg") == 0 || strcasecmp(dot, ".png") == 0);
}

static double plan_x(const yb_vertex_t *vertex)
{
    return vertex->x_q8 / 256.0;
}

static double plan_y(const plan_t *plan, const yb_vertex_t *vertex)
{
    return (plan->map->north_q8 - vertex->y_q8) / 256.0;
}

static void move_to(const plan_t *plan, const yb_vertex_t *vertex)
{
    yb_drawing_move(plan->drawing, plan_x(vertex), plan_y(plan, vertex));
}

static void line_to(const plan_t *plan, const yb_vertex_t *vertex)
{
    yb_drawing_line(plan->drawing, plan_x(vertex), plan_y(plan, vertex));
}

/* --- Colours ---------------------------------------------------------------------------------- */

static const int32_t tints[] = {0x9fc69a, 0xc6d9a0, 0xece5b4, 0xe0c193, 0xc99f7b, 0xe8e2de};
static const int32_t inks[] = {0x1f6b3a, 0x5f7d1c, 0x9a7a10, 0xa5560f, 0x9c2f16, 0x6e1440};
enum {
    STOPS = 6
};

/* A colour of a ramp, share 0 to 1, times a brightness. */
static int32_t ramp(const int32_t stops[STOPS], double share, double light)
{
    const double at = fmin(fmax(share, 0), 1) * (STOPS - 1);
    const int low = at >= STOPS - 1 ? STOPS - 2 : (int)at;
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
static double light_on(const plan_t *plan, const yb_vertex_t *const corner[3])
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

/* For each contour how many triangles say that its left side is the lower one, less those that say
 * the right one. NULL: no memory.
 */
static int32_t *lower_sides(const plan_t *plan)
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
            const bool along =
                contour->open ? b == a + 1 : next_point(contour, a - contour->first) == b;
            lower[i] += along ? falls : -falls;
        }
    }
    free(contour_of);
    return lower;
}

/* Ticks of some pixels every so many pixels; side 1 is the line's left, -1 its right. */
static void draw_ticks(const plan_t *plan, const yb_contour_t *contour, int side)
{
    const double every = 18 / plan->scale, length = 5 / plan->scale;
    double way = every / 2;
    for (int k = 0; k + (contour->open ? 1 : 0) < contour->count; k++) {
        const yb_vertex_t *a = &plan->map->vertex[contour->first + k];
        const yb_vertex_t *b = &plan->map->vertex[next_point(contour, k)];
        const double x = plan_x(a), y = plan_y(plan, a);
        const double dx = plan_x(b) - x, dy = plan_y(plan, b) - y;
        const double segment = hypot(dx, dy);
        for (; way < segment; way += every) {
            const double at_x = x + dx * way / segment, at_y = y + dy * way / segment;
            yb_drawing_move(plan->drawing, at_x, at_y);
            yb_drawing_line(plan->drawing, at_x + side * dy / segment * length,
                            at_y - side * dx / segment * length);
        }
        way -= segment;
    }
}

static void draw_contours(const plan_t *plan, const int32_t *lower)
{
    const yb_map_t *map = plan->map;
    for (uint16_t i = 0; i < plan->load->contour_count; i++) {
        const yb_contour_t *contour = &plan->load->contour[i];
        if (contour->count == 1)
            continue;
        int32_t colour = rules[YB_RULE_CONTOUR].colour;
        if (plan->request->stage == YB_STAGE_CONTOURS)
            colour = ramp(inks, share_of(map, map->vertex[contour->first].z_q8), 1);
        else if (plan->request->stage == YB_STAGE_LINKS)
            colour = GREY;
        yb_ink_t ink = {.fill = YB_NO_INK,
                        .stroke = colour,
                        .width = rules[YB_RULE_CONTOUR].width * plan->thin};
        yb_drawing_begin(plan->drawing, "contour", ink);
        for (int k = 0; k < contour->count; k++) {
            const yb_vertex_t *vertex = &map->vertex[contour->first + k];
            if (k == 0)
                move_to(plan, vertex);
            else
                line_to(plan, vertex);
        }
        if (!contour->open)
            yb_drawing_loop(plan->drawing);
        if (plan->request->stage == YB_STAGE_CONTOURS && lower[i] != 0) {
            ink.width *= 0.7;
            yb_drawing_begin(plan->drawing, "lower", ink);
            draw_ticks(plan, contour, lower[i] > 0 ? 1 : -1);
        }
    }
}

static void draw_frame(const plan_t *plan)
{
    const double east = plan->map->east_q8 / 256.0, north = plan->map->north_q8 / 256.0;
    yb_drawing_begin(plan->drawing, "frame",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = BLACK, .width = 1.2});
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

static void draw_triangles(const plan_t *plan)
{
    const yb_map_t *map = plan->map;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        const yb_vertex_t *corner[3];
        for (int i = 0; i < 3; i++)
            corner[i] = &map->vertex[map->triangle[t][i]];
        const bool flat = is_flat(map, t);
        const double mean = ((double)corner[0]->z_q8 + corner[1]->z_q8 + corner[2]->z_q8) / 3;
        const int32_t colour =
            flat ? FLAT : ramp(tints, share_of(map, mean), light_on(plan, corner));
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

static void draw_edges(const plan_t *plan, yb_rule_t rule)
{
    const yb_map_t *map = plan->map;
    yb_drawing_begin(plan->drawing, rules[rule].name,
                     (yb_ink_t){.fill = YB_NO_INK,
                                .stroke = rules[rule].colour,
                                .width = rules[rule].width * plan->thin});
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int edge = 0; edge < 3; edge++) {
            if (!draws(map, t, edge) || yb_edge_rule(map, plan->load, t, edge) != rule)
                continue;
            move_to(plan, &map->vertex[map->triangle[t][edge]]);
            line_to(plan, &map->vertex[map->triangle[t][(edge + 1) % 3]]);
        }
    }
}

static void count_all(plan_t *plan)
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
}

/* --- Points and heights ----------------------------------------------------------------------- */

static void height_text(const plan_t *plan, int32_t z_q8, char text[16])
{
    const yb_map_t *map = plan->map;
    const bool low = yb_map_z_m(map, map->high_q8) - yb_map_z_m(map, map->low_q8) < 30;
    snprintf(text, 16, "%.*f", low ? 1 : 0, yb_map_z_m(map, z_q8));
}

/* On the line, along a segment of it, if there is room. */
static bool label_segment(plan_t *plan, const yb_contour_t *contour, int k, int32_t colour)
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
                        .halo = WHITE};
    char text[16];
    height_text(plan, a->z_q8, text);
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
static void label_contour(plan_t *plan, const yb_contour_t *contour)
{
    const yb_vertex_t *vertex = plan->map->vertex;
    const int segments = contour->count - (contour->open ? 1 : 0);
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
        colour = ramp(inks, share_of(plan->map, vertex[contour->first].z_q8), 1);
    else if (plan->request->stage == YB_STAGE_TRIANGLES)
        colour = rules[YB_RULE_CONTOUR].colour;
    for (int i = 0; i < 8; i++)
        if (label_segment(plan, contour, (best + i * segments / 8) % segments, colour))
            return;
}

/* Beside a point, on the first side that is free. */
static void label_point(plan_t *plan, const yb_vertex_t *vertex, double size, double away,
                        int32_t colour, bool bold)
{
    static const int sides[][2] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, 1}};
    char text[16];
    height_text(plan, vertex->z_q8, text);
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
                                  .halo = WHITE,
                                  .bold = bold};
        yb_drawing_text(plan->drawing, &label, text);
        return;
    }
}

static void draw_spots(const plan_t *plan, int32_t colour)
{
    const double r = 5 / plan->scale;
    yb_drawing_begin(plan->drawing, "spot",
                     (yb_ink_t){.fill = colour, .stroke = WHITE, .width = 0.8});
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

static void draw_added_points(const plan_t *plan)
{
    for (int rule = YB_RULE_SUMMIT; rule < RULES; rule++) {
        if (plan->points[rule] == 0)
            continue;
        yb_drawing_begin(
            plan->drawing, rules[rule].points,
            (yb_ink_t){.fill = rules[rule].colour, .stroke = WHITE, .width = 0.5 * plan->thin});
        for (uint16_t v = 0; v < plan->map->vertex_count; v++) {
            if ((int)yb_vertex_rule(plan->load, (yb_index_t)v) != rule)
                continue;
            const yb_vertex_t *vertex = &plan->map->vertex[v];
            yb_drawing_dot(plan->drawing, plan_x(vertex), plan_y(plan, vertex), 3.4 * plan->thin);
        }
    }
}

static void block_point(plan_t *plan, const yb_vertex_t *vertex, double size)
{
    yb_label_room_block(&plan->room, plan_x(vertex) * plan->scale,
                        plan_y(plan, vertex) * plan->scale, size, size);
}

/* Labels go round the points: these first, then spot heights, contours, points that were added. */
static void write_heights(plan_t *plan)
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
            label_point(plan, &map->vertex[load->contour[i].first], 11, 8, BLACK, true);
    for (uint16_t i = 0; i < load->contour_count; i++)
        if (load->contour[i].count > 1)
            label_contour(plan, &load->contour[i]);
    for (uint16_t v = load->first_summit; added && v < map->vertex_count; v++)
        label_point(plan, &map->vertex[v], 8, 6, rules[yb_vertex_rule(load, (yb_index_t)v)].colour,
                    false);
}

/* --- The page --------------------------------------------------------------------------------- */

static void write_at(const plan_t *plan, double x, double y, double size, yb_anchor_t anchor,
                     bool bold, const char *text)
{
    const yb_label_t label = {.x = x,
                              .y = y,
                              .size = size,
                              .anchor = anchor,
                              .colour = BLACK,
                              .halo = YB_NO_INK,
                              .bold = bold};
    yb_drawing_text(plan->drawing, &label, text);
}

static void write_number(const plan_t *plan, double x, double y, int value)
{
    char text[16];
    snprintf(text, sizeof(text), "%d", value);
    write_at(plan, x, y, 11, YB_TEXT_END, false, text);
}

static void key_line(const plan_t *plan, double x, double y, int32_t colour, double width)
{
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = colour, .width = width});
    yb_drawing_move(plan->drawing, x, y - 4);
    yb_drawing_line(plan->drawing, x + 22, y - 4);
}

static void key_box(const plan_t *plan, double x, double y, double width, int32_t colour)
{
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = colour, .stroke = YB_NO_INK, .crisp = true});
    yb_drawing_move(plan->drawing, x, y - 10);
    yb_drawing_line(plan->drawing, x + width, y - 10);
    yb_drawing_line(plan->drawing, x + width, y + 2);
    yb_drawing_line(plan->drawing, x, y + 2);
    yb_drawing_loop(plan->drawing);
}

/* The rules, how many points and edges each has. */
static double draw_rule_table(const plan_t *plan, double x, double y)
{
    write_at(plan, x + 182, y, 10, YB_TEXT_END, false, "points");
    write_at(plan, x + 226, y, 10, YB_TEXT_END, false, "edges");
    for (int rule = YB_RULE_CONTOUR; rule <= RULES; rule++) {
        const int of = rule == RULES ? YB_RULE_NONE : rule;
        if (of == YB_RULE_NONE && plan->request->stage == YB_STAGE_LINKS)
            continue;
        const bool grey = of == YB_RULE_CONTOUR && plan->request->stage == YB_STAGE_LINKS;
        y += ROW;
        key_line(plan, x, y, grey ? (int32_t)GREY : rules[of].colour, 2);
        if (of >= YB_RULE_SUMMIT && plan->points[of] > 0)
            yb_drawing_dot(plan->drawing, x + 11, y - 4, 2);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, rules[of].what);
        if (of != YB_RULE_NONE && of != YB_RULE_SLOPE)
            write_number(plan, x + 182, y, plan->points[of]);
        write_number(plan, x + 226, y, plan->edges[of]);
    }
    return y;
}

static void draw_height_bar(const plan_t *plan, double x, double y, const int32_t stops[STOPS])
{
    enum {
        PARTS = 24
    };
    char text[16];
    for (int i = 0; i < PARTS; i++)
        key_box(plan, x + i * 9, y, 9, ramp(stops, (i + 0.5) / PARTS, 1));
    height_text(plan, plan->map->low_q8, text);
    write_at(plan, x, y + 16, 11, YB_TEXT_START, false, text);
    height_text(plan, plan->map->high_q8, text);
    strcat(text, " m");
    write_at(plan, x + 9 * PARTS, y + 16, 11, YB_TEXT_END, false, text);
}

/* A length of 1, 2 or 5 and noughts that is about a third of the legend. */
static void draw_scale_bar(const plan_t *plan, double x, double y)
{
    const double metre = plan->scale / yb_map_cell_m(plan->map);
    const double power = pow(10, floor(log10(100 / metre)));
    const double most = 100 / metre / power;
    const double length = (most >= 5 ? 5 : most >= 2 ? 2 : 1) * power;
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = BLACK, .width = 1.5});
    yb_drawing_move(plan->drawing, x, y - 4);
    yb_drawing_line(plan->drawing, x, y);
    yb_drawing_line(plan->drawing, x + length * metre, y);
    yb_drawing_line(plan->drawing, x + length * metre, y - 4);
    char text[40];
    snprintf(text, sizeof(text), "%g %s", length >= 1000 ? length / 1000 : length,
             length >= 1000 ? "km" : "m");
    write_at(plan, x + length * metre + 6, y, 11, YB_TEXT_START, false, text);
}

static void draw_legend(const plan_t *plan)
{
    const yb_stage_t stage = plan->request->stage;
    const double x = plan->width - LEGEND;
    double y = plan->top + 12;
    int lines = 0;
    for (uint16_t i = 0; i < plan->load->contour_count; i++)
        lines += plan->load->contour[i].count > 1;
    if (stage == YB_STAGE_CONTOURS) {
        key_line(plan, x, y, rules[YB_RULE_CONTOUR].colour, 1.4);
        yb_drawing_move(plan->drawing, x + 11, y - 4);
        yb_drawing_line(plan->drawing, x + 11, y + 2);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "contours, lower side");
        write_number(plan, x + 226, y, lines);
    } else {
        y = draw_rule_table(plan, x, y);
    }
    y += ROW;
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = BLACK, .stroke = YB_NO_INK, .width = 0});
    yb_drawing_move(plan->drawing, x + 11, y - 9);
    yb_drawing_line(plan->drawing, x + 15.4, y - 1.5);
    yb_drawing_line(plan->drawing, x + 6.6, y - 1.5);
    yb_drawing_loop(plan->drawing);
    write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "spot heights");
    write_number(plan, x + 226, y, plan->load->contour_count - lines);
    if (stage == YB_STAGE_TRIANGLES) {
        y += ROW;
        key_box(plan, x, y, 22, FLAT);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "flat triangles");
        write_number(plan, x + 226, y, plan->flat);
    }
    y += 2 * ROW;
    if (stage != YB_STAGE_LINKS) {
        draw_height_bar(plan, x, y, stage == YB_STAGE_CONTOURS ? inks : tints);
        y += 3 * ROW;
    }
    draw_scale_bar(plan, x, y);
}

static void lay_out(plan_t *plan)
{
    const yb_mesh_drawing_t *request = plan->request;
    const double east = plan->map->east_q8 / 256.0, north = plan->map->north_q8 / 256.0;
    const double margin = request->plain ? PLAIN_MARGIN : MARGIN;
    const double room = request->width - 2 * margin - (request->plain ? 0 : LEGEND + 4);
    plan->scale = room / fmax(east, north);
    plan->left = margin;
    plan->top = margin + (request->plain ? 0 : TITLE);
    plan->width = request->plain ? ceil(east * plan->scale + 2 * margin) : request->width;
    double height = north * plan->scale;
    if (!request->plain)
        height = fmax(height, LEGEND_HEIGHT);
    plan->height = ceil(plan->top + height + margin);
    const double triangle = plan->scale * sqrt(east * north / plan->map->triangle_count);
    plan->thin = fmin(fmax(triangle / 12, 0.15), 1);
}

static void write_title(const plan_t *plan, char *text, size_t size)
{
    const int added = plan->map->vertex_count - plan->load->first_summit;
    snprintf(text, size, "%.200s: %d vertices, %d of them added, %d triangles", plan->request->name,
             (int)plan->map->vertex_count, added, (int)plan->map->triangle_count);
}

static void draw_plan(plan_t *plan, const int32_t *lower)
{
    const yb_stage_t stage = plan->request->stage;
    yb_drawing_place(plan->drawing, plan->left, plan->top, plan->scale);
    if (stage == YB_STAGE_TRIANGLES)
        draw_triangles(plan);
    if (stage == YB_STAGE_LINKS)
        draw_contours(plan, lower);
    for (size_t i = 0; i < sizeof(edge_order) / sizeof(edge_order[0]); i++)
        if (stage != YB_STAGE_CONTOURS && plan->edges[edge_order[i]] > 0 &&
            (stage == YB_STAGE_TRIANGLES || edge_order[i] != YB_RULE_NONE))
            draw_edges(plan, edge_order[i]);
    if (stage != YB_STAGE_LINKS)
        draw_contours(plan, lower);
    draw_frame(plan);
    draw_spots(plan, stage == YB_STAGE_LINKS ? 0x606060 : BLACK);
    if (stage != YB_STAGE_CONTOURS)
        draw_added_points(plan);
    write_heights(plan);
}

bool yb_mesh_drawing_write(const char *path, bool force, const yb_map_t *map, const yb_load_t *load,
                           const yb_mesh_drawing_t *request, yb_error_t *error)
{
    plan_t plan = {.map = map, .load = load, .request = request};
    char title[320];
    count_all(&plan);
    lay_out(&plan);
    write_title(&plan, title, sizeof(title));
    const char *dot = strrchr(path, '.');
    const yb_page_t page = {.path = path,
                            .png = dot != NULL && strcasecmp(dot, ".png") == 0,
                            .force = force,
                            .width = plan.width,
                            .height = plan.height,
                            .title = title};
    int32_t *lower = lower_sides(&plan);
    bool good = yb_label_room_init(&plan.room, plan.width, plan.height) && lower != NULL;
    if (good) {
        plan.drawing = yb_drawing_open(&page, error);
        good = plan.drawing != NULL;
    } else {
        yb_error_set(error, "not enough memory for %s", path);
    }
    if (good && !request->plain) {
        write_at(&plan, MARGIN, MARGIN + 16, 16, YB_TEXT_START, true, title);
        draw_legend(&plan);
    }
    if (good) {
        draw_plan(&plan, lower);
        good = yb_drawing_close(plan.drawing, error);
    }
    yb_label_room_free(&plan.room);
    free(lower);
    return good;
}
