/* SPDX-License-Identifier: MIT */
/* Random scenes of curved shapes among others, by families: anywhere, on a lattice, in contact,
   flush, nested with thin gaps, piercing, with a glint on a shadow's edge, scaled differently along
   the axes, of walls that share a rim. And directions to look from that spare none of them. */
#ifndef TEST_SHAPE_SCENES_H
#define TEST_SHAPE_SCENES_H

#include <lrcs/lrcs.h>

#include <math.h>

#include "random.h"

#define SHAPE_SCENE_PARTS 5
#define SHAPE_SCENE_PI    3.14159265358979323846

enum shape_scene_family {
    SHAPE_SCENE_ANYWHERE,
    SHAPE_SCENE_LATTICE,
    SHAPE_SCENE_RESTING,
    SHAPE_SCENE_FLUSH,
    SHAPE_SCENE_NESTED,
    SHAPE_SCENE_PIERCED,
    SHAPE_SCENE_GLINT,
    SHAPE_SCENE_STRETCHED,
    SHAPE_SCENE_JOINED,
    SHAPE_SCENE_FAMILIES
};

static const char *const shape_scene_name[SHAPE_SCENE_FAMILIES] = {
    "anywhere", "lattice",       "resting",   "flush", "nested",
    "pierced",  "glint on edge", "stretched", "joined"};

/* `aim` is where a glint meets an edge, or the light runs along a wall. */
typedef struct shape_scene {
    lrcs_recipe_part part[SHAPE_SCENE_PARTS];
    lrcs_recipe_material material[2];
    lrcs_recipe recipe;
    double aim[3];
    int family;
} shape_scene;

static uint64_t shape_scene_seed = 1;

static uint32_t pick(uint32_t below)
{
    return random_below(&shape_scene_seed, below);
}

static double between(double low, double high)
{
    return low + (high - low) * pick(1u << 30) / (double)(1u << 30);
}

/* On a lattice, so that things touch, or anywhere. */
static double length_of(int lattice)
{
    return lattice ? 0.25 * (1 + pick(4)) : between(0.1, 1.0);
}

/* --- turns ------------------------------------------------------------------------------------ */

static const double quarter[4][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                     {1, 0, 0, 0, 0, -1, 0, 1, 0},
                                     {0, 0, 1, 0, 1, 0, -1, 0, 0},
                                     {1, 0, 0, 0, -1, 0, 0, 0, -1}};

static void turn_by(lrcs_recipe_part *part, const double of[9])
{
    for (int i = 0; i < 9; i++) {
        part->place.rotate[i / 3][i % 3] = of[i];
    }
}

static void turn_at_random(lrcs_recipe_part *part)
{
    double q[4];
    double square = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = between(-1, 1);
        square += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= sqrt(square);
    }
    const double w = q[0];
    const double x = q[1];
    const double y = q[2];
    const double z = q[3];
    const double of[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
        2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
        2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    turn_by(part, of);
}

/* --- parts ------------------------------------------------------------------------------------ */

static lrcs_recipe_part *put(shape_scene *s, int kind, double a, double b, double c)
{
    lrcs_recipe_part *part = &s->part[s->recipe.part_count++];
    *part = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
    lrcs_shape *shape = &part->shape;
    shape->kind = kind;
    shape->parts = (int)pick(2);
    if (kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX) {
        shape->size[0] = 2 * a;
        shape->size[1] = 2 * b;
        shape->size[2] = kind == LRCS_SHAPE_BOX ? 2 * c : 0;
    } else {
        shape->radius = a;
        shape->radius2 = kind == LRCS_SHAPE_FRUSTUM ? b : 0;
        shape->length = kind >= LRCS_SHAPE_CYLINDER ? c : 0;
    }
    part->material_index = (int)pick(2);
    part->material = part->material_index ? "two" : "one";
    return part;
}

static void move(lrcs_recipe_part *part, double x, double y, double z)
{
    part->place.translate[0] = x;
    part->place.translate[1] = y;
    part->place.translate[2] = z;
}

