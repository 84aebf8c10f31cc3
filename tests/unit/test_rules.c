/* The rules: what they add to the triangulation, on many thousand random maps. How many is for
 * YB_TEST_MAPS in the environment to say.
 */
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "mesh.h"
#include "mesh_check.h"
#include "random_plan.h"
#include "rule_check.h"

static yb_map_t map;
static yb_load_t load;

static uint64_t maps_asked_for(uint64_t standard)
{
    const char *count = getenv("YB_TEST_MAPS");
    return count != NULL ? strtoull(count, NULL, 10) : standard;
}

/* Byte by byte, into memory with something in it. */
static yb_status_t feed_bytes(yb_map_t *other, const uint8_t *bytes, size_t count)
{
    static yb_load_t work;
    memset(other, 0xa5, sizeof *other);
    memset(&work, 0x5a, sizeof work);
    yb_map_begin(other, &work);
    for (size_t i = 0; i < count; i++) {
        if (yb_map_feed(other, &work, bytes + i, 1) < 0)
            break;
    }
    return yb_map_end(other, &work);
}

static const char *check_all(const plan_t *plan)
{
    const char *wrong = mesh_check(&map, &load, plan);
    return wrong == NULL ? rule_check(&map, &load, plan) : wrong;
}

static void rules_hold_on_random_maps(void **state)
{
    (void)state;
    uint64_t maps = maps_asked_for(24000);
    int taken = 0;
    int summits = 0;
    int saddles = 0;
    int skeletons = 0;
    int wrongs = 0;
    for (uint64_t seed = 0; seed < maps; seed++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_map(&plan, seed);
        size_t count = plan_write(&plan, bytes);
        yb_status_t status = yb_map_load(&map, &load, bytes, count);
        CHECK(status == YB_OK || status == YB_ERR_LIMIT, "map %d: %s", (int)seed,
              yb_status_text(status));
        static yb_map_t fed;
        CHECK(feed_bytes(&fed, bytes, count) == status, "map %d fed by bytes", (int)seed);
        if (status != YB_OK)
            continue;
        taken++;
        CHECK(map_same(&map, &fed), "map %d: another one when fed by bytes", (int)seed);
        const char *wrong = check_all(&plan);
        if (wrong != NULL && wrongs++ < 20)
            print_error("map %d: %s\n", (int)seed, wrong);
        summits += load.first_saddle - load.first_summit;
        saddles += load.first_skeleton - load.first_saddle;
        skeletons += map.vertex_count - load.first_skeleton;
    }
    print_message("%d of %d maps; %d summits, %d link points, %d points of skeletons\n", taken,
                  (int)maps, summits, saddles, skeletons);
    assert_int_equal(wrongs, 0);
}

/* What the skeletons start from: links fixed, all else Delaunay. */
static void the_rest_is_delaunay_after_links(void **state)
{
    (void)state;
    int taken = 0;
    for (uint64_t seed = 0; seed < 4000; seed++) {
        rng_t rng = {seed};
        plan_t plan;
        random_mountain(&plan, &rng);
        if (map_link(&map, &load, &plan) != YB_OK)
            continue;
        taken++;
        const char *wrong = mesh_check(&map, &load, &plan);
        if (wrong == NULL)
            wrong = mesh_check_delaunay(&map, &load, &plan);
        CHECK(wrong == NULL, "map %d: %s", (int)seed, wrong);
    }
    assert_true(taken > 3000);
}

/* Numbers the triangles and the regions anew and turns each triangle to another first corner: the
 * same mesh, as another way of triangulating might have left it.
 */
static void shuffle(rng_t *rng)
{
    static yb_map_t was;
    static yb_load_t had;
    was = map;
    had = load;
    had.across = was.across;
    had.corners = was.triangle[0];
    static int place[YB_MAX_TRIANGLES];
    static int turned[YB_MAX_TRIANGLES];
    int region[YB_MAX_CONTOURS + 1];
    for (int t = 0; t < (int)map.triangle_count; t++) {
        int k = rng_range(rng, 0, t);
        place[t] = place[k];
        place[k] = t;
        turned[t] = rng_range(rng, 0, 2);
    }
    for (int r = 0; r < load.region_count; r++) {
        int k = rng_range(rng, 0, r);
        region[r] = region[k];
        region[k] = r;
    }
    for (int t = 0; t < (int)map.triangle_count; t++) {
        int to = place[t];
        load.region[to] = (yb_index_t)region[had.region[t]];
        for (int i = 0; i < 3; i++) {
            int from = (i + turned[t]) % 3;
            int across_it = entry_of(&had, 4 * t + from) & NO_TRIANGLE;
            int mark = is_marked(&had, 4 * t + from) ? ENTRY_MARK : 0;
            int across_now = across_it == NO_TRIANGLE ? NO_TRIANGLE : place[across_it];
            map.triangle[to][i] = was.triangle[t][from];
            set_entry(&load, 4 * to + i, across_now | mark);
        }
    }
    for (int v = 0; v < map.vertex_count; v++)
        load.star[v] = (yb_triangle_t)place[had.star[v]];
    for (int c = 0; c < load.all_contours; c++) {
        load.contour[c].left = (yb_index_t)region[had.contour[c].left];
        load.contour[c].right = (yb_index_t)region[had.contour[c].right];
    }
}

