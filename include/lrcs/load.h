/* SPDX-License-Identifier: MIT */
/* Scenes with memory from the heap: from files and recipes, prepared, and run. */
#ifndef LRCS_LOAD_H
#define LRCS_LOAD_H

#include <lrcs/emulate.h>
#include <lrcs/file.h>

typedef struct lrcs_host_options {
    double unit_m;               /* metres per unit of a model file; 0: not given, 1 m */
    int keep_transparent;        /* do not leave out fully transparent facets */
    const char *two_sided;       /* what reflects from both sides in addition to what files state:
                                    "all"; "open": surfaces that are not closed; the name of a
                                    part, object or material; NULL: nothing */
    const lrcs_binding *binding; /* from the command line: kinds NAME, COLOUR, DEFAULT */
    uint32_t binding_count;
    lrcs_build_options build;
} lrcs_host_options;

lrcs_host_options lrcs_host_options_default(void);

/* A division (lrcs_build_options) with which curved shapes have a few hundred facets; poses that
   need more are run at finer divisions: lrcs_host_scene_refine, lrcs_host_sweep.refine. And the
   limit for the facets of one shape at finer divisions: preparing so many takes about half a
   second, and a pose some 0.5 GB. */
#define LRCS_HOST_DIVISION 1e-2
#define LRCS_HOST_FACETS   (UINT32_C(1) << 19)

/* A regular file that a scene was read from: its name, the FNV-1a hash of its bytes, and its device
   and inode number. */
typedef struct lrcs_host_input {
    const char *path;
    uint64_t hash, device, node;
    double unit_m; /* metres per unit of its lengths; < 0: a model that states none, metres are
                      assumed; 0: it holds no lengths */
    struct lrcs_host_input *next;
} lrcs_host_input;

/* The stages of preparing a scene, and of a pose. */
enum lrcs_host_prepare_stage {
    LRCS_HOST_PREPARE_EDGES,      /* checks; points welded; edges */
    LRCS_HOST_PREPARE_NEIGHBOURS, /* coincident facets; which facet lies across each side */
    LRCS_HOST_PREPARE_CONTACTS,   /* between facets; whether the scene is closed and outward */
    LRCS_HOST_PREPARE_NORMALS,
    LRCS_HOST_PREPARE_PROOFS, /* convexity; which facets are near curved shapes */
    LRCS_HOST_PREPARE_STAGES
};
enum lrcs_host_pose_stage {
    LRCS_HOST_POSE_VIEW,
    LRCS_HOST_POSE_CLASSIFY, /* entirely visible, entirely hidden and undecided facets */
    LRCS_HOST_POSE_VISIBILITY,
    LRCS_HOST_POSE_SUM,
    LRCS_HOST_POSE_STAGES
};

/* A scene with everything that it owns. Set it to zero before the first read; always free it. */
typedef struct lrcs_host_scene {
    lrcs_recipe recipe;
    lrcs_mesh *model; /* one for each part of the recipe; all zero for shapes */
    lrcs_scene scene;
    const lrcs_prepared *prepared; /* NULL until prepared */
    lrcs_host_notices notices;
    lrcs_host_input *input; /* every file read, the last one first; NULL: none */
    const char *two_sided;  /* as in lrcs_host_options, which must outlive the scene */
    double seconds_load, seconds_prepare;
    double seconds_stage[LRCS_HOST_PREPARE_STAGES]; /* of seconds_prepare, in the last attempt,
                                                       whose work area sufficed */
    void *blocks;                                   /* memory owned */
    struct lrcsi_host_levels *levels; /* finer divisions; NULL: it was read without a division,
                                         or no part is curved, or there was no memory */
} lrcs_host_scene;

/* Loads a scene: a model file (3DS, OBJ with its MTL, STL), a scene file, or "demo", which is
   built in. Paths of model files in a scene file are relative to the scene file's folder; a
   material file is read from the folder of its OBJ file.
   NAME and MAP_NAME bindings: a name that no material has may stand for several, which replace it
   in scene->recipe.binding: with * (any characters) and ? (one character), or else, with a notice,
   in letters of the other case (A to Z). Full names take precedence over names that differ in
   case, and these over patterns.
   Returned: scene->scene, and notices about what was found. The caller decides whether
   scene.unmatched is an error: it indexes scene->recipe.binding.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_ARGUMENT (a unit for a scene file, which states its
   own); LRCS_E_NAME (two_sided: no such part or material); as lrcs_3ds_read, lrcs_recipe_read and
   lrcs_scene_build. */
int lrcs_host_scene_read(const char *path, const lrcs_host_options *options, lrcs_host_scene *scene,
                         lrcs_host_error *error);

/* Builds a scene from a recipe that has only shapes. Only the recipe's strings must outlive the
   scene; scene->recipe stays empty, or is a copy if the options have a division. Status: LRCS_OK;
   LRCS_E_SYSTEM; as lrcs_scene_build. */
int lrcs_host_scene_make(const lrcs_recipe *recipe, const lrcs_build_options *build,
                         lrcs_host_scene *scene, lrcs_host_error *error);

/* Builds a variant of a scene. The recipe has the parts of base->recipe, in their order and with
   their models; parts are two-sided where those of base are. Everything else may differ: places,
   joints, shapes, materials. `base` and the recipe's strings must outlive the scene; scene->recipe
   stays empty, or is a copy if the options have a division.
   Status: as lrcs_host_scene_make. */
