/* SPDX-License-Identifier: MIT */
/* One cell: which surface component is nearest at a sample, whether it covers the cell, and what is
   behind it.

   Proof. P is the sample, x any other point of the cell in general position. "The path" is the
   straight line from P to x. All statements exclude the strips that visibility/cells/cells_cut.c
   accounts for. Facets that have been removed from the list are nowhere the nearest: at every point
   of the cell that such a facet covers, a facet of the list is in front of it. (2) preserves this,
   and facets that are hidden everywhere need not be listed in the first place.

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

   (5) Let K cover the cell once and be nearest at P, and let P be in a part of the cell after a
   cut. What (1) states of the points of the cell is then true of those of the part. It excludes
   strips at the border of the cell. These are charged already to all facets of the list, unless the
   cell is thin. So in a cell that is not thin, K and P serve for the part as well; (2) and (3) are
   applied to them with the segments that the part has.

   A contact is where two facets meet in space other than along a common edge or in a point: along a
   segment in the interior of one (mesh/contact/intersection.h), along parts of edges of both
   (lrcsi_intersection_along), or in a common plane. Such an edge, and every edge of a facet that
   has another facet in its plane, counts as an event edge, so that no component continues across
   it. A facet with a contact that could not be computed (unknown_contact) is never part
   of a component that covers a cell. Contacts in points do not matter: paths to points in general
   position miss them.

   An edge between a facet of K and a removed one, G, is behind K', behind which G was removed. Near
   the line in which K and K' meet, at the border of the cell, it can be as far inside as the strip
   of that contact is wide. So it is compared with the cell again, with that width added to its
   error. */
#include "visibility/cells/cells_cover.h"

#include <math.h>
#include <string.h>

#include "base/range.h"

/* The search of a component of more facets than this ends at the first event edge that crosses the
   cell. In a smaller one all are found, and the cell is cut along the one that divides it best: a
   heuristic, since any cut serves. */
#define SMALL_COMPONENT 8u
/* A sample stays undecided if the nearest facet so far is replaced more often than this: a
   heuristic limit on the time that is spent on one sample. Depth orders that form a cycle would not
   end. */
#define MAX_CHANGES 8u

/* --- the sample ------------------------------------------------------------------------------- */

/* Does a facet certainly cover the sample? */
static int covers_sample(const lrcsi_cells_sample *sample, uint32_t facet)
{
    return sample->covers[facet] == 2 * sample->listed.number + 1;
}

/* May a facet cover the sample? */
static int may_cover_sample(const lrcsi_cells_sample *sample, uint32_t facet)
{
    return sample->covers[facet] >> 1 == sample->listed.number;
}

/* Finds the facets that may cover a sample, and which of them is nearest to the laser. Returns a
   lrcsi_sample_outcome. */
static int sample_nearest(const lrcsi_division *d, const lrcsi_cell *cell,
                          const lrcsi_clip_sides *s, lrcsi_cells_sample *sample)
{
    const double at[2] = {sample->at[0], sample->at[1]};
    const lrcsi_marks listed = sample->listed;
    uint32_t *const hit = sample->hit;
    uint32_t *const covers = sample->covers;
    uint32_t hits = 0;
    uint32_t best = LRCS_NONE;
    double best_z = -HUGE_VAL;
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t index = cell->facet[i];
        const lrcsi_cells_facet *f = &d->facet[index];
        double w = f->err + s->tolerance;
        listed.entry[index] = listed.number;
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
        hit[hits++] = index;
        int certain = inside > w && !f->degenerate;
        covers[index] = 2 * listed.number + (uint32_t)certain;
        double range[2];
        lrcsi_cells_facet_z(f, at, s->tolerance, range);
        if (certain && (best == LRCS_NONE || range[0] > best_z)) {
            best = index;
            best_z = range[0];
        }
    }
    sample->hit_count = hits;
    if (best == LRCS_NONE) {
        return hits == 0 ? LRCSI_SAMPLE_EMPTY : LRCSI_SAMPLE_UNSURE;
    }
    uint32_t changes = 0;
    for (uint32_t i = 0; i < hits;) {
        uint32_t other = hit[i++];
        double range[2];
        lrcsi_cells_facet_z(&d->facet[other], at, s->tolerance, range);
        if (other == best || range[1] < best_z) {
            continue;
        }
        int order =
            covers_sample(sample, other) && changes < MAX_CHANGES
                ? lrcsi_cells_facet_order(d->view, d->facet[best].facet, d->facet[other].facet)
                : 0;
        if (order == 0) {
            return LRCSI_SAMPLE_UNSURE;
        }
        if (order > 0) { /* the earlier ones are compared with it again */
            best = other;
            best_z = lrcsi_min(best_z, range[0]);
            changes++;
            i = 0;
        }
    }
    sample->nearest = best;
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

