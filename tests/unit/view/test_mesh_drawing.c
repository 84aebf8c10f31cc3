/* A map's mesh drawn in plan: what is on the page, and that it is whole. */
#include "codes.h"
#include "label_room.h"
#include "mesh_drawing.h"

#include <cpl_minixml.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char room[] = "/tmp/yb-mesh-drawing-XXXXXX";

static const char *path_of(const char *name)
{
    static char path[sizeof(room) + 32];
    snprintf(path, sizeof(path), "%s/%s", room, name);
    return path;
}

static yb_mesh_drawing_t request_of(yb_stage_t stage)
{
    return (yb_mesh_drawing_t){.stage = stage, .width = 1000, .name = "a <map> & more"};
}

/* The bytes of the drawing; the file is gone again. */
static char *drawn(const char *name, const yb_code_file_t *file, const yb_mesh_drawing_t *request,
                   size_t *size)
{
    yb_error_t error = {""};
    const char *path = path_of(name);
    if (!yb_mesh_drawing_write(path, false, &file->map, &file->load, request, &error))
        fail_msg("%s", error.text);
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    assert_int_equal(fseek(stream, 0, SEEK_END), 0);
    *size = (size_t)ftell(stream);
    rewind(stream);
    char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, stream), *size);
    bytes[*size] = '\0';
    fclose(stream);
    remove(path);
    return bytes;
}

static char *svg_of(const yb_code_file_t *file, yb_stage_t stage)
{
    const yb_mesh_drawing_t request = request_of(stage);
    size_t size = 0;
    return drawn("map.svg", file, &request, &size);
}

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part))
        count++;
    return count;
}

/* How many lines the paths of a class have together. */
static int lines_of(const char *svg, const char *name)
{
    char head[64];
    int lines = 0;
    snprintf(head, sizeof(head), "<path class=\"%s\"", name);
    for (const char *at = strstr(svg, head); at != NULL; at = strstr(at + 1, head)) {
        const char *data = strstr(at, " d=\"") + 4;
        for (const char *end = strchr(data, '"'); data < end; data++)
            lines += *data == 'M';
    }
    return lines;
}

static int contour_edges(const yb_code_file_t *file)
{
    int edges = 0;
    for (uint16_t i = 0; i < file->load.contour_count; i++) {
        const yb_contour_t *contour = &file->load.contour[i];
        if (contour->count > 1)
            edges += contour->count - (yb_contour_is_open(&file->map, contour) ? 1 : 0);
    }
    return edges;
}

static void check_triangles(yb_code_file_t *file)
{
    static const char *const rules[] = {"none", "summit", "saddle", "slope", "skeleton"};
    char *svg = svg_of(file, YB_STAGE_TRIANGLES);
    const int vertices = file->map.vertex_count, triangles = (int)file->map.triangle_count;
    assert_int_equal(lines_of(svg, "triangle") + lines_of(svg, "flat"), triangles);
    int edges = contour_edges(file);
    for (size_t i = 0; i < sizeof(rules) / sizeof(rules[0]); i++)
        edges += lines_of(svg, rules[i]);
    assert_int_equal(edges, vertices + triangles - 1); /* Euler */
    assert_int_equal(lines_of(svg, "summit points") + lines_of(svg, "saddle points") +
                         lines_of(svg, "skeleton points"),
                     vertices - file->load.first_summit);
    free(svg);
    yb_code_file_free(file);
}

static void triangles_and_edges_are_all_there(void **state)
{
    (void)state;
    check_triangles(code_hill());
    check_triangles(code_eastern_hill());
    check_triangles(code_slope());
}

static void links_are_what_the_rules_made(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    char *svg = svg_of(file, YB_STAGE_LINKS);
    int summit = 0;
    for (yb_triangle_t t = 0; t < file->map.triangle_count; t++)
        for (int edge = 0; edge < 3; edge++)
            summit += yb_edge_rule(&file->map, &file->load, t, edge) == YB_RULE_SUMMIT;
    assert_int_equal(2 * lines_of(svg, "summit"), summit);
    assert_int_equal(lines_of(svg, "none"), 0);
    assert_int_equal(lines_of(svg, "triangle"), 0);
    assert_int_equal(lines_of(svg, "contour"), 2);
    assert_int_equal(lines_of(svg, "spot"), 1);
    free(svg);
    yb_code_file_free(file);
}

static void contours_have_heights_and_a_lower_side(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    char *svg = svg_of(file, YB_STAGE_CONTOURS);
    assert_int_equal(count_of(svg, ">200</text>"), 1);
    assert_int_equal(count_of(svg, ">700</text>"), 1);
    assert_int_equal(count_of(svg, ">1100</text>"), 1);
    free(svg);
    yb_code_file_free(file);

    file = code_slope(); /* low in the south: all ticks go down the page */
    svg = svg_of(file, YB_STAGE_CONTOURS);
    const char *at = strstr(svg, "class=\"lower\"");
    assert_non_null(at);
    int ticks = 0;
    const char *end = strstr(at, "/>");
    for (at = strchr(at, 'M'); at != NULL && at < end; at = strchr(at + 1, 'M'), ticks++) {
        double x, y, to_x, to_y;
        assert_int_equal(sscanf(at, "M%lf %lf %lf %lf", &x, &y, &to_x, &to_y), 4);
        assert_true(to_y > y);
    }
    assert_true(ticks > 20);
    free(svg);
    yb_code_file_free(file);
}

