/* SPDX-License-Identifier: MIT */
/* lrcs run: sigma of a scene from a pose. */
#include "cli/run/run.h"

#include <stdlib.h>
#include <string.h>

/* The time that stopping may take beyond a time budget. */
#define BUDGET_GRACE_MS 20.0

/* With this many facets a run takes seconds or more. */
#define RUN_MANY 100000u

#define STEPS_MOST 4294967295.0 /* of 32 bits */

static const char run_help[] =
    "usage: lrcs run SCENE [pose] [options]\n"
    "\n"
    "Computes sigma (m2) of SCENE: a .3ds, .obj or .stl model, a scene file, or 'demo'.\n"
    "\n" CLI_POSE_HELP "\n"
    "options\n" CLI_ACCURACY_HELP
    "  --time-budget MS      instead of these: the best answer that is complete within MS\n"
    "                        milliseconds, loading and preparing included: settings are tried\n"
    "                        from the quickest on, and the one with the smallest bound (or\n"
    "                        estimate, where the bound exceeds sigma / 10) is kept. Prints the\n"
    "                        options that reproduce it. Exit 3 if it took longer, misses a\n"
    "                        --tolerance, or the bound exceeds sigma: then it is not usable\n"
    "  --steps N             limits the work of finding what is visible to N steps, which are\n"
    "                        counted the same on every machine; what they leave undecided is in\n"
    "                        the bound. The pixels of a raster are not counted\n" CLI_SCENE_HELP;

static const char run_help_more[] =
    "  --precision P         float32 or float64: emulates graphics hardware, a z-buffer of\n"
    "                        --resolution N (default 1024). sigma is what that hardware\n"
    "                        computes, bound is proved for it by method exact; the\n"
    "                        contributions of sampling, precision, depth and summation to its\n"
    "                        error are printed\n"
    "  --depth-bits B        16, 24 or 32 bits of its depth buffer (default: all that P holds);\n"
    "                        without --precision, P is float64\n"
    "  --explain             the time and the change of sigma that each effect causes, measured\n"
    "                        by leaving it out, or by simulating it if it is off; and the time\n"
    "                        of each stage of preparing and of the pose. Runs the pose\n"
    "                        repeatedly, for about 2 s or once for each effect\n"
    "  --sensitivity         derivatives of sigma in each material's A, B, s, m and in attitude\n"
    "  --draws N, --seed N   size and seed of the sample that checks the material uncertainty,\n"
    "                        if materials state errors\n"
    "  --shares              what contributes to sigma: parts, materials, and the ten brightest\n"
    "                        facets\n"
    "  --json                the result as JSON, notices included\n"
    "  --facets FILE.csv     one row for each facet ('-': on standard output, instead of the\n"
    "                        table); FILE.csv.json states what it was made from\n"
    "  --polygons FILE.csv   the visible part of each facet as convex rings, one row for each\n"
    "                        point, by exact visibility whichever method auto chooses ('-' and\n"
    "                        FILE.csv.json as for --facets)\n"
    "  --image FILE.png      a picture of what the laser sees, coloured by sigma per projected\n"
    "                        area\n"
    "  --image-size N        side of the picture in pixels (default 512)\n"
    "\n"
    "words of the table\n"
    "  dBsm                  10 log10(sigma / 1 m2)\n"
    "  Eq. 2                 of Han et al. (2014): sigma is 4 pi times the integral of\n"
    "                        f_r cos^2(theta) over the surface that the laser sees; f_r is the\n"
    "                        BRDF, theta the angle between the normal and the direction to it\n"
    "  glint, diffuse        what the terms of f_r with A and with B contribute\n"
    "  bound                 sigma is proved to be this close to Eq. 2: visibility (what is\n"
    "                        hidden), tessellation (facets in the place of curved shapes), and\n"
    "                        rounding add up to it\n"
    "  silhouette            the area of what the laser sees, projected on a plane across\n"
    "                        its beam\n"
    "  a single convex body  nothing in the scene can hide anything else\n"
    "  closed and outward    the facets enclose a volume, and their normals point out of it\n"
    "  back_face_casters     facets hide others also where their backs face the laser\n"
    "  closed_forms          a formula for a whole shape, in the place of its facets\n"
    "\nexamples\n"
    "  lrcs run demo --image demo.png\n"
    "  lrcs run demo --azel 30,-20 --explain --shares\n"
    "  lrcs run demo --azel 30,-20 --time-budget 200\n"
    "  lrcs run demo --azel 30,-20 --resolution 512 --precision float32 --depth-bits 24\n"
    "  lrcs run aura.3ds --unit in --direction 0,-1,0.2 --material solar=solar-cell\n"
    "  lrcs run part.stl --unit mm --material 0,0.3,0.2,1 --facets part.csv\n";

