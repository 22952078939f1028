/* SPDX-License-Identifier: MIT */
/* Reads a scene file into a recipe: one pass over the text counts tables, a second one reads them;
   then names are resolved, so that a file may use a material before it defines it. */
#include <string.h>

#include "base/index.h"
#include "base/where.h"
#include "base/work.h"
#include "scene/build/bind.h"
#include "scene/file/recipe.h"

/* Kinds of names, each of which must be unique. */
enum recipe_tag { TAG_PART, TAG_MATERIAL, TAG_MAP_NAME, TAG_MAP_COLOUR };

/* The smallest numbers of bytes of a table, "[[map]]" with its line end (the last may lack it), and
   of a string, 'a=""' with its line end. */
#define TABLE_MIN  8u
#define STRING_MIN 5u

typedef struct recipe_reader {
    lrcsi_toml toml;
    lrcsi_draft draft;
    double unit; /* of model files, m; 0: not stated */
    lrcs_recipe recipe;
} recipe_reader;

size_t lrcs_recipe_need(size_t size)
{
    size_t tables = size / TABLE_MIN + 1;
    size_t strings = size / STRING_MIN + 1;
    /* A table makes at most one part and one name; the default material is one more binding. */
    size_t need = lrcsi_work_bytes(tables, sizeof(lrcs_recipe_part));
    need = lrcsi_work_add(need, lrcsi_work_bytes(1, sizeof(lrcs_recipe_material)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(1, sizeof(lrcs_binding)));
    /* Strings with terminators and padding; the copy of one number without its underscores. */
    need = lrcsi_work_add(need, lrcsi_work_bytes(strings, 1 + LRCS_WORK_ALIGN));
    need = lrcsi_work_add(need, lrcsi_work_bytes(size, 2));
    return lrcsi_work_add(need, lrcsi_index_need(tables));
}

static int out_of_memory(lrcs_where *where)
{
    return lrcsi_where_text(where, LRCS_E_MEMORY, 0, 0, "work area", "lrcs_recipe_need bytes", "",
                            0);
}

/* Counts parts, materials and maps up to the end or the first error, which the second pass
   reports. */
static int count_tables(const char *text, size_t size, lrcs_where *where, uint32_t count[3])
{
    static const char *const table[3] = {"part", "material", "map"};
    lrcsi_toml toml;
    lrcsi_toml_event event;
    size_t total[3] = {0, 0, 0};
    int status = lrcsi_toml_start(&toml, text, size, NULL, where);
    if (status != LRCS_OK) {
        return status;
    }
    toml.where = NULL;
    while (lrcsi_toml_next(&toml, &event) == LRCS_OK && event.kind != LRCSI_TOML_END) {
        for (int i = 0; i < 3; i++) {
            total[i] += event.kind == LRCSI_TOML_ELEMENT && event.name_count == 1 &&
                        lrcsi_toml_name_is(&event.name[0], table[i]);
        }
    }
    for (int i = 0; i < 3; i++) {
        if (total[i] >= LRCS_NONE - 1) {
            return lrcsi_where_number(where, LRCS_E_LIMIT, 0, 0, "scene file",
                                      "fewer than 2^32 - 2 tables of a kind", total[i]);
        }
        count[i] = (uint32_t)total[i];
    }
    return LRCS_OK;
}

/* Interprets the keys at the top of the file. */
static int finish_top(recipe_reader *reader)
{
    const lrcsi_draft *draft = &reader->draft;
    const lrcsi_toml_event *keep = lrcsi_draft_find(draft, LRCSI_KEY_KEEP_TRANSPARENT);
    const lrcsi_toml_event *material = lrcsi_draft_find(draft, LRCSI_KEY_DEFAULT_MATERIAL);
    if (lrcsi_draft_number(draft, LRCSI_KEY_SCHEMA, 1.0) != 1.0) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_SCHEMA, LRCS_E_UNSUPPORTED,
                                        "1, the only schema that this version reads");
    }
    reader->recipe.name = lrcsi_draft_text(draft, LRCSI_KEY_NAME);
    reader->recipe.keep_transparent = keep ? keep->boolean : 0;
    if (material) {
        lrcs_binding *binding = &reader->recipe.binding[reader->recipe.binding_count++];
        memset(binding, 0, sizeof *binding);
        binding->kind = LRCS_BIND_DEFAULT;
        binding->material = material->text;
        binding->line = material->line;
    }
    return lrcsi_recipe_unit(draft, 0.0, &reader->unit);
}

