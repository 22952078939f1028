/* SPDX-License-Identifier: MIT */
/* Builds a scene from a recipe: counts everything, then adds part after part: its materials, placed
   vertices, facets and normals. Decides the order of everything in the scene; bind.c decides
   materials, place.c positions, and the mesh layer the mesh of a shape. */
#include <math.h>
#include <string.h>

#include <lrcs/read.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/where.h"
#include "base/work.h"
#include "scene/build/bind.h"
#include "scene/build/fineness.h"
#include "scene/build/place.h"
#include "scene/build/placed_shape.h"
#include "scene/build/smooth.h"

typedef struct scene_builder {
    const lrcs_recipe *recipe;
    const lrcs_mesh *models;
    const lrcs_build_options *options;
    lrcs_where *where;
    lrcsi_binder binder;
    /* Indices among the scene's materials, LRCS_NONE until such a material is added: */
    uint32_t *entry;     /* assigned material: the material of surfaces without a name */
    uint32_t unassigned; /* the same, on parts without an assigned material */
    lrcsi_fineness fineness;
} scene_builder;

/* The part that is being added to the scene. */
typedef struct scene_source {
    const lrcs_recipe_part *part;
    uint32_t assigned; /* its assigned material, or LRCS_NONE */
    uint32_t surfaces; /* index of the mesh's first material among the scene's */
    lrcsi_placer placer;
} scene_source;

lrcs_build_options lrcs_build_options_default(void)
{
    lrcs_build_options options = {1e-4, UINT32_C(1) << 21, LRCS_NORMALS_FLAT, 0, 0, NULL};
    return options;
}

/* --- errors -------------------------------------------------------------------------------- */

static int refuse_part(const scene_builder *builder, int status, const lrcs_recipe_part *part,
                       const char *expected)
{
    const char *name = part->name ? part->name : "";
    return lrcsi_where_text(builder->where, status, 0, part->line, "part", expected, name,
                            strlen(name));
}

static int refuse_memory(const scene_builder *builder)
{
    return lrcsi_where_text(builder->where, LRCS_E_MEMORY, 0, 0, "work area",
                            "lrcs_scene_need bytes", "", 0);
}

/* --- counting ------------------------------------------------------------------------------ */

static int find_assigned(const scene_builder *builder, const lrcs_recipe_part *part,
                         uint32_t *assigned)
{
    int status = lrcsi_binder_assigned(&builder->binder, part, assigned);
    return status == LRCS_OK
               ? LRCS_OK
               : lrcsi_where_text(builder->where, status, 0, part->material_line, "material",
                                  "the name of a material of the recipe or of the library",
                                  part->material, strlen(part->material));
}

/* What part i adds: the counts of its model's mesh; or of its shape's, for which it chooses the
   divisions, which depend on the assigned material. */
static int count_part(scene_builder *builder, uint32_t i, lrcs_divisions *divisions,
                      lrcs_mesh_counts *counts)
{
    const lrcs_recipe_part *part = &builder->recipe->part[i];
    if (part->file) {
        const lrcs_mesh *mesh = &builder->models[i];
        *counts = (lrcs_mesh_counts){.vertices = mesh->vertex_count,
                                     .facets = mesh->facet_count,
                                     .materials = mesh->material_count,
                                     .parts = mesh->part_count};
        return LRCS_OK;
    }
    uint32_t assigned;
    int status = find_assigned(builder, part, &assigned);
    if (status != LRCS_OK) {
        return status;
    }
    status = lrcs_shape_check(&part->shape, builder->where);
    if (status != LRCS_OK) {
        if (builder->where) {
            builder->where->line = part->line;
        }
        return status;
    }
    lrcs_material material = lrcsi_binder_unassigned(&builder->binder, assigned);
    lrcsi_fineness fineness = builder->fineness;
    if (builder->options->halvings) {
        fineness.halvings = builder->options->halvings[i];
    }
    status = lrcsi_fineness_divide(&fineness, part, &material, divisions, counts);
    return status == LRCS_OK ? LRCS_OK
                             : refuse_part(builder, status, part,
                                           "a shape, material and tolerance in their domains");
}

typedef struct scene_totals {
    uint64_t vertices, facets, materials;
    size_t scratch; /* the most temporary memory of any part: for a shape's mesh or for normals */
    int normals;    /* normals are requested, and some model has them */
} scene_totals;

/* Does part i get normals from its file? */
static int gives_normals(const scene_builder *builder, uint32_t i)
{
    return builder->options->normals != LRCS_NORMALS_FLAT && builder->recipe->part[i].file &&
           lrcsi_smooth_given(&builder->models[i]);
}

/* Counts what all parts add. divisions: part: those of its shape; NULL if they are not to
   be kept. */
