/* SPDX-License-Identifier: MIT */
/* Decimal text to double, correctly rounded. Decides what a number looks like and its rounding;
   the caller decides whether a value is acceptable (finite, in range).

   The value is 0.d1 d2 ... dn * 10^point. Up to 15 digits, and powers of ten up to 10^22, are
   doubles exactly, so that one multiplication or division rounds once and correctly (Clinger 1990).
   Every other value is a quotient of two big integers, divided bit by bit: the leading 53 bits
   (fewer if the result is subnormal), then an exact comparison of the remainder with one half. */
#include "base/decimal.h"

#include <stdint.h>
#include <string.h>

#include "base/bits.h"

/* The smallest points halfway between doubles are k * 2^-1075 with k < 2^54: such a point is
   k * 5^1075 / 10^1075 and has at most 54 log10(2) + 1075 log10(5) < 768 significant digits.
   Of later digits it only matters whether one of them differs from 0: a single digit 1 replaces
   them. */
#define DIGITS_KEPT 800
/* 0.d1... * 10^point with d1 > 0: infinity if point exceeds POINT_MAX (the value is at least
   1e309), zero if point is below POINT_MIN (the value is below 1e-324 < 2^-1075). */
#define POINT_MAX 309
#define POINT_MIN (-323)
/* The larger integer is at most 10^(801 + 323), 3734 bits, and is doubled once; 118 words hold
   3776. (Integers: at most 10^309.) */
#define BIG_WORDS 118
/* An exponent above this ignores its further digits: it already exceeds the length of any text, and
   ten times as much does not overflow. */
#define EXPONENT_MAX INT64_C(100000000000000000)

#define INFINITY_BITS (UINT64_C(0x7ff) << 52)

typedef struct decimal_text {
    int64_t point;
    int count;
    int sticky;
    unsigned char digit[DIGITS_KEPT + 1];
} decimal_text;

typedef struct big_natural {
    int size; /* words in use; the highest is not zero */
    uint32_t word[BIG_WORDS];
} big_natural;

