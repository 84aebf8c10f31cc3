/* The models' common face: the table of panels, the handle, and the rules that hold for all. */
#include "mipi_model.h"
#include "model_parts.h"

#include <stdlib.h>
#include <string.h>

static const yb_model_kind_t kinds[] = {
    {"ssd0323", &yb_model_ssd0323, NULL, 128, 64},
    {"ssd1306", &yb_model_ssd1306, NULL, 128, 64},
    {"ssd1306-128x32", &yb_model_ssd1306, NULL, 128, 32},
    {"ssd1351", &yb_model_ssd1351, NULL, 128, 128},
    {"ssd1351-128x96", &yb_model_ssd1351, NULL, 128, 96},
    {"st7735", &yb_model_mipi, &yb_mipi_st7735, 128, 160},
    {"st7735-80x160", &yb_model_mipi, &yb_mipi_st7735_80x160, 80, 160},
    {"st7735-128x128", &yb_model_mipi, &yb_mipi_st7735_128x128, 128, 128},
    {"st7789", &yb_model_mipi, &yb_mipi_st7789, 240, 240},
    {"st7789-240x320", &yb_model_mipi, &yb_mipi_st7789, 240, 320},
    {"st7789-135x240", &yb_model_mipi, &yb_mipi_st7789_135x240, 135, 240},
    {"ili9341", &yb_model_mipi, &yb_mipi_ili9341, 240, 320},
    {"gc9a01", &yb_model_mipi, &yb_mipi_gc9a01, 240, 240},
    {"ls013b7dh03", &yb_model_sharp, NULL, 128, 128},
    {"ls013b7dh05", &yb_model_sharp, NULL, 144, 168},
    {"ls027b7dh01", &yb_model_sharp, NULL, 400, 240},
};

static size_t picture_bytes(const yb_model_kind_t *kind)
{
    return (size_t)3 * kind->width * kind->height;
}

const char *yb_panel_model_name(size_t index)
{
    return index < sizeof kinds / sizeof kinds[0] ? kinds[index].name : NULL;
}

yb_panel_model_t *yb_panel_model_new(const char *name)
{
    const yb_model_kind_t *kind = NULL;

    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strcmp(kinds[i].name, name) == 0)
            kind = &kinds[i];
    }
    if (kind == NULL)
        return NULL;
    yb_panel_model_t *model = calloc(1, sizeof *model);
    if (model == NULL)
        return NULL;
    model->kind = kind;
    model->noise = 0x5EED;
    model->chip = calloc(1, kind->family->chip_bytes);
    model->rgb = calloc(1, picture_bytes(kind));
    if (model->chip == NULL || model->rgb == NULL) {
        yb_panel_model_free(model);
        return NULL;
    }
    kind->family->reset(model);
    return model;
}

void yb_panel_model_free(yb_panel_model_t *model)
{
    if (model == NULL)
        return;
    free(model->rgb);
    free(model->chip);
    free(model);
}

void yb_panel_model_reset(yb_panel_model_t *model)
{
    model->timed = false;
    model->kind->family->reset(model);
}

bool yb_panel_model_select(yb_panel_model_t *model, bool selected)
{
    if (model->failed)
        return false;
    const bool changed = model->selected != selected;
    model->select_told = true;
    model->selected = selected;
    return !changed || model->kind->family->select == NULL ||
           model->kind->family->select(model, selected);
}

bool yb_panel_model_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    const yb_model_family_t *family = model->kind->family;

    if (model->failed)
        return false;
    model->bytes++;
    if (!model->selected && (model->select_told || family->must_be_selected))
        return yb_model_fail(model, "%02Xh came while the panel was not selected", byte);
    return family->byte(model, is_data, byte);
}

void yb_panel_model_wait(yb_panel_model_t *model, uint32_t us)
{
    model->timed = true;
    model->now_us += us;
    if (!model->failed && model->kind->family->wait != NULL)
        (void)model->kind->family->wait(model);
}

bool yb_panel_model_picture(yb_panel_model_t *model, yb_model_picture_t *picture)
{
    const yb_model_kind_t *kind = model->kind;

    if (model->failed || !kind->family->finished(model))
        return false;
    if (!kind->family->lit(model))
        memset(model->rgb, 0, picture_bytes(kind));
    else if (!kind->family->picture(model))
        return false;
    *picture =
        (yb_model_picture_t){.width = kind->width, .height = kind->height, .rgb = model->rgb};
    return true;
}

bool yb_panel_model_lit(const yb_panel_model_t *model)
{
    return model->kind->family->lit(model);
}

uint64_t yb_panel_model_bytes(const yb_panel_model_t *model)
{
    return model->bytes;
}

const char *yb_panel_model_error(const yb_panel_model_t *model)
{
    return model->error;
}
