/* SPDX-License-Identifier: MIT */
/* What the host layer shares: errors and notices as sentences, numbers as text, names, whole files
   in and out. */
#ifndef LRCS_FILE_H
#define LRCS_FILE_H

#include <lrcs/lrcs.h>

#include <stdio.h>

/* The operating system refused: a file, a folder, memory. Beside the codes of lrcs/status.h. */
#define LRCS_E_SYSTEM (-64)

/* One sentence: the file, the place in it, what was found and what was expected. Every function
   below that takes one fills it when it fails; it may be NULL. */
typedef struct lrcs_host_error {
    char text[1024];
} lrcs_host_error;

/* ---- numbers ---- */

/* Room for any double as text. */
#define LRCS_HOST_NUMBER_SIZE 32

/* A double as decimal text with 17 significant digits ("%.17g"), with a decimal point in every
   locale. */
void lrcs_host_number_text(double value, char text[LRCS_HOST_NUMBER_SIZE]);

/* Reads decimal text that consists of one finite number; blanks around it are allowed.
   Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_NUMBER (beyond double range). */
int lrcs_host_number_read(const char *text, size_t size, double *value);

/* Reads a text that consists of exactly `count` such numbers, separated by commas.
   Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_NUMBER. */
int lrcs_host_numbers_read(const char *text, double *value, int count);

/* A bound >= 0 as "%.*g" prints it, rounded up. */
#define LRCS_HOST_BOUND_SIZE 40
void lrcs_host_bound_text(double bound, int digits, char text[LRCS_HOST_BOUND_SIZE]);

/* Appends to a text, truncated to its size. */
__attribute__((format(printf, 3, 4))) void lrcs_host_append(char *text, size_t size,
                                                            const char *format, ...);

/* ---- names ---- */

/* How far a name is from what was typed: 0 if it or one of its words (between - and _) begins with
   the text, else the number of edits (letters added, dropped, replaced, neighbours swapped) to the
   nearer of these, in the first 64 bytes. */
unsigned lrcs_host_name_distance(const char *text, const char *name);

/* Of two names the one that is nearer by that measure to what was typed; `best` if they are alike,
   or the candidate if `best` is NULL. */
const char *lrcs_host_name_nearer(const char *text, const char *best, const char *candidate);

/* 1 if a name may be what was meant by what was typed: one contains the other, or at most a third
   of the letters differ, ignoring case; else 0. */
int lrcs_host_name_is_near(const char *text, const char *name);

/* The names most like what was typed, best first, each once: those that contain the text or are
   contained in it, then those with the fewest edits, ignoring case.
   Given: name[count]; capacity, the size of `near`. Returned: near, pointers into name;
   how many. */
uint32_t lrcs_host_names_near(const char *text, const char *const *name, uint32_t count,
                              const char **near, uint32_t capacity);

/* ---- files ---- */

typedef struct lrcs_host_file {
    unsigned char *bytes; /* never NULL once read */
    size_t size;
} lrcs_host_file;

/* A whole file in memory. Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT (above 16 GiB). */
int lrcs_host_file_read(const char *path, lrcs_host_file *file, lrcs_host_error *error);
void lrcs_host_file_free(lrcs_host_file *file);

/* FNV-1a, 64 bit, a fingerprint: the hash of no bytes; the hash after `size` more bytes. */
#define LRCS_HOST_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t lrcs_host_hash(uint64_t hash, const void *bytes, size_t size);

/* A file being written. It appears under its name only when it is complete: until then it is a
   temporary file in the same folder. "-" is standard output; a device or pipe is written
   directly. */
typedef struct lrcs_host_output {
    FILE *stream;
    char *path;      /* final name, links followed; NULL: standard output */
    char *temporary; /* NULL: written directly */
} lrcs_host_output;

/* Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_output_open(const char *path, lrcs_host_output *output, lrcs_host_error *error);

/* Closes the output: keeps the file, or removes it if keep is 0 or a write failed.
   Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_output_close(lrcs_host_output *output, int keep, lrcs_host_error *error);

/* ---- notices ---- */

/* A list of sentences, owned. */
typedef struct lrcs_host_notices {
    char **text;
    uint32_t count;
} lrcs_host_notices;

#endif
