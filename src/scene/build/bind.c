/* SPDX-License-Identifier: MIT */
/* Assigns materials to surfaces: decides which binding has precedence, and which bindings matched.
   It does not decide where names come from, nor which surface a facet has. */
#include "scene/build/bind.h"

#include <string.h>

#include "base/work.h"

/* Surfaces of at least this transparency are omitted from the scene. */
#define TRANSPARENCY_OMITTED 0.995
/* The index holds the recipe's materials under this tag; the other tags are kinds of bindings. */
#define TAG_RECIPE (LRCS_BIND_DEFAULT + 1)

/* The key of a binding: its name, its colour, or nothing. */
static const void *key_of(const lrcs_binding *binding, size_t *size)
{
    switch (binding->kind) {
    case LRCS_BIND_NAME:
    case LRCS_BIND_MAP_NAME:
        *size = strlen(binding->name);
        return binding->name;
    case LRCS_BIND_COLOUR:
    case LRCS_BIND_MAP_COLOUR:
        *size = sizeof binding->rgb;
        return binding->rgb;
    default:
        *size = 0;
        return "";
    }
}

size_t lrcsi_binder_need(const lrcs_recipe *recipe)
{
    return lrcsi_work_add(lrcsi_index_need((size_t)recipe->binding_count + recipe->material_count),
                          lrcsi_work_bytes(recipe->binding_count, 1));
}

lrcsi_binder lrcsi_binder_plain(const lrcs_recipe *recipe)
{
    lrcsi_binder binder;
    memset(&binder, 0, sizeof binder);
    binder.recipe = recipe;
    return binder;
}

/* The index of the last binding of a kind with a key or, for TAG_RECIPE, of the recipe's material
   of that name; LRCS_NONE if there is none. */
static uint32_t find_index(const lrcsi_binder *binder, int tag, const void *bytes, size_t size)
{
    if (binder->indexed) {
        return lrcsi_index_find(&binder->names, (uint32_t)tag, bytes, size);
    }
    const lrcs_recipe *recipe = binder->recipe;
    for (uint32_t i = tag == TAG_RECIPE ? recipe->material_count : 0; i-- > 0;) {
        const char *name = recipe->material[i].name;
        if (strlen(name) == size && memcmp(name, bytes, size) == 0) {
            return i;
        }
    }
    for (uint32_t i = recipe->binding_count; i-- > 0;) {
        size_t key_size;
        if (recipe->binding[i].kind == tag) {
            const void *key = key_of(&recipe->binding[i], &key_size);
            if (key_size == size && memcmp(key, bytes, size) == 0) {
                return i;
            }
        }
    }
    return LRCS_NONE;
}

/* Finds the binding of a kind and key, and marks it as matched; NULL if there is none. */
static const lrcs_binding *find_binding(lrcsi_binder *binder, int kind, const void *bytes,
                                        size_t size)
{
    uint32_t i = find_index(binder, kind, bytes, size);
    if (i == LRCS_NONE) {
        return NULL;
    }
    if (binder->matched) {
        binder->matched[i] = 1;
    }
    return &binder->recipe->binding[i];
}

static const lrcs_binding *find_named(lrcsi_binder *binder, int kind, const char *name)
{
    return find_binding(binder, kind, name, strlen(name));
}

int lrcsi_binder_make(const lrcs_recipe *recipe, lrcs_work *work, lrcsi_binder *binder)
{
    size_t total = (size_t)recipe->binding_count + recipe->material_count;
    *binder = lrcsi_binder_plain(recipe);
    binder->matched = lrcsi_work_take_zero(work, recipe->binding_count, 1);
    if (!binder->matched || total >= LRCS_NONE ||
        lrcsi_index_make(work, (uint32_t)total, &binder->names) != LRCS_OK) {
        return LRCS_E_MEMORY;
    }
    binder->indexed = 1;
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        size_t size;
        const void *key = key_of(&recipe->binding[i], &size);
        lrcsi_index_put(&binder->names, (uint32_t)recipe->binding[i].kind, key, size, i);
    }
    for (uint32_t i = 0; i < recipe->material_count; i++) {
        const char *name = recipe->material[i].name;
        lrcsi_index_put(&binder->names, TAG_RECIPE, name, strlen(name), i);
        find_named(binder, LRCS_BIND_NAME, name); /* a defined material counts as a match */
    }
    return LRCS_OK;
}

