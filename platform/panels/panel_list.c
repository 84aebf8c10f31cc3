#include "panel.h"

#include <string.h>

static const yb_panel_t *const panels[] = {
    &yb_panel_ssd0323,        &yb_panel_ssd1306,        &yb_panel_ssd1306_128x32,
    &yb_panel_ssd1351,        &yb_panel_ssd1351_128x96, &yb_panel_st7735,
    &yb_panel_st7735_80x160,  &yb_panel_st7735_128x128, &yb_panel_st7789,
    &yb_panel_st7789_240x320, &yb_panel_st7789_135x240, &yb_panel_ili9341,
    &yb_panel_gc9a01,         &yb_panel_ls013b7dh03,    &yb_panel_ls013b7dh05,
    &yb_panel_ls027b7dh01,
};

const yb_panel_t *yb_panel_at(size_t index)
{
    return index < sizeof panels / sizeof panels[0] ? panels[index] : NULL;
}

const yb_panel_t *yb_panel_find(const char *name)
{
    for (size_t i = 0; yb_panel_at(i) != NULL; i++) {
        if (strcmp(yb_panel_at(i)->name, name) == 0)
            return yb_panel_at(i);
    }
    return NULL;
}
