#include "outlet.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include <update.h>

enum {
    BANDS = 2 /* one is drawn while one is sent */
};

typedef struct {
    uint16_t y, rows;
    uint8_t *pixels;
} band_t;

struct yb_outlet {
    yb_display_t display;
    yb_update_t update;
    yb_screen_t screen; /* as drawn */
    yb_turn_t turn;     /* to be done here */
    uint8_t *drawn;     /* the whole picture before that turn, or NULL */
    uint8_t *turned;    /* and after it */
    band_t bands[BANDS];
    pthread_t thread;
    pthread_mutex_t mutex; /* of what follows */
    pthread_cond_t changed;
    unsigned drawn_bands, sent_bands; /* since it was opened; never more than BANDS apart */
    bool whole, failed, ends;
    bool ticks; /* the display has been started, and the bus is well */
    uint64_t ticked_ms;
    yb_outlet_clock_t clock;
};

static bool chip_can(const yb_panel_t *panel, yb_turn_t turn)
{
    return (panel->turns >> turn & 1) != 0;
}

static yb_display_t turned_display(const yb_panel_t *panel, yb_turn_t turn)
{
    return (yb_display_t){.panel = panel, .turn = turn};
}

yb_screen_t yb_outlet_screen(const yb_panel_t *panel, yb_turn_t turn)
{
    const yb_display_t display = turned_display(panel, turn);
    return yb_display_screen(&display);
}

uint16_t yb_outlet_step(const yb_panel_t *panel, yb_turn_t turn)
{
    const yb_display_t display = turned_display(panel, turn);
    return chip_can(panel, turn) ? yb_display_y_step(&display) : 1;
}

/* The last band of a picture that is turned here sends all of it. */
static bool send_band(yb_outlet_t *outlet, const band_t *band, bool whole)
{
    bool (*const send)(yb_update_t *, uint16_t, uint16_t, const uint8_t *) =
        whole ? yb_update_rows_whole : yb_update_rows;

    if (outlet->drawn == NULL)
        return send(&outlet->update, band->y, band->rows, band->pixels);
    if (band->y + band->rows < outlet->screen.height)
        return true;
    yb_turn_picture(&outlet->screen, outlet->turn, outlet->drawn, outlet->turned);
    return send(&outlet->update, 0, yb_display_screen(&outlet->display).height, outlet->turned);
}

static uint64_t real_ms(void *context)
{
    struct timespec time;
    (void)context;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (uint64_t)time.tv_sec * 1000 + (uint64_t)time.tv_nsec / 1000000;
}

static struct timespec after_ms(uint32_t ms)
{
    const uint64_t due = real_ms(NULL) + ms;
    return (struct timespec){.tv_sec = (time_t)(due / 1000),
                             .tv_nsec = (long)(due % 1000) * 1000000};
}

/* With the mutex: what the panel must hear regularly, if it is time for it. */
static void tick(yb_outlet_t *outlet)
{
    const uint32_t tick_ms = outlet->display.panel->tick_ms;
    const uint64_t now_ms = outlet->clock.now_ms(outlet->clock.context);

    if (!outlet->ticks || tick_ms == 0 || now_ms - outlet->ticked_ms < tick_ms)
        return;
    outlet->ticked_ms = now_ms;
    if (!yb_display_tick(&outlet->display)) {
        outlet->failed = true;
        outlet->ticks = false;
    }
}

/* With the mutex: waits for a band or the end. */
static void wait_for_work(yb_outlet_t *outlet)
{
    const uint32_t tick_ms = outlet->display.panel->tick_ms;

    for (;;) {
        tick(outlet);
        if (outlet->sent_bands != outlet->drawn_bands || outlet->ends)
            return;
        if (tick_ms == 0 || !outlet->ticks) {
            pthread_cond_wait(&outlet->changed, &outlet->mutex);
        } else {
            const struct timespec due = after_ms(tick_ms / 2);
            pthread_cond_timedwait(&outlet->changed, &outlet->mutex, &due);
        }
    }
}

