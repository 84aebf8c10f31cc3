/* What the stages of loading share: the mesh while it is being built.
 *
 *     code ─► border_close ─► mesh_triangulate ─► regions_find ─► summits_add ─► links_add
 *          ─► skeleton_add ─► relief_prepare
 *
 * A triangle is three vertices, counter-clockwise; its edge i runs from corner i to corner i + 1,
 * and the entry across it is the triangle there, or NO_TRIANGLE. An edge that must stay (a
 * contour's, or a link) is *marked*, in the entries from both sides; it is never flipped nor
 * crossed.
 *
 * A *half* is an edge as one of its triangles sees it: edge i of triangle t is the half 4t + i. It
 * begins at corner i, ends at corner i + 1 and has the third corner, its apex, on its left. The
 * halves that begin at a vertex are its spokes, each the rightmost side of its triangle there.
 *
 *            apex
 *            /  ^
 *    last_of/    \next_of
 *          v      \
 *      origin ───► end
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

/* Numbers of halves; NO_HALF, below 0: there is none. */
typedef int half_t;
enum {
    NO_HALF = -1
};
_Static_assert(sizeof(half_t) >= 4 || YB_MAX_TRIANGLES < 8192, "an int numbers all halves");

static inline int triangle_of(half_t e)
{
    return e >> 2;
}

/* The place of a point in the mesh: the half that it lies on, or, inside triangle t, 4t + 3. */
static inline half_t place_inside(half_t e)
{
    return e | 3;
}

static inline bool is_inside(half_t place)
{
    return (place & 3) == 3;
}

static inline int next3(int i)
{
    return i == 2 ? 0 : i + 1;
}

/* The next half of the triangle, counter-clockwise, and the last one. */
half_t next_of(half_t e);
half_t last_of(half_t e);

/* The next half of all, NO_HALF after the last one:
 *
 *     for (half_t e = 0; e != NO_HALF; e = half_after(load, e))
 */
half_t half_after(const yb_load_t *load, half_t e);

/* The region that the half's triangle lies in, after regions_find; one that meets at vertex v. */
int region_of(const yb_load_t *load, half_t e);
int region_at(const yb_load_t *load, int v);

int origin_of(const yb_load_t *load, half_t e);
int end_of(const yb_load_t *load, half_t e);
int apex_of(const yb_load_t *load, half_t e);

/* What lies across a half: above NO_TRIANGLE if it is marked. */
int entry_of(const yb_load_t *load, half_t e);

void set_entry(yb_load_t *load, half_t e, int entry);

/* Must an edge stay? */
static inline bool is_marked(const yb_load_t *load, half_t e)
{
    return entry_of(load, e) > NO_TRIANGLE;
}

/* The half of triangle t that begins at vertex v, one of its corners. */
half_t half_at(const yb_load_t *load, int t, int v);

/* The same edge seen from its other side, or NO_HALF on the frame. */
half_t twin_of(const yb_load_t *load, half_t e);

/* All spokes of v, counter-clockwise:
 *
 *     for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e))
 *
 * from the rightmost one if v is on the frame, from any if not.
 */
half_t first_spoke(const yb_load_t *load, int v);
half_t spoke_after(const yb_load_t *load, half_t e);

/* All neighbours of v, counter-clockwise; the first one again at the end, if v is not on the frame:
 *
 *     half_t e = first_spoke(load, v);
 *     for (int q = end_of(load, e); q >= 0; q = neighbour_after(load, &e))
 */
int neighbour_after(const yb_load_t *load, half_t *e);

/* The spoke to the left of e, without end; NO_HALF on the frame. */
half_t spoke_left(const yb_load_t *load, half_t e);

/* The spoke from vertex a that ends at b; there is one. */
half_t spoke_to(const yb_load_t *load, int a, int b);

static inline const yb_vertex_t *vertex_of(const yb_load_t *load, int v)
{
    return &load->vertex[v];
}

int32_t height_at(const yb_load_t *load, int v);

bool on_frame(const yb_load_t *load, const yb_vertex_t *v);

/* See yb_contour_is_open. */
bool is_open(const yb_load_t *load, const yb_contour_t *contour);

/* From vertex a to vertex b: x and y in 1/64 step, z in q8. Coordinates are multiples of 4 below
 * 2^16: within ±2^14.
 */
void find_way(const yb_load_t *load, int a, int b, int32_t way[3]);

/* Twice the area of abc in square 1/64 steps, positive when counter-clockwise. Coordinates are
 * multiples of 4 below 2^16, so differences are within ±2^14 and the result within ±2^29.
 */
