/* SPDX-License-Identifier: MIT */
/* A few arbitrary readings to a material: what comes out is finite and in order, or a status. */
#include <lrcs/fit.h>

#include "fuzz.h"

#include <math.h>

#define READINGS 12u

static const double units[8] = {1, 1 / 3.14159265358979323846, 1e-9, 1e9, 1e100, 1e-300, 0, -1};

/* Whole and half degrees; sometimes next to the limits, or just beyond them. */
static double take_angle(fuzz_input *in)
{
    static const double odd[6] = {1e-9, 1e-300, 89.9999999999, 90, -45.25, 60};
    unsigned byte = fuzz_byte(in);
    return byte < 180 ? 0.5 * byte : byte < 250 ? (double)byte - 255 : odd[byte - 250];
}

static double take_value(fuzz_input *in)
{
    static const double scale[8] = {1, 1, 0.1, 1e-3, 1e-12, 1e12, 1e90, 1e-200};
    unsigned byte = fuzz_byte(in);
    return byte == 255   ? HUGE_VAL
           : byte == 254 ? NAN
                         : ((double)(byte & 31) - 2) * scale[byte >> 5];
}

static uint32_t take_readings(fuzz_input *in, lrcs_fit_reading *reading)
{
    uint32_t count = 0;
    while (in->at < in->end && count < READINGS) {
        reading[count].angle_deg = take_angle(in);
        reading[count].value = take_value(in);
        reading[count].sigma = take_value(in);
        count++;
    }
    return count;
}

static void require_parameter(const lrcs_fit_parameter *p)
{
    require(p->value >= 0 && isfinite(p->value));
    require(p->error >= 0);
    require(p->low >= 0 && p->low <= p->high && isfinite(p->low));
    require(p->verdict >= LRCS_FIT_DETERMINED && p->verdict <= LRCS_FIT_FREE);
}

static void require_fit(const lrcs_fit *fit, uint32_t count)
{
    require(lrcs_brdf_check(&fit->brdf) >= 0);
    for (int i = 0; i < LRCS_FIT_PARAMETERS; i++) {
        require_parameter(&fit->parameter[i]);
        for (int k = 0; k < LRCS_FIT_PARAMETERS; k++) {
            require(fabs(fit->correlation[i][k]) <= 1 + 1e-12);
        }
    }
    require(fit->rms >= 0 && isfinite(fit->rms) && fit->noise >= 0 && isfinite(fit->noise));
    require(fit->kept <= count && fit->angles >= 1 && fit->angles <= 4);
    require(fit->least_deg >= 0 && fit->least_deg <= fit->most_deg && fit->most_deg < 90);
}

static void require_points(const lrcs_fit_point *point, const lrcs_fit *fit, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        require(isfinite(point[i].fitted) && isfinite(point[i].residual));
        require(isfinite(point[i].standard));
        kept += !point[i].outlier;
    }
    require(kept == fit->kept);
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    fuzz_input in = {data, data + size};
    lrcs_fit_reading reading[READINGS];
    lrcs_fit_point point[READINGS];
    lrcs_fit fit;
    lrcs_fit_options options = lrcs_fit_options_default();
    unsigned how = fuzz_byte(&in);
    options.unit = units[how & 7];
    options.cosine = how >> 3 & 1;
    options.noise = (int)(how >> 4 & 3);
    size_t short_memory = how >> 6 == 3;
    uint32_t count = take_readings(&in, reading);
    lrcs_work work = fuzz_area(lrcs_fit_need(count) - short_memory);
    memset(&fit, FUZZ_PATTERN, sizeof fit);
    memset(point, FUZZ_PATTERN, sizeof point);
    int status = lrcs_fit_run(reading, count, &options, &work, &fit, point);
    if (status == LRCS_OK) {
        require_fit(&fit, count);
        require_points(point, &fit, count);
        require(work.peak <= work.size);
    } else {
        require(status != LRCS_E_MEMORY || short_memory);
        require(fuzz_untouched(&fit, sizeof fit) && fuzz_untouched(point, sizeof point));
    }
    require(work.used == 0);
    free(work.bytes);
    return 0;
}
