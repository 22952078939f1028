/* SPDX-License-Identifier: MIT */
/* One cell: which surface component is nearest at a sample, whether it covers the cell, and what is
   behind it.

   Proof. P is the sample, x any other point of the cell in general position. "The path" is the
   straight line from P to x. All statements exclude the strips that visibility/cells_cut.c accounts
   for. Facets that have been removed from the list are nowhere the nearest: at every point of the
   cell that such a facet covers, a facet of the list is in front of it. (2) preserves this, and
   facets that are hidden everywhere need not be listed in the first place.

   (1) Let K be a set of listed facets with this property: each of its edges that crosses the cell
   is no event edge, and joins two facets of K. Then K covers x as many times as it covers P: along
   the path this number cannot change, because where one facet of K ends the next begins. So if
   exactly one facet of K certainly covers P, and the others certainly do not, K covers the cell
   once. It does not matter how K was found. At first K takes all listed neighbours of its facets,
   so that few edges need to be compared with the cell. Facets that are connected with it outside
   the cell only may then end in the cell, or cover P too. If so, and if there is no segment of K to
   cut along, K is found again, across edges that may cross the cell only.

   (2) Let K cover the cell once, and let G be a facet that is behind K at one point of the cell. If
   no contact between G and a facet of K crosses the cell, G is behind K wherever it is in the cell,
   because the two do not meet there and what G has in the cell is connected. So G can be removed,
   even if K meets other facets. The same is true of an event edge that is behind K at one point of
   the cell, and has a facet that no contact in the cell joins with K: K does not cross that edge.

   (3) Let K cover the cell once and be nearest at P, and let no contact between a facet of K and
   another facet cross the cell. If no event edge is left in the list, all of K is visible in the
   cell, and nothing else is. For let y be the first point of the path at which K is no longer the
   nearest of all facets. The facet H that is nearest just beyond y is listed. It begins at y at an
   edge, or passes through K there at a contact; the latter is excluded. The edge is an event edge,
   since a facet that ended there would have been in front of K before y. It is in front of K at y,
   and H has been listed all the time, so the edge has not been removed from the list.

   (4) If no facet covers P, and no event edge crosses the cell, no facet is visible in it.

   A contact is where two facets meet in space other than along a common edge or in a point: along a
   segment in the interior of one (mesh/contact/intersection.h), along parts of edges of both
   (lrcsi_intersection_along), or in a common plane. Such an edge, and every edge of a facet that
   has another facet in its plane, counts as an event edge, so that no component continues across
   it. A facet with a contact that could not be computed (LRCSI_FACET_UNKNOWN_CONTACT) is never part
   of a component that covers a cell. Contacts in points do not matter: paths to points in general
   position miss them.

   An edge between a facet of K and a removed one, G, is behind K', behind which G was removed. Near
   the line in which K and K' meet, at the border of the cell, it can be as far inside as the strip
   of that contact is wide. So it is compared with the cell again, with that width added to its
   error. */
#include "visibility/cells_cover.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

/* The search of a component of more facets than this ends at the first event edge that crosses the
   cell. In a smaller one all are found, and the cell is cut along the one that divides it best. */
#define SMALL_COMPONENT 8u

/* Finds the facet nearest to the laser at a point. Returns FOUND if all others that may cover the
   point are certainly behind it; UNSURE or NONE as lrcsi_cells_nearest. */
static int cells_sample(lrcsi_cells_work *c, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                        const double at[2], uint32_t *best)
{
    double best_z = -HUGE_VAL;
    c->hits = 0;
    *best = LRCS_NONE;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t index = cell->facet[i];
        const lrcsi_cells_facet *f = &c->facet[index];
        double w = f->err + s->tolerance;
        c->listed[index] = c->stamp;
        double outside = lrcsi_max3(lrcsi_max(f->low[0] - at[0], at[0] - f->high[0]),
                                    f->low[1] - at[1], at[1] - f->high[1]);
        if (outside > w) {
            continue;
        }
        double inside = lrcsi_line_at(f->side[0], at[0], at[1]);
        inside = lrcsi_min(inside, lrcsi_line_at(f->side[1], at[0], at[1]));
        inside = lrcsi_min(inside, lrcsi_line_at(f->side[2], at[0], at[1]));
        if (inside < -w) {
            continue;
        }
        c->hit[c->hits++] = index;
        int covers = inside > w && !f->sliver;
        c->covers[index] = 2 * c->stamp + (uint32_t)covers;
        double range[2];
        lrcsi_cells_facet_z(f, at, s->tolerance, range);
        if (covers && (*best == LRCS_NONE || range[0] > best_z)) {
            *best = index;
            best_z = range[0];
        }
    }
    if (*best == LRCS_NONE) {
        return c->hits == 0 ? LRCSI_SAMPLE_EMPTY : LRCSI_SAMPLE_UNSURE;
    }
    uint32_t changes = 0;
    for (uint32_t i = 0; i < c->hits; i++) {
        uint32_t other = c->hit[i];
        double range[2];
        lrcsi_cells_facet_z(&c->facet[other], at, s->tolerance, range);
        if (other == *best || range[1] < best_z) {
            continue;
        }
        int order = c->covers[other] % 2 == 1 && changes < 8
                        ? lrcsi_cells_facet_order(c->view, *best, other)
                        : 0;
        if (order == 0) {
            return LRCSI_SAMPLE_UNSURE;
        }
        if (order > 0) { /* the earlier ones are compared with it again */
            *best = other;
            best_z = lrcsi_min(best_z, range[0]);
            changes++;
            i = (uint32_t)-1;
        }
    }
    return LRCSI_SAMPLE_FOUND;
}

