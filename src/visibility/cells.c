/* SPDX-License-Identifier: MIT */
/* Exact visibility in convex cells of the view plane. It finds areas with bounds; what facets show
   in pieces is found one by one (visibility/occlude.c).

   A cell is the convex hull of its corners, which are doubles. With it goes a list of the facets
   that may be seen in it, and a list of segments: its event edges and contacts. A cell begins as a
   cell of the grid. One sample is taken in it, at a place P. From the facet nearest to the laser
   there, the surface around it is followed across edges that are no events, as far as the cell
   goes: the component. If an event or a contact of the component crosses the cell, the cell is cut
   along its line. If none does, the component covers the cell. Facets and events behind it are
   dropped from the lists, for all that comes of the cell. If no event is left, nothing else is seen
   in the cell; if one is, the cell is cut along it.

   Why this is right. All statements are about the cell but for some strips; x is any point of it,
   in general position, and the way from P to x is straight.
     (1) Let K be a set of facets such that any edge of theirs that crosses the cell is no event,
   and joins two facets of K. Then as many facets of K cover x as cover P: on the way from P to x
   their number does not change, since where one ends the next begins. So if just one facet of K
   surely covers P and the others surely do not, K covers the cell once. How K was found does not
   matter.
     (2) Let K cover the cell once, let no contact between a facet of K and another cross the cell,
   and let K be nearest at P. The number of surfaces in front of K is 0 at P, and changes on the way
   only at an event edge in front of K: at an edge that joins two facets one ends and one begins. So
   where no event is in front of K, all of K is seen in the cell, and nothing else.
     (3) Let K be as in (2), but perhaps with events in front of it. What is behind K at one place
   of the cell is behind it wherever it is in the cell. It may be dropped there: at no point is it
   nearest. (2) holds for the facets that are left: an edge that joins one of them with a dropped
   one is behind a cover, and a component that is nearest at P and has no contact with that cover
   is behind it nowhere.
     (4) Where no facet covers P, and no event crosses the cell, no facet is seen in it.
   A contact is where two facets meet in space other than along a common edge or in a point: across
   segments of the inside of one (mesh/touch.h), along parts of edges of both (the facets are then
   marked as rims), or in one plane. All edges of rims and of facets with another in their plane
   count as events, so that no component goes on across them. Facets of which a contact is not known
   tell nothing (`vague`). Contacts in points do not matter: ways in general position miss them.

   Error. A vertex is off in the view by less than 1.5 e, e its error in each coordinate; a sum of
   products that tells on which side of a line a point lies is off by at most 12 u b, b the largest
   coordinate. Cutting puts new corners within 3 u b of a side; the two parts of a cell then miss no
   point of it by more. So a point of the grid's cell belongs to one of the cells that come of it,
   or is within 3 u b n of that, n the number of cuts; what is said of a cell holds for points so
   near to it. Let w be 2 e of what is asked about and (16 + 4 n) u b. A segment that is computed to
   be farther than w from the cell does not come near it. One that is nowhere deeper than w within
   the cell (`BORDER`) has its part in the cell within 2 w of the line along a side of the cell, or
   of its own line with the cell on one side. P is clear of these by c. So the way from P to x
   crosses the segment only if x lies within 2 w of that line, and no farther along it from the
   segment than 2 w / c of the cell's diameter, which is below CELLS_FAR w where c is above
   CELLS_THIN of the perimeter. That area is in doubt; it is charged to the facets of the list that
   come near, when the segment is struck from the list; all cells that come of the cell are then rid
   of it. In a thin cell the strips of all that were struck run along the whole of it. The area of a
   facet in a cell is off by w times the length of its sides there, and 4 u b n times the cell's
   perimeter.

   Heights. In a facet of height H above each side, a place within w of it has barycentric
   coordinates off by w / H; with the facet's slope at most G, twice what it is as computed, its z
   there is off by e + G (w + 8 u l^2 / H), l its longest side, the second for the slope's own
   error, and is never beyond the z of its corners. Where H < 8 w only these count. */
#include "visibility/cells.h"

#include <math.h>
#include <string.h>

#include "base/dd.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/clip.h"
#include "visibility/contact.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* The clearance of a sample in a cell that is not thin, of the perimeter, and what follows. */
#define CELLS_THIN 0x1p-32
#define CELLS_FAR  0x1p34
/* Cuts on the way to a cell, at most; cells that wait; corners above which a cell is halved. */
#define MOST_CUTS     200u
#define CELLS_WAITING (MOST_CUTS + 2)
#define MANY_CORNERS  20u
/* Samples that may be tried in a cell. */
#define TRIES 3
/* Edges of a component at the border of a cell. */
#define MOST_BORDERS 128u
/* Steps that a block may take, and for each facet and segment in it. */
#define STEPS_LEAST 65536u
#define STEPS_EACH  256u
/* Room for lists, a facet and beside that; for segments of a grid cell likewise. */
#define LIST_A_FACET  8u
#define LIST_LEAST    65536u
#define SEGMENT_LEAST 1024u
/* How often facets and events may be listed in blocks, a facet and beside that. */
#define ENTRIES_A_FACET 16u
#define ENTRIES_LEAST   65536u
/* An area may be off by so much of itself, and of the square of the scene's extent. */
#define ACCURACY_OF_FACET 1e-12
#define ACCURACY_OF_SCENE 1e-15
/* A facet with less of its diameter's square is a needle. */
#define NEEDLE 0x1p-18
/* A cell that is no wider than so many strips may be charged whole. */
#define SLIVER 8

/* A facet that casts, in view coordinates. */
typedef struct cells_facet {
    double x[3], y[3];      /* corners, counter-clockwise */
    double side[3][3];      /* distance from the line of side k: a x + b y + c, positive inside */
    double length[3];       /* of the sides, upper bounds */
    double z[3];            /* the plane: a x + b y + c */
    double z_off[2];        /* that of a place on the facet is off by [0] + [1] w */
    double z_low, z_high;   /* that of all of it */
    double low[2], high[2]; /* its box */
    double off;             /* of its vertices */
    double z_err;           /* of their z */
    int thin;               /* its sides are those of a band */
} cells_facet;

/* An event edge or a contact. */
typedef struct cells_segment {
    double end[2][3];
    double line[3]; /* distance from its line: a x + b y + c */
    double length;
    double off;        /* of its ends */
    double z_err;      /* of their z */
    uint32_t owner[2]; /* facets whose edge or contact it is, the second perhaps LRCS_NONE */
    uint32_t edge;     /* of more facets; else LRCS_NONE */
    int contact;
} cells_segment;

/* A part of the view plane that is yet to be done. list[first ..] holds its facets, then its
   segments. */
typedef struct cells_cell {
    lrcsi_clip_polygon shape;
    size_t first;
    uint32_t facets, segments;
    uint32_t cuts, struck;
    double drift;  /* how far a place that belongs to it may be from it */
    double doubt;  /* area that may be wrong for any facet, yet to be charged */
    double inset;  /* the widest w of what was struck */
    double cut[3]; /* the line along which it was last cut, */
    double sign;   /* and on which side of it it lies */
} cells_cell;

/* Lines that a cell lies on the inner side of, one along each side of it. */
typedef struct cells_sides {
    double line[LRCSI_CLIP_SIDES][3];
    double moved[LRCSI_CLIP_SIDES]; /* how far out */
    double length[LRCSI_CLIP_SIDES];
    uint32_t count;
    double low[2], high[2];
    double perimeter;
    double g; /* (16 + 4 n) u b */
} cells_sides;

/* What is found of a facet that is asked about. */
typedef struct cells_found {
    double seen;  /* area in cells where it is seen */
    double off;   /* by which that may be wrong */
    double doubt; /* area of strips, */
    double cut;   /* and their length */
} cells_found;

/* What of a segment is in a cell, or within w of it: between two shares of its length; at the
   border, how deep. */
typedef struct cells_part {
    double from, to, deep;
} cells_part;

/* A segment at the border of a cell. */
typedef struct cells_border {
    double line[3], start[2]; /* of it, and where it starts */
    double length, w;
    cells_part part;
} cells_border;

enum { FOUND_SEEN = 1, FOUND_HIDDEN = 2, FOUND_OPEN = 4, FOUND_SPARED = 8 };

/* A vertex in the view, once it is made. */
typedef struct cells_point {
    double x[3];
    int made;
} cells_point;

/* Items of each block: item[first[b] .. first[b + 1]) of block b. */
typedef struct cells_blocks {
    uint32_t *first, *item;
} cells_blocks;

typedef struct cells_work {
    const lrcsi_contest *contest;
    const lrcsi_view *view;
    uint32_t side;          /* blocks along each, with the ring */
    double low[2], high[2]; /* of those within */
    double size;            /* of one */
    cells_blocks facets, events;
    unsigned char *open;
    unsigned char *found; /* facet: FOUND_... */
    unsigned char *kind;  /* facet: KIND_... */
    cells_facet *facet;
    cells_found *area;
    uint32_t *listed; /* facet: the look that found it in the list */
    uint32_t *met; /* facet: 2 look + 1 where it surely covers the sample, 2 look where perhaps */
    uint32_t *joined; /* facet: the look whose component it is in */
    uint32_t *component, *hit;
    uint32_t components, look;
    cells_border *border; /* of the component, at the border of the cell */
    uint32_t borders;
    uint32_t *list;
    size_t room;
    cells_segment *segment;
    uint32_t segments, segment_room;
    cells_cell *stack;
    uint32_t top;
    double axis_low[2][3];
    cells_point *point; /* vertex */
    double middle[2];   /* of the block at hand */
    double reach;       /* the largest coordinate in it, from there */
    double off;         /* the largest of what is listed there */
} cells_work;

