/* SPDX-License-Identifier: MIT */
/* What the commands share: the exit codes, the parsed command line, and the messages about it. The
   tool uses only the public headers. */
#ifndef LRCS_CLI_H
#define LRCS_CLI_H

#include <lrcs/constant.h>
#include <lrcs/picture.h>

enum cli_exit {
    CLI_DONE = 0,
    CLI_FAILED = 1,
    CLI_USAGE = 2,
    CLI_DEGRADED = 3 /* done, but the tolerance was not met, memory forced a fallback, or readings
                        leave a parameter undetermined */
};

/* The version of the JSON schema that --json states. */
#define CLI_SCHEMA 1

/* The most threads that --jobs may ask for; a sweep starts no more (host/sweep/sweep.c). */
#define CLI_JOBS_MOST 1024.0

/* The pose options, which cli_pose_read reads, for a help text and for an option list. */
#define CLI_POSE_HELP                                                                              \
    "pose: one of these; without any, the laser is on the +z axis\n"                               \
    "  --direction x,y,z     direction to the laser in the body frame, of any length\n"            \
    "  --azel AZ,EL          azimuth AZ from +x towards +y, elevation EL towards +z, deg: the\n"   \
    "                        direction (cos EL cos AZ, cos EL sin AZ, sin EL). Beyond 90 deg\n"    \
    "                        EL goes on over the pole: 30,100 is 210,80\n"                         \
    "  --euler SEQ:a,b,c     angles, deg; XYZ intrinsic: R = Rx(a) Ry(b) Rz(c); xyz extrinsic\n"   \
    "  --quaternion w,x,y,z  rotation from the body to the observation frame: x right, y up, z\n"  \
    "                        to the laser (of a direction: by the shortest rotation)\n"
#define CLI_POSE_OPTIONS                                                                           \
    {"direction", 1, 0}, {"azel", 1, 0}, {"euler", 1, 0},                                          \
    {                                                                                              \
        "quaternion", 1, 0                                                                         \
    }

/* The options for a run's accuracy (cli_accuracy_read, cli_normals_read) and for reading a scene
   (cli_scene_options_read), likewise. */
#define CLI_ACCURACY_HELP                                                                          \
    "  --tolerance REL       relative error that is allowed (default 1e-4; if --method is\n"       \
    "                        given, there is no tolerance unless REL is given too). Exit 3 if\n"   \
    "                        the bound, or the estimated error of curved normals, exceeds it\n"    \
    "  --accept WHAT         what must meet the tolerance: bound (default): the proved bound;\n"   \
    "                        estimate: the bound, or the estimated error of a raster; any:\n"      \
    "                        nothing, the first answer is accepted\n"                              \
    "  --method M            auto (default), facet, zbuffer or exact\n"                            \
    "  --resolution N        a raster of N x N samples (default: chosen from the tolerance)\n"     \
    "  --normals N           flat (default); smooth: curved normals, from smoothing groups and\n"  \
    "                        vertex normals; auto: curved only where flat facets are too coarse\n" \
    "                        for their glint\n"
#define CLI_ACCURACY_OPTIONS                                                                       \
    {"tolerance", 1, 0}, {"accept", 1, 0}, {"method", 1, 0}, {"resolution", 1, 0},                 \
    {                                                                                              \
        "normals", 1, 0                                                                            \
    }
#define CLI_SCENE_HELP                                                                             \
    "  --unit U              unit of a model: mm, cm, m (default), in, ft or metres per unit\n"    \
    "  --material [WHAT=]BRDF  a BRDF for some materials; repeatable. WHAT is the name of a\n"     \
    "                        material, in which * and ? are wildcards, or a colour '#RRGGBB';\n"   \
    "                        without it, all other materials. BRDF is A,B,s,m (A, B in 1/sr),\n"   \
    "                        each with or without +-DEVIATION, or the name of a library\n"         \
    "                        material\n"                                                           \
    "  --two-sided WHAT      what reflects from both sides: all, open (surfaces that are not\n"    \
    "                        closed), a part or a material\n"                                      \
    "  --keep-transparent    keeps facets that the file declares fully transparent\n"
#define CLI_SCENE_OPTIONS                                                                          \
    {"unit", 1, 0}, {"material", 1, 1}, {"two-sided", 1, 0},                                       \
    {                                                                                              \
        "keep-transparent", 0, 0                                                                   \
    }

