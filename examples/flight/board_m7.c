/* SPDX-License-Identifier: MIT */
/* A Cortex-M7 with double-precision FPU as the board: start, semihosting, and a painted stack. No
   start-up code of a C library is used, and nothing that is linked needs a heap. */
#include "board.h"

#include <stdint.h>

#define PAINT             0xa5a5a5a5u
#define CPACR             (*(volatile uint32_t *)0xe000ed88u)
#define FPU_FULL          (0xfu << 20)
#define SYST_CSR          (*(volatile uint32_t *)0xe000e010u)
#define SYST_RVR          (*(volatile uint32_t *)0xe000e014u)
#define SYST_CVR          (*(volatile uint32_t *)0xe000e018u)
#define SYST_FREE         5u /* counts the processor's clock, interrupts nobody */
#define SYS_WRITE0        0x04
#define SYS_EXIT_EXTENDED 0x20
#define EXIT_BY_PROGRAM   0x20026u

/* From the linker script. */
extern uint32_t stack_low[], stack_top[], data_from[], data_low[], data_end[], bss_low[], bss_end[];

static int semihost(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static void board_exit(int code)
{
    const uint32_t why[2] = {EXIT_BY_PROGRAM, (uint32_t)code};
    semihost(SYS_EXIT_EXTENDED, why);
    for (;;) {
    }
}

void board_write(const char *text)
{
    semihost(SYS_WRITE0, text);
}

size_t board_stack_peak(void)
{
    const uint32_t *at = stack_low;
    while (at < stack_top && *at == PAINT) {
        at++;
    }
    return (size_t)(stack_top - at) * sizeof *at;
}

uint32_t board_ticks(void)
{
    return 0xffffffu - SYST_CVR; /* it counts down */
}

void board_reset(void);
void board_fault(void);

void board_reset(void)
{
    uint32_t *stack_now;
    CPACR |= FPU_FULL;
    __asm__ volatile("dsb\n isb");
    __asm__ volatile("mov %0, sp" : "=r"(stack_now));
    for (volatile uint32_t *at = stack_low; at < stack_now; at++) { /* no memset: it has a frame */
        *at = PAINT;
    }
    for (uint32_t *to = data_low, *from = data_from; to < data_end;) {
        *to++ = *from++;
    }
    for (uint32_t *at = bss_low; at < bss_end;) {
        *at++ = 0;
    }
    SYST_RVR = 0xffffffu;
    SYST_CVR = 0;
    SYST_CSR = SYST_FREE;
    board_exit(flight_main());
}

void board_fault(void)
{
    board_exit(2);
}

/* The beginning of the vector table: stack, reset, NMI and the faults. */
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    void (*handler[6])(void);
} vectors = {stack_top,
             {board_reset, board_fault, board_fault, board_fault, board_fault, board_fault}};
