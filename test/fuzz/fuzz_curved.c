/* SPDX-License-Identifier: MIT */
/* Arbitrary bytes to sigma, over curved normals. */
#include "fuzz_pose.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    return fuzz_pose(data, size, 1);
}
