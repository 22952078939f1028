/* SPDX-License-Identifier: MIT */
/* One facet at a time: what is visible of it comes as pieces whose area is that of the answer. */
#include "visibility/occlude.h"

#include "scenes.h"
#include "visibility/uniform/query.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;

/* A level plate of two facets at height 0, seen from above, and whatever else was put there. */
static lrcsi_occlusion *open_scene(void)
{
    lrcs_pose pose;
    lrcsi_occlusion *o;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
    return o;
}

static void start(void)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
}

/* The area of all pieces, their count in *pieces; the facet's area as answered in *answer. */
static double pieces_area(lrcsi_occlusion *o, uint32_t facet, uint32_t *pieces, double *answer)
{
    double area = 0;
    *pieces = 0;
    size_t used = work.used;
    lrcsi_occlude_open(o, facet);
    while (lrcsi_occlude_next(o)) {
        area += lrcsi_clip_area(&o->single.piece);
        ++*pieces;
    }
    assert_false(lrcsi_occlude_next(o));
    *answer = lrcsi_prepared_area(view.prepared, lrcsi_occlude_close(o).area);
    assert_int_equal(work.used, used);
    return lrcsi_prepared_area(view.prepared, area);
}

static void whole_facet_is_its_own_triangle(void **state)
{
    (void)state;
    uint32_t pieces;
    double answer;
    start();
    lrcsi_occlusion *o = open_scene();
    check_rel(pieces_area(o, 1, &pieces, &answer), 0.5, 1e-15);
    assert_int_equal(pieces, 1);
    lrcsi_occlude_open(o, 1);
    assert_true(lrcsi_occlude_next(o));
    assert_int_equal(o->single.piece.count, 3);
    assert_memory_equal(o->single.piece.corner, o->single.target.corner,
                        sizeof o->single.target.corner);
    assert_int_equal(o->single.target.facet, 1);
    lrcsi_occlude_close(o);
}

static void hidden_and_edge_on_facets_have_no_pieces(void **state)
{
    (void)state;
    uint32_t pieces;
    double answer;
    start();
    scene_plate(&scene, (const double[3]){-1, -1, 2}, (const double[3]){4, 0, 0},
                (const double[3]){0, 4, 0});
    scene_plate(&scene, (const double[3]){5, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 0, 1});
    lrcsi_occlusion *o = open_scene();
    static const uint32_t none[] = {0, 1, 4, 5};
    for (int i = 0; i < 4; i++) {
        check_same(pieces_area(o, none[i], &pieces, &answer), 0);
        check_same(answer, 0);
        assert_int_equal(pieces, 0);
    }
}

/* A grid of plates, many more than a cell takes: each hides what it covers. */
static void pieces_of_an_undecided_facet_add_up_to_its_area(void **state)
{
    (void)state;
    uint32_t pieces;
    double answer;
    start();
    for (int i = 0; i < 64; i++) {
        scene_plate(&scene, (const double[3]){0.125 * (i % 8), 0.125 * (i / 8), 1},
                    (const double[3]){0.0625, 0, 0}, (const double[3]){0, 0.0625, 0});
    }
    lrcsi_occlusion *o = open_scene();
    double first = pieces_area(o, 0, &pieces, &answer);
    check_same(answer, first);
    assert_true(pieces > 20);
    double second = pieces_area(o, 1, &pieces, &answer);
    check_same(answer, second);
    check_rel(first + second, 0.75, 1e-14);
    check_same(pieces_area(o, 0, &pieces, &answer), first); /* however often it is computed */
    check_same(answer, first);
}

/* --- one facet in front of another, by hand --------------------------------------------------- */

/* What is seen of facet 0, as a share of its projected area, and by how much that may be off. */
static double share_left(const double direction[3], double *error)
{
    lrcs_pose pose;
    lrcsi_occlusion *o;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
    lrcsi_occlude_open(o, 0);
    lrcsi_visible_area seen = lrcsi_occlude_area(o);
    double whole = lrcsi_view_incidence(&view, 0).projected;
    *error = (seen.high - seen.low) / whole;
    return seen.area / whole;
}

/* Facet 0: (0,0,0) (4,0,0) (0,4,0), front up; facet 1 as given. */
static void start_pair(const double a[3], const double b[3], const double c[3])
{
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                   (const double[3]){0, 4, 0});
    scene_triangle(&scene, a, b, c);
}

