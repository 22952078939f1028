/* SPDX-License-Identifier: MIT */
/* How finely a shape is divided into facets: as finely as the edges of its shadows require, but
   more coarsely if it is small compared with the other parts. This is a choice without a proof, and
   so are all its constants: they decide how many facets there are, while the error of these facets
   is computed from the mesh for each pose. */
#include "scene/build/fineness.h"

#include <math.h>

#include "base/constant.h"
#include "base/vec3.h"
#include "mesh/shape/tessellate.h"
#include "scene/build/placed_shape.h"

/* The tolerance of a scene is divided among its parts, or among this many if it has fewer. */
#define PARTS_MIN 16.0
/* The largest factor by which a small part may be coarser than requested. */
#define COARSENING_MAX 100.0

/* A round body ("round": a sphere, a dome or a paraboloid) is divided so that its surface is within
   this times its radius times the tolerance of its facets. Measured: with 0.3, the bounds of 14 of
   20 directions to examples/satellites/spinner.toml and of 11 of 20 to lander.toml meet 1e-4;
   with 1.0, those of 25 and 17 of 60, in half the time. The number of its facets grows as
   1/tolerance. */
#define ROUND_REACH 0.3

/* The chord of one of N sectors is within about this times (pi/N)^2 of the unit circle
   (mesh/shape/revolution.c). */
#define SECTOR_REACH 0.36
/* The factor of rim_corners. */
#define RIM_FACTOR 5.0
/* No shape is given more sectors than this for its shadows. */
#define SECTORS_MAX 1e6
/* Of the reach that a round body is allowed, its sectors take up a fraction between these, in
   steps; its zones take up the rest. */
#define FRACTION_MIN  0.3
#define FRACTION_MAX  0.85
#define FRACTION_STEP 0.1
/* To keep within the limit of facets, a reach is enlarged by a quarter, at most so many times. */
#define ENLARGEMENT      1.25
#define ENLARGEMENTS_MAX 100

/* Divisions of a shape whose facets appear only in pictures and records: the normals of neighbours
   differ by 7.5 and 9 degrees, which looks smooth. */
#define BASE_AROUND 48
#define BASE_ALONG  10

/* Divisions of a shape that is alone in its scene and whose facets represent patches of its true
   surface. Only patches that are nearly edge-on to the laser, or partly face away from it, have a
   large error. Measured with nine materials at 37 aspects, the bounds relative to the mean of sigma
   over the aspects are at most 20/N^2 for straight walls and 300/N^3 for round shapes of N sectors.
   This holds if the rules of integrate/wall/patch.h apply: a facet may turn by at most 4 s and 0.1
   rad in azimuth (hence at least 1.6/s and 64 sectors), and m must not exceed 50. */
#define ALONE_STRAIGHT     20.0
#define ALONE_ROUND        300.0
#define ALONE_SECTORS_MIN  64.0
#define ALONE_SECTORS_MAX  1e6
#define ALONE_PER_SLOPE    1.6
#define ALONE_EXPONENT_MAX 50.0

/* If the components of a scale differ by more than this factor, no number of facets suffices. */
#define RATIO_MAX 1e3
/* A scale whose components differ by a ratio multiplies the error of a facet by slightly more than
   the square of the ratio: this factor is meant to cover the rest. */
#define RATIO_AMPLIFICATION 1.5

/* Round bodies among other parts are divided for a tolerance this many times as large. */
#define ROUND_COARSENING 10.0

/* The area of a facet, in units of the mesh; 0 if a corner is out of range. */
static double mesh_facet_area(const lrcs_mesh *mesh, uint32_t f)
{
    const uint32_t *corner = mesh->facet[f].corner;
    if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count ||
        corner[2] >= mesh->vertex_count) {
        return 0.0;
    }
    double n[3];
    lrcsi_vec3_normal(mesh->vertex[corner[0]].x, mesh->vertex[corner[1]].x,
                      mesh->vertex[corner[2]].x, n);
    return 0.5 * sqrt(lrcsi_vec3_dot(n, n));
}

double lrcsi_fineness_area(const lrcs_recipe_part *part, const lrcs_mesh *mesh)
{
    const lrcs_shape *shape = &part->shape;
    const double *s = shape->size;
    double r = fmax(shape->radius, shape->radius2);
    double area = 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) + 6.0 * r * (r + shape->length);
    if (mesh) {
        area = 0.0;
        for (uint32_t f = 0; f < mesh->facet_count; f++) {
            area += mesh_facet_area(mesh, f);
        }
    }
    const double *scale = part->place.scale;
    double largest = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    return area * largest * largest;
}

/* The factor by which a part that is small compared with the others may be coarser than requested:
   if sigma of each part were proportional to its surface area, the errors of all parts together
   would not exceed the error that the scene is allowed. */
static double part_coarsening(const lrcsi_fineness *fineness, const lrcs_recipe_part *part)
{
    double parts = fmax(PARTS_MIN, fineness->parts);
    double factor = fineness->area / (lrcsi_fineness_area(part, NULL) * parts);
    return factor > 1.0 ? fmin(factor, COARSENING_MAX) : 1.0;
}

