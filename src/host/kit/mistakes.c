/* SPDX-License-Identifier: MIT */
/* The catalogue of mistakes (in the shading of a facet, in the area that is summed, in the pose),
   and the answer that a code with a mistake would produce for a case: the sum of Eq. 2 over the
   truth's facets, with the mistake applied. explain.c decides which of them explains the
   submitted answers. */
#include "host/kit/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constant.h"
#include "host/fail.h"

#define TWINS_MOST 256u /* scenes with more facets are not searched for coincident facets */

/* The point at which a facet is shaded. */
typedef struct mistake_point {
    const lrcs_brdf *brdf;
    double c;    /* the cosine that is used, 0 .. 1 */
    double peak; /* the largest f_r cos of the case */
} mistake_point;

/* A case with a mistake: the pose and the records that are used. */
typedef struct mistake_view {
    const lrcs_host_kit_scene *scene;
    const lrcs_facet_record *records;
    const double *direction; /* unit */
} mistake_view;

/* What is wrong in the shading (f_r cos theta); what the parameter of a mistake means is stated
   beside it. */
enum mistake_shade {
    SHADE_RIGHT,
    SHADE_COSINE,         /* f_r is multiplied by another power of the cosine: the power */
    SHADE_DEGREES,        /* theta in degrees is taken for radians; a negative cosine counts as 0 */
    SHADE_DEGREES_FOLDED, /* likewise, but with the magnitude of that cosine */
    SHADE_POWER,          /* another power in 1 / cos^6: the power */
    SHADE_EXPONENT_FACTOR,  /* the exponent tan^2 / s^2 has a factor: the factor */
    SHADE_EXPONENT_PLAIN_S, /* the exponent is tan^2 / s */
    SHADE_NO_GLINT,
    SHADE_NO_DIFFUSE,
    SHADE_DIFFUSE_M, /* another m: its value */
    SHADE_TABLE,     /* f_r is interpolated in a table of angles: its step, deg */
    SHADE_ROUNDED,   /* theta is rounded: the step, deg */
    SHADE_BITS,      /* f_r cos in 8 bits: the value that the brightest one stands for */
    SHADE_BITS_PEAK, /* likewise, the largest f_r cos of the case */
    SHADE_CLAMPED,   /* f_r cos is clamped: the largest value */
    SHADE_SINE,
    SHADE_SMALL_ANGLE,
    SHADE_TAN_DEGREES
};
/* What is wrong in the projected area that is summed, and in how it is shaded. */
enum mistake_area {
    AREA_RIGHT,
    AREA_UNSHADOWED,
    AREA_BACKS,
    AREA_ALL,
    AREA_ONE_SIDED,
    AREA_FLIPPED,
    AREA_ONE_MATERIAL,
    AREA_NEXT_MATERIAL,
    AREA_SMOOTH,
    AREA_LAST
};
/* What is wrong in the pose. */
enum mistake_pose {
    POSE_NONE,
    POSE_AXES,
    POSE_TRANSPOSED,
    POSE_ALONG,
    POSE_SCALAR_LAST,
    POSE_RADIANS,
    POSE_POLAR,
    POSE_EXCHANGED
};

/* ---- shading: f_r cos theta ---- */

/* Both terms from their formulas, for mistakes in the glint term: 1 / cos^power and the exponent.
 */
static double shade_terms(const mistake_point *point, double power, double exponent)
{
    const lrcs_brdf *b = point->brdf;
    double glint = b->A > 0.0 ? b->A * pow(point->c, -power) * exp(-exponent) : 0.0;
    return (glint + b->B * pow(point->c, b->m)) * point->c;
}

/* The correct value for another BRDF, or for another angle of the BRDF. */
static double shade_as(lrcs_brdf brdf, double cosine, double c)
{
    return lrcs_brdf_eval(&brdf, cosine) * c;
}

/* f_r cos in 8 bits, of which the largest stands for `white`. */
static double shade_quantised(double right, double white)
{
    double fraction = white > 0.0 ? fmin(right / white, 1.0) : 0.0;
    return white * floor(255.0 * fraction + 0.5) / 255.0;
}

