/* SPDX-License-Identifier: MIT */
/* The hard cases beside a plain implementation: the formulas as printed, in doubles, with a ray
   from each facet's centroid for the shadow. The mathematics of the plain formulas is correct; in
   doubles they fail on most of these cases, and the engine must not. References:
   test/vectors/hard.py, with 50 digits. With the argument "table" it prints all cases (make hard).
 */
#include "scenes.h"

static test_scene scene;

typedef struct hard_case hard_case;
typedef double plain_formula(const hard_case *one);

enum plain_outcome { PLAIN_ANY, PLAIN_NAN, PLAIN_ZERO, PLAIN_OFF /* by more than a thousandth */ };

/* A shape with a closed form, or facets if `build` is given. */
struct hard_case {
    const char *name; /* as in hard.inc, which does not list cases that must be refused */
    plain_formula *plain;
    int outcome; /* of the plain formula */
    lrcs_brdf brdf;
    lrcs_shape shape;
    double aspect_deg;
    void (*build)(void);
    double direction[3];
};

/* --- plain formulas: shapes ------------------------------------------------------------------- */

#define PI        3.14159265358979323846
#define RADIANS   (PI / 180.0)
#define PI_SQUARE (PI * PI)

/* Eq. 1 as printed. */
static double plain_brdf(const lrcs_brdf *b, double cosine)
{
    double tan2 = 1.0 / (cosine * cosine) - 1.0;
    return b->A / pow(cosine, 6.0) * exp(-tan2 / (b->s * b->s)) + b->B * pow(cosine, b->m);
}

static double plain_sphere(const hard_case *one)
{
    const lrcs_brdf *b = &one->brdf;
    double s = b->s;
    double slopes = s * s + 0.5 * sqrt(PI) * s * s * s * exp(1.0 / (s * s)) * erfc(1.0 / s);
    double square = one->shape.radius * one->shape.radius * PI_SQUARE;
    return 4.0 * square * b->A * slopes + 8.0 * square * b->B / (b->m + 3.0);
}

/* Only the wall. */
static double plain_cylinder(const hard_case *one)
{
    const lrcs_brdf *b = &one->brdf;
    double g = one->aspect_deg * RADIANS;
    double k = sin(g);
    double cot = cos(g) / sin(g);
    double ks = k * b->s;
    double both = 4.0 * PI * one->shape.radius * one->shape.length * sqrt(PI);
    double glint =
        b->A * b->s / (k * k * k) * (1.0 + 0.5 * ks * ks) * exp(-cot * cot / (b->s * b->s));
    double diffuse =
        b->B * pow(k, b->m + 2.0) * tgamma(0.5 * (b->m + 3.0)) / tgamma(0.5 * (b->m + 4.0));
    return both * (glint + diffuse);
}

/* Only the wall, nose-on. */
static double plain_cone(const hard_case *one)
{
    double half = one->shape.half_angle_deg * RADIANS;
    double radius = one->shape.radius;
    return 4.0 * PI_SQUARE * radius * radius * sin(half) *
           plain_brdf(&one->brdf, cos(0.5 * PI - half));
}

/* P(u) of the paraboloid's glint. */
static double plain_p(double u, double s)
{
    double root = sqrt(u);
    return pow(u, 2.5) + 2.5 * s * s * pow(u, 1.5) + 3.75 * pow(s, 4.0) * root +
           1.875 * sqrt(PI) * pow(s, 5.0) * exp(u / (s * s)) * erfc(root / s);
}

/* Only the wall, nose-on; the glint as a difference, the diffuse term as a power. */
static double plain_paraboloid(const hard_case *one)
{
    const lrcs_brdf *b = &one->brdf;
    double slope = 2.0 * one->shape.length / one->shape.radius;
    double u = 1.0 + slope * slope;
    double k = one->shape.radius / slope;
    double glint = b->A * b->s * b->s *
                   (plain_p(1.0, b->s) - exp(-slope * slope / (b->s * b->s)) * plain_p(u, b->s));
    double diffuse = 2.0 * b->B * (pow(u, 0.5 * (1.0 - b->m)) - 1.0) / (1.0 - b->m);
    return 4.0 * PI_SQUARE * k * k * (glint + diffuse);
}