static int count_scene(scene_builder *builder, lrcs_divisions *divisions, scene_totals *totals)
{
    const lrcs_recipe *recipe = builder->recipe;
    const lrcs_build_options *options = builder->options;
    builder->fineness = (lrcsi_fineness){
        .tolerance = options->division > 0.0 ? options->division : options->tolerance,
        .round_min = options->division > 0.0 ? 0.0 : LRCSI_FINENESS_ROUND,
        .max_facets = options->max_facets,
        .parts = recipe->part_count,
        .facets_only = options->facets_only};
    uint32_t shapes = 0; /* only they are divided */
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        shapes += !recipe->part[i].file;
    }
    for (uint32_t i = 0; i < recipe->part_count && shapes > 0; i++) {
        builder->fineness.area += lrcsi_fineness_area(
            &recipe->part[i], recipe->part[i].file ? &builder->models[i] : NULL);
    }
    *totals = (scene_totals){.materials = lrcsi_binder_material_count(recipe) + UINT64_C(1)};
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        lrcs_mesh_counts counts;
        lrcs_divisions unused;
        int status = count_part(builder, i, divisions ? &divisions[i] : &unused, &counts);
        if (status != LRCS_OK) {
            return status;
        }
        size_t need = recipe->part[i].file ? 0 : lrcs_mesh_need(&counts);
        if (gives_normals(builder, i)) {
            need = lrcsi_smooth_need(&builder->models[i]);
            totals->normals = 1;
        }
        totals->scratch = need > totals->scratch ? need : totals->scratch;
        totals->vertices += counts.vertices;
        totals->facets += counts.facets;
        totals->materials += counts.materials;
        if (totals->vertices >= LRCS_NONE || totals->facets >= LRCS_NONE ||
            totals->materials >= LRCS_NONE) {
            return refuse_part(builder, LRCS_E_LIMIT, &recipe->part[i],
                               "fewer than 2^32 - 1 vertices, facets and materials up to here");
        }
    }
    return LRCS_OK;
}

size_t lrcs_scene_need(const lrcs_recipe *recipe, const lrcs_mesh *models,
                       const lrcs_build_options *options)
{
    scene_builder builder = {.recipe = recipe,
                             .models = models,
                             .options = options,
                             .binder = lrcsi_binder_plain(recipe)};
    scene_totals totals;
    count_scene(&builder, NULL,
                &totals); /* if it fails, building fails too, before it needs more */
    const size_t block[] = {
        /* as scene_take takes them: */
        lrcsi_work_bytes((size_t)totals.vertices, sizeof(lrcs_point)),
        lrcsi_work_bytes((size_t)totals.facets, sizeof(lrcs_facet)),
        lrcsi_work_bytes((size_t)totals.facets, sizeof(uint32_t)),
        lrcsi_work_bytes((size_t)totals.facets, sizeof(uint32_t)),
        lrcsi_work_bytes((size_t)totals.facets, sizeof(uint32_t)),
        lrcsi_work_bytes(totals.normals ? (size_t)totals.facets : 0, 3 * sizeof(lrcs_point)),
        lrcsi_work_bytes((size_t)totals.materials, sizeof(lrcs_material)),
        lrcsi_work_bytes(recipe->part_count, sizeof(lrcs_part)),
        /* and as build and its parts do: */
        lrcsi_work_bytes(recipe->part_count, sizeof(lrcs_divisions)),
        lrcsi_binder_need(recipe),
        lrcsi_work_bytes(lrcsi_binder_material_count(recipe), sizeof(uint32_t)),
        totals.scratch,
    };
    size_t need = 0;
    for (size_t i = 0; i < sizeof block / sizeof block[0]; i++) {
        need = lrcsi_work_add(need, block[i]);
    }
    return need;
}

static int add_material(const scene_builder *builder, const lrcs_material *material,
                        lrcs_scene *scene)
{
    int status = lrcs_brdf_check(&material->brdf);
    if (status < 0) {
        return lrcsi_where_text(builder->where, status, 0, 0, "material",
                                "A, B, m >= 0 and s > 0 (0 only with A = 0)", material->name,
                                strlen(material->name));
    }
    scene->material[scene->material_count++] = *material;
    return LRCS_OK;
}

/* --- parts --------------------------------------------------------------------------------- */

/* Adds the facets of a mesh with their winding and materials; its vertices begin at the scene's
   vertex_count. A facet without a surface gets the material of the part without one, which is added
   at its first use. */
