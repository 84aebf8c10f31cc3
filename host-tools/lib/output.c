/* realpath */
#define _XOPEN_SOURCE 700
#include "output.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct yb_output {
    char *target;    /* what the user named, links followed */
    char *directory; /* ours alone, beside the target */
    char *path;      /* the file in it */
    bool standard;   /* the target is the standard output */
    bool copied;     /* the target is not a file: at the commit it gets the bytes */
};

static char *text_join(const char *first, size_t first_length, const char *second)
{
    size_t second_length = strlen(second);
    char *text = malloc(first_length + second_length + 1);
    if (text != NULL) {
        memcpy(text, first, first_length);
        memcpy(text + first_length, second, second_length + 1);
    }
    return text;
}

/* Length of the directory part with its last slash: 0 if there is none. */
static size_t directory_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? 0 : (size_t)(slash - path) + 1;
}

static bool directory_exists(const char *path, yb_error_t *error)
{
    size_t length = directory_length(path);
    if (length == 0)
        return true;
    char *directory = text_join(path, length, "");
    struct stat status;
    bool good = directory != NULL && stat(directory, &status) == 0 && S_ISDIR(status.st_mode);
    if (!good)
        yb_error_set(error, "cannot write %s: there is no such directory", path);
    free(directory);
    return good;
}

bool yb_output_allowed(const char *path, bool force, yb_error_t *error)
{
    if (strcmp(path, "-") == 0)
        return true;
    if (*path == '\0')
        return yb_error_set(error, "the output file has an empty name");
    struct stat status;
    if (stat(path, &status) != 0)
        return directory_exists(path, error);
    if (S_ISDIR(status.st_mode))
        return yb_error_set(error, "cannot write %s: it is a directory", path);
    if (S_ISREG(status.st_mode) && !force)
        return yb_error_set(error, "%s exists already; --force overwrites it", path);
    return true;
}

/* Where the new directory goes: beside a file, elsewhere for what is not a file. */
static char *room_template(const yb_output_t *output)
{
    static const char name[] = ".yamabiko-XXXXXX";
    if (!output->copied)
        return text_join(output->target, directory_length(output->target), name);
    const char *temporary = getenv("TMPDIR");
    if (temporary == NULL || *temporary == '\0')
        temporary = "/tmp";
    char *with_slash = text_join(temporary, strlen(temporary), "/");
    if (with_slash == NULL)
        return NULL;
    char *text = text_join(with_slash, strlen(with_slash), name);
    free(with_slash);
    return text;
}

static bool output_place(yb_output_t *output, const char *path)
{
    struct stat status;
    output->standard = strcmp(path, "-") == 0;
    bool exists = !output->standard && stat(path, &status) == 0;
    output->copied = output->standard || (exists && !S_ISREG(status.st_mode));
    output->target = exists && !output->copied ? realpath(path, NULL) : text_join(path, 0, path);
    if (output->target == NULL)
        return false;
    output->directory = room_template(output);
    if (output->directory == NULL || mkdtemp(output->directory) == NULL) {
        free(output->directory);
        output->directory = NULL;
        return false;
    }
    const char *name = output->standard ? "output" : path + directory_length(path);
    char *slash = text_join(output->directory, strlen(output->directory), "/");
    if (slash != NULL)
        output->path = text_join(slash, strlen(slash), name);
    free(slash);
    return output->path != NULL;
}

yb_output_t *yb_output_open(const char *path, bool force, yb_error_t *error)
{
    if (!yb_output_allowed(path, force, error))
        return NULL;
    yb_output_t *output = calloc(1, sizeof(*output));
    if (output == NULL || !output_place(output, path)) {
        yb_error_set(error, "cannot write %s: %s", path, strerror(errno));
        yb_output_close(output);
        return NULL;
    }
    return output;
}

const char *yb_output_path(const yb_output_t *output)
{
    return output->path;
}

static bool stream_copy(FILE *from, FILE *to)
{
    char block[4096];
    for (;;) {
        size_t size = fread(block, 1, sizeof(block), from);
        if (size == 0)
            return ferror(from) == 0 && fflush(to) == 0;
        if (fwrite(block, 1, size, to) != size)
            return false;
    }
}

static bool commit_by_copy(const yb_output_t *output)
{
    FILE *from = fopen(output->path, "rb");
    FILE *to = output->standard ? stdout : fopen(output->target, "wb");
    bool good = from != NULL && to != NULL && stream_copy(from, to);
    if (from != NULL)
        fclose(from);
    if (to != NULL && to != stdout && fclose(to) != 0)
        good = false;
    return good;
}

bool yb_output_commit(yb_output_t *output, yb_error_t *error)
{
    bool good = output->copied ? commit_by_copy(output) : rename(output->path, output->target) == 0;
    if (!good)
        yb_error_set(error, "cannot write %s: %s",
                     output->standard ? "to the standard output" : output->target, strerror(errno));
    return good;
}

/* Libraries may have put files of their own beside ours: they go too. */
static void room_remove(const char *directory)
{
    DIR *entries = opendir(directory);
    if (entries == NULL)
        return;
    for (struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        unlinkat(dirfd(entries), entry->d_name, 0);
    }
    closedir(entries);
    rmdir(directory);
}

void yb_output_close(yb_output_t *output)
{
    if (output == NULL)
        return;
    if (output->directory != NULL)
        room_remove(output->directory);
    free(output->path);
    free(output->directory);
    free(output->target);
    free(output);
}

bool yb_output_stream(const char *path, bool force, yb_output_write_fn write, const void *context,
                      yb_error_t *error)
{
    yb_output_t *output = yb_output_open(path, force, error);
    if (output == NULL)
        return false;
    FILE *stream = fopen(output->path, "wb");
    bool good = stream != NULL && write(stream, context);
    if (stream != NULL && fclose(stream) != 0)
        good = false;
    if (!good)
        yb_error_set(error, "cannot write %s: %s", path, strerror(errno));
    good = good && yb_output_commit(output, error);
    yb_output_close(output);
    return good;
}

typedef struct {
    const void *bytes;
    size_t size;
} bytes_t;

static bool write_bytes(FILE *stream, const void *context)
{
    const bytes_t *all = context;
    return fwrite(all->bytes, 1, all->size, stream) == all->size;
}

bool yb_output_write(const char *path, bool force, const void *bytes, size_t size,
                     yb_error_t *error)
{
    const bytes_t all = {bytes, size};
    return yb_output_stream(path, force, write_bytes, &all, error);
}
