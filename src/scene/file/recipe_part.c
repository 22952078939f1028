/* SPDX-License-Identifier: MIT */
/* Makes a part from a [[part]] of a scene file. Decides which keys a model and each kind of shape
   need, and how the keys of the placement are combined. */
#include <math.h>
#include <string.h>

#include "base/rotate.h"
#include "scene/file/recipe.h"
#include "scene/file/unit.h"

#define SHAPE_KEYS                                                                                 \
    (LRCSI_KEY_BIT(SIZE) | LRCSI_KEY_BIT(RADIUS) | LRCSI_KEY_BIT(RADIUS2) |                        \
     LRCSI_KEY_BIT(LENGTH) | LRCSI_KEY_BIT(HALF_ANGLE_DEG) | LRCSI_KEY_BIT(WALL_ONLY))

/* The required and the optional keys of each kind of shape. */
typedef struct shape_rule {
    uint64_t needs, allows;
    const char *expected;
} shape_rule;

static const shape_rule shape_rules[LRCS_SHAPE_KINDS] = {
    [LRCS_SHAPE_PLATE] = {LRCSI_KEY_BIT(SIZE), 0, "plate: size = [a, b]"},
    [LRCS_SHAPE_DISC] = {LRCSI_KEY_BIT(RADIUS), 0, "disc: radius"},
    [LRCS_SHAPE_BOX] = {LRCSI_KEY_BIT(SIZE), 0, "box: size = [a, b, c]"},
    [LRCS_SHAPE_SPHERE] = {LRCSI_KEY_BIT(RADIUS), 0, "sphere: radius"},
    [LRCS_SHAPE_DOME] = {LRCSI_KEY_BIT(RADIUS), LRCSI_KEY_BIT(WALL_ONLY),
                         "dome: radius, and perhaps wall_only"},
    [LRCS_SHAPE_CYLINDER] = {LRCSI_KEY_BIT(RADIUS) | LRCSI_KEY_BIT(LENGTH),
                             LRCSI_KEY_BIT(WALL_ONLY),
                             "cylinder: radius, length, and perhaps wall_only"},
    [LRCS_SHAPE_CONE] = {LRCSI_KEY_BIT(RADIUS),
                         LRCSI_KEY_BIT(LENGTH) | LRCSI_KEY_BIT(HALF_ANGLE_DEG) |
                             LRCSI_KEY_BIT(WALL_ONLY),
                         "cone: radius, either length or half_angle_deg, and perhaps wall_only"},
    [LRCS_SHAPE_FRUSTUM] = {LRCSI_KEY_BIT(RADIUS) | LRCSI_KEY_BIT(RADIUS2) | LRCSI_KEY_BIT(LENGTH),
                            LRCSI_KEY_BIT(WALL_ONLY),
                            "frustum: radius, radius2, length, and perhaps wall_only"},
    [LRCS_SHAPE_PARABOLOID] = {LRCSI_KEY_BIT(RADIUS) | LRCSI_KEY_BIT(LENGTH),
                               LRCSI_KEY_BIT(WALL_ONLY),
                               "paraboloid: radius, length, and perhaps wall_only"},
};

int lrcsi_recipe_unit(const lrcsi_draft *draft, double fallback, double *metres)
{
    const lrcsi_toml_event *unit = lrcsi_draft_find(draft, LRCSI_KEY_UNIT);
    *metres = fallback;
    if (!unit) {
        return LRCS_OK;
    }
    if (unit->type == LRCSI_TOML_STRING) {
        return lrcsi_unit_find(unit->text, metres) == LRCS_OK
                   ? LRCS_OK
                   : lrcsi_draft_refuse_value(draft, LRCSI_KEY_UNIT, LRCS_E_NAME,
                                              "\"mm\", \"cm\", \"m\", \"in\", \"ft\" or a number");
    }
    *metres = unit->number[0];
    return *metres > 0.0 ? LRCS_OK
                         : lrcsi_draft_refuse_value(draft, LRCSI_KEY_UNIT, LRCS_E_NUMBER,
                                                    "metres in a unit, above 0");
}

