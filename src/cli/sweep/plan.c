/* SPDX-License-Identifier: MIT */
/* The rows of a sweep: the axes of the command line, and the values and the pose of a row from its
   number. Ranges A:B:STEP are exact: decimal numbers as integer multiples of one power of ten. This
   file decides how many rows there are, their order and their values; scene.c decides how a scene
   changes along its axes. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PLAN_ROWS ((uint64_t)1 << 53) /* far more than can be computed */

/* ---- ranges ---- */

/* Integers and powers of ten that doubles represent exactly: one division then rounds only once. */
#define RANGE_MOST     ((int64_t)1 << 53)
#define RANGE_DECIMALS 22

static const char range_form[] = "expected A:B:STEP or one number";
static const char range_long[] = "a number has too many digits: at most 15 are exact";

typedef struct range_number {
    int64_t digits; /* digits * 10^exponent */
    int exponent;
} range_number;

/* The digits of a number that lrcs_host_number_read has accepted. */
static const char *digits_read(const char *at, const char *end, range_number *number)
{
    int point = 0;
    for (; at < end && *at != 'e' && *at != 'E'; at++) {
        if (*at == '.') {
            point = 1;
        } else if (number->digits > RANGE_MOST / 10 - 1) {
            return NULL;
        } else if (*at >= '0' && *at <= '9') {
            number->digits = 10 * number->digits + (*at - '0');
            number->exponent -= point;
        }
    }
    return at;
}

static const char *range_number_read(const char *text, size_t size, range_number *number)
{
    double value;
    const char *end = text + size;
    *number = (range_number){0, 0};
    if (lrcs_host_number_read(text, size, &value) != LRCS_OK) {
        return range_form;
    }
    const char *at = digits_read(text + strspn(text, " +-"), end, number);
    if (!at) {
        return range_long;
    }
    if (at < end) {
        number->exponent += (int)strtol(at + 1, NULL, 10);
    }
    if (memchr(text, '-', (size_t)(at - text))) {
        number->digits = -number->digits;
    }
    while (number->digits % 10 == 0 && number->digits != 0) {
        number->digits /= 10;
        number->exponent++;
    }
    number->exponent = number->digits == 0 ? 0 : number->exponent;
    return NULL;
}

/* digits * 10^(exponent + decimals); on overflow 0, and *good becomes 0. */
static int64_t range_scaled(const range_number *number, int decimals, int *good)
{
    int64_t digits = number->digits;
    for (int i = number->exponent + decimals; i > 0 && *good; i--) {
        *good = llabs(digits) <= RANGE_MOST / 10;
        digits *= *good ? 10 : 1;
    }
    return digits;
}

/* Makes a range from first, last and step; returns what is wrong, or NULL. */
static const char *range_make(const range_number number[3], sweep_range *range)
{
    int decimals = 0;
    int good = 1;
    for (int i = 0; i < 3; i++) {
        decimals = -number[i].exponent > decimals ? -number[i].exponent : decimals;
    }
    if (decimals > RANGE_DECIMALS) {
        return range_long;
    }
    int64_t first = range_scaled(&number[0], decimals, &good);
    int64_t span = range_scaled(&number[1], decimals, &good) - first;
    int64_t step = range_scaled(&number[2], decimals, &good);
    if (!good) {
        return range_long;
    }
    if (span != 0 && (step == 0 || (step > 0) != (span > 0))) {
        return "STEP does not lead from A to B";
    }
    *range = (sweep_range){first, step, span != 0 ? (uint64_t)(span / step) + 1 : 1, decimals};
    return NULL;
}

const char *cli_range_read(const char *text, size_t size, sweep_range *range)
{
    range_number number[3] = {{0, 0}, {0, 0}, {1, 0}};
    const char *end = text + size;
    for (int i = 0; i < 3; i++) {
        const char *colon = memchr(text, ':', (size_t)(end - text));
        const char *stop = colon ? colon : end;
        const char *fault = range_number_read(text, (size_t)(stop - text), &number[i]);
        if (fault) {
            return fault;
        }
        if (!colon && i == 0) {
            number[1] = number[0];
            return range_make(number, range);
        }
        if (!colon) {
            return i == 2 ? range_make(number, range) : range_form;
        }
        text = colon + 1;
    }
    return range_form;
}

