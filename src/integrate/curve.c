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

int lrcsi_curve_wanted(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return lrcsi_prepared_normals(p, facet) && view->facing[facet] != 0 &&
           lrcsi_view_reflects(view, facet);
}

void lrcsi_curve_start(const lrcsi_curve_all *all, uint32_t facet, lrcsi_curve_facet *job)
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

lrcsi_curve_all lrcsi_curve_all_make(const lrcsi_view *view, const lrcsi_curving *how)
{
    lrcsi_curve_all all = {view, how, 0, 0, 0, 0};
    lrcsi_curve_facet job;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (lrcsi_curve_wanted(view, f)) {
            lrcsi_curve_start(&all, f, &job);
            all.negligible = job.sum.negligible;
            all.projected += job.incidence.projected;
            all.count++;
        }
    }
    return all;
}

void lrcsi_curve_have(lrcsi_curve_all *all, double sigma)
{
    all->done += sigma / FOUR_PI;
}

static void job_whole(lrcsi_curve_facet *job)
{
    lrcsi_cubature_add(&job->sum, (const double(*)[3])job->normal, job->incidence.projected);
}

double lrcsi_curve_most(const lrcsi_curve_facet *job)
{
    return job->sum.most.glint + job->sum.most.diffuse;
}

/* What has been summed, `share` of it. */
static lrcsi_curved job_part(const lrcsi_curve_facet *job, double share)
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
    part.most =
        FOUR_PI * lrcsi_curve_most(job) * job->incidence.projected * (1 + job->incidence.error);
    return part;
}

/* --- shares ----------------------------------------------------------------------------------- */

static lrcsi_curved curve_share(lrcsi_curve_facet *job, const lrcsi_visible *visible)
{
    if (!(visible->high > 0)) {
        return job_part(job, 0);
    }
    job_whole(job);
    double whole = lrcsi_sum_value(&job->sum.glint) + lrcsi_sum_value(&job->sum.diffuse);
    double most = lrcsi_curve_most(job);
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
    lrcsi_curve_facet job;
    lrcsi_curve_all all = lrcsi_curve_all_make(view, how);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        curved[f] = (lrcsi_curved){0, 0, 0, 0, 0, 0, 0, 0, 0};
        lrcsi_view_progress(view, LRCS_PROGRESS_INTEGRATE, f, view->prepared->scene->facet_count);
        if (lrcsi_curve_wanted(view, f)) {
            lrcsi_curve_start(&all, f, &job);
            curved[f] = curve_share(&job, &visible[f]);
            lrcsi_curve_have(&all, curved[f].glint + curved[f].diffuse);
        }
    }
}

/* --- pieces ----------------------------------------------------------------------------------- */

/* A piece, fanned from its first corner. Returns what its areas may be off by. */
static double piece_add(lrcsi_curve_facet *job, const lrcsi_target *target,
                        const double (*corner)[2], uint32_t count)
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
double lrcsi_curve_position_err(const lrcsi_curve_facet *job, const lrcsi_target *target)
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
static lrcsi_curved curve_pieces(lrcsi_curve_facet *job, lrcsi_occluding *o, lrcsi_visible *visible)
{
    const lrcsi_target *target = &o->alone.target;
    double off = 20 * LRCSI_U * target->reach * target->perimeter;
    job->sum.position_err = lrcsi_curve_position_err(job, target);
    while (lrcsi_occlude_next(o)) {
        off +=
            piece_add(job, target, (const double(*)[2])o->alone.piece.corner, o->alone.piece.count);
    }
    off += o->alone.bent;
    *visible = facet_known(job->view, job->facet, lrcsi_occlude_close(o));
    lrcsi_curved part = job_part(job, 1);
    part.visibility =
        FOUR_PI * (lrcsi_curve_most(job) * (visible->high - visible->low + off) + job->sum.left);
    return part;
}

/* One facet, integrated where there is a job for it. */
static void facet_pieces(lrcsi_curve_facet *job, lrcsi_occluding *o, uint32_t facet,
                         lrcsi_visible *visible, lrcsi_curved *curved)
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
    lrcsi_curve_facet job;
    lrcsi_curve_all all = lrcsi_curve_all_make(view, how);
    int status = lrcsi_occlude_make(classification, work, &o);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count && status == LRCS_OK; f++) {
        int wanted = lrcsi_curve_wanted(view, f);
        int parted = sampled && classification->undecided[f] && visible[f].low < visible[f].high;
        curved[f] = (lrcsi_curved){0, 0, 0, 0, 0, 0, 0, 0, 0};
        lrcsi_view_progress(view, sampled ? LRCS_PROGRESS_INTEGRATE : LRCS_PROGRESS_VISIBILITY, f,
                            view->prepared->scene->facet_count);
        if (wanted) {
            lrcsi_curve_start(&all, f, &job);
        }
        if (!sampled || (parted && wanted)) {
            facet_pieces(wanted ? &job : NULL, &o, f, &visible[f], &curved[f]);
        } else if (wanted) {
            curved[f] = curve_share(&job, &visible[f]);
        }
        lrcsi_curve_have(&all, curved[f].glint + curved[f].diffuse);
    }
    work->used = mark;
    return status;
}
