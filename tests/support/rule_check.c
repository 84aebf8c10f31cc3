#include "rule_check.h"

#include <stdlib.h>
#include <string.h>

enum {
    NONE = -1,
    MOST = 256
};

typedef struct {
    const yb_map_t *map;
    const yb_load_t *load;
    const plan_t *plan;
    int left[MOST][MOST];     /* the triangle to the left of a → b */
    bool line[MOST][MOST];    /* a segment of a line */
    int contour_of[MOST];     /* of a coded point */
    int region[2 * MOST];     /* of a triangle, by flooding */
    bool touches[MOST][MOST]; /* [region][vertex]: the vertex is a corner of one of its triangles */
    bool beside[MOST][MOST];  /* [region][region]: a line is between them */
    int regions;
} scene_t;

static int32_t z_of(const scene_t *s, int v)
{
    return s->map->vertex[v].z_q8;
}

static int apart(int32_t a, int32_t b)
{
    return abs(a - b);
}

static bool strictly_between(int32_t z, int32_t a, int32_t b)
{
    return (z > a && z < b) || (z < a && z > b);
}

static bool between(int32_t z, int32_t a, int32_t b)
{
    return z == a || z == b || strictly_between(z, a, b);
}

static void flood(scene_t *s, int first, int region)
{
    static int todo[2 * MOST];
    int count = 0;
    todo[count++] = first;
    s->region[first] = region;
    while (count > 0) {
        int t = todo[--count];
        for (int i = 0; i < 3; i++) {
            int a = s->map->triangle[t][i];
            int b = s->map->triangle[t][(i + 1) % 3];
            s->touches[region][a] = true;
            int u = s->left[b][a];
            if (u == NONE || s->line[a][b] || s->region[u] != NONE)
                continue;
            s->region[u] = region;
            todo[count++] = u;
        }
    }
}

static void look(scene_t *s, const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    memset(s, 0, sizeof *s);
    s->map = map;
    s->load = load;
    s->plan = plan;
    memset(s->left, 0xff, sizeof s->left);
    memset(s->region, 0xff, sizeof s->region);
    memset(s->contour_of, 0xff, sizeof s->contour_of);
    for (int t = 0; t < (int)map->triangle_count; t++) {
        for (int i = 0; i < 3; i++)
            s->left[map->triangle[t][i]][map->triangle[t][(i + 1) % 3]] = t;
    }
    for (int i = 0; i < plan->contours; i++) {
        for (int k = 0; k < plan->contour[i].count; k++)
            s->contour_of[plan->contour[i].first + k] = i;
        for (int k = 0; k < plan_edges(plan, i); k++) {
            int a, b;
            plan_edge(plan, i, k, &a, &b);
            s->line[a][b] = s->line[b][a] = true;
        }
    }
    for (int t = 0; t < (int)map->triangle_count; t++) {
        if (s->region[t] == NONE)
            flood(s, t, s->regions++);
    }
    for (int a = 0; a < map->vertex_count; a++) {
        for (int b = 0; b < map->vertex_count; b++) {
            if (s->line[a][b] && s->left[a][b] != NONE && s->left[b][a] != NONE) {
                int r = s->region[s->left[a][b]];
                int q = s->region[s->left[b][a]];
                s->beside[r][q] = s->beside[q][r] = true;
            }
        }
    }
}

/* The one region that vertex v lies in, or NONE: it lies in none, or between two. */
static int region_of(const scene_t *s, int v)
{
    int found = NONE;
    for (int r = 0; r < s->regions; r++) {
        if (!s->touches[r][v])
            continue;
        if (found != NONE)
            return NONE;
        found = r;
    }
    return found;
}

static bool is_spot(const scene_t *s, int v)
{
    return (v >= s->load->first_summit && v < s->load->first_saddle) ||
           (s->contour_of[v] != NONE && s->plan->contour[s->contour_of[v]].count == 1);
}

static bool is_on_line(const scene_t *s, int v)
{
    return s->contour_of[v] != NONE && s->plan->contour[s->contour_of[v]].count > 1;
}

/* --- Flat ground ------------------------------------------------------------------------------ */