/* The weight of corner i is 1 in the first sample, 1 + 0.2 i in the second, 1 + 1.5 / (1 + i) in
   the third. With equal weights, all samples in a symmetric cell could be on its axis, and so on an
   edge between facets. */
void lrcsi_cells_sample_point(const lrcsi_cell *cell, int number, double at[2])
{
    double sum = 0;
    at[0] = at[1] = 0;
    for (uint32_t i = 0; i < cell->shape.count; i++) {
        double weight = number == 0 ? 1 : number == 1 ? 1 + 0.2 * i : 1 + 1.5 / (1 + i);
        at[0] += weight * cell->shape.corner[i][0];
        at[1] += weight * cell->shape.corner[i][1];
        sum += weight;
    }
    at[0] /= sum;
    at[1] /= sum;
}

int lrcsi_cells_nearest(lrcsi_cells_work *c, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                        uint32_t *best, double at[2], double *clear)
{
    int answer = LRCSI_SAMPLE_UNSURE;
    for (int t = 0; t < LRCSI_SAMPLES && answer == LRCSI_SAMPLE_UNSURE; t++) {
        lrcsi_cells_sample_point(cell, t, at);
        *clear = lrcsi_clip_border_distance(s, at);
        c->stamp++;
        if (*clear > 4 * (cell->widest_strip + c->facet_err + s->tolerance)) {
            answer = cells_sample(c, cell, s, at, best);
        }
    }
    return answer;
}

/* Do all segments of the component in the list belong to contacts? Marks the facets that meet the
   component there. */
static int contacts_only(lrcsi_cells_work *c, const lrcsi_cell *cell)
{
    int only = 1;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[cell->segment[i]];
        if (lrcsi_cells_of_component(c, e)) {
            only &= e->contact != 0;
            c->contacts[e->owner[0]] = c->stamp;
            if (e->owner[1] != LRCS_NONE) {
                c->contacts[e->owner[1]] = c->stamp;
            }
        }
    }
    return only;
}

/* Does a facet alone cover the cell? */
static int covers_alone(const lrcsi_cells_work *c, const lrcsi_cell *cell,
                        const lrcsi_clip_sides *s, uint32_t index)
{
    const lrcsi_cells_facet *f = &c->facet[index];
    double w = f->err + s->tolerance;
    for (int k = 0; k < 3; k++) {
        double range[2];
        lrcsi_line_range(&cell->shape, f->side[k], range);
        if (!(range[0] > w)) {
            return 0;
        }
    }
    return (c->kind[index] & LRCSI_FACET_UNKNOWN_CONTACT) == 0;
}

int lrcsi_cells_find_occluder(lrcsi_cells_work *c, const lrcsi_cell *cell,
                              const lrcsi_clip_sides *s, const double at[2])
{
    uint32_t occluder = LRCS_NONE;
    double best_z = -HUGE_VAL;
    for (uint32_t i = 0; i < c->hits; i++) {
        uint32_t index = c->hit[i];
        double range[2];
        lrcsi_cells_facet_z(&c->facet[index], at, s->tolerance, range);
        if (c->covers[index] == 2 * c->stamp + 1 && range[0] > best_z &&
            covers_alone(c, cell, s, index)) {
            occluder = index;
            best_z = range[0];
        }
    }
    if (occluder == LRCS_NONE) {
        return 0;
    }
    c->borders = 0;
    c->component[0] = occluder;
    c->components = 1;
    c->in_component[occluder] = c->stamp;
    contacts_only(c, cell);
    return 1;
}

