#include "contour_code.h"

#include "compact_code.h"
#include "paper_code.h"

size_t yb_contour_code_write(const yb_contour_set_t *set, uint8_t *code, size_t room,
                             yb_bits_t *bits)
{
    if (set->profile == YB_COMPACT)
        return yb_compact_write(set, code, room, bits);
    size_t size = yb_paper_size(set);
    if (bits != NULL)
        bits->all = (double)size * 8;
    return size <= room && set->point_count <= 255 ? yb_paper_write(set, code) : 0;
}

bool yb_contour_code_fits(const yb_contour_set_t *set, size_t most_bytes)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    return yb_contour_code_write(set, code, most_bytes, NULL) > 0;
}

yb_code_file_t *yb_contour_code_load(const yb_contour_set_t *set, yb_error_t *error)
{
    yb_contour_set_t counted = *set;
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    size_t size = yb_contour_code_write(&counted, code, sizeof(code), NULL);
    if (size == 0) {
        yb_error_set(error, "the contours do not fit the format");
        return NULL;
    }
    yb_code_file_t *file = yb_code_file_from_bytes("the new code", code, size, error);
    if (file == NULL || counted.vertices > 0)
        return file;
    counted.vertices = file->map.vertex_count;
    yb_code_file_free(file);
    size = yb_contour_code_write(&counted, code, sizeof(code), NULL);
    return yb_code_file_from_bytes("the new code", code, size, error);
}
