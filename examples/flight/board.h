/* SPDX-License-Identifier: MIT */
/* What the task's surroundings give it: a line out, and how deep the stack ever was. */
#ifndef FLIGHT_BOARD_H
#define FLIGHT_BOARD_H

#include <stddef.h>

void board_write(const char *text);
size_t board_stack_peak(void); /* bytes; 0: not known here */

int flight_main(void);

#endif
