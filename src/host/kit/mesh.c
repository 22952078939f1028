/* SPDX-License-Identifier: MIT */
/* Makes the facets of a scene of a kit from its row. This file decides their order, their winding
   (counter-clockwise seen from outside) and the division into facets; all coordinates are rounded
   to single precision, so that a code that works in single precision starts from the same body. It
   has simple loops of its own: a kit from the engine's own meshes would not test them. */
#include "host/kit/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The item that is being built. */
typedef struct mesh_build {
    lrcsi_vectors_mesh *mesh;
    const lrcsi_vectors_scene *scene;
    const lrcsi_vectors_item *item;
    lrcs_pose rotation; /* of the item */
    uint32_t first;     /* first vertex of the item: earlier ones are not shared */
} mesh_build;

static void *room_grow(void *list, uint32_t *room, uint32_t used, size_t size)
{
    if (used < *room) {
        return list;
    }
    *room = *room ? 2 * *room : 256;
    void *grown = realloc(list, *room * size);
    if (!grown) {
        free(list);
    }
    return grown;
}

/* The index of a point of the item, in the scene's coordinates and in single precision; points of
   the same item are shared. */
static uint32_t mesh_point(mesh_build *build, const double p[3])
{
    lrcsi_vectors_mesh *mesh = build->mesh;
    lrcs_point placed;
    for (int k = 0; k < 3; k++) {
        const double *row = build->rotation.R[k];
        double at = build->item->at[k];
        double x = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + at;
        x = fabs(x) < 1e-12 && at == 0.0 ? 0.0 : x; /* rounding error of a rotation */
        placed.x[k] = (double)(float)((x + build->scene->move[k]) * build->scene->scale);
    }
    for (uint32_t i = build->first; i < mesh->vertices; i++) {
        if (memcmp(&mesh->vertex[i], &placed, sizeof placed) == 0) {
            return i;
        }
    }
    mesh->vertex = room_grow(mesh->vertex, &mesh->vertex_room, mesh->vertices, sizeof placed);
    mesh->failed |= !mesh->vertex;
    if (mesh->failed) {
        return 0;
    }
    mesh->vertex[mesh->vertices] = placed;
    return mesh->vertices++;
}

/* Adds a triangle unless two of its corners coincide. */
static void mesh_triangle(mesh_build *build, size_t face, const double *a, const double *b,
                          const double *c)
{
    lrcsi_vectors_mesh *mesh = build->mesh;
    const char *letters = build->item->material; /* the last one applies to all other faces */
    char letter = letters[face < strlen(letters) ? face : strlen(letters) - 1];
    uint32_t material = 0;
    if (letter == '-' || mesh->failed) {
        return;
    }
    while (lrcsi_vectors_materials[material].name &&
           lrcsi_vectors_materials[material].letter != letter) {
        material++;
    }
    uint32_t room = mesh->facet_room;
    lrcs_facet facet = {{mesh_point(build, a), mesh_point(build, b), mesh_point(build, c)}};
    const uint32_t *v = facet.corner;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
        return;
    }
    mesh->facet = room_grow(mesh->facet, &mesh->facet_room, mesh->facets, sizeof facet);
    mesh->material = room_grow(mesh->material, &room, mesh->facets, sizeof *mesh->material);
    mesh->failed |= !mesh->facet || !mesh->material;
    if (!mesh->failed) {
        mesh->material[mesh->facets] = material;
        mesh->facet[mesh->facets++] = facet;
    }
}

static void mesh_quad(mesh_build *build, size_t face, double p[4][3])
{
    mesh_triangle(build, face, p[0], p[1], p[2]);
    mesh_triangle(build, face, p[0], p[2], p[3]);
}

static void mesh_box(mesh_build *build)
{
    const double *size = build->item->size;
    for (size_t face = 0; face < 6; face++) {
        size_t axis = face / 2;
        size_t u = (axis + 1 + face % 2) % 3;
        size_t v = (axis + 2 - face % 2) % 3;
        double p[4][3];
        for (int k = 0; k < 4; k++) {
            p[k][axis] = (face % 2 ? -size[axis] : size[axis]) / 2;
            p[k][u] = (k == 1 || k == 2 ? size[u] : -size[u]) / 2;
            p[k][v] = (k >= 2 ? size[v] : -size[v]) / 2;
        }
        mesh_quad(build, face, p);
    }
}

/* A point of a circle; those at multiples of 90 deg are exact. */
static void circle_point(double radius, int i, int count, double z, double p[3])
{
    double angle = 2.0 * LRCS_PI * i / count;
    p[0] = 4 * i % (2 * count) == count ? 0.0 : radius * cos(angle);
    p[1] = 2 * i % count == 0 ? 0.0 : radius * sin(angle);
    p[2] = z;
}