uint32_t lrcsi_binder_material_count(const lrcs_recipe *recipe)
{
    uint32_t library = 0;
    while (lrcs_brdf_library(library)) {
        library++;
    }
    return recipe->material_count + library;
}

int lrcsi_binder_assigned(const lrcsi_binder *binder, const lrcs_recipe_part *part,
                          uint32_t *assigned)
{
    const lrcs_recipe *recipe = binder->recipe;
    *assigned = LRCS_NONE;
    if (!part->material) {
        return LRCS_OK;
    }
    if (part->material_index >= 0 && (uint32_t)part->material_index < recipe->material_count) {
        *assigned = (uint32_t)part->material_index;
        return LRCS_OK;
    }
    *assigned = find_index(binder, TAG_RECIPE, part->material, strlen(part->material));
    const lrcs_brdf_entry *entry;
    for (uint32_t i = 0; *assigned == LRCS_NONE && (entry = lrcs_brdf_library(i)) != NULL; i++) {
        if (strcmp(entry->name, part->material) == 0) {
            *assigned = recipe->material_count + i;
        }
    }
    return *assigned == LRCS_NONE ? LRCS_E_NAME : LRCS_OK;
}

uint32_t lrcsi_binder_library_source(const lrcs_brdf_entry *entry)
{
    uint32_t i = 0;
    while (lrcs_brdf_library(i) != entry) {
        i++;
    }
    return LRCS_SOURCE_LIBRARY + i;
}

/* Assigns a BRDF with its errors. A negative two_sided leaves the material's own. A material with
   assumed parameters does not count as bound. `source` is as in <lrcs/scene.h>. */
static void assign_brdf(lrcs_material *material, const lrcs_brdf *brdf,
                        const lrcs_brdf_error *error, uint32_t source, int two_sided, int assumed)
{
    material->brdf = *brdf;
    material->error = *error;
    material->source = source;
    material->brdf_given = !assumed;
    if (two_sided >= 0) {
        material->two_sided = two_sided != 0;
    }
}

/* Assigns the BRDF of a material of the library. */
static void assign_by_library(const lrcs_brdf_entry *entry, lrcs_material *material)
{
    assign_brdf(material, &entry->brdf, &entry->error, lrcsi_binder_library_source(entry), -1, 0);
}

/* Assigns the BRDF of a binding. The recipe's materials are sources 1, 2, ...; the bindings follow,
   except those that have their own source. */
static void assign_by_binding(const lrcsi_binder *binder, const lrcs_binding *binding,
                              lrcs_material *material)
{
    const lrcs_recipe *recipe = binder->recipe;
    uint32_t own = 1 + recipe->material_count + (uint32_t)(binding - recipe->binding);
    assign_brdf(material, &binding->brdf, &binding->error,
                binding->source != 0 ? binding->source : own, binding->two_sided, binding->assumed);
}

/* If the command line binds a material of this name, which the scene file assigned, its BRDF
   replaces that of the scene file. */
static void override_named(lrcsi_binder *binder, const char *name, lrcs_material *material)
{
    const lrcs_binding *binding = name ? find_named(binder, LRCS_BIND_NAME, name) : NULL;
    if (binding) {
        assign_by_binding(binder, binding, material);
    }
}

/* Assigns the material that a scene file gives to a whole part: one of the recipe or of the
   library. */
