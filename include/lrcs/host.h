/* SPDX-License-Identifier: MIT */
/* The host layer: files, memory, notices, pictures and writers around the core. It may use the
   heap and stdio. It never prints on its own and never exits: an error is reported as a status and
   a sentence. Flight software does not need it: the core works without it. */
#ifndef LRCS_HOST_H
#define LRCS_HOST_H

#include <lrcs/emulate.h>
#include <lrcs/fit.h>
#include <lrcs/lrcs.h>

#include <stdio.h>

/* The operating system refused: a file, a folder, memory. Beside the codes of lrcs/status.h. */
#define LRCS_E_SYSTEM (-64)

/* One sentence: the file, the place in it, what was found and what was expected. Every function
   below that takes one fills it when it fails; it may be NULL. */
typedef struct lrcs_host_error {
    char text[1024];
} lrcs_host_error;

/* ---- numbers ---- */

/* Room for any double as text. */
#define LRCS_HOST_NUMBER_SIZE 32

/* A double as decimal text with 17 significant digits ("%.17g"), with a decimal point in every
   locale. */
void lrcs_host_number_text(double value, char text[LRCS_HOST_NUMBER_SIZE]);

/* Reads decimal text that consists of one finite number; blanks around it are allowed.
   Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_NUMBER (beyond double range). */
int lrcs_host_number_read(const char *text, size_t size, double *value);

/* ---- names ---- */

/* How far a name is from what was typed: 0 if it begins with the text, else the number of edits
   (letters added, dropped, replaced, neighbours swapped) in the first 64 bytes. */
unsigned lrcs_host_name_distance(const char *text, const char *name);

/* The names most like what was typed, best first, each once: those that contain the text or are
   contained in it, then those with the fewest edits, upper and lower case alike.
   Given: name[count]; most, the size of `near`. Returned: near, pointers into name; how many. */
uint32_t lrcs_host_names_near(const char *text, const char *const *name, uint32_t count,
                              const char **near, uint32_t most);

/* ---- files ---- */

typedef struct lrcs_host_file {
    unsigned char *bytes; /* never NULL once read */
    size_t size;
} lrcs_host_file;

/* A whole file in memory. Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT (above 16 GiB). */
int lrcs_host_file_read(const char *path, lrcs_host_file *file, lrcs_host_error *error);
void lrcs_host_file_free(lrcs_host_file *file);

/* A file being written. It appears under its name only when it is complete: until then it is a
   temporary file in the same folder. "-" is standard output; a device or pipe is written
   directly. */
typedef struct lrcs_host_output {
    FILE *stream;
    char *path;      /* final name, links followed; NULL: standard output */
    char *temporary; /* NULL: written directly */
} lrcs_host_output;

/* Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_output_open(const char *path, lrcs_host_output *output, lrcs_host_error *error);

/* Closes the output: keeps the file, or removes it if keep is 0 or a write failed.
   Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_output_close(lrcs_host_output *output, int keep, lrcs_host_error *error);

/* ---- scenes ---- */

/* A list of sentences, owned. */
typedef struct lrcs_host_notices {
    char **text;
    uint32_t count;
} lrcs_host_notices;

typedef struct lrcs_host_options {
    double unit_m;               /* metres per unit of a model file; 0: not given, 1 m */
    int keep_transparent;        /* do not leave out fully transparent facets */
    const char *two_sided;       /* what reflects from both sides in addition to what files state:
                                    "all"; "open": surfaces that are not closed; the name of a
                                    part, object or material; NULL: nothing */
    const lrcs_binding *binding; /* from the command line: kinds NAME, COLOUR, DEFAULT */
    uint32_t binding_count;
    lrcs_build_options build;
} lrcs_host_options;

lrcs_host_options lrcs_host_options_default(void);

/* A regular file that a scene was read from: its name, the FNV-1a hash of its bytes, and its device
   and inode number. */
typedef struct lrcs_host_input {
    const char *path;
    uint64_t hash, device, node;
    struct lrcs_host_input *next;
} lrcs_host_input;

/* The stages of preparing a scene, and of a pose. */
enum lrcs_host_prepare_stage {
    LRCS_HOST_PREPARE_EDGES,      /* checks; points welded; edges */
    LRCS_HOST_PREPARE_NEIGHBOURS, /* coincident facets; which facet lies across each side */
    LRCS_HOST_PREPARE_CONTACTS,   /* between facets; is the scene closed and outward? */
    LRCS_HOST_PREPARE_NORMALS,
    LRCS_HOST_PREPARE_PROOFS, /* convex, what is near curved shapes */
    LRCS_HOST_PREPARE_STAGES
};
enum lrcs_host_pose_stage {
    LRCS_HOST_POSE_VIEW,
    LRCS_HOST_POSE_CLASSIFY, /* facets seen whole or not at all, and undecided ones */
    LRCS_HOST_POSE_VISIBILITY,
    LRCS_HOST_POSE_SUM,
    LRCS_HOST_POSE_STAGES
};

