/* SPDX-License-Identifier: MIT */
/* Turns of sequences of settings, by a clock of their own: the order in which settings complete. */
#include "cli/run/turns.h"

#include <string.h>

#include "check.h"

#define SEQUENCES 3
#define SETTINGS  12
#define LEAST     0.5

/* Costs of settings, which grow in each sequence, and how far each sequence is. */
typedef struct course {
    run_sequence sequence[SEQUENCES];
    double cost[SEQUENCES][SETTINGS];
    double done[SEQUENCES]; /* of the current setting */
    int count[SEQUENCES];   /* settings that are complete */
} course;

static uint32_t course_seed;

static double random_number(void)
{
    course_seed = course_seed * 1664525u + 1013904223u;
    return (course_seed >> 8) / 16777216.0;
}

static course course_make(uint32_t seed, double weight)
{
    course made;
    memset(&made, 0, sizeof made);
    course_seed = seed;
    for (int i = 0; i < SEQUENCES; i++) {
        made.sequence[i].weight = i == 0 ? weight : 1.0;
        double cost = 0.0;
        for (int k = 0; k < SETTINGS; k++) {
            cost += pow(10.0, 6.0 * random_number() - 3.0) * (random_number() < 0.3 ? 0.0 : 1.0);
            made.cost[i][k] = cost;
        }
    }
    return made;
}

/* Gives one turn; returns the sequence if that completed a setting, else -1. Every seventh turn
   ends early, as by a signal. */
static int course_turn(course *all, int number)
{
    int i = cli_turn_next(all->sequence, SEQUENCES);
    run_sequence *sequence = &all->sequence[i];
    double time = cli_turn_length(sequence, LEAST) * (number % 7 == 0 ? 0.3 : 1.0);
    double left = all->cost[i][all->count[i]] - all->done[i];
    int complete = left <= time;
    time = complete ? left : time;
    all->done[i] = complete ? 0.0 : all->done[i] + time;
    all->count[i] += complete;
    cli_turn_took(sequence, time, complete);
    sequence->over = all->count[i] == SETTINGS;
    return complete ? i : -1;
}

/* Whenever a setting completes, all that cost less, by more than a turn, have been completed. */
static void settings_complete_in_order(uint32_t seed, double weight)
{
    course all = course_make(seed, weight);
    int completed = 0;
    for (int number = 1; cli_turn_next(all.sequence, SEQUENCES) >= 0; number++) {
        int i = course_turn(&all, number);
        if (i < 0) {
            continue;
        }
        completed++;
        double cost = all.cost[i][all.count[i] - 1];
        for (int j = 0; j < SEQUENCES; j++) {
            double less = 0.8 * (cost - LEAST) * all.sequence[j].weight / all.sequence[i].weight;
            if (j != i && all.count[j] < SETTINGS) {
                check_most(less, all.cost[j][all.count[j]] * (1.0 + 1e-12));
            }
        }
    }
    assert_int_equal(completed, SEQUENCES * SETTINGS);
}

static void what_costs_less_completes_before(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 500; seed++) {
        settings_complete_in_order(seed, 1.0);
    }
}

static void a_weight_lets_a_sequence_go_ahead_by_that_factor(void **state)
{
    (void)state;
    for (uint32_t seed = 1; seed <= 500; seed++) {
        settings_complete_in_order(seed, 4.0);
    }
}

/* Two settings of weight 1 delay one of weight w by 5/4 of 2 / w of its cost, and a turn of each.
 */
static void a_weight_limits_what_others_delay(void **state)
{
    (void)state;
    course all = course_make(1, 4.0);
    for (int i = 0; i < SEQUENCES; i++) {
        all.cost[i][0] = i == 0 ? 1000.0 : 1e6;
    }
    double time = 0.0;
    while (all.count[0] == 0) {
        course_turn(&all, 1);
        time = 0.0;
        for (int i = 0; i < SEQUENCES; i++) {
            time += all.sequence[i].taken + all.sequence[i].before;
        }
    }
    check_most(time, 1000.0 * (1.0 + 2.0 * 1.25 / 4.0) + 2.0 * LEAST);
}

static void one_that_is_over_gets_no_turn(void **state)
{
    (void)state;
    run_sequence sequence[2] = {{.weight = 1.0}, {.weight = 1.0, .taken = 5.0}};
    assert_int_equal(cli_turn_next(sequence, 2), 0);
    sequence[0].over = 1;
    assert_int_equal(cli_turn_next(sequence, 2), 1);
    sequence[1].over = 1;
    assert_int_equal(cli_turn_next(sequence, 2), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_costs_less_completes_before),
        cmocka_unit_test(a_weight_lets_a_sequence_go_ahead_by_that_factor),
        cmocka_unit_test(a_weight_limits_what_others_delay),
        cmocka_unit_test(one_that_is_over_gets_no_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
