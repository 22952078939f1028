/* SPDX-License-Identifier: MIT */
/* Which facets are undecided, by what, and which of those a component hides all the same; and the
   grids that find them. Scenes are small enough to count by hand. */
#include "visibility/uniform/classify.h"

#include "base/disjoint.h"
#include "scenes.h"
#include "visibility/uniform/query.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_crossings crossings;
static uint32_t region_of[SCENE_FACETS + LRCSI_MESHLET_FACETS];
static lrcsi_grid facets;

static void look_from(double x, double y, double z)
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_crossings_make(&classification.search, &work, &crossings), LRCS_OK);
    lrcsi_events_join(classification.view, &classification.joinable, region_of);
    assert_int_equal(lrcsi_grid_facets(&classification.search.grid, &classification.search.boxes,
                                       NULL, &work, &facets),
                     LRCS_OK);
}

/* How many event edges cross a facet. */
static uint32_t crossing_count(uint32_t facet)
{
    lrcsi_crossings_find(&classification.search, facet, NULL, &crossings);
    assert_int_equal(crossings.facet, facet);
    return crossings.count;
}

static int screened(uint32_t facet)
{
    return lrcsi_query_hidden_by_component(&classification, &facets, facet, NULL, &crossings);
}

/* A level square, front up: corner at (x, y, z). */
static uint32_t square(double x, double y, double z, double size)
{
    return scene_plate(&scene, (const double[3]){x, y, z}, (const double[3]){size, 0, 0},
                       (const double[3]){0, size, 0});
}

static void a_body_alone_has_no_undecided_facets(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    look_from(1, 2, 3);
    assert_int_equal(classification.undecided_count, 0);
    assert_int_equal(classification.events.count, 6); /* the contour of a box is a hexagon */
    for (uint32_t f = 0; f < 12; f++) {
        assert_true(view.facing[f] <= 0 ||
                    lrcsi_query_facet(&facets, f, NULL) == LRCSI_QUERY_VISIBLE);
    }
}

/* A box some of whose facets are wound the other way: back sides cast then, and the contour, where
   both facets of an edge lie on one side of it, is the same hexagon. */
static void winding_that_changes_makes_no_events(void **state)
{
    (void)state;
    for (uint32_t flipped = 0; flipped < 1u << 12; flipped += 37) {
        scene_start(&scene);
        scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
        for (uint32_t f = 0; f < 12; f++) {
            if (flipped >> f & 1) {
                uint32_t corner = scene.facet[f].corner[1];
                scene.facet[f].corner[1] = scene.facet[f].corner[2];
                scene.facet[f].corner[2] = corner;
            }
        }
        look_from(1, 2, 3);
        assert_int_equal(classification.events.count, 6);
        assert_int_equal(classification.undecided_count, 0);
        uint32_t seen = 0;
        for (uint32_t f = 0; f < 12; f++) {
            seen += lrcsi_view_casts(&view, f) &&
                    lrcsi_query_facet(&facets, f, NULL) == LRCSI_QUERY_VISIBLE;
        }
        assert_int_equal(seen, 6);
    }
}

/* A square of side 1 over the lower right half of a square of side 4, whose diagonal runs from
   (0, 0) to (4, 4): its four rims cross facet 0 and none crosses facet 1. */
static void boundary_edges_in_front_make_facets_that_they_cross_undecided(void **state)
{
    (void)state;
    scene_start(&scene);
    square(0, 0, 0, 4);
    square(2.5, 0.5, 1, 1);
    look_from(0, 0, 1);
    assert_int_equal(classification.events.count, 8);
    assert_true(classification.undecided[0]);
    assert_false(classification.undecided[1]);
    assert_int_equal(crossing_count(0), 4);
    assert_int_equal(crossing_count(1), 0);
    assert_int_equal(classification.undecided[2] + classification.undecided[3], 0); /* the nearer */
    assert_int_equal(lrcsi_query_facet(&facets, 1, NULL), LRCSI_QUERY_VISIBLE);
    look_from(0, 0, -1); /* from behind the large one hides the small one whole */
    assert_int_equal(classification.undecided_count, 0);
    assert_int_equal(lrcsi_query_facet(&facets, 2, NULL), LRCSI_QUERY_HIDDEN);
    assert_int_equal(lrcsi_query_facet(&facets, 3, NULL), LRCSI_QUERY_HIDDEN);
}

