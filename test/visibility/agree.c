/* SPDX-License-Identifier: MIT */
/* Compares three methods: cells of the view plane for all facets together (visibility/cells/cells.h),
   cells of each facet alone (visibility/cells/facet_cells.h), and the clipping that both replaced
   (test/visibility/reference). For each given model or scene and the given number of directions, it
   tests whether the bounds of all facets overlap, and prints the cost of each method. The exit
   status is 1 if some bounds do not overlap.
   Given: agree DIRECTIONS FILE... */
#include <lrcs/host.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/work.h"
#include "visibility/cells/cells.h"
#include "visibility/cells/facet_cells.h"
#include "visibility/reference/occlude.h"

#define MEMORY ((size_t)1 << 30)
#define PI     3.14159265358979323846

/* One method of finding areas, compared with the reference. */
typedef struct agree_way {
    const char *name;
    uint64_t compared, undecided, apart;
    double worst;                  /* the largest gap between bounds */
    double width, reference_width; /* sums of the widths of bounds */
    double ms;
} agree_way;

typedef struct agree_sums {
    agree_way together, alone;
    double ms; /* of the reference */
} agree_sums;

static double now_ms(void)
{
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
}

/* The first six directions are along the axes; the others are spread over the sphere. Every other
   one of these is rounded to coordinates that are multiples of 1/4, so that edges coincide in
   projection. */
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

static void agree_facet(agree_way *way, int number, uint32_t facet, double projected,
                        const lrcsi_visible_area *found, const lrcsi_visible_area *clipped)
{
    double gap = fmax(found->low - clipped->high, clipped->low - found->high);
    way->compared++;
    way->width += found->high - found->low;
    way->reference_width += clipped->high - clipped->low;
    way->worst = fmax(way->worst, gap);
    if (!(gap <= 1e-16 * projected)) {
        printf("apart: direction %d facet %u %s %.17g .. %.17g clipped %.17g .. %.17g\n", number,
               facet, way->name, found->low, found->high, clipped->low, clipped->high);
        way->apart++;
    }
}

/* One direction: all facets that can be visible, together; then each undecided facet alone. */
static void agree_pose(const lrcs_prepared *prepared, int number, lrcs_work *work,
                       unsigned char *wanted, unsigned char *decided, lrcsi_visible_area *found,
                       agree_sums *sums)
{
    lrcsi_view view;
    lrcsi_classification classification;
    ref_occluding o;
    lrcsi_facet_cells a;
    uint32_t count = prepared->scene->facet_count;
    lrcs_pose pose = pose_of(number);
    work->used = 0;
    must(lrcsi_view_make(prepared, &pose, work, &view));
    must(lrcsi_classify_make(&view, NULL, work, &classification));
    for (uint32_t f = 0; f < count; f++) {
        wanted[f] = lrcsi_view_casts(&view, f) != 0;
    }
    double start = now_ms();
    lrcsi_cells_areas(&classification, NULL, NULL, work, NULL, wanted, decided, found, NULL);
    sums->together.ms += now_ms() - start;
    must(ref_occlude_make(&classification, work, &o));
    must(lrcsi_facet_cells_make(&classification, NULL, &o.cover.facets, work, &a));
    for (uint32_t f = 0; f < count; f++) {
        if (!lrcsi_view_casts(&view, f)) {
            continue;
        }
        double projected = lrcsi_view_projected(&view, f);
        start = now_ms();
        must(ref_occlude_open(&o, f));
        lrcsi_visible_area clipped = ref_occlude_area(&o);
        sums->ms += now_ms() - start;
        int found_together = !wanted[f] || decided[f];
        sums->together.undecided += !found_together;
        if (found_together) {
            agree_facet(&sums->together, number, f, projected, &found[f], &clipped);
        }
        if (classification.undecided[f]) {
            start = now_ms();
            lrcsi_facet_cells_open(&a, f);
            while (lrcsi_facet_cells_next(&a)) {
            }
            lrcsi_visible_area one = lrcsi_facet_cells_close(&a);
            sums->alone.ms += now_ms() - start;
            sums->alone.undecided += a.perhaps_hidden + a.perhaps_visible > 0;
            agree_facet(&sums->alone, number, f, projected, &one, &clipped);
        }
    }
}

static void agree_print(const agree_way *way, int directions)
{
    printf("    %-8s %llu facets, %llu in doubt, %llu apart (worst gap %.3g); widths %.3g, "
           "clipped "
           "%.3g; %.2f ms a pose\n",
           way->name, (unsigned long long)way->compared, (unsigned long long)way->undecided,
           (unsigned long long)way->apart, way->worst, way->width, way->reference_width,
           way->ms / directions);
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
        agree_sums sums = {{.name = "together"}, {.name = "alone"}, 0};
        memset(&scene, 0, sizeof scene);
        if (lrcs_host_scene_read(argv[i], &options, &scene, &error) != LRCS_OK ||
            lrcs_host_scene_prepare(&scene, &error) != LRCS_OK) {
            fprintf(stderr, "%s: cannot be read\n", argv[i]);
            return 2;
        }
        uint32_t count = scene.prepared->scene->facet_count;
        unsigned char *wanted = malloc(count);
        unsigned char *decided = malloc(count);
        lrcsi_visible_area *found = malloc(count * sizeof *found);
        if (!wanted || !decided || !found) {
            return 2;
        }
        for (int n = 0; n < directions; n++) {
            agree_pose(scene.prepared, n, &work, wanted, decided, found, &sums);
        }
        printf("%s: clipped in %.2f ms a pose\n", argv[i], sums.ms / directions);
        agree_print(&sums.together, directions);
        agree_print(&sums.alone, directions);
        fflush(stdout);
        status |= sums.together.apart + sums.alone.apart != 0;
        free(wanted);
        free(decided);
        free(found);
        lrcs_host_scene_free(&scene);
    }
    return status;
}