enum { KIND_APART = 1, KIND_VAGUE = 2 };

/* --- facets ----------------------------------------------------------------------------------- */

/* The axes of the view, exactly perpendicular to the direction but for 32 u^2: R's rows are so but
   for 4 u, which is taken off in their lower parts. They may be oblique by as much. */
static void axes_make(cells_work *c)
{
    const double *d = c->view->direction;
    for (int i = 0; i < 2; i++) {
        const double *row = c->view->R[i];
        lrcsi_dd dot = {0, 0};
        for (int k = 0; k < 3; k++) {
            dot = lrcsi_dd_add(dot, lrcsi_dd_two_product(row[k], d[k]));
        }
        double along = lrcsi_dd_value(dot) / (c->view->length * c->view->length);
        for (int k = 0; k < 3; k++) {
            c->axis_low[i][k] = -along * d[k];
        }
    }
}

/* A vertex in the view: each coordinate rounded once, of a sum that is off by 100 u^2 of the
   distance from the origin; z as the view has it, off by 20 u of that. */
static const double *point_of(cells_work *c, uint32_t vertex)
{
    cells_point *p = &c->point[vertex];
    if (!p->made) {
        const lrcs_prepared *prepared = c->view->prepared;
        lrcsi_dd gap[3];
        for (int k = 0; k < 3; k++) {
            gap[k] = lrcsi_dd_two_sum(prepared->vertex[vertex].x[k], -prepared->origin[k]);
        }
        for (int i = 0; i < 2; i++) {
            const double *row = c->view->R[i];
            lrcsi_dd sum = {0, 0};
            double rest = 0;
            for (int k = 0; k < 3; k++) {
                lrcsi_dd term = lrcsi_dd_two_product(row[k], gap[k].hi);
                rest += term.lo + (row[k] * gap[k].lo + c->axis_low[i][k] * gap[k].hi);
                lrcsi_dd next = lrcsi_dd_two_sum(sum.hi, term.hi);
                sum = (lrcsi_dd){next.hi, sum.lo + next.lo};
            }
            p->x[i] = sum.hi + (sum.lo + rest);
        }
        p->x[2] = c->view->point[vertex].x[2];
        p->made = 1;
    }
    return p->x;
}

/* The same from the middle of the block at hand; *off grows to how far that may be off, and lines
   through it (0.5 u of the sum of its coordinates from the centre of the view, and of those from
   the middle 0.5 u, and 5 u for a line); *z_err to the error of z. */
static void point_local(cells_work *c, uint32_t vertex, double out[3], double *off, double *z_err)
{
    const double *x = point_of(c, vertex);
    out[0] = x[0] - c->middle[0];
    out[1] = x[1] - c->middle[1];
    out[2] = x[2];
    double flat = fabs(x[0]) + fabs(x[1]);
    double far = flat + fabs(x[2]);
    double near = fabs(out[0]) + fabs(out[1]);
    *off = lrcsi_most(*off, U * (0.6 * flat + 6 * near) + 128 * U * U * far);
    *z_err = lrcsi_most(*z_err, 20 * U * far);
}

static void line_through(const double *p, const double *q, double line[3])
{
    double a = p[1] - q[1];
    double b = q[0] - p[0];
    double length = sqrt(a * a + b * b);
    line[0] = length > 0 ? a / length : 1;
    line[1] = length > 0 ? b / length : 0;
    line[2] = -(line[0] * p[0] + line[1] * p[1]);
}

static double line_at(const double line[3], double x, double y)
{
    return line[0] * x + line[1] * y + line[2];
}

static int longest_side(const cells_facet *f)
{
    int k = f->length[1] > f->length[0] ? 1 : 0;
    return f->length[2] > f->length[k] ? 2 : k;
}

/* Its least height, as computed: negative where rounding has turned it over. */
static double facet_least(const cells_facet *f)
{
    int k = (longest_side(f) + 2) % 3;
    return line_at(f->side[longest_side(f)], f->x[k], f->y[k]);
}

/* A facet so narrow that it may have been turned over: its sides are replaced by those of the band
   about its longest side that has all of it. It covers nothing surely, and is not decided. */
static void facet_flatten(cells_facet *f)
{
    double wide = fabs(facet_least(f)) + 4 * f->off;
    double line[3];
    memcpy(line, f->side[longest_side(f)], sizeof line);
    for (int k = 0; k < 3; k++) {
        int sign = k == 1 ? -1 : 1;
        f->side[k][0] = sign * line[0];
        f->side[k][1] = sign * line[1];
        f->side[k][2] = sign * line[2] + wide;
    }
}

/* The plane and its error, as told above; HUGE_VAL where it is so narrow that only corners tell. */
static void facet_slope(cells_facet *f, const double z[3])
{
    const double dx[2] = {f->x[1] - f->x[0], f->x[2] - f->x[0]};
    const double dy[2] = {f->y[1] - f->y[0], f->y[2] - f->y[0]};
    double twice = dx[0] * dy[1] - dx[1] * dy[0];
    double longest = lrcsi_most(f->length[0], lrcsi_most(f->length[1], f->length[2]));
    double height = twice / longest; /* the least */
    double rise = lrcsi_most(z[0], lrcsi_most(z[1], z[2])) -
                  lrcsi_least(z[0], lrcsi_least(z[1], z[2])) + 4 * f->z_err;
    f->z_low = lrcsi_least(z[0], lrcsi_least(z[1], z[2])) - f->z_err;
    f->z_high = lrcsi_most(z[0], lrcsi_most(z[1], z[2])) + f->z_err;
    f->z[0] = f->z[1] = f->z[2] = 0;
    f->z_off[0] = f->z_off[1] = HUGE_VAL;
    if (height > 64 * f->off && height > 0x1p-40 * longest) {
        const double dz[2] = {z[1] - z[0], z[2] - z[0]};
        f->z[0] = (dz[0] * dy[1] - dz[1] * dy[0]) / twice;
        f->z[1] = (dz[1] * dx[0] - dz[0] * dx[1]) / twice;
        f->z[2] = z[0] - f->z[0] * f->x[0] - f->z[1] * f->y[0];
        double slope = lrcsi_least(4 * rise / height,
                                   2 * (fabs(f->z[0]) + fabs(f->z[1])) + 8 * f->z_err / height);
        f->z_off[1] = slope;
        f->z_off[0] = 3 * f->z_err + slope * (2 * f->off + 8 * U * longest * longest / height) +
                      8 * U * (fabs(z[0]) + fabs(f->z[0] * f->x[0]) + fabs(f->z[1] * f->y[0]));
    }
}

/* Makes the record of a facet for the block at hand. */
static const cells_facet *facet_make(cells_work *c, uint32_t facet)
{
    cells_facet *f = &c->facet[facet];
    const lrcsi_view *view = c->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double p[3][3];
    double z[3];
    f->off = f->z_err = 0;
    for (int k = 0; k < 3; k++) {
        point_local(c, corner[view->facing[facet] > 0 ? k : (3 - k) % 3], p[k], &f->off, &f->z_err);
        f->x[k] = p[k][0];
        f->y[k] = p[k][1];
        z[k] = p[k][2];
    }
    for (int k = 0; k < 3; k++) {
        const double *q = p[(k + 1) % 3];
        line_through(p[k], q, f->side[k]);
        f->length[k] = fabs(q[0] - p[k][0]) + fabs(q[1] - p[k][1]) + 4 * f->off;
    }
    for (int i = 0; i < 2; i++) {
        f->low[i] = lrcsi_least(p[0][i], lrcsi_least(p[1][i], p[2][i]));
        f->high[i] = lrcsi_most(p[0][i], lrcsi_most(p[1][i], p[2][i]));
    }
    facet_slope(f, z);
    f->thin = !(facet_least(f) > 16 * f->off);
    if (f->thin) {
        facet_flatten(f);
        c->found[facet] |= FOUND_OPEN;
    }
    return f;
}

/* Whether a facet goes on nowhere: it meets others in its plane. */
static int facet_apart(const lrcsi_view *view, uint32_t facet)
{
    const lrcsi_touches *touches = &view->prepared->touches;
    for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
        if (touches->touch[i].kind == LRCSI_TOUCH_COPLANAR &&
            lrcsi_grid_casts(view, touches->touch[i].other)) {
            return 1;
        }
    }
    return 0;
}

static uint32_t odd_neighbour(const lrcsi_view *view, uint32_t facet, uint32_t edge)
{
    const lrcsi_topology *t = &view->prepared->topology;
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    uint32_t other = LRCS_NONE;
    uint32_t count = 0;
    uint32_t forward = 0;
    for (uint32_t i = 0; i < t->edge[edge].uses; i++) {
        if (lrcsi_grid_casts(view, use[i].facet)) {
            other = use[i].facet != facet ? use[i].facet : other;
            count++;
            forward += use[i].forward;
        }
    }
    return count == 2 && forward == 1 ? other : LRCS_NONE;
}

/* Who continues a facet across a side of its own numbering, events of the view being the only edges
   where nobody does (visibility/event.h); LRCS_NONE where nobody does. */
static uint32_t facet_joined(const lrcsi_view *view, uint32_t facet, int k)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t other = p->across.facet[facet].corner[k];
    if (other == facet) {
        other = odd_neighbour(view, facet, p->topology.facet_edge[facet].corner[k]);
    }
    return other < p->scene->facet_count && lrcsi_grid_casts(view, other) &&
                   view->facing[other] == view->facing[facet]
               ? other
               : LRCS_NONE;
}

