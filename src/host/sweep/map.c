/* SPDX-License-Identifier: MIT */
/* A sweep as a NumPy array, FILE.npy, and a file that identifies the sweep, FILE.npy.head: the
   first lines of the rows, a checksum of the map and counts of row results. This file decides the
   bytes of both, and whether an existing map is the one that a sweep would make. */
#include <lrcs/sweep_file.h>

#include <lrcs/table.h>

#include <stdlib.h>
#include <string.h>

#include "host/files/file.h"

#define MAP_HEAD ".head"
#define MAP_LINE 200u

static void npy_double(FILE *out, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++) {
        putc((int)(bits >> (8 * i) & 0xff), out);
    }
}

/* The format: numpy.org/doc/stable/reference/generated/numpy.lib.format.html, version 1.0. */
static void npy_head(FILE *out, const lrcs_host_rows *rows)
{
    char head[512];
    int used = snprintf(head, sizeof head, "{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for (uint32_t i = 0; i < rows->dimensions; i++) {
        used += snprintf(head + used, sizeof head - (size_t)used, "%llu, ",
                         (unsigned long long)rows->shape[i]);
    }
    used += snprintf(head + used, sizeof head - (size_t)used, "%d), }", rows->flagged ? 3 : 2);
    int whole = (10 + used + 1 + 63) / 64 * 64;
    fprintf(out, "%cNUMPY%c%c%c%c%s%*s\n", 0x93, 1, 0, (whole - 10) & 0xff, (whole - 10) >> 8, head,
            whole - 11 - used, "");
}

/* ---- the head beside it ---- */

static const char *const map_count[LRCS_HOST_TALLY_FLAGS] = {"missed", "starved", "estimated",
                                                             "unjudged"};

/* The last line of the head. */
static void map_sum_text(const lrcs_host_file *map, const lrcs_host_tally *tally,
                         char line[MAP_LINE])
{
    uint64_t hash = lrcs_host_hash(LRCS_HOST_HASH_START, map->bytes, map->size);
    int used = snprintf(line, MAP_LINE, "# map=fnv1a:%016llx", (unsigned long long)hash);
    for (int k = 0; k < LRCS_HOST_TALLY_FLAGS; k++) {
        used += snprintf(line + used, MAP_LINE - (size_t)used, "; %s=%llu", map_count[k],
                         (unsigned long long)tally->count[k]);
    }
    snprintf(line + used, MAP_LINE - (size_t)used, "\n");
}

/* Writes the head of a map that stands under a temporary name. */
static int map_head_write(const char *path, const char *map, const lrcs_host_rows *rows,
                          const lrcs_host_tally *tally, lrcs_host_error *error)
{
    char name[4096], line[MAP_LINE];
    lrcs_host_file made;
    lrcs_host_output head;
    if ((size_t)snprintf(name, sizeof name, "%s" MAP_HEAD, path) >= sizeof name) {
        return lrcsi_host_fail(error, LRCS_E_SYSTEM, "%s: the name is too long", path);
    }
    int status = lrcs_host_file_read(map, &made, error);
    if (status != LRCS_OK) {
        return status;
    }
    map_sum_text(&made, tally, line);
    lrcs_host_file_free(&made);
    status = lrcs_host_output_open(name, &head, error);
    if (status != LRCS_OK) {
        return status;
    }
    fwrite(rows->head, 1, rows->head_size, head.stream);
    fputs(line, head.stream);
    return lrcs_host_output_close(&head, 1, error);
}

int lrcs_host_sweep_map_write(const char *path, const lrcs_host_rows *rows,
                              lrcs_host_sweep_next *next, void *context, lrcs_host_error *error)
{
    lrcs_host_output map;
    lrcs_host_tally tally = {0};
    lrcs_host_row row;
    int more;
    int status = lrcs_host_output_open(path, &map, error);
    if (status != LRCS_OK) {
        return status;
    }
    /* 1. The map, under a temporary name. */
    npy_head(map.stream, rows);
    while ((more = next(context, &row, error)) == 1) {
        lrcs_host_tally_add(&tally, &row);
        npy_double(map.stream, row.field[LRCS_HOST_ROW_SIGMA]);
        npy_double(map.stream, row.field[LRCS_HOST_ROW_BOUND]);
        if (rows->flagged) {
            npy_double(map.stream, row.flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE ? 1.0
                                   : row.flags & LRCS_FLAG_ACCEPTED_UNJUDGED  ? 2.0
                                   : row.flags & LRCS_FLAG_TOLERANCE_NOT_MET  ? -1.0
                                                                              : 0.0);
        }
    }
    status = more;
    /* 2. Its head; a device or standard output has none. */
    if (status == LRCS_OK && map.temporary && fflush(map.stream) == 0) {
        status = map_head_write(path, map.temporary, rows, &tally, error);
    }
    /* 3. The map under its own name. */
    return lrcsi_host_output_end(&map, status, error);
}

/* ---- a map that is there ---- */

static double npy_double_at(const unsigned char *bytes)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++) {
        bits |= (uint64_t)bytes[i] << (8 * i);
    }
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Reads the last line of a head: counts of row results that the map does not contain. 1, or 0 if it
   is not such a line, or not that of these bytes. */
static int map_tally_read(lrcs_host_sweep_map *map)
{
    char line[MAP_LINE] = "";
    char expected[MAP_LINE];
    size_t size = (size_t)(map->rows.end - map->rows.at);
    memcpy(line, map->rows.at, size < sizeof line ? size : 0);
    for (int k = 0; k < LRCS_HOST_TALLY_FLAGS; k++) {
        char count[32] = "";
        lrcs_host_key_text(line, map_count[k], count, sizeof count);
        map->tally.count[k] = strtoull(count, NULL, 10);
    }
    map_sum_text(&map->file, &map->tally, expected);
    return strcmp(line, expected) == 0;
}

int lrcs_host_sweep_map_open(const char *path, lrcs_host_sweep_map *map)
{
    char beside[4096];
    memset(map, 0, sizeof *map);
    if ((size_t)snprintf(beside, sizeof beside, "%s" MAP_HEAD, path) >= sizeof beside ||
        lrcs_host_file_read(beside, &map->beside, NULL) != LRCS_OK ||
        lrcs_host_file_read(path, &map->file, NULL) != LRCS_OK ||
        lrcs_host_rows_open((const char *)map->beside.bytes, map->beside.size, &map->rows) !=
            LRCS_OK ||
        !map_tally_read(map)) {
        return LRCS_E_SYNTAX;
    }
    const lrcs_host_file *file = &map->file;
    size_t skip = file->size > 10 ? 10u + file->bytes[8] + 256u * file->bytes[9] : file->size;
    size_t room = file->size > skip ? (file->size - skip) / map->rows.rows : 0;
    map->value = file->bytes + skip;
    map->numbers = (uint32_t)(room / 8);
    return room == 16 || room == 24 ? LRCS_OK : LRCS_E_SYNTAX;
}

void lrcs_host_sweep_map_row(const lrcs_host_sweep_map *map, uint64_t index, lrcs_host_row *row)
{
    const unsigned char *at = map->value + index * 8 * map->numbers;
    *row = (lrcs_host_row){.index = index,
                           .field[LRCS_HOST_ROW_SIGMA] = npy_double_at(at),
                           .field[LRCS_HOST_ROW_BOUND] = npy_double_at(at + 8)};
}

void lrcs_host_sweep_map_close(lrcs_host_sweep_map *map)
{
    lrcs_host_file_free(&map->file);
    lrcs_host_file_free(&map->beside);
}
