/* SPDX-License-Identifier: MIT */
/* Scene files: what each key means, what is refused and where, and that no bytes cause a fault. */
#include <lrcs/scene.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

#define ROWS(table) (sizeof table / sizeof table[0])

/* Every table and nearly every key. */
static const char rich[] = "# a rich scene\n"
                           "schema = 1\n"
                           "name = \"rich \\u00e9\"\n"
                           "unit = \"mm\"\n"
                           "keep_transparent = true\n"
                           "default_material = \"paint-black\"\n"
                           "[[part]]\n"
                           "name = 'model'\n"
                           "file = \"a b.3ds\"\n"
                           "scale = [1, -2, 3_0.0e-1]\n"
                           "rotate_euler = \"ZYX\"\n"
                           "rotate_deg = [90, 0,\n 0] # a quarter turn\n"
                           "translate = [1, 2, 3]\n"
                           "material = \"own\"\n"
                           "[part.joint]\n"
                           "axis = [1, 0, 0]\n"
                           "origin = [0, 4, 5]\n"
                           "angle_deg = 30\n"
                           "[[part]]\n"
                           "name = \"cone\"\n"
                           "shape = \"cone\"\n"
                           "radius = 0.5\n"
                           "half_angle_deg = 15\n"
                           "wall_only = true\n"
                           "unit = \"in\"\n"
                           "rotate_axis = [0, 0, 2]\n"
                           "rotate_deg = 180\n"
                           "material = \"mli-gold\"\n"
                           "[[part]]\n"
                           "name = \"third\"\n"
                           "file = 'c.stl'\n"
                           "unit = 2.5\n"
                           "rotate_quaternion = [0, 1, 0, 0]\n"
                           "[[material]]\n"
                           "name = \"own\"\n"
                           "A = 1\nB = 0.25\ns = 0.2\nm = 0.5\n"
                           "two_sided = true\n"
                           "[[material]]\n"
                           "name = \"mli-silver\"\n"
                           "like = \"solar-cell\"\n"
                           "[[map]]\n"
                           "name = \"PANEL\"\n"
                           "material = \"mli-silver\"\n"
                           "[[map]]\n"
                           "colour = \"#1f2A6b\"\n"
                           "material = \"own\"";

/* Reads a text from a block of exactly its size, in a work area of exactly the size that is
   stated. */
static int read_text(const char *text, size_t size, void **area, lrcs_recipe *recipe,
                     lrcs_where *where)
{
    char *copy = malloc(size + (size == 0));
    size_t need = lrcs_recipe_need(size);
    *area = malloc(need);
    assert_non_null(copy);
    assert_non_null(*area);
    memcpy(copy, text, size);
    lrcs_work work = lrcs_work_make(*area, need);
    int status = lrcs_recipe_read(copy, size, &work, recipe, where);
    assert_true(status != LRCS_E_MEMORY);
    assert_true(status == LRCS_OK || work.used == 0);
    free(copy); /* the recipe must not refer to it */
    return status;
}

/* Reads text that must be refused, untouched; the message in *where. */
static int refuse_text(const char *text, lrcs_where *where)
{
    void *area;
    lrcs_recipe recipe;
    lrcs_recipe before;
    memset(&recipe, 0x5a, sizeof recipe);
    memcpy(&before, &recipe, sizeof recipe);
    memset(where, 0, sizeof *where);
    int status = read_text(text, strlen(text), &area, &recipe, where);
    assert_memory_equal(&recipe, &before, sizeof recipe);
    assert_true(status < 0);
    assert_non_null(where->item);
    assert_non_null(where->expected);
    assert_true(where->offset <= strlen(text));
    free(area);
    return status;
}

