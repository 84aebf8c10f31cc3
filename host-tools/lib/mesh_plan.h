/* The map in a drawing of its mesh (mesh_drawing.h), without the page round it: for mesh_drawing.c
 * alone.
 */
#ifndef YB_MESH_PLAN_H
#define YB_MESH_PLAN_H

#include "drawing.h"
#include "label_room.h"
#include "mesh_drawing.h"

enum {
    YB_MESH_RULES = YB_RULE_SKELETON + 1,
    YB_MESH_STOPS = 6,
    YB_MESH_GREY = 0xa8a8a8,
    YB_MESH_BLACK = 0x202020,
    YB_MESH_WHITE = 0xffffff,
    YB_MESH_FLAT = 0xff2fd0
};

/* By yb_rule_t: the class of its edges and of its points, its entry in the legend. */
typedef struct {
    const char *name, *points, *what;
    int32_t colour;
    double width;
} yb_mesh_rule_t;

extern const yb_mesh_rule_t yb_mesh_rules[YB_MESH_RULES];

/* Colours of heights, from low to high: of areas, of lines. */
extern const int32_t yb_mesh_tints[YB_MESH_STOPS], yb_mesh_inks[YB_MESH_STOPS];

/* A colour of them, share 0 to 1, times a brightness. */
int32_t yb_mesh_ramp(const int32_t stops[YB_MESH_STOPS], double share, double light);

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
    int edges[YB_MESH_RULES], points[YB_MESH_RULES];
    int flat;
    int32_t *lower; /* for each contour: positive if its left side is the lower one, negative: its
                     * right side, 0: neither */
} yb_mesh_plan_t;

/* Counts edges, points and flat triangles and finds the lower sides, for map and load that are set.
 * False: no memory. The caller frees `lower`.
 */
bool yb_mesh_plan_count(yb_mesh_plan_t *plan);

/* Draws it; all else must be set. */
void yb_mesh_plan_draw(yb_mesh_plan_t *plan);

/* A height in metres, as it stands on the map. */
void yb_mesh_plan_height(const yb_mesh_plan_t *plan, int32_t z_q8, char text[16]);

#endif
