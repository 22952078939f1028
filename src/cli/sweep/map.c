/* SPDX-License-Identifier: MIT */
/* A sweep as a NumPy array, FILE.npy, and a file that identifies the sweep, FILE.npy.head: the
   first lines of the rows, a checksum of the map and counts of row results. This file decides the
   bytes of both, and whether an existing map is the one that a sweep would make. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>

#define MAP_HEAD ".head"

static void npy_double(FILE *out, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++) {
        putc((int)(bits >> (8 * i) & 0xff), out);
    }
}

/* The format: numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0. */
static void npy_head(FILE *out, const sweep_text *text)
{
    char head[512];
    int used = snprintf(head, sizeof head, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for (uint32_t i = 0; i < text->dimensions; i++) {
        used += snprintf(head + used, sizeof head - (size_t)used, "%llu, ",
                         (unsigned long long)text->shape[i]);
    }
    used += snprintf(head + used, sizeof head - (size_t)used, "%d), }", text->flagged ? 3 : 2);
    int whole = (10 + used + 1 + 63) / 64 * 64;
    fprintf(out, "%cNUMPY%c%c%c%c%s%*s\n", 0x93, 1, 0, (whole - 10) & 0xff, (whole - 10) >> 8, head,
            whole - 11 - used, "");
}

/* ---- the head beside it ---- */

static const char *const map_count[TALLY_FLAGS] = {"missed", "starved", "estimated", "unjudged"};

static void map_sum(FILE *out, const lrcs_host_file *map, const sweep_tally *tally)
{
    fprintf(out, "# map=fnv1a:%016llx",
            (unsigned long long)cli_sum_more(CLI_SUM_BEGIN, map->bytes, map->size));
    for (int k = 0; k < TALLY_FLAGS; k++) {
        fprintf(out, "; %s=%llu", map_count[k], (unsigned long long)tally->count[k]);
    }
    putc('\n', out);
}

int cli_map_write(const char *path, const sweep_text *text, sweep_next *next, void *context)
{
    lrcs_host_error error;
    lrcs_host_output map;
    lrcs_host_output beside;
    lrcs_host_file made = {NULL, 0};
    sweep_tally tally = {0};
    sweep_row row;
    char head[4096];
    int more = 1;
    if ((size_t)snprintf(head, sizeof head, "%s" MAP_HEAD, path) >= sizeof head ||
        lrcs_host_output_open(path, &map, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    /* 1. The map, under a temporary name. */
    npy_head(map.stream, text);
    while ((more = next(context, &row)) == 1) {
        cli_tally_add(&tally, &row);
        npy_double(map.stream, row.field[FIELD_SIGMA]);
        npy_double(map.stream, row.field[FIELD_BOUND]);
        if (text->flagged) {
            npy_double(map.stream, row.flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE ? 1.0
                                   : row.flags & LRCS_FLAG_ACCEPTED_UNJUDGED  ? 2.0
                                   : row.flags & LRCS_FLAG_TOLERANCE_NOT_MET  ? -1.0
                                                                              : 0.0);
        }
    }
    int status = more == 0 ? LRCS_OK : LRCS_E_SYNTAX;
    /* 2. Its checksum and its head; a device or standard output has none. */
    if (status == LRCS_OK && map.temporary && fflush(map.stream) == 0) {
        status = lrcs_host_file_read(map.temporary, &made, &error);
        if (status == LRCS_OK) {
            status = lrcs_host_output_open(head, &beside, &error);
        }
        if (status == LRCS_OK) {
            fwrite(text->head, 1, text->head_size, beside.stream);
            map_sum(beside.stream, &made, &tally);
            status = lrcs_host_output_close(&beside, 1, &error);
        }
        lrcs_host_file_free(&made);
    }
    /* 3. The map under its own name. */
    int closed = lrcs_host_output_close(&map, status == LRCS_OK, status == LRCS_OK ? &error : NULL);
    if (more != 0) {
        return CLI_FAILED;
    }
    status = status == LRCS_OK ? closed : status;
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* ---- a map that is there ---- */

static double double_at(const unsigned char *bytes)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++) {
        bits |= (uint64_t)bytes[i] << (8 * i);
    }
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Reads the last line of a head: counts of row results that the map does not contain. 0, or -1 if
   it is not such a line, or not that of these bytes. */
static int map_tally_read(sweep_map *map)
{
    char line[200] = "";
    char expected[200] = "";
    size_t size = (size_t)(map->text.end - map->text.at);
    memcpy(line, map->text.at, size < sizeof line ? size : 0);
    for (int k = 0; k < TALLY_FLAGS; k++) {
        char count[32] = "";
        cli_key_text(line, map_count[k], count, sizeof count);
        map->tally.count[k] = strtoull(count, NULL, 10);
    }
    FILE *out = fmemopen(expected, sizeof expected, "w");
    if (!out) {
        return -1;
    }
    map_sum(out, &map->file, &map->tally);
    fclose(out);
    return strcmp(line, expected) == 0 ? 0 : -1;
}

int cli_map_open(const char *path, sweep_map *map)
{
    char beside[4096];
    memset(map, 0, sizeof *map);
    if ((size_t)snprintf(beside, sizeof beside, "%s" MAP_HEAD, path) >= sizeof beside ||
        lrcs_host_file_read(beside, &map->beside, NULL) != LRCS_OK ||
        lrcs_host_file_read(path, &map->file, NULL) != LRCS_OK ||
        cli_text_open((const char *)map->beside.bytes, map->beside.size, &map->text) != 0 ||
        map_tally_read(map) != 0) {
        return -1;
    }
    const lrcs_host_file *file = &map->file;
    size_t skip = file->size > 10 ? 10u + file->bytes[8] + 256u * file->bytes[9] : file->size;
    size_t room = file->size > skip ? (file->size - skip) / map->text.rows : 0;
    map->value = file->bytes + skip;
    map->numbers = (uint32_t)(room / 8);
    return room == 16 || room == 24 ? 0 : -1;
}

void cli_map_row(const sweep_map *map, uint64_t index, sweep_row *row)
{
    const unsigned char *at = map->value + index * 8 * map->numbers;
    *row = (sweep_row){.index = index,
                       .field[FIELD_SIGMA] = double_at(at),
                       .field[FIELD_BOUND] = double_at(at + 8)};
}

void cli_map_close(sweep_map *map)
{
    lrcs_host_file_free(&map->file);
    lrcs_host_file_free(&map->beside);
}

int cli_map_recover(sweep_file *file, const sweep_plan *plan, const char *const head[2],
                    const size_t head_size[2])
{
    sweep_map map;
    int same = cli_map_open(file->path, &map);
    if (same == 0) { /* the rows of a merged map may have had either format */
        int format = map.text.format;
        same = map.text.head_size == head_size[format] &&
                       memcmp(map.text.head, head[format], head_size[format]) == 0
                   ? 0
                   : -1;
    }
    for (uint64_t i = 0; same == 0 && i < plan->rows; i++) {
        sweep_row row;
        cli_map_row(&map, i, &row);
        cli_file_take(file, &row);
    }
    if (same == 0) {
        memcpy(file->tally.count, map.tally.count, sizeof map.tally.count);
    }
    cli_map_close(&map);
    return same;
}