/* The bits of the shape keys that are given. */
static uint64_t given_shape_keys(const lrcsi_draft *draft)
{
    uint64_t given = 0;
    for (int key = 0; key < LRCSI_KEYS; key++) {
        if (lrcsi_draft_find(draft, key)) {
            given |= UINT64_C(1) << key;
        }
    }
    return given & SHAPE_KEYS;
}

/* Refuses the first shape key outside `allowed`. */
static int refuse_others(const lrcsi_draft *draft, uint64_t allowed, const char *expected)
{
    uint64_t excess = given_shape_keys(draft) & ~allowed;
    for (int key = 0; key < LRCSI_KEYS; key++) {
        if (excess >> key & 1u) {
            return lrcsi_draft_refuse_value(draft, key, LRCS_E_NAME, expected);
        }
    }
    return LRCS_OK;
}

/* Checks the dimensions of a shape. lrcs_shape_check names the one that is wrong; the draft knows
   where it is in the file. */
static int check_shape(const lrcsi_draft *draft, const lrcs_shape *shape)
{
    lrcs_where *where = draft->toml->where;
    int status = lrcs_shape_check(shape, where);
    if (status == LRCS_OK || !where) {
        return status;
    }
    for (int key = LRCSI_KEY_SIZE; key <= LRCSI_KEY_HALF_ANGLE_DEG; key++) {
        const lrcsi_toml_event *value = lrcsi_draft_find(draft, key);
        size_t size = value ? value->name[0].size : 0; /* "size" in "size, 2nd number" */
        if (value && strncmp(where->item, value->name[0].text, size) == 0 &&
            (where->item[size] == '\0' || where->item[size] == ',')) {
            return lrcsi_toml_refuse(draft->toml, status, value->line, value->value_raw,
                                     value->value_size, where->item, where->expected);
        }
    }
    where->line = draft->header.line;
    where->offset = (uint64_t)(draft->header.raw - draft->toml->start);
    return status;
}

/* Reads a shape: its kind, whether the keys are those of that kind, the dimensions. */
static int read_shape(const lrcsi_draft *draft, lrcs_shape *shape)
{
    int kind = lrcs_shape_find(lrcsi_draft_text(draft, LRCSI_KEY_SHAPE));
    if (kind < 0) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_SHAPE, LRCS_E_NAME,
                                        "plate, disc, box, sphere, dome, cylinder, cone, frustum "
                                        "or paraboloid");
    }
    const shape_rule *rule = &shape_rules[kind];
    const lrcsi_toml_event *wall = lrcsi_draft_find(draft, LRCSI_KEY_WALL_ONLY);
    const lrcsi_toml_event *size = lrcsi_draft_find(draft, LRCSI_KEY_SIZE);
    int status = refuse_others(draft, rule->needs | rule->allows, rule->expected);
    if (status != LRCS_OK) {
        return status;
    }
    if ((given_shape_keys(draft) & rule->needs) != rule->needs) {
        return lrcsi_draft_refuse_missing(draft, rule->needs & ~given_shape_keys(draft),
                                          rule->expected);
    }
    if (size && size->count != (kind == LRCS_SHAPE_BOX ? 3u : 2u)) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_SIZE, LRCS_E_ARGUMENT, rule->expected);
    }
    if (kind == LRCS_SHAPE_CONE && !lrcsi_draft_find(draft, LRCSI_KEY_LENGTH) ==
                                       !lrcsi_draft_find(draft, LRCSI_KEY_HALF_ANGLE_DEG)) {
        return lrcsi_draft_refuse(draft, LRCS_E_NAME,
                                  lrcsi_draft_find(draft, LRCSI_KEY_LENGTH)
                                      ? "with both length and half_angle_deg"
                                      : "without length or half_angle_deg",
                                  rule->expected);
    }
    shape->kind = kind;
    shape->parts = wall && wall->boolean ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
    for (uint32_t i = 0; size && i < size->count; i++) {
        shape->size[i] = size->number[i];
    }
    shape->radius = lrcsi_draft_number(draft, LRCSI_KEY_RADIUS, 0.0);
    shape->radius2 = lrcsi_draft_number(draft, LRCSI_KEY_RADIUS2, 0.0);
    shape->length = lrcsi_draft_number(draft, LRCSI_KEY_LENGTH, 0.0);
    shape->half_angle_deg = lrcsi_draft_number(draft, LRCSI_KEY_HALF_ANGLE_DEG, 0.0);
    return check_shape(draft, shape);
}