/* Adds the surface between two circles, given by their radii and heights, from below. */
static void mesh_belt(mesh_build *build, double r0, double z0, double r1, double z1)
{
    int count = build->item->count;
    for (int i = 0; i < count; i++) {
        int next = (i + 1) % count;
        double p[4][3];
        circle_point(r0, i, count, z0, p[0]);
        circle_point(r0, next, count, z0, p[1]);
        circle_point(r1, next, count, z1, p[2]);
        circle_point(r1, i, count, z1, p[3]);
        mesh_quad(build, 0, p);
    }
}

/* A cap as a triangle fan from its first corner, seen from above or from below. */
static void mesh_cap(mesh_build *build, size_t face, double radius, double z)
{
    int count = build->item->count;
    for (int i = 1; radius > 0.0 && i + 1 < count; i++) {
        double p[3][3];
        int below = face == 2;
        circle_point(radius, 0, count, z, p[0]);
        circle_point(radius, below ? i + 1 : i, count, z, p[1]);
        circle_point(radius, below ? i : i + 1, count, z, p[2]);
        mesh_triangle(build, face, p[0], p[1], p[2]);
    }
}

static void mesh_ball(mesh_build *build)
{
    double radius = build->item->size[0];
    int rings = build->item->count / 2;
    for (int i = 0; i < rings; i++) {
        double low[3];
        double high[3]; /* radius of the ring, -, height */
        circle_point(radius, 3 * rings + 2 * i, 4 * rings, 0.0, low);
        circle_point(radius, 3 * rings + 2 * (i + 1), 4 * rings, 0.0, high);
        mesh_belt(build, i ? low[0] : 0.0, low[1], i + 1 < rings ? high[0] : 0.0, high[1]);
    }
}

/* Neighbouring corners have different heights, which are the same on every machine. */
static void mesh_quilt(mesh_build *build)
{
    const lrcsi_vectors_item *item = build->item;
    int count = item->count;
    for (int i = 0; i < count * count; i++) {
        double p[4][3];
        for (int k = 0; k < 4; k++) {
            int x = i % count + (k == 1 || k == 2);
            int y = i / count + (k >= 2);
            p[k][0] = item->size[0] * (x / (double)count - 0.5);
            p[k][1] = item->size[1] * (y / (double)count - 0.5);
            p[k][2] = item->size[2] * ((7 * x + 3 * y + x * y) % 5 - 2);
        }
        mesh_quad(build, 0, p);
    }
}

static void mesh_fan(mesh_build *build)
{
    const lrcsi_vectors_item *item = build->item;
    for (int i = 0; i < item->count; i++) {
        double p[3][3] = {{0, 0, 0}};
        circle_point(item->size[0], i, item->count, 0.0, p[1]);
        circle_point(item->size[0], (i + 1) % item->count, item->count, 0.0, p[2]);
        mesh_triangle(build, 0, p[0], p[1], p[2]);
    }
}

static void mesh_item(mesh_build *build)
{
    const double *size = build->item->size;
    double x = size[0] / 2;
    double y = size[1] / 2;
    double plate[4][3] = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
    build->first = build->mesh->vertices;
    switch (build->item->kind) {
    case LRCSI_VECTORS_PLATE:
        mesh_quad(build, 0, plate);
        break;
    case LRCSI_VECTORS_BOX:
        mesh_box(build);
        break;
    case LRCSI_VECTORS_ROUND:
        mesh_belt(build, size[0], -size[2] / 2, size[1], size[2] / 2);
        mesh_cap(build, 1, size[1], size[2] / 2);
        mesh_cap(build, 2, size[0], -size[2] / 2);
        break;
    case LRCSI_VECTORS_BALL:
        mesh_ball(build);
        break;
    case LRCSI_VECTORS_QUILT:
        mesh_quilt(build);
        break;
    default:
        mesh_fan(build);
        break;
    }
}

int lrcsi_vectors_mesh_make(const lrcsi_vectors_scene *scene, lrcsi_vectors_mesh *mesh,
                            lrcs_host_error *error)
{
    mesh_build build = {.mesh = mesh, .scene = scene};
    memset(mesh, 0, sizeof *mesh);
    for (int i = 0; scene->item[i].kind != LRCSI_VECTORS_NONE; i++) {
        build.item = &scene->item[i];
        int status = lrcs_pose_from_euler("XYZ", build.item->rotate_deg, &build.rotation);
        if (status != LRCS_OK) {
            return lrcsi_host_fail(error, status, "%s: %s", scene->name, lrcs_status_text(status));
        }
        mesh_item(&build);
    }
    return mesh->failed ? lrcsi_host_out_of_memory(error) : LRCS_OK;
}

void lrcsi_vectors_mesh_free(lrcsi_vectors_mesh *mesh)
{
    free(mesh->vertex);
    free(mesh->facet);
    free(mesh->material);
    memset(mesh, 0, sizeof *mesh);
}