static void *run(void *context)
{
    yb_outlet_t *outlet = context;

    pthread_mutex_lock(&outlet->mutex);
    for (;;) {
        wait_for_work(outlet);
        if (outlet->ends)
            break;
        const band_t band = outlet->bands[outlet->sent_bands % BANDS];
        const bool whole = outlet->whole;
        bool good = !outlet->failed; /* nothing more after a failure */
        pthread_mutex_unlock(&outlet->mutex);
        good = good && send_band(outlet, &band, whole);
        pthread_mutex_lock(&outlet->mutex);
        outlet->failed = !good;
        outlet->sent_bands++;
        pthread_cond_broadcast(&outlet->changed);
    }
    pthread_mutex_unlock(&outlet->mutex);
    return NULL;
}

static bool begin(yb_outlet_t *outlet)
{
    pthread_condattr_t clock;

    if (pthread_condattr_init(&clock) != 0)
        return false;
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&outlet->changed, &clock);
    pthread_condattr_destroy(&clock);
    pthread_mutex_init(&outlet->mutex, NULL);
    if (pthread_create(&outlet->thread, NULL, run, outlet) == 0)
        return true;
    pthread_mutex_destroy(&outlet->mutex);
    pthread_cond_destroy(&outlet->changed);
    return false;
}

static void free_memory(yb_outlet_t *outlet)
{
    for (int i = 0; i < BANDS; i++)
        free(outlet->bands[i].pixels);
    free(outlet->update.shown);
    free(outlet->drawn);
    free(outlet->turned);
    free(outlet);
}

/* A picture that is turned here is drawn into one piece of memory, its bands at their places. */
static bool take_memory(yb_outlet_t *outlet, uint16_t band_rows)
{
    const size_t pitch = yb_screen_pitch(&outlet->screen);
    const yb_screen_t shown = yb_display_screen(&outlet->display);
    const size_t bytes = yb_screen_pitch(&shown) * shown.height;

    outlet->update.shown = calloc(1, bytes);
    if (outlet->turn != YB_TURN_0) {
        outlet->drawn = calloc(outlet->screen.height, pitch);
        outlet->turned = calloc(1, bytes);
        return outlet->update.shown != NULL && outlet->drawn != NULL && outlet->turned != NULL;
    }
    bool good = outlet->update.shown != NULL;
    for (int i = 0; i < BANDS; i++) {
        outlet->bands[i].pixels = calloc(band_rows, pitch);
        good = good && outlet->bands[i].pixels != NULL;
    }
    return good;
}

yb_outlet_t *yb_outlet_open(const yb_panel_t *panel, yb_turn_t turn, const yb_panel_bus_t *bus,
                            uint16_t band_rows, const yb_outlet_clock_t *clock)
{
    yb_outlet_t *outlet = calloc(1, sizeof(*outlet));
    if (outlet == NULL)
        return NULL;
    outlet->screen = yb_outlet_screen(panel, turn);
    outlet->turn = chip_can(panel, turn) ? YB_TURN_0 : turn;
    outlet->display = (yb_display_t){
        .panel = panel, .bus = bus, .turn = outlet->turn == YB_TURN_0 ? turn : YB_TURN_0};
    outlet->update.display = &outlet->display;
    outlet->clock = clock != NULL ? *clock : (yb_outlet_clock_t){.now_ms = real_ms};
    if (take_memory(outlet, band_rows) && begin(outlet))
        return outlet;
    free_memory(outlet);
    return NULL;
}

bool yb_outlet_start(yb_outlet_t *outlet)
{
    pthread_mutex_lock(&outlet->mutex);
    outlet->failed = false;
    outlet->whole = true;
    outlet->ticks = yb_display_start(&outlet->display);
    outlet->ticked_ms = outlet->clock.now_ms(outlet->clock.context);
    const bool good = outlet->ticks;
    pthread_cond_broadcast(&outlet->changed);
    pthread_mutex_unlock(&outlet->mutex);
    return good;
}

