/* What the engine makes of codes, as text, for a second decoder to compare.
 *
 *     dump_mesh CODE ...
 *     dump_mesh --lines
 *     dump_mesh --random SEED COUNT
 *
 * A CODE is a file of hexadecimal digits; --lines takes codes from standard input, one a line.
 * --random takes COUNT random codes of the paper profile: legal ones, such as
 * may cross or touch, and damaged ones, some of them with a check that fits. For each code a line
 * "code DIGITS", a line "status WORD" and a line "taken BYTES", the bytes after which it was known;
 * if it is "ok" then "header CELL UNIT BASE SEED" (in 1/64 m, in metres), "vertex X Y Z GX GY" and
 * "triangle A B C" for each, "noise" and the scale of every length class, and some lines
 * "height X Y Z SMOOTH" of the reference surface with and without detail; at last "end".
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "random_plan.h"

enum {
    PLACES = 12,
    MOST_BYTES = 4096
};

static yb_map_t map;
static yb_load_t load;

static void dump_height(uint16_t x_q8, uint16_t y_q8)
{
    map.detail = true;
    int32_t full = yb_map_height(&map, x_q8, y_q8);
    map.detail = false;
    printf("height %d %d %" PRId32 " %" PRId32 "\n", x_q8, y_q8, full,
           yb_map_height(&map, x_q8, y_q8));
}

/* Corners, whole steps, vertices, and places anywhere. */
static void dump_heights(rng_t *rng)
{
    dump_height(0, 0);
    dump_height(map.east_q8, map.north_q8);
    for (int i = 0; i < PLACES; i++) {
        int mask = i % 3 == 0 ? ~255 : ~0;
        const yb_vertex_t *v = &map.vertex[rng_range(rng, 0, map.vertex_count - 1)];
        if (i % 6 == 5)
            dump_height(v->x_q8, v->y_q8);
        else
            dump_height((uint16_t)(rng_range(rng, 0, map.east_q8) & mask),
                        (uint16_t)(rng_range(rng, 0, map.north_q8) & mask));
    }
}

/* Byte by byte; how many were taken until the answer was known. */
static yb_status_t take(const uint8_t *code, size_t count, size_t *taken)
{
    yb_map_begin(&map, &load);
    yb_status_t status = YB_MORE;
    for (*taken = 0; *taken < count && status >= 0; (*taken)++)
        status = yb_map_feed(&map, &load, code + *taken, 1);
    return yb_map_end(&map, &load);
}

static void dump(const uint8_t *code, size_t count, rng_t *rng)
{
    size_t taken;
    yb_status_t status = take(code, count, &taken);
    printf("code ");
    for (size_t i = 0; i < count; i++)
        printf("%02x", code[i]);
    printf("\nstatus %s\ntaken %zu\n", yb_status_text(status), taken);
    if (status == YB_OK)
        printf("header %" PRIu32 " %" PRIu32 " %d %d\n", yb_unit_64th_m(map.cell),
               yb_unit_64th_m(map.unit), map.base_m, map.seed);
    for (int i = 0; status == YB_OK && i < map.vertex_count; i++) {
        const yb_vertex_t *v = &map.vertex[i];
        printf("vertex %d %d %" PRId32 " %d %d\n", v->x_q8, v->y_q8, v->z_q8, v->gx_q11, v->gy_q11);
    }
    for (yb_triangle_t i = 0; status == YB_OK && i < map.triangle_count; i++)
        printf("triangle %d %d %d\n", map.triangle[i][0], map.triangle[i][1], map.triangle[i][2]);
    if (status == YB_OK) {
        printf("noise");
        for (int i = 0; i < YB_LENGTH_CLASSES; i++)
            printf(" %d", map.noise[i]);
        printf("\n");
        dump_heights(rng);
    }
    printf("end\n");
}

/* Flips a bit, drops the end, or both; mends the check or not. */
static size_t damage(uint8_t *code, size_t count, rng_t *rng)
{
    if (!rng_one_in(rng, 3))
        code[rng_range(rng, 0, (int)count - 1)] ^= (uint8_t)(1 << rng_range(rng, 0, 7));
    if (rng_one_in(rng, 3))
        count = (size_t)rng_range(rng, 1, (int)count);
    if (rng_one_in(rng, 10))
        code[count++] = 0;
    if (!rng_one_in(rng, 4))
        plan_mend(code, count);
    return count;
}

static void dump_random(uint64_t seed)
{
    rng_t rng = {seed};
    plan_t plan;
    uint8_t code[PLAN_MAX_BYTES];
    if (seed % 8 == 0)
        random_mess(&plan, &rng);
    else if (seed % 8 < 3)
        random_plan(&plan, &rng);
    else
        random_mountain(&plan, &rng);
    if (seed % 16 == 15)
        plan.vertices = plan_vertices(&plan) + rng_range(&rng, -2, 10);
    plan.vertices = plan.vertices > 255 ? 255 : plan.vertices;
    size_t count = plan_write(&plan, code);
    if (seed % 8 == 7)
        count = damage(code, count, &rng);
    dump(code, count, &rng);
}

static int dump_file(const char *path)
{
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        return 1;
    }
    uint8_t code[MOST_BYTES];
    size_t count = 0;
    unsigned byte;
    while (count < sizeof code && fscanf(file, "%2x", &byte) == 1)
        code[count++] = (uint8_t)byte;
    (void)fclose(file);
    rng_t rng = {count};
    dump(code, count, &rng);
    return 0;
}

static int dump_lines(void)
{
    static char line[2 * MOST_BYTES + 2];
    while (fgets(line, sizeof line, stdin) != NULL) {
        uint8_t code[MOST_BYTES];
        size_t count = 0;
        unsigned byte;
        while (sscanf(line + 2 * count, "%2x", &byte) == 1)
            code[count++] = (uint8_t)byte;
        rng_t rng = {count};
        dump(code, count, &rng);
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "--random") == 0) {
        uint64_t seed = strtoull(argv[2], NULL, 10);
        uint64_t count = strtoull(argv[3], NULL, 10);
        for (uint64_t i = 0; i < count; i++)
            dump_random(seed + i);
        return 0;
    }
    if (argc == 2 && strcmp(argv[1], "--lines") == 0)
        return dump_lines();
    if (argc < 2 || argv[1][0] == '-') {
        (void)fprintf(stderr, "usage: dump_mesh CODE ... | --lines | --random SEED COUNT\n");
        return 2;
    }
    for (int i = 1; i < argc; i++) {
        if (dump_file(argv[i]) != 0)
            return 1;
    }
    return 0;
}
