#include "shadow.h"

#include <string.h>

#include "surface.h"

enum {
    MOST_SIDE = 256,
    CAST_LEVELS = 12, /* of refinement to four cells: what wants more is taken as it is */
    CAST_LONGEST = 4, /* cells */
    HEIGHT_BITS = 8   /* of the highest place, above the lowest */
};

/* --- Heights ---------------------------------------------------------------------------------- */

typedef struct {
    uint8_t *height; /* of the middles of the cells */
    int32_t side;
    int shift;       /* of a cell's width */
    int scale_shift; /* height = (z - low) >> scale_shift */
    int32_t low_q8, water_q8;
} field_t;

APART uint8_t cell_height(const field_t *field, int32_t z_q8)
{
    z_q8 = fix_max(z_q8, field->water_q8);
    return (uint8_t)fix_clamp((z_q8 - field->low_q8) >> field->scale_shift, 0, 255);
}

/* Cells from first up to end, along one axis, whose middles lie within three coordinates. */
typedef struct {
    int32_t first, end;
} cells_t;

static cells_t cells_within(const field_t *field, uint16_t a, uint16_t b, uint16_t c)
{
    int32_t half = (int32_t)1 << (field->shift - 1);
    int32_t least = fix_min(a, fix_min(b, c));
    int32_t most = fix_max(a, fix_max(b, c));
    return (cells_t){(least + half - 1) >> field->shift,
                     fix_min((most + half) >> field->shift, field->side)};
}

/* How near a place is to two corners of a triangle: twice the area that it makes with the opposite
 * side, and what a cell further east or north adds. The third corner has the rest of the whole.
 * Places are in 1/16 step, 12 bits: areas have 25.
 */
typedef struct {
    int32_t at[2], east[2], north[2];
    int32_t whole;
} weights_t;

static void weigh_cell(const yb_vertex_t *const p[4], int32_t x, int32_t y, int cell_shift,
                       weights_t *weights)
{
    for (int k = 0; k < 2; k++) {
        int32_t from_x = p[k + 1]->x_q8 >> 4;
        int32_t from_y = p[k + 1]->y_q8 >> 4;
        int32_t dx = (p[k + 2]->x_q8 >> 4) - from_x;
        int32_t dy = (p[k + 2]->y_q8 >> 4) - from_y;
        weights->at[k] = dx * (y - from_y) - dy * (x - from_x);
        weights->east[k] = -dy * ((int32_t)1 << cell_shift);
        weights->north[k] = dx * ((int32_t)1 << cell_shift);
        weights->whole = dx * ((p[k]->y_q8 >> 4) - from_y) - dy * ((p[k]->x_q8 >> 4) - from_x);
    }
}

/* Sets the cells whose middles lie in a triangle, or on its sides: neighbours agree there. */
static void set_cells(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                      const yb_vertex_t *c)
{
    const field_t *field = context;
    const yb_vertex_t *const p[4] = {a, b, c, a};
    const cells_t columns = cells_within(field, a->x_q8, b->x_q8, c->x_q8);
    const cells_t rows = cells_within(field, a->y_q8, b->y_q8, c->y_q8);
    if (columns.first >= columns.end || rows.first >= rows.end)
        return;
    int32_t half = (int32_t)1 << (field->shift - 1);
    weights_t row;
    weigh_cell(p, ((columns.first << field->shift) + half) >> 4,
               ((rows.first << field->shift) + half) >> 4, field->shift - 4, &row);
    int32_t area = row.whole;
    if (area <= 0)
        return;
    /* Shares of 2^8 by one division: a weight of 15 bits times 2^23 / area is below 2^24. */
    const int spare = fix_log2_floor((uint32_t)area | (uint32_t)1 << 14) - 14;
    int32_t inverse = ((int32_t)1 << 23) / (area >> spare);
    for (int32_t j = rows.first; j < rows.end; j++) {
        uint8_t *height = &field->height[j * field->side];
        int32_t to_a = row.at[0];
        int32_t to_b = row.at[1];
        for (int32_t i = columns.first; i < columns.end; i++) {
            if ((to_a | to_b | (area - to_a - to_b)) >= 0) { /* none is negative */
                /* Heights differ by less than 2^20: 2^28. */
                int32_t of_a = (to_a >> spare) * inverse >> 15;
                int32_t of_b = (to_b >> spare) * inverse >> 15;
                height[i] = cell_height(
                    field,
                    c->z_q8 + (((a->z_q8 - c->z_q8) * of_a + (b->z_q8 - c->z_q8) * of_b) >> 8));
            }
            to_a += row.east[0];
            to_b += row.east[1];
        }
        row.at[0] += row.north[0];
        row.at[1] += row.north[1];
    }
}

