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

/* The radius of the bulk about the median; 0 if no vertices should be left out. Chooses the radius
   of least cost. A uniform grid of n cells for n vertices that extends to the radius r, where half
   of the vertices are within r', costs about n (r / r')^2. Vertices that are left out fall into
   border cells: if they are close together, c of them fall into a single cell and cost up to c^2
   more. The code divides both costs by n.
   Given: the distances of the `count` vertices of the sample from the median, ascending; `whole`,
   the radius that contains all vertices. */
static double bulk_radius(const double *distance, uint32_t count, double whole, uint32_t vertices)
{
    double half = distance[count / 2];
    double cost_of_all = (whole / half) * (whole / half);
    double least = cost_of_all / WORK_RATIO;
    double radius = 0;
    for (uint32_t left_out = 0; left_out < count / 2 && half > 0; left_out++) {
        double ratio = distance[count - 1 - left_out] / half;
        double fraction = (double)left_out / count;
        double cost = ratio * ratio + fraction * fraction * vertices;
        if (cost < least) {
            least = cost;
            radius = distance[count - 1 - left_out];
        }
    }
    return radius;
}

void lrcsi_bulk_find(lrcs_prepared *p, const double half[3])
{
    memcpy(p->origin, p->centre, sizeof p->origin);
    memcpy(p->bulk, half, sizeof p->bulk);
    /* 1. a sample of the vertices of live facets: every stride-th. The stride is odd, so that a
       model made of many equal bodies is not sampled at the same corner of each body. */
    double x[3][SAMPLE];
    uint32_t count = 0;
    uint32_t vertices = p->scene->vertex_count;
    uint32_t stride = (vertices / SAMPLE + 1) | 1;
    for (uint64_t v = 0; v < vertices; v += stride) {
        if (p->referenced[v]) {
            for (int k = 0; k < 3; k++) {
                x[k][count] = p->vertex[v].x[k];
            }
            count++;
        }
    }
    if (count == 0) {
        return;
    }
    /* 2. the median of each coordinate, and the distances from it in the maximum norm */
    double median[3];
    double distance[SAMPLE] = {0};
    double sorted[SAMPLE];
    double whole = 0;
    for (int k = 0; k < 3; k++) {
        memcpy(sorted, x[k], count * sizeof *sorted);
        lrcsi_sort_ascending(sorted, count);
        median[k] = sorted[count / 2];
        for (uint32_t i = 0; i < count; i++) {
            distance[i] = lrcsi_max(distance[i], fabs(x[k][i] - median[k]));
        }
        whole = lrcsi_max(whole, half[k] + fabs(median[k] - p->centre[k]));
    }
    memcpy(sorted, distance, count * sizeof *sorted);
    lrcsi_sort_ascending(sorted, count);
    /* 3. the radius; the box around the vertices within twice of it */
    double radius = 2 * bulk_radius(sorted, count, whole, vertices);
    for (int k = 0; k < 3 && radius > 0; k++) {
        double low = median[k];
        double high = median[k];
        for (uint32_t i = 0; i < count; i++) {
            if (distance[i] <= radius) {
                low = lrcsi_min(low, x[k][i]);
                high = lrcsi_max(high, x[k][i]);
            }
        }
        p->origin[k] = 0.5 * (low + high);
        p->bulk[k] = lrcsi_max(high - p->origin[k], p->origin[k] - low);
    }
}
