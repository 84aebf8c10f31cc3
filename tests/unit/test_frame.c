/* Whole frames: the same in any bands, nothing dropped that is seen, bounded. That nothing shows
 * through is tested in test_cracks.c.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <yamabiko/yamabiko.h>

#include "colour.h"
#include "loaded_map.h"
#include "plain_frame.h"
#include "raster.h"

enum {
    WIDTH = 320,
    HEIGHT = 240,
};

static yb_frame_t frame;
static uint8_t greys[WIDTH / 2 * HEIGHT];
static uint8_t whole[WIDTH * HEIGHT * 2];
static uint8_t again[WIDTH * HEIGHT * 2];

static const yb_screen_t *random_scene(rng_t *rng, int round, yb_view_t *view)
{
    static const yb_screen_t screens[] = {
        {128, 64, YB_GREY4}, {160, 120, YB_RGB565}, {90, 160, YB_MONO}, {WIDTH, HEIGHT, YB_RGB565}};
    if (round % 8 == 0) {
        plan_t plan;
        random_fitting_plan(&plan, rng);
        load_plan(&plan);
    }
    random_view(view, &map, rng);
    random_look(view, rng);
    return &screens[round % 4];
}

static void draw(uint8_t *pixels, int y, int rows)
{
    size_t pitch = yb_screen_pitch(&frame.screen);
    yb_band_t band = {(uint16_t)y, (uint16_t)rows, pixels + (size_t)y * pitch, pitch, greys};
    yb_frame_band(&frame, &band);
}

/* --- Bands ------------------------------------------------------------------------------------ */

static void any_bands_give_the_same_picture(void **state)
{
    (void)state;
    rng_t rng = {71};
    for (int round = 0; round < 240; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        yb_frame_begin(&frame, &map, &view, screen);
        size_t size = yb_screen_pitch(screen) * screen->height;
        draw(whole, 0, screen->height);
        const int heights[] = {1, 8, 16, rng_range(&rng, 2, 50)};
        for (int k = round % 3 == 0 ? 0 : 1; k < 4; k++) {
            memset(again, 0x5a, sizeof again);
            int bands = (screen->height + heights[k] - 1) / heights[k];
            int start = rng_range(&rng, 0, bands - 1);
            int stride = bands > 1 ? rng_range(&rng, 1, bands - 1) : 1;
            while (bands > 1 && (bands % stride == 0 && stride > 1))
                stride--;
            bool done[HEIGHT] = {false};
            for (int i = 0, at = start; i < bands; i++, at = (at + stride) % bands) {
                while (done[at])
                    at = (at + 1) % bands;
                done[at] = true;
                int y = at * heights[k];
                int rows = screen->height - y < heights[k] ? screen->height - y : heights[k];
                draw(again, y, rows);
            }
            CHECK(memcmp(whole, again, size) == 0, "view %d differs in bands of %d", round,
                  heights[k]);
        }
    }
}

/* A map of as many summits as a code can say, each of its own height. */
static void load_crowd(rng_t *rng)
{
    plan_t plan;
    plan_init(&plan, 255, 255);
    while (plan.points < 251) {
        const plan_point_t at = {rng_range(rng, 1, 254), rng_range(rng, 1, 254)};
        (void)plan_try(&plan, &at, 1, 30 + plan.points * 97 % 251);
    }
    load_plan(&plan);
}

/* What a band has handed on is what the next would find: of the first triangles, in their order,
 * that both have.
 */
static void check_queue(int first_row, int end_row)
{
    const yb_queue_t *queue = &frame.queue;
    const int first_bin = refine_bin_of(&frame, first_row);
    const int last_bin = refine_bin_of(&frame, end_row - 1);
    uint8_t at = queue->end;
    for (int i = 0; i < map.triangle_count && at != queue->next; i++) {
        const yb_triangle_t triangle = frame.order[i];
        if (!refine_touches(&frame, triangle, first_bin, last_bin) ||
            !refine_touches(&frame, triangle, refine_bin_of(&frame, end_row), 15))
            continue;
        const yb_kept_t *kept = &frame.kept[at++ % YB_KEPT];
        yb_part_t fresh;
        refine_root(&frame, plain_view(&frame), triangle, NULL, &fresh);
        assert_memory_equal(kept->edge, fresh.edge, sizeof fresh.edge);
        assert_int_equal(kept->bulge, fresh.bulge);
    }
    assert_int_equal(at, queue->next);
}