/* The wall of a cylinder or cone in 360 steps of azimuth. */
static double plain_steps(const hard_case *one)
{
    const lrcs_shape *shape = &one->shape;
    double aspect = one->aspect_deg * RADIANS;
    double half = shape->half_angle_deg * RADIANS;
    double area = shape->kind == LRCS_SHAPE_CONE ? PI * shape->radius * shape->radius / sin(half)
                                                 : 2.0 * PI * shape->radius * shape->length;
    double sum = 0.0;
    for (int degree = 0; degree < 360; degree++) {
        double cosine = sin(half) * cos(aspect) + cos(half) * sin(aspect) * cos(degree * RADIANS);
        sum += cosine > 0.0 ? plain_brdf(&one->brdf, cosine) * cosine * cosine : 0.0;
    }
    return 4.0 * PI * area * sum / 360.0;
}

/* --- plain formulas: facets ------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) {
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static const double *corner(uint32_t f, int i)
{
    return scene.vertex[scene.facet[f].corner[i]].x;
}

/* The sides of a facet from its first corner. */
static void sides(uint32_t f, double p[3], double q[3])
{
    for (int k = 0; k < 3; k++) {
        p[k] = corner(f, 1)[k] - corner(f, 0)[k];
        q[k] = corner(f, 2)[k] - corner(f, 0)[k];
    }
}

/* The offset of a ray from its surface, and the threshold below which its determinant counts as
   zero. */
#define PLAIN_EPSILON 1e-6

/* 1 if the ray intersects the facet. T. Moller and B. Trumbore, J. Graphics Tools 2 (1997) 21. */
static int ray_meets(const double from[3], const double along[3], uint32_t f)
{
    double p[3];
    double q[3];
    double h[3];
    double g[3];
    const double t[3] = {from[0] - corner(f, 0)[0], from[1] - corner(f, 0)[1],
                         from[2] - corner(f, 0)[2]};
    sides(f, p, q);
    cross(along, q, h);
    cross(t, p, g);
    double determinant = dot(p, h);
    if (fabs(determinant) < PLAIN_EPSILON) {
        return 0;
    }
    double u = dot(t, h) / determinant;
    double v = dot(along, g) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(q, g) / determinant > PLAIN_EPSILON;
}

static int centroid_in_shadow(uint32_t f, const double along[3])
{
    double from[3];
    int hidden = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = (corner(f, 0)[k] + corner(f, 1)[k] + corner(f, 2)[k]) / 3.0;
    }
    for (uint32_t other = 0; other < scene.scene.facet_count; other++) {
        hidden |= other != f && ray_meets(from, along, other);
    }
    return hidden;
}

static double area_by_cross(const double p[3], const double q[3])
{
    double n[3];
    cross(p, q, n);
    return 0.5 * sqrt(dot(n, n));
}

/* Heron's formula, from the lengths of the sides. */
static double area_by_heron(const double p[3], const double q[3])
{
    const double r[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    double a = sqrt(dot(p, p));
    double b = sqrt(dot(q, q));
    double c = sqrt(dot(r, r));
    double half = 0.5 * (a + b + c);
    return sqrt(half * (half - a) * (half - b) * (half - c));
}

/* Eq. 2 over the facets whose centroid is visible to the laser. */
static double plain_sum(const hard_case *one, double (*area)(const double[3], const double[3]))
{
    double length = sqrt(dot(one->direction, one->direction));
    const double along[3] = {one->direction[0] / length, one->direction[1] / length,
                             one->direction[2] / length};
    double sigma = 0.0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        double p[3];
        double q[3];
        double n[3];
        sides(f, p, q);
        cross(p, q, n);
        double cosine = dot(n, along) / sqrt(dot(n, n));
        if (cosine <= 0.0 || scene.material_of[f] == 1 || centroid_in_shadow(f, along)) {
            continue;
        }
        sigma += 4.0 * PI * area(p, q) * plain_brdf(&one->brdf, cosine) * cosine * cosine;
    }
    return sigma;
}