/* After each stage: what it makes must follow from the mesh alone, not from how it is written down.
 */
static bool apply_rules(rng_t *rng, bool shuffled, uint64_t hash[3])
{
    bool (*const stage[3])(yb_load_t *) = {summits_add, links_add, skeleton_add};
    for (int k = 0; k < 3; k++) {
        if (shuffled)
            shuffle(rng);
        if (!stage[k](&load))
            return false;
        map.vertex_count = load.vertex_count;
        hash[k] = mesh_hash(&map);
    }
    return true;
}

static void numbers_of_triangles_do_not_matter(void **state)
{
    (void)state;
    int wrongs = 0;
    static const char *const name[3] = {"summits", "links", "skeletons"};
    for (uint64_t seed = 0; seed < 3000; seed++) {
        rng_t rng = {~seed}; /* of the renumbering */
        plan_t plan;
        uint64_t hash[2][3] = {{0}};
        bool good[2];
        random_map(&plan, seed);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(map_triangulate(&map, &load, &plan), YB_OK);
            good[k] = apply_rules(&rng, k == 1, hash[k]);
        }
        CHECK(good[0] == good[1], "map %d", (int)seed);
        for (int k = 0; k < 3; k++) {
            if (hash[0][k] != hash[1][k]) {
                if (wrongs++ < 20)
                    print_error("map %d: other %s\n", (int)seed, name[k]);
                break;
            }
        }
    }
    assert_int_equal(wrongs, 0);
}

/* Lines that may cross, touch and repeat points: refused if they do, else as good a map as any. */
static void messes_are_right_or_refused(void **state)
{
    (void)state;
    int good = 0;
    uint64_t messes = maps_asked_for(24000) * 2;
    for (uint64_t seed = 0; seed < messes; seed++) {
        rng_t rng = {seed};
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_mess(&plan, &rng);
        bool legal = plan_valid(&plan) && plan_codable(&plan, 255);
        yb_status_t status = yb_map_load(&map, &load, bytes, plan_write(&plan, bytes));
        CHECK(status == (legal ? YB_OK : YB_ERR_CORRUPT), "mess %d: %s", (int)seed,
              yb_status_text(status));
        if (!legal)
            continue;
        good++;
        const char *wrong = check_all(&plan);
        CHECK(wrong == NULL, "mess %d: %s", (int)seed, wrong);
    }
    print_message("%d of %d messes are legal\n", good, (int)messes);
    assert_true(good > 0);
}

/* --- By hand ---------------------------------------------------------------------------------- */

typedef struct {
    const char *name;
    yb_status_t status;
    int count[3]; /* of up to three contours, of height 20, 40, 60 */
    plan_point_t point[16];
} bad_t;

