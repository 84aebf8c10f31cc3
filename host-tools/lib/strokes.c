#include "strokes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stroke_ends.h"
#include "thin.h"

enum {
    INK = 1,
    DONE = 2,
    SMOOTHINGS = 8,
    MOST_NAMED = 3 /* places in a sentence */
};

/* A line in the making. */
typedef struct {
    yb_place_t *place;
    int count, room;
} path_t;

void yb_strokes_free(yb_strokes_t *strokes)
{
    for (int i = 0; i < strokes->count; i++)
        free(strokes->stroke[i].place);
    free(strokes->stroke);
    *strokes = (yb_strokes_t){0};
}

static bool path_add(path_t *path, yb_place_t at)
{
    if (path->count == path->room) {
        int room = path->room == 0 ? 64 : 2 * path->room;
        yb_place_t *place = realloc(path->place, (size_t)room * sizeof(*place));
        if (place == NULL)
            return false;
        path->place = place;
        path->room = room;
    }
    path->place[path->count++] = at;
    return true;
}

/* Takes the path's places over. */
static bool strokes_add(yb_strokes_t *strokes, int *room, path_t *path, bool closed)
{
    if (strokes->count == *room) {
        int more = *room == 0 ? 16 : 2 * *room;
        yb_stroke_t *stroke = realloc(strokes->stroke, (size_t)more * sizeof(*stroke));
        if (stroke == NULL)
            return false;
        strokes->stroke = stroke;
        *room = more;
    }
    strokes->stroke[strokes->count++] = (yb_stroke_t){closed, path->count, path->place};
    *path = (path_t){0};
    return true;
}

/* Walks a thinned line from a pixel on, as far as there are pixels not yet walked. */
static bool walk(yb_ink_t *ink, const int32_t step[8], int32_t from, path_t *path)
{
    int32_t at = from;
    while (at >= 0) {
        ink->pixel[at] |= DONE;
        if (!path_add(path, (yb_place_t){yb_ink_x(ink, at) + 0.5, yb_ink_y(ink, at) + 0.5}))
            return false;
        int32_t next = -1;
        for (int i = 0; i < 8 && next < 0; i++)
            if (ink->pixel[at + step[i]] == INK)
                next = at + step[i];
        at = next;
    }
    return true;
}

/* Lines with ends first, then rings. */
static bool trace(yb_strokes_t *pieces, yb_ink_t *ink)
{
    int32_t step[8];
    yb_ink_around(ink, step);
    int32_t all = yb_ink_index(ink, ink->width - 1, ink->height - 1) + 1;
    int room = 0;
    bool good = true;
    for (int ring = 0; ring < 2; ring++)
        for (int32_t i = 0; i < all && good; i++) {
            if (ink->pixel[i] != INK || (ring == 0 && yb_thin_neighbours(ink, step, i) > 1))
                continue;
            path_t path = {0};
            good = walk(ink, step, i, &path) && strokes_add(pieces, &room, &path, ring == 1);
            free(path.place);
        }
    for (int32_t i = 0; i < all; i++)
        ink->pixel[i] &= INK;
    return good;
}

/* Cuts half a thickness off loose ends: thinned, they lean to a corner of what was drawn. */
static void cut_ends(yb_strokes_t *pieces, yb_ink_t *ink)
{
    int most = (int)(ink->thickness / 2);
    for (int i = 0; i < pieces->count; i++) {
        yb_stroke_t *piece = &pieces->stroke[i];
        int cut = most < piece->count / 4 ? most : piece->count / 4;
        if (piece->closed)
            continue;
        for (int k = 0; k < piece->count; k++)
            if (k < cut || k >= piece->count - cut)
                ink->pixel[yb_ink_index(ink, (int)piece->place[k].x_m, (int)piece->place[k].y_m)] =
                    0;
        piece->count -= 2 * cut;
        memmove(piece->place, piece->place + cut, (size_t)piece->count * sizeof(*piece->place));
    }
}

/* Names up to three places where lines are left open. */
static bool say_open(const yb_end_t *end, int ends, const yb_ink_t *ink, const char *path,
                     yb_error_t *error)
{
    char places[128] = "";
    int length = 0;
    int count = 0;
    for (int i = 0; i < ends; i++) {
        if (!end[i].used || end[i].partner != YB_END_LOOSE)
            continue;
        if (count < MOST_NAMED)
            length += snprintf(places + length, sizeof(places) - (size_t)length, "%s(%d, %d)",
                               count == 0 ? "" : ", ", ink->left + (int)end[i].at.x_m,
                               ink->top + (int)end[i].at.y_m);
        count++;
    }
    if (count == 0)
        return true;
    return yb_error_set(error,
                        "lines of %s are left open in the middle of the sheet, at pixel %s%s: "
                        "close them or draw them on to the edge",
                        path, places, count > MOST_NAMED ? " and more" : "");
}