/* What an option takes, if it is not nothing (0) or a value (1): the name of a file to write, of
   any kind; or that of a chart, FILE.svg or FILE.png. */
#define CLI_FILE  2
#define CLI_CHART 3

typedef struct cli_option {
    const char *name; /* without its dashes (a name of one letter has one dash, others have two);
                         NULL ends a list */
    int has_value;    /* 0, 1, CLI_FILE or CLI_CHART */
    int repeats;
} cli_option;

typedef struct cli_args cli_args;

typedef struct cli_command {
    const char *name;
    const char *operand; /* the operands, given without an option name: "SCENE", or "FILE..." if
                            several are allowed; NULL for none */
    const char *operand_hint;
    const char *help;
    const cli_option *option;
    int (*run)(const cli_args *args);
    const char *help_more; /* the rest of a long help text (C compilers need accept only 4095
                              characters in one literal); or NULL */
} cli_command;

typedef struct cli_given {
    const char *name;
    const char *value; /* NULL for an option without a value */
} cli_given;

struct cli_args {
    const cli_command *command;
    const char *operand;
    cli_given *given; /* in the order given */
    int given_count;
};

/* Parses the words after the command's name. Returns 0, or CLI_USAGE with the message printed. The
   caller frees args->given in any case. */
int cli_args_read(const cli_command *command, int count, char **word, cli_args *args);

/* The prefix of an option's name: two dashes, or one before a single letter. */
const char *cli_dashes(const char *name);

/* The value of an option ("" if it takes none), or NULL if it was not given. */
const char *cli_value(const cli_args *args, const char *name);

/* Reads an option's number, which is unchanged if the option was not given. 0 or CLI_USAGE. */
int cli_number(const cli_args *args, const char *name, double *value);

/* The same for a number > 0; `what` says so in a message: "a time > 0". */
int cli_positive(const cli_args *args, const char *name, const char *what, double *value);

/* The same for a whole number from `least` to `most`. */
int cli_whole(const cli_args *args, const char *name, double least, double most, uint32_t *value);

/* Reads an option with one of several words, "a, b or c": its place among them, unchanged if the
   option was not given. 0 or CLI_USAGE. */
int cli_choice(const cli_args *args, const char *name, const char *words, int *place);

/* Messages on stderr: "lrcs: TEXT" is why a command fails, or why its exit code is 3; "notice:
   TEXT" is worth knowing and changes no exit code; "wrote FILE" names an output. */

/* Prints "lrcs: TEXT", and how to get help. Returns CLI_USAGE. */
__attribute__((format(printf, 2, 3))) int cli_usage(const cli_command *command, const char *format,
                                                    ...);

/* The same for the value of an option: "--NAME: expected WHAT, found 'VALUE'". */
int cli_expected(const cli_args *args, const char *name, const char *what);

/* Prints "lrcs: TEXT", also for an error or lack of memory. Returns CLI_FAILED. */
__attribute__((format(printf, 1, 2))) int cli_fail(const char *format, ...);
int cli_failed(const lrcs_host_error *error);

/* Prints "lrcs: TEXT", why an answer is not what was asked for. Returns CLI_DEGRADED. */
__attribute__((format(printf, 1, 2))) int cli_degraded(const char *format, ...);
int cli_out_of_memory(void);

/* Ends a command: CLI_FAILED with a message if stdout could not be written, else `code`. */
int cli_finish(int code);

/* The pose that the options specify; 0 or CLI_USAGE. */
int cli_pose_read(const cli_args *args, lrcs_pose *pose);

/* Its direction to the laser: a unit vector; azimuth and elevation, deg. */
void cli_pose_unit(const lrcs_pose *pose, double s_hat[3]);
void cli_pose_azel(const lrcs_pose *pose, double azel_deg[2]);

/* --tolerance, --accept, --method and --resolution; --normals. 0 or CLI_USAGE. */
int cli_accuracy_read(const cli_args *args, lrcs_run_options *options);
int cli_normals_read(const cli_args *args, lrcs_host_options *load);

/* Sets how a scene is read for a run with these options: its curved shapes are divided as finely as
   each pose needs. */
void cli_division_set(const lrcs_run_options *options, lrcs_host_options *load);

