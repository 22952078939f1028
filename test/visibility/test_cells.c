/* SPDX-License-Identifier: MIT */
/* Cells of the view plane find the areas that clipping finds facet by facet, within both bounds,
   whatever touches what. */
#include "visibility/cells/cells.h"

#include "base/work.h"
#include "scenes.h"
#include "visibility/occlude.h"
#include "visibility/uniform/query.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_visible_area found[SCENE_FACETS];
static lrcsi_moment moment[SCENE_FACETS];
static unsigned char wanted[SCENE_FACETS];
static unsigned char finished[SCENE_FACETS]; /* its area was found */
static unsigned char open[SCENE_FACETS];     /* it was not, though wanted */
static lrcsi_meter *limit;                   /* NULL: none */

static void turned(const double direction[3])
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
}

/* Asks for all facets that can be seen, undecided or not. Returns how many there are; *left is how
   many stay open. */
static uint32_t ask(uint32_t *left)
{
    uint32_t asked = 0;
    *left = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        wanted[f] = lrcsi_view_casts(&view, f) != 0;
        asked += wanted[f];
    }
    memset(moment, 0, sizeof moment);
    lrcsi_cells_areas(&classification, limit, NULL, &work, NULL, wanted, finished, found, moment);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        open[f] = wanted[f] && !finished[f];
        *left += open[f];
    }
    return asked;
}

/* The area and the first moment of a piece about `about`, by Green's theorem. */
static void add_piece(const lrcsi_clip_polygon *piece, const double about[2], double first[2])
{
    for (uint32_t i = 0; i < piece->count; i++) {
        const double *p = piece->corner[i];
        const double *q = piece->corner[(i + 1) % piece->count];
        double a[2] = {p[0] - about[0], p[1] - about[1]};
        double b[2] = {q[0] - about[0], q[1] - about[1]};
        first[0] += (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) * (b[1] - a[1]) / 6;
        first[1] -= (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]) * (b[0] - a[0]) / 6;
    }
}

static uint32_t moments_known; /* components, of facets that are undecided */

/* The visible area of a facet by its pieces; its moment by them, by clipping and by cells agree. */
static lrcsi_visible_area clip_with_moment(lrcsi_occlusion *o, uint32_t f)
{
    double first[2] = {0, 0};
    lrcsi_occlude_open(o, f);
    int undecided = o->undecided;
    const double(*corner)[2] = (const double(*)[2])o->single.target.corner;
    while (lrcsi_occlude_next(o)) {
        const double centre[2] = {(corner[0][0] + corner[1][0] + corner[2][0]) / 3,
                                  (corner[0][1] + corner[1][1] + corner[2][1]) / 3};
        add_piece(&o->single.piece, centre, first);
    }
    lrcsi_visible_area clipped = lrcsi_occlude_close(o);
    const lrcsi_moment *by_pieces = &o->single.moment;
    double size = o->single.target.diameter;
    double rounding = 1e-14 * size * size * size;
    const double by_pieces_err = by_pieces->error + size * by_pieces->area_err;
    for (int k = 0; k < 2 && undecided && by_pieces->error < HUGE_VAL; k++) {
        const double err = moment[f].error + size * moment[f].area_err;
        check_abs(by_pieces->first[k], first[k], by_pieces_err + rounding);
        if (!open[f]) {
            check_abs(moment[f].first[k], first[k], by_pieces_err + err + rounding);
            check_most(err, size * (1e-11 * lrcsi_view_projected(&view, f) + 1e-14));
            moments_known++;
        }
    }
    return clipped;
}

/* What is found against clipping: the bounds overlap; and what cells tell is as good as is
   promised, 1e-12 of the facet's projected area and 1e-15 of the square of the scene's extent.
   Returns how many facets cells decided. */
