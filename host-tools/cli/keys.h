/* Keys of the terminal, each as it is pressed; only if the standard input is one, and ours to read.
 * It is as it was again after cli_keys_close, and when the program ends by exit. */
#ifndef YB_CLI_KEYS_H
#define YB_CLI_KEYS_H

#include "player.h"

/* The help's lines about them. */
extern const char cli_keys_help[];

/* What a key means; YB_ACT_NONE: nothing. Arrow keys come as 0x100 and up: see window.h. */
yb_act_t cli_keys_act(int key);

/* A descriptor that can be read when a key was pressed; -1: there is no terminal. */
int cli_keys_open(void);

/* The next key that was pressed, as an act; YB_ACT_NONE: none waits, or it means nothing. */
yb_act_t cli_keys_read(void);

void cli_keys_close(void);

#endif