/* 1 if a tolerance applies: under auto, and whenever one is given. Otherwise no tolerance can be
   missed. */
int cli_tolerance_judged(const cli_args *args, const lrcs_run_options *options);

/* By what criterion an answer was accepted: "bound", "estimate", "any"; NULL if it missed its
   tolerance. */
const char *cli_accepted_by(uint32_t flags);

/* Prints a line if an answer was accepted without a proof. */
void cli_accepted_print(FILE *out, uint32_t flags);

/* The flags of a result, without that of a missed tolerance if no tolerance applies; and the exit
   code for them, CLI_DONE or CLI_DEGRADED with the message printed. */
uint32_t cli_flags_in_force(const cli_args *args, const lrcs_run_options *options, uint32_t flags);
int cli_accuracy_code(const cli_args *args, const lrcs_run_options *options, uint32_t flags);

/* Reads four numbers A,B,s,m or the name of a library material; 0 or CLI_USAGE. `option` is for
   messages. */
int cli_brdf_read(const cli_command *command, const char *text, const char *option,
                  lrcs_brdf *brdf);

/* The library material that has these numbers; NULL if there is none. */
const lrcs_brdf_entry *cli_brdf_entry(const lrcs_brdf *brdf);

/* Prints a notice for each warning about a BRDF, as of a material of that name. */
void cli_brdf_warnings_print(const char *name, const lrcs_brdf *brdf);

/* A colour as "#RRGGBB"; returns the text. */
#define CLI_COLOUR_TEXT 8
const char *cli_colour_text(const unsigned char rgb[3], char text[CLI_COLOUR_TEXT]);

/* Reads the scene options shared by run and info: --material (repeatable), --unit,
   --keep-transparent. The caller frees the bindings' array and names (cli_scene_options_free). */
int cli_scene_options_read(const cli_args *args, lrcs_host_options *options);
void cli_scene_options_free(lrcs_host_options *options);

/* Reads the command's scene: 0, or CLI_FAILED or CLI_USAGE with the message printed. A --material
   that matches no facet is a usage error. cli_scene_code returns the same code for a scene that was
   read elsewhere with `status` and `error`. */
int cli_scene_read(const cli_args *args, const lrcs_host_options *options, lrcs_host_scene *scene);
int cli_scene_code(const cli_args *args, const lrcs_host_options *options, int status,
                   const lrcs_host_error *error, const lrcs_host_scene *scene);

/* A unit of length (lrcs_host_input.unit_m) in words: "mm", .., metres per unit, "m assumed", or
   NULL for none. The unit of the scene's own coordinates: the one given for a model file, NULL if
   none was; "m" for scene files and demo. */
#define CLI_UNIT_TEXT 32
const char *cli_unit_text(double unit_m, char text[CLI_UNIT_TEXT]);
const char *cli_scene_unit(const cli_args *args, const lrcs_host_scene *scene);

/* lrcs_host_scene_prepare; lrcs_host_scene_run. 0, or CLI_FAILED with the message printed. */
int cli_scene_prepare(lrcs_host_scene *scene);
int cli_scene_run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                  const lrcs_run_options *options, lrcs_result *result, lrcs_facet_record *records,
                  lrcs_image *image, double *seconds);

/* ---- what a result was made from ---- */

/* The title of the scene, or the operand if it has none. */
const char *cli_scene_title(const cli_args *args, const lrcs_host_scene *scene);

/* The same with the operand without its folders, for people. */
const char *cli_scene_name(const cli_args *args, const lrcs_host_scene *scene);

/* Prints the scene for people: its title, and in brackets the file, if the title does not name
   it. */
void cli_scene_print(const cli_args *args, const lrcs_host_scene *scene);

/* The origin of a material's numbers: "given", "illustrative" or "published" (in the library),
   "default", or "assumed" (the scene file says so). */
const char *cli_material_source(const lrcs_material *material);

/* 1 if a scene file assigns the material and marks its numbers as assumed, be they default ones or
   not. */
int cli_material_guessed(const lrcs_material *material);

/* 1 if some material states errors; 1 if the numbers of some are illustrative or default. */
int cli_errors_stated(const lrcs_scene *scene);
int cli_materials_assumed(const lrcs_scene *scene);