static uint32_t agree(const double direction[3])
{
    uint32_t left;
    turned(direction);
    uint32_t asked = ask(&left);
    lrcsi_occlusion *o;
    assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
    const double *bulk = view.prepared->bulk;
    double extent = 2 * fmax(bulk[0], fmax(bulk[1], bulk[2]));
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        if (!lrcsi_view_casts(&view, f)) {
            continue;
        }
        lrcsi_visible_area clipped = clip_with_moment(o, f);
        if (!open[f]) {
            double most = 1e-12 * lrcsi_view_projected(&view, f) + 1e-15 * extent * extent;
            check_most(found[f].high - found[f].area, most * (1 + 1e-9));
            check_most(found[f].area - found[f].low, most * (1 + 1e-9));
        }
        found[f] = open[f] ? clipped : found[f];
        double rounding = 1e-16 * lrcsi_view_projected(&view, f);
        check_most(found[f].low - clipped.high, rounding);
        check_most(clipped.low - found[f].high, rounding);
        check_most(found[f].low - found[f].area, 0);
        check_most(found[f].area - found[f].high, 0);
    }
    return asked - left;
}

/* The share of a facet that is seen, cells having decided it. */
static double share(uint32_t facet)
{
    assert_int_equal(open[facet], 0);
    assert_true(lrcsi_view_casts(&view, facet));
    return found[facet].area / lrcsi_view_projected(&view, facet);
}

static void point(double x, double y, double z)
{
    scene_vertex(&scene, x, y, z);
}

static void flip(void)
{
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        uint32_t corner = scene.facet[f].corner[1];
        scene.facet[f].corner[1] = scene.facet[f].corner[2];
        scene.facet[f].corner[2] = corner;
    }
    scene.material[0].two_sided = 1;
}

/* K is z = 0 left of the y axis and falls on its right; Q rises to the axis and is level beyond: no
   insides meet, and both folds join two facets, yet behind the axis the one is nearer that was
   farther before it. */
static void surfaces_that_change_order_along_a_fold_of_both(void **state)
{
    (void)state;
    for (int winding = 0; winding < 2; winding++) {
        scene_start(&scene);
        for (int i = 0; i < 2; i++) {
            double y = i == 0 ? 1 : 2;
            uint32_t v = scene.scene.vertex_count;
            point(-1, -y, i == 0 ? 0 : -1);
            point(0, -y, 0);
            point(1, -y, i == 0 ? -1 : 0);
            point(-1, y, i == 0 ? 0 : -1);
            point(0, y, 0);
            point(1, y, i == 0 ? -1 : 0);
            scene_facet(&scene, v, v + 1, v + 4);
            scene_facet(&scene, v, v + 4, v + 3);
            scene_facet(&scene, v + 1, v + 2, v + 5);
            scene_facet(&scene, v + 1, v + 5, v + 4);
        }
        if (winding) {
            flip();
        }
        assert_int_equal(agree((const double[3]){0, 0, 1}), 8);
        check_abs(share(0) + share(1), 2, 1e-13); /* K's left, */
        check_abs(share(2) + share(3), 0, 1e-13); /* and right */
        check_abs(share(4) + share(5), 1, 1e-13);
        check_abs(share(6) + share(7), 2, 1e-13);
        agree((const double[3]){0.1, 0.2, 1});
    }
}

/* Two folds of panels along one line, their common sides of different lengths: the fold of 0 and 1
   is nearer on the right of the line, that of 2 and 3 on its left. Every panel is stored as two
   faces, which begin at different corners. Symptom: the marks of the sides along the line were
   those of the other face's sides, and a fold was taken to be nearer on both sides of the line. */
static void folds_of_panels_that_change_order_along_a_line(void **state)
{
    (void)state;
    static const double at[7][3] = {{-1.5, 1.5, 1}, {-1.5, -1.5, -1}, {-1, 1, 0}, {-1, -1, 0},
                                    {-1, 0.5, 0},   {0, 0, -1},       {0, 0, 1}};
    static const uint32_t panel[4][3] = {{3, 6, 4}, {1, 3, 4}, {2, 3, 5}, {0, 3, 2}};
    static const double truth[4] = {1, 2.0 / 3, 0.25, 1};
    for (uint32_t turn = 0; turn < 162; turn++) {
        scene_start(&scene);
        for (int i = 0; i < 7; i++) {
            point(at[i][0], at[i][1], at[i][2]);
        }
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t k = (turn + i * (turn / 9)) % 3;
            uint32_t j = turn / 3 % 3;
            uint32_t back = turn / 81;
            const uint32_t *c = panel[i];
            for (uint32_t face = 0; face < 2; face++) {
                if (face == back) {
                    scene_facet(&scene, c[k], c[(k + 1) % 3], c[(k + 2) % 3]);
                } else {
                    scene_facet(&scene, c[(j + 2) % 3], c[(j + 1) % 3], c[j]);
                }
            }
        }
        agree((const double[3]){0, 0, 1});
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t front = 2 * i + (view.facing[2 * i] < 0);
            check_abs(share(front), truth[i], 1e-12);
        }
    }
}

