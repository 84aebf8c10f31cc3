#include "still.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "view_options.h"

/* Casts the shadows of a view, in one block of memory with the grid. */
static yb_shadow_t *cast(const yb_map_t *map, const yb_view_t *view, uint16_t side)
{
    yb_shadow_t *shadow = malloc(sizeof(*shadow) + YB_SHADOW_BYTES(side));
    uint8_t *work = malloc(YB_SHADOW_WORK(side));
    if (shadow != NULL && work != NULL) {
        *shadow = (yb_shadow_t){.side = side, .lit = (uint8_t *)(shadow + 1)};
        yb_shadow_cast(map, view, shadow, work);
    } else {
        free(shadow);
        shadow = NULL;
    }
    free(work);
    return shadow;
}

static void draw(yb_still_t *still, const yb_map_t *map, yb_frame_t *frame, uint8_t *greys,
                 uint16_t rows)
{
    const yb_screen_t *screen = &still->screen;
    const size_t pitch = yb_screen_pitch(screen);
    yb_frame_begin(frame, map, &still->view, screen);
    for (uint32_t y = 0; y < screen->height; y += rows) {
        /* The last band may be lower: there is no room for rows below the screen. */
        const uint32_t left = screen->height - y;
        const yb_band_t band = {.y = (uint16_t)y,
                                .rows = (uint16_t)(left < rows ? left : rows),
                                .pixels = still->pixels + y * pitch,
                                .pitch = pitch,
                                .greys = greys};
        yb_frame_band(frame, &band);
    }
    still->stats = frame->stats;
}

bool yb_still_draw(yb_still_t *still, const yb_map_t *map, const yb_view_t *view,
                   const yb_screen_t *screen, uint16_t band_rows, uint16_t shadow_side)
{
    const uint16_t rows = band_rows == 0 || band_rows > screen->height ? screen->height : band_rows;
    *still = (yb_still_t){.view = *view, .screen = *screen, .shadow_side = shadow_side};
    still->pixels = malloc(yb_screen_pitch(screen) * screen->height);
    yb_frame_t *frame = malloc(sizeof(*frame));
    uint8_t *greys = malloc(yb_band_row_bytes(screen) * rows);
    yb_shadow_t *shadow = shadow_side > 0 ? cast(map, view, shadow_side) : NULL;
    still->view.shadow = shadow;
    const bool good = still->pixels != NULL && frame != NULL && greys != NULL &&
                      (shadow != NULL || shadow_side == 0);
    if (good)
        draw(still, map, frame, greys, rows);
    else
        yb_still_free(still);
    still->view.shadow = NULL;
    free(shadow);
    free(frame);
    free(greys);
    return good;
}

void yb_still_free(yb_still_t *still)
{
    free(still->pixels);
    still->pixels = NULL;
}

uint32_t yb_still_hash(const yb_still_t *still)
{
    const size_t size = yb_screen_pitch(&still->screen) * still->screen.height;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ still->pixels[i]) * 16777619u;
    return hash;
}

static json_t *view_json(const yb_view_t *view)
{
    json_t *lamp = view->lamp
                       ? json_pack("[iii]", view->lamp_q8[0], view->lamp_q8[1], view->lamp_q8[2])
                       : json_null();
    json_t *water = view->water_q8 == YB_NO_WATER ? json_null() : json_integer(view->water_q8);
    return json_pack(
        "{s:[iii], s:[iii], s:i, s:i, s:i, s:i, s:[iii], s:o, s:b, s:o, s:i, s:i, s:s, "
        "s:i, s:I}",
        "eye_q8", view->eye_q8[0], view->eye_q8[1], view->eye_q8[2], "look_q8", view->look_q8[0],
        view->look_q8[1], view->look_q8[2], "azimuth_bam", view->azimuth_bam, "zoom_q12",
        view->zoom_q12, "exaggerate_q8", view->exaggerate_q8, "edge_q4", view->edge_q4, "sun_q14",
        view->sun_q14[0], view->sun_q14[1], view->sun_q14[2], "lamp_q8", lamp, "walls", view->walls,
        "water_q8", water, "contour_q8", view->contour_q8, "contour_at_q8", view->contour_at_q8,
        "palette", yb_palette_names[view->palette], "haze_q8", view->haze_q8, "max_leaves",
        (json_int_t)view->max_leaves);
}

json_t *yb_still_json(const yb_still_t *still)
{
    char hash[9];
    snprintf(hash, sizeof(hash), "%08" PRIx32, yb_still_hash(still));
    return json_pack(
        "{s:o, s:{s:i, s:i, s:s}, s:{s:I, s:I}, s:i, s:s}", "view", view_json(&still->view),
        "screen", "width", still->screen.width, "height", still->screen.height, "format",
        yb_format_names[still->screen.format], "stats", "refined", (json_int_t)still->stats.refined,
        "drawn", (json_int_t)still->stats.drawn, "shadow_side", still->shadow_side, "fnv1a", hash);
}
