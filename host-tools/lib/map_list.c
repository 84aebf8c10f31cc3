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
    char *path;
    bool told;
} name_t;

typedef struct {
    name_t *at;
    size_t count;
} names_t;

enum {
    IS_FILE = -1,
    IS_GONE = -2 /* a folder that was watched */
};

struct yb_map_list {
    char *const *paths; /* as given */
    size_t path_count;
    int *watches; /* of each path: a folder's watch, or */
    int fd;
    names_t names;
};

static bool add(names_t *names, char *name)
{
    name_t *more = realloc(names->at, (names->count + 1) * sizeof(*more));
    if (more != NULL)
        names->at = more;
    if (more == NULL || name == NULL) {
        free(name);
        return false;
    }
    names->at[names->count++] = (name_t){.path = name};
    return true;
}

static void free_names(names_t *names)
{
    for (size_t i = 0; i < names->count; i++)
        free(names->at[i].path);
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

/* Not a pipe, which would keep us waiting. */
static bool is_regular(const char *path)
{
    struct stat about;
    return path != NULL && stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

/* A folder that is gone holds nothing. */
static bool add_folder(names_t *names, const char *folder)
{
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, is_code, by_name);
    bool good = true;
    for (int i = 0; i < count; i++) {
        char *path = join(folder, entries[i]->d_name);
        if (is_regular(path))
            good = add(names, path) && good;
        else
            free(path);
        free(entries[i]);
    }
    free(entries);
    return good;
}

static bool is_folder(const yb_map_list_t *list, size_t path)
{
    return list->watches[path] != IS_FILE;
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

static int watch_folder(const yb_map_list_t *list, const char *folder)
{
    return inotify_add_watch(list->fd, folder,
                             IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE |
                                 IN_MOVE_SELF | IN_ONLYDIR);
}

static bool watch(yb_map_list_t *list, size_t path, yb_error_t *error)
{
    const char *name = list->paths[path];
    struct stat about;
    list->watches[path] = IS_FILE;
    if (strcmp(name, "-") == 0)
        return list->path_count == 1 ||
               yb_error_set(error, "the standard input must be the only map: it is read once");
    if (stat(name, &about) != 0)
        return yb_error_set(error, "%s: %s", name, strerror(errno));
    if (!S_ISDIR(about.st_mode))
        return true;
    if (list->fd < 0)
        list->fd = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    list->watches[path] = list->fd >= 0 ? watch_folder(list, name) : IS_GONE;
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
    return index < list->names.count ? list->names.at[index].path : NULL;
}

bool yb_map_list_tell(yb_map_list_t *list, size_t index)
{
    const bool told = index < list->names.count && list->names.at[index].told;
    if (index < list->names.count)
        list->names.at[index].told = true;
    return !told;
}

int yb_map_list_fd(const yb_map_list_t *list)
{
    return list->fd;
}

/* The file that an event is about, NULL if it is about a folder itself; to be freed. */
static char *path_of(yb_map_list_t *list, const struct inotify_event *event)
{
    for (size_t i = 0; i < list->path_count; i++) {
        if (list->watches[i] != event->wd)
            continue;
        if ((event->mask & (IN_IGNORED | IN_MOVE_SELF)) != 0) {
            if ((event->mask & IN_MOVE_SELF) != 0)
                (void)inotify_rm_watch(list->fd, event->wd);
            list->watches[i] = IS_GONE;
        }
        return event->len > 0 ? join(list->paths[i], event->name) : NULL;
    }
    return NULL;
}

static bool is_link(const char *path)
{
    struct stat about;
    return path != NULL && lstat(path, &about) == 0 && S_ISLNK(about.st_mode);
}

static yb_maps_change_t take_event(yb_map_list_t *list, const struct inotify_event *event,
                                   const char *current)
{
    char *path = path_of(list, event);
    yb_maps_change_t change = YB_MAPS_OTHERS;
    if ((event->mask & IN_CREATE) != 0 && !is_link(path))
        change = YB_MAPS_SAME; /* it is still to be written */
    else if (path != NULL && current != NULL && strcmp(path, current) == 0)
        change = YB_MAPS_THIS;
    for (size_t i = 0; path != NULL && i < list->names.count; i++) {
        if (strcmp(list->names.at[i].path, path) == 0)
            list->names.at[i].told = false;
    }
    free(path);
    return change;
}

/* Takes all events that wait. */
static yb_maps_change_t take_events(yb_map_list_t *list, const char *current)
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
            const yb_maps_change_t now = take_event(list, event, current);
            change = now > change ? now : change;
        }
    }
    return change;
}

bool yb_map_list_misses(const yb_map_list_t *list)
{
    bool misses = false;
    for (size_t i = 0; i < list->path_count; i++)
        misses = misses || list->watches[i] == IS_GONE;
    return misses;
}

/* Folders that were gone may be there again; true if one is. */
static bool find_again(yb_map_list_t *list)
{
    bool found = false;
    for (size_t i = 0; i < list->path_count; i++) {
        if (list->watches[i] != IS_GONE)
            continue;
        const int watch = watch_folder(list, list->paths[i]);
        list->watches[i] = watch >= 0 ? watch : IS_GONE;
        found = found || watch >= 0;
    }
    return found;
}

static bool was_told(const names_t *names, const char *path)
{
    size_t i = 0;
    while (i < names->count && strcmp(names->at[i].path, path) != 0)
        i++;
    return i < names->count && names->at[i].told;
}

yb_maps_change_t yb_map_list_update(yb_map_list_t *list, size_t *index)
{
    names_t now = {0};
    const char *current = yb_map_list_at(list, *index);
    yb_maps_change_t change = list->fd < 0 ? YB_MAPS_SAME : take_events(list, current);
    if (list->fd >= 0 && find_again(list) && change == YB_MAPS_SAME)
        change = YB_MAPS_OTHERS;
    if (change == YB_MAPS_SAME)
        return YB_MAPS_SAME;
    if (!list_all(list, &now)) {
        free_names(&now); /* no memory: as it was */
        return change;
    }
    size_t place = now.count;
    for (size_t i = 0; i < now.count; i++) {
        now.at[i].told = was_told(&list->names, now.at[i].path);
        if (current != NULL && strcmp(now.at[i].path, current) == 0)
            place = i;
    }
    if (place < now.count)
        *index = place;
    else
        change = YB_MAPS_THIS;
    free_names(&list->names);
    list->names = now;
    if (*index >= now.count)
        *index = 0;
    return change;
}
