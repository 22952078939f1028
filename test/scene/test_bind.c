/* SPDX-License-Identifier: MIT */
/* Precedence: which binding assigns a surface its material, and which bindings matched. */
#include "scene/build/bind.h"

#include <string.h>

#include "check.h"

/* Numbers that identify the binding that assigned them. */
enum { BY_NAME = 1, BY_COLOUR, BY_PART, BY_MAP_NAME, BY_MAP_COLOUR, BY_DEFAULT, BY_OVERRIDE };

static lrcs_brdf mark(int who)
{
    lrcs_brdf brdf = {0.0, (double)who / 100.0, 0.0, 0.0};
    return brdf;
}

static lrcs_binding binding_of(int kind, const char *name, int who)
{
    lrcs_binding binding = {.kind = kind, .name = name, .brdf = mark(who), .two_sided = -1};
    binding.rgb[0] = 0x12;
    return binding;
}

static lrcs_surface surface_of(const char *name)
{
    lrcs_surface surface = {.name = name, .rgb = {0x12, 0, 0}, .has_colour = 1};
    return surface;
}

static void check_who(const lrcs_material *material, int who)
{
    check_same(material->brdf.B, mark(who).B);
    assert_int_equal(material->brdf_given, 1);
}

static lrcs_recipe_material own_material = {
    .name = "own", .brdf = {0.0, 0.03, 0.0, 0.0}, .two_sided = -1, .line = 1};

/* All bindings that apply to surface "skin", in the order of their rank. */
static void make_recipe(lrcs_binding binding[5], uint32_t count, lrcs_recipe *recipe)
{
    binding[0] = binding_of(LRCS_BIND_DEFAULT, NULL, BY_DEFAULT);
    binding[1] = binding_of(LRCS_BIND_MAP_COLOUR, NULL, BY_MAP_COLOUR);
    binding[2] = binding_of(LRCS_BIND_MAP_NAME, "skin", BY_MAP_NAME);
    binding[3] = binding_of(LRCS_BIND_COLOUR, NULL, BY_COLOUR);
    binding[4] = binding_of(LRCS_BIND_NAME, "skin", BY_NAME);
    memset(recipe, 0, sizeof *recipe);
    recipe->binding = binding;
    recipe->binding_count = count;
    recipe->material = &own_material;
    recipe->material_count = 1;
}

static lrcs_material bind(const lrcs_recipe *recipe, uint32_t index, const lrcs_surface *surface,
                          uint32_t *unmatched)
{
    unsigned char bytes[2048];
    lrcs_work work = lrcs_work_make(bytes, lrcsi_binder_need(recipe));
    lrcsi_binder binder;
    lrcs_material material;
    assert_true(lrcsi_binder_need(recipe) <= sizeof bytes);
    assert_int_equal(lrcsi_binder_make(recipe, &work, &binder), LRCS_OK);
    material = surface ? lrcsi_binder_surface(&binder, index, surface)
                       : lrcsi_binder_unassigned(&binder, index);
    if (unmatched) {
        *unmatched = lrcsi_binder_unmatched(&binder);
    }
    return material;
}

static void each_kind_yields_to_the_next(void **state)
{
    (void)state;
    static const int who[6] = {0, BY_DEFAULT, BY_MAP_COLOUR, BY_MAP_NAME, BY_COLOUR, BY_NAME};
    const lrcs_surface skin = surface_of("skin");
    lrcs_binding binding[5];
    lrcs_recipe recipe;
    for (uint32_t count = 1; count <= 5; count++) {
        make_recipe(binding, count, &recipe);
        lrcs_material material = bind(&recipe, LRCS_NONE, &skin, NULL);
        check_who(&material, who[count]);
        assert_string_equal(material.name, "skin");
    }
}

static void a_parts_material_beats_the_map_and_yields_to_the_command_line(void **state)
{
    (void)state;
    const lrcs_surface skin = surface_of("skin");
    lrcs_binding binding[5];
    lrcs_recipe recipe;
    make_recipe(binding, 3, &recipe);
    lrcs_material material = bind(&recipe, 0, &skin, NULL);
    check_who(&material, BY_PART);
    make_recipe(binding, 4, &recipe);
    material = bind(&recipe, 0, &skin, NULL);
    check_who(&material, BY_COLOUR);
    make_recipe(binding, 5, &recipe);
    material = bind(&recipe, 0, &skin, NULL);
    check_who(&material, BY_NAME);
    assert_int_equal(material.source, 1 + recipe.material_count + 4); /* the fifth binding */
    binding[4].source = 77;
    material = bind(&recipe, 0, &skin, NULL);
    assert_int_equal(material.source, 77);
    material = bind(&recipe, 0, NULL, NULL); /* facets that the model gives no material */
    check_who(&material, BY_PART);
    assert_string_equal(material.name, "own");
}

