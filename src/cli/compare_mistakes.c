/* SPDX-License-Identifier: MIT */
/* The catalogue of mistakes, each a small function of the truth: how somebody shades a facet, which
   area of it they sum, which pose they take for the one asked for. Which of them explains what was
   handed in, compare_explain.c decides. */
#include "cli/compare.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define MISTAKE_PI         3.14159265358979323846
#define DEGREES_PER_RADIAN 57.295779513082320877
#define TWINS_MOST         256u /* facets of scenes in which twins are looked for */

/* ---- shades: f_r cos ---- */

static double shade_right(const mistake_spot *spot)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) * spot->c;
}

static double shade_no_cosine(const mistake_spot *spot)
{
    return lrcs_brdf_eval(spot->brdf, spot->c);
}

static double shade_whole_area(const mistake_spot *spot)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) / spot->c;
}

static double shade_cosine_more(const mistake_spot *spot)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) * spot->c * spot->c;
}

/* f_r at the cosine of so many radians as theta has degrees. */
static double shade_degrees(const mistake_spot *spot)
{
    double c = cos(acos(fmin(spot->c, 1.0)) * DEGREES_PER_RADIAN);
    return c > 0.0 ? lrcs_brdf_eval(spot->brdf, c) * spot->c : 0.0;
}

static double shade_degrees_folded(const mistake_spot *spot)
{
    double c = fabs(cos(acos(fmin(spot->c, 1.0)) * DEGREES_PER_RADIAN));
    return c > 0.0 ? lrcs_brdf_eval(spot->brdf, c) * spot->c : 0.0;
}

/* Both terms from their formulas, for mistakes inside them. */
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

