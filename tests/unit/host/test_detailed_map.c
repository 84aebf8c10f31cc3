/* Maps of contour lines in full detail: whatever the lines are, legal contours come of them. */
#include "detailed_map.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "rng.h"
#include "surface.h"

static const double side_m = 2550; /* steps of 10 m, grains of 62.5 cm */

static yb_map_t map;
static yb_load_t load;

/* --- What SPEC 1.5 says, checked the slow way ------------------------------------------------- */

typedef struct {
    int64_t ax, ay, bx, by;
    int contour, at; /* its first point's number in the contour */
} edge_t;

static int64_t turn(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t cx, int64_t cy)
{
    int64_t area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    return (area > 0) - (area < 0);
}

static bool between(int64_t a, int64_t b, int64_t c)
{
    return (a <= c && c <= b) || (b <= c && c <= a);
}

static bool holds(const edge_t *e, int64_t x, int64_t y)
{
    return turn(e->ax, e->ay, e->bx, e->by, x, y) == 0 && between(e->ax, e->bx, x) &&
           between(e->ay, e->by, y);
}

static bool meet(const edge_t *e, const edge_t *f)
{
    return holds(e, f->ax, f->ay) || holds(e, f->bx, f->by) || holds(f, e->ax, e->ay) ||
           holds(f, e->bx, e->by) ||
           (turn(e->ax, e->ay, e->bx, e->by, f->ax, f->ay) *
                    turn(e->ax, e->ay, e->bx, e->by, f->bx, f->by) <
                0 &&
            turn(f->ax, f->ay, f->bx, f->by, e->ax, e->ay) *
                    turn(f->ax, f->ay, f->bx, f->by, e->bx, e->by) <
                0);
}

static bool at_frame(const yb_vertex_t *v)
{
    return v->x_q8 == 0 || v->y_q8 == 0 || v->x_q8 == map.east_q8 || v->y_q8 == map.north_q8;
}

static int take_edges(edge_t *edge)
{
    int edges = 0;
    for (int i = 0; i < load.contour_count; i++) {
        const yb_contour_t *contour = &load.contour[i];
        const yb_vertex_t *v = &map.vertex[contour->first];
        int count = contour->count;
        bool open = count > 1 && at_frame(&v[0]) && at_frame(&v[count - 1]);
        assert_true(count == 1 || count >= (open ? 2 : 3));
        for (int k = 0; k < count; k++) {
            assert_int_equal(v[k].x_q8 % 16, 0);
            assert_int_equal(v[k].y_q8 % 16, 0);
            assert_true(open && (k == 0 || k == count - 1) ? at_frame(&v[k]) : !at_frame(&v[k]));
            if (open && k == count - 1)
                break;
            const yb_vertex_t *w = &v[(k + 1) % count];
            edge[edges++] = (edge_t){v[k].x_q8, v[k].y_q8, w->x_q8, w->y_q8, i, k};
        }
    }
    return edges;
}

/* Two edges may only share the point between neighbours of one line. */
static void check_pair(const edge_t *e, const edge_t *f)
{
    int count = load.contour[e->contour].count;
    bool follows = e->contour == f->contour && f->at == e->at + 1;
    bool closes = e->contour == f->contour && e->at == 0 && f->at == count - 1;
    if (follows || closes) {
        const edge_t *first = follows ? e : f;
        const edge_t *second = follows ? f : e;
        assert_false(holds(first, second->bx, second->by));
        assert_false(holds(second, first->ax, first->ay));
    } else {
        assert_false(meet(e, f));
    }
}

static void check_legal(void)
{
    static edge_t edge[YB_MAX_VERTICES];
    int edges = take_edges(edge);
    for (int i = 0; i < edges; i++)
        for (int k = i + 1; k < edges; k++)
            check_pair(&edge[i], &edge[k]);
}

/* --- Messes ----------------------------------------------------------------------------------- */

static double any(rng_t *rng, double low, double high)
{
    return low + (high - low) * rng_unit(rng);
}

static yb_place_t on_side(rng_t *rng)
{
    double along = any(rng, 0, side_m);
    switch (rng_range(rng, 0, 3)) {
    case 0:
        return (yb_place_t){0, along};
    case 1:
        return (yb_place_t){side_m, along};
    case 2:
        return (yb_place_t){along, 0};
    default:
        return (yb_place_t){along, side_m};
    }
}

