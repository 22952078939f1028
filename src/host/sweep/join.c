/* SPDX-License-Identifier: MIT */
/* Joins the parts of a sweep. The rows are copied byte by byte, so that the file is identical to
   that of a single sweep. */
#include <lrcs/sweep_file.h>

#include <stdlib.h>
#include <string.h>

#include "host/files/file.h"
#include "host/sweep/read.h"

int lrcs_host_sweep_part_read(const char *path, const lrcs_host_sweep_part *other,
                              lrcs_host_sweep_part *part, lrcs_host_error *error)
{
    memset(part, 0, sizeof *part);
    part->path = path;
    int status = lrcs_host_file_read(path, &part->file, error);
    if (status != LRCS_OK) {
        return status;
    }
    const lrcs_host_rows *rows = &part->rows;
    if (lrcs_host_rows_open((const char *)part->file.bytes, part->file.size, &part->rows) !=
        LRCS_OK) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX,
                               "%s: expected rows of lrcs sweep, CSV or JSON lines", path);
    }
    if (other && (rows->head_size != other->rows.head_size ||
                  memcmp(rows->head, other->rows.head, rows->head_size) != 0)) {
        return lrcsi_host_fail(
            error, LRCS_E_SYNTAX,
            "%s: belongs to another sweep (its first lines differ from those of the "
            "first file)",
            path);
    }
    return lrcsi_rows_read(path, rows, NULL, NULL, NULL, &part->first, &part->count, error);
}

void lrcs_host_sweep_part_free(lrcs_host_sweep_part *part)
{
    lrcs_host_file_free(&part->file);
}

static int by_first_row(const void *a, const void *b)
{
    const lrcs_host_sweep_part *x = a;
    const lrcs_host_sweep_part *y = b;
    int empty = (x->count != 0) - (y->count != 0); /* parts without rows come first */
    return empty ? empty : (x->first > y->first) - (x->first < y->first);
}

/* Checks that every row is present exactly once. */
static int parts_check(const lrcs_host_sweep_part *part, uint32_t count, lrcs_host_error *error)
{
    uint64_t next = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (part[i].count > 0 && part[i].first < next) {
            return lrcsi_host_fail(error, LRCS_E_INDEX,
                                   "%s: holds rows that another file holds too", part[i].path);
        }
        if (part[i].count > 0 && part[i].first > next) {
            break;
        }
        next += part[i].count;
    }
    return next == part[0].rows.rows
               ? LRCS_OK
               : lrcsi_host_fail(error, LRCS_E_INDEX, "row %llu of %llu is in none of the files",
                                 (unsigned long long)next, (unsigned long long)part[0].rows.rows);
}

/* The rows of all parts, in order. */
typedef struct join_rows {
    const lrcs_host_sweep_part *part;
    uint32_t count, at;
    lrcs_host_rows rows; /* what remains of part `at` */
} join_rows;

static int join_next(void *context, lrcs_host_row *row, lrcs_host_error *error)
{
    join_rows *join = context;
    while (join->at < join->count) {
        int more = lrcs_host_rows_next(&join->rows, NULL, row, error);
        if (more != 0) {
            return more;
        }
        join->at++;
        join->rows = join->at < join->count ? join->part[join->at].rows : join->rows;
    }
    return 0;
}

/* Writes the text, and adds up the checksum of its bytes. */
static int join_write(FILE *out, join_rows *join, lrcs_host_error *error)
{
    const lrcs_host_rows *head = &join->part[0].rows;
    lrcs_host_tally tally = {0};
    lrcs_host_row row;
    int more;
    uint64_t sum = lrcs_host_hash(LRCS_HOST_HASH_START, head->head, head->head_size);
    fwrite(head->head, 1, head->head_size, out);
    while ((more = join_next(join, &row, error)) == 1) {
        lrcs_host_tally_add(&tally, &row);
        fwrite(join->rows.line, 1, join->rows.line_size, out);
        sum = lrcs_host_hash(sum, join->rows.line, join->rows.line_size);
    }
    if (more == 0 && head->is_sphere) {
        char *mean = NULL;
        size_t size = 0;
        FILE *text = open_memstream(&mean, &size);
        if (!text) {
            return lrcsi_host_out_of_memory(error);
        }
        lrcs_host_rows_mean_write(text, head->format, &tally);
        fclose(text);
        fwrite(mean, 1, size, out);
        sum = lrcs_host_hash(sum, mean, size);
        free(mean);
    }
    lrcs_host_rows_sum_write(out, head->format, sum);
    return more;
}

int lrcs_host_sweep_join(lrcs_host_sweep_part *part, uint32_t count, const char *path, int map,
                         lrcs_host_error *error)
{
    lrcs_host_output out;
    qsort(part, count, sizeof *part, by_first_row);
    int status = parts_check(part, count, error);
    if (status != LRCS_OK) {
        return status;
    }
    join_rows join = {.part = part, .count = count, .rows = part[0].rows};
    if (map) {
        return lrcs_host_sweep_map_write(path, &part[0].rows, join_next, &join, error);
    }
    status = lrcs_host_output_open(path, &out, error);
    if (status != LRCS_OK) {
        return status;
    }
    status = join_write(out.stream, &join, error);
    return lrcsi_host_output_end(&out, status, error);
}
