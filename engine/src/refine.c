/* Triangles of a frame are split into parts. */
#include "refine.h"

#include "fix.h"
#include "relief.h"

/* Is an edge of this length left whole, as most are, by its nearer end? */
static inline bool looks_short(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                               yb_edge_t length)
{
    int32_t least = fix_min(a->spot.near, b->spot.near);
    int32_t most = fix_max(a->spot.near, b->spot.near);
    return least > 0 && length * (uint32_t)most <= frame->longest;
}

/* An edge that an edge to be asked anew has left: most are short. */
static inline yb_edge_t ask_anew(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                                 yb_edge_t edge)
{
    return looks_short(frame, a, b, edge & 0xffff) ? edge & REFINE_WHOLE
                                                   : refine_ask(frame, a, b, edge);
}

/* Both halves of the edge ab at its midpoint m. */
TINY void halve(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *m,
                const yb_point_t *b, yb_edge_t edge, yb_edge_t *am, yb_edge_t *mb)
{
    *am = *mb = refine_half(edge);
    if (edge >= REFINE_AGAIN) {
        *am = ask_anew(frame, a, m, *am);
        *mb = ask_anew(frame, m, b, *mb);
    }
}

bool refine_is_sliver(const yb_frame_t *frame, const yb_part_t *part)
{
    const yb_spot_t *a = &part->point[0]->spot;
    const yb_spot_t *b = &part->point[1]->spot;
    const yb_spot_t *c = &part->point[2]->spot;
    if (refine_edges(part) < 3 * REFINE_ONCE || a->near == 0 || b->near == 0 || c->near == 0)
        return false;
    const int32_t bx = (int32_t)b->x_q4 - a->x_q4;
    const int32_t by = (int32_t)b->y_q4 - a->y_q4;
    const int32_t cx = (int32_t)c->x_q4 - a->x_q4;
    const int32_t cy = (int32_t)c->y_q4 - a->y_q4;
    const raster_area_t twice = (raster_area_t)bx * cy - (raster_area_t)by * cx;
    const int32_t wide = fix_max(fix_abs(bx), fix_abs(cx));
    const int32_t high = fix_max(fix_abs(by), fix_abs(cy));
    return (twice < 0 ? -twice : twice) < (raster_area_t)fix_max(wide, high) * frame->thin_q4;
}

/* The edge between two midpoints, parallel to one that is split and as long as its half. `most`: of
 * the edges of what it lies in, the greatest, one to be asked anew if there is any.
 */
static inline yb_edge_t inner_edge(const yb_frame_t *frame, const yb_point_t *a,
                                   const yb_point_t *b, yb_edge_t edge, yb_edge_t most)
{
    yb_edge_t half = refine_half(edge);
    if (most >= REFINE_AGAIN)
        half = ask_anew(frame, a, b, (half & REFINE_WHOLE) | (refine_half(most) & ~REFINE_WHOLE));
    return half;
}

/* The line from the midpoint m of ab to c, where bc is split but not ca: about half of bc, if ca is
 * short, and split as that is, as far as its midpoints are on the lattice; else left whole. It may
 * be longer where ca is long and left whole, as under water.
 */
static yb_edge_t cross_edge(const yb_frame_t *frame, const yb_point_t *m, const yb_point_t *c,
                            yb_edge_t bc, yb_edge_t ca)
{
    if ((ca & REFINE_TURNED) != 0)
        return 0;
    yb_edge_t mc = refine_half(bc);
    if (bc >= REFINE_AGAIN) { /* as often as the half has classes for, at most */
        const int32_t most = fix_min(refine_often(mc), (refine_class(mc) + 4) >> 2);
        return ask_anew(frame, m, c, (mc & (REFINE_AGAIN | REFINE_WHOLE)) | (yb_edge_t)most << 24);
    }
    const uint32_t parity = refine_parity(m, c);
    int often = 0;
    while (often < refine_often(mc) && (parity >> often & 1) == 0)
        often++;
    return (mc & REFINE_WHOLE) | (yb_edge_t)often << 24;
}

/* Of a triangle whose edges are all split, the corner a that has the part with its corner b come
 * last: of the three outer parts at most two lie on the eye's side of their inner edges.
 */
static inline int corner_before_last(const yb_part_t *part, int32_t half)
{
    return part->eye[1] <= half ? 0 : part->eye[2] <= half ? 1 : 2;
}

/* Has a triangle begin with its corner i. */
APART void turn(yb_part_t *part, int i)
{
    while (i-- > 0) {
        const yb_point_t *p = part->point[0];
        const yb_edge_t edge = part->edge[0];
        const int32_t eye = part->eye[0];
        part->point[0] = part->point[1];
        part->point[1] = part->point[2];
        part->point[2] = p;
        part->edge[0] = part->edge[1];
        part->edge[1] = part->edge[2];
        part->edge[2] = edge;
        part->eye[0] = part->eye[1];
        part->eye[1] = part->eye[2];
        part->eye[2] = eye;
    }
}

/* As SPEC 3.4, the parts in the order of order.h. A part that is laid aside needs no midpoint above
 * its own place on the stack, or one and the next place's as its last corner.
 */
