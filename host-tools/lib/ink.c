#include "ink.h"

#include <math.h>
#include <stdlib.h>

#include <png.h>

#include "border.h"

enum {
    LEVELS = 256,
    BLOCKS_A_SIDE = 24,
    SMALLEST_BLOCK = 16,
    LARGEST_BLOCK = 128,
    TURNS = 8,          /* of the search for a threshold */
    FAINTEST = 217,     /* ink is darker than this in 255ths of the paper */
    DARKEST = 100,      /* and need not be darker than this */
    MOST_THICKNESS = 64 /* runs of ink beyond are no lines */
};

/* The paper is as bright as the brighter pixels of a block: this share of them is darker. */
static const double paper_share = 0.85;
/* A block darker than this part of the whole sheet holds no paper. */
static const double darkest_paper = 0.5;
/* Ink starts so far from the paper to the mean ink: under a half, since pixels at the sides of a
 * thin line hold little ink.
 */
static const double ink_starts = 0.4;
static const double most_ink = 0.4;
static const int darkest_sheet = 64;

/* A picture on its way to ink. */
typedef struct {
    int width, height;
    uint8_t *grey;
    int block, columns, rows;
    uint8_t *paper; /* columns * rows */
} page_t;

static bool read_grey(page_t *page, const char *path, yb_error_t *error)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    const png_color white = {255, 255, 255};
    if (png_image_begin_read_from_file(&image, path) == 0)
        return yb_error_set(error, "cannot read %s: %s", path, image.message);
    image.format = PNG_FORMAT_GRAY;
    bool good = false;
    if (image.width < YB_INK_LEAST_SIDE || image.height < YB_INK_LEAST_SIDE)
        yb_error_set(error, "%s has only %u x %u pixels: at least %d x %d are needed", path,
                     image.width, image.height, YB_INK_LEAST_SIDE, YB_INK_LEAST_SIDE);
    else if (image.width > YB_INK_MOST_PIXELS / image.height)
        yb_error_set(error, "%s has %u x %u pixels, more than %d million: scan it coarser", path,
                     image.width, image.height, YB_INK_MOST_PIXELS / 1000000);
    else if ((page->grey = malloc((size_t)image.width * image.height)) == NULL)
        yb_error_set(error, "%s: out of memory", path);
    else if (png_image_finish_read(&image, &white, page->grey, 0, NULL) == 0)
        yb_error_set(error, "cannot read %s: %s", path, image.message);
    else
        good = true;
    page->width = (int)image.width;
    page->height = (int)image.height;
    png_image_free(&image);
    return good;
}

/* The level below which the given share of a rectangle's pixels lies. */
static uint8_t level_at(const page_t *page, int x, int y, int width, int height, double share)
{
    int32_t count[LEVELS] = {0};
    for (int row = y; row < y + height; row++)
        for (int column = x; column < x + width; column++)
            count[page->grey[(size_t)row * (size_t)page->width + (size_t)column]]++;
    double below = 0;
    int level = 0;
    while (level < LEVELS - 1 && (below += count[level]) < share * width * height)
        level++;
    return (uint8_t)level;
}

static bool measure_paper(page_t *page, const char *path, yb_error_t *error)
{
    int sheet = level_at(page, 0, 0, page->width, page->height, paper_share);
    if (sheet < darkest_sheet) {
        yb_error_set(error, "%s is dark all over: lines must be dark on light paper", path);
        return false;
    }
    int longer = page->width > page->height ? page->width : page->height;
    int block = longer / BLOCKS_A_SIDE;
    block = block < SMALLEST_BLOCK ? SMALLEST_BLOCK : block;
    page->block = block > LARGEST_BLOCK ? LARGEST_BLOCK : block;
    page->columns = 1 + (page->width - 1) / page->block;
    page->rows = 1 + (page->height - 1) / page->block;
    page->paper = calloc((size_t)page->columns + 1, (size_t)page->rows + 1);
    if (page->paper == NULL) {
        yb_error_set(error, "%s: out of memory", path);
        return false;
    }
    double least = darkest_paper * sheet;
    for (int row = 0; row < page->rows; row++)
        for (int column = 0; column < page->columns; column++) {
            int x = column * page->block;
            int y = row * page->block;
            int width = page->width - x < page->block ? page->width - x : page->block;
            int height = page->height - y < page->block ? page->height - y : page->block;
            uint8_t level = level_at(page, x, y, width, height, paper_share);
            page->paper[row * page->columns + column] = (uint8_t)fmax(level, least);
        }
    return true;
}

