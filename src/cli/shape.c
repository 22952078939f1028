/* SPDX-License-Identifier: MIT */
/* lrcs shape: sigma of a simple shape from its closed form. */
#include "cli/cli.h"

#include <math.h>
#include <string.h>

static const char shape_help[] =
    "usage: lrcs shape KIND dimensions [--aspect DEG] [--material A,B,s,m] [--json]\n"
    "\n"
    "Computes sigma (m2) of a simple body alone, from its closed form. Lengths are in metres.\n"
    "\n"
    "  plate       --size a,b                    one-sided, normal +z\n"
    "  disc        --radius R                    one-sided, normal +z\n"
    "  box         --size a,b,c\n"
    "  sphere      --radius R\n"
    "  dome        --radius R                    half a sphere\n"
    "  cylinder    --radius R --length L\n"
    "  cone        --radius R, and --half-angle DEG or --length H\n"
    "  frustum     --radius R --radius2 R2 --length L   R: the end at aspect 0\n"
    "  paraboloid  --radius R --length H         R: base, H: height\n"
    "\n"
    "options\n"
    "  --aspect DEG        angle of the line of sight to the axis or normal, 0 .. 180 (default 0)\n"
    "  --direction x,y,z   direction to the laser instead (box and plate)\n"
    "  --parts wall|all    without or with caps or base (default all)\n"
    "  --material A,B,s,m  or a library material (default 1,0.25,0.2,0.5)\n"
    "  --json              JSON: sigma_m2, sigma_glint_m2, sigma_diffuse_m2, bound_m2\n"
    "\n"
    "examples\n"
    "  lrcs shape plate --size 1,1 --aspect 20 --material 1,0.25,0.2,0.5\n"
    "  lrcs shape cone --radius 0.5 --half-angle 15 --parts wall --json\n";

static const cli_option shape_options[] = {
    {"size", 1, 0},       {"radius", 1, 0}, {"radius2", 1, 0},   {"length", 1, 0},
    {"half-angle", 1, 0}, {"aspect", 1, 0}, {"direction", 1, 0}, {"parts", 1, 0},
    {"material", 1, 0},   {"json", 0, 0},   {"help", 0, 0},      {NULL, 0, 0}};

/* What each kind takes. */
typedef struct shape_form {
    int sizes;                   /* number of sizes of --size */
    int radius, radius2, length; /* 1: required */
    int cone;                    /* 1: half-angle or length */
    int caps;                    /* 1: has caps or a base */
    int turns;                   /* 1: takes a direction */
} shape_form;

static const shape_form shape_forms[LRCS_SHAPE_KINDS] = {
    [LRCS_SHAPE_PLATE] = {.sizes = 2, .turns = 1},
    [LRCS_SHAPE_BOX] = {.sizes = 3, .turns = 1},
    [LRCS_SHAPE_DISC] = {.radius = 1},
    [LRCS_SHAPE_SPHERE] = {.radius = 1},
    [LRCS_SHAPE_DOME] = {.radius = 1, .caps = 1},
    [LRCS_SHAPE_CYLINDER] = {.radius = 1, .length = 1, .caps = 1},
    [LRCS_SHAPE_CONE] = {.radius = 1, .cone = 1, .caps = 1},
    [LRCS_SHAPE_FRUSTUM] = {.radius = 1, .radius2 = 1, .length = 1, .caps = 1},
    [LRCS_SHAPE_PARABOLOID] = {.radius = 1, .length = 1, .caps = 1}};

/* 1 if an option is given as the kind requires; else CLI_USAGE in *code if it must or must not be
   given. `more` follows its name in the message. */
static int is_given(const cli_args *args, const char *name, int wanted, const char *more, int *code)
{
    int given = cli_value(args, name) != NULL;
    if (given != (wanted != 0)) {
        *code = given ? cli_usage(args->command, "%s takes no --%s", args->operand, name)
                      : cli_usage(args->command, "%s needs --%s%s", args->operand, name, more);
    }
    return given && wanted;
}

static int dimension_read(const cli_args *args, const char *name, int wanted, double *value)
{
    int code = 0;
    if (!is_given(args, name, wanted, "", &code)) {
        return code;
    }
    code = cli_number(args, name, value);
    return code == 0 && *value < 0.0 ? cli_expected(args, name, "a number >= 0") : code;
}

/* Reads a cone's height or its half-angle; exactly one must be given. */
static int cone_read(const cli_args *args, const shape_form *form, lrcs_shape *shape)
{
    int angle = cli_value(args, "half-angle") != NULL;
    int length = cli_value(args, "length") != NULL;
    if (form->cone && angle == length) {
        return cli_usage(args->command, "cone needs --half-angle or --length%s",
                         angle ? ", not both" : "");
    }
    int code = dimension_read(args, "half-angle", form->cone && angle, &shape->half_angle_deg);
    code = code ? code
                : dimension_read(args, "length", form->length || (form->cone && length),
                                 &shape->length);
    if (code == 0 && form->cone && angle &&
        !(shape->half_angle_deg > 0.0 && shape->half_angle_deg < 90.0)) {
        return cli_expected(args, "half-angle", "0 < DEG < 90");
    }
    return code;
}