/* Who continues it for all that is done here. */
static uint32_t facet_next(const cells_work *c, uint32_t facet, int k)
{
    uint32_t other = facet_joined(c->view, facet, k);
    return other != LRCS_NONE && ((c->kind[facet] | c->kind[other]) & KIND_APART) == 0 &&
                   !lrcsi_touches_along(&c->view->prepared->touches, facet, k)
               ? other
               : LRCS_NONE;
}

/* The facet's own number of the side that runs from corner k of its record. */
static int side_number(const lrcsi_view *view, uint32_t facet, int k)
{
    return view->facing[facet] > 0 ? k : 2 - k;
}

/* --- cells ------------------------------------------------------------------------------------ */

/* Lines along the sides, each moved out so far that all corners are on its inner side. */
static void cells_sides_of(const cells_work *c, const cells_cell *cell, cells_sides *s)
{
    const lrcsi_clip_polygon *p = &cell->shape;
    s->count = p->count;
    s->g = 16 * U * c->reach + cell->drift;
    lrcsi_clip_box(p, s->low, s->high);
    s->perimeter = 2 * ((s->high[0] - s->low[0]) + (s->high[1] - s->low[1]));
    for (uint32_t i = 0; i < p->count; i++) {
        double *line = s->line[i];
        const double *from = p->corner[i];
        const double *to = p->corner[i + 1 < p->count ? i + 1 : 0];
        line_through(from, to, line);
        s->length[i] = fabs(to[0] - from[0]) + fabs(to[1] - from[1]);
        double least = 0;
        for (uint32_t k = 0; k < p->count; k++) {
            least = lrcsi_least(least, line_at(line, p->corner[k][0], p->corner[k][1]));
        }
        s->moved[i] = -least;
        line[2] -= least;
    }
}

/* How a line passes the corners of a cell: the least and the most distance. */
static void line_range(const lrcsi_clip_polygon *shape, const double line[3], double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < shape->count; i++) {
        double d = line_at(line, shape->corner[i][0], shape->corner[i][1]);
        range[0] = lrcsi_least(range[0], d);
        range[1] = lrcsi_most(range[1], d);
    }
}

/* The same of a box around it: the range is as wide or wider. */
static void box_range(const double low[2], const double high[2], const double line[3],
                      double range[2])
{
    double middle = line_at(line, 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]));
    double half = 0.5 * (fabs(line[0]) * (high[0] - low[0]) + fabs(line[1]) * (high[1] - low[1]));
    range[0] = middle - half;
    range[1] = middle + half;
}

enum cells_place { PLACE_APART, PLACE_BORDER, PLACE_MEETS };

/* How a segment stands to a cell: a cells_place. */
static int segment_place(const cells_cell *cell, const cells_sides *s, const double p[2],
                         const double q[2], const double line[3], double w, cells_part *part)
{
    int place = PLACE_MEETS;
    if (lrcsi_most(p[0], q[0]) < s->low[0] - w || lrcsi_least(p[0], q[0]) > s->high[0] + w ||
        lrcsi_most(p[1], q[1]) < s->low[1] - w || lrcsi_least(p[1], q[1]) > s->high[1] + w) {
        return PLACE_APART;
    }
    double range[2];
    line_range(&cell->shape, line, range);
    double deep = lrcsi_least(range[1], -range[0]);
    if (deep < -w) {
        return PLACE_APART;
    }
    part->deep = w;
    part->from = 0;
    part->to = 1;
    for (uint32_t i = 0; i < s->count; i++) {
        double a = line_at(s->line[i], p[0], p[1]);
        double b = line_at(s->line[i], q[0], q[1]);
        if (a < w && b < w) {
            place = PLACE_BORDER;
            part->deep = lrcsi_least(part->deep, lrcsi_most(a, b));
            if (a < -w && b < -w) {
                return PLACE_APART;
            }
        }
        if (a < -w) {
            part->from = lrcsi_most(part->from, (-w - a) / (b - a));
        } else if (b < -w) {
            part->to = lrcsi_least(part->to, (-w - a) / (b - a));
        }
    }
    if (part->from > part->to) {
        return PLACE_APART;
    }
    if (deep <= w) {
        place = PLACE_BORDER;
        part->deep = lrcsi_least(part->deep, deep);
    }
    return place;
}

/* A lower bound of how far inside the cell a point lies (as lrcsi_clip_clear). */
static double sides_clear(const cells_sides *s, const double at[2])
{
    double counts = 0x1p-44 * s->perimeter + 64 * s->g;
    double clear = HUGE_VAL;
    double brief = 0;
    for (uint32_t i = 0; i < s->count; i++) {
        if (s->length[i] > counts) {
            clear = lrcsi_least(clear, line_at(s->line[i], at[0], at[1]) - s->moved[i]);
        } else {
            brief += s->length[i];
        }
    }
    return 0.98 * clear - brief - s->g;
}

/* Charges what it puts in doubt to the facets that come near: no more than the strip has along the
   length of the facet. What is next to nothing goes to all of them, later. */
static void cells_charge(cells_work *c, cells_cell *cell, const cells_sides *s,
                         const cells_border *e)
{
    double strip = e->w + lrcsi_most(0, e->part.deep);
    double doubt = strip * ((e->part.to - e->part.from) * e->length + CELLS_FAR * e->w);
    if (doubt < 0x1p-58 * c->reach * c->reach) {
        cell->doubt += doubt;
        return;
    }
    double box[2][2];
    for (int k = 0; k < 2; k++) {
        double to = e->start[k] + (k == 0 ? e->line[1] : -e->line[0]) * e->length;
        box[0][k] = lrcsi_most(s->low[k], lrcsi_least(e->start[k], to));
        box[1][k] = lrcsi_least(s->high[k], lrcsi_most(e->start[k], to));
    }
    double cut = 0.7 * e->length; /* length is the sum of both components, below 1.42 of it */
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t facet = c->list[cell->first + i];
        const cells_facet *f = &c->facet[facet];
        if (!c->open[facet]) {
            continue;
        }
        double far = 4 * strip + f->off + s->g;
        double reject = far + CELLS_FAR * e->w;
        if (f->low[0] > box[1][0] + reject || f->high[0] < box[0][0] - reject ||
            f->low[1] > box[1][1] + reject || f->high[1] < box[0][1] - reject) {
            continue;
        }
        double across[2] = {HUGE_VAL, -HUGE_VAL};
        double along[2] = {HUGE_VAL, -HUGE_VAL};
        for (int k = 0; k < 3; k++) {
            double d = line_at(e->line, f->x[k], f->y[k]);
            double t = e->line[1] * (f->x[k] - e->start[0]) - e->line[0] * (f->y[k] - e->start[1]);
            across[0] = lrcsi_least(across[0], d);
            across[1] = lrcsi_most(across[1], d);
            along[0] = lrcsi_least(along[0], t);
            along[1] = lrcsi_most(along[1], t);
        }
        double beyond = CELLS_FAR * e->w + far;
        if (across[1] > -far && across[0] < far && along[1] > e->part.from * cut - beyond &&
            along[0] < e->part.to * e->length + beyond) {
            double length = along[1] - along[0] + 2 * far;
            c->area[facet].doubt += lrcsi_least(doubt, strip * length);
            c->area[facet].cut += lrcsi_least(doubt / strip, length);
        }
    }
}

static uint32_t *cells_segments(const cells_work *c, const cells_cell *cell)
{
    return c->list + cell->first + cell->facets;
}

static void facet_charge(cells_work *c, uint32_t facet, double doubt)
{
    c->area[facet].doubt += c->open[facet] ? doubt : 0;
}

/* Charges all of a cell that has no room for a sample, where it is a sliver. */
static int cells_spare(cells_work *c, const cells_cell *cell, const cells_sides *s)
{
    double wide = SLIVER * (cell->inset + c->off + s->g);
    double area = lrcsi_clip_area(&cell->shape) + 2 * s->g * s->perimeter;
    if (!(area < wide * s->perimeter)) {
        return 0;
    }
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t facet = c->list[cell->first + i];
        c->found[facet] |= FOUND_SPARED;
        if (c->open[facet]) {
            c->area[facet].doubt += cell->doubt + area;
            c->area[facet].cut += 0.5 * s->perimeter;
        }
    }
    return 1;
}

/* Nothing can be told of the cell. */
static void cells_leave(cells_work *c, const cells_cell *cell)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        c->found[c->list[cell->first + i]] |= FOUND_OPEN;
    }
}

/* Is a facet in the list whose area is wanted? */
static int cells_wanted(const cells_work *c, const cells_cell *cell)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = c->list[cell->first + i];
        if (c->open[f] && (c->found[f] & FOUND_OPEN) == 0) {
            return 1;
        }
    }
    return 0;
}

/* --- samples ---------------------------------------------------------------------------------- */

/* What is known of z of a facet at a place that it may cover. */
static void facet_height(const cells_facet *f, const double at[2], double g, double range[2])
{
    range[0] = f->z_low;
    range[1] = f->z_high;
    double off = f->z_off[0] + f->z_off[1] * g;
    if (off < HUGE_VAL) {
        double z = f->z[0] * at[0] + f->z[1] * at[1] + f->z[2];
        range[0] = lrcsi_most(range[0], z - off);
        range[1] = lrcsi_least(range[1], z + off);
    }
}

/* Which of two facets that surely cover a place is nearer there, exactly: 1 the second, -1 the
   first, 0 it cannot be told. */
