/* SPDX-License-Identifier: MIT */
/* Contacts between all facets. Pairs are tested (mesh/contact/intersection_pair.h) if

   - their boxes intersect: the tree of boxes is joined with itself, leaf by leaf
   (mesh/contact/tree.h);
   - they have no corner in common whose fan is proved (mesh/contact/fan.h).

   All other pairs meet at most in corners of both or along a side of both. */
#include "mesh/contact/intersection.h"

#include <math.h>

#include "base/constant.h"
#include "base/exact.h"
#include "base/range.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/contact/fan.h"
#include "mesh/contact/tree_bounds.h"
#include "mesh/contact/tree_capsule.h"
#include "mesh/contact/tree_walk.h"

enum { LEAF_LANES = LRCSI_TREE_LANES };

/* When a leaf's slab is compared with the corners of another leaf: if boxes leave at least
   MANY_PAIRS pairs of their facets; and if the box of the leaf has intersected SOME_LEAVES others,
   or the slab of the leaf before it separated LEAVES_APART. Long facets at an angle to the axes, as
   in the wall of a tilted cylinder, have boxes that intersect most others of the wall. */
enum { MANY_PAIRS = 16, SOME_LEAVES = 8, LEAVES_APART = 4 };

/* When leaves are also compared by slabs and capsules. If the box of a leaf intersects more than
   MANY_LEAVES others, the rest of them are compared by these too; if they then separate at least
   NODES_APART nodes from it, the next leaf is compared by them from the start. Those of the tree
   are filled once such leaves have intersected FILL_COST times as many others as there are leaves.
   */
enum { MANY_LEAVES = 16, NODES_APART = 8, FILL_COST = 2 };

/* 8 u: see slab_separates; heights are within 4 u, and what is added to them rounds by 2 u. */
#define CORNER_FILTER (8.0 * LRCSI_U)

/* A contact as it is found: `other` meets the interior of `facet`. They are taken from the work
   area in blocks that follow one another without gaps. */
typedef struct found_contact {
    uint32_t facet, other, kind;
} found_contact;
enum { FOUND_BLOCK = 4 };
_Static_assert(FOUND_BLOCK * sizeof(found_contact) % LRCS_WORK_ALIGN == 0, "no gaps");

/* The corners of a leaf's facets as welded vertices. */
typedef struct search_leaf {
    uint32_t corner[3][LEAF_LANES];
} search_leaf;

/* The facets among which contacts are sought, and those found. */
typedef struct contact_search {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const lrcsi_shells *shells; /* or NULL */
    unsigned char *proved;      /* welded vertex: 1 if its fan is proved */
    lrcsi_tree tree;
    search_leaf *leaf;
    uint64_t excess;      /* leaves that were met beyond the first MANY_LEAVES of a leaf, in all */
    lrcsi_tree_slab slab; /* of the leaf slab_of */
    uint32_t slab_of;     /* LRCS_NONE: of none yet */
    int leaves_apart;     /* leaves that the slab of the last leaf separated from it */
    int narrow_pays;      /* slabs and capsules separated at least NODES_APART nodes from the last
                             leaf */
    found_contact *found; /* above the tree in the work area */
    uint32_t count;
    lrcs_work *work;
    lrcsi_intersections *intersections;
} contact_search;

/* ---- one pair ---- */

static int append_found(contact_search *search, found_contact found)
{
    if (search->count == LRCS_NONE - 1) {
        return LRCS_E_LIMIT;
    }
    if (search->count % FOUND_BLOCK == 0) {
        found_contact *block = lrcsi_work_take(search->work, FOUND_BLOCK, sizeof *block);
        search->found = search->count == 0 ? block : search->found;
        if (!block) {
            return LRCS_E_MEMORY;
        }
    }
    search->found[search->count++] = found;
    return LRCS_OK;
}

/* The boxes around the three sides of a facet. */
static void side_boxes(const lrcsi_pair_facet *f, lrcsi_box box[3])
{
    for (int n = 0; n < 3; n++) {
        const double *a = f->x[n];
        const double *b = f->x[n < 2 ? n + 1 : 0];
        for (int k = 0; k < 3; k++) {
            box[n].low[k] = a[k] < b[k] ? a[k] : b[k];
            box[n].high[k] = a[k] < b[k] ? b[k] : a[k];
        }
    }
}

