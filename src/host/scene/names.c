/* SPDX-License-Identifier: MIT */
/* Names as users type them: patterns, upper and lower case, and the similarity of two names. It
   decides what matches; the caller decides what a match means. */
#include "host/scene/names.h"

#include <string.h>

#define NAME_BYTES_MAX  64u /* bytes that count for the distance of two names */
#define WORD_SEPARATORS "-_ "
#define PART_MIN        3u /* bytes of a name that make it recognisable within another */

/* ---- matching ---- */

static unsigned char fold_byte(unsigned char c, int fold)
{
    return fold && c >= 'A' && c <= 'Z' ? (unsigned char)(c - 'A' + 'a') : c;
}

/* The number of bytes of the UTF-8 character at `at`; 1 if it is not valid. */
static size_t utf8_size(const char *at)
{
    size_t size = 1;
    while ((at[size] & 0xc0) == 0x80) {
        size++;
    }
    return size;
}

int lrcsi_name_is_pattern(const char *text)
{
    return strpbrk(text, "*?") != NULL;
}

/* After a mismatch the match resumes at the last *, which takes one character more. Earlier stars
   need not be tried again, because the text between two stars can always be matched at its first
   occurrence. */
int lrcsi_name_matches(const char *pattern, const char *name, int fold)
{
    const char *star = NULL;
    const char *resume = NULL;
    while (*name) {
        if (*pattern == '*') {
            star = pattern++;
            resume = name;
        } else if (*pattern == '?') {
            pattern++;
            name += utf8_size(name);
        } else if (fold_byte((unsigned char)*pattern, fold) ==
                   fold_byte((unsigned char)*name, fold)) {
            pattern++;
            name++;
        } else if (star) {
            pattern = star + 1;
            resume += utf8_size(resume);
            name = resume;
        } else {
            return 0;
        }
    }
    return pattern[strspn(pattern, "*")] == '\0';
}

int lrcsi_name_same_folded(const char *a, const char *b)
{
    while (*a && fold_byte((unsigned char)*a, 1) == fold_byte((unsigned char)*b, 1)) {
        a++;
        b++;
    }
    return *a == *b;
}

/* ---- similarity ---- */

static unsigned smaller_of(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

/* Levenshtein's distance, with neighbours swapped counted once (optimal string alignment). */
static unsigned edit_distance(const char *a, const char *b, int fold)
{
    unsigned row[3][NAME_BYTES_MAX + 1];
    size_t na = strlen(a) < NAME_BYTES_MAX ? strlen(a) : NAME_BYTES_MAX;
    size_t nb = strlen(b) < NAME_BYTES_MAX ? strlen(b) : NAME_BYTES_MAX;
    unsigned char fa[NAME_BYTES_MAX];
    unsigned char fb[NAME_BYTES_MAX];
    for (size_t i = 0; i < na; i++) {
        fa[i] = fold_byte((unsigned char)a[i], fold);
    }
    for (size_t k = 0; k < nb; k++) {
        fb[k] = fold_byte((unsigned char)b[k], fold);
    }
    for (unsigned k = 0; k <= nb; k++) {
        row[0][k] = k;
    }
    for (size_t i = 1; i <= na; i++) {
        unsigned *now = row[i % 3];
        const unsigned *last = row[(i - 1) % 3];
        now[0] = (unsigned)i;
        for (size_t k = 1; k <= nb; k++) {
            now[k] = smaller_of(smaller_of(last[k], now[k - 1]) + 1,
                                last[k - 1] + (fa[i - 1] != fb[k - 1]));
            if (i > 1 && k > 1 && fa[i - 1] == fb[k - 2] && fa[i - 2] == fb[k - 1]) {
                now[k] = smaller_of(now[k], row[(i - 2) % 3][k - 2] + 1);
            }
        }
    }
    return row[na % 3][nb];
}

/* 0 if `name` begins with the text, which is not empty, else the number of edits. */
static unsigned beginning_distance(const char *text, const char *name, int fold)
{
    size_t size = 0;
    while (text[size] && fold_byte((unsigned char)text[size], fold) ==
                             fold_byte((unsigned char)name[size], fold)) {
        size++;
    }
    return size > 0 && text[size] == '\0' ? 0 : edit_distance(text, name, fold);
}

/* Twice the distance to a name or to the nearest of its words, 1 more if it is a word's: "white" is
   a word of "paint-white". */
static unsigned name_rank(const char *text, const char *name, int fold)
{
    unsigned rank = 2 * beginning_distance(text, name, fold);
    for (const char *at = name; *at; at += *at != '\0') {
        char word[NAME_BYTES_MAX + 1] = "";
        size_t size = strcspn(at, WORD_SEPARATORS);
        memcpy(word, at, size < NAME_BYTES_MAX ? size : NAME_BYTES_MAX);
        at += size;
        rank = size > 0 ? smaller_of(rank, 2 * beginning_distance(text, word, fold) + 1) : rank;
    }
    return rank;
}

unsigned lrcs_host_name_distance(const char *text, const char *name)
{
    return name_rank(text, name, 0) / 2;
}

const char *lrcs_host_name_nearer(const char *text, const char *best, const char *candidate)
{
    return !best || name_rank(text, candidate, 0) < name_rank(text, best, 0) ? candidate : best;
}

/* 1 if one contains the other, ignoring case; the empty text contains nothing. */
static int contains(const char *whole, const char *part)
{
    size_t size = strlen(whole);
    for (size_t i = 0; part[0] && i < size; i++) {
        size_t k = 0;
        while (part[k] &&
               fold_byte((unsigned char)whole[i + k], 1) == fold_byte((unsigned char)part[k], 1)) {
            k++;
        }
        if (part[k] == '\0') {
            return 1;
        }
    }
    return 0;
}

int lrcs_host_name_is_near(const char *text, const char *name)
{
    size_t size = strlen(text);
    size_t edits = size < 2 ? 0 : size < 6 ? 1 : size / 3;
    return (size >= PART_MIN && contains(name, text)) ||
           (strlen(name) >= PART_MIN && contains(text, name)) ||
           name_rank(text, name, 1) / 2 <= edits;
}

static unsigned name_difference(const char *text, const char *name)
{
    return contains(name, text) || contains(text, name) ? 0 : edit_distance(text, name, 1);
}

/* Insertion into a short sorted list; names of equal similarity keep their order. */
uint32_t lrcs_host_names_near(const char *text, const char *const *name, uint32_t count,
                              const char **near, uint32_t capacity)
{
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        unsigned distance = name_difference(text, name[i]);
        uint32_t at = used;
        int known = 0;
        for (uint32_t k = 0; k < used; k++) {
            known |= strcmp(near[k], name[i]) == 0;
        }
        while (!known && at > 0 && name_difference(text, near[at - 1]) > distance) {
            at--;
        }
        if (known || at >= capacity || name[i][0] == '\0') {
            continue;
        }
        used += used < capacity;
        memmove(near + at + 1, near + at, (used - at - 1) * sizeof *near);
        near[at] = name[i];
    }
    return used;
}