static void find_heights(const yb_map_t *map, const yb_view_t *view, const yb_shadow_t *shadow,
                         field_t *field)
{
    field->side = shadow->side;
    field->low_q8 = map->low_q8;
    field->water_q8 = view->water_q8;
    field->scale_shift = 0;
    while ((map->high_q8 - map->low_q8) >> field->scale_shift >= 1 << HEIGHT_BITS)
        field->scale_shift++;
    memset(field->height, 0, YB_SHADOW_WORK(shadow->side));
    uint16_t longest = (uint16_t)fix_min((int32_t)CAST_LONGEST << field->shift, 65535);
    surface_level_t levels[CAST_LEVELS];
    for (yb_triangle_t t = 0; t < map->triangle_count; t++)
        surface_refine(map, t, longest, levels, CAST_LEVELS, set_cells, field);
}

/* --- Shadows ---------------------------------------------------------------------------------- */

/* The sun's way from a row of cells to the next one behind it. Heights: 6 more fractional bits. */
typedef struct {
    int32_t aside_q8; /* cells along the row, towards the sun */
    int32_t drop;
} ray_t;

enum {
    FINE = 6,
    SLACK = 96, /* heights are rounded to 64: level ground casts no shadow on itself */
    NOTHING = -32768
};

/* The shadow's height above a cell, from where the row before has it at that cell: at most one cell
 * aside, between there and the next.
 */
static int32_t shadow_height(const int16_t *top, const ray_t *ray)
{
    top += ray->aside_q8 >> 8;
    const int32_t here = top[0];
    const int32_t next = top[1];
    return here + ((next - here) * (ray->aside_q8 & 255) >> 8) - ray->drop;
}

/* Goes through the rows of cells across the sun's way, beginning with those next to the sun. `top`
 * is how high ground or shadow reaches, in the row before, and up to cell j in this one; nothing
 * does beyond a row's ends.
 */
static void sweep(const field_t *field, yb_shadow_t *shadow, const ray_t *ray, bool along_x,
                  bool ascending)
{
    int16_t rows[1 + MOST_SIDE + 2];
    int16_t *top = &rows[1];
    int32_t lines = along_x ? shadow->columns : shadow->rows;
    int32_t cells = along_x ? shadow->rows : shadow->columns;
    int32_t next_line = along_x ? 1 : field->side;
    int32_t next_cell = along_x ? field->side : 1;
    for (int32_t j = -1; j < cells + 2; j++)
        top[j] = NOTHING;
    for (int32_t k = 0; k < lines; k++) {
        int32_t i = ascending ? k : lines - 1 - k;
        for (int32_t m = 0; m < cells; m++) {
            /* A cell of the row before is read before its place is used for this row. */
            int32_t j = ray->aside_q8 >= 0 ? m : cells - 1 - m;
            int32_t at = i * next_line + j * next_cell;
            int32_t ground = (int32_t)field->height[at] << FINE;
            int32_t shade = shadow_height(&top[j], ray);
            if (ground + SLACK >= shade)
                shadow->lit[at >> 3] = (uint8_t)(shadow->lit[at >> 3] | 1 << (at & 7));
            top[j] = (int16_t)fix_max(fix_max(ground, shade), NOTHING);
        }
    }
}

/* Cells whose middles lie within a side of the map. */
static uint16_t cells_of(uint16_t length_q8, int shift)
{
    return (uint16_t)(fix_max((length_q8 - ((int32_t)1 << (shift - 1))) >> shift, 0) + 1);
}

void yb_shadow_cast(const yb_map_t *map, const yb_view_t *view, yb_shadow_t *shadow, uint8_t *work)
{
    const int shift = shadow_cell_shift(shadow);
    field_t field;
    field.height = work;
    field.shift = shift;
    const int16_t *sun = view->sun_q14;
    bool along_x = fix_abs(sun[0]) >= fix_abs(sun[1]);
    int32_t ahead = along_x ? sun[0] : sun[1];
    int32_t aside = along_x ? sun[1] : sun[0];
    int32_t size = fix_abs(ahead);
    int32_t up = sun[2];
    bool high = up >> 6 >= size; /* 89 degrees: nothing casts a shadow */
    shadow->columns = cells_of(map->east_q8, shift);
    shadow->rows = cells_of(map->north_q8, shift);
    memset(shadow->lit, high ? 0xff : 0, YB_SHADOW_BYTES(shadow->side));
    if (high || up <= 0)
        return;
    find_heights(map, view, shadow, &field);
    /* A cell is at most 2^12 wide, the sine below 2^6 times the cosine: 2^18, and as much again by
     * the scale. */
    int32_t drop_q8 = ((up << 6) / size << shift) >> 6;
    int32_t scale = fix_max(view->exaggerate_q8, 1);
    drop_q8 = fix_min(drop_q8, ((int32_t)1 << 23) - 1) * 256 / scale;
    ray_t ray = {.aside_q8 = aside * 256 / size,
                 .drop = fix_min(drop_q8, (int32_t)1 << 24) << FINE >> field.scale_shift};
    ray.drop = fix_min(ray.drop, 32767);
    sweep(&field, shadow, &ray, along_x, ahead < 0);
}