static void assign_material(lrcsi_binder *binder, uint32_t assigned, lrcs_material *material)
{
    const lrcs_recipe *recipe = binder->recipe;
    const char *name;
    if (assigned < recipe->material_count) {
        name = recipe->material[assigned].name;
        assign_brdf(material, &recipe->material[assigned].brdf, &recipe->material[assigned].error,
                    assigned + 1, recipe->material[assigned].two_sided,
                    recipe->material[assigned].assumed);
    } else {
        const lrcs_brdf_entry *entry = lrcs_brdf_library(assigned - recipe->material_count);
        name = entry->name;
        assign_by_library(entry, material);
    }
    override_named(binder, name, material);
    material->name = material->name ? material->name : name;
}

/* Applies a map or the default of a scene file. */
static void apply_binding(lrcsi_binder *binder, const lrcs_binding *binding,
                          lrcs_material *material)
{
    assign_by_binding(binder, binding, material);
    override_named(binder, binding->material, material);
}

/* Applies the default of the recipe; if there is none, lrcs_brdf_default. */
static void apply_default(lrcsi_binder *binder, lrcs_material *material)
{
    const lrcs_binding *binding = find_named(binder, LRCS_BIND_DEFAULT, "");
    if (binding) {
        apply_binding(binder, binding, material);
    } else {
        material->brdf = lrcs_brdf_default();
    }
}

lrcs_material lrcsi_binder_unassigned(lrcsi_binder *binder, uint32_t assigned)
{
    lrcs_material material;
    memset(&material, 0, sizeof material);
    material.name = NULL;
    if (assigned != LRCS_NONE) {
        assign_material(binder, assigned, &material);
    } else {
        material.name = "";
        apply_default(binder, &material);
    }
    return material;
}

/* Applies the scene file's maps, the library and the default to a surface. */
static void apply_map(lrcsi_binder *binder, const lrcs_surface *surface, lrcs_material *material)
{
    const lrcs_binding *map = find_named(binder, LRCS_BIND_MAP_NAME, surface->name);
    if (!map && surface->has_colour) {
        map = find_binding(binder, LRCS_BIND_MAP_COLOUR, surface->rgb, sizeof surface->rgb);
    }
    const lrcs_brdf_entry *entry = lrcs_brdf_find(surface->name);
    if (map) {
        apply_binding(binder, map, material);
    } else if (entry) {
        assign_by_library(entry, material);
    } else {
        apply_default(binder, material);
    }
}

lrcs_material lrcsi_binder_surface(lrcsi_binder *binder, uint32_t assigned,
                                   const lrcs_surface *surface)
{
    const lrcs_binding *name = find_named(binder, LRCS_BIND_NAME, surface->name);
    const lrcs_binding *colour =
        surface->has_colour
            ? find_binding(binder, LRCS_BIND_COLOUR, surface->rgb, sizeof surface->rgb)
            : NULL;
    lrcs_material material;
    memset(&material, 0, sizeof material);
    material.name = surface->name;
    memcpy(material.rgb, surface->rgb, sizeof material.rgb);
    material.has_colour = surface->has_colour;
    material.two_sided = surface->two_sided;
    material.omitted =
        !binder->recipe->keep_transparent && surface->transparency >= TRANSPARENCY_OMITTED;
    if (name || colour) {
        const lrcs_binding *binding = name ? name : colour;
        assign_by_binding(binder, binding, &material);
    } else if (assigned != LRCS_NONE) {
        assign_material(binder, assigned, &material);
    } else {
        apply_map(binder, surface, &material);
    }
    return material;
}

uint32_t lrcsi_binder_unmatched(const lrcsi_binder *binder)
{
    const lrcs_recipe *recipe = binder->recipe;
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        const lrcs_binding *binding = &recipe->binding[i];
        if (binding->kind == LRCS_BIND_NAME || binding->kind == LRCS_BIND_COLOUR) {
            size_t size;
            const void *key = key_of(binding, &size);
            if (!binder->matched[find_index(binder, binding->kind, key, size)]) {
                return i;
            }
        }
    }
    return LRCS_NONE;
}
