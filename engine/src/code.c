/* The decoder: a state machine that takes a code byte by byte (docs/SPEC.md section 1).
 *
 * This is the container: the first byte says by which profile the relief is coded, sections may
 * follow it, a check byte ends it all. Points go straight into the map's vertices; nothing else of
 * the code is kept. What the bytes claim is checked as soon as it is known, so that a bad code is
 * refused early and every index is in range.
 */
#include "code.h"

#include <stddef.h>
#include <string.h>

#include "fix.h"
#include "mesh.h"

enum part {
    FIRST,
    RELIEF,
    SECTION_HEAD,
    SECTION_SIZE_HIGH,
    SECTION_SIZE_LOW,
    SECTION_BODY,
    CHECK
};

APART void attach(yb_load_t *load, yb_map_t *map)
{
    load->map = map;
    load->vertex = map->vertex;
    load->across = map->across;
    load->corners = map->triangle[0];
    load->scratch = &load->scratch_memory;
}

void yb_map_begin(yb_map_t *map, yb_load_t *load)
{
    /* All but the arrays, which may be large and are written before they are read. */
    memset(map, 0, offsetof(yb_map_t, vertex));
    memset(load, 0, offsetof(yb_load_t, contour));
    map->detail = true;
    attach(load, map);
    load->vertices_promised = YB_MAX_VERTICES;
    for (int i = 0; i < 4; i++)
        load->corner_height[i] = UNKNOWN_HEIGHT;
    load->result = YB_MORE;
}

yb_status_t yb_map_build(yb_map_t *map, yb_load_t *load)
{
    attach(load, map);
    load->vertex_count = load->point_count;
    if (!border_close(load) || !mesh_triangulate(load))
        return YB_ERR_CORRUPT;
    regions_find(load);
    if (!summits_add(load) || !links_add(load) || !skeleton_add(load))
        return YB_ERR_LIMIT;
    map->vertex_count = load->vertex_count;
    relief_prepare(load);
    return YB_OK;
}

/* Rounded to the nearest: ⌊(256 z + cell / 2) / cell⌋, all doubled. Units are within 2^30, a unit
 * is below 2^20 64ths of a metre: 2^59 with the fraction bits. Counted from the lowest height, so
 * that the division rounds down.
 */
bool settle_height(const yb_map_t *map, uint32_t rest_64th_m, int32_t *height)
{
    const uint32_t most = 2 * (uint32_t)YB_MAX_HEIGHT_Q8;
    int32_t cell = (int32_t)yb_unit_64th_m(map->cell);
    int64_t z_64th_m = fix_add(rest_64th_m, *height, (int32_t)yb_unit_64th_m(map->unit));
    int64_t above = fix_add(z_64th_m * 512, cell, (int32_t)most + 1);
    /* What is below the lowest height is, as an unsigned number, beyond the highest. */
    uint32_t z_q8 = fix_share((uint64_t)above, 2 * (uint32_t)cell, most + 1);
    *height = (int32_t)z_q8 - YB_MAX_HEIGHT_Q8;
    return z_q8 <= most;
}

/* CRC-8, polynomial x^8 + x^2 + x + 1. */
static uint8_t crc8(unsigned crc, uint8_t byte)
{
    crc ^= byte;
    for (int i = 0; i < 8; i++) {
        crc <<= 1;
        if (crc >> 8 != 0)
            crc ^= 0x107;
    }
    return (uint8_t)crc;
}

bool add_point(yb_load_t *load, int32_t x, int32_t y, int32_t units)
{
    const yb_map_t *map = load->map;
    yb_vertex_t point;
    /* As unsigned numbers, what is below zero is far beyond the other sides. */
    if ((uint32_t)x > map->east_q8 >> 8 || (uint32_t)y > map->north_q8 >> 8)
        return false;
    point.x_q8 = (uint16_t)(x << 8);
    point.y_q8 = (uint16_t)(y << 8);
    point.z_q8 = units;
    return mesh_add_vertex(load, &point);
}

static enum part after_section(const yb_load_t *load)
{
    return (load->section & SECTION_LAST) != 0 ? CHECK : SECTION_HEAD;
}

