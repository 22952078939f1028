/* SPDX-License-Identifier: MIT */
/* Models with normals for tests: OBJ text or 3DS bytes read, placed, with one material, and run;
   and a cylinder in each form that says that it is round. */
#ifndef TEST_CURVED_H
#define TEST_CURVED_H

#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

#define CURVED_TEXT 65536u
#define CURVED_PI   3.14159265358979323846

typedef struct curved_case {
    lrcs_mesh mesh;
    lrcs_place place;
    lrcs_joint joint;
    lrcs_brdf brdf;
    int two_sided;
    double tolerance;
    lrcs_scene scene;
    const lrcs_prepared *prepared;
    lrcs_facet_record record[1024]; /* of the last run */
    void *read, *built, *kept;      /* memory */
} curved_case;

static inline void curved_free(curved_case *c)
{
    free(c->read);
    free(c->built);
    free(c->kept);
    c->read = c->built = c->kept = NULL;
}

static inline void curved_read(curved_case *c, const void *bytes, size_t size, int is_3ds)
{
    lrcs_mesh_counts counts;
    lrcs_where where;
    int status = (is_3ds ? lrcs_3ds_count : lrcs_obj_count)(bytes, size, &counts, &where);
    assert_int_equal(status, LRCS_OK);
    memset(c, 0, sizeof *c);
    c->place = lrcs_place_default();
    c->brdf = lrcs_brdf_default();
    c->tolerance = 1e-4;
    c->read = malloc(lrcs_mesh_need(&counts));
    assert_non_null(c->read);
    lrcs_work work = lrcs_work_make(c->read, lrcs_mesh_need(&counts));
    status = (is_3ds ? lrcs_3ds_read : lrcs_obj_read)(bytes, size, &work, &c->mesh, &where);
    assert_int_equal(status, LRCS_OK);
}

static inline curved_case curved_obj(const char *text)
{
    curved_case c;
    curved_read(&c, text, strlen(text), 0);
    return c;
}

/* Builds and prepares in exactly as much memory as the library states. */
static inline void curved_build(curved_case *c, int normals)
{
    static lrcs_recipe_part part;
    static lrcs_binding binding;
    part = (lrcs_recipe_part){.name = "model",
                              .file = "model",
                              .place = c->place,
                              .joint = c->joint,
                              .material_index = -1};
    binding = (lrcs_binding){.kind = LRCS_BIND_DEFAULT, .brdf = c->brdf, .two_sided = c->two_sided};
    lrcs_recipe recipe = {.part = &part, .part_count = 1, .binding = &binding, .binding_count = 1};
    lrcs_build_options options = {c->tolerance, 64, normals, 1, 0, NULL};
    size_t need = lrcs_scene_need(&recipe, &c->mesh, &options);
    free(c->built);
    free(c->kept);
    c->built = malloc(need);
    assert_non_null(c->built);
    lrcs_work work = lrcs_work_make(c->built, need);
    assert_int_equal(lrcs_scene_build(&recipe, &c->mesh, &options, &work, &c->scene, NULL),
                     LRCS_OK);
    need = lrcs_prepare_need(&c->scene);
    c->kept = malloc(need);
    assert_non_null(c->kept);
    work = lrcs_work_make(c->kept, need);
    assert_int_equal(lrcs_prepare_run(&c->scene, &work, &c->prepared), LRCS_OK);
}

/* Memory of exactly that size, kept until another size is needed: under AddressSanitizer a large
   block takes longer to allocate than a run. */
static inline void *curved_memory(size_t need)
{
    static void *area;
    static size_t size;
    if (need != size) {
        free(area);
        area = malloc(need);
        size = need;
    }
    assert_non_null(area);
    return area;
}

static inline lrcs_result curved_run(curved_case *c, const double direction[3], int method,
                                     uint32_t size)
{
    lrcs_pose pose;
    lrcs_result result;
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = c->tolerance;
    options.method = method;
    options.resolution = size;
    size_t need = lrcs_sigma_need(c->prepared, &options);
    void *area = curved_memory(need);
    assert_true(c->scene.facet_count <= sizeof c->record / sizeof c->record[0]);
    lrcs_work work = lrcs_work_make(area, need);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(c->prepared, &pose, &options, &work, &result, c->record, NULL),
                     LRCS_OK);
    return result;
}

/* Appends a line to a text. */
__attribute__((format(printf, 2, 3))) static inline void curved_line(char *text, const char *format,
                                                                     ...)
{
    size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, CURVED_TEXT - used, format, list);
    va_end(list);
    assert_true(strlen(text) < CURVED_TEXT - 2);
    strcat(text, "\n");
}

/* A closed cylinder of n sides about z, its corners on the radius, centred; its wall round by
   vertex normals ('v'), by a smoothing group ('s') or not at all ('f'); caps flat. */
static inline void curved_cylinder(char *text, int n, double radius, double length, char form)
{
    text[0] = '\0';
    for (int i = 0; i < 2 * n; i++) {
        double a = 2 * CURVED_PI * (i % n) / n;
        curved_line(text, "v %.17g %.17g %.17g\nvn %.17g %.17g 0", radius * cos(a), radius * sin(a),
                    (i < n ? -0.5 : 0.5) * length, cos(a), sin(a));
    }
    curved_line(text, "s %d", form == 's');
    for (int i = 1; i <= n; i++) {
        int j = i % n + 1;
        if (form == 'v') {
            curved_line(text, "f %d//%d %d//%d %d//%d %d//%d", i, i, j, j, n + j, j, n + i, i);
        } else {
            curved_line(text, "f %d %d %d %d", i, j, n + j, n + i);
        }
    }
    curved_line(text, "s off");
    for (int i = 1; i + 1 < n; i++) {
        curved_line(text, "f %d %d %d\nf 1 %d %d", n + 1, n + 1 + i, n + 2 + i, 2 + i, 1 + i);
    }
}

#endif
