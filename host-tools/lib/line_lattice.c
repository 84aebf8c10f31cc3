#include "line_lattice.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* Nodes along a side of a cell, in which the segments nearby are looked up. */
enum {
    CELL_SHIFT = 4
};
enum {
    MOST_SHORT_CUT = 12, /* points, before and behind together, of which every choice is tried */
    MOST_NUDGED = 2,     /* … and up to which nodes beside the nearest are tried, too */
    NEIGHBOURS = 9,
    ALONG_FRAME = 8, /* nodes that an end may move along the frame */
    MOST_STARTS = 4
};

/* Of the nodes laid so far; a single node is a segment from itself to itself. */
typedef struct {
    yb_node_t a, b;
    double height_m;
    int first_entry;
} segment_t;

/* That a segment touches a cell. */
typedef struct {
    int segment, cell;
    int older; /* entry of the same cell, or -1 */
} entry_t;

/* A line that is about to be laid, its points in units of the lattice. */
typedef struct {
    double x, y;
    yb_node_t nearest;
} point_t;

struct yb_line_lattice {
    double width_m, depth_m;
    int east, north;
    int columns;
    int *newest;        /* of each cell: its latest entry, or -1 */
    segment_t *segment; /* both are stacks: what is laid last can be taken back */
    entry_t *entry;
    int segments, segment_room;
    int entries, entry_room;
    bool failed; /* out of memory */
    yb_line_loss_t loss;
    /* The line being laid: its points, and what there is of it. */
    point_t *point;
    int points, point_room;
    bool closed;
    double height_m;
    yb_node_t *node;
    int nodes, base; /* node k ends segment base + k */
    int start;       /* where it is begun, see point_at */
};

yb_line_lattice_t *yb_line_lattice_new(double width_m, double depth_m, int east, int north)
{
    yb_line_lattice_t *lattice = calloc(1, sizeof(*lattice));
    if (lattice == NULL)
        return NULL;
    lattice->width_m = width_m;
    lattice->depth_m = depth_m;
    lattice->east = east;
    lattice->north = north;
    lattice->columns = (east >> CELL_SHIFT) + 1;
    int cells = lattice->columns * ((north >> CELL_SHIFT) + 1);
    lattice->newest = malloc((size_t)cells * sizeof(int));
    if (lattice->newest == NULL) {
        free(lattice);
        return NULL;
    }
    for (int i = 0; i < cells; i++)
        lattice->newest[i] = -1;
    return lattice;
}

void yb_line_lattice_free(yb_line_lattice_t *lattice)
{
    if (lattice == NULL)
        return;
    free(lattice->newest);
    free(lattice->segment);
    free(lattice->entry);
    free(lattice->point);
    free(lattice);
}

yb_line_loss_t yb_line_lattice_loss(const yb_line_lattice_t *lattice)
{
    return lattice->loss;
}

/* The array with room for one element more, or NULL: then the old one is still there. */
static void *grow(void *array, int *room, int count, size_t size)
{
    if (count < *room)
        return array;
    int more = *room == 0 ? 1024 : 2 * *room;
    void *grown = realloc(array, (size_t)more * size);
    if (grown != NULL)
        *room = more;
    return grown;
}

/* --- Exact geometry: coordinates are below 2^15, products of differences below 2^31 ----------- */

static bool same(yb_node_t a, yb_node_t b)
{
    return a.x == b.x && a.y == b.y;
}

/* Which side of ab is c on: left 1, right -1, on the line 0. */
static int side_of(yb_node_t a, yb_node_t b, yb_node_t c)
{
    int64_t area = (int64_t)(b.x - a.x) * (c.y - a.y) - (int64_t)(b.y - a.y) * (c.x - a.x);
    return (area > 0) - (area < 0);
}

static bool in_box(yb_node_t a, yb_node_t b, yb_node_t p)
{
    return (a.x < b.x ? a.x <= p.x && p.x <= b.x : b.x <= p.x && p.x <= a.x) &&
           (a.y < b.y ? a.y <= p.y && p.y <= b.y : b.y <= p.y && p.y <= a.y);
}

