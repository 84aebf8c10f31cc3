/* The panels whose exact pixels `yamabiko render --panel` can show. */
#ifndef YB_PANEL_LIST_H
#define YB_PANEL_LIST_H

#include <yamabiko/yamabiko.h>

/* The screen of the panel of this name, or NULL. */
const yb_screen_t *yb_panel_list_screen(const char *name);

/* The i-th name, NULL beyond the last. */
const char *yb_panel_list_name(int which);

#endif
