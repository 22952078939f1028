/* SPDX-License-Identifier: MIT */
/* Chooses the faces whose margins are used: those of which something is visible, and whose bound
   becomes smaller. The areas of margins are found in visibility/proximity/face_margin.c; what they
   change in the bound is proved in integrate/wall/tessellation.c. */
#include "integrate/wall/flat_face.h"

#include "base/range.h"

/* Decides whether the margins of a face are used, and which facet represents it. */
static lrcsi_flat_face flat_face_choose(const lrcsi_masked_band *band,
                                        const lrcsi_visible_area *visible, uint32_t number)
{
    const lrcsi_proximity_band *whole = band->whole;
    const lrcsi_view *view = whole->classification->view;
    const lrcs_part *part = &view->prepared->scene->part[number / LRCSI_FACES_OF_PART];
    const lrcsi_flat_face unused = {.facet = LRCS_NONE};
    lrcsi_flat_face face = unused;
    double most = 0;
    double with[2] = {whole->face[number].error, whole->face[number].error}; /* gain, loss */
    double without[2] = {0, 0};
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (lrcsi_face_of(view, f) != number) {
            continue;
        }
        if (whole->gain_aligned[f] < 0) {
            return unused;
        }
        const double projected = lrcsi_view_projected(view, f);
        const double hidden = lrcsi_max(0, projected - visible[f].low);
        const double gain = projected * lrcsi_masked_gain_aligned(band, f);
        if (visible[f].low > most) {
            most = visible[f].low;
            face.facet = f;
        }
        without[0] += lrcsi_min(hidden, projected * lrcsi_masked_gain(band, f));
        without[1] += lrcsi_min(visible[f].high, projected * lrcsi_masked_loss(band, f));
        with[0] += lrcsi_flat_face_exceeds(view, f) ? gain : lrcsi_min(hidden, gain);
        with[1] += lrcsi_min(visible[f].high, projected * lrcsi_masked_loss_aligned(band, f));
    }
    face.area = whole->face[number].area;
    face.error = whole->face[number].error;
    face.causes = whole->face[number].causes;
    return lrcsi_max(with[0], with[1]) < lrcsi_max(without[0], without[1]) ? face : unused;
}

void lrcsi_flat_faces_make(const lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                           lrcsi_flat_face *face)
{
    const lrcs_scene *scene = band->whole->classification->view->prepared->scene;
    for (uint32_t i = 0; i < LRCSI_FACES_OF_PART * scene->part_count; i++) {
        face[i] = (lrcsi_flat_face){.facet = LRCS_NONE};
        if (band->whole->face[i].known) {
            face[i] = flat_face_choose(band, visible, i);
        }
    }
}