static int aspect_read(const cli_args *args, const shape_form *form, lrcs_aspect *aspect)
{
    const char *direction = cli_value(args, "direction");
    if (direction && cli_value(args, "aspect")) {
        return cli_usage(args->command, "--aspect and --direction both say where the laser is");
    }
    if (direction && !form->turns) {
        return cli_usage(args->command, "%s takes --aspect, not --direction", args->operand);
    }
    if (direction) {
        double *v = aspect->direction;
        aspect->by_direction = 1;
        if (lrcs_host_numbers_read(direction, v, 3) != LRCS_OK ||
            (v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)) {
            return cli_expected(args, "direction", "x,y,z, not all zero");
        }
        return 0;
    }
    int code = cli_number(args, "aspect", &aspect->deg);
    if (code == 0 && !(aspect->deg >= 0.0 && aspect->deg <= 180.0)) {
        return cli_expected(args, "aspect", "0 .. 180 degrees");
    }
    return code;
}

static int shape_read(const cli_args *args, lrcs_shape *shape, lrcs_aspect *aspect)
{
    int all = 1;
    shape->kind = lrcs_shape_find(args->operand);
    if (shape->kind < 0) {
        const char *best = NULL;
        char list[LRCS_SHAPE_KINDS * 14] = "";
        for (int i = 0; i < LRCS_SHAPE_KINDS; i++) {
            best = lrcs_host_name_nearer(args->operand, best, lrcs_shape_text(i));
            lrcs_host_append(list, sizeof list, "%s%s", i > 0 ? ", " : "", lrcs_shape_text(i));
        }
        int near = lrcs_host_name_is_near(args->operand, best);
        return cli_usage(args->command, "unknown KIND '%s'; %s %s", args->operand,
                         near ? "the nearest is" : "expected one of", near ? best : list);
    }
    const shape_form *form = &shape_forms[shape->kind];
    const double *size = shape->size;
    int code = 0;
    if (is_given(args, "size", form->sizes, form->sizes == 2 ? " a,b" : " a,b,c", &code) &&
        (lrcs_host_numbers_read(cli_value(args, "size"), shape->size, form->sizes) != LRCS_OK ||
         size[0] < 0.0 || size[1] < 0.0 || size[2] < 0.0)) {
        return cli_expected(args, "size",
                            form->sizes == 2 ? "a,b (metres, >= 0)" : "a,b,c (metres, >= 0)");
    }
    code = code ? code : dimension_read(args, "radius", form->radius, &shape->radius);
    code = code ? code : dimension_read(args, "radius2", form->radius2, &shape->radius2);
    code = code ? code : cone_read(args, form, shape);
    code = code ? code : cli_choice(args, "parts", "wall or all", &all);
    if (code == 0 && !all && !form->caps) {
        return cli_usage(args->command, "--parts: a %s has no caps to leave out", args->operand);
    }
    shape->parts = all ? LRCS_SHAPE_ALL : LRCS_SHAPE_WALL;
    return code ? code : aspect_read(args, form, aspect);
}

static void shape_print(const cli_args *args, const lrcs_closed_form *closed)
{
    char bound[LRCS_HOST_BOUND_SIZE];
    if (cli_value(args, "json")) {
        lrcs_host_json json = lrcs_host_json_make(stdout);
        lrcs_host_json_put(&json, "{\n");
        cli_version_json(&json);
        lrcs_host_json_put(&json,
                           "sigma_m2=%g sigma_glint_m2=%g sigma_diffuse_m2=%g bound_m2=%g shape=%s",
                           closed->sigma_m2, closed->sigma_glint_m2, closed->sigma_diffuse_m2,
                           closed->bound_m2, args->operand);
        cli_options_json(args, &json);
        lrcs_host_json_put(&json, "}");
        return;
    }
    printf("sigma      %.15g m2", closed->sigma_m2);
    if (closed->sigma_m2 > 0.0) {
        printf("   %.6f dBsm", cli_dbsm(closed->sigma_m2));
    }
    lrcs_host_bound_text(closed->bound_m2, 3, bound);
    printf("\n  glint    %.15g m2\n  diffuse  %.15g m2\nbound      %s m2\n", closed->sigma_glint_m2,
           closed->sigma_diffuse_m2, bound);
}

static int shape_command(const cli_args *args)
{
    lrcs_shape shape = {0};
    lrcs_aspect aspect = {0};
    lrcs_brdf brdf = lrcs_brdf_default();
    lrcs_closed_form closed;
    lrcs_where where = {0};
    const char *material = cli_value(args, "material");
    int code = shape_read(args, &shape, &aspect);
    if (code == 0 && material) {
        code = cli_brdf_read(args->command, material, "--material", &brdf);
    }
    if (code != 0) {
        return code;
    }
    int status = lrcs_shape_check(&shape, &where);
    if (status != LRCS_OK) {
        return cli_usage(args->command, "%s: %s: expected %s, found %s", args->operand,
                         where.item ? where.item : "dimensions",
                         where.expected ? where.expected : lrcs_status_text(status), where.found);
    }
    status = lrcs_closed_eval(&shape, &brdf, &aspect, &closed);
    if (status != LRCS_OK) {
        return cli_fail("%s: %s: lengths are 0 or 1e-150 .. 1e100 m, s about 1e-100 .. 1e100, and "
                        "sigma is within the range of doubles",
                        args->operand, lrcs_status_text(status));
    }
    if (!material) {
        fprintf(stderr, "notice: no --material: A=1, B=0.25, s=0.2, m=0.5\n");
    }
    cli_brdf_warnings_print("material", &brdf);
    shape_print(args, &closed);
    return CLI_DONE;
}

const cli_command cli_shape_command = {
    "shape",
    "KIND",
    "plate, disc, box, sphere, dome, cylinder, cone, frustum or paraboloid",
    shape_help,
    shape_options,
    shape_command,
    NULL};
