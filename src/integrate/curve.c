/* SPDX-License-Identifier: MIT */
/* Facets with curved normals. It decides over which region of a facet its normals are integrated,
   and what not knowing that region may cost; how the integral is done is cubature.c.

   Let F be the most that f_r cos reaches over the facet's normals, P its projected area and I the
   integral over all of it. What is visible, V, has an area in [low, high], so
       I - F (P - low) <= integral over V <= F high,  and it lies in [0, I].
   Where only an area is known, any value in that interval is off by at most its longer part. Pieces
   differ from V by an area of at most high - low, both ways, and by their corners' rounding
   (visibility/occlude.h): F times as much. An I that steps left off by as much moves all of these
   by no more.

   Rounding: normals in view axes are off by 12 u (a rotation's rows, three products, two sums), by
   4 u more at each of 64 halvings at most, and by 8 u at a rule's point: 2^-44 covers it. */
#include "integrate/curve.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"

#define FOUR_PI    12.566370614359172954
#define SLIP_WHOLE 0x1p-44

/* The cubature aims at this share of the tolerance, within what rules of its order can do. */
#define CUBATURE_SHARE 0.1
#define CUBATURE_LEAST 1e-9
#define CUBATURE_MOST  1e-2

/* All facets to integrate over. The sum so far tells how small a contribution is still worth work:
   a dark sliver gets no more than it can add. Each facet may err by its share of the sum, by area
   and by count: all together by twice the aim. */
typedef struct curve_all {
    const lrcsi_view *view;
    const lrcsi_curving *how;
    double negligible; /* f_r cos below this is negligible beside the brightest facet */
    double projected;  /* area of all */
    double count;
    double done; /* integral of f_r cos over the visible parts of the facets done so far */
} curve_all;

/* A facet at work. */
typedef struct curve_job {
    const lrcsi_view *view;
    uint32_t facet;
    lrcsi_incidence incidence;
    lrcs_brdf brdf;
    double normal[3][3]; /* at its corners, view axes, on the side that is seen */
    lrcsi_cubature sum;
} curve_job;

int lrcsi_curve_wanted(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return lrcsi_prepared_normals(p, facet) && view->facing[facet] != 0 &&
           lrcsi_view_reflects(view, facet);
}

static void job_start(curve_job *job, const curve_all *all, uint32_t facet)
{
    const lrcsi_view *view = all->view;
    const lrcs_point *n = lrcsi_prepared_normals(view->prepared, facet);
    job->view = view;
    job->facet = facet;
    job->incidence = lrcsi_view_incidence(view, facet);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const double *row = view->R[k];
            job->normal[i][k] = view->facing[facet] *
                                (row[0] * n[i].x[0] + row[1] * n[i].x[1] + row[2] * n[i].x[2]);
        }
    }
    double aim = lrcsi_least(CUBATURE_MOST,
                             lrcsi_most(CUBATURE_LEAST, CUBATURE_SHARE * all->how->tolerance));
    job->brdf = lrcsi_plan_brdf(all->how->plan, lrcsi_prepared_material(view->prepared, facet));
    job->sum =
        lrcsi_cubature_make(&job->brdf, (const double(*)[3])job->normal, aim, all->how->waiting);
    job->sum.whole = job->incidence.projected;
    job->sum.position_err = SLIP_WHOLE;
    job->sum.meter = view->meter;
    job->sum.moments = all->how->moments;
    job->sum.negligible = lrcsi_most(job->sum.negligible, all->negligible);
    job->sum.had = all->done > 0 ? all->done / all->projected +
                                       all->done / all->count / job->incidence.projected
                                 : 0;
}

static curve_all all_make(const lrcsi_view *view, const lrcsi_curving *how)
{
    curve_all all = {view, how, 0, 0, 0, 0};
    curve_job job;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (lrcsi_curve_wanted(view, f)) {
            job_start(&job, &all, f);
            all.negligible = job.sum.negligible;
            all.projected += job.incidence.projected;
            all.count++;
        }
    }
    return all;
}

