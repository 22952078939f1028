/* SPDX-License-Identifier: MIT */
/* The catalogue of mistakes, each a small function of the truth: how somebody shades a facet, which
   area of it they sum, which pose they take for the one asked for. Which of them explains what was
   handed in, compare_explain.c decides. */
#include "cli/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREES_PER_RADIAN 57.295779513082320877
#define QUARTER_PI_INVERSE 0.079577471545947667884 /* 1 / (4 pi) */
#define TWINS_MOST         256u /* facets of scenes in which twins are looked for */

/* ---- shades: f_r cos ---- */

double cli_mistake_right(const mistake_spot *spot, double at)
{
    (void)at;
    return lrcs_brdf_eval(spot->brdf, spot->c) * spot->c;
}

/* With a power of the cosine in place of the first. */
static double shade_cosine(const mistake_spot *spot, double at)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) * pow(spot->c, at);
}

/* f_r at the cosine of so many radians as theta has degrees; at 1: its magnitude. */
static double shade_degrees(const mistake_spot *spot, double at)
{
    double c = cos(acos(spot->c) * DEGREES_PER_RADIAN);
    c = at > 0.0 ? fabs(c) : c;
    return c > 0.0 ? lrcs_brdf_eval(spot->brdf, c) * spot->c : 0.0;
}

/* Both terms from their formulas, for mistakes inside the glint. */
static double shade_terms(const mistake_spot *spot, double power, double exponent)
{
    const lrcs_brdf *b = spot->brdf;
    double glint = b->A > 0.0 ? b->A * pow(spot->c, -power) * exp(-exponent) : 0.0;
    return (glint + b->B * pow(spot->c, b->m)) * spot->c;
}

static double spot_tan2(const mistake_spot *spot)
{
    return 1.0 / (spot->c * spot->c) - 1.0;
}