/* Reads what the part is: either a file or a shape. */
static int read_body(const lrcsi_draft *draft, lrcs_recipe_part *part)
{
    const char *file = lrcsi_draft_text(draft, LRCSI_KEY_FILE);
    const char *shape = lrcsi_draft_text(draft, LRCSI_KEY_SHAPE);
    if (!file == !shape) {
        return lrcsi_draft_refuse(draft, LRCS_E_NAME,
                                  file ? "with both file and shape" : "without file or shape",
                                  "either file = \"...\" or shape = \"...\"");
    }
    if (shape) {
        return read_shape(draft, &part->shape);
    }
    part->file = file;
    if (file[0] == '\0') {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_FILE, LRCS_E_NAME, "a file's name");
    }
    return refuse_others(draft, 0, "no such key beside file");
}

/* Reads the rotation, which is given in at most one of three ways. */
static int read_rotation(const lrcsi_draft *draft, double R[3][3])
{
    const char *sequence = lrcsi_draft_text(draft, LRCSI_KEY_ROTATE_EULER);
    const lrcsi_toml_event *axis = lrcsi_draft_find(draft, LRCSI_KEY_ROTATE_AXIS);
    const lrcsi_toml_event *q = lrcsi_draft_find(draft, LRCSI_KEY_ROTATE_QUATERNION);
    const lrcsi_toml_event *deg = lrcsi_draft_find(draft, LRCSI_KEY_ROTATE_DEG);
    if ((sequence != NULL) + (axis != NULL) + (q != NULL) > 1) {
        return lrcsi_draft_refuse(draft, LRCS_E_NAME, "with several rotations",
                                  "one of rotate_euler, rotate_axis, rotate_quaternion");
    }
    if (deg && !sequence && !axis) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_ROTATE_DEG, LRCS_E_NAME,
                                        q ? "no rotate_deg beside rotate_quaternion"
                                          : "rotate_euler or rotate_axis beside rotate_deg");
    }
    if (!deg && (sequence || axis)) {
        return lrcsi_draft_refuse_missing(draft, LRCSI_KEY_BIT(ROTATE_DEG),
                                          sequence ? "rotate_deg = [a, b, c] beside rotate_euler"
                                                   : "rotate_deg beside rotate_axis");
    }
    if (deg && deg->count != (sequence ? 3u : 1u)) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_ROTATE_DEG, LRCS_E_ARGUMENT,
                                        "a number, or three with rotate_euler");
    }
    if (deg && sequence && lrcsi_rotate_euler(sequence, deg->number, R) != LRCS_OK) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_ROTATE_EULER, LRCS_E_NAME,
                                        "three letters such as \"XYZ\" (intrinsic) or \"xyz\" "
                                        "(extrinsic), neighbours different");
    }
    if (deg && axis && lrcsi_rotate_axis(axis->number, deg->number[0], R) != LRCS_OK) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_ROTATE_AXIS, LRCS_E_NUMBER,
                                        "an axis that is not zero");
    }
    if (q && lrcsi_rotate_quaternion(q->number, R) != LRCS_OK) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_ROTATE_QUATERNION, LRCS_E_NUMBER,
                                        "a quaternion that is not zero");
    }
    return LRCS_OK;
}

