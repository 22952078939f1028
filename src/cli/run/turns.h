/* SPDX-License-Identifier: MIT */
/* Several sequences of settings, run in turns so that settings complete in the order of their
   costs, although no cost is known before. Costs are times, in any unit.

   In each sequence a setting costs at least as much as the one before it. The known cost of its
   current setting is what that has taken so far, and not less than what the one before it took.
   Every turn goes to the sequence whose known cost, divided by its weight, is least; it lasts
   `least` plus a quarter of the known cost.

   Claim: when a setting of sequence i completes at cost c, every setting of sequence j that costs
   less than 4/5 (c - least) w_j / w_i has been completed. Proof: let k be the known cost of the
   setting when it got its last turn. Then c <= k + least + k / 4, so that k >= 4/5 (c - least). At
   that time the current setting of sequence j had a known cost of at least k w_j / w_i: it costs at
   least that, and so do those after it; all those before it have been completed. A turn that ends
   late counts as a larger `least`. */
#ifndef LRCS_CLI_RUN_TURNS_H
#define LRCS_CLI_RUN_TURNS_H

typedef struct run_sequence {
    double weight; /* > 0 */
    double taken;  /* by the current setting so far */
    double before; /* by the setting before it; 0 for none */
    int over;      /* 1 if there are no more settings */
} run_sequence;

static inline double cli_turn_known(const run_sequence *sequence)
{
    return sequence->taken > sequence->before ? sequence->taken : sequence->before;
}

/* The sequence whose turn it is, the first of equals; -1 if all are over. */
static inline int cli_turn_next(const run_sequence *sequence, int count)
{
    double least = 0.0;
    int next = -1;
    for (int i = 0; i < count; i++) {
        double known = cli_turn_known(&sequence[i]) / sequence[i].weight;
        if (!sequence[i].over && (next < 0 || known < least)) {
            next = i;
            least = known;
        }
    }
    return next;
}

static inline double cli_turn_length(const run_sequence *sequence, double least)
{
    return least + 0.25 * cli_turn_known(sequence);
}

/* Counts a turn, after which the current setting is complete or not. */
static inline void cli_turn_took(run_sequence *sequence, double time, int complete)
{
    sequence->taken += time;
    if (complete) {
        sequence->before = sequence->taken;
        sequence->taken = 0.0;
    }
}

#endif
