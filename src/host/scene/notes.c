/* SPDX-License-Identifier: MIT */
/* Notices to be given before any result: materials that are assumed or not bound, sizes that
   depend on an assumed unit, and maps of a scene file that match no material. It decides what to
   report, and changes nothing. */
#include "host/scene/notes.h"

#include "host/scene/binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The usual sizes of spacecraft and their parts, m. */
#define SIZE_USUAL_MIN 0.1
#define SIZE_USUAL_MAX 200.0

/* ---- sizes ---- */

/* The box of facets first .. first + count - 1 except those left out. Returns 0 if there are
   none. */
static int facets_box(const lrcs_scene *scene, uint32_t first, uint32_t count, double box_min[3],
                      double box_max[3])
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = first; i < first + count; i++) {
        if (scene->material[scene->facet_material[i]].omitted) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const double *x = scene->vertex[scene->facet[i].corner[k]].x;
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = x[axis] < low[axis] ? x[axis] : low[axis];
                high[axis] = x[axis] > high[axis] ? x[axis] : high[axis];
            }
        }
    }
    if (!(low[0] <= high[0])) {
        return 0;
    }
    memcpy(box_min, low, sizeof low);
    memcpy(box_max, high, sizeof high);
    return 1;
}

int lrcs_host_scene_tessellated(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->part_count; i++) {
        const lrcs_part *part = &scene->part[i];
        if (part->kind >= 0 && (part->bounds.patch.turn > 0.0 || !part->bounds.known)) {
            return 1;
        }
    }
    return 0;
}

void lrcs_host_scene_box(const lrcs_scene *scene, double box_min[3], double box_max[3])
{
    if (!facets_box(scene, 0, scene->facet_count, box_min, box_max)) {
        memset(box_min, 0, 3 * sizeof *box_min);
        memset(box_max, 0, 3 * sizeof *box_max);
    }
}

/* A model without a stated unit: the assumed unit and, if that is unlikely, a likelier one. */
static void unit_note(lrcs_host_scene *host, uint32_t part)
{
    static const struct {
        const char *name;
        double metres;
    } unit[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"ft", 0.3048}};
    const lrcs_recipe_part *given = &host->recipe.part[part];
    const lrcs_part *placed = &host->scene.part[part];
    double low[3] = {0.0, 0.0, 0.0};
    double high[3] = {0.0, 0.0, 0.0};
    facets_box(&host->scene, placed->first_facet, placed->facet_count, low, high);
    double size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    char others[200] = "";
    size_t used = 0;
    if (!given->file || given->unit_m > 0.0 || !(size > 0.0)) {
        return;
    }
    if (size >= SIZE_USUAL_MIN && size <= SIZE_USUAL_MAX) {
        lrcsi_host_note(&host->notices,
                        "%s: no unit is stated: metres are assumed, it is %.4g m across",
                        given->name, size);
        return;
    }
    for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++) {
        double other = size * unit[i].metres;
        if (other >= SIZE_USUAL_MIN && other <= SIZE_USUAL_MAX) {
            used += (size_t)snprintf(others + used, sizeof others - used, "%s%.4g m in %s",
                                     used ? ", " : ": it would be ", other, unit[i].name);
        }
    }
    lrcsi_host_note(&host->notices,
                    "%s: no unit is stated: metres are assumed, but it is %.4g m across, which is "
                    "unlikely for a spacecraft%s (state its unit)",
                    given->name, size, others);
}

/* ---- maps ---- */

/* Does a material of a model have the name or the colour that a map binds? */
static int map_matches(const lrcs_host_scene *host, const lrcs_binding *binding)
{
    for (uint32_t i = 0; i < host->recipe.part_count; i++) {
        const lrcs_mesh *model = &host->model[i];
        for (uint32_t k = 0; host->recipe.part[i].file && k < model->material_count; k++) {
            const lrcs_surface *surface = &model->material[k];
            if (binding->kind == LRCS_BIND_MAP_NAME
                    ? strcmp(surface->name, binding->name) == 0
                    : surface->has_colour &&
                          memcmp(surface->rgb, binding->rgb, sizeof surface->rgb) == 0) {
                return 1;
            }
        }
    }
    return 0;
}

#define NEAREST_MAX 4u /* names reported */

/* A map of a scene file that matches no material of a model; for a name, the nearest ones. */
static void map_note(lrcs_host_scene *host, const lrcs_binding *binding)
{
    int named = binding->kind == LRCS_BIND_MAP_NAME;
    if ((!named && binding->kind != LRCS_BIND_MAP_COLOUR) || map_matches(host, binding)) {
        return;
    }
    if (!named) {
        lrcsi_host_note(
            &host->notices,
            "[[map]] colour = \"#%02X%02X%02X\": no material of a model has that colour",
            binding->rgb[0], binding->rgb[1], binding->rgb[2]);
        return;
    }
    const char *near[NEAREST_MAX];
    char list[400] = "";
    size_t used = 0;
    uint32_t count = 0;
    const char *const *names = lrcsi_host_binding_names(host, LRCS_BIND_MAP_NAME, &count);
    uint32_t found =
        names ? lrcs_host_names_near(binding->name, names, count, near, NEAREST_MAX) : 0;
    for (uint32_t i = 0; i < found; i++) {
        used += (size_t)snprintf(list + used, sizeof list - used, "%s'%.60s'",
                                 i > 1   ? ", "
                                 : i > 0 ? ", then "
                                         : "; the nearest is ",
                                 near[i]);
    }
    lrcsi_host_note(&host->notices,
                    "[[map]] name = \"%.200s\": no material of a model has that name%s",
                    binding->name, list);
}

