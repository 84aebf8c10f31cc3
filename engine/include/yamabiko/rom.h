/* Constant tables and code bytes in program space.
 *
 * Most processors read flash like RAM, and all of this is plain C there. An AVR has two address
 * spaces: constants are copied to its little RAM at the start unless they are marked YB_ROM, and
 * those that are can be read by these functions alone.
 *
 *     static const uint8_t code[] YB_ROM = {...};
 *     for (size_t i = 0; status == YB_MORE; i++) {
 *         uint8_t byte = yb_rom_u8(&code[i]);
 *         status = yb_map_feed(&map, &load, &byte, 1);
 *     }
 */
#ifndef YAMABIKO_ROM_H
#define YAMABIKO_ROM_H

#include <stdint.h>

#if defined(__AVR__)

/* Within the first 64 KB, where the linker puts these constants. */
#define YB_ROM __attribute__((progmem))

static inline uint8_t yb_rom_u8(const uint8_t *at)
{
    uint8_t byte;
    __asm__("lpm %0, Z" : "=r"(byte) : "z"(at));
    return byte;
}

static inline uint16_t yb_rom_u16(const uint16_t *at)
{
    const uint8_t *byte = (const uint8_t *)at;
    return (uint16_t)(yb_rom_u8(byte) | (uint16_t)yb_rom_u8(byte + 1) << 8);
}

static inline uint32_t yb_rom_u32(const uint32_t *at)
{
    const uint16_t *half = (const uint16_t *)at;
    return yb_rom_u16(half) | (uint32_t)yb_rom_u16(half + 1) << 16;
}

#else

#define YB_ROM

static inline uint8_t yb_rom_u8(const uint8_t *at)
{
    return *at;
}

static inline uint16_t yb_rom_u16(const uint16_t *at)
{
    return *at;
}

static inline uint32_t yb_rom_u32(const uint32_t *at)
{
    return *at;
}

#endif
#endif
