#include "certificate.h"

#include <math.h>

#include "fidelity.h"

/* Where its bytes are; NULL: there is none. */
static uint8_t *find(yb_code_file_t *code)
{
    uint8_t *bytes = code->bytes + code->load.relief_size;
    size_t count = code->size - code->load.relief_size - 1;
    yb_section_t section;
    size_t at = 0;
    while (yb_section_next(bytes, count, &at, &section))
        if (section.kind == YB_SECTION_CERTIFICATE && section.count == YB_CERTIFICATE_BYTES)
            return bytes + at - YB_CERTIFICATE_BYTES;
    return NULL;
}

bool yb_certificate_fill(yb_code_file_t **code, const yb_grid_t *relief, const yb_lines_t *lines,
                         yb_error_t *error)
{
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    uint8_t *certificate = find(*code);
    if (certificate == NULL)
        return yb_error_set(error, "the code has no room for a certificate");
    if (!yb_comparison_make(&comparison, *code, relief, lines, error))
        return false;
    bool good = yb_fidelity_measure(&fidelity, *code, &comparison) ||
                yb_error_set(error, "not enough memory to compare the code with the relief");
    yb_comparison_free(&comparison);
    if (!good)
        return false;
    certificate[0] = yb_sections_error(fidelity.detail.p90_m);
    certificate[1] = (uint8_t)floor(fidelity.k * UINT8_MAX);
    yb_fidelity_free(&fidelity);
    (*code)->bytes[(*code)->size - 1] = yb_sections_check((*code)->bytes, (*code)->size - 1);
    yb_code_file_t *filled =
        yb_code_file_from_bytes("the new code", (*code)->bytes, (*code)->size, error);
    if (filled == NULL)
        return false;
    yb_code_file_free(*code);
    *code = filled;
    return true;
}