static const cli_option run_options[] = {CLI_POSE_OPTIONS,
                                         CLI_ACCURACY_OPTIONS,
                                         CLI_SCENE_OPTIONS,
                                         {"json", 0, 0},
                                         {"facets", CLI_FILE, 0},
                                         {"polygons", CLI_FILE, 0},
                                         {"image", CLI_FILE, 0},
                                         {"image-size", 1, 0},
                                         {"explain", 0, 0},
                                         {"time-budget", 1, 0},
                                         {"shares", 0, 0},
                                         {"precision", 1, 0},
                                         {"depth-bits", 1, 0},
                                         {"steps", 1, 0},
                                         {"sensitivity", 0, 0},
                                         {"draws", 1, 0},
                                         {"seed", 1, 0},
                                         {"help", 0, 0},
                                         {NULL, 0, 0}};

/* ---- options ---- */

/* The scene is divided for the method that the options state, before an emulation replaces it. What
   tolerance is judged follows from all of them: a time budget ends at the first answer that meets a
   tolerance only if one is given. */
static int run_options_read(run_job *job)
{
    const cli_args *args = job->args;
    uint32_t steps = 0;
    int code = cli_pose_read(args, &job->pose);
    code = code ? code : cli_accuracy_read(args, &job->options);
    code = code ? code : cli_whole(args, "steps", 1.0, STEPS_MOST, &steps);
    job->options.steps = steps;
    code = code ? code : cli_run_outputs_read(job);
    code = code ? code : cli_scene_options_read(args, &job->load);
    cli_division_set(&job->options, &job->load);
    code = code ? code : cli_run_budget_read(job);
    code = code ? code : cli_run_emulation_read(job);
    code = code ? code : cli_run_materials_read(job);
    int judged = job->budget.asked_ms > 0.0 ? cli_value(args, "tolerance") != NULL
                                            : cli_tolerance_judged(args, &job->options);
    job->asked = judged ? job->options.tolerance : 0.0;
    job->explain = cli_value(args, "explain") != NULL;
    job->shares_asked = cli_value(args, "shares") != NULL;
    return code ? code : cli_normals_read(args, &job->load);
}

/* ---- the run ---- */

/* Prints a notice, once, if shapes became very many facets and the run takes long, unless the time
   that it may take was given. */
static void long_run_notice(run_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    if (scene->facet_count > RUN_MANY && lrcs_host_scene_tessellated(scene) &&
        !(job->budget.asked_ms > 0.0) && !job->announced) {
        job->announced = 1;
        fprintf(stderr,
                "notice: %lu facets for a tolerance of %g: preparing and running them takes a "
                "while\n",
                (unsigned long)scene->facet_count, job->options.tolerance);
    }
}

static int run_scene_prepare(run_job *job)
{
    long_run_notice(job);
    cli_watch_stage("preparing", &job->scene);
    return cli_scene_prepare(&job->scene) != 0 ? CLI_FAILED : 0;
}

/* Allocates memory for the records of facets, if they are needed: for an output, or for what the
   bound does not include. Of shapes with closed surfaces no back side is visible, and their facets
   stand for the true surface; their records would take longer than sigma. */
static int run_records(run_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    int needed = job->facets_path || job->image_path || job->shares_asked || job->emulation.asked;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        needed |= scene->part[i].kind < 0 || !scene->part[i].solid;
    }
    free(job->records);
    job->records = NULL;
    if (!needed) {
        return 0;
    }
    job->records = calloc((size_t)scene->facet_count + 1, sizeof *job->records);
    return job->records ? 0 : cli_out_of_memory();
}

/* Runs the pose, unless that is done, and makes what the outputs show. */
static int run_pose(run_job *job)
{
    lrcs_host_error error;
    int code = job->scene.prepared ? 0 : run_scene_prepare(job);
    int done = job->divided && !job->image_path;
    if (code == 0 && !done) {
        code = run_records(job);
    }
    if (code == 0 && job->image_path) {
        lrcs_host_picture picture = cli_run_picture(job);
        job->image.size = lrcs_host_picture_need(&picture, job->image_size);
        job->image.facet = calloc((size_t)job->image.size * job->image.size, sizeof(uint32_t));
        code = job->image.facet ? 0 : cli_out_of_memory();
    }
    if (code != 0) {
        return code;
    }
    cli_watch_stage("pose", NULL);
    job->options.progress = cli_watch_run();
    if (job->emulation.asked) {
        return cli_run_emulate(job);
    }
    if (!done) {
        code = cli_scene_run(&job->scene, &job->pose, &job->options, &job->result, job->records,
                             job->image_path ? &job->image : NULL, &job->seconds);
    }
    if (code == 0 && job->polygons_path &&
        lrcs_host_polygons_make(&job->scene, &job->pose, &job->polygons, &error) != LRCS_OK) {
        code = cli_failed(&error);
    }
    return code;
}

