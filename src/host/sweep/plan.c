/* SPDX-License-Identifier: MIT */
/* The rows of a sweep: the axes of its texts, and the values, the pose and the weight of a row from
   its number. This file decides how many rows there are, their order and their poses; vary.c
   decides how the scene changes along its axes. */
#include <lrcs/plan.h>
#include <lrcs/sweep.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "host/fail.h"
#include "host/sweep/axis.h"
#include "host/sweep/vary.h"

#define PLAN_ROWS   ((uint64_t)1 << 53) /* far more than can be computed */
#define SPHERE_MOST 4e9

/* ---- from texts ---- */

static const char *const plan_pose_ways[] = {"direction", "azel", "euler", "quaternion"};

int lrcs_host_plan_takes(const char *key)
{
    static const char *const takes[] = {"az",   "el",        "rotate", "sphere", "joint",
                                        "vary", "direction", "azel",   "euler",  "quaternion"};
    int found = 0;
    for (size_t i = 0; i < sizeof takes / sizeof takes[0]; i++) {
        found |= strcmp(takes[i], key) == 0;
    }
    return found;
}

/* The text of a key, the first one; NULL if it was not given. */
static const char *plan_text(const lrcs_host_plan_text *given, int count, const char *key)
{
    for (int i = 0; i < count; i++) {
        if (given[i].text && strcmp(given[i].key, key) == 0) {
            return given[i].text;
        }
    }
    return NULL;
}

/* az and el in the order given; an axis that is not given is 0. */
static int azel_axes(const lrcs_host_plan_text *given, int count, lrcs_host_plan *plan,
                     lrcs_host_error *error)
{
    static const char *const key[2] = {"az", "el"};
    static const char *const name[2] = {"az_deg", "el_deg"};
    int status = LRCS_OK;
    plan->kind = LRCS_HOST_PLAN_AZEL;
    for (int i = 0; i < count && status == LRCS_OK; i++) {
        for (int k = 0; k < 2 && status == LRCS_OK; k++) {
            if (given[i].text && strcmp(given[i].key, key[k]) == 0) {
                status = lrcsi_axis_add(plan, key[k], name[k], given[i].text, strlen(given[i].text),
                                        error);
            }
        }
    }
    for (int k = 0; k < 2 && status == LRCS_OK; k++) {
        if (!plan_text(given, count, key[k])) {
            status = lrcsi_axis_add(plan, key[k], name[k], "0", 1, error);
        }
    }
    return status;
}

/* SEQ:a,b,c, each of which may be a range. */
static int euler_axes(const char *text, lrcs_host_plan *plan, lrcs_host_error *error)
{
    static const char *const name[3] = {"euler_a_deg", "euler_b_deg", "euler_c_deg"};
    const double none[3] = {0.0, 0.0, 0.0};
    lrcs_pose pose;
    int status = LRCS_OK;
    plan->kind = LRCS_HOST_PLAN_EULER;
    if (strlen(text) > 3 && text[3] == ':') {
        memcpy(plan->sequence, text, 3);
    }
    if (lrcs_pose_from_euler(plan->sequence, none, &pose) != LRCS_OK) {
        return lrcsi_text_refuse(error, "euler",
                                 "SEQ:a,b,c with SEQ three of XYZ (intrinsic) or of xyz "
                                 "(extrinsic), neighbours different",
                                 text);
    }
    const char *at = text + 4;
    for (int i = 0; i < 3 && status == LRCS_OK; i++) {
        size_t size = strcspn(at, ",");
        if ((at[size] == '\0') != (i == 2)) {
            return lrcsi_text_refuse(error, "euler", "three angles or ranges", text);
        }
        status = lrcsi_axis_add(plan, "euler", name[i], at, size, error);
        at += size + 1;
    }
    return status;
}