bool yb_outlet_blank(yb_outlet_t *outlet)
{
    /* A start clears. */
    if (outlet->display.panel->driver->sleep == NULL)
        return yb_outlet_start(outlet);
    pthread_mutex_lock(&outlet->mutex);
    const bool good = yb_display_sleep(&outlet->display, true);
    pthread_mutex_unlock(&outlet->mutex);
    return good;
}

bool yb_outlet_well(yb_outlet_t *outlet)
{
    pthread_mutex_lock(&outlet->mutex);
    const bool well = !outlet->failed;
    pthread_mutex_unlock(&outlet->mutex);
    return well;
}

bool yb_outlet_set_brightness(yb_outlet_t *outlet, uint8_t level)
{
    pthread_mutex_lock(&outlet->mutex);
    const bool good = yb_display_brightness(&outlet->display, level);
    pthread_mutex_unlock(&outlet->mutex);
    return good;
}

bool yb_outlet_invert(yb_outlet_t *outlet, bool inverted)
{
    pthread_mutex_lock(&outlet->mutex);
    const bool good = yb_display_invert(&outlet->display, inverted);
    pthread_mutex_unlock(&outlet->mutex);
    return good;
}

void yb_outlet_refresh(yb_outlet_t *outlet)
{
    pthread_mutex_lock(&outlet->mutex);
    outlet->whole = true;
    pthread_mutex_unlock(&outlet->mutex);
}

uint8_t *yb_outlet_band(yb_outlet_t *outlet, uint16_t y)
{
    if (outlet->drawn != NULL)
        return outlet->drawn + y * yb_screen_pitch(&outlet->screen);
    pthread_mutex_lock(&outlet->mutex);
    while (outlet->drawn_bands - outlet->sent_bands == BANDS)
        pthread_cond_wait(&outlet->changed, &outlet->mutex);
    uint8_t *pixels = outlet->bands[outlet->drawn_bands % BANDS].pixels;
    pthread_mutex_unlock(&outlet->mutex);
    return pixels;
}

void yb_outlet_send(yb_outlet_t *outlet, uint16_t y, uint16_t rows)
{
    pthread_mutex_lock(&outlet->mutex);
    while (outlet->drawn_bands - outlet->sent_bands == BANDS)
        pthread_cond_wait(&outlet->changed, &outlet->mutex);
    band_t *band = &outlet->bands[outlet->drawn_bands % BANDS];
    band->y = y;
    band->rows = rows;
    outlet->drawn_bands++;
    pthread_cond_broadcast(&outlet->changed);
    pthread_mutex_unlock(&outlet->mutex);
}

bool yb_outlet_finish(yb_outlet_t *outlet)
{
    pthread_mutex_lock(&outlet->mutex);
    while (outlet->sent_bands != outlet->drawn_bands)
        pthread_cond_wait(&outlet->changed, &outlet->mutex);
    outlet->failed = outlet->failed || !yb_display_finish(&outlet->display);
    const bool good = !outlet->failed;
    outlet->whole = outlet->whole && !good;
    outlet->ticks = outlet->ticks && good;
    pthread_mutex_unlock(&outlet->mutex);
    return good;
}

void yb_outlet_close(yb_outlet_t *outlet)
{
    if (outlet == NULL)
        return;
    pthread_mutex_lock(&outlet->mutex);
    outlet->ends = true;
    pthread_cond_broadcast(&outlet->changed);
    pthread_mutex_unlock(&outlet->mutex);
    pthread_join(outlet->thread, NULL);
    pthread_mutex_destroy(&outlet->mutex);
    pthread_cond_destroy(&outlet->changed);
    free_memory(outlet);
}
