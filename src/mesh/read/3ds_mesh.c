/* SPDX-License-Identifier: MIT */
/* Reads one mesh of a 3DS file: vertices as stored, faces, material groups and smoothing groups, in
   any order. Its matrix is checked but never applied: the vertices already are in world space. */
#include "mesh/read/3ds.h"

#include <math.h>

#include "base/bytes.h"

/* One mesh: its two lists, wherever they are among its chunks, and the index of its first items in
   the whole. */
typedef struct tds_trimesh {
    lrcsi_tds_chunk vertices, faces; /* end = 0: none seen */
    uint32_t vertex_count, face_count;
    uint32_t first_vertex, first_facet;
} tds_trimesh;

/* Records a list of a mesh and its count. A second list of the same kind is refused, because no
   reader could decide which one the faces refer to. */
static int tds_find_list(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk, size_t size,
                         lrcsi_tds_chunk *list, uint32_t *count, const char *item)
{
    int status = lrcsi_tds_check(walk, &chunk, 1, 2, item);
    if (status != LRCS_OK) {
        return status;
    }
    if (list->end != 0) {
        return lrcsi_tds_fail(walk, LRCS_E_SYNTAX, chunk.at, item, "one such list in a mesh", 2);
    }
    *count = lrcsi_bytes_u16(walk->bytes + chunk.at);
    chunk.at += 2;
    *list = chunk;
    return lrcsi_tds_check(walk, &chunk, *count, size, item);
}

static int tds_read_vertices(const lrcsi_tds_walk *walk, const tds_trimesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        for (size_t k = 0; k < 3; k++) {
            size_t at = mesh->vertices.at + 12 * i + 4 * k;
            double value = lrcsi_bytes_float(walk->bytes + at);
            if (!isfinite(value)) {
                return lrcsi_tds_fail(walk, LRCS_E_NUMBER, at, "vertex coordinate",
                                      "a finite number (found: its bits)",
                                      lrcsi_bytes_u32(walk->bytes + at));
            }
            if (walk->mesh) {
                walk->mesh->vertex[mesh->first_vertex + i].x[k] = value;
            }
        }
    }
    return LRCS_OK;
}

static int tds_read_faces(const lrcsi_tds_walk *walk, const tds_trimesh *mesh)
{
    for (size_t i = 0; i < mesh->face_count; i++) {
        size_t at = mesh->faces.at + 8 * i;
        for (size_t k = 0; k < 3; k++) {
            unsigned corner = lrcsi_bytes_u16(walk->bytes + at + 2 * k);
            if (corner >= mesh->vertex_count) {
                return lrcsi_tds_fail(walk, LRCS_E_INDEX, at + 2 * k, "face index",
                                      "less than the mesh's vertex count", corner);
            }
            if (walk->mesh) {
                walk->mesh->facet[mesh->first_facet + i].corner[k] = mesh->first_vertex + corner;
            }
        }
        if (walk->mesh) {
            walk->mesh->facet_part[mesh->first_facet + i] = walk->counts.parts;
        }
    }
    return LRCS_OK;
}

/* A material group: the material's name, a count, and that many faces. Of two groups with a face in
   common the last counts. */
static int tds_read_group(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk, const tds_trimesh *mesh)
{
    lrcsi_span name;
    size_t count = 0;
    int status = lrcsi_tds_name(walk, &chunk, &name, "material group name");
    if (status == LRCS_OK) {
        status = lrcsi_tds_check(walk, &chunk, 1, 2, "material group count");
    }
    if (status == LRCS_OK) {
        count = lrcsi_bytes_u16(walk->bytes + chunk.at);
        chunk.at += 2;
        status = lrcsi_tds_check(walk, &chunk, count, 2, "material group");
    }
    if (status != LRCS_OK) {
        return status;
    }
    uint32_t material = LRCS_NONE;
    if (walk->mesh) {
        material = lrcsi_index_find(&walk->names, 0, walk->bytes + name.at, name.size);
    }
    unsigned char undefined = material == LRCS_NONE;
    for (size_t i = 0; i < count; i++) {
        unsigned face = lrcsi_bytes_u16(walk->bytes + chunk.at + 2 * i);
        if (face >= mesh->face_count) {
            return lrcsi_tds_fail(walk, LRCS_E_INDEX, chunk.at + 2 * i, "face of a material group",
                                  "less than the mesh's face count", face);
        }
        if (walk->mesh) {
            uint32_t *old = walk->mesh->facet_material + mesh->first_facet + face;
            unsigned char *old_undefined = walk->undefined + mesh->first_facet + face;
            int in_group = *old != LRCS_NONE || *old_undefined;
            if (in_group && *old != material) {
                walk->notices |= LRCS_MESH_OVERLAPPING_GROUPS;
            }
            *old = material;
            *old_undefined = undefined;
        }
    }
    return LRCS_OK;
}