static bool segments_touch(yb_node_t a, yb_node_t b, yb_node_t c, yb_node_t d)
{
    int of_c = side_of(a, b, c);
    int of_d = side_of(a, b, d);
    int of_a = side_of(c, d, a);
    int of_b = side_of(c, d, b);
    if (of_c * of_d < 0 && of_a * of_b < 0)
        return true;
    return (of_c == 0 && in_box(a, b, c)) || (of_d == 0 && in_box(a, b, d)) ||
           (of_a == 0 && in_box(c, d, a)) || (of_b == 0 && in_box(c, d, b));
}

/* Do two segments that share the end a touch elsewhere, too? */
static bool overlap(yb_node_t a, yb_node_t b, yb_node_t other)
{
    return side_of(a, b, other) == 0 &&
           (int64_t)(b.x - a.x) * (other.x - a.x) + (int64_t)(b.y - a.y) * (other.y - a.y) > 0;
}

/* Is segment s in the way of a new one from a, the end of the line so far, to b? If that closes the
 * line, b is its beginning and may be touched as well. A line begins with a segment from a to a.
 */
static bool in_the_way(const segment_t *s, yb_node_t a, yb_node_t b, bool closing)
{
    if (same(a, b))
        return segments_touch(a, b, s->a, s->b);
    if (same(s->a, a) || same(s->b, a))
        return overlap(a, b, same(s->a, a) ? s->b : s->a);
    if (closing && (same(s->a, b) || same(s->b, b)))
        return overlap(b, a, same(s->a, b) ? s->b : s->a);
    return segments_touch(a, b, s->a, s->b);
}

/* --- Segments by cells ------------------------------------------------------------------------ */

/* The cells that a segment may touch, row by row: sets the columns of a row of cells. */
static void cell_columns(yb_node_t a, yb_node_t b, int row, int *first, int *last)
{
    yb_node_t low = a.y <= b.y ? a : b;
    yb_node_t high = a.y <= b.y ? b : a;
    double from = low.x;
    double to = high.x;
    if (low.y != high.y) {
        double slope = (double)(high.x - low.x) / (high.y - low.y);
        from = low.x + slope * fmax(0, (row << CELL_SHIFT) - low.y);
        to = low.x + slope * (fmin(high.y, (row + 1) << CELL_SHIFT) - low.y);
    }
    /* A little more, for what is rounded. */
    *first = (int)fmax(fmin(from, to) - 0.01, fmin(low.x, high.x)) >> CELL_SHIFT;
    *last = (int)fmin(fmax(from, to) + 0.01, fmax(low.x, high.x)) >> CELL_SHIFT;
}

/* Can a segment be laid from a to b, seen from what was laid before segment `until`? */
static bool is_clear(const yb_line_lattice_t *lattice, yb_node_t a, yb_node_t b, int until,
                     bool closing)
{
    int row = (a.y < b.y ? a.y : b.y) >> CELL_SHIFT;
    int last_row = (a.y < b.y ? b.y : a.y) >> CELL_SHIFT;
    for (; row <= last_row; row++) {
        int column = 0;
        int last = 0;
        cell_columns(a, b, row, &column, &last);
        for (; column <= last; column++) {
            int at = lattice->newest[row * lattice->columns + column];
            for (; at >= 0; at = lattice->entry[at].older) {
                int segment = lattice->entry[at].segment;
                if (segment < until && in_the_way(&lattice->segment[segment], a, b, closing))
                    return false;
            }
        }
    }
    return true;
}

static void add_entry(yb_line_lattice_t *lattice, int segment, int cell)
{
    entry_t *grown = grow(lattice->entry, &lattice->entry_room, lattice->entries, sizeof(*grown));
    if (grown == NULL) {
        lattice->failed = true;
        return;
    }
    lattice->entry = grown;
    lattice->entry[lattice->entries] = (entry_t){segment, cell, lattice->newest[cell]};
    lattice->newest[cell] = lattice->entries++;
}