/* The tolerance for which a shape is divided: as requested if it is alone. Among other parts the
   requested tolerance is multiplied by the factor above. For round bodies it is also
   ROUND_COARSENING times as large, and at least round_min, because their number of facets grows as
   1/tolerance (that of straight walls as its square root). */
static double shape_tolerance(const lrcsi_fineness *fineness, const lrcs_recipe_part *part)
{
    double tolerance = fineness->tolerance;
    if (fineness->parts == 1) {
        return tolerance;
    }
    tolerance = fmin(tolerance * part_coarsening(fineness, part), fmax(1.0, tolerance));
    return lrcsi_shape_is_round(part->shape.kind)
               ? fmax(fmin(ROUND_COARSENING * tolerance, 1.0), fineness->round_min)
               : tolerance;
}

/* The number of sectors N of a rim among other parts whose shadow is accurate enough. The shadow of
   a rim of radius R is uncertain over a strip of length 2 pi R and width 2 SECTOR_REACH R (pi/N)^2.
   With N = pi sqrt(RIM_FACTOR / tolerance) its area is 4 SECTOR_REACH / RIM_FACTOR, less than a
   third, of the tolerance times the area of the disc that the rim bounds. 3.1416: pi,
   rounded up. */
static double rim_corners(double tolerance)
{
    return 3.1416 * sqrt(RIM_FACTOR / tolerance);
}

/* Divides the rim of a shape among other parts finely enough for its shadows. */
static void refine_rim(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                       lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    const lrcs_shape *shape = &part->shape;
    double corners = rim_corners(ldexp(shape_tolerance(fineness, part), -fineness->halvings));
    if (fineness->parts == 1 || divisions->along > 1 || lrcsi_shape_is_plane_faced(shape->kind) ||
        !(corners < SECTORS_MAX)) {
        return;
    }
    lrcs_divisions finer = {4 * (uint32_t)(corners / 4.0 + 1.0), 1, 0};
    if (finer.around > divisions->around &&
        lrcsi_tessellate_counts(shape, &finer).facets <= fineness->max_facets) {
        *divisions = finer;
        *counts = lrcsi_tessellate_counts(shape, &finer);
    }
}

/* Divisions of a round body with level zones whose facets are within `reach` of its true surface.
   The sectors take up the given fraction of that distance; zones are added until the facets are
   within it, or too many. */
static lrcs_divisions divide_round_by(const lrcsi_fineness *fineness, const lrcs_shape *shape,
                                      double reach, double fraction)
{
    double corners = LRCS_PI * sqrt(SECTOR_REACH * shape->radius / (fraction * reach));
    lrcs_divisions d = {4 * (uint32_t)(fmin(fmax(corners, BASE_AROUND), SECTORS_MAX) / 4.0 + 1.0),
                        BASE_ALONG, 1};
    while (lrcsi_tessellate_counts(shape, &d).facets <= fineness->max_facets &&
           lrcsi_tessellate_reach(shape, &d).all > reach) {
        d.along += 1 + d.along / 16;
    }
    return d;
}

/* The divisions above for the fraction that gives the fewest facets. If these are still too many,
   the reach is enlarged. */
static lrcs_divisions divide_round(const lrcsi_fineness *fineness, const lrcs_shape *shape,
                                   double reach)
{
    lrcs_divisions best = {0, 0, 0};
    uint32_t fewest = UINT32_MAX;
    for (int i = 0; i < ENLARGEMENTS_MAX && fewest > fineness->max_facets; i++) {
        for (double fraction = FRACTION_MIN; fraction < FRACTION_MAX; fraction += FRACTION_STEP) {
            lrcs_divisions d = divide_round_by(fineness, shape, reach, fraction);
            uint32_t facets = lrcsi_tessellate_counts(shape, &d).facets;
            if (facets < fewest) {
                best = d;
                fewest = facets;
            }
        }
        reach *= ENLARGEMENT;
    }
    return best;
}

/* Divisions of a shape among other parts whose facets represent patches of its true surface
   (integrate/wall/patch.h). Patches have no error of their own; only the shadows are uncertain, in
   proportion to the distance between the true surface and the facets. Straight walls are divided as
   in refine_rim, round bodies for that distance. Each halving halves the distance. Returns 0 if
   there would be too many facets. */
static int divide_for_shadows(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                              lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    const lrcs_shape *shape = &part->shape;
    double tolerance = fmin(fineness->tolerance * part_coarsening(fineness, part), 1.0);
    double reach = ROUND_REACH * fmax(tolerance, fineness->round_min) * shape->radius;
    double corners = fmax(rim_corners(tolerance), BASE_AROUND);
    corners *= sqrt(ldexp(1.0, fineness->halvings));
    if (!(corners < SECTORS_MAX)) {
        return 0;
    }
    *divisions = (lrcs_divisions){4 * (uint32_t)(corners / 4.0 + 1.0), 1, 0};
    if (lrcsi_shape_is_round(shape->kind)) {
        *divisions = divide_round(fineness, shape, reach);
    }
    if (lrcsi_shape_is_round(shape->kind) && fineness->halvings > 0) {
        reach = ldexp(lrcsi_tessellate_reach(shape, divisions).all, -fineness->halvings);
        *divisions = divide_round(fineness, shape, reach);
    }
    *counts = lrcsi_tessellate_counts(shape, divisions);
    return counts->facets <= fineness->max_facets;
}

