/* SPDX-License-Identifier: MIT */
/* The flat faces that a part shows the laser: a disc, the end of a solid cylinder, cone, frustum,
   dome or paraboloid, a plate, or up to three faces of a box. */
#ifndef LRCSI_FACE_FRAME_H
#define LRCSI_FACE_FRAME_H

#include "visibility/proximity/event_band.h"

/* Every part has so many numbers of faces: those of part i begin at i times this. */
#define LRCSI_FACES_OF_PART 3u

/* Where it is. Lengths are scaled. */
typedef struct lrcsi_face_frame {
    uint32_t number, part, facet;         /* one of its facets */
    double centre[3], plane[2][3], up[3]; /* unit vectors in its plane; its normal, to the laser */
    double radius; /* of a circle that lies in the true face and in that of the facets */
    double outer;  /* of one about the same centre that contains both */
    double
        plane_err; /* of a rectangle: how far its facets are from the plane of one of them, at most;
                         of a circle, bounds.position_err tells */
    int is_rectangle;
    double half[2]; /* half its lengths along the vectors in its plane; the circles are not used */
    double view[2], axis[2][2]; /* the centre and these vectors in projection */
    double det;                 /* of these: the cosine of the incidence, with a sign */
} lrcsi_face_frame;

/* The number of the face that a facet is on; LRCS_NONE if it is on none, or does not face the
   laser. */
uint32_t lrcsi_face_of(const lrcsi_view *view, uint32_t facet);

static inline int lrcsi_face_has_facet(const lrcsi_view *view, uint32_t facet)
{
    return lrcsi_face_of(view, facet) != LRCS_NONE;
}

/* Which sides of such a facet are sides of the face: bit k stands for the side from corner k to
   k + 1. */
unsigned lrcsi_face_border_sides(const lrcsi_view *view, uint32_t facet);

/* The face of a number. Returns 0 if there is none, or it is seen too obliquely, or one of its
   facets hides nothing (another takes its place), or rounding has turned the facets of a rectangle,
   or the depth order of the face and an open curved part is not known and that part is not beside
   it, or the limit of steps is reached. */
int lrcsi_face_frame_make(lrcsi_event_bands *bands, uint32_t number, lrcsi_face_frame *face);

/* The coordinates in the plane of the face, along the vectors in it, of a point of the view
   plane. */
void lrcsi_face_coordinates(const lrcsi_face_frame *face, const double x[2], double at[2]);

/* The largest coordinate k in projection, from its centre, of any point of the true face or that of
   the facets. */
double lrcsi_face_extent(const lrcsi_face_frame *face, int k);

/* Is a point of the view plane in the face, and all within a distance of it? */
int lrcsi_face_contains(const lrcsi_face_frame *face, const double x[2], double distance);

/* The part of a segment of the view plane that is in the face with all points within a distance of
   it. */
lrcsi_segment_part lrcsi_face_segment_inside(const lrcsi_face_frame *face, const double a[2],
                                             const double b[2], double distance);

/* A part of it that contains all its points within a distance of the face. */
lrcsi_segment_part lrcsi_face_segment_near(const lrcsi_face_frame *face, const double a[2],
                                           const double b[2], double distance);

/* Are the facets of a part so far from the face in projection that neither they nor the true shape
   hide anything near it? */
int lrcsi_face_part_is_beside(const lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                              uint32_t part);

/* Does a plane separate a part, in front, from the face's part? Returned: the area in projection of
   the face for which that is not proved. */
int lrcsi_face_part_is_separated_in_front(lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                                          uint32_t part, double *unproved);

/* Is a part behind all of the face's part, with nothing left unproved on any facet of the face? */
int lrcsi_face_part_is_behind(lrcsi_event_bands *bands, const lrcsi_face_frame *face,
                              uint32_t part);

#endif