static void svg_is_xml_and_says_what_it_shows(void **state)
{
    (void)state;
    yb_code_file_t *file = code_rough_hill();
    for (int stage = 0; stage <= YB_STAGE_TRIANGLES; stage++) {
        char *svg = svg_of(file, (yb_stage_t)stage);
        CPLXMLNode *tree = CPLParseXMLString(svg);
        assert_non_null(tree);
        const CPLXMLNode *root = CPLGetXMLNode(tree, "=svg");
        assert_non_null(root);
        assert_string_equal(CPLGetXMLValue(root, "width", ""), "1000");
        char title[128];
        snprintf(title, sizeof(title),
                 "a <map> & more: %d vertices, %d of them added, %d triangles",
                 (int)file->map.vertex_count, file->map.vertex_count - file->load.first_summit,
                 (int)file->map.triangle_count);
        assert_string_equal(CPLGetXMLValue(root, "title", ""), title);
        CPLDestroyXMLNode(tree);
        free(svg);
    }
    yb_code_file_free(file);
}

static void any_name_makes_valid_xml(void **state)
{
    (void)state;
    static const char *const names[][2] = {{"\xe5\xb1\xb1\xe5\xbd\xa6", "\xe5\xb1\xb1\xe5\xbd\xa6"},
                                           {"half \xe5\xb1", "half ??"},
                                           {"\x80\xff\x01 bell \x07", "??? bell ?"}};
    yb_code_file_t *file = code_slope();
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        yb_mesh_drawing_t request = request_of(YB_STAGE_CONTOURS);
        request.name = names[i][0];
        size_t size = 0;
        char *svg = drawn("map.svg", file, &request, &size);
        CPLXMLNode *tree = CPLParseXMLString(svg);
        assert_non_null(tree);
        const char *title = CPLGetXMLValue(CPLGetXMLNode(tree, "=svg"), "title", "");
        assert_memory_equal(title, names[i][1], strlen(names[i][1]));
        assert_int_equal(title[strlen(names[i][1])], ':');
        CPLDestroyXMLNode(tree);
        free(svg);
        free(drawn("map.png", file, &request, &size));
    }
    yb_code_file_free(file);
}

static void the_same_map_gives_the_same_bytes(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    static const char *const names[] = {"map.svg", "map.png"};
    for (int i = 0; i < 2; i++) {
        const yb_mesh_drawing_t request = request_of(YB_STAGE_TRIANGLES);
        size_t size = 0, again_size = 0;
        char *first = drawn(names[i], file, &request, &size);
        char *again = drawn(names[i], file, &request, &again_size);
        assert_int_equal(size, again_size);
        assert_memory_equal(first, again, size);
        free(first);
        free(again);
    }
    yb_code_file_free(file);
}

static void plain_is_the_plan_alone(void **state)
{
    (void)state;
    yb_code_file_t *file = code_slope(); /* 100 by 60 steps */
    yb_mesh_drawing_t request = request_of(YB_STAGE_TRIANGLES);
    request.plain = true;
    request.width = 104;
    size_t size = 0;
    char *bytes = drawn("map.png", file, &request, &size);
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&image, bytes, size));
    assert_int_equal(image.width, 104);
    assert_int_equal(image.height, 64);
    png_image_free(&image);
    free(bytes);
    bytes = drawn("map.svg", file, &request, &size);
    assert_int_equal(count_of(bytes, "class=\"key\""), 0);
    free(bytes);
    yb_code_file_free(file);
}

static void files_are_not_overwritten(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    const yb_mesh_drawing_t request = request_of(YB_STAGE_LINKS);
    yb_error_t error = {""};
    const char *path = path_of("kept.svg");
    assert_true(yb_mesh_drawing_write(path, false, &file->map, &file->load, &request, &error));
    assert_false(yb_mesh_drawing_write(path, false, &file->map, &file->load, &request, &error));
    assert_non_null(strstr(error.text, "--force"));
    assert_true(yb_mesh_drawing_write(path, true, &file->map, &file->load, &request, &error));
    remove(path);
    yb_code_file_free(file);
}

static void labels_find_room_once(void **state)
{
    (void)state;
    yb_label_room_t page;
    assert_true(yb_label_room_init(&page, 100, 60));
    assert_true(yb_label_room_take(&page, 50, 30, 30, 12));
    assert_false(yb_label_room_take(&page, 60, 30, 30, 12));
    assert_true(yb_label_room_take(&page, 50, 50, 30, 12));
    assert_false(yb_label_room_take(&page, 5, 10, 30, 12)); /* it would leave the page */
    yb_label_room_block(&page, -20, -20, 300, 300);
    assert_false(yb_label_room_take(&page, 85, 10, 6, 6));
    yb_label_room_free(&page);
}

static int make_room(void **state)
{
    (void)state;
    return mkdtemp(room) == NULL;
}

static int clear_room(void **state)
{
    (void)state;
    return rmdir(room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_and_edges_are_all_there),
        cmocka_unit_test(links_are_what_the_rules_made),
        cmocka_unit_test(contours_have_heights_and_a_lower_side),
        cmocka_unit_test(svg_is_xml_and_says_what_it_shows),
        cmocka_unit_test(any_name_makes_valid_xml),
        cmocka_unit_test(the_same_map_gives_the_same_bytes),
        cmocka_unit_test(plain_is_the_plan_alone),
        cmocka_unit_test(files_are_not_overwritten),
        cmocka_unit_test(labels_find_room_once),
    };
    return cmocka_run_group_tests(tests, make_room, clear_room);
}
