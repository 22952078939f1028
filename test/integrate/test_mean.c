/* SPDX-License-Identifier: MIT */
/* The mean of sigma over all attitudes of a convex body of one material, by quadrature over whole
   sweeps, against its closed form S (pi A E + 2 pi B / (m + 3)), E = s^2 + (sqrt(pi) / 2) s^3
   erfcx(1/s) (lrcs/brdf.h has f_r; Cauchy's theorem, facet by facet). Facet meshes obey it as they
   stand. How far the quadrature itself is off is measured on each facet alone, in long double: so
   much and the engine's bounds, and nothing more, is allowed. */
#include "scenes.h"

static test_scene scene;

/* --- the rule: Gauss-Legendre in z, equal steps in azimuth ------------------------------------ */

enum { RULE_Z = 40, RULE_AROUND = 2 * RULE_Z };

typedef struct sphere_rule {
    double direction[RULE_Z][RULE_AROUND][3];
    double weight[RULE_Z]; /* of each direction of a row; all make 1 */
} sphere_rule;

static sphere_rule sphere;

/* Nodes and weights on -1 .. 1, by Newton on the three-term recurrence. */
static void gauss_legendre(int n, double *node, double *weight)
{
    for (int i = 0; i < n; i++) {
        double x = cos((double)SCENE_PI * (i + 0.75) / (n + 0.5));
        double slope = 1;
        for (int step = 0; step < 100; step++) {
            double p = 1;
            double before = 0;
            for (int k = 1; k <= n; k++) {
                double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p;
                p = next;
            }
            slope = n * (before - x * p) / (1 - x * x);
            x -= p / slope;
        }
        node[i] = x;
        weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

static void sphere_make(void)
{
    double z[RULE_Z];
    gauss_legendre(RULE_Z, z, sphere.weight);
    for (int i = 0; i < RULE_Z; i++) {
        double r = sqrt(1 - z[i] * z[i]);
        sphere.weight[i] /= 2 * RULE_AROUND;
        for (int k = 0; k < RULE_AROUND; k++) {
            double a = (k + 0.5) * 2 * (double)SCENE_PI / RULE_AROUND;
            double *d = sphere.direction[i][k];
            d[0] = r * cos(a);
            d[1] = r * sin(a);
            d[2] = z[i];
        }
    }
}

/* --- one facet: its mean, and what the rule makes of it --------------------------------------- */

/* Per unit of area. exp(1/s^2) erfc(1/s) serves for s above 0.04. */
static long double mean_of_facet(const lrcs_brdf *b)
{
    long double s = b->s;
    long double e =
        b->A > 0 ? s * s + 0.5L * sqrtl(SCENE_PI) * s * s * s * expl(1 / s / s) * erfcl(1 / s) : 0;
    return SCENE_PI * b->A * e + 2 * SCENE_PI * b->B / (b->m + 3);
}

/* Twice its area along its normal. */
static void facet_normal(uint32_t f, long double n[3])
{
    const double *a = scene.vertex[scene.facet[f].corner[0]].x;
    const double *b = scene.vertex[scene.facet[f].corner[1]].x;
    const double *c = scene.vertex[scene.facet[f].corner[2]].x;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        n[k] = ((long double)b[i] - a[i]) * ((long double)c[j] - a[j]) -
               ((long double)b[j] - a[j]) * ((long double)c[i] - a[i]);
    }
}

static long double rule_on_facet(const lrcs_brdf *b, const long double n[3], long double length)
{
    long double mean = 0;
    for (int i = 0; i < RULE_Z * RULE_AROUND; i++) {
        const double *d = sphere.direction[i / RULE_AROUND][i % RULE_AROUND];
        long double cosine = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / length;
        if (cosine > 0) {
            mean += sphere.weight[i / RULE_AROUND] * scene_eq2(b, 1, cosine * cosine);
        }
    }
    return mean;
}

/* --- a body ----------------------------------------------------------------------------------- */

/* How far the rule may be off, of the mean: else the test would say little. */
#define RULE_OFF 1e-6

/* Its mean by the engine against its surface times a facet's mean. */
static void check_mean(int method)
{
    const lrcs_brdf *brdf = &scene.material[0].brdf;
    long double surface = 0;
    long double difference = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        long double n[3];
        facet_normal(f, n);
        long double length = sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        surface += 0.5L * length;
        difference += 0.5L * length * fabsl(rule_on_facet(brdf, n, length) - mean_of_facet(brdf));
    }
    lrcs_work work;
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    double mean = 0;
    double bound = 0;
    for (int i = 0; i < RULE_Z * RULE_AROUND; i++) {
        const double *d = sphere.direction[i / RULE_AROUND][i % RULE_AROUND];
        lrcs_result r = scene_pose(&scene, p, &work, d, method, 64);
        mean += sphere.weight[i / RULE_AROUND] * r.sigma_m2;
        bound += sphere.weight[i / RULE_AROUND] * r.bound_m2;
    }
    double want = (double)(surface * mean_of_facet(brdf));
    check_most((double)difference, RULE_OFF * want);
    check_most(bound, 1e-9 * want);
    check_abs(mean, want, (double)difference + bound + 1e-14 * want);
}

