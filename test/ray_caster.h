/* SPDX-License-Identifier: MIT */
/* A slow ray caster over the true shapes of a recipe, sharing nothing with the library but its
   conventions: Eq. 2 by stratified samples of every surface, each with one ray to the laser. Of
   flat surfaces that coincide and face the same way, the first is seen. */
#ifndef TEST_RAY_CASTER_H
#define TEST_RAY_CASTER_H

#include <lrcs/scene.h>

#include <math.h>
#include <stdint.h>

#include "random.h"

#define CAST_PI     3.14159265358979323846
#define CAST_REPEAT 16

/* One smooth surface in its part's frame. */
enum cast_kind { CAST_RECT, CAST_DISC, CAST_WALL, CAST_BALL, CAST_BOWL };

typedef struct cast_surface {
    int kind;
    int axis;      /* RECT: the normal's axis */
    double sign;   /* RECT, DISC: of the normal */
    double at;     /* RECT, DISC: its place on the axis */
    double a, b;   /* RECT: half sides; DISC, BALL, BOWL: radius a; WALL: radii at 0, top */
    double height; /* WALL, BOWL */
    double low;    /* BALL: least z */
    const lrcs_recipe_part *part;
    const lrcs_brdf *brdf;
    int two_sided;
} cast_surface;

typedef struct cast_scene {
    cast_surface surface[48];
    int count;
    uint64_t seed;
    double most; /* the most that any sample would send back unhidden */
} cast_scene;

/* An estimate and its standard error. */
typedef struct cast_answer {
    double sigma, error;
} cast_answer;

static inline void cast_disc(cast_scene *s, cast_surface like, double radius, double at,
                             double sign)
{
    like.kind = CAST_DISC;
    like.a = radius;
    like.at = at;
    like.sign = sign;
    s->surface[s->count++] = like;
}

static inline void cast_box(cast_scene *s, cast_surface like, const double size[3])
{
    for (int axis = 0; axis < 3; axis++) {
        for (int side = -1; side < 2; side += 2) {
            like.kind = CAST_RECT;
            like.axis = axis;
            like.sign = side;
            like.at = 0.5 * side * size[axis];
            like.a = 0.5 * size[(axis + 1) % 3];
            like.b = 0.5 * size[(axis + 2) % 3];
            s->surface[s->count++] = like;
        }
    }
}

/* The surfaces of a part. A cone's height is its length here: no half angle. */
static inline void cast_part(cast_scene *s, const lrcs_recipe_part *part, const lrcs_brdf *brdf,
                             int two_sided)
{
    const lrcs_shape *shape = &part->shape;
    int capped = shape->parts == LRCS_SHAPE_ALL;
    cast_surface like = {.part = part, .brdf = brdf, .two_sided = two_sided, .a = shape->radius};
    like.height = shape->length;
    switch (shape->kind) {
    case LRCS_SHAPE_PLATE:
        like.axis = 2;
        like.sign = 1;
        like.a = 0.5 * shape->size[0];
        like.b = 0.5 * shape->size[1];
        s->surface[s->count++] = like;
        return;
    case LRCS_SHAPE_BOX:
        cast_box(s, like, shape->size);
        return;
    case LRCS_SHAPE_DISC:
        cast_disc(s, like, shape->radius, 0, 1);
        return;
    case LRCS_SHAPE_SPHERE:
    case LRCS_SHAPE_DOME:
        like.kind = CAST_BALL;
        like.low = shape->kind == LRCS_SHAPE_DOME ? 0 : -shape->radius;
        break;
    case LRCS_SHAPE_PARABOLOID:
        like.kind = CAST_BOWL;
        break;
    default:
        like.kind = CAST_WALL;
        like.a = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius2 : shape->radius;
        like.b = shape->kind == LRCS_SHAPE_CONE ? 0 : shape->radius;
        if (capped && shape->kind != LRCS_SHAPE_CONE) {
            cast_disc(s, like, like.b, like.height, 1);
        }
    }
    s->surface[s->count++] = like;
    if (capped && shape->kind != LRCS_SHAPE_SPHERE) {
        cast_disc(s, like, like.a, 0, -1);
    }
}

/* v turned into the part's frame; and back. */
static inline void cast_into(const cast_surface *f, const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = f->part->place.rotate[0][k] * v[0] + f->part->place.rotate[1][k] * v[1] +
                 f->part->place.rotate[2][k] * v[2];
    }
}

static inline void cast_out_of(const cast_surface *f, const double v[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        const double *row = f->part->place.rotate[k];
        out[k] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    }
}

