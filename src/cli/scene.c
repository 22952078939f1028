/* SPDX-License-Identifier: MIT */
/* lrcs scene: writes a scene file made from a model, to be edited: its parts, its materials with
   their colours, and every number that is assumed for them. As written it is equivalent to the
   model alone: the same facets, materials and sigma. */
#include "cli/cli.h"

#include <lrcs/inventory.h>

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static const char scene_help[] =
    "usage: lrcs scene MODEL -o FILE.toml [options]\n"
    "\n"
    "Writes a scene file for MODEL, a .3ds, .obj or .stl model, to edit: the model as a part\n"
    "with its unit, and every material with its colour, facets and area, and its numbers A,\n"
    "B, s, m. Numbers that nobody has given are marked as assumed, and have their default\n"
    "values. lrcs run accepts the file unchanged, and computes the same sigma as for MODEL.\n"
    "\n"
    "output\n"
    "  -o FILE.toml          the scene file, which must not exist yet ('-': standard output)\n"
    "\n"
    "options\n"
    "  --unit U              unit of the model: mm, cm, m (default), in, ft or metres per unit\n"
    "  --material [WHAT=]BRDF  a BRDF for some materials; repeatable. WHAT is the name of a\n"
    "                        material, in which * and ? are wildcards, or a colour '#RRGGBB';\n"
    "                        without it, all other materials. BRDF is A,B,s,m (A, B in 1/sr) or\n"
    "                        the name of a library material\n"
    "  --keep-transparent    keeps facets that the file declares fully transparent\n"
    "\n"
    "examples\n"
    "  lrcs scene aura.3ds --unit in -o aura.toml\n"
    "  lrcs scene lander.obj --material 'gold*=mli-gold' -o lander.toml\n";

static const cli_option scene_options[] = {{"unit", 1, 0},     {"material", 1, 1},
                                           {"o", CLI_FILE, 0}, {"keep-transparent", 0, 0},
                                           {"help", 0, 0},     {NULL, 0, 0}};

typedef struct scene_job {
    const cli_args *args;
    const char *path;
    lrcs_host_options load;
    lrcs_host_scene scene;
    uint32_t *facets; /* by material */
    double *area;     /* m2, by material */
    char *text;       /* content of the scene file */
    size_t size;
} scene_job;

/* ---- TOML ---- */

/* Writes a TOML basic string. */
static void string_put(FILE *out, const char *before, const char *text)
{
    fprintf(out, "%s\"", before);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c < 0x20 || *c == 0x7f) {
            fprintf(out, "\\u%04X", *c);
        } else {
            fprintf(out, *c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
        }
    }
    putc('"', out);
}

/* Writes a number with as few digits as identify it. */
static void number_put(FILE *out, const char *key, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE];
    double back = 0.0;
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (lrcs_host_number_read(text, strlen(text), &back) == LRCS_OK && back == value) {
            break;
        }
    }
    fprintf(out, "%s = %s\n", key, text);
}

/* ---- paths ---- */

/* The model's path relative to the scene file's folder; the caller frees it. An absolute path is
   unchanged. */
static char *path_from(const char *model, const char *scene)
{
    char *folder = strdup(scene);
    char *slash = folder ? strrchr(folder, '/') : NULL;
    if (!folder || model[0] == '/' || strcmp(scene, "-") == 0 || (!slash && !strchr(model, '/'))) {
        free(folder);
        return strdup(model);
    }
    if (slash) {
        slash[1] = '\0';
    } else {
        strcpy(folder, ".");
    }
    char *from = realpath(folder, NULL);
    char *to = realpath(model, NULL);
    char *path = NULL;
    size_t same = 0; /* length of the common folders */
    size_t ups = 0;
    for (size_t i = 0; from && to && from[i] == to[i] && to[i]; i++) {
        same = to[i] == '/' ? i + 1 : same;
        if (from[i + 1] == '\0' && to[i + 1] == '/') {
            same = i + 2;
        }
    }
    for (size_t i = same; from && same < strlen(from) + 1 && from[i]; i++) {
        ups += i == same || from[i] == '/';
    }
    if (from && to && (path = malloc(3 * ups + strlen(to + same) + 1)) != NULL) {
        path[0] = '\0';
        for (size_t i = 0; i < ups; i++) {
            strcat(path, "../");
        }
        strcat(path, to + same);
    }
    free(folder);
    free(from);
    free(to);
    return path;
}