static int facets_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    const lrcsi_touches *touches = &view->prepared->touches;
    int side = lrcsi_contact_side(view, first, second);
    int touch = 0;
    for (int way = 0; way < 2 && side == 0; way++) {
        uint32_t facet = way == 0 ? first : second;
        uint32_t other = way == 0 ? second : first;
        for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
            if (touches->touch[i].other == other) {
                touch = 1;
                if (touches->touch[i].kind == LRCSI_TOUCH_COPLANAR) {
                    return lrcsi_sample_beats(view, second, first) ? 1 : -1;
                }
            }
        }
    }
    if (side == 0 && !touch) {
        side = lrcsi_contact_order(view, first, second);
        side = side == 0 ? lrcsi_contact_within(view, first, second) : side;
    }
    return side;
}

enum { SAMPLE_UNSURE, SAMPLE_NONE, SAMPLE_FOUND };

/* The facet nearest to the laser at a place; all others that may cover it are then surely behind.
 */
static int cells_sample(cells_work *c, const cells_cell *cell, const cells_sides *s,
                        const double at[2], uint32_t *best)
{
    uint32_t hits = 0;
    double most = -HUGE_VAL;
    *best = LRCS_NONE;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t index = c->list[cell->first + i];
        const cells_facet *f = &c->facet[index];
        double w = f->off + s->g;
        c->listed[index] = c->look;
        if (at[0] < f->low[0] - w || at[0] > f->high[0] + w || at[1] < f->low[1] - w ||
            at[1] > f->high[1] + w) {
            continue;
        }
        double inside = line_at(f->side[0], at[0], at[1]);
        inside = lrcsi_least(inside, line_at(f->side[1], at[0], at[1]));
        inside = lrcsi_least(inside, line_at(f->side[2], at[0], at[1]));
        if (inside < -w) {
            continue;
        }
        c->hit[hits++] = index;
        int covers = inside > w && !f->thin;
        c->met[index] = 2 * c->look + (uint32_t)covers;
        double range[2];
        facet_height(f, at, s->g, range);
        if (covers && (*best == LRCS_NONE || range[0] > most)) {
            *best = index;
            most = range[0];
        }
    }
    if (*best == LRCS_NONE) {
        return hits == 0 ? SAMPLE_NONE : SAMPLE_UNSURE;
    }
    uint32_t changes = 0;
    for (uint32_t i = 0; i < hits; i++) {
        uint32_t other = c->hit[i];
        double range[2];
        facet_height(&c->facet[other], at, s->g, range);
        if (other == *best || range[1] < most) {
            continue;
        }
        int order = c->met[other] % 2 == 1 && changes < 8 ? facets_order(c->view, *best, other) : 0;
        if (order == 0) {
            return SAMPLE_UNSURE;
        }
        if (order > 0) { /* those before it are asked again */
            *best = other;
            most = lrcsi_least(most, range[0]);
            changes++;
            i = (uint32_t)-1;
        }
    }
    return SAMPLE_FOUND;
}

/* --- components ------------------------------------------------------------------------------- */

/* Follows the surface around a facet through the cell. 1 where it covers the cell once, unless
   events or contacts in the list cross it; its edges at the border of the cell are noted. */
static int cells_component(cells_work *c, const cells_cell *cell, const cells_sides *s,
                           uint32_t best)
{
    int whole = 1;
    c->borders = 0;
    c->component[0] = best;
    c->components = 1;
    c->joined[best] = c->look;
    for (uint32_t i = 0; i < c->components; i++) {
        uint32_t facet = c->component[i];
        const cells_facet *f = &c->facet[facet];
        double w = f->off + s->g;
        whole &= (c->kind[facet] & KIND_VAGUE) == 0 &&
                 (facet == best || (c->met[facet] >> 1) != c->look);
        for (int k = 0; k < 3; k++) {
            double range[2];
            cells_part part;
            uint32_t next = facet_next(c, facet, side_number(c->view, facet, k));
            if (next != LRCS_NONE && c->joined[next] == c->look) {
                continue;
            }
            int n = k == 2 ? 0 : k + 1;
            const double p[2] = {f->x[k], f->y[k]};
            const double q[2] = {f->x[n], f->y[n]};
            double line[3];
            memcpy(line, f->side[k], sizeof line);
            if (f->thin) {
                line_through(p, q, line);
            }
            box_range(s->low, s->high, line, range);
            if (range[0] > w || range[1] < -w) {
                continue;
            }
            int place = segment_place(cell, s, p, q, line, w, &part);
            if (place == PLACE_APART) {
                continue;
            }
            if (place == PLACE_BORDER && next != LRCS_NONE) {
                whole &= c->borders < MOST_BORDERS;
                if (whole) {
                    c->border[c->borders++] = (cells_border){
                        {line[0], line[1], line[2]}, {p[0], p[1]}, f->length[k], w, part};
                }
            } else if (place == PLACE_BORDER) {
                continue;
            } else if (next == LRCS_NONE || c->listed[next] != c->look) {
                whole = 0;
            } else {
                c->joined[next] = c->look;
                c->component[c->components++] = next;
            }
        }
    }
    return whole;
}

/* Is any facet of an edge, or of a contact, marked by the look at hand? Given: c->joined or
   c->listed. */
static int segment_marked(const cells_work *c, const cells_segment *e, const uint32_t *mark)
{
    if (mark[e->owner[0]] == c->look ||
        (e->owner[1] != LRCS_NONE && mark[e->owner[1]] == c->look)) {
        return 1;
    }
    if (e->edge != LRCS_NONE) {
        const lrcsi_topology *t = &c->view->prepared->topology;
        const lrcsi_edge_use *use = t->use + t->edge[e->edge].first_use;
        for (uint32_t i = 0; i < t->edge[e->edge].uses; i++) {
            if (mark[use[i].facet] == c->look) {
                return 1;
            }
        }
    }
    return 0;
}

static int segment_owned(const cells_work *c, const cells_segment *e)
{
    return segment_marked(c, e, c->joined);
}

/* Whether all facets of an edge have been dropped as hidden, or one of a contact. */
static int segment_idle(const cells_work *c, const cells_segment *e)
{
    if (e->contact) {
        return c->listed[e->owner[0]] != c->look || e->owner[1] == LRCS_NONE ||
               c->listed[e->owner[1]] != c->look;
    }
    return !segment_marked(c, e, c->listed);
}

/* What a plane's z is at least, or at most, at places of the facet in the box of the cell. */
static double box_height(const cells_facet *f, const cells_sides *s, int sign)
{
    double corner = sign > 0 ? f->z_high : f->z_low;
    double off = f->z_off[0] + f->z_off[1] * s->g;
    if (!(off < HUGE_VAL)) {
        return corner;
    }
    double x = 0.5 * (s->low[0] + s->high[0]);
    double y = 0.5 * (s->low[1] + s->high[1]);
    double half = fabs(f->z[0]) * (s->high[0] - x) + fabs(f->z[1]) * (s->high[1] - y);
    double z = f->z[0] * x + f->z[1] * y + f->z[2];
    return sign > 0 ? lrcsi_least(corner, z + half + off) : lrcsi_most(corner, z - half - off);
}

/* Is the part of an edge in the cell behind the component, which covers the cell? Where one facet
   is all of it, its plane tells; else a point of the edge over one of its facets. */
static int segment_behind(const cells_work *c, const cells_cell *cell, const cells_sides *s,
                          const cells_segment *e, double w, double low)
{
    double z_off = 2 * e->z_err;
    if (lrcsi_most(e->end[0][2], e->end[1][2]) + z_off < low) {
        return 1;
    }
    cells_part part = {0, 1, 0};
    segment_place(cell, s, e->end[0], e->end[1], e->line, w, &part);
    double at[2][3];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            at[i][k] =
                e->end[0][k] + (i == 0 ? part.from : part.to) * (e->end[1][k] - e->end[0][k]);
        }
    }
    if (lrcsi_most(at[0][2], at[1][2]) + z_off < low) {
        return 1;
    }
    if (c->components == 1) {
        const cells_facet *f = &c->facet[c->component[0]];
        double off = f->z_off[0] + f->z_off[1] * w + z_off;
        return at[0][2] + off < f->z[0] * at[0][0] + f->z[1] * at[0][1] + f->z[2] &&
               at[1][2] + off < f->z[0] * at[1][0] + f->z[1] * at[1][1] + f->z[2];
    }
    double middle[3];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (at[0][k] + at[1][k]);
    }
    for (uint32_t i = 0; i < s->count; i++) {
        if (!(line_at(s->line[i], middle[0], middle[1]) > w)) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < c->components; i++) {
        const cells_facet *f = &c->facet[c->component[i]];
        double clear = f->thin ? HUGE_VAL : 2 * f->off + w;
        if (line_at(f->side[0], middle[0], middle[1]) > clear &&
            line_at(f->side[1], middle[0], middle[1]) > clear &&
            line_at(f->side[2], middle[0], middle[1]) > clear) {
            double range[2];
            facet_height(f, middle, w, range);
            return middle[2] + z_off < range[0];
        }
    }
    return 0;
}

/* --- what is found ---------------------------------------------------------------------------- */