static double plain_facets(const hard_case *one)
{
    return plain_sum(one, area_by_cross);
}

static double plain_heron(const hard_case *one)
{
    return plain_sum(one, area_by_heron);
}

/* --- facets by hand: material 0 is the case's, 1 is black ------------------------------------- */

static void hand_plate(double x, double y, double z, const double u[3], const double v[3])
{
    scene_plate(&scene, (const double[3]){x, y, z}, u, v);
}

/* A square with the given side, from a corner; front on +z. */
static void hand_square(double x, double y, double z, double side)
{
    hand_plate(x, y, z, (const double[3]){side, 0.0, 0.0}, (const double[3]){0.0, side, 0.0});
}

static void hand_cube(double side)
{
    scene_box(&scene, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){side, side, side});
}

static void hand_black(void)
{
    scene_material(&scene, 0.0, 0.0, 0.2, 0.0);
}

static void build_plate(void)
{
    hand_square(0.0, 0.0, 0.0, 1.0);
}

static void build_tilted_plate(void)
{
    hand_plate(0.25, -0.75, 0.5, (const double[3]){1.0, 2.0, 3.0},
               (const double[3]){-2.0, 1.0, 0.5});
}

/* The tip is 2^-40 away from the middle of the long side. */
static void build_needle(void)
{
    const double third = 1.0 / 3.0;
    scene_triangle(&scene, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){1.0, third, 0.25},
                   (const double[3]){0.5 + 0x1p-40, 0.5 * third, 0.125});
}

static void build_sliver(void)
{
    scene_triangle(&scene, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){1.0, 0.0, 0.0},
                   (const double[3]){0.5, 0x1p-27, 0.0});
}

static void build_plate_with_a_facet_of_no_area(void)
{
    build_plate();
    scene_facet(&scene, 0, scene_vertex(&scene, 0.5, 0.5, 0.0), 2);
}

static void build_small_box(void)
{
    hand_cube(0x1p-500);
}

static void build_large_box(void)
{
    hand_cube(0x1p300);
}

/* A plate, and a black wall on its edge that shadows it. */
static void hand_bracket(double at, double side)
{
    hand_square(at, at, at, side);
    hand_black();
    hand_plate(at + side, at, at, (const double[3]){0.0, side, 0.0},
               (const double[3]){0.0, 0.0, side});
}

static void build_bracket(void)
{
    hand_bracket(0.0, 1.0);
}

static void build_small_bracket(void)
{
    hand_bracket(0.0, 0x1p-20);
}

static void build_far_bracket(void)
{
    hand_bracket(0x1p20, 1.0);
}

static void build_comb(void)
{
    hand_plate(0.0, 0.0, 0.0, (const double[3]){5.0, 0.0, 0.0}, (const double[3]){0.0, 1.0, 0.0});
    for (int i = 1; i <= 40; i++) {
        hand_plate(0.125 * i, 0.0, 0.0, (const double[3]){0.0, 1.0, 0.0},
                   (const double[3]){0.0, 0.0, 1.0});
    }
}

static void build_crossing_plates(void)
{
    hand_plate(-1.0, 0.0, -1.0, (const double[3]){2.0, 0.0, 2.0}, (const double[3]){0.0, 1.0, 0.0});
    hand_plate(-1.0, 0.0, 1.0, (const double[3]){2.0, 0.0, -2.0}, (const double[3]){0.0, 1.0, 0.0});
}

static void build_doubled_plate(void)
{
    build_plate();
    build_plate();
}

static void build_overlapping_plates(void)
{
    hand_square(0.0, 0.0, 0.0, 2.0);
    hand_square(1.0, 1.0, 0.0, 2.0);
}

static void build_skins(void)
{
    hand_square(0.0, 0.0, 1.0, 1.0);
    hand_square(0.0, 0.0, 1.0 + 0x1p-52, 1.0);
}

static void build_inverted_box(void)
{
    hand_cube(1.0);
    scene_invert(&scene, 0);
}