/* What was found for a facet stays available until another one is searched for. */
static void crossings_are_searched_for_once(void **state)
{
    (void)state;
    scene_start(&scene);
    square(0, 0, 0, 4);
    square(2.5, 0.5, 1, 1);
    look_from(0, 0, 1);
    uint32_t found[4];
    uint32_t before = classification.search.searches;
    assert_int_equal(crossing_count(0), 4);
    assert_int_equal(crossing_count(0), 4);
    assert_int_equal(classification.search.searches, before + 1);
    memcpy(found, crossings.edge, sizeof found);
    assert_int_equal(crossing_count(1), 0);
    assert_int_equal(classification.search.searches, before + 2);
    assert_int_equal(crossing_count(0), 4);
    assert_memory_equal(crossings.edge, found, sizeof found);
    assert_int_equal(classification.search.searches, before + 3);
}

/* Numbers of searches begin again after the last one; what an earlier search left with an event is
   not mistaken for a mark of the new one. */
static void crossings_are_found_after_the_last_number_of_a_search(void **state)
{
    (void)state;
    scene_start(&scene);
    square(0, 0, 0, 4);
    square(2.5, 0.5, 1, 1);
    look_from(0, 0, 1);
    for (uint32_t i = 0; i < classification.search.events; i++) {
        classification.search.event[i].last_search = 1 + i % 2;
    }
    classification.search.searches = UINT32_MAX - 1;
    assert_int_equal(crossing_count(0), 4);
    assert_int_equal(classification.search.searches, UINT32_MAX);
    assert_int_equal(crossing_count(1), 0);
    assert_int_equal(classification.search.searches, 1);
    assert_int_equal(crossing_count(0), 4);
    assert_int_equal(classification.search.searches, 2);
}

/* A rim that projects exactly onto another plate's rim, or only touches it, crosses nothing. */
/* A slope over which a level edge passes underneath, lower than all of it; but far to the left,
   where the slope is no more, the edge is above the slope's plane. */
static void boundary_edges_behind_a_facet_do_not_make_it_undecided(void **state)
{
    (void)state;
    scene_start(&scene);
    uint32_t v = scene_vertex(&scene, 0, 0, 0); /* z = x */
    scene_vertex(&scene, 4, 0, 4);
    scene_vertex(&scene, 0, 4, 0);
    scene_facet(&scene, v, v + 1, v + 2);
    v = scene_vertex(&scene, 1, 1, -1);
    scene_vertex(&scene, -9, 1, -1); /* where the plane is at -9 */
    scene_vertex(&scene, -9, 1.5, -1);
    scene_facet(&scene, v, v + 1, v + 2);
    look_from(0, 0, 1);
    assert_false(classification.undecided[0]);
    assert_int_equal(crossing_count(0), 0);
    assert_true(classification.undecided[1]);
}

static void boundary_edges_along_boundary_edges_make_nothing_undecided(void **state)
{
    (void)state;
    scene_start(&scene);
    square(0, 0, 0, 2);
    square(2, 0, 1, 2); /* beside */
    square(0, 2, 1, 2);
    square(-1, -1, 1, 1); /* corner to corner */
    square(0, 0, -1, 2);  /* right below */
    look_from(0, 0, 1);
    assert_int_equal(classification.undecided_count, 0);
    assert_int_equal(lrcsi_query_facet(&facets, 0, NULL), LRCSI_QUERY_VISIBLE);
    assert_int_equal(lrcsi_query_facet(&facets, 8, NULL), LRCSI_QUERY_HIDDEN);
}

