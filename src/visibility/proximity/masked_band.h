/* SPDX-License-Identifier: MIT */
/* A proximity band without the facets that other parts are known to hide entirely, in truth too:
   their visibility cannot differ, so they have no fractions. The band itself is not changed. */
#ifndef LRCSI_MASKED_BAND_H
#define LRCSI_MASKED_BAND_H

#include "visibility/base/visible_area.h"
#include "visibility/proximity/proximity_band.h"

typedef struct lrcsi_masked_band {
    const lrcsi_proximity_band *whole; /* the band */
    unsigned char *region_hidden;      /* region: 1 if other parts hide all of it, in truth too */
    unsigned char *facet_hidden;       /* facet that meets bands: the same of it */
} lrcsi_masked_band;

/* Bytes for lrcsi_masked_band_make and lrcsi_masked_band_find together; 0 if
   prepared->proximity.reach is NULL. */
size_t lrcsi_masked_band_need(const lrcs_prepared *prepared);

/* Masks nothing yet. It stays in the work area, and refers to the band. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_masked_band_make(const lrcsi_proximity_band *whole, lrcs_work *work,
                           lrcsi_masked_band *band);

/* Given visible areas, finds what is hidden in truth too, and masks it: regions, and facets that
   meet bands. Without memory, or when the meter is spent, it finds less. It may be called again
   with other areas of the same view: regions are then found anew; facets stay masked, because what
   is hidden does not depend on how areas are found. Scratch memory is released. */
void lrcsi_masked_band_find(lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                            lrcsi_meter *meter, lrcs_work *work);

/* Is it known that other parts hide all of a facet, in truth too? */
static inline int lrcsi_masked_band_is_hidden(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->region_hidden[band->whole->region[facet]] || band->facet_hidden[facet];
}

/* The fractions of lrcsi_proximity_band; 0 of masked facets. Facets of hidden regions meet no band,
   and need no mask. */
static inline double lrcsi_masked_mismatch(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->mismatch[facet];
}

static inline double lrcsi_masked_gain(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->gain[facet];
}

static inline double lrcsi_masked_loss(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->loss[facet];
}

static inline double lrcsi_masked_rows(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->rows[facet];
}

static inline double lrcsi_masked_rows_open(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->rows_open[facet];
}

static inline lrcsi_row_range lrcsi_masked_row_range(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? (lrcsi_row_range){1, 0} : band->whole->row_range[facet];
}

/* Those of aligned points of a facet on a known face. If a part whose bands the facet does not meet
   hides the facet, it hides all points of the true face within its reach
   (visibility/proximity/proximity_band.c, 1.c and d): those beside its sides, too. */
static inline double lrcsi_masked_gain_aligned(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->gain_aligned[facet];
}

static inline double lrcsi_masked_loss_aligned(const lrcsi_masked_band *band, uint32_t facet)
{
    return band->facet_hidden[facet] ? 0 : band->whole->loss_aligned[facet];
}

#endif