static void big_multiply_add(big_natural *a, uint32_t factor, uint32_t addend)
{
    uint64_t carry = addend;
    for (int i = 0; i < a->size; i++) {
        carry += (uint64_t)a->word[i] * factor;
        a->word[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0) {
        a->word[a->size++] = (uint32_t)carry;
    }
}

static void big_multiply_power_of_ten(big_natural *a, int power)
{
    for (; power >= 9; power -= 9) {
        big_multiply_add(a, 1000000000u, 0);
    }
    for (; power > 0; power--) {
        big_multiply_add(a, 10, 0);
    }
}

static void big_shift(big_natural *a, int bits)
{
    int words = bits / 32;
    memmove(a->word + words, a->word, (size_t)a->size * sizeof a->word[0]);
    memset(a->word, 0, (size_t)words * sizeof a->word[0]);
    a->size += words;
    big_multiply_add(a, UINT32_C(1) << (bits % 32), 0);
}

/* For a > 0. */
static int big_bits(const big_natural *a)
{
    int bits = 32 * a->size;
    for (uint32_t top = a->word[a->size - 1]; !(top & 0x80000000u); top <<= 1) {
        bits--;
    }
    return bits;
}

static int big_compare(const big_natural *a, const big_natural *b)
{
    if (a->size != b->size) {
        return a->size < b->size ? -1 : 1;
    }
    for (int i = a->size - 1; i >= 0; i--) {
        if (a->word[i] != b->word[i]) {
            return a->word[i] < b->word[i] ? -1 : 1;
        }
    }
    return 0;
}

/* a -= b, for a >= b. */
static void big_subtract(big_natural *a, const big_natural *b)
{
    uint64_t borrow = 0;
    for (int i = 0; i < a->size; i++) {
        uint64_t less = borrow + (i < b->size ? b->word[i] : 0);
        borrow = a->word[i] < less;
        a->word[i] = (uint32_t)(a->word[i] - less);
    }
    while (a->size > 0 && a->word[a->size - 1] == 0) {
        a->size--;
    }
}

/* Rounds n/d * 2^exponent, 1 <= n/d < 2. Returns the bits of the double. A carry out of the
   mantissa increments the exponent; from the largest exponent it gives infinity. */
static uint64_t round_quotient(big_natural *n, const big_natural *d, int exponent)
{
    int precision = exponent >= -1022 ? 53 : 53 - (-1022 - exponent);
    if (exponent > 1023 || precision < 0) {
        return exponent > 1023 ? INFINITY_BITS : 0;
    }
    uint64_t q = 0;
    for (int i = 0; i < precision; i++) {
        q <<= 1;
        if (big_compare(n, d) >= 0) {
            big_subtract(n, d);
            q |= 1;
        }
        big_shift(n, 1);
    }
    int above = big_compare(n, d); /* n/d is the remainder, in half units of the last place */
    q += above > 0 || (above == 0 && (q & 1));
    return exponent >= -1022 ? q + ((uint64_t)(exponent + 1022) << 52) : q;
}

static double value_by_division(const decimal_text *t)
{
    big_natural n = {0, {0}};
    big_natural d = {1, {1}};
    for (int i = 0; i < t->count; i++) {
        big_multiply_add(&n, 10, t->digit[i]);
    }
    int power = (int)t->point - t->count;
    if (power >= 0) {
        big_multiply_power_of_ten(&n, power);
    } else {
        big_multiply_power_of_ten(&d, -power);
    }
    int exponent = big_bits(&n) - big_bits(&d);
    big_shift(exponent > 0 ? &d : &n, exponent > 0 ? exponent : -exponent);
    if (big_compare(&n, &d) < 0) {
        big_shift(&n, 1);
        exponent--;
    }
    return lrcsi_bits_double(round_quotient(&n, &d, exponent));
}

static double decimal_value(const decimal_text *t)
{
    static const double ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (t->count == 0 || t->point < POINT_MIN) {
        return 0.0;
    }
    if (t->point > POINT_MAX) {
        return lrcsi_bits_double(INFINITY_BITS);
    }
    int power = (int)t->point - t->count;
    if (t->count > 15 || power < -22 || power > 22) {
        return value_by_division(t);
    }
    double m = 0.0;
    for (int i = 0; i < t->count; i++) {
        m = m * 10.0 + t->digit[i];
    }
    return power < 0 ? m / ten[-power] : m * ten[power];
}

static int is_digit(const char *at, const char *end)
{
    return at < end && *at >= '0' && *at <= '9';
}

/* Digits of the integer part (fraction = 0) or after the point (fraction = 1). */
static const char *read_digits(const char *at, const char *end, int fraction, decimal_text *t)
{
    for (; is_digit(at, end); at++) {
        int leading = t->count == 0 && *at == '0';
        if (t->count < DIGITS_KEPT && !leading) {
            t->digit[t->count++] = (unsigned char)(*at - '0');
        } else if (*at != '0') {
            t->sticky = 1;
        }
        t->point += leading ? -fraction : 1 - fraction;
    }
    return at;
}

/* Reads an exponent if there is one at `at`. */
static const char *read_exponent(const char *at, const char *end, decimal_text *t)
{
    const char *p = at;
    if (p == end || (*p != 'e' && *p != 'E')) {
        return at;
    }
    p++;
    int negative = p < end && *p == '-';
    p += p < end && (*p == '+' || *p == '-');
    if (!is_digit(p, end)) {
        return at;
    }
    int64_t exponent = 0;
    for (; is_digit(p, end); p++) {
        exponent = exponent < EXPONENT_MAX ? exponent * 10 + (*p - '0') : exponent;
    }
    t->point += negative ? -exponent : exponent;
    return p;
}

const char *lrcsi_decimal_read(const char *text, const char *end, double *value)
{
    decimal_text t;
    t.point = 0;
    t.count = t.sticky = 0;
    const char *at = text;
    int negative = at < end && *at == '-';
    at += at < end && (*at == '+' || *at == '-');
    int has_digit = is_digit(at, end);
    at = read_digits(at, end, 0, &t);
    if (at < end && *at == '.' && (has_digit || is_digit(at + 1, end))) {
        has_digit = 1;
        at = read_digits(at + 1, end, 1, &t);
    }
    if (!has_digit) {
        return NULL;
    }
    at = read_exponent(at, end, &t);
    if (t.sticky) {
        t.digit[t.count++] = 1;
    }
    while (t.count > 0 && t.digit[t.count - 1] == 0) {
        t.count--;
    }
    double magnitude = decimal_value(&t);
    *value = negative ? -magnitude : magnitude;
    return at;
}