/* A square twice, its facets 0 and 3 on one diagonal, 1 and 2 on the other: 0 wins, 3 loses. */
static void square_stored_twice_with_both_diagonals(void **state)
{
    (void)state;
    for (int winding = 0; winding < 2; winding++) {
        scene_start(&scene);
        point(0, 0, 0);
        point(1, 0, 0);
        point(1, 1, 0);
        point(0, 1, 0);
        scene_facet(&scene, 0, 1, 2);
        scene_facet(&scene, 0, 1, 3);
        scene_facet(&scene, 1, 2, 3);
        scene_facet(&scene, 0, 2, 3);
        if (winding) {
            flip();
        }
        turned((const double[3]){0.1, 0.3, 1});
        uint32_t left;
        ask(&left);
        check_abs(share(0), 1, 1e-13);
        check_abs(share(1), 0.5, 1e-13);
        check_abs(share(2), 0.5, 1e-13);
        check_abs(share(3), 0, 1e-13);
        agree((const double[3]){0, 0, 1});
        agree((const double[3]){0.3, -0.2, 1});
    }
}

/* One plate pierces another at a slant: a contact divides both. */
static void plates_that_pierce_each_other(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    scene_plate(&scene, (const double[3]){-1, -1, -0.75}, (const double[3]){3, 0, 1.5},
                (const double[3]){0, 3, 0});
    assert_int_equal(agree((const double[3]){0, 0, 1}), 4);
    double first = share(0) + share(1); /* z = 0 beyond x = 1/2 is behind */
    check_abs(first, 1, 1e-13);
}

/* Spikes that rise through a plate of two facets: most of each edge of a spike is behind the plate,
   and its tip is in front. A strip of facets behind the plate begins at the first spike. */
static void tips_of_spikes_through_a_plate_are_seen(void **state)
{
    (void)state;
    for (int winding = 0; winding < 2; winding++) {
        scene_start(&scene);
        scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                    (const double[3]){0, 1, 0});
        for (int i = 0; i < 12; i++) {
            double x = 0.07 * i;
            uint32_t v = scene.scene.vertex_count;
            point(0.05 + x, 0.1, -1);
            point(0.06 + x, 0.3, -1);
            point(0.15 + x, 0.8, 0.05 + 0.01 * i);
            point(0.5 + 0.01 * i, 0.05, -1.5);
            scene_facet(&scene, v, v + 1, v + 2);
            scene_facet(&scene, v, v + 3, v + 1);
        }
        if (winding) {
            flip();
        }
        assert_int_equal(agree((const double[3]){0, 0, 1}), 26);
        for (uint32_t i = 0; i < 12; i++) {
            double above = 0.05 + 0.01 * i; /* the tip is a smaller triangle of the same shape */
            double part = above / (1 + above);
            check_abs(share(2 + 2 * i), part * part, 1e-13);
            check_abs(share(3 + 2 * i), 0, 1e-13);
        }
        agree((const double[3]){0.2, 0.3, 1});
        agree((const double[3]){-1, 0.1, 0.4});
    }
}

/* A ramp that winds around an axis twice passes behind itself: one component, two layers. */
static void ramp_that_passes_behind_itself(void **state)
{
    (void)state;
    for (int winding = 0; winding < 2; winding++) {
        scene_start(&scene);
        for (int i = 0; i <= 48; i++) {
            double t = 4 * (double)SCENE_PI * i / 48;
            point(0.2 * cos(t), 0.2 * sin(t), -0.05 * i);
            point(cos(t), sin(t), -0.05 * i);
        }
        for (uint32_t i = 0; i < 48; i++) {
            scene_facet(&scene, 2 * i, 2 * i + 1, 2 * i + 3);
            scene_facet(&scene, 2 * i, 2 * i + 3, 2 * i + 2);
        }
        if (winding) {
            flip();
        }
        assert_true(agree((const double[3]){0.3, 0.2, 1}) > 10);
        agree((const double[3]){0, 0, 1});
        agree((const double[3]){1, 0.2, 0.3});
    }
}