/* 1 / cos^at in place of 1 / cos^6. */
static double shade_power(const mistake_spot *spot, double at)
{
    return shade_terms(spot, at, spot_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

/* tan^2 at / s^2 in place of tan^2 / s^2; at 0: tan^2 / s. */
static double shade_slope(const mistake_spot *spot, double at)
{
    double s = spot->brdf->s;
    return shade_terms(spot, 6.0, spot_tan2(spot) * (at > 0.0 ? at / (s * s) : 1.0 / s));
}

static double shade_small_angle(const mistake_spot *spot, double at)
{
    double theta = acos(spot->c) / spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, theta * theta);
}

static double shade_lambert(const mistake_spot *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.m = at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

/* At 0 without the glint term, at 1 without the diffuse one. */
static double shade_one_term(const mistake_spot *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.A *= at;
    brdf.B *= 1.0 - at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

static double brdf_at(const mistake_spot *spot, double theta_deg)
{
    return lrcs_brdf_eval(spot->brdf, cos(theta_deg / DEGREES_PER_RADIAN));
}

/* f_r from a table in steps of `at` deg, with lines between its entries. */
static double shade_lines(const mistake_spot *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    double low = at * floor(theta / at);
    double from = brdf_at(spot, low);
    return (from + (theta - low) / at * (brdf_at(spot, low + at) - from)) * spot->c;
}

/* theta rounded to multiples of `at` deg. */
static double shade_steps(const mistake_spot *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    return brdf_at(spot, at * floor(theta / at + 0.5)) * spot->c;
}

/* A channel of 8 bits, of which `at` is the brightest; 0: the brightest of the case. */
static double shade_bits(const mistake_spot *spot, double at)
{
    double white = at > 0.0 ? at : spot->peak;
    double value = white > 0.0 ? fmin(cli_mistake_right(spot, at) / white, 1.0) : 0.0;
    return white * floor(255.0 * value + 0.5) / 255.0;
}

static double shade_clamped(const mistake_spot *spot, double at)
{
    return fmin(cli_mistake_right(spot, at), at);
}

/* ---- areas ---- */

static int spot_fill(const mistake_view *view, uint32_t facet, mistake_spot *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_material *material = &scene->material[scene->facet_material[facet]];
    spot->brdf = &material->brdf;
    spot->c = fmin(fabs(view->records[facet].cos_theta), 1.0);
    return view->records[facet].cos_theta > 0.0 || material->two_sided;
}

double cli_mistake_seen(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    return spot_fill(view, facet, spot) ? view->records[facet].visible_area_m2 : 0.0;
}

static double area_unshadowed(const mistake_view *view, uint32_t facet, int corner,
                              mistake_spot *spot)
{
    (void)corner;
    return spot_fill(view, facet, spot) ? view->records[facet].area_m2 * spot->c : 0.0;
}

static double area_backs(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    spot_fill(view, facet, spot);
    return view->records[facet].visible_area_m2;
}

static double area_all(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    spot_fill(view, facet, spot);
    return view->records[facet].area_m2 * spot->c;
}

static double area_one_sided(const mistake_view *view, uint32_t facet, int corner,
                             mistake_spot *spot)
{
    double area = cli_mistake_seen(view, facet, corner, spot);
    return view->records[facet].cos_theta > 0.0 ? area : 0.0;
}

static double area_clockwise(const mistake_view *view, uint32_t facet, int corner,
                             mistake_spot *spot)
{
    double area = area_backs(view, facet, corner, spot);
    return view->records[facet].cos_theta < 0.0 ? area : 0.0;
}

static double area_one_material(const mistake_view *view, uint32_t facet, int corner,
                                mistake_spot *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    double area = cli_mistake_seen(view, facet, corner, spot);
    spot->brdf = &scene->material[scene->facet_material[0]].brdf;
    return area;
}

/* Shaded by the mean normal at each corner. */
static double area_smooth(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
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

/* Of facets in one place the last one, in place of the first. */
static double area_last(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
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

/* Components of s_hat exchanged and mirrored. */
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

/* The laser along another axis of the observation frame. */
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

/* ---- the catalogue ---- */

#define CULLED (1u << LRCS_EFFECT_BACK_FACE_CASTERS)

const compare_mistake cli_compare_mistakes[] = {
    {.name = "none", .text = "as it should be"},
    {.name = "no-shadows",
     .text = "missing shadows: facets count whole, though others hide them",
     .area = area_unshadowed},
    {.name = "backs-reflect",
     .text = "back faces: visible backs of one-sided facets reflect (|cos theta| in place of cos "
             "theta?)",
     .area = area_backs},
    {.name = "backs-and-no-shadows",
     .text = "back faces and missing shadows: every facet counts, whichever way it faces",
     .area = area_all},
    {.name = "backs-culled",
     .text = "back faces are culled: they do not hide what is behind them",
     .without = CULLED},
    {.name = "one-sided",
     .text = "two-sided materials reflect from their front only",
     .area = area_one_sided},
    {.name = "clockwise",
     .text = "winding: fronts are taken for backs (clockwise, or normals inward)",
     .area = area_clockwise},
    {.name = "one-material",
     .text = "every facet wears the first facet's material",
     .area = area_one_material},
    {.name = "last-wins",
     .text = "of facets in one place the last one counts, not the first (depth test <= ?)",
     .area = area_last},
    {.name = "missing-cosine",
     .text = "missing cos: a sum of f_r, not of f_r cos theta, times projected area",
     .shade = shade_cosine,
     .at = 0.0},
    {.name = "missing-cosines",
     .text = "missing cos twice: f_r times the facet's area, not its projected area",
     .shade = shade_cosine,
     .at = -1.0},
    {.name = "extra-cosine",
     .text = "one cos too many: f_r cos^2 theta times projected area",
     .shade = shade_cosine,
     .at = 2.0},
    {.name = "theta-degrees",
     .text = "degrees for radians: theta in degrees goes into cos or tan as radians",
     .shade = shade_degrees,
     .at = 0.0},
    {.name = "theta-degrees-folded",
     .text = "degrees for radians: theta in degrees goes into |cos| or tan as radians",
     .shade = shade_degrees,
     .at = 1.0},
    {.name = "no-cos6", .text = "BRDF: the glint lacks 1 / cos^6", .shade = shade_power, .at = 0.0},
    {.name = "cos4",
     .text = "BRDF: the glint has 1 / cos^4 in place of 1 / cos^6",
     .shade = shade_power,
     .at = 4.0},
    {.name = "s-plain",
     .text = "BRDF: tan^2 / s in place of tan^2 / s^2",
     .shade = shade_slope,
     .at = 0.0},
    {.name = "s-twice",
     .text = "BRDF: tan^2 / (2 s^2) in place of tan^2 / s^2",
     .shade = shade_slope,
     .at = 0.5},
    {.name = "small-angle",
     .text = "BRDF: theta^2 / s^2 in place of tan^2 / s^2",
     .shade = shade_small_angle},
    {.name = "lambert",
     .text = "BRDF: the diffuse term lacks cos^m",
     .shade = shade_lambert,
     .at = 0.0},
    {.name = "no-glint",
     .text = "BRDF: the glint term is missing (A = 0)",
     .shade = shade_one_term,
     .at = 0.0},
    {.name = "no-diffuse",
     .text = "BRDF: the diffuse term is missing (B = 0)",
     .shade = shade_one_term,
     .at = 1.0},
    {.name = "vertex-normals",
     .text = "under-resolved glint: shaded by averaged normals at the corners",
     .area = area_smooth,
     .corners = 3},
    {.name = "angles-1",
     .text = "under-resolved glint: f_r from a table in steps of 1 deg, lines between",
     .shade = shade_lines,
     .at = 1.0},
    {.name = "angles-5",
     .text = "under-resolved glint: f_r from a table in steps of 5 deg, lines between",
     .shade = shade_lines,
     .at = 5.0},
    {.name = "angles-10",
     .text = "under-resolved glint: f_r from a table in steps of 10 deg, lines between",
     .shade = shade_lines,
     .at = 10.0},
    {.name = "steps-1",
     .text = "under-resolved glint: theta rounded to whole degrees",
     .shade = shade_steps,
     .at = 1.0},
    {.name = "steps-5",
     .text = "under-resolved glint: theta rounded to 5 deg",
     .shade = shade_steps,
     .at = 5.0},
    {.name = "steps-10",
     .text = "under-resolved glint: theta rounded to 10 deg",
     .shade = shade_steps,
     .at = 10.0},
    {.name = "8-bits",
     .text = "colour quantisation: f_r cos in 8 bits, 1 being the brightest",
     .shade = shade_bits,
     .at = 1.0},
    {.name = "8-bits-4pi",
     .text = "colour quantisation: 4 pi f_r cos in 8 bits, 1 being the brightest",
     .shade = shade_bits,
     .at = QUARTER_PI_INVERSE},
    {.name = "8-bits-peak",
     .text = "colour quantisation: 8 bits of the brightest f_r cos of each case",
     .shade = shade_bits,
     .at = 0.0},
    {.name = "clamped", .text = "f_r cos is clamped at 1", .shade = shade_clamped, .at = 1.0},
    {.name = "transposed",
     .text = "wrong frame: R in place of its transpose (or the conjugate quaternion)",
     .turn = turn_transposed},
    {.name = "negated",
     .text = "wrong frame: the laser on the other side, -s_hat",
     .turn = turn_axes,
     .axes = {-1, -2, -3}},
    {.name = "mirror-x",
     .text = "wrong handedness: x mirrored",
     .turn = turn_axes,
     .axes = {-1, 2, 3}},
    {.name = "mirror-y",
     .text = "wrong handedness: y mirrored",
     .turn = turn_axes,
     .axes = {1, -2, 3}},
    {.name = "mirror-z",
     .text = "wrong handedness: z mirrored",
     .turn = turn_axes,
     .axes = {1, 2, -3}},
    {.name = "swap-xy",
     .text = "wrong handedness: x and y exchanged",
     .turn = turn_axes,
     .axes = {2, 1, 3}},
    {.name = "swap-yz",
     .text = "wrong handedness: y and z exchanged",
     .turn = turn_axes,
     .axes = {1, 3, 2}},
    {.name = "swap-zx",
     .text = "wrong handedness: z and x exchanged",
     .turn = turn_axes,
     .axes = {3, 2, 1}},
    {.name = "y-up",
     .text = "wrong frame: turned by 90 deg about x (y up, or z?)",
     .turn = turn_axes,
     .axes = {1, 3, -2}},
    {.name = "z-up",
     .text = "wrong frame: turned by -90 deg about x (y up, or z?)",
     .turn = turn_axes,
     .axes = {1, -3, 2}},
    {.name = "yzx",
     .text = "wrong frame: x, y, z taken for y, z, x",
     .turn = turn_axes,
     .axes = {2, 3, 1}},
    {.name = "zxy",
     .text = "wrong frame: x, y, z taken for z, x, y",
     .turn = turn_axes,
     .axes = {3, 1, 2}},
    {.name = "along-x",
     .text = "wrong frame: the laser along x of the observation frame, not z",
     .turn = turn_along,
     .axes = {1, 0, 0}},
    {.name = "along-y",
     .text = "wrong frame: the laser along y of the observation frame, not z",
     .turn = turn_along,
     .axes = {2, 0, 0}},
    {.name = "scalar-last",
     .text = "wrong frame: the quaternion read as (x, y, z, w)",
     .turn = turn_scalar_last},
    {.name = "azel-radians",
     .text = "degrees for radians: azimuth and elevation in degrees taken for radians",
     .turn = turn_radians},
    {.name = "polar-angle",
     .text = "wrong frame: elevation taken for an angle from the z axis",
     .turn = turn_polar},
    {.name = NULL}};
