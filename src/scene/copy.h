/* SPDX-License-Identifier: MIT */
/* Copies: facets that lie in the very place of another which is seen in their stead, wherever the
   laser stands. */
#ifndef LRCSI_COPY_H
#define LRCSI_COPY_H

#include "scene/prepare.h"

/* Marks them in p->idle. Status: LRCS_OK; LRCS_E_MEMORY. Work: nothing stays;
   lrcsi_same_need. Linear time. */
int lrcsi_copies_mark(lrcs_prepared *p, lrcs_work *work);

#endif