/* From the top down, so that each band takes what the one above it hands on: also where there is
 * more of that than is kept, where the stack grows over it, where a band is drawn a second time,
 * and where their heights are all different.
 */
static void bands_hand_on_what_they_know(void **state)
{
    (void)state;
    rng_t rng = {977};
    int handed_on = 0;
    int full = 0;
    int grown_over = 0;
    for (int round = 0; round < 120; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        if (round % 8 < 4) {
            load_crowd(&rng);
            random_view(&view, &map, &rng);
            view.edge_q4 = (uint16_t)(round % 8 == 0 ? 16 : 160);
        }
        yb_frame_begin(&frame, &map, &view, screen);
        draw(whole, 0, screen->height);
        for (int height = 1; height < 32; height *= 2) {
            memset(again, 0x5a, sizeof again);
            for (int y = 0, rows; y < screen->height; y += rows) {
                rows = rng_range(&rng, height, 2 * height - 1);
                rows = rows < screen->height - y ? rows : screen->height - y;
                draw(again, y, rows);
                if (rng_range(&rng, 0, 15) == 0)
                    draw(again, y, rows);
                if (y + rows < screen->height)
                    check_queue(y, y + rows);
                handed_on += frame.queue.next != frame.queue.end;
                full += frame.queue.full && frame.queue.row > 0;
                grown_over += frame.queue.row < 0;
            }
            CHECK(memcmp(whole, again, yb_screen_pitch(screen) * screen->height) == 0,
                  "view %d differs in bands of %d and more", round, height);
        }
    }
    print_message("of the bands %d hand on something, %d are full, %d grown over\n", handed_on,
                  full, grown_over);
    assert_true(handed_on > 1000 && full > 100 && grown_over > 100);
}

/* A map, its frame and a band in one piece, of any length: the frame is as it is elsewhere, the map
 * stays as it is, and nothing behind the piece is touched.
 */
