/* SPDX-License-Identifier: MIT */
/* A desk computer as the board. */
#include "board.h"

#include <stdio.h>

void board_write(const char *text)
{
    fputs(text, stdout);
}

size_t board_stack_peak(void)
{
    return 0;
}

uint32_t board_ticks(void)
{
    return 0;
}

int main(void)
{
    return flight_main();
}
