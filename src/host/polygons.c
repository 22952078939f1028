/* SPDX-License-Identifier: MIT */
/* Visible polygons in memory from the heap, and as a table: CSV, one row a point. */
#include "host/memory.h"

#include <stdlib.h>

typedef struct polygon_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    lrcs_polygons *list;
} polygon_step;

static int run_polygons(void *context, lrcs_work *work)
{
    polygon_step *step = context;
    return lrcs_polygon_run(step->prepared, step->pose, work, step->list);
}

int lrcs_host_polygons_make(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            lrcs_host_polygons *polygons, lrcs_host_error *error)
{
    lrcs_host_polygons p = {{0}, NULL};
    polygon_step step = {scene->prepared, pose, &p.list};
    size_t need = lrcs_polygon_need(scene->prepared);
    int status = lrcsi_host_step_run(&p.blocks, need, run_polygons, &step, error);
    if (status == LRCS_OK) {
        *polygons = p;
    } else if (status != LRCS_E_SYSTEM) {
        lrcsi_host_fail(error, status, "visible polygons: %s", lrcs_status_text(status));
    }
    return status;
}

void lrcs_host_polygons_free(lrcs_host_polygons *polygons)
{
    lrcsi_host_free(polygons->blocks);
    *polygons = (lrcs_host_polygons){{0}, NULL};
}

void lrcs_host_polygons_write(FILE *out, const lrcs_polygons *polygons)
{
    fputs("facet,ring,x_m,y_m,z_m,u_m,v_m\n", out);
    for (uint32_t r = 0; r < polygons->rings; r++) {
        const lrcs_ring *ring = &polygons->ring[r];
        for (uint32_t i = ring->first; i < ring->first + ring->count; i++) {
            const lrcs_ring_point *p = &polygons->point[i];
            const double value[5] = {p->body[0], p->body[1], p->body[2], p->view[0], p->view[1]};
            fprintf(out, "%lu,%lu", (unsigned long)ring->facet, (unsigned long)r);
            for (int k = 0; k < 5; k++) {
                char text[LRCS_HOST_NUMBER_SIZE];
                lrcs_host_number_text(value[k], text);
                fprintf(out, ",%s", text);
            }
            putc('\n', out);
        }
    }
}
