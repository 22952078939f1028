/* SPDX-License-Identifier: MIT */
/* Wavefront MTL: colour (Kd) and transparency (d, Tr) of the materials that an OBJ file uses. All
   other statements of a library (shading, textures) have no meaning here and are skipped. The bytes
   are read twice: once to check them, once to write the materials. */
#include "base/range.h"
#include "base/text.h"
#include "base/where.h"
#include "mesh/read/lines.h"

#include <lrcs/read.h>

#include <math.h>
#include <string.h>

typedef struct mtl_walk {
    lrcsi_lines lines;
    lrcs_where *where;
    lrcs_mesh *mesh;       /* NULL while the bytes are only checked */
    lrcs_surface *current; /* NULL: none yet, or one that the mesh does not use */
    uint32_t next;         /* where the search begins: libraries tend to keep the order of use */
    int has_d;             /* `d` was given: `Tr` no longer counts */
} mtl_walk;

/* 1 if lrcsi_text_utf8 turns these bytes into `name`. */
static int name_matches(const char *bytes, size_t size, const char *name)
{
    int utf8 = lrcsi_text_is_utf8(bytes, size);
    for (size_t i = 0; i < size; i++) {
        char text[3] = {bytes[i], '\0', '\0'};
        if (!utf8 || (unsigned char)bytes[i] < 0x80) {
            lrcsi_text_utf8(&bytes[i], 1, text); /* a byte by itself is ASCII or Latin-1 */
        }
        size_t length = strlen(text);
        if (strncmp(name, text, length) != 0) {
            return 0;
        }
        name += length;
    }
    return *name == '\0';
}

/* "Kd r g b", or "Kd r" for a grey; a spectral curve or CIE XYZ is ignored. */
static int read_diffuse(mtl_walk *w)
{
    lrcsi_lines from = w->lines;
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    if (lrcsi_lines_is(word, size, "spectral") || lrcsi_lines_is(word, size, "xyz")) {
        return LRCS_OK;
    }
    w->lines = from;
    unsigned char rgb[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        double value = 0.0;
        if (k == 1 && lrcsi_lines_done(&w->lines)) {
            rgb[1] = rgb[2] = rgb[0];
            break;
        }
        int status = lrcsi_lines_number(&w->lines, "Kd", &value, w->where);
        if (status != LRCS_OK) {
            return status;
        }
        rgb[k] = (unsigned char)floor(255.0 * lrcsi_clamp_unit(value) + 0.5);
    }
    if (w->current) {
        memcpy(w->current->rgb, rgb, sizeof rgb);
        w->current->has_colour = 1;
    }
    return LRCS_OK;
}

/* "d x", "d -halo x", "Tr x": transparency is 1 - d, or Tr. If a material has both, d is used,
   because exporters do not agree on the sense of Tr. */
static int read_transparency(mtl_walk *w, int is_d)
{
    lrcsi_lines from = w->lines;
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    if (!is_d || !lrcsi_lines_is(word, size, "-halo")) {
        w->lines = from;
    }
    double value = 0.0;
    int status = lrcsi_lines_number(&w->lines, is_d ? "d" : "Tr", &value, w->where);
    if (status == LRCS_OK && w->current && (is_d || !w->has_d)) {
        w->current->transparency = is_d ? 1.0 - lrcsi_clamp_unit(value) : lrcsi_clamp_unit(value);
    }
    w->has_d |= is_d;
    return status;
}

/* One statement. "newmtl name" finds the material that the following ones describe. */
static int read_library_statement(mtl_walk *w)
{
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    if (lrcsi_lines_is(word, size, "Kd")) {
        return read_diffuse(w);
    }
    if (lrcsi_lines_is(word, size, "d")) {
        return read_transparency(w, 1);
    }
    if (lrcsi_lines_is(word, size, "Tr")) {
        return read_transparency(w, 0);
    }
    if (!lrcsi_lines_is(word, size, "newmtl")) {
        return LRCS_OK;
    }
    const char *name = NULL;
    size = lrcsi_lines_name(&w->lines, &name);
    w->current = NULL;
    w->has_d = 0;
    for (uint32_t i = 0; w->mesh && i < w->mesh->material_count && !w->current; i++) {
        lrcs_surface *material = &w->mesh->material[w->next];
        w->next = w->next + 1 < w->mesh->material_count ? w->next + 1 : 0;
        if (name_matches(name, size, material->name)) {
            w->current = material;
            material->defined = 1;
        }
    }
    return LRCS_OK;
}

static int walk_library(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where)
{
    mtl_walk w = {lrcsi_lines_make(bytes, size), where, mesh, NULL, 0, 0};
    int status = LRCS_OK;
    do {
        status = read_library_statement(&w);
    } while (status == LRCS_OK && lrcsi_lines_next(&w.lines));
    return status;
}

int lrcs_mtl_read(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where)
{
    if (size == 0) {
        return lrcsi_where_number(where, LRCS_E_EMPTY, 0, 1, "file", "MTL statements", 0);
    }
    int status = walk_library(bytes, size, NULL, where);
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < mesh->material_count; i++) {
        mesh->material[i].defined = 0;
    }
    walk_library(bytes, size, mesh, where); /* succeeds, as it did before */
    for (uint32_t i = 0; i < mesh->material_count; i++) {
        if (!mesh->material[i].defined) {
            mesh->notices |= LRCS_MESH_UNDEFINED_MATERIAL;
        }
    }
    return LRCS_OK;
}