int lrcs_host_scene_vary(const lrcs_host_scene *base, const lrcs_recipe *recipe,
                         const lrcs_build_options *build, lrcs_host_scene *scene,
                         lrcs_host_error *error);

/* Checks that writing `path` would not replace a file that the scene was read from, under any name
   or link. Status: LRCS_OK; LRCS_E_ARGUMENT: it would; the sentence names both files. */
int lrcs_host_output_check(const char *path, const lrcs_host_scene *scene, lrcs_host_error *error);

/* 1 if two output paths refer to the same file, whether it exists or not; else 0. */
int lrcs_host_output_same(const char *path, const char *other);

/* The bounding box of all facets that are not omitted, m, body frame; all zero if there
   are none. */
void lrcs_host_scene_box(const lrcs_scene *scene, double box_min[3], double box_max[3]);

/* 1 if facets replace curved shapes of the scene, so that a tolerance changes it; else 0. */
int lrcs_host_scene_tessellated(const lrcs_scene *scene);

/* Prepares a scene, once for all poses: lrcs_prepare_run with memory from the heap.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_prepare_run. */
int lrcs_host_scene_prepare(lrcs_host_scene *scene, lrcs_host_error *error);

/* sigma of a prepared scene for a pose: lrcs_sigma_run with memory from the heap. If the heap
   cannot provide enough, a smaller work area is tried, and result->flags says so.
   Returned: result; records and image unless NULL; seconds unless NULL.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_sigma_run. */
int lrcs_host_scene_run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                        const lrcs_run_options *options, lrcs_result *result,
                        lrcs_facet_record *records, lrcs_image *image, double *seconds,
                        lrcs_host_error *error);

/* If a pose of a prepared scene that was read with a division misses its tolerance because of the
   curved shapes' facets, the parts that cause most of the tessellation bound are divided more
   finely, and the scene is prepared again: with it the pose is likely to meet the tolerance.
   Given: the options of the run, and what it returned: result; part_error_m2[part_count], as in the
   options (NULL: all curved parts are divided alike). Returned: 1 if so, and build->halvings, which
   lasts as long as the scene; else 0, also if the shapes cannot be divided any finer. */
int lrcs_host_scene_refine(lrcs_host_scene *scene, const lrcs_run_options *options,
                           const lrcs_result *result, const double *part_error_m2,
                           lrcs_build_options *build);

/* lrcs_uncertainty_run and lrcs_attitude_slope_run with memory from the heap.
   Returned: result; sensitivity[material_count]; uncertainty; and slope.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_uncertainty_run and lrcs_attitude_slope_run. */
int lrcs_host_scene_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                const lrcs_run_options *options,
                                const lrcs_uncertainty_options *how, lrcs_result *result,
                                lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                                lrcs_host_error *error);
int lrcs_host_scene_attitude_slope(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                   const lrcs_run_options *options, lrcs_attitude_slope *slope,
                                   lrcs_host_error *error);

/* Runs a pose up to a stage (lrcs_host_pose_stage) and discards the results, to measure the time of
   single stages. options->method must not be AUTO, which may run stages more than once.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_ARGUMENT (the method or the stage); as lrcs_sigma_run. */
int lrcs_host_scene_run_until(const lrcs_host_scene *scene, const lrcs_pose *pose,
                              const lrcs_run_options *options, int stage, lrcs_host_error *error);

/* The time that runs of a pose are expected to take, before any of them, by the cost model with
   which auto chooses a method: from a sample of the facets, in a small fraction of the time of a
   run. Its constants were measured on one machine: divide by a measured time for another one. An
   estimate, mostly within a factor of two. Given: a prepared scene; pose; options[count]: with
   method zbuffer a resolution of 0 counts as 256; steps are not considered. Returned:
   seconds[count]. Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_ARGUMENT (options); LRCS_E_NUMBER (the
   pose); LRCS_E_UNSUPPORTED (as lrcs_prepare_run). */
int lrcs_host_scene_forecast(const lrcs_host_scene *scene, const lrcs_pose *pose,
                             const lrcs_run_options *options, uint32_t count, double *seconds,
                             lrcs_host_error *error);

/* The same pose as graphics hardware computes it: lrcs_emulate_run with memory from the heap.
   Returned: emulation; records unless NULL; seconds unless NULL. Status: LRCS_OK; LRCS_E_SYSTEM; as
   lrcs_emulate_run. */
int lrcs_host_scene_emulate(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            const lrcs_emulation_options *options, lrcs_emulation *emulation,
                            lrcs_facet_record *records, double *seconds, lrcs_host_error *error);

void lrcs_host_scene_free(lrcs_host_scene *scene);

/* The visible polygons of a pose, in memory of their own: lrcs_polygon_run, and its release.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_polygon_run. */
typedef struct lrcs_host_polygons {
    lrcs_polygons list;
    void *blocks; /* memory owned */
} lrcs_host_polygons;
int lrcs_host_polygons_make(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            lrcs_host_polygons *polygons, lrcs_host_error *error);
void lrcs_host_polygons_free(lrcs_host_polygons *polygons);

/* The range profile of a pose, in memory of its own: lrcs_profile_run, and its release.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_profile_run. */
typedef struct lrcs_host_profile {
    lrcs_profile list;
    void *blocks; /* memory owned */
} lrcs_host_profile;
int lrcs_host_profile_make(const lrcs_host_scene *scene, const lrcs_pose *pose, double bin_m,
                           lrcs_host_profile *profile, lrcs_host_error *error);
void lrcs_host_profile_free(lrcs_host_profile *profile);

#endif
