#include "mesh_drawing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh_plan.h"
#include "surface.h"

enum {
    MARGIN = 16,
    PLAIN_MARGIN = 2,
    TITLE = 34,
    LEGEND = 236,
    LEGEND_HEIGHT = 330,
    ROW = 20
};

bool yb_mesh_drawing_named(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && (strcasecmp(dot, ".svg") == 0 || strcasecmp(dot, ".png") == 0);
}

static void write_at(const yb_mesh_plan_t *plan, double x, double y, double size,
                     yb_anchor_t anchor, bool bold, const char *text)
{
    const yb_label_t label = {.x = x,
                              .y = y,
                              .size = size,
                              .anchor = anchor,
                              .colour = YB_MESH_BLACK,
                              .halo = YB_NO_INK,
                              .bold = bold};
    yb_drawing_text(plan->drawing, &label, text);
}

static void write_number(const yb_mesh_plan_t *plan, double x, double y, int value)
{
    char text[16];
    snprintf(text, sizeof(text), "%d", value);
    write_at(plan, x, y, 11, YB_TEXT_END, false, text);
}

static void key_line(const yb_mesh_plan_t *plan, double x, double y, int32_t colour, double width)
{
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = colour, .width = width});
    yb_drawing_move(plan->drawing, x, y - 4);
    yb_drawing_line(plan->drawing, x + 22, y - 4);
}

static void key_box(const yb_mesh_plan_t *plan, double x, double y, double width, int32_t colour)
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
static double draw_rule_table(const yb_mesh_plan_t *plan, double x, double y)
{
    write_at(plan, x + 182, y, 10, YB_TEXT_END, false, "points");
    write_at(plan, x + 226, y, 10, YB_TEXT_END, false, "edges");
    for (int rule = YB_RULE_CONTOUR; rule <= YB_MESH_RULES; rule++) {
        const int of = rule == YB_MESH_RULES ? YB_RULE_NONE : rule;
        if (of == YB_RULE_NONE && plan->request->stage == YB_STAGE_LINKS)
            continue;
        const bool grey = of == YB_RULE_CONTOUR && plan->request->stage == YB_STAGE_LINKS;
        y += ROW;
        key_line(plan, x, y, grey ? (int32_t)YB_MESH_GREY : yb_mesh_rules[of].colour, 2);
        if (of >= YB_RULE_SUMMIT && plan->points[of] > 0)
            yb_drawing_dot(plan->drawing, x + 11, y - 4, 2);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, yb_mesh_rules[of].what);
        if (of != YB_RULE_NONE && of != YB_RULE_SLOPE)
            write_number(plan, x + 182, y, plan->points[of]);
        write_number(plan, x + 226, y, plan->edges[of]);
    }
    return y;
}

static void draw_height_bar(const yb_mesh_plan_t *plan, double x, double y,
                            const int32_t stops[YB_MESH_STOPS])
{
    enum {
        PARTS = 24
    };
    char text[16], with_unit[24];
    for (int i = 0; i < PARTS; i++)
        key_box(plan, x + i * 9, y, 9, yb_mesh_ramp(stops, (i + 0.5) / PARTS, 1));
    yb_mesh_plan_height(plan, plan->map->low_q8, text);
    write_at(plan, x, y + 16, 11, YB_TEXT_START, false, text);
    yb_mesh_plan_height(plan, plan->map->high_q8, text);
    snprintf(with_unit, sizeof(with_unit), "%s m", text);
    write_at(plan, x + 9 * PARTS, y + 16, 11, YB_TEXT_END, false, with_unit);
}

