#include "player.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "code_file.h"
#include "surface.h"

enum {
    STRIDE_DEG = 15,
    STANDARD_SUN_AZIMUTH = 315,
    STANDARD_SUN_ELEVATION = 30,
    STANDARD_SHADOWS = 64,
    LINES_MOST = 14,
};

struct yb_player {
    yb_play_t play;
    yb_map_list_t *list;
    size_t index;         /* of the map in the list */
    yb_code_file_t *file; /* NULL: not read yet, or none can be */
    size_t failures;      /* of maps, one after the other */
    double since_s;       /* when this map was first shown; negative: not yet */
    bool paused, changed;
    double lines_m; /* the interval that was asked for; 0: a round one of the map's own */
    bool lines, shadows;
    yb_frame_t *frame;
    uint8_t *greys;
    yb_shadow_t *shadow;
    uint8_t *shadow_work;
    bool shadow_cast; /* for this map and sun */
};

const char *yb_act_name(yb_act_t act)
{
    static const char *const names[YB_ACT_END] = {"none",  "next",    "previous", "left", "right",
                                                  "pause", "shadows", "lines",    "quit"};
    return act < YB_ACT_END ? names[act] : NULL;
}

static bool take_shadows(yb_player_t *player)
{
    const long asked = player->play.view.shadows;
    const uint16_t side = (uint16_t)(asked > 0 ? asked : STANDARD_SHADOWS);
    player->shadows = asked > 0;
    player->shadow = malloc(sizeof(*player->shadow) + YB_SHADOW_BYTES(side));
    player->shadow_work = malloc(YB_SHADOW_WORK(side));
    if (player->shadow == NULL || player->shadow_work == NULL)
        return false;
    *player->shadow = (yb_shadow_t){.side = side, .lit = (uint8_t *)(player->shadow + 1)};
    return true;
}

yb_player_t *yb_player_new(const yb_play_t *play, yb_map_list_t *list)
{
    yb_player_t *player = calloc(1, sizeof(*player));
    if (player == NULL)
        return NULL;
    player->play = *play;
    player->list = list;
    player->since_s = -1;
    player->changed = true;
    player->lines_m = play->view.contours_m;
    player->lines = player->lines_m > 0;
    if (!yb_view_options_given(&play->view, YB_OPTION_SUN)) {
        player->play.view.sun_deg[0] = STANDARD_SUN_AZIMUTH;
        player->play.view.sun_deg[1] = STANDARD_SUN_ELEVATION;
    }
    /* On foot and in the air the camera looks north unless it is told otherwise; then it can turn.
     */
    if ((yb_view_options_given(&play->view, YB_OPTION_WALK) ||
         yb_view_options_given(&play->view, YB_OPTION_FLY)) &&
        !yb_view_options_given(&play->view, YB_OPTION_AZIMUTH)) {
        player->play.view.azimuth_deg = 0;
        player->play.view.given |= 1u << (YB_OPTION_AZIMUTH - YB_OPTION_SIZE);
    }
    player->frame = malloc(sizeof(*player->frame));
    player->greys = malloc(yb_band_row_bytes(&play->view.screen) * play->band_rows);
    if (take_shadows(player) && player->frame != NULL && player->greys != NULL)
        return player;
    yb_player_free(player);
    return NULL;
}

void yb_player_free(yb_player_t *player)
{
    if (player == NULL)
        return;
    yb_code_file_free(player->file);
    free(player->frame);
    free(player->greys);
    free(player->shadow);
    free(player->shadow_work);
    free(player);
}

/* Another map, or the same one anew. */
static void go_to(yb_player_t *player, size_t index)
{
    yb_code_file_free(player->file);
    player->file = NULL;
    player->index = index;
    player->since_s = -1;
    player->shadow_cast = false;
    player->changed = true;
}

/* Forwards by so many maps, round and round. The only one is not read again: it may be the standard
 * input. */
static void go_on(yb_player_t *player, size_t by)
{
    const size_t count = yb_map_list_count(player->list);
    if (count > 1 || (count > 0 && player->index > 0))
        go_to(player, (player->index + by) % count);
}

/* 1, 2 or 5 times a power of ten, so that there are at most LINES_MOST, and the engine takes it. */
static double round_interval_m(const yb_map_t *map)
{
    const double cell_m = yb_map_cell_m(map);
    const double few_m = (map->high_q8 - map->low_q8) / 256.0 * cell_m / LINES_MOST;
    const double least = fmax(few_m, ceil(cell_m * YB_LEAST_CONTOUR_Q8 / 256));
    const double power = pow(10, floor(log10(fmax(least, 0.01))));
    const double steps[] = {1, 2, 5, 10};
    size_t i = 0;
    while (i < 3 && steps[i] * power < least)
        i++;
    return steps[i] * power;
}

static bool set_view(yb_player_t *player, yb_view_t *view, yb_error_t *error)
{
    yb_view_options_t options = player->play.view;
    yb_map_t *map = &player->file->map;
    options.azimuth_deg = fmod(options.azimuth_deg, 360);
    options.sun_deg[0] = fmod(options.sun_deg[0], 360);
    options.given |= 1u << (YB_OPTION_SUN - YB_OPTION_SIZE);
    options.contours_m = !player->lines        ? 0
                         : player->lines_m > 0 ? player->lines_m
                                               : round_interval_m(map);
    return yb_view_options_apply(&options, map, view, error);
}

