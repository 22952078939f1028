/* SPDX-License-Identifier: MIT */
/* Wavefront OBJ files from arbitrary bytes. */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    static const fuzz_reader reader = {lrcs_obj_count, lrcs_obj_read};
    return fuzz_mesh(&reader, data, size);
}
