/* SPDX-License-Identifier: MIT */
/* Contacts between all facets. Pairs are compared (mesh/intersection_pair.h) where

   - their boxes meet: the tree of boxes is joined with itself, leaf by leaf (mesh/tree.h);
   - they have no corner in common whose ring is proved (mesh/ring.h).

   Others meet in corners of both or along a side of both, if at all. */
#include "mesh/intersection.h"

#include "base/exact.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/ring.h"
#include "mesh/tree.h"

/* A contact as it is found: `other` meets the inside of `facet`. */
typedef struct touch_found {
    uint32_t facet, other, kind;
} touch_found;

/* They are taken from the work area in blocks that follow one another without gaps. */
enum { FOUND_BLOCK = 4 };
_Static_assert(FOUND_BLOCK * sizeof(touch_found) % LRCS_WORK_ALIGN == 0, "no gaps");

/* Sinks entry `i` of a heap of n, largest on top. */
static void sink_found(touch_found *found, size_t i, size_t n)
{
    for (size_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
        if (child + 1 < n && found[child + 1].other > found[child].other) {
            child++;
        }
        if (found[i].other >= found[child].other) {
            return;
        }
        touch_found t = found[i];
        found[i] = found[child];
        found[child] = t;
        i = child;
    }
}

/* Heap sort by `other`, in place. */
static void sort_found(touch_found *found, size_t n)
{
    for (size_t i = n / 2; i > 0; i--) {
        sink_found(found, i - 1, n);
    }
    for (size_t last = n; last > 1; last--) {
        touch_found t = found[0];
        found[0] = found[last - 1];
        found[last - 1] = t;
        sink_found(found, 0, last - 1);
    }
}

/* ---- all pairs ---- */

enum { LEAF_LANES = LRCSI_TREE_LANES };

/* A leaf that meets more others than this by boxes is compared by slabs too, and the next one from
   the first, if slabs left out so many blocks; but slabs are filled only once there have been as
   many more meetings as there are leaves, which is what filling them costs. */
enum { MANY_LEAVES = 16, BLOCKS_APART = 8 };

/* The corners of a leaf's facets, welded, in structure of arrays. */
typedef struct touch_leaf {
    uint32_t corner[3][LEAF_LANES];
} touch_leaf;

/* The facets among which contacts are sought, and those found. */
typedef struct touch_search {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const uint32_t *piece; /* or NULL */
    unsigned char *proved; /* welded vertex: its ring is */
    lrcsi_tree tree;
    touch_leaf *leaf;
    uint64_t crowded;   /* meetings of leaves that meet many others */
    int slabs_pay;      /* they did so for the last leaf */
    touch_found *found; /* above the tree */
    uint32_t count;
    lrcs_work *work;
    lrcsi_intersections *intersections;
} touch_search;

static int append_found(touch_search *search, touch_found found)
{
    if (search->count == LRCS_NONE - 1) {
        return LRCS_E_LIMIT;
    }
    if (search->count % FOUND_BLOCK == 0) {
        touch_found *block = lrcsi_work_take(search->work, FOUND_BLOCK, sizeof *block);
        search->found = search->count == 0 ? block : search->found;
        if (!block) {
            return LRCS_E_MEMORY;
        }
    }
    search->found[search->count++] = found;
    return LRCS_OK;
}

