/* SPDX-License-Identifier: MIT */
/* Meshes of a quarter of a million facets, and of ten million (make big): a plate with fins on it
   whose shadows have a closed form. Every facet of the plate is divided by a shadow's edge or lies
   beside one. */
#include <lrcs/lrcs.h>

#include <stdlib.h>

#include "check.h"

/* n fins on n rows: 4 n^2 facets. */
static uint32_t rows = 256;

typedef struct comb {
    lrcs_scene scene;
    lrcs_material material;
    lrcs_part part;
} comb;

static void *take(size_t count, size_t size)
{
    void *block = calloc(count, size);
    assert_non_null(block);
    return block;
}

static void put_quad(lrcs_scene *scene, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    scene->facet[scene->facet_count++] = (lrcs_facet){{a, b, c}};
    scene->facet[scene->facet_count++] = (lrcs_facet){{a, c, d}};
}

/* The unit plate z = 0, front up, in n x n squares of side p; on the far side of each, at
   x = (i + 1) p, a fin p / 2 high, front on +x. Coordinates are multiples of p / 2. */
static void comb_make(comb *c, uint32_t n)
{
    size_t line = (size_t)n + 1;
    lrcs_scene *s = &c->scene;
    c->material = (lrcs_material){.name = "", .brdf = lrcs_brdf_default(), .brdf_given = 1};
    c->part = (lrcs_part){.name = "", .kind = -1, .facet_count = 4 * n * n, .bounds.known = 1};
    *s = (lrcs_scene){.material_count = 1,
                      .part_count = 1,
                      .vertex = take(2 * line * line, sizeof *s->vertex),
                      .facet = take(4 * (size_t)n * n, sizeof *s->facet),
                      .facet_material = take(4 * (size_t)n * n, sizeof(uint32_t)),
                      .facet_part = take(4 * (size_t)n * n, sizeof(uint32_t)),
                      .facet_smooth = take(4 * (size_t)n * n, sizeof(uint32_t)),
                      .material = &c->material,
                      .part = &c->part,
                      .unmatched = LRCS_NONE};
    for (size_t i = 0; i < line * line; i++) {
        double x = (double)(i / line) / n;
        double y = (double)(i % line) / n;
        s->vertex[i] = (lrcs_point){{x, y, 0}};
        s->vertex[line * line + i] = (lrcs_point){{x, y, 0.5 / n}};
    }
    s->vertex_count = (uint32_t)(2 * line * line);
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = 0; j < n; j++) {
            uint32_t low = (uint32_t)(i * line) + j;
            uint32_t next = low + (uint32_t)line;
            uint32_t top = next + (uint32_t)(line * line);
            put_quad(s, low, next, next + 1, low + 1);
            put_quad(s, next, next + 1, top + 1, top);
        }
    }
}

static void comb_free(comb *c)
{
    free(c->scene.vertex);
    free(c->scene.facet);
    free(c->scene.facet_material);
    free(c->scene.facet_part);
    free(c->scene.facet_smooth);
}

/* Runs the exact method in as much memory as it asks for. */
static lrcs_result comb_run(const comb *c, const double direction[3])
{
    const lrcs_prepared *prepared = NULL;
    lrcs_run_options options = {.tolerance = 1e-9, .method = LRCS_METHOD_EXACT};
    lrcs_pose pose;
    lrcs_result result;
    size_t need = lrcs_prepare_need(&c->scene);
    void *memory = take(need, 1);
    lrcs_work work = lrcs_work_make(memory, need);
    assert_int_equal(lrcs_prepare_run(&c->scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    size_t more = lrcs_sigma_need(prepared, &options);
    void *area = take(more, 1);
    work = lrcs_work_make(area, more);
    print_message("%u facets: %.0f bytes a facet to prepare, %.0f to run\n", c->scene.facet_count,
                  (double)need / c->scene.facet_count, (double)more / c->scene.facet_count);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &result, NULL, NULL),
                     LRCS_OK);
    free(area);
    free(memory);
    return result;
}

/* From (1, q, 1) a fin's shadow reaches p / 2 across the plate and slides by q z along it, out over
   the end: n fins of height h shade n (h - q h^2 / 2), and are wholly lit themselves. */
static void fins_of_very_many_facets_shade_as_by_hand(void **state)
{
    (void)state;
    const double q = 0.25;
    const double direction[3] = {1, q, 1};
    const long double pi = 3.14159265358979323846264338L;
    comb c;
    comb_make(&c, rows);
    double h = 0.5 / rows;
    long double cos2 = 1 / (2 + (long double)q * q); /* of plate and fins alike */
    long double lit = 1 - rows * ((long double)h - q * (long double)h * h / 2) + rows * h;
    long double law = expl(-(1 / cos2 - 1) / 0.04L) / (cos2 * cos2) + 0.25L * powl(cos2, 1.25L);
    double want = (double)(4 * pi * lit * law);
    lrcs_result r = comb_run(&c, direction);
    assert_int_equal(r.facets_total, 4 * rows * rows);
    check_abs(r.sigma_m2, want, r.bound_m2 + 4e-16 * want);
    check_most(r.bound_m2, 1e-7 * want);
    check_rel(r.projected_area_m2, (double)(lit * sqrtl(cos2)), 1e-11);
    comb_free(&c);
}

int main(int count, char **word)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fins_of_very_many_facets_shade_as_by_hand)};
    rows = count > 1 ? (uint32_t)strtoul(word[1], NULL, 10) : rows;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