/* A scene with everything that it owns. Set it to zero before the first read; always free it. */
typedef struct lrcs_host_scene {
    lrcs_recipe recipe;
    lrcs_mesh *model; /* one for each part of the recipe; all zero for shapes */
    lrcs_scene scene;
    const lrcs_prepared *prepared; /* NULL until prepared */
    lrcs_host_notices notices;
    lrcs_host_input *input; /* every file read, the last one first; NULL: none */
    const char *two_sided;  /* as in lrcs_host_options, which must outlive the scene */
    double seconds_load, seconds_prepare;
    double seconds_stage[LRCS_HOST_PREPARE_STAGES]; /* of seconds_prepare, in the last attempt,
                                                       whose work area sufficed */
    void *blocks;                                   /* memory owned */
} lrcs_host_scene;

/* Loads a scene: a model file (3DS, OBJ with its MTL, STL), a scene file, or "demo", which is
   built in. Paths of model files in a scene file are relative to the scene file's folder; a
   material file is read from the folder of its OBJ file.
   NAME and MAP_NAME bindings: a name that no material has may stand for several, which replace it
   in scene->recipe.binding: with * (any characters) and ? (one character), or else, with a notice,
   in letters of the other case (A to Z). Full names take precedence over names that differ in
   case, and these over patterns.
   Returned: scene->scene, and notices about what was found. The caller decides whether
   scene.unmatched is an error: it indexes scene->recipe.binding.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_ARGUMENT (a unit for a scene file, which states its
   own); LRCS_E_NAME (two_sided: no such part or material); as lrcs_3ds_read, lrcs_recipe_read and
   lrcs_scene_build. */
int lrcs_host_scene_read(const char *path, const lrcs_host_options *options, lrcs_host_scene *scene,
                         lrcs_host_error *error);

/* Builds a scene from a recipe that has only shapes. Only the recipe's strings must outlive the
   scene; scene->recipe stays empty. Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_scene_build. */
int lrcs_host_scene_make(const lrcs_recipe *recipe, const lrcs_build_options *build,
                         lrcs_host_scene *scene, lrcs_host_error *error);

/* Builds a variant of a scene. The recipe has the parts of base->recipe, in their order and with
   their models; parts are two-sided where those of base are. Everything else may differ: places,
   joints, shapes, materials. `base` and the recipe's strings must outlive the scene; scene->recipe
   stays empty.
   Status: as lrcs_host_scene_make. */
int lrcs_host_scene_vary(const lrcs_host_scene *base, const lrcs_recipe *recipe,
                         const lrcs_build_options *build, lrcs_host_scene *scene,
                         lrcs_host_error *error);

/* Checks that writing `path` would not replace a file that the scene was read from, under any name
   or link. Status: LRCS_OK; LRCS_E_ARGUMENT: it would; the sentence names both files. */
int lrcs_host_output_check(const char *path, const lrcs_host_scene *scene, lrcs_host_error *error);

/* 1 if two output paths refer to the same file, whether it exists or not; else 0. */
int lrcs_host_output_same(const char *path, const char *other);

/* The bounding box of all facets that are not omitted, m, body frame; all zero if there are none.
 */
void lrcs_host_scene_box(const lrcs_scene *scene, double least[3], double most[3]);

/* Prepares a scene, once for all poses: lrcs_prepare_run with memory from the heap.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_prepare_run. */
int lrcs_host_scene_prepare(lrcs_host_scene *scene, lrcs_host_error *error);

/* sigma of a prepared scene for a pose: lrcs_sigma_run with memory from the heap. If the heap
   cannot provide enough, a smaller work area is tried, and result->flags says so.
   Returned: result; records and image unless NULL; seconds unless NULL.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_sigma_run. */
int lrcs_host_scene_run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                        const lrcs_run_options *options, lrcs_result *result,
                        lrcs_facet_record *records, lrcs_image *image, double *seconds,
                        lrcs_host_error *error);