static void add_segment(yb_line_lattice_t *lattice, yb_node_t a, yb_node_t b)
{
    segment_t *grown =
        grow(lattice->segment, &lattice->segment_room, lattice->segments, sizeof(*grown));
    if (grown == NULL) {
        lattice->failed = true;
        return;
    }
    lattice->segment = grown;
    int segment = lattice->segments++;
    lattice->segment[segment] = (segment_t){a, b, lattice->height_m, lattice->entries};
    int row = (a.y < b.y ? a.y : b.y) >> CELL_SHIFT;
    int last_row = (a.y < b.y ? b.y : a.y) >> CELL_SHIFT;
    for (; row <= last_row; row++) {
        int column = 0;
        int last = 0;
        cell_columns(a, b, row, &column, &last);
        for (; column <= last; column++)
            add_entry(lattice, segment, row * lattice->columns + column);
    }
}

static void remove_segment(yb_line_lattice_t *lattice)
{
    int first = lattice->segment[--lattice->segments].first_entry;
    while (lattice->entries > first) {
        const entry_t *entry = &lattice->entry[--lattice->entries];
        lattice->newest[entry->cell] = entry->older;
    }
}

/* --- Walking a line --------------------------------------------------------------------------- */

/* Point i of the line as it is walked: a closed one from some quarter of it on, an open one from
 * either end (and at one of two places there).
 */
static const point_t *point_at(const yb_line_lattice_t *lattice, int i)
{
    int points = lattice->points;
    if (lattice->closed)
        i = (i + (int)((int64_t)points * lattice->start / MOST_STARTS)) % points;
    else if (lattice->start % 2 == 1)
        i = points - 1 - i;
    return &lattice->point[i];
}

static void push(yb_line_lattice_t *lattice, yb_node_t node)
{
    add_segment(lattice, lattice->nodes > 0 ? lattice->node[lattice->nodes - 1] : node, node);
    lattice->node[lattice->nodes++] = node;
}

static void pop(yb_line_lattice_t *lattice, int count)
{
    for (; count > 0 && !lattice->failed; count--) {
        lattice->nodes--;
        remove_segment(lattice);
    }
}

/* Could the line, less its last `back` nodes, go on to this one? An empty one may begin anywhere
 * that is free.
 */
static bool reaches(const yb_line_lattice_t *lattice, int back, yb_node_t node, bool closing)
{
    int nodes = lattice->nodes - back;
    yb_node_t from = nodes > 0 ? lattice->node[nodes - 1] : node;
    if (nodes > 0 && same(from, node))
        return false;
    return is_clear(lattice, from, node, lattice->base + nodes, closing);
}

static yb_node_t inside(const yb_line_lattice_t *lattice, int x, int y)
{
    return (yb_node_t){x < 1                   ? 1
                       : x > lattice->east - 1 ? lattice->east - 1
                                               : x,
                       y < 1                    ? 1
                       : y > lattice->north - 1 ? lattice->north - 1
                                                : y};
}

static double distance(const point_t *point, yb_node_t node)
{
    return hypot(node.x - point->x, node.y - point->y);
}

/* The nodes round a point, the nearest first. */
static void nodes_round(const yb_line_lattice_t *lattice, const point_t *point,
                        yb_node_t found[NEIGHBOURS])
{
    for (int i = 0; i < NEIGHBOURS; i++) {
        yb_node_t node =
            inside(lattice, point->nearest.x + i % 3 - 1, point->nearest.y + i / 3 - 1);
        int at = i;
        for (; at > 0 && distance(point, found[at - 1]) > distance(point, node); at--)
            found[at] = found[at - 1];
        found[at] = node;
    }
}

/* Is the point after point i in sight of a node beside it? */
static bool leads_on(const yb_line_lattice_t *lattice, int i, yb_node_t node)
{
    return i + 1 == lattice->points ||
           is_clear(lattice, node, point_at(lattice, i + 1)->nearest, lattice->segments, false);
}

/* Goes on to point i, or beside it if `nudge`, from `back` nodes before the end. */
static bool step(yb_line_lattice_t *lattice, int i, int back, bool nudge)
{
    const point_t *point = point_at(lattice, i);
    const yb_node_t *chosen = NULL;
    yb_node_t found[NEIGHBOURS];
    if (reaches(lattice, back, point->nearest, false)) {
        chosen = &point->nearest;
    } else if (nudge) {
        nodes_round(lattice, point, found);
        for (int k = 1; k < NEIGHBOURS; k++) {
            if (!reaches(lattice, back, found[k], false))
                continue;
            if (chosen == NULL || leads_on(lattice, i, found[k]))
                chosen = &found[k];
            if (leads_on(lattice, i, *chosen))
                break;
        }
    }
    if (chosen == NULL)
        return false;
    pop(lattice, back);
    push(lattice, *chosen);
    return true;
}