static void a_rich_file_comes_to_its_recipe(void **state)
{
    (void)state;
    void *area;
    lrcs_recipe r;
    assert_int_equal(read_text(rich, sizeof rich - 1, &area, &r, NULL), LRCS_OK);
    assert_string_equal(r.name, "rich \xc3\xa9");
    assert_int_equal(r.keep_transparent, 1);
    assert_int_equal(r.part_count, 3);
    assert_int_equal(r.material_count, 2);
    assert_int_equal(r.binding_count, 3);
    const lrcs_recipe_part *model = &r.part[0];
    assert_string_equal(model->file, "a b.3ds");
    check_same(model->place.scale[0], 1e-3);
    check_same(model->place.scale[1], -2e-3);
    check_same(model->place.scale[2], 3e-3);
    check_same(model->place.rotate[1][0], 1.0);
    check_same(model->place.rotate[0][1], -1.0);
    check_same(model->place.translate[2], 3.0);
    assert_int_equal(model->material_index, 0);
    assert_int_equal(model->line, 7);
    assert_int_equal(model->material_line, 15);
    assert_int_equal(model->joint.used, 1);
    check_same(model->joint.origin[2], 5.0);
    check_same(model->joint.angle_deg, 30.0);
    const lrcs_recipe_part *cone = &r.part[1];
    assert_null(cone->file);
    assert_int_equal(cone->shape.kind, LRCS_SHAPE_CONE);
    assert_int_equal(cone->shape.parts, LRCS_SHAPE_WALL);
    check_same(cone->shape.radius, 0.5);
    check_same(cone->shape.half_angle_deg, 15.0);
    check_same(cone->place.scale[1], 0.0254);
    check_same(cone->place.rotate[0][0], -1.0);
    check_same(cone->place.rotate[2][2], 1.0);
    assert_int_equal(cone->material_index, -1);
    assert_string_equal(cone->material, "mli-gold");
    assert_int_equal(cone->joint.used, 0);
    check_same(r.part[2].place.scale[2], 2.5);
    check_same(r.part[2].place.rotate[1][1], -1.0);
    assert_null(r.part[2].material);
    free(area);
}

static void maps_and_materials_resolve_to_numbers(void **state)
{
    (void)state;
    void *area;
    lrcs_recipe r;
    assert_int_equal(read_text(rich, sizeof rich - 1, &area, &r, NULL), LRCS_OK);
    check_same(r.material[0].brdf.B, 0.25);
    assert_int_equal(r.material[0].two_sided, 1);
    assert_int_equal(r.material[1].two_sided, -1);
    check_same(r.material[1].brdf.A, lrcs_brdf_find("solar-cell")->brdf.A);
    assert_int_equal(r.binding[0].kind, LRCS_BIND_DEFAULT);
    check_same(r.binding[0].brdf.B, lrcs_brdf_find("paint-black")->brdf.B);
    assert_int_equal(r.binding[1].kind, LRCS_BIND_MAP_NAME);
    assert_string_equal(r.binding[1].name, "PANEL");
    check_same(r.binding[1].brdf.A, lrcs_brdf_find("solar-cell")->brdf.A); /* shadows the library */
    assert_int_equal(r.binding[2].kind, LRCS_BIND_MAP_COLOUR);
    assert_int_equal(r.binding[2].rgb[0], 0x1f);
    assert_int_equal(r.binding[2].rgb[1], 0x2a);
    assert_int_equal(r.binding[2].rgb[2], 0x6b);
    assert_int_equal(r.binding[2].two_sided, 1);
    free(area);
}

/* A part that is complete but for its last line, which the case adds. */
#define BOX   "[[part]]\nname = \"a\"\nshape = \"box\"\nsize = [1, 2, 3]\n"
#define OWN   "[[material]]\nname = \"w\"\nA=1\nB=1\ns=1\nm=1\n"
#define DISC  "[[part]]\nname = \"b\"\nshape = \"disc\"\nradius = 1\n"
#define MODEL "[[part]]\nname = \"m\"\nfile = \"m.obj\"\n"
#define WHITE "[[material]]\nname = \"w\"\nA = 0\nB = 0.1\ns = 0\nm = 1\n"

typedef struct refusal {
    const char *text;
    int status;
    unsigned line;
} refusal;

