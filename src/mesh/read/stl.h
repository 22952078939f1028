/* SPDX-License-Identifier: MIT */
/* Shared by the two files of the STL reader: the distinction of the binary and the text kind, the
   reader of text, and the function by which both add facets. */
#ifndef LRCSI_STL_H
#define LRCSI_STL_H

#include <lrcs/mesh.h>

#include "base/bytes.h"

/* A binary file begins with a title of 80 bytes and the number of facets. */
#define LRCSI_STL_HEADER 84u

typedef struct lrcsi_stl_walk {
    const unsigned char *bytes;
    size_t size;
    lrcs_where *where;
    uint32_t facets;
    uint32_t notices;
    lrcsi_span name; /* of the first solid, of a text file */
    /* NULL while counting: */
    lrcs_mesh *mesh; /* vertex_count grows as vertices are welded */
    uint32_t *slot;  /* index of a vertex, or LRCS_NONE */
    size_t slots;
} lrcsi_stl_walk;

/* 1 if the bytes are a binary file of exactly the size that its count requires. No text is mistaken
   for one: its count would be at least 0x09090909, its size over 7 GB. */
int lrcsi_stl_is_binary(const unsigned char *bytes, size_t size);

/* 1 if the bytes start like a text file: "solid" and a line, then "facet", "endsolid", "solid" or
   nothing; or "facet normal" at once. A binary file may start with "solid" too. */
int lrcsi_stl_is_text(const unsigned char *bytes, size_t size);

/* Adds a facet, welding its corners; the corners are finite, the normal need not be. Status:
   LRCS_OK; LRCS_E_LIMIT (which the caller reports). */
int lrcsi_stl_add(lrcsi_stl_walk *walk, double corner[3][3], const double normal[3]);

/* Reads a text file. Status: LRCS_OK; _SYNTAX, _TRUNCATED, _NUMBER, _LIMIT. */
int lrcsi_stl_read_text(lrcsi_stl_walk *walk);

#endif
