/* SPDX-License-Identifier: MIT */
/* Which parts hide nothing of another: pairs placed so that the answer is plain, whichever way the
   pair is turned, in both roles; and what rounding leaves open of the facets where they touch. */
#include "visibility/proximity/depth_order.h"

#include "base/rotate.h"
#include "base/vec3.h"
#include "pair.h"

#define ROWS(a) (sizeof(a) / sizeof(a)[0])

typedef struct order_case {
    const lrcs_shape *first, *other;
    double at[3];        /* of the other */
    double direction[3]; /* in the frame in which the first stands upright at the origin */
    int first_free;      /* the other hides nothing of the first */
    int other_free;      /* the first hides nothing of the other */
} order_case;

static const order_case order_cases[] = {
    {&post, &drum, {0, 0, -1}, {0.1, 0.2, 1}, 1, 0}, /* it stands there */
    {&post, &drum, {0, 0, -1}, {0.1, 0.2, -1}, 0, 1},
    {&post,
     &drum,
     {0, 0, -1},
     {1, 0.2, 0},
     1,
     1}, /* seen edge-on, the plane between hides nothing */
    {&post, &drum, {0, 0, -2}, {1, 0.2, 0}, 1, 1},
    {&post, &drum, {0, 0, -0.999}, {0.1, 0.2, 1}, 0, 0}, /* it is sunk in */
    {&post, &drum, {0.75, 0, -1}, {1, 0.2, 0.1}, 1, 0},  /* their walls meet */
    {&post, &drum, {0, 0, -2}, {0.1, 0.2, 1}, 1, 0},
    {&dome, &drum, {0, 0, -1}, {1, 0.2, 0.1}, 1, 0},
    {&horn, &box, {0, 0, -0.5}, {1, 0, 0.001}, 1, 0},
    {&horn, &box, {0, 0, -0.5}, {1, 0, -0.001}, 0, 1},
    {&dish, &box, {0, 0, -0.5}, {0, 0, 1}, 1, 0},
    {&dish, &box, {0, 0, 0.75}, {0, 0, 1}, 0, 1},
    {&dish, &box, {0, 0, 0.7}, {0, 0, 1}, 0, 0},
    {&box, &post, {0.75, 0, -0.5}, {-1, 0.3, 0.2}, 0, 0}, /* the facets of the post may pierce it */
    {&box, &post, {0.8, 0, -0.5}, {-1, 0.3, 0.2}, 1, 0},
    {&ball, &box, {0, 0, -2}, {0.3, 0.3, 1}, 1, 0},
    {&ball, &box, {0, 0, 0}, {0.3, 0.3, 1}, 0, 0},
    {&post, &drum, {1.3, 0, -0.2}, {1, 0.2, 0.1}, 0, 1}, /* side by side */
    {&post, &drum, {1.3, 0, -0.2}, {-1, 0.2, 0.1}, 1, 0},
    {&post, &drum, {1.2, 0, -0.2}, {-1, 0.2, 0.1}, 0, 0},  /* they intersect */
    {&ball, &ball, {0.8, 0.1, 0.7}, {-1, -0.2, -1}, 1, 0}, /* no axis separates them */
    {&horn, &dome, {2, -3, 4}, {-2, 3, -4.5}, 1, 0},       /* far behind */
};

/* Is what rounding leaves open a small fraction of every facet that is not in the plane? */
static void check_fractions(const lrcsi_order_proof *proof, const lrcs_prepared *p, uint32_t part)
{
    const lrcs_part *at = &p->scene->part[part];
    for (uint32_t f = at->first_facet; f < at->first_facet + at->facet_count; f++) {
        double fraction = lrcsi_order_unproved(proof, p, f);
        int flat = 1;
        for (int k = 0; k < 3; k++) {
            double height = lrcsi_vec3_dot(lrcsi_prepared_corner(p, f, k), proof->n);
            flat &= fabs(height - proof->level) < 1e-9;
        }
        check_most(fraction, flat ? 1 : 1e-8);
    }
}

static void order_run(const order_case *c, const double R[3][3], double shift)
{
    lrcs_scene scene;
    lrcs_work work;
    const lrcs_prepared *prepared =
        pair_prepare(c->first, c->other, c->at, R, shift, &scene, &work);
    double d[3];
    double length = sqrt(lrcsi_vec3_dot(c->direction, c->direction));
    for (int k = 0; k < 3; k++) {
        d[k] = lrcsi_vec3_dot(R[k], c->direction) / length;
    }
    lrcsi_body body[2] = {lrcsi_body_make(prepared, 0), lrcsi_body_make(prepared, 1)};
    for (int i = 0; i < 2; i++) {
        int known = i == 0 ? c->first_free : c->other_free;
        lrcsi_depth_order order = lrcsi_depth_order_make(&body[i], &body[1 - i], d);
        if (order.front_is_free.known != known || (order.back_by_outline.known && !known)) {
            fail_msg("case %ld, part %d", (long)(c - order_cases), i);
        }
        if (order.front_is_free.known) {
            check_fractions(&order.front_is_free, prepared, (uint32_t)i);
        }
        if (order.back_by_outline.known) {
            check_fractions(&order.back_by_outline, prepared, (uint32_t)(1 - i));
        }
    }
}

static void what_is_behind_hides_nothing(void **state)
{
    (void)state;
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (size_t i = 0; i < ROWS(order_cases); i++) {
        order_run(&order_cases[i], upright, 0);
    }
}

static void turning_and_moving_a_pair_changes_nothing(void **state)
{
    (void)state;
    for (int turn = 0; turn < 5; turn++) {
        double R[3][3];
        assert_int_equal(lrcsi_rotate_axis((const double[3]){0.3, -0.5, 0.8}, 10.0 + 70 * turn, R),
                         LRCS_OK);
        for (size_t i = 0; i < ROWS(order_cases); i++) {
            order_run(&order_cases[i], (const double(*)[3])R, 0.1 * turn);
        }
    }
}

/* Where two parts touch, it is not known how much of a shape is within rounding of the plane between
   them if the shape is known only by the box around it, or if its facets may lie beyond it. */
static void a_shape_whose_slab_is_not_known_may_be_hidden(void **state)
{
    (void)state;
    static const double upward[3] = {0, 0, 1};
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double below[3] = {0, 0, -0.5}; /* the dome stands on the box */
    lrcs_scene scene;
    lrcs_work work;
    for (int i = 0; i < 3; i++) {
        const lrcs_prepared *prepared = pair_prepare(&dome, &box, below, upright, 0, &scene, &work);
        lrcsi_body front = lrcsi_body_make(prepared, 0);
        lrcsi_body back = lrcsi_body_make(prepared, 1);
        assert_true(front.curved && front.part->bounds.reach > 0 && front.beyond == 0);
        front.beyond = i == 1 ? 0x1p-60 : 0;
        front.curved = i != 2;
        lrcsi_depth_order order = lrcsi_depth_order_make(&front, &back, upward);
        assert_int_equal(order.front_is_free.known, i == 0);
        if (i == 1) { /* next time the box around the dome stands there */
            below[2] += ldexp(front.extent->low[2], prepared->exponent);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_behind_hides_nothing),
        cmocka_unit_test(turning_and_moving_a_pair_changes_nothing),
        cmocka_unit_test(a_shape_whose_slab_is_not_known_may_be_hidden),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
