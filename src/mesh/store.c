/* SPDX-License-Identifier: MIT */
/* Lays out a mesh's blocks in the work area, and computes the bytes for them and for the readers'
   scratch. It does not know any format. */
#include "mesh/store.h"

#include <lrcs/read.h>

#include <string.h>

#include "base/hash.h"
#include "base/index.h"
#include "base/work.h"

/* Allocates the blocks of normals, if there are normals; no corner has one yet. Returns 0 if there
   is no room. */
static int store_normals(const lrcs_mesh_counts *counts, lrcs_work *work, lrcs_mesh *mesh)
{
    if (counts->normals == 0) {
        return 1;
    }
    mesh->normal_count = counts->normals;
    mesh->facet_normal = lrcsi_work_take(work, counts->facets, sizeof *mesh->facet_normal);
    mesh->normal = lrcsi_work_take(work, counts->normals, sizeof *mesh->normal);
    if (!mesh->facet_normal || !mesh->normal) {
        return 0;
    }
    memset(mesh->facet_normal, 0xff, counts->facets * sizeof *mesh->facet_normal);
    return 1;
}

int lrcsi_store_take(const lrcs_mesh_counts *counts, lrcs_work *work, lrcs_mesh *mesh, char **text)
{
    size_t mark = work->used;
    lrcs_mesh made = {.vertex_count = counts->vertices,
                      .facet_count = counts->facets,
                      .material_count = counts->materials,
                      .part_count = counts->parts};
    made.material = lrcsi_work_take_zero(work, counts->materials, sizeof *made.material);
    made.part = lrcsi_work_take_zero(work, counts->parts, sizeof *made.part);
    made.facet = lrcsi_work_take_zero(work, counts->facets, sizeof *made.facet);
    made.facet_material = lrcsi_work_take(work, counts->facets, sizeof *made.facet_material);
    made.facet_part = lrcsi_work_take_zero(work, counts->facets, sizeof *made.facet_part);
    made.facet_smooth = lrcsi_work_take_zero(work, counts->facets, sizeof *made.facet_smooth);
    char *names = lrcsi_work_take(work, counts->text_bytes, 1);
    int normals = store_normals(counts, work, &made);
    made.vertex = lrcsi_work_take(work, counts->vertices, sizeof *made.vertex);
    if (!made.material || !made.part || !made.facet || !made.facet_material || !made.facet_part ||
        !made.facet_smooth || !names || !normals || !made.vertex) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    memset(made.facet_material, 0xff, counts->facets * sizeof *made.facet_material);
    *mesh = made;
    *text = names;
    return LRCS_OK;
}

size_t lrcs_mesh_need(const lrcs_mesh_counts *counts)
{
    const size_t marks = lrcsi_work_bytes(counts->facets, 1);
    const size_t table = lrcsi_work_bytes(lrcsi_hash_slots(counts->vertices), sizeof(uint32_t));
    const size_t block[] = {
        lrcsi_work_bytes(counts->materials, sizeof(lrcs_surface)),
        lrcsi_work_bytes(counts->parts, sizeof(const char *)),
        lrcsi_work_bytes(counts->facets, sizeof(lrcs_facet)),
        lrcsi_work_bytes(counts->facets, 3 * sizeof(uint32_t)),
        2 * (size_t)LRCS_WORK_ALIGN, /* those three are separate blocks */
        lrcsi_work_bytes(counts->text_bytes, 1),
        lrcsi_work_bytes(counts->vertices, sizeof(lrcs_point)),
        counts->normals ? lrcsi_work_bytes(counts->facets, sizeof(lrcs_facet)) : 0,
        lrcsi_work_bytes(counts->normals, sizeof(lrcs_point)),
        /* scratch: names of materials and parts; welded vertices in a table, or a mark of each
           facet */
        lrcsi_work_bytes(counts->materials, sizeof(const char *)),
        lrcsi_index_need(counts->materials),
        lrcsi_index_need(counts->parts),
        table > marks ? table : marks,
    };
    size_t bytes = 0;
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) {
        bytes = lrcsi_work_add(bytes, block[i]);
    }
    return bytes;
}
