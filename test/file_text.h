/* SPDX-License-Identifier: MIT */
/* What a writer wrote into a temporary file. */
#ifndef TEST_FILE_TEXT_H
#define TEST_FILE_TEXT_H

#include "check.h"

#include <stdio.h>
#include <stdlib.h>

/* The file as a string that the caller frees; closes it. */
static inline char *file_text(FILE *file)
{
    size_t size = (size_t)ftell(file);
    char *text = calloc(size + 1, 1);
    rewind(file);
    assert_int_equal(fread(text, 1, size, file), size);
    fclose(file);
    return text;
}

#endif
