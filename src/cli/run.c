/* SPDX-License-Identifier: MIT */
/* lrcs run: sigma of a scene from a pose. */
#include "cli/cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define IMAGE_LEAST   16.0
#define IMAGE_MOST    8192.0
#define IMAGE_DEFAULT 512u
#define RASTER_MOST   32768.0

static const char run_help[] =
    "usage: lrcs run SCENE [pose] [options]\n"
    "\n"
    "Computes sigma (m2) of SCENE: a .3ds, .obj or .stl model, a scene file, or 'demo'.\n"
    "\n"
    "pose: one of these; without any, the laser stands on +z\n"
    "  --direction x,y,z     to the laser, body frame, any length\n"
    "  --azel AZ,EL          the same as azimuth and elevation, deg\n"
    "  --euler SEQ:a,b,c     deg; XYZ intrinsic: R = Rx(a) Ry(b) Rz(c); xyz extrinsic\n"
    "  --quaternion w,x,y,z  body to observation frame\n"
    "\n"
    "options\n"
    "  --tolerance REL       relative error asked for (1e-4); exit 3 where the bound exceeds it\n"
    "  --method M            auto (default), facet, zbuffer or exact\n"
    "  --resolution N        raster N x N (default: from the tolerance)\n"
    "  --unit U              of a model file: mm, cm, m (default), in, ft or metres per unit\n"
    "  --material [WHAT=]BRDF  repeatable; WHAT is a material's name or '#RRGGBB', all else if\n"
    "                        missing; BRDF is A,B,s,m (1/sr, 1/sr, slope, exponent) or a library\n"
    "                        material\n"
    "  --keep-transparent    keep facets that the file calls fully transparent\n"
    "  --json                the result as JSON, notices included\n"
    "  --facets FILE.csv     one row for every facet ('-': instead of the table)\n"
    "  --image FILE.png      what the laser sees, coloured by sigma per projected area\n"
    "  --image-size N        its side in pixels (512)\n"
    "\n"
    "examples\n"
    "  lrcs run demo --image demo.png\n"
    "  lrcs run demo --azel 30,-20 --json\n"
    "  lrcs run aura.3ds --unit in --direction 0,-1,0.2 --material solar=solar-cell\n"
    "  lrcs run part.stl --unit mm --material 0,0.3,0.2,1 --facets part.csv\n";

static const cli_option run_options[] = {
    {"direction", 1, 0}, {"azel", 1, 0},       {"euler", 1, 0},  {"quaternion", 1, 0},
    {"tolerance", 1, 0}, {"method", 1, 0},     {"unit", 1, 0},   {"resolution", 1, 0},
    {"material", 1, 1},  {"json", 0, 0},       {"facets", 1, 0}, {"keep-transparent", 0, 0},
    {"image", 1, 0},     {"image-size", 1, 0}, {"help", 0, 0},   {NULL, 0, 0}};

/* All that a run is made of, and all that it makes. */
typedef struct run_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_run_options options;
    lrcs_host_options load;
    const char *facets, *image_path;
    uint32_t image_size;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_facet_record *records;
    lrcs_image image;
    double seconds;
    int met;
} run_job;

/* ---- options ---- */

static int whole_read(const cli_args *args, const char *name, double least, double most,
                      uint32_t *value)
{
    double number = *value;
    int code = cli_number(args, name, &number);
    if (code == 0 && cli_value(args, name)) {
        if (!(number >= least && number <= most) || number != floor(number)) {
            return cli_usage(args->command,
                             "--%s: expected a whole number %.0f .. %.0f, found '%s'", name, least,
                             most, cli_value(args, name));
        }
        *value = (uint32_t)number;
    }
    return code;
}

static int outputs_read(run_job *job)
{
    const cli_args *args = job->args;
    job->facets = cli_value(args, "facets");
    job->image_path = cli_value(args, "image");
    if (job->facets && job->image_path && strcmp(job->facets, job->image_path) == 0) {
        return cli_usage(args->command, "--facets and --image name the same file '%s'",
                         job->facets);
    }
    if (job->image_path && strcmp(job->image_path, "-") == 0) {
        return cli_usage(args->command, "--image: a picture does not go to standard output");
    }
    if (job->facets && strcmp(job->facets, "-") == 0 && cli_value(args, "json")) {
        return cli_usage(args->command, "--facets - and --json both want standard output");
    }
    if (cli_value(args, "image-size") && !job->image_path) {
        return cli_usage(args->command, "--image-size needs --image FILE.png");
    }
    job->image_size = IMAGE_DEFAULT;
    return whole_read(args, "image-size", IMAGE_LEAST, IMAGE_MOST, &job->image_size);
}