/* The BRDF of a material: four numbers, or the name of a material of the library. */
static int read_brdf(const lrcsi_draft *draft, lrcs_brdf *brdf)
{
    static const int key[4] = {LRCSI_KEY_A, LRCSI_KEY_B, LRCSI_KEY_S, LRCSI_KEY_M};
    const char *like = lrcsi_draft_text(draft, LRCSI_KEY_LIKE);
    uint64_t missing = 0;
    int given = 0;
    for (int i = 0; i < 4; i++) {
        const lrcsi_toml_event *number = lrcsi_draft_find(draft, key[i]);
        given += number != NULL;
        missing |= number ? 0 : UINT64_C(1) << key[i];
        if (number && !(number->number[0] >= 0.0)) {
            return lrcsi_draft_refuse_value(draft, key[i], LRCS_E_NUMBER, "a number, 0 or more");
        }
    }
    if (like && given > 0) {
        return lrcsi_draft_refuse(draft, LRCS_E_NAME, "with like and numbers",
                                  "either like = \"...\" or all of A, B, s, m");
    }
    if (!like && missing != 0) {
        return lrcsi_draft_refuse_missing(draft, missing,
                                          "either like = \"...\" or all of A, B, s, m");
    }
    if (like) {
        const lrcs_brdf_entry *entry = lrcs_brdf_find(like);
        if (!entry) {
            return lrcsi_draft_refuse_value(draft, LRCSI_KEY_LIKE, LRCS_E_NAME,
                                            "the name of a material of the library");
        }
        *brdf = entry->brdf;
        return LRCS_OK;
    }
    *brdf = (lrcs_brdf){lrcsi_draft_number(draft, LRCSI_KEY_A, 0.0) + 0.0,
                        lrcsi_draft_number(draft, LRCSI_KEY_B, 0.0) + 0.0,
                        lrcsi_draft_number(draft, LRCSI_KEY_S, 0.0) + 0.0,
                        lrcsi_draft_number(draft, LRCSI_KEY_M, 0.0) + 0.0};
    int status = lrcs_brdf_check(brdf);
    return status < 0 ? lrcsi_draft_refuse_value(draft, LRCSI_KEY_S, status,
                                                 "above 0 (0 only together with A = 0)")
                      : LRCS_OK;
}

/* The standard deviations and correlations of the four numbers. Where they are not given, those of
   the library for `like`, else 0. */
static int read_brdf_error(const lrcsi_draft *draft, const lrcs_brdf *brdf, lrcs_brdf_error *error)
{
    static const int key[4] = {LRCSI_KEY_A_ERROR, LRCSI_KEY_B_ERROR, LRCSI_KEY_S_ERROR,
                               LRCSI_KEY_M_ERROR};
    double value[4];
    const char *like = lrcsi_draft_text(draft, LRCSI_KEY_LIKE);
    lrcs_brdf_error library;
    memset(&library, 0, sizeof library);
    if (like) {
        library = lrcs_brdf_find(like)->error;
    }
    const double fallback[4] = {library.A, library.B, library.s, library.m};
    memset(error, 0, sizeof *error);
    for (int i = 0; i < 4; i++) {
        value[i] = lrcsi_draft_number(draft, key[i], fallback[i]) + 0.0;
        if (!(value[i] >= 0.0)) {
            return lrcsi_draft_refuse_value(draft, key[i], LRCS_E_NUMBER, "a number, 0 or more");
        }
    }
    error->A = value[0];
    error->B = value[1];
    error->s = value[2];
    error->m = value[3];
    const lrcsi_toml_event *correlation = lrcsi_draft_find(draft, LRCSI_KEY_CORRELATION);
    for (int i = 0; correlation && i < 6; i++) {
        error->correlation[i] = correlation->number[i];
    }
    int status = lrcs_brdf_error_check(brdf, error);
    if (status == LRCS_E_ARGUMENT) {
        return lrcsi_draft_refuse(draft, status, "with an error of A or s",
                                  "no A_error and no s_error where s is 0");
    }
    return status != LRCS_OK /* only correlations can be wrong */
               ? lrcsi_draft_refuse_value(draft, LRCSI_KEY_CORRELATION, status,
                                          "correlations of A and B, A and s, A and m, B and s, B "
                                          "and m, s and m: a matrix without negative eigenvalues")
               : LRCS_OK;
}