static void shape_clip(lrcsi_clip_polygon *shape, const double line[3])
{
    lrcsi_clip_polygon out = {.count = 0};
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *p = shape->corner[i];
        const double *q = shape->corner[i + 1 < shape->count ? i + 1 : 0];
        double a = line_at(line, p[0], p[1]);
        double b = line_at(line, q[0], q[1]);
        if (a >= 0) {
            memcpy(out.corner[out.count++], p, sizeof out.corner[0]);
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            double t = a / (a - b);
            out.corner[out.count][0] = p[0] + t * (q[0] - p[0]);
            out.corner[out.count++][1] = p[1] + t * (q[1] - p[1]);
        }
    }
    *shape = out;
}

/* A facet is seen wherever it is in the cell. */
static void facet_seen(cells_work *c, const cells_cell *cell, const cells_sides *s, uint32_t facet)
{
    const cells_facet *f = &c->facet[facet];
    cells_found *area = &c->area[facet];
    lrcsi_clip_polygon piece = cell->shape;
    double w = f->off + s->g;
    double diameter = 0.5 * s->perimeter;
    area->off += 4 * s->g * s->perimeter +
                 5 * U * (piece.count + 3) * (s->high[0] - s->low[0]) * (s->high[1] - s->low[1]);
    for (int k = 0; k < 3 && piece.count > 0; k++) {
        double range[2];
        box_range(s->low, s->high, f->side[k], range);
        if (range[0] < w) {
            line_range(&cell->shape, f->side[k], range);
        }
        if (range[0] < w) {
            area->off += w * (lrcsi_least(f->length[k], diameter) + 4 * w);
            shape_clip(&piece, f->side[k]);
        }
    }
    area->seen += piece.count >= 3 ? lrcsi_most(0, lrcsi_clip_area(&piece)) : 0;
}

/* All of the cell shows the component, or nothing where that has no facets. */
static void cells_decide(cells_work *c, const cells_cell *cell, const cells_sides *s, double doubt)
{
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = c->list[cell->first + i];
        if (!c->open[f]) {
            continue;
        }
        int seen = c->components > 0 && c->joined[f] == c->look;
        c->found[f] |= seen ? FOUND_SEEN : FOUND_HIDDEN;
        c->area[f].doubt += doubt;
        if (seen) {
            facet_seen(c, cell, s, f);
        }
    }
}

/* --- cutting ---------------------------------------------------------------------------------- */

/* May the facet come near a cell in a box? */
static int facet_near(const cells_facet *f, const lrcsi_clip_polygon *shape, const double low[2],
                      const double high[2], double g)
{
    double w = f->off + g;
    if (f->low[0] > high[0] + w || f->high[0] < low[0] - w || f->low[1] > high[1] + w ||
        f->high[1] < low[1] - w) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        double range[2];
        box_range(low, high, f->side[k], range);
        if (range[1] > -w && range[0] + range[1] < 0) {
            line_range(shape, f->side[k], range);
        }
        if (range[1] < -w) {
            return 0;
        }
    }
    return 1;
}

/* Whether a facet on both sides of a cut comes near the parts: one side of it may have all of a
   part beyond it, which then has the corners that both parts share. */
static void part_near(const cells_facet *f, const lrcsi_clip_polygon *left,
                      const lrcsi_clip_polygon *right, const double *const common[2], int commons,
                      double g, int *on_left, int *on_right)
{
    double w = f->off + g;
    for (int k = 0; k < 3; k++) {
        int beyond = 1;
        for (int i = 0; i < commons && beyond; i++) {
            beyond = line_at(f->side[k], common[i][0], common[i][1]) < -w;
        }
        if (beyond) {
            double range[2];
            line_range(left, f->side[k], range);
            *on_left &= !(range[1] < -w);
            line_range(right, f->side[k], range);
            *on_right &= !(range[1] < -w);
        }
    }
}

/* A shape divided along a line. */
typedef struct shape_cut {
    const double *common[2]; /* corners that both parts share, so many of them */
    int commons;
    double longest; /* of the sides that are cut, |x| + |y| */
} shape_cut;

static shape_cut shape_divide(const lrcsi_clip_polygon *shape, const double line[3],
                              lrcsi_clip_polygon *left, lrcsi_clip_polygon *right)
{
    shape_cut cut = {{NULL, NULL}, 0, 0};
    left->count = right->count = 0;
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *here = shape->corner[i];
        const double *next = shape->corner[i + 1 < shape->count ? i + 1 : 0];
        double a = line_at(line, here[0], here[1]);
        double b = line_at(line, next[0], next[1]);
        if (a >= 0) {
            memcpy(left->corner[left->count++], here, 2 * sizeof *here);
        }
        if (a <= 0) {
            memcpy(right->corner[right->count++], here, 2 * sizeof *here);
        }
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            double t = a / (a - b);
            double *corner = left->corner[left->count++];
            corner[0] = here[0] + t * (next[0] - here[0]);
            corner[1] = here[1] + t * (next[1] - here[1]);
            memcpy(right->corner[right->count++], corner, 2 * sizeof *corner);
            cut.longest =
                lrcsi_most(cut.longest, fabs(next[0] - here[0]) + fabs(next[1] - here[1]));
            if (cut.commons < 2) {
                cut.common[cut.commons++] = corner;
            }
        }
    }
    return cut;
}

/* The strip along a segment at which a cell is cut. Distances along it from its first end, its
   length being known as |x| + |y|: at most 1 / 0.7 of the true one. */
typedef struct cut_strip {
    const cells_segment *along; /* or NULL: then there is none */
    double width, from, to;
} cut_strip;

/* Charges a facet that is still open, on both sides of the cut, for its part of the strip. */
static void strip_charge(cells_work *c, uint32_t index, const double line[3],
                         const cut_strip *strip)
{
    const cells_facet *f = &c->facet[index];
    const cells_segment *along = strip->along;
    double near[2] = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        double t = line[1] * (f->x[k] - along->end[0][0]) - line[0] * (f->y[k] - along->end[0][1]);
        near[0] = lrcsi_least(near[0], t);
        near[1] = lrcsi_most(near[1], t);
    }
    double beyond = CELLS_FAR * strip->width + f->off;
    double length = lrcsi_least(near[1] + beyond, strip->to + beyond) -
                    lrcsi_most(near[0] - beyond, strip->from - beyond);
    c->area[index].doubt += 2 * strip->width * lrcsi_most(0, length);
    c->area[index].cut += lrcsi_most(0, length);
}

/* Lists the facets of a cell with the parts that they may come near. */
static void cut_facets(cells_work *c, const cells_cell *cell, const double line[3],
                       const shape_cut *cut, const cut_strip *strip, double g, cells_cell *left,
                       cells_cell *right)
{
    uint32_t *in = c->list + cell->first;
    uint32_t *to_right = c->list + right->first;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t index = in[i];
        const cells_facet *f = &c->facet[index];
        double w = f->off + g + strip->width;
        double a = line_at(line, f->x[0], f->y[0]);
        double b = line_at(line, f->x[1], f->y[1]);
        double d = line_at(line, f->x[2], f->y[2]);
        int on_left = lrcsi_most(a, lrcsi_most(b, d)) > -w;
        int on_right = lrcsi_least(a, lrcsi_least(b, d)) < w;
        if (on_left && on_right) {
            if (strip->along && c->open[index]) {
                strip_charge(c, index, line, strip);
            }
            part_near(f, &left->shape, &right->shape, cut->common, cut->commons, g, &on_left,
                      &on_right);
        }
        if (on_left) {
            in[left->facets++] = index;
        }
        if (on_right) {
            to_right[right->facets++] = index;
        }
    }
}

/* Lists its segments likewise, after the facets, but the one at which it is cut. */
static void cut_segments(cells_work *c, const cells_cell *cell, const double line[3],
                         uint32_t struck, double g, cells_cell *left, cells_cell *right)
{
    const uint32_t *in = cells_segments(c, cell);
    uint32_t *to_left = c->list + left->first + left->facets;
    uint32_t *to_right = c->list + right->first + right->facets;
    for (uint32_t i = 0; i < cell->segments; i++) {
        uint32_t index = in[i];
        const cells_segment *e = &c->segment[index];
        if (index == struck) {
            continue;
        }
        double w = e->off + g;
        double a = line_at(line, e->end[0][0], e->end[0][1]);
        double b = line_at(line, e->end[1][0], e->end[1][1]);
        if (a > -w || b > -w) {
            to_left[left->segments++] = index;
        }
        if (a < w || b < w) {
            to_right[right->segments++] = index;
        }
    }
}

/* Cuts a cell along a line: the part on the left stays where it is, that on the right goes behind
   it. 0 where there is no room. */
static int cells_cut(cells_work *c, const cells_cell *cell, const cells_sides *s,
                     const double line[3], const cells_segment *along)
{
    uint32_t struck = along ? (uint32_t)(along - c->segment) : LRCS_NONE;
    cut_strip strip = {along, 0, 0, 0};
    if (along) {
        cells_part part = {0, 1, 0};
        strip.width = along->off + s->g + 4 * U * c->reach + U * s->perimeter;
        segment_place(cell, s, along->end[0], along->end[1], along->line, strip.width, &part);
        strip.from = part.from * 0.7 * along->length;
        strip.to = part.to * along->length;
    }
    uint32_t total = cell->facets + cell->segments;
    size_t end = cell->first + total;
    if (cell->shape.count + 2 > LRCSI_CLIP_SIDES || c->top + 2 > CELLS_WAITING ||
        end + total > c->room) {
        return 0;
    }
    cells_cell left = *cell;
    cells_cell right = *cell;
    shape_cut cut = shape_divide(&cell->shape, line, &left.shape, &right.shape);
    if (left.shape.count < 3 || right.shape.count < 3) {
        return 0;
    }
    double drift = cell->drift + U * cut.longest + 0.75 * U * c->reach;
    double g = 16 * U * c->reach + drift;
    memcpy(left.cut, line, sizeof left.cut);
    memcpy(right.cut, line, sizeof right.cut);
    left.sign = 1;
    right.sign = -1;
    left.cuts = right.cuts = cell->cuts + 1;
    left.struck = right.struck = cell->struck + (along != NULL);
    left.inset = right.inset = lrcsi_most(cell->inset, 2 * strip.width);
    left.drift = right.drift = drift;
    left.facets = right.facets = left.segments = right.segments = 0;
    right.first = end;
    cut_facets(c, cell, line, &cut, &strip, g, &left, &right);
    cut_segments(c, cell, line, struck, g, &left, &right);
    c->stack[c->top++] = left;
    c->stack[c->top++] = right;
    return 1;
}

