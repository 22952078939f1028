/* SPDX-License-Identifier: MIT */
/* Every shared model that lies in ../shared/models (none of them belongs to the project; without
   them the tests skip), read and held against what other programs measured: test/vectors/models.py.
   The numbers there have nine digits, hence 1e-8. */
#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

#define FOLDER      "../shared/models/"
#define NINE_DIGITS 1e-8

typedef struct model_material {
    const char *name;
    int has_colour;
    double rgb[3];
    double transparency;
    int two_sided;
    uint32_t facets; /* of all materials of this name */
    double area;
} model_material;

typedef struct model_truth {
    const char *file;
    uint32_t facets, vertices; /* vertices as stored; STL: welded */
    uint32_t meshes;           /* 0: not counted */
    const char *material_file; /* OBJ */
    uint32_t first_material, material_count;
    double box[2][3];
    double area, volume;
    uint32_t bare_facets; /* in no group */
    double bare_area;
    uint32_t undefined_facets; /* of a material that is not there */
    double undefined_area;
    uint32_t nodes, matrices; /* animation nodes; mesh matrices other than the identity */
    uint32_t slivers;         /* area < 1e-12 of the box diagonal squared */
    uint32_t duplicates, opposite_pairs;
    uint32_t collapsed; /* facets with a repeated corner */
    uint32_t welded, edges, boundary_edges, nonmanifold_edges, misoriented_edges;
    int closed;
} model_truth;

#include "../vectors/models.inc"

typedef struct loaded {
    void *bytes, *area;
    lrcs_mesh mesh;
} loaded;

static void *file_bytes(const char *name, size_t *size)
{
    char path[256];
    snprintf(path, sizeof path, FOLDER "%s", name);
    FILE *file = fopen(path, "rb");
    if (!file) {
        return NULL;
    }
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    long end = ftell(file);
    assert_true(end > 0);
    *size = (size_t)end;
    rewind(file);
    void *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

typedef struct model_reader {
    int (*count)(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
    int (*read)(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                lrcs_where *where);
} model_reader;

static const model_reader readers[] = {
    [LRCS_FORMAT_3DS] = {lrcs_3ds_count, lrcs_3ds_read},
    [LRCS_FORMAT_OBJ] = {lrcs_obj_count, lrcs_obj_read},
    [LRCS_FORMAT_STL] = {lrcs_stl_count, lrcs_stl_read},
};

static void load_colours(const char *name, lrcs_mesh *mesh)
{
    size_t size = 0;
    lrcs_where where;
    void *bytes = file_bytes(name, &size);
    assert_non_null(bytes);
    assert_int_equal(lrcs_mtl_read(bytes, size, mesh, &where), LRCS_OK);
    free(bytes);
}

/* Reads a model in as many bytes as lrcs_mesh_need says; 0 where it is absent. */
static int load(const model_truth *truth, loaded *model)
{
    size_t size = 0;
    memset(model, 0, sizeof *model);
    model->bytes = file_bytes(truth->file, &size);
    if (!model->bytes) {
        return 0;
    }
    int format = lrcs_format_check(model->bytes, size, NULL);
    assert_int_not_equal(format, LRCS_FORMAT_UNKNOWN);
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(readers[format].count(model->bytes, size, &counts, &where), LRCS_OK);
    assert_int_equal(counts.facets, truth->facets);
    size_t need = lrcs_mesh_need(&counts);
    model->area = malloc(need);
    assert_non_null(model->area);
    lrcs_work work = lrcs_work_make(model->area, need);
    assert_int_equal(readers[format].read(model->bytes, size, &work, &model->mesh, &where),
                     LRCS_OK);
    if (truth->material_file) {
        load_colours(truth->material_file, &model->mesh);
    }
    return 1;
}

static void unload(loaded *model)
{
    free(model->bytes);
    free(model->area);
}

static double facet_area(const lrcs_mesh *mesh, uint32_t i)
{
    const double *a = mesh->vertex[mesh->facet[i].corner[0]].x;
    const double *b = mesh->vertex[mesh->facet[i].corner[1]].x;
    const double *c = mesh->vertex[mesh->facet[i].corner[2]].x;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3;
        double n = (b[k] - a[k]) * (c[l] - a[l]) - (b[l] - a[l]) * (c[k] - a[k]);
        sum += n * n;
    }
    return 0.5 * sqrt(sum);
}

static void check_geometry(const model_truth *truth, const lrcs_mesh *mesh)
{
    double area = 0.0;
    double box[2][3] = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        area += facet_area(mesh, i);
        for (int k = 0; k < 9; k++) {
            double x = mesh->vertex[mesh->facet[i].corner[k / 3]].x[k % 3];
            box[0][k % 3] = fmin(box[0][k % 3], x);
            box[1][k % 3] = fmax(box[1][k % 3], x);
        }
    }
    assert_int_equal(mesh->facet_count, truth->facets);
    assert_int_equal(mesh->vertex_count, truth->vertices);
    check_rel(area, truth->area, NINE_DIGITS);
    for (int k = 0; k < 6; k++) {
        check_rel(box[k / 3][k % 3], truth->box[k / 3][k % 3], NINE_DIGITS);
    }
    assert_true(truth->meshes == 0 || mesh->part_count == truth->meshes);
}

