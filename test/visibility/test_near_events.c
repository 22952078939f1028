/* SPDX-License-Identifier: MIT */
/* The event edges near each facet of curved parts: all that are near enough to matter are listed, and
   none that a search for the facet alone excludes. */
#include "visibility/proximity/near_events.h"

#include "facet_distance.h"
#include "pair.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_event_bands bands;
static lrcsi_near_events near;

/* A shape above a plate and oblique to it, seen from a direction. */
static void look_at(const lrcs_shape *above, double tilt, double x, double y, double z)
{
    const double turned[3][3] = {{1, 0, 0}, {0, cos(tilt), -sin(tilt)}, {0, sin(tilt), cos(tilt)}};
    const lrcs_prepared *prepared =
        pair_prepare(above, &plate, (const double[3]){0.1, 0, -1}, turned, 0, &scene, &work);
    static unsigned char memory[1u << 22];
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_event_bands_make(&view, NULL, &work, &bands), LRCS_OK);
    const size_t need = lrcsi_near_events_need(prepared);
    assert_true(need <= sizeof memory);
    lrcs_work room = lrcs_work_make(memory, need);
    assert_int_equal(lrcsi_near_events_make(&bands, &room, &near), LRCS_OK);
}

/* How often an event is listed for the facet. */
static int times_listed(uint32_t event)
{
    int times = 0;
    for (uint32_t i = 0; i < near.count; i++) {
        times += near.listed[i] == event;
    }
    return times;
}

/* May an event matter for a facet? Not if it is of the same part, unless the laser sees its inside. */
static int applies(uint32_t event, uint32_t facet)
{
    return bands.events.part[event] != scene.facet_part[facet] ||
           lrcsi_band_sees_inside(&bands, facet);
}

/* The distance within which it does, at most. */
static double slack_of(uint32_t event, uint32_t facet)
{
    const lrcsi_proximity *p = &view.prepared->proximity;
    return 2 * p->reach[scene.facet_part[facet]] + 3 * p->hausdorff[bands.events.part[event]];
}

/* Checks the lists of all facets of a meshlet. Returns how many events are listed. */
static unsigned check_meshlet(uint32_t start, uint32_t end)
{
    uint32_t facet[LRCSI_MESHLET_FACETS];
    unsigned listed = 0;
    for (uint32_t f = start; f < end; f++) {
        facet[f - start] = f;
    }
    lrcsi_near_events_of_meshlet(&near, facet, end - start);
    for (uint32_t f = start; f < end; f++) {
        const lrcsi_band_search where = lrcsi_band_search_make(&bands, f);
        assert_int_equal(lrcsi_near_events_of_facet(&near, f, &where), 1);
        for (uint32_t e = 0; e < bands.events.count; e++) {
            int line = 0;
            const int times = times_listed(e);
            const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[e]];
            assert_true(times <= 1);
            assert_true(times == 0 ||
                        (applies(e, f) && !lrcsi_band_excludes(&bands, &where, e, &line)));
            if (applies(e, f) && facet_distance(&view, f, edge) <= slack_of(e, f)) {
                assert_int_equal(times, 1);
            }
        }
        listed += near.count;
    }
    return listed;
}

static void events_near_facets_are_listed(void **state)
{
    (void)state;
    const lrcs_shape tube = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.3, .length = 1};
    const lrcs_shape *const shape[2] = {&ball, &tube};
    unsigned listed = 0;
    unsigned facets = 0;
    for (int i = 0; i < 8; i++) {
        look_at(shape[i % 2], 0.4 * i, 0.3 * i - 1, 0.2, 1 - 0.1 * i);
        for (uint32_t start = 0; start < scene.facet_count; start += LRCSI_MESHLET_FACETS) {
            listed += check_meshlet(start, lrcsi_meshlet_end(start, scene.facet_count));
        }
        facets += scene.facet_count;
    }
    assert_true(listed > 500 && listed < 20 * facets);
}

static void few_steps_leave_lists_incomplete(void **state)
{
    (void)state;
    const uint32_t facet[1] = {0};
    look_at(&ball, 0, 0.2, 0.1, 1);
    const lrcsi_band_search where = lrcsi_band_search_make(&bands, 0);
    int known = 0;
    for (uint64_t limit = 0; !known && limit < 10000; limit++) {
        lrcsi_meter meter = {.limit = limit};
        bands.meter = &meter;
        lrcsi_near_events_of_meshlet(&near, facet, 1);
        known = lrcsi_near_events_of_facet(&near, 0, &where);
        assert_int_equal(known, !meter.spent);
        assert_true(limit > 0 || !known);
    }
    assert_true(known);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_near_facets_are_listed),
        cmocka_unit_test(few_steps_leave_lists_incomplete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
