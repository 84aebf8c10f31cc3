/* What the tests of the panels' models have in common: scripts of what happens on the wires, and
 * pictures whose every turn and mirror image looks different. */
#ifndef MODEL_SCRIPT_H
#define MODEL_SCRIPT_H

#include "panel_model.h"

/* A script is a list of these; bytes from 0 to FFh are sent with D/C low. */
enum {
    END = -1,
    DATA = 0x100, /* + a byte, sent with D/C high */
    SELECT = 0x200,
    RELEASE,
    RESET,
    WAIT_MS = 0x10000, /* + milliseconds */
};
#define D(byte) (DATA + (byte))
#define D16(value) D((value) >> 8), D((value)&0xFF)
#define W(ms) (WAIT_MS + (ms))

typedef struct {
    const char *name;     /* of the panel */
    const char *expected; /* a part of the sentence */
    int script[20];
} wrong_t;

yb_panel_model_t *new_model(const char *name);

/* Plays a script that must be right to its end; NULL: an empty one. */
void play(yb_panel_model_t *model, const int *script);

/* For each of them: after the script `before`, its own must be refused at its last item and nowhere
 * earlier, and the sentence must give the byte's number. */
void assert_refused(const int *before, const wrong_t *wrong, size_t count);

/* For each of them: its script is right, and there is no picture. */
void assert_no_pictures(const int *before, const wrong_t *wrong, size_t count);

/* Red, green, blue at a place of what is shown: RRGGBBh. */
uint32_t shown_at(yb_panel_model_t *model, unsigned x, unsigned y);

void assert_all(yb_panel_model_t *model, uint32_t rgb);

/* Marks in the corners of a dark picture. */
enum {
    DARK,
    TOP_LEFT,
    TOP_RIGHT,   /* two pixels, one beside the other */
    BOTTOM_LEFT, /* two pixels, one above the other */
    BOTTOM_RIGHT,
    MARKS,
};
unsigned mark_at(unsigned x, unsigned y, unsigned width, unsigned height);

/* The marks must be seen in these colours, and nothing else, by one who looks at the picture turned
 * clockwise by `turn` quarters. */
void assert_marks(yb_panel_model_t *model, unsigned turn, const uint32_t rgb[MARKS]);

/* Groups of tests; how many failed. */
int test_solomon_models(void);
int test_mipi_models(void);
int test_sharp_models(void);

#endif
