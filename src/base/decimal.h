/* SPDX-License-Identifier: MIT */
/* Decimal text to double, correctly rounded (nearest, ties to even) whatever the locale. */
#ifndef LRCSI_DECIMAL_H
#define LRCSI_DECIMAL_H

/* Reads [+-]digits[.digits][(e|E)[+-]digits] (a digit is needed on one side of the point) from
   [text, end). Returns the first byte not read, or NULL where no number stands there; "nan",
   "inf" and hexadecimal are no numbers. A value beyond double range gives +-infinity: the caller
   refuses it. *value is untouched on NULL. */
const char *lrcsi_decimal_read(const char *text, const char *end, double *value);

#endif
