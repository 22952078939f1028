/* SPDX-License-Identifier: MIT */
/* Arbitrary bytes to sigma: a few facets on small integers, which meet, coincide and pierce, some
   of them moved by an ulp or to the ends of what is allowed; materials, sides, curved normals where
   they are wanted, a direction, a raster and too little memory, each from a byte. */
#ifndef TEST_FUZZ_POSE_H
#define TEST_FUZZ_POSE_H

#include "fuzz_sigma.h"

#define VERTICES  12u
#define FACETS    16u
#define MATERIALS 2u

typedef struct pose_input {
    lrcs_point vertex[VERTICES];
    lrcs_facet facet[FACETS];
    uint32_t material_of[FACETS], part_of[FACETS], smooth_of[FACETS];
    lrcs_point normal[3 * FACETS];
    lrcs_material material[MATERIALS];
    lrcs_part part;
    lrcs_scene scene;
    fuzz_run run;
} pose_input;

/* Small integers by the low four bits; by the high ones what becomes of them. */
static inline double take_coordinate(fuzz_input *in)
{
    unsigned byte = fuzz_byte(in);
    double whole = (double)(byte & 15) - 7;
    switch (byte >> 4) {
    case 8:
        return whole * (1 + DBL_EPSILON);
    case 9:
        return whole * (1 - DBL_EPSILON);
    case 10:
        return whole + 1e-9;
    case 11:
        return whole * 1e-12;
    case 12:
        return whole / 3;
    case 13:
        return whole * 1e6;
    case 14:
        return whole * 1e-100;
    case 15:
        return whole * 1e-320;
    default:
        return whole;
    }
}

static inline void take_material(fuzz_input *in, lrcs_material *material)
{
    static const double amplitude[8] = {0, 1, 0.25, 1e-9, 1e6, 1e-300, 1e60, 0.02};
    static const double slope[8] = {0.2, 0.05, 1e-6, 1e3, 0.5, 0.9, 1e-3, 0.02};
    static const double power[8] = {0, 0.5, 1, 2, 1e4, 37.5, 1e-9, 0.25};
    unsigned one = fuzz_byte(in);
    unsigned two = fuzz_byte(in);
    *material = (lrcs_material){.name = "", .brdf_given = 1};
    material->brdf = (lrcs_brdf){amplitude[one & 7], amplitude[one >> 3 & 7], slope[two & 7],
                                 power[two >> 3 & 7]};
    material->two_sided = one >> 6 & 1;
    material->omitted = two == 255;
}

/* Powers of two and of ten, up to where the largest coordinate stays within 1e100. */
static inline double take_scale(fuzz_input *in)
{
    static const double scale[8] = {1, 1, 1, 0.1, 1e-6, 1e90, 1e-200, 0x1p-40};
    return scale[fuzz_byte(in) & 7];
}

/* Runs two methods, that of the options and another one, or sometimes all; and one more test: too
   little memory, the scene with its axes renamed, polygons, or few steps. */
static inline void take_choices(unsigned effects, unsigned share, fuzz_run *run, int *turned)
{
    unsigned other = ((unsigned)run->options.method + 1 + share % 3) & 3;
    run->methods = share == 255 ? 15 : 1u << run->options.method | 1u << other;
    run->share = share;
    run->options.accept = (int)(share >> 2 & 3) % 3;
    run->short_memory = effects >> 4 & 1;
    *turned = (effects >> 6 & 1) && fuzz_chosen(!run->short_memory);
    run->polygons = (effects >> 7 & 1) && !run->short_memory && !*turned;
    run->hurried = !run->short_memory && !run->polygons && share % 4 == 0;
}

static inline void take_run(fuzz_input *in, fuzz_run *run, int *turned)
{
    static const uint32_t size[8] = {8, 1, 2, 3, 5, 4, 16, 33};
    double direction[3];
    for (int k = 0; k < 3; k++) {
        direction[k] = take_coordinate(in);
    }
    if (lrcs_pose_from_direction(direction, &run->pose) != LRCS_OK) {
        run->pose = lrcs_pose_default();
    }
    unsigned how = fuzz_byte(in);
    run->options = lrcs_run_options_default();
    run->options.method = (int)(how & 3);
    run->options.resolution = size[how >> 2 & 7];
    run->options.tolerance = how & 32 ? 1e-9 : 1e-2;
    unsigned effects = fuzz_byte(in);
    run->options.without = how & 64 ? effects & LRCS_EFFECTS_SWITCHED : 0;
    run->options.with = how & 128 ? effects & LRCS_EFFECTS_SWITCHED & ~run->options.without : 0;
    take_choices(effects, fuzz_byte(in), run, turned);
}

/* A normal at a corner: most are unit vectors in front of their facet, as a scene promises them;
   others are on a lattice, of any length up to what is let in, 0 among them. */
