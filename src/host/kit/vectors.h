/* SPDX-License-Identifier: MIT */
/* What a kit is written from: its scenes as tables, their meshes, and the truth of each case. */
#ifndef LRCSI_KIT_VECTORS_H
#define LRCSI_KIT_VECTORS_H

#include <lrcs/kit.h>

#include "host/fail.h"
#include "host/kit/kit.h"

typedef struct lrcsi_vectors_material {
    const char *name;
    lrcs_brdf brdf;
    int two_sided;
    unsigned char rgb[3]; /* for viewers of the OBJ */
    char letter;          /* letter by which items refer to it */
} lrcsi_vectors_material;

enum lrcsi_vectors_kind {
    LRCSI_VECTORS_NONE, /* ends a list */
    LRCSI_VECTORS_PLATE,
    LRCSI_VECTORS_BOX,
    LRCSI_VECTORS_ROUND, /* cylinder, cone, frustum: size is radius below, radius above, height */
    LRCSI_VECTORS_BALL,  /* size is radius, 0, 0 */
    LRCSI_VECTORS_QUILT, /* a plate of count x count fields, each tilted differently by size[2] */
    LRCSI_VECTORS_FAN    /* a disc of count triangles around its centre: slivers */
};

/* A body of a scene. `material` has the material's letter for each of its faces (box: +x -x +y -y
   +z -z; round: wall, above, below); '-' leaves the face out; the last letter applies to all
   remaining faces. */
typedef struct lrcsi_vectors_item {
    int kind;
    int count; /* number of divisions */
    double size[3], at[3];
    double rotate_deg[3]; /* rotations about X, Y, Z, applied before `at` */
    const char *material;
} lrcsi_vectors_item;

typedef struct lrcsi_vectors_scene {
    const char *name;
    int tier;
    unsigned attitudes;             /* bits, lrcsi_vectors_attitude.set */
    double scale;                   /* of all coordinates, a power of two */
    double move[3];                 /* translation before the scale */
    const lrcsi_vectors_item *item; /* terminated by one of kind LRCSI_VECTORS_NONE */
    const char *about;              /* what it tests */
} lrcsi_vectors_scene;

#define LRCSI_VECTORS_TILTS   1u /* from the normal +z of a plate to grazing and beyond */
#define LRCSI_VECTORS_OBLIQUE 2u /* not symmetric to anything */
#define LRCSI_VECTORS_EDGES   4u /* exactly along the axes of the body */

/* An attitude: a quaternion of integers, body to observation frame, of any length. */
typedef struct lrcsi_vectors_attitude {
    const char *name;
    unsigned set;
    double quaternion[4];
} lrcsi_vectors_attitude;

/* The tables, terminated by a NULL name. */
extern const lrcsi_vectors_material lrcsi_vectors_materials[];
extern const lrcsi_vectors_attitude lrcsi_vectors_attitudes[];
extern const lrcsi_vectors_scene lrcsi_vectors_scenes[];

/* A scene as facets. Every coordinate is representable in single precision. */
typedef struct lrcsi_vectors_mesh {
    lrcs_point *vertex;
    lrcs_facet *facet;
    uint32_t *material; /* by facet: an index into lrcsi_vectors_materials */
    uint32_t vertices, facets, vertex_room, facet_room;
    int failed; /* 1 if out of memory */
} lrcsi_vectors_mesh;

/* The mesh, which the caller frees in any case. Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcsi_vectors_mesh_make(const lrcsi_vectors_scene *scene, lrcsi_vectors_mesh *mesh,
                            lrcs_host_error *error);
void lrcsi_vectors_mesh_free(lrcsi_vectors_mesh *mesh);

/* A case: a scene from an attitude, with its truth. */
typedef struct lrcsi_vectors_case {
    const lrcsi_vectors_scene *scene;
    const lrcsi_vectors_attitude *attitude;
    double quaternion[4]; /* unit, w first */
    double direction[3];  /* unit, body frame */
    double azel_deg[2];
    lrcs_pose pose; /* made from these numbers as they are printed */
    lrcs_result result;
    double float_m2;  /* the error allowed for single precision */
    double edge_m2;   /* the error allowed for a raster of N pixels, times N */
    double window[3]; /* left, top, side, m: the visible square of the observation frame */
    int image;        /* 1 if there are pictures of it */
} lrcsi_vectors_case;

typedef struct lrcsi_vectors_job {
    const char *folder;
    uint32_t resolution; /* of the pictures; 0 for none */
    lrcs_binding *binding;
    uint32_t bindings;
    lrcsi_vectors_case *list; /* in the order of the tables */
    uint32_t cases;
} lrcsi_vectors_job;

/* Files whose paths begin alike, with what writes them; each appears complete or not at all.
   Status: LRCS_OK; LRCS_E_SYSTEM; LRCS_E_LIMIT (a path); as the writers. */
typedef int lrcsi_vectors_writer(FILE *out, const void *context, lrcs_host_error *error);
typedef struct lrcsi_vectors_file {
    const char *name;
    lrcsi_vectors_writer *write;
} lrcsi_vectors_file;
int lrcsi_vectors_write(const char *prefix, const lrcsi_vectors_file *file, int count,
                        const void *context, lrcs_host_error *error);

/* Writes scenes/NAME.obj, .mtl, .stl and .json; and README.md, kit.json, cases.csv and
   materials.csv. Status: as above. */
int lrcsi_vectors_scene_write(const lrcsi_vectors_job *job, const lrcsi_vectors_scene *scene,
                              const lrcsi_vectors_mesh *mesh, lrcs_host_error *error);
int lrcsi_vectors_index_write(const lrcsi_vectors_job *job, lrcs_host_error *error);

/* Runs every case of a scene and writes truth/NAME.facets.csv and the pictures.
   Status: LRCS_OK; LRCS_E_UNSUPPORTED: a case cannot be clipped exactly; as above,
   lrcs_host_scene_read, lrcs_host_scene_prepare and lrcs_host_scene_run. */
int lrcsi_vectors_truth_write(lrcsi_vectors_job *job, const lrcsi_vectors_scene *scene,
                              lrcs_host_error *error);

/* The pictures of a case: truth/NAME.ATTITUDE.item.u32, .item.png, .depth.f64, .depth.png. Status:
   as above. */
int lrcsi_vectors_images_write(const lrcsi_vectors_job *job, const lrcsi_vectors_case *one,
                               const lrcs_scene *scene, const lrcs_image *image,
                               lrcs_host_error *error);

#endif
