#include "turntable.h"

#define TEXT_OF(x) #x
#define NUMBER_TEXT(x) TEXT_OF(x)
#define VERSION_TEXT                                                                               \
    NUMBER_TEXT(YB_VERSION_MAJOR)                                                                  \
    "." NUMBER_TEXT(YB_VERSION_MINOR) "." NUMBER_TEXT(YB_VERSION_PATCH)

/* What the console's N turns by. */
#define STRIDE_STEPS 16

static void say(const yb_turntable_port_t *port, const char *text)
{
    while (*text != '\0')
        port->write(port->context, *text++);
}

/* Five digits, by subtraction: a division would link a helper on a Cortex-M0. */
static void say_decimal(const yb_turntable_port_t *port, uint16_t value)
{
    static const uint16_t powers[5] = {10000, 1000, 100, 10, 1};
    for (size_t i = 0; i < 5; i++) {
        char digit = '0';
        while (value >= powers[i]) {
            value = (uint16_t)(value - powers[i]);
            digit++;
        }
        port->write(port->context, digit);
    }
}

static void say_hex(const yb_turntable_port_t *port, uint32_t value)
{
    for (unsigned shift = 32; shift > 0;) {
        shift -= 4;
        port->write(port->context, "0123456789abcdef"[(value >> shift) & 15]);
    }
}

static void say_frame(const yb_turntable_t *table, const char *what)
{
    const yb_turntable_port_t *port = table->port;
    say(port, what);
    say(port, " azimuth=");
    say_decimal(port, table->azimuth_bam);
    say(port, " hash=");
    say_hex(port, table->hash);
    say(port, "\r\n");
}

/* Flash that was never written reads as ones, and as zeros in emulators: no code of any version
 * starts with two bytes of either.
 */
static bool slot_is_empty(const yb_turntable_port_t *port)
{
    uint8_t first = port->slot[0];
    return (first == 0x00 || first == 0xff) && port->slot[1] == first;
}

static void load_map(yb_turntable_t *table)
{
    const yb_turntable_port_t *port = table->port;
    const char *map = "slot";
    say(port, "yamabiko " VERSION_TEXT " ");
    say(port, port->board);
    say(port, " slot=");
    if (slot_is_empty(port)) {
        say(port, "empty");
        table->shown = false;
    } else {
        yb_status_t status = yb_viewer_load(&table->viewer, port->slot, port->slot_bytes);
        say(port, yb_status_text(status));
        table->shown = status == YB_OK;
    }
    if (!table->shown) {
        table->shown =
            yb_viewer_load(&table->viewer, port->built_in, port->built_in_bytes) == YB_OK;
        map = table->shown ? "built-in" : "none";
    }
    say(port, " map=");
    say(port, map);
    say(port, "\r\n");
}

static void draw(yb_turntable_t *table)
{
    if (!table->shown)
        return;
    const yb_turntable_port_t *port = table->port;
    table->hash = yb_viewer_draw(&table->viewer, table->azimuth_bam, port->band, port->context);
    if (port->report && !table->paused)
        say_frame(table, "frame");
}

static void draw_next(yb_turntable_t *table, unsigned steps)
{
    table->azimuth_bam = (uint16_t)(table->azimuth_bam + steps * YB_VIEWER_STEP_BAM);
    draw(table);
}

void yb_turntable_begin(yb_turntable_t *table, const yb_turntable_port_t *port)
{
    table->port = port;
    table->azimuth_bam = 0;
    table->hash = 0;
    table->paused = false;
    load_map(table);
    draw(table);
}

void yb_turntable_step(yb_turntable_t *table)
{
    const int command = table->port->read(table->port->context);
    switch (command) {
    case 'p':
        table->paused = true;
        say_frame(table, "paused");
        break;
    case 'n':
    case 'N':
        if (table->paused) {
            draw_next(table, command == 'N' ? STRIDE_STEPS : 1);
            say_frame(table, "paused");
        }
        break;
    case 's':
    case 'l':
        table->viewer.looks ^= command == 's' ? YB_VIEWER_SHADOWS : YB_VIEWER_LINES;
        draw(table);
        if (table->paused)
            say_frame(table, "paused");
        break;
    case 'r':
        table->paused = false;
        break;
    default:
        if (!table->paused)
            draw_next(table, 1);
        break;
    }
}