/* A walk, a star that crosses itself, a ring, or all places in a corner of the map. */
static int make_places(rng_t *rng, yb_place_t *place, int most)
{
    int count = rng_range(rng, 1, most);
    int kind = rng_range(rng, 0, 3);
    double x = any(rng, 0, side_m);
    double y = any(rng, 0, side_m);
    double size = any(rng, 0.5, rng_one_in(rng, 2) ? 20 : side_m / 2);
    for (int i = 0; i < count; i++) {
        if (kind == 0) {
            x += any(rng, -size / 4, size / 4);
            y += any(rng, -size / 4, size / 4);
            place[i] = (yb_place_t){x, y};
        } else if (kind == 1) {
            place[i] = (yb_place_t){any(rng, x - size, x + size), any(rng, y - size, y + size)};
        } else if (kind == 2) {
            double angle = 6.283185307 * i / count;
            place[i] = (yb_place_t){x + size * cos(angle), y + size * sin(angle)};
        } else {
            place[i] = (yb_place_t){any(rng, 0, 8), any(rng, 0, 8)};
        }
    }
    return count;
}

static yb_lines_t *make_mess(rng_t *rng)
{
    enum {
        MOST = 60
    };
    yb_lines_t *lines = yb_lines_new(side_m, side_m);
    assert_non_null(lines);
    int count = rng_range(rng, 1, 25);
    for (int i = 0; i < count; i++) {
        yb_place_t place[MOST];
        int places = make_places(rng, place, MOST);
        bool closed = places > 2 && rng_one_in(rng, 2);
        double height_m = rng_range(rng, 100, 104);
        if (!closed && places > 1) {
            place[0] = on_side(rng);
            place[places - 1] = on_side(rng);
        }
        if (i > 0 && rng_one_in(rng, 6)) { /* the same again, or beside it */
            const yb_line_t *twin = &lines->line[rng_range(rng, 0, i - 1)];
            closed = twin->closed;
            places = twin->count;
            memcpy(place, twin->place, (size_t)places * sizeof(yb_place_t));
            for (int k = 0; k < places && (closed || places == 1); k++)
                place[k].x_m += rng_one_in(rng, 2) ? 0 : 0.3;
        }
        assert_true(yb_lines_add(lines, height_m, closed, place, places));
    }
    return lines;
}

static void test_any_mess_gives_legal_contours(void **state)
{
    (void)state;
    rng_t rng = {20260};
    yb_error_t error;
    int made = 0;
    for (int i = 0; i < 400; i++) {
        yb_lines_t *lines = make_mess(&rng);
        if (yb_detailed_map(lines, &map, &load, NULL, NULL, &error)) {
            check_legal();
            made++;
        } else {
            assert_non_null(strstr(error.text, "none of the lines"));
        }
        yb_lines_free(lines);
    }
    assert_true(made > 350);
}

/* --- One case at a time ----------------------------------------------------------------------- */

static yb_lines_t *given;
static yb_line_loss_t loss;

static int begin(void **state)
{
    (void)state;
    given = yb_lines_new(side_m, side_m);
    return given == NULL;
}

static int end(void **state)
{
    (void)state;
    yb_lines_free(given);
    return 0;
}

#define PLACES(...)                                                                                \
    (const yb_place_t[]){__VA_ARGS__}, sizeof((yb_place_t[]){__VA_ARGS__}) / sizeof(yb_place_t)

static void add(double height_m, bool closed, const yb_place_t *place, size_t count)
{
    assert_true(yb_lines_add(given, height_m, closed, place, (int)count));
}

static void add_ring(double height_m, double x, double y, double radius, int count)
{
    yb_place_t *place = malloc((size_t)count * sizeof(*place));
    assert_non_null(place);
    for (int i = 0; i < count; i++)
        place[i] = (yb_place_t){x + radius * cos(6.283185307179586 * i / count),
                                y + radius * sin(6.283185307179586 * i / count)};
    add(height_m, true, place, (size_t)count);
    free(place);
}