/* f_r cos. */
static double mistake_shade(const lrcsi_mistake *mistake, const mistake_point *point)
{
    double parameter = mistake->parameter;
    double c = point->c;
    double s = point->brdf->s;
    double theta = acos(c);
    double degrees = theta * LRCS_DEGREES_PER_RADIAN;
    double tan2 = 1.0 / (c * c) - 1.0;
    double right = lrcs_brdf_eval(point->brdf, c) * c;
    double wrong, from, to;
    lrcs_brdf brdf = *point->brdf;
    switch (mistake->shade) {
    case SHADE_COSINE:
        return lrcs_brdf_eval(point->brdf, c) * pow(c, parameter);
    case SHADE_DEGREES:
    case SHADE_DEGREES_FOLDED:
        wrong = cos(degrees);
        wrong = mistake->shade == SHADE_DEGREES_FOLDED ? fabs(wrong) : wrong;
        return wrong > 0.0 ? shade_as(brdf, wrong, c) : 0.0;
    case SHADE_TAN_DEGREES:
        wrong = tan(degrees) / s;
        return shade_terms(point, 6.0, wrong * wrong);
    case SHADE_POWER:
        return shade_terms(point, parameter, tan2 / (s * s));
    case SHADE_EXPONENT_FACTOR:
        return shade_terms(point, 6.0, tan2 * (parameter / (s * s)));
    case SHADE_EXPONENT_PLAIN_S:
        return shade_terms(point, 6.0, tan2 * (1.0 / s));
    case SHADE_SINE:
        return shade_terms(point, 6.0, (1.0 - c * c) / (s * s));
    case SHADE_SMALL_ANGLE:
        return shade_terms(point, 6.0, (theta / s) * (theta / s));
    case SHADE_DIFFUSE_M:
        brdf.m = parameter;
        return shade_as(brdf, c, c);
    case SHADE_NO_GLINT:
        brdf.A = 0.0;
        return shade_as(brdf, c, c);
    case SHADE_NO_DIFFUSE:
        brdf.B = 0.0;
        return shade_as(brdf, c, c);
    case SHADE_TABLE:
        wrong = parameter * floor(degrees / parameter); /* the entry at or below theta */
        from = lrcs_brdf_eval(&brdf, cos(wrong / LRCS_DEGREES_PER_RADIAN));
        to = lrcs_brdf_eval(&brdf, cos((wrong + parameter) / LRCS_DEGREES_PER_RADIAN));
        return (from + (degrees - wrong) / parameter * (to - from)) * c;
    case SHADE_ROUNDED:
        wrong = parameter * floor(degrees / parameter + 0.5);
        return shade_as(brdf, cos(wrong / LRCS_DEGREES_PER_RADIAN), c);
    case SHADE_BITS:
        return shade_quantised(right, parameter);
    case SHADE_BITS_PEAK:
        return shade_quantised(right, point->peak);
    case SHADE_CLAMPED:
        return fmin(right, parameter);
    default:
        return right;
    }
}

/* ---- the area of a facet that is summed, its cosine, its material ---- */

/* The cosine of the mean normal at a corner, negative if it faces away from the laser. */
static double corner_cosine(const mistake_view *view, uint32_t facet, int corner)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const double *n = view->scene->normal[scene->facet[facet].corner[corner]].x;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double c = 0.0;
    for (int k = 0; k < 3; k++) {
        c += length > 0.0 ? n[k] / length * view->direction[k] : 0.0;
    }
    return view->records[facet].cos_theta < 0.0 ? -c : c;
}

/* The last of the facets that coincide with a facet. */
static uint32_t facet_last(const lrcs_scene *scene, uint32_t facet)
{
    uint32_t last = facet;
    uint32_t count = scene->facet_count <= TWINS_MOST ? scene->facet_count : 0;
    for (uint32_t i = facet + 1; i < count; i++) {
        int same = 1;
        for (int k = 0; k < 3; k++) {
            same &= memcmp(&scene->vertex[scene->facet[facet].corner[k]],
                           &scene->vertex[scene->facet[i].corner[k]], sizeof *scene->vertex) == 0;
        }
        last = same ? i : last;
    }
    return last;
}

/* The projected area of a facet, for the value at a corner (0 .. 2) if that counts. Also sets how
   it is shaded; 0 if the facet does not contribute. */