/* Have two boxes more than a point in common? */
static int boxes_overlap(const lrcsi_box *a, const lrcsi_box *b)
{
    int longer = 0;
    for (int k = 0; k < 3; k++) {
        double low = lrcsi_max(a->low[k], b->low[k]);
        double high = lrcsi_min(a->high[k], b->high[k]);
        if (low > high) {
            return 0;
        }
        longer |= low < high;
    }
    return longer;
}

/* The sides of each facet that lie on one line with a side of the other and have more than a point
   in common with it, a bit each; not those that both have. */
static void sides_along(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t, unsigned sides[2])
{
    lrcsi_box box_f[3];
    lrcsi_box box_t[3];
    side_boxes(f, box_f);
    side_boxes(t, box_t);
    sides[0] = sides[1] = 0;
    for (int n = 0; n < 9; n++) {
        int i = n / 3;
        int j = n % 3;
        if (boxes_overlap(&box_f[i], &box_t[j])) {
            const double *a = f->x[i];
            const double *b = f->x[i < 2 ? i + 1 : 0];
            const double *p = t->x[j];
            const double *q = t->x[j < 2 ? j + 1 : 0];
            int both = (a == p && b == q) || (a == q && b == p);
            if (!both && lrcsi_exact_collinear(a, b, p) && lrcsi_exact_collinear(a, b, q)) {
                sides[0] |= 1u << i;
                sides[1] |= 1u << j;
            }
        }
    }
}

/* Stores how a pair of facets meets. */
static int pair_store(contact_search *search, uint32_t facet, const lrcsi_pair_facet *f,
                      uint32_t other, const lrcsi_pair_facet *t, const lrcsi_pair_result *result)
{
    lrcsi_intersections *intersections = search->intersections;
    const lrcsi_shells *shells = search->shells;
    int status = LRCS_OK;
    unsigned sides[2];
    sides_along(f, t, sides);
    intersections->met[facet] |= result->met[0] ? (unsigned char)(1 | sides[0] << 1) : 0;
    intersections->met[other] |= result->met[1] ? (unsigned char)(1 | sides[1] << 1) : 0;
    if (result->kind[0] != LRCSI_INTERSECTION_NONE) {
        status = append_found(search, (found_contact){facet, other, (uint32_t)result->kind[0]});
    }
    if (result->kind[1] != LRCSI_INTERSECTION_NONE && status == LRCS_OK) {
        status = append_found(search, (found_contact){other, facet, (uint32_t)result->kind[1]});
    }
    uint32_t shell = shells ? shells->of[facet] : LRCS_NONE;
    if (shell != LRCS_NONE && shell == shells->of[other] && !shells->self[shell]) {
        shells->self[shell] = result->kind[0] != LRCSI_INTERSECTION_NONE ||
                              result->kind[1] != LRCSI_INTERSECTION_NONE ||
                              lrcsi_pair_on_side(f, t);
    }
    return status;
}

/* ---- the tree joined with itself ---- */

/* The lanes of a leaf whose facets have a corner with a proved fan in common with the facet in a
   lane of `own`. */