/* The ray from the facet's centroid to the laser meets the screen on its diagonal. */
static void build_screened_facet(void)
{
    scene_triangle(&scene, (const double[3]){-1.5, -3.0, 3.0}, (const double[3]){-2.0, -2.5, 3.0},
                   (const double[3]){-2.5, -3.5, 3.0});
    hand_black();
    hand_square(-5.0, -5.0, 8.0, 10.0);
}

static void build_t_junction(void)
{
    scene_box(&scene, (const double[3]){0.0, 0.0, 0.0}, (const double[3]){3.0, 2.0, 1.0});
    /* on the diagonal of the top, from 7 to 4 */
    uint32_t middle = scene_vertex(&scene, 1.5, 1.0, 1.0);
    scene.facet[10] = (lrcs_facet){{4, 5, middle}};
    scene_facet(&scene, 5, 7, middle);
}

static void build_nothing(void)
{
}

/* One corner of the plate has a coordinate that is not a number. */
static void build_nan(void)
{
    build_plate();
    scene.vertex[2].x[0] = (double)NAN;
}

static void build_1e308(void)
{
    build_plate();
    scene.vertex[2].x[0] = 1e308;
}

static void build_beyond_1e100(void)
{
    hand_square(0.0, 0.0, 0.0, 1.01e100);
}

/* --- the cases -------------------------------------------------------------------------------- */

#define USUAL                                                                                      \
    {                                                                                              \
        1.0, 0.25, 0.2, 0.5                                                                        \
    }

