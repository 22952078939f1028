/* SPDX-License-Identifier: MIT */
/* What a board provides for the task: a line of output, the greatest depth of the stack so far, and
   a clock. */
#ifndef FLIGHT_BOARD_H
#define FLIGHT_BOARD_H

#include <stddef.h>
#include <stdint.h>

void board_write(const char *text);
size_t board_stack_peak(void); /* bytes; 0: not known here */
uint32_t board_ticks(void);    /* a counter of 24 bits of processor cycles; 0 if there is none */

int flight_main(void);

#endif