/* Not quite touching, touching, or sunk. */
static double gap(void)
{
    static const double any[] = {0, 0, 0, 1e-12, 1e-6, 1e-3, 0.02, -1e-12, -1e-6, -1e-3, -0.02};
    return any[pick(sizeof any / sizeof *any)];
}

static void fill_at_random(shape_scene *s, int lattice, double spread)
{
    uint32_t parts = 1 + pick(4);
    for (uint32_t i = 0; i < parts; i++) {
        int kind = (int)pick(LRCS_SHAPE_KINDS);
        double a = length_of(lattice);
        double b = length_of(lattice);
        lrcs_recipe_part *part = put(s, kind, a, b, length_of(lattice));
        if (pick(3) == 0) {
            turn_at_random(part);
        } else {
            turn_by(part, quarter[pick(4)]);
        }
        for (int k = 0; k < 3; k++) {
            part->place.translate[k] =
                lattice ? 0.25 * ((int)pick(9) - 4) : between(-spread, spread);
        }
    }
}

/* What lies or stands on the plane z = 0, its place along x. */
static void place_on_plane(shape_scene *s, double x, double r)
{
    double length = length_of(0);
    double above = gap();
    lrcs_recipe_part *part;
    switch (pick(5)) {
    case 0:
        move(put(s, LRCS_SHAPE_SPHERE, r, 0, 0), x, 0, r + above);
        break;
    case 1: /* along a line */
        part = put(s, LRCS_SHAPE_CYLINDER, r, 0, length);
        turn_by(part, quarter[1]);
        move(part, x, 0.5 * length, r + above);
        break;
    case 2: { /* on its slant */
        double al = atan(r / length);
        const double of[9] = {-sin(al), 0, cos(al), 0, 1, 0, -cos(al), 0, -sin(al)};
        part = put(s, LRCS_SHAPE_CONE, r, 0, length);
        turn_by(part, of);
        move(part, x, 0, length * sin(al) + above);
        break;
    }
    case 3: /* on a point */
        part = put(s, pick(2) ? LRCS_SHAPE_CONE : LRCS_SHAPE_PARABOLOID, r, 0, length);
        turn_by(part, quarter[3]);
        move(part, x, 0, length + above);
        break;
    default:
        move(put(s, LRCS_SHAPE_DISC + (int)pick(LRCS_SHAPE_KINDS - LRCS_SHAPE_DISC), r, 0.7 * r,
                 length),
             x, 0, above);
    }
}

static void fill_on_plane(shape_scene *s)
{
    double r = length_of(1) * 0.5;
    switch (pick(3)) {
    case 0:
        put(s, LRCS_SHAPE_PLATE, between(1, 2), between(1, 2), 0);
        break;
    case 1:
        move(put(s, LRCS_SHAPE_BOX, 1, 1, 0.5), 0, 0, -0.5);
        break;
    default: /* a cylinder's top */
        move(put(s, LRCS_SHAPE_CYLINDER, 1.25, 0, 0.5), 0, 0, -0.5);
    }
    place_on_plane(s, 0, r);
    place_on_plane(s, 2 * r + gap(), r);
    if (pick(2)) { /* across both, should they lie */
        lrcs_recipe_part *part = put(s, LRCS_SHAPE_CYLINDER, 0.2, 0, 1.5);
        turn_by(part, quarter[2]);
        move(part, -0.5, 0, 2 * r + 0.2 + gap());
    }
}

