/* Panels on the command line: which one, how it is turned, and `yamabiko info --panel`. */
#ifndef YB_CLI_PANELS_H
#define YB_CLI_PANELS_H

#include <stdbool.h>

#include <panel.h>

/* Values of --panel and --turn. CLI_OK or CLI_USAGE, said. */
int cli_take_panel(const char *name, const yb_panel_t **panel);
int cli_take_turn(const char *degrees, yb_turn_t *turn);

/* What is known of the named panels, or of all if there is no name. An exit code, said. */
int cli_info_panels(char **names, int count, bool json);

#endif
