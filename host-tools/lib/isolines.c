#include "isolines.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The cut of one triangle. Edges are named by their two points, the smaller index in the high half:
 * both triangles of an edge give it one name.
 */
typedef struct {
    uint64_t from, to;
    uint32_t next; /* the cut that begins where this one ends, or NONE */
    bool follows;  /* some cut ends where this one begins */
    bool used;
} cut_t;

#define NONE UINT32_MAX

typedef struct {
    const yb_mesh_t *mesh;
    double height_m;
    cut_t *cut;
    uint32_t count;
} cuts_t;

static uint64_t edge_name(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* In a counter-clockwise triangle the line enters by the edge that leads down and leaves by the one
 * that leads up: then the higher corner is on its left.
 */
static bool cut_triangle(const cuts_t *cuts, const uint32_t *corner, cut_t *cut)
{
    bool above[3];
    for (int i = 0; i < 3; i++)
        above[i] = cuts->mesh->point[corner[i]].z >= cuts->height_m;
    if (above[0] == above[1] && above[1] == above[2])
        return false;
    *cut = (cut_t){.next = NONE};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (above[i] && !above[j])
            cut->from = edge_name(corner[i], corner[j]);
        if (!above[i] && above[j])
            cut->to = edge_name(corner[i], corner[j]);
    }
    return true;
}

static int compare_cuts(const void *a, const void *b)
{
    const cut_t *first = a, *second = b;
    return (first->from > second->from) - (first->from < second->from);
}

/* Sorted by where they begin, so that the next one is found by bisection. */
static bool find_cuts(cuts_t *cuts)
{
    cut_t cut;
    size_t count = 0;
    for (uint32_t i = 0; i < cuts->mesh->triangle_count; i++)
        count += cut_triangle(cuts, cuts->mesh->triangle[i], &cut);
    cuts->cut = malloc((count + 1) * sizeof(*cuts->cut));
    if (cuts->cut == NULL)
        return false;
    for (uint32_t i = 0; i < cuts->mesh->triangle_count; i++)
        cuts->count += cut_triangle(cuts, cuts->mesh->triangle[i], &cuts->cut[cuts->count]) ? 1 : 0;
    qsort(cuts->cut, cuts->count, sizeof(*cuts->cut), compare_cuts);
    for (uint32_t i = 0; i < cuts->count; i++) {
        const cut_t key = {.from = cuts->cut[i].to};
        cut_t *next = bsearch(&key, cuts->cut, cuts->count, sizeof(key), compare_cuts);
        if (next != NULL) {
            cuts->cut[i].next = (uint32_t)(next - cuts->cut);
            next->follows = true;
        }
    }
    return true;
}

static yb_point2_t edge_point(const cuts_t *cuts, uint64_t edge)
{
    const yb_point3_t *low = &cuts->mesh->point[edge >> 32];
    const yb_point3_t *high = &cuts->mesh->point[edge & UINT32_MAX];
    if (low->z > high->z) {
        const yb_point3_t *swap = low;
        low = high;
        high = swap;
    }
    if (high->z == cuts->height_m)
        return (yb_point2_t){high->x, high->y};
    const double share = (cuts->height_m - low->z) / (high->z - low->z);
    return (yb_point2_t){low->x + (high->x - low->x) * share, low->y + (high->y - low->y) * share};
}

static bool same_place(yb_point2_t a, yb_point2_t b)
{
    return a.x == b.x && a.y == b.y;
}

/* Walks from one cut to the end of its line. *line is left without points if they are all one. */
static bool walk(cuts_t *cuts, uint32_t first, yb_isoline_t *line)
{
    size_t room = 0;
    uint32_t last = first;
    for (uint32_t at = first; at != NONE && !cuts->cut[at].used; at = cuts->cut[at].next) {
        cuts->cut[at].used = true;
        last = at;
        room++;
    }
    *line = (yb_isoline_t){.height_m = cuts->height_m, .closed = cuts->cut[last].next == first};
    line->point = malloc((room + 1) * sizeof(*line->point));
    if (line->point == NULL)
        return false;
    uint32_t at = first;
    for (size_t i = 0; i <= room; i++) {
        if (i == room && line->closed)
            break;
        const uint64_t edge = i < room ? cuts->cut[at].from : cuts->cut[last].to;
        const yb_point2_t point = edge_point(cuts, edge);
        if (line->count == 0 || !same_place(point, line->point[line->count - 1]))
            line->point[line->count++] = point;
        if (i < room)
            at = cuts->cut[at].next;
    }
    while (line->closed && line->count > 1 &&
           same_place(line->point[0], line->point[line->count - 1]))
        line->count--;
    if (line->count < 2) {
        free(line->point);
        *line = (yb_isoline_t){0};
    }
    return true;
}

static bool append(yb_isolines_t *lines, yb_isoline_t line)
{
    /* Room doubles whenever the count is a power of two. */
    if ((lines->count & (lines->count - 1)) == 0) {
        const size_t room = lines->count == 0 ? 1 : lines->count * 2;
        yb_isoline_t *grown = realloc(lines->line, room * sizeof(*grown));
        if (grown == NULL) {
            free(line.point);
            return false;
        }
        lines->line = grown;
    }
    lines->line[lines->count++] = line;
    return true;
}

bool yb_isolines_add(yb_isolines_t *lines, const yb_mesh_t *mesh, double height_m)
{
    cuts_t cuts = {.mesh = mesh, .height_m = height_m};
    bool good = find_cuts(&cuts);
    /* Lines that begin on the boundary first; what is left then goes round. */
    for (int round = 0; round < 2; round++) {
        for (uint32_t i = 0; good && i < cuts.count; i++) {
            yb_isoline_t line;
            if (cuts.cut[i].used || (round == 0 && cuts.cut[i].follows))
                continue;
            good = walk(&cuts, i, &line);
            if (good && line.count != 0)
                good = append(lines, line);
        }
    }
    free(cuts.cut);
    return good;
}

yb_isolines_t yb_isolines_at(const yb_isolines_t *lines, double height_m)
{
    size_t first = 0, end = 0;
    while (first < lines->count && lines->line[first].height_m != height_m)
        first++;
    for (end = first; end < lines->count && lines->line[end].height_m == height_m;)
        end++;
    return (yb_isolines_t){first < end ? lines->line + first : NULL, end - first};
}

void yb_isolines_free(yb_isolines_t *lines)
{
    for (size_t i = 0; i < lines->count; i++)
        free(lines->line[i].point);
    free(lines->line);
    *lines = (yb_isolines_t){0};
}