/* The pose that is given, if any. */
static int base_read(const lrcs_host_plan_text *given, int count, lrcs_host_plan *plan,
                     lrcs_host_error *error)
{
    for (size_t i = 0; i < sizeof plan_pose_ways / sizeof plan_pose_ways[0]; i++) {
        const char *text = plan_text(given, count, plan_pose_ways[i]);
        if (text) {
            return lrcs_host_pose_read(plan_pose_ways[i], text, &plan->base, error);
        }
    }
    return LRCS_OK;
}

/* x:RANGE, y:, z: or u,v,w:RANGE, an axis of the body. */
static int rotate_axes(const lrcs_host_plan_text *given, int count, lrcs_host_plan *plan,
                       lrcs_host_error *error)
{
    const char *text = plan_text(given, count, "rotate");
    size_t size = strcspn(text, ":");
    char axis[128] = "";
    lrcs_pose pose = lrcs_pose_default();
    plan->kind = LRCS_HOST_PLAN_ROTATE;
    if (size < sizeof axis) {
        memcpy(axis, text, size);
    }
    if (size == 1 && axis[0] >= 'x' && axis[0] <= 'z') {
        plan->about[axis[0] - 'x'] = 1.0;
    } else if (lrcs_host_numbers_read(axis, plan->about, 3) != LRCS_OK ||
               lrcs_host_pose_turn(&pose, plan->about, 0.0, &pose) != LRCS_OK) {
        return lrcsi_text_refuse(error, "rotate",
                                 "x, y, z or an axis u,v,w of the body, then :A:B:STEP in degrees",
                                 text);
    }
    const char *range = text[size] ? text + size + 1 : text + size;
    int status = base_read(given, count, plan, error);
    return status != LRCS_OK
               ? status
               : lrcsi_axis_add(plan, "rotate", "rotate_deg", range, strlen(range), error);
}

static int sphere_read(const char *text, lrcs_host_plan *plan, lrcs_host_error *error)
{
    double points;
    plan->kind = LRCS_HOST_PLAN_SPHERE;
    if (lrcs_host_number_read(text, strlen(text), &points) != LRCS_OK) {
        return lrcsi_text_refuse(error, "sphere", "a finite number", text);
    }
    if (!(points >= 1.0 && points <= SPHERE_MOST) || points != floor(points)) {
        char expected[80];
        snprintf(expected, sizeof expected, "a whole number 1 .. %.0f", SPHERE_MOST);
        return lrcsi_text_refuse(error, "sphere", expected, text);
    }
    plan->poses = (uint64_t)points;
    return LRCS_OK;
}

static int poses_read(const lrcs_host_plan_text *given, int count, const lrcs_host_track *track,
                      lrcs_host_plan *plan, lrcs_host_error *error)
{
    plan->poses = 1;
    plan->base = lrcs_pose_default();
    if (plan_text(given, count, "az") || plan_text(given, count, "el")) {
        return azel_axes(given, count, plan, error);
    }
    if (plan_text(given, count, "rotate")) {
        return rotate_axes(given, count, plan, error);
    }
    if (plan_text(given, count, "sphere")) {
        return sphere_read(plan_text(given, count, "sphere"), plan, error);
    }
    if (track) {
        plan->kind = LRCS_HOST_PLAN_TRACK;
        plan->track = *track;
        plan->poses = track->count;
        return LRCS_OK;
    }
    if (plan_text(given, count, "euler")) {
        return euler_axes(plan_text(given, count, "euler"), plan, error);
    }
    plan->kind = LRCS_HOST_PLAN_FIXED;
    return base_read(given, count, plan, error);
}

static void columns_name(lrcs_host_plan *plan)
{
    static const char *const direction[3] = {"x", "y", "z"};
    for (uint32_t i = 0; i < plan->axes; i++) {
        plan->column[plan->columns++] = plan->axis[i].name;
    }
    for (uint32_t i = 0; i < plan->track.joints; i++) {
        plan->column[plan->columns++] = plan->track.joint_name[i];
    }
    if (plan->kind == LRCS_HOST_PLAN_TRACK) {
        plan->column[plan->columns++] = "time";
    }
    for (int k = 0;
         k < 3 && (plan->kind == LRCS_HOST_PLAN_SPHERE || plan->kind == LRCS_HOST_PLAN_TRACK);
         k++) {
        plan->column[plan->columns++] = direction[k];
    }
}