/* A strip that is turned over once on its way around: somewhere its winding changes. Any other of
   its facets may be wound the other way as well, and shows as much. */
static void moebius_strip_wound_at_random(void **state)
{
    (void)state;
    enum { PARTS = 40 };
    static const double direction[][3] = {{0.3, 0.2, 1}, {1, 0.2, 0.3}, {-0.5, 1, 0.7}};
    double seen[sizeof direction / sizeof *direction][2 * PARTS];
    uint32_t events[sizeof direction / sizeof *direction];
    for (uint32_t winding = 0; winding < 8; winding++) {
        scene_start(&scene);
        scene.material[0].two_sided = 1;
        for (int i = 0; i < PARTS; i++) {
            double t = 2 * (double)SCENE_PI * i / PARTS;
            for (int side = -1; side <= 1; side += 2) {
                double r = 1 + side * 0.4 * cos(t / 2);
                point(r * cos(t), r * sin(t), side * 0.4 * sin(t / 2));
            }
        }
        for (uint32_t i = 0; i < PARTS; i++) {
            uint32_t next = 2 * (i + 1) % (2 * PARTS);
            uint32_t turn = i + 1 == PARTS; /* its sides change places */
            scene_facet(&scene, 2 * i, 2 * i + 1, next + 1 - turn);
            scene_facet(&scene, 2 * i, next + 1 - turn, next + turn);
        }
        uint32_t dice = winding * 2654435761u;
        for (uint32_t f = 0; f < 2 * PARTS; f++) {
            dice = dice * 1664525u + 1013904223u;
            if (winding > 0 && dice >> 31) {
                uint32_t corner = scene.facet[f].corner[1];
                scene.facet[f].corner[1] = scene.facet[f].corner[2];
                scene.facet[f].corner[2] = corner;
            }
        }
        for (size_t i = 0; i < sizeof direction / sizeof *direction; i++) {
            assert_true(agree(direction[i]) >= 2 * PARTS - 8);
            events[i] = winding == 0 ? classification.events.count : events[i];
            assert_int_equal(classification.events.count, events[i]);
            for (uint32_t f = 0; f < 2 * PARTS; f++) {
                seen[i][f] = winding == 0 ? found[f].area : seen[i][f];
                check_abs(found[f].area, seen[i][f], 1e-12);
            }
        }
    }
}

/* A needle of some ulps, seen along itself: all of the view is as wide as the errors of the
   needle's corners in it, and some of the needle lies outside of the window that holds these. */
static void needle_along_the_line_of_sight_has_all_of_its_area(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){-21, 18, 0},
                   (const double[3]){-0x1.37fffffffffffp+5, 24, -0x1.7ffffffffffffp+4},
                   (const double[3]){-12, 15, 12});
    turned((const double[3]){-0x1.2000000000005p+2, 0x1.7ffffffffffd7p+0, -0x1.8000000000001p+2});
    uint32_t left;
    assert_int_equal(ask(&left), 1);
    check_rel(share(0), 1.0, 1e-12);
}

/* --- at random -------------------------------------------------------------------------------- */

static uint32_t dice_state;

static uint32_t dice(uint32_t most)
{
    dice_state = dice_state * 1664525u + 1013904223u;
    return (dice_state >> 8) % most;
}

/* Facets on few points: they pierce, stand on, share and double each other, in every way; pinched,
   of three to an edge, and one-sided. */
static void soup(uint32_t seed, uint32_t points, uint32_t side, uint32_t facets)
{
    dice_state = seed;
    scene_start(&scene);
    for (uint32_t i = 0; i < points; i++) {
        double x = dice(side);
        double y = dice(side);
        point(x, y, dice(side));
    }
    for (uint32_t i = 0; i < facets; i++) {
        uint32_t a = dice(points);
        uint32_t b = dice(points);
        scene_facet(&scene, a, b, dice(points));
    }
    scene.material[0].two_sided = (unsigned char)(seed % 2);
}