/* Where side k of a facet of the component lies: a lrcsi_clip_location. Given: is the facet across
   it removed from the list? Returned, unless it is outside: the side, and where it is near the
   cell. */
static int locate_side(const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                       const lrcsi_cells_facet *f, int k, int removed, lrcsi_cell_border *side)
{
    int n = k == 2 ? 0 : k + 1;
    const double p[2] = {f->x[k], f->y[k]};
    const double q[2] = {f->x[n], f->y[n]};
    double w = f->err + s->tolerance;
    double line_w = (f->sliver ? f->err : f->line_err) + s->tolerance;
    if (lrcsi_clip_box_outside(s, p, q, w)) {
        return LRCSI_CLIP_OUTSIDE;
    }
    *side = (lrcsi_cell_border){
        {f->side[k][0], f->side[k][1], f->side[k][2]}, {p[0], p[1]}, f->length[k], {0, 1, 0}};
    if (f->sliver) {
        lrcsi_line_through(p, q, side->line);
    }
    int place =
        lrcsi_clip_locate_near(&cell->shape, s, p, q, side->line, w, line_w, &side->interval);
    return place == LRCSI_CLIP_CROSSES && removed
               ? lrcsi_clip_locate_near(&cell->shape, s, p, q, side->line, w + cell->widest_strip,
                                        line_w + cell->widest_strip, &side->interval)
               : place;
}

int lrcsi_cells_component(lrcsi_cells_work *c, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                          uint32_t best, int within)
{
    int covers = 1;
    for (uint32_t i = 0; within && i < c->components; i++) {
        c->in_component[c->component[i]] = 0;
    }
    c->borders = 0;
    c->component[0] = best;
    c->components = 1;
    c->in_component[best] = c->stamp;
    for (uint32_t i = 0; i < c->components; i++) {
        uint32_t facet = c->component[i];
        const lrcsi_cells_facet *f = &c->facet[facet];
        covers &= (c->kind[facet] & LRCSI_FACET_UNKNOWN_CONTACT) == 0 &&
                  (facet == best || (c->covers[facet] >> 1) != c->stamp);
        for (int k = 0; k < 3; k++) {
            lrcsi_cell_border side;
            uint32_t next = f->neighbour[k];
            if (next != LRCS_NONE && c->in_component[next] == c->stamp) {
                continue;
            }
            int listed = next != LRCS_NONE && c->listed[next] == c->stamp;
            int place = listed && !within
                            ? LRCSI_CLIP_CROSSES
                            : locate_side(cell, s, f, k, next != LRCS_NONE && !listed, &side);
            if (place == LRCSI_CLIP_CROSSES && listed) {
                c->in_component[next] = c->stamp;
                c->component[c->components++] = next;
            } else if (place == LRCSI_CLIP_CROSSES && c->components > SMALL_COMPONENT) {
                return 0;
            } else if (place == LRCSI_CLIP_CROSSES) {
                covers = 0;
            } else if (place == LRCSI_CLIP_BORDER && next != LRCS_NONE) {
                covers &= c->borders < LRCSI_COVER_MAX_BORDERS;
                if (covers) {
                    c->border[c->borders++] = side;
                }
            }
        }
    }
    return covers && contacts_only(c, cell);
}

int lrcsi_cells_segment_has(const lrcs_prepared *prepared, const lrcsi_cells_segment *e,
                            const uint32_t *mark, uint32_t value)
{
    if (mark[e->owner[0]] == value || (e->owner[1] != LRCS_NONE && mark[e->owner[1]] == value)) {
        return 1;
    }
    return e->edge != LRCS_NONE &&
           lrcsi_topology_edge_has(&prepared->topology, e->edge, mark, value);
}

int lrcsi_cells_of_component(const lrcsi_cells_work *c, const lrcsi_cells_segment *e)
{
    return lrcsi_cells_segment_has(c->view->prepared, e, c->in_component, c->stamp);
}

/* Is no facet of an edge in the list any more, or not both facets of a contact? */
static int segment_is_unlisted(const lrcsi_cells_work *c, const lrcsi_cells_segment *e)
{
    if (e->contact) {
        return c->listed[e->owner[0]] != c->stamp || e->owner[1] == LRCS_NONE ||
               c->listed[e->owner[1]] != c->stamp;
    }
    return !lrcsi_cells_segment_has(c->view->prepared, e, c->listed, c->stamp);
}