static inline unsigned lanes_in_fan(const contact_search *search, const search_leaf *own,
                                    uint32_t lane, const search_leaf *leaf)
{
    static const uint32_t lane_bit[LEAF_LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    const uint32_t corner[3] = {own->corner[0][lane], own->corner[1][lane], own->corner[2][lane]};
    const uint32_t a = search->proved[corner[0]] ? corner[0] : LRCS_NONE;
    const uint32_t b = search->proved[corner[1]] ? corner[1] : LRCS_NONE;
    const uint32_t c = search->proved[corner[2]] ? corner[2] : LRCS_NONE;
    uint32_t lanes = 0;
    for (int k = 0; k < LEAF_LANES; k++) {
        uint32_t x = leaf->corner[0][k];
        uint32_t y = leaf->corner[1][k];
        uint32_t z = leaf->corner[2][k];
        int in = (x == a) | (x == b) | (x == c) | (y == a) | (y == b) | (y == c) | (z == a) |
                 (z == b) | (z == c);
        lanes |= in ? lane_bit[k] : 0;
    }
    return lanes;
}

static lrcsi_pair_facet facet_of_lane(const contact_search *search, const search_leaf *leaf,
                                      uint32_t lane)
{
    return (lrcsi_pair_facet){.x = {search->vertex[leaf->corner[0][lane]].x,
                                    search->vertex[leaf->corner[1][lane]].x,
                                    search->vertex[leaf->corner[2][lane]].x}};
}

/* Tests the facet in a lane of leaf `own` against those in `lanes` of another leaf, which may be
   the same: unless they are in a common fan, which most neighbours are, or their boxes are
   disjoint. */
static int join_lanes(contact_search *search, uint32_t own, uint32_t lane, uint32_t leaf,
                      unsigned lanes)
{
    const lrcsi_tree *tree = &search->tree;
    lanes &= ~lanes_in_fan(search, &search->leaf[own], lane, &search->leaf[leaf]);
    if (lanes != 0) {
        lrcsi_box box = lrcsi_tree_box(&tree->node[0][own], lane);
        lanes &= lrcsi_tree_meets(&tree->node[0][leaf], &box);
    }
    if (lanes == 0) {
        return LRCS_OK;
    }
    uint32_t facet = tree->order[own * LEAF_LANES + lane];
    lrcsi_pair_facet f = facet_of_lane(search, &search->leaf[own], lane);
    int status = LRCS_OK;
    lrcsi_pair_plane(&f);
    for (; lanes != 0 && status == LRCS_OK; lanes &= lanes - 1) {
        uint32_t at = lrcsi_tree_lane(lanes);
        lrcsi_pair_facet t = facet_of_lane(search, &search->leaf[leaf], at);
        lrcsi_pair_result result;
        if (lrcsi_pair_meet(&f, &t, &result)) {
            uint32_t other = tree->order[leaf * LEAF_LANES + at];
            status = pair_store(search, facet, &f, other, &t, &result);
        }
    }
    return status;
}

/* The number of bits of a mask of lanes. */
static uint32_t count_lanes(unsigned mask)
{
    mask = (mask & 0x55u) + (mask >> 1 & 0x55u);
    mask = (mask & 0x33u) + (mask >> 2 & 0x33u);
    return (mask & 0x0fu) + (mask >> 4);
}

/* Is a leaf, by the slab that contains it, proved to be disjoint from the facets in `lanes` of
   another leaf: do all their corners lie beyond one side of the slab? Errors: as |d_k| <= 1, the
   height of a corner has an error of at most 4 u (|x| + |y| + |z|); so have the ends of
   the slab. */
static int slab_separates(contact_search *search, uint32_t own, uint32_t leaf, unsigned lanes)
{
    const search_leaf *others = &search->leaf[leaf];
    const lrcsi_tree_slab *slab = &search->slab;
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    double size = 0.0;
    if (search->slab_of != own) {
        search->slab = lrcsi_tree_leaf_slab(search->vertex, search->facet, &search->tree, own);
        search->slab_of = own;
    }
    for (; lanes != 0; lanes &= lanes - 1) {
        uint32_t lane = lrcsi_tree_lane(lanes);
        for (int k = 0; k < 3; k++) {
            const double *x = search->vertex[others->corner[k][lane]].x;
            double height = lrcsi_vec3_dot(slab->direction, x);
            low = lrcsi_min(low, height);
            high = lrcsi_max(high, height);
            size = lrcsi_max(size, (fabs(x[0]) + fabs(x[1])) + fabs(x[2]));
        }
    }
    double error = CORNER_FILTER * (size + slab->size);
    return low - error > slab->high || high + error < slab->low;
}

/* Tests the facets of two leaves against each other: those that intersect the other leaf's box, one
   by one in the leaf that has fewer of them. If `by_slab` is 1, the slab of the first one is
   compared too. */
static int join_leaves(contact_search *search, int by_slab, uint32_t first, uint32_t second)
{
    const lrcsi_tree *tree = &search->tree;
    lrcsi_box box = lrcsi_tree_box(&tree->node[1][second / LEAF_LANES], second % LEAF_LANES);
    unsigned rows = lrcsi_tree_meets(&tree->node[0][first], &box);
    unsigned columns = 0xff;
    int status = LRCS_OK;
    if ((rows & (rows - 1)) != 0) { /* for a single one, comparing its own box is as good */
        box = lrcsi_tree_box(&tree->node[1][first / LEAF_LANES], first % LEAF_LANES);
        columns = lrcsi_tree_meets(&tree->node[0][second], &box);
    }
    if (by_slab && count_lanes(rows) * count_lanes(columns) >= MANY_PAIRS &&
        slab_separates(search, first, second, columns)) {
        search->leaves_apart++;
        return LRCS_OK;
    }
    if (count_lanes(columns) < count_lanes(rows)) {
        unsigned lanes = rows;
        uint32_t leaf = first;
        rows = columns;
        columns = lanes;
        first = second;
        second = leaf;
    }
    for (; rows != 0 && columns != 0 && status == LRCS_OK; rows &= rows - 1) {
        status = join_lanes(search, first, lrcsi_tree_lane(rows), second, columns);
    }
    return status;
}

/* From here on compares nodes with a leaf by slabs and capsules. */
static void narrow_walk(lrcsi_tree_walk *walk, uint32_t leaf)
{
    const lrcsi_tree_capsule capsule =
        lrcsi_tree_lane_capsule(walk->tree, 1, leaf / LEAF_LANES, leaf % LEAF_LANES);
    lrcsi_tree_narrow_by_slabs(walk, leaf);
    lrcsi_tree_narrow_by_capsule(walk, &capsule);
}

/* Tests all pairs of a leaf's facets, unless all are in one proved fan, and its facets against
   those of leaves that come after it. */
static int join_leaf(contact_search *search, uint32_t leaf)
{
    lrcsi_tree *tree = &search->tree;
    lrcsi_tree_walk walk = lrcsi_tree_after(tree, leaf);
    uint32_t apex = tree->label[0][leaf];
    int in_fan = apex != LRCS_NONE && search->proved[apex];
    int status = LRCS_OK;
    uint32_t left = tree->count - leaf * LEAF_LANES;
    unsigned lanes = left < LEAF_LANES ? (1u << left) - 1 : 0xff;
    for (uint32_t lane = 0; lanes >> lane > 1 && !in_fan && status == LRCS_OK; lane++) {
        status = join_lanes(search, leaf, lane, leaf, lanes & (~1u << lane));
    }
    if (!in_fan) {
        walk.without = LRCS_NONE;
    }
    if (apex != LRCS_NONE && !in_fan) {
        lrcsi_tree_narrow_by_cones(&walk, leaf);
    }
    if (search->narrow_pays) {
        narrow_walk(&walk, leaf);
    }
    int slab_from = search->leaves_apart >= LEAVES_APART ? 0 : SOME_LEAVES;
    uint32_t other;
    search->leaves_apart = 0;
    for (int met = 0; status == LRCS_OK && (other = lrcsi_tree_next(&walk)) != LRCS_NONE; met++) {
        search->excess += met >= MANY_LEAVES;
        if (!tree->has_slabs && search->excess > (uint64_t)FILL_COST * tree->nodes[0]) {
            lrcsi_tree_fill_slabs(search->vertex, search->facet, tree);
            lrcsi_tree_fill_capsules(search->vertex, search->facet, tree);
        }
        if (tree->has_slabs && met == MANY_LEAVES && walk.leaf == LRCS_NONE) {
            narrow_walk(&walk, leaf);
        }
        status = join_leaves(search, met >= slab_from, leaf, other);
    }
    search->narrow_pays = walk.apart >= NODES_APART;
    return status;
}

/* ---- the whole search ---- */

/* Proves fans, builds the tree, and fills its leaves. */
static int search_prepare(contact_search *search, uint32_t vertex_count, uint32_t facet_count,
                          const lrcsi_topology *topology, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    lrcsi_tree *tree = &search->tree;
    search->proved = lrcsi_work_take(work, vertex_count, sizeof *search->proved);
    uint32_t *apex = lrcsi_work_take(work, facet_count, sizeof *apex);
    if (!search->proved || !apex) {
        return LRCS_E_MEMORY;
    }
    int status = lrcsi_fans_prove(search->vertex, vertex_count, search->facet, facet_count,
                                  topology, skip, work, search->proved, apex);
    if (status == LRCS_OK) {
        status =
            lrcsi_tree_make(search->vertex, search->facet, facet_count, skip, apex, 1, work, tree);
    }
    search->leaf = lrcsi_work_take(work, tree->nodes[0], sizeof *search->leaf);
    if (status != LRCS_OK || !search->leaf) {
        return LRCS_E_MEMORY;
    }
    lrcsi_tree_fill_cones(search->vertex, search->facet, search->proved, tree);
    for (uint32_t place = 0; place < tree->count; place++) {
        const uint32_t *corner = search->facet[tree->order[place]].corner;
        search_leaf *leaf = &search->leaf[place / LEAF_LANES];
        for (int k = 0; k < 3; k++) {
            leaf->corner[k][place % LEAF_LANES] = topology->weld[corner[k]];
        }
    }
    return LRCS_OK;
}

/* Groups the contacts by facet, in place, each going to the next free entry of its facet. */
static int group_found(const contact_search *search, uint32_t facet_count)
{
    found_contact *found = search->found;
    uint32_t *first = search->intersections->first;
    uint32_t *next = lrcsi_work_take(search->work, facet_count, sizeof *next);
    if (!next) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < search->count; i++) {
        first[found[i].facet + 1]++;
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        next[f] = first[f];
        first[f + 1] += first[f];
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        while (next[f] < first[f + 1]) {
            found_contact *here = &found[next[f]];
            found_contact moved = *here;
            *here = found[next[moved.facet]];
            found[next[moved.facet]++] = moved;
        }
    }
    return LRCS_OK;
}