static const refusal refusals[] = {
    {"", LRCS_E_EMPTY, 1},
    {"# nothing\n", LRCS_E_EMPTY, 2},
    {WHITE, LRCS_E_EMPTY, 7},
    {"schema = 2\n" BOX, LRCS_E_UNSUPPORTED, 1},
    {"schema = \"1\"\n" BOX, LRCS_E_ARGUMENT, 1},
    {"name = 1\n" BOX, LRCS_E_ARGUMENT, 1},
    {"name = \"a\"\nname = \"b\"\n" BOX, LRCS_E_NAME, 2},
    {"unit = \"km\"\n" BOX, LRCS_E_NAME, 1},
    {"unit = 0\n" BOX, LRCS_E_NUMBER, 1},
    {"unit = -1\n" BOX, LRCS_E_NUMBER, 1},
    {"keep_transparent = 1\n" BOX, LRCS_E_ARGUMENT, 1},
    {"default_material = \"none such\"\n" BOX, LRCS_E_NAME, 1},
    {"colour = \"#123456\"\n" BOX, LRCS_E_NAME, 1},
    {"[part]\nname = \"a\"\n", LRCS_E_NAME, 1},
    {"[[parts]]\n", LRCS_E_NAME, 1},
    {"[[part.joint]]\n", LRCS_E_NAME, 1},
    {"[part.joint]\n", LRCS_E_NAME, 1},
    {BOX "[part.joint]\naxis=[1,0,0]\nangle_deg=1\n[part.joint]\n", LRCS_E_NAME, 8},
    {BOX WHITE "[part.joint]\n", LRCS_E_NAME, 11},
    {BOX "[part.joint]\naxis = [1, 0, 0]\n", LRCS_E_NAME, 1},
    {BOX "[part.joint]\nangle_deg = 1\n", LRCS_E_NAME, 1},
    {BOX "[part.joint]\naxis = [0, 0, 0]\nangle_deg = 1\n", LRCS_E_NUMBER, 6},
    {BOX "[part.joint]\nname = \"j\"\n", LRCS_E_NAME, 6},
    {BOX BOX, LRCS_E_NAME, 5},
    /* the item that is wrong, half_angle_deg, has no line */
    {WHITE "[[part]]\nname = \"c\"\nshape = \"cone\"\nradius = 1\nlength = 0\n", LRCS_E_ARGUMENT,
     7},
    {BOX "colour = \"#123456\"\n", LRCS_E_NAME, 5},
    {BOX "Size = [1, 2, 3]\n", LRCS_E_NAME, 5},
    {BOX "file = \"x.3ds\"\n", LRCS_E_NAME, 1},
    {BOX "radius = 1\n", LRCS_E_NAME, 5},
    {BOX "wall_only = true\n", LRCS_E_NAME, 5},
    {BOX "material = \"none such\"\n", LRCS_E_NAME, 5},
    {BOX "material = 7\n", LRCS_E_ARGUMENT, 5},
    {BOX "translate = [1, 2]\n", LRCS_E_ARGUMENT, 5},
    {BOX "translate = 1\n", LRCS_E_ARGUMENT, 5},
    {BOX "translate = [1, 2, inf]\n", LRCS_E_NUMBER, 5},
    {BOX "translate = [1, 2, 1e999]\n", LRCS_E_NUMBER, 5},
    {BOX "scale = 0\n", LRCS_E_NUMBER, 5},
    {BOX "scale = [1, 0, 1]\n", LRCS_E_NUMBER, 5},
    {BOX "scale = [1, 1]\n", LRCS_E_ARGUMENT, 5},
    {BOX "scale = 1e-320\nunit = \"mm\"\nscale = 1\n", LRCS_E_NAME, 7},
    {BOX "scale = 1e-323\nunit = \"mm\"\n", LRCS_E_NUMBER, 1},
    {BOX "scale = 1e300\nunit = 1e300\n", LRCS_E_NUMBER, 1},
    {BOX "rotate_euler = \"XXY\"\nrotate_deg = [1, 2, 3]\n", LRCS_E_NAME, 5},
    {BOX "rotate_euler = \"XYZ\"\nrotate_deg = 1\n", LRCS_E_ARGUMENT, 6},
    {BOX "rotate_euler = \"XYZ\"\n", LRCS_E_NAME, 1},
    {BOX "rotate_deg = 1\n", LRCS_E_NAME, 5},
    {BOX "rotate_axis = [1, 2, 3]\n", LRCS_E_NAME, 1},
    {BOX "rotate_axis = [0, 0, 0]\nrotate_deg = 1\n", LRCS_E_NUMBER, 5},
    {BOX "rotate_axis = [1, 0, 0]\nrotate_deg = [1, 2, 3]\n", LRCS_E_ARGUMENT, 6},
    {BOX "rotate_quaternion = [0, 0, 0, 0]\n", LRCS_E_NUMBER, 5},
    {BOX "rotate_quaternion = [1, 0, 0]\n", LRCS_E_ARGUMENT, 5},
    {BOX "rotate_quaternion = [1, 0, 0, 0]\nrotate_deg = 1\n", LRCS_E_NAME, 6},
    {BOX "rotate_quaternion = [1, 0, 0, 0]\nrotate_axis = [1, 0, 0]\n", LRCS_E_NAME, 1},
    {"[[part]]\nshape = \"disc\"\nradius = 1\n", LRCS_E_NAME, 1},
    {"[[part]]\nname = \"\"\nshape = \"disc\"\nradius = 1\n", LRCS_E_NAME, 2},
    {"[[part]]\nname = \"a\"\n", LRCS_E_NAME, 1},
    {"[[part]]\nname = \"a\"\nfile = \"\"\n", LRCS_E_NAME, 3},
    {"[[part]]\nname = \"a\"\nshape = \"cube\"\n", LRCS_E_NAME, 3},
    {"[[part]]\nname = \"a\"\nshape = \"disc\"\n", LRCS_E_NAME, 1},
    {"[[part]]\nname = \"a\"\nshape = \"plate\"\nsize = [1, 2, 3]\n", LRCS_E_ARGUMENT, 4},
    {"[[part]]\nname = \"a\"\nshape = \"box\"\nsize = [1, 2]\n", LRCS_E_ARGUMENT, 4},
    {"[[part]]\nname = \"a\"\nshape = \"disc\"\nradius = -1\n", LRCS_E_NUMBER, 4},
    {"[[part]]\nname = \"a\"\nshape = \"cone\"\nradius = 1\n", LRCS_E_NAME, 1},
    {"[[part]]\nname = \"a\"\nshape = \"cone\"\nradius = 1\nlength = 1\nhalf_angle_deg = 9\n",
     LRCS_E_NAME, 1},
    {"[[part]]\nname = \"a\"\nshape = \"cylinder\"\nradius = 1\nlength = -1\n", LRCS_E_NUMBER, 5},
    {"[[part]]\nname = \"a\"\nshape = \"frustum\"\nradius = 1\nradius2 = -1\nlength = 1\n",
     LRCS_E_NUMBER, 5},
    {MODEL "radius = 1\n", LRCS_E_NAME, 4},
    {MODEL "size = [1, 2]\n", LRCS_E_NAME, 4},
    {DISC "[[material]]\nA = 0\nB = 0.1\ns = 0\nm = 1\n", LRCS_E_NAME, 5},
    {DISC WHITE WHITE, LRCS_E_NAME, 11},
    {DISC WHITE "like = \"solar-cell\"\n", LRCS_E_NAME, 5},
    {DISC "[[material]]\nname = \"w\"\nA = 0\nB = 0.1\ns = 0\n", LRCS_E_NAME, 5},
    {DISC "[[material]]\nname = \"\"\nlike = \"solar-cell\"\n", LRCS_E_NAME, 6},
    {DISC "[[material]]\nname = \"w\"\nlike = \"none such\"\n", LRCS_E_NAME, 7},
    {DISC "[[material]]\nname = \"w\"\nA = -1\nB = 0.1\ns = 0.1\nm = 1\n", LRCS_E_NUMBER, 7},
    {DISC "[[material]]\nname = \"w\"\nA = 1\nB = 0.1\ns = 0\nm = 1\n", LRCS_E_NUMBER, 9},
    {DISC "[[material]]\nname = \"w\"\nA = 1\nB = nan\ns = 0\nm = 1\n", LRCS_E_NUMBER, 8},
    {DISC "[[material]]\nname = \"w\"\nA = \"1\"\n", LRCS_E_ARGUMENT, 7},
    {DISC "[[material]]\nname = \"w\"\nS = 1\n", LRCS_E_NAME, 7},
    {DISC OWN "A_error = -1\n", LRCS_E_NUMBER, 11},
    {DISC OWN "m_error = nan\n", LRCS_E_NUMBER, 11},
    {DISC OWN "B_error = inf\n", LRCS_E_NUMBER, 11},
    {DISC OWN "correlation = [0, 0, 2, 0, 0, 0]\n", LRCS_E_NUMBER, 11},
    {DISC OWN "correlation = [0.9, 0.9, 0, -0.9, 0, 0]\n", LRCS_E_NUMBER, 11},
    {DISC OWN "correlation = [0, 0, 0]\n", LRCS_E_ARGUMENT, 11},
    {DISC "[[material]]\nname = \"w\"\nA = 0\nB = 1\ns = 0\nm = 1\ns_error = 0.1\n",
     LRCS_E_ARGUMENT, 5},
    {DISC "[[map]]\nmaterial = \"solar-cell\"\n", LRCS_E_NAME, 5},
    {DISC "[[map]]\nname = \"x\"\n", LRCS_E_NAME, 5},
    {DISC "[[map]]\nname = \"x\"\nmaterial = \"none such\"\n", LRCS_E_NAME, 7},
    {DISC "[[map]]\nname = \"x\"\ncolour = \"#000000\"\nmaterial = \"solar-cell\"\n", LRCS_E_NAME,
     5},
    {DISC "[[map]]\ncolour = \"#00000\"\nmaterial = \"solar-cell\"\n", LRCS_E_ARGUMENT, 6},
    {DISC "[[map]]\ncolour = \"#00000g\"\nmaterial = \"solar-cell\"\n", LRCS_E_ARGUMENT, 6},
    {DISC "[[map]]\ncolour = \"red\"\nmaterial = \"solar-cell\"\n", LRCS_E_ARGUMENT, 6},
    {DISC "[[map]]\nname='x'\nmaterial='solar-cell'\n[[map]]\nname='x'\nmaterial='solar-cell'\n",
     LRCS_E_NAME, 10},
    {DISC "[[map]]\ncolour='#00ff00'\nmaterial='solar-cell'\n[[map]]\ncolour='#00FF00'\n"
          "material='solar-cell'\n",
     LRCS_E_NAME, 10},
};