static const lrcs_brdf laws[] = {{1, 0.25, 0.5, 2}, {0, 0.25, 0.2, 1}, {1, 0, 0.6, 0}};

static void mean_over_attitudes_of_boxes(void **state)
{
    (void)state;
    static const double size[3][3] = {{1, 2, 0.5}, {1, 1, 1}, {1e-3, 4, 2}};
    for (int i = 0; i < 3; i++) {
        scene_start(&scene);
        scene.material[0].brdf = laws[i];
        scene_box(&scene, (const double[3]){0, 0, 0}, size[i]);
        check_mean(LRCS_METHOD_FACET);
        check_mean(LRCS_METHOD_ZBUFFER);
        check_mean(LRCS_METHOD_EXACT);
    }
}

/* The hull of random lattice points: each triangle with all points on one side of it, exactly. */
static void random_polytope(uint64_t *seed)
{
    enum { POINTS = 14, REACH = 1000 };
    double x[POINTS][3];
    scene_start(&scene);
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < 3; k++) {
            x[i][k] = (double)random_below(seed, 2 * REACH + 1) - REACH;
        }
        scene_vertex(&scene, x[i][0], x[i][1], x[i][2]);
    }
    for (uint32_t t = 0; t < POINTS * POINTS * POINTS; t++) {
        uint32_t corner[3] = {t % POINTS, t / POINTS % POINTS, t / POINTS / POINTS};
        int outside = corner[0] == corner[1] || corner[1] == corner[2];
        for (int i = 0; i < POINTS && !outside; i++) {
            double v[3][3]; /* small integers: the determinant is exact */
            for (int k = 0; k < 3; k++) {
                v[0][k] = x[corner[1]][k] - x[corner[0]][k];
                v[1][k] = x[corner[2]][k] - x[corner[0]][k];
                v[2][k] = x[i][k] - x[corner[0]][k];
            }
            double det = v[2][0] * (v[0][1] * v[1][2] - v[0][2] * v[1][1]) +
                         v[2][1] * (v[0][2] * v[1][0] - v[0][0] * v[1][2]) +
                         v[2][2] * (v[0][0] * v[1][1] - v[0][1] * v[1][0]);
            outside = det > 0;
        }
        if (!outside && corner[0] < corner[1] && corner[0] < corner[2]) {
            scene_facet(&scene, corner[0], corner[1], corner[2]);
        }
    }
}

static void mean_over_attitudes_of_random_polytopes(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 9; i++) {
        random_polytope(&seed);
        scene.material[0].brdf = laws[i % 3];
        lrcs_result r = scene_run(&scene, (const double[3]){1, 2, 3}, LRCS_METHOD_AUTO, 0);
        assert_int_equal(r.method, LRCS_METHOD_FACET); /* proved convex */
        check_mean(LRCS_METHOD_AUTO);
    }
}

/* The facets of a shape, as the engine divides it. */
static void tessellated(const lrcs_shape *shape, uint32_t around, uint32_t along)
{
    lrcs_divisions divisions = {around, along, 0};
    lrcs_mesh mesh;
    lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
    scene_start(&scene);
    assert_int_equal(lrcs_shape_mesh(shape, &divisions, &work, &mesh, NULL), LRCS_OK);
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        const double *x = mesh.vertex[v].x;
        scene_vertex(&scene, x[0], x[1], x[2]);
    }
    for (uint32_t f = 0; f < mesh.facet_count; f++) {
        const uint32_t *c = mesh.facet[f].corner;
        scene_facet(&scene, c[0], c[1], c[2]);
    }
}

static void mean_over_attitudes_of_tessellated_shapes(void **state)
{
    (void)state;
    const struct {
        lrcs_shape shape;
        uint32_t around, along;
    } body[] = {{{.kind = LRCS_SHAPE_SPHERE, .radius = 1}, 12, 3},
                {{.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2}, 16, 1},
                {{.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 15}, 16, 1},
                {{.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.3, .radius2 = 0.6, .length = 1}, 12, 1},
                {{.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.4}, 12, 3}};
    for (int i = 0; i < 5; i++) {
        tessellated(&body[i].shape, body[i].around, body[i].along);
        scene.material[0].brdf = laws[i % 3];
        check_mean(LRCS_METHOD_EXACT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_over_attitudes_of_boxes),
        cmocka_unit_test(mean_over_attitudes_of_random_polytopes),
        cmocka_unit_test(mean_over_attitudes_of_tessellated_shapes),
    };
    sphere_make();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
