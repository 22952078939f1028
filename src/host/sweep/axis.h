/* SPDX-License-Identifier: MIT */
/* The quantities that a sweep varies, from their texts. */
#ifndef LRCSI_SWEEP_AXIS_H
#define LRCSI_SWEEP_AXIS_H

#include <lrcs/plan.h>

/* Reads "A:B:STEP", including B if a step reaches it, or "A" alone. Returns NULL, or what is wrong
   with it. */
const char *lrcsi_range_read(const char *text, size_t size, lrcs_host_range *range);

/* Adds an axis; the text need not be NUL-terminated. Status: LRCS_OK; LRCS_E_LIMIT (no more axes);
   LRCS_E_ARGUMENT (the range): the sentence begins with the key. */
int lrcsi_axis_add(lrcs_host_plan *plan, const char *key, const char *name, const char *text,
                   size_t size, lrcs_host_error *error);

/* LRCS_E_ARGUMENT: "KEY: expected EXPECTED, found 'FOUND'". */
int lrcsi_text_refuse(lrcs_host_error *error, const char *key, const char *expected,
                      const char *found);

#endif
