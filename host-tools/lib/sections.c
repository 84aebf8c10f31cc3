#include "sections.h"

#include <math.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "code.h"
#include "fix.h"

enum {
    ANGLE_BITS = 24,
    LEAST_AFTER_ASCII = 0xa0 /* controls lie below, as below the space */
};

typedef struct {
    uint8_t *bytes; /* NULL: only count them */
    size_t count;
    size_t last; /* where the last section begins */
} writer_t;

static void put_byte(writer_t *writer, unsigned value)
{
    if (writer->bytes != NULL)
        writer->bytes[writer->count] = (uint8_t)value;
    writer->count++;
}

static void put_head(writer_t *writer, int kind, size_t count)
{
    writer->last = writer->count;
    put_byte(writer, (unsigned)kind << 4 | (unsigned)(count < SECTION_LONG ? count : SECTION_LONG));
    if (count >= SECTION_LONG) {
        put_byte(writer, (unsigned)count >> 8);
        put_byte(writer, (unsigned)count & 0xff);
    }
}

/* An angle as a share of its range, a whole number of 24 bits with its sign. */
static void put_angle(writer_t *writer, double degrees, double range_deg, bool turns)
{
    long most = (1L << (ANGLE_BITS - 1)) - 1;
    long value = lround(degrees / range_deg * (1 << ANGLE_BITS));
    if (!turns && value > most)
        value = most;
    for (int shift = ANGLE_BITS - 8; shift >= 0; shift -= 8)
        put_byte(writer, (unsigned)((unsigned long)value >> shift & 0xff));
}

static double get_angle(const uint8_t *bytes, double range_deg)
{
    int32_t value = (int32_t)bytes[0] << 16 | bytes[1] << 8 | bytes[2];
    if (value >= 1 << (ANGLE_BITS - 1))
        value -= 1 << ANGLE_BITS;
    return value * range_deg / (1 << ANGLE_BITS);
}

static void put_sections(writer_t *writer, const yb_sections_t *sections)
{
    size_t length = strlen(sections->name);
    if (sections->certified) {
        put_head(writer, YB_SECTION_CERTIFICATE, YB_CERTIFICATE_BYTES);
        put_byte(writer, sections->error);
        put_byte(writer, sections->k);
    }
    if (sections->placed) {
        put_head(writer, YB_SECTION_PLACE, YB_PLACE_BYTES);
        put_angle(writer, sections->lon_deg, 360, true);
        put_angle(writer, sections->lat_deg, 180, false);
    }
    if (length > 0) {
        put_head(writer, YB_SECTION_NAME, length);
        for (size_t i = 0; i < length; i++)
            put_byte(writer, (uint8_t)sections->name[i]);
    }
}

size_t yb_sections_size(const yb_sections_t *sections)
{
    writer_t writer = {0};
    if (sections != NULL)
        put_sections(&writer, sections);
    return writer.count;
}

uint8_t yb_sections_check(const uint8_t *bytes, size_t count)
{
    unsigned crc = 0;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = (crc & 0x80) != 0 ? (crc << 1 ^ 0x07) & 0xff : crc << 1;
    }
    return (uint8_t)crc;
}

size_t yb_sections_end(const yb_sections_t *sections, uint8_t *code, size_t size, size_t room)
{
    size_t count = yb_sections_size(sections);
    if (size + count + 1 > room)
        return 0;
    if (count > 0) {
        writer_t writer = {.bytes = code + size};
        put_sections(&writer, sections);
        code[size + writer.last] |= SECTION_LAST;
    }
    code[size + count] = yb_sections_check(code, size + count);
    return size + count + 1;
}

bool yb_section_next(const uint8_t *bytes, size_t count, size_t *at, yb_section_t *section)
{
    if (*at >= count)
        return false;
    size_t begin = *at;
    uint8_t head = bytes[begin];
    size_t head_bytes = 1;
    size_t length = head & 15;
    if (length == SECTION_LONG) {
        head_bytes = 3;
        if (count - begin < head_bytes)
            return false;
        length = (size_t)bytes[begin + 1] << 8 | bytes[begin + 2];
    }
    if (length > count - begin - head_bytes)
        return false;
    *section = (yb_section_t){.kind = head >> 4 & 7,
                              .bytes = bytes + begin + head_bytes,
                              .count = length,
                              .whole = head_bytes + length};
    *at = begin + section->whole;
    return true;
}

/* Bytes of the UTF-8 character at the text's beginning, 0 if it is none or a control. */
static size_t character_at(const uint8_t *text, size_t count)
{
    static const uint32_t least[] = {0, 0, LEAST_AFTER_ASCII, 0x800, 0x10000};
    uint8_t first = text[0];
    if (first < 0x80)
        return first >= ' ' && first != 0x7f ? 1 : 0;
    size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc0 || first >= 0xf8 || length > count)
        return 0;
    uint32_t point = first & (0x7fU >> length);
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80)
            return 0;
        point = point << 6 | (text[i] & 0x3f);
    }
    bool good = point >= least[length] && point <= 0x10ffff && !(point >= 0xd800 && point < 0xe000);
    return good ? length : 0;
}

static bool is_text(const uint8_t *text, size_t count)
{
    size_t at = 0;
    while (at < count) {
        size_t length = character_at(text + at, count - at);
        if (length == 0)
            return false;
        at += length;
    }
    return true;
}

void yb_sections_read(yb_sections_t *sections, const uint8_t *bytes, size_t count)
{
    yb_section_t section;
    size_t at = 0;
    memset(sections, 0, sizeof(*sections));
    while (yb_section_next(bytes, count, &at, &section)) {
        if (section.kind == YB_SECTION_CERTIFICATE && section.count >= YB_CERTIFICATE_BYTES) {
            sections->certified = true;
            sections->error = section.bytes[0];
            sections->k = section.bytes[1];
        } else if (section.kind == YB_SECTION_PLACE && section.count >= YB_PLACE_BYTES) {
            sections->placed = true;
            sections->lon_deg = get_angle(section.bytes, 360);
            sections->lat_deg = get_angle(section.bytes + YB_PLACE_BYTES / 2, 180);
        } else if (section.kind == YB_SECTION_NAME && section.count <= YB_NAME_BYTES &&
                   is_text(section.bytes, section.count)) {
            memcpy(sections->name, section.bytes, section.count);
            sections->name[section.count] = '\0';
        }
    }
}

bool yb_sections_name(yb_sections_t *sections, const char *name, yb_error_t *error)
{
    size_t length = strlen(name);
    if (length == 0)
        return yb_error_set(error, "the name is empty");
    if (length > YB_NAME_BYTES)
        return yb_error_set(error, "the name has %zu bytes: at most %d are possible", length,
                            YB_NAME_BYTES);
    if (!is_text((const uint8_t *)name, length))
        return yb_error_set(error, "the name is no UTF-8 text without control characters");
    memcpy(sections->name, name, length + 1);
    return true;
}

double yb_sections_error_m(uint8_t coded)
{
    return coded == 0 ? 0 : fix_exp2_q11(6 * 2048 + 128 * (coded - 1)) / 256.0;
}

uint8_t yb_sections_error(double metres)
{
    for (int coded = 1; coded <= UINT8_MAX; coded++)
        if (yb_sections_error_m((uint8_t)coded) >= metres)
            return (uint8_t)coded;
    return 0;
}
