#include "panel.h"

#include <string.h>

static const yb_panel_t *const panels[] = {&yb_panel_ssd0323};

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