static void piercing_and_overlapping_facets_make_each_other_undecided(void **state)
{
    (void)state;
    scene_start(&scene);
    square(0, 0, 0, 4);
    scene_triangle(&scene, (const double[3]){1, 0.5, -1}, (const double[3]){3.5, 0.5, -1},
                   (const double[3]){2, 0.75, 1}); /* pierces facet 0 */
    look_from(0, 0, 1);
    assert_true(classification.undecided[0]);
    assert_true(classification.undecided[2]);
    scene_start(&scene);
    square(0, 0, 0, 4);
    square(2.5, 0.5, 0, 1); /* in the same plane: the lower index wins */
    look_from(0, 0, 1);
    assert_false(classification.undecided[0]);
    assert_true(classification.undecided[2] && classification.undecided[3]);
    assert_true(screened(2) == 0);
}

/* Of every edge of the scene: it is listed as an event if it is one, and joins two facets into one
   component, and into one region if they may be, if it joins them in the view. No others are
   joined.
 */
static void check_joins(void)
{
    static uint32_t component[SCENE_FACETS];
    static uint32_t region[SCENE_FACETS];
    const lrcs_prepared *p = view.prepared;
    uint32_t events = 0;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        component[f] = region[f] = f;
    }
    for (uint32_t e = 0; e < p->topology.edge_count; e++) {
        lrcsi_edge_facets on;
        int kind = lrcsi_edge_kind_of(&view, e, LRCS_NONE, &on);
        int listed = 0;
        for (uint32_t i = 0; i < classification.events.count; i++) {
            listed += classification.events.edge[i] == e;
        }
        assert_int_equal(listed, kind == LRCSI_EDGE_EVENT);
        events += (uint32_t)listed;
        if (kind == LRCSI_EDGE_JOINS) {
            lrcsi_disjoint_union(component, on.facet[0], on.facet[1]);
            if (classification.joinable.facet[on.facet[0]] != 0 &&
                classification.joinable.facet[on.facet[1]] != 0) {
                lrcsi_disjoint_union(region, on.facet[0], on.facet[1]);
            }
        }
    }
    assert_true(events > 0);
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        assert_int_equal(classification.component[f], lrcsi_disjoint_root(component, f));
        assert_int_equal(region_of[f], lrcsi_disjoint_root(region, f));
    }
}

/* Meshlets whose facets all face alike are joined at once; spheres and boxes have such meshlets and
   others, in file order and shuffled, with the winding of some facets reversed, and with open
   edges. */
static void components_and_regions_are_joined_across_every_edge(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 24; i++) {
        scene_start(&scene);
        scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 12);
        scene_box(&scene, (const double[3]){1.5, -1, -1}, (const double[3]){2.5, 1, 1});
        square(-3, -3, 2, 2);
        for (uint32_t f = scene.scene.facet_count; i % 3 == 1 && f > 1; f--) {
            uint32_t other = (uint32_t)random_below(&seed, f);
            lrcs_facet swap = scene.facet[f - 1];
            scene.facet[f - 1] = scene.facet[other];
            scene.facet[other] = swap;
        }
        for (uint32_t f = 0; i % 3 == 2 && f < scene.scene.facet_count; f += 37) {
            uint32_t corner = scene.facet[f].corner[1];
            scene.facet[f].corner[1] = scene.facet[f].corner[2];
            scene.facet[f].corner[2] = corner;
        }
        scene.scene.facet_count -= (uint32_t)i;
        look_from(sin(i), cos(i), 0.3 * (i % 7) - 1);
        check_joins();
    }
}

/* A roof whose ridge stands over the y axis: facet 0 slopes down to the left, facet 1 to the
   right. */
static void roof(void)
{
    scene_start(&scene);
    uint32_t v = scene_vertex(&scene, 0, 0, 1);
    scene_vertex(&scene, 0, 1, 1);
    scene_vertex(&scene, -1, 0.5, 0);
    scene_vertex(&scene, 1, 0.5, 0);
    scene_facet(&scene, v, v + 1, v + 2);
    scene_facet(&scene, v, v + 3, v + 1);
}

static int region_answer(uint32_t facet)
{
    static unsigned char answer[SCENE_FACETS];
    assert_int_equal(lrcsi_query_uniform(&classification, NULL, &work, &facets, answer), LRCS_OK);
    return answer[facet];
}