static void errors_name_their_line(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(refusals); i++) {
        lrcs_where where;
        int status = refuse_text(refusals[i].text, &where);
        if (status != refusals[i].status || where.line != refusals[i].line) {
            fprintf(stderr, "%s\n-> %d, line %u: %s: expected %s, found %s\n", refusals[i].text,
                    status, where.line, where.item, where.expected, where.found);
        }
        assert_int_equal(status, refusals[i].status);
        assert_int_equal(where.line, refusals[i].line);
    }
}

/* The found text of a refusal: what the table has or lacks, and a long name cut to leave room. */
static void what_is_missing_or_wrong_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *text, *item, *found;
    } row[] = {
        {"[[part]]\nshape = 'disc'\n", "[[part]]", "[[part]] without name"},
        {"[[part]]\nname = 'a'\nshape = 'frustum'\nradius = 1\n", "[[part]]",
         "'a' without radius2, length"},
        {"[[part]]\nname = 'a'\nshape = 'cone'\nradius = 1\n", "[[part]]",
         "'a' without length or half_angle_deg"},
        {"[[part]]\nname = 'a'\nshape = 'cone'\nradius = 1\nlength = 1\nhalf_angle_deg = 9\n",
         "[[part]]", "'a' with both length and half_angle_deg"},
        {"[[part]]\nname = 'a name of more than twenty-four letters'\n", "[[part]]",
         "'a name of more than twe.. without file or shape"},
        {BOX "rotate_euler = 'xyz'\n", "[[part]]", "\"a\" without rotate_deg"},
        {BOX "[part.joint]\n", "[[part]]", "\"a\" without axis, angle_deg"},
        {"[[part]]\nname = 'a'\nshape = 'box'\nsize = [1, 1, -2]\n", "size, 3rd number",
         "[1, 1, -2]"},
        {"[[part]]\nname = 'a'\nshape = 'disc'\nradius = -1.50\n", "radius", "-1.50"},
        {DISC "[[material]]\nname = 'w'\nA = 0\ns = 1\n", "[[material]]", "'w' without B, m"},
        {DISC WHITE "like = 'solar-cell'\n", "[[material]]", "\"w\" with like and numbers"},
        {DISC "[[map]]\nname = 'x'\n", "[[map]]", "'x' without material"},
    };
    for (size_t i = 0; i < ROWS(row); i++) {
        lrcs_where where;
        assert_true(refuse_text(row[i].text, &where) < 0);
        assert_string_equal(where.item, row[i].item);
        assert_string_equal(where.found, row[i].found);
    }
}

