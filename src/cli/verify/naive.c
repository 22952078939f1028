/* SPDX-License-Identifier: MIT */
/* sigma by a straightforward implementation: the formulas as printed, in plain double arithmetic,
   with a ray from each facet's centroid for the shadow. Correct mathematically; `lrcs verify
   --hard` compares the engine with it. Nothing else may use it. */
#include "cli/verify/verify.h"

#include <math.h>

/* Eq. 1 as printed. */
static double naive_brdf(const lrcs_brdf *b, double cosine)
{
    double tan2 = 1.0 / (cosine * cosine) - 1.0;
    return b->A / pow(cosine, 6.0) * exp(-tan2 / (b->s * b->s)) + b->B * pow(cosine, b->m);
}

/* --- bodies: closed forms as printed ---------------------------------------------------------- */

double cli_naive_sphere(const hard_case *one, const hard_mesh *mesh)
{
    (void)mesh;
    const lrcs_brdf *b = &one->brdf;
    double s = b->s;
    double slopes = s * s + 0.5 * sqrt(CLI_PI) * s * s * s * exp(1.0 / (s * s)) * erfc(1.0 / s);
    double square = one->shape.radius * one->shape.radius * CLI_PI * CLI_PI;
    return 4.0 * square * b->A * slopes + 8.0 * square * b->B / (b->m + 3.0);
}

/* Only the wall. */
double cli_naive_cylinder(const hard_case *one, const hard_mesh *mesh)
{
    (void)mesh;
    const lrcs_brdf *b = &one->brdf;
    double g = one->aspect_deg * CLI_PI / 180.0;
    double k = sin(g);
    double cot = cos(g) / sin(g);
    double ks = k * b->s;
    double both = 4.0 * CLI_PI * one->shape.radius * one->shape.length * sqrt(CLI_PI);
    double glint =
        b->A * b->s / (k * k * k) * (1.0 + 0.5 * ks * ks) * exp(-cot * cot / (b->s * b->s));
    double diffuse =
        b->B * pow(k, b->m + 2.0) * tgamma(0.5 * (b->m + 3.0)) / tgamma(0.5 * (b->m + 4.0));
    return both * (glint + diffuse);
}

/* Only the wall, nose-on. */
double cli_naive_cone(const hard_case *one, const hard_mesh *mesh)
{
    (void)mesh;
    double half = one->shape.half_angle_deg * CLI_PI / 180.0;
    double radius = one->shape.radius;
    return 4.0 * CLI_PI * CLI_PI * radius * radius * sin(half) *
           naive_brdf(&one->brdf, cos(0.5 * CLI_PI - half));
}

/* Only the wall, nose-on; P(u) of the glint as a difference, the diffuse part as a power. */
static double naive_p(double u, double s)
{
    double root = sqrt(u);
    return pow(u, 2.5) + 2.5 * s * s * pow(u, 1.5) + 3.75 * pow(s, 4.0) * root +
           1.875 * sqrt(CLI_PI) * pow(s, 5.0) * exp(u / (s * s)) * erfc(root / s);
}

double cli_naive_paraboloid(const hard_case *one, const hard_mesh *mesh)
{
    (void)mesh;
    const lrcs_brdf *b = &one->brdf;
    double slope = 2.0 * one->shape.length / one->shape.radius;
    double u = 1.0 + slope * slope;
    double k = one->shape.radius / slope;
    double glint = b->A * b->s * b->s *
                   (naive_p(1.0, b->s) - exp(-slope * slope / (b->s * b->s)) * naive_p(u, b->s));
    double diffuse = 2.0 * b->B * (pow(u, 0.5 * (1.0 - b->m)) - 1.0) / (1.0 - b->m);
    return 4.0 * CLI_PI * CLI_PI * k * k * (glint + diffuse);
}

/* The wall of a cylinder or cone in 360 steps of azimuth. */
double cli_naive_steps(const hard_case *one, const hard_mesh *mesh)
{
    (void)mesh;
    const lrcs_shape *shape = &one->shape;
    double aspect = one->aspect_deg * CLI_PI / 180.0;
    double half = shape->half_angle_deg * CLI_PI / 180.0;
    double area = shape->kind == LRCS_SHAPE_CONE
                      ? CLI_PI * shape->radius * shape->radius / sin(half)
                      : 2.0 * CLI_PI * shape->radius * shape->length;
    double sum = 0.0;
    for (int degree = 0; degree < 360; degree++) {
        double cosine =
            sin(half) * cos(aspect) + cos(half) * sin(aspect) * cos(degree * CLI_PI / 180.0);
        if (cosine > 0.0) {
            sum += naive_brdf(&one->brdf, cosine) * cosine * cosine;
        }
    }
    return 4.0 * CLI_PI * area * sum / 360.0;
}