static const double up[3] = {0, 0, 1};

static void facet_in_front_hides_its_shadow(void **state)
{
    (void)state;
    double error;
    start_pair((const double[3]){1, 1, 2}, (const double[3]){2, 1, 2}, (const double[3]){1, 2, 1});
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    check_most(error, 1e-12);
    scene_invert(&scene, 1); /* from either side */
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    /* From (-1, 0, 1) the shadow of a level facet at height 1 lies 1 further along x. */
    start_pair((const double[3]){1, 0, 1}, (const double[3]){3, 0, 1}, (const double[3]){1, 2, 1});
    check_rel(share_left((const double[3]){-1, 0, 1}, &error), 6 / 8.0, 1e-14);
    check_rel(share_left((const double[3]){1, 0, 1}, &error), 6 / 8.0, 1e-14);
}

/* Corners at heights 1, 1 and -1: the side to the lower corner passes the plane half-way. */
static void piercing_facet_hides_only_what_its_upper_part_covers(void **state)
{
    (void)state;
    double error;
    start_pair((const double[3]){0, 0, 1}, (const double[3]){2, 0, 1}, (const double[3]){0, 2, -1});
    check_rel(share_left(up, &error), 1 - 1.5 / 8, 1e-14); /* 2 less its upper half-sized tip */
    check_most(error, 1e-12);
    start_pair((const double[3]){0, 0, -1}, (const double[3]){2, 0, -1},
               (const double[3]){0, 2, 1});
    check_rel(share_left(up, &error), 1 - 0.5 / 8, 1e-14);
    start_pair((const double[3]){0, 0, 1}, (const double[3]){2, 0, -1},
               (const double[3]){0, 2, -3});
    check_rel(share_left(up, &error), 1 - 2 * 0.5 * 0.25 / 8, 1e-14); /* cut at 1/2 and 1/4 */
}

static void facets_behind_beside_or_in_contact_hide_nothing(void **state)
{
    (void)state;
    double error;
    static const double none[][3][3] = {
        {{1, 1, -1}, {2, 1, -2}, {1, 2, -1}}, /* behind */
        {{4, 0, 1}, {8, 0, 1}, {4, 4, 1}},    /* beside: touches a corner in projection */
        {{4, 0, 1}, {4, 4, 1}, {0, 4, 1}},    /* beyond the hypotenuse */
        {{1, 1, 0}, {2, 1, -1}, {1, 2, -1}},  /* behind, a corner on the plane */
        {{1, 1, 0}, {2, 1, 0}, {1, 2, -1}},   /* behind, a side on the plane */
        {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}},    /* in the plane, of higher index */
        {{0, 0, 0}, {0, 4, 0}, {-1, 0, 3}}};  /* a wall on the target's side, leaning out */
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        start_pair(none[i][0], none[i][1], none[i][2]);
        check_rel(share_left(up, &error), 1.0, 1e-15);
        check_most(error, 1e-12);
    }
    start_pair((const double[3]){1, 1, 0}, (const double[3]){2, 1, 0}, (const double[3]){1, 2, 1});
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14); /* in front, a side on the plane */
}

/* Facets 1 and 2 are one surface through the plate, folded so that 2 is seen edge-on, but for
   2^-49: what it has in front of the plate lies along the line in which the two meet, and far
   beyond the end of that. Its free edge there is where the surface ends all the same. */
static void the_edge_of_a_facet_seen_edge_on_ends_its_surface(void **state)
{
    (void)state;
    static const uint32_t wound[][3] = {{0, 1, 2}, {0, 2, 1}};
    for (int n = 0; n < 4; n++) {
        double error;
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                       (const double[3]){0, 4, 0});
        uint32_t v = scene_vertex(&scene, 1, 1, -1);
        scene_vertex(&scene, 0.25, 0.5, 1);
        scene_vertex(&scene, 1, 0.5, 1);
        scene_vertex(&scene, 1 + 0x1p-49, 1.5, -1);
        static const uint32_t fold[][3] = {{0, 1, 2}, {0, 2, 3}};
        for (int i = 0; i < 2; i++) {
            const uint32_t *f = fold[n < 2 ? i : 1 - i];
            const uint32_t *turn = wound[n % 2];
            scene_facet(&scene, v + f[turn[0]], v + f[turn[1]], v + f[turn[2]]);
        }
        /* Cut half-way between heights 1 and -1: a trapezoid 0.25 high, 0.75 and 0.375 wide. */
        check_rel(share_left(up, &error), 1 - 0.25 * 0.5625 / 8, 1e-14);
        check_most(error, 1e-12);
    }
}

