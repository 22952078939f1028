/* SPDX-License-Identifier: MIT */
/* What lrcs vectors writes, as far as an implementation needs it: cases, scenes, materials. */
#ifndef EXAMPLE_KIT_H
#define EXAMPLE_KIT_H

#include <stdio.h>

#define KIT_NAME 64

typedef struct kit_material {
    char name[KIT_NAME];
    double A, B, s, m;
    int two_sided;
} kit_material;

typedef struct kit_facet {
    double corner[3][3]; /* m, body frame, counter-clockwise from the front */
    const kit_material *material;
} kit_facet;

/* A line of cases.csv: a scene, an attitude, and the square of the observation frame to draw. */
typedef struct kit_case {
    char scene[KIT_NAME], attitude[KIT_NAME];
    double quaternion[4]; /* body to observation, w first */
    double left, top, side;
} kit_case;

typedef struct kit {
    const char *folder;
    kit_material material[64];
    int materials;
    kit_case *cases;
    int case_count;
    char scene[KIT_NAME]; /* whose facets these are */
    kit_facet *facet;
    int facets;
} kit;

/* Both end the program with a message if they fail, which suffices for an example. */
kit kit_read(const char *folder);
void kit_scene(kit *k, const char *scene);

#endif