static void all_have(curve_all *all, const lrcsi_curved *curved)
{
    all->done += (curved->glint + curved->diffuse) / FOUR_PI;
}

static void job_whole(curve_job *job)
{
    lrcsi_cubature_add(&job->sum, (const double(*)[3])job->normal, job->incidence.projected);
}

/* The most that f_r cos reaches on the facet. */
static double job_most(const curve_job *job)
{
    return job->sum.most.glint + job->sum.most.diffuse;
}

/* What has been summed, `share` of it. */
static lrcsi_curved job_part(const curve_job *job, double share)
{
    const lrcsi_cubature *sum = &job->sum;
    double factor = FOUR_PI * share;
    lrcsi_curved part = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    part.glint = factor * lrcsi_sum_value(&sum->glint);
    part.diffuse = factor * lrcsi_sum_value(&sum->diffuse);
    part.glint_u = factor * lrcsi_sum_value(&sum->glint_u);
    part.diffuse_log = factor * lrcsi_sum_value(&sum->diffuse_log);
    part.rounding = factor * sum->rounding +
                    (job->incidence.error + 16 * LRCSI_U) * (part.glint + part.diffuse);
    part.estimate = factor * sum->estimate;
    part.most = FOUR_PI * job_most(job) * job->incidence.projected * (1 + job->incidence.error);
    return part;
}

/* --- shares ----------------------------------------------------------------------------------- */

static lrcsi_curved curve_share(curve_job *job, const lrcsi_visible *visible)
{
    if (!(visible->high > 0)) {
        return job_part(job, 0);
    }
    job_whole(job);
    double whole = lrcsi_sum_value(&job->sum.glint) + lrcsi_sum_value(&job->sum.diffuse);
    double most = job_most(job);
    double projected = job->incidence.projected;
    double high = visible->high < projected ? lrcsi_least(whole, most * visible->high) : whole;
    double low =
        visible->low < projected ? lrcsi_most(0, whole - most * (projected - visible->low)) : whole;
    if (!(low <= high)) { /* by rounding, or the cubature's error */
        low = high;
    }
    double value = lrcsi_least(high, lrcsi_most(low, visible->area / projected * whole));
    lrcsi_curved part = job_part(job, whole > 0 ? value / whole : 0);
    part.visibility = FOUR_PI * (lrcsi_most(high - value, value - low) + job->sum.left);
    part.rounding = job_part(job, 1).rounding;
    part.likely = part.visibility > 0 ? (FOUR_PI * whole / projected) * visible->likely : 0;
    part.estimate = FOUR_PI * job->sum.estimate;
    return part;
}

void lrcsi_curve_shares(const lrcsi_view *view, const lrcsi_curving *how,
                        const lrcsi_visible *visible, lrcsi_curved *curved)
{
    curve_job job;
    curve_all all = all_make(view, how);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        curved[f] = (lrcsi_curved){0, 0, 0, 0, 0, 0, 0, 0, 0};
        lrcsi_view_progress(view, LRCS_PROGRESS_INTEGRATE, f, view->prepared->scene->facet_count);
        if (lrcsi_curve_wanted(view, f)) {
            job_start(&job, &all, f);
            curved[f] = curve_share(&job, &visible[f]);
            all_have(&all, &curved[f]);
        }
    }
}

/* --- pieces ----------------------------------------------------------------------------------- */