static void one_piece_of_memory_is_enough(void **state)
{
    (void)state;
    enum {
        MOST = sizeof(yb_map_t) + sizeof(yb_frame_t) + WIDTH * 4 * HEIGHT,
        GUARD = 64
    };
    static union {
        yb_map_t map;
        uint8_t byte[MOST + GUARD];
    } piece;
    rng_t rng = {173};
    int least = HEIGHT;
    for (int round = 0; round < 200; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        const size_t pitch = yb_screen_pitch(screen);
        const size_t row = yb_band_row_bytes(screen);
        yb_frame_begin(&frame, &map, &view, screen);
        draw(whole, 0, screen->height);
        memset(piece.byte, 0xa5, sizeof piece.byte);
        piece.map = map;
        const size_t bytes = sizeof(yb_map_t) + sizeof(yb_frame_t) +
                             (size_t)rng_range(&rng, 1, round % 2 == 0 ? 20 : HEIGHT) * row;
        yb_band_t band;
        yb_frame_t *placed = yb_frame_place(&piece.map, bytes, screen, &band);
        assert_non_null(placed);
        assert_true(band.y == 0 && band.rows >= 1 && band.rows <= screen->height);
        least = band.rows < least ? band.rows : least;
        yb_frame_begin(placed, &piece.map, &view, screen);
        const uint16_t most = band.rows;
        int bands = 0;
        for (int y = 0; y < screen->height; y += band.rows, bands++) {
            band.y = (uint16_t)y;
            band.rows = yb_band_rows(screen, band.y, most);
            assert_true(band.rows >= 1 && band.rows <= (y == 0 ? most : screen->height - y));
            assert_true(y == 0 || band.rows == most);
            yb_frame_band(placed, &band);
            assert_memory_equal(band.pixels, whole + (size_t)y * pitch, band.rows * pitch);
        }
        assert_int_equal(bands, (screen->height + most - 1) / most);
        band.rows = most;
        assert_memory_equal(piece.map.vertex, map.vertex, map.vertex_count * sizeof *map.vertex);
        for (yb_triangle_t t = 0; t < map.triangle_count; t++)
            assert_memory_equal(yb_map_triangle(&piece.map, t), map.triangle[t],
                                sizeof map.triangle[t]);
        for (size_t i = bytes; i < sizeof piece.byte; i++)
            CHECK(piece.byte[i] == 0xa5, "round %d: byte %zu of %zu was written", round, i, bytes);
        /* Not one row more would have fitted, nor does one in less than is needed for it. */
        const size_t used = (size_t)(band.pixels - piece.byte);
        assert_true(bytes - used - band.rows * row < row || band.rows == screen->height);
        assert_null(yb_frame_place(&piece.map, used + row - 1, screen, &band));
        assert_non_null(yb_frame_place(&piece.map, used + row, screen, &band));
        assert_int_equal(band.rows, 1);
        for (yb_triangle_t t = 0; t < map.triangle_count; t++) {
            assert_memory_equal(yb_map_triangle(&piece.map, t), map.triangle[t],
                                sizeof map.triangle[t]);
            for (int i = 0; i < 3; i++)
                assert_int_equal(yb_edge_rule(&piece.map, &load, t, i),
                                 yb_edge_rule(&map, &load, t, i));
        }
        assert_int_equal(yb_map_height(&piece.map, 9000, 7000), yb_map_height(&map, 9000, 7000));
        /* The next map needs all of the memory again. */
        plan_t plan;
        uint8_t code[PLAN_MAX_BYTES];
        static yb_load_t other;
        static yb_map_t fresh;
        random_fitting_plan(&plan, &rng);
        const size_t count = plan_write(&plan, code);
        assert_int_equal(yb_map_load(&fresh, &other, code, count), YB_OK);
        assert_int_equal(yb_map_load(&piece.map, &other, code, count), YB_OK);
        assert_true(map_same(&piece.map, &fresh));
        /* Which rule made an edge is known as long as the map is, wherever its triangles are. */
        static yb_rule_t rule[YB_MAX_TRIANGLES][3];
        for (yb_triangle_t t = 0; t < piece.map.triangle_count; t++)
            for (int i = 0; i < 3; i++)
                rule[t][i] = yb_edge_rule(&piece.map, &other, t, i);
        placed = yb_frame_place(&piece.map, MOST, screen, &band);
        memset(placed, 0x5a, (size_t)(piece.byte + MOST - (uint8_t *)placed));
        for (yb_triangle_t t = 0; t < piece.map.triangle_count; t++)
            for (int i = 0; i < 3; i++)
                assert_int_equal(yb_edge_rule(&piece.map, &other, t, i), rule[t][i]);
    }
    print_message("bands of %d rows and more\n", least);
    /* As much as is promised for any map, and nothing for a screen without pixels. */
    piece.map.vertex_count = YB_MAX_VERTICES;
    piece.map.triangle_count = YB_MAX_TRIANGLES;
    piece.map.packed = false;
    yb_band_t band;
    const yb_screen_t screen = {128, 64, YB_GREY4};
    const size_t promised = sizeof(yb_map_t) + sizeof(yb_frame_t) + 2 * sizeof(void *);
    assert_non_null(yb_frame_place(&piece.map, promised + 64, &screen, &band));
    assert_true(band.rows == 1);
    const yb_screen_t none = {0, 0, YB_GREY4};
    assert_null(yb_frame_place(&piece.map, sizeof piece, &none, &band));
}

