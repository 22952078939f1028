/* SPDX-License-Identifier: MIT */
/* STL files, binary and text from arbitrary bytes. */
#include "fuzz_mesh.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    static const fuzz_reader reader = {lrcs_stl_count, lrcs_stl_read};
    return fuzz_mesh(&reader, data, size);
}