/* Is the sample farther from the border of the cell than any strip is wide? */
static int is_inside(const lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                     const lrcsi_cells_sample *sample)
{
    return sample->border_distance > 4 * (cell->widest_strip + d->facet_err + s->tolerance);
}

int lrcsi_cells_sample_keep(const lrcsi_division *d, const lrcsi_cell *cell,
                            const lrcsi_clip_sides *s, lrcsi_cells_sample *sample)
{
    sample->border_distance = lrcsi_clip_border_distance(s, sample->at);
    return is_inside(d, cell, s, sample);
}

void lrcsi_cells_sample_take(const lrcsi_division *d, const lrcsi_cell *cell,
                             const lrcsi_clip_sides *s, lrcsi_cells_sample *sample)
{
    sample->outcome = LRCSI_SAMPLE_UNSURE;
    for (int t = 0; t < LRCSI_SAMPLES && sample->outcome == LRCSI_SAMPLE_UNSURE; t++) {
        lrcsi_cells_sample_point(cell, t, sample->at);
        sample->border_distance = lrcsi_clip_border_distance(s, sample->at);
        lrcsi_cells_sample_clear(sample, d->record_room);
        if (is_inside(d, cell, s, sample)) {
            sample->outcome = sample_nearest(d, cell, s, sample);
        }
    }
}

/* --- the surface that covers the cell --------------------------------------------------------- */

/* Marks the facets of the segments in the cell's list that belong to the foreground. Returns 1 if
   any of these segments is an event edge. */
static int mark_adjoining(const lrcsi_division *d, const lrcsi_cell *cell,
                          lrcsi_cells_surface *surface)
{
    lrcsi_marks *adjoining = &surface->adjoining;
    int has_edge = 0;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &d->segment[cell->segment[i]];
        if (lrcsi_division_segment_marked(d, e, &surface->foreground)) {
            has_edge |= e->contact == 0;
            adjoining->entry[e->owner[0]] = adjoining->number;
            if (e->owner[1] != LRCS_NONE) {
                adjoining->entry[e->owner[1]] = adjoining->number;
            }
        }
    }
    return has_edge;
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
    double line_w = (f->degenerate ? f->err : f->line_err) + s->tolerance;
    if (lrcsi_clip_box_outside(s, p, q, w)) {
        return LRCSI_CLIP_OUTSIDE;
    }
    *side = (lrcsi_cell_border){
        {f->side[k][0], f->side[k][1], f->side[k][2]}, {p[0], p[1]}, f->length[k], {0, 1, 0}};
    if (f->degenerate) {
        lrcsi_line_through(p, q, side->line);
    }
    int place =
        lrcsi_clip_locate_near(&cell->shape, s, p, q, side->line, w, line_w, &side->interval);
    return place == LRCSI_CLIP_CROSSES && removed
               ? lrcsi_clip_locate_near(&cell->shape, s, p, q, side->line, w + cell->widest_strip,
                                        line_w + cell->widest_strip, &side->interval)
               : place;
}

