/* The player: maps in motion, frame by frame, onto an outlet.
 *
 *     yb_player_t *player = yb_player_new(&play, list);
 *     for (;;) {
 *         yb_player_draw(player, now_s, outlet, &stop);
 *         yb_outlet_finish(outlet);
 *         yb_player_act(player, act);      what a user wants
 *     }
 *
 * A map that cannot be read or drawn is told (by `tell`, once until its file changes) and passed
 * over; while there is none that can, the picture is black.
 */
#ifndef YB_PLAYER_H
#define YB_PLAYER_H

#include "error.h"
#include "map_list.h"
#include "outlet.h"
#include "view_options.h"

typedef enum {
    YB_ACT_NONE,
    YB_ACT_NEXT,     /* the next map */
    YB_ACT_PREVIOUS, /* the one before */
    YB_ACT_LEFT,     /* the camera goes a 24th round, or turns on foot and in the air */
    YB_ACT_RIGHT,
    YB_ACT_PAUSE,   /* or go on */
    YB_ACT_SHADOWS, /* on or off */
    YB_ACT_LINES,   /* contour lines on or off */
    YB_ACT_QUIT,    /* for the caller */
    YB_ACT_END
} yb_act_t;

/* "none", "next", …; NULL beyond the last. */
const char *yb_act_name(yb_act_t act);

typedef struct {
    yb_view_options_t view; /* its screen is the outlet's */
    double turn_deg;        /* the camera goes on clockwise by so much a frame */
    double sun_deg;         /* the sun by so much */
    double slide_s;         /* a map is shown for so many seconds; 0: until somebody asks */
    uint16_t band_rows;
    void (*tell)(const char *sentence);
} yb_play_t;

typedef struct yb_player yb_player_t;

/* The list must live as long; it may be updated, by yb_player_update. NULL: no memory. */
yb_player_t *yb_player_new(const yb_play_t *play, yb_map_list_t *list);
void yb_player_free(yb_player_t *player);

/* Draws the next frame, band by band, at a time in seconds of any clock. Stops between bands when
 * *stop is set. False: there is no map that can be drawn, and the frame is black. */
bool yb_player_draw(yb_player_t *player, double now_s, yb_outlet_t *outlet,
                    const volatile int *stop);

/* Does what a user wants; the next frame shows it. */
void yb_player_act(yb_player_t *player, yb_act_t act);

/* After a watched folder has changed. */
void yb_player_update(yb_player_t *player);

/* For how many seconds the picture stays as it is, if nobody acts: 0 if it moves or has become
 * another one since the last frame, infinity if it stays for ever. */
double yb_player_still_s(const yb_player_t *player, double now_s);

#endif