/* ---- what a name suggests ---- */

/* The library's material that a name suggests, or NULL. */
static const char *suggestion(const char *name)
{
    static const char *const word[][2] = {
        {"solar", "solar-cell"},    {"cell", "solar-cell"},
        {"gold", "mli-gold"},       {"mli", "mli-gold"},
        {"kapton", "mli-gold"},     {"foil", "mli-silver"},
        {"silver", "mli-silver"},   {"white", "paint-white"},
        {"black", "paint-black"},   {"anod", "aluminium-anodised"},
        {"alu", "aluminium-bare"},  {"chrom", "aluminium-bare"},
        {"metal", "aluminium-bare"}};
    for (size_t i = 0; i < sizeof word / sizeof word[0]; i++) {
        for (const char *at = name; *at; at++) {
            if (strncasecmp(at, word[i][0], strlen(word[i][0])) == 0) {
                return word[i][1];
            }
        }
    }
    return NULL;
}

/* ---- the parts of the file ---- */

/* Writes the beginning of the file, and the model as a part, with the names of its objects.
   `unnamed`: the name of the material of facets without one, or NULL. */
static void model_put(const scene_job *job, const char *unnamed, FILE *out)
{
    const lrcs_mesh *model = &job->scene.model[0];
    const char *operand = job->args->operand;
    const char *unit = cli_value(job->args, "unit");
    char *path = path_from(operand, job->path);
    double metres = 0.0;
    cli_line_put(out, "# ", cli_base_name(operand));
    fprintf(out,
            " as a scene, to edit: made by lrcs scene, version %s.\n"
            "# As it stands it means what the model alone means. What nobody has given is marked "
            "as a GUESS.\n",
            lrcs_version());
    string_put(out, "schema = 1\nname = ", cli_base_name(operand));
    fprintf(out,
            "\n%skeep_transparent = true   # keep facets that the file calls fully transparent\n",
            job->load.keep_transparent ? "" : "# ");
    if (unnamed) {
        string_put(out, "default_material = ", unnamed);
        fputs("   # of facets without a material\n", out);
    }
    string_put(out, "\n[[part]]\nname = ", job->scene.recipe.part[0].name);
    string_put(out, "\nfile = ", path ? path : operand);
    free(path);
    if (!unit) {
        fputs("\n# GUESS: ", out);
        for (uint32_t i = 0; i < job->scene.notices.count; i++) {
            if (strstr(job->scene.notices.text[i], "no unit is stated")) {
                cli_line_put(out, "", job->scene.notices.text[i]);
            }
        }
        fputs("\n# unit = \"m\"              # mm, cm, m, in, ft, or metres per unit\n", out);
    } else if (lrcs_host_number_read(unit, strlen(unit), &metres) == LRCS_OK) {
        number_put(out, "\nunit", metres);
    } else {
        fprintf(out, "\nunit = \"%s\"\n", unit);
    }
    fputs("# translate = [0, 0, 0]   # m; rotate_euler = \"XYZ\" with rotate_deg = [0, 0, 0] turns "
          "it\n",
          out);
    /* the objects: their facets belong to the part */
    uint32_t *count = calloc((size_t)model->part_count + 1, sizeof *count);
    if (!count || model->part_count == 0) {
        free(count);
        return;
    }
    fprintf(out, "#\n# The model's %lu object%s (run --two-sided takes these names):\n",
            (unsigned long)model->part_count, model->part_count > 1 ? "s" : "");
    for (uint32_t i = 0; i < model->facet_count; i++) {
        count[model->facet_part[i]]++;
    }
    for (uint32_t k = 0; k < model->part_count; k++) {
        fprintf(out, "#   %8lu facets  ", (unsigned long)count[k]);
        cli_line_put(out, "", model->part[k]);
        putc('\n', out);
    }
    free(count);
}

/* Writes a material of the model, with a mapping from its name; if `unnamed` is not NULL, as the
   material of facets without a name, without a mapping. */
