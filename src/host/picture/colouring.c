/* SPDX-License-Identifier: MIT */
/* From the numbers of a run to colours, and the scale that covers them. It decides the appearance
   of a run, but no number of the result and no layout. */
#include "host/picture/colouring.h"

#include "base/constant.h"
#include "host/chart/palette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SCALE_DB      40.0 /* the largest range of the scale of sigma */
#define SCALE_BINS    800  /* a histogram of -400 .. 400 dB */
#define SCALE_LABELS  9.0
#define COLOUR_PLAIN  0xc8c8c8u /* facets without a colour of their own, shaded */
#define VISIBLE_SLOPE 1e-9      /* a slope that no colour shows */
#define CREASE_COSINE 0.05      /* cosines that differ by more show an edge */

static const char *const colouring_names[] = {"sigma", "theta",    "range",
                                              "facet", "material", "shaded"};

#define COLOURINGS (int)(sizeof colouring_names / sizeof colouring_names[0])

const char *lrcs_host_colouring_text(int colouring)
{
    return colouring >= 0 && colouring < COLOURINGS ? colouring_names[colouring] : NULL;
}

int lrcs_host_colouring_find(const char *name)
{
    for (int i = 0; i < COLOURINGS; i++) {
        if (strcmp(colouring_names[i], name) == 0) {
            return i;
        }
    }
    return LRCS_E_NAME;
}

uint32_t lrcsi_colouring_background(const lrcsi_colouring *colouring)
{
    return colouring->picture->white ? 0xffffffu : 0x0d111cu;
}

uint32_t lrcsi_colouring_text_colour(const lrcsi_colouring *colouring)
{
    return colouring->picture->white ? 0x222222u : 0xcdd2dcu;
}

/* ---- numbers of a facet ---- */

/* sigma per visible projected area in dB, or -HUGE_VAL if nothing is returned. */
static double facet_return(const lrcs_facet_record *record)
{
    if (!(record->sigma_m2 > 0.0) || !(record->visible_area_m2 > 0.0)) {
        return -HUGE_VAL;
    }
    return 10.0 * (log10(record->sigma_m2) - log10(record->visible_area_m2));
}

/* Coordinate k of the scene's centre in the observation frame. */
static double centre_view(const lrcsi_colouring *colouring, int k)
{
    const double *axis = colouring->picture->pose->R[k];
    const double *c = colouring->centre;
    return axis[0] * c[0] + axis[1] * c[1] + axis[2] * c[2];
}

/* The plane of a facet, z = at[0] + at[1] x + at[2] y in the observation frame about the scene's
   centre; level if the facet is edge-on. Returned, too: the least and the largest z of its
   corners. */
static void facet_plane(const lrcsi_colouring *colouring, uint32_t facet, double at[3],
                        double height[2])
{
    const lrcs_scene *scene = colouring->picture->scene;
    const double *c = colouring->centre;
    double p[3][3];
    for (int i = 0; i < 3; i++) {
        const double *x = scene->vertex[scene->facet[facet].corner[i]].x;
        for (int k = 0; k < 3; k++) {
            const double *axis = colouring->picture->pose->R[k];
            p[i][k] = axis[0] * (x[0] - c[0]) + axis[1] * (x[1] - c[1]) + axis[2] * (x[2] - c[2]);
        }
    }
    double ax = p[1][0] - p[0][0];
    double ay = p[1][1] - p[0][1];
    double bx = p[2][0] - p[0][0];
    double by = p[2][1] - p[0][1];
    double area = ax * by - ay * bx;
    double along = ((p[1][2] - p[0][2]) * by - (p[2][2] - p[0][2]) * ay) / area;
    double up = ((p[2][2] - p[0][2]) * ax - (p[1][2] - p[0][2]) * bx) / area;
    int level = !isfinite(along) || !isfinite(up);
    at[1] = level ? 0.0 : along;
    at[2] = level ? 0.0 : up;
    at[0] = p[0][2] - at[1] * p[0][0] - at[2] * p[0][1];
    height[0] = fmin(p[0][2], fmin(p[1][2], p[2][2]));
    height[1] = fmax(p[0][2], fmax(p[1][2], p[2][2]));
}

/* ---- scales ---- */

/* The value below which a fraction of the area lies, from a histogram of whole dB. */
static double histogram_quantile(const double area[SCALE_BINS], double fraction)
{
    double total = 0.0;
    double seen = 0.0;
    int bin = 0;
    for (int i = 0; i < SCALE_BINS; i++) {
        total += area[i];
    }
    while (bin < SCALE_BINS - 1 && seen + area[bin] <= fraction * total) {
        seen += area[bin++];
    }
    return bin - SCALE_BINS / 2.0;
}

