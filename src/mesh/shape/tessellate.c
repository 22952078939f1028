/* SPDX-License-Identifier: MIT */
/* A shape's facet mesh, row by row from the base up. revolution.c decides the positions of the rows
   and proves their errors; this file places vertices and joins them. Azimuths are exact fractions
   of a turn, folded to an eighth of it, so that the mesh has the exact symmetry of its polygon. */
#include "mesh/shape/tessellate.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/work.h"
#include "mesh/shape/revolution.h"
#include "mesh/store.h"

#define SQRT_HALF   0.70710678118654752440
#define WALL_SMOOTH 1u /* smoothing group of a curved wall; flat parts are hard */

/* A disc of many sides is not a fan of slivers that all meet at its centre. Instead it has rows
   inside, each with about an eighth of the sides of the row around it. */
#define INNER_SIDES_MIN 64u /* a polygon with this many sides or more gets a row inside */
#define INNER_ROWS_MAX  10

/* A mesh under construction: the last row placed, and the direction of z. */
typedef struct row_builder {
    lrcs_mesh *mesh;
    uint32_t first;  /* first vertex of the last row */
    uint32_t count;  /* its vertices: 0 none yet, 1 a point, else a polygon's */
    double mirror;   /* 1, or -1: z negated and winding reversed */
    uint32_t smooth; /* smoothing group of the next facets */
} row_builder;

static int shape_has_apex(const lrcs_shape *shape)
{
    return lrcsi_shape_is_round(shape->kind) || shape->kind == LRCS_SHAPE_CONE;
}

/* The number of discs that ALL adds: one if the wall has an apex, two if it has none. */
static uint32_t shape_caps(const lrcs_shape *shape)
{
    if (shape->parts == LRCS_SHAPE_WALL || shape->kind == LRCS_SHAPE_SPHERE ||
        shape->kind == LRCS_SHAPE_DISC) {
        return 0;
    }
    return shape_has_apex(shape) ? 1 : 2;
}

/* cos and sin of k/n of a full turn, n a multiple of 4: at k = 0 exactly (1, 0), and exactly
   symmetric under the symmetries of the square. Error at most 2 units in the last place. */
static void circle_fraction(uint32_t k, uint32_t n, double *c, double *s)
{
    uint32_t quarter = n / 4;
    uint32_t remainder = k % quarter;
    uint32_t fold = 2 * remainder > quarter ? quarter - remainder : remainder;
    double angle = (2.0 * LRCS_PI) * (double)fold / (double)n;
    double x = 2 * fold == quarter ? SQRT_HALF : cos(angle);
    double y = 2 * fold == quarter ? SQRT_HALF : sin(angle);
    double cosine = 2 * remainder > quarter ? y : x;
    double sine = 2 * remainder > quarter ? x : y;
    switch (k / quarter) {
    case 0:
        *c = cosine;
        *s = sine;
        return;
    case 1:
        *c = -sine;
        *s = cosine;
        return;
    case 2:
        *c = -cosine;
        *s = -sine;
        return;
    default:
        *c = sine;
        *s = -cosine;
        return;
    }
}

static void mesh_vertex(lrcs_mesh *mesh, double x, double y, double z)
{
    /* + 0.0 turns -0 into 0 */
    mesh->vertex[mesh->vertex_count++] = (lrcs_point){{x + 0.0, y + 0.0, z + 0.0}};
}

static void mesh_facet(lrcs_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t smooth)
{
    uint32_t i = mesh->facet_count++;
    mesh->facet[i] = (lrcs_facet){{a, b, c}};
    mesh->facet_smooth[i] = smooth;
}

/* Adds a facet a, b, c, counter-clockwise seen from outside if z is not mirrored. */
static void row_facet(const row_builder *row, uint32_t a, uint32_t b, uint32_t c)
{
    if (row->mirror > 0.0) {
        mesh_facet(row->mesh, a, b, c, row->smooth);
    } else {
        mesh_facet(row->mesh, a, c, b, row->smooth);
    }
}

/* The corner of a polygon with `few` corners that is nearest to the middle of side k of one with
   `many`. */
static uint32_t row_nearest(uint32_t k, uint32_t many, uint32_t few)
{
    return (uint32_t)(((2 * (uint64_t)k + 1) * few + many) / (2 * (uint64_t)many)) % few;
}

/* Joins the last row to one with fewer or more corners: each side of the longer row is joined to
   the nearest corner of the shorter one. Of two polygons about one centre, the shorter one inside,
   the facets do not overlap: a side's ends lie, seen from the centre, between that corner and one
   of its neighbours, so that they are beyond the side that joins those two. */