/* Goes on to point i or, by the shortest cut, to one after it; answers where to go on. `stuck`: the
 * same was tried in vain from the point before.
 */
static int walk_on(yb_line_lattice_t *lattice, int i, int end, bool *stuck)
{
    int keep = lattice->nodes > 0 ? 1 : 0; /* where the line begins */
    for (int cut = *stuck ? MOST_SHORT_CUT : 0; cut <= MOST_SHORT_CUT; cut++) {
        for (int back = 0; back <= cut && back <= lattice->nodes - keep; back++) {
            int to = i + cut - back;
            if (to < end && step(lattice, to, back, cut <= MOST_NUDGED)) {
                *stuck = false;
                return to + 1;
            }
        }
    }
    *stuck = true;
    return i + 1;
}

/* The node so far along the frame, counter-clockwise, from one on it. */
static yb_node_t along_frame(const yb_line_lattice_t *lattice, yb_node_t node, int off)
{
    int east = lattice->east;
    int north = lattice->north;
    int round = 2 * (east + north);
    int way = node.y == 0       ? node.x
              : node.x == east  ? east + node.y
              : node.y == north ? east + north + (east - node.x)
                                : round - node.y;
    way = (way + off + round) % round;
    if (way < east)
        return (yb_node_t){way, 0};
    if (way < east + north)
        return (yb_node_t){east, way - east};
    if (way < 2 * east + north)
        return (yb_node_t){2 * east + north - way, north};
    return (yb_node_t){0, round - way};
}

static bool on_one_side(const yb_line_lattice_t *lattice, yb_node_t a, yb_node_t b)
{
    return (a.x == b.x && (a.x == 0 || a.x == lattice->east)) ||
           (a.y == b.y && (a.y == 0 || a.y == lattice->north));
}

/* Begins or ends an open line on the frame, without as few nodes as possible; at another place than
 * the first `skip` that would do.
 */
static bool meet_frame(yb_line_lattice_t *lattice, const point_t *point, int skip)
{
    for (int back = 0; back == 0 || back < lattice->nodes; back++) {
        for (int k = 0; k <= 2 * ALONG_FRAME; k++) {
            yb_node_t node =
                along_frame(lattice, point->nearest, k % 2 == 0 ? k / 2 : -(k + 1) / 2);
            if (!reaches(lattice, back, node, false) ||
                (lattice->nodes - back == 1 && on_one_side(lattice, lattice->node[0], node)) ||
                skip-- > 0)
                continue;
            pop(lattice, back);
            push(lattice, node);
            return true;
        }
    }
    return false;
}

static bool close_line(yb_line_lattice_t *lattice)
{
    for (int back = 0; lattice->nodes - back >= 3; back++) {
        if (reaches(lattice, back, lattice->node[0], true)) {
            pop(lattice, back);
            add_segment(lattice, lattice->node[lattice->nodes - 1], lattice->node[0]);
            return true;
        }
    }
    return false;
}

static void take_back(yb_line_lattice_t *lattice)
{
    while (lattice->segments > lattice->base)
        remove_segment(lattice);
    lattice->nodes = 0;
}

/* The line as far as it can be laid; nothing of it if it cannot be closed or end on the frame. */
static int attempt(yb_line_lattice_t *lattice, int start)
{
    lattice->start = start;
    int first = lattice->closed ? 0 : 1;
    int end = lattice->points - first;
    bool good = lattice->closed || meet_frame(lattice, point_at(lattice, 0), start / 2);
    bool stuck = false;
    for (int i = first; good && i < end && !lattice->failed;)
        i = walk_on(lattice, i, end, &stuck);
    good = good &&
           (lattice->closed ? close_line(lattice) : meet_frame(lattice, point_at(lattice, end), 0));
    if (!good)
        take_back(lattice);
    return lattice->nodes;
}

/* Lays the line from its first point on or, if it loses more than an eighth of its points so, from
 * where it loses least.
 */