static double mistake_area(const lrcsi_mistake *mistake, const mistake_view *view, uint32_t facet,
                           int corner, mistake_point *point)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_facet_record *record = &view->records[facet];
    const lrcs_material *material = &scene->material[scene->facet_material[facet]];
    int front = record->cos_theta > 0.0;
    double seen = record->visible_area_m2;
    uint32_t other = facet;
    point->c = fmin(fabs(record->cos_theta), 1.0);
    point->brdf = &material->brdf;
    switch (mistake->area) {
    case AREA_UNSHADOWED:
        return front || material->two_sided ? record->area_m2 * point->c : 0.0;
    case AREA_BACKS:
        return seen;
    case AREA_ALL:
        return record->area_m2 * point->c;
    case AREA_ONE_SIDED:
        return front ? seen : 0.0;
    case AREA_FLIPPED: /* front and back sides exchanged */
        return material->two_sided || record->cos_theta < 0.0 ? seen : 0.0;
    case AREA_NEXT_MATERIAL: /* the material changes one facet too late */
        material = &scene->material[scene->facet_material[facet ? facet - 1 : 0]];
        point->brdf = &material->brdf;
        break;
    case AREA_ONE_MATERIAL:
        other = 0;
        break;
    case AREA_LAST: /* of coincident facets the last one is counted instead of the first */
        other = seen > 0.0 ? facet_last(scene, facet) : facet;
        break;
    case AREA_SMOOTH: /* shading by the mean normal at each corner */
        point->c = fmin(corner_cosine(view, facet, corner), 1.0);
        seen = point->c > 0.0 ? seen : 0.0;
        break;
    default:
        break;
    }
    if (other != facet) {
        point->brdf = &scene->material[scene->facet_material[other]].brdf;
    }
    return front || material->two_sided ? seen : 0.0;
}

/* ---- poses ---- */

/* The laser at an azimuth and an elevation in radians. */
static int pose_at(double az, double el, lrcs_pose *pose)
{
    const double s[3] = {cos(el) * cos(az), cos(el) * sin(az), sin(el)};
    return lrcs_pose_from_direction(s, pose);
}

/* The pose that is used. Status: as lrcs_pose_from_quaternion. */
static int mistake_pose_make(const lrcsi_mistake *mistake, const lrcs_host_kit_case *one,
                             lrcs_pose *pose)
{
    const double *q = one->quaternion;
    const double scalar_last[4] = {q[3], q[0], q[1], q[2]};
    double az = one->azel_deg[0];
    double el = one->azel_deg[1];
    double s[3] = {one->pose.R[0][2], one->pose.R[1][2], one->pose.R[2][2]}; /* transposed */
    switch (mistake->pose) {
    case POSE_SCALAR_LAST:
        return lrcs_pose_from_quaternion(scalar_last, pose);
    case POSE_AXES: /* components of s_hat exchanged and mirrored */
        for (int k = 0; k < 3; k++) {
            int axis = mistake->axes[k];
            s[k] = (axis < 0 ? -1.0 : 1.0) * one->direction[abs(axis) - 1];
        }
        break;
    case POSE_ALONG: /* the laser on another axis of the observation frame */
        memcpy(s, one->pose.R[mistake->axes[0] - 1], sizeof s);
        break;
    case POSE_RADIANS:
        return pose_at(az, el, pose);
    case POSE_POLAR:
        return pose_at(az / LRCS_DEGREES_PER_RADIAN, 0.5 * LRCS_PI - el / LRCS_DEGREES_PER_RADIAN,
                       pose);
    case POSE_EXCHANGED:
        return pose_at(el / LRCS_DEGREES_PER_RADIAN, az / LRCS_DEGREES_PER_RADIAN, pose);
    default:
        break;
    }
    return lrcs_pose_from_direction(s, pose);
}

/* ---- the catalogue ---- */

#define CULLED (1u << LRCS_EFFECT_BACK_FACE_CASTERS)

