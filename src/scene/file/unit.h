/* SPDX-License-Identifier: MIT */
/* Units of length by name. */
#ifndef LRCSI_UNIT_H
#define LRCSI_UNIT_H

/* Metres in a unit: mm, cm, m, in or ft. Status: LRCS_OK; LRCS_E_NAME. */
int lrcsi_unit_find(const char *name, double *metres);

#endif
