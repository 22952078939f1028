/* SPDX-License-Identifier: MIT */
/* Decides whether typed text matches a name. */
#ifndef LRCSI_HOST_NAMES_H
#define LRCSI_HOST_NAMES_H

#include <lrcs/host.h>

/* 1 if a name matches a pattern, else 0. In the pattern, * stands for any number of characters, ?
   for one (UTF-8), all else for itself; with `fold`, A to Z and a to z are alike. O(product of the
   lengths). */
int lrcsi_name_matches(const char *pattern, const char *name, int fold);

/* 1 if a text has a * or ?. */
int lrcsi_name_is_pattern(const char *text);

/* 1 if two names are equal except for upper and lower case (A to Z). */
int lrcsi_name_same_folded(const char *a, const char *b);

#endif
