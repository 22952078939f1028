/* SPDX-License-Identifier: MIT */
/* Moving through the bytes of a scene file: blanks, comments, line ends, and the report of what
   should not stand where it does. */
#include "scene/toml_scan.h"

#include "base/where.h"

int lrcsi_toml_stop(const lrcsi_toml *toml, int status, const char *at, const char *item,
                    const char *expected)
{
    static const char end_of_file[] = "end of file";
    static const char end_of_line[] = "end of line";
    uint64_t offset = (uint64_t)(at - toml->start);
    if (at == toml->end) {
        return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected,
                                end_of_file, sizeof end_of_file - 1);
    }
    if (lrcsi_toml_is_end(*at)) {
        return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected,
                                end_of_line, sizeof end_of_line - 1);
    }
    size_t size = 1;
    while (size < LRCSI_TOML_EXCERPT && at + size < toml->end && !lrcsi_toml_is_end(at[size])) {
        size++;
    }
    return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected, at, size);
}

void lrcsi_toml_blanks(lrcsi_toml *toml)
{
    while (lrcsi_toml_peek(toml, ' ') || lrcsi_toml_peek(toml, '\t')) {
        toml->at++;
    }
}

/* Passes a comment, up to its line end. */
static void skip_comment(lrcsi_toml *toml)
{
    if (lrcsi_toml_peek(toml, '#')) {
        while (toml->at < toml->end && !lrcsi_toml_is_end(*toml->at)) {
            toml->at++;
        }
    }
}

/* Passes one line end, if it stands here: lrcsi_toml_start saw that a CR is followed by LF. */
static int skip_line_end(lrcsi_toml *toml)
{
    if (toml->at == toml->end || !lrcsi_toml_is_end(*toml->at)) {
        return 0;
    }
    toml->at += *toml->at == '\r' ? 2 : 1;
    toml->line++;
    return 1;
}

void lrcsi_toml_lines(lrcsi_toml *toml)
{
    do {
        lrcsi_toml_blanks(toml);
        skip_comment(toml);
    } while (skip_line_end(toml));
}

int lrcsi_toml_line_end(lrcsi_toml *toml, const char *item)
{
    lrcsi_toml_blanks(toml);
    skip_comment(toml);
    if (toml->at < toml->end && !skip_line_end(toml)) {
        return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, toml->at, item, "the end of the line");
    }
    return LRCS_OK;
}