/* Facets and their area of all materials of this name. */
static void check_share(const lrcs_mesh *mesh, const model_material *truth)
{
    uint32_t facets = 0;
    double area = 0.0;
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        uint32_t material = mesh->facet_material[i];
        if (material != LRCS_NONE && strcmp(mesh->material[material].name, truth->name) == 0) {
            facets++;
            area += facet_area(mesh, i);
        }
    }
    assert_int_equal(facets, truth->facets);
    check_rel(area, truth->area, NINE_DIGITS);
}

/* The material at this place in the file, or for OBJ, whose materials stand in a file of their own
   in another order, the one of that name. */
static const lrcs_surface *find_material(const model_truth *truth, const lrcs_mesh *mesh,
                                         uint32_t place)
{
    const char *name = materials[truth->first_material + place].name;
    for (uint32_t i = 0; truth->material_file && i < mesh->material_count; i++) {
        if (strcmp(mesh->material[i].name, name) == 0) {
            return &mesh->material[i];
        }
    }
    return &mesh->material[place];
}

static void check_materials(const model_truth *truth, const lrcs_mesh *mesh)
{
    assert_int_equal(mesh->material_count, truth->material_count);
    for (uint32_t i = 0; i < truth->material_count; i++) {
        const model_material *want = &materials[truth->first_material + i];
        const lrcs_surface *got = find_material(truth, mesh, i);
        assert_string_equal(got->name, want->name);
        assert_int_equal(got->has_colour, want->has_colour);
        assert_int_equal(got->two_sided, want->two_sided);
        check_abs(got->transparency, want->transparency, NINE_DIGITS);
        for (int k = 0; k < 3; k++) {
            assert_int_equal(got->rgb[k], (int)(255.0 * want->rgb[k] + 0.5));
        }
        check_share(mesh, want);
    }
}

static void check_bare(const model_truth *truth, const lrcs_mesh *mesh)
{
    uint32_t facets = 0;
    double area = 0.0;
    for (uint32_t i = 0; truth->material_count > 0 && i < mesh->facet_count; i++) {
        if (mesh->facet_material[i] == LRCS_NONE) {
            facets++;
            area += facet_area(mesh, i);
        }
    }
    if (truth->material_count > 0) {
        assert_int_equal(facets, truth->bare_facets + truth->undefined_facets);
        check_rel(area, truth->bare_area + truth->undefined_area, NINE_DIGITS);
    }
}