static void without_any_binding_the_default_is_worn_and_said_to_be(void **state)
{
    (void)state;
    const lrcs_surface skin = surface_of("skin");
    lrcs_recipe recipe;
    memset(&recipe, 0, sizeof recipe);
    lrcs_material material = bind(&recipe, LRCS_NONE, &skin, NULL);
    check_same(material.brdf.A, 1.0);
    check_same(material.brdf.B, 0.25);
    assert_int_equal(material.brdf_given, 0);
    material = bind(&recipe, LRCS_NONE, NULL, NULL);
    assert_int_equal(material.brdf_given, 0);
    assert_string_equal(material.name, "");
}

static void a_surface_named_as_in_the_library_is_assigned_that_material(void **state)
{
    (void)state;
    const lrcs_surface gold = surface_of("mli-gold");
    lrcs_binding binding[5];
    lrcs_recipe recipe;
    make_recipe(binding, 1, &recipe); /* beats the default */
    lrcs_material material = bind(&recipe, LRCS_NONE, &gold, NULL);
    check_same(material.brdf.A, lrcs_brdf_find("mli-gold")->brdf.A);
    assert_int_equal(material.brdf_given, 1);
    make_recipe(binding, 2, &recipe); /* yields to the map */
    material = bind(&recipe, LRCS_NONE, &gold, NULL);
    check_who(&material, BY_MAP_COLOUR);
}

static void the_last_of_equal_bindings_wins(void **state)
{
    (void)state;
    const lrcs_surface skin = surface_of("skin");
    lrcs_binding binding[3] = {binding_of(LRCS_BIND_NAME, "skin", BY_DEFAULT),
                               binding_of(LRCS_BIND_NAME, "skin", BY_NAME),
                               binding_of(LRCS_BIND_NAME, "other", BY_COLOUR)};
    lrcs_recipe recipe = {.binding = binding, .binding_count = 2};
    uint32_t unmatched;
    lrcs_material material = bind(&recipe, LRCS_NONE, &skin, &unmatched);
    check_who(&material, BY_NAME);
    assert_int_equal(unmatched, LRCS_NONE); /* the first one names something that is there */
    recipe.binding_count = 3;
    bind(&recipe, LRCS_NONE, &skin, &unmatched);
    assert_int_equal(unmatched, 2);
}

static void colours_match_only_surfaces_that_have_one(void **state)
{
    (void)state;
    lrcs_surface skin = surface_of("skin");
    lrcs_binding colour = binding_of(LRCS_BIND_COLOUR, NULL, BY_COLOUR);
    lrcs_recipe recipe = {.binding = &colour, .binding_count = 1};
    uint32_t unmatched;
    bind(&recipe, LRCS_NONE, &skin, &unmatched);
    assert_int_equal(unmatched, LRCS_NONE);
    skin.has_colour = 0;
    lrcs_material material = bind(&recipe, LRCS_NONE, &skin, &unmatched);
    assert_int_equal(material.brdf_given, 0);
    assert_int_equal(unmatched, 0);
}

static void a_colour_that_a_name_beats_still_matched(void **state)
{
    (void)state;
    const lrcs_surface skin = surface_of("skin");
    lrcs_binding binding[5];
    lrcs_recipe recipe;
    uint32_t unmatched;
    make_recipe(binding, 5, &recipe);
    bind(&recipe, LRCS_NONE, &skin, &unmatched);
    assert_int_equal(unmatched, LRCS_NONE);
}

static void a_name_changes_a_scene_files_material_wherever_it_is_put_on(void **state)
{
    (void)state;
    const lrcs_surface skin = surface_of("skin");
    lrcs_binding binding[2] = {binding_of(LRCS_BIND_MAP_NAME, "skin", BY_MAP_NAME),
                               binding_of(LRCS_BIND_NAME, "own", BY_OVERRIDE)};
    lrcs_recipe recipe = {
        .binding = binding, .binding_count = 2, .material = &own_material, .material_count = 1};
    uint32_t unmatched;
    binding[0].material = "own";
    lrcs_material material = bind(&recipe, LRCS_NONE, &skin, NULL);
    check_who(&material, BY_OVERRIDE);
    binding[0].kind = LRCS_BIND_DEFAULT;
    material = bind(&recipe, LRCS_NONE, &skin, NULL);
    check_who(&material, BY_OVERRIDE);
    material = bind(&recipe, 0, NULL, &unmatched);
    check_who(&material, BY_OVERRIDE);
    assert_string_equal(material.name, "own");
    assert_int_equal(unmatched, LRCS_NONE);
    recipe.binding_count = 1; /* defined, assigned to nothing: the name is there all the same */
    recipe.binding = &binding[1];
    bind(&recipe, LRCS_NONE, &skin, &unmatched);
    assert_int_equal(unmatched, LRCS_NONE);
}

