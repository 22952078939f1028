/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs vectors: the scenes of the kit as tables, their meshes, and the truth
   of each case. */
#ifndef LRCS_CLI_VECTORS_H
#define LRCS_CLI_VECTORS_H

#include "cli/cli.h"

#include <lrcs/conformance.h>

#define KIT_PATH 4096u /* size of a path */

/* Writes "DIR/a/b" to path. 0, or CLI_FAILED with the message printed if it does not fit. */
__attribute__((format(printf, 2, 3))) int cli_kit_path(char path[KIT_PATH], const char *format,
                                                       ...);

typedef struct vectors_material {
    const char *name;
    lrcs_brdf brdf;
    int two_sided;
    unsigned char rgb[3]; /* for viewers of the OBJ */
    char letter;          /* letter by which items refer to it */
} vectors_material;

enum vectors_kind {
    VECTORS_NONE, /* ends a list */
    VECTORS_PLATE,
    VECTORS_BOX,
    VECTORS_ROUND, /* cylinder, cone, frustum: size is radius below, radius above, height */
    VECTORS_BALL,  /* size is radius, 0, 0 */
    VECTORS_QUILT, /* a plate of count x count fields, each tilted differently by size[2] */
    VECTORS_FAN    /* a disc of count triangles around its centre: slivers */
};

/* A body of a scene. `material` has the material's letter for each of its faces (box: +x -x +y -y
   +z -z; round: wall, above, below); '-' leaves the face out; the last letter applies to all
   remaining faces. */
typedef struct vectors_item {
    int kind;
    int count; /* number of divisions */
    double size[3], at[3];
    double turn_deg[3]; /* rotations about X, Y, Z, applied before `at` */
    const char *material;
} vectors_item;

typedef struct vectors_scene {
    const char *name;
    int tier;
    unsigned attitudes;       /* bits, vectors_attitude.set */
    double scale;             /* of all coordinates, a power of two */
    double move[3];           /* translation before the scale */
    const vectors_item *item; /* terminated by one of kind VECTORS_NONE */
    const char *about;        /* what it tests */
} vectors_scene;

#define VECTORS_TILTS 1u /* from the normal +z of a plate to grazing and beyond */
#define VECTORS_TURNS 2u /* not symmetric to anything */
#define VECTORS_EDGES 4u /* exactly along the axes of the body */

/* An attitude: a quaternion of integers, body to observation frame, of any length. */
typedef struct vectors_attitude {
    const char *name;
    unsigned set;
    double quaternion[4];
} vectors_attitude;

/* The tables, terminated by a NULL name. */
extern const vectors_material cli_vectors_materials[];
extern const vectors_attitude cli_vectors_attitudes[];
extern const vectors_scene cli_vectors_scenes[];

/* A scene as facets. Every coordinate is representable in single precision. */
typedef struct vectors_mesh {
    lrcs_point *vertex;
    lrcs_facet *facet;
    uint32_t *material; /* by facet: an index into cli_vectors_materials */
    uint32_t vertices, facets, vertex_room, facet_room;
    int failed; /* 1 if out of memory */
} vectors_mesh;

/* 0 or CLI_FAILED with the message printed; the caller frees it in any case. */
int cli_vectors_mesh(const vectors_scene *scene, vectors_mesh *mesh);
void cli_vectors_mesh_free(vectors_mesh *mesh);

/* A case: a scene from an attitude, with its truth. */
typedef struct vectors_case {
    const vectors_scene *scene;
    const vectors_attitude *attitude;
    double quaternion[4]; /* unit, w first */
    double direction[3];  /* unit, body frame */
    double azel_deg[2];
    lrcs_pose pose; /* made from these numbers as they are printed */
    lrcs_result result;
    double float_m2;  /* the error allowed for single precision */
    double edge_m2;   /* the error allowed for a raster of N pixels, times N */
    double window[3]; /* left, top, side, m: the visible square of the observation frame */
    int image;        /* 1 if there are pictures of it */
} vectors_case;

typedef struct vectors_job {
    const char *folder;
    uint32_t resolution; /* of the pictures; 0 for none */
    lrcs_binding *binding;
    uint32_t bindings;
    vectors_case *list; /* in the order of the tables */
    uint32_t cases;
} vectors_job;

/* Files whose paths begin alike, with what writes them. 0 or CLI_FAILED with the message printed.
 */
typedef struct vectors_file {
    const char *name;
    cli_text_writer *write;
    cli_writer *picture; /* if write is NULL */
} vectors_file;
int cli_vectors_write(const char *prefix, const vectors_file *file, int count, const void *context);

/* scenes/NAME.obj, .mtl, .stl and .json. */
int cli_vectors_files(const vectors_job *job, const vectors_scene *scene, const vectors_mesh *mesh);

/* Runs every case of a scene and writes truth/NAME.facets.csv and the pictures. */
int cli_vectors_truth(vectors_job *job, const vectors_scene *scene);

/* The pictures of a case: truth/NAME.ATTITUDE.item.u32, .item.png, .depth.f64, .depth.png. */
int cli_vectors_images(const vectors_job *job, const vectors_case *one, const lrcs_scene *scene,
                       const lrcs_image *image);

/* README.md, kit.json, cases.csv, materials.csv. */
int cli_vectors_index(const vectors_job *job);

#endif
