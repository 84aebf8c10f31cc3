#include "cli.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

typedef struct {
    const char *name;
    cli_verb_fn run;
    const char *what;
} verb_t;

static const verb_t verbs[] = {
    {"encode", cli_encode, "code a relief or its contour lines"},
    {"info", cli_info, "say what is in a code"},
    {"render", cli_render, "draw it"},
    {"dem", cli_dem, "write its surface as a raster"},
    {"contours", cli_contours, "write contour lines of its surface"},
    {"mesh", cli_mesh, "write its triangles"},
    {"evaluate", cli_evaluate, "compare it with the real relief"},
    {"show", cli_show, "show maps on a real panel"},
    {"sim", cli_sim, "show them in a window, as a panel or the handheld would"},
    {"ping", cli_ping, "look for a device"},
};
enum {
    VERBS = sizeof(verbs) / sizeof(verbs[0])
};

static const char *verb_name = "";

static void say(const char *format, va_list arguments)
{
    fflush(stdout);
    fprintf(stderr, "yamabiko %s%s", verb_name, *verb_name != '\0' ? ": " : "");
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

int cli_fail(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    return CLI_FAILED;
}

int cli_usage(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    say(format, arguments);
    va_end(arguments);
    fprintf(stderr, "Try 'yamabiko %s --help'.\n", verb_name);
    return CLI_USAGE;
}

int cli_bad_option(int answer, int argc, char **argv)
{
    const char *text = optind > 0 && optind <= argc ? argv[optind - 1] : "";
    if (answer == ':')
        return cli_usage("option '%s' needs a value", text);
    return cli_usage("unknown option '%s'", text);
}

bool cli_number(const char *text, double *value)
{
    char *end = NULL;
    errno = 0;
    *value = strtod(text, &end);
    return end != text && *end == '\0' && errno == 0 && isfinite(*value);
}

bool cli_integer(const char *text, long low, long high, long *value)
{
    char *end = NULL;
    errno = 0;
    *value = strtol(text, &end, 10);
    return end != text && *end == '\0' && errno == 0 && *value >= low && *value <= high;
}

static void help(void)
{
    puts("Usage: yamabiko VERB [OPTION ...] [FILE ...]\n\n"
         "A whole mountain in about a hundred bytes.\n");
    for (int i = 0; i < VERBS; i++)
        printf("  %-10s %s\n", verbs[i].name, verbs[i].what);
    puts("\n'yamabiko VERB --help' tells a verb's options, 'man yamabiko' the whole.\n"
         "Exit codes: 0 done, 1 failed (one sentence says why), 2 wrong usage,\n3 a panel cannot "
         "be reached.");
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        help();
        return CLI_USAGE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        help();
        return CLI_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("yamabiko %d.%d.%d, code format %d\n", YB_VERSION_MAJOR, YB_VERSION_MINOR,
               YB_VERSION_PATCH, YB_FORMAT_VERSION);
        return CLI_OK;
    }
    for (int i = 0; i < VERBS; i++) {
        if (strcmp(argv[1], verbs[i].name) == 0) {
            verb_name = verbs[i].name;
            opterr = 0;
            int status = verbs[i].run(argc - 1, argv + 1);
            if (fflush(stdout) != 0 || ferror(stdout) != 0)
                status = cli_fail("cannot write to the standard output: %s", strerror(errno));
            return status;
        }
    }
    fprintf(stderr, "yamabiko: there is no verb '%s'.\nTry 'yamabiko --help'.\n", argv[1]);
    return CLI_USAGE;
}