/* Makes a material from its finished draft. */
static int finish_material(recipe_reader *reader)
{
    const lrcsi_draft *draft = &reader->draft;
    const lrcsi_toml_event *two_sided = lrcsi_draft_find(draft, LRCSI_KEY_TWO_SIDED);
    const lrcsi_toml_event *assumed = lrcsi_draft_find(draft, LRCSI_KEY_ASSUMED);
    lrcs_recipe_material *material = &reader->recipe.material[reader->recipe.material_count];
    memset(material, 0, sizeof *material);
    material->name = lrcsi_draft_text(draft, LRCSI_KEY_NAME);
    material->two_sided = two_sided ? two_sided->boolean : -1;
    material->line = draft->header.line;
    material->assumed = assumed ? assumed->boolean : 0;
    if (!material->name || material->name[0] == '\0') {
        return material->name
                   ? lrcsi_draft_refuse_value(draft, LRCSI_KEY_NAME, LRCS_E_NAME,
                                              "a name that is not empty")
                   : lrcsi_draft_refuse_missing(draft, LRCSI_KEY_BIT(NAME), "name = \"...\"");
    }
    reader->recipe.material_count++;
    int status = read_brdf(draft, &material->brdf);
    return status == LRCS_OK ? read_brdf_error(draft, &material->brdf, &material->error) : status;
}

/* Reads a colour, "#RRGGBB". */
static int read_colour(const char *text, unsigned char rgb[3])
{
    static const char digits[] = "0123456789abcdefABCDEF";
    if (strlen(text) != 7 || text[0] != '#' || strspn(text + 1, digits) != 6) {
        return LRCS_E_ARGUMENT;
    }
    for (int i = 0; i < 6; i++) {
        int digit = (int)(strchr(digits, text[1 + i]) - digits);
        digit = digit < 16 ? digit : digit - 6;
        rgb[i / 2] = (unsigned char)((i % 2 ? rgb[i / 2] << 4 : 0) | digit);
    }
    return LRCS_OK;
}

/* Makes a binding from a finished [[map]], which maps surfaces of models, by name or colour, to a
   material. */
static int finish_map(recipe_reader *reader)
{
    const lrcsi_draft *draft = &reader->draft;
    const char *name = lrcsi_draft_text(draft, LRCSI_KEY_NAME);
    const char *colour = lrcsi_draft_text(draft, LRCSI_KEY_COLOUR);
    const lrcsi_toml_event *material = lrcsi_draft_find(draft, LRCSI_KEY_MATERIAL);
    lrcs_binding *binding = &reader->recipe.binding[reader->recipe.binding_count];
    memset(binding, 0, sizeof *binding);
    if (!name == !colour) {
        return lrcsi_draft_refuse(draft, LRCS_E_NAME,
                                  name ? "with both name and colour" : "without name or colour",
                                  "either name = \"...\" or colour = \"...\"");
    }
    if (!material) {
        return lrcsi_draft_refuse_missing(draft, LRCSI_KEY_BIT(MATERIAL), "material = \"...\"");
    }
    if (colour && read_colour(colour, binding->rgb) != LRCS_OK) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_COLOUR, LRCS_E_ARGUMENT, "\"#RRGGBB\"");
    }
    binding->kind = colour ? LRCS_BIND_MAP_COLOUR : LRCS_BIND_MAP_NAME;
    binding->name = name;
    binding->material = material->text;
    binding->line = material->line;
    reader->recipe.binding_count++;
    return LRCS_OK;
}

/* Interprets the table that has just ended. */
static int finish_table(recipe_reader *reader)
{
    switch (reader->draft.table) {
    case LRCSI_TABLE_TOP:
        return finish_top(reader);
    case LRCSI_TABLE_MATERIAL:
        return finish_material(reader);
    case LRCSI_TABLE_MAP:
        return finish_map(reader);
    default: {
        lrcs_recipe_part *part = &reader->recipe.part[reader->recipe.part_count++];
        return lrcsi_recipe_part(&reader->draft, reader->unit, part);
    }
    }
}