/* lrcs_uncertainty_run and lrcs_attitude_slope_run with memory from the heap.
   Returned: result; sensitivity[material_count]; uncertainty; and slope.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_uncertainty_run and lrcs_attitude_slope_run. */
int lrcs_host_scene_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                const lrcs_run_options *options,
                                const lrcs_uncertainty_options *how, lrcs_result *result,
                                lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                                lrcs_host_error *error);
int lrcs_host_scene_attitude_slope(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                   const lrcs_run_options *options, lrcs_attitude_slope *slope,
                                   lrcs_host_error *error);

/* Runs a pose up to a stage (lrcs_host_pose_stage) and discards the results, to measure the time of
   single stages. options->method must not be AUTO, which may run stages more than once.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_ARGUMENT (the method or the stage); as lrcs_sigma_run. */
int lrcs_host_scene_run_until(const lrcs_host_scene *scene, const lrcs_pose *pose,
                              const lrcs_run_options *options, int stage, lrcs_host_error *error);

/* The same pose as graphics hardware computes it: lrcs_emulate_run with memory from the heap.
   Returned: emulation; records unless NULL; seconds unless NULL. Status: LRCS_OK; LRCS_E_SYSTEM; as
   lrcs_emulate_run. */
int lrcs_host_scene_emulate(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            const lrcs_emulation_options *options, lrcs_emulation *emulation,
                            lrcs_facet_record *records, double *seconds, lrcs_host_error *error);

void lrcs_host_scene_free(lrcs_host_scene *scene);

/* The visible polygons of a pose, in memory of their own: lrcs_polygon_run, and its release.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_polygon_run. */
typedef struct lrcs_host_polygons {
    lrcs_polygons list;
    void *blocks; /* memory owned */
} lrcs_host_polygons;
int lrcs_host_polygons_make(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            lrcs_host_polygons *polygons, lrcs_host_error *error);
void lrcs_host_polygons_free(lrcs_host_polygons *polygons);

/* The range profile of a pose, in memory of its own: lrcs_profile_run, and its release.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_profile_run. */
typedef struct lrcs_host_profile {
    lrcs_profile list;
    void *blocks; /* memory owned */
} lrcs_host_profile;
int lrcs_host_profile_make(const lrcs_host_scene *scene, const lrcs_pose *pose, double bin_m,
                           lrcs_host_profile *profile, lrcs_host_error *error);
void lrcs_host_profile_free(lrcs_host_profile *profile);

/* Whether the mesh of a curved body is fine enough for the glint of its material. An ESTIMATE. The
   turn is the median angle between neighbouring facets that share a smoothing group; in a scene
   built with curved normals, for facets in no group, between the normals at their corners; for
   engine shapes, twice the proved turn. The error is that of a cylinder of such facets at
   broadside: (dphi/2)^2 / 6 for the chords and 2 exp(-(pi s / dphi)^2) for the comb (the ripple
   of the sum over discrete normals). */
typedef struct lrcs_host_glint {
    uint32_t part, material; /* of the scene */
    double s;                /* the material's slope */
    double turn;             /* dphi, rad */
    double error;            /* relative, at the worst aspect, an estimate */
    double around_1_percent; /* facets per full turn needed for an error of 1 % and of 0.1 % */
    double around_01_percent;
} lrcs_host_glint;

/* A part with a larger error is too coarse for the glint of its material. */
#define LRCS_HOST_GLINT_COARSE 1e-2

/* Lists them, ordered by part and material, in an array that the caller frees.
   Status: LRCS_OK; LRCS_E_SYSTEM (memory). */
int lrcs_host_glint_check(const lrcs_scene *scene, lrcs_host_glint **list, uint32_t *count,
                          lrcs_host_error *error);

/* The glint of one pose that comes from facets too coarse for it. */
typedef struct lrcs_host_glint_sum {
    double glint_m2; /* of all these facets together */
    double error_m2; /* ESTIMATE of its error: of each part the relative error, at most 1, times
                        its glint */
    double most_m2;  /* of the flat face that contributes most: its brightest facet, and the facets
                        of the same part and material that turn from that by less than 1e-3 rad */
    uint32_t facet;  /* its brightest facet; LRCS_NONE if none contributes */
} lrcs_host_glint_sum;

/* From the records of a run of `scene`, and a list of lrcs_host_glint_check of this scene or of the
   one that it was varied from: the relative errors are those of the slopes in `scene`. */
void lrcs_host_glint_sum_make(const lrcs_scene *scene, const lrcs_facet_record *records,
                              const lrcs_host_glint *list, uint32_t count,
                              lrcs_host_glint_sum *sum);