/* A piece, fanned from its first corner. Returns what its areas may be off by. */
static double piece_add(curve_job *job, const lrcsi_target *target, const double (*corner)[2],
                        uint32_t count)
{
    double normal[3][3]; /* of the fan's triangle at hand: corners 0, i - 1, i */
    double off = 0;
    for (uint32_t i = 0; i < count; i++) {
        double weight[3];
        double *n = normal[i < 2 ? i : 2];
        lrcsi_target_weights(target, corner[i], weight);
        for (int k = 0; k < 3; k++) {
            n[k] = weight[0] * job->normal[0][k] + weight[1] * job->normal[1][k] +
                   weight[2] * job->normal[2][k];
        }
        if (i < 2) {
            continue;
        }
        const double u[2] = {corner[i - 1][0] - corner[0][0], corner[i - 1][1] - corner[0][1]};
        const double v[2] = {corner[i][0] - corner[0][0], corner[i][1] - corner[0][1]};
        lrcsi_cubature_add(&job->sum, (const double(*)[3])normal,
                           0.5 * (u[0] * v[1] - u[1] * v[0]));
        off += 4 * LRCSI_U * (fabs(u[0] * v[1]) + fabs(u[1] * v[0]));
        for (int k = 0; k < 3; k++) {
            normal[1][k] = normal[2][k];
        }
    }
    return off;
}

/* Points of pieces are off by 100 u of the reach in projection: as a share of the facet's least
   height, and that times how far its normals lie apart, at most 2. */
static double pieces_position_err(const curve_job *job, const lrcsi_target *target)
{
    double height = 2 * job->incidence.projected / target->diameter;
    return SLIP_WHOLE + 200 * LRCSI_U * target->reach / height;
}

/* Back sides proved never to be seen, and looked for all the same, may show nothing. */
static lrcsi_visible facet_known(const lrcsi_view *view, uint32_t facet, lrcsi_visible visible)
{
    visible.low = view->prepared->solid && view->facing[facet] < 0 ? 0 : visible.low;
    return visible;
}

/* All pieces of the facet that is open, which is closed then. */
static lrcsi_curved curve_pieces(curve_job *job, lrcsi_occluding *o, lrcsi_visible *visible)
{
    const lrcsi_target *target = &o->alone.target;
    double off = 20 * LRCSI_U * target->reach * target->perimeter;
    job->sum.position_err = pieces_position_err(job, target);
    while (lrcsi_occlude_next(o)) {
        off +=
            piece_add(job, target, (const double(*)[2])o->alone.piece.corner, o->alone.piece.count);
    }
    off += o->alone.bent;
    *visible = facet_known(job->view, job->facet, lrcsi_occlude_close(o));
    lrcsi_curved part = job_part(job, 1);
    part.visibility =
        FOUR_PI * (job_most(job) * (visible->high - visible->low + off) + job->sum.left);
    return part;
}

/* One facet, integrated where there is a job for it. */
static void facet_pieces(curve_job *job, lrcsi_occluding *o, uint32_t facet, lrcsi_visible *visible,
                         lrcsi_curved *curved)
{
    lrcsi_occlude_open(o, facet);
    if (job && o->undecided) {
        *curved = curve_pieces(job, o, visible);
        return;
    }
    *visible = facet_known(o->classification->view, facet, lrcsi_occlude_area(o));
    if (job) {
        *curved = curve_share(job, visible);
    }
}

int lrcsi_curve_pieces(lrcsi_classification *classification, const lrcsi_curving *how, int sampled,
                       lrcs_work *work, lrcsi_visible *visible, lrcsi_curved *curved)
{
    const lrcsi_view *view = classification->view;
    size_t mark = work->used;
    lrcsi_occluding o;
    curve_job job;
    curve_all all = all_make(view, how);
    int status = lrcsi_occlude_make(classification, work, &o);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        int wanted = lrcsi_curve_wanted(view, f);
        int parted = sampled && classification->undecided[f] && visible[f].low < visible[f].high;
        curved[f] = (lrcsi_curved){0, 0, 0, 0, 0, 0, 0, 0, 0};
        lrcsi_view_progress(view, sampled ? LRCS_PROGRESS_INTEGRATE : LRCS_PROGRESS_VISIBILITY, f,
                            view->prepared->scene->facet_count);
        if (wanted) {
            job_start(&job, &all, f);
        }
        if (!sampled || (parted && wanted)) {
            facet_pieces(wanted ? &job : NULL, &o, f, &visible[f], &curved[f]);
        } else if (wanted) {
            curved[f] = curve_share(&job, &visible[f]);
        }
        all_have(&all, &curved[f]);
    }
    work->used = mark;
    return status;
}
