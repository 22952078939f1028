/* SPDX-License-Identifier: MIT */
/* Reproducible random numbers: the same on every machine. Tests depend on the sequences, so these
   never change. */
#ifndef TEST_RANDOM_H
#define TEST_RANDOM_H

#include <stdint.h>

/* 64 bits from SplitMix64 (Steele, Lea and Flood 2014), from any state. */
static inline uint64_t random_splitmix(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* 64 bits from xorshift64 (Marsaglia 2003); the state is not 0. */
static inline uint64_t random_xorshift(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* 64 bits, of which the upper are good, from the linear congruence of MMIX (Knuth). */
static inline uint64_t random_mmix(uint64_t *state)
{
    return *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
}

/* The upper 53 of 64 bits as a number, 0 <= x < 1. */
static inline double random_fraction(uint64_t bits)
{
    return (double)(bits >> 11) * 0x1p-53;
}

/* 0 <= x < 1. */
static inline double random_unit(uint64_t *state)
{
    return random_fraction(random_splitmix(state));
}

/* 0 .. below - 1. */
static inline uint32_t random_below(uint64_t *state, uint32_t below)
{
    return (uint32_t)((random_xorshift(state) >> 33) % below);
}

#endif
