/* The verbs encode and info as their users meet them: what they say, how they end, and that a
 * failure leaves no file behind. The program is the first argument.
 */
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <sys/wait.h>

#include <gdal.h>
#include <jansson.h>

#include "ground.h"

static const char *program;
static char said[65536]; /* by the last run, both streams */

/* Runs the program in a shell; answers its exit code. */
static int run(const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof(command), "'%s' %s 2>&1", program, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t size = fread(said, 1, sizeof(said) - 1, pipe);
    said[size] = '\0';
    int status = pclose(pipe);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* Runs encode on an input with some options, writing to "out.yb". */
static int encode(const char *input, const char *more)
{
    char arguments[2048];
    snprintf(arguments, sizeof(arguments), "encode %s -o %s --effort 1 %s", input,
             scratch_path("out.yb"), more);
    return run(arguments);
}

static void expect_failure(const char *input, const char *more, int code, const char *sentence)
{
    int files = scratch_files();
    int answer = encode(input, more);
    if (answer != code || strstr(said, sentence) == NULL)
        fail_msg("encode %s %s: exit code %d and \"%s\"; expected %d and \"%s\"", input, more,
                 answer, said, code, sentence);
    assert_int_equal(scratch_files(), files);
    assert_false(scratch_exists(scratch_path("out.yb")));
}

static void test_bad_usage(void **state)
{
    (void)state;
    const char *dem = scratch_path("range.tif");
    assert_int_equal(run("encode"), 2);
    assert_non_null(strstr(said, "name the relief"));
    assert_int_equal(run("encode x.tif"), 2);
    assert_non_null(strstr(said, "-o MAP.yb"));
    expect_failure(dem, "--nonsense", 2, "unknown option '--nonsense'");
    expect_failure(dem, "--bytes", 2, "needs a value");
    expect_failure(dem, "--bytes 22", 2, "the least is 23");
    expect_failure(dem, "--bytes 1300", 2, "from 23 to 1299");
    expect_failure(dem, "--bytes many", 2, "from 23 to 1299");
    expect_failure(dem, "--profile plain", 2, "no profile 'plain'");
    expect_failure(dem, "--levels 0", 2, "from 1 to 64");
    expect_failure(dem, "--interval -5", 2, "above 0");
    expect_failure(dem, "--levels 3 --interval 100", 2, "exclude each other");
    expect_failure(dem, "--effort 10", 2, "from 1 to 9");
    expect_failure(dem, "--seed 256", 2, "from 0 to 127");
    expect_failure(dem, "--target-k 1.5", 2, "above 0, at most 1");
    expect_failure(dem, "--target-k alike", 2, "above 0, at most 1");
    expect_failure(dem, "--window 1 2 3", 2, "four numbers");
    expect_failure(dem, "--window 5 0 1 1", 2, "is empty");
    expect_failure(dem, "--center 200 0", 2, "longitude");
    expect_failure(dem, "--km 5", 2, "--km needs --center");
    expect_failure(dem, "--center 9 46 --window 0 0 1 1", 2, "exclude each other");
    expect_failure(dem, "another.tif", 2, "more than one input");
    expect_failure(dem, "--name ''", 2, "the name is empty");
    expect_failure(dem, "--name \"$(printf '%064d' 0)\"", 2, "64 bytes: at most 63");
    expect_failure(dem, "--name \"$(printf 'caf\\351')\"", 2, "no UTF-8 text");
    expect_failure(dem, "--name \"$(printf 'a\\tb')\"", 2, "without control characters");
    const char *const sections[] = {"--name x", "--place", "--certify"};
    for (int i = 0; i < 3; i++) {
        char both[64];
        snprintf(both, sizeof(both), "--profile paper %s", sections[i]);
        expect_failure(dem, both, 2, "are for --profile compact");
    }
}

static void test_bad_inputs(void **state)
{
    (void)state;
    const char *text = scratch_path("text.txt");
    scratch_text(text, "nothing here\n");
    expect_failure(scratch_path("none.tif"), "", 1, "No such file");
    expect_failure(text, "", 1, "no raster that GDAL can read");
    const char *flat = scratch_path("flat.tif");
    scratch_raster(flat, 32, 32, relief_flat);
    expect_failure(flat, "", 1, "is flat: all heights of the window are 5 m");
    const char *dem = scratch_path("range.tif");
    expect_failure(dem, "--window 0 0 10 10", 1, "reaches out of");
    expect_failure(dem, "--center 120 10", 1, "does not lie on");
    expect_failure(dem, "--interval 90000", 1, "choose a smaller interval");
    expect_failure(dem, "--field height", 1, "no raster and no vector");
    dem = scratch_path("range.tif"); /* scratch_path turns round */
    expect_failure(dem, "--bytes 30 --certify --place --name Monte", 1, "the least is 39");
    const char *bare = scratch_path("bare.png");
    scratch_raster_bare(bare, 40, 40, relief_range);
    expect_failure(bare, "-q --place", 1, "--place needs an input with a projection");
    expect_failure(bare, "-q --center 9 46", 1, "where on earth");
    const char *lines = scratch_path("names.geojson");
    scratch_text(lines, "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\","
                        "\"properties\":{\"name\":\"a\"},\"geometry\":{\"type\":\"LineString\","
                        "\"coordinates\":[[0,0],[1,1],[2,0],[0,0]]}}]}");
    expect_failure(lines, "", 1, "--field");
    expect_failure(lines, "--field height", 1, "no attribute 'height'");
}

static void contour_file(const char *path, const char *features)
{
    char text[2048];
    snprintf(text, sizeof(text), "{\"type\":\"FeatureCollection\",\"features\":[%s]}", features);
    scratch_text(path, text);
}

#define LINE(height, coordinates)                                                                  \
    "{\"type\":\"Feature\",\"properties\":{\"ele\":" height "},\"geometry\":{\"type\":"            \
    "\"LineString\",\"coordinates\":" coordinates "}}"

static void test_bad_lines(void **state)
{
    (void)state;
    char path[512];
    snprintf(path, sizeof(path), "%s", scratch_path("bad.geojson"));
    contour_file(path, LINE("100", "[[9,46],[9.1,46.1]]") "," LINE("120", "[[9,46.1],[9.1,46]]"));
    expect_failure(path, "", 1, "cross: 100 m and 120 m at 9.0");
    contour_file(path, LINE("\"100\"", "[[9,46],[9.1,46]]") "," LINE("\"1.200,5\"",
                                                                     "[[9,46.1],[9.1,46.1]]"));
    expect_failure(path, "", 1, "the height of feature 1 of");
    expect_failure(path, "", 1, "is the text '1.200,5' (attribute ele)");
    contour_file(path, LINE("100", "[[9,46],[9.1,46.1]]"));
    expect_failure(path, "--window 20 20 21 21", 1, "outside the lines");
    contour_file(path, LINE("100", "[[9,46],[9.1,46]]") "," LINE("120", "[[9,46.1],[9.1,46.1]]"));
    expect_failure(path, "--bytes 30 --name 'Piz Nair'", 1, "the least is 32");
}

/* The name, the place and the certificate that a code has, and the raster that lies there. */
static void test_sections(void **state)
{
    (void)state;
    char arguments[1024];
    const char *name = "Mont \xc3\x89mile";
    char more[128];
    snprintf(more, sizeof(more), "--bytes 80 --certify --place --name '%s'", name);
    assert_int_equal(encode(scratch_path("range.tif"), more), 0);
    assert_non_null(strstr(said, "certified: nine tenths of the heights within "));
    snprintf(arguments, sizeof(arguments), "info %s --json", scratch_path("out.yb"));
    assert_int_equal(run(arguments), 0);
    json_t *info = json_loads(said, 0, NULL);
    assert_non_null(info);
    assert_true(json_integer_value(json_object_get(info, "bytes")) <= 80);
    assert_string_equal(json_string_value(json_object_get(info, "name")), name);
    assert_int_equal(json_array_size(json_object_get(info, "sections")), 3);
    const json_t *place = json_object_get(info, "place");
    double lon = json_number_value(json_object_get(place, "lon"));
    double lat = json_number_value(json_object_get(place, "lat"));
    double east = lon;
    double north = lat;
    OGRSpatialReferenceH degrees = yb_ground_lon_lat();
    OGRSpatialReferenceH utm = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(utm, 32632), OGRERR_NONE);
    assert_true(yb_ground_transform(degrees, utm, &east, &north));
    assert_true(fabs(east - 500960) < 2 && fabs(north - 5000960) < 2);
    OSRDestroySpatialReference(utm);
    const json_t *certificate = json_object_get(info, "certificate");
    double p90_m = json_number_value(json_object_get(certificate, "p90_m"));
    double k = json_number_value(json_object_get(certificate, "k"));
    snprintf(arguments, sizeof(arguments), "evaluate %s %s --json", scratch_path("out.yb"),
             scratch_path("range.tif"));
    assert_int_equal(run(arguments), 0);
    json_t *found = json_loads(said, 0, NULL);
    assert_non_null(found);
    double found_m = json_number_value(json_object_get(json_object_get(found, "detail"), "p90_m"));
    double found_k = json_number_value(json_object_get(found, "k"));
    assert_true(found_m > 0 && found_m <= p90_m && p90_m < 1.06 * found_m);
    assert_true(k <= found_k && found_k < k + 0.005);
    json_decref(found);
    json_decref(info);
    /* Another relief: the certificate is not true of that. */
    scratch_raster(scratch_path("other.tif"), 64, 64, relief_cone);
    snprintf(arguments, sizeof(arguments), "evaluate %s %s", scratch_path("out.yb"),
             scratch_path("other.tif"));
    assert_int_equal(run(arguments), 0);
    assert_non_null(strstr(said, "its certificate promises more"));
    snprintf(arguments, sizeof(arguments), "dem %s -o %s", scratch_path("out.yb"),
             scratch_path("placed.tif"));
    assert_int_equal(run(arguments), 0);
    GDALDatasetH dem = GDALOpen(scratch_path("placed.tif"), GA_ReadOnly);
    assert_non_null(dem);
    double transform[6];
    assert_int_equal(GDALGetGeoTransform(dem, transform), CE_None);
    east = transform[0] + transform[1] * GDALGetRasterXSize(dem) / 2;
    north = transform[3] + transform[5] * GDALGetRasterYSize(dem) / 2;
    assert_true(fabs(east) < 0.01 && fabs(north) < 0.01);
    assert_true(yb_ground_transform(GDALGetSpatialRef(dem), degrees, &east, &north));
    assert_true(fabs(east - lon) < 1e-5 && fabs(north - lat) < 1e-5);
    GDALClose(dem);
    OSRDestroySpatialReference(degrees);
    remove(scratch_path("placed.tif"));
    remove(scratch_path("out.yb"));
}