static int cells_halve(cells_work *c, const cells_cell *cell, const cells_sides *s)
{
    int wide = s->high[0] - s->low[0] > s->high[1] - s->low[1];
    const double line[3] = {
        wide, !wide, wide ? -0.5 * (s->low[0] + s->high[0]) : -0.5 * (s->low[1] + s->high[1])};
    return cells_cut(c, cell, s, line, NULL);
}

/* --- one cell --------------------------------------------------------------------------------- */

/* Does a segment that met the cell which this one was cut from meet it too? If not, its own line or
   that of the cut parts them. */
static int segment_stays(const cells_cell *cell, const cells_segment *e, double w)
{
    if (!(cell->sign * line_at(cell->cut, e->end[0][0], e->end[0][1]) > w) &&
        !(cell->sign * line_at(cell->cut, e->end[1][0], e->end[1][1]) > w)) {
        return 0;
    }
    double range[2];
    line_range(&cell->shape, e->line, range);
    return range[0] < -w && range[1] > w;
}

/* Strikes what is apart from the cell, or only at its border, which is charged. */
static void cells_strike(cells_work *c, cells_cell *cell, const cells_sides *s)
{
    uint32_t *list = cells_segments(c, cell);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const cells_segment *e = &c->segment[list[i]];
        double w = e->off + s->g;
        if (cell->cuts > 0 && segment_stays(cell, e, w)) {
            list[kept++] = list[i];
            continue;
        }
        cells_part part;
        int place = segment_place(cell, s, e->end[0], e->end[1], e->line, w, &part);
        if (place == PLACE_MEETS) {
            list[kept++] = list[i];
        } else if (place == PLACE_BORDER) {
            cell->struck++;
            cell->inset = lrcsi_most(cell->inset, w + lrcsi_most(0, part.deep));
            cells_charge(c, cell, s,
                         &(cells_border){{e->line[0], e->line[1], e->line[2]},
                                         {e->end[0][0], e->end[0][1]},
                                         e->length,
                                         w,
                                         part});
        }
    }
    cell->segments = kept;
}

/* Drops facets behind the component, which covers the cell, and the edges behind it. */
static void cells_drop(cells_work *c, cells_cell *cell, const cells_sides *s, double doubt)
{
    double low = HUGE_VAL;
    for (uint32_t i = 0; i < c->components; i++) {
        low = lrcsi_least(low, box_height(&c->facet[c->component[i]], s, -1));
    }
    uint32_t *list = c->list + cell->first;
    uint32_t *segments = cells_segments(c, cell);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t f = list[i];
        if (c->joined[f] != c->look &&
            (c->met[f] == 2 * c->look + 1 || box_height(&c->facet[f], s, 1) < low)) {
            c->listed[f] = 0;
            c->found[f] |= FOUND_HIDDEN;
            facet_charge(c, f, cell->doubt + doubt);
            continue;
        }
        list[kept++] = f;
    }
    cell->facets = kept;
    kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const cells_segment *e = &c->segment[segments[i]];
        if (!segment_idle(c, e) &&
            (e->contact || !segment_behind(c, cell, s, e, e->off + s->g, low))) {
            segments[kept++] = segments[i];
        }
    }
    cell->segments = kept;
    memmove(list + cell->facets, segments, kept * sizeof *list);
}

enum { CHOOSE_OWN, CHOOSE_EDGES, CHOOSE_ANY };

/* The longest of the segments of a kind, or NULL. */
static const cells_segment *cells_choose(const cells_work *c, const cells_cell *cell, int which)
{
    const uint32_t *list = cells_segments(c, cell);
    const cells_segment *best = NULL;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const cells_segment *e = &c->segment[list[i]];
        if ((which == CHOOSE_ANY || (which == CHOOSE_EDGES && !e->contact) ||
             (which == CHOOSE_OWN && segment_owned(c, e))) &&
            (!best || e->length > best->length)) {
            best = e;
        }
    }
    return best;
}

/* Asks a sample well inside of a cell; where it cannot be told, another. Returns its answer, the
   facet found, and how far inside the last one lies. */
static int cells_look(cells_work *c, const cells_cell *cell, const cells_sides *s, uint32_t *best,
                      double *clear)
{
    static const double weight[TRIES][3] = {{1, 1, 1}, {1.3, 0.9, 1.1}, {0.7, 1.2, 1.6}};
    int answer = SAMPLE_UNSURE;
    for (int t = 0; t < TRIES && answer == SAMPLE_UNSURE; t++) {
        double at[2] = {0, 0};
        double sum = 0;
        for (uint32_t i = 0; i < cell->shape.count; i++) {
            double share = weight[t][i % 3];
            at[0] += share * cell->shape.corner[i][0];
            at[1] += share * cell->shape.corner[i][1];
            sum += share;
        }
        at[0] /= sum;
        at[1] /= sum;
        *clear = sides_clear(s, at);
        c->look++;
        if (*clear > 4 * (cell->inset + c->off + s->g)) {
            answer = cells_sample(c, cell, s, at, best);
        }
    }
    return answer;
}

/* Does one cell: it is decided, cut, or left. */
static void cells_do(cells_work *c, cells_cell *cell)
{
    cells_sides s;
    if (!cells_wanted(c, cell)) {
        return;
    }
    cells_sides_of(c, cell, &s);
    cells_strike(c, cell, &s);
    c->components = 0;

    /* 1. A sample. */
    uint32_t best = LRCS_NONE;
    double clear = 0;
    int answer = cells_look(c, cell, &s, &best, &clear);
    if (answer == SAMPLE_UNSURE && cells_spare(c, cell, &s)) {
        return;
    }

    /* 2. The component, and what is behind it. */
    double doubt = 0;
    int covers = 0;
    const cells_segment *cut = NULL;
    if (answer == SAMPLE_FOUND) {
        covers = cells_component(c, cell, &s, best);
        cut = cells_choose(c, cell, CHOOSE_OWN);
        covers = covers && !cut;
        if (clear < CELLS_THIN * s.perimeter) {
            double strips = 2 * ((double)cell->struck + c->borders) * (cell->inset + c->off + s.g) *
                            s.perimeter;
            doubt = lrcsi_least(strips, lrcsi_clip_area(&cell->shape) + s.g * s.perimeter);
        }
        for (uint32_t i = 0; i < c->borders && covers; i++) {
            cells_charge(c, cell, &s, &c->border[i]);
        }
        if (covers) {
            cells_drop(c, cell, &s, doubt);
        }
    }

    /* 3. Decided, or cut. */
    if (!cut) {
        int told = covers || answer == SAMPLE_NONE;
        cut = cells_choose(c, cell, told ? CHOOSE_EDGES : CHOOSE_ANY);
        if (!cut && told) {
            cells_decide(c, cell, &s, cell->doubt + doubt);
            return;
        }
    }
    int done = 0;
    if (cut && cell->cuts < MOST_CUTS) {
        done = cell->shape.count > MANY_CORNERS ? cells_halve(c, cell, &s)
                                                : cells_cut(c, cell, &s, cut->line, cut);
    }
    if (!done) {
        cells_leave(c, cell);
    }
}

/* --- grid cells ------------------------------------------------------------------------------- */

static cells_segment *segment_new(cells_work *c)
{
    if (c->segments == c->segment_room) {
        return NULL;
    }
    cells_segment *e = &c->segment[c->segments++];
    *e = (cells_segment){.owner = {LRCS_NONE, LRCS_NONE}, .edge = LRCS_NONE};
    return e;
}

static void segment_line(cells_segment *e)
{
    line_through(e->end[0], e->end[1], e->line);
    e->length = fabs(e->end[1][0] - e->end[0][0]) + fabs(e->end[1][1] - e->end[0][1]);
}

static int open_edge(cells_work *c, uint32_t edge)
{
    const lrcsi_view *view = c->view;
    const lrcsi_topology *t = &view->prepared->topology;
    const lrcsi_edge *of = &t->edge[edge];
    cells_segment *e = segment_new(c);
    if (!e) {
        return 0;
    }
    uint32_t owners = 0;
    for (uint32_t i = 0; i < of->uses; i++) {
        uint32_t facet = t->use[of->first_use + i].facet;
        if (lrcsi_grid_casts(view, facet)) {
            if (owners < 2) {
                e->owner[owners] = facet;
            }
            owners++;
        }
    }
    e->edge = owners > 2 ? edge : LRCS_NONE;
    point_local(c, of->low, e->end[0], &e->off, &e->z_err);
    point_local(c, of->high, e->end[1], &e->off, &e->z_err);
    segment_line(e);
    return 1;
}

/* Edges across which two facets continue each other are events nevertheless where one of these
   meets others in its plane, or along parts of the edge. */