int lrcs_host_plan_make(const lrcs_host_plan_text *given, int count, const lrcs_host_track *track,
                        lrcs_host_plan *plan, lrcs_host_error *error)
{
    memset(plan, 0, sizeof *plan);
    int status = lrcsi_vary_read(given, count, plan, error);
    status = status == LRCS_OK ? poses_read(given, count, track, plan, error) : status;
    plan->rows = plan->poses;
    for (uint32_t i = 0; i < plan->axes && status == LRCS_OK; i++) {
        if (plan->axis[i].range.count > PLAN_ROWS / plan->rows) {
            return lrcsi_host_fail(error, LRCS_E_LIMIT, "too many poses: more than 2^53");
        }
        plan->rows *= plan->axis[i].range.count;
        plan->poses *= i >= plan->scene_axes ? plan->axis[i].range.count : 1;
    }
    if (status == LRCS_OK && plan->kind == LRCS_HOST_PLAN_FIXED && plan->axes == 0) {
        return lrcsi_host_fail(error, LRCS_E_EMPTY, "nothing varies");
    }
    columns_name(plan);
    return status;
}

void lrcs_host_plan_free(lrcs_host_plan *plan)
{
    lrcs_host_track_free(&plan->track);
}

/* ---- one row ---- */

int lrcs_host_plan_varies_scene(const lrcs_host_plan *plan)
{
    return plan->scene_axes > 0 || plan->track.joints > 0;
}

uint64_t lrcs_host_plan_place(const lrcs_host_plan *plan, uint64_t row, uint32_t axis)
{
    int listed = plan->kind == LRCS_HOST_PLAN_SPHERE || plan->kind == LRCS_HOST_PLAN_TRACK;
    uint64_t inner = listed ? plan->poses : 1;
    for (uint32_t i = plan->axes; i-- > axis + 1;) {
        inner *= plan->axis[i].range.count;
    }
    return row / inner % plan->axis[axis].range.count;
}

/* Point i of a spherical Fibonacci lattice of N: z = 1 - (2 i + 1) / N, and the azimuth is i times
   the golden section of a full turn, in whole numbers of which 2^64 are a full turn:
   i (2^64 / phi). Source: R. Swinbank, R. J. Purser, Q. J. R. Meteorol. Soc. 132 (2006) 1769. */
static void sphere_point(uint64_t i, uint64_t count, double direction[3])
{
    uint64_t azimuth = i * 0x9e3779b97f4a7c15u;
    lrcs_pose around = lrcs_pose_default();
    double n = (double)count;
    double z = (n - 1.0 - 2.0 * (double)i) / n;
    double level = sqrt((1.0 - z) * (1.0 + z));
    lrcs_pose_from_azel(360.0 * ((double)(azimuth >> 11) * 0x1p-53), 0.0, &around);
    direction[0] = level * around.direction[0];
    direction[1] = level * around.direction[1];
    direction[2] = z;
}