/* Reads the map if need be, and makes its view. */
static bool prepare(yb_player_t *player, const char *path, yb_view_t *view, yb_error_t *error)
{
    if (player->file == NULL)
        player->file = yb_code_file_read(path, error);
    if (player->file == NULL || !set_view(player, view, error))
        return false;
    if (player->shadows && !view->lamp) {
        if (!player->shadow_cast)
            yb_shadow_cast(&player->file->map, view, player->shadow, player->shadow_work);
        player->shadow_cast = true;
        view->shadow = player->shadow;
    }
    return true;
}

/* The first map from here on that can be drawn, or none. When all have failed, they are not tried
 * again until the list changes or the user acts. */
static bool find_map(yb_player_t *player, yb_view_t *view)
{
    const size_t count = yb_map_list_count(player->list);
    yb_error_t error;
    while (player->failures < count) {
        if (prepare(player, yb_map_list_at(player->list, player->index), view, &error)) {
            player->failures = 0;
            return true;
        }
        if (yb_map_list_tell(player->list, player->index))
            player->play.tell(error.text);
        player->failures++;
        go_on(player, 1);
    }
    return false;
}

static void draw_bands(yb_player_t *player, const yb_view_t *view, yb_outlet_t *outlet,
                       const volatile int *stop)
{
    const yb_screen_t *screen = &player->play.view.screen;
    const size_t pitch = yb_screen_pitch(screen);
    if (view != NULL)
        yb_frame_begin(player->frame, &player->file->map, view, screen);
    for (uint32_t y = 0; y < screen->height && !*stop; y += player->play.band_rows) {
        const uint32_t left = screen->height - y;
        const uint16_t rows =
            (uint16_t)(left < player->play.band_rows ? left : player->play.band_rows);
        uint8_t *pixels = yb_outlet_band(outlet, (uint16_t)y);
        const yb_band_t band = {.y = (uint16_t)y,
                                .rows = rows,
                                .pixels = pixels,
                                .pitch = pitch,
                                .greys = player->greys};
        if (view != NULL)
            yb_frame_band(player->frame, &band);
        else
            memset(pixels, 0, rows * pitch);
        yb_outlet_send(outlet, (uint16_t)y, rows);
    }
}

static void move(yb_player_t *player)
{
    if (player->paused)
        return;
    player->play.view.azimuth_deg += player->play.turn_deg;
    player->play.view.sun_deg[0] += player->play.sun_deg;
    player->shadow_cast = player->shadow_cast && player->play.sun_deg == 0;
}

static bool slides(const yb_player_t *player)
{
    return player->play.slide_s > 0 && yb_map_list_count(player->list) > 1;
}

bool yb_player_draw(yb_player_t *player, double now_s, yb_outlet_t *outlet,
                    const volatile int *stop)
{
    yb_view_t view;
    if (slides(player) && player->since_s >= 0 && !player->paused &&
        now_s - player->since_s >= player->play.slide_s)
        go_on(player, 1);
    const bool found = find_map(player, &view);
    if (found && player->since_s < 0)
        player->since_s = now_s;
    draw_bands(player, found ? &view : NULL, outlet, stop);
    move(player);
    player->changed = false;
    return found;
}

void yb_player_act(yb_player_t *player, yb_act_t act)
{
    const size_t count = yb_map_list_count(player->list);
    if (act == YB_ACT_NONE || act == YB_ACT_QUIT)
        return;
    player->changed = true;
    player->failures = 0;
    switch (act) {
    case YB_ACT_NEXT:
    case YB_ACT_PREVIOUS:
        go_on(player, act == YB_ACT_NEXT ? 1 : count - 1);
        break;
    case YB_ACT_LEFT:
        player->play.view.azimuth_deg += STRIDE_DEG;
        break;
    case YB_ACT_RIGHT:
        player->play.view.azimuth_deg -= STRIDE_DEG;
        break;
    case YB_ACT_PAUSE:
        player->paused = !player->paused;
        break;
    case YB_ACT_SHADOWS:
        player->shadows = !player->shadows;
        break;
    case YB_ACT_LINES:
        player->lines = !player->lines;
        break;
    default:
        break;
    }
}

void yb_player_update(yb_player_t *player)
{
    size_t index = player->index;
    const yb_maps_change_t change = yb_map_list_update(player->list, &index);
    if (change == YB_MAPS_SAME)
        return;
    player->failures = 0;
    if (change == YB_MAPS_THIS || player->file == NULL)
        go_to(player, index);
    player->index = index;
}

double yb_player_still_s(const yb_player_t *player, double now_s)
{
    if (player->changed)
        return 0;
    if (player->paused || player->file == NULL)
        return HUGE_VAL;
    if (player->play.turn_deg != 0 || player->play.sun_deg != 0)
        return 0;
    return slides(player) ? fmax(player->since_s + player->play.slide_s - now_s, 0) : HUGE_VAL;
}