/* The second pass: reads every table into the arrays, whose sizes the first pass has counted. */
static int read_tables(recipe_reader *reader)
{
    lrcsi_toml_event event;
    lrcsi_draft_start(&reader->toml, &reader->draft);
    for (;;) {
        int status = lrcsi_toml_next(&reader->toml, &event);
        if (status != LRCS_OK) {
            return status;
        }
        if (event.kind == LRCSI_TOML_END) {
            return finish_table(reader);
        }
        if (event.kind == LRCSI_TOML_KEY) {
            status = lrcsi_draft_add(&reader->draft, &event);
        } else { /* a header: it ends the table before it, unless it opens the joint of the same
                    part */
            int table = lrcsi_draft_table(&reader->draft, &event);
            status = table < 0                    ? table
                     : table == LRCSI_TABLE_JOINT ? LRCS_OK
                                                  : finish_table(reader);
            if (status == LRCS_OK) {
                lrcsi_draft_open(&reader->draft, table, &event);
            }
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
}

static int refuse_name(const recipe_reader *reader, uint32_t line, const char *item,
                       const char *expected, const char *name)
{
    const lrcsi_toml *toml = &reader->toml;
    size_t offset = lrcsi_toml_offset(toml->start, (size_t)(toml->end - toml->start), line);
    return lrcsi_where_text(toml->where, LRCS_E_NAME, offset, line, item, expected, name,
                            strlen(name));
}

/* Adds a name to the index; LRCS_E_NAME if it is there already. */
static int enter_name(lrcsi_index *names, uint32_t tag, const void *bytes, size_t size,
                      uint32_t value)
{
    if (lrcsi_index_find(names, tag, bytes, size) != LRCS_NONE) {
        return LRCS_E_NAME;
    }
    lrcsi_index_put(names, tag, bytes, size, value);
    return LRCS_OK;
}

/* Adds all names of parts, materials and maps to the index, and reports the first duplicate. */
static int enter_names(const recipe_reader *reader, lrcsi_index *names)
{
    const lrcs_recipe *recipe = &reader->recipe;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        const lrcs_recipe_part *part = &recipe->part[i];
        if (enter_name(names, TAG_PART, part->name, strlen(part->name), i) != LRCS_OK) {
            return refuse_name(reader, part->line, "[[part]]", "a name that no part above has",
                               part->name);
        }
    }
    for (uint32_t i = 0; i < recipe->material_count; i++) {
        const lrcs_recipe_material *one = &recipe->material[i];
        if (enter_name(names, TAG_MATERIAL, one->name, strlen(one->name), i) != LRCS_OK) {
            return refuse_name(reader, one->line, "[[material]]",
                               "a name that no material above has", one->name);
        }
    }
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        const lrcs_binding *map = &recipe->binding[i];
        if (map->kind == LRCS_BIND_MAP_NAME &&
            enter_name(names, TAG_MAP_NAME, map->name, strlen(map->name), i) != LRCS_OK) {
            return refuse_name(reader, map->line, "[[map]]", "a name mapped once", map->name);
        }
        if (map->kind == LRCS_BIND_MAP_COLOUR &&
            enter_name(names, TAG_MAP_COLOUR, map->rgb, sizeof map->rgb, i) != LRCS_OK) {
            return refuse_name(reader, map->line, "[[map]]", "a colour mapped once", map->material);
        }
    }
    return LRCS_OK;
}

/* Finds a material by its name: one of the recipe, else one of the library. Returned: the material;
   *own, its index in the recipe, or LRCS_NONE for one of the library; its source, as in
   <lrcs/scene.h>. */
