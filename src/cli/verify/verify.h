/* SPDX-License-Identifier: MIT */
/* lrcs verify --hard: the cases, the plain formulas for comparison, and the table. */
#ifndef LRCS_CLI_VERIFY_H
#define LRCS_CLI_VERIFY_H

#include "cli/cli.h"

#define HARD_VERTICES 192u
#define HARD_FACETS   96u

/* Facets constructed one by one: material 0 is the case's, 1 is black. */
typedef struct hard_mesh {
    uint32_t vertices, facets, wears; /* has: the material assigned to subsequent facets */
    lrcs_point vertex[HARD_VERTICES];
    lrcs_facet facet[HARD_FACETS];
    uint32_t material[HARD_FACETS];
    uint32_t none[HARD_FACETS]; /* zeros: every facet's part and smoothing groups */
} hard_mesh;

typedef struct hard_case hard_case;

/* A body with a closed form, or facets if `build` is given. */
struct hard_case {
    const char *name;
    double (*naive)(const hard_case *one, const hard_mesh *mesh);
    double reference_m2; /* NaN if the engine must refuse the case */
    lrcs_brdf brdf;
    lrcs_shape shape;
    double aspect_deg;
    void (*build)(hard_mesh *mesh);
    double direction[3];
};

/* Case i, or NULL beyond the last. */
const hard_case *cli_hard_case(size_t i);

/* Plain double implementations as in a textbook, none of which is reliable. */
double cli_naive_sphere(const hard_case *one, const hard_mesh *mesh);
double cli_naive_cylinder(const hard_case *one, const hard_mesh *mesh);
double cli_naive_cone(const hard_case *one, const hard_mesh *mesh);
double cli_naive_paraboloid(const hard_case *one, const hard_mesh *mesh);
double cli_naive_steps(const hard_case *one, const hard_mesh *mesh);
double cli_naive_facets(const hard_case *one, const hard_mesh *mesh);
double cli_naive_heron(const hard_case *one, const hard_mesh *mesh);

/* Prints the table, or JSON: CLI_DONE if every answer lies within its bound, else CLI_FAILED. */
int cli_hard_verify(int as_json);

#endif
