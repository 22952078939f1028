/* SPDX-License-Identifier: MIT */
/* Output functions that several commands use, and the clock. */
#include "cli/cli.h"

#include <math.h>
#include <time.h>

double cli_known(double value)
{
    return value >= 0.0 ? value : (double)NAN;
}

double cli_shown(double value)
{
    return fabs(value) < 1e-30 ? 0.0 : value;
}

double cli_percent(double part, double whole)
{
    return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

double cli_dbsm(double sigma_m2)
{
    return 10.0 * log10(sigma_m2);
}

/* The width is counted in code points: every byte except the continuation bytes of UTF-8. */
void cli_column_to(FILE *out, const char *text, int width)
{
    for (; *text; text++) {
        putc(CLI_PLAIN(*text), out);
        width -= ((unsigned char)*text & 0xc0) != 0x80;
    }
    fprintf(out, "%*s", width > 0 ? width : 0, "");
}

void cli_column(const char *text, int width)
{
    cli_column_to(stdout, text, width);
}

void cli_notices_print(FILE *out, const lrcs_host_notices *notices)
{
    cli_watch_clear();
    for (uint32_t i = 0; i < notices->count; i++) {
        fprintf(out, "notice: %s\n", notices->text[i]);
    }
}

void cli_notices_json(const lrcs_host_notices *notices, lrcs_host_json *json)
{
    for (uint32_t i = 0; i < notices->count; i++) {
        lrcs_host_json_text(json, NULL, notices->text[i]);
    }
}

void cli_flags_json(lrcs_host_json *json, uint32_t flags)
{
    lrcs_host_json_begin(json, "flags", LRCS_HOST_ROW_ARRAY);
    for (uint32_t bits = flags; bits != 0; bits &= bits - 1) {
        lrcs_host_json_text(json, NULL, lrcs_flag_text(CLI_LOWEST(bits)));
    }
    lrcs_host_json_end(json);
}

double cli_seconds(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