/* One upon the other, with rims that agree or not, either way up. */
static void fill_flush(shape_scene *s)
{
    static const double share[] = {1, 1, 0.5, 1.5, 0.999};
    double z = 0;
    for (uint32_t i = 0; i < 2 + pick(2); i++) {
        double height = length_of(1);
        double r = 0.5 * share[pick(5)];
        int kind = LRCS_SHAPE_BOX + (int)pick(LRCS_SHAPE_KINDS - LRCS_SHAPE_BOX);
        if (kind == LRCS_SHAPE_SPHERE) {
            kind = LRCS_SHAPE_CYLINDER;
        }
        if (kind == LRCS_SHAPE_BOX) { /* sunk ones would share a side, which rays count twice */
            r *= 1 - 0.013 * i;
        }
        lrcs_recipe_part *part = put(s, kind, r, r * share[pick(5)], height);
        height = kind == LRCS_SHAPE_BOX    ? 2 * height
                 : kind == LRCS_SHAPE_DISC ? 0
                 : kind == LRCS_SHAPE_DOME ? r
                                           : height;
        int over = kind != LRCS_SHAPE_BOX && pick(3) == 0;
        turn_by(part, quarter[over ? 3 : 0]);
        move(part, 0, 0, kind == LRCS_SHAPE_BOX ? z + 0.5 * height : over ? z + height : z);
        z += height + (kind == LRCS_SHAPE_DISC ? 0.01 : 0) + (pick(2) ? gap() : 0);
    }
}

/* About one axis, thin gaps between. */
static void fill_nested(shape_scene *s)
{
    static const double thin[] = {0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-6};
    int kind = LRCS_SHAPE_SPHERE + (int)pick(LRCS_SHAPE_KINDS - LRCS_SHAPE_SPHERE);
    double r = 1;
    double length = length_of(0) * 2;
    for (uint32_t i = 0; i < 2 + pick(2); i++) {
        lrcs_recipe_part *part = put(s, kind, r, 0.6 * r, length);
        part->shape.parts = pick(4) ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
        if (pick(2)) {
            move(part, 0, 0, 0.25 * ((int)pick(5) - 2));
        }
        r *= 1 - thin[pick(6)];
        if (pick(4) == 0) {
            kind = LRCS_SHAPE_DISC + (int)pick(LRCS_SHAPE_KINDS - LRCS_SHAPE_DISC);
        }
    }
    if (pick(2)) {
        move(put(s, LRCS_SHAPE_BOX, 1.5, 0.1, 0.1), 0, 0, between(0, 0.5));
    }
}

/* The edge of a ball or a disc's shadow runs through the spot that glints at `aim`. */
static void fill_glint(shape_scene *s)
{
    double r = between(0.1, 0.6);
    double azimuth = between(0, 2 * SHAPE_SCENE_PI);
    double height = between(-0.9, 0.9);
    double across = sqrt(1 - height * height);
    int ball = pick(2) != 0;
    s->aim[0] = ball ? across * cos(azimuth) : across;
    s->aim[1] = ball ? across * sin(azimuth) : 0;
    s->aim[2] = height;
    const double aside[3] = {-s->aim[1], s->aim[0], 0};
    double spot = 1;
    if (ball) {
        put(s, LRCS_SHAPE_SPHERE, 1, 0, 0);
    } else { /* a wall glints along a line where the light is square to it */
        s->aim[0] = 1;
        s->aim[2] = 0;
        move(put(s, LRCS_SHAPE_CYLINDER, 1, 0, 1), 0, 0, -0.5);
    }
    lrcs_recipe_part *part = put(s, pick(2) ? LRCS_SHAPE_SPHERE : LRCS_SHAPE_BOX, r, r, r);
    double off = (pick(2) ? r : r * between(0.9, 1.1)) / (ball ? across : 1);
    double far = spot + between(0.5, 1.5);
    move(part, far * s->aim[0] + off * aside[0], far * s->aim[1] + off * aside[1],
         far * s->aim[2] + off * aside[2]);
}

/* The axis of the world along which the part's axis k lies, or -1 if it lies along none. */
static int axis_of(const lrcs_recipe_part *part, int k)
{
    for (int i = 0; i < 3; i++) {
        if (fabs(part->place.rotate[i][k]) == 1) {
            return i;
        }
    }
    return -1;
}

/* Scales what is there by another factor along each axis of the world, so that contacts stay; parts
   that are turned otherwise are scaled along their own axes. */