const lrcsi_mistake lrcsi_mistakes[] = {
    {.name = "none", .text = "as it should be"},
    {"no-shadows", "missing shadows: facets count whole, though others hide them",
     .area = AREA_UNSHADOWED},
    {"backs-reflect",
     "back faces: visible backs of one-sided facets reflect (|cos theta| in place of cos theta?)",
     .area = AREA_BACKS},
    {"backs-and-no-shadows",
     "back faces and missing shadows: every facet counts, whichever way it faces",
     .area = AREA_ALL},
    {"backs-culled", "back faces are culled: they do not hide what is behind them",
     .without = CULLED},
    {"one-sided", "two-sided materials reflect from their front only", .area = AREA_ONE_SIDED},
    {"clockwise", "winding: fronts are taken for backs (clockwise, or normals inward)",
     .area = AREA_FLIPPED},
    {"one-material", "every facet has the first facet's material", .area = AREA_ONE_MATERIAL},
    {"next-material", "materials begin one facet late: a facet has that of the one before",
     .area = AREA_NEXT_MATERIAL},
    {"last-wins", "of facets in one place the last one counts, not the first (depth test <= ?)",
     .area = AREA_LAST},
    {"missing-cosine", "missing cos: a sum of f_r, not of f_r cos theta, times projected area",
     .shade = SHADE_COSINE, .parameter = 0.0},
    {"missing-cosines", "missing cos twice: f_r times the facet's area, not its projected area",
     .shade = SHADE_COSINE, .parameter = -1.0},
    {"extra-cosine", "one cos too many: f_r cos^2 theta times projected area",
     .shade = SHADE_COSINE, .parameter = 2.0},
    {"theta-degrees", "degrees for radians: theta in degrees goes into cos or tan as radians",
     .shade = SHADE_DEGREES},
    {"theta-degrees-folded",
     "degrees for radians: theta in degrees goes into |cos| or tan as radians",
     .shade = SHADE_DEGREES_FOLDED},
    {"no-cos6", "BRDF: the glint lacks 1 / cos^6", .shade = SHADE_POWER, .parameter = 0.0},
    {"cos4", "BRDF: the glint has 1 / cos^4 in place of 1 / cos^6", .shade = SHADE_POWER,
     .parameter = 4.0},
    {"s-plain", "BRDF: tan^2 / s in place of tan^2 / s^2", .shade = SHADE_EXPONENT_PLAIN_S},
    {"s-twice", "BRDF: tan^2 / (2 s^2) in place of tan^2 / s^2", .shade = SHADE_EXPONENT_FACTOR,
     .parameter = 0.5},
    {"sine", "BRDF: sin^2 / s^2 in place of tan^2 / s^2", .shade = SHADE_SINE},
    {"small-angle", "BRDF: theta^2 / s^2 in place of tan^2 / s^2", .shade = SHADE_SMALL_ANGLE},
    {"tan-degrees", "degrees for radians: theta in degrees goes into tan as radians, cos is right",
     .shade = SHADE_TAN_DEGREES},
    {"lambert", "BRDF: the diffuse term lacks cos^m", .shade = SHADE_DIFFUSE_M, .parameter = 0.0},
    {"no-glint", "BRDF: the glint term is missing (A = 0)", .shade = SHADE_NO_GLINT},
    {"no-diffuse", "BRDF: the diffuse term is missing (B = 0)", .shade = SHADE_NO_DIFFUSE},
    {"vertex-normals", "under-resolved glint: shaded by averaged normals at the corners",
     .area = AREA_SMOOTH, .corners = 3},
    {"angles-1", "under-resolved glint: f_r from a table in steps of 1 deg, lines between",
     .shade = SHADE_TABLE, .parameter = 1.0},
    {"angles-5", "under-resolved glint: f_r from a table in steps of 5 deg, lines between",
     .shade = SHADE_TABLE, .parameter = 5.0},
    {"angles-10", "under-resolved glint: f_r from a table in steps of 10 deg, lines between",
     .shade = SHADE_TABLE, .parameter = 10.0},
    {"steps-1", "under-resolved glint: theta rounded to whole degrees", .shade = SHADE_ROUNDED,
     .parameter = 1.0},
    {"steps-5", "under-resolved glint: theta rounded to 5 deg", .shade = SHADE_ROUNDED,
     .parameter = 5.0},
    {"steps-10", "under-resolved glint: theta rounded to 10 deg", .shade = SHADE_ROUNDED,
     .parameter = 10.0},
    {"8-bits", "colour quantisation: f_r cos in 8 bits, 1 being the brightest", .shade = SHADE_BITS,
     .parameter = 1.0},
    {"8-bits-4pi", "colour quantisation: 4 pi f_r cos in 8 bits, 1 being the brightest",
     .shade = SHADE_BITS, .parameter = 1.0 / LRCS_FOUR_PI},
    {"8-bits-peak", "colour quantisation: 8 bits of the brightest f_r cos of each case",
     .shade = SHADE_BITS_PEAK},
    {"clamped", "f_r cos is clamped at 1", .shade = SHADE_CLAMPED, .parameter = 1.0},
    {"farthest",
     "inverted depth: the farthest facet is seen, not the nearest (depth test, or the sign of z)",
     .pose = POSE_AXES, .axes = {-1, -2, -3}, .area = AREA_FLIPPED},
    {"transposed", "wrong frame: R in place of its transpose (or the conjugate quaternion)",
     .pose = POSE_TRANSPOSED},
    {"negated", "wrong frame: the laser on the other side, -s_hat", .pose = POSE_AXES,
     .axes = {-1, -2, -3}},
    {"mirror-x", "wrong handedness: x mirrored", .pose = POSE_AXES, .axes = {-1, 2, 3}},
    {"mirror-y", "wrong handedness: y mirrored", .pose = POSE_AXES, .axes = {1, -2, 3}},
    {"mirror-z", "wrong handedness: z mirrored", .pose = POSE_AXES, .axes = {1, 2, -3}},
    {"swap-xy", "wrong handedness: x and y exchanged", .pose = POSE_AXES, .axes = {2, 1, 3}},
    {"swap-yz", "wrong handedness: y and z exchanged", .pose = POSE_AXES, .axes = {1, 3, 2}},
    {"swap-zx", "wrong handedness: z and x exchanged", .pose = POSE_AXES, .axes = {3, 2, 1}},
    {"y-up", "wrong frame: turned by 90 deg about x (y up, or z?)", .pose = POSE_AXES,
     .axes = {1, 3, -2}},
    {"z-up", "wrong frame: turned by -90 deg about x (y up, or z?)", .pose = POSE_AXES,
     .axes = {1, -3, 2}},
    {"yzx", "wrong frame: x, y, z taken for y, z, x", .pose = POSE_AXES, .axes = {2, 3, 1}},
    {"zxy", "wrong frame: x, y, z taken for z, x, y", .pose = POSE_AXES, .axes = {3, 1, 2}},
    {"along-x", "wrong frame: the laser along x of the observation frame, not z",
     .pose = POSE_ALONG, .axes = {1, 0, 0}},
    {"along-y", "wrong frame: the laser along y of the observation frame, not z",
     .pose = POSE_ALONG, .axes = {2, 0, 0}},
    {"mirror-x-winding", "wrong handedness: x mirrored, which turns the winding as well",
     .pose = POSE_AXES, .axes = {-1, 2, 3}, .area = AREA_FLIPPED},
    {"mirror-y-winding", "wrong handedness: y mirrored, which turns the winding as well",
     .pose = POSE_AXES, .axes = {1, -2, 3}, .area = AREA_FLIPPED},
    {"mirror-z-winding", "wrong handedness: z mirrored, which turns the winding as well",
     .pose = POSE_AXES, .axes = {1, 2, -3}, .area = AREA_FLIPPED},
    {"swap-xy-winding", "wrong handedness: x and y exchanged, which turns the winding as well",
     .pose = POSE_AXES, .axes = {2, 1, 3}, .area = AREA_FLIPPED},
    {"swap-yz-winding", "wrong handedness: y and z exchanged, which turns the winding as well",
     .pose = POSE_AXES, .axes = {1, 3, 2}, .area = AREA_FLIPPED},
    {"swap-zx-winding", "wrong handedness: z and x exchanged, which turns the winding as well",
     .pose = POSE_AXES, .axes = {3, 2, 1}, .area = AREA_FLIPPED},
    {"along-x-winding",
     "wrong handedness: x and z of the observation frame exchanged, which turns the winding as "
     "well",
     .pose = POSE_ALONG, .axes = {1, 0, 0}, .area = AREA_FLIPPED},
    {"along-y-winding",
     "wrong handedness: y and z of the observation frame exchanged, which turns the winding as "
     "well",
     .pose = POSE_ALONG, .axes = {2, 0, 0}, .area = AREA_FLIPPED},
    {"scalar-last", "wrong frame: the quaternion read as (x, y, z, w)", .pose = POSE_SCALAR_LAST},
    {"azel-radians", "degrees for radians: azimuth and elevation in degrees taken for radians",
     .pose = POSE_RADIANS},
    {"azel-exchanged", "wrong frame: azimuth and elevation exchanged", .pose = POSE_EXCHANGED},
    {"polar-angle", "wrong frame: elevation taken for an angle from the z axis",
     .pose = POSE_POLAR},
    {.name = NULL}};