static void uniform_neighbours_form_regions(void **state)
{
    (void)state;
    roof();
    look_from(0, 0, 1);
    assert_int_equal(region_of[1], 0);
    assert_int_equal(region_answer(1), LRCSI_QUERY_VISIBLE);
    square(-3, -3, 2, 6); /* hides both */
    look_from(0, 0, 1);
    assert_int_equal(region_of[1], 0);
    assert_int_equal(region_answer(0), LRCSI_QUERY_HIDDEN);
    assert_int_equal(region_answer(1), LRCSI_QUERY_HIDDEN);
    look_from(1, 0, 0); /* the ridge is a contour now */
    assert_int_equal(region_of[1], 1);
}

/* A rim that ends right above the ridge crosses neither slope, yet hides one of them. */
static void a_rim_along_a_shared_edge_parts_regions(void **state)
{
    (void)state;
    roof();
    scene_plate(&scene, (const double[3]){0, -1, 2}, (const double[3]){3, 0, 0},
                (const double[3]){0, 3, 0});
    look_from(0, 0, 1);
    assert_int_equal(classification.undecided[0] + classification.undecided[1], 0);
    assert_int_equal(region_of[1], 1);
    assert_int_equal(region_answer(0), LRCSI_QUERY_VISIBLE);
    assert_int_equal(region_answer(1), LRCSI_QUERY_HIDDEN);
}

/* A plane through the ridge, above one slope and below the other, touches the inside of neither. */
static void a_plane_through_a_shared_edge_parts_regions(void **state)
{
    (void)state;
    roof();
    scene_plate(&scene, (const double[3]){-2, -1, 5}, (const double[3]){4, 0, -8},
                (const double[3]){0, 4, 0});
    look_from(0, 0, 1);
    assert_int_equal(classification.undecided[0] + classification.undecided[1], 0);
    assert_int_equal(region_of[1], 1);
    assert_int_equal(region_answer(0), LRCSI_QUERY_HIDDEN);
    assert_int_equal(region_answer(1), LRCSI_QUERY_VISIBLE);
}

/* Surface components end at contours: from (1, 2, 3) a box has one of its six front facets and one
   behind; one facet without a neighbour is a component of its own. */
static void components_end_at_contours(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    square(3, 3, 0, 1);
    look_from(1, 2, 3);
    uint32_t front = LRCS_NONE;
    for (uint32_t f = 0; f < 12; f++) {
        if (view.facing[f] > 0) {
            front = front == LRCS_NONE ? classification.component[f] : front;
            assert_int_equal(classification.component[f], front);
        } else {
            assert_true(classification.component[f] != front);
        }
    }
    assert_int_equal(classification.component[12], classification.component[13]);
    assert_true(classification.component[12] != front);
}

/* What a component hides is undecided, and yet hidden for certain; two components together, or one
   that the facet pierces, prove nothing. */
static void whole_components_screen_and_others_do_not(void **state)
{
    (void)state;
    scene_start(&scene);
    uint32_t low = square(0, 0, 0, 4);
    square(2.5, 0.5, 1, 1);
    uint32_t screen = square(-1, -1, 2, 6);
    look_from(0.125, 0, 1);
    assert_true(classification.undecided[low]);
    assert_true(screened(low));
    assert_false(screened(screen));

    scene_start(&scene);
    low = square(0, 0, 0, 4);
    scene_plate(&scene, (const double[3]){-1, -1, 1}, (const double[3]){3.5, 0, 0},
                (const double[3]){0, 6, 0});
    scene_plate(&scene, (const double[3]){2, -1, 2}, (const double[3]){3.5, 0, 0},
                (const double[3]){0, 6, 0});
    look_from(0, 0, 1);
    assert_true(classification.undecided[low]);
    assert_false(screened(low));

    scene_start(&scene);
    low = scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                         (const double[3]){2, 1, 4});
    square(-1, -1, 2, 6); /* the tip looks out of it */
    look_from(0, -1, 3);
    assert_true(classification.undecided[low]);
    assert_false(screened(low));
}

