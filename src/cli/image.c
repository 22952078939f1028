/* SPDX-License-Identifier: MIT */
/* lrcs image: draws what the laser sees from a pose, as a picture, as vector graphics, or as a
   surface for other programs. This file decides what is drawn and where it is written; the host
   draws. */
#include "cli/cli.h"

#include <lrcs/picture.h>

#include <stdlib.h>
#include <string.h>

static const char image_help[] =
    "usage: lrcs image SCENE [pose] -o FILE.png [options]\n"
    "\n"
    "Draws what the laser sees of SCENE, a .3ds, .obj or .stl model, a scene file, or 'demo',\n"
    "with a scale bar and the meaning of colours (160 pixels and more), its title, the\n"
    "direction and the body's axes (320 pixels and more).\n"
    "\n" CLI_POSE_HELP "\n"
    "output: at least one of these\n"
    "  -o FILE.png           a picture\n"
    "  --visible FILE.svg    the exact visible polygons as vector graphics: the path f12 shows\n"
    "                        facet 12; coordinates are metres of the observation frame, x to\n"
    "                        the right, y up\n"
    "  --vtk FILE            all facets in the body frame (m), for ParaView and VTK: FILE.vtp\n"
    "                        (XML, text) or FILE.vtk (legacy, binary), with cos_theta, area_m2,\n"
    "                        visible_area_m2 (projected), visible_fraction, sigma_m2, material\n"
    "                        and part of each; FILE.json states what it was made from\n"
    "\n"
    "options\n"
    "  --by LOOK             what colours show:\n"
    "                          sigma     per projected area, dB re 1 m2/m2 (default)\n"
    "                          theta     angle of incidence, deg\n"
    "                          range     height towards the laser, from the centre of the\n"
    "                                    scene's box, m\n"
    "                          facet     a colour of its own for each facet\n"
    "                          material  a false colour for each material, named below it\n"
    "                          shaded    the model's own colours, matt, lit from the laser\n"
    "                        Grey facets return nothing: their material reflects nothing, or\n"
    "                        they show a back that does not reflect\n"
    "  --size N              side of the picture in pixels, 16 .. 4096 (default 512)\n"
    "  --ground WHAT         background: dark (default of -o) or white (default of "
    "--visible)\n" CLI_ACCURACY_HELP;

static const char image_help_more[] =
    CLI_SCENE_HELP "\n"
                   "examples\n"
                   "  lrcs image demo -o demo.png\n"
                   "  lrcs image demo --azel 50,40 --by theta --size 1024 -o demo.png\n"
                   "  lrcs image demo --azel 50,40 --visible demo.svg --vtk demo.vtp\n"
                   "  lrcs image aura.3ds --azel 30,20 --by material --ground white -o aura.png\n";

static const cli_option image_options[] = {
    CLI_POSE_OPTIONS,         CLI_ACCURACY_OPTIONS, CLI_SCENE_OPTIONS, {"o", CLI_FILE, 0},
    {"visible", CLI_FILE, 0}, {"vtk", CLI_FILE, 0}, {"by", 1, 0},      {"size", 1, 0},
    {"ground", 1, 0},         {"help", 0, 0},       {NULL, 0, 0}};

enum { IMAGE_PNG, IMAGE_SVG, IMAGE_VTK, IMAGE_FILES };
static const char *const image_file[IMAGE_FILES] = {"o", "visible", "vtk"}; /* options */

typedef struct image_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_run_options options;
    lrcs_host_options load;
    const char *path[IMAGE_FILES]; /* NULL if not asked for */
    int colouring, white, ground_asked;
    uint32_t size;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_facet_record *records;
    lrcs_image image;
    lrcs_host_polygons polygons;
} image_job;

/* ---- options ---- */

static int image_read(image_job *job)
{
    static const struct {
        const char *ending, *other, *expected;
    } kind[IMAGE_FILES] = {{".png", ".png", "FILE.png"},
                           {".svg", ".svg", "FILE.svg"},
                           {".vtp", ".vtk", "FILE.vtp or FILE.vtk"}};
    const cli_args *args = job->args;
    int given = 0;
    int code = cli_pose_read(args, &job->pose);
    for (int i = 0; i < IMAGE_FILES && code == 0; i++) {
        const char *path = job->path[i] = cli_value(args, image_file[i]);
        given += path != NULL;
        if (path && !cli_extension(path, kind[i].ending) && !cli_extension(path, kind[i].other)) {
            code = cli_expected(args, image_file[i], kind[i].expected);
        }
    }
    if (code == 0 && given == 0) {
        return cli_usage(args->command, "give -o FILE.png, --visible FILE.svg or --vtk FILE.vtp");
    }
    job->ground_asked = cli_value(args, "ground") != NULL;
    job->colouring = LRCS_HOST_BY_SIGMA;
    job->size = CLI_PICTURE_DEFAULT;
    code = code ? code
                : cli_choice(args, "by", "sigma, theta, range, facet, material or shaded",
                             &job->colouring);
    code = code ? code : cli_choice(args, "ground", "dark or white", &job->white);
    if (code == 0 && cli_value(args, "size") && !job->path[IMAGE_PNG]) {
        return cli_usage(args->command, "--size needs -o FILE.png");
    }
    code = code ? code : cli_whole(args, "size", CLI_PICTURE_LEAST, CLI_PICTURE_MOST, &job->size);
    code = code ? code : cli_accuracy_read(args, &job->options);
    code = code ? code : cli_scene_options_read(args, &job->load);
    job->load.build.tolerance = job->options.tolerance;
    job->load.build.facets_only = LRCS_FACETS_TOTAL;
    return code ? code : cli_normals_read(args, &job->load);
}