/* Is a facet in the list, and does no contact in the cell join it with the component? */
static int has_no_contact(const lrcsi_cells_work *c, uint32_t facet)
{
    return facet != LRCS_NONE && c->listed[facet] == c->stamp && c->contacts[facet] != c->stamp;
}

/* Is the part of an edge in the cell behind the component, which covers the cell? If the component
   is one facet, both ends of the part are compared with its plane. Otherwise, if a facet of the
   edge has no contact with the component, one point of the part is compared with the facet that
   covers it. Given: low, the lowest z of the component in the cell. */
static int segment_behind(const lrcsi_cells_work *c, const lrcsi_cell *cell,
                          const lrcsi_clip_sides *s, const lrcsi_cells_segment *e, double w,
                          double low)
{
    double z_err = 2 * e->z_err;
    if (lrcsi_max(e->end[0][2], e->end[1][2]) + z_err < low) {
        return 1;
    }
    lrcsi_clip_interval interval = {0, 1, 0};
    lrcsi_clip_locate(&cell->shape, s, e->end[0], e->end[1], e->line, w, w, &interval);
    double at[2][3];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            at[i][k] = e->end[0][k] +
                       (i == 0 ? interval.from : interval.to) * (e->end[1][k] - e->end[0][k]);
        }
    }
    if (lrcsi_max(at[0][2], at[1][2]) + z_err < low) {
        return 1;
    }
    if (c->components == 1) {
        const lrcsi_cells_facet *f = &c->facet[c->component[0]];
        double err = f->plane_err[0] + f->plane_err[1] * w + z_err;
        return at[0][2] + err < f->z[0] * at[0][0] + f->z[1] * at[0][1] + f->z[2] &&
               at[1][2] + err < f->z[0] * at[1][0] + f->z[1] * at[1][1] + f->z[2];
    }
    if (!has_no_contact(c, e->owner[0]) && !has_no_contact(c, e->owner[1])) {
        return 0;
    }
    double middle[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (at[0][k] + at[1][k]);
    }
    for (uint32_t i = 0; i < s->count; i++) {
        if (!(lrcsi_line_at(s->line[i], middle[0], middle[1]) > w)) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < c->components; i++) {
        const lrcsi_cells_facet *f = &c->facet[c->component[i]];
        double clear = f->sliver ? HUGE_VAL : 2 * f->err + w;
        if (lrcsi_line_at(f->side[0], middle[0], middle[1]) > clear &&
            lrcsi_line_at(f->side[1], middle[0], middle[1]) > clear &&
            lrcsi_line_at(f->side[2], middle[0], middle[1]) > clear) {
            double range[2];
            lrcsi_cells_facet_z(f, middle, w, range);
            return middle[2] + z_err < range[0];
        }
    }
    return 0;
}

/* Is a facet that certainly covers the sample behind the component there? at NULL: yes. */
static int behind_at(const lrcsi_cells_work *c, const lrcsi_clip_sides *s, const double *at,
                     uint32_t facet)
{
    double range[2];
    double of_component[2];
    if (!at) {
        return 1;
    }
    lrcsi_cells_facet_z(&c->facet[facet], at, s->tolerance, range);
    lrcsi_cells_facet_z(&c->facet[c->component[0]], at, s->tolerance, of_component);
    return range[1] < of_component[0];
}

void lrcsi_cells_cull(lrcsi_cells_work *c, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                      const double *at, double uncertainty)
{
    double low = HUGE_VAL;
    for (uint32_t i = 0; i < c->components; i++) {
        low = lrcsi_min(low, lrcsi_cells_facet_z_bound(&c->facet[c->component[i]], s, -1));
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = cell->facet[i];
        if (c->in_component[f] != c->stamp &&
            ((c->covers[f] == 2 * c->stamp + 1 && c->contacts[f] != c->stamp &&
              behind_at(c, s, at, f)) ||
             c->facet[f].z_high < low || lrcsi_cells_facet_z_bound(&c->facet[f], s, 1) < low)) {
            c->listed[f] = 0;
            c->state[f] |= LRCSI_FINDING_HIDDEN;
            c->area[f].uncertainty += c->wanted[f] ? cell->uncertainty + uncertainty : 0;
            continue;
        }
        cell->facet[kept++] = f;
    }
    cell->facets = kept;
    kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[cell->segment[i]];
        if (!segment_is_unlisted(c, e) &&
            (e->contact || !segment_behind(c, cell, s, e, e->err + s->tolerance, low))) {
            cell->segment[kept++] = cell->segment[i];
        }
    }
    cell->segments = kept;
}
