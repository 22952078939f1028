/* SPDX-License-Identifier: MIT */
/* Arbitrary bytes to sigma, all facets flat. */
#include "fuzz_pose.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    return fuzz_pose(data, size, 0);
}