static int options_read(run_job *job)
{
    const cli_args *args = job->args;
    const char *method = cli_value(args, "method");
    job->options = lrcs_run_options_default();
    int code = cli_pose_read(args, &job->pose);
    code = code ? code : cli_number(args, "tolerance", &job->options.tolerance);
    if (code == 0 && !(job->options.tolerance > 0.0)) {
        return cli_usage(args->command, "--tolerance: expected a relative error > 0, found '%s'",
                         cli_value(args, "tolerance"));
    }
    if (code == 0 && method) {
        job->options.method = lrcs_method_find(method);
        if (job->options.method < 0) {
            return cli_usage(args->command,
                             "--method: expected auto, facet, zbuffer or exact, found '%s'",
                             method);
        }
    }
    code = code ? code : whole_read(args, "resolution", 1.0, RASTER_MOST, &job->options.resolution);
    code = code ? code : outputs_read(job);
    code = code ? code : cli_scene_options_read(args, &job->load);
    job->load.build.tolerance = job->options.tolerance;
    return code;
}

/* ---- the run ---- */

static int run_scene(run_job *job)
{
    lrcs_host_error error;
    lrcs_host_scene *scene = &job->scene;
    int code = cli_scene_read(job->args, &job->load, scene);
    if (code != 0) {
        return code;
    }
    if (job->facets || job->image_path) {
        job->records = calloc((size_t)scene->scene.facet_count + 1, sizeof *job->records);
    }
    if (job->image_path) {
        job->image.size = lrcs_host_picture_need(job->image_size);
        job->image.facet = calloc((size_t)job->image.size * job->image.size, sizeof(uint32_t));
    }
    if ((!job->records && (job->facets || job->image_path)) ||
        (!job->image.facet && job->image_path)) {
        fprintf(stderr, "lrcs: out of memory\n");
        return CLI_FAILED;
    }
    if (lrcs_host_scene_prepare(scene, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    int status = lrcs_host_scene_run(scene, &job->pose, &job->options, &job->result, job->records,
                                     job->image_path ? &job->image : NULL, &job->seconds, &error);
    if (status == LRCS_E_UNSUPPORTED) {
        return cli_usage(job->args->command, "--method %s is not in this version",
                         lrcs_method_text(job->options.method));
    }
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    job->met = job->result.bound_m2 <= job->options.tolerance * job->result.sigma_m2;
    return 0;
}

/* ---- files ---- */

static int facets_write(const run_job *job)
{
    lrcs_host_error error;
    lrcs_host_output out;
    if (lrcs_host_output_open(job->facets, &out, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    lrcs_host_facets_write(out.stream, &job->scene.scene, job->records);
    return lrcs_host_output_close(&out, 1, &error) == LRCS_OK ? 0 : cli_failed(&error);
}

static int image_write(const run_job *job)
{
    lrcs_host_error error;
    lrcs_host_output out;
    size_t side = job->image_size;
    unsigned char *rgb = malloc(3 * side * side);
    if (!rgb) {
        fprintf(stderr, "lrcs: out of memory\n");
        return CLI_FAILED;
    }
    lrcs_host_picture_make(&job->scene.scene, job->records, &job->image, job->image_size, rgb);
    int status = lrcs_host_output_open(job->image_path, &out, &error);
    if (status == LRCS_OK) {
        status = lrcs_host_png_write(out.stream, rgb, job->image_size, job->image_size, 3, &error);
        int good = status == LRCS_OK;
        int closed = lrcs_host_output_close(&out, good, good ? &error : NULL);
        status = good ? closed : status;
    }
    free(rgb);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* ---- the report ---- */

static void notices_gather(run_job *job, lrcs_host_json *json)
{
    const lrcs_host_notices *notices = &job->scene.notices;
    uint32_t bits = job->result.notices;
    int unused = job->options.resolution != 0 && job->result.resolution == 0;
    const char *unused_text = "--resolution has no effect: no raster was needed";
    for (uint32_t i = 0; i < notices->count && json; i++) {
        lrcs_host_json_text(json, NULL, notices->text[i]);
    }
    for (int bit = 1; bits != 0; bit *= 2, bits >>= 1) {
        if ((bits & 1u) && json) {
            lrcs_host_json_text(json, NULL, lrcs_notice_text(bit));
        } else if (bits & 1u) {
            fprintf(stderr, "notice: %s\n", lrcs_notice_text(bit));
        }
    }
    if (unused && json) {
        lrcs_host_json_text(json, NULL, unused_text);
    } else if (unused) {
        fprintf(stderr, "notice: %s\n", unused_text);
    }
}

/* Negative stands for not known. */
static void known_number(lrcs_host_json *json, const char *key, double value)
{
    lrcs_host_json_number(json, key, value >= 0.0 ? value : (double)NAN);
}

/* The direction with length 1, for people and scripts. */
static void unit_direction(const lrcs_pose *pose, double s_hat[3])
{
    const double *d = pose->direction;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        s_hat[k] = d[k] / length;
    }
}

static void json_head(run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    char hash[17];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)lrcs_scene_hash(&job->scene.scene));
    lrcs_host_json_count(json, "schema", CLI_SCHEMA);
    lrcs_host_json_text(json, "version", lrcs_version());
    lrcs_host_json_text(json, "scene_hash", hash);
    lrcs_host_json_number(json, "sigma_m2", result->sigma_m2);
    lrcs_host_json_number(json, "sigma_dbsm",
                          result->sigma_m2 > 0.0 ? cli_dbsm(result->sigma_m2) : (double)NAN);
    lrcs_host_json_begin(json, "tolerance", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_number(json, "asked", job->options.tolerance);
    lrcs_host_json_bool(json, "met", job->met);
    lrcs_host_json_end(json);
    if (result->resolution != 0) {
        lrcs_host_json_count(json, "resolution", result->resolution);
    } else {
        lrcs_host_json_text(json, "resolution", NULL);
    }
    lrcs_host_json_text(json, "normals", "flat");
    known_number(json, "estimate_m2", result->estimate_m2);
    lrcs_host_json_begin(json, "notices", LRCS_HOST_ARRAY);
    notices_gather(job, json);
    lrcs_host_json_end(json);
}

static void json_effects(const lrcs_result *result, lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "effects", LRCS_HOST_ARRAY);
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", lrcs_effect_text(i));
        lrcs_host_json_bool(json, "on", result->effect[i].on);
        lrcs_host_json_text(json, "reason", result->effect[i].reason);
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_begin(json, "flags", LRCS_HOST_ROW_ARRAY);
    for (uint32_t bits = result->flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            lrcs_host_json_text(json, NULL, lrcs_flag_text((int)bit));
        }
    }
    lrcs_host_json_end(json);
}

static void json_tail(const run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    double s_hat[3];
    unit_direction(&job->pose, s_hat);
    lrcs_host_json_begin(json, "facets", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_count(json, "total", result->facets_total);
    lrcs_host_json_count(json, "front", result->facets_front);
    lrcs_host_json_count(json, "hidden", result->facets_hidden);
    lrcs_host_json_count(json, "partial", result->facets_partial);
    lrcs_host_json_end(json);
    lrcs_host_json_begin(json, "direction", LRCS_HOST_ROW_ARRAY);
    for (int k = 0; k < 3; k++) {
        lrcs_host_json_number(json, NULL, s_hat[k]);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_begin(json, "seconds", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_number(json, "load", job->scene.seconds_load);
    lrcs_host_json_number(json, "prepare", job->scene.seconds_prepare);
    lrcs_host_json_number(json, "pose", job->seconds);
    lrcs_host_json_end(json);
}

static void json_report(run_job *job)
{
    const lrcs_result *result = &job->result;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    json_head(job, &json);
    lrcs_host_json_number(&json, "sigma_glint_m2", result->sigma_glint_m2);
    lrcs_host_json_number(&json, "sigma_diffuse_m2", result->sigma_diffuse_m2);
    lrcs_host_json_number(&json, "bound_m2", result->bound_m2);
    lrcs_host_json_begin(&json, "budget_m2", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_number(&json, "visibility", result->budget.visibility_m2);
    known_number(&json, "tessellation", result->budget.tessellation_m2);
    lrcs_host_json_number(&json, "rounding", result->budget.rounding_m2);
    lrcs_host_json_end(&json);
    lrcs_host_json_number(&json, "projected_area_m2", result->projected_area_m2);
    lrcs_host_json_text(&json, "method", lrcs_method_text(result->method));
    json_effects(result, &json);
    json_tail(job, &json);
    lrcs_host_json_end(&json);
}

static void table_sigma(const run_job *job)
{
    const lrcs_result *r = &job->result;
    printf("sigma        %.10g m2", r->sigma_m2);
    if (r->sigma_m2 > 0.0) {
        printf("   %.6f dBsm", cli_dbsm(r->sigma_m2));
    }
    printf("\n  glint      %.10g m2\n  diffuse    %.10g m2\n", r->sigma_glint_m2,
           r->sigma_diffuse_m2);
    printf("bound        %.3g m2", r->bound_m2);
    if (r->sigma_m2 > 0.0) {
        printf("   %.2g of sigma", r->bound_m2 / r->sigma_m2);
    }
    printf("; tolerance %g %s\n", job->options.tolerance, job->met ? "met" : "NOT met");
    printf("  visibility %.3g m2\n", r->budget.visibility_m2);
    if (r->budget.tessellation_m2 >= 0.0) {
        printf("  tessellation %.3g m2\n", r->budget.tessellation_m2);
    } else {
        printf("  tessellation not known\n");
    }
    printf("  rounding   %.3g m2\n", r->budget.rounding_m2);
    if (r->estimate_m2 >= 0.0) {
        printf("estimate     %.3g m2   likely error, not a bound\n", r->estimate_m2);
    }
    printf("silhouette   %.10g m2\n", r->projected_area_m2);
}

static void table_report(run_job *job)
{
    const lrcs_result *r = &job->result;
    double s_hat[3];
    unit_direction(&job->pose, s_hat);
    printf("scene        %s, hash %016llx\n", job->args->operand,
           (unsigned long long)lrcs_scene_hash(&job->scene.scene));
    printf("direction    %.10g, %.10g, %.10g   to the laser, body frame\n", s_hat[0], s_hat[1],
           s_hat[2]);
    table_sigma(job);
    printf("method       %s", lrcs_method_text(r->method));
    if (r->resolution != 0) {
        printf(", %lu x %lu", (unsigned long)r->resolution, (unsigned long)r->resolution);
    }
    printf(" (%s)\n", job->options.method == LRCS_METHOD_AUTO ? "chosen by auto" : "as asked");
    printf("simulated    normals flat\n");
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        printf("  %-18s %-4s %s\n", lrcs_effect_text(i), r->effect[i].on ? "on" : "off",
               r->effect[i].reason);
    }
    printf("facets       %lu: %lu face the laser, %lu hidden, %lu partly hidden\n",
           (unsigned long)r->facets_total, (unsigned long)r->facets_front,
           (unsigned long)r->facets_hidden, (unsigned long)r->facets_partial);
    for (uint32_t bits = r->flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            printf("flag         %s\n", lrcs_flag_text((int)bit));
        }
    }
    printf("time         load %.3g ms, prepare %.3g ms, pose %.3g ms\n",
           1e3 * job->scene.seconds_load, 1e3 * job->scene.seconds_prepare, 1e3 * job->seconds);
    if (job->image_path) {
        printf("picture      %s\n", job->image_path);
    }
}

/* ---- the command ---- */

/* Files first: a table on stdout that says "picture" must be true. */
static int run_outputs(run_job *job)
{
    int to_stdout = job->facets && strcmp(job->facets, "-") == 0;
    int code = job->image_path ? image_write(job) : 0;
    code = code == 0 && job->facets ? facets_write(job) : code;
    if (code != 0) {
        return code;
    }
    if (cli_value(job->args, "json")) {
        json_report(job);
    } else {
        cli_notices_print(stderr, &job->scene.notices);
        notices_gather(job, NULL);
        if (!to_stdout) {
            table_report(job);
        }
    }
    int judged = job->options.method == LRCS_METHOD_AUTO || cli_value(job->args, "tolerance");
    int short_of_memory = (job->result.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
    return (judged && !job->met) || short_of_memory ? CLI_DEGRADED : CLI_DONE;
}

static int run_command(const cli_args *args)
{
    run_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = options_read(&job);
    code = code ? code : run_scene(&job);
    code = code ? code : run_outputs(&job);
    free(job.records);
    free(job.image.facet);
    lrcs_host_scene_free(&job.scene);
    cli_scene_options_free(&job.load);
    return code;
}

const cli_command cli_run_command = {
    "run",    "SCENE",     "give a .3ds, .obj or .stl model, a scene file, or demo",
    run_help, run_options, run_command};