static void test_drawn_sheets(void **state)
{
    (void)state;
    char sheet[512]; /* scratch_path turns round */
    snprintf(sheet, sizeof(sheet), "%s", scratch_path("rings.png"));
    scratch_sheet(sheet, 4);
    const char *both = "--base 100 --interval 20";
    expect_failure(sheet, "", 2, "--base METRES");
    expect_failure(sheet, "--base 100", 2, "--interval METRES");
    expect_failure(sheet, "--interval 20", 2, "--base METRES");
    expect_failure(sheet, "--base high --interval 20", 2, "--base needs a number");
    expect_failure(sheet, "--base 100 --interval 20 --window 0 0 9 9", 2, "is read whole");
    expect_failure(sheet, "--base 100 --interval 20 -q --place", 1, "--place needs an input");
    expect_failure(scratch_path("range.tif"), "--base 100", 2, "--base is for drawn sheets");
    expect_failure(scratch_path("none.png"), both, 1, "No such file");
    const char *blank = scratch_path("blank.png");
    scratch_sheet(blank, 0);
    expect_failure(blank, both, 1, "is blank");
    assert_int_equal(encode(sheet, both), 0);
    assert_non_null(strstr(said, "size of its pixels: 30 m are assumed (--cell)"));
    assert_int_equal(encode(sheet, "--base 100 --interval 20 --cell 2 --force --json"), 0);
    json_t *made = json_loads(said, 0, NULL);
    assert_non_null(made);
    const json_t *heights = json_object_get(made, "line_heights_m");
    assert_true(json_array_size(heights) > 0);
    size_t i = 0;
    json_t *height = NULL;
    json_array_foreach(heights, i, height)
    {
        double step = (json_number_value(height) - 100) / 20;
        assert_true(step > -0.05 && step < 3.05);
    }
    json_decref(made);
    remove(scratch_path("out.yb"));
}