static int lay_best(yb_line_lattice_t *lattice)
{
    int enough = lattice->points - lattice->points / 8;
    int best = 0;
    int best_start = 0;
    for (int start = 0; start < MOST_STARTS; start++) {
        int nodes = attempt(lattice, start);
        if (nodes >= enough || lattice->failed)
            return nodes;
        if (nodes > best) {
            best = nodes;
            best_start = start;
        }
        take_back(lattice);
    }
    return best > 0 ? attempt(lattice, best_start) : 0;
}

/* --- Taking a line ---------------------------------------------------------------------------- */

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Onto the side of the frame that is nearest. */
static yb_node_t onto_frame(const yb_line_lattice_t *lattice, double x, double y)
{
    yb_node_t node = {(int)lround(x), (int)lround(y)};
    double west = x;
    double east = lattice->east - x;
    double south = y;
    double north = lattice->north - y;
    double least = fmin(fmin(west, east), fmin(south, north));
    if (least == west)
        node.x = 0;
    else if (least == east)
        node.x = lattice->east;
    else if (least == south)
        node.y = 0;
    else
        node.y = lattice->north;
    return node;
}

/* The points of a line in units of the lattice, without those that share their nearest node with
 * the one before.
 */
static bool take_points(yb_line_lattice_t *lattice, const yb_line_t *line)
{
    lattice->points = 0;
    lattice->closed = line->closed;
    lattice->height_m = line->height_m;
    for (int i = 0; i < line->count; i++) {
        point_t *grown =
            grow(lattice->point, &lattice->point_room, lattice->points, sizeof(*grown));
        if (grown == NULL)
            return false;
        lattice->point = grown;
        double x = clamp(line->place[i].x_m / lattice->width_m, 0, 1) * lattice->east;
        double y = clamp(line->place[i].y_m / lattice->depth_m, 0, 1) * lattice->north;
        bool end = !line->closed && line->count > 1 && (i == 0 || i == line->count - 1);
        point_t point = {x, y,
                         end ? onto_frame(lattice, x, y)
                             : inside(lattice, (int)lround(x), (int)lround(y))};
        if (lattice->points == 0 || end ||
            !same(lattice->point[lattice->points - 1].nearest, point.nearest))
            lattice->point[lattice->points++] = point;
    }
    while (line->closed && lattice->points > 1 &&
           same(lattice->point[lattice->points - 1].nearest, lattice->point[0].nearest))
        lattice->points--;
    return true;
}

static bool on_same_height(const yb_line_lattice_t *lattice, yb_node_t node)
{
    int cell = (node.y >> CELL_SHIFT) * lattice->columns + (node.x >> CELL_SHIFT);
    for (int at = lattice->newest[cell]; at >= 0; at = lattice->entry[at].older) {
        const segment_t *segment = &lattice->segment[lattice->entry[at].segment];
        if (segment->height_m == lattice->height_m && side_of(segment->a, segment->b, node) == 0 &&
            in_box(segment->a, segment->b, node))
            return true;
    }
    return false;
}

/* Does more than half of the line lie on others of its height? */
static bool is_repeated(const yb_line_lattice_t *lattice)
{
    int there = 0;
    for (int i = 0; i < lattice->points; i++)
        there += on_same_height(lattice, lattice->point[i].nearest);
    return 2 * there > lattice->points;
}

static int lay_spot(yb_line_lattice_t *lattice)
{
    lattice->start = 0;
    return step(lattice, 0, 0, true) ? 1 : 0;
}

int yb_line_lattice_lay(yb_line_lattice_t *lattice, const yb_line_t *line, yb_node_t *node)
{
    lattice->node = node;
    lattice->nodes = 0;
    lattice->base = lattice->segments;
    if (!take_points(lattice, line))
        return -1;
    if (is_repeated(lattice)) {
        lattice->loss.repeated++;
        return 0;
    }
    bool spot = lattice->points == 1 || (line->closed && lattice->points == 2);
    int nodes = spot ? lay_spot(lattice) : lay_best(lattice);
    if (lattice->failed)
        return -1;
    if (nodes == 0)
        lattice->loss.lines++;
    else if (!spot)
        lattice->loss.points += lattice->points - nodes;
    return nodes;
}