/* Facet 1 passes through a corner of facet 0 with a side, and lies above it although the plane of
   either parts the other's corners; no two of their sides cross in the view. Facet 0 is as wide as
   1 and as long as given. */
static void order_follows_from_corners_on_sides_of_a_needle_too(void **state)
{
    (void)state;
    for (int n = 3; n <= 45; n += 6) {
        double length = ldexp(1, n);
        double error;
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){7, 6, 6}, (const double[3]){7, 6 + length, 6},
                       (const double[3]){6, 7, 7});
        scene_triangle(&scene, (const double[3]){-4, 7, 7}, (const double[3]){7, 6, 6 + length},
                       (const double[3]){7, 7, 7});
        check_abs(share_left(up, &error), 1 - 1 / length, 1e-14);
        check_most(error, 1e-11);
    }
}

/* A fin through a plate, both seen at e from edge-on: of the fin's height z <= 0, the plate in
   front of it, which ends at y = 3, hides what is above -e (3 - y). At height z the fin has -2 < y
   < 2 z of 4 in all: 8 e of that is hidden, but for e^2. */
static void a_fin_through_a_plate_when_both_are_seen_edge_on(void **state)
{
    (void)state;
    for (int n = 22; n <= 46; n += 3) {
        double e = ldexp(1, -n);
        double error;
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0.125, -2, -1}, (const double[3]){0.5, 2, 1},
                       (const double[3]){0.5, -2, 1});
        scene_triangle(&scene, (const double[3]){-9, 3, 0}, (const double[3]){9, 3, 0},
                       (const double[3]){0, -9, 0});
        for (int i = 0; i < 2; i++) {
            double left = share_left((const double[3]){0, 1, e}, &error);
            check_abs(left, 1 - 2 * e, 16 * e * e + error);
            check_most(error, 1e-11);
            scene_invert(&scene, 1);
        }
    }
}

static void front_skin_hides_a_back_in_its_plane(void **state)
{
    (void)state;
    double error;
    start_pair((const double[3]){1, 1, 0}, (const double[3]){2, 1, 0}, (const double[3]){1, 2, 0});
    scene.facet[0] = (lrcs_facet){{0, 2, 1}}; /* the target now faces away */
    check_rel(share_left(up, &error), 15 / 16.0, 1e-14);
    check_most(error, 1e-12);
    scene_invert(&scene, 1);
    check_same(share_left(up, &error), 1);
}

/* Planes that meet at 1e-9: the cut is where exact arithmetic puts it, and the error states its
   position error. */
static void shallow_cuts_state_their_position_err(void **state)
{
    (void)state;
    for (int power = 1; power <= 50; power += 7) {
        double e = ldexp(1, -power);
        double error;
        start_pair((const double[3]){0, 0, e}, (const double[3]){2, 0, e},
                   (const double[3]){0, 2, -e});
        double left = share_left(up, &error);
        check_abs(left, 1 - 1.5 / 8, 1e-13);
        check_most(fabs(left - (1 - 1.5 / 8)), error);
        check_most(error, 1e-12);
    }
}

/* Needles an ulp wide through the target's plane, many of which rounding turns over in the view. */
static void needles_turned_over_by_rounding_hide_nothing(void **state)
{
    (void)state;
    uint64_t seed = 3;
    double worst = 0;
    for (int i = 0; i < 4000; i++) {
        double length = ldexp(1, -(int)random_below(&seed, 30));
        double angle = 0.001 * random_below(&seed, 6283);
        double error;
        const double a[3] = {0.7 + 0.0001 * i, 1.3 - 0.0001 * i, 0.3 * length};
        double b[3] = {a[0] + length * cos(angle), a[1] + length * sin(angle), -0.7 * length};
        double c[3] = {nextafter(b[0], 9), b[1], b[2]};
        const double from[3] = {0.3 + 0.00007 * i, -0.1, 1};
        start_pair(a, b, c);
        double hidden = 1 - share_left(from, &error);
        worst = fmax(worst, hidden - error);
        check_most(error, 1e-11);
    }
    check_most(worst, 4e-16);
}