double cli_range_at(const sweep_range *range, uint64_t i)
{
    double power = 1.0;
    for (int k = 0; k < range->decimals; k++) {
        power *= 10.0; /* exact up to 10^22 */
    }
    return (double)(range->first + (int64_t)i * range->step) / power;
}

/* ---- axes ---- */

int cli_axis_add(const cli_args *args, sweep_plan *plan, const char *option, const char *name,
                 const char *text, size_t size)
{
    if (plan->axes == SWEEP_AXES) {
        return cli_usage(args->command, "at most %d axes", SWEEP_AXES);
    }
    sweep_axis *axis = &plan->axis[plan->axes];
    const char *fault = cli_range_read(text, size, &axis->range);
    if (fault) {
        return cli_usage(args->command, "--%s: %s, found '%.*s'", option, fault, (int)size, text);
    }
    axis->option = option;
    snprintf(axis->name, sizeof axis->name, "%s", name);
    plan->axes++;
    return 0;
}

/* --az and --el in the order given; an axis that is not given is 0. */
static int azel_axes(const cli_args *args, sweep_plan *plan)
{
    int code = 0;
    plan->kind = SWEEP_AZEL;
    for (int i = 0; i < args->given_count && code == 0; i++) {
        const cli_given *one = &args->given[i];
        if (strcmp(one->name, "az") == 0 || strcmp(one->name, "el") == 0) {
            code = cli_axis_add(args, plan, one->name, one->name[0] == 'a' ? "az_deg" : "el_deg",
                                one->value, strlen(one->value));
        }
    }
    if (code == 0 && !cli_value(args, "az")) {
        code = cli_axis_add(args, plan, "az", "az_deg", "0", 1);
    }
    if (code == 0 && !cli_value(args, "el")) {
        code = cli_axis_add(args, plan, "el", "el_deg", "0", 1);
    }
    return code;
}

/* SEQ:a,b,c, each of which may be a range. */
static int euler_axes(const cli_args *args, sweep_plan *plan)
{
    static const char *const name[3] = {"euler_a_deg", "euler_b_deg", "euler_c_deg"};
    const char *text = cli_value(args, "euler");
    const double none[3] = {0.0, 0.0, 0.0};
    lrcs_pose pose;
    int code = 0;
    plan->kind = SWEEP_EULER;
    if (strlen(text) > 3 && text[3] == ':') {
        memcpy(plan->sequence, text, 3);
    }
    if (lrcs_pose_from_euler(plan->sequence, none, &pose) != LRCS_OK) {
        return cli_expected(args, "euler",
                            "SEQ:a,b,c with SEQ three of XYZ (intrinsic) or of xyz (extrinsic), "
                            "neighbours different");
    }
    const char *at = text + 4;
    for (int i = 0; i < 3 && code == 0; i++) {
        size_t size = strcspn(at, ",");
        if ((at[size] == '\0') != (i == 2)) {
            return cli_expected(args, "euler", "three angles or ranges");
        }
        code = cli_axis_add(args, plan, "euler", name[i], at, size);
        at += size + 1;
    }
    return code;
}

/* x:RANGE, y:, z: or u,v,w:RANGE, an axis of the body. */
static int rotate_axes(const cli_args *args, sweep_plan *plan)
{
    const char *text = cli_value(args, "rotate");
    size_t size = strcspn(text, ":");
    char axis[128] = "";
    lrcs_pose pose = lrcs_pose_default();
    plan->kind = SWEEP_ROTATE;
    if (size < sizeof axis) {
        memcpy(axis, text, size);
    }
    if (size == 1 && axis[0] >= 'x' && axis[0] <= 'z') {
        plan->about[axis[0] - 'x'] = 1.0;
    } else if (cli_list(axis, plan->about, 3) != 0 ||
               lrcs_host_pose_turn(&pose, plan->about, 0.0, &pose) != LRCS_OK) {
        return cli_expected(args, "rotate",
                            "x, y, z or an axis u,v,w of the body, then :A:B:STEP in degrees");
    }
    const char *range = text[size] ? text + size + 1 : text + size;
    int code = cli_pose_read(args, &plan->base);
    return code ? code : cli_axis_add(args, plan, "rotate", "rotate_deg", range, strlen(range));
}

/* ---- which kind ---- */