static int add_facets(scene_builder *builder, const lrcs_mesh *mesh, const scene_source *source,
                      lrcs_scene *scene)
{
    uint32_t base = scene->vertex_count;
    uint32_t *entry =
        source->assigned != LRCS_NONE ? &builder->entry[source->assigned] : &builder->unassigned;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        uint32_t to = scene->facet_count + i;
        const uint32_t *corner = mesh->facet[i].corner;
        uint32_t surface = mesh->facet_material[i];
        if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count ||
            corner[2] >= mesh->vertex_count ||
            (surface != LRCS_NONE && surface >= mesh->material_count)) {
            return refuse_part(builder, LRCS_E_INDEX, source->part,
                               "corners and materials that its mesh has");
        }
        if (surface == LRCS_NONE && *entry == LRCS_NONE) {
            lrcs_material material = lrcsi_binder_unassigned(&builder->binder, source->assigned);
            *entry = scene->material_count;
            int status = add_material(builder, &material, scene);
            if (status != LRCS_OK) {
                return status;
            }
        }
        int flip = source->placer.reflects;
        scene->facet[to] = (lrcs_facet){
            {base + corner[0], base + corner[flip ? 2 : 1], base + corner[flip ? 1 : 2]}};
        scene->facet_part[to] = scene->part_count;
        scene->facet_smooth[to] = mesh->facet_smooth[i];
        scene->facet_material[to] = surface == LRCS_NONE ? *entry : source->surfaces + surface;
    }
    return LRCS_OK;
}

/* Adds the mesh of a part: its materials, its vertices in metres, its facets. */
static int add_mesh(scene_builder *builder, const lrcs_mesh *mesh, scene_source *source,
                    lrcs_scene *scene)
{
    lrcs_part *part = &scene->part[scene->part_count];
    part->name = source->part->name;
    part->first_facet = scene->facet_count;
    part->facet_count = mesh->facet_count;
    part->articulated = source->part->joint.used;
    source->surfaces = scene->material_count;
    for (uint32_t i = 0; i < mesh->material_count; i++) {
        lrcs_material material =
            lrcsi_binder_surface(&builder->binder, source->assigned, &mesh->material[i]);
        int status = add_material(builder, &material, scene);
        if (status != LRCS_OK) {
            return status;
        }
    }
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double *placed = scene->vertex[scene->vertex_count + i].x;
        lrcsi_placer_run(&source->placer, mesh->vertex[i].x, placed);
        for (int k = 0; k < 3; k++) {
            if (!(fabs(placed[k]) <= LRCSI_COORDINATE_MAX)) {
                return refuse_part(builder, LRCS_E_NUMBER, source->part,
                                   "coordinates of at most 1e100 m after placing");
            }
        }
    }
    int status = add_facets(builder, mesh, source, scene);
    scene->vertex_count += mesh->vertex_count;
    scene->facet_count += mesh->facet_count;
    scene->part_count++;
    return status;
}

/* Adds a part that is a shape: tessellates it, and states what holds of its facets. */
static int add_shape(scene_builder *builder, scene_source *source, const lrcs_divisions *divisions,
                     lrcs_work *work, lrcs_scene *scene)
{
    size_t mark = work->used;
    lrcs_mesh mesh;
    lrcs_patch_bounds bounds;
    int status = lrcs_shape_mesh(&source->part->shape, divisions, work, &mesh, &bounds);
    if (status != LRCS_OK) {
        return status == LRCS_E_MEMORY
                   ? refuse_memory(builder)
                   : refuse_part(builder, status, source->part, "a shape that can be meshed");
    }
    lrcs_part *part = &scene->part[scene->part_count];
    double extent = lrcsi_placed_shape_extent(&mesh);
    lrcsi_placed_shape_describe(&source->part->shape, divisions, &bounds, &source->placer, extent,
                                part);
    status = add_mesh(builder, &mesh, source, scene);
    if (status == LRCS_OK) {
        lrcsi_placed_shape_normal_err(&source->placer, scene, extent, part);
    }
    work->used = mark;
    return status;
}

/* Adds part i: a shape with the given divisions, or a model with the normals that it gives. */
static int add_part(scene_builder *builder, uint32_t i, const lrcs_divisions *divisions,
                    lrcs_work *work, lrcs_scene *scene)
{
    scene_source source;
    memset(&source, 0, sizeof source);
    source.part = &builder->recipe->part[i];
    int status = find_assigned(builder, source.part, &source.assigned);
    if (status != LRCS_OK) {
        return status;
    }
    status = lrcsi_placer_make(&source.part->place, &source.part->joint, &source.placer);
    if (status != LRCS_OK) {
        return refuse_part(builder, status, source.part,
                           "a finite place, no scale of 0, a joint's axis of some length");
    }
    if (!source.part->file) {
        return add_shape(builder, &source, divisions, work, scene);
    }
    lrcs_part *part = &scene->part[scene->part_count];
    part->kind = -1;
    part->bounds.known = 1;
    part->smoothed = lrcsi_smooth_given(&builder->models[i]);
    status = add_mesh(builder, &builder->models[i], &source, scene);
    if (status != LRCS_OK || !gives_normals(builder, i)) {
        return status;
    }
    status = lrcsi_smooth_run(&builder->models[i], &source.placer, builder->options, work, scene);
    return status == LRCS_OK ? LRCS_OK
           : status == LRCS_E_MEMORY
               ? refuse_memory(builder)
               : refuse_part(builder, status, source.part, "normals that its mesh has");
}

