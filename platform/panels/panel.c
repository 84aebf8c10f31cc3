#include "panel.h"

static const yb_panel_t *const panels[] = {&yb_panel_ssd0323};

const yb_panel_t *yb_panel_at(size_t index)
{
    return index < sizeof panels / sizeof panels[0] ? panels[index] : NULL;
}

/* Written out because freestanding C libraries of ours promise mem* only. */
static bool same_name(const char *a, const char *b)
{
    while (*a != '\0' && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

const yb_panel_t *yb_panel_find(const char *name)
{
    for (size_t i = 0; yb_panel_at(i) != NULL; i++) {
        if (same_name(yb_panel_at(i)->name, name))
            return yb_panel_at(i);
    }
    return NULL;
}