/* Where a pixel lies between the middles of blocks: the first of two, and the part to the next. */
static int between_blocks(int at, int block, int blocks, float *part)
{
    float place = ((float)at + 0.5F) / (float)block - 0.5F;
    int first = place < 0 ? 0 : (int)place;
    first = first > blocks - 2 ? blocks - 2 : first;
    if (first < 0) {
        *part = 0;
        return 0;
    }
    *part = fminf(fmaxf(place - (float)first, 0), 1);
    return first;
}

/* Replaces each pixel by its brightness in 255ths of the paper there; counts the levels. */
static void divide_by_paper(page_t *page, double count[LEVELS])
{
    for (int y = 0; y < page->height; y++) {
        float down = 0;
        int row = between_blocks(y, page->block, page->rows, &down);
        const uint8_t *upper = page->paper + (size_t)row * (size_t)page->columns;
        const uint8_t *lower = page->rows > 1 ? upper + page->columns : upper;
        uint8_t *grey = page->grey + (size_t)y * (size_t)page->width;
        for (int x = 0; x < page->width; x++) {
            float right = 0;
            int a = between_blocks(x, page->block, page->columns, &right);
            int b = page->columns > 1 ? a + 1 : a;
            float paper = (1 - down) * ((1 - right) * upper[a] + right * upper[b]) +
                          down * ((1 - right) * lower[a] + right * lower[b]);
            grey[x] = (uint8_t)fminf(255, 255 * (float)grey[x] / paper);
            count[grey[x]]++;
        }
    }
}

static double mean_level(const double count[LEVELS], int from, int to)
{
    double sum = 0;
    double pixels = 0;
    for (int level = from; level < to; level++) {
        sum += level * count[level];
        pixels += count[level];
    }
    return pixels > 0 ? sum / pixels : from;
}

/* Ridler's and Calvard's iteration: a threshold between the means of the two sides that it makes.
 */
static int find_threshold(const double count[LEVELS])
{
    int threshold = 204;
    for (int turn = 0; turn < TURNS; turn++) {
        double dark = mean_level(count, 0, threshold);
        double light = mean_level(count, threshold, LEVELS);
        double next = light - ink_starts * (light - dark);
        threshold = (int)fmin(fmax(next, DARKEST), FAINTEST);
    }
    return threshold;
}

static bool page_to_ink(page_t *page, yb_ink_t *ink, const char *path, yb_error_t *error)
{
    double count[LEVELS] = {0};
    if (!measure_paper(page, path, error))
        return false;
    divide_by_paper(page, count);
    int threshold = find_threshold(count);
    double dark = 0;
    for (int level = 0; level < threshold; level++)
        dark += count[level];
    if (dark == 0)
        return yb_error_set(error, "%s is blank: there is no line on it", path);
    if (dark > most_ink * page->width * page->height)
        return yb_error_set(error, "%.0f %% of %s are dark: lines must be dark on light paper",
                            100 * dark / page->width / page->height, path);
    ink->width = page->width;
    ink->height = page->height;
    ink->pixel = calloc((size_t)yb_ink_pitch(ink), (size_t)ink->height + 2);
    if (ink->pixel == NULL)
        return yb_error_set(error, "%s: out of memory", path);
    for (int y = 0; y < page->height; y++)
        for (int x = 0; x < page->width; x++)
            ink->pixel[yb_ink_index(ink, x, y)] =
                page->grey[(size_t)y * (size_t)page->width + (size_t)x] < threshold;
    return true;
}

