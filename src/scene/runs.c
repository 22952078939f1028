/* SPDX-License-Identifier: MIT */
/* Computes the boxes of runs, which of their facets are connected within the run, and to which runs
   their sides lead. It does not decide how a view uses them. */
#include "scene/runs.h"

#include <math.h>

#include "base/disjoint.h"
#include "base/work.h"
#include "mesh/box.h"

/* Lists the runs that the sides of a run lead to. */
static void run_link(lrcsi_runs *runs, uint32_t run, uint32_t facet_count)
{
    uint32_t first = runs->first_link[run];
    uint32_t end = first;
    for (uint32_t i = runs->run[run].first_side; i < runs->run[run + 1].first_side; i++) {
        uint32_t other = runs->side[i].other;
        uint32_t to = other < facet_count ? other / LRCSI_RUN : LRCS_NONE;
        uint32_t k = first;
        while (k < end && runs->link[k] != to) {
            k++;
        }
        runs->link[k] = to;
        end = k == end ? end + 1 : end;
    }
    runs->first_link[run + 1] = end;
}

/* Finds the connected facets of a run, and lists the sides that lead to earlier runs or have no
   neighbour. Being neighbours is symmetric (scene/neighbours.c), so a side that leads to a later
   run is listed with that run. */
static void run_connect(const lrcs_prepared *p, lrcsi_runs *runs, uint32_t start, uint32_t end)
{
    uint32_t group[LRCSI_RUN];
    uint32_t count = p->scene->facet_count;
    uint32_t *sides = &runs->run[start / LRCSI_RUN + 1].first_side;
    int whole = 1;
    for (uint32_t f = start; f < end; f++) {
        group[f - start] = f - start;
        for (int k = 0; k < 3; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            if (other >= start && other < f) {
                lrcsi_disjoint_union(group, other - start, f - start);
            } else if (other < start || other == count) {
                runs->side[(*sides)++] =
                    (lrcsi_run_side){f, other, p->topology.facet_edge[f].corner[k]};
            }
        }
    }
    lrcsi_disjoint_flatten(group, end - start);
    for (uint32_t f = start; f < end; f++) {
        runs->first[f] = (unsigned char)group[f - start];
        whole &= group[f - start] == 0;
    }
    runs->whole[start / LRCSI_RUN] = (unsigned char)whole;
}

size_t lrcsi_runs_need(uint32_t facet_count)
{
    size_t runs = (size_t)lrcsi_runs_count(facet_count) + 1;
    size_t need =
        lrcsi_work_add(lrcsi_work_bytes(runs, sizeof(lrcsi_run)), lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(runs, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(runs, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(3, facet_count, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_blocks(3, facet_count, sizeof(lrcsi_run_side)));
}

/* Takes memory for three sides per facet, then for as many links as there are sides; what turns out
   not to be needed is released. */
int lrcsi_runs_make(const lrcs_prepared *p, lrcs_work *work, lrcsi_runs *runs)
{
    uint32_t facet_count = p->scene->facet_count;
    lrcsi_runs made = {.count = lrcsi_runs_count(facet_count)};
    made.run = lrcsi_work_take(work, (size_t)made.count + 1, sizeof *made.run);
    made.first = lrcsi_work_take(work, facet_count, 1);
    made.whole = lrcsi_work_take(work, made.count, 1);
    made.first_link = lrcsi_work_take(work, (size_t)made.count + 1, sizeof *made.first_link);
    size_t mark = work->used;
    made.side = lrcsi_work_take(work, 3 * (size_t)facet_count, sizeof *made.side);
    if (!made.run || !made.first || !made.whole || !made.first_link || !made.side) {
        return LRCS_E_MEMORY;
    }
    made.run[0].first_side = 0;
    for (uint32_t r = 0; r < made.count; r++) {
        uint32_t start = r * LRCSI_RUN;
        uint32_t end = lrcsi_run_end(start, facet_count);
        lrcsi_box box = lrcsi_box_empty();
        int has_contacts = 0;
        for (uint32_t f = start; f < end; f++) {
            has_contacts |=
                lrcsi_intersection_of(&p->intersections, f) != 0 || p->intersections.met[f];
            for (int c = 0; c < 3 && p->redundant[f] < LRCSI_REDUNDANT; c++) {
                lrcsi_box_add(&box, lrcsi_prepared_corner(p, f, c));
            }
        }
        lrcsi_run *run = &made.run[r];
        for (int k = 0; k < 3; k++) {
            run->low[k] = box.low[k];
            run->high[k] = box.high[k];
        }
        run->has_contacts = has_contacts;
        made.run[r + 1].first_side = run->first_side;
        run_connect(p, &made, start, end);
    }
    work->used = mark;
    made.side = lrcsi_work_take(work, made.run[made.count].first_side, sizeof *made.side);
    mark = work->used;
    made.link = lrcsi_work_take(work, made.run[made.count].first_side, sizeof *made.link);
    if (!made.link) {
        return LRCS_E_MEMORY;
    }
    made.first_link[0] = 0;
    for (uint32_t r = 0; r < made.count; r++) {
        run_link(&made, r, facet_count);
    }
    work->used = mark;
    made.link = lrcsi_work_take(work, made.first_link[made.count], sizeof *made.link);
    *runs = made;
    return LRCS_OK;
}
