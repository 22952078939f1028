/* SPDX-License-Identifier: MIT */
/* The mean of F = f_r cos^2 over the patch of a facet: how the patch is divided into pieces, and
   what counts as an error. F, its bounds and the rules: integrate/wall/patch_frame.h. Whether the
   patch is visible is decided elsewhere (integrate/wall/tessellation.c, clear_sectors.c).

   Pieces. The patch is halved in both variables, and its halves again, where the remainder of the
   rules would be too large, or where it is nearly edge-on to the laser.

   Edge-on. With kappa for real angles up to the ends of a piece, and c of its middle, all of it
   faces away if c + kappa <= 0. Pieces that may be edge-on in part:
   integrate/wall/patch_edge_on.h.

   Shadow of a rim. Where only a part of the inside of a patch is visible, past the rim of its own
   part, F counts as 0 on the rest of it (integrate/wall/rim_shadow.h). On a straight wall the
   visible fraction is a weight, and the patch is divided at the azimuths where it reaches 1. On a
   round wall pieces that the end of the shadow crosses are divided along it
   (integrate/wall/patch_cut.c).
   Called: lrcsi_tessellate_patch. */
#include "integrate/wall/patch.h"

#include <math.h>

#include "base/elementary.h"
#include "base/range.h"
#include "integrate/wall/patch_cut.h"
#include "integrate/wall/patch_edge_on.h"
#include "integrate/wall/patch_frame.h"

/* Heuristics, which affect the time and the size of remainders, which are part of the bound
   whatever they are:
   - the remainder that a rule should have, relative to F in the middle of the piece, on patches
     that may be edge-on in part to the largest F: this times the tolerance, but within these
     limits;
   - the remainder, relative to the mean, above which the mean is not used: of patches that may be
     edge-on in part a larger one, because without the mean about all of F would be an error;
   - how often a piece is halved in each variable: anywhere; where the end of a shadow crosses it;
     where it is nearly edge-on, that is, where normals move by more than a fraction of the cosine;
   - the error of a nearly edge-on piece that is enough, as a multiple of the tolerance, relative to
     the diffuse term where the wall faces the laser most. The area of these pieces is so small that
     far more is enough there than elsewhere. */
#define RULE_TOLERANCE     0x1p-7
#define RULE_LOW           0x1p-40
#define RULE_HIGH          0x1p-12
#define REMAINDER_MAX      0x1p-10
#define EDGE_ON_MAX        0x1p-3
#define LEVELS_MAX         2
#define CUT_LEVELS_MAX     8
#define EDGE_ON_LEVELS_MAX 10
#define NEARLY_EDGE_ON     0.1
#define EDGE_ON_FRACTION   0x1p1

/* Piece `index` of those that `level` halvings in phi and, unless the wall is straight, in alpha
   make of the patch. The four pieces of one have successive indices: the last two bits are its
   half in alpha and in phi. */
static lrcsi_patch_frame frame_piece(const lrcsi_patch_frame *whole, int level, uint32_t index)
{
    const int n = 1 << level;
    const int bits = whole->step > 0 ? 2 : 1;
    int i = 0;
    int k = 0;
    for (int at = level - 1; at >= 0; at--) {
        const uint32_t part = index >> (bits * at);
        i = 2 * i + (int)(part >> 1 & (uint32_t)(bits - 1));
        k = 2 * k + (int)(part & 1);
    }
    const double step = whole->step / n;
    const double half = whole->half / n;
    return lrcsi_patch_frame_part(whole, whole->alpha + (2 * i + 1 - n) * step, step,
                                  whole->phi + (2 * k + 1 - n) * half, half);
}

/* Is a piece, whose normals differ by at most `shift`, far enough from edge-on for the rules? */
static int piece_is_slanting(const lrcsi_patch_frame *f, double shift)
{
    return shift < 0.4 * f->c;
}

/* Adds the mean over a piece by rules, times `fraction`. Returns the remainder, infinite if
   rounding errors are too large. */
static double piece_add_all(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double target,
                            double fraction, lrcsi_patch *patch)
{
    const lrcsi_mean_rule *rule[2];
    const double remainder = lrcsi_patch_rules(f, brdf, target, rule);
    return remainder < HUGE_VAL && lrcsi_patch_add_points(f, brdf, rule, fraction, patch)
               ? remainder
               : HUGE_VAL;
}

/* The error of the mean over a nearly edge-on piece at which it is not halved any further. */
static double edge_on_small(const lrcsi_patch_frame *f, const lrcs_brdf *brdf)
{
    const lrcs_brdf term = {brdf->B > 0 ? 0 : brdf->A, brdf->B, brdf->s, brdf->m};
    const double u = 1 / (f->most * f->most) - 1;
    return EDGE_ON_FRACTION * f->tolerance * lrcsi_patch_integrand(f, &term, lrcsi_max(0, u));
}

