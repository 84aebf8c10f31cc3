#include "label_room.h"

#include <math.h>
#include <stdlib.h>

/* Pixels a square: small against letters. */
static const double square = 3;

bool yb_label_room_init(yb_label_room_t *room, double width, double height)
{
    room->columns = (int)(width / square);
    room->rows = (int)(height / square);
    room->taken = calloc((size_t)room->columns * (size_t)room->rows + 1, 1);
    return room->taken != NULL;
}

void yb_label_room_free(yb_label_room_t *room)
{
    free(room->taken);
    *room = (yb_label_room_t){0};
}

typedef struct {
    int left, top, right, bottom; /* the last ones do not belong to it */
} box_t;

static box_t box_round(double x, double y, double width, double height)
{
    return (box_t){(int)floor((x - width / 2) / square), (int)floor((y - height / 2) / square),
                   (int)ceil((x + width / 2) / square), (int)ceil((y + height / 2) / square)};
}

void yb_label_room_block(yb_label_room_t *room, double x, double y, double width, double height)
{
    const box_t box = box_round(x, y, width, height);
    for (int j = box.top < 0 ? 0 : box.top; j < box.bottom && j < room->rows; j++)
        for (int i = box.left < 0 ? 0 : box.left; i < box.right && i < room->columns; i++)
            room->taken[j * room->columns + i] = 1;
}

bool yb_label_room_take(yb_label_room_t *room, double x, double y, double width, double height)
{
    const box_t box = box_round(x, y, width, height);
    if (box.left < 0 || box.top < 0 || box.right > room->columns || box.bottom > room->rows)
        return false;
    for (int j = box.top; j < box.bottom; j++)
        for (int i = box.left; i < box.right; i++)
            if (room->taken[j * room->columns + i] != 0)
                return false;
    yb_label_room_block(room, x, y, width, height);
    return true;
}