/* Facet 0, in the plane y = 0, and half of its length under a plate, as a needle seen from
   (0, w, 1). */
static void start_needle(void)
{
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 1},
                   (const double[3]){1, 0, 0});
    scene_plate(&scene, (const double[3]){0.5, -1, 2}, (const double[3]){1, 0, 0},
                (const double[3]){0, 2, 0});
}

/* What is left is 3/4 of it, however narrow, and comes in pieces. */
static void a_needle_shows_its_share_in_pieces(void **state)
{
    (void)state;
    for (int n = 24; n <= 52; n += 4) {
        const double from[3] = {0, ldexp(1, -n), 1};
        const double truth = 0.75 * 0.5 * from[1] / hypot(1, from[1]);
        double error = 0;
        lrcsi_occlusion *o;
        start_needle();
        check_abs(share_left(from, &error), 0.75, 1e-14);
        check_most(error, 1e-12);
        assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
        lrcsi_occlude_open(o, 0);
        double area = 0;
        while (lrcsi_occlude_next(o)) {
            area += lrcsi_clip_area(&o->single.piece);
        }
        double err = lrcsi_occlude_piece_err(o);
        lrcsi_visible_area seen = lrcsi_occlude_close(o);
        check_most(err, 1e-14);
        err = lrcsi_prepared_area(view.prepared, seen.high - seen.low + err);
        check_abs(lrcsi_prepared_area(view.prepared, area), truth, err);
        assert_true(seen.area > 0);
    }
}

/* A facet that is hidden, but with an edge of another one before it, after a needle whose pieces
   have errors. */
static void a_facet_without_pieces_has_no_errors_of_pieces(void **state)
{
    (void)state;
    double error;
    lrcsi_occlusion *o;
    start_needle();
    uint32_t hidden = scene.scene.facet_count;
    scene_triangle(&scene, (const double[3]){4, 0, 0}, (const double[3]){5, 0, 0},
                   (const double[3]){4, 1, 0});
    scene_plate(&scene, (const double[3]){4.25, -1, 1}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1.5, 0});
    scene_plate(&scene, (const double[3]){3, -1, 2}, (const double[3]){3, 0, 0},
                (const double[3]){0, 3, 0});
    (void)share_left((const double[3]){0, 0x1p-30, 1}, &error);
    assert_true(classification.undecided[hidden]);
    assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
    lrcsi_occlude_open(o, 0);
    while (lrcsi_occlude_next(o)) {
    }
    assert_true(o->single.piece_err > 0 && lrcsi_occlude_piece_err(o) > o->single.piece_err);
    (void)lrcsi_occlude_close(o);
    assert_int_equal(lrcsi_occlude_open(o, hidden), 0); /* one surface hides it: no cells */
    assert_false(lrcsi_occlude_next(o));
    check_same(lrcsi_occlude_piece_err(o), 0);
    check_same(lrcsi_occlude_close(o).high, 0);
}

/* --- many ------------------------------------------------------------------------------------- */

enum { SECTORS = 256 };

/* A plate of two facets below a disc of many sectors. */
static void fan_over_plate(void)
{
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                (const double[3]){0, 4, 0});
    uint32_t apex = scene_vertex(&scene, 2.75, 1.25, 1);
    for (uint32_t k = 0; k < SECTORS; k++) {
        double turn = 2 * (double)SCENE_PI * k / SECTORS;
        scene_vertex(&scene, 2.75 + 0.5 * cos(turn), 1.25 + 0.5 * sin(turn), 1);
    }
    for (uint32_t k = 0; k < SECTORS; k++) {
        scene_facet(&scene, apex, apex + 1 + k, apex + 1 + (k + 1) % SECTORS);
    }
}

/* Only the disc's rim divides what lies below. The area is that of the square less that of the
   polygon, and comes in few pieces although a sector's tip is as thin as rounding. */
