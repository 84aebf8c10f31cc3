/* `yamabiko info --panel`: what is known of the panels. */
#ifndef YB_CLI_INFO_PANEL_H
#define YB_CLI_INFO_PANEL_H

#include <stdbool.h>

/* Of the named panels, or of all if there is no name. An exit code, said. */
int cli_info_panels(char **names, int count, bool json);

#endif
