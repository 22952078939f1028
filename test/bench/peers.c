/* SPDX-License-Identifier: MIT */
/* Runs the programs of peers.h and reads what they print: a line for each pose, "azimuth elevation
   sigma seconds", and at the end the time for what they build once for all poses. */
#include "bench/peers.h"

#include <string.h>

void bench_peer_run(const char *folder, int peer, const char *stl, uint32_t size, double limit_s,
                    bench_cell *cell, double *build)
{
    static const char *const program[] = {"gl_lrcs", "embree_lrcs"};
    char command[2048];
    char line[512];
    *cell = (bench_cell){.end = BENCH_FAILED};
    *build = 0;
    /* the material of facets that no one has bound */
    snprintf(command, sizeof command, "timeout %.0f '%s/%s' '%s' %lu %d 1 0.25 0.2 0.5 2>&1",
             1 + limit_s, folder, program[peer], stl, (unsigned long)size, BENCH_DIRECTIONS);
    FILE *from = popen(command, "r");
    if (!from) {
        return;
    }
    while (fgets(line, sizeof line, from)) {
        double azimuth;
        double elevation;
        double sigma;
        double seconds;
        const char *built = strstr(line, "build ");
        if (sscanf(line, "%lf %lf %lf %lf", &azimuth, &elevation, &sigma, &seconds) == 4 &&
            cell->count < 1 + BENCH_TIMES) {
            cell->sample[cell->count++] = (bench_sample){.wall = 1e3 * seconds};
        } else if (built && sscanf(built, "build %lf", &seconds) == 1) {
            *build = 1e3 * seconds;
        }
    }
    cell->end = pclose(from) == 0 && cell->count > 0 ? BENCH_DONE : BENCH_FAILED;
}
