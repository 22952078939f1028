/* SPDX-License-Identifier: MIT */
/* The kinds of bodies, their names, and which dimensions each must have. It does not decide how a
   body is divided into facets (tessellate.c does), nor what it reflects. */
#include <lrcs/shape.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/where.h"

enum dimension {
    USES_SIZE_X = 1 << 0,
    USES_SIZE_Y = 1 << 1,
    USES_SIZE_Z = 1 << 2,
    USES_RADIUS = 1 << 3,
    USES_RADIUS2 = 1 << 4,
    USES_LENGTH = 1 << 5,
    USES_HALF_ANGLE = 1 << 6
};

typedef struct shape_entry {
    const char *name;
    int uses; /* bits of enum dimension */
} shape_entry;

static const shape_entry shape_table[LRCS_SHAPE_KINDS] = {
    [LRCS_SHAPE_PLATE] = {"plate", USES_SIZE_X | USES_SIZE_Y},
    [LRCS_SHAPE_DISC] = {"disc", USES_RADIUS},
    [LRCS_SHAPE_BOX] = {"box", USES_SIZE_X | USES_SIZE_Y | USES_SIZE_Z},
    [LRCS_SHAPE_SPHERE] = {"sphere", USES_RADIUS},
    [LRCS_SHAPE_DOME] = {"dome", USES_RADIUS},
    [LRCS_SHAPE_CYLINDER] = {"cylinder", USES_RADIUS | USES_LENGTH},
    [LRCS_SHAPE_CONE] = {"cone", USES_RADIUS | USES_LENGTH | USES_HALF_ANGLE},
    [LRCS_SHAPE_FRUSTUM] = {"frustum", USES_RADIUS | USES_RADIUS2 | USES_LENGTH},
    [LRCS_SHAPE_PARABOLOID] = {"paraboloid", USES_RADIUS | USES_LENGTH},
};

static int shape_fault(lrcs_where *where, int status, const char *item, const char *expected,
                       const char *found)
{
    return lrcsi_where_text(where, status, 0, 0, item, expected, found, strlen(found));
}

/* One dimension: finite, 0 .. limit, and 0 if it is not used. */
static int shape_check_one(double value, int used, const char *item, double limit,
                           const char *expected, lrcs_where *where)
{
    if (!isfinite(value)) {
        return shape_fault(where, LRCS_E_NUMBER, item, expected, "a number that is not finite");
    }
    if (!used && value != 0.0) {
        return shape_fault(where, LRCS_E_ARGUMENT, item, "0: this kind has no such dimension",
                           "a number other than 0");
    }
    if (value < 0.0) {
        return shape_fault(where, LRCS_E_NUMBER, item, expected, "a negative number");
    }
    if (value > limit) {
        return shape_fault(where, LRCS_E_NUMBER, item, expected, "a larger number");
    }
    return LRCS_OK;
}

/* A cone's height is given by exactly one of two numbers. */
static int shape_check_cone(const lrcs_shape *shape, lrcs_where *where)
{
    if (shape->half_angle_deg > 0.0 && shape->length > 0.0) {
        return shape_fault(where, LRCS_E_ARGUMENT, "length",
                           "a half-angle or a length for a cone, not both", "both");
    }
    if (!(shape->half_angle_deg > 0.0) && !(shape->length > 0.0)) {
        return shape_fault(where, LRCS_E_ARGUMENT, "half_angle_deg",
                           "a half-angle or a length above 0 for a cone", "neither");
    }
    if (shape->half_angle_deg >= 90.0) {
        return shape_fault(where, LRCS_E_NUMBER, "half_angle_deg", "degrees above 0 and below 90",
                           "90 or more");
    }
    if (shape->half_angle_deg > 0.0 &&
        !(shape->radius / tan(shape->half_angle_deg * LRCS_RADIANS_PER_DEGREE) <=
          LRCSI_COORDINATE_MAX)) {
        return shape_fault(where, LRCS_E_NUMBER, "half_angle_deg", "a cone no longer than 1e100 m",
                           "a longer one");
    }
    return LRCS_OK;
}

const char *lrcs_shape_text(int kind)
{
    return kind >= 0 && kind < LRCS_SHAPE_KINDS ? shape_table[kind].name : NULL;
}

int lrcs_shape_find(const char *name)
{
    for (int kind = 0; name && kind < LRCS_SHAPE_KINDS; kind++) {
        if (strcmp(name, shape_table[kind].name) == 0) {
            return kind;
        }
    }
    return LRCS_E_NAME;
}

int lrcs_shape_check(const lrcs_shape *shape, lrcs_where *where)
{
    static const char metres[] = "metres, 0 .. 1e100";
    if (shape->kind < 0 || shape->kind >= LRCS_SHAPE_KINDS) {
        return shape_fault(where, LRCS_E_ARGUMENT, "kind", "a kind of shape", "no kind");
    }
    if (shape->parts != LRCS_SHAPE_ALL && shape->parts != LRCS_SHAPE_WALL) {
        return shape_fault(where, LRCS_E_ARGUMENT, "parts", "all or wall", "neither");
    }
    const struct {
        const char *item;
        double value;
        int bit;
    } length[] = {
        {"size, 1st number", shape->size[0], USES_SIZE_X},
        {"size, 2nd number", shape->size[1], USES_SIZE_Y},
        {"size, 3rd number", shape->size[2], USES_SIZE_Z},
        {"radius", shape->radius, USES_RADIUS},
        {"radius2", shape->radius2, USES_RADIUS2},
        {"length", shape->length, USES_LENGTH},
    };
    int uses = shape_table[shape->kind].uses;
    int status = LRCS_OK;
    for (size_t i = 0; status == LRCS_OK && i < sizeof length / sizeof length[0]; i++) {
        status = shape_check_one(length[i].value, uses & length[i].bit, length[i].item,
                                 LRCSI_COORDINATE_MAX, metres, where);
    }
    if (status == LRCS_OK) {
        status = shape_check_one(shape->half_angle_deg, uses & USES_HALF_ANGLE, "half_angle_deg",
                                 90.0, "degrees above 0 and below 90", where);
    }
    return status == LRCS_OK && shape->kind == LRCS_SHAPE_CONE ? shape_check_cone(shape, where)
                                                               : status;
}
