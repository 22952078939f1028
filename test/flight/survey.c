/* SPDX-License-Identifier: MIT */
/* How many steps the cycles of examples/flight take, over many attitudes: three of four at random,
   the fourth with the laser along the scene's axes, in its planes, or next to that. Fails where one
   takes more than FLIGHT_STEPS. */
#include "task.h"

#include <stdio.h>

#include "random.h"

#define ATTITUDES 20000u

static double uniform(uint64_t *state)
{
    return 2 * random_fraction(random_mmix(state)) - 1;
}

int main(void)
{
    uint64_t random = 1;
    double sum = 0;
    uint32_t most = 0;
    uint32_t spent = 0;
    int status = flight_start();
    for (uint32_t i = 0; i < ATTITUDES && status == 0; i++) {
        flight_telemetry t;
        double q[4];
        for (int k = 0; k < 4; k++) {
            q[k] = i % 4 != 0 ? uniform(&random) : (double)(i / 4 >> 2 * k & 3) - 1;
        }
        q[i % 3] += i % 8 == 4 ? 0x1p-50 : 0;
        flight_cycle(q, &t);
        sum += t.steps;
        most = t.steps > most ? t.steps : most;
        spent += t.flags != 0;
    }
    printf("flight: %u attitudes, at most %u steps of %u, %.0f on average\n", ATTITUDES,
           (unsigned)most, (unsigned)FLIGHT_STEPS, sum / ATTITUDES);
    return status != 0 || most == 0 || spent != 0;
}
