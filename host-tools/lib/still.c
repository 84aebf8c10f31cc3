#include "still.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

bool yb_still_draw(yb_still_t *still, const yb_map_t *map, const yb_view_t *view,
                   const yb_screen_t *screen, uint16_t band_rows)
{
    const size_t pitch = yb_screen_pitch(screen);
    const uint16_t rows = band_rows == 0 || band_rows > screen->height ? screen->height : band_rows;
    *still = (yb_still_t){.view = *view, .screen = *screen};
    still->pixels = malloc(pitch * screen->height);
    yb_frame_t *frame = malloc(sizeof(*frame));
    uint16_t *depth = malloc((size_t)screen->width * rows * sizeof(*depth));
    const bool good = still->pixels != NULL && frame != NULL && depth != NULL;
    if (good) {
        yb_frame_begin(frame, map, view, screen);
        for (uint32_t y = 0; y < screen->height; y += rows) {
            /* The last band may be lower: there is no room for rows below the screen. */
            const uint32_t left = screen->height - y;
            const yb_band_t band = {.y = (uint16_t)y,
                                    .rows = (uint16_t)(left < rows ? left : rows),
                                    .depth = depth,
                                    .pixels = still->pixels + y * pitch,
                                    .pitch = pitch};
            yb_frame_band(frame, &band);
        }
        still->stats = frame->stats;
    } else {
        yb_still_free(still);
    }
    free(frame);
    free(depth);
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
    json_t *water = view->water_q8 == YB_NO_WATER ? json_null() : json_integer(view->water_q8);
    return json_pack("{s:[iii], s:[iii], s:i, s:i, s:i, s:i, s:[iii], s:b, s:o, s:I}", "eye_q8",
                     view->eye_q8[0], view->eye_q8[1], view->eye_q8[2], "look_q8", view->look_q8[0],
                     view->look_q8[1], view->look_q8[2], "azimuth_bam", view->azimuth_bam,
                     "zoom_q12", view->zoom_q12, "exaggerate_q8", view->exaggerate_q8, "edge_q4",
                     view->edge_q4, "sun_q14", view->sun_q14[0], view->sun_q14[1], view->sun_q14[2],
                     "walls", view->walls, "water_q8", water, "max_leaves",
                     (json_int_t)view->max_leaves);
}

json_t *yb_still_json(const yb_still_t *still)
{
    char hash[9];
    snprintf(hash, sizeof(hash), "%08" PRIx32, yb_still_hash(still));
    return json_pack("{s:o, s:{s:i, s:i, s:s}, s:{s:I, s:I, s:I}, s:s}", "view",
                     view_json(&still->view), "screen", "width", still->screen.width, "height",
                     still->screen.height, "format",
                     still->screen.format == YB_GREY4 ? "grey4" : "rgb565", "stats", "refined",
                     (json_int_t)still->stats.refined, "drawn", (json_int_t)still->stats.drawn,
                     "depth_limited", (json_int_t)still->stats.depth_limited, "fnv1a", hash);
}
