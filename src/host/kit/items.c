/* SPDX-License-Identifier: MIT */
/* Compares the submitted item images with the truth's, pixel by pixel: which are rotated or
   mirrored, number facets from another base, lose facets or show hidden ones. This only explains;
   the verdict depends on sigma alone. */
#include "host/kit/kit.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host/fail.h"

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
typedef struct image_convention {
    const char *text;
    int exchange, rows, columns; /* rows, columns: 1 if reversed */
    uint32_t add;                /* added to the truth's facet to get the submitted one */
} image_convention;

static const image_convention image_conventions[LRCS_HOST_IMAGE_CONVENTIONS] = {
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
   with rows and columns of the submitted image as in `convention`. If indices start at 1, 0 is
   none. */
static double images_agree(const items_image *truth, const items_image *answer,
                           const image_convention *convention)
{
    uint32_t last = truth->side - 1;
    uint64_t shown = 0;
    uint64_t same = 0;
    for (uint32_t row = 0; row < truth->side; row++) {
        for (uint32_t column = 0; column < truth->side; column++) {
            uint32_t y = convention->rows ? last - row : row;
            uint32_t x = convention->columns ? last - column : column;
            uint32_t a = item_at(truth, row, column);
            uint32_t b = convention->exchange ? item_at(answer, x, y) : item_at(answer, y, x);
            int none = b == LRCS_NONE || (convention->add > 0 && b == 0);
            int equal = a == LRCS_NONE ? none : b == a + convention->add;
            shown += a != LRCS_NONE || !equal;
            same += a != LRCS_NONE && equal;
        }
    }
    return shown > 0 ? (double)same / (double)shown : 1.0;
}

/* Reads an image if its file exists (*found). Status: as lrcs_host_judge. */
static int item_image_read(const char *path, uint32_t side, items_image *image, int *found,
                           lrcs_host_error *error)
{
    size_t size = 4 * (size_t)side * side;
    *image = (items_image){.side = side};
    *found = access(path, F_OK) == 0;
    if (!*found) {
        return LRCS_OK;
    }
    int status = lrcs_host_file_read(path, &image->file, error);
    if (status != LRCS_OK) {
        return status;
    }
    if (image->file.size != size) {
        status = lrcsi_host_fail(error, LRCS_E_SYNTAX,
                                 "%s: expected %lu x %lu pixels of 4 bytes, found %zu bytes", path,
                                 (unsigned long)side, (unsigned long)side, image->file.size);
        lrcs_host_file_free(&image->file);
        return status;
    }
    image->bytes = image->file.bytes;
    return LRCS_OK;
}

/* Judges an image: the convention in which it agrees with the truth; if it agrees in none, the
   facets that lose most pixels, with the number of the truth's pixels that show something else. */
static int image_judge(lrcs_host_judgement *job, const lrcs_host_kit_case *one,
                       const items_image *truth, const items_image *answer, lrcs_host_error *error)
{
    lrcs_host_kit_items *found = &job->by_item;
    const uint32_t facets = job->kit.scene[one->scene].host.scene.facet_count;
    double first = 0.0;
    double most = 0.0;
    size_t best = 0;
    for (size_t i = 0; i < LRCS_HOST_IMAGE_CONVENTIONS; i++) {
        double agree = images_agree(truth, answer, &image_conventions[i]);
        first = i == 0 ? agree : first;
        best = agree > most ? i : best;
        most = fmax(agree, most);
    }
    if (first >= AGREE || most >= AGREE) {
        found->convention_count[first >= AGREE ? 0 : best]++;
        return LRCS_OK;
    }
    if (found->images_differ++ >= LRCS_HOST_KIT_NAMED) {
        return LRCS_OK;
    }
    lrcs_host_kit_image *image = &found->image[found->named++];
    *image = (lrcs_host_kit_image){.kit_case = one, .agree_share = first};
    uint32_t *lost = calloc((size_t)facets + 1, sizeof *lost);
    if (!lost) {
        return lrcsi_host_out_of_memory(error);
    }
    for (uint32_t i = 0; i < truth->side * truth->side; i++) {
        uint32_t a = item_at(truth, i / truth->side, i % truth->side);
        uint32_t b = item_at(answer, i / truth->side, i % truth->side);
        lost[a < facets ? a : facets] += a != b;
    }
    for (uint32_t n = 0; n < LRCS_HOST_KIT_TOP; n++) {
        uint32_t worst = 0;
        for (uint32_t i = 1; i < facets; i++) {
            worst = lost[i] > lost[worst] ? i : worst;
        }
        image->facet[n] = worst;
        image->lost[n] = lost[worst];
        lost[worst] = 0;
    }
    free(lost);
    return LRCS_OK;
}

/* Judges the image of a case if there is one (*found). Status: as lrcs_host_judge. */
static int item_case_judge(lrcs_host_judgement *job, const char *folder,
                           const lrcs_host_kit_case *one, int *found, lrcs_host_error *error)
{
    char path[LRCSI_KIT_PATH];
    const char *name = job->kit.scene[one->scene].name;
    items_image truth = {.side = 0};
    items_image answer = {.side = 0};
    int expected = 0;
    *found = 0;
    int status = lrcsi_kit_path(path, error, "%s/%s.%s.item.u32", folder, name, one->attitude);
    status = status == LRCS_OK ? item_image_read(path, one->image, &answer, found, error) : status;
    if (status != LRCS_OK || !*found) {
        return status;
    }
    status = lrcsi_kit_path(path, error, "%s/truth/%s.%s.item.u32", job->kit.folder, name,
                            one->attitude);
    status =
        status == LRCS_OK ? item_image_read(path, one->image, &truth, &expected, error) : status;
    if (status == LRCS_OK && !expected) {
        status = lrcsi_host_fail(error, LRCS_E_SYSTEM, "%s: no such file", path);
    }
    status =
        status == LRCS_OK ? lrcsi_kit_scene(&job->kit, &job->kit.scene[one->scene], error) : status;
    if (status == LRCS_OK && truth.bytes && answer.bytes) {
        status = image_judge(job, one, &truth, &answer, error);
    }
    lrcs_host_file_free(&truth.file);
    lrcs_host_file_free(&answer.file);
    return status;
}

int lrcs_host_judge_items(lrcs_host_judgement *judgement, const char *folder,
                          lrcs_host_error *error)
{
    DIR *opened = opendir(folder);
    if (!opened) {
        return lrcsi_host_fail(error, LRCS_E_SYSTEM, "%s: cannot open folder: %s", folder,
                               strerror(errno));
    }
    closedir(opened);
    for (uint32_t i = 0; i < judgement->kit.cases; i++) {
        const lrcs_host_kit_case *one = &judgement->kit.list[i];
        if (one->image > 0 && lrcs_host_judge_asked(judgement, one)) {
            int found;
            int status = item_case_judge(judgement, folder, one, &found, error);
            if (status != LRCS_OK) {
                return status;
            }
            judgement->by_item.images_found += (uint32_t)found;
            judgement->by_item.images++;
        }
    }
    return LRCS_OK;
}

const char *lrcs_host_image_convention_text(int convention)
{
    return image_conventions[convention].text;
}