static int scene_take(const scene_totals *totals, uint32_t parts, lrcs_work *work,
                      lrcs_scene *scene)
{
    memset(scene, 0, sizeof *scene);
    scene->vertex = lrcsi_work_take(work, (size_t)totals->vertices, sizeof *scene->vertex);
    scene->facet = lrcsi_work_take(work, (size_t)totals->facets, sizeof *scene->facet);
    scene->facet_material =
        lrcsi_work_take(work, (size_t)totals->facets, sizeof *scene->facet_material);
    scene->facet_part = lrcsi_work_take(work, (size_t)totals->facets, sizeof *scene->facet_part);
    scene->facet_smooth =
        lrcsi_work_take(work, (size_t)totals->facets, sizeof *scene->facet_smooth);
    if (totals->normals) { /* zeros: facets to which no part gives normals are flat */
        scene->corner_normal =
            lrcsi_work_take_zero(work, (size_t)totals->facets, 3 * sizeof *scene->corner_normal);
    }
    scene->material = lrcsi_work_take(work, (size_t)totals->materials, sizeof *scene->material);
    scene->part = lrcsi_work_take_zero(work, parts, sizeof *scene->part);
    return scene->vertex && scene->facet && scene->facet_material && scene->facet_part &&
                   scene->facet_smooth && scene->material && scene->part &&
                   (scene->corner_normal || !totals->normals)
               ? LRCS_OK
               : LRCS_E_MEMORY;
}

/* Builds the scene; on failure the caller resets work->used. Called:
   1. count_scene: counts, and the divisions of shapes; scene_take: the scene's arrays;
   2. lrcsi_binder_make: an index of names;
   3. add_part, for each part: materials, vertices, facets, normals;
   4. lrcsi_binder_unmatched: the first binding that matched nothing. */
static int build(scene_builder *builder, lrcs_work *work, lrcs_scene *scene)
{
    const lrcs_recipe *recipe = builder->recipe;
    uint32_t material_count = lrcsi_binder_material_count(recipe);
    scene_totals totals;
    builder->binder = lrcsi_binder_plain(recipe);
    lrcs_divisions *divisions = lrcsi_work_take(work, recipe->part_count, sizeof *divisions);
    if (!divisions) {
        return refuse_memory(builder);
    }
    int status = count_scene(builder, divisions, &totals);
    if (status != LRCS_OK) {
        return status;
    }
    if (scene_take(&totals, recipe->part_count, work, scene) != LRCS_OK) {
        return refuse_memory(builder);
    }
    size_t mark = work->used;
    builder->entry = lrcsi_work_take(work, material_count, sizeof *builder->entry);
    if (!builder->entry || lrcsi_binder_make(recipe, work, &builder->binder) != LRCS_OK) {
        return refuse_memory(builder);
    }
    memset(builder->entry, 0xff, material_count * sizeof *builder->entry); /* LRCS_NONE */
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        status = add_part(builder, i, &divisions[i], work, scene);
        if (status != LRCS_OK) {
            return status;
        }
    }
    scene->unmatched = lrcsi_binder_unmatched(&builder->binder);
    scene->normals = builder->options->normals;
    int has_normals = 0; /* they are dropped if every facet is flat */
    for (uint32_t f = 0; scene->corner_normal && f < scene->facet_count && !has_normals; f++) {
        const double *x = scene->corner_normal[3 * (size_t)f].x;
        has_normals = x[0] != 0.0 || x[1] != 0.0 || x[2] != 0.0;
    }
    scene->corner_normal = has_normals ? scene->corner_normal : NULL;
    work->used = mark;
    return LRCS_OK;
}

int lrcs_scene_build(const lrcs_recipe *recipe, const lrcs_mesh *models,
                     const lrcs_build_options *options, lrcs_work *work, lrcs_scene *scene,
                     lrcs_where *where)
{
    scene_builder builder = {.recipe = recipe,
                             .models = models,
                             .options = options,
                             .where = where,
                             .unassigned = LRCS_NONE};
    lrcs_scene made;
    size_t mark = work->used;
    if (!(options->tolerance > 0.0) || !isfinite(options->tolerance) || options->max_facets < 64 ||
        !lrcs_normals_text(options->normals) || !(options->division >= 0.0) ||
        !isfinite(options->division)) {
        return lrcsi_where_text(where, LRCS_E_ARGUMENT, 0, 0, "options",
                                "a tolerance above 0, at least 64 facets, a kind of normals, and a "
                                "division of 0 or more",
                                "", 0);
    }
    int status = build(&builder, work, &made);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *scene = made;
    return LRCS_OK;
}
