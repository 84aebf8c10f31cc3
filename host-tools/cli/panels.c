#include "panels.h"

#include <jansson.h>
#include <stdio.h>

#include "cli.h"
#include "view_options.h"

int cli_take_panel(const char *name, const yb_panel_t **panel)
{
    *panel = yb_panel_find(name);
    return *panel != NULL
               ? CLI_OK
               : cli_usage("there is no panel '%s'; 'yamabiko info --panel' lists them", name);
}

int cli_take_turn(const char *text, yb_turn_t *turn)
{
    long degrees = 0;
    if (!cli_integer(text, 0, 270, &degrees) || degrees % 90 != 0)
        return cli_usage("--turn: '%s' is not 0, 90, 180 or 270", text);
    *turn = (yb_turn_t)(degrees / 90);
    return CLI_OK;
}

static double frames_per_second(const yb_panel_t *panel)
{
    return panel->spi_hz / (8.0 * yb_panel_frame_bytes(panel));
}

static void print_line(const yb_panel_t *panel)
{
    char size[16], turns[16];
    int used = 0;
    snprintf(size, sizeof(size), "%ux%u", panel->screen.width, panel->screen.height);
    for (unsigned turn = 0; turn < 4; turn++) {
        if ((panel->turns >> turn & 1) != 0)
            used += snprintf(turns + used, sizeof(turns) - (size_t)used, "%s%u",
                             used > 0 ? " " : "", 90 * turn);
    }
    printf("%-16s %-8s %-7s %-13s %7.2f %8lu %7.1f  %s\n", panel->name, size,
           yb_format_names[panel->screen.format], turns, panel->spi_hz / 1e6,
           (unsigned long)yb_panel_frame_bytes(panel), frames_per_second(panel), panel->title);
}

static json_t *panel_json(const yb_panel_t *panel)
{
    json_t *turns = json_array();
    for (int turn = 0; turn < 4; turn++) {
        if ((panel->turns >> turn & 1) != 0)
            json_array_append_new(turns, json_integer(90 * turn));
    }
    return json_pack("{s:s, s:s, s:i, s:i, s:s, s:o, s:I, s:I, s:f, s:b}", "name", panel->name,
                     "title", panel->title, "width", panel->screen.width, "height",
                     panel->screen.height, "format", yb_format_names[panel->screen.format],
                     "chip_turns", turns, "spi_hz", (json_int_t)panel->spi_hz, "frame_bytes",
                     (json_int_t)yb_panel_frame_bytes(panel), "frames_per_second",
                     frames_per_second(panel), "dc", (panel->flags & YB_PANEL_NO_DC) == 0);
}

int cli_info_panels(char **names, int count, bool json)
{
    const yb_panel_t *panel = NULL;
    for (int i = 0; i < count; i++) {
        const int status = cli_take_panel(names[i], &panel);
        if (status != CLI_OK)
            return status;
    }
    json_t *root = json_array();
    if (!json)
        puts("panel            size     pixels  chip turns     clock    bytes  frames\n"
             "                                                  MHz  a frame    a s");
    const size_t panels = count > 0 ? (size_t)count : SIZE_MAX;
    for (size_t i = 0; i < panels; i++) {
        panel = count > 0 ? yb_panel_find(names[i]) : yb_panel_at(i);
        if (panel == NULL)
            break; /* the last of all */
        if (json)
            json_array_append_new(root, panel_json(panel));
        else
            print_line(panel);
    }
    if (json) {
        json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(8));
        putchar('\n');
    }
    json_decref(root);
    return CLI_OK;
}