static void soups_on_few_points_agree_with_clipping(void **state)
{
    (void)state;
    static const double direction[][3] = {{0, 0, 1},        {1, 0, 0},    {1, 1, 1},
                                          {0.3, -0.2, 0.9}, {-1, 2, 0.5}, {0, 1, 1}};
    uint32_t decided = 0;
    for (uint32_t seed = 0; seed < 150; seed++) {
        soup(seed, 6 + seed % 20, 3 + seed % 5, 8 + seed % 40);
        for (int winding = 0; winding < 2; winding++) {
            for (size_t i = 0; i < sizeof direction / sizeof *direction; i++) {
                decided += agree(direction[i]);
            }
            flip();
        }
    }
    assert_true(decided > 10000);
}

/* A facet that reaches from among the others to 1e9 times their distances, listed from its far
   corner or another, with a spike through it where the others are. */
static void a_facet_with_one_far_corner_is_pierced_near_the_others(void **state)
{
    (void)state;
    for (int first = 0; first < 3; first++) {
        scene_start(&scene);
        scene_sphere(&scene, (const double[3]){0, 0, -3}, 1, 16);
        uint32_t v = scene.scene.vertex_count;
        point(1e9, 0, 0);
        point(-0.25, 1, 0);
        point(-0.25, -1, 0);
        uint32_t third = (uint32_t)first;
        scene_facet(&scene, v + third, v + (third + 1) % 3, v + (third + 2) % 3);
        for (int i = 0; i < 6; i++) {
            double x = 0.1 * i;
            scene_triangle(&scene, (const double[3]){x, -0.3, -1},
                           (const double[3]){x + 0.1, 0.3, -1},
                           (const double[3]){x + 0.02, 0.1, 1});
        }
        scene.material[0].two_sided = 1;
        assert_true(agree((const double[3]){0, 0, 1}) > 0);
        agree((const double[3]){0.1, 0.3, 1});
        agree((const double[3]){-0.2, 0.1, -1});
    }
}

/* Triangles that are needles wherever they are seen from, 2^-30 to 2^-60 of their length wide,
   among facets on few points. */
static void needles_of_any_width_agree_with_clipping(void **state)
{
    (void)state;
    static const double direction[][3] = {{0, 0, 1}, {1, 1, 1}, {0.3, -0.2, 0.9}};
    for (uint32_t seed = 0; seed < 60; seed++) {
        uint32_t points = 8 + seed % 8;
        soup(seed, points, 4, 10);
        for (int i = 0; i < 12; i++) {
            const double *p = scene.vertex[dice(points)].x;
            const double *q = scene.vertex[dice(points)].x;
            double wide = ldexp(1, -30 - (int)dice(31));
            double along = dice(3) * 0.25 + 0.25;
            uint32_t v = scene.scene.vertex_count;
            double corner[3];
            for (int k = 0; k < 3; k++) {
                corner[k] = p[k] + along * (q[k] - p[k]) + wide * dice(4);
            }
            point(p[0], p[1], p[2]);
            point(q[0], q[1], q[2]);
            point(corner[0], corner[1], corner[2]);
            uint32_t turn = dice(2);
            scene_facet(&scene, v, v + 1 + turn, v + 2 - turn);
        }
        for (size_t i = 0; i < sizeof direction / sizeof *direction; i++) {
            agree(direction[i]);
        }
    }
}

/* --- limits ----------------------------------------------------------------------------------- */

static void hatch(int n)
{
    scene_start(&scene);
    for (int i = 0; i < n; i++) {
        double at = (double)i / n;
        scene_plate(&scene, (const double[3]){0, at, 0}, (const double[3]){1, 0, 0},
                    (const double[3]){0, 0.5 / n, 0});
        scene_plate(&scene, (const double[3]){at, 0, -1}, (const double[3]){0.5 / n, 0, 0},
                    (const double[3]){0, 1, 0});
    }
}

/* Twice the strips are four times the pieces that are seen: the steps grow as those do. */
static void hatch_takes_steps_like_the_pieces_that_are_seen(void **state)
{
    (void)state;
    uint64_t steps[2];
    for (int i = 0; i < 2; i++) {
        uint32_t left;
        lrcsi_meter meter = {.limit = UINT64_MAX};
        hatch(50 << i);
        turned((const double[3]){0, 0, 1});
        limit = &meter;
        assert_int_equal(ask(&left), 4 * (50 << i));
        limit = NULL;
        assert_int_equal(left, 0);
        steps[i] = meter.taken;
    }
    assert_true(steps[1] < 6 * steps[0]);
    assert_true(steps[1] < 2000000);
}

