/* SPDX-License-Identifier: MIT */
/* The fingerprint of a scene. Decides what it includes: everything that sigma depends on, in the
   scene's order, but not names, colours and whether a material's BRDF was given. */
#include <lrcs/scene.h>

#include <string.h>

#include "base/fnv.h"

/* The IEEE bits of a double, those of +0 for either zero. */
static uint64_t hash_double(uint64_t hash, double x)
{
    uint64_t bits;
    x += 0.0;
    memcpy(&bits, &x, sizeof bits);
    return lrcsi_fnv_bits(hash, bits, 8);
}

static uint64_t hash_material(uint64_t hash, const lrcs_material *material)
{
    hash = hash_double(hash, material->brdf.A);
    hash = hash_double(hash, material->brdf.B);
    hash = hash_double(hash, material->brdf.s);
    hash = hash_double(hash, material->brdf.m);
    hash = lrcsi_fnv_byte(hash, material->two_sided != 0);
    return lrcsi_fnv_byte(hash, material->omitted != 0);
}

uint64_t lrcs_scene_hash(const lrcs_scene *scene)
{
    uint64_t hash = LRCSI_FNV_START;
    hash = lrcsi_fnv_bits(hash, scene->vertex_count, 4);
    hash = lrcsi_fnv_bits(hash, scene->facet_count, 4);
    hash = lrcsi_fnv_bits(hash, scene->material_count, 4);
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            hash = hash_double(hash, scene->vertex[i].x[k]);
        }
    }
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            hash = lrcsi_fnv_bits(hash, scene->facet[i].corner[k], 4);
        }
        hash = lrcsi_fnv_bits(hash, scene->facet_material[i], 4);
        hash = lrcsi_fnv_bits(hash, scene->facet_smooth[i], 4);
    }
    for (size_t i = 0; scene->corner_normal && i < 3 * (size_t)scene->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            hash = hash_double(hash, scene->corner_normal[i].x[k]);
        }
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        hash = hash_material(hash, &scene->material[i]);
    }
    return hash;
}