int lrcs_host_plan_pose(const lrcs_host_plan *plan, uint64_t row, lrcs_pose *pose)
{
    double v[LRCS_HOST_PLAN_AXES];
    uint64_t at = row % plan->poses;
    if (plan->kind == LRCS_HOST_PLAN_FIXED) {
        *pose = plan->base;
        return LRCS_OK;
    }
    if (plan->kind == LRCS_HOST_PLAN_TRACK) {
        const double *given = plan->track.row[at] + 1;
        return plan->track.quaternions ? lrcs_pose_from_quaternion(given, pose)
                                       : lrcs_pose_from_direction(given, pose);
    }
    if (plan->kind == LRCS_HOST_PLAN_SPHERE) {
        double direction[3];
        sphere_point(at, plan->poses, direction);
        return lrcs_pose_from_direction(direction, pose);
    }
    for (uint32_t i = plan->scene_axes; i < plan->axes; i++) {
        v[i - plan->scene_axes] =
            lrcs_host_range_at(&plan->axis[i].range, lrcs_host_plan_place(plan, row, i));
    }
    if (plan->kind == LRCS_HOST_PLAN_AZEL) {
        int swapped = plan->axis[plan->scene_axes].key[0] == 'e';
        return lrcs_pose_from_azel(v[swapped], v[!swapped], pose);
    }
    return plan->kind == LRCS_HOST_PLAN_EULER
               ? lrcs_pose_from_euler(plan->sequence, v, pose)
               : lrcs_host_pose_turn(&plan->base, plan->about, v[0], pose);
}

void lrcs_host_plan_values(const lrcs_host_plan *plan, uint64_t row,
                           double value[LRCS_HOST_PLAN_COLUMNS])
{
    uint32_t used = plan->axes;
    lrcs_pose pose = lrcs_pose_default();
    for (uint32_t i = 0; i < plan->axes; i++) {
        value[i] = lrcs_host_range_at(&plan->axis[i].range, lrcs_host_plan_place(plan, row, i));
    }
    for (uint32_t i = 0; i < plan->track.joints; i++) {
        value[used++] = plan->track.joint[row % plan->poses][i];
    }
    if (plan->kind == LRCS_HOST_PLAN_TRACK) {
        value[used++] = plan->track.row[row % plan->poses][0];
    }
    if (plan->kind == LRCS_HOST_PLAN_SPHERE || plan->kind == LRCS_HOST_PLAN_TRACK) {
        lrcs_host_plan_pose(plan, row, &pose);
        for (int k = 0; k < 3; k++) {
            value[used++] = pose.R[2][k];
        }
    }
}

/* ---- weights ---- */

int lrcs_host_plan_is_sphere(const lrcs_host_plan *plan)
{
    return plan->kind == LRCS_HOST_PLAN_SPHERE && plan->rows == plan->poses;
}

int lrcs_host_plan_is_map(const lrcs_host_plan *plan)
{
    int varied = plan->kind == LRCS_HOST_PLAN_AZEL;
    for (uint32_t i = plan->scene_axes; i < plan->axes && varied; i++) {
        const lrcs_host_range *range = &plan->axis[i].range;
        varied = range->count > 1 && (plan->axis[i].key[0] == 'a' ||
                                      (fabs(lrcs_host_range_at(range, 0)) <= 90.0 &&
                                       fabs(lrcs_host_range_at(range, range->count - 1)) <= 90.0));
    }
    return varied;
}

double lrcs_host_plan_weight(const lrcs_host_plan *plan, uint64_t row)
{
    double weight = 1.0;
    for (uint32_t i = plan->scene_axes; i < plan->axes; i++) {
        const lrcs_host_range *range = &plan->axis[i].range;
        uint64_t place = lrcs_host_plan_place(plan, row, i);
        uint64_t last = range->count - 1;
        double first = lrcs_host_range_at(range, 0);
        double here = lrcs_host_range_at(range, place);
        double half = 0.5 * fabs(lrcs_host_range_at(range, 1) - first);
        if (plan->axis[i].key[0] == 'a') {
            int full_turn = fabs(lrcs_host_range_at(range, last) - first) == 360.0;
            weight *= full_turn && (place == 0 || place == last) ? 0.5 : 1.0;
        } else {
            double width = sin(fmin(here + half, 90.0) / LRCS_DEGREES_PER_RADIAN) -
                           sin(fmax(here - half, -90.0) / LRCS_DEGREES_PER_RADIAN);
            weight *= fmax(width, 0.0);
        }
    }
    return weight;
}