static const hard_case cases[] = {
    {"sphere, s = 0.02",
     plain_sphere,
     PLAIN_NAN,
     {1.0, 0.25, 0.02, 0.5},
     .shape = {.kind = LRCS_SHAPE_SPHERE, .radius = 1.0}},
    {"cylinder broadside, m = 10000",
     plain_cylinder,
     PLAIN_NAN,
     {1.0, 0.25, 0.2, 1e4},
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0},
     .aspect_deg = 90.0},
    {"cylinder broadside, s = 0.0001",
     plain_steps,
     PLAIN_OFF,
     {1e6, 0.25, 1e-4, 0.5},
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0},
     .aspect_deg = 90.0},
    {"cylinder wall seen end-on", plain_cylinder, PLAIN_NAN, USUAL,
     .shape = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_WALL, .radius = 0.5, .length = 2.0}},
    {"cone of 1e-9 deg, nose-on", plain_cone, PLAIN_ANY, USUAL,
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 1e-9}},
    {"cone of 89.9999 deg, s = 1e-6",
     plain_cone,
     PLAIN_ANY,
     {1.0, 0.25, 1e-6, 0.5},
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 89.9999}},
    {"cone along its side, s = 0.001",
     plain_steps,
     PLAIN_OFF,
     {1e4, 0.25, 1e-3, 0.5},
     .shape = {LRCS_SHAPE_CONE, LRCS_SHAPE_WALL, .radius = 0.5, .half_angle_deg = 45.0},
     .aspect_deg = 45.0},
    {"paraboloid, m = 1",
     plain_paraboloid,
     PLAIN_NAN,
     {1.0, 0.25, 0.2, 1.0},
     .shape = {LRCS_SHAPE_PARABOLOID, LRCS_SHAPE_WALL, .radius = 0.5, .length = 0.4}},
    {"paraboloid 1e-6 deep",
     plain_paraboloid,
     PLAIN_ANY,
     {1.0, 0.25, 0.5, 0.5},
     .shape = {LRCS_SHAPE_PARABOLOID, LRCS_SHAPE_WALL, .radius = 1.0, .length = 1e-6}},
    {"plate 1e-60 rad from edge-on", plain_facets, PLAIN_NAN, USUAL, .build = build_plate,
     .direction = {1.0, 0.0, 1e-60}},
    {"plate exactly edge-on", plain_facets, PLAIN_ANY, USUAL, .build = build_tilted_plate,
     .direction = {-2.0, 1.0, 0.5}},
    {"glint 1e-6 wide, 2e-6 off normal",
     plain_facets,
     PLAIN_ANY,
     {1.0, 0.25, 1e-6, 0.5},
     .build = build_plate,
     .direction = {2e-6, 0.0, 1.0}},
    {"glint that underflows, 63 deg",
     plain_facets,
     PLAIN_ANY,
     {1.0, 0.25, 1e-3, 0.5},
     .build = build_plate,
     .direction = {2.0, 0.0, 1.0}},
    {"needle of aspect 1e12", plain_facets, PLAIN_ANY, USUAL, .build = build_needle,
     .direction = {1.0, 2.0, -3.0}},
    {"sliver of aspect 1e8, Heron", plain_heron, PLAIN_ZERO, USUAL, .build = build_sliver,
     .direction = {1.0, 2.0, 4.0}},
    {"facet of no area", plain_facets, PLAIN_NAN, USUAL,
     .build = build_plate_with_a_facet_of_no_area, .direction = {1.0, 2.0, 4.0}},
    {"box of 2^-500 m", plain_facets, PLAIN_NAN, USUAL, .build = build_small_box,
     .direction = {1.0, 2.0, 3.0}},
    {"box of 2^300 m", plain_facets, PLAIN_ZERO, USUAL, .build = build_large_box,
     .direction = {1.0, 2.0, 3.0}},
    {"L-bracket, 3/8 in shadow", plain_facets, PLAIN_OFF, USUAL, .build = build_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {"the same, 2^-20 of its size", plain_facets, PLAIN_ANY, USUAL, .build = build_small_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {"the same, moved 2^20 m", plain_facets, PLAIN_ANY, USUAL, .build = build_far_bracket,
     .direction = {3.0, 0.0, 8.0}},
    {"comb of 40 fins", plain_facets, PLAIN_OFF, USUAL, .build = build_comb,
     .direction = {1.0, 0.0, 2.0}},
    {"plates that cross", plain_facets, PLAIN_OFF, USUAL, .build = build_crossing_plates,
     .direction = {1.0, 0.0, 2.0}},
    {"facets given twice", plain_facets, PLAIN_OFF, USUAL, .build = build_doubled_plate,
     .direction = {1.0, 2.0, 4.0}},
    {"two plates that share a quarter", plain_facets, PLAIN_OFF, USUAL,
     .build = build_overlapping_plates, .direction = {0.0, 0.0, 1.0}},
    {"skins one ulp apart", plain_facets, PLAIN_OFF, USUAL, .build = build_skins,
     .direction = {0.0, 0.0, 1.0}},
    {"box inside out", plain_facets, PLAIN_ANY, USUAL, .build = build_inverted_box,
     .direction = {1.0, 2.0, 3.0}},
    {"wholly behind a screen", plain_facets, PLAIN_OFF, USUAL, .build = build_screened_facet,
     .direction = {2.0, 3.0, 5.0}},
    {"box with a T-junction", plain_facets, PLAIN_ANY, USUAL, .build = build_t_junction,
     .direction = {1.0, 2.0, 3.0}},
    {"empty scene", plain_facets, PLAIN_ANY, USUAL, .build = build_nothing,
     .direction = {0.0, 0.0, 1.0}},
    {"a coordinate NaN", plain_facets, PLAIN_ANY, USUAL, .build = build_nan,
     .direction = {0.0, 0.0, 1.0}},
    {"a coordinate of 1e308 m", plain_facets, PLAIN_ANY, USUAL, .build = build_1e308,
     .direction = {0.0, 0.0, 1.0}},
    {"a plate beyond 1e100 m", plain_facets, PLAIN_ANY, USUAL, .build = build_beyond_1e100,
     .direction = {0.0, 0.0, 1.0}},
};

#define CASES (sizeof cases / sizeof cases[0])

static const struct {
    const char *name;
    double sigma;
} references[] = {
#include "../vectors/hard.inc"
};

/* The reference of a case; NaN if the engine must refuse it. */
static double reference(const hard_case *one)
{
    for (size_t i = 0; i < sizeof references / sizeof references[0]; i++) {
        if (strcmp(references[i].name, one->name) == 0) {
            return references[i].sigma;
        }
    }
    return (double)NAN;
}

typedef struct hard_answer {
    double plain, engine, bound;
    int status; /* of the engine */
} hard_answer;

/* Prepares and runs the facets of a case; the status of the step that fails. */
static int facets_run(const hard_case *one, hard_answer *answer)
{
    const lrcs_prepared *prepared = NULL;
    const lrcs_run_options options = {.tolerance = 1e-4, .method = LRCS_METHOD_EXACT};
    lrcs_pose pose;
    lrcs_result result = {0};
    lrcs_work work = lrcs_work_make(scene_memory, sizeof scene_memory);
    int status = lrcs_pose_from_direction(one->direction, &pose);
    status = status == LRCS_OK ? lrcs_prepare_run(&scene.scene, &work, &prepared) : status;
    status = status == LRCS_OK
                 ? lrcs_sigma_run(prepared, &pose, &options, &work, &result, scene.record, NULL)
                 : status;
    answer->engine = result.sigma_m2;
    answer->bound = result.bound_m2;
    return status;
}

static hard_answer case_run(const hard_case *one)
{
    hard_answer answer = {0};
    scene_start(&scene);
    scene.material[0].brdf = one->brdf;
    if (one->build) {
        one->build();
        answer.status = facets_run(one, &answer);
    } else {
        const lrcs_aspect aspect = {.deg = one->aspect_deg};
        lrcs_closed_form closed = {0};
        answer.status = lrcs_closed_eval(&one->shape, &one->brdf, &aspect, &closed);
        answer.engine = closed.sigma_m2;
        answer.bound = closed.bound_m2;
    }
    answer.plain = one->plain(one);
    return answer;
}

/* --- tests ------------------------------------------------------------------------------------ */

/* The reference is itself rounded once. */
static void engine_is_within_its_bound_on_every_hard_case(void **state)
{
    (void)state;
    int answered = 0;
    for (size_t i = 0; i < CASES; i++) {
        double want = reference(&cases[i]);
        if (!isnan(want)) {
            hard_answer answer = case_run(&cases[i]);
            assert_int_equal(answer.status, LRCS_OK);
            check_abs(answer.engine, want, answer.bound + 0x1p-53 * fabs(want));
            answered++;
        }
    }
    assert_int_equal(answered, 30);
}

static void engine_refuses_what_has_no_answer(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        if (isnan(reference(&cases[i]))) {
            assert_int_equal(case_run(&cases[i]).status, LRCS_E_NUMBER);
        }
    }
}