const char *rule_check_flats(const yb_map_t *map, const plan_t *plan)
{
    bool one = true;
    for (int v = 1; v < plan_vertices(plan); v++)
        one = one && map->vertex[v].z_q8 == map->vertex[0].z_q8;
    for (int t = 0; t < (int)map->triangle_count && !one; t++) {
        const yb_index_t *v = map->triangle[t];
        if (map->vertex[v[0]].z_q8 == map->vertex[v[1]].z_q8 &&
            map->vertex[v[0]].z_q8 == map->vertex[v[2]].z_q8)
            return "a triangle of one height";
    }
    return NULL;
}

/* --- Summits ---------------------------------------------------------------------------------- */

static const char *check_summit(const scene_t *s, int v)
{
    int r = region_of(s, v);
    if (r == NONE)
        return "a summit that lies in no region";
    int32_t h = 0;
    bool any = false;
    for (int k = 0; k < s->load->first_saddle; k++) {
        if (k == v || !s->touches[r][k])
            continue;
        if (k >= s->load->first_summit)
            return "two summits in one region";
        if (any && z_of(s, k) != h)
            return "a summit in a region that has two heights";
        h = z_of(s, k);
        any = true;
    }
    int least = INT32_MAX;
    int most = 0;
    for (int q = 0; q < s->regions; q++) {
        for (int k = 0; k < s->load->first_saddle && s->beside[r][q]; k++) {
            if (!s->touches[q][k] || z_of(s, k) == h)
                continue;
            least = apart(z_of(s, k), h) < least ? apart(z_of(s, k), h) : least;
            most = apart(z_of(s, k), h) > most ? apart(z_of(s, k), h) : most;
        }
    }
    int off = apart(z_of(s, v), h);
    if (most == 0)
        return "a summit where nothing is of another height";
    if (off == 0 || (off < least / 8 && abs(z_of(s, v)) < YB_MAX_HEIGHT_Q8))
        return "a summit less than an eighth of an interval off its line";
    if (off >= most && most >= 8)
        return "a summit an interval and more off its line";
    return NULL;
}

/* --- Link points and links -------------------------------------------------------------------- */

/* The height of the region's lines and the frame's corners in it that is nearest to h, or h. */
static int32_t other_height(const scene_t *s, int r, int32_t h)
{
    int32_t nearest = h;
    for (int k = 0; k < s->load->first_summit; k++) {
        if (!s->touches[r][k] || is_spot(s, k) || z_of(s, k) == h)
            continue;
        if (nearest == h || apart(z_of(s, k), h) < apart(nearest, h))
            nearest = z_of(s, k);
    }
    return nearest;
}

static const char *check_saddle(const scene_t *s, int v)
{
    int r = region_of(s, v);
    if (r == NONE)
        return "a link point that lies in no region";
    for (int k = 0; k < s->load->first_summit; k++) {
        int t = s->left[v][k];
        if (t == NONE)
            continue;
        int edge = s->map->triangle[t][0] == v ? 0 : s->map->triangle[t][1] == v ? 1 : 2;
        if (yb_edge_rule(s->map, s->load, (yb_triangle_t)t, edge) != YB_RULE_SADDLE)
            continue;
        int32_t h = z_of(s, k);
        int32_t other = other_height(s, r, h);
        if (apart(h, other) > 1 && !strictly_between(z_of(s, v), h, other))
            return "a link point that is not between two heights";
    }
    return NULL;
}