static void a_band_leaves_the_rest_alone(void **state)
{
    (void)state;
    rng_t rng = {72};
    yb_view_t view;
    (void)random_scene(&rng, 0, &view);
    yb_screen_t screen = {64, 40, YB_GREY4};
    yb_frame_begin(&frame, &map, &view, &screen);
    memset(again, 0xa5, sizeof again);
    /* Eight rows asked for from row 36: four of them are below the screen. */
    yb_band_t band = {36, 8, again, 40, NULL};
    yb_frame_band(&frame, &band);
    for (size_t i = 0; i < sizeof again; i++)
        assert_true(again[i] == 0xa5 || (i / 40 < 4 && i % 40 < 32));
    band.y = 40;
    memset(again, 0xa5, sizeof again);
    yb_frame_band(&frame, &band);
    for (size_t i = 0; i < sizeof again; i++)
        assert_true(again[i] == 0xa5);
}

/* --- Nothing seen is dropped ------------------------------------------------------------------ */

static void culling_changes_no_pixel(void **state)
{
    (void)state;
    rng_t rng = {73};
    for (int round = 0; round < 320; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        if (view.edge_q4 < 96)
            view.edge_q4 = 96;
        yb_frame_begin(&frame, &map, &view, screen);
        draw(whole, 0, screen->height);
        yb_band_t band = {0, screen->height, again, yb_screen_pitch(screen), greys};
        plain_frame(&frame, &band);
        CHECK(memcmp(whole, again, yb_screen_pitch(screen) * screen->height) == 0,
              "view %d differs from the plain drawing", round);
    }
}

/* --- The triangles themselves ----------------------------------------------------------------- */

enum {
    MOST_HANDED = 60000
};
static uint32_t handed[MOST_HANDED]; /* a sum over the corners of each */
static uint32_t handed_count;

static uint32_t sum_of(uint32_t place_a, uint32_t place_b, uint32_t place_c, int32_t z)
{
    return place_a * 3 + place_b * 5 + place_c * 7 + (uint32_t)z;
}

static void take_triangle(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                          const yb_vertex_t *c)
{
    (void)context;
    assert_true(handed_count < MOST_HANDED);
    handed[handed_count++] =
        sum_of((uint32_t)a->y_q8 << 16 | a->x_q8, (uint32_t)b->y_q8 << 16 | b->x_q8,
               (uint32_t)c->y_q8 << 16 | c->x_q8, a->z_q8 + b->z_q8 + c->z_q8);
}

/* Those that plain drawing would draw, in its order, are handed out in this one. */
static void expect_leaf(void *context, const yb_point_t *const p[3])
{
    uint32_t *next = context;
    const raster_t whole_screen = {.screen = &frame.screen, .end_row = frame.screen.height};
    raster_look_t look = raster_draw(&whole_screen, &p[0]->spot, &p[1]->spot, &p[2]->spot, 0, NULL);
    uint32_t sum =
        sum_of(p[0]->place, p[1]->place, p[2]->place, p[0]->top_q8 + p[1]->top_q8 + p[2]->top_q8);
    if (look == RASTER_NOTHING)
        return;
    bool is_next = *next < handed_count && handed[*next] == sum;
    assert_true(is_next || look == RASTER_BEYOND); /* clipped ones may be all outside */
    *next += is_next ? 1 : 0;
}

static void what_is_drawn_is_handed_out(void **state)
{
    (void)state;
    rng_t rng = {79};
    uint32_t all = 0;
    for (int round = 0; round < 200; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        view.walls = false;
        view.edge_q4 = view.edge_q4 < 96 ? 96 : view.edge_q4;
        yb_frame_begin(&frame, &map, &view, screen);
        draw(whole, 0, screen->height);
        uint32_t next = 0;
        handed_count = 0;
        yb_frame_triangles(&frame, take_triangle, NULL);
        CHECK(handed_count == frame.stats.drawn, "view %d: %d handed out, %d drawn", round,
              (int)handed_count, (int)frame.stats.drawn);
        (void)plain_leaves(&frame, expect_leaf, &next);
        CHECK(next == handed_count, "view %d: triangle %d is not drawn", round, (int)next);
        all += handed_count;
    }
    assert_true(all > 40000);
}

/* --- Bounds ----------------------------------------------------------------------------------- */