/* ---- readings to fit ---- */

typedef struct lrcs_host_reading {
    lrcs_fit_reading fit; /* sigma is 0 if the file has none */
    uint32_t material;    /* an index of lrcs_host_readings' names */
    uint32_t line;        /* in the file, from 1 */
} lrcs_host_reading;

/* Readings from a table of text, several materials in one file allowed. */
typedef struct lrcs_host_readings {
    lrcs_host_reading *reading; /* in the file's order */
    uint32_t count;
    char **name; /* in the order of their first reading; one "" where the file names none */
    uint32_t name_count;
    int noise; /* LRCS_FIT_GIVEN: the file has sigmas; _WEIGHTED: it has weights, and sigma is
                  weight^(-1/2); else LRCS_FIT_ABSOLUTE */
    lrcs_host_notices notices; /* unused columns, skipped lines */
} lrcs_host_readings;

/* Reads a table (lrcs/table.h) with one line per reading. If the first field of the first line is
   not a number, that line names the columns, in any order: angle or theta (deg); brdf, reading or
   value; optionally sigma (or error, std), weight (proportional to 1/sigma^2; a line with 0 is
   skipped), material (or sample); other columns are not used. Without such a line the columns are
   angle, brdf and, if there is a third, sigma. A line whose value is empty, "nan" or "NA" is
   skipped. Status: LRCS_OK;
   LRCS_E_SYSTEM; LRCS_E_SYNTAX, _NUMBER, _NAME, _EMPTY, _LIMIT: the sentence names the line, what
   was found there and what was expected. On failure there is nothing to free. */
int lrcs_host_readings_read(const char *path, lrcs_host_readings *readings, lrcs_host_error *error);
void lrcs_host_readings_free(lrcs_host_readings *readings);

/* ---- writers: none checks for write errors; lrcs_host_output_close does ---- */

/* The per-facet table of a run: a header and one row per facet. */
void lrcs_host_facets_write(FILE *out, const lrcs_scene *scene, const lrcs_facet_record *records);
/* The table of visible polygons: a header and one row per point; rings are counted from 0. */
void lrcs_host_polygons_write(FILE *out, const lrcs_polygons *polygons);

/* A JSON writer: containers nest; commas and escapes are written automatically. */
enum lrcs_host_json_kind {
    LRCS_HOST_OBJECT, /* one item per line */
    LRCS_HOST_ARRAY,
    LRCS_HOST_ROW_OBJECT, /* all in one line, including nested containers */
    LRCS_HOST_ROW_ARRAY
};
typedef struct lrcs_host_json {
    FILE *out;
    uint32_t depth;
    struct {
        char close;
        unsigned char row, filled;
    } level[16];
} lrcs_host_json;

lrcs_host_json lrcs_host_json_make(FILE *out);
/* key: NULL inside arrays and at the top level. At most 16 levels. */
void lrcs_host_json_begin(lrcs_host_json *json, const char *key, int kind);
void lrcs_host_json_end(lrcs_host_json *json);
void lrcs_host_json_text(lrcs_host_json *json, const char *key, const char *text); /* NULL: null */
void lrcs_host_json_number(lrcs_host_json *json, const char *key,
                           double value); /* not finite: null */
void lrcs_host_json_count(lrcs_host_json *json, const char *key, uint64_t value);
void lrcs_host_json_bool(lrcs_host_json *json, const char *key, int value);

/* Writes a PNG, 8 bits per channel; channels: 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha.
   about: what the picture was made from, a tEXt chunk named Comment (other characters than ASCII
   become '?'), or NULL.
   Status: LRCS_OK; LRCS_E_ARGUMENT; LRCS_E_LIMIT (2 GiB); LRCS_E_SYSTEM (memory). */
int lrcs_host_png_write(FILE *out, const unsigned char *pixels, uint32_t width, uint32_t height,
                        uint32_t channels, const char *about, lrcs_host_error *error);

/* Writes text into an HTML page, between tags or in quotes; bytes that are not UTF-8 and characters
   that HTML does not allow become U+FFFD. lrcs_host_html_base64 writes bytes as base64 (RFC 4648),
   for data: URLs. */
void lrcs_host_html_text(FILE *out, const char *text);
void lrcs_host_html_base64(FILE *out, const unsigned char *bytes, size_t size);

/* ---- charts ---- */

/* The layout of charts and maps: the size of the drawing, the height of title and note, and the
   square that a polar chart occupies with its numbers. A page that has its own title and text can
   crop a chart to its plot by these. */