int cli_run_divide(run_job *job)
{
    lrcs_host_scene *scene = &job->scene;
    job->divided = scene->levels != NULL;
    int code = job->divided ? run_scene_prepare(job) : 0;
    double *part_error = calloc(scene->scene.part_count + (size_t)1, sizeof *part_error);
    code = code == 0 && !part_error ? cli_out_of_memory() : code;
    for (int finer = job->divided; finer && code == 0;) {
        cli_watch_stage("pose", NULL);
        job->options.progress = cli_watch_run();
        lrcs_run_options options = job->options;
        options.part_error_m2 = part_error;
        code = run_records(job);
        code = code ? code
                    : cli_scene_run(scene, &job->pose, &options, &job->result, job->records, NULL,
                                    &job->seconds);
        cli_watch_stage("dividing curved shapes", NULL);
        finer = code == 0 &&
                lrcs_host_scene_refine(scene, &options, &job->result, part_error, &job->load.build);
        if (finer) {
            long_run_notice(job);
        }
    }
    free(part_error);
    return code;
}

/* A search for the best settings already has their result; files and shares need the run itself. */
int cli_run_scene(run_job *job)
{
    int searched = job->budget.asked_ms > 0.0;
    int files = job->facets_path || job->polygons_path || job->image_path || job->shares_asked;
    cli_watch_stage("loading", NULL);
    int code = cli_scene_read(job->args, &job->load, &job->scene);
    code = code ? code : cli_outputs_spare(job->args, &job->scene);
    code = code ? code : searched ? cli_run_budget(job) : cli_run_divide(job);
    if (code == 0 && (files || !searched)) {
        code = run_pose(job);
    }
    code = code ? code : cli_run_materials(job);
    return code == 0 && job->shares_asked
               ? cli_shares_make(&job->scene, &job->scene.scene, job->records, job->result.sigma_m2,
                                 &job->shares)
               : code;
}

void cli_run_free(run_job *job)
{
    free(job->records);
    free(job->image.facet);
    free(job->sensitivity);
    lrcs_host_shares_free(&job->shares);
    lrcs_host_polygons_free(&job->polygons);
    lrcs_host_scene_free(&job->scene);
    cli_scene_options_free(&job->load);
}

/* The flag of a result of a search refers to a tolerance that was tried; if no tolerance applies,
   none is missed. */
static void run_judge(run_job *job)
{
    uint32_t *flags = &job->result.flags;
    if (job->budget.asked_ms > 0.0) {
        int missed = job->asked > 0.0 && !cli_run_meets(&job->result, job->asked);
        *flags &= ~(uint32_t)LRCS_FLAG_TOLERANCE_NOT_MET;
        *flags |= missed ? LRCS_FLAG_TOLERANCE_NOT_MET : 0u;
    }
    *flags = job->asked > 0.0 ? *flags : *flags & ~(uint32_t)LRCS_FLAG_TOLERANCE_NOT_MET;
    job->met = !(*flags & LRCS_FLAG_TOLERANCE_NOT_MET);
}

/* ---- the command ---- */

/* Files come first: a table on stdout that mentions a picture must be true. */
static int run_outputs(run_job *job)
{
    int code = cli_run_caveats(job);
    code = code ? code : cli_run_outputs_write(job);
    code = code == 0 && job->explain ? cli_run_explain(job) : code;
    cli_watch_end();
    if (code != 0) {
        return code;
    }
    if (cli_value(job->args, "json")) {
        cli_run_json(job);
    } else {
        cli_run_notices(job, NULL);
        if (!cli_run_outputs_stdout(job)) {
            cli_run_table(job);
        }
    }
    if (job->budget.spent_ms > job->budget.asked_ms + BUDGET_GRACE_MS) {
        return cli_degraded("the time budget of %g ms is exceeded: %.3g ms", job->budget.asked_ms,
                            job->budget.spent_ms);
    }
    if (job->budget.asked_ms > 0.0 && job->result.bound_m2 > job->result.sigma_m2) {
        return cli_degraded("the bound exceeds sigma: the time budget is too short");
    }
    lrcs_run_options asked = job->options; /* a search tries other tolerances */
    asked.tolerance = job->asked > 0.0 ? job->asked : asked.tolerance;
    return cli_accuracy_code(job->args, &asked, job->result.flags);
}

static int run_command(const cli_args *args)
{
    run_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = run_options_read(&job);
    code = code ? code : cli_run_scene(&job);
    if (code == 0) {
        run_judge(&job);
        code = run_outputs(&job);
    }
    cli_run_free(&job);
    return code;
}

const cli_command cli_run_command = {
    "run",        "SCENE",     "give a .3ds, .obj or .stl model, a scene file, or demo",
    run_help,     run_options, run_command,
    run_help_more};