static void the_first_error_in_the_file_is_reported(void **state)
{
    (void)state;
    lrcs_where where;
    assert_int_equal(refuse_text(BOX "radios = 1\n[[part]]\nname = \x22\n", &where), LRCS_E_NAME);
    assert_int_equal(where.line, 5);
    assert_string_equal(where.found, "radios");
    assert_non_null(strstr(where.expected, "radius"));
}

static void every_unknown_key_is_refused_in_every_table(void **state)
{
    (void)state;
    static const char *const table[] = {"", BOX, BOX "[part.joint]\n", BOX "[[material]]\n",
                                        BOX "[[map]]\n"};
    static const char *const key[] = {"x",    "Name", "name ", "names", "part",      "material2",
                                      "ways", "",     "joint", "sizes", "rotate_DEG"};
    for (size_t t = 0; t < ROWS(table); t++) {
        for (size_t k = 0; k < ROWS(key); k++) {
            char text[200];
            lrcs_where where;
            snprintf(text, sizeof text, "%s\"%s\" = 1\n", table[t], key[k]);
            assert_int_equal(refuse_text(text, &where), LRCS_E_NAME);
        }
    }
    lrcs_where where;
    static const char longer[] = "name_name_name_name_name_name_name_name_name_name = 1\n";
    assert_int_equal(refuse_text(longer, &where), LRCS_E_NAME);
}