/* The entries of every facet, sorted by the other one. Without the facets' numbers the contacts
   move down to the mark, where items for the sort and then the entries take their place. */
static int store_entries(const contact_search *search, uint32_t facet_count, size_t mark)
{
    lrcsi_intersections *t = search->intersections;
    search->work->used = mark;
    lrcsi_sort_item *item = lrcsi_work_take(search->work, search->count, sizeof *item);
    search->work->used = mark;
    t->entry = lrcsi_work_take(search->work, search->count, sizeof *t->entry);
    if (!item || !t->entry) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < search->count; i++) {
        found_contact found = search->found[i];
        item[i] = (lrcsi_sort_item){found.other, found.kind};
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        lrcsi_sort_items(item + t->first[f], t->first[f + 1] - t->first[f]);
    }
    for (uint32_t i = 0; i < search->count; i++) {
        lrcsi_sort_item sorted = item[i];
        t->entry[i] = (lrcsi_intersection){sorted.key, sorted.value};
    }
    t->count = search->count;
    return LRCS_OK;
}

size_t lrcsi_intersection_need(uint32_t vertex_count, uint32_t facet_count, size_t count)
{
    size_t need = lrcsi_work_blocks(2, (size_t)facet_count + 1, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertex_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    size_t fans = lrcsi_fans_need(vertex_count);
    size_t search = lrcsi_tree_need(facet_count);
    search =
        lrcsi_work_add(search, lrcsi_work_bytes(facet_count / LEAF_LANES + 1, sizeof(search_leaf)));
    search = lrcsi_work_add(
        search, lrcsi_work_bytes(lrcsi_work_add(count, FOUND_BLOCK), sizeof(found_contact)));
    return lrcsi_work_add(need, fans > search ? fans : search);
}

int lrcsi_intersection_make(const lrcs_point *vertex, uint32_t vertex_count,
                            const lrcs_facet *facet, uint32_t facet_count,
                            const lrcsi_topology *topology, const unsigned char *skip,
                            const lrcsi_shells *shells, lrcs_work *work,
                            lrcsi_intersections *intersections)
{
    size_t start = work->used;
    lrcsi_intersections t = {0};
    t.first = lrcsi_work_take_zero(work, (size_t)facet_count + 1, sizeof *t.first);
    t.met = lrcsi_work_take_zero(work, facet_count, 1);
    size_t mark = work->used;
    contact_search search = {.vertex = vertex,
                             .facet = facet,
                             .shells = shells,
                             .slab_of = LRCS_NONE,
                             .work = work,
                             .intersections = &t};
    int status = t.first && t.met
                     ? search_prepare(&search, vertex_count, facet_count, topology, skip)
                     : LRCS_E_MEMORY;
    for (uint32_t leaf = 0; status == LRCS_OK && leaf < search.tree.nodes[0]; leaf++) {
        status = join_leaf(&search, leaf);
    }
    if (status == LRCS_OK) {
        status = group_found(&search, facet_count);
    }
    if (status == LRCS_OK) {
        status = store_entries(&search, facet_count, mark);
    }
    if (status != LRCS_OK) {
        work->used = start;
        return status;
    }
    *intersections = t;
    return LRCS_OK;
}
