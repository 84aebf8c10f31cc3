#include "level_cut.h"

#include <stdlib.h>
#include <string.h>

#include "relief.h"
#include "split.h"

enum {
    LEVELS = 34, /* as in the engine: no triangle can be split more often */
    FIRST_ROOM = 1024,
    LIKELY_SHARE = 2 /* eighths of what noise could do at most; more is rare */
};

#define NONE UINT32_MAX

/* The cut of one triangle: where the line comes in and goes out. */
typedef struct {
    uint64_t from, to; /* edges, named by the places of their ends */
    yb_point2_t in, out;
    uint32_t next;
    bool follows, used;
} piece_t;

struct yb_level_cut {
    const yb_map_t *map;
    int32_t z_q8;
    int32_t longest_q8;
    int shortest; /* class of edges that may still be split */
    int share;    /* of what noise can do that is reckoned with, in 1/8 */
    piece_t *piece;
    uint32_t count, room;
    uint32_t *slot; /* pieces by `from`: index + 1, 0 = free; twice the room */
    yb_point2_t *point;
    size_t point_room;
    yb_isolines_t lines;
    size_t line_room;
    bool failed;
};

typedef struct {
    const yb_vertex_t *corner[3];
    yb_vertex_t middle[3];
    uint8_t pattern, child;
} step_t;

yb_level_cut_t *yb_level_cut_new(void)
{
    return calloc(1, sizeof(yb_level_cut_t));
}

void yb_level_cut_free(yb_level_cut_t *cut)
{
    if (cut == NULL)
        return;
    free(cut->piece);
    free(cut->slot);
    free(cut->point);
    free(cut->lines.line);
    free(cut);
}

static uint64_t edge_name(const yb_vertex_t *a, const yb_vertex_t *b)
{
    uint64_t first = (uint64_t)a->x_q8 << 16 | a->y_q8;
    uint64_t second = (uint64_t)b->x_q8 << 16 | b->y_q8;
    return first < second ? first << 32 | second : second << 32 | first;
}

/* Where the height lies on an edge, of whose ends `low` lies below it. */
static yb_point2_t edge_point(int32_t z_q8, const yb_vertex_t *low, const yb_vertex_t *high)
{
    double share = (double)(z_q8 - low->z_q8) / (high->z_q8 - low->z_q8);
    return (yb_point2_t){(low->x_q8 + (high->x_q8 - low->x_q8) * share) / 256,
                         (low->y_q8 + (high->y_q8 - low->y_q8) * share) / 256};
}

static bool grow_pieces(yb_level_cut_t *cut)
{
    uint32_t room = cut->room == 0 ? FIRST_ROOM : 2 * cut->room;
    piece_t *piece = realloc(cut->piece, room * sizeof(*piece));
    if (piece != NULL)
        cut->piece = piece;
    uint32_t *slot = realloc(cut->slot, 2 * (size_t)room * sizeof(*slot));
    if (slot != NULL)
        cut->slot = slot;
    if (piece == NULL || slot == NULL)
        return false;
    cut->room = room;
    return true;
}

/* The higher ground is on the left, as in isolines.c. */
static void cut_leaf(yb_level_cut_t *cut, const yb_vertex_t *const corner[3])
{
    bool above[3];
    for (int i = 0; i < 3; i++)
        above[i] = corner[i]->z_q8 >= cut->z_q8;
    if (above[0] == above[1] && above[1] == above[2])
        return;
    if (cut->count == cut->room && !grow_pieces(cut)) {
        cut->failed = true;
        return;
    }
    piece_t *piece = &cut->piece[cut->count++];
    *piece = (piece_t){.next = NONE};
    for (int i = 0; i < 3; i++) {
        const yb_vertex_t *a = corner[i];
        const yb_vertex_t *b = corner[(i + 1) % 3];
        if (above[i] && !above[(i + 1) % 3]) {
            piece->from = edge_name(a, b);
            piece->in = edge_point(cut->z_q8, b, a);
        } else if (!above[i] && above[(i + 1) % 3]) {
            piece->to = edge_name(a, b);
            piece->out = edge_point(cut->z_q8, a, b);
        }
    }
}

