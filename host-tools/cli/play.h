/* What verbs that play maps on a panel share (show, sim): options, those of the view among them,
 * and the loop over the frames. */
#ifndef YB_CLI_PLAY_H
#define YB_CLI_PLAY_H

#include <panel.h>

#include "player.h"

enum {
    CLI_PLAY_PANEL = 0x3000,
    CLI_PLAY_TURN,
    CLI_PLAY_ORBIT,
    CLI_PLAY_SPIN_SUN,
    CLI_PLAY_SLIDE,
    CLI_PLAY_FPS,
    CLI_PLAY_FRAMES,
    CLI_PLAY_BRIGHTNESS,
    CLI_PLAY_INVERT,
    CLI_PLAY_WHOLE,
    CLI_PLAY_STATS,
    CLI_PLAY_CONFIG,
    CLI_PLAY_END
};

/* clang-format off */
#define CLI_PLAY_LONG_OPTIONS                                           \
    {"panel", required_argument, NULL, CLI_PLAY_PANEL},                 \
    {"turn", required_argument, NULL, CLI_PLAY_TURN},                   \
    {"orbit", optional_argument, NULL, CLI_PLAY_ORBIT},                 \
    {"spin-sun", optional_argument, NULL, CLI_PLAY_SPIN_SUN},           \
    {"slide", required_argument, NULL, CLI_PLAY_SLIDE},                 \
    {"fps", required_argument, NULL, CLI_PLAY_FPS},                     \
    {"frames", required_argument, NULL, CLI_PLAY_FRAMES},               \
    {"brightness", required_argument, NULL, CLI_PLAY_BRIGHTNESS},       \
    {"invert", no_argument, NULL, CLI_PLAY_INVERT},                     \
    {"whole", no_argument, NULL, CLI_PLAY_WHOLE},                       \
    {"stats", no_argument, NULL, CLI_PLAY_STATS},                       \
    {"config", required_argument, NULL, CLI_PLAY_CONFIG},               \
    YB_VIEW_LONG_OPTIONS
/* clang-format on */

/* Starts as cli_play_default(). */
typedef struct {
    const yb_panel_t *panel;
    yb_turn_t turn;
    double orbit_deg, sun_deg; /* a frame */
    double slide_s, fps;
    long frames;     /* 0: no end */
    long brightness; /* percent; -1: as the panel starts */
    bool invert, whole, stats;
    yb_view_options_t view;
} cli_play_t;

cli_play_t cli_play_default(void);

extern const char cli_play_help[];

bool cli_play_owns(int answer);
int cli_play_take(cli_play_t *play, int answer, int argc, char **argv);

/* After the last option. CLI_OK or CLI_USAGE, said. */
int cli_play_check(cli_play_t *play);

/* A player of these maps. NULL: it has been said why not. */
yb_player_t *cli_play_player(const cli_play_t *play, yb_map_list_t *list);

/* Starts the display, with the brightness that is wanted. */
bool cli_play_start(const cli_play_t *play, yb_outlet_t *outlet);

/* Fewer rows than the screen, so that some are drawn while some are sent. */
uint16_t cli_play_band_rows(const cli_play_t *play);

/* Where the frames go. */
typedef struct {
    void *context;
    yb_outlet_t *outlet; /* started */
    /* What is wanted next, YB_ACT_NONE after so many milliseconds. */
    yb_act_t (*wait)(void *context, yb_player_t *player, int timeout_ms);
    /* A frame is on the display; false ends the play. NULL: nobody asks. */
    bool (*shown)(void *context);
    uint64_t (*bytes)(void *context); /* sent so far */
    volatile int *stop;               /* set when it is to end at once */
    bool hurry;                       /* time is counted by frames, and nobody waits for it */
} cli_stage_t;

/* What has been played, over any number of calls of cli_play_run. Starts as {0}. */
typedef struct {
    long frames;
    long told_frames;
    uint64_t bytes, told_bytes;
    double told_s;
    bool black; /* the last frame had no map */
} cli_played_t;

typedef enum {
    CLI_PLAY_DONE,    /* all frames, or somebody wanted the end */
    CLI_PLAY_BUS_LOST /* the bus can say why */
} cli_play_end_t;

cli_play_end_t cli_play_run(const cli_play_t *play, const cli_stage_t *stage, yb_player_t *player,
                            cli_played_t *played);

/* For --stats: one line of the whole. */
void cli_play_sum(const cli_play_t *play, const cli_played_t *played);

#endif
