/* SPDX-License-Identifier: MIT */
/* What callers of lrcs/refine.h share that build finer divisions. */
#ifndef LRCSI_REFINE_H
#define LRCSI_REFINE_H

#include <lrcs/refine.h>

/* After a division that could not be built: half as many more halvings than before. Returns 0 if
   none is left. */
int lrcsi_refine_less(const unsigned char *before, uint32_t parts, unsigned char *halvings);

#endif