static int open_joins(cells_work *c, uint32_t facet)
{
    if ((c->kind[facet] & KIND_APART) == 0 && c->view->prepared->touches.rim[facet] <= 1) {
        return 1;
    }
    for (int k = 0; k < 3; k++) {
        uint32_t other = facet_joined(c->view, facet, k);
        if (other != LRCS_NONE && facet_next(c, facet, k) == LRCS_NONE &&
            !open_edge(c, c->view->prepared->topology.facet_edge[facet].corner[k])) {
            return 0;
        }
    }
    return 1;
}

static int touches_back(const lrcs_prepared *p, uint32_t facet, uint32_t other)
{
    for (uint32_t i = p->touches.first[other]; i < p->touches.first[other + 1]; i++) {
        if (p->touches.touch[i].other == facet) {
            return 1;
        }
    }
    return 0;
}

/* The segments in which others of the list meet the inside of a facet. */
static int open_contacts(cells_work *c, uint32_t facet)
{
    const lrcsi_view *view = c->view;
    const lrcsi_touches *touches = &view->prepared->touches;
    lrcsi_target target = {.view = NULL};
    for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
        uint32_t other = touches->touch[i].other;
        if (touches->touch[i].kind != LRCSI_TOUCH_CROSS || c->listed[other] != c->look ||
            (other < facet && touches_back(view->prepared, facet, other))) {
            continue;
        }
        if (!target.view) {
            lrcsi_target_make(view, facet, &target);
        }
        lrcsi_contact contact;
        int kind = lrcsi_contact_find(&target, other, &contact);
        if (kind == LRCSI_CONTACT_POINT) {
            continue;
        }
        if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
            c->kind[facet] |= KIND_VAGUE;
            c->kind[other] |= KIND_VAGUE;
            continue;
        }
        cells_segment *e = segment_new(c);
        if (!e) {
            return 0;
        }
        double origin[3];
        const lrcs_point *vertex = view->prepared->vertex;
        uint32_t corner = view->prepared->scene->facet[facet].corner[0];
        for (int k = 1; k < 3 && vertex[corner].x != target.origin; k++) {
            corner = view->prepared->scene->facet[facet].corner[k];
        }
        point_local(c, corner, origin, &e->off, &e->z_err);
        for (int n = 0; n < 2; n++) {
            e->end[n][0] = origin[0] + contact.end[n][0];
            e->end[n][1] = origin[1] + contact.end[n][1];
        }
        e->end[0][2] = e->end[1][2] = 0;
        e->off += 32 * U * contact.reach + contact.slip;
        e->owner[0] = facet;
        e->owner[1] = other;
        e->contact = 1;
        segment_line(e);
    }
    return 1;
}

static uint64_t block_entries(const lrcs_prepared *p)
{
    return ENTRIES_LEAST + (uint64_t)ENTRIES_A_FACET * p->scene->facet_count;
}

/* Blocks are squares of the window of the scene's bulk, twice as large as the cells of the
   contest's grid, in a ring of blocks that hold what stands outside. */
#define BLOCK 2u

static void blocks_place(cells_work *c)
{
    const lrcsi_grid *grid = &c->contest->grid;
    uint32_t size = (grid->size + BLOCK - 1) / BLOCK;
    c->side = size + 2;
    c->size = grid->scale > 0 ? BLOCK / (grid->scale * c->view->scale) : 1;
    for (int k = 0; k < 2; k++) {
        c->low[k] = grid->low[k] / c->view->scale;
        c->high[k] = c->low[k] + size * c->size;
    }
}

/* The first coordinate of block i of a row, i from 1 to the last but one, or the last. */
static double block_edge(const cells_work *c, uint32_t i, int k)
{
    return c->low[k] + (i - 1) * c->size;
}

/* The block of a coordinate, or one beside it, where it is nearly on the edge. */
static uint32_t block_of(const cells_work *c, double x, int k)
{
    double i = (x - c->low[k]) / c->size + 1;
    return (uint32_t)lrcsi_least(c->side - 1.0, lrcsi_most(0, i));
}

/* The blocks that a range of coordinates touches: *from <= i < *to. */
static void block_range(const cells_work *c, double low, double high, int k, uint32_t *from,
                        uint32_t *to)
{
    double near = 64 * U * (fabs(c->low[k]) + c->side * c->size);
    *from = block_of(c, low - near, k);
    *to = block_of(c, high + near, k) + 1;
}

/* Counts items in blocks, or files them, rows y0 <= y < y1. */
static void block_put(cells_blocks *b, size_t row, uint32_t x0, uint32_t x1, uint32_t item)
{
    for (size_t i = row + x0; i < row + x1; i++) {
        if (b->item) {
            b->item[b->first[i]++] = item;
        } else {
            b->first[i + 1]++;
        }
    }
}

static void blocks_put_facet(cells_work *c, cells_blocks *b, uint32_t facet)
{
    const uint32_t *corner = c->view->prepared->scene->facet[facet].corner;
    double low[3];
    double high[3];
    uint32_t x[2];
    uint32_t y[2];
    lrcsi_view_bounds(c->view, corner, 3, low, high);
    block_range(c, low[0], high[0], 0, &x[0], &x[1]);
    block_range(c, low[1], high[1], 1, &y[0], &y[1]);
    for (uint32_t row = y[0]; row < y[1]; row++) {
        block_put(b, (size_t)row * c->side, x[0], x[1], facet);
    }
}

/* An edge, row by row: where it is in one, but for twice its error. */
static void blocks_put_edge(cells_work *c, cells_blocks *b, uint32_t event)
{
    const lrcsi_edge *e = &c->view->prepared->topology.edge[c->contest->events.edge[event]];
    const double *p = c->view->point[e->low].x;
    const double *q = c->view->point[e->high].x;
    double off = 4 * lrcsi_most(lrcsi_view_off(p), lrcsi_view_off(q));
    uint32_t y[2];
    block_range(c, lrcsi_least(p[1], q[1]) - off, lrcsi_most(p[1], q[1]) + off, 1, &y[0], &y[1]);
    for (uint32_t row = y[0]; row < y[1]; row++) {
        double from = lrcsi_least(p[0], q[0]);
        double to = lrcsi_most(p[0], q[0]);
        double rise = q[1] - p[1];
        if (y[1] - y[0] > 1 && fabs(rise) > 64 * off) {
            double slope = (q[0] - p[0]) / rise;
            double near = off + 64 * U * (fabs(c->low[1]) + c->side * c->size);
            double low = row > 0 ? block_edge(c, row, 1) - near : -HUGE_VAL;
            double high = row + 1 < c->side ? block_edge(c, row + 1, 1) + near : HUGE_VAL;
            low = lrcsi_most(low, lrcsi_least(p[1], q[1]));
            high = lrcsi_least(high, lrcsi_most(p[1], q[1]));
            double a = p[0] + slope * (low - p[1]);
            double z = p[0] + slope * (high - p[1]);
            from = lrcsi_most(from, lrcsi_least(a, z) - fabs(slope) * off);
            to = lrcsi_least(to, lrcsi_most(a, z) + fabs(slope) * off);
        }
        uint32_t x[2];
        block_range(c, from - off, to + off, 0, &x[0], &x[1]);
        block_put(b, (size_t)row * c->side, x[0], x[1], event);
    }
}

/* Files casting facets, or events. 0 where they find no memory, or are listed too often. */
static int blocks_make(cells_work *c, cells_blocks *b, int events, lrcs_work *work)
{
    size_t count = (size_t)c->side * c->side;
    uint32_t items = events ? c->contest->events.count : c->view->prepared->scene->facet_count;
    b->first = lrcsi_work_take_zero(work, count + 1, sizeof *b->first);
    b->item = NULL;
    if (!b->first) {
        return 0;
    }
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < items; i++) {
            if (events) {
                blocks_put_edge(c, b, i);
            } else if (lrcsi_grid_casts(c->view, i)) {
                blocks_put_facet(c, b, i);
            }
        }
        if (pass == 0) {
            uint64_t total = 0;
            for (size_t k = 0; k < count; k++) {
                total += b->first[k + 1];
                b->first[k + 1] = (uint32_t)total;
                if (total > block_entries(c->view->prepared)) {
                    return 0;
                }
            }
            b->item = lrcsi_work_take(work, (size_t)total, sizeof *b->item);
            if (!b->item) {
                return 0;
            }
        }
    }
    for (size_t k = count; k > 0; k--) {
        b->first[k] = b->first[k - 1];
    }
    b->first[0] = 0;
    return 1;
}

/* The ring reaches out of the window of all that stands in the view. */
static void open_shape(cells_work *c, uint32_t x, uint32_t y, lrcsi_clip_polygon *shape)
{
    const uint32_t at[2] = {x, y};
    double low[2];
    double high[2];
    c->reach = 0;
    for (int k = 0; k < 2; k++) {
        double start = c->view->low[k];
        double end = c->view->low[k] + c->view->side;
        double wide = 0x1p-30 * (fabs(start) + fabs(end) + c->side * c->size);
        low[k] = at[k] > 0 ? block_edge(c, at[k], k) : lrcsi_least(start, c->low[k]) - wide;
        high[k] =
            at[k] + 1 < c->side ? block_edge(c, at[k] + 1, k) : lrcsi_most(end, c->high[k]) + wide;
        c->middle[k] = 0.5 * (low[k] + high[k]);
        low[k] -= c->middle[k];
        high[k] -= c->middle[k];
        c->reach = lrcsi_most(c->reach, lrcsi_most(fabs(low[k]), fabs(high[k])));
    }
    *shape = (lrcsi_clip_polygon){
        .corner = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}},
        .count = 4};
}