static const char *check_edge(const scene_t *s, int t, int edge)
{
    int a = s->map->triangle[t][edge];
    int b = s->map->triangle[t][(edge + 1) % 3];
    yb_rule_t rule = yb_edge_rule(s->map, s->load, (yb_triangle_t)t, edge);
    if ((rule == YB_RULE_CONTOUR) != s->line[a][b])
        return "a line's segment not marked as one, or another edge that is";
    int u = s->left[b][a];
    if (u != NONE) {
        for (int i = 0; i < 3; i++) {
            if (s->map->triangle[u][i] == b &&
                yb_edge_rule(s->map, s->load, (yb_triangle_t)u, i) != rule)
                return "an edge marked on one side";
        }
    }
    int first = s->load->first_saddle;
    int end = s->load->first_skeleton;
    switch (rule) {
    case YB_RULE_SUMMIT:
        if (!(is_spot(s, a) && is_on_line(s, b)) && !(is_spot(s, b) && is_on_line(s, a)))
            return "a fan that is not from a summit to a line";
        return z_of(s, a) == z_of(s, b) ? "a fan along one height" : NULL;
    case YB_RULE_SLOPE:
        if (!is_on_line(s, a) || !is_on_line(s, b) || s->contour_of[a] == s->contour_of[b])
            return "a link that is not from one line to another";
        return z_of(s, a) == z_of(s, b) ? "a link along one height" : NULL;
    case YB_RULE_SADDLE:
        if (!(a >= first && a < end && is_on_line(s, b)) &&
            !(b >= first && b < end && is_on_line(s, a)))
            return "a link that is not from a link point to a line";
        return NULL;
    case YB_RULE_SKELETON:
        return a < end && b < end ? "a skeleton's edge without a point of one" : NULL;
    case YB_RULE_NONE:
    case YB_RULE_CONTOUR:
        break;
    }
    return NULL;
}

/* Twice the area of abc; q8, so below 2^33. */
static int64_t area(const scene_t *s, int a, int b, int c)
{
    const yb_vertex_t *p = s->map->vertex;
    return ((int64_t)p[b].x_q8 - p[a].x_q8) * ((int64_t)p[c].y_q8 - p[a].y_q8) -
           ((int64_t)p[b].y_q8 - p[a].y_q8) * ((int64_t)p[c].x_q8 - p[a].x_q8);
}

/* Does vertex k lie on ab, between its ends? */
static bool lies_on(const scene_t *s, int a, int b, int k)
{
    const yb_vertex_t *p = s->map->vertex;
    int64_t on = ((int64_t)p[k].x_q8 - p[a].x_q8) * ((int64_t)p[k].x_q8 - p[b].x_q8) +
                 ((int64_t)p[k].y_q8 - p[a].y_q8) * ((int64_t)p[k].y_q8 - p[b].y_q8);
    return k != a && k != b && area(s, a, b, k) == 0 && on <= 0;
}

static bool opposite(int64_t a, int64_t b)
{
    return (a > 0 && b < 0) || (a < 0 && b > 0);
}

/* Does the way from a to b meet no line and no vertex that was there before links? */
static bool sees(const scene_t *s, int a, int b)
{
    for (int k = 0; k < s->load->first_saddle; k++) {
        if (lies_on(s, a, b, k))
            return false;
    }
    for (int i = 0; i < s->plan->contours; i++) {
        for (int k = 0; k < plan_edges(s->plan, i); k++) {
            int c, d;
            plan_edge(s->plan, i, k, &c, &d);
            if (opposite(area(s, a, b, c), area(s, a, b, d)) &&
                opposite(area(s, c, d, a), area(s, c, d, b)))
                return false;
        }
    }
    return true;
}

/* Lengths as the rules have them (SPEC 3.1). */
static int length_of(const scene_t *s, int a, int b)
{
    int dx = abs(s->map->vertex[a].x_q8 - s->map->vertex[b].x_q8);
    int dy = abs(s->map->vertex[a].y_q8 - s->map->vertex[b].y_q8);
    return dx > dy ? dx + 3 * dy / 8 : dy + 3 * dx / 8;
}

/* May a point of the same height stand across a ridge from point p, nearer than the summit? */
static bool is_by_ridge(const scene_t *s, int r, int p, int summit)
{
    for (int q = 0; q < s->load->first_saddle; q++) {
        if (q != p && s->touches[r][q] && z_of(s, p) == z_of(s, q) && !s->line[p][q] &&
            length_of(s, p, q) < length_of(s, p, summit))
            return true;
    }
    return false;
}

