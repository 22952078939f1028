/* SPDX-License-Identifier: MIT */
/* The schema of scene files, as a list of keys, and drafts, which are checked against it. Decides
   which keys each table may have, and their types. */
#include "scene/file/draft.h"

#include <string.h>

#include "base/where.h"

/* A key of a table: the types that its value may have, and for an array the smallest
   and the largest number of elements. */
typedef struct schema_row {
    int table, key, types;
    uint32_t min_count, max_count;
    const char *name, *expected;
} schema_row;

/* The most bytes of a table's name that are quoted, so that there is room for what is wrong. */
#define NAME_EXCERPT 24u

#define TEXT         LRCSI_TOML_STRING, 0, 0
#define NUMBER       LRCSI_TOML_NUMBER, 0, 0
#define BOOLEAN      LRCSI_TOML_BOOLEAN, 0, 0
#define VECTOR       LRCSI_TOML_ARRAY, 3, 3
#define IS_TEXT      "a string"
#define IS_NUMBER    "a number"
#define IS_BOOLEAN   "true or false"
#define IS_VECTOR    "three numbers, [x, y, z]"
#define NUMBER_OR(t) (LRCSI_TOML_NUMBER | (t))

static const schema_row schema[] = {
    {LRCSI_TABLE_TOP, LRCSI_KEY_SCHEMA, NUMBER, "schema", IS_NUMBER},
    {LRCSI_TABLE_TOP, LRCSI_KEY_NAME, TEXT, "name", IS_TEXT},
    {LRCSI_TABLE_TOP, LRCSI_KEY_UNIT, NUMBER_OR(LRCSI_TOML_STRING), 0, 0, "unit",
     "\"mm\", \"cm\", \"m\", \"in\", \"ft\" or a number"},
    {LRCSI_TABLE_TOP, LRCSI_KEY_KEEP_TRANSPARENT, BOOLEAN, "keep_transparent", IS_BOOLEAN},
    {LRCSI_TABLE_TOP, LRCSI_KEY_DEFAULT_MATERIAL, TEXT, "default_material", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_NAME, TEXT, "name", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_MATERIAL, TEXT, "material", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_UNIT, NUMBER_OR(LRCSI_TOML_STRING), 0, 0, "unit",
     "\"mm\", \"cm\", \"m\", \"in\", \"ft\" or a number"},
    {LRCSI_TABLE_PART, LRCSI_KEY_FILE, TEXT, "file", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_SHAPE, TEXT, "shape", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_SIZE, LRCSI_TOML_ARRAY, 2, 3, "size", "two or three numbers"},
    {LRCSI_TABLE_PART, LRCSI_KEY_RADIUS, NUMBER, "radius", IS_NUMBER},
    {LRCSI_TABLE_PART, LRCSI_KEY_RADIUS2, NUMBER, "radius2", IS_NUMBER},
    {LRCSI_TABLE_PART, LRCSI_KEY_LENGTH, NUMBER, "length", IS_NUMBER},
    {LRCSI_TABLE_PART, LRCSI_KEY_HALF_ANGLE_DEG, NUMBER, "half_angle_deg", IS_NUMBER},
    {LRCSI_TABLE_PART, LRCSI_KEY_WALL_ONLY, BOOLEAN, "wall_only", IS_BOOLEAN},
    {LRCSI_TABLE_PART, LRCSI_KEY_TRANSLATE, VECTOR, "translate", IS_VECTOR},
    {LRCSI_TABLE_PART, LRCSI_KEY_ROTATE_EULER, TEXT, "rotate_euler", IS_TEXT},
    {LRCSI_TABLE_PART, LRCSI_KEY_ROTATE_AXIS, VECTOR, "rotate_axis", IS_VECTOR},
    {LRCSI_TABLE_PART, LRCSI_KEY_ROTATE_QUATERNION, LRCSI_TOML_ARRAY, 4, 4, "rotate_quaternion",
     "four numbers, [w, x, y, z]"},
    {LRCSI_TABLE_PART, LRCSI_KEY_ROTATE_DEG, NUMBER_OR(LRCSI_TOML_ARRAY), 3, 3, "rotate_deg",
     "a number, or three with rotate_euler"},
    {LRCSI_TABLE_PART, LRCSI_KEY_SCALE, NUMBER_OR(LRCSI_TOML_ARRAY), 3, 3, "scale",
     "a number or three"},
    {LRCSI_TABLE_JOINT, LRCSI_KEY_AXIS, VECTOR, "axis", IS_VECTOR},
    {LRCSI_TABLE_JOINT, LRCSI_KEY_ORIGIN, VECTOR, "origin", IS_VECTOR},
    {LRCSI_TABLE_JOINT, LRCSI_KEY_ANGLE_DEG, NUMBER, "angle_deg", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_NAME, TEXT, "name", IS_TEXT},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_LIKE, TEXT, "like", IS_TEXT},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_A, NUMBER, "A", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_B, NUMBER, "B", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_S, NUMBER, "s", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_M, NUMBER, "m", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_A_ERROR, NUMBER, "A_error", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_B_ERROR, NUMBER, "B_error", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_S_ERROR, NUMBER, "s_error", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_M_ERROR, NUMBER, "m_error", IS_NUMBER},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_CORRELATION, LRCSI_TOML_ARRAY, 6, 6, "correlation",
     "six numbers, [AB, As, Am, Bs, Bm, sm]"},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_TWO_SIDED, BOOLEAN, "two_sided", IS_BOOLEAN},
    {LRCSI_TABLE_MATERIAL, LRCSI_KEY_ASSUMED, BOOLEAN, "assumed", IS_BOOLEAN},
    {LRCSI_TABLE_MAP, LRCSI_KEY_NAME, TEXT, "name", IS_TEXT},
    {LRCSI_TABLE_MAP, LRCSI_KEY_COLOUR, TEXT, "colour", IS_TEXT},
    {LRCSI_TABLE_MAP, LRCSI_KEY_MATERIAL, TEXT, "material", IS_TEXT},
};

