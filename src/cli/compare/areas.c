/* SPDX-License-Identifier: MIT */
/* Mistakes in the area of a facet that is summed, and in the cosine and material that it is shaded
   with. mistakes.c lists the mistakes. */
#include "cli/compare/mistakes.h"

#include <math.h>
#include <string.h>

#define TWINS_MOST 256u /* scenes with more facets are not searched for coincident facets */

static int point_fill(const mistake_view *view, uint32_t facet, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_material *material = &scene->material[scene->facet_material[facet]];
    spot->brdf = &material->brdf;
    spot->c = fmin(fabs(view->records[facet].cos_theta), 1.0);
    return view->records[facet].cos_theta > 0.0 || material->two_sided;
}

double cli_mistake_seen(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    return point_fill(view, facet, spot) ? view->records[facet].visible_area_m2 : 0.0;
}

double cli_area_unshadowed(const mistake_view *view, uint32_t facet, int corner,
                           mistake_point *spot)
{
    (void)corner;
    return point_fill(view, facet, spot) ? view->records[facet].area_m2 * spot->c : 0.0;
}

double cli_area_backs(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    point_fill(view, facet, spot);
    return view->records[facet].visible_area_m2;
}

double cli_area_all(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    (void)corner;
    point_fill(view, facet, spot);
    return view->records[facet].area_m2 * spot->c;
}

double cli_area_one_sided(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    double area = cli_mistake_seen(view, facet, corner, spot);
    return view->records[facet].cos_theta > 0.0 ? area : 0.0;
}

/* Front and back sides exchanged. */
double cli_area_flipped(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    int two_sided = scene->material[scene->facet_material[facet]].two_sided;
    double area = cli_area_backs(view, facet, corner, spot);
    return two_sided || view->records[facet].cos_theta < 0.0 ? area : 0.0;
}

double cli_area_one_material(const mistake_view *view, uint32_t facet, int corner,
                             mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    double area = cli_mistake_seen(view, facet, corner, spot);
    spot->brdf = &scene->material[scene->facet_material[0]].brdf;
    return area;
}

/* The material changes one facet too late. */
double cli_area_next_material(const mistake_view *view, uint32_t facet, int corner,
                              mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const lrcs_material *worn = &scene->material[scene->facet_material[facet ? facet - 1 : 0]];
    double area = cli_area_backs(view, facet, corner, spot);
    spot->brdf = &worn->brdf;
    return worn->two_sided || view->records[facet].cos_theta > 0.0 ? area : 0.0;
}

/* Shading by the mean normal at each corner. */
double cli_area_smooth(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    const double *n = view->scene->normal[scene->facet[facet].corner[corner]].x;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double area = cli_mistake_seen(view, facet, corner, spot);
    double c = 0.0;
    for (int k = 0; k < 3; k++) {
        c += length > 0.0 ? n[k] / length * view->direction[k] : 0.0;
    }
    c = view->records[facet].cos_theta < 0.0 ? -c : c;
    spot->c = fmin(c, 1.0);
    return c > 0.0 ? area : 0.0;
}

static int facets_coincide(const lrcs_scene *scene, uint32_t a, uint32_t b)
{
    for (int k = 0; k < 3; k++) {
        if (memcmp(&scene->vertex[scene->facet[a].corner[k]],
                   &scene->vertex[scene->facet[b].corner[k]], sizeof *scene->vertex) != 0) {
            return 0;
        }
    }
    return 1;
}

/* Of coincident facets the last one is counted instead of the first. */
double cli_area_last(const mistake_view *view, uint32_t facet, int corner, mistake_point *spot)
{
    const lrcs_scene *scene = &view->scene->host.scene;
    double area = cli_mistake_seen(view, facet, corner, spot);
    uint32_t count = scene->facet_count <= TWINS_MOST ? scene->facet_count : 0;
    for (uint32_t i = facet + 1; i < count && area > 0.0; i++) {
        if (facets_coincide(scene, facet, i)) {
            spot->brdf = &scene->material[scene->facet_material[i]].brdf;
        }
    }
    return area;
}