static yb_status_t take_first(yb_load_t *load, uint8_t byte)
{
    load->profile = byte & 15;
    if (byte >> 4 != YB_FORMAT_VERSION || load->profile > YB_COMPACT)
        return YB_ERR_VERSION;
    load->section = SECTION_LAST; /* unless the relief says that some follow */
    if (load->profile == YB_COMPACT)
        compact_begin(load);
    load->part = RELIEF;
    return YB_MORE;
}

/* One byte of a section: kept if somebody wants it, else skipped. */
static void take_section_byte(yb_load_t *load, uint8_t byte)
{
    if ((load->section >> 4 & 7) == YB_SECTION_CERTIFICATE && load->section_at < 2)
        *(load->section_at == 0 ? &load->map->certified_error : &load->map->certified_k) = byte;
    load->section_at++;
}

/* What follows the relief. */
static yb_status_t take_tail(yb_load_t *load, uint8_t byte)
{
    switch ((enum part)load->part) {
    case SECTION_HEAD:
        load->section = byte;
        load->section_size = byte & 15;
        load->section_at = 0;
        load->part = load->section_size == SECTION_LONG ? SECTION_SIZE_HIGH : SECTION_BODY;
        break;
    case SECTION_SIZE_HIGH:
    case SECTION_SIZE_LOW: /* what stood there before is shifted out */
        load->section_size = (uint16_t)(load->section_size << 8 | byte);
        load->part++;
        break;
    case SECTION_BODY:
        take_section_byte(load, byte);
        break;
    default:
        return load->crc != 0 ? YB_ERR_CORRUPT : yb_map_build(load->map, load);
    }
    if (load->part == SECTION_BODY && load->section_at == load->section_size)
        load->part = (uint8_t)after_section(load);
    return YB_MORE;
}

APART yb_status_t take_byte(yb_load_t *load, uint8_t byte)
{
    load->crc = crc8(load->crc, byte);
    load->size++;
    if (load->part == FIRST)
        return take_first(load, byte);
    if (load->part != RELIEF)
        return take_tail(load, byte);
    bool compact = load->profile == YB_COMPACT;
    yb_status_t status = compact ? compact_take(load, byte) : paper_take(load, byte);
    if (status != YB_OK)
        return status;
    load->part = (uint8_t)after_section(load);
    /* The compact profile has read one byte ahead. */
    load->relief_size = (uint16_t)(load->size - (compact ? 1 : 0));
    return compact ? take_tail(load, byte) : YB_MORE;
}

yb_status_t yb_map_feed(yb_map_t *map, yb_load_t *load, const uint8_t *bytes, size_t count)
{
    attach(load, map);
    for (size_t i = 0; i < count; i++) {
        if (load->result == YB_OK)
            load->result = YB_ERR_CORRUPT; /* a byte after the end */
        else if (load->result == YB_MORE)
            load->result = take_byte(load, bytes[i]);
    }
    return load->result;
}

yb_status_t yb_map_end(yb_map_t *map, yb_load_t *load)
{
    (void)map;
    if (load->result == YB_MORE)
        load->result = YB_ERR_TRUNCATED;
    return load->result;
}

yb_status_t yb_map_load(yb_map_t *map, yb_load_t *load, const uint8_t *bytes, size_t count)
{
    yb_map_begin(map, load);
    yb_status_t status = yb_map_feed(map, load, bytes, count);
    return status == YB_MORE ? yb_map_end(map, load) : status;
}

/* Sixteen steps an octave from 1/4 m on: 2^6 is that in 1/256 m, 255 gives below 2^22. */
uint16_t yb_certified_error_m(uint8_t certified_error)
{
    int32_t exponent_q11 = 6 * 2048 + 128 * ((int32_t)certified_error - 1);
    return (uint16_t)(certified_error == 0 ? 0 : (fix_exp2_q11(exponent_q11) + 255) >> 8);
}

const char *yb_status_text(yb_status_t status)
{
    switch (status) {
    case YB_OK:
        return "ok";
    case YB_MORE:
        return "more";
    case YB_ERR_TRUNCATED:
        return "truncated";
    case YB_ERR_CORRUPT:
        return "corrupt";
    case YB_ERR_VERSION:
        return "version";
    case YB_ERR_LIMIT:
        return "limit";
    }
    return "unknown";
}