static const char *const table_header[LRCSI_TABLES] = {"top of the file", "[[part]]",
                                                       "[part.joint]", "[[material]]", "[[map]]"};
static const char part_keys[] =
    "one of name, file, shape, size, radius, radius2, length, half_angle_deg, wall_only, unit, "
    "scale, rotate_euler, rotate_axis, rotate_quaternion, rotate_deg, translate, material";
static const char *const table_keys[LRCSI_TABLES] = {
    "one of schema, name, unit, keep_transparent, default_material",
    part_keys,
    "one of axis, origin, angle_deg",
    "one of name, like, A, B, s, m, A_error, B_error, s_error, m_error, correlation, two_sided, "
    "assumed",
    "one of name, colour, material",
};

void lrcsi_draft_start(const lrcsi_toml *toml, lrcsi_draft *draft)
{
    memset(draft, 0, sizeof *draft);
    draft->toml = toml;
    draft->header.line = 1;
    draft->header.raw = toml->start;
}

int lrcsi_draft_table(const lrcsi_draft *draft, const lrcsi_toml_event *header)
{
    static const char expected[] = "[[part]], [part.joint], [[material]] or [[map]]";
    const char *why = expected;
    int element = header->kind == LRCSI_TOML_ELEMENT;
    if (header->name_count == 1 && element) {
        if (lrcsi_toml_name_is(&header->name[0], "part")) {
            return LRCSI_TABLE_PART;
        }
        if (lrcsi_toml_name_is(&header->name[0], "material")) {
            return LRCSI_TABLE_MATERIAL;
        }
        if (lrcsi_toml_name_is(&header->name[0], "map")) {
            return LRCSI_TABLE_MAP;
        }
    }
    if (header->name_count == 2 && !element && lrcsi_toml_name_is(&header->name[0], "part") &&
        lrcsi_toml_name_is(&header->name[1], "joint")) {
        if (draft->table == LRCSI_TABLE_PART) {
            return LRCSI_TABLE_JOINT;
        }
        why = "one joint at most, directly after its [[part]]";
    }
    return lrcsi_toml_refuse(draft->toml, LRCS_E_NAME, header->line, header->raw, header->raw_size,
                             "table header", why);
}

