/* SPDX-License-Identifier: MIT */
/* Which materials a binding stands for if none has its name: its name contains * or ?, or differs
   in case. Such bindings are replaced by bindings of the names that they match. The core
   decides which binding a surface gets: the last one for its name. Therefore patterns come first in
   the list, then names that differ in case, and exact names last. */
#include "host/scene/binding.h"

#include <string.h>

#include "host/scene/names.h"

enum binding_rank { RANK_PATTERN, RANK_FOLDED, RANK_EXACT, RANKS };

typedef struct binding_names {
    const char *const *name;
    uint32_t count;
} binding_names;

/* How a binding's name is interpreted, and the names that it then matches. */
typedef struct binding_match {
    int rank;          /* binding_rank */
    int fold;          /* 1: letters of either case match */
    uint32_t count;    /* number of names that match */
    const char *first; /* of them, or "" */
} binding_match;

/* ---- existing names ---- */

const char *const *lrcsi_host_binding_names(lrcs_host_scene *scene, int kind, uint32_t *count)
{
    const lrcs_recipe *recipe = &scene->recipe;
    uint32_t most = recipe->part_count + recipe->material_count + recipe->binding_count;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        most += scene->model[i].material_count;
    }
    const char **list = lrcsi_host_take(scene, (size_t)most + 1, sizeof *list);
    uint32_t used = 0;
    for (uint32_t i = 0; list && i < recipe->part_count; i++) {
        const lrcs_mesh *model = &scene->model[i];
        for (uint32_t k = 0; k < model->material_count; k++) {
            list[used++] = model->material[k].name;
        }
        if (kind == LRCS_BIND_NAME && recipe->part[i].material) {
            list[used++] = recipe->part[i].material;
        }
    }
    for (uint32_t i = 0; list && kind == LRCS_BIND_NAME && i < recipe->material_count; i++) {
        list[used++] = recipe->material[i].name;
    }
    for (uint32_t i = 0; list && kind == LRCS_BIND_NAME && i < recipe->binding_count; i++) {
        if (recipe->binding[i].material) {
            list[used++] = recipe->binding[i].material;
        }
    }
    *count = used;
    return (const char *const *)list;
}

/* ---- the names that a binding matches ---- */

static int is_named(const lrcs_binding *binding)
{
    return binding->kind == LRCS_BIND_NAME || binding->kind == LRCS_BIND_MAP_NAME;
}

static int is_match(const char *text, const char *name, const binding_match *match)
{
    return match->rank == RANK_PATTERN  ? lrcsi_name_matches(text, name, match->fold)
           : match->rank == RANK_FOLDED ? lrcsi_name_same_folded(text, name)
                                        : strcmp(text, name) == 0;
}

/* The strictest interpretation of a binding's name that matches any name: the exact name, a
   case-sensitive pattern, or a name or pattern without regard to case. If nothing matches, the
   exact name, so that the caller reports it. */
static binding_match binding_read(const lrcs_binding *binding, const binding_names *names)
{
    int pattern = is_named(binding) && lrcsi_name_is_pattern(binding->name);
    const binding_match reading[3] = {
        {.rank = RANK_EXACT, .first = ""},
        {.rank = pattern ? RANK_PATTERN : RANK_EXACT, .first = ""},
        {.rank = pattern ? RANK_PATTERN : RANK_FOLDED, .fold = 1, .first = ""}};
    for (int i = 0; i < 3 && is_named(binding); i++) {
        binding_match match = reading[i];
        for (uint32_t k = 0; k < names->count; k++) {
            if (is_match(binding->name, names->name[k], &match)) {
                match.first = match.count == 0 ? names->name[k] : match.first;
                match.count++;
            }
        }
        if (match.count > 0) {
            return match;
        }
    }
    return reading[0];
}

/* For a name that differs in case: the matching name, and whether there are others (a model read
   twice gives each name twice). */
static void folded_note(lrcs_host_scene *scene, const lrcs_binding *binding,
                        const binding_names *names, const binding_match *match)
{
    int map = binding->kind == LRCS_BIND_MAP_NAME;
    int others = 0;
    for (uint32_t i = 0; i < names->count; i++) {
        others |= strcmp(names->name[i], match->first) != 0 &&
                  is_match(binding->name, names->name[i], match);
    }
    lrcsi_host_note(&scene->notices,
                    "%s%.200s%s: no material has exactly that name; taken for '%.200s'%s, "
                    "ignoring case",
                    map ? "[[map]] name = \"" : "--material '", binding->name, map ? "\"" : "'",
                    match->first, others ? " and others" : "");
}

/* ---- the list ---- */

/* Appends the bindings of a rank, each replaced by those that it represents. Returns the new number
   of bindings. */
static uint32_t rank_add(const lrcs_recipe *recipe, const binding_names names[2],
                         const binding_match *match, int rank, lrcs_binding *all, uint32_t used)
{
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        const lrcs_binding *one = &recipe->binding[i];
        const binding_names *known = &names[one->kind == LRCS_BIND_MAP_NAME];
        if (match[i].rank != rank) {
            continue;
        }
        if (rank == RANK_EXACT) {
            all[used++] = *one;
            continue;
        }
        for (uint32_t k = 0; k < known->count; k++) {
            if (is_match(one->name, known->name[k], &match[i])) {
                all[used] = *one;
                all[used++].name = known->name[k];
            }
        }
    }
    return used;
}

int lrcsi_host_bindings_expand(lrcs_host_scene *scene, lrcs_host_error *error)
{
    lrcs_recipe *recipe = &scene->recipe;
    binding_names names[2]; /* for NAME and MAP_NAME */
    size_t total = 0;
    int changed = 0;
    binding_match *match = lrcsi_host_take(scene, (size_t)recipe->binding_count + 1, sizeof *match);
    names[0].name = lrcsi_host_binding_names(scene, LRCS_BIND_NAME, &names[0].count);
    names[1].name = lrcsi_host_binding_names(scene, LRCS_BIND_MAP_NAME, &names[1].count);
    if (!match || !names[0].name || !names[1].name) {
        return lrcsi_host_fail_memory(error, sizeof *match);
    }
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        const lrcs_binding *one = &recipe->binding[i];
        const binding_names *known = &names[one->kind == LRCS_BIND_MAP_NAME];
        match[i] = binding_read(one, known);
        if (match[i].fold) {
            folded_note(scene, one, known, &match[i]);
        }
        changed |= match[i].rank != RANK_EXACT;
        total += match[i].rank == RANK_EXACT ? 1 : match[i].count;
    }
    if (!changed) {
        return LRCS_OK;
    }
    lrcs_binding *all = total < LRCS_NONE ? lrcsi_host_take(scene, total, sizeof *all) : NULL;
    if (!all) {
        return lrcsi_host_fail_memory(error, total * sizeof *all);
    }
    uint32_t used = 0;
    for (int rank = 0; rank < RANKS; rank++) {
        used = rank_add(recipe, names, match, rank, all, used);
    }
    recipe->binding = all;
    recipe->binding_count = used;
    return LRCS_OK;
}
