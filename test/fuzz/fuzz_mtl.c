/* SPDX-License-Identifier: MIT */
/* Material libraries from arbitrary bytes, for a mesh with two materials. */
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    lrcs_surface material[2] = {{.name = "gold"}, {.name = "white paint"}};
    const lrcs_surface before[2] = {material[0], material[1]};
    lrcs_mesh mesh = {.material_count = 2, .material = material};
    lrcs_where where;
    int status = lrcs_mtl_read(data, size, &mesh, &where);
    if (status != LRCS_OK) {
        require_where(&where, size);
        require(mesh.notices == 0 && memcmp(material, before, sizeof before) == 0);
    }
    for (int i = 0; i < 2; i++) {
        require(material[i].name == before[i].name);
        require(material[i].transparency >= 0 && material[i].transparency <= 1);
    }
    return 0;
}
