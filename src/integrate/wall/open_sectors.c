/* SPDX-License-Identifier: MIT */
/* Decides which sectors of open walls are integrated over their patches. The integral over a patch:
   integrate/wall/patch.h. */
#include "integrate/wall/open_sectors.h"

#include <string.h>

#include "base/work.h"
#include "integrate/wall/patch.h"
#include "scene/proximity.h"

typedef struct open_job {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_masked_band *band;
    const lrcsi_visible_area *visible;
    int derivatives;
    unsigned char *alone; /* facet: does it meet no band of another part? On open walls only */
    uint32_t *group;      /* facet: connected facets that meet none have the same group */
    unsigned char *seen;  /* group: is something of one of its facets visible? */
} open_job;

size_t lrcsi_open_sectors_need(const lrcs_prepared *prepared)
{
    const size_t facets = prepared->scene->facet_count;
    return lrcsi_work_add(lrcsi_work_blocks(2, facets, 1),
                          lrcsi_work_bytes(facets, sizeof(uint32_t)));
}

/* Is a facet on the wall of an open part, and does it meet no band of another part? */
static int is_alone(const open_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t part = p->scene->facet_part[facet];
    return !p->skip[facet] && lrcsi_patch_exists(p, facet) &&
           lrcsi_proximity_openings(p, part) > 0 &&
           lrcsi_part_set_without(job->band->whole->parts[facet], part) == 0;
}

/* Of a facet that is alone: may the laser see both sides of its patch, or the shadow of the part's
   rim end on it? */
static int is_candidate(const open_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const double turn = lrcsi_patch_part(view->prepared, facet)->bounds.patch.turn;
    return lrcsi_view_reflects(view, facet) &&
           ((view->facing[facet] < 0 && job->band->whole->parts[facet] != 0) ||
            lrcsi_view_may_show_both(view, facet, turn));
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

/* May the inside of a facet's patch be visible, and reflect? */
static int inside_reflects(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return view->facing[facet] < 0
               ? lrcsi_view_reflects(view, facet)
               : view->backs.reflect && p->redundant[facet] != LRCSI_REDUNDANT_IN_SOLID &&
                     lrcsi_prepared_material(p, facet)->two_sided;
}

/* Integrates over the patch of a sector, given one of its facets: over what is visible of its
   inside, and its outside if it may face the laser. Returns 0 if an integral is not known. */
static int patch_integrate_sides(const open_job *job, const lrcsi_rim_shadow *shadow,
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

/* Makes the terms of a candidate's sector, if other parts hide nothing of it. */
static void open_sector_make(const open_job *job, const lrcsi_rim_shadow *shadow, uint32_t facet,
                             lrcsi_wall_terms *terms)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    const uint32_t partner = lrcsi_patch_partner(p, facet);
    lrcsi_wall_patch at;
    if (!job->seen[job->group[facet]] ||
        !lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet, &at)) {
        return;
    }
    const int is_shared = at.facets == 2 && !p->skip[partner];
    if ((is_shared && !job->alone[partner]) ||
        !patch_integrate_sides(job, shadow, facet, &terms[facet])) {
        terms[facet].way = LRCSI_WALL_FACET;
    } else if (is_shared) {
        terms[partner] = (lrcsi_wall_terms){.way = LRCSI_WALL_PATCH};
    }
}

/* Finds the facets that meet no band of another part. Returns 0 if there are none. */
static int find_alone(const open_job *job)
{
    const lrcs_scene *scene = job->view->prepared->scene;
    int any = 0;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        job->alone[f] = (unsigned char)is_alone(job, f);
        any |= job->alone[f];
    }
    return any;
}

/* Finds their groups, and those of which something is visible. */
static void find_groups(const open_job *job)
{
    const uint32_t facets = job->view->prepared->scene->facet_count;
    lrcsi_proximity_band_join(job->band->whole, job->alone, 0, job->group);
    memset(job->seen, 0, facets);
    for (uint32_t f = 0; f < facets; f++) {
        job->seen[job->group[f]] |= job->alone[f] && job->visible[f].low > 0;
    }
}

void lrcsi_open_sectors_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                             int derivatives, lrcs_work *work, lrcsi_wall_terms *terms)
{
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t facets = scene->facet_count;
    const size_t mark = work->used;
    const open_job job = {.view = view,
                          .plan = plan,
                          .band = band,
                          .visible = visible,
                          .derivatives = derivatives,
                          .alone = lrcsi_work_take(work, facets, 1),
                          .group = lrcsi_work_take(work, facets, sizeof(uint32_t)),
                          .seen = lrcsi_work_take(work, facets, 1)};
    for (uint32_t f = 0; f < facets; f++) {
        terms[f].way = LRCSI_WALL_FACET;
    }
    if (plan->patches && job.alone && job.group && job.seen && find_alone(&job)) {
        find_groups(&job);
        for (uint32_t i = 0; i < scene->part_count; i++) {
            const lrcs_part *part = &scene->part[i];
            const uint32_t end = part->first_facet + part->facet_count;
            if (lrcsi_proximity_openings(view->prepared, i) == 0) {
                continue;
            }
            const lrcsi_rim_shadow shadow = lrcsi_rim_shadow_make(part, view->unit);
            for (uint32_t f = part->first_facet; f < end; f++) {
                if (job.alone[f] && terms[f].way == LRCSI_WALL_FACET && is_candidate(&job, f)) {
                    open_sector_make(&job, &shadow, f, terms);
                }
            }
        }
    }
    work->used = mark;
}
