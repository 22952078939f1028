/* SPDX-License-Identifier: MIT */
/* Estimates the bulk of the vertices from a sample of them. It affects the speed and the accuracy
   of a view, never its correctness. */
#include "scene/bulk.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "base/sort.h"

/* The largest number of vertices in the sample. */
#define SAMPLE 256u
/* Vertices are left out of the bulk only if that reduces the work of a grid by at least this
   factor. */
#define WORK_RATIO 8.0

/* A sample of the vertices of live facets. */
typedef struct bulk_sample {
    double x[3][SAMPLE];
    double distance[SAMPLE]; /* from the median, in the maximum norm */
    uint32_t count;
} bulk_sample;

/* Takes every stride-th vertex. The stride is odd, so that a model made of many equal pieces is not
   sampled at the same corner of each piece. */
static void sample_take(const lrcs_prepared *p, bulk_sample *s)
{
    uint32_t vertices = p->scene->vertex_count;
    uint32_t stride = (vertices / SAMPLE + 1) | 1;
    s->count = 0;
    for (uint64_t v = 0; v < vertices; v += stride) {
        if (p->referenced[v]) {
            for (int k = 0; k < 3; k++) {
                s->x[k][s->count] = p->vertex[v].x[k];
            }
            s->count++;
        }
    }
}

/* The median of each coordinate, and the distance of each vertex from it. */
static void sample_centre(bulk_sample *s, double median[3])
{
    double sorted[SAMPLE];
    memset(s->distance, 0, sizeof s->distance);
    for (int k = 0; k < 3; k++) {
        memcpy(sorted, s->x[k], s->count * sizeof *sorted);
        lrcsi_sort_ascending(sorted, s->count);
        median[k] = sorted[s->count / 2];
        for (uint32_t i = 0; i < s->count; i++) {
            s->distance[i] = lrcsi_max(s->distance[i], fabs(s->x[k][i] - median[k]));
        }
    }
}

/* The radius of the bulk about the median; 0 if no vertices should be left out. Chooses the radius
   of least cost. A uniform grid of n cells for n vertices that extends to the radius r, where half
   of the vertices are within r', costs about n (r / r')^2. Vertices that are left out fall into
   border cells: if they are close together, c of them fall into a single cell and cost up to c^2
   more. The code divides both costs by n. `whole` is the radius that contains all vertices. */
static double bulk_radius(const bulk_sample *s, double whole, uint32_t vertices)
{
    double sorted[SAMPLE];
    memcpy(sorted, s->distance, s->count * sizeof *sorted);
    lrcsi_sort_ascending(sorted, s->count);
    double half = sorted[s->count / 2];
    double cost_of_all = (whole / half) * (whole / half);
    double least = cost_of_all / WORK_RATIO;
    double radius = 0;
    for (uint32_t left_out = 0; left_out < s->count / 2 && half > 0; left_out++) {
        double ratio = sorted[s->count - 1 - left_out] / half;
        double fraction = (double)left_out / s->count;
        double cost = ratio * ratio + fraction * fraction * vertices;
        if (cost < least) {
            least = cost;
            radius = sorted[s->count - 1 - left_out];
        }
    }
    return radius;
}

void lrcsi_bulk_find(lrcs_prepared *p, const double half[3])
{
    bulk_sample s;
    double median[3];
    memcpy(p->origin, p->centre, sizeof p->origin);
    memcpy(p->bulk, half, sizeof p->bulk);
    sample_take(p, &s);
    if (s.count == 0) {
        return;
    }
    sample_centre(&s, median);
    double whole = 0;
    for (int k = 0; k < 3; k++) {
        whole = lrcsi_max(whole, half[k] + fabs(median[k] - p->centre[k]));
    }
    double radius = 2 * bulk_radius(&s, whole, p->scene->vertex_count);
    for (int k = 0; k < 3 && radius > 0; k++) { /* the box around the vertices within the radius */
        double low = median[k];
        double high = median[k];
        for (uint32_t i = 0; i < s.count; i++) {
            if (s.distance[i] <= radius) {
                low = lrcsi_min(low, s.x[k][i]);
                high = lrcsi_max(high, s.x[k][i]);
            }
        }
        p->origin[k] = 0.5 * (low + high);
        p->bulk[k] = lrcsi_max(high - p->origin[k], p->origin[k] - low);
    }
}