/* Strokes as short as a mark whose ends both lead nowhere are marks. */
static bool take_short(const yb_strokes_t *pieces, yb_end_t *end, const yb_ink_t *ink,
                       yb_blots_t *marks)
{
    for (int i = 0; i < pieces->count; i++) {
        const yb_stroke_t *piece = &pieces->stroke[i];
        if (!end[2 * i].used || end[2 * i].partner != YB_END_LOOSE ||
            end[2 * i + 1].partner != YB_END_LOOSE || piece->count > yb_blots_largest(ink))
            continue;
        end[2 * i].used = false;
        end[2 * i + 1].used = false;
        if (!yb_blots_add(marks, piece->place[piece->count / 2]))
            return false;
    }
    return true;
}

/* Crosses a gap by Hermite's cubic, which leaves and meets the lines as they run. */
static bool bridge(path_t *path, const yb_end_t *from, const yb_end_t *to)
{
    double gap = hypot(to->at.x_m - from->at.x_m, to->at.y_m - from->at.y_m);
    int parts = (int)ceil(gap);
    for (int i = 1; i < parts; i++) {
        double t = (double)i / parts;
        double leave = t * (1 - t) * (1 - t) * gap;
        double meet = t * t * (1 - t) * gap;
        double rest = (1 + 2 * t) * (1 - t) * (1 - t);
        yb_place_t at = {
            rest * from->at.x_m + (1 - rest) * to->at.x_m + leave * from->dx + meet * to->dx,
            rest * from->at.y_m + (1 - rest) * to->at.y_m + leave * from->dy + meet * to->dy};
        if (!path_add(path, at))
            return false;
    }
    return true;
}

/* Follows pieces from end to partner, beginning at an end; they are not used again. */
static bool chain(const yb_strokes_t *pieces, yb_end_t *end, int from, path_t *path, bool *closed)
{
    bool good = end[from].partner != YB_END_EDGE || path_add(path, end[from].edge);
    int at = from;
    while (good) {
        const yb_stroke_t *piece = &pieces->stroke[at / 2];
        for (int i = 0; i < piece->count && good; i++)
            good = path_add(path, piece->place[at % 2 == 0 ? i : piece->count - 1 - i]);
        end[at].used = false;
        at ^= 1;
        end[at].used = false;
        int next = end[at].partner;
        *closed = next >= 0;
        if (next < 0)
            return good && path_add(path, end[at].edge);
        good = good && bridge(path, &end[at], &end[next]);
        if (next == from)
            break;
        at = next;
    }
    return good;
}

/* Chains of pieces from edge to edge first, then those that run in a ring. */
static bool join(yb_strokes_t *strokes, yb_strokes_t *pieces, yb_end_t *end)
{
    int room = 0;
    for (int i = 0; i < pieces->count; i++) {
        yb_stroke_t *piece = &pieces->stroke[i];
        path_t path = {piece->place, piece->count, piece->count};
        if (!piece->closed)
            continue;
        if (!strokes_add(strokes, &room, &path, true))
            return false;
        piece->place = NULL;
    }
    for (int ring = 0; ring < 2; ring++)
        for (int i = 0; i < 2 * pieces->count; i++) {
            if (!end[i].used || (ring == 0 && end[i].partner >= 0))
                continue;
            path_t path = {0};
            bool closed = false;
            bool good =
                chain(pieces, end, i, &path, &closed) && strokes_add(strokes, &room, &path, closed);
            free(path.place);
            if (!good)
                return false;
        }
    return true;
}

/* The staircase of pixels becomes a curve: each place moves halfway to the middle of its two
 * neighbours, some times over. Ends stay.
 */
static void smooth(yb_stroke_t *stroke, int times)
{
    int count = stroke->count;
    yb_place_t *place = stroke->place;
    for (int turn = 0; turn < times && count > 2; turn++) {
        yb_place_t first = place[0];
        yb_place_t before = stroke->closed ? place[count - 1] : place[0];
        for (int i = stroke->closed ? 0 : 1; i < (stroke->closed ? count : count - 1); i++) {
            yb_place_t here = place[i];
            yb_place_t after = i + 1 < count ? place[i + 1] : first;
            place[i].x_m = (before.x_m + 2 * here.x_m + after.x_m) / 4;
            place[i].y_m = (before.y_m + 2 * here.y_m + after.y_m) / 4;
            before = here;
        }
    }
}

bool yb_strokes_follow(yb_strokes_t *strokes, yb_ink_t *ink, yb_blots_t *marks, const char *path,
                       yb_error_t *error)
{
    yb_strokes_t pieces = {0};
    yb_end_t *end = NULL;
    bool many = false;
    *strokes = (yb_strokes_t){0};
    bool good =
        trace(&pieces, ink) && (end = calloc(2 * (size_t)pieces.count + 1, sizeof(*end))) != NULL;
    if (good)
        cut_ends(&pieces, ink);
    good = good && yb_ends_find(end, &pieces, ink, &many) && take_short(&pieces, end, ink, marks);
    if (many)
        yb_error_set(error, "%s holds too many loose ends: dots or hatching, not lines", path);
    else if (!good)
        yb_error_set(error, "%s: out of memory", path);
    good = good && say_open(end, 2 * pieces.count, ink, path, error);
    if (good && !join(strokes, &pieces, end))
        good = yb_error_set(error, "%s: out of memory", path);
    for (int i = 0; i < strokes->count && good; i++)
        smooth(&strokes->stroke[i], SMOOTHINGS + (int)ink->thickness);
    free(end);
    yb_strokes_free(&pieces);
    return good;
}