static void test_output_is_kept(void **state)
{
    (void)state;
    const char *dem = scratch_path("range.tif");
    const char *out = scratch_path("out.yb");
    scratch_text(out, "precious");
    assert_int_equal(encode(dem, ""), 1);
    assert_non_null(strstr(said, "exists already; --force overwrites it"));
    assert_int_equal(encode(dem, "--force -q"), 0);
    assert_string_equal(said, "");
    remove(out);
    char arguments[1024];
    snprintf(arguments, sizeof(arguments), "encode %s -o %s", dem, scratch_path("no/where.yb"));
    assert_int_equal(run(arguments), 1);
    assert_non_null(strstr(said, "no such directory"));
}

static long long number(const json_t *root, const char *key)
{
    const json_t *value = json_object_get(root, key);
    assert_true(json_is_integer(value));
    return json_integer_value(value);
}

static void test_info_adds_up(void **state)
{
    (void)state;
    char arguments[1024];
    assert_int_equal(encode(scratch_path("range.tif"), "--bytes 90 --json"), 0);
    json_t *made = json_loads(said, 0, NULL);
    assert_non_null(made);
    snprintf(arguments, sizeof(arguments), "info %s --json", scratch_path("out.yb"));
    assert_int_equal(run(arguments), 0);
    json_t *info = json_loads(said, 0, NULL);
    assert_non_null(info);
    assert_int_equal(number(info, "bytes"), number(made, "bytes"));
    assert_int_equal(number(info, "f_bits"), number(made, "f_bits"));
    assert_true(number(info, "bytes") <= 90);
    double bits = 0;
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach(json_object_get(info, "bits"), key, value) bits += json_number_value(value);
    assert_true(fabs(bits - 8.0 * (double)number(info, "bytes")) < 1e-4);
    assert_int_equal(json_array_size(json_object_get(info, "contours")), number(info, "m"));
    const json_t *fractal = json_object_get(made, "fractal");
    const double dimension = json_number_value(json_object_get(fractal, "dimension"));
    assert_true(dimension == json_number_value(json_object_get(made, "dimension")));
    assert_true(fabs(dimension - json_number_value(json_object_get(info, "dimension"))) < 0.017);
    assert_true(fabs(2 - dimension - json_number_value(json_object_get(info, "hurst"))) < 0.017);
    assert_true(json_number_value(json_object_get(fractal, "r2")) > 0.9);
    assert_int_equal(json_array_size(json_object_get(fractal, "levels")), 9);
    const json_t *line = json_array_get(json_object_get(fractal, "contours"), 0);
    assert_true(json_is_boolean(json_object_get(line, "closed")));
    assert_true(json_number_value(json_object_get(line, "length_m")) > 1000);
    json_decref(made);
    json_decref(info);
    snprintf(arguments, sizeof(arguments), "info - < %s", scratch_path("out.yb"));
    assert_int_equal(run(arguments), 0);
    assert_non_null(strstr(said, "the standard input"));
    assert_non_null(strstr(said, "region 0"));
    remove(scratch_path("out.yb"));
}