#define LRCS_HOST_CHART_WIDTH      860.0
#define LRCS_HOST_CHART_HEIGHT     520.0
#define LRCS_HOST_CHART_TITLE      50.0
#define LRCS_HOST_CHART_POLAR_LEFT 72.0
#define LRCS_HOST_CHART_POLAR_SIDE 464.0

/* Colours that remain distinguishable with colour vision deficiency (M. Okabe and K. Ito, 2008). */
enum lrcs_host_colour {
    LRCS_HOST_BLACK,
    LRCS_HOST_ORANGE,
    LRCS_HOST_SKY_BLUE,
    LRCS_HOST_GREEN,
    LRCS_HOST_YELLOW,
    LRCS_HOST_BLUE,
    LRCS_HOST_VERMILION,
    LRCS_HOST_PURPLE
};
enum lrcs_host_marker {
    LRCS_HOST_DISC,
    LRCS_HOST_SQUARE,
    LRCS_HOST_TRIANGLE,
    LRCS_HOST_DIAMOND,
    LRCS_HOST_CROSS,
    LRCS_HOST_NO_MARKER
};
enum lrcs_host_dash { LRCS_HOST_SOLID, LRCS_HOST_DASHED, LRCS_HOST_DOTTED, LRCS_HOST_NO_LINE };

/* Points, joined in their order unless dash is LRCS_HOST_NO_LINE. Points that an axis cannot show
   (not finite, beyond 1e288; log: not above 1e-288) are omitted, and leave a gap in the line. */
typedef struct lrcs_host_series {
    const char *name; /* in the legend, or NULL: not listed */
    uint32_t count;
    const double *x, *y;
    const char *const *label; /* one per point, drawn where there is room; NULL: no labels, or no
                                 label for that point */
    int colour, marker, dash; /* lrcs_host_colour, ... */
    int hollow;               /* markers are outlines */
    const double *low, *high; /* the ends of a band at each point, shaded below all lines; an end
                                 that the axis cannot show lies at its edge; not in polar charts.
                                 NULL: none */
} lrcs_host_series;

typedef struct lrcs_host_chart {
    const char *title, *note; /* note: a smaller line below the title, or NULL */
    const char *x_name, *y_name;
    int x_log, y_log;
    int x_deg;    /* x is an angle, deg: ticks every 30, 45, .. */
    int y_from_0; /* the y axis begins at 0 regardless of the data; not with y_log */
    int polar;    /* polar chart: x is an angle, deg, counter-clockwise from the right; y is the
                     distance from the pole. The pole is 0 with y_from_0; otherwise it is 40 below
                     the largest y, and smaller values are drawn there */
    double floor; /* log y: smaller values, including 0, are drawn at this value with a downward
                     arrow; 0: none */
    const char *floor_name; /* in the legend */
    const lrcs_host_series *series;
    uint32_t series_count;
    const char *about; /* what it was made from, as in lrcs_host_png_write; SVG: metadata */
} lrcs_host_chart;

/* The same chart as SVG 1.1, and as PNG with twice the pixels. Status: LRCS_OK; LRCS_E_SYSTEM. */
void lrcs_host_chart_svg(FILE *out, const lrcs_host_chart *chart);
int lrcs_host_chart_png(FILE *out, const lrcs_host_chart *chart, lrcs_host_error *error);

/* A quantity as a function of two others, as colours with contours, interpolated between points. */
typedef struct lrcs_host_map {
    const char *title, *note;             /* as a chart's */
    const char *x_name, *y_name, *z_name; /* z: beside the scale of colours */
    uint32_t columns, rows;               /* at least 2 of each */
    const double *x, *y;                  /* ascending: columns of x, rows of y */
    const double *z;                      /* z[row * columns + column]; not finite: grey */
    double deep;       /* the colour scale covers at most this range below the largest; 0: all */
    int x_deg, y_deg;  /* these are angles, deg */
    int mollweide;     /* drawn in Mollweide's equal-area projection, 0 deg in the middle: x is the
                          azimuth or longitude, deg, over at most 360; y is -90 .. 90 */
    int cells;         /* without contours */
    const char *about; /* as of a chart */
} lrcs_host_map;

/* As for charts. If there are more points than can be resolved, several are averaged.
   Status: LRCS_OK; LRCS_E_SYSTEM. */
void lrcs_host_map_svg(FILE *out, const lrcs_host_map *map);
int lrcs_host_map_png(FILE *out, const lrcs_host_map *map, lrcs_host_error *error);

#endif