/* Only one way to specify the direction may be given; a rotation starts from a pose. */
static int ways_check(const cli_args *args)
{
    static const struct {
        const char *name;
        int way;
    } given[] = {{"az", 1},        {"el", 1},   {"rotate", 2}, {"sphere", 3},    {"poses", 4},
                 {"direction", 5}, {"azel", 6}, {"euler", 7},  {"quaternion", 8}};
    const char *first = NULL;
    int way = 0;
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++) {
        int turned = way == 2 && given[i].way >= 5; /* cli_pose_read checks this one */
        if (!cli_value(args, given[i].name) || given[i].way == way || turned) {
            continue;
        }
        if (first) {
            return cli_usage(args->command, "--%s and --%s both give the poses: give one", first,
                             given[i].name);
        }
        first = given[i].name;
        way = given[i].way;
    }
    return 0;
}

static int poses_read(const cli_args *args, const sweep_track *track, sweep_plan *plan)
{
    int code;
    plan->poses = 1;
    plan->base = lrcs_pose_default();
    if (track) {
        plan->kind = SWEEP_TRACK;
        plan->track = *track;
        plan->poses = track->count;
        return 0;
    }
    if (cli_value(args, "az") || cli_value(args, "el")) {
        return azel_axes(args, plan);
    }
    if (cli_value(args, "rotate")) {
        return rotate_axes(args, plan);
    }
    if (cli_value(args, "sphere")) {
        uint32_t points = 0;
        code = cli_whole(args, "sphere", 1.0, 4e9, &points);
        plan->kind = SWEEP_SPHERE;
        plan->poses = points;
        return code;
    }
    if (cli_value(args, "poses")) {
        code = cli_track_read(cli_value(args, "poses"), &plan->track);
        plan->kind = SWEEP_TRACK;
        plan->poses = plan->track.count;
        return code;
    }
    if (cli_value(args, "euler")) {
        return euler_axes(args, plan);
    }
    plan->kind = SWEEP_FIXED;
    return cli_pose_read(args, &plan->base);
}

/* K/N: part K of N nearly equal parts of the rows. */
static int shard_read(const cli_args *args, sweep_plan *plan)
{
    const char *text = cli_value(args, "shard");
    double part[2];
    size_t size = text ? strcspn(text, "/") : 0;
    if (!text) {
        return 0;
    }
    if (!text[size] || lrcs_host_number_read(text, size, &part[0]) != LRCS_OK ||
        lrcs_host_number_read(text + size + 1, strlen(text + size + 1), &part[1]) != LRCS_OK ||
        !(part[0] >= 1.0 && part[0] <= part[1] && part[1] <= 1e6) ||
        part[0] != (double)(uint32_t)part[0] || part[1] != (double)(uint32_t)part[1]) {
        return cli_expected(args, "shard", "K/N, 1 <= K <= N <= 1000000");
    }
    uint64_t shards = (uint64_t)part[1];
    uint64_t k = (uint64_t)part[0];
    uint64_t whole = plan->rows / shards;
    uint64_t rest = plan->rows % shards;
    plan->first = whole * (k - 1) + rest * (k - 1) / shards;
    plan->end = whole * k + rest * k / shards;
    return 0;
}

int cli_plan_read(const cli_args *args, const sweep_track *track, sweep_plan *plan)
{
    static const char *const direction[3] = {"x", "y", "z"};
    memset(plan, 0, sizeof *plan);
    int code = ways_check(args);
    code = code ? code : cli_scene_axes_read(args, plan);
    code = code ? code : poses_read(args, track, plan);
    plan->rows = plan->poses;
    for (uint32_t i = 0; i < plan->axes && code == 0; i++) {
        if (plan->axis[i].range.count > PLAN_ROWS / plan->rows) {
            return cli_usage(args->command, "too many poses: more than 2^53");
        }
        plan->rows *= plan->axis[i].range.count;
        plan->poses *= i >= plan->scene_axes ? plan->axis[i].range.count : 1;
    }
    if (code == 0 && plan->kind == SWEEP_FIXED && plan->axes == 0) {
        return cli_usage(args->command,
                         "nothing varies: give --az A:B:STEP, --el, --euler, --rotate, --sphere N, "
                         "--poses FILE.csv, --joint or --vary");
    }
    plan->end = plan->rows;
    for (uint32_t i = 0; i < plan->axes; i++) {
        plan->column[plan->columns++] = plan->axis[i].name;
    }
    for (uint32_t i = 0; i < plan->track.joints; i++) {
        plan->column[plan->columns++] = plan->track.joint_name[i];
    }
    if (plan->kind == SWEEP_TRACK) {
        plan->column[plan->columns++] = "time";
    }
    for (int k = 0; k < 3 && (plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK); k++) {
        plan->column[plan->columns++] = direction[k];
    }
    return code ? code : shard_read(args, plan);
}