/* Where one line bounds a region that has one summit. */
static const char *check_fan(const scene_t *s, int r)
{
    int line = NONE;
    int summit = NONE;
    for (int k = 0; k < s->load->first_saddle; k++) {
        if (!s->touches[r][k])
            continue;
        if (is_spot(s, k)) {
            if (summit != NONE)
                return NULL;
            summit = k;
        } else if (is_on_line(s, k)) {
            if (line != NONE && line != s->contour_of[k])
                return NULL;
            line = s->contour_of[k];
        }
    }
    if (summit == NONE || line == NONE)
        return NULL;
    const plan_contour_t *c = &s->plan->contour[line];
    for (int p = c->first; p < c->first + c->count; p++) {
        if (z_of(s, p) == z_of(s, summit))
            return NULL;
        int t = s->left[summit][p];
        int edge = 0;
        for (int i = 0; i < 3 && t != NONE; i++)
            edge = s->map->triangle[t][i] == summit ? i : edge;
        bool linked =
            t != NONE && yb_edge_rule(s->map, s->load, (yb_triangle_t)t, edge) == YB_RULE_SUMMIT;
        bool seen = sees(s, summit, p);
        if (linked && !seen)
            return "a fan through something";
        if (!linked && seen && !is_by_ridge(s, r, p, summit))
            return "a point that is not linked to its summit";
    }
    return NULL;
}

/* Which line of region r leads to each other region: before[q] is a contour, or NONE. */
static void look_beyond(const scene_t *s, int r, int before[MOST])
{
    int way[2][PLAN_MAX_CONTOURS];
    for (int q = 0; q < s->regions; q++)
        before[q] = NONE;
    for (int i = 0; i < s->plan->contours; i++) {
        way[0][i] = way[1][i] = NONE;
        if (s->plan->contour[i].count > 1) {
            int a, b;
            plan_edge(s->plan, i, 0, &a, &b);
            way[0][i] = s->region[s->left[a][b]];
            way[1][i] = s->region[s->left[b][a]];
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int i = 0; i < 2 * s->plan->contours; i++) {
            int from = way[i % 2][i / 2];
            int to = way[1 - i % 2][i / 2];
            if (from == NONE || to == r || before[to] != NONE ||
                (from != r && before[from] == NONE))
                continue;
            before[to] = from == r ? i / 2 : before[from];
            changed = true;
        }
    }
}

/* May a link down the slope go from p to q? The peak beyond other lines that is steepest from p
 * must lie behind a line of q's height, and q be at most a quarter farther than the nearest such
 * point.
 */
static bool may_link_down(const scene_t *s, int r, int p, int q)
{
    int before[MOST];
    int64_t rise = 0;
    int64_t run = 1;
    bool right = false;
    look_beyond(s, r, before);
    for (int k = 0; k < s->load->first_saddle; k++) {
        int line = is_spot(s, k) && region_of(s, k) != r ? before[region_of(s, k)] : NONE;
        if (line == NONE || line == s->contour_of[p])
            continue;
        int32_t z = z_of(s, p);
        int32_t h = z_of(s, s->plan->contour[line].first);
        if (h == z || z_of(s, k) == h || (h > z) != (z_of(s, k) > h))
            continue;
        int64_t up = apart(z_of(s, k), z);
        int64_t along = length_of(s, p, k);
        if (up * run < rise * along)
            continue;
        right = h == z_of(s, q) || (right && up * run == rise * along);
        rise = up;
        run = along;
    }
    int shortest = INT32_MAX;
    for (int k = 0; k < s->load->first_summit; k++) {
        if (s->touches[r][k] && is_on_line(s, k) && z_of(s, k) == z_of(s, q) &&
            length_of(s, p, k) < shortest)
            shortest = length_of(s, p, k);
    }
    return right && length_of(s, p, q) <= shortest + shortest / 4;
}

static const char *check_slope(const scene_t *s, int t, int edge)
{
    int a = s->map->triangle[t][edge];
    int b = s->map->triangle[t][(edge + 1) % 3];
    if (yb_edge_rule(s->map, s->load, (yb_triangle_t)t, edge) != YB_RULE_SLOPE)
        return NULL;
    int r = s->region[t];
    return may_link_down(s, r, a, b) || may_link_down(s, r, b, a)
               ? NULL
               : "a link that does not lead towards the steepest peak";
}