/* ---- a scene in which the wrong one of coplanar facets is seen ---- */

/* Relative to the scene's size: more than rounding, less than any distance in it. */
#define MOVED 0x1p-30

/* The records of a case if of coplanar facets the wrong one is seen: backs before fronts, then the
   last before the first. Depths of one plane that differ by rounding make this mistake in some
   pixels. Every facet is moved towards the laser by a share of the distance: backs by all of it,
   fronts by up to half, later ones by more; corners are no longer shared. The true records must
   be there already. */
static int run_wrong_coplanar(const lrcs_host_kit *kit, const lrcs_host_kit_case *one,
                              lrcs_facet_record *records, lrcs_host_error *error)
{
    const lrcs_scene *from = &kit->scene[one->scene].host.scene;
    lrcs_point *vertex = malloc(((size_t)3 * from->facet_count + 1) * sizeof *vertex);
    lrcs_facet *facet = malloc(((size_t)from->facet_count + 1) * sizeof *facet);
    if (!vertex || !facet) {
        free(vertex);
        free(facet);
        return lrcsi_host_out_of_memory(error);
    }
    lrcs_host_scene moved = {.scene = *from};
    moved.scene.vertex = vertex;
    moved.scene.facet = facet;
    moved.scene.vertex_count = 3 * from->facet_count;
    double size = 0.0;
    for (uint32_t i = 0; i < from->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            size = fmax(size, fabs(from->vertex[i].x[k]));
        }
    }
    for (uint32_t i = 0; i < from->facet_count; i++) {
        int back = one->records[i].cos_theta < 0.0;
        double by = MOVED * size * (back ? 1.0 : 0.5 * i / from->facet_count);
        for (uint32_t k = 0; k < 3; k++) {
            lrcs_point *corner = &vertex[3 * i + k];
            *corner = from->vertex[from->facet[i].corner[k]];
            for (int axis = 0; axis < 3; axis++) {
                corner->x[axis] += by * one->direction[axis];
            }
            facet[i].corner[k] = 3 * i + k;
        }
    }
    int status = lrcs_host_scene_prepare(&moved, error);
    status = status == LRCS_OK ? lrcsi_kit_run(&moved, &one->pose, 0, records, error) : status;
    lrcs_host_scene_free(&moved);
    free(vertex);
    free(facet);
    return status;
}