/* ---- assigned materials ---- */

static int brdf_equals(const lrcs_brdf *a, const lrcs_brdf *b)
{
    return a->A == b->A && a->B == b->B && a->s == b->s && a->m == b->m;
}

static void material_notes(lrcs_host_notices *notices, const lrcs_material *material)
{
    const lrcs_brdf_entry *library = lrcs_brdf_library(0);
    for (uint32_t i = 0; library && !brdf_equals(&library->brdf, &material->brdf);) {
        library = lrcs_brdf_library(++i);
    }
    const char *name = material->name[0] ? material->name : "(default)";
    int warnings = lrcs_brdf_check(&material->brdf);
    if (library && material->brdf_given && library->source) {
        lrcsi_host_note(notices,
                        "library material '%s': solar reflectance of %s; Lambert's law is assumed",
                        library->name, library->source);
    } else if (library && material->brdf_given && material->source >= LRCS_SOURCE_LIBRARY) {
        lrcsi_host_note(notices, "library material '%s': its values are illustrative, not measured",
                        library->name);
    } else if (library && material->brdf_given) {
        lrcsi_host_note(notices,
                        "material '%s': its numbers equal those of the library's %s, which are "
                        "illustrative, not measured",
                        name, library->name);
    }
    for (int bit = 1; warnings > 0 && bit <= warnings; bit *= 2) {
        if (warnings & bit) {
            lrcsi_host_note(notices, "material '%s': %s", name, lrcs_brdf_warning_text(bit));
        }
    }
}

/* Facets whose materials the scene file marks as assumed; their numbers, if all have the same. */
static void assumed_note(lrcs_host_scene *host, uint64_t count, const lrcs_brdf *same)
{
    char facets[64];
    char numbers[128] = "";
    if (count == host->scene.facet_count) {
        snprintf(facets, sizeof facets, "all %llu facets", (unsigned long long)count);
    } else {
        snprintf(facets, sizeof facets, "%llu of %lu facets", (unsigned long long)count,
                 (unsigned long)host->scene.facet_count);
    }
    if (same) {
        snprintf(numbers, sizeof numbers, ": A=%g, B=%g, s=%g, m=%g", same->A, same->B, same->s,
                 same->m);
    }
    lrcsi_host_note(&host->notices,
                    "%s have GUESSED materials (assumed = true in the scene file)%s", facets,
                    numbers);
}

/* Counts facets that are left out, and those without a given material; checks the materials that
   are assigned to facets. */
static void scene_notes(lrcs_host_scene *host)
{
    const lrcs_scene *scene = &host->scene;
    const lrcs_brdf *guess = NULL; /* of the first assumed material */
    int same = 1;                  /* have all assumed materials its numbers? */
    uint32_t *facets = calloc((size_t)scene->material_count + 1, sizeof *facets); /* by material */
    if (!facets) {
        return;
    }
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        facets[scene->facet_material[i]]++;
    }
    uint64_t omitted = 0;
    uint64_t unassigned = 0;
    uint64_t assumed = 0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const lrcs_material *material = &scene->material[i];
        if (facets[i] == 0) {
            continue;
        }
        if (material->omitted) {
            omitted += facets[i];
            continue;
        }
        if (!material->brdf_given && material->source == 0) {
            unassigned += facets[i];
        } else if (!material->brdf_given) {
            assumed += facets[i];
            guess = guess ? guess : &material->brdf;
            same = same && brdf_equals(&material->brdf, guess);
        }
        material_notes(&host->notices, material);
    }
    free(facets);
    if (omitted > 0) {
        lrcsi_host_note(
            &host->notices,
            "%llu fully transparent facets are left out (--keep-transparent keeps them)",
            (unsigned long long)omitted);
    }
    if (unassigned > 0) {
        lrcsi_host_note(
            &host->notices,
            "%llu of %lu facets have no material assigned: they have A=1, B=0.25, s=0.2, "
            "m=0.5 (--material assigns one)",
            (unsigned long long)unassigned, (unsigned long)scene->facet_count);
    }
    if (assumed > 0) {
        assumed_note(host, assumed, same ? guess : NULL);
    }
    if (scene->facet_count == 0) {
        lrcsi_host_note(&host->notices, "the scene holds no facets");
    }
}

/* ---- all ---- */

void lrcsi_host_scene_notes(lrcs_host_scene *host, uint32_t kept)
{
    while (host->notices.count > kept) {
        free(host->notices.text[--host->notices.count]);
    }
    scene_notes(host);
    for (uint32_t i = 0; i < host->recipe.part_count; i++) {
        unit_note(host, i);
    }
    for (uint32_t i = 0; i < host->recipe.binding_count; i++) {
        map_note(host, &host->recipe.binding[i]);
    }
}
