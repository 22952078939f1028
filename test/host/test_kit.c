/* SPDX-License-Identifier: MIT */
/* Judging answers to a kit: a plate whose sigma is known in closed form, the class of each case,
   the mistakes that are recognized, and what is refused. test/cli/test_compare.sh tries every
   mistake on whole kits. */
#include <lrcs/conformance.h>

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"

#define CASES 12
#define B     0.25
#define M     1.5
#define AREA  2.0

static char folder[64];
static double sigma[CASES], cosine[CASES];
static lrcs_host_judgement judgement;
static lrcs_host_error error;

static FILE *file_open(const char *name)
{
    FILE *out = fopen(name, "wb");
    assert_non_null(out);
    return out;
}

/* A plate of 2 x 1 m in the plane z = 0, turned about y by 6 deg from case to case: by Eq. 2 sigma
   is 4 pi B cos^M S cos^2. */
static int kit_make(void **state)
{
    (void)state;
    const double pi = acos(-1.0);
    strcpy(folder, "/tmp/lrcs-test-XXXXXX");
    if (!mkdtemp(folder) || chdir(folder) != 0 || mkdir("scenes", 0777) != 0 ||
        mkdir("truth", 0777) != 0) {
        return -1;
    }
    FILE *out = file_open("materials.csv");
    fprintf(out, "material,A,B,s,m,two_sided\nwhite,0,%g,0.3,%g,0\n", B, M);
    fclose(out);
    out = file_open("scenes/plate.obj");
    fputs("v -1 -0.5 0\nv 1 -0.5 0\nv 1 0.5 0\nv -1 0.5 0\nusemtl white\nf 1 2 3\nf 1 3 4\n", out);
    fclose(out);
    out = file_open("cases.csv");
    fputs("scene,attitude,tier,qw,qx,qy,qz,sx,sy,sz,az_deg,el_deg,sigma_m2,bound_m2,float_m2,"
          "edge_m2,side_m,image\n",
          out);
    for (int i = 0; i < CASES; i++) {
        double a = 6.0 * i * pi / 180.0;
        cosine[i] = cos(a);
        sigma[i] = 4.0 * pi * B * pow(cosine[i], M) * AREA * cosine[i] * cosine[i];
        fprintf(out,
                "plate,a%d,%d,%.17g,0,%.17g,0,%.17g,0,%.17g,180,%.17g,%.17g,%.17g,%.17g,%.17g,"
                "3,%d\n",
                i, 1 + i / 6, cos(a / 2.0), sin(a / 2.0), -sin(a), cos(a), 90.0 - 6.0 * i, sigma[i],
                1e-14 * sigma[i], 1e-6 * sigma[i], sigma[i], i == 3 ? 2 : 0);
    }
    return fclose(out);
}

static int kit_remove(void **state)
{
    static const char *const name[] = {"materials.csv", "scenes/plate.obj", "cases.csv",
                                       "theirs.csv",    "scenes",           "truth"};
    (void)state;
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        remove(name[i]);
    }
    return chdir("/") == 0 ? rmdir(folder) : -1;
}

/* Judges answers: factor times sigma times cos^power. */
static int judge(double factor, double power)
{
    FILE *out = file_open("theirs.csv");
    fputs("scene,attitude,sigma_m2\n", out);
    for (int i = 0; i < CASES; i++) {
        fprintf(out, "plate,a%d,%.17g\n", i, factor * sigma[i] * pow(cosine[i], power));
    }
    fclose(out);
    memset(&judgement, 0, sizeof judgement);
    judgement.pixels = 512;
    judgement.tier = LRCS_HOST_KIT_TIERS;
    judgement.grade = LRCS_HOST_GRADE_RASTER;
    int status = lrcs_host_kit_read(".", &judgement.kit, &error);
    status = status == LRCS_OK ? lrcs_host_judge(&judgement, "theirs.csv", &error) : status;
    return status == LRCS_OK ? lrcs_host_judge_explain(&judgement, &error) : status;
}

static void classes_are_what_they_allow(void **state)
{
    static const struct {
        double off;
        int grade;
    } tried[] = {{0.0, LRCS_HOST_GRADE_EXACT},       {0.9e-9, LRCS_HOST_GRADE_EXACT},
                 {1.1e-9, LRCS_HOST_GRADE_FLOAT},    {1.9e-6, LRCS_HOST_GRADE_FLOAT},
                 {3e-6, LRCS_HOST_GRADE_RASTER},     {0.9 / 512.0, LRCS_HOST_GRADE_RASTER},
                 {1.1 / 512.0, LRCS_HOST_GRADE_FAIL}};
    (void)state;
    for (size_t k = 0; k < sizeof tried / sizeof *tried; k++) {
        assert_int_equal(judge(1.0 + tried[k].off, 0.0), LRCS_OK);
        assert_int_equal(judgement.asked, CASES);
        assert_int_equal(judgement.given, CASES);
        for (uint32_t i = 0; i < CASES; i++) {
            assert_int_equal(judgement.kit.list[i].grade, tried[k].grade);
        }
        int fails = tried[k].grade == LRCS_HOST_GRADE_FAIL;
        assert_int_equal(judgement.failed, fails ? CASES : 0);
        assert_int_equal(lrcs_host_judge_passed(&judgement), !fails);
        lrcs_host_kit_free(&judgement.kit);
    }
}