static void a_recipe_takes_no_more_than_its_need(void **state)
{
    (void)state;
    static const char *const unit[] = {"[[map]]\n",
                                       "[[part]]\n",
                                       "[[material]]\n",
                                       "a=''\n",
                                       "[[map]]\nname=''\n",
                                       "a=[1_0]\n",
                                       "[[part]]\nname='a'\nfile='b'\n"};
    for (size_t i = 0; i < ROWS(unit); i++) {
        for (size_t times = 1; times < 2000; times = times * 3 + 1) {
            size_t step = strlen(unit[i]);
            char *text = malloc(step * times);
            assert_non_null(text);
            for (size_t k = 0; k < times; k++) {
                memcpy(text + k * step, unit[i], step);
            }
            void *area;
            lrcs_recipe recipe;
            read_text(text, step * times, &area, &recipe,
                      NULL); /* asserts that memory is not the cause */
            free(area);
            free(text);
        }
    }
}

/* Parts with names of their own, so that the largest recipes are also read to their end. */
static void many_parts_fit_their_need(void **state)
{
    (void)state;
    enum { PARTS = 3000, STEP = 40 };
    char *text = malloc((size_t)PARTS * STEP + 1);
    assert_non_null(text);
    size_t size = 0;
    for (int i = 0; i < PARTS; i++) {
        size += (size_t)snprintf(text + size, STEP, "[[part]]\nname='%x'\nfile='m'\n", (unsigned)i);
    }
    void *area;
    lrcs_recipe recipe;
    assert_int_equal(read_text(text, size, &area, &recipe, NULL), LRCS_OK);
    assert_int_equal(recipe.part_count, PARTS);
    free(area);
    free(text);
}

static void too_small_an_area_is_refused_until_it_suffices(void **state)
{
    (void)state;
    size_t size = 0;
    int status = LRCS_E_MEMORY;
    for (; status == LRCS_E_MEMORY && size <= lrcs_recipe_need(sizeof rich - 1); size += 7) {
        unsigned char *area = malloc(size + 1);
        lrcs_recipe recipe;
        lrcs_where where = {0};
        assert_non_null(area);
        lrcs_work work = lrcs_work_make(area, size);
        status = lrcs_recipe_read(rich, sizeof rich - 1, &work, &recipe, &where);
        if (status != LRCS_OK) {
            assert_int_equal(status, LRCS_E_MEMORY);
            assert_int_equal(work.used, 0);
            assert_true(work.peak > size);
            assert_non_null(where.item);
        }
        free(area);
    }
    assert_int_equal(status, LRCS_OK);
}

static void every_prefix_is_read_or_refused(void **state)
{
    (void)state;
    int good = 0;
    for (size_t size = 0; size < sizeof rich; size++) {
        void *area;
        lrcs_recipe recipe;
        lrcs_where where = {0};
        int status = read_text(rich, size, &area, &recipe, &where);
        good += status == LRCS_OK;
        assert_true(status == LRCS_OK || (where.item && where.expected && where.offset <= size));
        free(area);
    }
    assert_true(good > 1);
}

static void flipped_bytes_are_read_or_refused(void **state)
{
    (void)state;
    uint32_t seed = 12345;
    for (int i = 0; i < 6000; i++) {
        char text[sizeof rich];
        memcpy(text, rich, sizeof rich);
        for (int k = 0; k <= i % 3; k++) {
            seed = seed * 1664525u + 1013904223u;
            size_t at = (seed >> 8) % (sizeof rich - 1);
            seed = seed * 1664525u + 1013904223u;
            text[at] =
                i % 2 ? (char)(unsigned char)(seed >> 24) : "\"'[]=#\n\\.,_-1e{}"[seed >> 28];
        }
        void *area;
        lrcs_recipe recipe;
        lrcs_where where = {0};
        int status = read_text(text, sizeof rich - 1, &area, &recipe, &where);
        assert_true(status == LRCS_OK || (where.item && where.expected));
        for (uint32_t p = 0; status == LRCS_OK && p < recipe.part_count; p++) {
            assert_true(strlen(recipe.part[p].name) > 0);
            assert_true(isfinite(recipe.part[p].place.scale[0]));
        }
        free(area);
    }
}

