#include "map_list.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    char **at;
    size_t count;
} names_t;

struct yb_map_list {
    char *const *paths; /* as given */
    size_t path_count;
    int *watches; /* of each path; -1: a file */
    int fd;
    names_t names;
};

static bool add(names_t *names, char *name)
{
    char **more = realloc(names->at, (names->count + 1) * sizeof(*more));
    if (more != NULL)
        names->at = more;
    if (more == NULL || name == NULL) {
        free(name);
        return false;
    }
    names->at[names->count++] = name;
    return true;
}

static void free_names(names_t *names)
{
    for (size_t i = 0; i < names->count; i++)
        free(names->at[i]);
    free(names->at);
    *names = (names_t){0};
}

static char *join(const char *folder, const char *file)
{
    const size_t length = strlen(folder);
    const char *slash = length > 0 && folder[length - 1] == '/' ? "" : "/";
    const size_t room = length + strlen(slash) + strlen(file) + 1;
    char *path = malloc(room);
    if (path != NULL)
        snprintf(path, room, "%s%s%s", folder, slash, file);
    return path;
}

static int is_code(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return entry->d_name[0] != '.' && dot != NULL && strcmp(dot, ".yb") == 0;
}

static int by_name(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

/* A folder that is gone holds nothing. */
static bool add_folder(names_t *names, const char *folder)
{
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, is_code, by_name);
    bool good = true;
    for (int i = 0; i < count; i++) {
        good = add(names, join(folder, entries[i]->d_name)) && good;
        free(entries[i]);
    }
    free(entries);
    return good;
}

static bool is_folder(const yb_map_list_t *list, size_t path)
{
    return list->watches[path] >= 0;
}

static bool list_all(const yb_map_list_t *list, names_t *names)
{
    bool good = true;
    for (size_t i = 0; i < list->path_count; i++)
        good = (is_folder(list, i) ? add_folder(names, list->paths[i])
                                   : add(names, strdup(list->paths[i]))) &&
               good;
    return good;
}

static bool watch(yb_map_list_t *list, size_t path, yb_error_t *error)
{
    const char *name = list->paths[path];
    struct stat about;
    list->watches[path] = -1;
    if (strcmp(name, "-") == 0)
        return true;
    if (stat(name, &about) != 0)
        return yb_error_set(error, "%s: %s", name, strerror(errno));
    if (!S_ISDIR(about.st_mode))
        return true;
    if (list->fd < 0)
        list->fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (list->fd >= 0)
        list->watches[path] = inotify_add_watch(
            list->fd, name, IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_ONLYDIR);
    return list->watches[path] >= 0 ||
           yb_error_set(error, "%s cannot be watched: %s", name, strerror(errno));
}

yb_map_list_t *yb_map_list_open(char *const *paths, size_t count, yb_error_t *error)
{
    yb_map_list_t *list = calloc(1, sizeof(*list));
    if (list != NULL)
        *list = (yb_map_list_t){.paths = paths, .path_count = count, .fd = -1};
    if (list == NULL || (list->watches = calloc(count + 1, sizeof(*list->watches))) == NULL) {
        free(list);
        yb_error_set(error, "out of memory");
        return NULL;
    }
    bool good = true;
    for (size_t i = 0; good && i < count; i++)
        good = watch(list, i, error);
    if (good && !list_all(list, &list->names))
        good = yb_error_set(error, "out of memory");
    if (good)
        return list;
    yb_map_list_close(list);
    return NULL;
}

void yb_map_list_close(yb_map_list_t *list)
{
    if (list == NULL)
        return;
    if (list->fd >= 0)
        close(list->fd);
    free_names(&list->names);
    free(list->watches);
    free(list);
}

size_t yb_map_list_count(const yb_map_list_t *list)
{
    return list->names.count;
}

const char *yb_map_list_at(const yb_map_list_t *list, size_t index)
{
    return index < list->names.count ? list->names.at[index] : NULL;
}

int yb_map_list_fd(const yb_map_list_t *list)
{
    return list->fd;
}

/* Whether an event is about this path. */
static bool is_about(const yb_map_list_t *list, const struct inotify_event *event, const char *path)
{
    for (size_t i = 0; i < list->path_count; i++) {
        if (list->watches[i] != event->wd || event->len == 0)
            continue;
        char *touched = join(list->paths[i], event->name);
        const bool same = touched != NULL && strcmp(touched, path) == 0;
        free(touched);
        if (same)
            return true;
    }
    return false;
}

/* Takes all events that wait, and says whom they were about. */
static yb_maps_change_t take_events(const yb_map_list_t *list, const char *path)
{
    union {
        struct inotify_event first;
        char bytes[4096];
    } events;
    yb_maps_change_t change = YB_MAPS_SAME;
    ssize_t got;
    while ((got = read(list->fd, &events, sizeof(events))) > 0) {
        const struct inotify_event *event = NULL;
        for (char *at = events.bytes; at < events.bytes + got; at += sizeof(*event) + event->len) {
            event = (const struct inotify_event *)(const void *)at;
            if (path != NULL && is_about(list, event, path))
                change = YB_MAPS_THIS;
            else if (change == YB_MAPS_SAME)
                change = YB_MAPS_OTHERS;
        }
    }
    return change;
}

yb_maps_change_t yb_map_list_update(yb_map_list_t *list, size_t *index)
{
    names_t now = {0};
    const char *current = yb_map_list_at(list, *index);
    yb_maps_change_t change = list->fd < 0 ? YB_MAPS_SAME : take_events(list, current);
    if (change == YB_MAPS_SAME)
        return YB_MAPS_SAME;
    if (!list_all(list, &now)) {
        free_names(&now); /* no memory: as it was */
        return change;
    }
    size_t place = 0;
    while (current != NULL && place < now.count && strcmp(now.at[place], current) != 0)
        place++;
    if (current != NULL && place < now.count)
        *index = place;
    else
        change = YB_MAPS_THIS;
    free_names(&list->names);
    list->names = now;
    if (*index >= now.count)
        *index = 0;
    return change;
}
