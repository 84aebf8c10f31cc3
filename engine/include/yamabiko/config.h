/* Yamabiko's compile-time limits. Every build of one program must use the same values: they size
 * the structs of yamabiko.h. Override with -DYB_MAX_…=n on the compiler's command line.
 */
#ifndef YAMABIKO_CONFIG_H
#define YAMABIKO_CONFIG_H

/* Most vertices of a mesh. 255 keeps indices in 8 bits: a map then takes 12 bytes a vertex and
 * 14 a vertex for triangles. A code of the paper profile never asks for more than 255; more, up to
 * 65535, are for maps that are built from contours in full detail (yb_map_build). The surface of a
 * code is the same in every build that it fits.
 */
#ifndef YB_MAX_VERTICES
#define YB_MAX_VERTICES 255
#endif
#if YB_MAX_VERTICES < 4 || YB_MAX_VERTICES > 65535
#error "YB_MAX_VERTICES: 4 to 65535"
#endif

/* Longest side of a screen, in pixels. Up to 512 the areas of triangles fit 32 bits;
 * above they take 64, with the same pixels.
 */
#ifndef YB_MAX_SIDE
#if defined(__SIZEOF_POINTER__) && __SIZEOF_POINTER__ >= 8
#define YB_MAX_SIDE 4096
#else
#define YB_MAX_SIDE 512
#endif
#endif
#if YB_MAX_SIDE < 16 || YB_MAX_SIDE > 4096
#error "YB_MAX_SIDE: 16 to 4096"
#endif

/* How often an edge of a base triangle is halved in a frame, at most: the finest detail is so many
 * powers of two finer than the mesh. The explicit stack that refines one base triangle has three
 * places for each, of 64 bytes of yb_frame_t (on 32 bits), so it never wants for room. Its upper
 * part is lent to what bands hand on, as long as it is not needed.
 */
#ifndef YB_MAX_HALVINGS
#define YB_MAX_HALVINGS 10
#endif
#if YB_MAX_HALVINGS < 3 || YB_MAX_HALVINGS > 12
#error "YB_MAX_HALVINGS: 3 to 12"
#endif

#endif
