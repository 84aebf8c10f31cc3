/* The built-in map: a made-up volcano of three contours and a summit, 65 bytes, written by hand
 * from docs/SPEC.md. The cone leans to the north-west, so no two frames of a turn are alike.
 */
#include "turntable.h"

const uint8_t yb_built_in_map[] = {
    0x20,       /* format version 2, paper profile */
    0x02,       /* one height for the whole frame; smooth; differences in units of 4 steps */
    4, 26,      /* contours; vertices: 22 points and the frame's corners */
    255, 255,   /* the frame, in steps */
    0x07, 0x80, /* a step is 1920/64 = 30 m */
    0x02, 0x80, /* a unit of height is 640/64 = 10 m */
    0, 0,       /* base: 0 m above the datum */
    7,          /* seed */
    32,         /* gain 1 */
    0, 20,      /* the frame lies at 200 m */
    9, 7, 5, 1, /* points of each contour */
    0x40,       /* D = 1.25 */
    /* Each contour: height, first point, then 12 bits for each step to the next point.
     * The foot, at 400 m: */
    0x00, 0x28, 232, 120, 0xe1, 0x2b, 0xc9, 0xbb, 0xad, 0xee, 0x16, 0xd2, 0x7b, 0x2b, 0xd4, 0xc5,
    /* 900 m: */
    0x00, 0x5a, 188, 124, 0xe8, 0xcc, 0xc3, 0xdb, 0x50, 0xf2, 0x2f, 0xb2, 0xc5,
    /* 1500 m: */
    0x00, 0x96, 152, 116, 0xf0, 0x7e, 0x3f, 0xfb, 0x91, 0x7b,
    /* The summit, at 1900 m: */
    0x00, 0xbe, 120, 120,
    /* The check byte: */
    0x03};
const size_t yb_built_in_map_bytes = sizeof yb_built_in_map;