static int listed(const lrcsi_grid *grid, const double xy[2], uint32_t item)
{
    uint32_t x = lrcsi_grid_bucket(grid, xy[0] * view.scale, 0);
    uint32_t y = lrcsi_grid_bucket(grid, xy[1] * view.scale, 1);
    size_t cell = (size_t)y * grid->size + x;
    for (uint32_t i = grid->first[cell]; i < grid->first[cell + 1]; i++) {
        if (grid->item[i] == item) {
            return 1;
        }
    }
    return 0;
}

/* The cell in which a point of an item lies lists the item. */
static void grids_list_every_item_wherever_it_stands(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 20);
    scene_box(&scene, (const double[3]){-3, -0.1, -0.1}, (const double[3]){3, 0.1, 0.2});
    look_from(0.3, 0.2, 1);
    for (uint32_t e = 0; e < classification.events.count; e++) {
        const lrcsi_edge *edge = &view.prepared->topology.edge[classification.events.edge[e]];
        const double *a = view.point[edge->low].x;
        const double *b = view.point[edge->high].x;
        for (int i = 0; i <= 32; i++) {
            const double xy[2] = {a[0] + (b[0] - a[0]) * i / 32, a[1] + (b[1] - a[1]) * i / 32};
            assert_true(listed(&classification.search.grid, xy, e));
        }
    }
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const double *c[3];
        for (int k = 0; k < 3; k++) {
            c[k] = view.point[scene.facet[f].corner[k]].x;
        }
        for (int i = 0; i <= 8 && lrcsi_view_casts(&view, f); i++) {
            for (int j = 0; i + j <= 8; j++) {
                double xy[2];
                for (int k = 0; k < 2; k++) {
                    xy[k] = (c[0][k] * i + c[1][k] * j + c[2][k] * (8 - i - j)) / 8;
                }
                assert_true(listed(&facets, xy, f));
            }
        }
    }
}

static int lists_agree(const lrcsi_grid *some, const lrcsi_grid *all, size_t cell)
{
    uint32_t count = all->first[cell + 1] - all->first[cell];
    if (some->first[cell + 1] - some->first[cell] != count) {
        return 0;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (some->item[some->first[cell] + i] != all->item[all->first[cell] + i]) {
            return 0;
        }
    }
    return 1;
}

/* The cells of the readers have complete lists, and the grid is smaller. */
static void grids_have_complete_lists_where_they_are_read(void **state)
{
    (void)state;
    static unsigned char reads[SCENE_FACETS];
    static uint32_t region[SCENE_FACETS]; /* no facet is the first of its region */
    static signed char none[SCENE_FACETS + LRCSI_MESHLET_FACETS];
    const lrcsi_facet_signs joinable = {none, none}; /* no meshlet is of one region */
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 20);
    scene_box(&scene, (const double[3]){-3, -0.1, -0.1}, (const double[3]){3, 0.1, 0.2});
    look_from(0.3, 0.2, 1);
    for (uint32_t every = 1; every < 200; every += 66) {
        lrcsi_grid some;
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            reads[f] = f % every == 0;
            region[f] = LRCS_NONE;
        }
        const lrcsi_grid_readers readers = {reads, region, &joinable};
        lrcs_work after = work;
        assert_int_equal(lrcsi_grid_facets(&classification.search.grid,
                                           &classification.search.boxes, &readers, &after, &some),
                         LRCS_OK);
        size_t cells = (size_t)some.size * some.size;
        assert_true(every == 1 || some.first[cells] < facets.first[cells]);
        for (uint32_t f = 0; f < scene.scene.facet_count; f += every) {
            lrcsi_grid_rect at =
                lrcsi_view_casts(&view, f)
                    ? lrcsi_grid_buckets(&some, lrcsi_boxes_facet(&classification.search.boxes, f))
                    : (lrcsi_grid_rect){0};
            for (uint32_t y = at.y0; y < at.y1; y++) {
                for (uint32_t x = at.x0; x < at.x1; x++) {
                    assert_true(lists_agree(&some, &facets, (size_t)y * some.size + x));
                }
            }
        }
    }
}