int lrcsi_cells_surface_find(const lrcsi_division *d, const lrcsi_cell *cell,
                             const lrcsi_clip_sides *s, const lrcsi_cells_sample *sample,
                             int extent, lrcsi_cells_surface *surface)
{
    uint32_t count = 1;
    int covers = 1;
    lrcsi_marks_clear(&surface->foreground, d->record_room);
    lrcsi_marks_clear(&surface->adjoining, d->record_room);
    const uint32_t number = surface->foreground.number;
    uint32_t *const mark = surface->foreground.entry;
    const uint32_t *const listed = sample->listed.entry;
    const uint32_t listed_number = sample->listed.number;
    surface->nearest = 1;
    surface->border_count = 0;
    surface->facet[0] = sample->nearest;
    mark[sample->nearest] = number;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = surface->facet[i];
        const lrcsi_cells_facet *f = &d->facet[facet];
        covers &=
            !f->unknown_contact && (facet == sample->nearest || !may_cover_sample(sample, facet));
        for (int k = 0; k < 3; k++) {
            lrcsi_cell_border side;
            uint32_t next = f->neighbour[k];
            int is_listed = next != LRCS_NONE && listed[next] == listed_number;
            if (is_listed && (extent == LRCSI_SURFACE_LISTED || mark[next] == number)) {
                surface->facet[count] = next; /* without a branch: which are new has no pattern */
                count += mark[next] != number;
                mark[next] = number;
                continue;
            }
            int place = locate_side(cell, s, f, k, next != LRCS_NONE && !is_listed, &side);
            if (place == LRCSI_CLIP_CROSSES && is_listed) {
                mark[next] = number;
                surface->facet[count++] = next;
            } else if (place == LRCSI_CLIP_CROSSES && count > SMALL_COMPONENT) {
                surface->facet_count = count;
                return 0;
            } else if (place == LRCSI_CLIP_CROSSES) {
                covers = 0;
            } else if (place == LRCSI_CLIP_BORDER && next != LRCS_NONE) {
                covers &= surface->border_count < LRCSI_SURFACE_BORDERS;
                if (covers) {
                    surface->border[surface->border_count++] = side;
                }
            }
        }
    }
    surface->facet_count = count;
    return covers && !mark_adjoining(d, cell, surface);
}

void lrcsi_cells_surface_keep(const lrcsi_division *d, const lrcsi_cell *cell,
                              lrcsi_cells_surface *surface)
{
    lrcsi_marks_clear(&surface->adjoining, d->record_room);
    surface->border_count = 0;
    (void)mark_adjoining(d, cell, surface);
}

int lrcsi_cells_surface_occluder(const lrcsi_division *d, const lrcsi_cell *cell,
                                 const lrcsi_clip_sides *s, const lrcsi_cells_sample *sample,
                                 lrcsi_cells_surface *surface)
{
    uint32_t occluder = LRCS_NONE;
    double best_z = -HUGE_VAL;
    for (uint32_t i = 0; i < sample->hit_count; i++) {
        uint32_t index = sample->hit[i];
        const lrcsi_cells_facet *f = &d->facet[index];
        double range[2];
        lrcsi_cells_facet_z(f, sample->at, s->tolerance, range);
        int covers = covers_sample(sample, index) && range[0] > best_z && !f->unknown_contact;
        for (int k = 0; k < 3 && covers; k++) {
            double distance[2];
            lrcsi_line_range(&cell->shape, f->side[k], distance);
            covers = distance[0] > f->err + s->tolerance;
        }
        if (covers) {
            occluder = index;
            best_z = range[0];
        }
    }
    if (occluder == LRCS_NONE) {
        return 0;
    }
    surface->nearest = 0;
    surface->border_count = 0;
    surface->facet[0] = occluder;
    surface->facet_count = 1;
    surface->foreground.entry[occluder] = surface->foreground.number;
    (void)mark_adjoining(d, cell, surface);
    return 1;
}

/* --- what is behind it ------------------------------------------------------------------------ */

/* Is no facet of an edge in the list any more, or not both facets of a contact? */
static int segment_is_unlisted(const lrcsi_division *d, const lrcsi_marks *listed,
                               const lrcsi_cells_segment *e)
{
    if (e->contact) {
        return !lrcsi_marked(listed, e->owner[0]) || e->owner[1] == LRCS_NONE ||
               !lrcsi_marked(listed, e->owner[1]);
    }
    return !lrcsi_division_segment_marked(d, e, listed);
}

/* Is a facet in the list, and does no contact in the cell join it with the surface? */
static int has_no_contact(const lrcsi_marks *listed, const lrcsi_cells_surface *surface,
                          uint32_t facet)
{
    return facet != LRCS_NONE && lrcsi_marked(listed, facet) &&
           !lrcsi_marked(&surface->adjoining, facet);
}

/* The facet of the surface that certainly covers a point, to within w, or NULL. *near is where the
   search begins, in both directions: the place of the facet that was found for the point before.
   Adjacent facets are near each other in the list, and so are edges near each other in theirs. */
