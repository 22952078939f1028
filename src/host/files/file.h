/* SPDX-License-Identifier: MIT */
/* Reading a file and recording which one it was; ending an output. */
#ifndef LRCSI_HOST_FILE_H
#define LRCSI_HOST_FILE_H

#include <sys/stat.h>

#include "host/fail.h"

/* lrcs_host_file_read, and the system's record of the file that was read. */
int lrcsi_host_file_read(const char *path, lrcs_host_file *file, struct stat *about,
                         lrcs_host_error *error);

/* lrcs_host_output_close after writing with a status: the output is kept if that is LRCS_OK.
   Returns it, or the status of closing. */
int lrcsi_host_output_end(lrcs_host_output *output, int status, lrcs_host_error *error);

#endif
