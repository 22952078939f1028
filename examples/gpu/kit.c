/* SPDX-License-Identifier: MIT */
/* Reads the kit's tables and OBJ files. It does not check them, because lrcs vectors wrote them. */
#include "kit.h"

#include <stdlib.h>
#include <string.h>

#define LINE    2048
#define COLUMNS 32

/* A table being read: the names of its columns, and the fields of the current line. */
typedef struct table {
    FILE *file;
    char head[LINE], line[LINE];
    char *name[COLUMNS], *field[COLUMNS];
} table;

static void fail(const char *what, const char *name)
{
    fprintf(stderr, "lrcs_gl: %s: %s\n", name, what);
    exit(1);
}

static FILE *open_in(const char *folder, const char *name)
{
    char path[LINE];
    int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = length < LINE ? fopen(path, "r") : NULL;
    if (!file) {
        fail("cannot open", path);
    }
    return file;
}

static void *grown(void *block, int count, size_t size)
{
    block = realloc(block, (size_t)count * size);
    if (!block) {
        fail("out of memory", "kit");
    }
    return block;
}

/* Splits a line in place; what is missing is empty. */
static void split(char *line, char *field[COLUMNS])
{
    static char none[] = "";
    line[strcspn(line, "\r\n")] = '\0';
    for (int i = 0; i < COLUMNS; i++) {
        field[i] = line ? line : none;
        line = line ? strchr(line, ',') : NULL;
        if (line) {
            *line++ = '\0';
        }
    }
}

static int next_line(table *t)
{
    if (!fgets(t->line, sizeof t->line, t->file)) {
        fclose(t->file);
        return 0;
    }
    split(t->line, t->field);
    return 1;
}

static table open_table(const char *folder, const char *name)
{
    table t = {.file = open_in(folder, name)};
    if (!fgets(t.head, sizeof t.head, t.file)) {
        fail("empty", name);
    }
    return t;
}

static const char *text(const table *t, const char *column)
{
    for (int i = 0; i < COLUMNS; i++) {
        if (strcmp(t->name[i], column) == 0) {
            return t->field[i];
        }
    }
    fail("no such column", column);
    return NULL;
}

static double number(const table *t, const char *column)
{
    return strtod(text(t, column), NULL);
}

static void copy_name(char to[KIT_NAME], const char *from)
{
    snprintf(to, KIT_NAME, "%.*s", KIT_NAME - 1, from);
}

static void read_materials(kit *k)
{
    table t = open_table(k->folder, "materials.csv");
    split(t.head, t.name);
    while (k->materials < 64 && next_line(&t)) {
        kit_material *m = &k->material[k->materials++];
        copy_name(m->name, text(&t, "material"));
        m->A = number(&t, "A");
        m->B = number(&t, "B");
        m->s = number(&t, "s");
        m->m = number(&t, "m");
        m->two_sided = number(&t, "two_sided") != 0;
    }
}

static void read_cases(kit *k)
{
    static const char *const part[4] = {"qw", "qx", "qy", "qz"};
    table t = open_table(k->folder, "cases.csv");
    split(t.head, t.name);
    while (next_line(&t)) {
        k->cases = grown(k->cases, ++k->case_count, sizeof *k->cases);
        kit_case *c = &k->cases[k->case_count - 1];
        copy_name(c->scene, text(&t, "scene"));
        copy_name(c->attitude, text(&t, "attitude"));
        for (int i = 0; i < 4; i++) {
            c->quaternion[i] = number(&t, part[i]);
        }
        c->left = number(&t, "left_m");
        c->top = number(&t, "top_m");
        c->side = number(&t, "side_m");
    }
}

kit kit_read(const char *folder)
{
    kit k = {.folder = folder};
    read_materials(&k);
    read_cases(&k);
    return k;
}

static const kit_material *find_material(const kit *k, const char *name)
{
    for (int i = 0; i < k->materials; i++) {
        if (strcmp(k->material[i].name, name) == 0) {
            return &k->material[i];
        }
    }
    fail("no such material", name);
    return NULL;
}

void kit_scene(kit *k, const char *scene)
{
    char line[LINE];
    char name[KIT_NAME + 16];
    int corner[3];
    double v[3];
    double(*vertex)[3] = NULL;
    int vertices = 0;
    const kit_material *material = NULL;
    snprintf(name, sizeof name, "scenes/%s.obj", scene);
    FILE *file = open_in(k->folder, name);
    k->facets = 0;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]) == 3) {
            vertex = grown(vertex, ++vertices, sizeof *vertex);
            memcpy(vertex[vertices - 1], v, sizeof v);
        } else if (sscanf(line, "usemtl %63s", name) == 1) {
            material = find_material(k, name);
        } else if (sscanf(line, "f %d %d %d", &corner[0], &corner[1], &corner[2]) == 3) {
            k->facet = grown(k->facet, ++k->facets, sizeof *k->facet);
            for (int i = 0; i < 3; i++) {
                memcpy(k->facet[k->facets - 1].corner[i], vertex[corner[i] - 1], sizeof v);
            }
            k->facet[k->facets - 1].material = material;
        }
    }
    fclose(file);
    free(vertex);
    copy_name(k->scene, scene);
}
