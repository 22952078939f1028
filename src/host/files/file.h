/* SPDX-License-Identifier: MIT */
/* Reading a file and recording which one it was. */
#ifndef LRCSI_HOST_FILE_H
#define LRCSI_HOST_FILE_H

#include <sys/stat.h>

#include "host/fail.h"

/* lrcs_host_file_read, and the system's record of the file that was read. */
int lrcsi_host_file_read(const char *path, lrcs_host_file *file, struct stat *about,
                         lrcs_host_error *error);

#endif
