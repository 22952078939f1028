/* SPDX-License-Identifier: MIT */
/* Runs the task through a slow tumble that includes two invalid attitudes, and writes a line of
   telemetry after each cycle, without stdio or a locale. */
#include "board.h"
#include "task.h"

#include <math.h>
#include <string.h>

typedef struct telemetry_line {
    char text[160];
    size_t length;
} telemetry_line;

static void line_text(telemetry_line *line, const char *text)
{
    for (; *text && line->length + 1 < sizeof line->text; text++) {
        line->text[line->length++] = *text;
        line->text[line->length] = '\0';
    }
}

/* In the base, with at least so many digits. */
static void line_number(telemetry_line *line, const char *name, uint64_t value, unsigned base,
                        int digits)
{
    char text[24] = "";
    char *at = &text[sizeof text - 1];
    for (; value > 0 || digits > 0; value /= base, digits--) {
        *--at = "0123456789abcdef"[value % base];
    }
    line_text(line, name);
    line_text(line, at);
}

static void line_status(telemetry_line *line, const char *name, int32_t status)
{
    line_text(line, name);
    line_number(line, status < 0 ? "-" : "", (uint64_t)(status < 0 ? -(int64_t)status : status), 10,
                1);
}

/* In whole square millimetres for people, in bits for machines. */
static void line_area(telemetry_line *line, const char *name, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    line_number(line, name, value < 1e12 ? (uint64_t)(value * 1e6 + 0.5) : UINT64_MAX, 10, 1);
    line_number(line, " = ", bits, 16, 16);
}

int flight_main(void)
{
    static const double attitude[][4] = {{1, 0, 0, 0},       {0.9, 0.3, 0, 0.1}, {0.7, 0.6, 0.2, 0},
                                         {0.4, 0.7, 0.3, 0}, {0, 0, 0, 0},       {NAN, 0, 0, 1},
                                         {0.1, 0.9, 0.5, 1}, {0, 0, 1, 0.2}};
    int32_t status = flight_start();
    flight_telemetry t = {.status = status};
    uint32_t most = 0;
    for (size_t i = 0; status == 0 && i < sizeof attitude / sizeof *attitude; i++) {
        telemetry_line line = {.length = 0};
        uint32_t start = board_ticks();
        flight_cycle(attitude[i], &t);
        uint32_t ticks = (board_ticks() - start) & 0xffffffu;
        most = ticks > most ? ticks : most;
        line_number(&line, "cycle ", t.cycle, 10, 1);
        line_status(&line, " status ", t.status);
        line_number(&line, " stale ", t.stale, 10, 1);
        line_number(&line, " flags ", t.flags, 16, 1);
        line_number(&line, " steps ", t.steps, 10, 1);
        line_area(&line, " sigma mm2 ", t.sigma_m2);
        line_area(&line, " bound mm2 ", t.bound_m2);
        line_text(&line, "\n");
        board_write(line.text);
    }
    telemetry_line line = {.length = 0};
    line_status(&line, "end: status ", status);
    line_number(&line, " failures ", t.failures, 10, 1);
    line_number(&line, " memory ", t.memory_used, 10, 1);
    line_number(&line, " of ", t.memory_peak, 10, 1);
    line_number(&line, " ticks ", most, 10, 1);
    line_number(&line, " stack ", board_stack_peak(), 10, 1);
    line_text(&line, "\n");
    board_write(line.text);
    return status == 0 ? 0 : 1;
}

/* expected output, the bits of areas left out:
cycle 1 status 0 stale 0 flags 0 steps 44625 sigma mm2 30579551 bound mm2 9
cycle 2 status 0 stale 0 flags 0 steps 37130 sigma mm2 1697619 bound mm2 145
cycle 3 status 0 stale 0 flags 0 steps 34563 sigma mm2 7070226 bound mm2 88
cycle 4 status 0 stale 0 flags 0 steps 19809 sigma mm2 1076713 bound mm2 25
cycle 5 status -1 stale 1 flags 0 steps 19809 sigma mm2 1076713 bound mm2 25
cycle 6 status -6 stale 2 flags 0 steps 19809 sigma mm2 1076713 bound mm2 25
cycle 7 status 0 stale 0 flags 0 steps 28461 sigma mm2 1671467 bound mm2 110
cycle 8 status 0 stale 0 flags 0 steps 8118 sigma mm2 3148562 bound mm2 0
end: status 0 failures 2
*/
