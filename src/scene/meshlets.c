/* SPDX-License-Identifier: MIT */
/* Computes the boxes of meshlets, which of their facets are connected within the meshlet, and to
   which meshlets their sides lead; compares the numbers of their facets. It does not decide how a
   view uses them. */
#include "scene/meshlets.h"

#include <math.h>
#include <string.h>

#include "base/disjoint.h"
#include "base/work.h"
#include "mesh/box.h"

/* Lists the meshlets that the sides of a meshlet lead to. */
static void meshlet_link(lrcsi_meshlets *meshlets, uint32_t meshlet, uint32_t facet_count)
{
    uint32_t first = meshlets->first_link[meshlet];
    uint32_t end = first;
    for (uint32_t i = meshlets->meshlet[meshlet].first_side;
         i < meshlets->meshlet[meshlet + 1].first_side; i++) {
        uint32_t other = meshlets->side[i].other;
        uint32_t to = other < facet_count ? other / LRCSI_MESHLET_FACETS : LRCS_NONE;
        uint32_t k = first;
        while (k < end && meshlets->link[k] != to) {
            k++;
        }
        meshlets->link[k] = to;
        end = k == end ? end + 1 : end;
    }
    meshlets->first_link[meshlet + 1] = end;
}

/* Finds the connected facets of a meshlet, and lists the sides that lead to earlier meshlets or
   have no neighbour. Being neighbours is symmetric (scene/neighbours.c), so a side that leads to a
   later meshlet is listed with that meshlet. */
static void meshlet_connect(const lrcs_prepared *p, lrcsi_meshlets *meshlets, uint32_t start,
                            uint32_t end)
{
    uint32_t group[LRCSI_MESHLET_FACETS];
    uint32_t count = p->scene->facet_count;
    uint32_t *sides = &meshlets->meshlet[start / LRCSI_MESHLET_FACETS + 1].first_side;
    int whole = 1;
    for (uint32_t f = start; f < end; f++) {
        group[f - start] = f - start;
        for (int k = 0; k < 3; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            if (other >= start && other < f) {
                lrcsi_disjoint_union(group, other - start, f - start);
            } else if (other < start || other == count) {
                meshlets->side[(*sides)++] =
                    (lrcsi_meshlet_side){f, other, p->topology.facet_edge[f].corner[k]};
            }
        }
    }
    lrcsi_disjoint_flatten(group, end - start);
    for (uint32_t f = start; f < end; f++) {
        meshlets->first[f] = (unsigned char)group[f - start];
        whole &= group[f - start] == 0;
    }
    meshlets->whole[start / LRCSI_MESHLET_FACETS] = (unsigned char)whole;
}