static void steps_that_run_out_leave_facets_open(void **state)
{
    (void)state;
    hatch(20);
    for (uint64_t most = 1; most < 200000; most *= 4) {
        uint32_t left;
        lrcsi_meter meter = {.limit = most};
        turned((const double[3]){0, 0, 1});
        limit = &meter;
        uint32_t asked = ask(&left);
        limit = NULL;
        assert_true(meter.spent ? left > 0 : left == 0);
        assert_true(left <= asked && meter.taken <= most);
    }
}

/* Whatever size the work area has: larger blocks, where they serve, find the same areas. */
static void memory_that_does_not_suffice_leaves_all_open(void **state)
{
    (void)state;
    static lrcsi_visible_area ample[SCENE_FACETS];
    uint32_t left;
    hatch(30);
    turned((const double[3]){0, 0, 1});
    size_t size = work.size;
    size_t used = work.used;
    work.peak = used;
    work.size = used + lrcsi_cells_need(view.prepared);
    uint32_t asked = ask(&left);
    size_t taken = work.peak;
    assert_int_equal(left, 0);
    assert_true(taken <= work.size);
    memcpy(ample, found, sizeof ample);
    int served = 0;
    for (work.size = used; work.size <= taken; work.size += work.size < taken - 8 ? 8 : 1) {
        work.peak = used;
        ask(&left);
        assert_int_equal(work.used, used);
        if (left == asked) {
            assert_int_equal(work.peak, used);
            continue;
        }
        assert_int_equal(left, 0);
        served++;
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            assert_true(found[f].low <= ample[f].high && ample[f].low <= found[f].high);
        }
    }
    assert_true(served > 0);
    work.size = size;
}

/* A plate in front of a square mesh, within its outline in the view. Facets of the mesh that are
   proved to be hidden are not listed: they stay open. Those that the plate's sides cross get the
   areas that they have when all are listed; so the mesh shows all that the plate leaves. */
static void hidden_facets_are_left_out_and_change_nothing(void **state)
{
    (void)state;
    enum { SIDE = 12 };
    scene_start(&scene);
    for (uint32_t i = 0; i <= SIDE; i++) {
        for (uint32_t j = 0; j <= SIDE; j++) {
            point(0.5 * i - 3, 0.5 * j - 3, 0);
        }
    }
    for (uint32_t i = 0; i < SIDE; i++) {
        for (uint32_t j = 0; j < SIDE; j++) {
            uint32_t v = i * (SIDE + 1) + j;
            scene_facet(&scene, v, v + SIDE + 1, v + SIDE + 2);
            scene_facet(&scene, v, v + SIDE + 2, v + 1);
        }
    }
    scene_plate(&scene, (const double[3]){-1.03, -1.07, 1}, (const double[3]){2.1, 0, 0},
                (const double[3]){0, 2.2, 0});
    turned((const double[3]){0.05, 0.1, 1});
    static unsigned char answer[SCENE_FACETS];
    static lrcsi_visible_area listed[SCENE_FACETS];
    lrcsi_grid facets;
    assert_int_equal(lrcsi_query_uniform(&classification, NULL, &work, &facets, answer), LRCS_OK);
    uint32_t left;
    ask(&left);
    assert_int_equal(left, 0);
    memcpy(listed, found, sizeof listed);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        wanted[f] = 1;
    }
    lrcsi_cells_areas(&classification, NULL, NULL, &work, answer, wanted, finished, found, NULL);
    uint32_t hidden = 0;
    uint32_t crossed = 0;
    double seen = 0;
    double whole = 0;
    for (uint32_t f = 0; f < 2 * SIDE * SIDE; f++) {
        whole += lrcsi_view_projected(&view, f);
        if (!classification.undecided[f] && answer[f] == LRCSI_QUERY_HIDDEN) {
            hidden++;
            assert_int_equal(finished[f], 0);
            check_abs(listed[f].high, 0, 0);
        } else {
            crossed += classification.undecided[f] != 0;
            assert_int_equal(finished[f], 1);
            check_most(found[f].low, listed[f].high);
            check_most(listed[f].low, found[f].high);
            seen += found[f].area;
        }
    }
    assert_true(hidden > 10);
    assert_true(crossed > 20);
    check_abs(seen / whole, (36 - 2.1 * 2.2) / 36, 1e-13);
}

