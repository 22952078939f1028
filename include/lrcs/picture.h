/* SPDX-License-Identifier: MIT */
/* What the laser sees, to look at: pixels, vector graphics, and a surface for other programs. */
#ifndef LRCS_PICTURE_H
#define LRCS_PICTURE_H

#include <lrcs/host.h>

/* What colours stand for. What returns nothing is grey by its slant where a scale is. */
enum lrcs_host_look {
    LRCS_HOST_BY_SIGMA = 0, /* sigma per visible projected area, dB */
    LRCS_HOST_BY_THETA,     /* incidence angle, deg */
    LRCS_HOST_BY_RANGE,     /* m towards the laser, from the centre of the scene's box */
    LRCS_HOST_BY_FACET,     /* none is like its neighbours */
    LRCS_HOST_BY_MATERIAL,  /* the model's own colour where it has one */
    LRCS_HOST_BY_SHADE      /* the same under a lamp beside the laser, on a matt surface */
};

/* The look's name ("sigma", "theta", "range", "facet", "material", "shaded"), or NULL. And back:
   LRCS_E_NAME for none. */
const char *lrcs_host_look_text(int look);
int lrcs_host_look_find(const char *name);

typedef struct lrcs_host_picture {
    const lrcs_scene *scene;
    const lrcs_pose *pose;
    const lrcs_facet_record *records; /* of a run from that pose */
    const char *title;                /* what a drawing calls itself */
    int look;                         /* lrcs_host_look */
    int white;                        /* on white paper; 0: on a dark ground */
} lrcs_host_picture;

/* A picture of `size` x `size` pixels (16 .. 16384) as PNG, with its legend and a bar of some
   metres. The image is the run's, of the side that lrcs_host_picture_need gives, for which a
   picture needs no records yet. Status: LRCS_OK; LRCS_E_SYSTEM (memory); LRCS_E_LIMIT. */
uint32_t lrcs_host_picture_need(const lrcs_host_picture *picture, uint32_t size);
int lrcs_host_picture_png(FILE *out, const lrcs_host_picture *picture, const lrcs_image *image,
                          uint32_t size, lrcs_host_error *error);

/* The same from visible polygons, as SVG 1.1: for each facet a path "f12", in metres of the
   observation frame, to the last digit. */
void lrcs_host_picture_svg(FILE *out, const lrcs_host_picture *picture,
                           const lrcs_polygons *polygons);

/* The scene's facets in the body frame (m) with what the laser sees of each, as ParaView and VTK
   read it: XML PolyData (.vtp, text) or the legacy format (.vtk, binary).
   Cell data: cos_theta, area_m2, visible_area_m2 (projected), visible_fraction (of the projected
   area; 0 where that is 0), sigma_m2, material, part. Field data: direction (to the laser, body
   frame, unit length). */
void lrcs_host_vtk_write(FILE *out, const lrcs_host_picture *picture, int xml);

#endif