/* By sigma, the scale covers all visible returns except the weakest and the strongest half percent
   of the area, in steps of 5 dB; values beyond its ends have the colours of the ends. By range, it
   covers all corners of the visible facets; by angle, 0 to 90 degrees. */
static void scale_make(lrcsi_colouring *colouring)
{
    const lrcs_host_picture *picture = colouring->picture;
    double range[2] = {0.0, 90.0};
    if (picture->colouring == LRCS_HOST_BY_SIGMA) {
        double area[SCALE_BINS] = {0};
        double largest = 0.0;
        for (uint32_t f = 0; f < picture->scene->facet_count; f++) {
            double bin = floor(facet_return(&picture->records[f])) + SCALE_BINS / 2.0;
            if (bin >= 0.0 && bin < SCALE_BINS) {
                area[(int)bin] += picture->records[f].visible_area_m2;
                largest = fmax(largest, area[(int)bin]);
            }
        }
        range[0] = -10.0; /* where nothing is returned, any scale will do */
        range[1] = 0.0;
        if (largest > 0.0) {
            range[1] = 5.0 * ceil((histogram_quantile(area, 0.995) + 1.0) / 5.0);
            range[0] = 5.0 * floor(histogram_quantile(area, 0.005) / 5.0);
            range[0] = fmax(range[0], range[1] - SCALE_DB);
            range[0] = fmin(range[0], range[1] - 10.0);
        }
    } else if (picture->colouring == LRCS_HOST_BY_RANGE) {
        range[0] = HUGE_VAL;
        range[1] = -HUGE_VAL;
        for (uint32_t f = 0; f < picture->scene->facet_count; f++) {
            if (picture->records[f].visible_area_m2 > 0.0) {
                double at[3];
                double height[2];
                facet_plane(colouring, f, at, height);
                range[0] = fmin(range[0], height[0]);
                range[1] = fmax(range[1], height[1]);
            }
        }
    }
    colouring->scale = lrcsi_axis_make(0, range[0], range[1], SCALE_LABELS);
}

const char *lrcsi_colouring_name(const lrcsi_colouring *colouring)
{
    static const char *const name[] = {"sigma per projected area (dB re 1 m2/m2)",
                                       "angle of incidence (deg)", "height towards the laser (m)"};
    return colouring->scaled ? name[colouring->picture->colouring] : NULL;
}

/* ---- materials ---- */

/* A model read twice gives each material twice. */
static int material_alike(const lrcs_material *a, const lrcs_material *b)
{
    return strcmp(a->name, b->name) == 0 && a->has_colour == b->has_colour &&
           memcmp(a->rgb, b->rgb, sizeof a->rgb) == 0;
}

/* Lists the materials assigned to facets, in the order of the scene's list, those that look the
   same once, each with its own colour. */
static void materials_list(lrcsi_colouring *colouring)
{
    const lrcs_scene *scene = colouring->picture->scene;
    unsigned char *used = calloc((size_t)scene->material_count + 1, 1);
    for (uint32_t f = 0; used && f < scene->facet_count; f++) {
        used[scene->facet_material[f]] = !scene->material[scene->facet_material[f]].omitted;
    }
    for (uint32_t i = 0; used && i < scene->material_count; i++) {
        int is_new = used[i];
        for (uint32_t k = 0; is_new && k < i; k++) {
            is_new = !(used[k] && material_alike(&scene->material[k], &scene->material[i]));
        }
        if (is_new && colouring->materials < LRCSI_COLOURING_MATERIALS) {
            colouring->material[colouring->materials++] = i;
        } else {
            colouring->more += is_new ? 1 : 0;
        }
    }
    free(used);
    lrcsi_palette_categorical(colouring->materials, colouring->hue);
}

const char *lrcsi_colouring_material_name(const lrcsi_colouring *colouring, uint32_t material)
{
    const char *name = colouring->picture->scene->material[material].name;
    return name && name[0] ? name : "(default)";
}

uint32_t lrcsi_colouring_material(const lrcsi_colouring *colouring, uint32_t material)
{
    const lrcs_material *all = colouring->picture->scene->material;
    uint32_t place = 0;
    while (place < colouring->materials && material != colouring->material[place]) {
        place++;
    }
    for (uint32_t k = 0; place == colouring->materials && k < colouring->materials; k++) {
        place = material_alike(&all[colouring->material[k]], &all[material]) ? k : place;
    }
    return place < colouring->materials ? colouring->hue[place] : lrcsi_palette_distinct(material);
}

/* ---- colours of facets ---- */

