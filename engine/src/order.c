#include "order.h"

#include "camera.h"
#include "fix.h"
#include "kept.h"
#include "mesh.h"
#include "refine.h"
#include "relief.h"

/* How far the eye is to the left of the line from a place to another, times its length: below 0, to
 * its right; of ba the same with the other sign, or 0 for both. Vertices lie on a lattice of
 * eighths, so that in 1/8 and 1/64 step nothing is rounded: 2^11 * (2^18 + 2^14), twice, is
 * below 2^31.
 */
static inline int32_t left_of(int32_t eye_x_q6, int32_t eye_y_q6, uint32_t a, uint32_t b)
{
#if YB_MAX_VERTICES <= 255
    const int32_t x = (int32_t)((a & 0xffff) >> 5);
    const int32_t y = (int32_t)(a >> 21);
    const int32_t dx = (int32_t)((b & 0xffff) >> 5) - x;
    const int32_t dy = (int32_t)(b >> 21) - y;
    return dx * (eye_y_q6 - y * 8) - dy * (eye_x_q6 - x * 8);
#else
    /* Of a map in full detail it may be rounded: away from 0, so that the sign stays. */
    const int32_t x = (int32_t)(a & 0xffff);
    const int32_t y = (int32_t)(a >> 16);
    const int64_t left = (int64_t)relief_dx(a, b) * (eye_y_q6 * 4 - y) -
                         (int64_t)relief_dy(a, b) * (eye_x_q6 * 4 - x);
    return (int32_t)((left + (left > 0 ? 127 : 0)) >> 7);
#endif
}

/* left_of of a triangle's edges. */
APART void find_left(const yb_frame_t *frame, const yb_index_t *corner, int32_t left[3])
{
    const yb_vertex_t *const vertex = frame->map->vertex;
    const int32_t eye_x_q6 = frame->eye_x_q6;
    const int32_t eye_y_q6 = frame->eye_y_q6;
    uint32_t end = relief_place(&vertex[corner[0]]);
    for (int i = 2; i >= 0; i--) {
        const uint32_t from = relief_place(&vertex[corner[i]]);
        left[i] = left_of(eye_x_q6, eye_y_q6, from, end);
        end = from;
    }
}

void order_root(const yb_frame_t *frame, const yb_index_t *corner, yb_part_t *part)
{
    int32_t left[3];
    find_left(frame, corner, left);
    /* Halves: sums of two, and those of the long parts of thin triangles, are below 2^31. */
    part->eye[0] = left[1] >> 1;
    part->eye[1] = left[2] >> 1;
    part->eye[2] = left[0] >> 1;
}

/* How far a place without a spot is from the eye, in the view's unit: within 1.375 * 2^16. */
APART int32_t distance_of(const yb_frame_t *frame, const yb_vertex_t *v, int32_t rise)
{
    const int32_t x = (v->x_q8 - frame->view.eye_q8[0]) >> frame->eye_shift;
    const int32_t y = (v->y_q8 - frame->view.eye_q8[1]) >> frame->eye_shift;
    return fix_max(fix_length(x, y), fix_abs(rise));
}

/* How far a triangle is open: how high above its plane the eye is, over how far its nearest corner
 * is, times frame->open_turn, which is 12 at most. Where the eye is in plan the plane has the mean
 * height of the corners, each by how far the eye is from the opposite side: of 12 bits each, sums
 * are below 3 * 2^12, and times a height, below 2^16, or a distance, below 2^17, below 2^31.
 */
APART uint8_t open_of(const yb_frame_t *frame, const yb_index_t *corner, const int32_t left[3])
{
    if (refine_out_of_sight(frame, corner))
        return ORDER_OUT;
    const int shift =
        fix_log2_floor(fix_size(left[0]) | fix_size(left[1]) | fix_size(left[2]) | 1 << 11) - 11;
    const uint32_t scale = (uint32_t)frame->near << 15;
    int32_t area = 0;
    int32_t above = 0;
    int32_t nearest = INT32_MAX;
    uint32_t near = 1; /* of a corner with a spot it is more */
    for (int i = 0; i < 3; i++) {
        const yb_index_t opposite = corner[i == 0 ? 2 : i - 1];
        const yb_vertex_t *v = &frame->map->vertex[opposite];
        const int32_t rise = camera_rise(frame, fix_max(v->z_q8, frame->view.water_q8));
        const int32_t weight = left[i] >> shift;
        const uint32_t its = frame->seen[opposite].near;
        area += weight;
        above -= weight * rise;
        if (its == 0)
            nearest = fix_min(nearest, distance_of(frame, v, rise));
        near = its > near ? its : near;
    }
    if (above <= 0)
        return ORDER_OPEN / 4;
    if (near > 1)
        nearest = fix_min(nearest, (int32_t)(scale / (near >> 1)));
    const int32_t whole = area * nearest;
    const int32_t turned = (above >> 4) * frame->open_turn;
    if (turned >= whole >> 4)
        return ORDER_OPEN;
    return (uint8_t)fix_max(turned / ((whole >> (4 + ORDER_OPEN_BITS)) + 1), ORDER_OPEN / 4);
}

