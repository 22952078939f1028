/* SPDX-License-Identifier: MIT */
/* Decides nothing about what is near an edge: it keeps a short list of parts of it. */
#include "visibility/proximity/edge_gaps.h"

#include "base/range.h"

/* Removes gap i. */
static void gap_remove(lrcsi_edge_gaps *gaps, int i)
{
    gaps->count--;
    for (int k = i; k < gaps->count; k++) {
        gaps->gap[k] = gaps->gap[k + 1];
    }
}

/* Makes room for one more. */
static void gaps_shorten(lrcsi_edge_gaps *gaps)
{
    int nearest = 1;
    for (int i = 2; i < gaps->count; i++) {
        if (gaps->gap[i].from - gaps->gap[i - 1].to <
            gaps->gap[nearest].from - gaps->gap[nearest - 1].to) {
            nearest = i;
        }
    }
    gaps->gap[nearest - 1].to = gaps->gap[nearest].to;
    gap_remove(gaps, nearest);
}

void lrcsi_edge_gaps_add(lrcsi_edge_gaps *gaps, lrcsi_segment_part part)
{
    lrcsi_segment_part one = {lrcsi_max(part.from, 0), lrcsi_min(part.to, 1)};
    if (!(one.from <= one.to)) {
        return;
    }
    if (gaps->count == LRCSI_EDGE_GAPS) {
        gaps_shorten(gaps);
    }
    int i = 0;
    while (i < gaps->count && gaps->gap[i].to < one.from) {
        i++;
    }
    while (i < gaps->count && gaps->gap[i].from <= one.to) {
        one.from = lrcsi_min(one.from, gaps->gap[i].from);
        one.to = lrcsi_max(one.to, gaps->gap[i].to);
        gap_remove(gaps, i);
    }
    for (int k = gaps->count; k > i; k--) {
        gaps->gap[k] = gaps->gap[k - 1];
    }
    gaps->gap[i] = one;
    gaps->count++;
}

void lrcsi_edge_gaps_add_outside(lrcsi_edge_gaps *gaps, lrcsi_segment_part part)
{
    if (part.from > part.to) {
        lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){0, 1});
        return;
    }
    if (part.from > 0) {
        lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){0, part.from});
    }
    if (part.to < 1) {
        lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){part.to, 1});
    }
}
