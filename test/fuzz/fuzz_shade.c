/* SPDX-License-Identifier: MIT */
/* A few arbitrary facets of one arbitrary material: what a packet gives for each is what
   double-double incidence and reflect.h give, within the bounds of both, and sigma of them all is
   their sum. */
#include "fuzz.h"

#include <float.h>
#include <math.h>

#include "optics/reflect.h"
#include "optics/shade.h"
#include "view/view.h"

#define FACETS  40u
#define FOUR_PI 12.566370614359172954
#define U       0x1p-53

static lrcs_point vertex[3 * FACETS];
static lrcs_facet facets[FACETS];
static uint32_t zeros[FACETS];
static unsigned char room[1 << 20];

static double take_number(fuzz_input *in)
{
    static const double fine[4] = {0, 0x1p-30, 0x1p-52, 0.1};
    unsigned byte = fuzz_byte(in);
    double whole = (double)(byte & 15) - 8;
    return whole * (1 + fine[byte >> 4 & 3] * (1 + (byte >> 6)));
}

static lrcs_brdf take_brdf(fuzz_input *in)
{
    static const double A[4] = {1, 0, 0x1p-90, 1e20};
    static const double B[4] = {0.25, 0, 1e-25, 3};
    static const double s[16] = {0.2, 0.05, 0.0499, 1e-6, 1e-3, 0.01, 0.1, 0.3,
                                 0.7, 1,    3,      30,   1e3,  1e-4, 0.5, 1e-9};
    static const double m[16] = {0.5, 0,   1,   2, 0.3, 7.3, 100, 799,
                                 801, 1e4, 1e6, 3, 0.1, 5,   30,  1e9};
    unsigned parts = fuzz_byte(in);
    unsigned forms = fuzz_byte(in);
    return (lrcs_brdf){A[parts & 3], B[parts >> 2 & 3], s[forms & 15], m[forms >> 4]};
}

/* n . d of the facet at a place of the batches. */
static double dot_at(const lrcsi_view *view, uint32_t place)
{
    double *const *n = view->prepared->batches.normal;
    return lrcsi_view_dot(n[0][place], n[1][place], n[2][place], view->unit);
}

/* One facet at `place` by both ways. */
static void require_same(const lrcsi_view *view, const lrcs_brdf *brdf, const lrcsi_lobes *lobes,
                         uint32_t place, double dot)
{
    const lrcsi_batches *b = &view->prepared->batches;
    lrcsi_incidence incidence = lrcsi_view_incidence(view, b->facet[place]);
    static lrcsi_shade_normals normals;
    static lrcsi_shades shades;
    if (!(dot > lobes->low && dot < lobes->high && incidence.tan2_err < 1)) {
        return;
    }
    for (uint32_t i = 0; i < LRCSI_LANES; i++) {
        for (int k = 0; k < 3; k++) {
            normals.x[k][i] = b->normal[k][place];
        }
    }
    lrcsi_shade(lobes, view->unit, view->unit_low, &normals, &shades);
    uint32_t lane = place % LRCSI_LANES;
    double whole = b->area[place] * shades.cosine[lane];
    double got = (shades.glint[lane] + shades.diffuse[lane]) * whole;
    lrcsi_reflection at = lrcsi_reflect(brdf, incidence.tan2, incidence.tan2_err);
    double want = FOUR_PI * b->area[place] * (at.glint + at.diffuse);
    double bound = shades.error[lane] * LRCSI_SHADE_UNIT * whole +
                   FOUR_PI * b->area[place] * at.error + 8 * U * want + 0x1p-1000;
    require(isfinite(got) && got >= 0 && isfinite(bound));
    require(fabs(got - want) <= bound);
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    fuzz_input in = {data, data + size};
    lrcs_material material = {.name = "", .brdf = take_brdf(&in), .brdf_given = 1};
    double direction[3];
    uint32_t count = 0;
    for (int k = 0; k < 3; k++) {
        direction[k] = take_number(&in) + 0x1p-6 * take_number(&in);
    }
    for (; in.at < in.end && count < FACETS; count++) {
        for (uint32_t k = 0; k < 9; k++) {
            vertex[3 * count + k / 3].x[k % 3] = take_number(&in);
        }
        facets[count] = (lrcs_facet){{3 * count, 3 * count + 1, 3 * count + 2}};
    }
    lrcs_part part = {.name = "part", .kind = -1, .bounds.known = 1, .facet_count = count};
    const lrcs_scene scene = {.vertex_count = 3 * count,
                              .facet_count = count,
                              .material_count = 1,
                              .part_count = 1,
                              .vertex = vertex,
                              .facet = facets,
                              .facet_material = zeros,
                              .facet_part = zeros,
                              .facet_smooth = zeros,
                              .material = &material,
                              .part = &part,
                              .unmatched = LRCS_NONE};
    lrcs_pose pose;
    lrcs_work work = lrcs_work_make(room, sizeof room);
    const lrcs_prepared *prepared = NULL;
    lrcsi_view view;
    if (lrcs_pose_from_direction(direction, &pose) != LRCS_OK || count == 0 ||
        lrcs_brdf_check(&material.brdf) < 0) {
        return 0;
    }
    require(lrcs_prepare_run(&scene, &work, &prepared) == LRCS_OK);
    require(lrcsi_view_face(prepared, &pose, (lrcsi_view_backs){!prepared->solid, !prepared->solid},
                            &work, &view) == LRCS_OK);
    const lrcs_brdf *brdf = &material.brdf;
    lrcsi_lobes lobes = lrcsi_lobes_make(brdf, brdf->A > 0, brdf->B > 0);
    for (uint32_t place = 0; place < prepared->batches.count; place++) {
        double dot = dot_at(&view, place);
        require(fabs(dot) <= LRCSI_DOT_ERROR ||
                (dot > 0) == (view.facing[prepared->batches.facet[place]] > 0));
        require_same(&view, brdf, &lobes, place, dot);
    }
    static lrcs_facet_record records[FACETS];
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    options.method = LRCS_METHOD_FACET;
    int status = lrcs_sigma_run(prepared, &pose, &options, &work, &result, records, NULL);
    require(status == LRCS_OK || status == LRCS_E_NUMBER);
    long double sum = 0;
    for (uint32_t f = 0; f < count; f++) {
        sum += status == LRCS_OK ? records[f].sigma_m2 : 0;
    }
    require(status != LRCS_OK || fabsl(sum - (long double)result.sigma_m2) <=
                                     (count + 2) * (long double)DBL_EPSILON * sum + DBL_MIN);
    return 0;
}
