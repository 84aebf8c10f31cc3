/* The paper profile: a header of whole bytes, a body of 12N + 20M + 8 bits (docs/SPEC.md 1.1, 1.2).
 * A state is one kind of field; bytes enter a bit buffer and a state runs when its bits are there.
 */
#include <yamabiko/rom.h>

#include "code.h"
#include "mesh.h"

enum state {
    FLAGS,
    CONTOURS,
    VERTICES,
    EAST,
    NORTH,
    CELL,
    UNIT,
    BASE,
    SEED,
    GAIN, /* the last of the header */
    FRAME_HEIGHTS,
    COUNTS,
    DIMENSION,
    HEIGHT,
    START,
    STEP,
    END
};

enum {
    FLAG_STRAIGHT = 4,
    FLAG_RESERVED = 8
};

static yb_status_t check_header(const yb_load_t *load)
{
    const yb_map_t *map = load->map;
    if ((load->flags & FLAG_RESERVED) != 0 || load->vertices_promised < 4 || map->east_q8 == 0 ||
        map->north_q8 == 0 || (map->cell & 0xfff) == 0 || (map->unit & 0xfff) == 0)
        return YB_ERR_CORRUPT;
#if YB_MAX_VERTICES < 255
    if (load->vertices_promised > YB_MAX_VERTICES)
        return YB_ERR_LIMIT;
#endif
    return YB_MORE;
}

static yb_status_t take_header(yb_load_t *load, uint32_t field)
{
    yb_map_t *map = load->map;
    switch ((enum state)load->state++) {
    case FLAGS:
        load->flags = field;
        map->smooth = (field & FLAG_STRAIGHT) == 0;
        break;
    case CONTOURS:
        load->contour_count = (uint16_t)field;
        break;
    case VERTICES:
        load->vertices_promised = (uint16_t)field;
        break;
    case EAST:
        map->east_q8 = (uint16_t)(field << 8);
        break;
    case NORTH:
        map->north_q8 = (uint16_t)(field << 8);
        break;
    case CELL:
        map->cell = (uint16_t)field;
        break;
    case UNIT:
        map->unit = (uint16_t)field;
        break;
    case BASE:
        map->base_m = (int16_t)field;
        break;
    case SEED:
        map->seed = (uint8_t)field;
        break;
    default:
        load->gain = (uint8_t)field;
        return check_header(load);
    }
    return YB_MORE;
}

/* One height per coded corner, or, if none is coded, one for the whole frame. */
static yb_status_t take_frame_height(yb_load_t *load, uint32_t coded)
{
    uint32_t corners = load->flags >> 4; /* SW SE NE NW from bit 3 down */
    int32_t height = (int32_t)coded;
    if (!settle_height(load->map, 0, &height))
        return YB_ERR_CORRUPT;
    if (corners == 0) {
        load->frame_height = height;
    } else {
        while ((corners & 8u >> load->at) == 0)
            load->at++;
        load->corner_height[load->at++] = height;
        if ((corners << load->at & 15) != 0)
            return YB_MORE;
    }
    load->at = 0;
    load->state = load->contour_count > 0 ? COUNTS : DIMENSION;
    return YB_MORE;
}

static yb_status_t take_count(yb_load_t *load, uint32_t count)
{
    yb_contour_t *contour = &load->contour[load->at++];
    contour->first = (yb_index_t)load->point_count;
    contour->count = (yb_index_t)count;
    load->point_count = (uint16_t)(load->point_count + count);
    if (count == 0 || load->point_count > load->vertices_promised)
        return YB_ERR_CORRUPT;
    if (load->at == load->contour_count) {
        load->at = 0;
        load->state = DIMENSION;
    }
    return YB_MORE;
}

/* The body has ended: what is left of its last byte must be zero. */
static yb_status_t end_body(yb_load_t *load)
{
    if ((load->bits & ((1u << load->bits_held) - 1)) != 0)
        return YB_ERR_CORRUPT;
    load->state = END;
    return YB_OK;
}

static yb_status_t take_dimension(yb_load_t *load, uint32_t d)
{
    load->map->hurst_q8m1 = (uint8_t)(255 - d); /* H = 2 - D = (256 - d) / 256 */
    load->state = HEIGHT;
    return load->contour_count > 0 ? YB_MORE : end_body(load);
}

/* A point has come: it lies in the frame or the code is corrupt. */
static yb_status_t take_point(yb_load_t *load, int32_t x, int32_t y)
{
    const yb_contour_t *contour = &load->contour[load->at];
    if (!add_point(load, x, y, load->vertex[contour->first].z_q8))
        return YB_ERR_CORRUPT;
    load->state = STEP;
    if (load->vertex_count < contour->first + contour->count)
        return YB_MORE;
    load->at++;
    load->state = HEIGHT;
    return load->at < load->contour_count ? YB_MORE : end_body(load);
}

static yb_status_t take_height(yb_load_t *load, uint32_t coded)
{
    int32_t *height = &load->vertex[load->vertex_count].z_q8;
    *height = (int32_t)coded;
    load->state = START;
    return settle_height(load->map, 0, height) ? YB_MORE : YB_ERR_CORRUPT;
}

/* Six bits as a signed number, times the coded shift. */
static int32_t difference(const yb_load_t *load, uint32_t six)
{
    return ((int32_t)((six & 63) ^ 32) - 32) * (1 << (load->flags & 3));
}

static yb_status_t take_step(yb_load_t *load, uint32_t twelve)
{
    const yb_vertex_t *last = &load->vertex[load->vertex_count - 1];
    return take_point(load, (last->x_q8 >> 8) + difference(load, twelve >> 6),
                      (last->y_q8 >> 8) + difference(load, twelve));
}

static yb_status_t take_field(yb_load_t *load, uint32_t field)
{
    if (load->state <= GAIN)
        return take_header(load, field);
    switch ((enum state)load->state) {
    case FRAME_HEIGHTS:
        return take_frame_height(load, field);
    case COUNTS:
        return take_count(load, field);
    case DIMENSION:
        return take_dimension(load, field);
    case HEIGHT:
        return take_height(load, field);
    case START:
        return take_point(load, (int32_t)(field >> 8), (int32_t)(field & 255));
    case STEP:
        return take_step(load, field);
    default:
        return YB_ERR_CORRUPT;
    }
}

yb_status_t paper_take(yb_load_t *load, uint8_t byte)
{
    static const uint8_t width[] YB_ROM = {
        [FLAGS] = 8,  [CONTOURS] = 8,  [VERTICES] = 8, [EAST] = 8,           [NORTH] = 8,
        [CELL] = 16,  [UNIT] = 16,     [BASE] = 16,    [SEED] = 8,           [GAIN] = 8,
        [COUNTS] = 8, [DIMENSION] = 8, [HEIGHT] = 16,  [FRAME_HEIGHTS] = 16, [START] = 16,
        [STEP] = 12,  [END] = 8,
    };
    load->bits = load->bits << 8 | byte; /* at most 15 bits held before, 23 now */
    load->bits_held += 8;
    yb_status_t status = YB_MORE;
    uint8_t bits = yb_rom_u8(&width[load->state]);
    while (status == YB_MORE && load->bits_held >= bits) {
        load->bits_held -= bits;
        status = take_field(load, load->bits >> load->bits_held & (((uint32_t)1 << bits) - 1));
        bits = yb_rom_u8(&width[load->state]);
    }
    return status;
}
