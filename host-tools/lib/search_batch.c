#include "search_batch.h"

#include "random.h"
#include "simplify.h"

double yb_batch_bits(const yb_batch_change_t *change)
{
    static const double bits[] = {
        [YB_MOVE_INSERT] = 10, [YB_MOVE_REMOVE] = -10, [YB_MOVE_SPOT] = 14};
    return bits[change->kind];
}

static yb_local_move_t draw_kind(yb_search_mover_t *mover)
{
    static const struct {
        yb_local_move_t kind;
        double until;
    } kinds[] = {{YB_MOVE_POINT, 0.6},
                 {YB_MOVE_HEIGHT, 0.75},
                 {YB_MOVE_INSERT, 0.84},
                 {YB_MOVE_REMOVE, 0.94},
                 {YB_MOVE_SPOT, 1}};
    double ticket = yb_random_share(&mover->random);
    int i = 0;
    while (ticket >= kinds[i].until)
        i++;
    return kinds[i].kind;
}

/* What the mover has just done to a copy of the code. */
static yb_batch_change_t change_of(const yb_search_mover_t *mover, yb_local_move_t kind)
{
    const yb_contour_set_t *set = mover->set;
    yb_batch_change_t change = {.kind = kind, .contour = mover->contour, .point = mover->point};
    if (kind == YB_MOVE_HEIGHT)
        change.point = mover->first;
    if (kind == YB_MOVE_INSERT)
        change.point++;
    if (kind == YB_MOVE_SPOT) {
        change.contour = set->contour_count - 1;
        change.point = set->point_count - 1;
    }
    change.to = set->point[change.point];
    change.height = set->contour[change.contour].height;
    return change;
}

/* Whether a change may join the others: no other of its point, one shortening of each contour. */
static bool is_apart(const yb_batch_t *batch, const yb_batch_change_t *change)
{
    for (int i = 0; i < batch->count; i++) {
        const yb_batch_change_t *other = &batch->change[i];
        if (other->point == change->point ||
            (other->kind == YB_MOVE_REMOVE && change->kind == YB_MOVE_REMOVE &&
             other->contour == change->contour))
            return false;
    }
    return true;
}

/* Keeps the highest points first. Answers where the change is. */
static int join(yb_batch_t *batch, const yb_batch_change_t *change)
{
    int at = batch->count++;
    for (; at > 0 && batch->change[at - 1].point < change->point; at--)
        batch->change[at] = batch->change[at - 1];
    batch->change[at] = *change;
    return at;
}

static void leave(yb_batch_t *batch, int at)
{
    batch->count--;
    for (int i = at; i < batch->count; i++)
        batch->change[i] = batch->change[i + 1];
}

void yb_batch_apply(const yb_batch_t *batch, const yb_contour_set_t *now, yb_contour_set_t *set)
{
    *set = *now;
    for (int i = 0; i < batch->count; i++) {
        const yb_batch_change_t *change = &batch->change[i];
        switch (change->kind) {
        case YB_MOVE_POINT:
            set->point[change->point] = change->to;
            break;
        case YB_MOVE_HEIGHT:
            set->contour[change->contour].height = change->height;
            break;
        case YB_MOVE_INSERT:
            (void)yb_contour_set_insert(set, change->contour, change->point, change->to);
            break;
        case YB_MOVE_REMOVE:
            yb_contour_set_remove(set, change->contour, change->point);
            break;
        default:
            (void)yb_contour_set_append(set, change->height, false, &change->to, 1);
            break;
        }
    }
}

/* Whether change `at` of the batch makes no lines meet in the code with all of them. */
static bool fits(const yb_batch_t *batch, int at, const yb_contour_set_t *set)
{
    const yb_batch_change_t *change = &batch->change[at];
    if (change->kind == YB_MOVE_HEIGHT)
        return true;
    int point = change->point;
    for (int i = at + 1; i < batch->count; i++) {
        yb_local_move_t kind = batch->change[i].kind;
        point += kind == YB_MOVE_INSERT ? 1 : kind == YB_MOVE_REMOVE ? -1 : 0;
    }
    int in_line = point - yb_contour_set_first(set, change->contour);
    if (change->kind == YB_MOVE_REMOVE)
        in_line += in_line > 0 ? -1 : set->contour[change->contour].count - 1;
    return yb_simplify_point_fits(set, change->contour, in_line);
}

void yb_batch_draw(yb_batch_t *batch, yb_search_mover_t *mover, const yb_contour_set_t *now,
                   int most)
{
    batch->count = 0;
    for (int i = 0; i < most && i < YB_BATCH_CHANGES; i++) {
        *mover->set = *now;
        yb_local_move_t kind = draw_kind(mover);
        if (!yb_search_move_locally(mover, kind) ||
            (kind == YB_MOVE_HEIGHT && now->contour[mover->contour].count > YB_BATCH_LINE))
            continue;
        const yb_batch_change_t change = change_of(mover, kind);
        if (!is_apart(batch, &change))
            continue;
        int at = join(batch, &change);
        yb_batch_apply(batch, now, mover->set);
        if (!fits(batch, at, mover->set))
            leave(batch, at);
    }
    yb_batch_apply(batch, now, mover->set);
}

static yb_judge_site_t site_of(const yb_contour_set_t *set, yb_step_t at, int change)
{
    return (yb_judge_site_t){(double)at.x / set->east, (double)at.y / set->north, change};
}

int yb_batch_sites(const yb_batch_t *batch, const yb_contour_set_t *now,
                   yb_judge_site_t site[YB_BATCH_SITES])
{
    int sites = 0;
    for (int i = 0; i < batch->count; i++) {
        const yb_batch_change_t *change = &batch->change[i];
        if (change->kind == YB_MOVE_HEIGHT) {
            for (int k = 0; k < now->contour[change->contour].count; k++)
                site[sites++] = site_of(now, now->point[change->point + k], i);
        } else {
            bool there = change->kind == YB_MOVE_POINT || change->kind == YB_MOVE_REMOVE;
            site[sites++] = site_of(now, there ? now->point[change->point] : change->to, i);
        }
    }
    return sites;
}