/* Does a facet have no value on the scale? Such a facet returns nothing. */
static int is_grey(const lrcsi_colouring *colouring, uint32_t facet)
{
    const lrcs_scene *scene = colouring->picture->scene;
    const lrcs_facet_record *record = &colouring->picture->records[facet];
    switch (colouring->picture->colouring) {
    case LRCS_HOST_BY_SIGMA:
        return !isfinite(facet_return(record));
    case LRCS_HOST_BY_THETA:
        return record->cos_theta < 0.0 && !scene->material[scene->facet_material[facet]].two_sided;
    default:
        return 0;
    }
}

lrcsi_colouring lrcsi_colouring_make(const lrcs_host_picture *picture)
{
    lrcsi_colouring colouring = {.picture = picture,
                                 .scaled = picture->colouring <= LRCS_HOST_BY_RANGE};
    if (picture->colouring == LRCS_HOST_BY_MATERIAL) {
        materials_list(&colouring);
    }
    if (picture->colouring == LRCS_HOST_BY_RANGE) {
        double low[3];
        double high[3];
        lrcs_host_scene_box(picture->scene, low, high);
        for (int k = 0; k < 3; k++) {
            colouring.centre[k] = 0.5 * (low[k] + high[k]);
        }
    }
    if (colouring.scaled && picture->records) {
        scale_make(&colouring);
    }
    for (uint32_t f = 0; colouring.scaled && picture->records && f < picture->scene->facet_count;
         f++) {
        colouring.greys |= picture->records[f].visible_area_m2 > 0.0 && is_grey(&colouring, f);
    }
    return colouring;
}

/* A facet without a value on the scale is grey, darker at larger incidence. */
uint32_t lrcsi_colouring_colour(const lrcsi_colouring *colouring, uint32_t facet,
                                const double view[2])
{
    const lrcs_scene *scene = colouring->picture->scene;
    const lrcs_facet_record *record = &colouring->picture->records[facet];
    const lrcs_material *material = &scene->material[scene->facet_material[facet]];
    double cosine = fmin(fabs(record->cos_theta), 1.0);
    double value = -HUGE_VAL; /* on the scale */
    double at[3];
    double height[2];
    switch (colouring->picture->colouring) {
    case LRCS_HOST_BY_SIGMA:
        value = facet_return(record);
        break;
    case LRCS_HOST_BY_THETA:
        if (record->cos_theta >= 0.0 || material->two_sided) {
            value = LRCS_DEGREES_PER_RADIAN * acos(cosine);
        }
        break;
    case LRCS_HOST_BY_RANGE:
        facet_plane(colouring, facet, at, height);
        value = at[0] + at[1] * (view[0] - centre_view(colouring, 0)) +
                at[2] * (view[1] - centre_view(colouring, 1));
        value = fmin(fmax(value, height[0]), height[1]);
        break;
    case LRCS_HOST_BY_FACET:
        return lrcsi_palette_distinct(facet);
    case LRCS_HOST_BY_MATERIAL:
        return lrcsi_colouring_material(colouring, scene->facet_material[facet]);
    default: {
        uint32_t own = (uint32_t)material->rgb[0] << 16 | (uint32_t)material->rgb[1] << 8 |
                       (uint32_t)material->rgb[2];
        return lrcsi_palette_shade(material->has_colour ? own : COLOUR_PLAIN, 0.12 + 0.88 * cosine);
    }
    }
    return isfinite(value) ? lrcsi_palette_viridis(lrcsi_axis_at(&colouring->scale, value))
                           : lrcsi_palette_shade(LRCSI_COLOURING_GREY, 0.375 + 0.625 * cosine);
}

int lrcsi_colouring_slope(const lrcsi_colouring *colouring, uint32_t facet, double at[3])
{
    double height[2];
    if (colouring->picture->colouring != LRCS_HOST_BY_RANGE) {
        return 0;
    }
    facet_plane(colouring, facet, at, height);
    for (int k = 0; k < 2; k++) {
        at[0] -= at[k + 1] * centre_view(colouring, k);
    }
    return hypot(at[1], at[2]) > VISIBLE_SLOPE;
}

int lrcsi_colouring_outline(const lrcsi_colouring *colouring, uint32_t a, uint32_t b)
{
    const lrcs_scene *scene = colouring->picture->scene;
    const lrcs_facet_record *records = colouring->picture->records;
    int in_a = a < scene->facet_count;
    int in_b = b < scene->facet_count;
    if (!in_a || !in_b) {
        return in_a;
    }
    int crease = colouring->picture->colouring == LRCS_HOST_BY_MATERIAL &&
                 fabs(records[a].cos_theta - records[b].cos_theta) > CREASE_COSINE;
    return crease || scene->facet_part[a] != scene->facet_part[b];
}