/* Lists the facets near a cell. 0 where they find no room. */
static int open_facets(cells_work *c, size_t block, cells_cell *cell)
{
    const cells_blocks *b = &c->facets;
    double g = 16 * U * c->reach;
    if (b->first[block + 1] - b->first[block] > c->room) {
        return 0;
    }
    for (uint32_t i = b->first[block]; i < b->first[block + 1]; i++) {
        uint32_t f = b->item[i];
        if (facet_near(facet_make(c, f), &cell->shape, cell->shape.corner[0], cell->shape.corner[2],
                       g)) {
            c->list[cell->facets++] = f;
            c->listed[f] = c->look;
            c->off = lrcsi_most(c->off, c->facet[f].off);
        }
    }
    return 1;
}

/* Its segments likewise. */
static int open_segments(cells_work *c, size_t block, cells_cell *cell)
{
    const cells_blocks *b = &c->events;
    for (uint32_t i = 0; i < cell->facets; i++) {
        if (!open_contacts(c, c->list[i]) || !open_joins(c, c->list[i])) {
            return 0;
        }
    }
    for (uint32_t i = b->first[block]; i < b->first[block + 1]; i++) {
        if (!open_edge(c, c->contest->events.edge[b->item[i]])) {
            return 0;
        }
    }
    if (cell->facets + (size_t)c->segments > c->room) {
        return 0;
    }
    for (uint32_t i = 0; i < c->segments; i++) {
        c->list[cell->facets + cell->segments++] = i;
    }
    return 1;
}

/* Facets of a block that is not done stay open. */
static void block_leave(cells_work *c, size_t block)
{
    for (uint32_t i = c->facets.first[block]; i < c->facets.first[block + 1]; i++) {
        c->found[c->facets.item[i]] |= FOUND_OPEN;
    }
}

static int block_wanted(const cells_work *c, size_t block)
{
    for (uint32_t i = c->facets.first[block]; i < c->facets.first[block + 1]; i++) {
        if (c->open[c->facets.item[i]]) {
            return 1;
        }
    }
    return 0;
}

static void block_do(cells_work *c, uint32_t x, uint32_t y)
{
    lrcsi_meter *meter = c->view->meter;
    size_t block = (size_t)y * c->side + x;
    if (!block_wanted(c, block)) {
        return;
    }
    cells_cell cell = {.first = 0};
    open_shape(c, x, y, &cell.shape);
    c->look++;
    c->segments = 0;
    c->off = 0;
    if (!open_facets(c, block, &cell) || !open_segments(c, block, &cell)) {
        block_leave(c, block);
        return;
    }
    /* Where cells become too many, clipping is left to itself. */
    uint64_t most = STEPS_LEAST + STEPS_EACH * (uint64_t)(cell.facets + cell.segments);
    c->stack[0] = cell;
    c->top = 1;
    while (c->top > 0) {
        cell = c->stack[--c->top];
        uint64_t steps = (uint64_t)1 + cell.facets + cell.segments;
        if (steps > most || !lrcsi_meter_take(meter, steps)) {
            block_leave(c, block);
            return;
        }
        most -= steps;
        cells_do(c, &cell);
    }
}

/* --- all cells -------------------------------------------------------------------------------- */

static lrcsi_visible facet_told(const cells_work *c, uint32_t facet, double *off)
{
    const cells_found *a = &c->area[facet];
    double whole = lrcsi_view_tilt(c->view, facet).projected;
    double seen = (c->found[facet] & FOUND_HIDDEN) == 0 ? whole
                  : (c->found[facet] & FOUND_SEEN) == 0 ? 0
                                                        : lrcsi_least(whole, a->seen);
    int mixed = (c->found[facet] & FOUND_SEEN) != 0 && (c->found[facet] & FOUND_HIDDEN) != 0;
    *off = a->doubt + (mixed ? a->off + 64 * U * a->seen : 0);
    return (lrcsi_visible){seen, lrcsi_most(0, seen - *off), lrcsi_least(whole, seen + *off), 0, 0};
}

/* What a facet's area may be off by, so that it is told: as much as clipping the facet alone would
   cost (visibility/occlude.c), 52 u of its diameter times its perimeter, and for each cut a strip
   128 u of the diameter wide, or wider; or so little that it does not matter. Clipping finds
   needles and what is larger than the bulk of the scene better than that. */
static double facet_accuracy(const cells_work *c, uint32_t facet)
{
    const uint32_t *corner = c->view->prepared->scene->facet[facet].corner;
    double projected = lrcsi_view_projected(c->view, facet);
    double diameter = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = c->view->point[corner[k]].x;
        const double *q = c->view->point[corner[(k + 1) % 3]].x;
        diameter = lrcsi_most(diameter, lrcsi_most(fabs(p[0] - q[0]), fabs(p[1] - q[1])));
    }
    double alone = U * diameter * (104 * diameter + 128 * c->area[facet].cut);
    const double *bulk = c->view->prepared->bulk;
    double extent = 2 * lrcsi_most(bulk[0], lrcsi_most(bulk[1], bulk[2]));
    int ordinary = projected > NEEDLE * diameter * diameter && diameter < 2 * extent;
    return ACCURACY_OF_FACET * projected +
           (ordinary ? alone + ACCURACY_OF_SCENE * extent * extent : 0);
}

static void areas_tell(const cells_work *c, lrcsi_visible *visible)
{
    for (uint32_t f = 0; f < c->view->prepared->scene->facet_count; f++) {
        if (!c->open[f] || (c->found[f] & FOUND_OPEN) != 0 || c->found[f] == 0) {
            continue;
        }
        double off;
        lrcsi_visible area = facet_told(c, f, &off);
        if (off <= facet_accuracy(c, f)) {
            visible[f] = area;
            c->open[f] = 0;
        }
    }
}

static size_t list_room(const lrcs_prepared *p)
{
    return (size_t)LIST_A_FACET * p->scene->facet_count + LIST_LEAST;
}

size_t lrcsi_cells_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t blocks = 2 * facets + 64; /* half as many along a side as the grid has, and 2 */
    size_t need = 2 * lrcsi_work_bytes(facets, 1);
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(blocks, sizeof(uint32_t)));
    need = lrcsi_work_add(need,
                          2 * lrcsi_work_bytes((size_t)block_entries(prepared), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(cells_facet)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(cells_found)));
    need =
        lrcsi_work_add(need, lrcsi_work_bytes(prepared->scene->vertex_count, sizeof(cells_point)));
    need = lrcsi_work_add(need, 5 * lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(list_room(prepared), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets + SEGMENT_LEAST, sizeof(cells_segment)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(MOST_BORDERS, sizeof(cells_border)));
    return lrcsi_work_add(need, lrcsi_work_bytes(CELLS_WAITING, sizeof(cells_cell)));
}

/* Both, and the axes. 0 also where much of the view lies outside of the bulk: cells there are so
   large that nothing is told. */
static int cells_blocks_make(cells_work *c, lrcs_work *work)
{
    blocks_place(c);
    axes_make(c);
    return c->view->side <= 2 * c->side * c->size && blocks_make(c, &c->facets, 0, work) &&
           blocks_make(c, &c->events, 1, work);
}

void lrcsi_cells_areas(const lrcsi_contest *contest, lrcs_work *work, unsigned char *open,
                       lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    const lrcs_prepared *p = view->prepared;
    uint32_t count = p->scene->facet_count;
    size_t mark = work->used;
    size_t peak = work->peak; /* nothing is missing where this finds no memory */
    cells_work c = {.contest = contest, .view = view, .open = open};
    c.room = list_room(p);
    c.segment_room = count + SEGMENT_LEAST;
    c.found = lrcsi_work_take_zero(work, count, 1);
    c.kind = lrcsi_work_take_zero(work, count, 1);
    c.facet = lrcsi_work_take(work, count, sizeof *c.facet);
    c.area = lrcsi_work_take_zero(work, count, sizeof *c.area);
    c.listed = lrcsi_work_take_zero(work, count, sizeof *c.listed);
    c.met = lrcsi_work_take_zero(work, count, sizeof *c.met);
    c.joined = lrcsi_work_take_zero(work, count, sizeof *c.joined);
    c.point = lrcsi_work_take_zero(work, p->scene->vertex_count, sizeof *c.point);
    c.component = lrcsi_work_take(work, count, sizeof *c.component);
    c.hit = lrcsi_work_take(work, count, sizeof *c.hit);
    c.list = lrcsi_work_take(work, c.room, sizeof *c.list);
    c.segment = lrcsi_work_take(work, c.segment_room, sizeof *c.segment);
    c.border = lrcsi_work_take(work, MOST_BORDERS, sizeof *c.border);
    c.stack = lrcsi_work_take(work, CELLS_WAITING, sizeof *c.stack);
    if (!p->convex && c.point && c.found && c.kind && c.facet && c.area && c.listed && c.met &&
        c.joined && c.component && c.hit && c.list && c.segment && c.border && c.stack &&
        cells_blocks_make(&c, work)) {
        for (uint32_t f = 0; f < count; f++) {
            c.kind[f] = lrcsi_grid_casts(view, f) && facet_apart(view, f) ? KIND_APART : 0;
        }
        for (uint32_t y = 0; y < c.side; y++) {
            for (uint32_t x = 0; x < c.side; x++) {
                block_do(&c, x, y);
            }
        }
        areas_tell(&c, visible);
    } else {
        work->peak = peak;
    }
    work->used = mark;
}
