/* The maps that are shown one after another: files, and the codes of folders that are watched.
 *
 *     yb_map_list_t *list = yb_map_list_open(paths, count, &error);
 *     while (name = yb_map_list_at(list, 0)) …
 *     poll yb_map_list_fd(list); when it can be read: yb_map_list_update(list, &current);
 *     yb_map_list_close(list);
 *
 * A folder's codes are its files *.yb, by name. Files that come are added, those that go are
 * dropped.
 */
#ifndef YB_MAP_LIST_H
#define YB_MAP_LIST_H

#include <stdbool.h>
#include <stddef.h>

#include "error.h"

typedef struct yb_map_list yb_map_list_t;

/* The paths must stay as they are. NULL with a sentence if one is neither a file nor a folder that
 * can be read, or if "-", the standard input, is not the only one. */
yb_map_list_t *yb_map_list_open(char *const *paths, size_t count, yb_error_t *error);
void yb_map_list_close(yb_map_list_t *list);

size_t yb_map_list_count(const yb_map_list_t *list);

/* The path of one; until the next update. NULL beyond the last. */
const char *yb_map_list_at(const yb_map_list_t *list, size_t index);

/* Whether something may be told of a map that cannot be shown: once, until its file changes. */
bool yb_map_list_tell(yb_map_list_t *list, size_t index);

/* A descriptor that can be read when a folder has changed; -1: there is none. */
int yb_map_list_fd(const yb_map_list_t *list);

typedef enum {
    YB_MAPS_SAME,   /* nothing has happened */
    YB_MAPS_OTHERS, /* others came or went */
    YB_MAPS_THIS    /* this one's file was written or is gone */
} yb_maps_change_t;

/* A folder is gone: update now and then, because nothing will tell when it is there again. */
bool yb_map_list_misses(const yb_map_list_t *list);

/* Looks at the folders again, if anything has happened there. *index follows the map that it stood
 * for, or, if that is gone, stays where the next one is. */
yb_maps_change_t yb_map_list_update(yb_map_list_t *list, size_t *index);

#endif