/* Is the point within the surface's extent, given that it lies on the whole plane or quadric? */
static inline int cast_within(const cast_surface *f, const double x[3])
{
    switch (f->kind) {
    case CAST_RECT:
        return fabs(x[(f->axis + 1) % 3]) <= f->a && fabs(x[(f->axis + 2) % 3]) <= f->b;
    case CAST_DISC:
        return x[0] * x[0] + x[1] * x[1] <= f->a * f->a;
    case CAST_BALL:
        return x[2] >= f->low;
    case CAST_BOWL:
        return x[2] >= 0;
    default:
        return x[2] >= 0 && x[2] <= f->height;
    }
}

/* Coefficients of the quadric q2 t^2 + 2 q1 t + q0 along o + t d. */
static inline void cast_quadric(const cast_surface *f, const double o[3], const double d[3],
                                double q[3])
{
    double k = 0;
    q[2] = d[0] * d[0] + d[1] * d[1];
    q[1] = o[0] * d[0] + o[1] * d[1];
    q[0] = o[0] * o[0] + o[1] * o[1];
    switch (f->kind) {
    case CAST_BALL:
        q[2] += d[2] * d[2];
        q[1] += o[2] * d[2];
        q[0] += o[2] * o[2] - f->a * f->a;
        return;
    case CAST_BOWL: /* x^2 + y^2 - R^2 (1 - z / H) */
        k = f->a * f->a / f->height;
        q[1] += 0.5 * k * d[2];
        q[0] += k * o[2] - f->a * f->a;
        return;
    default: /* x^2 + y^2 - (a + k z)^2 */
        k = (f->b - f->a) / f->height;
        q[2] -= k * k * d[2] * d[2];
        q[1] -= k * d[2] * (f->a + k * o[2]);
        q[0] -= (f->a + k * o[2]) * (f->a + k * o[2]);
    }
}

/* Does the ray from `from` along d meet the surface beyond `least`? */
static inline int cast_meets(const cast_surface *f, const double from[3], const double d[3],
                             double least)
{
    double moved[3];
    double o[3];
    double v[3];
    double root[2] = {-1, -1};
    for (int k = 0; k < 3; k++) {
        moved[k] = from[k] - f->part->place.translate[k];
    }
    cast_into(f, moved, o);
    cast_into(f, d, v);
    for (int k = 0; k < 3; k++) {
        o[k] /= f->part->place.scale[k];
        v[k] /= f->part->place.scale[k];
    }
    if (f->kind == CAST_RECT || f->kind == CAST_DISC) {
        int axis = f->kind == CAST_DISC ? 2 : f->axis;
        root[0] = v[axis] != 0 ? (f->at - o[axis]) / v[axis] : -1;
    } else {
        double q[3];
        cast_quadric(f, o, v, q);
        double inside = q[1] * q[1] - q[2] * q[0];
        if (inside < 0) {
            return 0;
        }
        double w = -(q[1] + (q[1] < 0 ? -sqrt(inside) : sqrt(inside)));
        root[0] = q[2] != 0 ? w / q[2] : -1;
        root[1] = w != 0 ? q[0] / w : -1;
    }
    for (int i = 0; i < 2; i++) {
        double x[3] = {o[0] + root[i] * v[0], o[1] + root[i] * v[1], o[2] + root[i] * v[2]};
        if (root[i] > least && cast_within(f, x)) {
            return 1;
        }
    }
    return 0;
}

/* The point at u, v in 0 .. 1, its outward normal, and area per unit of u v, in the part's frame.
 */
static inline double cast_point(const cast_surface *f, double u, double v, double x[3], double n[3])
{
    double angle = 2 * CAST_PI * v;
    double c = cos(angle);
    double s = sin(angle);
    double r = f->a * sqrt(u);
    double k = f->kind == CAST_WALL ? (f->b - f->a) / f->height : 0;
    double steep = f->kind == CAST_BOWL ? 2 * f->height * sqrt(u) / f->a : 0;
    switch (f->kind) {
    case CAST_RECT:
        for (int i = 0; i < 3; i++) {
            n[i] = i == f->axis ? f->sign : 0;
        }
        x[f->axis] = f->at;
        x[(f->axis + 1) % 3] = f->a * (2 * u - 1);
        x[(f->axis + 2) % 3] = f->b * (2 * v - 1);
        return 4 * f->a * f->b;
    case CAST_DISC:
        x[0] = r * c;
        x[1] = r * s;
        x[2] = f->at;
        n[0] = n[1] = 0;
        n[2] = f->sign;
        return CAST_PI * f->a * f->a;
    case CAST_BALL:
        x[2] = f->low + u * (f->a - f->low);
        r = sqrt(fmax(0, f->a * f->a - x[2] * x[2]));
        x[0] = r * c;
        x[1] = r * s;
        for (int i = 0; i < 3; i++) {
            n[i] = x[i] / f->a;
        }
        return 2 * CAST_PI * f->a * (f->a - f->low);
    case CAST_BOWL:
        x[0] = r * c;
        x[1] = r * s;
        x[2] = f->height * (1 - u);
        n[0] = steep * c / sqrt(1 + steep * steep);
        n[1] = steep * s / sqrt(1 + steep * steep);
        n[2] = 1 / sqrt(1 + steep * steep);
        return CAST_PI * f->a * f->a * sqrt(1 + steep * steep);
    default:
        x[2] = f->height * u;
        r = f->a + k * x[2];
        x[0] = r * c;
        x[1] = r * s;
        n[0] = c / sqrt(1 + k * k);
        n[1] = s / sqrt(1 + k * k);
        n[2] = -k / sqrt(1 + k * k);
        return 2 * CAST_PI * r * f->height * sqrt(1 + k * k);
    }
}

