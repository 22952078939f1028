/* SPDX-License-Identifier: MIT */
/* All readers under libFuzzer. The first byte picks the reader, modulo 4 ('<' 3DS, '=' OBJ, '>'
   STL,
   '?' MTL), the rest is the file; a mesh that comes out must keep what mesh.h promises. Starts from
   test/fuzz/seeds. See `make fuzz`. */
#include <lrcs/read.h>

#include <math.h>
#include <stdlib.h>

typedef struct fuzz_reader {
    int (*count)(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
    int (*read)(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                lrcs_where *where);
} fuzz_reader;

static const fuzz_reader readers[] = {
    {lrcs_3ds_count, lrcs_3ds_read},
    {lrcs_obj_count, lrcs_obj_read},
    {lrcs_stl_count, lrcs_stl_read},
};
#define READERS (sizeof readers / sizeof *readers)

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size);

static void require(int holds)
{
    if (!holds) {
        abort();
    }
}

static void require_sound(const lrcs_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            require(fabs(mesh->vertex[i].x[k]) <= 1e100);
        }
    }
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            require(mesh->facet[i].corner[k] < mesh->vertex_count);
            require(!mesh->facet_normal || mesh->facet_normal[i].corner[k] == LRCS_NONE ||
                    mesh->facet_normal[i].corner[k] < mesh->normal_count);
        }
        require(mesh->facet_part[i] < mesh->part_count);
        require(mesh->facet_material[i] == LRCS_NONE ||
                mesh->facet_material[i] < mesh->material_count);
    }
}

static void fuzz_mesh(const fuzz_reader *reader, const unsigned char *bytes, size_t size)
{
    lrcs_mesh_counts counts;
    lrcs_where where;
    int status = reader->count(bytes, size, &counts, &where);
    if (status != LRCS_OK) {
        require(where.item != NULL && where.expected != NULL && where.offset <= size);
        return;
    }
    size_t need = lrcs_mesh_need(&counts);
    void *area = malloc(need);
    lrcs_work work = lrcs_work_make(area, need);
    lrcs_mesh mesh;
    require(area != NULL && reader->read(bytes, size, &work, &mesh, &where) == LRCS_OK);
    require_sound(&mesh);
    free(area);
}

static void fuzz_materials(const unsigned char *bytes, size_t size)
{
    lrcs_surface material[2] = {{.name = "gold"}, {.name = "white paint"}};
    lrcs_mesh mesh = {.material_count = 2, .material = material};
    lrcs_where where;
    int status = lrcs_mtl_read(bytes, size, &mesh, &where);
    require(status == LRCS_OK || (where.item != NULL && where.offset <= size));
    for (int i = 0; i < 2; i++) {
        require(material[i].transparency >= 0.0 && material[i].transparency <= 1.0);
    }
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    if (size == 0) {
        return 0;
    }
    lrcs_format_check(data + 1, size - 1, NULL);
    if (data[0] % (READERS + 1) < READERS) {
        fuzz_mesh(&readers[data[0] % (READERS + 1)], data + 1, size - 1);
    } else {
        fuzz_materials(data + 1, size - 1);
    }
    return 0;
}
