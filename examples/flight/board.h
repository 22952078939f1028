/* SPDX-License-Identifier: MIT */
/* What the task's surroundings give it: a line out, how deep the stack ever was, and a clock. */
#ifndef FLIGHT_BOARD_H
#define FLIGHT_BOARD_H

#include <stddef.h>
#include <stdint.h>

void board_write(const char *text);
size_t board_stack_peak(void); /* bytes; 0: not known here */
uint32_t board_ticks(void);    /* a clock of 24 bits, of the processor's ticks; 0: none here */

int flight_main(void);

#endif