static void row_join_unequal(const row_builder *row, uint32_t first, uint32_t count)
{
    int inward = row->count > count;
    uint32_t many = inward ? row->count : count;
    uint32_t few = inward ? count : row->count;
    uint32_t outer = inward ? row->first : first;
    uint32_t inner = inward ? first : row->first;
    for (uint32_t k = 0; k < many; k++) {
        uint32_t next = k + 1 < many ? k + 1 : 0;
        uint32_t at = row_nearest(k, many, few);
        uint32_t then = row_nearest(next, many, few);
        uint32_t a = outer + k;
        uint32_t b = outer + next;
        row_facet(row, inward ? a : b, inward ? b : a, inner + at);
        if (then != at) {
            row_facet(row, b, inner + (inward ? then : at), inner + (inward ? at : then));
        }
    }
}

/* Joins the last row to the one that starts at `first` with `count` vertices. */
static void row_join(const row_builder *row, uint32_t first, uint32_t count)
{
    if (row->count > 1 && count > 1 && row->count != count) {
        row_join_unequal(row, first, count);
        return;
    }
    uint32_t around = row->count > count ? row->count : count;
    for (uint32_t k = 0; k < around; k++) {
        uint32_t next = k + 1 < around ? k + 1 : 0;
        if (row->count > 1) {
            row_facet(row, row->first + k, row->first + next, count > 1 ? first + next : first);
        }
        if (count > 1) {
            row_facet(row, row->count > 1 ? row->first + k : row->first, first + next, first + k);
        }
    }
}

/* Adds a row: a point on the axis (count 1), or a polygon of the circle of radius r. */
static void row_add(row_builder *row, double r, double z, uint32_t count)
{
    lrcs_mesh *mesh = row->mesh;
    uint32_t first = mesh->vertex_count;
    for (uint32_t k = 0; k < count; k++) {
        double c = 0.0;
        double s = 0.0;
        if (count > 1) {
            circle_fraction(k, count, &c, &s);
        }
        mesh_vertex(mesh, r * c, r * s, row->mirror * z);
    }
    if (row->count > 0) {
        row_join(row, first, count);
    }
    row->first = first;
    row->count = count;
}

/* The rows inside a polygon of `around` sides, the widest first: their numbers of corners, and
   their radii as fractions of the polygon's. A row is half as far inside the one around it as its
   own sides are long. Returns the number of rows. */
static int list_inner_rows(uint32_t around, uint32_t corners[INNER_ROWS_MAX],
                           double radius[INNER_ROWS_MAX])
{
    int rows = 0;
    double r = 1.0;
    while (around >= INNER_SIDES_MIN && rows < INNER_ROWS_MAX) {
        around = 4 * ((around + 16) / 32);
        r *= 1.0 - LRCS_PI / around;
        corners[rows] = around;
        radius[rows++] = r;
    }
    return rows;
}

/* Fills the disc from the last row, a polygon of radius r, to its centre. */
static void disc_close(row_builder *row, double r, double z)
{
    uint32_t corners[INNER_ROWS_MAX];
    double radius[INNER_ROWS_MAX];
    int rows = list_inner_rows(row->count, corners, radius);
    for (int i = 0; i < rows; i++) {
        row_add(row, r * radius[i], z, corners[i]);
    }
    row_add(row, 0.0, z, 1);
}

/* The same from the centre out to a polygon of `around` corners, which is then the last row. */
static void disc_open(row_builder *row, double r, double z, uint32_t around)
{
    uint32_t corners[INNER_ROWS_MAX];
    double radius[INNER_ROWS_MAX];
    row_add(row, 0.0, z, 1);
    for (int i = list_inner_rows(around, corners, radius); i > 0; i--) {
        row_add(row, r * radius[i - 1], z, corners[i - 1]);
    }
    row_add(row, r, z, around);
}

/* Adds rows 1 .. zones of the wall above the last row, which is at z = 0. */
static double wall_add(row_builder *row, const lrcsi_revolution *body, int apex)
{
    uint32_t around = row->count;
    lrcsi_dd z = {0.0, 0.0};
    for (uint32_t i = 0; i < body->zones; i++) {
        z = lrcsi_dd_add(z, (lrcsi_dd){lrcsi_revolution_rise(body, i), 0.0});
        int last = i + 1 == body->zones;
        row_add(row, body->vertex_ratio * lrcsi_revolution_radius(body, i + 1), lrcsi_dd_value(z),
                last && apex ? 1 : around);
    }
    return lrcsi_dd_value(z);
}

