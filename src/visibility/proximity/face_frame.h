/* SPDX-License-Identifier: MIT */
/* The flat face that a part shows the laser: a disc, or the end of a solid cylinder, cone, frustum,
   dome or paraboloid. */
#ifndef LRCSI_FACE_FRAME_H
#define LRCSI_FACE_FRAME_H

#include "visibility/proximity/event_band.h"

/* Where it is. Lengths are scaled. */
typedef struct lrcsi_face_frame {
    uint32_t part, facet;     /* one of its facets */
    double centre[3], radius; /* of a circle that lies in the true face and in that of the facets */
    double outer;             /* of one about the same centre that contains both */
    double view[2], axis[2][2]; /* the centre and the part's x and y axes in projection */
    double det;                 /* of these axes: the cosine of the incidence, with a sign */
} lrcsi_face_frame;

/* May a facet be one of such a face, and does it face the laser? */
int lrcsi_face_has_facet(const lrcsi_view *view, uint32_t facet);

/* Which sides of such a facet are sides of the face: bit k stands for the side from corner k to
   k + 1. */
unsigned lrcsi_face_border_sides(const lrcsi_view *view, uint32_t facet);

/* The face of a part. Returns 0 if there is none, or it is seen too obliquely, or one of its facets
   hides nothing (another takes its place), or the depth order of the face and an open curved part
   is not known and that part is not beside it, or the limit of steps is reached. */
int lrcsi_face_frame_make(lrcsi_event_bands *bands, uint32_t part, lrcsi_face_frame *face);

/* The coordinates in the plane of the face, along the part's x and y axes, of a point of the view
   plane. */
void lrcsi_face_coordinates(const lrcsi_face_frame *face, const double x[2], double at[2]);

/* Is a point of the view plane in the face, and all within a distance of it? */
int lrcsi_face_contains(const lrcsi_face_frame *face, const double x[2], double distance);

/* The part of a segment of the view plane that is in the face with all points within a distance of
   it. */
lrcsi_segment_part lrcsi_face_segment_inside(const lrcsi_face_frame *face, const double a[2],
                                             const double b[2], double distance);

/* A part of it that contains all its points within a distance of the face. */
lrcsi_segment_part lrcsi_face_segment_near(const lrcsi_face_frame *face, const double a[2],
                                           const double b[2], double distance);

/* Is a part behind all of the face's part, with nothing left unproved on any facet of the face? */
int lrcsi_face_part_is_behind(lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                              uint32_t part);

#endif