/* Divisions of a shape alone in its scene whose facets represent patches: as coarse as the
   tolerance allows. Returns 0 if that does not suffice, or if these facets would need to be finer
   than facets without patches. ratio: of the scales along two axes. It multiplies the turns of
   normals; measured with scales of 1 to 4, it multiplies the bounds of round shapes by its cube. */
static int divide_alone(const lrcsi_fineness *fineness, const lrcs_recipe_part *part, double ratio,
                        const lrcs_brdf *brdf, lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    int is_round = lrcsi_shape_is_round(part->shape.kind);
    const double round = ALONE_ROUND * (ratio * ratio * ratio);
    double tolerance = fmin(ldexp(fineness->tolerance, -fineness->halvings), 1.0);
    double corners =
        fmax(ALONE_SECTORS_MIN, brdf->A > 0.0 ? ALONE_PER_SLOPE * ratio / brdf->s : 0.0);
    corners = is_round ? corners : fmax(corners, sqrt(ALONE_STRAIGHT / tolerance));
    while (is_round && corners < ALONE_SECTORS_MAX &&
           corners * corners * corners * tolerance < round) {
        corners += 4.0;
    }
    if (fineness->facets_only == LRCS_FACETS_LOCAL || !(corners < ALONE_SECTORS_MAX) ||
        (brdf->B > 0.0 && brdf->m > ALONE_EXPONENT_MAX)) {
        return 0;
    }
    divisions->around = 4 * (uint32_t)(corners / 4.0 + 1.0);
    divisions->along = is_round ? divisions->around / 4 : 1;
    divisions->level_zones = 0;
    *counts = lrcsi_tessellate_counts(&part->shape, divisions);
    return counts->facets <= fineness->max_facets;
}

/* Do the facets of a shape represent patches of it? */
static int has_patches(const lrcs_recipe_part *part)
{
    lrcsi_placer placer;
    double image[3][3];
    double area;
    int kind = part->shape.kind;
    int flat = lrcsi_shape_is_plane_faced(kind) || kind == LRCS_SHAPE_DISC;
    return !flat && lrcsi_placer_make(&part->place, &part->joint, &placer) == LRCS_OK &&
           lrcsi_placer_normals(&placer, image, &area);
}

/* Does the closed form hold for a shape in every direction? It does if the shape is alone, so that
   nothing hides it, and if its placement does not deform it. */
static int is_closed_form(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                          const lrcs_material *material)
{
    lrcsi_placer placer;
    lrcsi_axes axes;
    return fineness->parts == 1 && !fineness->facets_only &&
           lrcsi_placed_shape_closed_form(&part->shape, material->two_sided) &&
           lrcsi_placer_make(&part->place, &part->joint, &placer) == LRCS_OK &&
           lrcsi_placer_axes(&placer, &axes);
}

/* The first of these that applies:
   1. facets for pictures only, if the closed form holds for the shape;
   2. facets that represent patches of the true surface;
   3. flat facets. If the scale differs between axes, the ratio of its largest to its smallest
      component multiplies the angles between neighbouring normals, and slightly more than the
      square of the ratio multiplies the error of a facet (mesh/shape/revolution.c). */
int lrcsi_fineness_divide(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                          const lrcs_material *material, lrcs_divisions *divisions,
                          lrcs_mesh_counts *counts)
{
    const double *scale = part->place.scale;
    double large = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    double small = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    double ratio = large / small < RATIO_MAX ? large / small : 1.0; /* 1 too if small is 0 */
    double amplification = ratio > 1.0 ? RATIO_AMPLIFICATION * ratio * ratio : 1.0;
    const double tolerance =
        ldexp(shape_tolerance(fineness, part) / amplification, -fineness->halvings);
    const lrcs_fineness wanted = {tolerance, material->brdf, fineness->max_facets};
    if (is_closed_form(fineness, part, material)) {
        *divisions = (lrcs_divisions){BASE_AROUND,
                                      lrcsi_shape_is_round(part->shape.kind) ? BASE_ALONG : 1, 0};
        *counts = lrcsi_tessellate_counts(&part->shape, divisions);
        if (counts->facets <= fineness->max_facets) {
            return LRCS_OK;
        }
    }
    if (has_patches(part) &&
        (fineness->parts > 1
             ? divide_for_shadows(fineness, part, divisions, counts)
             : divide_alone(fineness, part, ratio, &material->brdf, divisions, counts))) {
        return LRCS_OK;
    }
    int status = lrcs_shape_count(&part->shape, &wanted, divisions, counts);
    if (status == LRCS_OK) {
        refine_rim(fineness, part, divisions, counts);
    }
    return status;
}
