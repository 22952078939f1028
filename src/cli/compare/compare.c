/* SPDX-License-Identifier: MIT */
/* lrcs compare: judges another implementation's answers to a kit case by case, and explains the
   differences. */
#include "cli/compare/compare.h"

#include <string.h>

#define PIXELS      512u    /* side of the raster if none is given */
#define PIXELS_MOST 65536.0 /* far more than any raster has */

static const char compare_help[] =
    "usage: lrcs compare DIR THEIRS.csv [options]\n"
    "\n"
    "Judges the answers of another implementation to the kit in DIR (lrcs vectors). The first\n"
    "line of THEIRS.csv names its columns: scene, attitude, and sigma_m2 or sigma_dbsm. Each\n"
    "case falls into a class: exact, float (single precision), raster (N x N pixels) or fail;\n"
    "DIR/README.md says what errors they allow. If cases fail, compare computes what a code\n"
    "with a certain mistake would have answered, and names the mistakes that explain the\n"
    "failures. Facets and images explain too; the verdict depends on sigma alone.\n"
    "\n"
    "options\n"
    "  --tier K              judges tiers 1 .. K (default 5)\n"
    "  --class C             requires that class or better: exact, float, raster (default)\n"
    "  --pixels N            side of their raster, for class raster (default 512)\n"
    "  --facets FILE.csv     their scene, attitude, facet, visible_area_m2 and optionally\n"
    "                        cos_theta: names the facets that differ\n"
    "  --items DIR           their item images, NAME.ATTITUDE.item.u32 as in the kit: finds\n"
    "                        images that are mirrored or rotated, shifted numbers, facets that\n"
    "                        are lost or shown although hidden\n"
    "  --json FILE           everything as JSON, every case ('-': on standard output, instead\n"
    "                        of the table)\n"
    "  --junit FILE.xml      JUnit XML: a test suite for each tier, a test case for each case\n"
    "                        ('-' likewise)\n"
    "\n"
    "Exit: 0 if every case of these tiers was answered and passed, otherwise 1.\n"
    "\n"
    "examples\n"
    "  lrcs compare kit theirs.csv --tier 1\n"
    "  lrcs compare kit theirs.csv --pixels 1024 --facets facets.csv --junit kit.xml\n";

static const cli_option compare_options[] = {
    {"tier", 1, 0},         {"class", 1, 0}, {"pixels", 1, 0},
    {"facets", 1, 0},       {"items", 1, 0}, {"json", CLI_FILE, 0},
    {"junit", CLI_FILE, 0}, {"help", 0, 0},  {NULL, 0, 0}};

/* ---- options ---- */

/* Reads the options and the two operands, and checks that no output replaces a file that is read.
 */
static int compare_options_read(compare_job *job, const char **folder)
{
    const cli_args *args = job->args;
    const char *name[2] = {NULL, NULL};
    int count = 0;
    for (int i = 0; i < args->given_count; i++) {
        if (args->given[i].name[0] == '\0') {
            name[count < 2 ? count : 1] = args->given[i].value;
            count++;
        }
    }
    if (count != 2) {
        return cli_usage(args->command, "expected a kit's folder and one table, found %d operand%s",
                         count, count == 1 ? "" : "s");
    }
    *folder = name[0];
    job->theirs = name[1];
    lrcs_host_judgement *judgement = &job->judgement;
    judgement->tier = LRCS_HOST_KIT_TIERS;
    judgement->pixels = PIXELS;
    judgement->grade = LRCS_HOST_GRADE_RASTER;
    job->facets = cli_value(args, "facets");
    job->items = cli_value(args, "items");
    int code = cli_whole(args, "tier", 1.0, LRCS_HOST_KIT_TIERS, &judgement->tier);
    code = code ? code : cli_whole(args, "pixels", 2.0, PIXELS_MOST, &judgement->pixels);
    code = code ? code : cli_choice(args, "class", "exact, float or raster", &judgement->grade);
    code = code ? code : cli_outputs_spare_input(args, job->theirs, "what is to be judged");
    return code == 0 && job->facets
               ? cli_outputs_spare_input(args, job->facets, "what is to be judged")
               : code;
}

/* ---- the command ---- */

void cli_compare_tier(const lrcs_host_judgement *judgement, uint32_t tier, unsigned long *cases,
                      unsigned long *failed)
{
    *cases = *failed = 0;
    for (uint32_t i = 0; i < judgement->kit.cases; i++) {
        const compare_case *one = &judgement->kit.list[i];
        *cases += (uint32_t)one->tier == tier;
        *failed += (uint32_t)one->tier == tier && lrcs_host_judge_failed(judgement, one);
    }
}

static int compare_make(compare_job *job, const char *folder)
{
    lrcs_host_error error;
    lrcs_host_judgement *judgement = &job->judgement;
    cli_watch_stage("the kit", NULL);
    int status = lrcs_host_kit_read(folder, &judgement->kit, &error);
    cli_watch_stage("verdicts", NULL);
    status = status == LRCS_OK ? lrcs_host_judge(judgement, job->theirs, &error) : status;
    cli_watch_stage("causes", NULL);
    status = status == LRCS_OK ? lrcs_host_judge_explain(judgement, &error) : status;
    if (status == LRCS_OK && job->facets) {
        cli_watch_stage("facets", NULL);
        status = lrcs_host_judge_facets(judgement, job->facets, &error);
    }
    if (status == LRCS_OK && job->items) {
        cli_watch_stage("item buffers", NULL);
        status = lrcs_host_judge_items(judgement, job->items, &error);
    }
    cli_watch_end();
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

static int compare_command(const cli_args *args)
{
    compare_job job;
    const char *folder = NULL;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = compare_options_read(&job, &folder);
    code = code ? code : compare_make(&job, folder);
    const char *json = cli_value(args, "json");
    const char *junit = cli_value(args, "junit");
    code = code == 0 && json ? cli_text_write(json, cli_compare_json, &job) : code;
    code = code == 0 && junit ? cli_text_write(junit, cli_compare_junit, &job) : code;
    if (code == 0 && !(json && strcmp(json, "-") == 0) && !(junit && strcmp(junit, "-") == 0)) {
        cli_compare_table(&job);
    }
    code = code ? code : lrcs_host_judge_passed(&job.judgement) ? CLI_DONE : CLI_FAILED;
    lrcs_host_kit_free(&job.judgement.kit);
    return code;
}

const cli_command cli_compare_command = {
    "compare",    "DIR THEIRS.csv...", "give a kit's folder and a table of answers to it",
    compare_help, compare_options,     compare_command,
    NULL};
