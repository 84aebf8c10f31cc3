#include "line_join.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* End 2 i is the beginning of piece i, end 2 i + 1 its end. */
typedef struct {
    yb_place_t at;
    double angle; /* of the way into the piece */
    int end;
} end_t;

static const double half_turn = 3.14159265358979323846;

static bool same_place(yb_place_t a, yb_place_t b)
{
    return a.x_m == b.x_m && a.y_m == b.y_m;
}

static int by_place(const void *a, const void *b)
{
    const end_t *first = a;
    const end_t *second = b;
    if (first->at.x_m != second->at.x_m)
        return first->at.x_m < second->at.x_m ? -1 : 1;
    if (first->at.y_m != second->at.y_m)
        return first->at.y_m < second->at.y_m ? -1 : 1;
    if (first->angle != second->angle)
        return first->angle < second->angle ? -1 : 1;
    return first->end - second->end;
}

/* The ends of all pieces that are not closed, sorted by place and direction. */
static int find_ends(const yb_piece_t *piece, int count, end_t *end)
{
    int ends = 0;
    for (int i = 0; i < count; i++) {
        const yb_place_t *place = piece[i].place;
        int last = piece[i].count - 1;
        if (same_place(place[0], place[last]))
            continue;
        end[ends++] = (end_t){
            place[0], atan2(place[1].y_m - place[0].y_m, place[1].x_m - place[0].x_m), 2 * i};
        end[ends++] = (end_t){
            place[last],
            atan2(place[last - 1].y_m - place[last].y_m, place[last - 1].x_m - place[last].x_m),
            2 * i + 1};
    }
    qsort(end, (size_t)ends, sizeof(*end), by_place);
    return ends;
}

/* How far two directions are from being opposite. */
static double bend(const end_t *a, const end_t *b)
{
    return fabs(fabs(a->angle - b->angle) - half_turn);
}

/* Pairs ends that meet at a place and are neighbours in direction, the straightest first: so no two
 * pairs cross. Takes those paired out.
 */
static void pair_ends(end_t *end, int count, int *partner)
{
    while (count >= 2) {
        int best = 0;
        for (int i = 1; i < count; i++)
            if (bend(&end[i], &end[(i + 1) % count]) < bend(&end[best], &end[(best + 1) % count]))
                best = i;
        int next = (best + 1) % count;
        partner[end[best].end] = end[next].end;
        partner[end[next].end] = end[best].end;
        int low = best < next ? best : next;
        int high = best < next ? next : best;
        memmove(&end[high], &end[high + 1], (size_t)(count - high - 1) * sizeof(*end));
        memmove(&end[low], &end[low + 1], (size_t)(count - low - 2) * sizeof(*end));
        count -= 2;
    }
}

static void append(yb_piece_t *line, const yb_piece_t *piece, bool backwards)
{
    for (int i = 0; i < piece->count; i++) {
        yb_place_t place = piece->place[backwards ? piece->count - 1 - i : i];
        if (line->count == 0 || !same_place(line->place[line->count - 1], place))
            line->place[line->count++] = place;
    }
}

/* Follows the pieces from one end on. False: out of memory. */
static bool follow(const yb_piece_t *piece, const int *partner, int from, bool *used,
                   yb_piece_t *line)
{
    size_t places = 0;
    for (int end = from; end >= 0 && !used[end / 2]; end = partner[end ^ 1]) {
        places += (size_t)piece[end / 2].count;
        used[end / 2] = true;
    }
    *line = (yb_piece_t){calloc(places, sizeof(yb_place_t)), 0};
    if (line->place == NULL)
        return false;
    int end = from;
    do {
        append(line, &piece[end / 2], end % 2 == 1);
        end = partner[end ^ 1];
    } while (end >= 0 && end != from);
    return true;
}

/* Chains first, from their open ends, then what runs in a ring. */
static int join_all(const yb_piece_t *piece, int count, const int *partner, bool *used,
                    yb_piece_t *line)
{
    int lines = 0;
    for (int ring = 0; ring < 2; ring++)
        for (int end = 0; end < 2 * count; end++) {
            if (used[end / 2] || (ring == 0 && partner[end] >= 0))
                continue;
            if (!follow(piece, partner, end, used, &line[lines])) {
                while (lines > 0)
                    free(line[--lines].place);
                return -1;
            }
            lines++;
        }
    return lines;
}

int yb_line_join(yb_piece_t *piece, int count)
{
    end_t *end = malloc(2 * (size_t)count * sizeof(*end) + 1);
    int *partner = calloc(2 * (size_t)count + 1, sizeof(*partner));
    bool *used = calloc((size_t)count + 1, sizeof(*used));
    yb_piece_t *line = malloc((size_t)count * sizeof(*line) + 1);
    int lines = -1;
    if (end != NULL && partner != NULL && used != NULL && line != NULL) {
        for (int i = 0; i < 2 * count; i++)
            partner[i] = -1;
        int ends = find_ends(piece, count, end);
        for (int first = 0, next = 0; first < ends; first = next) {
            for (next = first; next < ends && same_place(end[first].at, end[next].at);)
                next++;
            pair_ends(&end[first], next - first, partner);
        }
        lines = join_all(piece, count, partner, used, line);
    }
    if (lines >= 0) {
        for (int i = 0; i < count; i++)
            free(piece[i].place);
        memcpy(piece, line, (size_t)lines * sizeof(*line));
    }
    free(end);
    free(partner);
    free(used);
    free(line);
    return lines;
}
