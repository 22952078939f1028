/* SPDX-License-Identifier: MIT */
/* Of facets on the same three points, those wound the same way face the same way from everywhere.
   Where they show their fronts the first in order wins the tie; where they show their backs, the
   first of those that reflect, else the first (visibility/sample.h). So a facet that follows one of
   its winding is never seen if that one reflects from its back or itself does not; and it hides
   nothing that the first does not hide as well: it need not be asked for. Of any number of facets
   in one place four are left at most.

   Where facets stand for a curved shape, what is seen of the true one may be another matter: none
   of them is a copy here. */
#include "scene/copy.h"

#include <string.h>

#include "mesh/same.h"

static int may_be_copy(const lrcs_prepared *p, uint32_t facet)
{
    return !p->skip[facet] && !(p->scene->part[p->scene->facet_part[facet]].reach > 0);
}

int lrcsi_copies_mark(lrcs_prepared *p, lrcs_work *work)
{
    const uint32_t *order = NULL;
    uint32_t count = 0;
    int status = lrcsi_same_order(&p->topology, p->scene->facet, p->scene->facet_count, work,
                                  &order, &count);
    lrcsi_same_key place = {LRCS_NONE, LRCS_NONE, LRCS_NONE, 0};
    int met[2][2] = {{0, 0}, {0, 0}}; /* at this place: by winding, and whether backs reflect */
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = order[i];
        lrcsi_same_key key = lrcsi_same_key_of(&p->topology, &p->scene->facet[facet]);
        if (!lrcsi_same_place(&key, &place)) {
            place = key;
            memset(met, 0, sizeof met);
        }
        if (may_be_copy(p, facet)) {
            int *earlier = met[key.odd];
            int reflects = lrcsi_prepared_material(p, facet)->two_sided != 0;
            p->idle[facet] = earlier[1] || (earlier[0] && !reflects);
            earlier[reflects] = 1;
        }
    }
    return status;
}
