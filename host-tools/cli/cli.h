/* What the verbs of `yamabiko` share: their table, their exit codes and their way of failing. */
#ifndef YB_CLI_H
#define YB_CLI_H

#include <stdbool.h>

/* Exit codes, a contract with users' scripts. */
enum {
    CLI_OK = 0,
    CLI_FAILED = 1,
    CLI_USAGE = 2,
    CLI_UNREACHED = 3 /* a panel could not be reached, or no more */
};

/* One verb: argv[0] is the verb itself, for getopt_long. */
typedef int (*cli_verb_fn)(int argc, char **argv);

int cli_encode(int argc, char **argv);
int cli_info(int argc, char **argv);
int cli_render(int argc, char **argv);
int cli_dem(int argc, char **argv);
int cli_contours(int argc, char **argv);
int cli_mesh(int argc, char **argv);
int cli_evaluate(int argc, char **argv);
int cli_show(int argc, char **argv);
int cli_sim(int argc, char **argv);
int cli_ping(int argc, char **argv);

/* Print one sentence on stderr, "yamabiko VERB: …", and return CLI_FAILED or CLI_USAGE. */
int cli_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
int cli_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* After getopt_long has answered '?' or ':' (with opterr = 0 and a leading ':' in the short
 * options): says which option was wrong, returns CLI_USAGE.
 */
int cli_bad_option(int answer, int argc, char **argv);

/* Whole text to number; false unless all of it is one finite number. */
bool cli_number(const char *text, double *value);
bool cli_integer(const char *text, long low, long high, long *value);

#endif
