/* SPDX-License-Identifier: MIT */
/* Attitudes over time, from a table of text (lrcs/table.h). */
#ifndef LRCS_TRACK_H
#define LRCS_TRACK_H

#include <lrcs/file.h>

#define LRCS_HOST_TRACK_JOINTS     8        /* columns that turn joints, at most */
#define LRCS_HOST_TRACK_JOINT_TEXT "joint:" /* their names begin so; the name of a part follows */

typedef struct lrcs_host_track {
    double (*row)[5]; /* time, s; direction to the laser x, y, z, body frame, of any length, or
                         quaternion w, x, y, z, body to observation frame; owned */
    uint64_t count;
    int quaternions; /* 1: rows have quaternions */
    uint64_t hash;   /* FNV-1a, of the file's bytes */
    char epoch[40]; /* the date, ISO 8601, from which times are counted; "" if times are as given */
    uint32_t joints;
    char joint_name[LRCS_HOST_TRACK_JOINTS][112]; /* "joint:PART" */
    double (*joint)[LRCS_HOST_TRACK_JOINTS];      /* of each row, deg; owned */
    lrcs_host_notices notices;                    /* unused columns; owned */
} lrcs_host_track;

/* Reads a table with one attitude in each row. If the first field of the first row is neither a
   number nor a date, that row names the columns, in any order: time (or time_s, t); x, y, z, or w
   (or qw), x, y, z (or qx, qy, qz); joint:PART; other columns are not used, and a notice says so.
   Without names four columns are time, x, y, z, and five are time, w, x, y, z. Times are seconds,
   or dates as 2026-11-22T20:15:30.5Z, which are counted from the first one, without leap seconds.
   Returned: track, to be freed in any case.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_SYNTAX, LRCS_E_NUMBER, LRCS_E_NAME (a column missing, or
   given twice), LRCS_E_ARGUMENT (a direction or quaternion of zero), LRCS_E_LIMIT, LRCS_E_EMPTY:
   the sentence names the line, what was found there and what was expected. */
int lrcs_host_track_read(const char *path, lrcs_host_track *track, lrcs_host_error *error);
void lrcs_host_track_free(lrcs_host_track *track);

#endif
