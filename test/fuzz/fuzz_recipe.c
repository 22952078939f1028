/* SPDX-License-Identifier: MIT */
/* Scene files from arbitrary bytes, as far as the recipe; with less memory too. */
#include "fuzz_recipe.h"

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    lrcs_work work;
    lrcs_recipe recipe;
    int read = fuzz_recipe(data, size, &work, &recipe);
    size_t used = work.used;
    free(work.bytes);
    if (read) {
        work = fuzz_area((size * 2654435761u) % used);
        memset(&recipe, FUZZ_PATTERN, sizeof recipe);
        require(lrcs_recipe_read((const char *)data, size, &work, &recipe, NULL) == LRCS_E_MEMORY);
        require(work.used == 0 && fuzz_untouched(&recipe, sizeof recipe));
        free(work.bytes);
    }
    return 0;
}
