/* FNV-1a, 64 bits: names a mesh or a picture in one number. */
#ifndef TEST_FNV_H
#define TEST_FNV_H

#include <stddef.h>
#include <stdint.h>

#define FNV_START 0xcbf29ce484222325u

static inline uint64_t fnv_bytes(uint64_t hash, const void *bytes, size_t count)
{
    const uint8_t *p = bytes;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ p[i]) * 0x100000001b3u;
    return hash;
}

/* A number by its value, low byte first whatever the machine. */
static inline uint64_t fnv_number(uint64_t hash, int64_t number)
{
    for (int i = 0; i < 8; i++)
        hash = (hash ^ ((uint64_t)number >> 8 * i & 255)) * 0x100000001b3u;
    return hash;
}

#endif