/* --- facets ----------------------------------------------------------------------------------- */

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

static void minus(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++) {
        c[k] = a[k] - b[k];
    }
}

static const double *corner(const hard_mesh *mesh, uint32_t f, int i)
{
    return mesh->vertex[mesh->facet[f].corner[i]].x;
}

/* The offset of a ray from its surface, and the threshold below which its determinant counts as
   zero. */
#define NAIVE_EPSILON 1e-6

/* 1 if the ray intersects the facet. T. Moller and B. Trumbore, J. Graphics Tools 2 (1997) 21. */
static int ray_meets(const double from[3], const double along[3], const hard_mesh *mesh, uint32_t f)
{
    double p[3];
    double q[3];
    double t[3];
    double h[3];
    double g[3];
    minus(corner(mesh, f, 1), corner(mesh, f, 0), p);
    minus(corner(mesh, f, 2), corner(mesh, f, 0), q);
    minus(from, corner(mesh, f, 0), t);
    cross(along, q, h);
    cross(t, p, g);
    double determinant = dot(p, h);
    if (fabs(determinant) < NAIVE_EPSILON) {
        return 0;
    }
    double u = dot(t, h) / determinant;
    double v = dot(along, g) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(q, g) / determinant > NAIVE_EPSILON;
}

static int centroid_in_shadow(const hard_mesh *mesh, uint32_t f, const double along[3])
{
    double from[3];
    for (int k = 0; k < 3; k++) {
        from[k] = (corner(mesh, f, 0)[k] + corner(mesh, f, 1)[k] + corner(mesh, f, 2)[k]) / 3.0;
    }
    for (uint32_t other = 0; other < mesh->facets; other++) {
        if (other != f && ray_meets(from, along, mesh, other)) {
            return 1;
        }
    }
    return 0;
}

static double area_by_cross(const double p[3], const double q[3], const double n[3])
{
    (void)p;
    (void)q;
    return 0.5 * sqrt(dot(n, n));
}

/* Heron's formula, from the lengths of the sides. */
static double area_by_heron(const double p[3], const double q[3], const double n[3])
{
    (void)n;
    double r[3];
    minus(q, p, r);
    double a = sqrt(dot(p, p));
    double b = sqrt(dot(q, q));
    double c = sqrt(dot(r, r));
    double half = 0.5 * (a + b + c);
    return sqrt(half * (half - a) * (half - b) * (half - c));
}

/* Eq. 2 over the facets whose centroid is visible to the laser. */
static double naive_sum(const hard_case *one, const hard_mesh *mesh,
                        double (*area)(const double[3], const double[3], const double[3]))
{
    double along[3];
    double length = sqrt(dot(one->direction, one->direction));
    double sigma = 0.0;
    for (int k = 0; k < 3; k++) {
        along[k] = one->direction[k] / length;
    }
    for (uint32_t f = 0; f < mesh->facets; f++) {
        double p[3];
        double q[3];
        double n[3];
        minus(corner(mesh, f, 1), corner(mesh, f, 0), p);
        minus(corner(mesh, f, 2), corner(mesh, f, 0), q);
        cross(p, q, n);
        double cosine = dot(n, along) / sqrt(dot(n, n));
        if (cosine <= 0.0 || mesh->material[f] == 1 || centroid_in_shadow(mesh, f, along)) {
            continue;
        }
        sigma += 4.0 * CLI_PI * area(p, q, n) * naive_brdf(&one->brdf, cosine) * cosine * cosine;
    }
    return sigma;
}

double cli_naive_facets(const hard_case *one, const hard_mesh *mesh)
{
    return naive_sum(one, mesh, area_by_cross);
}

double cli_naive_heron(const hard_case *one, const hard_mesh *mesh)
{
    return naive_sum(one, mesh, area_by_heron);
}