static void revolve(const lrcs_shape *shape, const lrcs_divisions *divisions, lrcs_mesh *mesh)
{
    lrcsi_revolution body = lrcsi_revolution_make(shape, divisions);
    uint32_t caps = shape_caps(shape);
    double base = body.vertex_ratio * body.base;
    row_builder row = {mesh, 0, 0, 1.0, 0};
    if (caps > 0) {
        disc_open(&row, base, 0.0, divisions->around);
    } else {
        row_add(&row, base, 0.0, divisions->around);
    }
    uint32_t rim = row.first;
    row.smooth = WALL_SMOOTH;
    double top = wall_add(&row, &body, shape_has_apex(shape));
    if (shape->kind == LRCS_SHAPE_SPHERE) {
        row.first = rim;
        row.count = divisions->around;
        row.mirror = -1.0;
        wall_add(&row, &body, 1);
    }
    row.smooth = 0;
    if (caps == 2 || shape->kind == LRCS_SHAPE_DISC) {
        double r = shape->kind == LRCS_SHAPE_DISC
                       ? base
                       : body.vertex_ratio * lrcsi_revolution_radius(&body, body.zones);
        disc_close(&row, r, top);
    }
}

static void make_plate(const double size[3], lrcs_mesh *mesh)
{
    double x = 0.5 * size[0];
    double y = 0.5 * size[1];
    mesh_vertex(mesh, -x, -y, 0.0);
    mesh_vertex(mesh, x, -y, 0.0);
    mesh_vertex(mesh, x, y, 0.0);
    mesh_vertex(mesh, -x, y, 0.0);
    mesh_facet(mesh, 0, 1, 2, 0);
    mesh_facet(mesh, 0, 2, 3, 0);
}

static void make_box(const double size[3], lrcs_mesh *mesh)
{
    static const unsigned char face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (int i = 0; i < 8; i++) {
        mesh_vertex(mesh, 0.5 * (i & 1 ? size[0] : -size[0]), 0.5 * (i & 2 ? size[1] : -size[1]),
                    0.5 * (i & 4 ? size[2] : -size[2]));
    }
    for (int f = 0; f < 6; f++) {
        mesh_facet(mesh, face[f][0], face[f][1], face[f][2], 0);
        mesh_facet(mesh, face[f][0], face[f][2], face[f][3], 0);
    }
}

/* Vertices inside a disc's rim, and its facets: each row adds as many facets as it and the
   row around it have corners, the centre as many as the last row. */
static void disc_counts(uint32_t around, uint64_t *vertices, uint64_t *facets)
{
    uint32_t corners[INNER_ROWS_MAX];
    double radius[INNER_ROWS_MAX];
    int rows = list_inner_rows(around, corners, radius);
    *vertices = 1;
    *facets = around;
    for (int i = 0; i < rows; i++) {
        *vertices += corners[i];
        *facets += 2 * (uint64_t)corners[i];
    }
}

/* Vertices and facets of a body of revolution. */
static void revolved_counts(const lrcs_shape *shape, const lrcs_divisions *divisions,
                            uint64_t *vertices, uint64_t *facets)
{
    uint64_t around = divisions->around;
    uint64_t zones = shape->kind == LRCS_SHAPE_DISC ? 0 : divisions->along;
    uint64_t caps = shape_caps(shape) + (shape->kind == LRCS_SHAPE_DISC ? 1u : 0u);
    uint64_t apex = shape_has_apex(shape) ? 1 : 0;
    uint64_t inside = 0;
    uint64_t cap = 0;
    disc_counts(divisions->around, &inside, &cap);
    *vertices = around * (1 + zones - apex) + apex + caps * inside;
    *facets = around * (2 * zones - apex) + caps * cap;
    if (shape->kind == LRCS_SHAPE_SPHERE) {
        *vertices = 2 * *vertices - around;
        *facets *= 2;
    }
}

