/* SPDX-License-Identifier: MIT */
/* lrcs vectors: writes a conformance kit for other implementations (lrcs/kit.h). */
#include "cli/cli.h"

#include <lrcs/kit.h>

static const char vectors_help[] =
    "usage: lrcs vectors DIR [options]\n"
    "\n"
    "Writes a conformance kit for other implementations into DIR: small scenes (OBJ, STL,\n"
    "JSON), attitudes, materials, and the truth of each case: sigma with its bound, glint and\n"
    "diffuse parts, visible area and cos theta of every facet, item and depth images; in five\n"
    "tiers, from a plate to hard cases. DIR/README.md explains all that is needed to take\n"
    "part; lrcs compare judges the answers. DIR is made if it does not exist; an older kit in\n"
    "it is overwritten, but files of scenes that are not asked for stay (cases.csv lists\n"
    "those that count). The bytes are the same every time.\n"
    "\n"
    "options\n"
    "  --resolution N        side of the images in pixels (default 128; 0: none)\n"
    "  --tier K              only tiers 1 .. K (default 5)\n"
    "\n"
    "examples\n"
    "  lrcs vectors kit\n"
    "  lrcs vectors kit --resolution 512\n";

static const cli_option vectors_options[] = {
    {"resolution", 1, 0}, {"tier", 1, 0}, {"help", 0, 0}, {NULL, 0, 0}};

static void scene_begin(const char *scene)
{
    cli_watch_stage(scene, NULL);
}

static int vectors_command(const cli_args *args)
{
    const char *folder = args->operand;
    lrcs_host_kit_options options = {
        .tier = LRCS_HOST_KIT_TIERS, .resolution = 128, .begin = scene_begin};
    lrcs_host_kit_size size;
    lrcs_host_error error;
    int code =
        cli_whole(args, "resolution", 0.0, LRCS_HOST_KIT_RESOLUTION_MOST, &options.resolution);
    code = code ? code : cli_whole(args, "tier", 1.0, LRCS_HOST_KIT_TIERS, &options.tier);
    if (code != 0) {
        return code;
    }
    if (lrcs_host_kit_write(folder, &options, &size, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    cli_watch_end();
    printf("%s: kit %d, %lu scenes, %lu cases; begin with %s/README.md\n", folder,
           LRCS_HOST_KIT_VERSION, (unsigned long)size.scenes, (unsigned long)size.cases, folder);
    return CLI_DONE;
}

const cli_command cli_vectors_command = {
    "vectors",       "DIR", "give the folder that the kit goes to", vectors_help, vectors_options,
    vectors_command, NULL};
