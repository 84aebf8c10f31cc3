/* The codes whose frames are compared, embedded by the build. */
#ifndef GOLDEN_CODES_H
#define GOLDEN_CODES_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *name;
    const uint8_t *bytes; /* in program space: yb_rom_u8 */
    size_t count;
} golden_code_t;

extern const golden_code_t golden_codes[];
extern const size_t golden_code_count;

#endif
