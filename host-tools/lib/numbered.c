#include "numbered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Length of the number's conversion at text[0] == '%', 0 if it is none; its width in *width. */
static size_t number_length(const char *text, int *width)
{
    *width = 0;
    if (text[1] == 'd')
        return 2;
    if (text[1] != '0' || text[2] < '1' || text[2] > '9' || text[3] != 'd')
        return 0;
    *width = text[2] - '0';
    return 4;
}

bool yb_numbered_check(const char *pattern, yb_error_t *error)
{
    int numbers = 0;
    for (const char *at = pattern; (at = strchr(at, '%')) != NULL;) {
        int width = 0;
        const size_t length = number_length(at, &width);
        if (length == 0 && at[1] != '%')
            return yb_error_set(error,
                                "'%s' is no pattern of file names: only %%d, %%0Nd and %%%% may "
                                "follow a %% sign",
                                pattern);
        numbers += length != 0;
        at += length == 0 ? 2 : length;
    }
    if (numbers != 1)
        return yb_error_set(error, "'%s' must have exactly one %%d or %%0Nd, as in f-%%03d.png",
                            pattern);
    return true;
}

char *yb_numbered_name(const char *pattern, int number)
{
    const size_t room = strlen(pattern) + 16;
    char *name = malloc(room);
    size_t used = 0;
    if (name == NULL)
        return NULL;
    for (const char *at = pattern; *at != '\0';) {
        int width = 0;
        const size_t length = *at == '%' ? number_length(at, &width) : 0;
        if (length != 0) {
            used += (size_t)snprintf(name + used, room - used, "%0*d", width, number);
            at += length;
        } else {
            name[used++] = *at;
            at += *at == '%' ? 2 : 1;
        }
    }
    name[used] = '\0';
    return name;
}