/* Adds the mean over a piece that is nearly edge-on, times `fraction`, if its error is at most
   `most`. Returns 0 if it is not. */
static int edge_on_add(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift, double most,
                       double fraction, lrcsi_patch *patch)
{
    const lrcsi_edge_on_mean mean = lrcsi_patch_edge_on_mean(f, brdf, shift);
    if (!(mean.error <= most)) {
        return 0;
    }
    patch->diffuse += fraction * mean.diffuse;
    patch->diffuse_log += f->derivatives ? fraction * mean.diffuse_log : 0;
    patch->remainder += fraction * mean.error;
    return 1;
}

/* Adds the mean over a piece, times `fraction`, which may have been halved `level` times, and whose
   normals differ by at most `shift`. Returns 0, and adds nothing, if it is to be halved again:
   1. where all of it faces away, or is in the shadow of the rim, F is 0;
   2. where F is no larger than its remainder should be, F is an error;
   3. where it is far enough from edge-on, by rules, if their remainder is small, or the piece is
      not halved any further;
   4. elsewhere the mean is enclosed, if that is accurate enough;
   5. otherwise F is an error. */
static int patch_piece_add(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift,
                           double target, double fraction, int level, lrcsi_patch *patch)
{
    const int part = f->shadow && f->shadow->round ? lrcsi_patch_cut_part(f) : LRCSI_CUT_ALL;
    if (f->c + shift <= 0 || part == LRCSI_CUT_NOTHING) { /* 1 */
        return 1;
    }
    const int is_nearly_edge_on = !(shift < NEARLY_EDGE_ON * f->c);
    const double bound = is_nearly_edge_on ? lrcsi_patch_edge_on_bound(f, brdf, shift) : HUGE_VAL;
    if (bound <= target) { /* 2 */
        patch->remainder += fraction * bound;
        return 1;
    }
    const double edge_on = is_nearly_edge_on ? edge_on_small(f, brdf) : 0;
    const int levels = is_nearly_edge_on        ? EDGE_ON_LEVELS_MAX
                       : part == LRCSI_CUT_SOME ? CUT_LEVELS_MAX
                                                : LEVELS_MAX;
    const int is_smallest = level >= levels || bound <= edge_on;
    if (piece_is_slanting(f, shift)) { /* 3 */
        const lrcsi_patch before = *patch;
        const double middle = f->target * lrcsi_patch_integrand(f, brdf, f->u);
        const double small = lrcsi_max(middle, target);
        const double remainder = part == LRCSI_CUT_SOME
                                     ? lrcsi_patch_cut_add(f, brdf, small, fraction, patch)
                                     : piece_add_all(f, brdf, small, fraction, patch);
        if (remainder <= 4 * small || (is_smallest && remainder < bound)) {
            patch->remainder += fraction * remainder;
            return 1;
        }
        *patch = before;
    } else if (part == LRCSI_CUT_ALL && /* 4 */
               edge_on_add(f, brdf, shift, is_smallest ? bound : edge_on, fraction, patch)) {
        return 1;
    }
    if (is_smallest) { /* 5 */
        const double largest = bound < HUGE_VAL ? bound : lrcsi_patch_largest(f, brdf);
        patch->remainder += fraction * largest;
    }
    return is_smallest;
}

/* Adds the mean over a patch or a part of it, times `fraction`, without the factor of area, piece
   by piece. Returns 0 if some of it may be edge-on. */
static int patch_add_pieces(const lrcsi_patch_frame *whole, const lrcs_brdf *brdf, double fraction,
                            lrcsi_patch *patch)
{
    const int bits = whole->step > 0 ? 2 : 1;
    const uint32_t last = (UINT32_C(1) << bits) - 1;
    int all_slants = 1;
    double target = 0;
    int level = 0;
    uint32_t index = 0;
    do {
        const lrcsi_patch_frame piece = frame_piece(whole, level, index);
        const double shift = lrcsi_patch_normal_shift(&piece, piece.step, lrcsi_exp(piece.step),
                                                      lrcsi_exp(piece.half));
        const double share = ldexp(fraction, -bits * level);
        if (level == 0 && !piece_is_slanting(&piece, shift)) { /* the whole patch */
            all_slants = 0;
            target = whole->target * lrcsi_patch_edge_on_most(&piece, brdf, shift);
        }
        if (!patch_piece_add(&piece, brdf, shift, target, share, level, patch)) {
            level++;
            index <<= bits;
            continue;
        }
        while (level > 0 && (index & last) == last) {
            level--;
            index >>= bits;
        }
        index++;
    } while (level > 0);
    return all_slants;
}