static void leaves_keep_to_their_bound(void **state)
{
    (void)state;
    rng_t rng = {75};
    clock_t slowest = 0;
    for (int round = 0; round < 300; round++) {
        yb_view_t view;
        const yb_screen_t *screen = random_scene(&rng, round, &view);
        view.walls = false;
        view.edge_q4 = (uint16_t)(round % 4 == 0 ? 1 : view.edge_q4);
        view.max_leaves = (uint32_t)rng_range(&rng, 511, 4000);
        clock_t start = clock();
        yb_frame_begin(&frame, &map, &view, screen);
        draw(whole, 0, screen->height);
        clock_t took = clock() - start;
        slowest = took > slowest ? took : slowest;
        CHECK(frame.stats.refined <= view.max_leaves, "view %d: %d leaves, not %d", round,
              (int)frame.stats.refined, (int)view.max_leaves);
        assert_true(frame.stats.drawn <= frame.stats.refined);
        /* The same in bands, and nothing but the ground where the plain drawing has it. */
        for (int y = 0; y < screen->height; y += 8)
            draw(again, y, screen->height - y < 8 ? screen->height - y : 8);
        assert_memory_equal(whole, again, yb_screen_pitch(screen) * screen->height);
        if (view.edge_q4 == 1)
            continue; /* what is out of sight would be refined to the lattice */
        yb_band_t band = {0, screen->height, again, yb_screen_pitch(screen), greys};
        plain_frame(&frame, &band);
        assert_memory_equal(whole, again, yb_screen_pitch(screen) * screen->height);
    }
    print_message("the slowest bounded frame took %.1f ms\n",
                  1000.0 * (double)slowest / CLOCKS_PER_SEC);
}

/* What is not split at all may still be too much: then nothing is. */
static void a_bound_below_the_mesh_leaves_it_as_it_is(void **state)
{
    (void)state;
    const yb_screen_t screen = {128, 64, YB_GREY4};
    yb_view_t view;
    yb_view_init(&view, &map);
    view.max_leaves = 1;
    yb_frame_begin(&frame, &map, &view, &screen);
    draw(whole, 0, screen.height);
    assert_int_equal(frame.longest, UINT32_MAX);
    assert_in_range(frame.stats.refined, 2, map.triangle_count);
}

/* Leaves within four steps of the frame's western side. */
static void count_western(void *context, const yb_point_t *const p[3])
{
    uint32_t *count = context;
    const uint32_t east = YB_REFERENCE_Q8 * 4;
    *count += (p[0]->place & 0xffff) <= east && (p[1]->place & 0xffff) <= east &&
              (p[2]->place & 0xffff) <= east;
}

/* A summit close to a side of the frame: a sliver with three long edges, of which all but its sides
 * is left whole, without any gap.
 */
static void slivers_become_few(void **state)
{
    (void)state;
    rng_t rng = {79};
    uint32_t few = 0;
    uint32_t many = 0;
    for (int round = 0; round < 40; round++) {
        plan_t plan;
        do {
            const plan_point_t summit = {rng_range(&rng, 1, 4), rng_range(&rng, 60, 190)};
            plan_init(&plan, 255, 255);
            assert_true(plan_try(&plan, &summit, 1, rng_range(&rng, 1, 20)));
        } while (!map_fits(&plan));
        load_plan(&plan);
        yb_view_t view;
        yb_view_init(&view, &map);
        yb_view_orbit(&view, &map, (uint16_t)rng_range(&rng, 0, 65535), YB_DEGREES(60), 300);
        view.edge_q4 = 60;
        const yb_screen_t screen = {128, 64, YB_GREY4};
        yb_frame_begin(&frame, &map, &view, &screen);
        draw(whole, 0, screen.height);
        yb_band_t band = {0, screen.height, again, yb_screen_pitch(&screen), greys};
        plain_frame(&frame, &band);
        assert_memory_equal(whole, again, yb_screen_pitch(&screen) * screen.height);
        (void)plain_leaves(&frame, count_western, &few);
        frame.thin_q4 = 0;
        (void)plain_leaves(&frame, count_western, &many);
    }
    print_message("%u leaves, else %u\n", (unsigned)few, (unsigned)many);
    assert_true(2 * few < many);
}

