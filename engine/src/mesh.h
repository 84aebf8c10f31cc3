/* What the stages of loading share: the mesh while it is being built.
 *
 *     code ─► border_close ─► mesh_triangulate ─► regions_find ─► summits_add ─► links_add
 *          ─► skeleton_add ─► relief_prepare
 *
 * A triangle is three vertices, counter-clockwise; its edge i runs from corner i to corner i + 1,
 * and the entry across it is the triangle there, or NO_TRIANGLE. An edge that must stay (a
 * contour's, or a link) is *marked*, in the entries from both sides; it is never flipped nor
 * crossed.
 */
#ifndef YB_MESH_H
#define YB_MESH_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

#define UNKNOWN_HEIGHT INT32_MIN

/* An entry: a triangle, and the mark. Three make a word of load->across. */
enum {
    ENTRY_BITS = sizeof(yb_across_t) == 4 ? 10 : 20,
    ENTRY_MARK = 1L << (ENTRY_BITS - 1),
    NO_TRIANGLE = ENTRY_MARK - 1, /* across the frame */
    ENTRY_ALL = ENTRY_MARK | NO_TRIANGLE
};
typedef yb_triangle_t yb_entry_t;

static inline int next3(int i)
{
    return i == 2 ? 0 : i + 1;
}

static inline int prev3(int i)
{
    return i == 0 ? 2 : i - 1;
}

/* What lies across edge `edge` of t: above NO_TRIANGLE if it is marked. */
yb_entry_t entry_of(const yb_load_t *load, yb_triangle_t t, int edge);

void set_entry(yb_load_t *load, yb_triangle_t t, int edge, yb_entry_t entry);

static inline yb_triangle_t neighbour_of(const yb_load_t *load, yb_triangle_t t, int edge)
{
    return entry_of(load, t, edge) & NO_TRIANGLE;
}

/* Must an edge stay? */
static inline bool is_marked(const yb_load_t *load, yb_triangle_t t, int edge)
{
    return entry_of(load, t, edge) > NO_TRIANGLE;
}

/* Which corner of triangle t vertex v is; v is one of them. */
int corner_of(const yb_map_t *map, yb_triangle_t t, yb_index_t v);

/* The corner of triangle t that comes after (before) its corner v, counter-clockwise. */
yb_index_t corner_after(const yb_map_t *map, yb_triangle_t t, yb_index_t v);

yb_index_t corner_before(const yb_map_t *map, yb_triangle_t t, yb_index_t v);

bool on_frame(const yb_map_t *map, const yb_vertex_t *v);

/* Twice the area of abc in square 1/64 steps, positive when counter-clockwise. Coordinates are
 * multiples of 4 below 2^16, so differences are within ±2^14 and the result within ±2^29.
 */
int32_t area_of(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c);

int32_t orientation(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t c);

/* Length of an edge, q8: see fix_length. */
int32_t edge_length(const yb_map_t *map, yb_index_t a, yb_index_t b);

/* Checks the contours against the frame, tells open from closed ones, adds the corners that no
 * line ends at, and gives every corner its height (SPEC 1.5, 2.1).
 */
YB_MUST_CHECK yb_status_t border_close(yb_map_t *map, yb_load_t *load);

/* The constrained Delaunay triangulation of all vertices and contour edges (SPEC 2.2); corrupt if
 * contours cross or touch.
 */
YB_MUST_CHECK yb_status_t mesh_triangulate(yb_map_t *map, yb_load_t *load);

/* Adds a vertex that lies in no triangle yet; corrupt if the code did not promise so many. */
YB_MUST_CHECK yb_status_t mesh_add_vertex(yb_map_t *map, yb_load_t *load, uint16_t x_q8,
                                          uint16_t y_q8, int32_t z_q8);

/* Splits t at vertex p, which lies on its edge `edge` (then the triangle across is split too) or,
 * edge = -1, inside. Nothing is flipped.
 */
void mesh_split(yb_map_t *map, yb_load_t *load, yb_triangle_t t, int edge, yb_index_t p);

/* Makes the edges round the new vertex p Delaunay. */
void mesh_legalise(yb_map_t *map, yb_load_t *load, yb_index_t p);

/* Makes ab a marked edge; corrupt if another or a vertex is in its way. */
YB_MUST_CHECK yb_status_t mesh_force_edge(yb_map_t *map, yb_load_t *load, yb_index_t a,
                                          yb_index_t b);

/* Flips what is not marked until it is Delaunay. */
void mesh_make_delaunay(yb_map_t *map, yb_load_t *load);

/* Can ab become an edge? Not if a marked edge or a vertex is in its way. */
bool mesh_sees(const yb_map_t *map, const yb_load_t *load, yb_index_t a, yb_index_t b);

/* The regions between the contours, and on which sides of each contour they lie (SPEC 2.3). */
YB_MUST_CHECK yb_status_t regions_find(const yb_map_t *map, yb_load_t *load);

/* Section 3: a summit, or the bottom of a pit, for every region of one height (SPEC 2.4). */
YB_MUST_CHECK yb_status_t summits_add(yb_map_t *map, yb_load_t *load);

/* Rules 4, 5 and 7: link points between peaks (saddles.c), links from summits and down the slopes
 * (SPEC 2.5).
 */
YB_MUST_CHECK yb_status_t links_add(yb_map_t *map, yb_load_t *load);

/* Rules 6: points along the middle of whatever still is flat (SPEC 2.6). */
YB_MUST_CHECK yb_status_t skeleton_add(yb_map_t *map, yb_load_t *load);

/* Slopes, amplitude, and the tables of noise and reach (SPEC 3). */
void relief_prepare(yb_map_t *map, const yb_load_t *load);

/* The triangle after t (before t) in counter-clockwise order round vertex v, or NO_TRIANGLE. */
yb_triangle_t turn_left(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v);

yb_triangle_t turn_right(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v);

/* The triangle across edge i of t, which is not on the frame, and which corner of it lies opposite.
 */
yb_triangle_t across(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i,
                     int *corner);

/* The vertex opposite edge i of t on its other side; the edge is not on the frame. */
yb_index_t apex_across(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i);

/* Edge i of t as a number, the lower end's times 65536 and the higher end's: an order that does not
 * depend on how the mesh is written down.
 */
uint32_t mesh_edge_key(const yb_map_t *map, yb_triangle_t t, int i);

/* Do all corners lie at one height? */
bool is_flat(const yb_map_t *map, yb_triangle_t t);

/* All triangles at v, counter-clockwise from the first: the one after t, or NO_TRIANGLE. */
yb_triangle_t turn_on(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v,
                      yb_triangle_t first);

/* The rightmost triangle at v: the first one counter-clockwise if v is on the frame, any if not. */
yb_triangle_t first_at(const yb_map_t *map, const yb_load_t *load, yb_index_t v);

#endif