static void scale_axes(shape_scene *s)
{
    static const double any[] = {1, 1, 0.5, 2, 0.1, 0.999, 1 + 1e-9};
    double factor[3];
    for (int k = 0; k < 3; k++) {
        factor[k] = pick(3) ? any[pick(7)] : between(0.2, 2);
    }
    for (uint32_t i = 0; i < s->recipe.part_count; i++) {
        lrcs_place *place = &s->part[i].place;
        for (int k = 0; k < 3; k++) {
            int axis = axis_of(&s->part[i], k);
            place->scale[k] *= axis >= 0 ? factor[axis] : any[pick(7)];
            place->translate[k] *= factor[k];
        }
    }
}

static void fill_stretched(shape_scene *s)
{
    switch (pick(4)) {
    case 0:
        fill_on_plane(s);
        break;
    case 1:
        fill_flush(s);
        break;
    case 2:
        fill_nested(s);
        break;
    default:
        fill_at_random(s, 0, pick(2) ? 0.1 : 1);
    }
    scale_axes(s);
}

/* A wall that rises from its rim of radius r at z = 0; of a kind, or LRCS_SHAPE_KINDS: of any. */
static lrcs_recipe_part *put_wall(shape_scene *s, int kind, double r, double length)
{
    static const int any[] = {LRCS_SHAPE_DOME, LRCS_SHAPE_DOME,    LRCS_SHAPE_PARABOLOID,
                              LRCS_SHAPE_CONE, LRCS_SHAPE_FRUSTUM, LRCS_SHAPE_CYLINDER};
    kind = kind == LRCS_SHAPE_KINDS ? any[pick(6)] : kind;
    double top = kind == LRCS_SHAPE_FRUSTUM ? r * between(0.3, 1.5) : r;
    lrcs_recipe_part *part = put(s, kind, top, r, length);
    part->shape.parts = pick(4) ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
    return part;
}

/* Turns a part as `of` does, after turning it over or not. */
static void turn_over_by(lrcs_recipe_part *part, int over, const double of[9])
{
    turn_by(part, of);
    for (int i = 0; i < 6 && over; i++) {
        part->place.rotate[i / 2][1 + i % 2] *= -1;
    }
}

/* Walls that share a rim, of one material or two: one turned over, or both on the same side of it,
   or a tube between two others. Their meshes share the vertices there if they are of the same kind,
   or if the limit of facets divides them equally. Most are partly behind something at `aim`. */
static void fill_joined(shape_scene *s)
{
    lrcs_recipe_part frame;
    double of[9];
    double r = 0.5 * length_of(1);
    double length = length_of(1);
    turn_by(&frame, quarter[pick(4)]);
    if (pick(2)) {
        turn_at_random(&frame);
    }
    for (int i = 0; i < 9; i++) {
        of[i] = frame.place.rotate[i / 3][i % 3];
    }
    lrcs_recipe_part *first = put_wall(s, pick(2) ? LRCS_SHAPE_DOME : LRCS_SHAPE_KINDS, r, length);
    turn_over_by(first, 0, of);
    int kind = first->shape.kind;
    switch (pick(4)) {
    case 0: /* another one of its kind, turned over */
        turn_over_by(put_wall(s, kind, r, length), 1, of);
        break;
    case 1: /* another one, turned over */
        turn_over_by(put_wall(s, LRCS_SHAPE_KINDS, r, length_of(1)), 1, of);
        break;
    case 2: /* within it or about it */
        kind = kind == LRCS_SHAPE_PARABOLOID ? LRCS_SHAPE_DOME : LRCS_SHAPE_PARABOLOID;
        turn_over_by(put_wall(s, kind, r, length_of(1)), 0, of);
        break;
    default: /* a tube below it, and a wall at the other end of that */
        turn_over_by(put_wall(s, LRCS_SHAPE_CYLINDER, r, length), 1, of);
        lrcs_recipe_part *last = put_wall(s, pick(2) ? kind : LRCS_SHAPE_KINDS, r, length);
        turn_over_by(last, 1, of);
        move(last, -length * of[2], -length * of[5], -length * of[8]);
    }
    double square = 0;
    for (int k = 0; k < 3; k++) {
        s->aim[k] = between(-1, 1);
        square += s->aim[k] * s->aim[k];
    }
    for (int k = 0; k < 3; k++) {
        s->aim[k] /= sqrt(square);
    }
    if (pick(5)) {
        double size = r * between(0.3, 1);
        lrcs_recipe_part *front =
            put(s, pick(2) ? LRCS_SHAPE_BOX : LRCS_SHAPE_SPHERE, size, size, size);
        double far = 3 * (r + length);
        move(front, far * s->aim[0] + r * between(-1, 1), far * s->aim[1] + r * between(-1, 1),
             far * s->aim[2] + r * between(-1, 1));
    }
}

