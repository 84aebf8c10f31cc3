#include "keys.h"

#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <window.h>

const char cli_keys_help[] = "  left, right         turn the camera\n"
                             "  n, b                next map, map before\n"
                             "  space or p          pause, go on\n"
                             "  s, l                shadows, contour lines: on or off\n"
                             "  q                   end\n";

static struct termios before, now;
static bool changed;

yb_act_t cli_keys_act(int key)
{
    switch (key) {
    case YB_KEY_LEFT:
        return YB_ACT_LEFT;
    case YB_KEY_RIGHT:
        return YB_ACT_RIGHT;
    case 'n':
        return YB_ACT_NEXT;
    case 'b':
        return YB_ACT_PREVIOUS;
    case ' ':
    case 'p':
        return YB_ACT_PAUSE;
    case 's':
        return YB_ACT_SHADOWS;
    case 'l':
        return YB_ACT_LINES;
    case 'q':
    case YB_KEY_CLOSE:
        return YB_ACT_QUIT;
    default:
        return YB_ACT_NONE;
    }
}

void cli_keys_close(void)
{
    if (changed)
        (void)tcsetattr(STDIN_FILENO, TCSANOW, &before);
    changed = false;
}

/* In the background the terminal is somebody else's. */
static bool in_front(void)
{
    return tcgetpgrp(STDIN_FILENO) == getpgrp();
}

/* After a stop (Ctrl-Z) the shell has set the terminal as it likes it. */
static void on_continue(int signal)
{
    (void)signal;
    if (changed && in_front())
        (void)tcsetattr(STDIN_FILENO, TCSANOW, &now);
}

int cli_keys_open(void)
{
    static bool registered;
    const struct sigaction again = {.sa_handler = on_continue, .sa_flags = SA_RESTART};
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    if (isatty(STDIN_FILENO) == 0 || !in_front() || tcgetattr(STDIN_FILENO, &before) != 0)
        return -1;
    now = before;
    now.c_lflag &= (tcflag_t) ~(ICANON | ECHO);
    now.c_cc[VMIN] = 0;
    now.c_cc[VTIME] = 0;
    if (!registered)
        registered = atexit(cli_keys_close) == 0;
    /* Restoring the terminal from the background must not stop us. */
    if (!registered || sigaction(SIGTTOU, &ignore, NULL) != 0 ||
        sigaction(SIGCONT, &again, NULL) != 0 || tcsetattr(STDIN_FILENO, TCSANOW, &now) != 0)
        return -1;
    changed = true;
    return STDIN_FILENO;
}

/* Arrows come as Escape, [ and a letter. */
yb_act_t cli_keys_read(void)
{
    unsigned char byte = 0;
    unsigned char arrow[2] = {0};
    if (!changed || read(STDIN_FILENO, &byte, 1) != 1)
        return YB_ACT_NONE;
    if (byte != 0x1B)
        return cli_keys_act(byte);
    if (read(STDIN_FILENO, arrow, sizeof(arrow)) != (ssize_t)sizeof(arrow) || arrow[0] != '[')
        return YB_ACT_NONE;
    return cli_keys_act(arrow[1] == 'D' ? YB_KEY_LEFT : arrow[1] == 'C' ? YB_KEY_RIGHT : 0);
}