/* The facet at a place. */
static lrcsi_pair_facet facet_of_place(const touch_search *search, uint32_t place)
{
    const touch_leaf *leaf = &search->leaf[place / LEAF_LANES];
    uint32_t lane = place % LEAF_LANES;
    return (lrcsi_pair_facet){.x = {search->vertex[leaf->corner[0][lane]].x,
                                    search->vertex[leaf->corner[1][lane]].x,
                                    search->vertex[leaf->corner[2][lane]].x}};
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
        double low = lrcsi_most(a->low[k], b->low[k]);
        double high = lrcsi_least(a->high[k], b->high[k]);
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

/* Files how a pair meets. */
static int file_pair(touch_search *search, uint32_t facet, const lrcsi_pair_facet *f,
                     uint32_t other, const lrcsi_pair_facet *t, const lrcsi_pair_result *result)
{
    lrcsi_intersections *intersections = search->intersections;
    const uint32_t *piece = search->piece;
    int status = LRCS_OK;
    unsigned sides[2];
    sides_along(f, t, sides);
    intersections->rim[facet] |= result->rim[0] ? (unsigned char)(1 | sides[0] << 1) : 0;
    intersections->rim[other] |= result->rim[1] ? (unsigned char)(1 | sides[1] << 1) : 0;
    if (result->kind[0] != LRCSI_INTERSECTION_NONE) {
        status = append_found(search, (touch_found){facet, other, (uint32_t)result->kind[0]});
    }
    if (result->kind[1] != LRCSI_INTERSECTION_NONE && status == LRCS_OK) {
        status = append_found(search, (touch_found){other, facet, (uint32_t)result->kind[1]});
    }
    if (piece && !intersections->self && piece[facet] == piece[other]) {
        intersections->self = result->kind[0] != LRCSI_INTERSECTION_NONE ||
                              result->kind[1] != LRCSI_INTERSECTION_NONE ||
                              lrcsi_pair_on_side(f, t);
    }
    return status;
}

/* The lanes of a leaf whose facets have a corner with a proved ring in common with the facet at a
   place. */
static unsigned lanes_in_ring(const touch_search *search, uint32_t place, const touch_leaf *leaf)
{
    static const uint32_t lane_bit[LEAF_LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    const touch_leaf *own = &search->leaf[place / LEAF_LANES];
    uint32_t proved[3];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        uint32_t v = own->corner[k][place % LEAF_LANES];
        proved[count] = v;
        count += search->proved[v];
    }
    if (count == 0) {
        return 0;
    }
    const uint32_t a = proved[0];
    const uint32_t b = count > 1 ? proved[1] : a;
    const uint32_t c = count > 2 ? proved[2] : a;
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

/* The facet at a place against those in some lanes of a leaf whose boxes meet its own, less those
   of a common ring. */
static int meet_lanes(touch_search *search, uint32_t place, uint32_t leaf, unsigned lanes)
{
    const lrcsi_tree *tree = &search->tree;
    lrcsi_box box = lrcsi_tree_box(&tree->block[0][place / LEAF_LANES], place % LEAF_LANES);
    lanes &= lrcsi_tree_meets(&tree->block[0][leaf], &box);
    lanes = lanes ? lanes & ~lanes_in_ring(search, place, &search->leaf[leaf]) : 0;
    if (lanes == 0) {
        return LRCS_OK;
    }
    lrcsi_pair_facet f = facet_of_place(search, place);
    int status = LRCS_OK;
    lrcsi_pair_plane(&f);
    for (; lanes != 0 && status == LRCS_OK; lanes &= lanes - 1) {
        uint32_t at = leaf * LEAF_LANES + lrcsi_tree_lane(lanes);
        lrcsi_pair_facet t = facet_of_place(search, at);
        lrcsi_pair_result result;
        if (lrcsi_pair_meet(&f, &t, &result)) {
            status = file_pair(search, tree->order[place], &f, tree->order[at], &t, &result);
        }
    }
    return status;
}

/* How many bits a mask of lanes has. */
static uint32_t count_lanes(unsigned mask)
{
    mask = (mask & 0x55u) + (mask >> 1 & 0x55u);
    mask = (mask & 0x33u) + (mask >> 2 & 0x33u);
    return (mask & 0x0fu) + (mask >> 4);
}

/* The facets of two leaves that meet the other's box, against each other, those of the leaf with
   fewer of them one by one; or, where it is one leaf, each of its facets against those after it. */
static int meet_leaves(touch_search *search, uint32_t first, uint32_t second)
{
    const lrcsi_tree *tree = &search->tree;
    unsigned rows = 0xff;
    unsigned columns = 0xff;
    int status = LRCS_OK;
    if (first != second) {
        lrcsi_box box = lrcsi_tree_box(&tree->block[1][second / LEAF_LANES], second % LEAF_LANES);
        rows = lrcsi_tree_meets(&tree->block[0][first], &box);
        if ((rows & (rows - 1)) != 0) { /* two or more: one compares its own box */
            box = lrcsi_tree_box(&tree->block[1][first / LEAF_LANES], first % LEAF_LANES);
            columns = lrcsi_tree_meets(&tree->block[0][second], &box);
        }
        if (count_lanes(columns) < count_lanes(rows)) {
            unsigned lanes = rows;
            uint32_t leaf = first;
            rows = columns;
            columns = lanes;
            first = second;
            second = leaf;
        }
    } else if (tree->count - first * LEAF_LANES < LEAF_LANES) {
        rows = columns = (1u << (tree->count - first * LEAF_LANES)) - 1;
    }
    for (; rows != 0 && columns != 0 && status == LRCS_OK; rows &= rows - 1) {
        uint32_t lane = lrcsi_tree_lane(rows);
        columns &= first == second ? ~1u << lane : ~0u;
        if (columns != 0) {
            status = meet_lanes(search, first * LEAF_LANES + lane, second, columns);
        }
    }
    return status;
}

/* All pairs of a leaf's facets with each other, unless all have one proved ring, and with those of
   leaves after it. */
static int meet_leaf(touch_search *search, uint32_t leaf)
{
    lrcsi_tree *tree = &search->tree;
    lrcsi_tree_walk walk = lrcsi_tree_after(tree, leaf);
    uint32_t apex = tree->label[0][leaf];
    int in_ring = apex != LRCS_NONE && search->proved[apex];
    int status = in_ring ? LRCS_OK : meet_leaves(search, leaf, leaf);
    uint32_t other;
    if (!in_ring) {
        walk.without = LRCS_NONE;
    }
    if (apex != LRCS_NONE && !in_ring) {
        lrcsi_tree_narrow_fan(&walk, leaf);
    }
    if (search->slabs_pay) {
        lrcsi_tree_narrow(&walk, leaf);
    }
    for (int met = 0; status == LRCS_OK && (other = lrcsi_tree_next(&walk)) != LRCS_NONE; met++) {
        search->crowded += met >= MANY_LEAVES;
        if (!tree->has_slabs && search->crowded > tree->blocks[0]) {
            lrcsi_tree_fill_slabs(search->vertex, search->facet, tree);
        }
        if (tree->has_slabs && met == MANY_LEAVES && walk.leaf == LRCS_NONE) {
            lrcsi_tree_narrow(&walk, leaf);
        }
        status = meet_leaves(search, leaf, other);
    }
    search->slabs_pay = walk.apart >= BLOCKS_APART;
    return status;
}

/* Orders what was found by facet, in place, each entry going where its facet's next one belongs;
   then by other. */
static int order_found(const touch_search *search, uint32_t facet_count)
{
    uint32_t *first = search->intersections->first;
    uint32_t *next = lrcsi_work_take(search->work, facet_count, sizeof *next);
    if (!next) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < search->count; i++) {
        first[search->found[i].facet + 1]++;
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        next[f] = first[f];
        first[f + 1] += first[f];
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        while (next[f] < first[f + 1]) {
            touch_found *here = &search->found[next[f]];
            touch_found moved = *here;
            *here = search->found[next[moved.facet]];
            search->found[next[moved.facet]++] = moved;
        }
        if (first[f + 1] > first[f]) { /* where none was found at all there is no list either */
            sort_found(search->found + first[f], first[f + 1] - first[f]);
        }
    }
    return LRCS_OK;
}

/* Proves rings, and makes the tree and its leaves' corners. */
static int prepare_search(touch_search *search, uint32_t vertex_count, uint32_t facet_count,
                          const lrcsi_topology *topology, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    search->proved = lrcsi_work_take(work, vertex_count, sizeof *search->proved);
    uint32_t *apex = lrcsi_work_take(work, facet_count, sizeof *apex);
    if (!search->proved || !apex) {
        return LRCS_E_MEMORY;
    }
    int status = lrcsi_rings_prove(search->vertex, vertex_count, search->facet, facet_count,
                                   topology, skip, work, search->proved, apex);
    if (status == LRCS_OK) {
        status = lrcsi_tree_make(search->vertex, search->facet, facet_count, skip, apex, 1, work,
                                 &search->tree);
    }
    lrcsi_tree *tree = &search->tree;
    search->leaf = lrcsi_work_take(work, tree->blocks[0], sizeof *search->leaf);
    if (status != LRCS_OK || !search->leaf) {
        return LRCS_E_MEMORY;
    }
    lrcsi_tree_fill_cones(search->vertex, search->facet, search->proved, tree);
    for (uint32_t place = 0; place < tree->count; place++) {
        const uint32_t *c = search->facet[tree->order[place]].corner;
        touch_leaf *leaf = &search->leaf[place / LEAF_LANES];
        for (int k = 0; k < 3; k++) {
            leaf->corner[k][place % LEAF_LANES] = topology->weld[c[k]];
        }
    }
    return LRCS_OK;
}

size_t lrcsi_intersection_need(uint32_t vertex_count, uint32_t facet_count, size_t count)
{
    size_t need = 2 * lrcsi_work_bytes((size_t)facet_count + 1, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertex_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    size_t rings = lrcsi_rings_need(vertex_count);
    size_t search = lrcsi_tree_need(facet_count);
    search =
        lrcsi_work_add(search, lrcsi_work_bytes(facet_count / LEAF_LANES + 1, sizeof(touch_leaf)));
    search = lrcsi_work_add(
        search, lrcsi_work_bytes(lrcsi_work_add(count, FOUND_BLOCK), sizeof(touch_found)));
    return lrcsi_work_add(need, rings > search ? rings : search);
}

/* Everything but the release on failure. What is found grows above the tree, and moves down, less
   the facets' numbers, at the end. */
static int touches_build(touch_search *search, uint32_t vertex_count, uint32_t facet_count,
                         const lrcsi_topology *topology, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    lrcsi_intersections *t = search->intersections;
    t->first = lrcsi_work_take_zero(work, (size_t)facet_count + 1, sizeof *t->first);
    t->rim = lrcsi_work_take_zero(work, facet_count, 1);
    size_t mark = work->used;
    if (!t->first || !t->rim) {
        return LRCS_E_MEMORY;
    }
    int status = prepare_search(search, vertex_count, facet_count, topology, skip);
    for (uint32_t leaf = 0; status == LRCS_OK && leaf < search->tree.blocks[0]; leaf++) {
        status = meet_leaf(search, leaf);
    }
    if (status == LRCS_OK) {
        status = order_found(search, facet_count);
    }
    if (status != LRCS_OK) {
        return status;
    }
    work->used = mark;
    t->touch = lrcsi_work_take(work, search->count, sizeof *t->touch);
    for (t->count = 0; t->touch && t->count < search->count; t->count++) {
        touch_found found = search->found[t->count];
        t->touch[t->count] = (lrcsi_intersection){found.other, found.kind};
    }
    return t->touch ? LRCS_OK : LRCS_E_MEMORY;
}

int lrcsi_intersection_make(const lrcs_point *vertex, uint32_t vertex_count,
                            const lrcs_facet *facet, uint32_t facet_count,
                            const lrcsi_topology *topology, const unsigned char *skip,
                            const uint32_t *piece, lrcs_work *work,
                            lrcsi_intersections *intersections)
{
    size_t mark = work->used;
    lrcsi_intersections made = {0};
    touch_search search = {
        .vertex = vertex, .facet = facet, .piece = piece, .work = work, .intersections = &made};
    int status = touches_build(&search, vertex_count, facet_count, topology, skip);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *intersections = made;
    return LRCS_OK;
}
