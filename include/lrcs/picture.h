/* SPDX-License-Identifier: MIT */
/* What the laser sees, to look at: pixels, vector graphics, and a surface for other programs. */
#ifndef LRCS_PICTURE_H
#define LRCS_PICTURE_H

#include <lrcs/host.h>

/* The quantity that colours show. Where there is a colour scale, surfaces that return nothing are
   grey, shaded by their incidence angle. */
enum lrcs_host_colouring {
    LRCS_HOST_BY_SIGMA = 0, /* sigma per visible projected area, dB */
    LRCS_HOST_BY_THETA,     /* incidence angle, deg */
    LRCS_HOST_BY_RANGE,     /* m towards the laser, from the centre of the scene's box */
    LRCS_HOST_BY_FACET,     /* neighbouring facets have different colours */
    LRCS_HOST_BY_MATERIAL,  /* false colours that tell 64 materials apart, named in the legend */
    LRCS_HOST_BY_SHADE      /* the model's own colours, a matt surface lit by a lamp beside the
                               laser */
};

/* The name of a colour mapping ("sigma", "theta", "range", "facet", "material", "shaded"), or
   NULL. lrcs_host_colouring_find is the inverse: LRCS_E_NAME for an unknown name. */
const char *lrcs_host_colouring_text(int colouring);
int lrcs_host_colouring_find(const char *name);

typedef struct lrcs_host_picture {
    const lrcs_scene *scene;
    const lrcs_pose *pose;
    const lrcs_facet_record *records; /* of a run for that pose */
    const char *title;                /* also the title element of an SVG drawing */
    int colouring;                    /* lrcs_host_colouring */
    int white;                        /* 1: white background; 0: dark background */
    int annotated; /* 1: the title and the laser's azimuth and elevation stand above the picture,
                      and the body's axes in a corner; not in a PNG of less than 320 pixels */
    const char *about; /* what it was made from: in a PNG a comment, in an SVG metadata; or NULL */
} lrcs_host_picture;

/* Writes a picture of `size` x `size` pixels (16 .. 16384) as PNG, with a legend and a scale bar in
   metres. `image` comes from the run and has the size that lrcs_host_picture_need returns;
   lrcs_host_picture_need does not use picture->records. Status: LRCS_OK; LRCS_E_SYSTEM (memory);
   LRCS_E_LIMIT. */
uint32_t lrcs_host_picture_need(const lrcs_host_picture *picture, uint32_t size);
int lrcs_host_picture_png(FILE *out, const lrcs_host_picture *picture, const lrcs_image *image,
                          uint32_t size, lrcs_host_error *error);

/* The same from visible polygons, as SVG 1.1: one path per facet ("f12"), in metres of the
   observation frame, with all 17 significant digits. */
void lrcs_host_picture_svg(FILE *out, const lrcs_host_picture *picture,
                           const lrcs_polygons *polygons);

/* Writes the scene's facets in the body frame (m) with the visible part of each, for ParaView and
   VTK: XML PolyData (.vtp, text) or the legacy format (.vtk, binary).
   Cell data: cos_theta, area_m2, visible_area_m2 (projected), visible_fraction (of the projected
   area; 0 if that is 0), sigma_m2, material, part. Field data: direction (to the laser, body
   frame, unit length). */
void lrcs_host_vtk_write(FILE *out, const lrcs_host_picture *picture, int xml);

#endif