int32_t area_of(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c);

int32_t orientation(const yb_load_t *load, int a, int b, int c);

/* The same of a half and a point: positive if the point lies to its left. */
int32_t side_of(const yb_load_t *load, half_t e, const yb_vertex_t *p);

/* What the angle at the apex of a half is like, which is between the ways to its ends: the area
 * that they span, which is twice the triangle's, and their product, positive where the angle is
 * acute. Its cotangent is the quotient. Both within ±2^29.
 */
typedef struct {
    int32_t area, dot;
} angle_t;

void find_angle(const yb_load_t *load, half_t e, angle_t *angle);

/* Length from vertex to vertex, q8: see fix_length. */
int32_t edge_length(const yb_load_t *load, int a, int b);

int32_t half_length(const yb_load_t *load, half_t e);

/* Height at the end of a half less that at its origin. */
int32_t rise_of(const yb_load_t *load, half_t e);

/* The place half way between two vertices, and the middle of an edge, at the height of its
 * beginning; without slopes.
 */
void find_middle_of(const yb_vertex_t *a, const yb_vertex_t *b, yb_vertex_t *middle);
void find_middle(const yb_load_t *load, half_t e, yb_vertex_t *middle);

/* The edge as a number, the lower end's times 65536 and the higher end's: an order that does not
 * depend on how the mesh is written down.
 */
uint32_t edge_key(const yb_load_t *load, half_t e);

static inline int lower_end(const yb_load_t *load, half_t e)
{
    return (int)(edge_key(load, e) >> 16);
}

/* --- Stages ----------------------------------------------------------------------------------- */

/* The first two answer false where the contours are corrupt, those that add to the mesh where it
 * has no room for that.
 */

/* Checks the contours against the frame, tells open from closed ones, adds the corners that no
 * line ends at, and gives every corner its height (SPEC 1.5, 2.1).
 */
YB_MUST_CHECK bool border_close(yb_load_t *load);

/* The constrained Delaunay triangulation of all vertices and contour edges (SPEC 2.2); false if
 * contours cross or touch.
 */
YB_MUST_CHECK bool mesh_triangulate(yb_load_t *load);

/* The regions between the contours, and on which sides of each contour they lie (SPEC 2.3). */
void regions_find(yb_load_t *load);

/* Section 3: a summit, or the bottom of a pit, for every region of one height (SPEC 2.4). */
YB_MUST_CHECK bool summits_add(yb_load_t *load);

/* Rules 4, 5 and 7: link points between peaks (saddles.c), links from summits and down the slopes
 * (SPEC 2.5).
 */
YB_MUST_CHECK bool links_add(yb_load_t *load);

/* Rules 6: points along the middle of whatever still is flat (SPEC 2.6). */
YB_MUST_CHECK bool skeleton_add(yb_load_t *load);

/* Slopes, amplitude, and the tables of noise and reach (SPEC 3). */
void relief_prepare(const yb_load_t *load);

/* --- Changes ---------------------------------------------------------------------------------- */

/* Adds a vertex, of which x, y and z are given, that lies in no triangle yet; false if the code did
 * not promise so many.
 */
YB_MUST_CHECK bool mesh_add_vertex(yb_load_t *load, const yb_vertex_t *at);

/* The same, and splits the triangle that it lies in at it, or, on an edge, both. Nothing is
 * flipped.
 */
YB_MUST_CHECK bool mesh_insert(yb_load_t *load, half_t place, const yb_vertex_t *at);

/* Makes the edges round the new vertex p Delaunay. */
void mesh_legalise(yb_load_t *load, int p);

/* Can ab become an edge? Not if a marked edge or a vertex is in its way. To `force` it, it is made
 * one and marked, as far as that goes.
 */
bool mesh_reach(yb_load_t *load, int a, int b, bool force);

/* Makes ab a marked edge; false if another or a vertex is in its way. */
static inline bool mesh_force_edge(yb_load_t *load, int a, int b)
{
    return mesh_reach(load, a, b, true);
}

/* Flips what is not marked until it is Delaunay. */
void mesh_make_delaunay(yb_load_t *load);

/* Can ab become an edge? */
static inline bool mesh_sees(yb_load_t *load, int a, int b)
{
    return mesh_reach(load, a, b, false);
}

/* Makes it one if it can. */
bool mesh_link(yb_load_t *load, int a, int b);

/* The region on side k of the contours: the left one of contour k / 2, or, k odd, its right one. */
int region_beside(const yb_load_t *load, int k);

#endif
