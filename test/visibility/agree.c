/* SPDX-License-Identifier: MIT */
/* Cells of the view plane (visibility/cells.h) against facets one by one (visibility/query.h,
   visibility/occlude.h): on each model given, from so many directions, whether the bounds of all
   facets overlap, and what both cost. Ends with 1 where some do not.
   Given: agree DIRECTIONS FILE... */
#include <lrcs/host.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/work.h"
#include "visibility/cells.h"
#include "visibility/occlude.h"

#define MEMORY ((size_t)1 << 30)
#define PI     3.14159265358979323846

typedef struct agree_sums {
    uint64_t asked, left, apart;
    double worst;        /* gap between bounds */
    double ours, theirs; /* widths of bounds, of facets that cells decide */
    double cells_ms, facets_ms;
} agree_sums;

static double now_ms(void)
{
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
}

/* Six along the axes, then directions spread over the sphere; every other one of coordinates so
   round that edges come to lie over each other. */
static lrcs_pose pose_of(int number)
{
    double z = 1 - 2 * fmod((number + 0.5) * 0.6180339887498949, 1.0);
    double turn = 2 * PI * fmod((number + 0.5) * 0.7548776662466927, 1.0);
    double flat = sqrt(1 - z * z);
    double to[3] = {flat * cos(turn), flat * sin(turn), z};
    for (int k = 0; k < 3; k++) {
        if (number < 6) {
            to[k] = number / 2 == k ? 1 - 2 * (number % 2) : 0;
        } else if (number % 2 == 0) {
            to[k] = floor(4 * to[k] + 0.5) / 4;
        }
    }
    lrcs_pose pose;
    if (lrcs_pose_from_direction(to, &pose) != LRCS_OK) {
        exit(2);
    }
    return pose;
}

static void must(int status)
{
    if (status != LRCS_OK) {
        fprintf(stderr, "%s\n", lrcs_status_text(status));
        exit(2);
    }
}

/* One direction: all facets that can be seen, by cells and one by one. */
static void agree_pose(const lrcs_prepared *prepared, int number, lrcs_work *work,
                       unsigned char *open, lrcsi_visible *found, agree_sums *sums)
{
    lrcsi_view view;
    lrcsi_contest contest;
    lrcsi_occluding o;
    uint32_t count = prepared->scene->facet_count;
    lrcs_pose pose = pose_of(number);
    work->used = 0;
    must(lrcsi_view_make(prepared, &pose, work, &view));
    must(lrcsi_contest_make(&view, work, &contest));
    for (uint32_t f = 0; f < count; f++) {
        open[f] = lrcsi_grid_casts(&view, f) != 0;
        sums->asked += open[f];
    }
    double start = now_ms();
    lrcsi_cells_areas(&contest, work, open, found);
    double middle = now_ms();
    must(lrcsi_occlude_make(&contest, work, &o));
    for (uint32_t f = 0; f < count; f++) {
        must(lrcsi_occlude_open(&o, f));
        lrcsi_visible one = lrcsi_occlude_area(&o);
        sums->left += open[f];
        if (!lrcsi_grid_casts(&view, f) || open[f]) {
            continue;
        }
        double gap = fmax(found[f].low - one.high, one.low - found[f].high);
        sums->ours += found[f].high - found[f].low;
        sums->theirs += one.high - one.low;
        sums->worst = fmax(sums->worst, gap);
        if (!(gap <= 1e-16 * lrcsi_view_projected(&view, f))) {
            printf("apart: direction %d facet %u cells %.17g .. %.17g alone %.17g .. %.17g\n",
                   number, f, found[f].low, found[f].high, one.low, one.high);
            sums->apart++;
        }
    }
    sums->cells_ms += middle - start;
    sums->facets_ms += now_ms() - middle;
}

int main(int argc, char **argv)
{
    lrcs_work work = lrcs_work_make(malloc(MEMORY), MEMORY);
    lrcs_host_options options = lrcs_host_options_default();
    int directions = argc > 1 ? atoi(argv[1]) : 0;
    int status = argc < 3 || directions < 1 || !work.bytes ? 2 : 0;
    for (int i = 2; i < argc && status != 2; i++) {
        lrcs_host_scene scene;
        lrcs_host_error error;
        agree_sums sums = {0};
        memset(&scene, 0, sizeof scene);
        if (lrcs_host_scene_read(argv[i], &options, &scene, &error) != LRCS_OK ||
            lrcs_host_scene_prepare(&scene, &error) != LRCS_OK) {
            fprintf(stderr, "%s: cannot be read\n", argv[i]);
            return 2;
        }
        uint32_t count = scene.prepared->scene->facet_count;
        unsigned char *open = malloc(count);
        lrcsi_visible *found = malloc(count * sizeof *found);
        if (!open || !found) {
            return 2;
        }
        for (int n = 0; n < directions; n++) {
            agree_pose(scene.prepared, n, &work, open, found, &sums);
        }
        printf(
            "%s: %llu facets, %llu left, %llu apart (worst gap %.3g); widths %.3g, alone %.3g; ms "
            "a pose %.2f, alone %.2f\n",
            argv[i], (unsigned long long)sums.asked, (unsigned long long)sums.left,
            (unsigned long long)sums.apart, sums.worst, sums.ours, sums.theirs,
            sums.cells_ms / directions, sums.facets_ms / directions);
        fflush(stdout);
        status |= sums.apart != 0;
        free(open);
        free(found);
        lrcs_host_scene_free(&scene);
    }
    return status;
}
