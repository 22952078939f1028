/* SPDX-License-Identifier: MIT */
/* Reads the text kind of STL: words separated by white space, in upper or lower case; lines end
   with LF, CR LF or CR. A solid's name is the rest of its line, whatever it contains; "endsolid"
   may be missing; stored normals need not be numbers (some writers print "nan" for slivers). */
#include "mesh/read/stl.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/decimal.h"
#include "base/text.h"
#include "base/where.h"

/* The next byte to read, and its line counted from 1. */
typedef struct stl_place {
    const unsigned char *bytes;
    size_t size, at;
    uint32_t line;
} stl_place;

static int stl_is_space(unsigned char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

static int stl_is_line_end(unsigned char byte)
{
    return byte == '\n' || byte == '\r';
}

static int stl_at_line_end(const stl_place *place)
{
    return place->at == place->size || stl_is_line_end(place->bytes[place->at]);
}

static void stl_skip_space(stl_place *place)
{
    while (place->at < place->size && stl_is_space(place->bytes[place->at])) {
        int cr_lf = place->bytes[place->at] == '\r' && place->at + 1 < place->size &&
                    place->bytes[place->at + 1] == '\n';
        place->line += stl_is_line_end(place->bytes[place->at]) && !cr_lf;
        place->at++;
    }
}

static size_t stl_word_size(const stl_place *place)
{
    size_t end = place->at;
    while (end < place->size && !stl_is_space(place->bytes[end])) {
        end++;
    }
    return end - place->at;
}

/* 1 if the next word is this one (given in lower case), which is then consumed. */
static int stl_take_word(stl_place *place, const char *word)
{
    stl_skip_space(place);
    size_t size = strlen(word);
    if (size > place->size - place->at) {
        return 0;
    }
    for (size_t i = 0; i < size; i++) {
        unsigned char byte = place->bytes[place->at + i];
        byte = byte >= 'A' && byte <= 'Z' ? (unsigned char)(byte + 32) : byte;
        if (byte != (unsigned char)word[i]) {
            return 0;
        }
    }
    size_t end = place->at + size;
    if (end < place->size && !stl_is_space(place->bytes[end])) {
        return 0;
    }
    place->at = end;
    return 1;
}

/* Reads the next word as a number. Returns 1 and consumes it, or 0. */
static int stl_take_number(stl_place *place, double *value)
{
    stl_skip_space(place);
    const char *word = (const char *)place->bytes + place->at;
    const char *end = word + stl_word_size(place);
    if (word == end || lrcsi_decimal_read(word, end, value) != end) {
        return 0;
    }
    place->at += (size_t)(end - word);
    return 1;
}

/* 1 if "facet normal" and a number come next: a file without line breaks continues like that after
   the name, but a name does not contain it. */
static int stl_facet_follows(stl_place place)
{
    double value;
    return stl_take_word(&place, "facet") && stl_take_word(&place, "normal") &&
           stl_take_number(&place, &value);
}

/* Skips the rest of a line, as far as it is a name. */
static lrcsi_span stl_take_name(stl_place *place)
{
    while (!stl_at_line_end(place) && stl_is_space(place->bytes[place->at])) {
        place->at++;
    }
    lrcsi_span name = {place->at, 0};
    while (!stl_at_line_end(place)) {
        int starts_word =
            stl_is_space(place->bytes[place->at - 1]) && !stl_is_space(place->bytes[place->at]);
        if (starts_word && stl_facet_follows(*place)) {
            break;
        }
        place->at++;
        if (!stl_is_space(place->bytes[place->at - 1])) {
            name.size = place->at - name.at;
        }
    }
    return name;
}

/* The start of the text, after a byte order mark. */
static stl_place stl_begin(const unsigned char *bytes, size_t size)
{
    return (stl_place){bytes, size, lrcsi_text_mark((const char *)bytes, size), 1};
}

/* A binary file of fewer than 2^24 facets has a zero in its header, the highest byte of its
   count; a text has none. For other files the words decide. */
int lrcsi_stl_is_text(const unsigned char *bytes, size_t size)
{
    stl_place place = stl_begin(bytes, size);
    if (size == 0 || memchr(bytes, 0, size < LRCSI_STL_HEADER ? size : LRCSI_STL_HEADER)) {
        return 0;
    }
    if (stl_facet_follows(place)) {
        return 1;
    }
    if (!stl_take_word(&place, "solid")) {
        return 0;
    }
    stl_take_name(&place);
    stl_skip_space(&place);
    return place.at == size || stl_take_word(&place, "facet") ||
           stl_take_word(&place, "endsolid") || stl_take_word(&place, "solid");
}

/* Reports that the expected word is missing. */
static int stl_fail(const lrcsi_stl_walk *walk, const stl_place *place, int status,
                    const char *item, const char *expected)
{
    status = place->at == place->size ? LRCS_E_TRUNCATED : status;
    return lrcsi_where_text(walk->where, status, place->at, place->line, item, expected,
                            (const char *)place->bytes + place->at, stl_word_size(place));
}

/* 1 if the next word begins as printf writes a number that is not finite. */
static int stl_is_not_finite(stl_place place)
{
    unsigned char sign = place.at < place.size ? place.bytes[place.at] : 0;
    place.at += sign == '-' || sign == '+';
    place.size = place.size - place.at > 3 ? place.at + 3 : place.size;
    return stl_take_word(&place, "nan") || stl_take_word(&place, "inf");
}

static int stl_read_coordinate(const lrcsi_stl_walk *walk, stl_place *place, double *value)
{
    stl_place start = *place;
    stl_skip_space(&start);
    if (!stl_take_number(place, value)) {
        int status = stl_is_not_finite(start) ? LRCS_E_NUMBER : LRCS_E_SYNTAX;
        return stl_fail(walk, &start, status, "vertex coordinate", "a finite number");
    }
    if (!(fabs(*value) <= LRCSI_COORDINATE_MAX)) {
        return stl_fail(walk, &start, LRCS_E_NUMBER, "vertex coordinate",
                        "a finite number, at most 1e100");
    }
    return LRCS_OK;
}

static int stl_expect(const lrcsi_stl_walk *walk, stl_place *place, const char *word)
{
    return stl_take_word(place, word) ? LRCS_OK
                                      : stl_fail(walk, place, LRCS_E_SYNTAX, "facet", word);
}

/* The normal: three words, numbers or not. */
static int stl_read_normal(const lrcsi_stl_walk *walk, stl_place *place, double normal[3])
{
    int status = stl_expect(walk, place, "normal");
    for (int k = 0; status == LRCS_OK && k < 3; k++) {
        if (!stl_take_number(place, &normal[k])) {
            size_t size = stl_word_size(place);
            if (size == 0) {
                return stl_fail(walk, place, LRCS_E_SYNTAX, "facet normal", "three numbers");
            }
            place->at += size;
            normal[k] = (double)NAN;
        }
    }
    return status;
}

/* Reads a facet whose first word is already consumed. */
static int stl_read_text_facet(lrcsi_stl_walk *walk, stl_place *place)
{
    double normal[3];
    double corner[3][3];
    stl_place start = *place;
    int status = stl_read_normal(walk, place, normal);
    if (status == LRCS_OK) {
        status = stl_expect(walk, place, "outer");
    }
    if (status == LRCS_OK) {
        status = stl_expect(walk, place, "loop");
    }
    for (int i = 0; status == LRCS_OK && i < 3; i++) {
        status = stl_expect(walk, place, "vertex");
        for (int k = 0; status == LRCS_OK && k < 3; k++) {
            status = stl_read_coordinate(walk, place, &corner[i][k]);
        }
    }
    if (status == LRCS_OK) {
        status = stl_expect(walk, place, "endloop");
    }
    if (status == LRCS_OK) {
        status = stl_expect(walk, place, "endfacet");
    }
    if (status == LRCS_OK && lrcsi_stl_add(walk, corner, normal) != LRCS_OK) {
        status = stl_fail(walk, &start, LRCS_E_LIMIT, "facet", "fewer than 2^32 / 3 facets");
    }
    return status;
}

int lrcsi_stl_read_text(lrcsi_stl_walk *walk)
{
    stl_place place = stl_begin(walk->bytes, walk->size);
    int named = 0;
    int ended = 0;
    int status = LRCS_OK;
    while (status == LRCS_OK) {
        stl_skip_space(&place);
        if (stl_take_word(&place, "facet")) {
            status = stl_read_text_facet(walk, &place);
        } else if (stl_take_word(&place, "endsolid")) {
            stl_take_name(&place);
            ended = 1;
        } else if (stl_take_word(&place, "solid")) {
            lrcsi_span name = stl_take_name(&place);
            walk->name = named ? walk->name : name;
            named = 1;
        } else if (place.at == place.size && (walk->facets > 0 || ended)) {
            break;
        } else {
            status = stl_fail(walk, &place, LRCS_E_SYNTAX, "word", "facet, endsolid or solid");
        }
    }
    return status;
}
