/* SPDX-License-Identifier: MIT */
/* Bytes to a mesh by one reader: count and read agree, the mesh keeps what mesh.h promises and can
   be checked, and with less memory than needed nothing is touched. */
#ifndef TEST_FUZZ_MESH_H
#define TEST_FUZZ_MESH_H

#include <math.h>

#include "fuzz.h"

typedef struct fuzz_reader {
    int (*count)(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
    int (*read)(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                lrcs_where *where);
} fuzz_reader;

static inline void require_facet(const lrcs_mesh *mesh, uint32_t f)
{
    for (int k = 0; k < 3; k++) {
        require(mesh->facet[f].corner[k] < mesh->vertex_count);
        require(!mesh->facet_normal || mesh->facet_normal[f].corner[k] == LRCS_NONE ||
                mesh->facet_normal[f].corner[k] < mesh->normal_count);
    }
    require(mesh->facet_part[f] < mesh->part_count);
    require(mesh->facet_material[f] == LRCS_NONE || mesh->facet_material[f] < mesh->material_count);
}

static inline void require_mesh(const lrcs_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            require(fabs(mesh->vertex[i].x[k]) <= 1e100);
        }
    }
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        require_facet(mesh, i);
    }
    for (uint32_t i = 0; i < mesh->material_count; i++) {
        require(mesh->material[i].name != NULL);
        require(mesh->material[i].transparency >= 0 && mesh->material[i].transparency <= 1);
    }
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        require(mesh->part[i] != NULL);
    }
}

static inline void require_report(const lrcs_mesh *mesh)
{
    lrcs_work work = fuzz_area(lrcs_mesh_check_need(mesh->vertex_count, mesh->facet_count));
    lrcs_mesh_report r;
    require(lrcs_mesh_check(mesh->vertex, mesh->vertex_count, mesh->facet, mesh->facet_count, &work,
                            &r) == LRCS_OK);
    require(r.area >= 0 && isfinite(r.area) && isfinite(r.volume));
    require(r.degenerate + r.duplicate <= mesh->facet_count && r.opposite_pairs <= r.duplicate);
    require(!r.convex || r.closed);
    free(work.bytes);
}

/* Room for a part of what is needed, a different one for every size of input. */
static inline void require_refusal(const fuzz_reader *reader, const void *bytes, size_t size,
                                   size_t need)
{
    lrcs_work work = fuzz_area((size * 2654435761u) % (need + 1));
    lrcs_mesh mesh;
    memset(&mesh, FUZZ_PATTERN, sizeof mesh);
    int status = reader->read(bytes, size, &work, &mesh, NULL);
    if (status == LRCS_OK) {
        require_mesh(&mesh);
    } else {
        require(status == LRCS_E_MEMORY && work.used == 0 && work.peak > work.size);
        require(fuzz_untouched(&mesh, sizeof mesh));
    }
    free(work.bytes);
}

static inline int fuzz_mesh(const fuzz_reader *reader, const void *bytes, size_t size)
{
    lrcs_mesh_counts counts;
    lrcs_where where;
    lrcs_format_check(bytes, size, NULL);
    int status = reader->count(bytes, size, &counts, &where);
    if (status != LRCS_OK) {
        require_where(&where, size);
        return 0;
    }
    size_t need = lrcs_mesh_need(&counts);
    lrcs_work work = fuzz_area(need);
    lrcs_mesh mesh;
    require(reader->read(bytes, size, &work, &mesh, &where) == LRCS_OK);
    require(work.peak <= need && mesh.facet_count == counts.facets);
    require_mesh(&mesh);
    require_report(&mesh);
    free(work.bytes);
    require_refusal(reader, bytes, size, need);
    return 0;
}

#endif