void lrcsi_draft_open(lrcsi_draft *draft, int table, const lrcsi_toml_event *header)
{
    draft->table = table;
    if (table == LRCSI_TABLE_JOINT) {
        draft->has_joint = 1;
        return;
    }
    draft->has_joint = 0;
    draft->header = *header;
    memset(draft->value, 0, sizeof draft->value);
}

static int type_fits(const schema_row *row, const lrcsi_toml_event *event)
{
    return (row->types & event->type) != 0 &&
           (event->type != LRCSI_TOML_ARRAY ||
            (event->count >= row->min_count && event->count <= row->max_count));
}

int lrcsi_draft_add(lrcsi_draft *draft, const lrcsi_toml_event *event)
{
    for (size_t i = 0; i < sizeof schema / sizeof schema[0]; i++) {
        const schema_row *row = &schema[i];
        if (row->table != draft->table || !lrcsi_toml_name_is(&event->name[0], row->name)) {
            continue;
        }
        if (draft->value[row->key].kind != LRCSI_TOML_NONE) {
            return lrcsi_toml_refuse(draft->toml, LRCS_E_NAME, event->line, event->raw,
                                     event->raw_size, table_header[draft->table],
                                     "each key once in a table");
        }
        if (!type_fits(row, event)) {
            return lrcsi_toml_refuse(draft->toml, LRCS_E_ARGUMENT, event->line, event->value_raw,
                                     event->value_size, row->name, row->expected);
        }
        draft->value[row->key] = *event;
        return LRCS_OK;
    }
    return lrcsi_toml_refuse(draft->toml, LRCS_E_NAME, event->line, event->raw, event->raw_size,
                             table_header[draft->table], table_keys[draft->table]);
}

const lrcsi_toml_event *lrcsi_draft_find(const lrcsi_draft *draft, int key)
{
    return draft->value[key].kind != LRCSI_TOML_NONE ? &draft->value[key] : NULL;
}

const char *lrcsi_draft_text(const lrcsi_draft *draft, int key)
{
    return draft->value[key].text;
}

double lrcsi_draft_number(const lrcsi_draft *draft, int key, double fallback)
{
    const lrcsi_toml_event *event = lrcsi_draft_find(draft, key);
    return event ? event->number[0] : fallback;
}

/* The name of a key in a scene file. */
static const char *key_name(int key)
{
    const char *name = "value";
    for (size_t i = 0; i < sizeof schema / sizeof schema[0]; i++) {
        if (schema[i].key == key) {
            name = schema[i].name;
        }
    }
    return name;
}

int lrcsi_draft_refuse(const lrcsi_draft *draft, int status, const char *fault,
                       const char *expected)
{
    const lrcsi_toml_event *name = lrcsi_draft_find(draft, LRCSI_KEY_NAME);
    int table = draft->table == LRCSI_TABLE_JOINT ? LRCSI_TABLE_PART : draft->table;
    const char *found = name ? name->value_raw : draft->header.raw;
    size_t size = name ? name->value_size : draft->header.raw_size;
    lrcsi_where_text(draft->toml->where, status, (uint64_t)(draft->header.raw - draft->toml->start),
                     draft->header.line, table_header[table], expected, found,
                     size < NAME_EXCERPT ? size : NAME_EXCERPT);
    lrcsi_where_add(draft->toml->where, size > NAME_EXCERPT ? ".. " : " ");
    lrcsi_where_add(draft->toml->where, fault);
    return status;
}

int lrcsi_draft_refuse_missing(const lrcsi_draft *draft, uint64_t keys, const char *expected)
{
    const char *before = " ";
    int status = lrcsi_draft_refuse(draft, LRCS_E_NAME, "without", expected);
    for (int key = 0; key < LRCSI_KEYS; key++) {
        if (keys >> key & 1u) {
            lrcsi_where_add(draft->toml->where, before);
            lrcsi_where_add(draft->toml->where, key_name(key));
            before = ", ";
        }
    }
    return status;
}

int lrcsi_draft_refuse_value(const lrcsi_draft *draft, int key, int status, const char *expected)
{
    const lrcsi_toml_event *event = &draft->value[key];
    return lrcsi_toml_refuse(draft->toml, status, event->line, event->value_raw, event->value_size,
                             key_name(key), expected);
}
