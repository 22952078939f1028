/* SPDX-License-Identifier: MIT */
/* lrcs verify: compares the engine (shape to facets to sigma) with closed forms, on this machine.
 */
#include "cli/cli.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static const char verify_help[] =
    "usage: lrcs verify [--json]\n"
    "\n"
    "Tessellates simple bodies, computes sigma of their facets, and compares it with the\n"
    "closed form of the body, for all combinations of shapes, aspects and materials. Every\n"
    "error must lie within the bound that the engine states, plus that of the closed form:\n"
    "exit 0 if so, otherwise 1.\n"
    "\n"
    "options\n"
    "  --json   the same as JSON\n"
    "\n"
    "example\n"
    "  lrcs verify\n";

static const cli_option verify_options[] = {{"json", 0, 0}, {"help", 0, 0}, {NULL, 0, 0}};

/* Fine enough to be a test, coarse enough to take seconds. */
#define VERIFY_TOLERANCE 1e-2

static const lrcs_shape verify_shapes[] = {
    {.kind = LRCS_SHAPE_PLATE, .size = {1.2, 0.8, 0.0}},
    {.kind = LRCS_SHAPE_DISC, .radius = 0.5},
    {.kind = LRCS_SHAPE_BOX, .size = {1.0, 0.8, 0.6}},
    {.kind = LRCS_SHAPE_SPHERE, .radius = 0.7},
    {.kind = LRCS_SHAPE_DOME, .radius = 0.6},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2.0},
    {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 15.0},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.3, .radius2 = 0.6, .length = 1.0},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.4}};

static const double verify_aspects[] = {0.0, 20.0, 60.0, 90.0, 135.0, 180.0};

static const lrcs_brdf verify_brdfs[] = {
    {1.0, 0.25, 0.2, 0.5}, {0.0, 0.3, 0.2, 1.0}, {2.0, 0.0, 0.15, 0.0}};

#define COUNT_OF(list) (sizeof(list) / sizeof(list)[0])

typedef struct verify_case {
    const char *shape;
    double aspect_deg;
    const lrcs_brdf *brdf;
    double engine, closed, bound, seconds;
    int good;
} verify_case;

typedef struct verify_tally {
    unsigned count, failed;
    double seconds, worst; /* the largest |error| / bound */
} verify_tally;

static void case_print(const verify_case *one, lrcs_host_json *json)
{
    double error = one->engine - one->closed;
    double relative = one->closed != 0.0 ? error / one->closed : (double)NAN;
    char text[64];
    if (json) {
        lrcs_host_json_put(json, "{shape=%s aspect_deg=%g material={", one->shape, one->aspect_deg);
        cli_brdf_json(one->brdf, json);
        lrcs_host_json_put(
            json,
            "} engine_m2=%g closed_form_m2=%g relative_error=%g bound_m2=%g seconds=%g ok=%d}",
            one->engine, one->closed, relative, one->bound, one->seconds, one->good);
        return;
    }
    snprintf(text, sizeof text, "%g,%g,%g,%g", one->brdf->A, one->brdf->B, one->brdf->s,
             one->brdf->m);
    printf("%-10s %6g  %-14s %15.9g %15.9g ", one->shape, one->aspect_deg, text, one->engine,
           one->closed);
    snprintf(text, sizeof text, "%10.1e", relative);
    printf("%10s %9.1e %9.3f%s\n",
           one->closed != 0.0 ? text
           : error == 0.0     ? "0"
                              : "-",
           one->bound, 1e3 * one->seconds, one->good ? "" : "  FAIL");
}