void cli_plan_free(sweep_plan *plan)
{
    free(plan->track.row);
    free(plan->track.joint);
    plan->track.row = NULL;
    plan->track.joint = NULL;
}

int cli_plan_has_mean(const sweep_plan *plan)
{
    return plan->kind == SWEEP_SPHERE && plan->rows == plan->poses;
}

/* ---- one row ---- */

uint64_t cli_plan_place(const sweep_plan *plan, uint64_t row, uint32_t axis)
{
    uint64_t inner = plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK ? plan->poses : 1;
    for (uint32_t i = plan->axes; i-- > axis + 1;) {
        inner *= plan->axis[i].range.count;
    }
    return row / inner % plan->axis[axis].range.count;
}

/* Point i of a spherical Fibonacci lattice of N: z = 1 - (2 i + 1) / N, the azimuth a multiple of
   the golden section of a turn, taken modulo 1 in whole numbers (2^64 / phi). Source: R. Swinbank,
   R. J. Purser, Q. J. R. Meteorol. Soc. 132 (2006) 1769. */
static void sphere_point(uint64_t i, uint64_t count, double direction[3])
{
    uint64_t turn = i * 0x9e3779b97f4a7c15u;
    lrcs_pose around = lrcs_pose_default();
    double n = (double)count;
    double z = (n - 1.0 - 2.0 * (double)i) / n;
    double level = sqrt((1.0 - z) * (1.0 + z));
    lrcs_pose_from_azel(360.0 * ((double)(turn >> 11) * 0x1p-53), 0.0, &around);
    direction[0] = level * around.direction[0];
    direction[1] = level * around.direction[1];
    direction[2] = z;
}

int cli_plan_pose(const sweep_plan *plan, uint64_t row, lrcs_pose *pose)
{
    double v[SWEEP_AXES];
    uint64_t at = row % plan->poses;
    if (plan->kind == SWEEP_FIXED) {
        *pose = plan->base;
        return LRCS_OK;
    }
    if (plan->kind == SWEEP_TRACK) {
        const double *given = plan->track.row[at] + 1;
        return plan->track.quaternions ? lrcs_pose_from_quaternion(given, pose)
                                       : lrcs_pose_from_direction(given, pose);
    }
    if (plan->kind == SWEEP_SPHERE) {
        double direction[3];
        sphere_point(at, plan->poses, direction);
        return lrcs_pose_from_direction(direction, pose);
    }
    for (uint32_t i = plan->scene_axes; i < plan->axes; i++) {
        v[i - plan->scene_axes] = cli_range_at(&plan->axis[i].range, cli_plan_place(plan, row, i));
    }
    if (plan->kind == SWEEP_AZEL) {
        int swapped = plan->axis[plan->scene_axes].option[0] == 'e';
        return lrcs_pose_from_azel(v[swapped], v[!swapped], pose);
    }
    return plan->kind == SWEEP_EULER ? lrcs_pose_from_euler(plan->sequence, v, pose)
                                     : lrcs_host_pose_turn(&plan->base, plan->about, v[0], pose);
}

void cli_plan_values(const sweep_plan *plan, uint64_t row, double value[SWEEP_COLUMNS])
{
    uint32_t used = plan->axes;
    lrcs_pose pose = lrcs_pose_default();
    for (uint32_t i = 0; i < plan->axes; i++) {
        value[i] = cli_range_at(&plan->axis[i].range, cli_plan_place(plan, row, i));
    }
    for (uint32_t i = 0; i < plan->track.joints; i++) {
        value[used++] = plan->track.joint[row % plan->poses][i];
    }
    if (plan->kind == SWEEP_TRACK) {
        value[used++] = plan->track.row[row % plan->poses][0];
    }
    if (plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK) {
        cli_plan_pose(plan, row, &pose);
        for (int k = 0; k < 3; k++) {
            value[used++] = pose.R[2][k];
        }
    }
}
