/* What may follow the relief of a code (docs/SPEC.md 1.4): a name, a place on earth, a certificate.
 * The engine skips all but the certificate; here they are written and read.
 */
#ifndef YB_SECTIONS_H
#define YB_SECTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "error.h"

enum {
    YB_NAME_BYTES = 63,
    YB_CERTIFICATE_BYTES = 2,
    YB_PLACE_BYTES = 6
};

typedef struct {
    bool certified;
    uint8_t error, k; /* as coded: yb_sections_error, K in 1/255 */
    bool placed;
    double lon_deg, lat_deg;      /* of the frame's centre, WGS 84 */
    char name[YB_NAME_BYTES + 1]; /* UTF-8; empty: none */
} yb_sections_t;

/* One section of a code. */
typedef struct {
    int kind;
    const uint8_t *bytes; /* of its content … */
    size_t count;         /* … and how many; borrowed from the code */
    size_t whole;         /* the same with its head */
} yb_section_t;

/* Bytes that the sections take, heads included; 0: there are none, or `sections` is NULL. */
size_t yb_sections_size(const yb_sections_t *sections);

/* Ends a code of `size` bytes, its relief: appends the sections, if there are any, and the check
 * byte. Answers the size then, 0 if that is more than `room`.
 */
size_t yb_sections_end(const yb_sections_t *sections, uint8_t *code, size_t size, size_t room);

/* The check byte of what comes before it. */
uint8_t yb_sections_check(const uint8_t *bytes, size_t count);

/* Steps from section to section; *at is 0 to begin with. False: there are no more. `bytes` are
 * those between relief and check byte of a code that the engine has taken.
 */
bool yb_section_next(const uint8_t *bytes, size_t count, size_t *at, yb_section_t *section);

/* Those that are known, from the same bytes. A name that breaks the rules counts as none. */
void yb_sections_read(yb_sections_t *sections, const uint8_t *bytes, size_t count);

/* Takes a name of 1 to 63 bytes of UTF-8 without control characters; else false, with what is wrong
 * about it.
 */
bool yb_sections_name(yb_sections_t *sections, const char *name, yb_error_t *error);

/* An error in metres as a certificate has it, rounded up, 0 if it is too large for one; and what a
 * certificate says in metres.
 */
uint8_t yb_sections_error(double metres);
double yb_sections_error_m(uint8_t coded);

#endif