/* Of any two events, the one whose nearest point is nearer comes first. */
static void events_stand_in_order_of_depth(void **state)
{
    (void)state;
    scene_start(&scene);
    for (int i = 0; i < 40; i++) {
        square(0.1 * i, 0.05 * i, 1 - 2 * (i * 13 % 40) / 39.0, 1);
    }
    look_from(0.3, 0.2, 0.9);
    assert_int_equal(classification.events.count, 160);
    for (uint32_t i = 1; i < classification.events.count; i++) {
        assert_true(classification.search.event[i].box.high[2] <=
                    classification.search.event[i - 1].box.high[2]);
    }
}

/* Each triangle of a stack is crossed by edges of all above it. Symptom: testing it against every
   edge in front of it took 15 million steps for 1,000 triangles. */
static void stacked_facets_are_classified_in_linear_time(void **state)
{
    (void)state;
    scene_start(&scene);
    for (uint32_t i = 0; i < 1000; i++) {
        double z = 1e-6 * i;
        uint32_t v = scene_vertex(&scene, 0, 0, z);
        scene_vertex(&scene, 1, 0, z);
        scene_vertex(&scene, 0, 1, z);
        scene_facet(&scene, v, v + 1, v + 2);
    }
    lrcs_pose pose;
    lrcsi_meter meter = {UINT64_MAX, 0, 0};
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.3, 0.2, 0.9}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, &meter, &work, &classification), LRCS_OK);
    assert_true(classification.undecided_count >= 999);
    assert_true(meter.taken <= 600 * 1000);
}

/* The walls of a cone are needles about its tip; the grid lists thousands of edges of its rim where
   their boxes stand. From no direction does anything hide them: each is decided by itself. */
static void needles_about_a_tip_are_decided(void **state)
{
    (void)state;
    static const double directions[3][3] = {{0.3, 0.2, 0.9}, {0.9, 0.1, 0.2}, {-0.2, 0.7, -0.6}};
    const uint32_t n = 4000;
    scene_start(&scene);
    uint32_t tip = scene_vertex(&scene, 0, 0, 1.5);
    uint32_t middle = scene_vertex(&scene, 0, 0, 0);
    for (uint32_t i = 0; i < n; i++) {
        double t = 2 * 3.14159265358979323846 * i / n;
        scene_vertex(&scene, 0.5 * cos(t), 0.5 * sin(t), 0);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t from = middle + 1 + i;
        uint32_t to = middle + 1 + (i + 1) % n;
        scene_facet(&scene, tip, from, to);
        scene_facet(&scene, middle, to, from);
    }
    for (int i = 0; i < 3; i++) {
        look_from(directions[i][0], directions[i][1], directions[i][2]);
        assert_int_equal(classification.undecided_count, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_alone_has_no_undecided_facets),
        cmocka_unit_test(winding_that_changes_makes_no_events),
        cmocka_unit_test(boundary_edges_in_front_make_facets_that_they_cross_undecided),
        cmocka_unit_test(crossings_are_searched_for_once),
        cmocka_unit_test(crossings_are_found_after_the_last_number_of_a_search),
        cmocka_unit_test(boundary_edges_behind_a_facet_do_not_make_it_undecided),
        cmocka_unit_test(boundary_edges_along_boundary_edges_make_nothing_undecided),
        cmocka_unit_test(piercing_and_overlapping_facets_make_each_other_undecided),
        cmocka_unit_test(uniform_neighbours_form_regions),
        cmocka_unit_test(a_rim_along_a_shared_edge_parts_regions),
        cmocka_unit_test(a_plane_through_a_shared_edge_parts_regions),
        cmocka_unit_test(components_end_at_contours),
        cmocka_unit_test(components_and_regions_are_joined_across_every_edge),
        cmocka_unit_test(whole_components_screen_and_others_do_not),
        cmocka_unit_test(events_stand_in_order_of_depth),
        cmocka_unit_test(stacked_facets_are_classified_in_linear_time),
        cmocka_unit_test(needles_about_a_tip_are_decided),
        cmocka_unit_test(grids_list_every_item_wherever_it_stands),
        cmocka_unit_test(grids_have_complete_lists_where_they_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