static int resolve_name(const recipe_reader *reader, const lrcsi_index *names, const char *name,
                        uint32_t line, lrcs_recipe_material *material, uint32_t *own,
                        uint32_t *source)
{
    *own = lrcsi_index_find(names, TAG_MATERIAL, name, strlen(name));
    if (*own != LRCS_NONE) {
        *material = reader->recipe.material[*own];
        *source = *own + 1;
        return LRCS_OK;
    }
    const lrcs_brdf_entry *entry = lrcs_brdf_find(name);
    if (!entry) {
        return refuse_name(reader, line, "material",
                           "the name of a [[material]] or of one of the library", name);
    }
    *material = (lrcs_recipe_material){
        .name = entry->name, .brdf = entry->brdf, .two_sided = -1, .error = entry->error};
    *source = lrcsi_binder_library_source(entry);
    return LRCS_OK;
}

static int resolve_materials(recipe_reader *reader, const lrcsi_index *names)
{
    lrcs_recipe *recipe = &reader->recipe;
    lrcs_recipe_material material = {0};
    uint32_t own = LRCS_NONE;
    uint32_t source = 0;
    int status = LRCS_OK;
    for (uint32_t i = 0; status == LRCS_OK && i < recipe->binding_count; i++) {
        lrcs_binding *binding = &recipe->binding[i];
        status =
            resolve_name(reader, names, binding->material, binding->line, &material, &own, &source);
        if (status == LRCS_OK) {
            binding->brdf = material.brdf;
            binding->two_sided = material.two_sided;
            binding->assumed = material.assumed;
            binding->error = material.error;
            binding->source = source;
        }
    }
    for (uint32_t i = 0; status == LRCS_OK && i < recipe->part_count; i++) {
        lrcs_recipe_part *part = &recipe->part[i];
        if (part->material) {
            status = resolve_name(reader, names, part->material, part->material_line, &material,
                                  &own, &source);
            part->material_index = status == LRCS_OK && own != LRCS_NONE ? (int)own : -1;
        }
    }
    return status;
}

/* Replaces names of materials by the materials; reports duplicate and unknown names. */
static int resolve_names(recipe_reader *reader, lrcs_work *work)
{
    const lrcs_recipe *recipe = &reader->recipe;
    size_t mark = work->used;
    size_t total = (size_t)recipe->part_count + recipe->material_count + recipe->binding_count;
    lrcsi_index names;
    if (total >= LRCS_NONE || recipe->material_count > INT32_MAX) {
        return lrcsi_where_number(reader->toml.where, LRCS_E_LIMIT, 0, 0, "scene file",
                                  "fewer tables", total);
    }
    if (lrcsi_index_make(work, (uint32_t)total, &names) != LRCS_OK) {
        return out_of_memory(reader->toml.where);
    }
    int status = enter_names(reader, &names);
    if (status == LRCS_OK) {
        status = resolve_materials(reader, &names);
    }
    work->used = mark;
    return status;
}

static int read_recipe(recipe_reader *reader, const char *text, size_t size, lrcs_work *work,
                       lrcs_where *where)
{
    uint32_t count[3] = {0, 0, 0};
    int status = count_tables(text, size, where, count);
    if (status != LRCS_OK) {
        return status;
    }
    lrcs_recipe *recipe = &reader->recipe;
    recipe->part = lrcsi_work_take(work, count[0], sizeof *recipe->part);
    recipe->material = lrcsi_work_take(work, count[1], sizeof *recipe->material);
    recipe->binding = lrcsi_work_take(work, (size_t)count[2] + 1, sizeof *recipe->binding);
    if (!recipe->part || !recipe->material || !recipe->binding) {
        return out_of_memory(where);
    }
    status = lrcsi_toml_start(&reader->toml, text, size, work, where);
    if (status == LRCS_OK) {
        status = read_tables(reader);
    }
    if (status == LRCS_OK && recipe->part_count == 0) {
        return lrcsi_where_text(where, LRCS_E_EMPTY, size, reader->toml.line, "scene file",
                                "a [[part]]", "end of file", 11);
    }
    return status == LRCS_OK ? resolve_names(reader, work) : status;
}

int lrcs_recipe_read(const char *text, size_t size, lrcs_work *work, lrcs_recipe *recipe,
                     lrcs_where *where)
{
    recipe_reader reader;
    size_t mark = work->used;
    memset(&reader, 0, sizeof reader);
    int status = read_recipe(&reader, text, size, work, where);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *recipe = reader.recipe;
    return LRCS_OK;
}