static void make_map(int contours)
{
    yb_error_t error = {""};
    if (!yb_detailed_map(given, &map, &load, &loss, NULL, &error))
        fail_msg("%s", error.text);
    assert_int_equal(load.contour_count, contours);
    check_legal();
}

static void assert_loss(int points, int whole, int repeated)
{
    assert_int_equal(loss.points, points);
    assert_int_equal(loss.lines, whole);
    assert_int_equal(loss.repeated, repeated);
}

static void test_saddle(void **state)
{
    (void)state;
    add(10, false, PLACES({0, 900}, {1000, 1000}, {900, 0}));
    add(10, false, PLACES({2550, 900}, {1000, 1000}, {900, 2550}));
    make_map(2);
    assert_loss(0, 0, 0); /* one goes beside the place, by a grain */
}

static void test_crossing_lines(void **state)
{
    (void)state;
    add(10, false, PLACES({0, 900}, {2550, 910}));
    add(20, false, PLACES({900, 0}, {905, 700}, {905, 1700}, {910, 2550}));
    make_map(1);
    assert_loss(0, 1, 0);
}

static void test_crossing_rings(void **state)
{
    (void)state;
    add_ring(10, 1000, 1000, 500, 100);
    add_ring(20, 1600, 1000, 500, 100);
    make_map(2);
    assert_int_equal(loss.lines, 0);
    assert_in_range(loss.points, 10, 60);
}

static void test_same_line_again(void **state)
{
    (void)state;
    add_ring(10, 1000, 1000, 500, 100);
    add_ring(10, 1000, 1000, 500, 100);
    add_ring(20, 1000, 1000, 499.9, 100); /* another height: an edge of rock */
    make_map(2);
    assert_loss(0, 0, 1);
}

static void test_ends_at_one_place(void **state)
{
    (void)state;
    add(10, false, PLACES({0, 0}, {2550, 2550}));
    add(20, false, PLACES({0, 0}, {1000, 1500}, {2550, 2550}));
    add(30, false, PLACES({0, 700}, {1000, 1800}, {700, 2550}));
    add(40, false, PLACES({0, 700}, {800, 1800}, {700, 2550}));
    make_map(4);
    assert_loss(0, 0, 0);
}

static void test_closed_line_at_the_frame(void **state)
{
    (void)state;
    add(10, true, PLACES({0, 0}, {2550, 0}, {2550, 2550}, {0, 2550}));
    add(20, true, PLACES({0, 500}, {900, 500}, {900, 900}, {0, 900}));
    make_map(2);
    assert_int_equal(loss.lines, 0);
}

static void test_lines_nearer_than_the_lattice(void **state)
{
    (void)state;
    for (int i = 0; i < 9; i++) {
        double y = 1000 + 0.2 * i;
        add(10 * i, false, PLACES({0, y}, {500, y}, {501, y + 0.1}, {1700, y + 3}, {2550, y}));
    }
    make_map(9);
    assert_int_equal(loss.lines, 0);
}

static void test_smaller_than_the_lattice(void **state)
{
    (void)state;
    add_ring(10, 1000, 1000, 500, 100);
    add_ring(20, 1000, 1000, 0.1, 12);
    make_map(2);
    assert_int_equal(load.contour[1].count, 1);
    assert_loss(0, 0, 0);
}

static void test_spot_on_a_line(void **state)
{
    (void)state;
    add(12, false, PLACES({1500, 1000}));
    add_ring(10, 1000, 1000, 500, 100);
    make_map(2);
    assert_loss(0, 0, 0);
}

static void test_self_crossing(void **state)
{
    (void)state;
    add(10, true, PLACES({500, 500}, {1500, 1500}, {1500, 500}, {500, 1500}));
    make_map(1);
    assert_loss(1, 0, 0);
}

static void test_too_many_points(void **state)
{
    (void)state;
    yb_error_t error;
    double thinned_m = 0;
    for (int i = 0; i < 5; i++)
        add_ring(10 * i, 1275, 1275, 1200 - 100 * i, 20000);
    assert_true(yb_detailed_map(given, &map, &load, &loss, &thinned_m, &error));
    assert_int_equal(load.contour_count, 5);
    assert_true(thinned_m > 0 && thinned_m < 1);
}