/* 3 x 3 axes, then the origin. */
static int tds_read_matrix(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk)
{
    int status = lrcsi_tds_check(walk, &chunk, 12, 4, "mesh matrix");
    for (size_t i = 0; status == LRCS_OK && i < 12; i++) {
        double identity = i < 9 && i % 4 == 0 ? 1.0 : 0.0;
        if (!(lrcsi_bytes_float(walk->bytes + chunk.at + 4 * i) == identity)) {
            walk->notices |= LRCS_MESH_LOCAL_MATRIX;
        }
    }
    return status;
}

/* A material group, or the smoothing groups of all faces. */
static int tds_read_detail(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk, const tds_trimesh *mesh)
{
    if (chunk.id == LRCSI_TDS_GROUP) {
        return tds_read_group(walk, chunk, mesh);
    }
    if (chunk.id != LRCSI_TDS_SMOOTHING) {
        return LRCS_OK;
    }
    int status = lrcsi_tds_check(walk, &chunk, mesh->face_count, 4, "smoothing groups");
    for (size_t i = 0; status == LRCS_OK && walk->mesh && i < mesh->face_count; i++) {
        walk->mesh->facet_smooth[mesh->first_facet + i] =
            lrcsi_bytes_u32(walk->bytes + chunk.at + 4 * i);
    }
    return status;
}

/* Groups and smoothing in their regular place, after the faces in the face list. */
static int tds_read_face_details(lrcsi_tds_walk *walk, const tds_trimesh *mesh)
{
    lrcsi_tds_chunk inside = mesh->faces;
    inside.at += 8 * (size_t)mesh->face_count;
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &inside, &chunk)) > 0) {
        int status = tds_read_detail(walk, chunk, mesh);
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

/* Groups and smoothing in file order, including those outside the face list. */
static int tds_read_details(lrcsi_tds_walk *walk, lrcsi_tds_chunk parent, const tds_trimesh *mesh)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &parent, &chunk)) > 0) {
        int status = chunk.id == LRCSI_TDS_FACES ? tds_read_face_details(walk, mesh)
                                                 : tds_read_detail(walk, chunk, mesh);
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

/* Finds the lists of a mesh among its chunks. */
static int tds_find_lists(lrcsi_tds_walk *walk, lrcsi_tds_chunk parent, tds_trimesh *mesh)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &parent, &chunk)) > 0) {
        int status = LRCS_OK;
        if (chunk.id == LRCSI_TDS_VERTICES) {
            status =
                tds_find_list(walk, chunk, 12, &mesh->vertices, &mesh->vertex_count, "vertex list");
        } else if (chunk.id == LRCSI_TDS_FACES) {
            status = tds_find_list(walk, chunk, 8, &mesh->faces, &mesh->face_count, "face list");
        } else if (chunk.id == LRCSI_TDS_MATRIX) {
            status = tds_read_matrix(walk, chunk);
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

int lrcsi_tds_read_trimesh(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk, const char *name)
{
    tds_trimesh mesh = {.first_vertex = walk->counts.vertices, .first_facet = walk->counts.facets};
    int status = tds_find_lists(walk, chunk, &mesh);
    if (status == LRCS_OK) {
        status = tds_read_vertices(walk, &mesh);
    }
    if (status == LRCS_OK) {
        status = tds_read_faces(walk, &mesh);
    }
    if (status == LRCS_OK) {
        status = tds_read_details(walk, chunk, &mesh);
    }
    if (status != LRCS_OK) {
        return status;
    }
    for (size_t i = 0; walk->mesh && i < mesh.face_count; i++) {
        if (walk->undefined[mesh.first_facet + i]) {
            walk->notices |= LRCS_MESH_UNDEFINED_MATERIAL;
        }
    }
    if (walk->mesh) {
        walk->mesh->part[walk->counts.parts] = name;
    }
    status = lrcsi_tds_add(walk, &walk->counts.vertices, mesh.vertex_count, chunk.at, "vertices");
    if (status == LRCS_OK) {
        status = lrcsi_tds_add(walk, &walk->counts.facets, mesh.face_count, chunk.at, "faces");
    }
    return status == LRCS_OK ? lrcsi_tds_add(walk, &walk->counts.parts, 1, chunk.at, "mesh")
                             : status;
}