/* Can the height pass through anything that this triangle becomes? */
static bool is_near(const yb_level_cut_t *cut, const yb_vertex_t *const corner[3])
{
    int32_t low = fix_min(corner[0]->z_q8, fix_min(corner[1]->z_q8, corner[2]->z_q8));
    int32_t high = fix_max(corner[0]->z_q8, fix_max(corner[1]->z_q8, corner[2]->z_q8));
    if (low < cut->z_q8 && high >= cut->z_q8)
        return true;
    relief_bound_t bound;
    relief_bound(corner, &bound);
    int32_t noise = relief_reach(cut->map, &bound, cut->shortest) - bound.bulge_q8;
    int32_t reach = bound.bulge_q8 + noise / 8 * cut->share;
    return low - reach <= cut->z_q8 && high + reach >= cut->z_q8;
}

/* The same edges as yb_map_refine splits, or none where the height does not come. */
static void open_step(yb_level_cut_t *cut, step_t *step)
{
    step->pattern = 0;
    step->child = 0;
    int longer = 0;
    for (int i = 0; i < 3; i++) {
        const yb_vertex_t *a = step->corner[i];
        const yb_vertex_t *b = step->corner[i == 2 ? 0 : i + 1];
        int32_t dx = b->x_q8 - a->x_q8;
        int32_t dy = b->y_q8 - a->y_q8;
        if (fix_length(dx, dy) > cut->longest_q8 && relief_splits(dx, dy))
            longer |= 1 << i;
    }
    if (longer != 0 && !is_near(cut, step->corner))
        return;
    for (int i = 0; i < 3; i++)
        if ((longer >> i & 1) != 0)
            relief_middle(cut->map, step->corner[i], step->corner[i == 2 ? 0 : i + 1],
                          &step->middle[i]);
    step->pattern = (uint8_t)longer;
    if (longer == 0)
        cut_leaf(cut, step->corner);
}

static void cut_triangle(yb_level_cut_t *cut, yb_triangle_t triangle)
{
    step_t steps[LEVELS];
    step_t *step = steps;
    for (int i = 0; i < 3; i++)
        step->corner[i] = &cut->map->vertex[cut->map->triangle[triangle][i]];
    for (;;) {
        open_step(cut, step);
        const uint8_t *child = split_child[step->pattern][0];
        while (step->child == SPLIT_CHILDREN || *child == SPLIT_END) {
            if (step == steps)
                return;
            step--;
            child = split_child[step->pattern][++step->child & 3];
        }
        for (int i = 0; i < 3; i++)
            step[1].corner[i] = child[i] < 3 ? step->corner[child[i]] : &step->middle[child[i] - 3];
        step++;
    }
}

static uint32_t home_of(uint64_t name, uint32_t slots)
{
    uint64_t hash = name * 0x9e3779b97f4a7c15U;
    return (uint32_t)(hash >> 32) & (slots - 1);
}

static void link_pieces(yb_level_cut_t *cut)
{
    uint32_t slots = FIRST_ROOM;
    while (slots < 2 * cut->count)
        slots *= 2;
    memset(cut->slot, 0, slots * sizeof(*cut->slot));
    for (uint32_t i = 0; i < cut->count; i++) {
        uint32_t at = home_of(cut->piece[i].from, slots);
        while (cut->slot[at] != 0)
            at = (at + 1) & (slots - 1);
        cut->slot[at] = i + 1;
    }
    for (uint32_t i = 0; i < cut->count; i++) {
        uint32_t at = home_of(cut->piece[i].to, slots);
        for (; cut->slot[at] != 0; at = (at + 1) & (slots - 1)) {
            uint32_t next = cut->slot[at] - 1;
            if (cut->piece[next].from != cut->piece[i].to)
                continue;
            cut->piece[i].next = next;
            cut->piece[next].follows = true;
            break;
        }
    }
}

