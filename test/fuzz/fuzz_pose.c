/* SPDX-License-Identifier: MIT */
/* Arbitrary bytes to sigma: a few facets on small integers, which meet, coincide and pierce, some
   of them moved by an ulp or to the ends of what is allowed; materials, sides, a direction, a
   raster and too little memory, each from a byte. */
#include "fuzz_sigma.h"

#define VERTICES  12u
#define FACETS    16u
#define MATERIALS 2u

typedef struct pose_input {
    lrcs_point vertex[VERTICES];
    lrcs_facet facet[FACETS];
    uint32_t material_of[FACETS], part_of[FACETS], smooth_of[FACETS];
    lrcs_material material[MATERIALS];
    lrcs_part part;
    lrcs_scene scene;
    fuzz_run run;
} pose_input;

/* Small integers by the low four bits; by the high ones what becomes of them. */
static double take_coordinate(fuzz_input *in)
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

static void take_material(fuzz_input *in, lrcs_material *material)
{
    static const double amplitude[8] = {0, 1, 0.25, 1e-9, 1e6, 1e-300, 1e60, 0.02};
    static const double slope[8] = {0.2, 0.05, 1e-6, 1e3, 0.5, 0.9, 1e-3, 0.02};
    static const double power[8] = {0, 0.5, 1, 2, 1e4, 37.5, 1e-9, 0.25};
    unsigned one = fuzz_byte(in);
    unsigned two = fuzz_byte(in);
    *material = (lrcs_material){.name = "", .bound = 1};
    material->brdf = (lrcs_brdf){amplitude[one & 7], amplitude[one >> 3 & 7], slope[two & 7],
                                 power[two >> 3 & 7]};
    material->two_sided = one >> 6 & 1;
    material->omitted = two == 255;
}

/* Powers of two and of ten, up to where the largest coordinate stays within 1e100. */
static double take_scale(fuzz_input *in)
{
    static const double scale[8] = {1, 1, 1, 0.1, 1e-6, 1e90, 1e-200, 0x1p-40};
    return scale[fuzz_byte(in) & 7];
}

static void take_run(fuzz_input *in, fuzz_run *run, int *turned)
{
    static const uint32_t size[8] = {8, 1, 2, 3, 5, 16, 33, 64};
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
    run->polygons = effects < 128;
    *turned = effects >> 6 & 1;
    run->share = fuzz_byte(in);
}

static void take_facets(fuzz_input *in, pose_input *p)
{
    lrcs_scene *scene = &p->scene;
    while (in->at < in->end && scene->facet_count < FACETS) {
        uint32_t f = scene->facet_count++;
        for (int k = 0; k < 3; k++) {
            p->facet[f].corner[k] = fuzz_byte(in) % scene->vertex_count;
        }
        p->material_of[f] = fuzz_byte(in) % MATERIALS;
    }
    p->part.facet_count = scene->facet_count;
}

static void take_scene(fuzz_input *in, pose_input *p)
{
    for (unsigned i = 0; i < MATERIALS; i++) {
        take_material(in, &p->material[i]);
    }
    double scale = take_scale(in);
    p->part = (lrcs_part){.name = "", .kind = -1, .curvature_known = 1};
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
                            .unmatched = LRCS_NONE};
    for (uint32_t v = 0; v < p->scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            p->vertex[v].x[k] = scale * take_coordinate(in);
        }
    }
    take_facets(in, p);
}

/* The same scene twice as large, its axes renamed, its facets begun at another corner: exact. */
static void turn(pose_input *p)
{
    double direction[3];
    for (uint32_t v = 0; v < p->scene.vertex_count; v++) {
        const lrcs_point old = p->vertex[v];
        p->vertex[v] = (lrcs_point){{2 * old.x[1], 2 * old.x[2], 2 * old.x[0]}};
    }
    for (uint32_t f = 0; f < p->scene.facet_count; f++) {
        const lrcs_facet old = p->facet[f];
        p->facet[f] = (lrcs_facet){{old.corner[1], old.corner[2], old.corner[0]}};
    }
    for (int k = 0; k < 3; k++) {
        direction[k] = p->run.pose.direction[(k + 1) % 3];
    }
    require(lrcs_pose_from_direction(direction, &p->run.pose) == LRCS_OK);
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    static pose_input p;
    fuzz_input in = {data, data + size};
    int turned;
    memset(&p, 0, sizeof p);
    take_run(&in, &p.run, &turned);
    take_scene(&in, &p);
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