/* ---- the run ---- */

static lrcs_host_picture picture_of(const image_job *job)
{
    return (lrcs_host_picture){.scene = &job->scene.scene,
                               .pose = &job->pose,
                               .records = job->records,
                               .title = cli_scene_name(job->args, &job->scene),
                               .annotated = 1,
                               .colouring = job->colouring,
                               .white = job->white};
}

static int image_run(image_job *job)
{
    lrcs_host_error error;
    const lrcs_host_picture picture = picture_of(job);
    job->records = calloc((size_t)job->scene.scene.facet_count + 1, sizeof *job->records);
    if (job->path[IMAGE_PNG]) {
        job->image.size = lrcs_host_picture_need(&picture, job->size);
        job->image.facet = calloc((size_t)job->image.size * job->image.size, sizeof(uint32_t));
    }
    if (!job->records || (job->path[IMAGE_PNG] && !job->image.facet)) {
        return cli_out_of_memory();
    }
    cli_watch_stage("preparing", &job->scene);
    int code = cli_scene_prepare(&job->scene);
    cli_watch_stage("pose", NULL);
    job->options.progress = cli_watch_run();
    code = code ? code
                : cli_scene_run(&job->scene, &job->pose, &job->options, &job->result, job->records,
                                job->image.facet ? &job->image : NULL, NULL);
    if (code == 0 && job->path[IMAGE_SVG] &&
        lrcs_host_polygons_make(&job->scene, &job->pose, &job->polygons, &error) != LRCS_OK) {
        code = cli_failed(&error);
    }
    return code;
}

/* ---- the files ---- */

static int png_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const image_job *job = context;
    const lrcs_host_picture picture = picture_of(job);
    return cli_picture_write(out, &picture, &job->image, job->size, job->args, &job->scene, error);
}

/* SVG is meant for print, so its background is white unless an option says otherwise. */
static int svg_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const image_job *job = context;
    lrcs_host_picture picture = picture_of(job);
    (void)error;
    picture.white = job->white || !job->ground_asked;
    char *about = cli_provenance_text(job->args, &job->scene);
    picture.about = about;
    lrcs_host_picture_svg(out, &picture, &job->polygons.list);
    free(about);
    return LRCS_OK;
}

static int vtk_write(FILE *out, const void *context, lrcs_host_error *error)
{
    const image_job *job = context;
    const lrcs_host_picture picture = picture_of(job);
    (void)error;
    lrcs_host_vtk_write(out, &picture, cli_extension(job->path[IMAGE_VTK], ".vtp"));
    return LRCS_OK;
}

static int image_command(const cli_args *args)
{
    static cli_writer *const writer[IMAGE_FILES] = {png_write, svg_write, vtk_write};
    image_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = image_read(&job);
    cli_watch_stage("loading", NULL);
    code = code ? code : cli_scene_read(args, &job.load, &job.scene);
    code = code ? code : cli_outputs_spare(args, &job.scene);
    code = code ? code : image_run(&job);
    for (int i = 0; i < IMAGE_FILES && code == 0; i++) {
        code = job.path[i] ? cli_output_write(job.path[i], writer[i], &job) : 0;
    }
    if (code == 0 && job.path[IMAGE_VTK]) {
        code = cli_provenance_beside(args, job.path[IMAGE_VTK], &job.scene, &job.pose, NULL);
    }
    cli_watch_end();
    if (code == 0) {
        cli_notices_print(stderr, &job.scene.notices);
        cli_accepted_print(stderr, job.result.flags);
        cli_outputs_print(args, NULL);
        code = cli_accuracy_code(args, &job.options, job.result.flags);
    }
    free(job.records);
    free(job.image.facet);
    lrcs_host_polygons_free(&job.polygons);
    lrcs_host_scene_free(&job.scene);
    cli_scene_options_free(&job.load);
    return code;
}

const cli_command cli_image_command = {
    "image",        "SCENE",       "give a .3ds, .obj or .stl model, a scene file, or demo",
    image_help,     image_options, image_command,
    image_help_more};
