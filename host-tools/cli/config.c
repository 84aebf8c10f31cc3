#include "config.h"

#include <errno.h>
#include <ini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "view_options.h"

typedef struct {
    cli_config_t *config;
    const struct option *options;
    const char *key; /* that was refused, and why */
    const char *why;
} reader_t;

static bool add(cli_config_t *config, char *word)
{
    char **more = realloc(config->argv, ((size_t)config->argc + 2) * sizeof(*more));
    if (more != NULL)
        config->argv = more;
    if (more == NULL || word == NULL) {
        free(word);
        return false;
    }
    config->argv[config->argc++] = word;
    config->argv[config->argc] = NULL;
    return true;
}

/* --name, or --name=value */
static char *long_option(const char *name, const char *value)
{
    const size_t room = strlen(name) + (value != NULL ? strlen(value) : 0) + 4;
    char *word = malloc(room);
    if (word != NULL)
        snprintf(word, room, "--%s%s%s", name, value != NULL ? "=" : "",
                 value != NULL ? value : "");
    return word;
}

/* Options of several numbers take them as words of their own. */
static bool add_words(cli_config_t *config, const char *name, const char *value)
{
    char *words = strdup(value), *rest = NULL;
    bool good = words != NULL;
    const char *word = good ? strtok_r(words, " \t", &rest) : NULL;
    good = good && add(config, long_option(name, word != NULL ? word : ""));
    while (good && word != NULL && (word = strtok_r(NULL, " \t", &rest)) != NULL)
        good = add(config, strdup(word));
    free(words);
    return good;
}

static bool refuse(reader_t *reader, const char *key, const char *why)
{
    if (reader->why == NULL) {
        reader->key = strdup(key);
        reader->why = why;
    }
    return false;
}

static bool take(reader_t *reader, const struct option *option, const char *value)
{
    const bool yes = strcmp(value, "yes") == 0, no = strcmp(value, "no") == 0;
    cli_config_t *config = reader->config;

    if (option->has_arg == no_argument && !yes && !no)
        return refuse(reader, option->name, "is either yes or no");
    if (option->has_arg == required_argument && *value == '\0')
        return refuse(reader, option->name, "needs a value");
    if (option->has_arg != required_argument && no)
        return true;
    if (option->has_arg != required_argument && yes)
        return add(config, long_option(option->name, NULL));
    return yb_view_options_values(option->val) > 1 ? add_words(config, option->name, value)
                                                   : add(config, long_option(option->name, value));
}

static int on_line(void *user, const char *section, const char *key, const char *value)
{
    reader_t *reader = user;
    const struct option *option = reader->options;
    (void)section;
    if (strcmp(key, "map") == 0)
        return *value != '\0' ? add(reader->config, strdup(value))
                              : refuse(reader, key, "needs a value");
    while (option->name != NULL && strcmp(option->name, key) != 0)
        option++;
    if (option->name == NULL || strcmp(key, "config") == 0 || strcmp(key, "help") == 0)
        return refuse(reader, key, "is no option here");
    return take(reader, option, value);
}

static int read_file(cli_config_t *config, const struct option *options, const char *path)
{
    reader_t reader = {.config = config, .options = options};
    errno = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return cli_fail("%s: %s", path, strerror(errno));
    const int line = ini_parse_file(file, on_line, &reader);
    const bool unread = ferror(file) != 0;
    fclose(file);
    int status = CLI_OK;
    if (unread)
        status = cli_fail("%s: cannot be read", path);
    else if (line > 0 && reader.why != NULL)
        status = cli_usage("%s: line %d: '%s' %s", path, line, reader.key, reader.why);
    else if (line > 0)
        status = cli_usage("%s: line %d is neither [section] nor key = value", path, line);
    else if (line < 0)
        status = cli_fail("out of memory");
    free((char *)reader.key);
    return status;
}

/* The value of --config at argv[i], or NULL. */
static const char *config_at(int argc, char **argv, int i)
{
    if (strncmp(argv[i], "--config=", 9) == 0)
        return argv[i] + 9;
    return strcmp(argv[i], "--config") == 0 && i + 1 < argc ? argv[i + 1] : NULL;
}

int cli_config_read(cli_config_t *config, const struct option *options, int argc, char **argv)
{
    *config = (cli_config_t){0};
    int status = add(config, strdup(argv[0])) ? CLI_OK : cli_fail("out of memory");
    for (int i = 1; status == CLI_OK && i < argc && strcmp(argv[i], "--") != 0; i++) {
        const char *path = config_at(argc, argv, i);
        if (path != NULL)
            status = read_file(config, options, path);
    }
    for (int i = 1; status == CLI_OK && i < argc; i++) {
        if (!add(config, strdup(argv[i])))
            status = cli_fail("out of memory");
    }
    if (status != CLI_OK)
        cli_config_free(config);
    return status;
}

void cli_config_free(cli_config_t *config)
{
    for (int i = 0; i < config->argc; i++)
        free(config->argv[i]);
    free(config->argv);
    *config = (cli_config_t){0};
}