static void material_put(const scene_job *job, uint32_t index, const char *unnamed, FILE *out)
{
    const lrcs_scene *scene = &job->scene.scene;
    const lrcs_material *material = &scene->material[index];
    const char *name = unnamed ? unnamed : material->name;
    /* 1. What has it, and its name. */
    fprintf(out, "\n# %lu facets, %.4g m2", (unsigned long)job->facets[index], job->area[index]);
    if (material->has_colour) {
        char colour[CLI_COLOUR_TEXT];
        fprintf(out, ", colour %s", cli_colour_text(material->rgb, colour));
    }
    string_put(out,
               material->omitted ? ", fully transparent: left out\n[[material]]\nname = "
                                 : "\n[[material]]\nname = ",
               name);
    putc('\n', out);
    /* 2. Its numbers, or the library's material that has them. */
    const lrcs_brdf *brdf = &material->brdf;
    const lrcs_brdf_entry *entry = cli_brdf_entry(brdf);
    const char *like = suggestion(material->name);
    const char *const key[8] = {"A", "B", "s", "m", "A_error", "B_error", "s_error", "m_error"};
    const double value[8] = {brdf->A,           brdf->B,           brdf->s,
                             brdf->m,           material->error.A, material->error.B,
                             material->error.s, material->error.m};
    if (entry) {
        fprintf(out, "like = \"%s\"   # %sA=%g, B=%g, s=%g, m=%g, %s\n", entry->name,
                entry->source ? "" : "GUESS: ", brdf->A, brdf->B, brdf->s, brdf->m,
                entry->source ? entry->source : "illustrative");
    } else if (!material->brdf_given) {
        fputs("assumed = true    # GUESS: A to m are the default; delete this line with your own\n",
              out);
        if (like) {
            fprintf(out, "# like = \"%s\"   # may suit that name better, in place of A to m\n",
                    like);
        }
    }
    for (int i = 0; !entry && i < 8; i++) {
        if (i < 4 || value[i] > 0.0) {
            number_put(out, key[i], value[i]);
        }
    }
    /* 3. Whether its back reflects. */
    int two_sided = 1; /* 1 if all materials of that name are: the key applies to each of them */
    for (uint32_t i = 0; i < scene->material_count; i++) {
        two_sided &=
            strcmp(scene->material[i].name, material->name) != 0 || scene->material[i].two_sided;
    }
    fputs(two_sided ? "two_sided = true  # as the model says\n"
                    : "# two_sided = true   # if its back reflects, too\n",
          out);
    if (!unnamed) { /* 4. The mapping. */
        string_put(out, "[[map]]\nname = ", name);
        string_put(out, "\nmaterial = ", name);
        putc('\n', out);
    }
}

static void scene_put(const scene_job *job, FILE *out)
{
    const lrcs_scene *scene = &job->scene.scene;
    const lrcs_brdf_entry *entry;
    char unnamed[32];
    int any = 0;
    int taken = 1;
    /* 1. A name, different from all others, for the material without a name. */
    for (unsigned n = 1; taken; n++) {
        snprintf(unnamed, sizeof unnamed, n > 1 ? "default %u" : "default", n);
        taken = 0;
        for (uint32_t i = 0; i < scene->material_count; i++) {
            taken |= strcmp(scene->material[i].name, unnamed) == 0;
            any |= !scene->material[i].name[0] && job->facets[i] > 0;
        }
    }
    /* 2. The model. */
    model_put(job, any ? unnamed : NULL, out);
    /* 3. The materials: the first of each name, which stands for all that have it. */
    fputs(
        "\n# Materials: f_r = A / cos^6 exp(-tan^2 / s^2) + B cos^m, A and B in 1/sr. Names of the "
        "library,\n# illustrative but for those with a published reflectance (*):",
        out);
    for (uint32_t i = 0; (entry = lrcs_brdf_library(i)) != NULL; i++) {
        fprintf(out, "%s %s%s",
                i == 0       ? ""
                : i % 6 == 5 ? ",\n#"
                             : ",",
                entry->name, entry->source ? "*" : "");
    }
    putc('\n', out);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const char *name = scene->material[i].name;
        uint32_t first = 0;
        while (strcmp(scene->material[first].name, name) != 0) {
            first++;
        }
        if ((name[0] || job->facets[i] > 0) && first == i) {
            material_put(job, i, name[0] ? NULL : unnamed, out);
        }
    }
}

