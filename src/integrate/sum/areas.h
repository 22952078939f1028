/* SPDX-License-Identifier: MIT */
/* The visible areas of all facets as one run found them, whichever method that was: some facets
   only have the answer that they are entirely visible or hidden, and method facet needs no areas in
   memory, because the plan implies them. */
#ifndef LRCSI_AREAS_H
#define LRCSI_AREAS_H

#include "integrate/plan/plan.h"
#include "integrate/wall/flat_face.h"
#include "integrate/wall/patch_visibility.h"
#include "integrate/wall/wall_terms.h"
#include "visibility/base/visible_area.h"
#include "visibility/uniform/query.h"

/* answer[facet] is LRCSI_QUERY_VISIBLE or LRCSI_QUERY_HIDDEN if all or nothing of the facet is
   visible; visible[] has the areas of the other facets, and of all facets if answer is NULL. */
typedef struct lrcsi_areas {
    const lrcsi_visible_area *visible; /* NULL: method facet */
    const unsigned char *answer;
    const lrcsi_moment *moment;         /* of the visible regions of all facets; NULL: not known */
    const lrcsi_wall_terms *wall_terms; /* what facets on curved walls add; NULL: not known */
    const lrcsi_flat_face *face;        /* [faces]: margins on flat faces; NULL: none are used */
    const lrcsi_masked_band *margins;   /* its margins facet by facet are used; NULL: none are */
} lrcsi_areas;

/* Is it an answer that says what is visible of the facet? */
static inline int lrcsi_areas_answered(const lrcsi_areas *areas, uint32_t facet)
{
    return areas->answer && areas->answer[facet] != LRCSI_QUERY_NO_ANSWER;
}

/* What a facet on a curved wall adds, or NULL if that is not known. */
static inline const lrcsi_wall_terms *lrcsi_areas_wall_terms(const lrcsi_areas *areas,
                                                             uint32_t facet)
{
    return areas->wall_terms && areas->wall_terms[facet].way != LRCSI_WALL_FACET
               ? &areas->wall_terms[facet]
               : NULL;
}

/* What is to be added to the visible area of a facet because of margins between the outlines of
   true shapes and of their facets. */
static inline double lrcsi_areas_margin(const lrcsi_areas *areas, const lrcsi_view *view,
                                        uint32_t facet)
{
    return lrcsi_flat_face_area(areas->face, view, facet) +
           (areas->margins ? lrcsi_wall_margin_area(areas->margins, areas->visible, facet) : 0);
}

/* The visible area of a facet of given incidence. */
static inline lrcsi_visible_area lrcsi_areas_of(const lrcsi_areas *areas, const lrcsi_view *view,
                                                const lrcsi_plan *plan, uint32_t facet,
                                                const lrcsi_incidence *incidence)
{
    if (lrcsi_areas_answered(areas, facet)) {
        int is_visible = areas->answer[facet] == LRCSI_QUERY_VISIBLE;
        return lrcsi_visible_area_exact(is_visible ? incidence->projected : 0);
    }
    if (areas->visible) {
        return areas->visible[facet];
    }
    return lrcsi_view_casts(view, facet)
               ? lrcsi_visible_area_unshadowed(incidence, plan->grazing_cos)
               : lrcsi_visible_area_exact(0);
}

/* The visible fraction of a facet, from its visible and its projected area. 1 if these are equal,
   even if both are 0 because the projected area underflows: a facet that is summed at all
   (lrcsi_areas_is_summed) then counts as entirely visible. There is no division for the many facets
   that are entirely visible. */
static inline double lrcsi_areas_fraction(double visible, double projected)
{
    return visible == projected ? 1 : visible / projected;
}

/* May some of a facet be visible? Given: areas of any method but facet. */
static inline int lrcsi_areas_may_be_visible(const lrcsi_areas *areas, uint32_t facet)
{
    return lrcsi_areas_answered(areas, facet) ? areas->answer[facet] == LRCSI_QUERY_VISIBLE
                                              : areas->visible[facet].high > 0;
}

/* Does the sum of Eq. 2 include a facet that faces the laser and reflects towards it? By any
   method. Of a sector that is integrated over its patch something may be visible even if nothing is
   of its facets. */
static inline int lrcsi_areas_is_summed(const lrcsi_areas *areas, const lrcsi_view *view,
                                        uint32_t facet)
{
    if (!areas->visible) {
        return lrcsi_view_casts(view, facet);
    }
    return lrcsi_areas_may_be_visible(areas, facet) ||
           (areas->wall_terms && areas->wall_terms[facet].way == LRCSI_WALL_PATCH);
}

/* The visible area of a facet that may be visible. Given: areas of any method but facet. */
static inline double lrcsi_areas_value(const lrcsi_areas *areas, const lrcsi_view *view,
                                       uint32_t facet)
{
    return lrcsi_areas_answered(areas, facet) ? lrcsi_view_projected(view, facet)
                                              : areas->visible[facet].area;
}

#endif