/* The facets of a wall follow those of the cap below it, zone by zone and sector by sector. */
int lrcsi_tessellate_patch(const lrcs_shape *shape, const lrcs_divisions *divisions, uint32_t facet,
                           lrcsi_wall_patch *patch)
{
    uint64_t inside = 0;
    uint64_t cap = 0;
    if (lrcsi_shape_is_plane_faced(shape->kind) || shape->kind == LRCS_SHAPE_DISC) {
        return 0;
    }
    if (shape_caps(shape) > 0) {
        disc_counts(divisions->around, &inside, &cap);
    }
    uint64_t around = divisions->around;
    uint64_t apex = shape_has_apex(shape) ? 1 : 0;
    uint64_t wall = around * (2 * (uint64_t)divisions->along - apex);
    uint64_t halves = shape->kind == LRCS_SHAPE_SPHERE ? 2 : 1;
    if (facet < cap || facet - cap >= halves * wall) {
        return 0;
    }
    uint64_t place = facet - cap;
    patch->mirrored = place >= wall;
    place -= patch->mirrored ? wall : 0;
    patch->row = (uint32_t)(place / (2 * around));
    patch->facets = apex && patch->row + 1 == divisions->along ? 1 : 2;
    patch->sector = (uint32_t)(place % (2 * around) / patch->facets);
    return 1;
}

int lrcsi_tessellate_fits(const lrcs_shape *shape, const lrcs_divisions *divisions)
{
    uint32_t around = divisions->around;
    uint32_t along = divisions->along;
    if (lrcsi_shape_is_plane_faced(shape->kind)) {
        return around == 4 && along == 1;
    }
    if (around < 8 || around > LRCSI_AROUND_MAX || around % 4 != 0 || along < 1 ||
        along > LRCSI_ALONG_MAX || (along > 1 && !lrcsi_shape_is_round(shape->kind))) {
        return 0;
    }
    uint64_t vertices = 0;
    uint64_t facets = 0;
    revolved_counts(shape, divisions, &vertices, &facets);
    return vertices < LRCS_NONE && facets < LRCS_NONE;
}

lrcs_mesh_counts lrcsi_tessellate_counts(const lrcs_shape *shape, const lrcs_divisions *divisions)
{
    uint64_t vertices = shape->kind == LRCS_SHAPE_BOX ? 8 : 4;
    uint64_t facets = shape->kind == LRCS_SHAPE_BOX ? 12 : 2;
    if (!lrcsi_shape_is_plane_faced(shape->kind)) {
        revolved_counts(shape, divisions, &vertices, &facets);
    }
    return (lrcs_mesh_counts){.vertices = (uint32_t)vertices,
                              .facets = (uint32_t)facets,
                              .parts = 1,
                              .text_bytes = strlen(lrcs_shape_text(shape->kind)) + 1};
}

lrcs_patch_bounds lrcsi_tessellate_patch_bounds(const lrcs_shape *shape,
                                                const lrcs_divisions *divisions)
{
    if (lrcsi_shape_is_plane_faced(shape->kind)) {
        return (lrcs_patch_bounds){0.0, 0.0, 0.0, 0.0};
    }
    lrcsi_revolution body = lrcsi_revolution_make(shape, divisions);
    return lrcsi_revolution_patch_bounds(&body);
}

lrcsi_reach lrcsi_tessellate_reach(const lrcs_shape *shape, const lrcs_divisions *divisions)
{
    if (lrcsi_shape_is_plane_faced(shape->kind)) {
        return (lrcsi_reach){.all = 0.0};
    }
    lrcsi_revolution body = lrcsi_revolution_make(shape, divisions);
    return lrcsi_revolution_reach(&body);
}

int lrcs_shape_mesh(const lrcs_shape *shape, const lrcs_divisions *divisions, lrcs_work *work,
                    lrcs_mesh *mesh, lrcs_patch_bounds *bounds)
{
    if (lrcs_shape_check(shape, NULL) != LRCS_OK || !lrcsi_tessellate_fits(shape, divisions)) {
        return LRCS_E_ARGUMENT;
    }
    lrcs_mesh_counts counts = lrcsi_tessellate_counts(shape, divisions);
    lrcs_mesh made;
    char *name;
    if (lrcsi_store_take(&counts, work, &made, &name) != LRCS_OK) {
        return LRCS_E_MEMORY;
    }
    memcpy(name, lrcs_shape_text(shape->kind), counts.text_bytes);
    made.part[0] = name;
    made.vertex_count = made.facet_count = 0; /* of those added so far */
    if (shape->kind == LRCS_SHAPE_PLATE) {
        make_plate(shape->size, &made);
    } else if (shape->kind == LRCS_SHAPE_BOX) {
        make_box(shape->size, &made);
    } else {
        revolve(shape, divisions, &made);
    }
    *mesh = made;
    if (bounds) {
        *bounds = lrcsi_tessellate_patch_bounds(shape, divisions);
    }
    return LRCS_OK;
}
