/* SPDX-License-Identifier: MIT */
/* Which setting of a time budget comes next, and which answer is better. This file only computes:
   it reads no clock and runs nothing. */
#include <lrcs/sequence.h>

#include <math.h>
#include <string.h>

/* A bound above this share of sigma says little: beyond it a likely error decides. */
#define BOUND_TELLS 0.1

/* The least share of a measured time that is taken to be proof and not drawing: forecasts of the
   drawing may exceed the time measured. */
#define PROOF_LEAST 0.1

/* The last setting is preferred to rasters if the time left is this many times what it is expected
   to take. On an idle machine forecasts scaled by a measured time were wrong by at most a factor of
   1.9; on a busy one drawing and clipping are slowed down unequally, which the second factor allows
   for until a proof has been timed too. */
#define LAST_MARGIN         2.0
#define LAST_MARGIN_UNTIMED 4.0

lrcs_sequence lrcs_sequence_make(void)
{
    static const uint32_t size[] = {256, 512, 1024};
    lrcs_sequence s;
    memset(&s, 0, sizeof s);
    s.samples_scale = 1.0;
    for (size_t i = 0; i < sizeof size / sizeof size[0]; i++) {
        s.setting[s.count++] = (lrcs_setting){LRCS_SETTING_PROVED, size[i], 0.0, 0};
        s.setting[s.count++] = (lrcs_setting){LRCS_SETTING_SAMPLES, size[i], 0.0, 0};
    }
    s.setting[s.count++] = (lrcs_setting){LRCS_SETTING_LAST, 0, 0.0, 0};
    return s;
}

/* The part of a setting's forecast that is drawing: that of the same raster without a proof. */
static double draw_forecast(const lrcs_sequence *sequence, const lrcs_setting *setting)
{
    for (int i = 0; i < sequence->count && setting->kind != LRCS_SETTING_LAST; i++) {
        const lrcs_setting *other = &sequence->setting[i];
        if (other->kind == LRCS_SETTING_SAMPLES && other->resolution == setting->resolution) {
            return fmin(other->forecast, setting->forecast);
        }
    }
    return 0.0;
}

/* The time that a setting is expected to take, s. */
static double sequence_expected(const lrcs_sequence *sequence, int setting)
{
    const lrcs_setting *s = &sequence->setting[setting];
    double draw = draw_forecast(sequence, s);
    double proof_scale =
        sequence->proof_scale > 0.0 ? sequence->proof_scale : sequence->samples_scale;
    return sequence->samples_scale * draw + proof_scale * (s->forecast - draw);
}

int lrcs_sequence_next(const lrcs_sequence *sequence, double left)
{
    const double margin = sequence->proof_scale > 0.0 ? LAST_MARGIN : LAST_MARGIN_UNTIMED;
    int next = -1, begun = 0;
    for (int i = 0; i < sequence->count; i++) {
        begun |= sequence->setting[i].done;
        if (!sequence->setting[i].done &&
            (next < 0 || sequence_expected(sequence, i) < sequence_expected(sequence, next))) {
            next = i;
        }
    }
    for (int i = 0; i < sequence->count && begun; i++) {
        const lrcs_setting *s = &sequence->setting[i];
        if (s->kind == LRCS_SETTING_LAST && !s->done &&
            margin * sequence_expected(sequence, i) <= left) {
            next = i;
        }
    }
    return next;
}

void lrcs_sequence_done(lrcs_sequence *sequence, int setting, double seconds, int clipped)
{
    lrcs_setting *s = &sequence->setting[setting];
    double draw = draw_forecast(sequence, s);
    double proof = s->forecast - draw;
    s->done = 1;
    if (proof > 0.0) {
        sequence->proof_scale =
            fmax(seconds - sequence->samples_scale * draw, PROOF_LEAST * seconds) / proof;
    } else if (draw > 0.0) {
        sequence->samples_scale = seconds / draw;
    }
    for (int i = 0; i < sequence->count; i++) {
        lrcs_setting *other = &sequence->setting[i];
        /* where a raster of samples alone cannot be drawn, it is the one with a bound */
        int same = other->resolution == s->resolution && other->forecast == s->forecast;
        if ((s->kind == LRCS_SETTING_LAST && clipped) ||
            (s->kind != LRCS_SETTING_LAST && s->forecast > 0.0 && same)) {
            other->done = 1;
        }
    }
}

double lrcs_sequence_error(const lrcs_result *result)
{
    double bound = result->bound_m2 + fmax(0.0, result->curvature_estimate_m2);
    double tells = BOUND_TELLS * result->sigma_m2;
    return bound > tells && result->estimate_m2 >= 0.0 ? fmin(bound, tells + result->estimate_m2)
                                                       : bound;
}