static void check_notices(const model_truth *truth, const lrcs_mesh *mesh)
{
    assert_int_equal((mesh->notices & LRCS_MESH_KEYFRAMER) != 0, truth->nodes > 0);
    assert_int_equal((mesh->notices & LRCS_MESH_LOCAL_MATRIX) != 0, truth->matrices > 0);
    assert_int_equal((mesh->notices & LRCS_MESH_UNDEFINED_MATERIAL) != 0,
                     truth->undefined_facets > 0);
    assert_int_equal(mesh->notices & LRCS_MESH_NORMALS_DISAGREE, 0);
}

/* The truth calls a facet degenerate below a relative area, and leaves only those with a repeated
   welded corner out of its edges; lrcs_mesh_check leaves out all of exactly no area. The two agree
   where the small ones are the collapsed ones, for the exactly flat lie in between. */
static void check_topology(const model_truth *truth, const lrcs_mesh *mesh)
{
    size_t need = lrcs_mesh_check_need(mesh->vertex_count, mesh->facet_count);
    void *bytes = malloc(need);
    assert_non_null(bytes);
    lrcs_work work = lrcs_work_make(bytes, need);
    lrcs_mesh_report report;
    assert_int_equal(lrcs_mesh_check(mesh->vertex, mesh->vertex_count, mesh->facet,
                                     mesh->facet_count, &work, &report),
                     LRCS_OK);
    check_rel(report.area, truth->area, NINE_DIGITS);
    check_rel(report.volume, truth->volume, NINE_DIGITS);
    for (int k = 0; k < 3; k++) {
        check_rel(report.box_min[k], truth->box[0][k], NINE_DIGITS);
        check_rel(report.box_max[k], truth->box[1][k], NINE_DIGITS);
    }
    assert_true(report.degenerate >= truth->collapsed && report.degenerate <= truth->slivers);
    if (truth->slivers == truth->collapsed) {
        assert_int_equal(report.vertices, truth->welded);
        assert_int_equal(report.edges, truth->edges);
        assert_int_equal(report.duplicate, truth->duplicates);
        assert_int_equal(report.opposite_pairs, truth->opposite_pairs);
        assert_int_equal(report.boundary_edges, truth->boundary_edges);
        assert_int_equal(report.nonmanifold_edges, truth->nonmanifold_edges);
    }
    if (truth->slivers == truth->collapsed && truth->nonmanifold_edges == 0) {
        /* beyond that, the truth counts directions, not edges, and closed asks for no more */
        assert_int_equal(report.misoriented_edges, truth->misoriented_edges);
        assert_int_equal(report.closed, truth->closed);
    }
    free(bytes);
}

/* Runs one check over all models that are there. */
static void each_model(void (*check)(const model_truth *, const lrcs_mesh *))
{
    int seen = 0;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        loaded model;
        if (load(&models[i], &model)) {
            seen++;
            check(&models[i], &model.mesh);
            unload(&model);
        }
    }
    if (seen == 0) {
        print_message("no models in " FOLDER "\n");
        skip();
    }
}

static void models_have_the_measured_counts_area_and_box(void **state)
{
    (void)state;
    each_model(check_geometry);
}

static void materials_have_the_measured_names_colours_facets_and_areas(void **state)
{
    (void)state;
    each_model(check_materials);
}

static void facets_without_a_material_are_those_measured(void **state)
{
    (void)state;
    each_model(check_bare);
}

static void notices_tell_what_the_files_hold(void **state)
{
    (void)state;
    each_model(check_notices);
}

static void edges_are_those_measured(void **state)
{
    (void)state;
    each_model(check_topology);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_have_the_measured_counts_area_and_box),
        cmocka_unit_test(materials_have_the_measured_names_colours_facets_and_areas),
        cmocka_unit_test(facets_without_a_material_are_those_measured),
        cmocka_unit_test(notices_tell_what_the_files_hold),
        cmocka_unit_test(edges_are_those_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