/* ---- the answer ---- */

/* The records of a case with a mistake: the truth's, or those of another run. */
static int mistake_view_make(const lrcs_host_kit *kit, lrcs_host_kit_case *one,
                             const lrcsi_mistake *mistake, mistake_view *view,
                             lrcs_facet_record **own, lrcs_host_error *error)
{
    lrcs_pose pose = one->pose;
    double peak = 0.0; /* the largest f_r cos of the case */
    int status = lrcsi_kit_records(kit, one, error);
    view->scene = &kit->scene[one->scene];
    view->direction = one->direction;
    view->records = one->records;
    uint32_t facets = view->scene->host.scene.facet_count;
    for (uint32_t i = 0; status == LRCS_OK && one->peak == 0.0 && i < facets; i++) {
        mistake_point point = {.peak = 0.0};
        if (mistake_area(lrcsi_mistakes, view, i, 0, &point) > 0.0) {
            peak = fmax(peak, mistake_shade(lrcsi_mistakes, &point));
        }
    }
    one->peak = fmax(one->peak, peak);
    if (status != LRCS_OK || (!mistake->pose && !mistake->without && !mistake->wrong_coplanar)) {
        return status;
    }
    *own = calloc((size_t)facets + 1, sizeof **own);
    if (!*own) {
        return lrcsi_host_out_of_memory(error);
    }
    view->records = *own;
    if (mistake->wrong_coplanar) {
        return run_wrong_coplanar(kit, one, *own, error);
    }
    if (mistake->pose && mistake_pose_make(mistake, one, &pose) != LRCS_OK) {
        pose = one->pose;
    }
    return lrcsi_kit_run(&view->scene->host, &pose, mistake->without, *own, error);
}

int lrcsi_mistake_answer(const lrcs_host_kit *kit, lrcs_host_kit_case *one,
                         const lrcsi_mistake *mistake, double *sigma_m2, lrcs_host_error *error)
{
    mistake_view view;
    lrcs_facet_record *own = NULL;
    int status = mistake_view_make(kit, one, mistake, &view, &own, error);
    int corners = mistake->corners > 0 ? mistake->corners : 1;
    double sum = 0.0; /* sigma / 4 pi */
    for (uint32_t i = 0; status == LRCS_OK && i < view.scene->host.scene.facet_count; i++) {
        for (int corner = 0; corner < corners; corner++) {
            mistake_point point = {.peak = one->peak};
            double area = mistake_area(mistake, &view, i, corner, &point);
            sum += area > 0.0 ? area * mistake_shade(mistake, &point) / corners : 0.0;
        }
    }
    *sigma_m2 = status == LRCS_OK ? LRCS_FOUR_PI * sum : *sigma_m2;
    free(own);
    return status;
}