static void plain_formulas_fail_as_the_cases_say(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        double want = reference(&cases[i]);
        double plain = case_run(&cases[i]).plain;
        int off = fabs(plain - want) > 1e-3 * fabs(want);
        int held = cases[i].outcome == PLAIN_NAN    ? isnan(plain)
                   : cases[i].outcome == PLAIN_ZERO ? plain == 0.0
                   : cases[i].outcome == PLAIN_OFF  ? off
                                                    : 1;
        if (!held) {
            fprintf(stderr, "%s: the plain formula gives %g\n", cases[i].name, plain);
            fail();
        }
    }
}

static void table_print(void)
{
    printf("%-33s%14s %14s %14s %9s\n", "case, sigma in m2", "plain formula", "engine", "reference",
           "bound");
    for (size_t i = 0; i < CASES; i++) {
        hard_answer answer = case_run(&cases[i]);
        printf("%-33s%14.8g ", cases[i].name, isnan(answer.plain) ? (double)NAN : answer.plain);
        if (answer.status == LRCS_OK) {
            printf("%14.8g %14.8g %9.1e\n", answer.engine, reference(&cases[i]), answer.bound);
        } else {
            printf("%14s %14s %9s\n", "refused", "refused", "-");
        }
    }
}

int main(int count, char **word)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(engine_is_within_its_bound_on_every_hard_case),
        cmocka_unit_test(engine_refuses_what_has_no_answer),
        cmocka_unit_test(plain_formulas_fail_as_the_cases_say),
    };
    if (count == 2 && strcmp(word[1], "table") == 0) {
        table_print();
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