/* Points at multiples of so many steps, which can be halved most often, seen by who stands on them
 * and looks down. plain_frame says if the stack has not room for all that they are split into.
 */
static void near_views_are_bounded(void **state)
{
    (void)state;
    rng_t rng = {76};
    uint32_t most = 0;
    for (int round = 0; round < 60; round++) {
        const int grid = 1 << rng_range(&rng, 3, 6);
        if (round % 6 == 0) {
            plan_t plan;
            do {
                plan_init(&plan, 192, 192);
                plan.gain = 128;
                for (int i = 0; i < 8; i++) {
                    const plan_point_t at = {rng_range(&rng, 1, 191 / grid) * grid,
                                             rng_range(&rng, 1, 191 / grid) * grid};
                    (void)plan_try(&plan, &at, 1, rng_range(&rng, 1, 40));
                }
            } while (!map_fits(&plan));
            load_plan(&plan);
        }
        yb_view_t view;
        yb_view_init(&view, &map);
        const uint16_t x = (uint16_t)rng_range(&rng, 0, map.east_q8);
        const uint16_t y = (uint16_t)rng_range(&rng, 0, map.north_q8);
        const uint16_t azimuth = (uint16_t)rng_range(&rng, 0, 65535);
        const int16_t tilt = (int16_t)-rng_range(&rng, YB_DEGREES(20), YB_DEGREES(90));
        yb_view_walk(&view, &map, x, y, 128, azimuth, tilt);
        view.edge_q4 = (uint16_t)rng_range(&rng, 100, 300);
        const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
        yb_frame_begin(&frame, &map, &view, &screen);
        draw(whole, 0, HEIGHT);
        yb_band_t band = {0, HEIGHT, again, yb_screen_pitch(&screen), greys};
        plain_frame(&frame, &band);
        assert_memory_equal(whole, again, yb_screen_pitch(&screen) * HEIGHT);
        most = frame.stats.refined > most ? frame.stats.refined : most;
    }
    print_message("up to %d leaves at 320x240\n", (int)most);
}

/* All is water: one colour and the sky's, whatever triangles it is drawn of. */
static void water_hides_what_is_under_it(void **state)
{
    (void)state;
    rng_t rng = {78};
    int wet = 0;
    for (int round = 0; round < 60; round++) {
        yb_view_t view;
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        load_plan(&plan);
        map.detail = map.smooth = false; /* nothing rises above the vertices */
        yb_view_init(&view, &map);
        const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
        view.walls = false;
        view.water_q8 = map.high_q8 + 256;
        view.eye_q8[2] = 2 * view.water_q8 + 20000;
        view.azimuth_bam = (uint16_t)rng_range(&rng, 0, 65535);
        yb_view_sun(&view, YB_DEGREES(315), YB_DEGREES(30));
        yb_frame_begin(&frame, &map, &view, &screen);
        draw(whole, 0, HEIGHT);
        int water = -1;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            int pixel = whole[2 * i] << 8 | whole[2 * i + 1];
            if (pixel == colour_sky(&frame, i / WIDTH))
                continue;
            CHECK(water < 0 || pixel == water, "view %d: the water has two colours, %x and %x",
                  round, (unsigned)water, (unsigned)pixel);
            water = pixel;
        }
        wet += water >= 0;
    }
    assert_true(wet > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_bands_give_the_same_picture),
        cmocka_unit_test(bands_hand_on_what_they_know),
        cmocka_unit_test(one_piece_of_memory_is_enough),
        cmocka_unit_test(a_band_leaves_the_rest_alone),
        cmocka_unit_test(culling_changes_no_pixel),
        cmocka_unit_test(what_is_drawn_is_handed_out),
        cmocka_unit_test(leaves_keep_to_their_bound),
        cmocka_unit_test(a_bound_below_the_mesh_leaves_it_as_it_is),
        cmocka_unit_test(slivers_become_few),
        cmocka_unit_test(near_views_are_bounded),
        cmocka_unit_test(water_hides_what_is_under_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
