/* SPDX-License-Identifier: MIT */
/* The catalogue of mistakes: in the shading of a facet, in the area that is summed, in the pose.
   explain.c decides which of them explains the submitted answers. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES_PER_RADIAN 57.295779513082320877
#define QUARTER_PI_INVERSE 0.079577471545947667884 /* 1 / (4 pi) */
#define TWINS_MOST         256u /* scenes with more facets are not searched for coincident facets */

/* ---- the shading of a facet: f_r cos theta, wrong ---- */

double cli_mistake_right(const mistake_point *spot, double at)
{
    (void)at;
    return lrcs_brdf_eval(spot->brdf, spot->c) * spot->c;
}

/* Another power of the cosine instead of the first. */
static double shade_cosine(const mistake_point *spot, double at)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) * pow(spot->c, at);
}

/* f_r at the cosine of theta in degrees taken for radians; at 1: the magnitude of that cosine. */
static double shade_degrees(const mistake_point *spot, double at)
{
    double c = cos(acos(spot->c) * DEGREES_PER_RADIAN);
    c = at > 0.0 ? fabs(c) : c;
    return c > 0.0 ? lrcs_brdf_eval(spot->brdf, c) * spot->c : 0.0;
}

/* Both terms from their formulas, for mistakes in the glint term. */
static double shade_terms(const mistake_point *spot, double power, double exponent)
{
    const lrcs_brdf *b = spot->brdf;
    double glint = b->A > 0.0 ? b->A * pow(spot->c, -power) * exp(-exponent) : 0.0;
    return (glint + b->B * pow(spot->c, b->m)) * spot->c;
}

static double point_tan2(const mistake_point *spot)
{
    return 1.0 / (spot->c * spot->c) - 1.0;
}

/* 1 / cos^at instead of 1 / cos^6. */
static double shade_power(const mistake_point *spot, double at)
{
    return shade_terms(spot, at, point_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

/* tan^2 at / s^2 instead of tan^2 / s^2; at 0: tan^2 / s. */
static double shade_slope(const mistake_point *spot, double at)
{
    double s = spot->brdf->s;
    return shade_terms(spot, 6.0, point_tan2(spot) * (at > 0.0 ? at / (s * s) : 1.0 / s));
}

static double shade_sine(const mistake_point *spot, double at)
{
    double s = spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, (1.0 - spot->c * spot->c) / (s * s));
}

static double shade_small_angle(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) / spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, theta * theta);
}

/* The tangent of theta in degrees, taken for radians; the cosines are right. */
static double shade_tan_degrees(const mistake_point *spot, double at)
{
    double t = tan(acos(spot->c) * DEGREES_PER_RADIAN) / spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, t * t);
}