static void test_heights_and_places_stay(void **state)
{
    (void)state;
    yb_lines_free(given);
    given = yb_lines_new(1234.5, 777.7);
    add_ring(-2.25, 600, 300, 200, 50);
    add_ring(31.5, 600, 300, 150, 50);
    make_map(2);
    double cell_m = yb_unit_64th_m(map.cell) / 64.0;
    assert_true(fabs(map.east_q8 / 256.0 * cell_m - 1234.5) < cell_m / 16);
    assert_true(fabs(map.north_q8 / 256.0 * cell_m - 777.7) < cell_m / 16);
    for (int i = 0; i < load.point_count; i++) {
        const yb_vertex_t *v = &map.vertex[i];
        double z_m = map.base_m + v->z_q8 / 256.0 * cell_m;
        double radius = hypot(v->x_q8 / 256.0 * cell_m - 600, v->y_q8 / 256.0 * cell_m - 300);
        assert_true(fabs(z_m - (i < 50 ? -2.25 : 31.5)) < 0.02);
        assert_true(fabs(radius - (i < 50 ? 200 : 150)) < cell_m / 8);
    }
}

static void test_heights_of_many_places(void **state)
{
    (void)state;
    enum {
        PLACES = 64
    };
    uint16_t at_q8[PLACES];
    static int32_t z_q8[PLACES * PLACES];
    for (int i = 0; i < 10; i++)
        add_ring(10 * i, 1275, 1275, 1200 - 100 * i, 700);
    make_map(10);
    for (int i = 0; i < PLACES; i++)
        at_q8[i] = (uint16_t)(map.east_q8 * i / (PLACES - 1));
    yb_map_heights(&map, at_q8, PLACES, at_q8, PLACES, z_q8);
    for (int i = 0; i < PLACES * PLACES; i++)
        assert_int_equal(z_q8[i], yb_map_height(&map, at_q8[i % PLACES], at_q8[i / PLACES]));
}

static void test_refused(void **state)
{
    (void)state;
    yb_error_t error;
    assert_false(yb_detailed_map(given, &map, &load, NULL, NULL, &error));
    assert_non_null(strstr(error.text, "no contour lines"));
    add_ring(10, 1000, 1000, 500, 100);
    add_ring(20000, 1000, 1000, 400, 100);
    assert_false(yb_detailed_map(given, &map, &load, NULL, NULL, &error));
    assert_non_null(strstr(error.text, "are they metres"));
    yb_lines_free(given);
    given = yb_lines_new(1000, 2);
    add(10, false, PLACES({500, 0}, {510, 2}));
    assert_false(yb_detailed_map(given, &map, &load, NULL, NULL, &error));
    assert_non_null(strstr(error.text, "shorter side"));
    yb_lines_free(given);
    given = yb_lines_new(1000, 1e300);
    add(10, false, PLACES({500, 0}, {500, 1e300}));
    assert_false(yb_detailed_map(given, &map, &load, NULL, NULL, &error));
    assert_non_null(strstr(error.text, "the earth"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_any_mess_gives_legal_contours),
        cmocka_unit_test_setup_teardown(test_saddle, begin, end),
        cmocka_unit_test_setup_teardown(test_crossing_lines, begin, end),
        cmocka_unit_test_setup_teardown(test_crossing_rings, begin, end),
        cmocka_unit_test_setup_teardown(test_same_line_again, begin, end),
        cmocka_unit_test_setup_teardown(test_ends_at_one_place, begin, end),
        cmocka_unit_test_setup_teardown(test_closed_line_at_the_frame, begin, end),
        cmocka_unit_test_setup_teardown(test_lines_nearer_than_the_lattice, begin, end),
        cmocka_unit_test_setup_teardown(test_smaller_than_the_lattice, begin, end),
        cmocka_unit_test_setup_teardown(test_spot_on_a_line, begin, end),
        cmocka_unit_test_setup_teardown(test_self_crossing, begin, end),
        cmocka_unit_test_setup_teardown(test_too_many_points, begin, end),
        cmocka_unit_test_setup_teardown(test_heights_and_places_stay, begin, end),
        cmocka_unit_test_setup_teardown(test_heights_of_many_places, begin, end),
        cmocka_unit_test_setup_teardown(test_refused, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
