#include "window.h"

#include <SDL.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct yb_sim_window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    int width, height;
};

/* The most that leaves a quarter of the desktop free. */
static int fitting_scale(int width, int height)
{
    SDL_Rect desktop;
    if (SDL_GetDisplayUsableBounds(0, &desktop) != 0)
        return 1;
    const int across = desktop.w * 3 / 4 / width, down = desktop.h * 3 / 4 / height;
    const int scale = across < down ? across : down;
    return scale > 1 ? scale : 1;
}

static bool draw(yb_sim_window_t *window)
{
    return SDL_RenderClear(window->renderer) == 0 &&
           SDL_RenderCopy(window->renderer, window->texture, NULL, NULL) == 0 &&
           (SDL_RenderPresent(window->renderer), true);
}

/* SDL may take a video driver without a screen by itself, and nobody would see the window. */
static bool has_desktop(void)
{
    const char *driver = NULL;

    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        return false;
    driver = SDL_GetCurrentVideoDriver();
    if (getenv("SDL_VIDEODRIVER") != NULL ||
        (driver != NULL && strcmp(driver, "offscreen") != 0 && strcmp(driver, "dummy") != 0))
        return true;
    SDL_SetError("there is no desktop");
    return false;
}

static bool make(yb_sim_window_t *window, const char *title, int scale, bool full_screen)
{
    const Uint32 flags =
        SDL_WINDOW_RESIZABLE | (full_screen ? (Uint32)SDL_WINDOW_FULLSCREEN_DESKTOP : 0);

    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "nearest");
    window->window = SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                      window->width * scale, window->height * scale, flags);
    if (window->window == NULL)
        return false;
    window->renderer = SDL_CreateRenderer(window->window, -1, 0);
    if (window->renderer == NULL)
        return false;
    window->texture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGB24,
                                        SDL_TEXTUREACCESS_STREAMING, window->width, window->height);
    /* Whole squares only; black bars take the rest of the window. */
    return window->texture != NULL &&
           SDL_RenderSetLogicalSize(window->renderer, window->width, window->height) == 0 &&
           SDL_RenderSetIntegerScale(window->renderer, SDL_TRUE) == 0;
}

yb_sim_window_t *yb_sim_window_open(const char *title, int width, int height, int scale,
                                    bool full_screen, char *error)
{
    yb_sim_window_t *window = calloc(1, sizeof *window);

    if (window == NULL) {
        snprintf(error, YB_WINDOW_ERROR_BYTES, "out of memory");
        return NULL;
    }
    window->width = width;
    window->height = height;
    if (has_desktop() &&
        make(window, title, scale > 0 ? scale : fitting_scale(width, height), full_screen))
        return window;
    snprintf(error, YB_WINDOW_ERROR_BYTES, "no window can be opened here: %s", SDL_GetError());
    yb_sim_window_close(window);
    return NULL;
}

bool yb_sim_window_show(yb_sim_window_t *window, const uint8_t *samples, bool grey)
{
    void *texture = NULL;
    int pitch = 0;

    if (SDL_LockTexture(window->texture, NULL, &texture, &pitch) != 0)
        return false;
    for (int y = 0; y < window->height; y++) {
        uint8_t *row = (uint8_t *)texture + y * pitch;
        for (int i = 0; i < 3 * window->width; i++)
            row[i] = samples[grey ? i / 3 : i];
        samples += (grey ? 1 : 3) * window->width;
    }
    SDL_UnlockTexture(window->texture);
    return draw(window);
}

static void toggle_full_screen(yb_sim_window_t *window)
{
    const bool full = (SDL_GetWindowFlags(window->window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    (void)SDL_SetWindowFullscreen(window->window, full ? 0 : (Uint32)SDL_WINDOW_FULLSCREEN_DESKTOP);
}

static int key_of(yb_sim_window_t *window, SDL_Keycode key)
{
    switch (key) {
    case SDLK_LEFT:
        return YB_KEY_LEFT;
    case SDLK_RIGHT:
        return YB_KEY_RIGHT;
    case SDLK_UP:
        return YB_KEY_UP;
    case SDLK_DOWN:
        return YB_KEY_DOWN;
    case SDLK_F12:
        return YB_KEY_SHOT;
    case SDLK_ESCAPE:
        return YB_KEY_CLOSE;
    case SDLK_F11:
        toggle_full_screen(window);
        return YB_KEY_NONE;
    default:
        return YB_KEY_NONE;
    }
}

/* Characters come as text, so that layouts and shift are the desktop's affair. */
static int key_in(yb_sim_window_t *window, const SDL_Event *event)
{
    switch (event->type) {
    case SDL_QUIT:
        return YB_KEY_CLOSE;
    case SDL_KEYDOWN:
        return key_of(window, event->key.keysym.sym);
    case SDL_TEXTINPUT:
        return (unsigned char)event->text.text[0] < 0x80 ? event->text.text[0] : YB_KEY_NONE;
    case SDL_WINDOWEVENT:
        (void)draw(window); /* uncovered, or of another size */
        return YB_KEY_NONE;
    default:
        return YB_KEY_NONE;
    }
}

int yb_sim_window_wait(yb_sim_window_t *window, int timeout_ms)
{
    const Uint64 end = SDL_GetTicks64() + (Uint64)timeout_ms;
    SDL_Event event;

    for (;;) {
        const Uint64 now = SDL_GetTicks64();
        const int left = now < end ? (int)(end - now) : 0;
        if (SDL_WaitEventTimeout(&event, left) == 0)
            return YB_KEY_NONE;
        const int key = key_in(window, &event);
        if (key != YB_KEY_NONE)
            return key;
    }
}

void yb_sim_window_close(yb_sim_window_t *window)
{
    if (window == NULL)
        return;
    SDL_DestroyTexture(window->texture);
    SDL_DestroyRenderer(window->renderer);
    SDL_DestroyWindow(window->window);
    SDL_Quit();
    free(window);
}