/* An edge of one height between two points that are both higher, or both lower. */
static const char *check_dam(const scene_t *s, int t, int edge)
{
    int a = s->map->triangle[t][edge];
    int b = s->map->triangle[t][(edge + 1) % 3];
    int c = s->map->triangle[t][(edge + 2) % 3];
    int u = s->left[b][a];
    int32_t h = z_of(s, a);
    if (u == NONE || z_of(s, b) != h || a >= s->load->first_skeleton ||
        b >= s->load->first_skeleton ||
        yb_edge_rule(s->map, s->load, (yb_triangle_t)t, edge) != YB_RULE_NONE)
        return NULL;
    int d = NONE;
    for (int i = 0; i < 3; i++) {
        if (s->map->triangle[u][i] != a && s->map->triangle[u][i] != b)
            d = s->map->triangle[u][i];
    }
    if ((z_of(s, c) > h && z_of(s, d) > h) || (z_of(s, c) < h && z_of(s, d) < h))
        return "an edge that dams a valley or cuts a ridge";
    return NULL;
}

/* --- Skeletons -------------------------------------------------------------------------------- */

/* Point v of a skeleton, in the middle of an edge of height h. */
static const char *check_height(const scene_t *s, int v, int32_t h)
{
    const yb_branch_t *branch = &s->load->branch[v];
    int32_t z = z_of(s, v);
    int32_t from = z_of(s, branch->parent);
    if (z == h || (z > h) != (from > h))
        return "a point of a skeleton on the wrong side of its sides' height";
    if (branch->parent < s->load->first_skeleton && apart(z, h) < apart(from, h) / 8)
        return "a branch that begins at the height of its sides";
    if (branch->other != v)
        return NULL;
    int32_t end = branch->end == v ? h : z_of(s, branch->end);
    return between(z, from, end) ? NULL : "a branch that goes up and down";
}

/* The edge that it halved is found by its place; where two edges may have been it, one will do. */
static const char *check_skeleton(const scene_t *s, int v)
{
    const yb_vertex_t *p = s->map->vertex;
    const char *wrong = "a point of a skeleton that is in the middle of nothing";
    if (region_of(s, v) == NONE)
        return "a point of a skeleton that lies in no region";
    if (s->load->branch[v].parent >= v)
        return "a branch that grows backwards";
    for (int a = 0; a < s->load->first_skeleton; a++) {
        if (s->left[v][a] == NONE && s->left[a][v] == NONE)
            continue;
        for (int b = 0; b < a; b++) {
            if ((s->left[v][b] == NONE && s->left[b][v] == NONE) || p[a].z_q8 != p[b].z_q8)
                continue;
            if ((p[a].x_q8 + p[b].x_q8) / 2 != p[v].x_q8 ||
                (p[a].y_q8 + p[b].y_q8) / 2 != p[v].y_q8)
                continue;
            wrong = check_height(s, v, p[a].z_q8);
            if (wrong == NULL)
                return NULL;
        }
    }
    return wrong;
}

const char *rule_check(const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    static scene_t s;
    const char *wrong = rule_check_flats(map, plan);
    look(&s, map, load, plan);
    if (load->first_summit != plan_vertices(plan))
        wrong = "where the summits begin";
    for (int v = load->first_summit; v < load->first_saddle && wrong == NULL; v++)
        wrong = check_summit(&s, v);
    for (int v = load->first_saddle; v < load->first_skeleton && wrong == NULL; v++)
        wrong = check_saddle(&s, v);
    for (int v = load->first_skeleton; v < map->vertex_count && wrong == NULL; v++)
        wrong = check_skeleton(&s, v);
    for (int t = 0; t < 3 * (int)map->triangle_count && wrong == NULL; t++)
        wrong = check_edge(&s, t / 3, t % 3);
    for (int t = 0; t < 3 * (int)map->triangle_count && wrong == NULL; t++)
        wrong = check_dam(&s, t / 3, t % 3);
    for (int t = 0; t < 3 * (int)map->triangle_count && wrong == NULL; t++)
        wrong = check_slope(&s, t / 3, t % 3);
    for (int r = 0; r < s.regions && wrong == NULL; r++)
        wrong = check_fan(&s, r);
    return wrong;
}