static yb_level_t *split_one(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                             yb_level_t *level)
{
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2] >> 1;
    const int32_t bulge = part->bulge;
    yb_point_t *const m = &level[0].middle;
    yb_edge_t am;
    yb_edge_t mb;
    refine_middle(frame, view, a, b, part->edge[0], m);
    halve(frame, a, m, b, part->edge[0], &am, &mb);
    const int32_t across = (eye_a - eye_b) >> 1;
    const bool a_first = eye_a > eye_b;
    yb_part_t *const with_a = a_first ? part : &level[0].rest;
    yb_part_t *const with_b = a_first ? &level[0].rest : part;
    /* The line mc is no edge to be split: it is no longer than the mean of bc and ca, which are
     * left whole. */
    *with_a = (yb_part_t){{c, a, m}, {ca, am, 0}, {eye_c, across, eye_b}, bulge};
    *with_b = (yb_part_t){{b, c, m}, {bc, 0, mb}, {-across, eye_c, eye_a}, bulge};
    return level + 1;
}

static yb_level_t *split_two(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                             yb_level_t *level, yb_edge_t inside)
{
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2];
    const int32_t half = refine_half_way(part);
    const int32_t bulge = part->bulge;
    yb_point_t *const m = &level[0].middle;
    yb_point_t *const n = &level[1].middle;
    yb_edge_t am;
    yb_edge_t mb;
    yb_edge_t bn;
    yb_edge_t nc;
    refine_middle(frame, view, a, b, part->edge[0], m);
    refine_middle(frame, view, b, c, bc, n);
    halve(frame, a, m, b, part->edge[0], &am, &mb);
    halve(frame, b, n, c, bc, &bn, &nc);
    const yb_edge_t mc = cross_edge(frame, m, c, bc, ca) & inside;
    yb_part_t *const with_b = eye_b > half ? part : &level[0].rest;
    yb_part_t *const first = eye_b > half ? &level[1].rest : part;
    yb_part_t *const second = eye_b > half ? &level[0].rest : &level[1].rest;
    yb_part_t *const with_a = eye_a > eye_b ? first : second;
    yb_part_t *const with_c = eye_a > eye_b ? second : first;
    *with_b = (yb_part_t){{m, b, n}, {mb, bn, 0}, {eye_a, eye_b - half, eye_c}, bulge};
    *with_a =
        (yb_part_t){{c, a, m}, {ca, am, mc}, {eye_c >> 1, (eye_a - eye_b) >> 1, eye_b}, bulge};
    *with_c = (yb_part_t){{c, m, n}, {mc, 0, nc}, {half - eye_b, eye_a, eye_b - eye_a}, bulge};
    return level + 2;
}

static yb_level_t *split_three(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                               yb_level_t *level, yb_edge_t inside)
{
    const int32_t half = refine_half_way(part);
    turn(part, corner_before_last(part, half));
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t ab = part->edge[0];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2];
    const int32_t bulge = part->bulge >> 2;
    yb_point_t *const m = &level[0].middle;
    yb_point_t *const n = &level[1].middle;
    yb_point_t *const o = &level[2].middle;
    yb_edge_t am;
    yb_edge_t mb;
    yb_edge_t bn;
    yb_edge_t nc;
    yb_edge_t co;
    yb_edge_t oa;
    refine_middle(frame, view, a, b, ab, m);
    refine_middle(frame, view, b, c, bc, n);
    refine_middle(frame, view, c, a, ca, o);
    halve(frame, a, m, b, ab, &am, &mb);
    halve(frame, b, n, c, bc, &bn, &nc);
    halve(frame, c, o, a, ca, &co, &oa);
    const yb_edge_t greater = ab > bc ? ab : bc;
    const yb_edge_t most = greater > ca ? greater : ca;
    const yb_edge_t on = inner_edge(frame, o, n, ab, most) & inside;
    const yb_edge_t mo = inner_edge(frame, m, o, bc, most) & inside;
    const yb_edge_t mn = inner_edge(frame, m, n, ca, most) & inside;
    const bool a_first = eye_a > half;
    const bool c_first = eye_c > half;
    yb_part_t *const second = &level[2].rest;
    yb_part_t *const third = &level[1].rest;
    yb_part_t *const with_a = a_first ? part : c_first ? third : second;
    yb_part_t *const with_c = !c_first ? third : a_first ? second : part;
    yb_part_t *const middle = a_first != c_first ? second : a_first ? third : part;
    *with_a = (yb_part_t){{a, m, o}, {am, mo, oa}, {eye_a - half, eye_b, eye_c}, bulge};
    *with_c = (yb_part_t){{n, c, o}, {nc, co, on}, {eye_b, eye_c - half, eye_a}, bulge};
    *middle =
        (yb_part_t){{m, n, o}, {mn, on, mo}, {half - eye_c, half - eye_a, half - eye_b}, bulge};
    level[0].rest = (yb_part_t){{m, b, n}, {mb, bn, mn}, {eye_a, eye_b - half, eye_c}, bulge};
    return level + 3;
}

yb_level_t *refine_split(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                         yb_level_t *level)
{
    turn(part, refine_first_corner(part));
    if (part->edge[1] < REFINE_ONCE)
        return split_one(frame, view, part, level);
    const yb_edge_t inside = refine_is_sliver(frame, part) ? REFINE_WHOLE : ~(yb_edge_t)0;
    if (part->edge[2] < REFINE_ONCE)
        return split_two(frame, view, part, level, inside);
    return split_three(frame, view, part, level, inside);
}