static void mistakes_are_recognized(void **state)
{
    static const struct {
        double factor, power;
        const char *name;
    } tried[] = {{0.25, 0.0, "missing-4"},
                 {1e4, 0.0, "centimetres"},
                 {1.0, -1.0, "missing-cosine"},
                 {1.0, 1.0, "extra-cosine"},
                 {1.0, -M, "lambert"}};
    (void)state;
    for (size_t k = 0; k < sizeof tried / sizeof *tried; k++) {
        assert_int_equal(judge(tried[k].factor, tried[k].power), LRCS_OK);
        assert_false(lrcs_host_judge_passed(&judgement));
        assert_true(judgement.findings > 0);
        assert_string_equal(judgement.finding[0].name, tried[k].name);
        assert_int_equal(judgement.unexplained, 0);
        lrcs_host_kit_free(&judgement.kit);
    }
}

static void tiers_that_are_not_asked_for_do_not_count(void **state)
{
    (void)state;
    assert_int_equal(judge(2.0, 0.0), LRCS_OK);
    judgement.tier = 1;
    for (uint32_t i = 0; i < CASES; i++) {
        const lrcs_host_kit_case *one = &judgement.kit.list[i];
        assert_int_equal(lrcs_host_judge_asked(&judgement, one), i < 6);
        assert_int_equal(lrcs_host_judge_failed(&judgement, one), i < 6);
    }
    lrcs_host_kit_free(&judgement.kit);
}

static void facets_that_differ_are_named(void **state)
{
    (void)state;
    assert_int_equal(judge(1.0, 0.0), LRCS_OK);
    FILE *out = file_open("theirs.csv");
    fputs("scene,attitude,facet,visible_area_m2,cos_theta\n", out);
    for (int i = 0; i < CASES; i++) { /* the second facet of the last case is lost */
        double area = 0.5 * AREA * cosine[i];
        fprintf(out, "plate,a%d,0,%.17g,%.17g\nplate,a%d,1,%.17g,%.17g\n", i, area, cosine[i], i,
                i + 1 < CASES ? area : 0.0, cosine[i]);
    }
    fclose(out);
    assert_int_equal(lrcs_host_judge_facets(&judgement, "theirs.csv", &error), LRCS_OK);
    const lrcs_host_kit_facets *facets = &judgement.by_facet;
    assert_int_equal(facets->cases, CASES);
    assert_int_equal(facets->cosines, 2 * CASES);
    assert_string_equal(lrcs_host_cosines_text(facets), "double precision");
    assert_int_equal(facets->worst_count, 1);
    assert_int_equal(facets->worst[0].facet, 1);
    assert_int_equal(facets->worst[0].kind, LRCS_HOST_FACET_LOST);
    check_rel(facets->worst[0].sigma_m2, 0.5 * sigma[CASES - 1], 1e-12);
    lrcs_host_kit_free(&judgement.kit);
}

static void images_upside_down_are_seen(void **state)
{
    static const unsigned char right[16] = {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    static const unsigned char flipped[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    (void)state;
    assert_int_equal(judge(1.0, 0.0), LRCS_OK);
    FILE *out = file_open("truth/plate.a3.item.u32");
    fwrite(right, 1, sizeof right, out);
    fclose(out);
    out = file_open("plate.a3.item.u32");
    fwrite(flipped, 1, sizeof flipped, out);
    fclose(out);
    assert_int_equal(lrcs_host_judge_items(&judgement, ".", &error), LRCS_OK);
    assert_int_equal(judgement.by_item.images, 1);
    assert_int_equal(judgement.by_item.images_found, 1);
    assert_int_equal(judgement.by_item.convention_count[1], 1);
    assert_non_null(strstr(lrcs_host_image_convention_text(1), "upside down"));
    assert_int_equal(lrcs_host_judge_items(&judgement, "nowhere", &error), LRCS_E_SYSTEM);
    assert_int_equal(remove("plate.a3.item.u32"), 0);
    assert_int_equal(remove("truth/plate.a3.item.u32"), 0);
    lrcs_host_kit_free(&judgement.kit);
}

static void faults_are_named_with_their_line(void **state)
{
    static const struct {
        const char *text;
        int status;
        const char *says;
    } bad[] = {{"", LRCS_E_SYNTAX, "found nothing"},
               {"scene,sigma_m2\nplate,1\n", LRCS_E_NAME, "no column is named attitude"},
               {"scene,attitude\nplate,a1\n", LRCS_E_NAME, "sigma_m2 or sigma_dbsm"},
               {"scene,attitude,sigma_m2\nplane,a1,1\n", LRCS_E_SYNTAX, "the nearest is plate"},
               {"scene,attitude,sigma_m2\nplate,b1,1\n", LRCS_E_SYNTAX, "an attitude of plate"},
               {"scene,attitude,sigma_m2\nplate,a1,1\nplate,a1,1\n", LRCS_E_SYNTAX, "line 3"},
               {"scene,attitude,sigma_m2\nplate,a1,x\n", LRCS_E_SYNTAX, "line 2"}};
    (void)state;
    assert_int_equal(judge(1.0, 0.0), LRCS_OK);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        FILE *out = file_open("theirs.csv");
        fputs(bad[i].text, out);
        fclose(out);
        for (uint32_t k = 0; k < CASES; k++) {
            judgement.kit.list[k].given = 0;
        }
        assert_int_equal(lrcs_host_judge(&judgement, "theirs.csv", &error), bad[i].status);
        assert_non_null(strstr(error.text, bad[i].says));
    }
    lrcs_host_kit_free(&judgement.kit);
    assert_int_equal(lrcs_host_kit_read("nowhere", &judgement.kit, &error), LRCS_E_SYSTEM);
    lrcs_host_kit_free(&judgement.kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(classes_are_what_they_allow),
        cmocka_unit_test(mistakes_are_recognized),
        cmocka_unit_test(tiers_that_are_not_asked_for_do_not_count),
        cmocka_unit_test(facets_that_differ_are_named),
        cmocka_unit_test(images_upside_down_are_seen),
        cmocka_unit_test(faults_are_named_with_their_line),
    };
    return cmocka_run_group_tests(tests, kit_make, kit_remove);
}