static void put_point(yb_isoline_t *line, yb_point2_t point)
{
    const yb_point2_t *last = line->count > 0 ? &line->point[line->count - 1] : NULL;
    if (last == NULL || last->x != point.x || last->y != point.y)
        line->point[line->count++] = point;
}

/* Walks a line from its first piece; answers how many points it took of the pool. */
static size_t walk(yb_level_cut_t *cut, uint32_t first, yb_point2_t *pool)
{
    yb_isoline_t line = {.point = pool};
    uint32_t last = first;
    for (uint32_t at = first; at != NONE && !cut->piece[at].used; at = cut->piece[at].next) {
        cut->piece[at].used = true;
        put_point(&line, cut->piece[at].in);
        last = at;
    }
    line.closed = cut->piece[last].next == first;
    if (!line.closed)
        put_point(&line, cut->piece[last].out);
    while (line.closed && line.count > 1 && pool[0].x == pool[line.count - 1].x &&
           pool[0].y == pool[line.count - 1].y)
        line.count--;
    if (line.count < 2)
        return 0;
    if (cut->lines.count == cut->line_room) {
        size_t room = cut->line_room == 0 ? 16 : 2 * cut->line_room;
        yb_isoline_t *grown = realloc(cut->lines.line, room * sizeof(*grown));
        if (grown == NULL) {
            cut->failed = true;
            return 0;
        }
        cut->lines.line = grown;
        cut->line_room = room;
    }
    cut->lines.line[cut->lines.count++] = line;
    return line.count;
}

static bool make_room_for_points(yb_level_cut_t *cut)
{
    size_t points = 2 * (size_t)cut->count + 2;
    if (points <= cut->point_room)
        return true;
    free(cut->point);
    cut->point = malloc(2 * points * sizeof(*cut->point));
    cut->point_room = cut->point != NULL ? 2 * points : 0;
    return cut->point != NULL;
}

/* With less than all that noise can do a part of a line may be missed: then it ends inside. */
static bool ends_inside(const yb_level_cut_t *cut, yb_point2_t point)
{
    double east = cut->map->east_q8 / 256.0;
    double north = cut->map->north_q8 / 256.0;
    return point.x > 0 && point.y > 0 && point.x < east && point.y < north;
}

/* Answers whether all lines are whole. */
static bool chain(yb_level_cut_t *cut)
{
    size_t used = 0;
    bool whole = true;
    cut->lines.count = 0;
    link_pieces(cut);
    for (int round = 0; round < 2; round++)
        for (uint32_t i = 0; i < cut->count; i++)
            if (!cut->piece[i].used && (round == 1 || !cut->piece[i].follows))
                used += walk(cut, i, cut->point + used);
    for (size_t i = 0; i < cut->lines.count && whole; i++) {
        const yb_isoline_t *line = &cut->lines.line[i];
        whole = line->closed || (!ends_inside(cut, line->point[0]) &&
                                 !ends_inside(cut, line->point[line->count - 1]));
    }
    return whole;
}

const yb_isolines_t *yb_level_cut_lines(yb_level_cut_t *cut, const yb_map_t *map, int32_t z_q8,
                                        uint16_t longest_q8)
{
    cut->map = map;
    cut->z_q8 = z_q8;
    cut->longest_q8 = longest_q8;
    cut->shortest = relief_class(longest_q8 / 15 * 14, 0);
    cut->failed = cut->room == 0 && !grow_pieces(cut);
    bool whole = false;
    for (cut->share = LIKELY_SHARE; !whole && cut->share <= 8; cut->share += 8 - LIKELY_SHARE) {
        cut->count = 0;
        for (yb_triangle_t i = 0; i < map->triangle_count && !cut->failed; i++)
            cut_triangle(cut, i);
        if (cut->failed || !make_room_for_points(cut))
            return NULL;
        whole = chain(cut);
    }
    return cut->failed ? NULL : &cut->lines;
}