/* ---- the command ---- */

static int scene_read(scene_job *job)
{
    const cli_args *args = job->args;
    job->path = cli_value(args, "o");
    if (!job->path) {
        return cli_usage(args->command, "give -o FILE.toml");
    }
    if (strcmp(job->path, "-") != 0 && !cli_extension(job->path, ".toml")) {
        return cli_expected(args, "o", "FILE.toml");
    }
    if (strcmp(job->path, "-") != 0 && access(job->path, F_OK) == 0) {
        return cli_usage(args->command,
                         "-o: '%s' exists, and may have been edited: give another name", job->path);
    }
    int code = cli_scene_options_read(args, &job->load);
    code = code ? code : cli_scene_read(args, &job->load, &job->scene);
    if (code == 0 && (job->scene.recipe.part_count != 1 || job->scene.recipe.part[0].line != 0)) {
        return cli_usage(args->command,
                         "expected a model, found a scene file: '%s' can be edited as "
                         "it is",
                         args->operand);
    }
    /* materials of the same name have the same mapping: colours cannot distinguish them */
    const lrcs_scene *scene = &job->scene.scene;
    for (uint32_t i = 0; code == 0 && i < scene->material_count; i++) {
        const lrcs_material *one = &scene->material[i];
        for (uint32_t k = 0; k < i; k++) {
            if (strcmp(one->name, scene->material[k].name) == 0 &&
                memcmp(&one->brdf, &scene->material[k].brdf, sizeof one->brdf) != 0) {
                return cli_usage(args->command,
                                 "--material: two materials are named '%s', which a scene file "
                                 "cannot give different numbers",
                                 one->name);
            }
        }
    }
    return code;
}

static void text_write(FILE *out, const void *context)
{
    const scene_job *job = context;
    fwrite(job->text, 1, job->size, out);
}

/* Makes the text from the facets of each material and their area. It is read back before it is
   written, so that no names in a model lead to a file that lrcs refuses. */
static int scene_make(scene_job *job)
{
    const lrcs_scene *scene = &job->scene.scene;
    lrcs_recipe recipe;
    lrcs_where where;
    job->facets = calloc((size_t)scene->material_count + 1, sizeof *job->facets);
    job->area = calloc((size_t)scene->material_count + 1, sizeof *job->area);
    FILE *out = open_memstream(&job->text, &job->size);
    if (job->facets && job->area && out) {
        for (uint32_t i = 0; i < scene->facet_count; i++) {
            job->facets[scene->facet_material[i]]++;
            job->area[scene->facet_material[i]] += lrcs_host_facet_area(scene, i);
        }
        scene_put(job, out);
    }
    int failed = !job->facets || !job->area || !out || ferror(out);
    if ((out && fclose(out) != 0) || failed) {
        return cli_out_of_memory();
    }
    size_t need = lrcs_recipe_need(job->size);
    void *bytes = malloc(need);
    if (!bytes) {
        return cli_out_of_memory();
    }
    lrcs_work work = lrcs_work_make(bytes, need);
    int status = lrcs_recipe_read(job->text, job->size, &work, &recipe, &where);
    free(bytes);
    return status == LRCS_OK
               ? 0
               : cli_fail("%s: cannot be written as a scene file: %s, found '%s', expected %s",
                          job->args->operand, where.item, where.found, where.expected);
}

static int scene_command(const cli_args *args)
{
    scene_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = scene_read(&job);
    code = code ? code : scene_make(&job);
    code = code ? code : cli_text_write(job.path, text_write, &job);
    cli_watch_end();
    if (code == 0) {
        cli_notices_print(stderr, &job.scene.notices);
        cli_outputs_print(args, NULL);
    }
    free(job.text);
    free(job.facets);
    free(job.area);
    lrcs_host_scene_free(&job.scene);
    cli_scene_options_free(&job.load);
    return code;
}

const cli_command cli_scene_command = {"scene",    "MODEL",       "give a .3ds, .obj or .stl model",
                                       scene_help, scene_options, scene_command,
                                       NULL};
