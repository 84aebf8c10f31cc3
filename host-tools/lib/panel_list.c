#include "panel_list.h"

#include <string.h>

static const struct {
    const char *name;
    yb_screen_t screen;
} panels[] = {
    {"ssd0323", {.width = 128, .height = 64, .format = YB_GREY4}},
};
enum {
    PANELS = sizeof(panels) / sizeof(panels[0])
};

const char *yb_panel_list_name(int which)
{
    return which >= 0 && which < PANELS ? panels[which].name : NULL;
}

const yb_screen_t *yb_panel_list_screen(const char *name)
{
    for (int i = 0; i < PANELS; i++) {
        if (strcmp(panels[i].name, name) == 0)
            return &panels[i].screen;
    }
    return NULL;
}