static const lrcsi_cells_facet *surface_facet_at(const lrcsi_division *d,
                                                 const lrcsi_cells_surface *surface,
                                                 const double point[2], double w, uint32_t *near)
{
    const uint32_t count = surface->facet_count;
    const uint32_t start = *near;
    const uint32_t farthest = start + 1 > count - start ? start + 1 : count - start;
    for (uint32_t i = 0; i < 2 * farthest; i++) {
        const uint32_t step = (i + 1) / 2;
        const uint32_t at = i % 2 == 0 ? start + step : start - step; /* below 0 it wraps around */
        if (at >= count) {
            continue;
        }
        const lrcsi_cells_facet *f = &d->facet[surface->facet[at]];
        const double inside = f->degenerate ? HUGE_VAL : 2 * f->err + w;
        if (lrcsi_line_at(f->side[0], point[0], point[1]) > inside &&
            lrcsi_line_at(f->side[1], point[0], point[1]) > inside &&
            lrcsi_line_at(f->side[2], point[0], point[1]) > inside) {
            *near = at;
            return f;
        }
    }
    return NULL;
}

/* Is the part of an edge in the cell behind the surface, which covers the cell? If the surface
   is one facet, both ends of the part are compared with its plane. Otherwise, if a facet of the
   edge has no contact with the surface, one point of the part is compared with the facet that
   covers it. Given: low, the lowest z of the surface in the cell; *near: as above. */
static int segment_behind(const lrcsi_division *d, const lrcsi_marks *listed,
                          const lrcsi_cells_surface *surface, const lrcsi_cell *cell,
                          const lrcsi_clip_sides *s, const lrcsi_cells_segment *e, double low,
                          uint32_t *near)
{
    double w = e->err + s->tolerance;
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
    if (surface->facet_count == 1) {
        const lrcsi_cells_facet *f = &d->facet[surface->facet[0]];
        double err = f->plane_err[0] + f->plane_err[1] * w + z_err;
        return at[0][2] + err < f->z[0] * at[0][0] + f->z[1] * at[0][1] + f->z[2] &&
               at[1][2] + err < f->z[0] * at[1][0] + f->z[1] * at[1][1] + f->z[2];
    }
    if (!has_no_contact(listed, surface, e->owner[0]) &&
        !has_no_contact(listed, surface, e->owner[1])) {
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
    const lrcsi_cells_facet *f = surface_facet_at(d, surface, middle, w, near);
    double range[2];
    if (!f) {
        return 0;
    }
    lrcsi_cells_facet_z(f, middle, w, range);
    return middle[2] + z_err < range[0];
}

/* Is a facet that certainly covers the sample behind the surface there? */
static int behind_at_sample(const lrcsi_division *d, const lrcsi_clip_sides *s,
                            const lrcsi_cells_sample *sample, const lrcsi_cells_surface *surface,
                            uint32_t facet)
{
    double range[2];
    double of_surface[2];
    if (surface->nearest) {
        return 1;
    }
    lrcsi_cells_facet_z(&d->facet[facet], sample->at, s->tolerance, range);
    lrcsi_cells_facet_z(&d->facet[surface->facet[0]], sample->at, s->tolerance, of_surface);
    return range[1] < of_surface[0];
}

void lrcsi_cells_cull(lrcsi_blocks *b, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                      const lrcsi_cells_surface *surface, double uncertainty,
                      lrcsi_cells_sample *sample)
{
    const lrcsi_division *d = &b->division;
    const lrcsi_marks foreground = surface->foreground;
    double low = HUGE_VAL; /* the lowest z of the surface in the cell */
    for (uint32_t i = 0; i < surface->facet_count; i++) {
        low = lrcsi_min(low, lrcsi_cells_facet_z_bound(&d->facet[surface->facet[i]], s, -1));
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t f = cell->facet[i];
        if (!lrcsi_marked(&foreground, f) &&
            ((covers_sample(sample, f) && !lrcsi_marked(&surface->adjoining, f) &&
              behind_at_sample(d, s, sample, surface, f)) ||
             d->facet[f].z_high < low || lrcsi_cells_facet_z_bound(&d->facet[f], s, 1) < low)) {
            sample->listed.entry[f] = 0;
            b->record_finding[f] |= LRCSI_FINDING_HIDDEN;
            d->area[f].uncertainty += d->wanted[f] ? cell->uncertainty + uncertainty : 0;
            continue;
        }
        cell->facet[kept++] = f;
    }
    cell->facet_count = kept;
    kept = 0;
    uint32_t near = 0;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &d->segment[cell->segment[i]];
        if (!segment_is_unlisted(d, &sample->listed, e) &&
            (e->contact || !segment_behind(d, &sample->listed, surface, cell, s, e, low, &near))) {
            cell->segment[kept++] = cell->segment[i];
        }
    }
    cell->segment_count = kept;
}
