/* SPDX-License-Identifier: MIT */
/* Reads one material of a 3DS file: name, diffuse colour, transparency, two-sidedness. It decides
   which of several colours is used, but not what the material reflects. */
#include "mesh/read/3ds.h"

#include <math.h>
#include <string.h>

#include "base/bytes.h"

/* Three floats as a colour: clamped to 0..1, rounded to 0..255. */
static int tds_float_colour(const lrcsi_tds_walk *walk, size_t at, unsigned char rgb[3])
{
    for (size_t i = 0; i < 3; i++) {
        double value = lrcsi_bytes_float(walk->bytes + at + 4 * i);
        if (!isfinite(value)) {
            return lrcsi_tds_fail(walk, LRCS_E_NUMBER, at + 4 * i, "material colour",
                                  "a finite number", lrcsi_bytes_u32(walk->bytes + at + 4 * i));
        }
        rgb[i] = (unsigned char)(255.0 * fmin(fmax(value, 0.0), 1.0) + 0.5);
    }
    return LRCS_OK;
}

/* The preference among colour chunks: the colour that the user saw on screen comes first. */
static int tds_colour_rank(unsigned id)
{
    switch (id) {
    case LRCSI_TDS_COLOUR_24:
        return 4;
    case LRCSI_TDS_COLOUR_24_LINEAR:
        return 3;
    case LRCSI_TDS_COLOUR_FLOAT:
        return 2;
    case LRCSI_TDS_COLOUR_FLOAT_LINEAR:
        return 1;
    default:
        return 0;
    }
}

static int tds_read_colour(lrcsi_tds_walk *walk, lrcsi_tds_chunk diffuse, lrcs_surface *surface)
{
    lrcsi_tds_chunk chunk;
    int best = 0;
    int next;
    while ((next = lrcsi_tds_next(walk, &diffuse, &chunk)) > 0) {
        int rank = tds_colour_rank(chunk.id);
        int is_float = rank == 1 || rank == 2;
        if (rank == 0) {
            continue;
        }
        int status = lrcsi_tds_check(walk, &chunk, 3, is_float ? 4 : 1, "material colour");
        unsigned char rgb[3] = {0};
        if (status == LRCS_OK && is_float) {
            status = tds_float_colour(walk, chunk.at, rgb);
        } else if (status == LRCS_OK) {
            memcpy(rgb, walk->bytes + chunk.at, 3);
        }
        if (status != LRCS_OK) {
            return status;
        }
        if (rank > best) {
            best = rank;
            surface->has_colour = 1;
            memcpy(surface->rgb, rgb, 3);
        }
    }
    return next;
}

/* Both forms are in percent (a float of 86.0 is 86 %). */
static int tds_read_transparency(lrcsi_tds_walk *walk, lrcsi_tds_chunk parent,
                                 lrcs_surface *surface)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &parent, &chunk)) > 0) {
        if (chunk.id != LRCSI_TDS_PERCENT_INT && chunk.id != LRCSI_TDS_PERCENT_FLOAT) {
            continue;
        }
        int is_float = chunk.id == LRCSI_TDS_PERCENT_FLOAT;
        int status = lrcsi_tds_check(walk, &chunk, 1, is_float ? 4 : 2, "material transparency");
        if (status != LRCS_OK) {
            return status;
        }
        unsigned word = is_float ? 0 : lrcsi_bytes_u16(walk->bytes + chunk.at);
        double percent = word < 0x8000 ? (double)word : (double)word - 65536.0;
        percent = is_float ? lrcsi_bytes_float(walk->bytes + chunk.at) : percent;
        if (!isfinite(percent)) {
            return lrcsi_tds_fail(walk, LRCS_E_NUMBER, chunk.at, "material transparency",
                                  "a finite number", lrcsi_bytes_u32(walk->bytes + chunk.at));
        }
        surface->transparency = fmin(fmax(percent / 100.0, 0.0), 1.0);
    }
    return next;
}

int lrcsi_tds_read_material(lrcsi_tds_walk *walk, lrcsi_tds_chunk material)
{
    lrcs_surface surface = {.defined = 1};
    lrcsi_span name = {material.at, 0};
    size_t start = material.at;
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &material, &chunk)) > 0) {
        int status = LRCS_OK;
        if (chunk.id == LRCSI_TDS_MATERIAL_NAME) {
            status = lrcsi_tds_name(walk, &chunk, &name, "material name");
        } else if (chunk.id == LRCSI_TDS_DIFFUSE) {
            status = tds_read_colour(walk, chunk, &surface);
        } else if (chunk.id == LRCSI_TDS_TRANSPARENCY) {
            status = tds_read_transparency(walk, chunk, &surface);
        } else if (chunk.id == LRCSI_TDS_TWO_SIDED) {
            surface.two_sided = 1;
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (next < 0) {
        return next;
    }
    uint32_t index = walk->counts.materials;
    surface.name = lrcsi_tds_store_name(walk, name);
    if (walk->mesh) {
        walk->mesh->material[index] = surface;
        const unsigned char *bytes = walk->bytes + name.at;
        if (lrcsi_index_find(&walk->names, 0, bytes, name.size) == LRCS_NONE) {
            lrcsi_index_put(&walk->names, 0, bytes, name.size, index);
        }
    }
    return lrcsi_tds_add(walk, &walk->counts.materials, 1, start, "material");
}
