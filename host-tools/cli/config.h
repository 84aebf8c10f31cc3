/* Options from an INI file (--config FILE), as if they stood on the command line before the others.
 *
 * A key is an option's long name and its value the option's; 'yes' gives an option that needs no
 * value and 'no' leaves it out; 'map = FILE' names a map. Sections only group; what follows ' ;' is
 * a comment. A line may have 198 characters.
 */
#ifndef YB_CLI_CONFIG_H
#define YB_CLI_CONFIG_H

#include <getopt.h>
#include <stdbool.h>

/* A command line that was made, to be freed by cli_config_free. */
typedef struct {
    int argc;
    char **argv;
} cli_config_t;

/* Puts the options of every --config of the command line in front of its own. CLI_OK, or it has
 * been said why not: CLI_FAILED (a file cannot be read), CLI_USAGE (it names no option, or one
 * without its value). */
int cli_config_read(cli_config_t *config, const struct option *options, int argc, char **argv);
void cli_config_free(cli_config_t *config);

#endif