/* Reads the scale, and multiplies it by the unit. */
static int read_scale(const lrcsi_draft *draft, double unit, double scale[3])
{
    const lrcsi_toml_event *given = lrcsi_draft_find(draft, LRCSI_KEY_SCALE);
    for (int i = 0; i < 3; i++) {
        double factor = given ? given->number[given->type == LRCSI_TOML_ARRAY ? i : 0] : 1.0;
        scale[i] = unit * factor;
        if (given && factor == 0.0) {
            return lrcsi_draft_refuse_value(draft, LRCSI_KEY_SCALE, LRCS_E_NUMBER,
                                            "a factor other than 0");
        }
        if (!isfinite(scale[i]) || scale[i] == 0.0) {
            return lrcsi_draft_refuse(draft, LRCS_E_NUMBER, "with a scale out of range",
                                      "unit times scale within the range of a double");
        }
    }
    return LRCS_OK;
}

static int read_joint(const lrcsi_draft *draft, lrcs_joint *joint)
{
    const lrcsi_toml_event *axis = lrcsi_draft_find(draft, LRCSI_KEY_AXIS);
    const lrcsi_toml_event *origin = lrcsi_draft_find(draft, LRCSI_KEY_ORIGIN);
    const lrcsi_toml_event *angle = lrcsi_draft_find(draft, LRCSI_KEY_ANGLE_DEG);
    if (!axis || !angle) {
        return lrcsi_draft_refuse_missing(
            draft, (axis ? 0 : LRCSI_KEY_BIT(AXIS)) | (angle ? 0 : LRCSI_KEY_BIT(ANGLE_DEG)),
            "axis and angle_deg in [part.joint]");
    }
    if (axis->number[0] == 0.0 && axis->number[1] == 0.0 && axis->number[2] == 0.0) {
        return lrcsi_draft_refuse_value(draft, LRCSI_KEY_AXIS, LRCS_E_NUMBER,
                                        "an axis that is not zero");
    }
    joint->used = 1;
    memcpy(joint->axis, axis->number, sizeof joint->axis);
    if (origin) {
        memcpy(joint->origin, origin->number, sizeof joint->origin);
    }
    joint->angle_deg = angle->number[0];
    return LRCS_OK;
}

static int read_place(const lrcsi_draft *draft, double unit, lrcs_recipe_part *part)
{
    const lrcsi_toml_event *translate = lrcsi_draft_find(draft, LRCSI_KEY_TRANSLATE);
    part->place = lrcs_place_default();
    int status = lrcsi_recipe_unit(draft, part->file ? unit : 0.0, &unit);
    part->unit_m = part->file ? unit : 0.0;
    unit = unit > 0.0 ? unit : 1.0;
    if (status == LRCS_OK) {
        status = read_scale(draft, unit, part->place.scale);
    }
    if (status == LRCS_OK) {
        status = read_rotation(draft, part->place.rotate);
    }
    if (translate) {
        memcpy(part->place.translate, translate->number, sizeof part->place.translate);
    }
    return status;
}

int lrcsi_recipe_part(const lrcsi_draft *draft, double unit, lrcs_recipe_part *part)
{
    const lrcsi_toml_event *material = lrcsi_draft_find(draft, LRCSI_KEY_MATERIAL);
    memset(part, 0, sizeof *part);
    part->name = lrcsi_draft_text(draft, LRCSI_KEY_NAME);
    part->file = NULL;
    part->line = draft->header.line;
    part->material_index = -1;
    part->material = material ? material->text : NULL;
    part->material_line = material ? material->line : 0;
    if (!part->name || part->name[0] == '\0') {
        return part->name
                   ? lrcsi_draft_refuse_value(draft, LRCSI_KEY_NAME, LRCS_E_NAME,
                                              "a name that is not empty")
                   : lrcsi_draft_refuse_missing(draft, LRCSI_KEY_BIT(NAME), "name = \"...\"");
    }
    int status = read_body(draft, part);
    if (status == LRCS_OK) {
        status = read_place(draft, unit, part);
    }
    return status == LRCS_OK && draft->has_joint ? read_joint(draft, &part->joint) : status;
}
