/* The three functions that a compiler may call without being asked. Whole words where both ends
 * allow it; a Cortex-M0 faults on any other word access.
 */
#include <stdint.h>
#include <string.h>

/* Words that may hold anything: the bytes of every type pass through here. */
typedef uint32_t __attribute__((may_alias)) word_t;

#define WORD sizeof(word_t)

static size_t misaligned(const void *at)
{
    return (uintptr_t)at % WORD;
}

void *memcpy(void *restrict to, const void *restrict from, size_t count)
{
    uint8_t *out = to;
    const uint8_t *in = from;
    if (misaligned(out) == 0 && misaligned(in) == 0) {
        for (; count >= WORD; count -= WORD, out += WORD, in += WORD)
            *(word_t *)(void *)out = *(const word_t *)(const void *)in;
    }
    while (count-- > 0)
        *out++ = *in++;
    return to;
}

void *memmove(void *to, const void *from, size_t count)
{
    uint8_t *out = to;
    const uint8_t *in = from;
    if ((uintptr_t)out - (uintptr_t)in >= count)
        return memcpy(to, from, count);
    while (count-- > 0)
        out[count] = in[count];
    return to;
}

void *memset(void *to, int value, size_t count)
{
    uint8_t *out = to;
    const uint8_t byte = (uint8_t)value;
    for (; count > 0 && misaligned(out) != 0; count--)
        *out++ = byte;
    const word_t word = byte * 0x01010101u;
    for (; count >= 4 * WORD; count -= 4 * WORD, out += 4 * WORD) {
        word_t *four = (word_t *)(void *)out;
        four[0] = word;
        four[1] = word;
        four[2] = word;
        four[3] = word;
    }
    while (count-- > 0)
        *out++ = byte;
    return to;
}