/* An axis and an angle from it: s_hat = (sin, 0, cos), that is elevation 90 - angle. */
static int verify_case_run(const lrcs_host_scene *scene, const lrcs_shape *shape, verify_case *one,
                           lrcs_host_error *error)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_aspect aspect = {.deg = one->aspect_deg};
    lrcs_pose pose;
    lrcs_result result = {0};
    lrcs_closed_form closed;
    options.method = LRCS_METHOD_FACET;
    options.tolerance = VERIFY_TOLERANCE;
    int status = lrcs_closed_eval(shape, one->brdf, &aspect, &closed);
    if (status == LRCS_OK) {
        status = lrcs_pose_from_azel(0.0, 90.0 - one->aspect_deg, &pose);
    }
    if (status != LRCS_OK) {
        snprintf(error->text, sizeof error->text, "%s at %g deg: %s", one->shape, one->aspect_deg,
                 lrcs_status_text(status));
        return status;
    }
    status = lrcs_host_scene_run(scene, &pose, &options, &result, NULL, NULL, &one->seconds, error);
    if (status == LRCS_OK) {
        one->engine = result.sigma_m2;
        one->closed = closed.sigma_m2;
        one->bound = result.bound_m2 + closed.bound_m2;
        one->good = fabs(one->engine - one->closed) <= one->bound;
    }
    return status;
}

/* One shape in one material, from all aspects. */
static int shape_verify(const lrcs_shape *shape, const lrcs_brdf *brdf, lrcs_host_json *json,
                        verify_tally *tally)
{
    lrcs_host_error error;
    lrcs_host_scene scene;
    lrcs_recipe_part part = {.name = lrcs_shape_text(shape->kind),
                             .shape = *shape,
                             .place = lrcs_place_default(),
                             .material_index = -1};
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = *brdf, .two_sided = -1};
    lrcs_recipe recipe = {.part = &part, .binding = &binding, .part_count = 1, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    build.tolerance = VERIFY_TOLERANCE;
    build.facets_only = LRCS_FACETS_TOTAL;
    int status = lrcs_host_scene_make(&recipe, &build, &scene, &error);
    status = status == LRCS_OK ? lrcs_host_scene_prepare(&scene, &error) : status;
    for (size_t i = 0; i < COUNT_OF(verify_aspects) && status == LRCS_OK; i++) {
        verify_case one = {
            .shape = lrcs_shape_text(shape->kind), .aspect_deg = verify_aspects[i], .brdf = brdf};
        status = verify_case_run(&scene, shape, &one, &error);
        if (status != LRCS_OK) {
            break;
        }
        tally->count++;
        tally->failed += !one.good;
        tally->seconds += one.seconds;
        if (one.bound > 0.0) {
            tally->worst = fmax(tally->worst, fabs(one.engine - one.closed) / one.bound);
        }
        case_print(&one, json);
    }
    lrcs_host_scene_free(&scene);
    return status == LRCS_OK ? CLI_DONE : cli_failed(&error);
}

static int verify_command(const cli_args *args)
{
    lrcs_host_json writer = lrcs_host_json_make(stdout);
    lrcs_host_json *json = cli_value(args, "json") ? &writer : NULL;
    verify_tally tally = {0, 0, 0.0, 0.0};
    /* rows already show the progress */
    cli_watch_stage(isatty(STDOUT_FILENO) ? NULL : "cases", NULL);
    if (json) {
        lrcs_host_json_put(json, "{\n");
        cli_version_json(json);
        lrcs_host_json_put(json, "cases=[\n");
    } else {
        printf("%-10s %6s  %-14s %15s %15s %10s %9s %9s\n", "shape", "aspect", "A,B,s,m",
               "engine m2", "closed form m2", "rel error", "bound m2", "time ms");
    }
    for (size_t i = 0; i < COUNT_OF(verify_shapes); i++) {
        for (size_t k = 0; k < COUNT_OF(verify_brdfs); k++) {
            cli_watch_count(tally.count, COUNT_OF(verify_shapes) * COUNT_OF(verify_brdfs) *
                                             COUNT_OF(verify_aspects));
            int code = shape_verify(&verify_shapes[i], &verify_brdfs[k], json, &tally);
            if (code != CLI_DONE) {
                return code;
            }
        }
    }
    cli_watch_end();
    if (json) {
        lrcs_host_json_put(json, "] count=%u failed=%u worst_error_over_bound=%g}", tally.count,
                           tally.failed, tally.worst);
    } else {
        printf("%u of %u cases within their bound; the worst error is %.2g of its bound; %.3g s\n",
               tally.count - tally.failed, tally.count, tally.worst, tally.seconds);
    }
    return tally.failed == 0 ? CLI_DONE : CLI_FAILED;
}

const cli_command cli_verify_command = {"verify",       NULL,           NULL, verify_help,
                                        verify_options, verify_command, NULL};
