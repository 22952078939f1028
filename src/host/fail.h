/* SPDX-License-Identifier: MIT */
/* Filling lrcs_host_error and lrcs_host_notices. */
#ifndef LRCSI_HOST_FAIL_H
#define LRCSI_HOST_FAIL_H

#include <lrcs/host.h>

/* Sets the sentence and returns the status. */
__attribute__((format(printf, 3, 4))) int lrcsi_host_fail(lrcs_host_error *error, int status,
                                                          const char *format, ...);

/* LRCS_E_SYSTEM for a file: "PATH: cannot WHAT: " and errno's text. */
int lrcsi_host_fail_file(lrcs_host_error *error, const char *path, const char *what);

/* LRCS_E_SYSTEM because of lack of memory: of so many bytes, or of an unknown number. */
int lrcsi_host_fail_memory(lrcs_host_error *error, size_t bytes);
int lrcsi_host_out_of_memory(lrcs_host_error *error);

/* A reader's status with the place that it reports. */
int lrcsi_host_fail_where(lrcs_host_error *error, int status, const char *path,
                          const lrcs_where *where);

/* Adds a sentence; a repeated sentence is kept once. Dropped if there is no memory for it. */
__attribute__((format(printf, 2, 3))) void lrcsi_host_note(lrcs_host_notices *notices,
                                                           const char *format, ...);

#endif