/* A path without its folders. */
const char *cli_base_name(const char *path);

/* The beginning of the first line of a table, after "# ": "lrcs VERSION COMMAND; key=text; ..". The
   caller ends the line. */
void cli_table_head(FILE *out, const cli_args *args, const char *title,
                    const lrcs_host_scene *scene, const double direction[3]);

/* Writes `before` as it is, and a text with its control characters as '?': it stays one line. */
void cli_line_put(FILE *out, const char *before, const char *text);

/* A file as such lines name it: its last name, the hash of its bytes, and the unit of its lengths.
 */
#define CLI_FILE_TEXT 384
void cli_file_text(const lrcs_host_input *input, char text[CLI_FILE_TEXT]);

/* What a writer writes, as a text that the caller frees; NULL without memory. */
typedef void cli_text_writer(FILE *out, const void *context);
char *cli_text_of(cli_text_writer *write, const void *context);

/* Keys of the object that is open: A, B, s, m of a BRDF; the schema and the version; the hash of
   the scene; its files; the operand as "files"; the options that were given; the direction to the
   laser; all of a scene: files, title, materials and options. */
void cli_brdf_json(const lrcs_brdf *brdf, lrcs_host_json *json);
void cli_version_json(lrcs_host_json *json);
void cli_hash_json(uint64_t hash, lrcs_host_json *json);
void cli_files_json(const lrcs_host_scene *scene, lrcs_host_json *json);
void cli_operand_json(const cli_args *args, lrcs_host_json *json);
void cli_options_json(const cli_args *args, lrcs_host_json *json);
void cli_direction_json(const lrcs_pose *pose, lrcs_host_json *json);
void cli_provenance_json(const cli_args *args, const lrcs_host_scene *host, lrcs_host_json *json);

/* What a picture states that it was made from, as a text that the caller frees; NULL without
   memory. Without a scene (NULL) it names the operand as the file. */
char *cli_provenance_text(const cli_args *args, const lrcs_host_scene *scene);

/* Writes what a file of numbers was made from, and the hash of that file, to a file beside it,
   because its format has no place for that: PATH.json. Nothing is written beside standard output or
   a device. scene, pose, and about (the first line that a table would have) may be NULL. 0 or
   CLI_FAILED. cli_beside_name: the name of that file, which the caller frees; NULL without memory.
 */
#define CLI_BESIDE ".json"
#define CLI_ABOUT  "about"
int cli_provenance_beside(const cli_args *args, const char *path, const lrcs_host_scene *scene,
                          const lrcs_pose *pose, const char *about);
char *cli_beside_name(const char *path);

/* The name of a scene's material as it is printed: "(default)" if it has none. */
const char *cli_material_name(const lrcs_material *material);

/* A value >= 0 as it is, or NAN, which no output shows as a number, for one that is not known. */
double cli_known(double value);

/* A value as tables for people show it: 0 where it has underflowed, below 1e-30. */
double cli_shown(double value);

/* A part of a whole in per cent; 0 if the whole is 0. */
double cli_percent(double part, double whole);

/* The value in dBsm of a sigma > 0. */
double cli_dbsm(double sigma_m2);

/* A character of a text that stays on its line: "?" for a control character. */
#define CLI_PLAIN(c) ((unsigned char)(c) < 0x20 || (c) == 0x7f ? '?' : (c))

/* Prints text on stdout, padded with blanks to `width`; control characters are printed as '?'. */
void cli_column(const char *text, int width);
void cli_column_to(FILE *out, const char *text, int width); /* the same on `out` */

/* Seconds on a monotonic clock. */
double cli_seconds(void);

/* Shows the stage of a command that takes more than two seconds, on stderr if that is a terminal,
   and says what remains after a Ctrl-C. Every command is watched from its start.
   cli_watch_stage names a stage by a text that stays valid; with a scene that is being prepared,
   the number of completed stages is shown too. NULL shows nothing, because something else is shown.
   cli_watch_count reports how many parts of the work are done; cli_watch_run lets a run report its
   progress (lrcs_run_options.progress). A command ends the watch before it prints. */
void cli_watch_begin(const char *stage);
void cli_watch_stage(const char *stage, const lrcs_host_scene *scene);
void cli_watch_clear(void); /* call before a line is printed to stderr; the watch continues */
void cli_watch_count(uint64_t done, uint64_t total);
lrcs_progress *cli_watch_run(void);
void cli_watch_end(void);

