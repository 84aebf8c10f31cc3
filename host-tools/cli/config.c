#include "config.h"

#include <errno.h>
#include <ini.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "view_options.h"

typedef struct {
    cli_config_t *config, *maps;
    const struct option *options;
    FILE *file;
    int line; /* that was read last */
    /* What was refused first, and why. */
    char *key;
    const char *why;
    int why_line;
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
static bool add_words(cli_config_t *config, const char *name, const char *value, int *count)
{
    char *words = strdup(value), *rest = NULL;
    bool good = words != NULL;
    const char *word = good ? strtok_r(words, " \t", &rest) : NULL;
    good = good && add(config, long_option(name, word != NULL ? word : ""));
    for (*count = 0; good && word != NULL; ++*count) {
        word = strtok_r(NULL, " \t", &rest);
        good = word == NULL || add(config, strdup(word));
    }
    free(words);
    return good;
}

static bool refuse(reader_t *reader, const char *key, const char *why)
{
    if (reader->why == NULL) {
        reader->key = strdup(key);
        reader->why = why;
        reader->why_line = reader->line;
    }
    return false;
}

/* A map whose name begins like an option's is still a map. */
static bool take_map(reader_t *reader, const char *value)
{
    const bool like_option = value[0] == '-' && value[1] != '\0';
    const size_t room = strlen(value) + 3;
    char *word = malloc(room);
    if (*value == '\0') {
        free(word);
        return refuse(reader, "map", "needs a value");
    }
    if (word != NULL)
        snprintf(word, room, "%s%s", like_option ? "./" : "", value);
    return add(reader->maps, word);
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
    const int values = yb_view_options_values(option->val);
    int count = 0;
    if (values == 1)
        return add(config, long_option(option->name, value));
    return add_words(config, option->name, value, &count) &&
           (count == values ||
            refuse(reader, option->name, values == 2 ? "needs 2 values" : "needs 3 values"));
}

static int on_line(void *user, const char *section, const char *key, const char *value)
{
    reader_t *reader = user;
    const struct option *option = reader->options;
    (void)section;
    if (strcmp(key, "map") == 0)
        return take_map(reader, value);
    while (option->name != NULL && strcmp(option->name, key) != 0)
        option++;
    if (option->name == NULL || strcmp(key, "config") == 0 || strcmp(key, "help") == 0)
        return refuse(reader, key, "is no option here");
    return take(reader, option, value);
}

/* As fgets. The library takes an indented line for more of the one before, and a line that is too
 * long for two. */
static char *next_line(char *text, int room, void *user)
{
    reader_t *reader = user;
    if (reader->why != NULL || fgets(text, room, reader->file) == NULL)
        return NULL;
    reader->line++;
    if (strchr(text, '\n') == NULL && feof(reader->file) == 0) {
        (void)refuse(reader, "", "is too long");
        return NULL;
    }
    const size_t indent = strspn(text, " \t");
    memmove(text, text + indent, strlen(text + indent) + 1);
    return text;
}

static int explain(const reader_t *reader, const char *path, int wrong_line)
{
    if (reader->why != NULL && (wrong_line <= 0 || reader->why_line <= wrong_line))
        return cli_usage("%s: line %d%s%s%s %s", path, reader->why_line,
                         *reader->key != '\0' ? ": '" : "", reader->key,
                         *reader->key != '\0' ? "'" : "", reader->why);
    if (wrong_line > 0)
        return cli_usage("%s: line %d is neither [section] nor key = value", path, wrong_line);
    return wrong_line < 0 ? cli_fail("out of memory") : CLI_OK;
}

static int read_file(cli_config_t *config, cli_config_t *maps, const struct option *options,
                     const char *path)
{
    reader_t reader = {
        .config = config, .maps = maps, .options = options, .file = fopen(path, "r")};
    if (reader.file == NULL)
        return cli_fail("%s: %s", path, strerror(errno));
    const int wrong_line = ini_parse_stream(next_line, &reader, on_line, &reader);
    const bool unread = ferror(reader.file) != 0;
    fclose(reader.file);
    const int status =
        unread ? cli_fail("%s: cannot be read", path) : explain(&reader, path, wrong_line);
    free(reader.key);
    return status;
}

/* The value of --config at argv[i], or NULL. */
static const char *config_at(int argc, char **argv, int i)
{
    enum {
        SHORTEST = 6 /* --conf: getopt_long takes names cut short, too */
    };
    const char *equals = strchr(argv[i], '=');
    const size_t length = equals != NULL ? (size_t)(equals - argv[i]) : strlen(argv[i]);
    if (length < SHORTEST || strncmp(argv[i], "--config", length) != 0)
        return NULL;
    return equals != NULL ? equals + 1 : i + 1 < argc ? argv[i + 1] : NULL;
}

static bool add_all(cli_config_t *config, int argc, char **argv)
{
    for (int i = 0; i < argc; i++) {
        if (!add(config, strdup(argv[i])))
            return false;
    }
    return true;
}

int cli_config_read(cli_config_t *config, const struct option *options, int argc, char **argv)
{
    cli_config_t maps = {0};
    *config = (cli_config_t){0};
    int status = add_all(config, 1, argv) ? CLI_OK : cli_fail("out of memory");
    for (int i = 1; status == CLI_OK && i < argc; i++) {
        if (argv[i] == NULL || strcmp(argv[i], "--") == 0)
            break; /* what follows are maps */
        const char *path = config_at(argc, argv, i);
        if (path != NULL)
            status = read_file(config, &maps, options, path);
    }
    if (status == CLI_OK &&
        !(add_all(config, argc - 1, argv + 1) && add_all(config, maps.argc, maps.argv)))
        status = cli_fail("out of memory");
    cli_config_free(&maps);
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
