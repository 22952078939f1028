/* SPDX-License-Identifier: MIT */
/* A draft is a table of a scene file while it is read: its keys and values so far, checked against
   the schema, and error reports about them. recipe.c and recipe_part.c interpret a finished
   draft. */
#ifndef LRCSI_DRAFT_H
#define LRCSI_DRAFT_H

#include "scene/file/toml.h"

enum lrcsi_table {
    LRCSI_TABLE_TOP = 0,
    LRCSI_TABLE_PART,
    LRCSI_TABLE_JOINT, /* continues the draft of its part */
    LRCSI_TABLE_MATERIAL,
    LRCSI_TABLE_MAP,
    LRCSI_TABLES
};

/* The keys of all tables; a key that several tables have is listed once. */
enum lrcsi_key {
    LRCSI_KEY_NAME,
    LRCSI_KEY_MATERIAL,
    LRCSI_KEY_UNIT,
    LRCSI_KEY_SCHEMA,
    LRCSI_KEY_KEEP_TRANSPARENT,
    LRCSI_KEY_DEFAULT_MATERIAL,
    LRCSI_KEY_FILE,
    LRCSI_KEY_SHAPE,
    LRCSI_KEY_SIZE,
    LRCSI_KEY_RADIUS,
    LRCSI_KEY_RADIUS2,
    LRCSI_KEY_LENGTH,
    LRCSI_KEY_HALF_ANGLE_DEG,
    LRCSI_KEY_WALL_ONLY,
    LRCSI_KEY_TRANSLATE,
    LRCSI_KEY_ROTATE_EULER,
    LRCSI_KEY_ROTATE_AXIS,
    LRCSI_KEY_ROTATE_QUATERNION,
    LRCSI_KEY_ROTATE_DEG,
    LRCSI_KEY_SCALE,
    LRCSI_KEY_AXIS,
    LRCSI_KEY_ORIGIN,
    LRCSI_KEY_ANGLE_DEG,
    LRCSI_KEY_LIKE,
    LRCSI_KEY_A,
    LRCSI_KEY_B,
    LRCSI_KEY_S,
    LRCSI_KEY_M,
    LRCSI_KEY_A_ERROR,
    LRCSI_KEY_B_ERROR,
    LRCSI_KEY_S_ERROR,
    LRCSI_KEY_M_ERROR,
    LRCSI_KEY_CORRELATION,
    LRCSI_KEY_TWO_SIDED,
    LRCSI_KEY_ASSUMED,
    LRCSI_KEY_COLOUR,
    LRCSI_KEYS
};

/* The bit of a key in a set of keys. */
#define LRCSI_KEY_BIT(name) (UINT64_C(1) << LRCSI_KEY_##name)

typedef struct lrcsi_draft {
    const lrcsi_toml *toml;
    int table; /* lrcsi_table: the table of the next keys */
    int has_joint;
    lrcsi_toml_event header;
    lrcsi_toml_event value[LRCSI_KEYS]; /* kind LRCSI_TOML_NONE if not given */
} lrcsi_draft;

/* Begins the table at the top of the file. */
void lrcsi_draft_start(const lrcsi_toml *toml, lrcsi_draft *draft);

/* The table that a header opens (lrcsi_table), or LRCS_E_NAME. Given: the draft of the table before
   it, because a joint must follow its part. */
int lrcsi_draft_table(const lrcsi_draft *draft, const lrcsi_toml_event *header);

/* Begins a table; a joint continues the draft of its part. */
void lrcsi_draft_open(lrcsi_draft *draft, int table, const lrcsi_toml_event *header);

/* Adds a key. Status: LRCS_OK; LRCS_E_NAME (unknown, given twice); LRCS_E_ARGUMENT (type). */
int lrcsi_draft_add(lrcsi_draft *draft, const lrcsi_toml_event *event);

/* The value of a key, or NULL. */
const lrcsi_toml_event *lrcsi_draft_find(const lrcsi_draft *draft, int key);

/* A string's text, or NULL. */
const char *lrcsi_draft_text(const lrcsi_draft *draft, int key);

/* A number, or `fallback` if it is not given. */
double lrcsi_draft_number(const lrcsi_draft *draft, int key, double fallback);

/* Reports an error in the table as a whole, or in the value of a key that is given. Both return
   `status`. The fault of a table follows its name: "with both file and shape". */
int lrcsi_draft_refuse(const lrcsi_draft *draft, int status, const char *fault,
                       const char *expected);
int lrcsi_draft_refuse_value(const lrcsi_draft *draft, int key, int status, const char *expected);

/* Reports that keys are missing, by their bits: LRCS_E_NAME. */
int lrcsi_draft_refuse_missing(const lrcsi_draft *draft, uint64_t keys, const char *expected);

#endif
