/* SPDX-License-Identifier: MIT */
/* Scene files from arbitrary bytes to sigma: a recipe of few parts, built of few facets and run.
   Parts that name a model file get two triangles of material "gold". */
#include "fuzz_recipe.h"
#include "fuzz_sigma.h"

#define MOST_PARTS 8u
#define BUILD_ROOM ((size_t)1 << 20)
/* Shapes that reach beyond this, m, are needles to the others: up to seconds for each. */
#define FAR 1e9

/* Two triangles of one smoothing group about a ridge, half of them with normals at its ends. */
static lrcs_mesh ridge(int normals)
{
    static lrcs_point vertex[4] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0.5}}, {{1, -1, 0.25}}};
    static lrcs_facet facet[2] = {{{0, 1, 2}}, {{1, 0, 3}}};
    static uint32_t zero[2], group[2] = {1, 1};
    static lrcs_surface material = {.name = "gold", .rgb = {255, 215, 0}, .has_colour = 1};
    static const char *part = "";
    static lrcs_point normal[2] = {{{0, 0, 1}}, {{0.25, 0, 2}}};
    static lrcs_facet facet_normal[2] = {{{0, 1, LRCS_NONE}}, {{1, 0, LRCS_NONE}}};
    lrcs_mesh mesh = {4,    2,    1,     1,         vertex, facet,
                      zero, zero, group, &material, &part,  .material_file = NULL};
    mesh.normal_count = normals ? 2 : 0;
    mesh.normal = normals ? normal : NULL;
    mesh.facet_normal = normals ? facet_normal : NULL;
    return mesh;
}

/* Shapes whose division takes a hundred times as long as all else: round ones, unless a limit of 64
   facets leaves no choice. */
static int is_dear(const lrcs_recipe *recipe)
{
    int dear = 0;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        int kind = recipe->part[i].shape.kind;
        dear |=
            !recipe->part[i].file && (kind == LRCS_SHAPE_CYLINDER || kind == LRCS_SHAPE_CONE ||
                                      kind == LRCS_SHAPE_FRUSTUM || kind == LRCS_SHAPE_PARABOLOID);
    }
    return dear;
}

static unsigned hash_of(const unsigned char *data, size_t size)
{
    unsigned hash = 0;
    for (size_t i = 0; i < size; i++) {
        hash = 31 * hash + data[i];
    }
    return hash >> 8 ^ hash;
}

/* One in sixteen: what takes long. */
static int is_rare(unsigned hash)
{
    return (hash >> 12 & 15) == 0;
}

/* Methods, too little memory, polygons and what else is open, from a hash of the file. */
static fuzz_run run_of(unsigned hash)
{
    fuzz_run run = {.options = lrcs_run_options_default(), .share = 64};
    run.options.method = (int)(hash & 3);
    run.options.tolerance = 1e-2;
    run.options.resolution = 16;
    run.options.accept = (int)(hash >> 9 & 3) % 3;
    run.methods = 1u << run.options.method | 1u << (hash >> 2 & 3);
    run.short_memory = (hash >> 4 & 3) == 0;
    run.polygons = (hash >> 4 & 3) == 1;
    require(lrcs_pose_from_azel(30, 40, &run.pose) == LRCS_OK);
    return run;
}

static void build_and_run(const lrcs_recipe *recipe, unsigned hash)
{
    const lrcs_build_options options = {0.5, 64,  (int)(hash >> 6 & 3) % 3, (int)(hash >> 8 & 1),
                                        0,   NULL};
    lrcs_mesh models[MOST_PARTS];
    lrcs_scene scene;
    lrcs_where where;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        models[i] = ridge(i & 1);
    }
    /* counting divides every shape, which building does once more and is most of the work */
    size_t need =
        fuzz_chosen(hash >> 8 & 1) ? lrcs_scene_need(recipe, models, &options) : BUILD_ROOM;
    require(need < FUZZ_ROOM);
    lrcs_work work = fuzz_area(need);
    int status = lrcs_scene_build(recipe, models, &options, &work, &scene, &where);
    require(status != LRCS_E_MEMORY && (status != LRCS_OK || work.peak <= need));
    if (status != LRCS_OK) {
        require(where.item != NULL && where.expected != NULL && work.used == 0);
    } else if (scene.facet_count <= 64 &&
               fuzz_chosen(scene_extent(&scene) < FAR || is_rare(hash))) {
        fuzz_run run = run_of(hash);
        lrcs_scene_hash(&scene);
        fuzz_scene(&scene, &run);
    }
    free(work.bytes);
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    lrcs_work work;
    lrcs_recipe recipe;
    unsigned hash = hash_of(data, size);
    if (fuzz_recipe(data, size, &work, &recipe) && recipe.part_count <= MOST_PARTS &&
        fuzz_chosen(!is_dear(&recipe) || is_rare(hash))) {
        build_and_run(&recipe, hash);
    }
    free(work.bytes);
    return 0;
}