/* A length of 1, 2 or 5 and noughts that is about a third of the legend. */
static void draw_scale_bar(const yb_mesh_plan_t *plan, double x, double y)
{
    const double metre = plan->scale / yb_map_cell_m(plan->map);
    const double power = pow(10, floor(log10(100 / metre)));
    const double most = 100 / metre / power;
    const double length = (most >= 5 ? 5 : most >= 2 ? 2 : 1) * power;
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = YB_NO_INK, .stroke = YB_MESH_BLACK, .width = 1.5});
    yb_drawing_move(plan->drawing, x, y - 4);
    yb_drawing_line(plan->drawing, x, y);
    yb_drawing_line(plan->drawing, x + length * metre, y);
    yb_drawing_line(plan->drawing, x + length * metre, y - 4);
    char text[40];
    snprintf(text, sizeof(text), "%g %s", length >= 1000 ? length / 1000 : length,
             length >= 1000 ? "km" : "m");
    write_at(plan, x + length * metre + 6, y, 11, YB_TEXT_START, false, text);
}

static void draw_legend(const yb_mesh_plan_t *plan)
{
    const yb_stage_t stage = plan->request->stage;
    const double x = plan->width - LEGEND;
    double y = plan->top + 12;
    int lines = 0;
    for (uint16_t i = 0; i < plan->load->contour_count; i++)
        lines += plan->load->contour[i].count > 1;
    if (stage == YB_STAGE_CONTOURS) {
        key_line(plan, x, y, yb_mesh_rules[YB_RULE_CONTOUR].colour, 1.4);
        yb_drawing_move(plan->drawing, x + 11, y - 4);
        yb_drawing_line(plan->drawing, x + 11, y + 2);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "contours, lower side");
        write_number(plan, x + 226, y, lines);
    } else {
        y = draw_rule_table(plan, x, y);
    }
    y += ROW;
    yb_drawing_begin(plan->drawing, "key",
                     (yb_ink_t){.fill = YB_MESH_BLACK, .stroke = YB_NO_INK, .width = 0});
    yb_drawing_move(plan->drawing, x + 11, y - 9);
    yb_drawing_line(plan->drawing, x + 15.4, y - 1.5);
    yb_drawing_line(plan->drawing, x + 6.6, y - 1.5);
    yb_drawing_loop(plan->drawing);
    write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "spot heights");
    write_number(plan, x + 226, y, plan->load->contour_count - lines);
    if (stage == YB_STAGE_TRIANGLES) {
        y += ROW;
        key_box(plan, x, y, 22, YB_MESH_FLAT);
        write_at(plan, x + 28, y, 11, YB_TEXT_START, false, "flat triangles");
        write_number(plan, x + 226, y, plan->flat);
    }
    y += 2 * ROW;
    if (stage != YB_STAGE_LINKS) {
        draw_height_bar(plan, x, y, stage == YB_STAGE_CONTOURS ? yb_mesh_inks : yb_mesh_tints);
        y += 3 * ROW;
    }
    draw_scale_bar(plan, x, y);
}

static void lay_out(yb_mesh_plan_t *plan)
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

static void write_title(const yb_mesh_plan_t *plan, char *text, size_t size)
{
    const int added = plan->map->vertex_count - plan->load->first_summit;
    snprintf(text, size, "%.200s: %d vertices, %d of them added, %d triangles", plan->request->name,
             (int)plan->map->vertex_count, added, (int)plan->map->triangle_count);
}

bool yb_mesh_drawing_write(const char *path, bool force, const yb_map_t *map, const yb_load_t *load,
                           const yb_mesh_drawing_t *request, yb_error_t *error)
{
    yb_mesh_plan_t plan = {.map = map, .load = load, .request = request};
    char title[320];
    bool good = yb_mesh_plan_count(&plan);
    lay_out(&plan);
    write_title(&plan, title, sizeof(title));
    const char *dot = strrchr(path, '.');
    const yb_page_t page = {.path = path,
                            .png = dot != NULL && strcasecmp(dot, ".png") == 0,
                            .force = force,
                            .width = plan.width,
                            .height = plan.height,
                            .title = title};
    good = yb_label_room_init(&plan.room, map->east_q8 / 256.0 * plan.scale,
                              map->north_q8 / 256.0 * plan.scale) &&
           good;
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
        yb_mesh_plan_draw(&plan);
        good = yb_drawing_close(plan.drawing, error);
    }
    yb_label_room_free(&plan.room);
    free(plan.lower);
    return good;
}