static const bad_t bad[] = {
    {"two spots at one place", YB_ERR_CORRUPT, {1, 1}, {{5, 5}, {5, 5}}},
    {"a side of no length", YB_ERR_CORRUPT, {4}, {{5, 5}, {5, 5}, {20, 5}, {5, 20}}},
    {"a line that ends where it began", YB_ERR_CORRUPT, {4}, {{5, 5}, {20, 5}, {5, 20}, {5, 5}}},
    {"a line there and back", YB_ERR_CORRUPT, {3}, {{5, 5}, {15, 5}, {25, 5}}},
    {"an eight", YB_ERR_CORRUPT, {4}, {{5, 5}, {25, 25}, {25, 5}, {5, 25}}},
    {"a line that touches itself",
     YB_ERR_CORRUPT,
     {5},
     {{5, 5}, {25, 5}, {25, 25}, {15, 5}, {5, 25}}},
    {"two that touch at a point",
     YB_ERR_CORRUPT,
     {3, 3},
     {{5, 5}, {15, 5}, {5, 15}, {15, 5}, {25, 5}, {25, 15}}},
    {"a point on another's side",
     YB_ERR_CORRUPT,
     {3, 3},
     {{5, 5}, {25, 5}, {5, 25}, {15, 15}, {30, 15}, {30, 30}}},
    {"a summit on its line", YB_ERR_CORRUPT, {3, 1}, {{5, 5}, {25, 5}, {5, 25}, {15, 5}}},
    {"a common side",
     YB_ERR_CORRUPT,
     {3, 3},
     {{5, 5}, {25, 5}, {5, 25}, {25, 5}, {5, 25}, {25, 25}}},
    {"a closed line at the frame", YB_ERR_CORRUPT, {3}, {{0, 5}, {25, 5}, {5, 25}}},
    {"a closed line in the corner", YB_ERR_CORRUPT, {3}, {{0, 0}, {25, 5}, {5, 25}}},
    {"a summit on the frame", YB_ERR_CORRUPT, {1}, {{0, 9}}},
    {"points in a row",
     YB_OK,
     {9},
     {{5, 5}, {10, 5}, {15, 5}, {20, 5}, {25, 5}, {25, 15}, {25, 25}, {15, 15}, {10, 10}}},
    {"two lines a hair apart", YB_OK, {3, 3}, {{5, 5}, {25, 5}, {5, 25}, {6, 6}, {22, 6}, {6, 22}}},
    {"two summits in a leaf", YB_OK, {3, 1, 1}, {{5, 5}, {29, 5}, {5, 29}, {9, 9}, {9, 16}}},
    {"the smallest triangle", YB_OK, {3}, {{5, 5}, {6, 5}, {5, 6}}},
    {"the smallest triangle round nothing",
     YB_OK,
     {3, 3},
     {{1, 1}, {2, 1}, {1, 2}, {3, 3}, {4, 3}, {3, 4}}},
    {"a thin leaf", YB_OK, {3}, {{1, 1}, {30, 2}, {29, 2}}},
    {"from corner to corner", YB_OK, {3}, {{0, 0}, {16, 17}, {31, 31}}},
    {"both lines in the corners",
     YB_OK,
     {3, 3},
     {{0, 31}, {10, 20}, {0, 0}, {31, 31}, {20, 10}, {31, 0}}},
    {"round a corner", YB_OK, {2, 2}, {{0, 1}, {1, 0}, {30, 31}, {31, 30}}},
};

static void bad_maps_by_hand(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        plan_init(&plan, 31, 31);
        int first = 0;
        for (int k = 0; k < 3 && bad[i].count[k] > 0; k++) {
            assert_true(plan_add(&plan, bad[i].point + first, bad[i].count[k], 20 + 20 * k));
            first += bad[i].count[k];
        }
        yb_status_t status = yb_map_load(&map, &load, bytes, plan_write(&plan, bytes));
        CHECK(status == bad[i].status, "%s: %s", bad[i].name, yb_status_text(status));
        CHECK(plan_valid(&plan) == (status == YB_OK), "%s: what the plan says", bad[i].name);
        const char *wrong = status == YB_OK ? check_all(&plan) : NULL;
        CHECK(wrong == NULL, "%s: %s", bad[i].name, wrong);
    }
}

/* One line of ever more points: a map, until it is too large. */
static void one_line_of_many_points(void **state)
{
    (void)state;
    int taken = 0;
    int refused = 0;
    for (int teeth = 2; teeth <= 124; teeth++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        plan_init(&plan, 255, 255);
        if (!shape_comb(&plan, 1, 100, teeth, 2, 31, 20))
            continue;
        yb_status_t status = yb_map_load(&map, &load, bytes, plan_write(&plan, bytes));
        CHECK(status == YB_OK || status == YB_ERR_LIMIT, "%d teeth: %s", teeth,
              yb_status_text(status));
        taken += status == YB_OK;
        refused += status != YB_OK;
        const char *wrong = status == YB_OK ? check_all(&plan) : NULL;
        CHECK(wrong == NULL, "%d teeth: %s", teeth, wrong);
    }
    print_message("%d combs are maps, %d too large\n", taken, refused);
    assert_true(taken > 20 && refused > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_hold_on_random_maps),
        cmocka_unit_test(the_rest_is_delaunay_after_links),
        cmocka_unit_test(numbers_of_triangles_do_not_matter),
        cmocka_unit_test(messes_are_right_or_refused),
        cmocka_unit_test(bad_maps_by_hand),
        cmocka_unit_test(one_line_of_many_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
