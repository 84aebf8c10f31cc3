/* What a compiler may be told. None of it changes what is computed: other compilers do without. */
#ifndef YB_COMPILER_H
#define YB_COMPILER_H

/* A function that stays one: inlined, it would take registers from what its callers keep in them,
 * and small processors have few.
 */
#if defined(__GNUC__)
#define APART static __attribute__((noinline))
#else
#define APART static
#endif

/* A function so small that a call would take more room, and registers, than a copy of it. */
#if defined(__GNUC__)
#define TINY static inline __attribute__((always_inline))
#else
#define TINY static inline
#endif

/* Does speed count more than size? Then what most triangles need has a copy of its own, COPIED
 * functions are in line wherever they are called, and SELDOM ones stay apart.
 */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define COPIES 1
#define COPIED static inline __attribute__((always_inline))
#define SELDOM APART
#else
#define COPIES 0
#define COPIED static inline
#define SELDOM static
#endif

/* Before a loop over the three corners of a triangle: it is written out, as the indices that it
 * goes by would take more room than its copies.
 */
#if defined(__GNUC__) && __GNUC__ >= 8 && !defined(__clang__)
#define WRITTEN_OUT _Pragma("GCC unroll 3")
#else
#define WRITTEN_OUT
#endif

/* What holds for most triangles: code is laid out by it. */
#if defined(__GNUC__)
#define USUAL(condition) __builtin_expect((condition), 1)
#else
#define USUAL(condition) (condition)
#endif

#endif
