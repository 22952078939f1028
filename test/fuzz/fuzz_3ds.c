/* SPDX-License-Identifier: MIT */
/* 3D Studio files from arbitrary bytes. */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    static const fuzz_reader reader = {lrcs_3ds_count, lrcs_3ds_read};
    return fuzz_mesh(&reader, data, size);
}
