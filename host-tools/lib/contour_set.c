#include "contour_set.h"

#include <math.h>
#include <string.h>

static double base_m(const yb_contour_set_t *set)
{
    return set->profile == YB_COMPACT ? set->base * yb_unit_m(set->unit) : set->base_m;
}

static uint16_t nearest_height(const yb_contour_set_t *set, double height_m, int multiple)
{
    double unit_m = yb_unit_m(set->unit) * multiple;
    double units = (height_m - base_m(set)) / unit_m;
    return (uint16_t)(lround(fmin(fmax(units, 0), UINT16_MAX / multiple)) * multiple);
}

uint16_t yb_contour_set_height(const yb_contour_set_t *set, double height_m)
{
    return nearest_height(set, height_m, 1);
}

uint16_t yb_contour_set_line_height(const yb_contour_set_t *set, double height_m)
{
    return nearest_height(set, height_m, 1 << set->interval);
}

double yb_contour_set_height_m(const yb_contour_set_t *set, int height)
{
    return base_m(set) + height * yb_unit_m(set->unit);
}

int yb_contour_set_most_vertices(const yb_contour_set_t *set)
{
    return set->most_vertices > 0 ? set->most_vertices : UINT8_MAX;
}

int yb_contour_set_first(const yb_contour_set_t *set, int contour)
{
    int first = 0;
    for (int i = 0; i < contour; i++)
        first += set->contour[i].count;
    return first;
}

bool yb_contour_set_is_end(const yb_contour_set_t *set, int contour, int at)
{
    return set->contour[contour].open && (at == 0 || at == set->contour[contour].count - 1);
}

bool yb_contour_set_insert(yb_contour_set_t *set, int contour, int at, yb_step_t point)
{
    if (set->point_count >= YB_SET_POINTS)
        return false;
    memmove(&set->point[at + 1], &set->point[at],
            (size_t)(set->point_count - at) * sizeof(set->point[0]));
    set->point[at] = point;
    set->point_count++;
    set->contour[contour].count++;
    return true;
}

void yb_contour_set_remove(yb_contour_set_t *set, int contour, int at)
{
    set->point_count--;
    memmove(&set->point[at], &set->point[at + 1],
            (size_t)(set->point_count - at) * sizeof(set->point[0]));
    set->contour[contour].count--;
}

bool yb_contour_set_append(yb_contour_set_t *set, uint16_t height, bool open,
                           const yb_step_t *point, int count)
{
    if (set->contour_count >= YB_SET_CONTOURS || set->point_count + count > YB_SET_POINTS)
        return false;
    set->contour[set->contour_count++] =
        (yb_coded_contour_t){.height = height, .count = (uint16_t)count, .open = open};
    memcpy(&set->point[set->point_count], point, (size_t)count * sizeof(*point));
    set->point_count += count;
    return true;
}

void yb_contour_set_drop(yb_contour_set_t *set, int contour)
{
    int first = yb_contour_set_first(set, contour);
    int count = set->contour[contour].count;
    memmove(&set->point[first], &set->point[first + count],
            (size_t)(set->point_count - first - count) * sizeof(set->point[0]));
    set->point_count -= count;
    set->contour_count--;
    memmove(&set->contour[contour], &set->contour[contour + 1],
            (size_t)(set->contour_count - contour) * sizeof(set->contour[0]));
}

bool yb_contour_set_reorder(yb_contour_set_t *set, int contour, int to)
{
    if (contour == to)
        return false;
    yb_coded_contour_t moved = set->contour[contour];
    yb_step_t point[YB_SET_POINTS];
    memcpy(point, &set->point[yb_contour_set_first(set, contour)], moved.count * sizeof(*point));
    yb_contour_set_drop(set, contour);
    int first = yb_contour_set_first(set, to);
    memmove(&set->point[first + moved.count], &set->point[first],
            (size_t)(set->point_count - first) * sizeof(*point));
    memcpy(&set->point[first], point, moved.count * sizeof(*point));
    set->point_count += moved.count;
    memmove(&set->contour[to + 1], &set->contour[to],
            (size_t)(set->contour_count - to) * sizeof(moved));
    set->contour[to] = moved;
    set->contour_count++;
    return true;
}

void yb_contour_set_turn(yb_contour_set_t *set, int contour, int from, bool back)
{
    yb_step_t before[YB_SET_POINTS];
    int count = set->contour[contour].count;
    yb_step_t *point = &set->point[yb_contour_set_first(set, contour)];
    memcpy(before, point, (size_t)count * sizeof(*point));
    for (int i = 0; i < count; i++)
        point[i] = before[(from + (back ? count - i : i)) % count];
}

bool yb_contour_set_rescale(yb_contour_set_t *set, uint16_t unit)
{
    const yb_contour_set_t before = *set;
    if (unit == before.unit)
        return false;
    set->unit = unit;
    set->base = (int)floor(base_m(&before) / yb_unit_m(unit));
    for (int i = 0; i < set->contour_count; i++) {
        double height_m = yb_contour_set_height_m(&before, before.contour[i].height);
        set->contour[i].height = set->contour[i].count > 1
                                     ? yb_contour_set_line_height(set, height_m)
                                     : yb_contour_set_height(set, height_m);
    }
    for (int i = 0; i < YB_CORNERS; i++)
        set->corner[i] =
            yb_contour_set_height(set, yb_contour_set_height_m(&before, before.corner[i]));
    set->frame = yb_contour_set_height(set, yb_contour_set_height_m(&before, before.frame));
    return true;
}