static inline lrcs_point take_normal(fuzz_input *in, const double own[3])
{
    unsigned byte = fuzz_byte(in);
    double length = 0;
    lrcs_point n;
    for (int k = 0; k < 3; k++, byte /= 3) {
        n.x[k] = (double)(byte % 3) - 1;
    }
    for (int k = 0; k < 3 && byte < 8; k++) {
        n.x[k] = own[k] + ldexp(n.x[k], -(int)byte);
        length = hypot(length, n.x[k]);
    }
    for (int k = 0; k < 3 && length > 0; k++) {
        n.x[k] /= length;
    }
    return n;
}

/* The unit normal of a facet; zero where it has no area or lies beyond plain arithmetic. */
static inline void own_normal(const pose_input *p, uint32_t f, double n[3])
{
    const double *a = p->vertex[p->facet[f].corner[0]].x;
    const double *b = p->vertex[p->facet[f].corner[1]].x;
    const double *c = p->vertex[p->facet[f].corner[2]].x;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
        length = hypot(length, n[k]);
    }
    for (int k = 0; k < 3; k++) {
        n[k] = length > 0 && isfinite(length) ? n[k] / length : 0;
    }
}

static inline void take_facets(fuzz_input *in, pose_input *p)
{
    lrcs_scene *scene = &p->scene;
    while (in->at < in->end && scene->facet_count < FACETS) {
        uint32_t f = scene->facet_count++;
        for (int k = 0; k < 3; k++) {
            p->facet[f].corner[k] = fuzz_byte(in) % scene->vertex_count;
        }
        unsigned byte = fuzz_byte(in);
        p->material_of[f] = byte % MATERIALS;
        if (scene->corner_normal && byte < 128) {
            double own[3];
            own_normal(p, f, own);
            for (int k = 0; k < 3; k++) {
                p->normal[3 * f + (unsigned)k] = take_normal(in, own);
            }
        }
    }
    p->part.facet_count = scene->facet_count;
}

static inline void take_scene(fuzz_input *in, int curved, pose_input *p)
{
    for (unsigned i = 0; i < MATERIALS; i++) {
        take_material(in, &p->material[i]);
    }
    double scale = take_scale(in);
    p->part = (lrcs_part){.name = "", .kind = -1, .bounds.known = 1};
    p->scene = (lrcs_scene){.vertex_count = 3 + fuzz_byte(in) % (VERTICES - 2),
                            .material_count = MATERIALS,
                            .part_count = 1,
                            .vertex = p->vertex,
                            .facet = p->facet,
                            .facet_material = p->material_of,
                            .facet_part = p->part_of,
                            .facet_smooth = p->smooth_of,
                            .material = p->material,
                            .part = &p->part,
                            .normals = curved ? LRCS_NORMALS_SMOOTH : LRCS_NORMALS_FLAT,
                            .corner_normal = curved ? p->normal : NULL,
                            .unmatched = LRCS_NONE};
    for (uint32_t v = 0; v < p->scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            p->vertex[v].x[k] = scale * take_coordinate(in);
        }
    }
    take_facets(in, p);
}

/* The same scene twice as large, its axes renamed, its facets begun at another corner: exact. */
static inline void turn(pose_input *p)
{
    double direction[3];
    for (uint32_t v = 0; v < p->scene.vertex_count; v++) {
        const lrcs_point old = p->vertex[v];
        p->vertex[v] = (lrcs_point){{2 * old.x[1], 2 * old.x[2], 2 * old.x[0]}};
    }
    for (uint32_t f = 0; f < p->scene.facet_count; f++) {
        const lrcs_facet old = p->facet[f];
        p->facet[f] = (lrcs_facet){{old.corner[1], old.corner[2], old.corner[0]}};
        const lrcs_point first = p->normal[3 * f];
        for (uint32_t k = 0; k < 3; k++) {
            const lrcs_point n = k < 2 ? p->normal[3 * f + k + 1] : first;
            p->normal[3 * f + k] = (lrcs_point){{n.x[1], n.x[2], n.x[0]}};
        }
    }
    for (int k = 0; k < 3; k++) {
        direction[k] = p->run.pose.direction[(k + 1) % 3];
    }
    require(lrcs_pose_from_direction(direction, &p->run.pose) == LRCS_OK);
}

static inline int fuzz_pose(const unsigned char *data, size_t size, int curved)
{
    static pose_input p;
    fuzz_input in = {data, data + size};
    int turned;
    memset(&p, 0, sizeof p);
    take_run(&in, &p.run, &turned);
    take_scene(&in, curved, &p);
    if (curved) { /* a cubature to 1e-10 may take seconds */
        p.run.options.tolerance = fmax(p.run.options.tolerance, 1e-2);
    }
    fuzz_truth truth = fuzz_scene(&p.scene, &p.run);
    if (turned) {
        turn(&p);
        fuzz_truth other = fuzz_scene(&p.scene, &p.run);
        truth.low = fmaxl(4 * truth.low, other.low);
        truth.high = fminl(4 * truth.high, other.high);
        require_truth(&truth);
    }
    return 0;
}

#endif
