/* SPDX-License-Identifier: MIT */
/* What accuracy costs in time, for one scene from one pose: every method and resolution, and every
   fineness of the facets of shapes, measured and compared with the truth. */
#ifndef LRCS_CONVERGENCE_H
#define LRCS_CONVERGENCE_H

#include <lrcs/load.h>

#define LRCS_HOST_CONVERGENCE_SETTINGS 32
#define LRCS_HOST_CONVERGENCE_MESHES   6
#define LRCS_HOST_CONVERGENCE_REPEATS  25

/* The kinds of settings. */
enum lrcs_host_convergence_kind {
    LRCS_HOST_CONVERGENCE_KIND_ZBUFFER, /* its resolution */
    LRCS_HOST_CONVERGENCE_KIND_MESH,    /* how finely shapes are tessellated */
    LRCS_HOST_CONVERGENCE_KIND_PREVIEW, /* the tolerance, by LRCS_ACCEPT_ESTIMATE */
    LRCS_HOST_CONVERGENCE_KIND_FACET,   /* no self-shadowing */
    LRCS_HOST_CONVERGENCE_KIND_EXACT,
    LRCS_HOST_CONVERGENCE_KIND_CLOSED, /* no facets: closed forms of shapes that nothing hides */
    LRCS_HOST_CONVERGENCE_KINDS
};
#define LRCS_HOST_PREVIEW_NAME_TEXT "by estimate" /* the names of previews begin so */

/* The scene with its shapes tessellated for a tolerance of 10^-digits; digits is 0 for a mesh that
   does not depend on it. */
typedef struct lrcs_host_convergence_mesh {
    int digits;
    lrcs_host_scene scene;
} lrcs_host_convergence_mesh;

/* One setting, measured. */
typedef struct lrcs_host_convergence_setting {
    int kind; /* lrcs_host_convergence_kind */
    char name[48];
    int method;
    uint32_t resolution; /* 0 for no raster */
    int digits;          /* of the tolerance 10^-digits that an estimate must meet; 0 for none */
    uint32_t mesh;       /* index of its mesh */
    uint32_t runs;
    double seconds[LRCS_HOST_CONVERGENCE_REPEATS]; /* of each run */
    double spent_s, pose_s;                        /* their sum and their median */
    double sigma_m2;
    double error_m2;    /* |sigma - truth| */
    double estimate_m2; /* negative if there is none */
    double bound_m2; /* bound of |sigma - truth|, without that of the truth itself; negative if not
                        known */
    int true_shapes; /* 1 if the bound is against the true shapes, not against the facets */
    uint32_t flags;  /* of the result */
} lrcs_host_convergence_setting;

typedef struct lrcs_host_convergence_truth {
    double sigma_m2, bound_m2;
    int true_shapes; /* 1 if the bound is against the true shapes, not against the facets */
    char text[96];   /* its origin */
} lrcs_host_convergence_truth;

/* All zero but for what is given. */
typedef struct lrcs_host_convergence {
    /* given */
    const char *path; /* as for lrcs_host_scene_read */
    lrcs_pose pose;
    lrcs_host_options load;  /* the tolerance is that of each mesh */
    int digits;              /* finest mesh, for 10^-digits; 0 for all meshes */
    double seconds;          /* time for all runs, about */
    lrcs_progress *progress; /* of each run, as lrcs_run_options.progress */
    void (*stage)(const char *name, uint32_t done, uint32_t count); /* called before each stage, for
                               a display: a mesh, of so many, or a run (count 0); or NULL */
    /* measured */
    double spent;     /* time of the runs, s */
    double processor; /* processor time that they used, s */
    lrcs_host_convergence_mesh mesh[LRCS_HOST_CONVERGENCE_MESHES];
    uint32_t meshes; /* from coarse to fine */
    lrcs_host_convergence_setting setting[LRCS_HOST_CONVERGENCE_SETTINGS];
    uint32_t settings;
    lrcs_host_convergence_truth truth;
    char left_out[160]; /* what was left out because of time or size, or "" */
    char busy[120];     /* the share of a processor that the runs had, if small, or "" */
} lrcs_host_convergence;

/* Reads the scene with every mesh, prepared. The caller decides whether the first scene's
   `unmatched` is an error, and frees all in any case. Status: as lrcs_host_scene_read and
   lrcs_host_scene_prepare. */
int lrcs_host_convergence_read(lrcs_host_convergence *convergence, lrcs_host_error *error);

/* Then measures all settings, each several times as far as the time allows, and finds the truth:
   the closed form of a single shape that is not turned or scaled, else the exact method on the
   finest mesh. Status: as lrcs_host_scene_run. */
int lrcs_host_convergence_measure(lrcs_host_convergence *convergence, lrcs_host_error *error);
void lrcs_host_convergence_free(lrcs_host_convergence *convergence);

/* The finest mesh. A value relative to the true sigma; in m2 if that is 0. */
const lrcs_host_convergence_mesh *
lrcs_host_convergence_finest(const lrcs_host_convergence *convergence);
double lrcs_host_convergence_relative(const lrcs_host_convergence *convergence, double value_m2);

#endif