/* A plate in thousands of blocks, in each of which its area is added: behind it are connected small
   facets, by whose number blocks are made; in front of it are triangles that hide parts of its first
   facet. All corners are multiples of 2^-23: the visible fraction is exact. */
static void plate_over_small_facets(double a, int triangles, const double slope[2])
{
    enum { SIDE = 60 };
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){-a, -a, 0}, (const double[3]){2 * a, 0, 0},
                (const double[3]){0, 2 * a, 0});
    for (int i = 0; i < triangles; i++) { /* they hide what is below the diagonal x = y */
        const double x = 0.5 + (i % 4) * 0x1p-4 + slope[0];
        const double y = -0.5 + (i / 4) * 0x1p-4 + slope[1];
        scene_triangle(&scene, (const double[3]){x, y, 1}, (const double[3]){x + 0x1p-5, y, 1},
                       (const double[3]){x, y + 0x1p-5, 1});
    }
    const uint32_t first = scene.scene.vertex_count;
    for (int i = 0; i < SIDE * SIDE; i++) {
        point((i % SIDE) * 0x1p-6 - 0.5, (i / SIDE) * 0x1p-6 - 0.5, -1);
    }
    for (uint32_t i = 0; i < (SIDE - 1) * SIDE; i++) {
        if (i % SIDE + 1 < SIDE) {
            const uint32_t v = first + i;
            scene_facet(&scene, v, v + 1, v + SIDE + 1);
            scene_facet(&scene, v, v + SIDE + 1, v + SIDE);
        }
    }
    turned((const double[3]){slope[0], slope[1], 1});
}

static void sums_over_thousands_of_blocks_keep_their_bounds(void **state)
{
    (void)state;
    enum { TRIALS = 30 };
    uint64_t seed = 1;
    for (int trial = 0; trial < TRIALS; trial++) {
        const double a = 1 + random_below(&seed, 1u << 23) * 0x1p-23;
        const int triangles = 1 + trial % 16;
        const double tilt = trial % 2 ? 0x1p-6 : 0;
        const double slope[2] = {tilt * random_below(&seed, 16), -tilt * random_below(&seed, 16)};
        uint32_t left;
        plate_over_small_facets(a, triangles, slope);
        ask(&left);
        for (uint32_t f = 0; f < 2; f++) {
            const double hidden = f == 0 ? triangles * 0x1p-11 : 0;
            const double whole = lrcsi_view_projected(&view, f);
            const double area = whole * ((2 * a * a - hidden) / (2 * a * a));
            const double rounding = 8 * 0x1p-53 * whole; /* of `whole` and the fraction */
            assert_false(open[f]);
            check_most(found[f].low, area + rounding);
            check_most(area, found[f].high + rounding);
        }
    }
}

/* By the tests above. */
static void moments_were_compared(void **state)
{
    (void)state;
    assert_true(moments_known > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_that_change_order_along_a_fold_of_both),
        cmocka_unit_test(folds_of_panels_that_change_order_along_a_line),
        cmocka_unit_test(square_stored_twice_with_both_diagonals),
        cmocka_unit_test(plates_that_pierce_each_other),
        cmocka_unit_test(tips_of_spikes_through_a_plate_are_seen),
        cmocka_unit_test(ramp_that_passes_behind_itself),
        cmocka_unit_test(moebius_strip_wound_at_random),
        cmocka_unit_test(needle_along_the_line_of_sight_has_all_of_its_area),
        cmocka_unit_test(soups_on_few_points_agree_with_clipping),
        cmocka_unit_test(a_facet_with_one_far_corner_is_pierced_near_the_others),
        cmocka_unit_test(needles_of_any_width_agree_with_clipping),
        cmocka_unit_test(hatch_takes_steps_like_the_pieces_that_are_seen),
        cmocka_unit_test(steps_that_run_out_leave_facets_open),
        cmocka_unit_test(memory_that_does_not_suffice_leaves_all_open),
        cmocka_unit_test(hidden_facets_are_left_out_and_change_nothing),
        cmocka_unit_test(sums_over_thousands_of_blocks_keep_their_bounds),
        cmocka_unit_test(moments_were_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
