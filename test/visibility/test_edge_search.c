/* SPDX-License-Identifier: MIT */
/* A search near a facet finds every event edge that a loop over all of them finds, and leaves out
   most of those that are far away. */
#include "visibility/proximity/edge_search.h"

#include "integer_view.h"

static unsigned char found[SCENE_FACETS];

/* The distance of a point from the segment a b, in projection. */
static double point_distance(const double x[3], const double a[3], const double b[3])
{
    double along[2] = {b[0] - a[0], b[1] - a[1]};
    double square = along[0] * along[0] + along[1] * along[1];
    double t = square > 0 ? ((x[0] - a[0]) * along[0] + (x[1] - a[1]) * along[1]) / square : 0;
    t = fmin(1, fmax(0, t));
    return hypot(a[0] + t * along[0] - x[0], a[1] + t * along[1] - x[1]);
}

static double cross(const double a[3], const double b[3], const double x[3])
{
    return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
}

/* The distance of two segments; 0 if they intersect. */
static double segment_distance(const double p[3], const double q[3], const double a[3],
                               const double b[3])
{
    if (cross(p, q, a) * cross(p, q, b) < 0 && cross(a, b, p) * cross(a, b, q) < 0) {
        return 0;
    }
    return fmin(fmin(point_distance(p, a, b), point_distance(q, a, b)),
                fmin(point_distance(a, p, q), point_distance(b, p, q)));
}

/* The distance of a facet and an edge in projection. */
static double facet_distance(uint32_t facet, const lrcsi_edge *e)
{
    const uint32_t *corner = scene.facet[facet].corner;
    const double *p = view.point[e->low].x;
    const double *q = view.point[e->high].x;
    double nearest = HUGE_VAL;
    int left = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = view.point[corner[k]].x;
        const double *b = view.point[corner[(k + 1) % 3]].x;
        nearest = fmin(nearest, segment_distance(p, q, a, b));
        double turn = cross(a, b, p);
        left += (turn > 0) - (turn < 0);
    }
    return left == 3 || left == -3 ? 0 : nearest; /* it begins inside */
}

/* Marks the events that a search finds. */
static void mark_found(const lrcsi_grid *grid, const lrcsi_edge_search *search, double near)
{
    int line = 0;
    lrcsi_grid_walk walk = search->rows;
    lrcsi_grid_row row;
    memset(found, 0, sizeof found);
    while (lrcsi_grid_walk_next(&walk, &row)) {
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, row.y, row.x0, row.x1);
        for (uint32_t i = items.from; i < items.to; i++) {
            const lrcsi_edge *e =
                &view.prepared->topology.edge[classification.events.edge[grid->item[i]]];
            found[grid->item[i]] |= !lrcsi_edge_search_excludes(search, view.point[e->low].x,
                                                                view.point[e->high].x, near, &line);
        }
    }
}

static void a_search_finds_what_a_loop_finds(void **state)
{
    (void)state;
    uint64_t random = 20261130;
    unsigned near_ones = 0;
    unsigned far_ones = 0;
    unsigned left_out = 0;
    for (int i = 0; i < 200; i++) {
        const uint32_t count = 24;
        scene_tangle(&random, 40, count);
        look_along_any(&random);
        uint32_t events = classification.events.count;
        double size = hypot(view.side, view.side);
        lrcsi_grid grid = lrcsi_grid_empty(&view, 4 * events);
        assert_int_equal(
            lrcsi_grid_edges(classification.events.edge, events, 8 * events, &work, &grid),
            LRCS_OK);
        for (uint32_t f = 0; f < count; f++) {
            double near = size * random_unit(&random) * (f % 2 == 0 ? 0.01 : 0.2);
            lrcsi_edge_search search = lrcsi_edge_search_make(&view, &grid, f, near);
            mark_found(&grid, &search, near);
            for (uint32_t e = 0; e < events; e++) {
                double distance =
                    facet_distance(f, &view.prepared->topology.edge[classification.events.edge[e]]);
                if (distance <= near) {
                    assert_true(found[e]);
                    near_ones++;
                } else if (distance > 2 * near) {
                    far_ones++;
                    left_out += !found[e];
                }
            }
        }
    }
    assert_true(near_ones > 10000);
    assert_true(left_out > 0.9 * far_ones);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_search_finds_what_a_loop_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
