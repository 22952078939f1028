/* SPDX-License-Identifier: MIT */
/* Comparators for tests. cmocka 1.1.5 compares doubles as floats, so none of its own is used on
   them: these print both values in full and the measure by which they differ. */
#ifndef TEST_CHECK_H
#define TEST_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

/* |got - want| <= most. A NaN never passes. */
#define check_abs(got, want, most) check_abs_at((got), (want), (most), #got, __FILE__, __LINE__)
/* |got - want| <= most * |want|. */
#define check_rel(got, want, most)                                                                 \
    check_abs_at((got), (want), (most)*fabs(want), #got, __FILE__, __LINE__)
/* Equal to the bit but for the sign of zero. */
#define check_same(got, want) check_abs_at((got), (want), 0.0, #got, __FILE__, __LINE__)
/* got <= most. */
#define check_most(got, most) check_most_at((got), (most), #got, __FILE__, __LINE__)

static inline void check_abs_at(double got, double want, double most, const char *what,
                                const char *file, int line)
{
    if (!(fabs(got - want) <= most) && !(got == want)) {
        fprintf(stderr, "%s = %.17g, want %.17g +- %.3g (off by %.3g)\n", what, got, want, most,
                fabs(got - want));
        _fail(file, line);
    }
}

static inline void check_most_at(double got, double most, const char *what, const char *file,
                                 int line)
{
    if (!(got <= most)) {
        fprintf(stderr, "%s = %.17g, at most %.17g\n", what, got, most);
        _fail(file, line);
    }
}

/* Skips a test whose reference is a long double of wider range than a double, where it has none. */
static inline void need_wide_long_double(void)
{
    if (LDBL_MAX_EXP == DBL_MAX_EXP) {
        print_message("long double is double here\n");
        skip();
    }
}

#endif
