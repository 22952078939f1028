/* SPDX-License-Identifier: MIT */
/* Decides which sectors are integrated over what the part itself leaves visible of their patches.
   The integral over a patch: integrate/wall/patch.h. */
#include "integrate/wall/clear_sectors.h"

#include "base/work.h"
#include "integrate/wall/patch.h"
#include "scene/proximity.h"

typedef struct sectors_job {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_masked_band *band; /* NULL: there is one part alone, and the arrays are not used */
    const lrcsi_visible_area *visible;
    int derivatives;
    unsigned char *alone; /* facet: does it meet no band of another part? On curved walls only */
    uint32_t *group;      /* facet: connected facets that meet none have the same group */
    unsigned char *seen;  /* group: is something of one of its facets visible? */
} sectors_job;

size_t lrcsi_clear_sectors_need(const lrcs_prepared *prepared)
{
    const size_t facets = prepared->scene->facet_count;
    return lrcsi_work_add(lrcsi_work_blocks(2, facets, 1),
                          lrcsi_work_bytes(facets, sizeof(uint32_t)));
}

/* Is a facet on a curved wall, and does it meet no band of another part? */
static int is_alone(const sectors_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t part = p->scene->facet_part[facet];
    return !p->skip[facet] && lrcsi_patch_exists(p, facet) &&
           (!job->band || lrcsi_part_set_without(job->band->whole->parts[facet], part) == 0);
}

/* Do other parts provably hide nothing of a facet on a curved wall, and of its patch? */
static int is_clear(const sectors_job *job, uint32_t facet)
{
    return job->band ? job->alone[facet] && job->seen[job->group[facet]] : is_alone(job, facet);
}

/* Can the laser see the inside of a facet's part, and does that reflect? */
static int inside_reflects(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    if (lrcsi_proximity_openings(p, p->scene->facet_part[facet]) == 0) {
        return 0;
    }
    return view->facing[facet] < 0
               ? lrcsi_view_reflects(view, facet)
               : view->backs.reflect && p->redundant[facet] != LRCSI_REDUNDANT_IN_SOLID &&
                     lrcsi_prepared_material(p, facet)->two_sided;
}

/* Of a facet that is clear: may its patch be at the limb, partly facing the laser and partly facing
   away, or may the shadow of the part's rim end on it? */
static int is_candidate(const sectors_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const double turn = lrcsi_patch_part(view->prepared, facet)->bounds.patch.turn;
    return lrcsi_view_may_show_both(view, facet, turn) ||
           (view->facing[facet] < 0 && job->band && job->band->whole->parts[facet] != 0 &&
            inside_reflects(view, facet));
}

/* What a patch adds to the terms of a facet. */
static void add_patch(const lrcsi_patch *patch, lrcsi_wall_terms *to)
{
    const double area = patch->facet_area;
    to->sum.glint += area * patch->glint;
    to->sum.diffuse += area * patch->diffuse;
    to->sum.glint_u += area * patch->glint_u;
    to->sum.diffuse_log += area * patch->diffuse_log;
    to->sum.rounding += area * patch->rounding + 4 * LRCSI_U * (to->sum.glint + to->sum.diffuse);
    to->sum.remainder += area * patch->remainder;
}

/* Integrates over the patch of a sector, given one of its facets: over what is visible of its
   inside, and its outside if it may face the laser. Returns 0 if an integral is not known. */
static int patch_integrate_sides(const sectors_job *job, const lrcsi_rim_shadow *shadow,
                                 uint32_t facet, lrcsi_wall_terms *terms)
{
    const lrcsi_view *view = job->view;
    const lrcs_brdf brdf =
        lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(view->prepared, facet));
    const double turn = lrcsi_patch_part(view->prepared, facet)->bounds.patch.turn;
    *terms = (lrcsi_wall_terms){.way = LRCSI_WALL_PATCH};
    for (int side = 1; side >= -1; side -= 2) {
        lrcsi_patch patch;
        if (side > 0 ? !lrcsi_view_may_face(view, facet, turn) : !inside_reflects(view, facet)) {
            continue;
        }
        if (!lrcsi_patch_make_side(view, job->plan, &brdf, facet, side > 0 ? NULL : shadow,
                                   job->derivatives, &patch)) {
            return 0;
        }
        add_patch(&patch, terms);
    }
    return 1;
}

/* Makes the terms of a candidate's sector, if other parts hide nothing of its other facet either.
   They belong to the given facet. */
static void sector_make(const sectors_job *job, const lrcsi_rim_shadow *shadow, uint32_t facet,
                        lrcsi_wall_terms *terms)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    const uint32_t partner = lrcsi_patch_partner(p, facet);
    lrcsi_wall_patch at;
    if (!lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet, &at)) {
        return;
    }
    const int is_shared = at.facets == 2 && !p->skip[partner];
    if ((is_shared && !is_clear(job, partner)) ||
        !patch_integrate_sides(job, shadow, facet, &terms[facet])) {
        terms[facet].way = LRCSI_WALL_FACET;
    } else if (is_shared) {
        terms[partner] = (lrcsi_wall_terms){.way = LRCSI_WALL_PATCH};
    }
}

/* Finds the facets that meet no band of another part, their groups, and the groups of which
   something is visible. Returns 0 if there are none, or no memory. */
static int find_groups(sectors_job *job, lrcs_work *work)
{
    const uint32_t facets = job->view->prepared->scene->facet_count;
    int any = 0;
    job->alone = lrcsi_work_take(work, facets, 1);
    job->group = lrcsi_work_take(work, facets, sizeof *job->group);
    job->seen = lrcsi_work_take_zero(work, facets, 1);
    if (!job->alone || !job->group || !job->seen) {
        return 0;
    }
    for (uint32_t f = 0; f < facets; f++) {
        job->alone[f] = (unsigned char)is_alone(job, f);
        any |= job->alone[f];
    }
    if (any) {
        lrcsi_proximity_band_join(job->band->whole, job->alone, 0, job->group);
    }
    for (uint32_t f = 0; f < facets && any; f++) {
        job->seen[job->group[f]] |= job->alone[f] && job->visible[f].low > 0;
    }
    return any;
}

/* Makes the terms of all sectors of a part. */
static void part_make(const sectors_job *job, const lrcs_part *part, lrcsi_wall_terms *terms)
{
    const lrcsi_rim_shadow shadow = lrcsi_rim_shadow_make(part, job->view->unit);
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (terms[f].way == LRCSI_WALL_FACET && is_clear(job, f) && is_candidate(job, f)) {
            sector_make(job, &shadow, f, terms);
        }
    }
}

void lrcsi_clear_sectors_make(const lrcsi_view *view, const lrcsi_plan *plan,
                              const lrcsi_clear_shapes *clear, const lrcsi_masked_band *band,
                              const lrcsi_visible_area *visible, int derivatives, lrcs_work *work,
                              lrcsi_wall_terms *terms)
{
    const lrcs_scene *scene = view->prepared->scene;
    const size_t mark = work->used;
    sectors_job job = {
        .view = view, .plan = plan, .band = band, .visible = visible, .derivatives = derivatives};
    const int any = plan->patches && (!band || find_groups(&job, work));
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        terms[f].way = LRCSI_WALL_FACET;
    }
    for (uint32_t i = 0; i < scene->part_count && any; i++) {
        if (!lrcsi_is_clear_shape(clear, i)) {
            part_make(&job, &scene->part[i], terms);
        }
    }
    work->used = mark;
}