static double shade_lambert(const mistake_point *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.m = at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

/* At 0 without the glint term, at 1 without the diffuse term. */
static double shade_one_term(const mistake_point *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.A *= at;
    brdf.B *= 1.0 - at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

static double brdf_at(const mistake_point *spot, double theta_deg)
{
    return lrcs_brdf_eval(spot->brdf, cos(theta_deg / DEGREES_PER_RADIAN));
}

/* f_r from a table in steps of `at` deg, interpolated linearly. */
static double shade_lines(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    double low = at * floor(theta / at);
    double from = brdf_at(spot, low);
    return (from + (theta - low) / at * (brdf_at(spot, low + at) - from)) * spot->c;
}

/* theta rounded to multiples of `at` deg. */
static double shade_steps(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    return brdf_at(spot, at * floor(theta / at + 0.5)) * spot->c;
}

/* A channel of 8 bits whose largest value stands for `at`; 0: for the brightest facet of the
   case. */
static double shade_bits(const mistake_point *spot, double at)
{
    double white = at > 0.0 ? at : spot->peak;
    double value = white > 0.0 ? fmin(cli_mistake_right(spot, at) / white, 1.0) : 0.0;
    return white * floor(255.0 * value + 0.5) / 255.0;
}

static double shade_clamped(const mistake_point *spot, double at)
{
    return fmin(cli_mistake_right(spot, at), at);
}

/* ---- the area of a facet that is summed, its cosine, its material ---- */

static int point_fill(const mistake_view *view, uint32_t facet, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_material *material = &scene->material[scene->facet_material[facet]];
    spot->brdf = &material->brdf;
    spot->c = fmin(fabs(view->records[facet].cos_theta), 1.0);
    return view->records[facet].cos_theta > 0.0 || material->two_sided;
}

double cli_mistake_seen(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    return point_fill(view, facet, spot) ? view->records[facet].visible_area_m2 : 0.0;
}

static double area_unshadowed(const mistake_view *view, uint32_t facet, int corner,
                              mistake_point *spot)
{
    (void)corner;
    return point_fill(view, facet, spot) ? view->records[facet].area_m2 * spot->c : 0.0;
}

static double area_backs(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    point_fill(view, facet, spot);
    return view->records[facet].visible_area_m2;
}

static double area_all(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    point_fill(view, facet, spot);
    return view->records[facet].area_m2 * spot->c;
}

static double area_one_sided(const mistake_view *view, uint32_t facet, int corner,
                             mistake_point *spot)
{
    double area = cli_mistake_seen(view, facet, corner, spot);
    return view->records[facet].cos_theta > 0.0 ? area : 0.0;
}

/* Front and back sides exchanged. */
static double area_flipped(const mistake_view *view, uint32_t facet, int corner,
                           mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    int two_sided = scene->material[scene->facet_material[facet]].two_sided;
    double area = area_backs(view, facet, corner, spot);
    return two_sided || view->records[facet].cos_theta < 0.0 ? area : 0.0;
}

static double area_one_material(const mistake_view *view, uint32_t facet, int corner,
                                mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    double area = cli_mistake_seen(view, facet, corner, spot);
    spot->brdf = &scene->material[scene->facet_material[0]].brdf;
    return area;
}

/* The material changes one facet too late. */
static double area_next_material(const mistake_view *view, uint32_t facet, int corner,
                                 mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_material *worn = &scene->material[scene->facet_material[facet ? facet - 1 : 0]];
    double area = area_backs(view, facet, corner, spot);
    spot->brdf = &worn->brdf;
    return worn->two_sided || view->records[facet].cos_theta > 0.0 ? area : 0.0;
}

/* Shading by the mean normal at each corner. */
static double area_smooth(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const double *n = view->scene->normal[scene->facet[facet].corner[corner]].x;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double area = cli_mistake_seen(view, facet, corner, spot);
    double c = 0.0;
    for (int k = 0; k < 3; k++) {
        c += length > 0.0 ? n[k] / length * view->direction[k] : 0.0;
    }
    c = view->records[facet].cos_theta < 0.0 ? -c : c;
    spot->c = fmin(c, 1.0);
    return c > 0.0 ? area : 0.0;
}

static int facets_coincide(const lrcs_scene *scene, uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++) {
        if (memcmp(&scene->vertex[scene->facet[a].corner[k]],
                   &scene->vertex[scene->facet[b].corner[k]], sizeof *scene->vertex) != 0) {
            return 0;
        }
    }
    return 1;
}

/* Of coincident facets the last one is counted instead of the first. */
static double area_last(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    double area = cli_mistake_seen(view, facet, corner, spot);
    uint32_t count = scene->facet_count <= TWINS_MOST ? scene->facet_count : 0;
    for (uint32_t i = facet + 1; i < count && area > 0.0; i++) {
        if (facets_coincide(scene, facet, i)) {
            spot->brdf = &scene->material[scene->facet_material[i]].brdf;
        }
    }
    return area;
}

/* ---- poses ---- */

static int turn_to(const double direction[3], lrcs_pose *pose)
{
    return lrcs_pose_from_direction(direction, pose);
}

/* Exchanges and mirrors components of s_hat. */
static int turn_axes(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    double s[3];
    for (int k = 0; k < 3; k++) {
        int axis = mistake->axes[k];
        s[k] = (axis < 0 ? -1.0 : 1.0) * one->direction[abs(axis) - 1];
    }
    return turn_to(s, pose);
}

static int turn_transposed(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    const double s[3] = {one->pose.R[0][2], one->pose.R[1][2], one->pose.R[2][2]};
    (void)mistake;
    return turn_to(s, pose);
}

/* Puts the laser on another axis of the observation frame. */
static int turn_along(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    return turn_to(one->pose.R[mistake->axes[0] - 1], pose);
}

static int turn_scalar_last(const compare_case *one, const compare_mistake *mistake,
                            lrcs_pose *pose)
{
    const double *q = one->quaternion;
    const double turned[4] = {q[3], q[0], q[1], q[2]};
    (void)mistake;
    return lrcs_pose_from_quaternion(turned, pose);
}

static int turn_radians(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    const double *a = one->azel_deg;
    const double s[3] = {cos(a[1]) * cos(a[0]), cos(a[1]) * sin(a[0]), sin(a[1])};
    (void)mistake;
    return turn_to(s, pose);
}

static int turn_polar(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    double az = one->azel_deg[0] / DEGREES_PER_RADIAN;
    double polar = one->azel_deg[1] / DEGREES_PER_RADIAN;
    const double s[3] = {sin(polar) * cos(az), sin(polar) * sin(az), cos(polar)};
    (void)mistake;
    return turn_to(s, pose);
}

/* Exchanges azimuth and elevation. */
static int turn_exchanged(const compare_case *one, const compare_mistake *mistake, lrcs_pose *pose)
{
    double az = one->azel_deg[1] / DEGREES_PER_RADIAN;
    double el = one->azel_deg[0] / DEGREES_PER_RADIAN;
    const double s[3] = {cos(el) * cos(az), cos(el) * sin(az), sin(el)};
    (void)mistake;
    return turn_to(s, pose);
}

/* ---- the catalogue ---- */

#define CULLED (1u << LRCS_EFFECT_BACK_FACE_CASTERS)

const compare_mistake cli_compare_mistakes[] = {
    {.name = "none", .text = "as it should be"},
    {"no-shadows", "missing shadows: facets count whole, though others hide them",
     .area = area_unshadowed},
    {"backs-reflect",
     "back faces: visible backs of one-sided facets reflect (|cos theta| in place of cos theta?)",
     .area = area_backs},
    {"backs-and-no-shadows",
     "back faces and missing shadows: every facet counts, whichever way it faces",
     .area = area_all},
    {"backs-culled", "back faces are culled: they do not hide what is behind them",
     .without = CULLED},
    {"one-sided", "two-sided materials reflect from their front only", .area = area_one_sided},
    {"clockwise", "winding: fronts are taken for backs (clockwise, or normals inward)",
     .area = area_flipped},
    {"one-material", "every facet assigned the first facet's material", .area = area_one_material},
    {"next-material", "materials begin one facet late: a facet assigned that of the one before",
     .area = area_next_material},
    {"last-wins", "of facets in one place the last one counts, not the first (depth test <= ?)",
     .area = area_last},
    {"missing-cosine", "missing cos: a sum of f_r, not of f_r cos theta, times projected area",
     .shade = shade_cosine, .at = 0.0},
    {"missing-cosines", "missing cos twice: f_r times the facet's area, not its projected area",
     .shade = shade_cosine, .at = -1.0},
    {"extra-cosine", "one cos too many: f_r cos^2 theta times projected area",
     .shade = shade_cosine, .at = 2.0},
    {"theta-degrees", "degrees for radians: theta in degrees goes into cos or tan as radians",
     .shade = shade_degrees, .at = 0.0},
    {"theta-degrees-folded",
     "degrees for radians: theta in degrees goes into |cos| or tan as radians",
     .shade = shade_degrees, .at = 1.0},
    {"no-cos6", "BRDF: the glint lacks 1 / cos^6", .shade = shade_power, .at = 0.0},
    {"cos4", "BRDF: the glint has 1 / cos^4 in place of 1 / cos^6", .shade = shade_power,
     .at = 4.0},
    {"s-plain", "BRDF: tan^2 / s in place of tan^2 / s^2", .shade = shade_slope, .at = 0.0},
    {"s-twice", "BRDF: tan^2 / (2 s^2) in place of tan^2 / s^2", .shade = shade_slope, .at = 0.5},
    {"sine", "BRDF: sin^2 / s^2 in place of tan^2 / s^2", .shade = shade_sine},
    {"small-angle", "BRDF: theta^2 / s^2 in place of tan^2 / s^2", .shade = shade_small_angle},
    {"tan-degrees", "degrees for radians: theta in degrees goes into tan as radians, cos is right",
     .shade = shade_tan_degrees},
    {"lambert", "BRDF: the diffuse term lacks cos^m", .shade = shade_lambert, .at = 0.0},
    {"no-glint", "BRDF: the glint term is missing (A = 0)", .shade = shade_one_term, .at = 0.0},
    {"no-diffuse", "BRDF: the diffuse term is missing (B = 0)", .shade = shade_one_term, .at = 1.0},
    {"vertex-normals", "under-resolved glint: shaded by averaged normals at the corners",
     .area = area_smooth, .corners = 3},
    {"angles-1", "under-resolved glint: f_r from a table in steps of 1 deg, lines between",
     .shade = shade_lines, .at = 1.0},
    {"angles-5", "under-resolved glint: f_r from a table in steps of 5 deg, lines between",
     .shade = shade_lines, .at = 5.0},
    {"angles-10", "under-resolved glint: f_r from a table in steps of 10 deg, lines between",
     .shade = shade_lines, .at = 10.0},
    {"steps-1", "under-resolved glint: theta rounded to whole degrees", .shade = shade_steps,
     .at = 1.0},
    {"steps-5", "under-resolved glint: theta rounded to 5 deg", .shade = shade_steps, .at = 5.0},
    {"steps-10", "under-resolved glint: theta rounded to 10 deg", .shade = shade_steps, .at = 10.0},
    {"8-bits", "colour quantisation: f_r cos in 8 bits, 1 being the brightest", .shade = shade_bits,
     .at = 1.0},
    {"8-bits-4pi", "colour quantisation: 4 pi f_r cos in 8 bits, 1 being the brightest",
     .shade = shade_bits, .at = QUARTER_PI_INVERSE},
    {"8-bits-peak", "colour quantisation: 8 bits of the brightest f_r cos of each case",
     .shade = shade_bits, .at = 0.0},
    {"clamped", "f_r cos is clamped at 1", .shade = shade_clamped, .at = 1.0},
    {"farthest",
     "inverted depth: the farthest facet is seen, not the nearest (depth test, or the sign of z)",
     .turn = turn_axes, .axes = {-1, -2, -3}, .area = area_flipped},
    {"transposed", "wrong frame: R in place of its transpose (or the conjugate quaternion)",
     .turn = turn_transposed},
    {"negated", "wrong frame: the laser on the other side, -s_hat", .turn = turn_axes,
     .axes = {-1, -2, -3}},
    {"mirror-x", "wrong handedness: x mirrored", .turn = turn_axes, .axes = {-1, 2, 3}},
    {"mirror-y", "wrong handedness: y mirrored", .turn = turn_axes, .axes = {1, -2, 3}},
    {"mirror-z", "wrong handedness: z mirrored", .turn = turn_axes, .axes = {1, 2, -3}},
    {"swap-xy", "wrong handedness: x and y exchanged", .turn = turn_axes, .axes = {2, 1, 3}},
    {"swap-yz", "wrong handedness: y and z exchanged", .turn = turn_axes, .axes = {1, 3, 2}},
    {"swap-zx", "wrong handedness: z and x exchanged", .turn = turn_axes, .axes = {3, 2, 1}},
    {"y-up", "wrong frame: turned by 90 deg about x (y up, or z?)", .turn = turn_axes,
     .axes = {1, 3, -2}},
    {"z-up", "wrong frame: turned by -90 deg about x (y up, or z?)", .turn = turn_axes,
     .axes = {1, -3, 2}},
    {"yzx", "wrong frame: x, y, z taken for y, z, x", .turn = turn_axes, .axes = {2, 3, 1}},
    {"zxy", "wrong frame: x, y, z taken for z, x, y", .turn = turn_axes, .axes = {3, 1, 2}},
    {"along-x", "wrong frame: the laser along x of the observation frame, not z",
     .turn = turn_along, .axes = {1, 0, 0}},
    {"along-y", "wrong frame: the laser along y of the observation frame, not z",
     .turn = turn_along, .axes = {2, 0, 0}},
    {"mirror-x-winding", "wrong handedness: x mirrored, which turns the winding as well",
     .turn = turn_axes, .axes = {-1, 2, 3}, .area = area_flipped},
    {"mirror-y-winding", "wrong handedness: y mirrored, which turns the winding as well",
     .turn = turn_axes, .axes = {1, -2, 3}, .area = area_flipped},
    {"mirror-z-winding", "wrong handedness: z mirrored, which turns the winding as well",
     .turn = turn_axes, .axes = {1, 2, -3}, .area = area_flipped},
    {"swap-xy-winding", "wrong handedness: x and y exchanged, which turns the winding as well",
     .turn = turn_axes, .axes = {2, 1, 3}, .area = area_flipped},
    {"swap-yz-winding", "wrong handedness: y and z exchanged, which turns the winding as well",
     .turn = turn_axes, .axes = {1, 3, 2}, .area = area_flipped},
    {"swap-zx-winding", "wrong handedness: z and x exchanged, which turns the winding as well",
     .turn = turn_axes, .axes = {3, 2, 1}, .area = area_flipped},
    {"along-x-winding",
     "wrong handedness: x and z of the observation frame exchanged, which turns the winding as "
     "well",
     .turn = turn_along, .axes = {1, 0, 0}, .area = area_flipped},
    {"along-y-winding",
     "wrong handedness: y and z of the observation frame exchanged, which turns the winding as "
     "well",
     .turn = turn_along, .axes = {2, 0, 0}, .area = area_flipped},
    {"scalar-last", "wrong frame: the quaternion read as (x, y, z, w)", .turn = turn_scalar_last},
    {"azel-radians", "degrees for radians: azimuth and elevation in degrees taken for radians",
     .turn = turn_radians},
    {"azel-exchanged", "wrong frame: azimuth and elevation exchanged", .turn = turn_exchanged},
    {"polar-angle", "wrong frame: elevation taken for an angle from the z axis",
     .turn = turn_polar},
    {.name = NULL}};