size_t lrcsi_meshlets_need(uint32_t facet_count)
{
    size_t meshlets = (size_t)lrcsi_meshlets_count(facet_count) + 1;
    size_t need = lrcsi_work_add(lrcsi_work_bytes(meshlets, sizeof(lrcsi_meshlet)),
                                 lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(meshlets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(meshlets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(3, facet_count, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_blocks(3, facet_count, sizeof(lrcsi_meshlet_side)));
}

/* Takes memory for three sides per facet, then for as many links as there are sides; what turns out
   not to be needed is released. */
int lrcsi_meshlets_make(const lrcs_prepared *p, lrcs_work *work, lrcsi_meshlets *meshlets)
{
    uint32_t facet_count = p->scene->facet_count;
    lrcsi_meshlets made = {.count = lrcsi_meshlets_count(facet_count)};
    made.meshlet = lrcsi_work_take(work, (size_t)made.count + 1, sizeof *made.meshlet);
    made.first = lrcsi_work_take(work, facet_count, 1);
    made.whole = lrcsi_work_take(work, made.count, 1);
    made.first_link = lrcsi_work_take(work, (size_t)made.count + 1, sizeof *made.first_link);
    size_t mark = work->used;
    made.side = lrcsi_work_take(work, 3 * (size_t)facet_count, sizeof *made.side);
    if (!made.meshlet || !made.first || !made.whole || !made.first_link || !made.side) {
        return LRCS_E_MEMORY;
    }
    made.meshlet[0].first_side = 0;
    for (uint32_t m = 0; m < made.count; m++) {
        uint32_t start = m * LRCSI_MESHLET_FACETS;
        uint32_t end = lrcsi_meshlet_end(start, facet_count);
        lrcsi_box box = lrcsi_box_empty();
        int has_contacts = 0;
        for (uint32_t f = start; f < end; f++) {
            has_contacts |=
                lrcsi_intersection_of(&p->intersections, f) != 0 || p->intersections.met[f];
            for (int c = 0; c < 3 && p->redundant[f] < LRCSI_REDUNDANT; c++) {
                lrcsi_box_add(&box, lrcsi_prepared_corner(p, f, c));
            }
        }
        lrcsi_meshlet *meshlet = &made.meshlet[m];
        for (int k = 0; k < 3; k++) {
            meshlet->low[k] = box.low[k];
            meshlet->high[k] = box.high[k];
        }
        meshlet->has_contacts = has_contacts;
        made.meshlet[m + 1].first_side = meshlet->first_side;
        meshlet_connect(p, &made, start, end);
    }
    work->used = mark;
    made.side = lrcsi_work_take(work, made.meshlet[made.count].first_side, sizeof *made.side);
    mark = work->used;
    made.link = lrcsi_work_take(work, made.meshlet[made.count].first_side, sizeof *made.link);
    if (!made.link) {
        return LRCS_E_MEMORY;
    }
    made.first_link[0] = 0;
    for (uint32_t m = 0; m < made.count; m++) {
        meshlet_link(&made, m, facet_count);
    }
    work->used = mark;
    made.link = lrcsi_work_take(work, made.first_link[made.count], sizeof *made.link);
    *meshlets = made;
    return LRCS_OK;
}

/* --- signs of facets -------------------------------------------------------------------------- */

size_t lrcsi_facet_signs_need(uint32_t facet_count)
{
    return lrcsi_work_add(lrcsi_work_bytes(lrcsi_meshlets_room(facet_count) + 1, 1),
                          lrcsi_work_bytes(lrcsi_meshlets_count(facet_count), 1));
}

int lrcsi_facet_signs_take(uint32_t facet_count, lrcs_work *work, lrcsi_facet_signs *signs)
{
    signs->facet = lrcsi_work_take(work, lrcsi_meshlets_room(facet_count) + 1, 1);
    signs->meshlet = lrcsi_work_take(work, lrcsi_meshlets_count(facet_count), 1);
    return signs->facet && signs->meshlet;
}

void lrcsi_facet_signs_finish(uint32_t facet_count, lrcsi_facet_signs *signs)
{
    const size_t room = lrcsi_meshlets_room(facet_count);
    memset(signs->facet + facet_count, 0, room + 1 - facet_count);
    for (size_t at = 0; at < room; at += LRCSI_MESHLET_FACETS) {
        const signed char *sign = signs->facet + at;
        uint64_t word[LRCSI_MESHLET_FACETS / sizeof(uint64_t)];
        memcpy(word, sign, sizeof word);
        const int alike =
            word[0] == word[1] && word[0] == (word[0] & 0xff) * UINT64_C(0x0101010101010101);
        signs->meshlet[at / LRCSI_MESHLET_FACETS] = alike ? sign[0] : LRCSI_MESHLET_MIXED;
    }
}

void lrcsi_facet_signs_copy(uint32_t facet_count, const lrcsi_facet_signs *from,
                            lrcsi_facet_signs *to)
{
    memcpy(to->facet, from->facet, lrcsi_meshlets_room(facet_count) + 1);
    memcpy(to->meshlet, from->meshlet, lrcsi_meshlets_count(facet_count));
}
