/* Where labels still fit: a page in squares that are free or taken. Each question costs as many
 * steps as the label has squares, however many labels there are.
 */
#ifndef YB_LABEL_ROOM_H
#define YB_LABEL_ROOM_H

#include <stdbool.h>

typedef struct {
    int columns, rows;
    unsigned char *taken;
} yb_label_room_t;

/* A free page, in pixels. False: no memory. */
bool yb_label_room_init(yb_label_room_t *room, double width, double height);
void yb_label_room_free(yb_label_room_t *room);

/* Takes a rectangle round (x, y), if all of it is on the page and free. */
bool yb_label_room_take(yb_label_room_t *room, double x, double y, double width, double height);

/* Takes it, free or not. */
void yb_label_room_block(yb_label_room_t *room, double x, double y, double width, double height);

#endif
