/* SPDX-License-Identifier: MIT */
/* Decimal text to double, correctly rounded (nearest, ties to even), independent of the locale. */
#ifndef LRCSI_DECIMAL_H
#define LRCSI_DECIMAL_H

/* Reads [+-]digits[.digits][(e|E)[+-]digits] (a digit is needed on one side of the point) from
   [text, end). Returns the first byte not read, or NULL if the text does not begin with a number;
   "nan", "inf" and hexadecimal do not count as numbers. A value beyond double range gives
   +-infinity, which the caller rejects. *value is unchanged on NULL. */
const char *lrcsi_decimal_read(const char *text, const char *end, double *value);

#endif
