/* SPDX-License-Identifier: MIT */
/* Compares the submitted item images with the truth's, pixel by pixel: which are rotated or
   mirrored, number facets from another base, lose facets or show hidden ones. This only explains;
   the verdict depends on sigma alone. */
#include "cli/compare/compare.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define AGREE 0.98 /* share of the non-empty pixels; the others are outlines */

typedef struct items_image {
    uint32_t side;
    unsigned char *bytes; /* side * side uint32, little-endian */
    lrcs_host_file file;
} items_image;

static uint32_t item_at(const items_image *image, uint32_t row, uint32_t column)
{
    const unsigned char *p = image->bytes + 4 * ((size_t)row * image->side + column);
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* A convention for images: rows and columns reversed or exchanged, and indices shifted. */
typedef struct items_way {
    const char *text;
    int exchange, rows, columns; /* rows, columns: 1 if reversed */
    uint32_t add;                /* added to the truth's facet to get the submitted one */
} items_way;

static const items_way item_ways[COMPARE_IMAGE_WAYS] = {
    {"agree with the truth", 0, 0, 0, 0},
    {"are upside down: row 0 is at the bottom", 0, 1, 0, 0},
    {"are mirrored left to right: a left-handed view", 0, 0, 1, 0},
    {"are turned by 180 deg", 0, 1, 1, 0},
    {"have rows and columns exchanged", 1, 0, 0, 0},
    {"are turned by 90 deg", 1, 1, 0, 0},
    {"are turned by -90 deg", 1, 0, 1, 0},
    {"have rows and columns exchanged and turned", 1, 1, 1, 0},
    {"agree, but their facets count from 1", 0, 0, 0, 1},
    {"are upside down, and their facets count from 1", 0, 1, 0, 1}};

/* Of the pixels that are not empty in at least one of the images, the share in which both agree,
   with rows and columns of the submitted image as in `way`. If indices start at 1, 0 is none. */
static double images_agree(const items_image *truth, const items_image *theirs,
                           const items_way *way)
{
    uint32_t last = truth->side - 1;
    uint64_t shown = 0;
    uint64_t same = 0;
    for (uint32_t row = 0; row < truth->side; row++) {
        for (uint32_t column = 0; column < truth->side; column++) {
            uint32_t y = way->rows ? last - row : row;
            uint32_t x = way->columns ? last - column : column;
            uint32_t a = item_at(truth, row, column);
            uint32_t b = way->exchange ? item_at(theirs, x, y) : item_at(theirs, y, x);
            int none = b == LRCS_NONE || (way->add > 0 && b == 0);
            int equal = a == LRCS_NONE ? none : b == a + way->add;
            shown += a != LRCS_NONE || !equal;
            same += a != LRCS_NONE && equal;
        }
    }
    return shown > 0 ? (double)same / (double)shown : 1.0;
}

/* The facets that lose most pixels, with the number of the truth's pixels that show something else.
   0 or CLI_FAILED. */
static int facets_lost(const lrcs_scene *scene, const items_image *truth, const items_image *theirs,
                       compare_image *image)
{
    uint32_t *lost = calloc((size_t)scene->facet_count + 1, sizeof *lost);
    if (!lost) {
        return cli_out_of_memory();
    }
    for (uint32_t i = 0; i < truth->side * truth->side; i++) {
        uint32_t a = item_at(truth, i / truth->side, i % truth->side);
        uint32_t b = item_at(theirs, i / truth->side, i % truth->side);
        lost[a < scene->facet_count ? a : scene->facet_count] += a != b;
    }
    for (uint32_t n = 0; n < COMPARE_TOP; n++) {
        uint32_t best = 0;
        for (uint32_t i = 1; i < scene->facet_count; i++) {
            best = lost[i] > lost[best] ? i : best;
        }
        image->facet[n] = best;
        image->lost[n] = lost[best];
        lost[best] = 0;
    }
    free(lost);
    return 0;
}

/* Reads an image: 1 if it exists, 0 if not, -1 with the message printed. */
static int image_read(const char *path, uint32_t side, items_image *image)
{
    lrcs_host_error error;
    size_t size = 4 * (size_t)side * side;
    *image = (items_image){.side = side};
    if (access(path, F_OK) != 0) {
        return 0;
    }
    if (lrcs_host_file_read(path, &image->file, &error) != LRCS_OK) {
        cli_failed(&error);
        return -1;
    }
    image->bytes = image->file.bytes;
    if (image->file.size != size) {
        cli_fail("%s: expected %lu x %lu pixels of 4 bytes, found %zu bytes", path,
                 (unsigned long)side, (unsigned long)side, image->file.size);
        lrcs_host_file_free(&image->file);
        return -1;
    }
    return 1;
}

static int image_judge(compare_job *job, const compare_case *one, const items_image *truth,
                       const items_image *theirs)
{
    compare_items *found = &job->by_item;
    double first = 0.0;
    double most = 0.0;
    size_t best = 0;
    for (size_t i = 0; i < COMPARE_IMAGE_WAYS; i++) {
        double agree = images_agree(truth, theirs, &item_ways[i]);
        first = i == 0 ? agree : first;
        best = agree > most ? i : best;
        most = fmax(agree, most);
    }
    if (first >= AGREE || most >= AGREE) {
        found->way[first >= AGREE ? 0 : best]++;
        return 0;
    }
    if (found->differ++ >= COMPARE_NAMED) {
        return 0;
    }
    compare_image *image = &found->image[found->named++];
    *image = (compare_image){.one = one, .agree = first};
    return facets_lost(&job->kit.scene[one->scene].host.scene, truth, theirs, image);
}

/* 1 if an image was submitted, 0 if not, -1 on failure. */
static int case_judge(compare_job *job, const compare_case *one)
{
    char path[2][KIT_PATH];
    const char *const folder[2] = {job->kit.folder, job->items};
    const char *const inside[2] = {"truth/", ""};
    const char *name = job->kit.scene[one->scene].name;
    items_image image[2];
    for (int i = 0; i < 2; i++) {
        if (cli_kit_path(path[i], "%s/%s%s.%s.item.u32", folder[i], inside[i], name,
                         one->attitude) != 0) {
            return -1;
        }
    }
    int found = image_read(path[1], one->image, &image[1]);
    if (found <= 0) {
        return found;
    }
    found = image_read(path[0], one->image, &image[0]);
    if (found == 0) {
        cli_fail("%s: not there", path[0]);
    }
    int good = found > 0 && cli_compare_scene(&job->kit, &job->kit.scene[one->scene]) == 0;
    good = good && image_judge(job, one, &image[0], &image[1]) == 0;
    lrcs_host_file_free(&image[0].file);
    lrcs_host_file_free(&image[1].file);
    return good ? 1 : -1;
}

int cli_compare_items(compare_job *job)
{
    DIR *folder = job->items ? opendir(job->items) : NULL;
    if (job->items && !folder) {
        return cli_fail("%s: cannot open folder: %s", job->items, strerror(errno));
    }
    if (folder) {
        closedir(folder);
    }
    for (uint32_t i = 0; job->items && i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->image > 0 && cli_compare_asked(job, one)) {
            int judged = case_judge(job, one);
            if (judged < 0) {
                return CLI_FAILED;
            }
            job->by_item.handed += (uint32_t)judged;
            job->by_item.images++;
        }
    }
    return 0;
}

const char *cli_compare_image_way(size_t way)
{
    return item_ways[way].text;
}