static void a_fan_costs_pieces_along_its_rim_only(void **state)
{
    (void)state;
    fan_over_plate();
    lrcsi_occlusion *o = open_scene();
    lrcsi_occlude_open(o, 0);
    int steps = 0;
    while (lrcsi_occlude_next(o)) {
        steps++;
    }
    lrcsi_visible_area seen = lrcsi_occlude_close(o);
    long double sector = 0.25L * 0.5L * sinl(2 * SCENE_PI / SECTORS);
    long double truth = (8 - SECTORS * sector) / 64; /* scaled by 1/8 */
    check_abs(seen.area, (double)truth, 1e-15);
    assert_true(seen.low <= (double)truth && (double)truth <= seen.high);
    assert_true(steps > 0 && steps < 8 * SECTORS);
}

/* A facet seen whole, one seen in part, one hidden: the answers together with the areas that they
   leave open are the areas of all, to the bit, and the other places of visible[] are not touched.
 */
static void answers_and_areas_tell_what_areas_alone_tell(void **state)
{
    (void)state;
    static lrcsi_visible_area all[SECTORS + 3];
    static lrcsi_visible_area some[SECTORS + 3];
    const lrcsi_visible_area untouched = {-1, -2, -3, -4, -5};
    const unsigned char *answer;
    uint32_t times[3] = {0, 0, 0};
    fan_over_plate();
    uint32_t low = scene_vertex(&scene, 2.7, 1.2, 0.5); /* hidden by the disc */
    scene_vertex(&scene, 2.8, 1.2, 0.5);
    scene_vertex(&scene, 2.7, 1.3, 0.5);
    scene_facet(&scene, low, low + 1, low + 2);
    open_scene();
    for (uint32_t f = 0; f < SECTORS + 3; f++) {
        some[f] = untouched;
    }
    size_t used = work.used;
    assert_int_equal(lrcsi_occlude_all(&classification, NULL, NULL, &work, NULL, all, NULL),
                     LRCS_OK);
    assert_int_equal(work.used, used);
    assert_int_equal(lrcsi_occlude_all(&classification, NULL, NULL, &work, &answer, some, NULL),
                     LRCS_OK);
    for (uint32_t f = 0; f < SECTORS + 3; f++) {
        double whole = lrcsi_view_projected(&view, f);
        int undecided = answer[f] == LRCSI_QUERY_NO_ANSWER;
        times[answer[f]]++;
        if (!undecided) {
            double area = answer[f] == LRCSI_QUERY_VISIBLE ? whole : 0;
            assert_memory_equal(&some[f], &untouched, sizeof untouched);
            assert_true(all[f].area == area && all[f].low == area && all[f].high == area);
        } else {
            assert_memory_equal(&some[f], &all[f], sizeof all[f]);
        }
    }
    assert_int_equal(times[LRCSI_QUERY_HIDDEN], 1);
    assert_int_equal(times[LRCSI_QUERY_VISIBLE], SECTORS + 1); /* and half of the plate */
    assert_int_equal(times[LRCSI_QUERY_NO_ANSWER], 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_facet_is_its_own_triangle),
        cmocka_unit_test(hidden_and_edge_on_facets_have_no_pieces),
        cmocka_unit_test(pieces_of_an_undecided_facet_add_up_to_its_area),
        cmocka_unit_test(facet_in_front_hides_its_shadow),
        cmocka_unit_test(piercing_facet_hides_only_what_its_upper_part_covers),
        cmocka_unit_test(facets_behind_beside_or_in_contact_hide_nothing),
        cmocka_unit_test(the_edge_of_a_facet_seen_edge_on_ends_its_surface),
        cmocka_unit_test(order_follows_from_corners_on_sides_of_a_needle_too),
        cmocka_unit_test(a_fin_through_a_plate_when_both_are_seen_edge_on),
        cmocka_unit_test(front_skin_hides_a_back_in_its_plane),
        cmocka_unit_test(shallow_cuts_state_their_position_err),
        cmocka_unit_test(needles_turned_over_by_rounding_hide_nothing),
        cmocka_unit_test(a_needle_shows_its_share_in_pieces),
        cmocka_unit_test(a_facet_without_pieces_has_no_errors_of_pieces),
        cmocka_unit_test(a_fan_costs_pieces_along_its_rim_only),
        cmocka_unit_test(answers_and_areas_tell_what_areas_alone_tell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
