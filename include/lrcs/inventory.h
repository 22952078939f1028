/* SPDX-License-Identifier: MIT */
/* What a scene holds: counts, areas, defects of its mesh, whether its facets are fine enough for
   the glint of their materials, and the surfaces that facets of models lie on. */
#ifndef LRCS_INVENTORY_H
#define LRCS_INVENTORY_H

#include <lrcs/glint.h>
#include <lrcs/load.h>
#include <lrcs/quadric.h>

/* The area of a facet, m2. */
double lrcs_host_facet_area(const lrcs_scene *scene, uint32_t facet);

typedef struct lrcs_host_inventory {
    uint32_t parts; /* as files and shapes define them */
    lrcs_mesh_report report;
    struct {
        uint32_t facets;
        double area_m2;
    } * material;           /* for each material of the scene */
    lrcs_host_glint *glint; /* lrcs_host_glint_check */
    uint32_t glint_count;
} lrcs_host_inventory;

/* Given: base, which was read; scene: its own, or one that was varied from it. Glint adequacy needs
   the curved normals of files: LRCS_NORMALS_SMOOTH. Returned: inventory, to be freed in any case.
   Status: LRCS_OK; LRCS_E_SYSTEM (memory); as lrcs_mesh_check and lrcs_host_glint_check. */
int lrcs_host_inventory_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                             lrcs_host_inventory *inventory, lrcs_host_error *error);
void lrcs_host_inventory_free(lrcs_host_inventory *inventory);

/* Sentence `i`, 0 .. LRCS_HOST_INVENTORY_NOTICES - 1, about what is peculiar in the mesh, which may
   be in `text`; NULL if it is not. */
#define LRCS_HOST_INVENTORY_NOTICES 4
#define LRCS_HOST_INVENTORY_NOTICE  160
const char *lrcs_host_inventory_notice(const lrcs_host_inventory *inventory,
                                       const lrcs_scene *scene, int i,
                                       char text[LRCS_HOST_INVENTORY_NOTICE]);

/* The surfaces on which facets of models provably lie (lrcs_quadric_find), and the sums of each
   kind. */
#define LRCS_HOST_SURFACE_KINDS (LRCS_QUADRIC_CONE + 1)
typedef struct lrcs_host_surface_kind {
    uint32_t regions, facets;
    double area_m2, displacement; /* displacement: the largest bound, m */
} lrcs_host_surface_kind;

typedef struct lrcs_host_surfaces {
    lrcs_quadric_region *region; /* the largest area first */
    uint32_t count;
    lrcs_host_surface_kind kind[LRCS_HOST_SURFACE_KINDS];
} lrcs_host_surfaces;

/* Status: LRCS_OK; LRCS_E_SYSTEM (memory); as lrcs_quadric_find. */
int lrcs_host_surfaces_find(const lrcs_scene *scene, lrcs_host_surfaces *surfaces,
                            lrcs_host_error *error);
void lrcs_host_surfaces_free(lrcs_host_surfaces *surfaces);

#endif
