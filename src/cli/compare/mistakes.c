/* SPDX-License-Identifier: MIT */
/* The catalogue of mistakes: in the shading of a facet, in the area that is summed, in the pose.
   explain.c decides which of them explains the submitted answers. */
#include "cli/compare/mistakes.h"

#include <math.h>
#include <stdlib.h>

#define DEGREES_PER_RADIAN 57.295779513082320877
#define QUARTER_PI_INVERSE 0.079577471545947667884 /* 1 / (4 pi) */

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
    {.name = "no-shadows",
     .text = "missing shadows: facets count whole, though others hide them",
     .area = cli_area_unshadowed},
    {.name = "backs-reflect",
     .text = "back faces: visible backs of one-sided facets reflect (|cos theta| in place of cos "
             "theta?)",
     .area = cli_area_backs},
    {.name = "backs-and-no-shadows",
     .text = "back faces and missing shadows: every facet counts, whichever way it faces",
     .area = cli_area_all},
    {.name = "backs-culled",
     .text = "back faces are culled: they do not hide what is behind them",
     .without = CULLED},
    {.name = "one-sided",
     .text = "two-sided materials reflect from their front only",
     .area = cli_area_one_sided},
    {.name = "clockwise",
     .text = "winding: fronts are taken for backs (clockwise, or normals inward)",
     .area = cli_area_flipped},
    {.name = "one-material",
     .text = "every facet wears the first facet's material",
     .area = cli_area_one_material},
    {.name = "next-material",
     .text = "materials begin one facet late: a facet wears that of the one before",
     .area = cli_area_next_material},
    {.name = "last-wins",
     .text = "of facets in one place the last one counts, not the first (depth test <= ?)",
     .area = cli_area_last},
    {.name = "missing-cosine",
     .text = "missing cos: a sum of f_r, not of f_r cos theta, times projected area",
     .shade = cli_shade_cosine,
     .at = 0.0},
    {.name = "missing-cosines",
     .text = "missing cos twice: f_r times the facet's area, not its projected area",
     .shade = cli_shade_cosine,
     .at = -1.0},
    {.name = "extra-cosine",
     .text = "one cos too many: f_r cos^2 theta times projected area",
     .shade = cli_shade_cosine,
     .at = 2.0},
    {.name = "theta-degrees",
     .text = "degrees for radians: theta in degrees goes into cos or tan as radians",
     .shade = cli_shade_degrees,
     .at = 0.0},
    {.name = "theta-degrees-folded",
     .text = "degrees for radians: theta in degrees goes into |cos| or tan as radians",
     .shade = cli_shade_degrees,
     .at = 1.0},
    {.name = "no-cos6",
     .text = "BRDF: the glint lacks 1 / cos^6",
     .shade = cli_shade_power,
     .at = 0.0},
    {.name = "cos4",
     .text = "BRDF: the glint has 1 / cos^4 in place of 1 / cos^6",
     .shade = cli_shade_power,
     .at = 4.0},
    {.name = "s-plain",
     .text = "BRDF: tan^2 / s in place of tan^2 / s^2",
     .shade = cli_shade_slope,
     .at = 0.0},
    {.name = "s-twice",
     .text = "BRDF: tan^2 / (2 s^2) in place of tan^2 / s^2",
     .shade = cli_shade_slope,
     .at = 0.5},
    {.name = "sine", .text = "BRDF: sin^2 / s^2 in place of tan^2 / s^2", .shade = cli_shade_sine},
    {.name = "small-angle",
     .text = "BRDF: theta^2 / s^2 in place of tan^2 / s^2",
     .shade = cli_shade_small_angle},
    {.name = "tan-degrees",
     .text = "degrees for radians: theta in degrees goes into tan as radians, cos is right",
     .shade = cli_shade_tan_degrees},
    {.name = "lambert",
     .text = "BRDF: the diffuse term lacks cos^m",
     .shade = cli_shade_lambert,
     .at = 0.0},
    {.name = "no-glint",
     .text = "BRDF: the glint term is missing (A = 0)",
     .shade = cli_shade_one_term,
     .at = 0.0},
    {.name = "no-diffuse",
     .text = "BRDF: the diffuse term is missing (B = 0)",
     .shade = cli_shade_one_term,
     .at = 1.0},
    {.name = "vertex-normals",
     .text = "under-resolved glint: shaded by averaged normals at the corners",
     .area = cli_area_smooth,
     .corners = 3},
    {.name = "angles-1",
     .text = "under-resolved glint: f_r from a table in steps of 1 deg, lines between",
     .shade = cli_shade_lines,
     .at = 1.0},
    {.name = "angles-5",
     .text = "under-resolved glint: f_r from a table in steps of 5 deg, lines between",
     .shade = cli_shade_lines,
     .at = 5.0},
    {.name = "angles-10",
     .text = "under-resolved glint: f_r from a table in steps of 10 deg, lines between",
     .shade = cli_shade_lines,
     .at = 10.0},
    {.name = "steps-1",
     .text = "under-resolved glint: theta rounded to whole degrees",
     .shade = cli_shade_steps,
     .at = 1.0},
    {.name = "steps-5",
     .text = "under-resolved glint: theta rounded to 5 deg",
     .shade = cli_shade_steps,
     .at = 5.0},
    {.name = "steps-10",
     .text = "under-resolved glint: theta rounded to 10 deg",
     .shade = cli_shade_steps,
     .at = 10.0},
    {.name = "8-bits",
     .text = "colour quantisation: f_r cos in 8 bits, 1 being the brightest",
     .shade = cli_shade_bits,
     .at = 1.0},
    {.name = "8-bits-4pi",
     .text = "colour quantisation: 4 pi f_r cos in 8 bits, 1 being the brightest",
     .shade = cli_shade_bits,
     .at = QUARTER_PI_INVERSE},
    {.name = "8-bits-peak",
     .text = "colour quantisation: 8 bits of the brightest f_r cos of each case",
     .shade = cli_shade_bits,
     .at = 0.0},
    {.name = "clamped", .text = "f_r cos is clamped at 1", .shade = cli_shade_clamped, .at = 1.0},
    {.name = "farthest",
     .text = "inverted depth: the farthest facet is seen, not the nearest (depth test, or the sign "
             "of z)",
     .turn = turn_axes,
     .axes = {-1, -2, -3},
     .area = cli_area_flipped},
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
    {.name = "mirror-x-winding",
     .text = "wrong handedness: x mirrored, which turns the winding as well",
     .turn = turn_axes,
     .axes = {-1, 2, 3},
     .area = cli_area_flipped},
    {.name = "mirror-y-winding",
     .text = "wrong handedness: y mirrored, which turns the winding as well",
     .turn = turn_axes,
     .axes = {1, -2, 3},
     .area = cli_area_flipped},
    {.name = "mirror-z-winding",
     .text = "wrong handedness: z mirrored, which turns the winding as well",
     .turn = turn_axes,
     .axes = {1, 2, -3},
     .area = cli_area_flipped},
    {.name = "swap-xy-winding",
     .text = "wrong handedness: x and y exchanged, which turns the winding as well",
     .turn = turn_axes,
     .axes = {2, 1, 3},
     .area = cli_area_flipped},
    {.name = "swap-yz-winding",
     .text = "wrong handedness: y and z exchanged, which turns the winding as well",
     .turn = turn_axes,
     .axes = {1, 3, 2},
     .area = cli_area_flipped},
    {.name = "swap-zx-winding",
     .text = "wrong handedness: z and x exchanged, which turns the winding as well",
     .turn = turn_axes,
     .axes = {3, 2, 1},
     .area = cli_area_flipped},
    {.name = "along-x-winding",
     .text = "wrong handedness: x and z of the observation frame exchanged, which turns the "
             "winding as well",
     .turn = turn_along,
     .axes = {1, 0, 0},
     .area = cli_area_flipped},
    {.name = "along-y-winding",
     .text = "wrong handedness: y and z of the observation frame exchanged, which turns the "
             "winding as well",
     .turn = turn_along,
     .axes = {2, 0, 0},
     .area = cli_area_flipped},
    {.name = "scalar-last",
     .text = "wrong frame: the quaternion read as (x, y, z, w)",
     .turn = turn_scalar_last},
    {.name = "azel-radians",
     .text = "degrees for radians: azimuth and elevation in degrees taken for radians",
     .turn = turn_radians},
    {.name = "azel-exchanged",
     .text = "wrong frame: azimuth and elevation exchanged",
     .turn = turn_exchanged},
    {.name = "polar-angle",
     .text = "wrong frame: elevation taken for an angle from the z axis",
     .turn = turn_polar},
    {.name = NULL}};