/* A progress bar with the remaining time, on stderr if that is a terminal. */
typedef struct cli_progress {
    int on;
    uint64_t first, total;
    double begun, shown; /* s */
} cli_progress;

cli_progress cli_progress_make(uint64_t first, uint64_t total);
void cli_progress_show(cli_progress *progress, uint64_t done);
void cli_progress_clear(const cli_progress *progress);

/* Prints "notice: ..." for each notice, on `out`; or as the items of an open array. */
void cli_notices_print(FILE *out, const lrcs_host_notices *notices);
void cli_notices_json(const lrcs_host_notices *notices, lrcs_host_json *json);

/* The lowest of some flags, as lrcs_flag_text and lrcs_notice_text take it; bits &= bits - 1 leaves
   the others. */
#define CLI_LOWEST(bits) ((int)((bits) & ~((bits)-1u)))

/* The flags of a result as the array "flags". */
void cli_flags_json(lrcs_host_json *json, uint32_t flags);

/* 1 if a path ends with the extension, in upper or lower case, and has a character before it. */
int cli_extension(const char *path, const char *extension);

/* 1 if an option names a file to write. */
int cli_is_output(const cli_command *command, const char *option);

/* Prints on stderr the names of the files that were written, for a command whose report does not
   name them; but not that of the option `kept` (or NULL), whose file was there. */
void cli_outputs_print(const cli_args *args, const char *kept);

/* Checks before the work the files named by options, for every command: charts are FILE.svg or
   FILE.png; no two are the same file; one that is standard output is not beside --json; none is a
   folder, and each lies in a writable folder. 0, CLI_USAGE or CLI_FAILED with the message printed.
 */
int cli_outputs_check(const cli_args *args);

/* Checks that none of them would replace a file that the scene was read from; or an input, `what`
   in a message: "the readings". 0 or CLI_USAGE. */
int cli_outputs_spare(const cli_args *args, const lrcs_host_scene *scene);
int cli_outputs_spare_input(const cli_args *args, const char *input, const char *what);

/* Writes what the laser sees as PNG, with what it was made from. Status: as lrcs_host_picture_png.
 */
int cli_picture_write(FILE *out, const lrcs_host_picture *picture, const lrcs_image *image,
                      uint32_t size, const cli_args *args, const lrcs_host_scene *scene,
                      lrcs_host_error *error);

/* Writes a file atomically: it appears complete or not at all. 0 or CLI_FAILED with the message
   printed. */
typedef int cli_writer(FILE *out, const void *context, lrcs_host_error *error);
int cli_output_write(const char *path, cli_writer *write, const void *context);

/* The same for a writer of text, which cannot fail. */
int cli_text_write(const char *path, cli_text_writer *write, const void *context);

/* Draws a chart on an open file, as PNG or SVG. Such a writer draws a file, by its extension; or
   every file that a repeatable option names. 0 or CLI_FAILED with the message printed. */
typedef int cli_chart_writer(FILE *out, const void *context, int png, lrcs_host_error *error);
int cli_chart_write(const char *path, cli_chart_writer *draw, const void *context);
int cli_charts_write(const cli_args *args, const char *option, cli_chart_writer *draw,
                     const void *context);

/* The chart writer whose context is an lrcs_host_chart. */
cli_chart_writer cli_chart_put;

/* The range of picture sizes, in pixels. */
#define CLI_PICTURE_LEAST   16.0
#define CLI_PICTURE_MOST    4096.0
#define CLI_PICTURE_DEFAULT 512u

/* The commands. */
extern const cli_command cli_run_command;
extern const cli_command cli_image_command;
extern const cli_command cli_profile_command;
extern const cli_command cli_info_command;
extern const cli_command cli_shape_command;
extern const cli_command cli_verify_command;
extern const cli_command cli_converge_command;
extern const cli_command cli_sweep_command;
extern const cli_command cli_merge_command;
extern const cli_command cli_plot_command;
extern const cli_command cli_fit_command;
extern const cli_command cli_report_command;
extern const cli_command cli_vectors_command;
extern const cli_command cli_compare_command;
extern const cli_command cli_scene_command;

#endif