static double shade_no_cos6(const mistake_spot *spot)
{
    return shade_terms(spot, 0.0, spot_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

static double shade_cos4(const mistake_spot *spot)
{
    return shade_terms(spot, 4.0, spot_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

static double shade_s_plain(const mistake_spot *spot)
{
    return shade_terms(spot, 6.0, spot_tan2(spot) / spot->brdf->s);
}

static double shade_s_twice(const mistake_spot *spot)
{
    return shade_terms(spot, 6.0, 0.5 * spot_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

static double shade_small_angle(const mistake_spot *spot)
{
    double theta = acos(fmin(spot->c, 1.0)) / spot->brdf->s;
    return shade_terms(spot, 6.0, theta * theta);
}

static double shade_lambert(const mistake_spot *spot)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.m = 0.0;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

static double shade_no_glint(const mistake_spot *spot)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.A = 0.0;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

static double shade_no_diffuse(const mistake_spot *spot)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.B = 0.0;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

/* f_r from a table over the angle, deg, by lines between its entries or the nearest of them. */
static double shade_angles(const mistake_spot *spot, double step, int lines)
{
    double at = acos(fmin(spot->c, 1.0)) * DEGREES_PER_RADIAN / step;
    double low = lines ? floor(at) : floor(at + 0.5);
    double from = lrcs_brdf_eval(spot->brdf, cos(low * step / DEGREES_PER_RADIAN));
    double to = lrcs_brdf_eval(spot->brdf, cos((low + 1.0) * step / DEGREES_PER_RADIAN));
    return (lines ? from + (at - low) * (to - from) : from) * spot->c;
}

static double shade_lines_1(const mistake_spot *spot)
{
    return shade_angles(spot, 1.0, 1);
}

static double shade_lines_5(const mistake_spot *spot)
{
    return shade_angles(spot, 5.0, 1);
}

static double shade_lines_10(const mistake_spot *spot)
{
    return shade_angles(spot, 10.0, 1);
}

static double shade_steps_1(const mistake_spot *spot)
{
    return shade_angles(spot, 1.0, 0);
}

static double shade_steps_5(const mistake_spot *spot)
{
    return shade_angles(spot, 5.0, 0);
}

static double shade_steps_10(const mistake_spot *spot)
{
    return shade_angles(spot, 10.0, 0);
}

/* A channel of 8 bits, of which `white` is the brightest. */
static double shade_bits(const mistake_spot *spot, double white)
{
    double value = white > 0.0 ? fmin(shade_right(spot) / white, 1.0) : 0.0;
    return white * floor(255.0 * value + 0.5) / 255.0;
}

static double shade_bits_1(const mistake_spot *spot)
{
    return shade_bits(spot, 1.0);
}

static double shade_bits_4pi(const mistake_spot *spot)
{
    return shade_bits(spot, 0.25 / MISTAKE_PI);
}

static double shade_bits_peak(const mistake_spot *spot)
{
    return shade_bits(spot, spot->peak);
}

static double shade_clamped(const mistake_spot *spot)
{
    return fmin(shade_right(spot), 1.0);
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

static double area_right(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    return spot_fill(view, facet, spot) ? view->records[facet].visible_area_m2 / 3.0 : 0.0;
}

static double area_unshadowed(const mistake_view *view, uint32_t facet, int corner,
                              mistake_spot *spot)
{
    (void)corner;
    return spot_fill(view, facet, spot) ? view->records[facet].area_m2 * spot->c / 3.0 : 0.0;
}

static double area_backs(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    spot_fill(view, facet, spot);
    return view->records[facet].visible_area_m2 / 3.0;
}

static double area_all(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    (void)corner;
    spot_fill(view, facet, spot);
    return view->records[facet].area_m2 * spot->c / 3.0;
}

static double area_one_sided(const mistake_view *view, uint32_t facet, int corner,
                             mistake_spot *spot)
{
    double area = area_right(view, facet, corner, spot);
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
    double area = area_right(view, facet, corner, spot);
    spot->brdf = &scene->material[scene->facet_material[0]].brdf;
    return area;
}

/* Shaded by the mean normal at each corner. */
static double area_smooth(const mistake_view *view, uint32_t facet, int corner, mistake_spot *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const double *n = view->scene->normal[scene->facet[facet].corner[corner]].x;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double area = area_right(view, facet, corner, spot);
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
    double area = area_right(view, facet, corner, spot);
    uint32_t count = scene->facet_count <= TWINS_MOST ? scene->facet_count : 0;
    for (uint32_t i = facet + 1; i < count && area > 0.0; i++) {
        if (facets_coincide(scene, facet, i)) {
            spot->brdf = &scene->material[scene->facet_material[i]].brdf;
        }
    }
    return area;
}

/* ---- poses ---- */

static int turn_to(double x, double y, double z, lrcs_pose *pose)
{
    const double direction[3] = {x, y, z};
    return lrcs_pose_from_direction(direction, pose);
}

static int turn_transposed(const compare_case *one, lrcs_pose *pose)
{
    return turn_to(one->pose.R[0][2], one->pose.R[1][2], one->pose.R[2][2], pose);
}

static int turn_negated(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(-s[0], -s[1], -s[2], pose);
}

static int turn_mirror_x(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(-s[0], s[1], s[2], pose);
}

static int turn_mirror_y(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[0], -s[1], s[2], pose);
}

static int turn_mirror_z(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[0], s[1], -s[2], pose);
}

static int turn_swap_xy(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[1], s[0], s[2], pose);
}

static int turn_swap_yz(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[0], s[2], s[1], pose);
}

static int turn_swap_zx(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[2], s[1], s[0], pose);
}

static int turn_y_up(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[0], s[2], -s[1], pose);
}

static int turn_z_up(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->direction;
    return turn_to(s[0], -s[2], s[1], pose);
}

/* The laser along the x or y axis of the observation frame. */
static int turn_along_x(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->pose.R[0];
    return turn_to(s[0], s[1], s[2], pose);
}

static int turn_along_y(const compare_case *one, lrcs_pose *pose)
{
    const double *s = one->pose.R[1];
    return turn_to(s[0], s[1], s[2], pose);
}

static int turn_scalar_last(const compare_case *one, lrcs_pose *pose)
{
    const double *q = one->quaternion;
    const double turned[4] = {q[3], q[0], q[1], q[2]};
    return lrcs_pose_from_quaternion(turned, pose);
}

static int turn_radians(const compare_case *one, lrcs_pose *pose)
{
    const double *a = one->azel_deg;
    return turn_to(cos(a[1]) * cos(a[0]), cos(a[1]) * sin(a[0]), sin(a[1]), pose);
}

static int turn_polar(const compare_case *one, lrcs_pose *pose)
{
    double az = one->azel_deg[0] / DEGREES_PER_RADIAN;
    double polar = one->azel_deg[1] / DEGREES_PER_RADIAN;
    return turn_to(sin(polar) * cos(az), sin(polar) * sin(az), cos(polar), pose);
}

/* ---- the catalogue ---- */

#define CULLED (1u << LRCS_EFFECT_BACK_FACE_CASTERS)

const compare_mistake cli_compare_mistakes[] = {
    {"none", "as it should be", NULL, NULL, NULL, 0},
    {"no-shadows", "missing shadows: facets count whole, though others hide them", NULL,
     area_unshadowed, NULL, 0},
    {"backs-reflect",
     "back faces: visible backs of one-sided facets reflect (|cos theta| in place of cos theta?)",
     NULL, area_backs, NULL, 0},
    {"backs-and-no-shadows",
     "back faces and missing shadows: every facet counts, whichever way it faces", NULL, area_all,
     NULL, 0},
    {"backs-culled", "back faces are culled: they do not hide what is behind them", NULL, NULL,
     NULL, CULLED},
    {"one-sided", "two-sided materials reflect from their front only", NULL, area_one_sided, NULL,
     0},
    {"clockwise", "winding: fronts are taken for backs (clockwise, or normals inward)", NULL,
     area_clockwise, NULL, 0},
    {"one-material", "every facet wears the first facet's material", NULL, area_one_material, NULL,
     0},
    {"last-wins", "of facets in one place the last one counts, not the first (depth test <= ?)",
     NULL, area_last, NULL, 0},

    {"missing-cosine", "missing cos: a sum of f_r, not of f_r cos theta, times projected area",
     shade_no_cosine, NULL, NULL, 0},
    {"missing-cosines", "missing cos twice: f_r times the facet's area, not its projected area",
     shade_whole_area, NULL, NULL, 0},
    {"extra-cosine", "one cos too many: f_r cos^2 theta times projected area", shade_cosine_more,
     NULL, NULL, 0},
    {"theta-degrees", "degrees for radians: theta in degrees goes into cos or tan as radians",
     shade_degrees, NULL, NULL, 0},
    {"theta-degrees-folded",
     "degrees for radians: theta in degrees goes into cos or tan as radians (and |cos|)",
     shade_degrees_folded, NULL, NULL, 0},
    {"no-cos6", "BRDF: the glint lacks 1 / cos^6", shade_no_cos6, NULL, NULL, 0},
    {"cos4", "BRDF: the glint has 1 / cos^4 in place of 1 / cos^6", shade_cos4, NULL, NULL, 0},
    {"s-plain", "BRDF: tan^2 / s in place of tan^2 / s^2", shade_s_plain, NULL, NULL, 0},
    {"s-twice", "BRDF: tan^2 / (2 s^2) in place of tan^2 / s^2", shade_s_twice, NULL, NULL, 0},
    {"small-angle", "BRDF: theta^2 / s^2 in place of tan^2 / s^2", shade_small_angle, NULL, NULL,
     0},
    {"lambert", "BRDF: the diffuse term lacks cos^m", shade_lambert, NULL, NULL, 0},
    {"no-glint", "BRDF: the glint term is missing (A = 0)", shade_no_glint, NULL, NULL, 0},
    {"no-diffuse", "BRDF: the diffuse term is missing (B = 0)", shade_no_diffuse, NULL, NULL, 0},

    {"vertex-normals", "under-resolved glint: shaded by averaged normals at the corners", NULL,
     area_smooth, NULL, 0},
    {"angles-1", "under-resolved glint: f_r from a table in steps of 1 deg, lines between",
     shade_lines_1, NULL, NULL, 0},
    {"angles-5", "under-resolved glint: f_r from a table in steps of 5 deg, lines between",
     shade_lines_5, NULL, NULL, 0},
    {"angles-10", "under-resolved glint: f_r from a table in steps of 10 deg, lines between",
     shade_lines_10, NULL, NULL, 0},
    {"steps-1", "under-resolved glint: theta rounded to whole degrees", shade_steps_1, NULL, NULL,
     0},
    {"steps-5", "under-resolved glint: theta rounded to 5 deg", shade_steps_5, NULL, NULL, 0},
    {"steps-10", "under-resolved glint: theta rounded to 10 deg", shade_steps_10, NULL, NULL, 0},
    {"8-bits", "colour quantisation: f_r cos in 8 bits, 1 being the brightest", shade_bits_1, NULL,
     NULL, 0},
    {"8-bits-4pi", "colour quantisation: 4 pi f_r cos in 8 bits, 1 being the brightest",
     shade_bits_4pi, NULL, NULL, 0},
    {"8-bits-peak", "colour quantisation: 8 bits of each scene's brightest f_r cos",
     shade_bits_peak, NULL, NULL, 0},
    {"clamped", "f_r cos is clamped at 1", shade_clamped, NULL, NULL, 0},

    {"transposed", "wrong frame: R in place of its transpose (or the conjugate quaternion)", NULL,
     NULL, turn_transposed, 0},
    {"negated", "wrong frame: the laser on the other side, -s_hat", NULL, NULL, turn_negated, 0},
    {"mirror-x", "wrong handedness: x mirrored", NULL, NULL, turn_mirror_x, 0},
    {"mirror-y", "wrong handedness: y mirrored", NULL, NULL, turn_mirror_y, 0},
    {"mirror-z", "wrong handedness: z mirrored", NULL, NULL, turn_mirror_z, 0},
    {"swap-xy", "wrong frame: x and y exchanged", NULL, NULL, turn_swap_xy, 0},
    {"swap-yz", "wrong frame: y and z exchanged", NULL, NULL, turn_swap_yz, 0},
    {"swap-zx", "wrong frame: z and x exchanged", NULL, NULL, turn_swap_zx, 0},
    {"y-up", "wrong frame: y up in place of z (a turn of 90 deg about x)", NULL, NULL, turn_y_up,
     0},
    {"z-up", "wrong frame: a turn of -90 deg about x", NULL, NULL, turn_z_up, 0},
    {"along-x", "wrong frame: the laser along x of the observation frame, not z", NULL, NULL,
     turn_along_x, 0},
    {"along-y", "wrong frame: the laser along y of the observation frame, not z", NULL, NULL,
     turn_along_y, 0},
    {"scalar-last", "wrong frame: the quaternion read as (x, y, z, w)", NULL, NULL,
     turn_scalar_last, 0},
    {"azel-radians", "degrees for radians: azimuth and elevation in degrees taken for radians",
     NULL, NULL, turn_radians, 0},
    {"polar-angle", "wrong frame: elevation taken for an angle from the z axis", NULL, NULL,
     turn_polar, 0},
    {NULL, NULL, NULL, NULL, NULL, 0}};

/* ---- an answer ---- */

/* The records of the case as somebody sees it: the truth's, or those of another run. 0 or
   CLI_FAILED. */
static int view_make(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                     mistake_view *view, lrcs_facet_record **own)
{
    lrcs_host_error error;
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    lrcs_pose pose = one->pose;
    int code = cli_compare_records(kit, one);
    view->scene = &kit->scene[one->scene];
    view->records = one->records;
    if (code != 0 || (!mistake->turn && !mistake->without)) {
        return code;
    }
    if (mistake->turn && mistake->turn(one, &pose) != LRCS_OK) {
        pose = one->pose;
    }
    *own = calloc((size_t)view->scene->host.scene.facet_count + 1, sizeof **own);
    if (!*own) {
        return cli_out_of_memory();
    }
    options.method = LRCS_METHOD_EXACT;
    options.without = mistake->without;
    if (lrcs_host_scene_run(&view->scene->host, &pose, &options, &result, *own, NULL, NULL,
                            &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    view->records = *own;
    return 0;
}

static double view_peak(const mistake_view *view)
{
    double peak = 0.0;
    for (uint32_t i = 0; i < view->scene->host.scene.facet_count; i++) {
        mistake_spot spot;
        if (area_right(view, i, 0, &spot) > 0.0) {
            peak = fmax(peak, shade_right(&spot));
        }
    }
    return peak;
}

int cli_compare_answer(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                       double *sigma_m2)
{
    mistake_view view;
    lrcs_facet_record *own = NULL;
    mistake_area *area = mistake->area ? mistake->area : area_right;
    mistake_shade *shade = mistake->shade ? mistake->shade : shade_right;
    double sum = 0.0;
    int code = view_make(kit, one, mistake, &view, &own);
    if (code == 0) {
        memcpy(view.direction, one->direction, sizeof view.direction);
        view.peak = view_peak(&view);
        for (uint32_t i = 0; i < 3 * view.scene->host.scene.facet_count; i++) {
            mistake_spot spot = {.peak = view.peak};
            double part = area(&view, i / 3, (int)(i % 3), &spot);
            sum += part > 0.0 ? part * shade(&spot) : 0.0;
        }
        *sigma_m2 = 4.0 * MISTAKE_PI * sum;
    }
    free(own);
    return code;
}