static void the_example_file_is_a_scene(void **state)
{
    (void)state;
    static char text[8192];
    FILE *file = fopen("examples/satellite.toml", "rb");
    if (!file) {
        print_message("examples/satellite.toml is not here: run from the root\n");
        skip();
    }
    size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    void *area;
    lrcs_recipe recipe;
    assert_true(size < 4096);
    assert_int_equal(read_text(text, size, &area, &recipe, NULL), LRCS_OK);
    assert_int_equal(recipe.part_count, 10);
    free(area);
}

static void the_position_of_an_error_is_optional(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(refusals); i++) {
        static unsigned char area[1 << 16];
        size_t size = strlen(refusals[i].text);
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_recipe recipe;
        assert_int_equal(lrcs_recipe_read(refusals[i].text, size, &work, &recipe, NULL),
                         refusals[i].status);
    }
}

static void errors_of_materials_are_read(void **state)
{
    (void)state;
    static const char text[] =
        DISC OWN "A_error = 0.1\nB_error = 0.02\ns_error = 0.03\nm_error = 0\n"
                 "correlation = [0.5, -0.25, 0, 0.125, 0, 0]\nassumed = true\n"
                 "[[material]]\nname = \"x\"\nlike = \"solar-cell\"\n";
    void *area;
    lrcs_recipe recipe;
    assert_int_equal(read_text(text, sizeof text - 1, &area, &recipe, NULL), LRCS_OK);
    assert_int_equal(recipe.material_count, 2);
    const lrcs_brdf_error *error = &recipe.material[0].error;
    check_same(error->A, 0.1);
    check_same(error->B, 0.02);
    check_same(error->s, 0.03);
    check_same(error->m, 0);
    static const double correlation[6] = {0.5, -0.25, 0, 0.125, 0, 0};
    for (int i = 0; i < 6; i++) {
        check_same(error->correlation[i], correlation[i]);
    }
    assert_true(recipe.material[0].assumed);
    assert_false(recipe.material[1].assumed);
    const lrcs_brdf_error library = lrcs_brdf_find("solar-cell")->error;
    assert_memory_equal(&recipe.material[1].error, &library, sizeof library);
    free(area);
}

static void a_body_is_whole_unless_only_its_wall_is_wanted(void **state)
{
    (void)state;
    static const char *const said[] = {"", "wall_only = false\n", "wall_only = true\n"};
    for (int i = 0; i < 3; i++) {
        char text[128];
        void *area;
        lrcs_recipe recipe;
        lrcs_where where;
        snprintf(text, sizeof text, "[[part]]\nname = \"a\"\nshape = \"dome\"\nradius = 1\n%s",
                 said[i]);
        assert_int_equal(read_text(text, strlen(text), &area, &recipe, &where), LRCS_OK);
        assert_int_equal(recipe.part[0].shape.parts, i == 2 ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL);
        free(area);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rich_file_comes_to_its_recipe),
        cmocka_unit_test(maps_and_materials_resolve_to_numbers),
        cmocka_unit_test(errors_name_their_line),
        cmocka_unit_test(what_is_missing_or_wrong_is_named),
        cmocka_unit_test(the_first_error_in_the_file_is_reported),
        cmocka_unit_test(every_unknown_key_is_refused_in_every_table),
        cmocka_unit_test(a_recipe_takes_no_more_than_its_need),
        cmocka_unit_test(many_parts_fit_their_need),
        cmocka_unit_test(too_small_an_area_is_refused_until_it_suffices),
        cmocka_unit_test(every_prefix_is_read_or_refused),
        cmocka_unit_test(flipped_bytes_are_read_or_refused),
        cmocka_unit_test(the_example_file_is_a_scene),
        cmocka_unit_test(the_position_of_an_error_is_optional),
        cmocka_unit_test(errors_of_materials_are_read),
        cmocka_unit_test(a_body_is_whole_unless_only_its_wall_is_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