/* The same for the whole patch, which is divided where the visible fraction of a straight wall
   reaches 1. */
static int patch_add_parts(const lrcsi_patch_frame *whole, const lrcs_brdf *brdf,
                           lrcsi_patch *patch)
{
    const double end = whole->phi + whole->half;
    double from = whole->phi - whole->half;
    double kink[3];
    int count = whole->shadow ? lrcsi_rim_shadow_kinks(whole->shadow, from, end, kink) : 0;
    if (count == 0) {
        return patch_add_pieces(whole, brdf, 1, patch);
    }
    int all_slants = 1;
    kink[count++] = end;
    for (int i = 0; i < count; i++) {
        const double half = 0.5 * (kink[i] - from);
        const lrcsi_patch_frame part =
            lrcsi_patch_frame_part(whole, whole->alpha, whole->step, from + half, half);
        all_slants &= patch_add_pieces(&part, brdf, half / whole->half, patch);
        from = kink[i];
    }
    return all_slants;
}

/* The mean over the patch that patch->at identifies, or over what the shadow leaves of it. Returns
   0 if its errors are not finite. *limit: the remainder up to which the mean is worth using, in
   place of F at the normal of the facet. */
static int patch_integrate(const lrcsi_view *view, const lrcsi_plan *plan, uint32_t facet,
                           const lrcsi_rim_shadow *shadow, int derivatives, lrcsi_patch *patch,
                           double *limit)
{
    const lrcs_brdf *brdf = &patch->brdf;
    lrcsi_patch_frame f;
    if (!lrcsi_patch_frame_make(view, facet, &f, patch)) {
        return 0;
    }
    f.shadow = shadow;
    f.derivatives = derivatives;
    f.tolerance = plan->tolerance;
    f.target = lrcsi_min(RULE_HIGH, lrcsi_max(RULE_LOW, RULE_TOLERANCE * plan->tolerance));
    const int all_slants = patch_add_parts(&f, brdf, patch);
    double area_err =
        f.fourth ? LRCSI_PATCH_AREA_ERR / (fabs(f.cosine) - f.step) : LRCSI_PATCH_AREA_ERR;
    patch->rounding += area_err * (patch->glint + patch->diffuse);
    patch->glint *= f.area;
    patch->diffuse *= f.area;
    patch->glint_u *= f.area;
    patch->diffuse_log *= f.area;
    patch->rounding *= 1.0001 * f.area;
    patch->remainder *= 1.0001 * f.area;
    *limit = (all_slants ? REMAINDER_MAX : EDGE_ON_MAX) * (patch->glint + patch->diffuse);
    return isfinite(patch->remainder + patch->rounding);
}

static int same_brdf(const lrcs_brdf *a, const lrcs_brdf *b)
{
    return a->A == b->A && a->B == b->B && a->s == b->s && a->m == b->m;
}

/* The patch of a facet, not yet integrated. Returns 0 if there is none. */
static int patch_find(const lrcsi_view *view, const lrcsi_plan *plan, const lrcs_brdf *brdf,
                      uint32_t facet, int side, lrcsi_patch *patch)
{
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t index = scene->facet_part[facet];
    const lrcs_part *part = &scene->part[index];
    *patch = (lrcsi_patch){.part = index, .brdf = *brdf, .side = side};
    return plan->patches && side != 0 && lrcsi_patch_exists(view->prepared, facet) &&
           !(brdf->A > 0 && !(brdf->s >= LRCSI_PATCH_SLOPE_MIN)) &&
           lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet,
                                  &patch->at);
}

const lrcsi_patch *lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                    const lrcs_brdf *brdf, uint32_t facet, lrcsi_patches *patches)
{
    lrcsi_patch *last = &patches->last;
    lrcsi_patch made;
    if (!patch_find(view, plan, brdf, facet, view->facing[facet], &made)) {
        return NULL;
    }
    if (last->side != made.side || last->part != made.part || last->at.row != made.at.row ||
        last->at.sector != made.at.sector || last->at.mirrored != made.at.mirrored ||
        !same_brdf(&last->brdf, brdf)) {
        double limit;
        made.known =
            patch_integrate(view, plan, facet, NULL, patches->derivatives, &made, &limit) &&
            made.remainder <= limit;
        *last = made;
    }
    return last->known ? last : NULL;
}

int lrcsi_patch_make_side(const lrcsi_view *view, const lrcsi_plan *plan, const lrcs_brdf *brdf,
                          uint32_t facet, const lrcsi_rim_shadow *shadow, int derivatives,
                          lrcsi_patch *patch)
{
    double limit;
    return patch_find(view, plan, brdf, facet, shadow ? -1 : 1, patch) &&
           patch_integrate(view, plan, facet, shadow, derivatives, patch, &limit);
}