/* Does a vertex lie where lines of sight ahead, or back, go? Products are within 2^19 * 2^12. */
static bool lies_there(const yb_frame_t *frame, int which, yb_index_t i)
{
    const yb_vertex_t *const v = &frame->map->vertex[i];
    /* The way that the camera looks, in plan, also if it looks straight down. */
    const int32_t x = (frame->depth_x * frame->up_z - frame->up_x * frame->depth_z) >> 16;
    const int32_t y = (frame->depth_y * frame->up_z - frame->up_y * frame->depth_z) >> 16;
    const int32_t ahead = (v->x_q8 / 4 - frame->eye_x_q6) * x + (v->y_q8 / 4 - frame->eye_y_q6) * y;
    return which == ORDER_AHEAD ? ahead > 0 : ahead < 0;
}

/* What is known of a triangle while it is sorted: which of those beside it it may hide, a bit for
 * each edge, and how many may hide it.
 */
enum {
    HIDES = 7,
    HIDDEN = 8
};

static inline unsigned hides_of(const yb_frame_t *frame, int which, const yb_index_t *corner,
                                const int32_t left[3], yb_across_t across)
{
    unsigned found = 0;
    for (int i = 0; i < 3; i++, across >>= ENTRY_BITS) {
        if ((across & NO_TRIANGLE) == NO_TRIANGLE ||
            (which != ORDER_ALL && !lies_there(frame, which, corner[i]) &&
             !lies_there(frame, which, corner[next3(i)])))
            continue;
        found += left[i] < 0 ? HIDDEN : left[i] > 0 ? 1u << i : 0;
    }
    return found;
}

/* Each triangle after all that may hide it. False: there is a circle; its triangles come last. */
static bool sort(yb_frame_t *frame, int which)
{
    const yb_across_t *const across = relief_across(frame->map);
    const yb_index_t *corner = relief_triangle(frame->map, 0);
    const yb_triangle_t count = frame->map->triangle_count;
    yb_triangle_t *const order = frame->order;
    uint8_t *const known = frame->bins; /* not in use yet */
    yb_triangle_t ready = 0;
    for (yb_triangle_t t = 0; t < count; t++, corner += 3) {
        int32_t left[3];
        find_left(frame, corner, left);
        if (which == ORDER_ALL) /* it is the same for all rows */
            frame->open[t] = open_of(frame, corner, left);
        const unsigned found = hides_of(frame, which, corner, left, across[t]);
        known[t] = (uint8_t)found;
        if (found < HIDDEN)
            order[ready++] = t;
    }
    for (yb_triangle_t done = 0; done < ready; done++) {
        yb_across_t word = across[order[done]];
        for (unsigned hides = known[order[done]] & HIDES; hides != 0; hides >>= 1) {
            const yb_triangle_t beside = (yb_triangle_t)(word & NO_TRIANGLE);
            word >>= ENTRY_BITS;
            if ((hides & 1) == 0)
                continue;
            known[beside] = (uint8_t)(known[beside] - HIDDEN);
            if (known[beside] < HIDDEN)
                order[ready++] = beside;
        }
    }
    if (ready == count)
        return true;
    for (yb_triangle_t t = 0; t < count; t++) {
        if (known[t] >= HIDDEN)
            order[ready++] = t;
    }
    return false;
}

void order_begin(yb_frame_t *frame)
{
    frame->eye_x_q6 = frame->view.eye_q8[0] >> 2;
    frame->eye_y_q6 = frame->view.eye_q8[1] >> 2;
    frame->order_for = sort(frame, ORDER_ALL) ? ORDER_ALL : ORDER_NONE;
}

/* Do the lines of sight through a row of pixels go ahead, in plan? All of a row go the same way. */
static int row_way(const yb_frame_t *frame, int32_t row)
{
    const int32_t off_q4 = (frame->screen.height - 2 * row - 1) * 8;
    return frame->up_z * frame->focal_q4 > off_q4 * frame->depth_z ? ORDER_AHEAD : ORDER_BACK;
}

int32_t order_rows(yb_frame_t *frame, int32_t row, int32_t end)
{
    if (frame->order_for == ORDER_ALL)
        return end;
    const int way = row_way(frame, row);
    if (frame->order_for != way) {
        frame->binned = false;
        kept_forget(frame);
        sort(frame, way);
    }
    frame->order_for = (uint8_t)way;
    do
        row++;
    while (row < end && row_way(frame, row) == way);
    return row;
}