static void the_two_sided_flag_stays_unless_a_binding_sets_it(void **state)
{
    (void)state;
    for (int model = 0; model <= 1; model++) {
        for (int set = -1; set <= 1; set++) {
            lrcs_surface skin = surface_of("skin");
            lrcs_binding name = binding_of(LRCS_BIND_NAME, "skin", BY_NAME);
            lrcs_recipe recipe = {.binding = &name, .binding_count = 1};
            skin.two_sided = (unsigned char)model;
            name.two_sided = set;
            lrcs_material material = bind(&recipe, LRCS_NONE, &skin, NULL);
            assert_int_equal(material.two_sided, set < 0 ? model : set);
        }
    }
}

static void fully_transparent_surfaces_are_omitted_unless_kept(void **state)
{
    (void)state;
    static const double transparency[3] = {0.9949, 0.995, 1.0};
    for (int keep = 0; keep <= 1; keep++) {
        for (int i = 0; i < 3; i++) {
            lrcs_recipe recipe = {.keep_transparent = keep};
            lrcs_surface skin = surface_of("skin");
            skin.transparency = transparency[i];
            lrcs_material material = bind(&recipe, LRCS_NONE, &skin, NULL);
            assert_int_equal(material.omitted, !keep && i > 0);
        }
    }
}

static void materials_of_the_recipe_take_precedence_over_the_library(void **state)
{
    (void)state;
    lrcs_recipe_material gold = {
        .name = "mli-gold", .brdf = mark(BY_PART), .two_sided = -1, .line = 1};
    lrcs_recipe recipe = {.material = &gold, .material_count = 1};
    lrcs_recipe_part part = {.material = "mli-gold", .material_index = -1};
    lrcsi_binder binder = lrcsi_binder_plain(&recipe);
    uint32_t index;
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_OK);
    assert_int_equal(index, 0);
    part.material = "solar-cell";
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_OK);
    assert_true(index >= 1 && index < lrcsi_binder_material_count(&recipe));
    lrcs_material material = bind(&recipe, index, NULL, NULL);
    assert_string_equal(material.name, "solar-cell");
    part.material = "none such";
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_E_NAME);
    part.material = "mli-geld";
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_E_NAME);
    part.material = "mli-gold";
    part.material_index = 1; /* beyond the recipe's materials: by name */
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_OK);
    assert_int_equal(index, 0);
    part.material = NULL;
    assert_int_equal(lrcsi_binder_assigned(&binder, &part, &index), LRCS_OK);
    assert_int_equal(index, LRCS_NONE);
}

static void the_slow_binder_agrees_with_the_indexed_one(void **state)
{
    (void)state;
    static const char *const name[] = {"skin", "own", "mli-gold", "other", "shin"};
    lrcs_binding binding[5];
    lrcs_recipe recipe;
    for (uint32_t count = 0; count <= 5; count++) {
        make_recipe(binding, count, &recipe);
        lrcsi_binder plain = lrcsi_binder_plain(&recipe);
        for (size_t i = 0; i < 10; i++) {
            uint32_t index = i < 5 ? 0 : LRCS_NONE;
            const lrcs_surface surface = surface_of(name[i % 5]);
            lrcs_material a = bind(&recipe, index, &surface, NULL);
            lrcs_material b = lrcsi_binder_surface(&plain, index, &surface);
            check_same(a.brdf.A, b.brdf.A);
            check_same(a.brdf.B, b.brdf.B);
            a = bind(&recipe, index, NULL, NULL);
            b = lrcsi_binder_unassigned(&plain, index);
            check_same(a.brdf.B, b.brdf.B);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_yields_to_the_next),
        cmocka_unit_test(a_parts_material_beats_the_map_and_yields_to_the_command_line),
        cmocka_unit_test(without_any_binding_the_default_is_worn_and_said_to_be),
        cmocka_unit_test(a_surface_named_as_in_the_library_is_assigned_that_material),
        cmocka_unit_test(the_last_of_equal_bindings_wins),
        cmocka_unit_test(colours_match_only_surfaces_that_have_one),
        cmocka_unit_test(a_colour_that_a_name_beats_still_matched),
        cmocka_unit_test(a_name_changes_a_scene_files_material_wherever_it_is_put_on),
        cmocka_unit_test(the_two_sided_flag_stays_unless_a_binding_sets_it),
        cmocka_unit_test(fully_transparent_surfaces_are_omitted_unless_kept),
        cmocka_unit_test(materials_of_the_recipe_take_precedence_over_the_library),
        cmocka_unit_test(the_slow_binder_agrees_with_the_indexed_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