static void test_pipes(void **state)
{
    (void)state;
    char arguments[1024];
    snprintf(arguments, sizeof(arguments), "encode %s --effort 1 -q -o - | '%s' info -",
             scratch_path("range.tif"), program);
    assert_int_equal(run(arguments), 0);
    assert_non_null(strstr(said, "profile compact"));
    assert_int_equal(run("info /dev/null"), 1);
    assert_non_null(strstr(said, "is empty"));
    assert_int_equal(run("info"), 2);
    assert_int_equal(run("encode --help"), 0);
    assert_non_null(strstr(said, "Usage: yamabiko encode"));
    assert_int_equal(run("info --help"), 0);
}

static int begin(void **state)
{
    int status = scratch_begin(state);
    if (status == 0)
        scratch_raster(scratch_path("range.tif"), 64, 64, relief_range);
    return status;
}

/* A similarity as the target: told if it is reached, else nothing is written. */
static void test_target_k(void **state)
{
    (void)state;
    const char *dem = scratch_path("small.tif");
    scratch_raster(dem, 32, 32, relief_range);
    expect_failure(dem, "--target-k 0.99 --bytes 30", 1, "--bytes");
    assert_int_equal(encode(dem, "--target-k 0.7 --json"), 0);
    json_t *made = json_loads(said, 0, NULL);
    assert_non_null(made);
    double k = json_number_value(json_object_get(made, "k"));
    assert_true(k >= 0.7);
    assert_true(json_integer_value(json_object_get(made, "bytes")) <= 100);
    json_decref(made);
    char arguments[1024];
    snprintf(arguments, sizeof(arguments), "evaluate %s %s --json", scratch_path("out.yb"), dem);
    assert_int_equal(run(arguments), 0);
    made = json_loads(said, 0, NULL);
    assert_non_null(made);
    assert_true(fabs(json_number_value(json_object_get(made, "k")) - k) < 1e-5);
    json_decref(made);
    assert_int_equal(encode(dem, "--force --target-k 0.5 --bytes 80 --name Monte --place --certify "
                                 "--vertices 64"),
                     0);
    assert_non_null(strstr(said, "K 0."));
    assert_non_null(strstr(said, "certified: nine tenths of the heights within "));
    remove(scratch_path("out.yb"));
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    program = argv[1];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_usage),      cmocka_unit_test(test_bad_inputs),
        cmocka_unit_test(test_output_is_kept), cmocka_unit_test(test_info_adds_up),
        cmocka_unit_test(test_target_k),       cmocka_unit_test(test_bad_lines),
        cmocka_unit_test(test_sections),       cmocka_unit_test(test_pipes),
        cmocka_unit_test(test_drawn_sheets),
    };
    return cmocka_run_group_tests(tests, begin, scratch_end);
}
