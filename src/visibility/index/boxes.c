/* SPDX-License-Identifier: MIT */
/* Boxes of meshlets and facets in a view. Which of them are needed is decided by the caller. */
#include "visibility/index/boxes.h"

#include <math.h>

#include "base/constant.h"
#include "base/work.h"
#include "scene/meshlets.h"

size_t lrcsi_boxes_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t meshlets = prepared->meshlets.count;
    size_t need = lrcsi_work_add(lrcsi_work_bytes(facets, sizeof(lrcsi_view_box)),
                                 lrcsi_work_bytes(meshlets, sizeof(lrcsi_view_box)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(meshlets, 1));
    return lrcsi_work_add(need, lrcsi_work_bytes(meshlets, sizeof(uint32_t)));
}

/* A point of the box is m + d, with |d_k| <= h_k. The position of m in the view has an error of at
   most lrcsi_view_point_err, which includes a sum; a row of the axes has an error of 4 u. So d
   contributes at most sum (|R_k| + 4 u) h_k, computed with a relative error of 4 u. */
void lrcsi_boxes_meshlet_bounds(const lrcsi_view *view, const lrcsi_meshlet *meshlet, double low[3],
                                double high[3])
{
    double middle[3];
    double half[3];
    double x[3];
    lrcsi_meshlet_middle(meshlet, middle, half);
    lrcsi_view_coordinates(view, middle, x);
    double err = lrcsi_view_point_err(x) + 8 * LRCSI_U * (half[0] + half[1] + half[2]);
    for (int k = 0; k < 3; k++) {
        const double *row = view->R[k];
        double wide = fabs(row[0]) * half[0] + fabs(row[1]) * half[1] + fabs(row[2]) * half[2];
        wide += 16 * LRCSI_U * wide + err;
        low[k] = x[k] - wide;
        high[k] = x[k] + wide;
    }
}

int lrcsi_boxes_make(const lrcsi_view *view, lrcs_work *work, lrcsi_boxes *boxes)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t count = p->scene->facet_count;
    *boxes = (lrcsi_boxes){.view = view};
    boxes->meshlet = lrcsi_work_take(work, p->meshlets.count, sizeof *boxes->meshlet);
    boxes->state = lrcsi_work_take_zero(work, p->meshlets.count, 1);
    boxes->start = lrcsi_work_take(work, p->meshlets.count, sizeof *boxes->start);
    boxes->facet = lrcsi_work_take(work, count, sizeof *boxes->facet);
    if (!boxes->meshlet || !boxes->state || !boxes->start || !boxes->facet) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t m = 0; m < p->meshlets.count; m++) {
        if (view->cast.meshlet[m] != 0) {
            double low[3];
            double high[3];
            lrcsi_boxes_meshlet_bounds(view, &p->meshlets.meshlet[m], low, high);
            boxes->meshlet[m] = lrcsi_view_box_round(view, low, high);
            boxes->state[m] = LRCSI_BOXES_MESHLET;
        }
    }
    return LRCS_OK;
}

void lrcsi_boxes_open(lrcsi_boxes *boxes, uint32_t meshlet)
{
    const lrcs_scene *scene = boxes->view->prepared->scene;
    if (boxes->state[meshlet] == LRCSI_BOXES_MESHLET) {
        uint32_t first = meshlet * LRCSI_MESHLET_FACETS;
        uint32_t end = lrcsi_meshlet_end(first, scene->facet_count);
        lrcsi_view_box *box = &boxes->facet[boxes->facet_count];
        for (uint32_t f = first; f < end; f++) {
            if (lrcsi_view_casts(boxes->view, f)) {
                box[f - first] = lrcsi_view_box_of(boxes->view, scene->facet[f].corner, 3);
            }
        }
        boxes->start[meshlet] = boxes->facet_count;
        boxes->facet_count += end - first;
        boxes->state[meshlet] = LRCSI_BOXES_FACETS;
    }
}