/* --- scenes and directions -------------------------------------------------------------------- */

static void shape_scene_dress(shape_scene *s)
{
    static const double slope[] = {0.02, 0.05, 0.1, 0.15, 0.3, 0.8, 2};
    int glint = s->family == SHAPE_SCENE_GLINT;
    for (int i = 0; i < 2; i++) {
        lrcs_brdf brdf = {pick(3) || glint ? between(0, 1) : 0, pick(3) ? between(0, 1) : 0,
                          slope[pick(glint ? 3 : 7)], pick(2) ? 0 : between(0, pick(4) ? 5 : 50)};
        s->material[i] =
            (lrcs_recipe_material){.name = i ? "two" : "one", .brdf = brdf, .two_sided = i};
    }
}

/* A scene of a family, some metres large. */
static void shape_scene_make(shape_scene *s, int family)
{
    *s = (shape_scene){.family = family, .aim = {1, 0, 0}};
    s->recipe = (lrcs_recipe){.part = s->part, .material = s->material, .material_count = 2};
    switch (family) {
    case SHAPE_SCENE_RESTING:
        fill_on_plane(s);
        break;
    case SHAPE_SCENE_FLUSH:
        fill_flush(s);
        break;
    case SHAPE_SCENE_NESTED:
        fill_nested(s);
        break;
    case SHAPE_SCENE_GLINT:
        fill_glint(s);
        break;
    case SHAPE_SCENE_STRETCHED:
        fill_stretched(s);
        break;
    case SHAPE_SCENE_JOINED:
        fill_joined(s);
        break;
    default:
        fill_at_random(s, family == SHAPE_SCENE_LATTICE, family == SHAPE_SCENE_PIERCED ? 0.1 : 1);
    }
    shape_scene_dress(s);
}

/* The same scene `size` times as large, mirrored through the origin where size < 0, and moved:
   how it looks from -d where mirrored, else from d, does not change. */
static void shape_scene_transform(const shape_scene *from, double size, double offset,
                                  shape_scene *s)
{
    *s = *from;
    s->recipe.part = s->part;
    s->recipe.material = s->material;
    for (uint32_t i = 0; i < s->recipe.part_count; i++) {
        for (int k = 0; k < 3; k++) {
            s->part[i].place.scale[k] *= size;
            s->part[i].place.translate[k] = size * s->part[i].place.translate[k] + offset;
        }
    }
}

/* Along axes and diagonals, nearly so, along the first part's wall, at the aim, or anywhere. */
static void shape_scene_direction(const shape_scene *s, double d[3])
{
    static const double off[] = {0, 0, 1e-2, 1e-4, 1e-7, 1e-10, 1e-14};
    uint32_t how = pick(s->family == SHAPE_SCENE_GLINT ? 3 : 5);
    double slip = off[pick(7)];
    const lrcs_recipe_part *part = &s->part[pick(s->recipe.part_count)];
    double fall = part->shape.radius - part->shape.radius2;
    double rise = part->shape.length * (pick(2) ? 1 : -1);
    double square = 0;
    while (square == 0) {
        for (int k = 0; k < 3; k++) {
            d[k] = how == 0   ? between(-1, 1)
                   : how == 1 ? s->aim[k]
                   : how == 2 ? s->aim[k] + between(-0.03, 0.03)
                   : how == 3 ? (double)pick(3) - 1
                              : part->place.rotate[k][0] * fall - part->place.rotate[k][2] * rise;
            d[k] += slip * between(-1, 1);
        }
        square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        how = square == 0 ? 0 : how;
    }
    for (int k = 0; k < 3; k++) {
        d[k] /= sqrt(square);
    }
}

#endif