/* Counts the runs of ink along a row or a column by their length. */
static void count_runs(const uint8_t *pixel, int count, int step, double runs[MOST_THICKNESS])
{
    int run = 0;
    for (int i = 0; i <= count; i++, pixel += step) {
        if (i < count && *pixel != 0) {
            run++;
        } else {
            if (run > 0 && run < MOST_THICKNESS)
                runs[run]++;
            run = 0;
        }
    }
}

/* The middle length of all runs, across and down: lines that run at a slant make it a tenth longer
 * than they are thick.
 */
static double measure_thickness(const yb_ink_t *ink)
{
    double runs[MOST_THICKNESS] = {0};
    for (int y = 0; y < ink->height; y++)
        count_runs(ink->pixel + yb_ink_index(ink, 0, y), ink->width, 1, runs);
    for (int x = 0; x < ink->width; x++)
        count_runs(ink->pixel + yb_ink_index(ink, x, 0), ink->height, yb_ink_pitch(ink), runs);
    double all = 0;
    for (int run = 1; run < MOST_THICKNESS; run++)
        all += runs[run];
    double below = 0;
    int middle = 1;
    while (middle < MOST_THICKNESS - 1 && below + runs[middle] < all / 2)
        below += runs[middle++];
    /* Within the middle length the runs are taken to lie evenly. */
    double part = runs[middle] > 0 ? (all / 2 - below) / runs[middle] : 0.5;
    return fmax(1, (middle - 0.5 + part) / 1.1);
}

/* The pixels of a hole, if it has no more than `most`; -1 if it has, or if it is no hole. */
static int hole_pixels(const yb_ink_t *ink, int32_t from, int32_t *found, int most)
{
    const int pitch = yb_ink_pitch(ink);
    const int32_t step[4] = {-pitch, 1, pitch, -1};
    int count = 1;
    found[0] = from;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            int32_t next = found[i] + step[k];
            bool known = ink->pixel[next] != 0;
            for (int j = 0; j < count && !known; j++)
                known = found[j] == next;
            if (known)
                continue;
            int x = yb_ink_x(ink, next);
            int y = yb_ink_y(ink, next);
            if (count == most || x < 0 || y < 0 || x >= ink->width || y >= ink->height)
                return -1;
            found[count++] = next;
        }
    return count;
}

/* Fills holes that are no larger than what a line covers in half its thickness. */
static void fill_holes(yb_ink_t *ink)
{
    enum {
        MOST = 64
    };
    int32_t found[MOST];
    int most = (int)fmin(fmax(1, ink->thickness * ink->thickness / 2), MOST);
    const int pitch = yb_ink_pitch(ink);
    for (int y = 0; y < ink->height; y++)
        for (int x = 0; x < ink->width; x++) {
            int32_t at = yb_ink_index(ink, x, y);
            if (ink->pixel[at] != 0 || ink->pixel[at - 1] == 0 || ink->pixel[at - pitch] == 0)
                continue;
            int count = hole_pixels(ink, at, found, most);
            for (int i = 0; i < count; i++)
                ink->pixel[found[i]] = 1;
        }
}

bool yb_ink_read(yb_ink_t *ink, const char *path, yb_error_t *error)
{
    page_t page = {0};
    *ink = (yb_ink_t){.thickness = 1};
    bool good = read_grey(&page, path, error) && page_to_ink(&page, ink, path, error);
    free(page.grey);
    free(page.paper);
    if (!good)
        return false;
    ink->thickness = measure_thickness(ink);
    if (!yb_border_cut(ink))
        return yb_error_set(error, "%s: out of memory", path);
    fill_holes(ink);
    return true;
}

void yb_ink_free(yb_ink_t *ink)
{
    free(ink->pixel);
    ink->pixel = NULL;
}