/* f_r cos^2. */
static inline double cast_reflect(const lrcs_brdf *brdf, double cosine)
{
    double tan2 = 1 / (cosine * cosine) - 1;
    double glint = brdf->A > 0 ? brdf->A * exp(-tan2 / brdf->s / brdf->s) / pow(cosine, 4) : 0;
    return glint + brdf->B * pow(cosine, brdf->m + 2);
}

/* Is a surface flat, with this normal? */
static inline int cast_is_level(const cast_surface *f, const double normal[3])
{
    const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double own[3];
    if (f->kind != CAST_RECT && f->kind != CAST_DISC) {
        return 0;
    }
    cast_out_of(f, axes[f->kind == CAST_DISC ? 2 : f->axis], own);
    return f->sign * (own[0] * normal[0] + own[1] * normal[1] + own[2] * normal[2]) > 1 - 1e-12;
}

/* What one point sends back, per unit of u v. */
static inline double cast_sample(cast_scene *s, const cast_surface *f, double u, double v,
                                 const double d[3])
{
    double x[3];
    double n[3];
    double from[3];
    double normal[3];
    const double *scale = f->part->place.scale;
    double area = cast_point(f, u, v, x, n) * fabs(scale[0] * scale[1] * scale[2]);
    double length = 0; /* normals go by the inverse transpose, areas with them */
    for (int k = 0; k < 3; k++) {
        x[k] *= scale[k];
        n[k] /= scale[k];
        length += n[k] * n[k];
    }
    area *= sqrt(length);
    for (int k = 0; k < 3; k++) {
        n[k] /= sqrt(length);
    }
    cast_out_of(f, x, from);
    cast_out_of(f, n, normal);
    double cosine = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
    if (cosine <= 0 && !f->two_sided) {
        return 0;
    }
    cosine = fabs(cosine);
    for (int k = 0; k < 3; k++) {
        from[k] += f->part->place.translate[k];
    }
    if (!(cosine > 1e-9)) {
        return 0;
    }
    double sent = 4 * CAST_PI * area * cast_reflect(f->brdf, cosine);
    s->most = fmax(s->most, sent);
    for (int i = 0; i < s->count; i++) { /* beyond where its own surface starts the ray */
        int is_same_plane = &s->surface[i] < f && cast_is_level(&s->surface[i], normal);
        if (cast_meets(&s->surface[i], from, d, (is_same_plane ? -1e-9 : 1e-9) / cosine)) {
            return 0;
        }
    }
    return sent;
}

/* Eq. 2 from the unit direction d: `side` squared samples of each surface, CAST_REPEAT times. The
   error is that of the mean of independent repeats, and at least what one sample weighs: so much
   may be seen, or hidden, where no sample fell. Light more grazing than 1e-9 is left out. */
static inline cast_answer cast_run(cast_scene *s, const double d[3], int side)
{
    double got[CAST_REPEAT];
    double mean = 0;
    double squares = 0;
    s->most = 0;
    for (int repeat = 0; repeat < CAST_REPEAT; repeat++) {
        double sigma = 0;
        for (int i = 0; i < s->count * side * side; i++) {
            double u = (i / s->count % side + random_unit(&s->seed)) / side;
            double v = (i / s->count / side + random_unit(&s->seed)) / side;
            sigma += cast_sample(s, &s->surface[i % s->count], u, v, d) / side / side;
        }
        got[repeat] = sigma;
        mean += sigma / CAST_REPEAT;
    }
    for (int repeat = 0; repeat < CAST_REPEAT; repeat++) {
        squares += (got[repeat] - mean) * (got[repeat] - mean);
    }
    double spread = sqrt(squares / CAST_REPEAT / (CAST_REPEAT - 1));
    double one = s->most / side / side / CAST_REPEAT;
    return (cast_answer){mean, spread + one + 1e-15};
}

#endif
