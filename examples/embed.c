/* SPDX-License-Identifier: MIT */
/* The library in another program: sigma of an STL model in memory, without a heap.
   build: cc embed.c -I../include ../build/liblrcs.a -lm */
#include <lrcs/lrcs.h>

#include <stdio.h>

/* A tetrahedron; a real program would hand over the bytes of its file. */
static const char model[] = "solid tetrahedron\n"
                            "facet normal 0 0 -1 outer loop\n"
                            "vertex 0 0 0 vertex 0 1 0 vertex 1 0 0 endloop endfacet\n"
                            "facet normal 0 -1 0 outer loop\n"
                            "vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet\n"
                            "facet normal -1 0 0 outer loop\n"
                            "vertex 0 0 0 vertex 0 0 1 vertex 0 1 0 endloop endfacet\n"
                            "facet normal 1 1 1 outer loop\n"
                            "vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet\n"
                            "endsolid tetrahedron\n";

int main(void)
{
    static unsigned char memory[1 << 20];
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    lrcs_mesh mesh;
    lrcs_where where;
    int status = lrcs_stl_read(model, sizeof model - 1, &work, &mesh, &where);
    if (status != LRCS_OK) {
        printf("line %u: %s: %s, found '%s'\n", where.line, lrcs_status_text(status), where.item,
               where.found);
        return 1;
    }

    lrcs_recipe_part part = {.name = "body", .file = "tetrahedron.stl", .material_index = -1};
    part.place = lrcs_place_default();
    lrcs_binding white = {.kind = LRCS_BIND_DEFAULT, .two_sided = -1};
    white.brdf = lrcs_brdf_find("paint-white")->brdf;
    lrcs_recipe recipe = {.part = &part, .part_count = 1, .binding = &white, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_scene scene;
    const lrcs_prepared *prepared;
    status = lrcs_scene_build(&recipe, &mesh, &build, &work, &scene, &where);
    if (status == LRCS_OK) {
        status = lrcs_prepare_run(&scene, &work, &prepared);
    }

    for (double az = 0; az <= 90 && status == LRCS_OK; az += 30) {
        lrcs_pose pose;
        lrcs_result result;
        lrcs_run_options options = lrcs_run_options_default();
        lrcs_pose_from_azel(az, 20, &pose);
        status = lrcs_sigma_run(prepared, &pose, &options, &work, &result, NULL, NULL);
        if (status == LRCS_OK) {
            printf("az %2.0f  sigma %.6f m2  bound below 1e-12 m2: %s\n", az, result.sigma_m2,
                   result.bound_m2 < 1e-12 ? "yes" : "no");
        }
    }
    if (status != LRCS_OK) {
        puts(lrcs_status_text(status));
    }
    return status != LRCS_OK;
}

/* expected output:
az  0  sigma 1.406924 m2  bound below 1e-12 m2: yes
az 30  sigma 2.487050 m2  bound below 1e-12 m2: yes
az 60  sigma 2.487050 m2  bound below 1e-12 m2: yes
az 90  sigma 1.406924 m2  bound below 1e-12 m2: yes
*/
