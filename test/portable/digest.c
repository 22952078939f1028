/* SPDX-License-Identifier: MIT */
/* What must be the same on every machine, as hashes over results: all that calls nothing of libm
   but what is exact or correctly rounded (readers, decimals, predicates, topology, poses, placing,
   every area and every decision of visibility, and sigma with its bound over flat facets). And what
   libm has a part in, as bits with its bound: sigma of shapes, whose vertices libm places, curved
   normals, closed forms.
   usage: digest STRIDE [REFERENCE]    (in the root; of all that is tried only each STRIDE-th; a
   reference is what this printed elsewhere)
   With a reference exit 1 where a hash differs, where two bounds do not overlap, or where such a
   sigma is off by more than SIGMA_ULPS. */
#include <lrcs/emulate.h>
#include <lrcs/lrcs.h>

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/decimal.h"
#include "base/exact.h"
#include "base/fnv.h"
#include "check.h"
#include "visible.h"

/* glibc's sine and cosine are within 1 ulp each; the glint's exponent multiplies what that moves a
   normal by up to some hundred where the glint is faint. Measured: 0 (examples/flight/README.md).
 */
#define SIGMA_ULPS  64
#define SIGMA_COUNT 2048
#define PIXELS      48u
#define SECTIONS    16
#define FILE_MOST   (1 << 16)
#define MEMORY      (96u << 20)

typedef struct digest_section {
    char name[32];
    uint64_t hash;
} digest_section;

typedef struct digest_sigma {
    char name[48];
    double value, bound;
} digest_sigma;

static digest_section section[SECTIONS];
static digest_sigma sigma[SIGMA_COUNT];
static size_t section_count, sigma_count;
static uint32_t stride = 1;
static unsigned char memory[MEMORY];
static char bytes[FILE_MOST];

/* --- what is hashed --------------------------------------------------------------------------- */

static void section_start(const char *name)
{
    snprintf(section[section_count].name, sizeof section->name, "%s", name);
    section[section_count++].hash = LRCSI_FNV_START;
}

static void take(uint64_t bits)
{
    uint64_t *hash = &section[section_count - 1].hash;
    *hash = lrcsi_fnv_bits(*hash, bits, 8);
}

static void take_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    take(bits);
}

static void take_doubles(const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        take_double(value[i]);
    }
}

static void take_text(const char *text)
{
    for (; *text; text++) {
        take((unsigned char)*text);
    }
    take(0);
}

static void take_mesh(const lrcs_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        take_doubles(mesh->vertex[i].x, 3);
    }
    for (uint32_t i = 0; i < mesh->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            take(mesh->facet[i].corner[k]);
        }
        take(mesh->facet_material[i]);
        take(mesh->facet_part[i]);
        take(mesh->facet_smooth[i]);
    }
    for (uint32_t i = 0; i < mesh->material_count; i++) {
        const lrcs_surface *material = &mesh->material[i];
        take_text(material->name);
        take(material->rgb[0] | material->rgb[1] << 8 | material->rgb[2] << 16);
        take(material->has_colour | material->two_sided << 1);
        take_double(material->transparency);
    }
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        take_text(mesh->part[i]);
    }
    take(mesh->notices);
}

static void take_report(const lrcs_mesh_report *report)
{
    take(report->vertices);
    take(report->edges);
    take(report->degenerate);
    take(report->duplicate);
    take(report->boundary_edges);
    take((uint64_t)report->closed | (uint64_t)report->convex << 1);
    take_doubles(report->box_min, 3);
    take_doubles(report->box_max, 3);
    take_double(report->area);
    take_double(report->volume);
}

static void keep_sigma(const char *name, uint32_t number, double value, double bound)
{
    assert_true(sigma_count < SIGMA_COUNT);
    digest_sigma *s = &sigma[sigma_count++];
    snprintf(s->name, sizeof s->name, "%s_%u", name, (unsigned)number);
    s->value = value;
    s->bound = bound;
}

/* --- readers ---------------------------------------------------------------------------------- */

static size_t file_load(const char *name)
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_true(size > 0 && size < sizeof bytes);
    return size;
}

typedef int reader(const void *, size_t, lrcs_work *, lrcs_mesh *, lrcs_where *);

static void read_once(reader *read, size_t size)
{
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    lrcs_mesh mesh;
    lrcs_where where;
    int status = read(bytes, size, &work, &mesh, &where);
    take((uint64_t)(int64_t)status);
    if (status == LRCS_OK) {
        lrcs_mesh_report report;
        take_mesh(&mesh);
        assert_int_equal(lrcs_mesh_check(mesh.vertex, mesh.vertex_count, mesh.facet,
                                         mesh.facet_count, &work, &report),
                         LRCS_OK);
        take_report(&report);
    } else {
        take(where.offset);
        take(where.line);
        take_text(where.item);
        take_text(where.found);
    }
}

/* A file as it is, and with each of its bytes changed in turn. */
static void digest_reader(const char *name, reader *read)
{
    size_t size = file_load(name);
    section_start(strrchr(name, '/') + 1);
    read_once(read, size);
    for (size_t i = 0; i < size; i += stride) {
        bytes[i] = (char)(bytes[i] ^ 0x81);
        read_once(read, size);
        bytes[i] = (char)(bytes[i] ^ 0x81);
    }
}

static void digest_readers(void)
{
    digest_reader("test/portable/models/all.3ds", lrcs_3ds_read);
    digest_reader("test/portable/models/square.stl", lrcs_stl_read);
    digest_reader("test/portable/models/text.stl", lrcs_stl_read);
    digest_reader("test/portable/models/all.obj", lrcs_obj_read);
}

/* --- numbers ---------------------------------------------------------------------------------- */

static void digest_decimals(void)
{
    uint64_t seed = 88172645463325252u;
    section_start("decimals");
    for (uint32_t i = 0; i < 3000; i += stride) {
        char text[64];
        double value = 0;
        unsigned part[3];
        for (int k = 0; k < 3; k++) {
            part[k] = random_below(&seed, 1u << 30);
        }
        int length = snprintf(text, sizeof text, "%u%u.%ue%d", part[0], part[1], part[2],
                              (int)random_below(&seed, 640) - 330);
        assert_non_null(lrcsi_decimal_read(text, text + length, &value));
        take_double(value);
    }
}

static void digest_predicates(void)
{
    uint64_t seed = 1234567;
    section_start("predicates");
    for (uint32_t i = 0; i < 4000; i += stride) {
        double p[4][3];
        for (int k = 0; k < 12; k++) {
            p[k / 3][k % 3] = (double)random_below(&seed, 5) + 0x1p-52 * random_below(&seed, 3);
        }
        double high[3];
        double low[3];
        take((uint64_t)(lrcsi_exact_orient(p[0], p[1], p[2], p[3]) + 1));
        take((uint64_t)(lrcsi_exact_side(p[0], p[1], p[2], p[3]) + 1));
        lrcsi_exact_normal(p[0], p[1], p[2], high, low);
        take_doubles(high, 3);
        take_doubles(low, 3);
        take_double(lrcsi_exact_dot(p[0], p[1], p[2], p[3]));
        lrcsi_dd height = lrcsi_exact_height(p[0], p[1], p[2], p[3]);
        take_double(height.hi);
        take_double(height.lo);
    }
}

static void take_pose(const lrcs_pose *pose)
{
    take_doubles(pose->direction, 3);
    take_doubles(pose->R[0], 9);
}

static void digest_poses(void)
{
    uint64_t seed = 7;
    section_start("poses");
    for (uint32_t i = 0; i < 500; i += stride) {
        static const char *const sequence[] = {"XYZ", "zyx", "ZXZ", "yxy"};
        lrcs_pose pose;
        double q[4];
        for (int k = 0; k < 4; k++) {
            q[k] = (double)random_below(&seed, 20001) - 10000;
        }
        const double angle[3] = {0.037 * q[0], 0.041 * q[1], 0.043 * q[2]};
        assert_int_equal(lrcs_pose_from_quaternion(q, &pose), LRCS_OK);
        take_pose(&pose);
        assert_int_equal(lrcs_pose_from_azel(angle[0], angle[1], &pose), LRCS_OK);
        take_pose(&pose);
        assert_int_equal(lrcs_pose_from_euler(sequence[i % 4], angle, &pose), LRCS_OK);
        take_pose(&pose);
        assert_int_equal(lrcs_pose_from_direction(q, &pose), LRCS_OK);
        take_pose(&pose);
    }
}

/* --- scenes ----------------------------------------------------------------------------------- */

static lrcs_facet_record record[SCENE_FACETS];
static uint32_t pixel[PIXELS * PIXELS];

static void take_records(uint32_t facets)
{
    assert_true(facets <= SCENE_FACETS);
    for (uint32_t i = 0; i < facets; i++) {
        take_double(record[i].area_m2);
        take_double(record[i].cos_theta);
        take_double(record[i].visible_area_m2);
        take_double(record[i].sigma_m2);
        take_double(record[i].sigma_glint_m2);
    }
}

static void take_pixels(void)
{
    for (uint32_t i = 0; i < PIXELS * PIXELS; i++) {
        take(pixel[i]);
    }
}

/* Half the steps that a run took: the same ones everywhere, where no cubature decides by libm. */
static void run_half(const lrcs_prepared *prepared, const lrcs_pose *pose, uint64_t steps,
                     lrcs_work *work, uint32_t facets)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    options.method = LRCS_METHOD_EXACT;
    options.steps = steps / 2;
    assert_int_equal(lrcs_sigma_run(prepared, pose, &options, work, &result, record, NULL),
                     LRCS_OK);
    take((uint32_t)steps);
    take((uint32_t)result.steps);
    take_records(facets);
}

static void take_sigma(const lrcs_result *result)
{
    take_double(result->sigma_m2);
    take_double(result->sigma_glint_m2);
    take_double(result->sigma_diffuse_m2);
    take_double(result->bound_m2);
    take_double(result->budget.visibility_m2);
    take_double(result->budget.rounding_m2);
    take_double(result->estimate_m2);
    take(result->flags);
}

/* One run: what is visible goes into the hash, and sigma with its bound; the latter are kept too,
   for scenes whose hash does not count. */
static void run_one(const char *name, uint32_t number, const lrcs_prepared *prepared,
                    const lrcs_pose *pose, int method, lrcs_work *work, uint32_t facets)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_image image = {.size = PIXELS, .facet = pixel};
    lrcs_result result;
    options.method = method;
    options.resolution = method == LRCS_METHOD_ZBUFFER ? PIXELS : 0;
    assert_int_equal(lrcs_sigma_run(prepared, pose, &options, work, &result, record,
                                    method == LRCS_METHOD_ZBUFFER ? &image : NULL),
                     LRCS_OK);
    take_double(result.projected_area_m2);
    take_double(result.back_side_area_m2);
    take(result.facets_front);
    take(result.facets_hidden);
    take(result.facets_partial);
    take(result.notices);
    take_records(facets);
    take_sigma(&result);
    if (method == LRCS_METHOD_ZBUFFER) {
        take_pixels();
    }
    keep_sigma(name, number, result.sigma_m2, result.bound_m2);
    if (method == LRCS_METHOD_EXACT && result.curvature_estimate_m2 < 0) {
        run_half(prepared, pose, result.steps, work, facets);
    }
}

static void digest_polygons(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work)
{
    size_t mark = work->used;
    lrcs_polygons polygons;
    assert_int_equal(lrcs_polygon_run(prepared, pose, work, &polygons), LRCS_OK);
    take(polygons.rings);
    for (uint32_t i = 0; i < polygons.points; i++) {
        take_doubles(polygons.point[i].body, 3);
        take_doubles(polygons.point[i].view, 2);
    }
    take_double(polygons.bound_m2);
    work->used = mark;
}

/* A z-buffer in floats, as graphics hardware has it. */
static void digest_emulation(const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work *work,
                             uint32_t facets)
{
    lrcs_emulation_options options = {PIXELS, LRCS_PRECISION_FLOAT32, 24};
    lrcs_image image = {.size = PIXELS, .facet = pixel};
    lrcs_emulation emulation;
    assert_int_equal(lrcs_emulate_run(prepared, pose, &options, work, &emulation, record, &image),
                     LRCS_OK);
    take_double(emulation.projected_area_m2);
    take_records(facets);
    take_pixels();
}

/* Many facets at random, on lattice points, each in a cube of its own, for full blocks of every
   kind of material: narrow and wide glints, each form of the diffuse term, one-sided and two-sided.
 */
static void digest_materials(void)
{
    static test_scene scene;
    static const lrcs_brdf brdf[] = {{1, 0.25, 0.2, 0.5}, {3, 0, 0.02, 0}, {0, 0.3, 0, 2},
                                     {1, 0.1, 0.07, 7.3}, {2, 1e-3, 3, 1}, {5, 0.5, 1e-4, 2000},
                                     {1, 0.2, 0.3, 0.3}};
    uint64_t seed = 4096;
    section_start("materials");
    scene_start(&scene);
    for (size_t i = 0; i < sizeof brdf / sizeof *brdf; i++) {
        scene_material(&scene, brdf[i].A, brdf[i].B, brdf[i].s, brdf[i].m)->two_sided = i % 3 == 1;
    }
    for (uint32_t i = 0; i < 2000; i++) {
        const double cube[3] = {i % 13 - 6.0, i / 13 % 13 - 6.0, i / 169 - 6.0};
        double p[3][3];
        for (int k = 0; k < 9; k++) {
            p[k / 3][k % 3] = (double)random_below(&seed, 1u << 20) + 0x1p21 * cube[k % 3];
        }
        scene.assigned = random_below(&seed, scene.scene.material_count);
        scene_triangle(&scene, p[0], p[1], p[2]);
    }
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    const lrcs_prepared *prepared;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    for (uint32_t i = 0; i < 60; i += stride) {
        lrcs_run_options options = lrcs_run_options_default();
        const double direction[3] = {random_below(&seed, 2000) - 999.5, random_below(&seed, 999),
                                     random_below(&seed, 2000) - 999.5};
        lrcs_pose pose;
        lrcs_result result;
        options.method = LRCS_METHOD_FACET;
        assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &result, record, NULL),
                         LRCS_OK);
        take_sigma(&result);
        take_records(scene.scene.facet_count);
    }
}

/* The 210 small scenes of degenerate contacts, at small integers. */
static void digest_contacts(void)
{
    static test_scene scene;
    section_start("contacts");
    for (uint32_t i = 0; i < CASES; i += stride) {
        visible_scene(&scene, &cases[i], i % 2);
        lrcs_work work = lrcs_work_make(memory, sizeof memory);
        const lrcs_prepared *prepared;
        lrcs_pose pose;
        assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
        assert_int_equal(lrcs_pose_from_direction(cases[i].direction, &pose), LRCS_OK);
        for (int method = LRCS_METHOD_FACET; method <= LRCS_METHOD_EXACT; method++) {
            run_one("contacts", 4 * i + (uint32_t)method, prepared, &pose, method, &work,
                    scene.scene.facet_count);
        }
        digest_polygons(prepared, &pose, &work);
    }
}

/* Boxes and plates at odd angles, as a scene file: reading, placing, every area. */
static const char boxes[] =
    "[[part]]\nname='bus'\nshape='box'\nsize=[1.2,1.1,1.83]\nmaterial='mli-gold'\n"
    "[[part]]\nname='wing'\nshape='box'\nsize=[2.4,1.1,0.02]\n"
    "translate=[1.9,0.05,0]\nrotate_euler='XYZ'\nrotate_deg=[17.3,4.1,-31]\n"
    "[[part]]\nname='plate'\nshape='plate'\nsize=[1.7,1.3]\nmaterial='paint-white'\n"
    "translate=[-0.6,0.2,0.3]\nrotate_axis=[1,2,3]\nrotate_deg=77.7\n";

static void run_scene(const char *name, const char *text, size_t size, const lrcs_mesh *models,
                      int normals, uint32_t poses, int hashed)
{
    lrcs_work work = lrcs_work_make(memory + MEMORY / 2, MEMORY / 2);
    lrcs_recipe recipe;
    lrcs_scene scene;
    const lrcs_prepared *prepared;
    lrcs_build_options build = lrcs_build_options_default();
    build.tolerance = 1e-2;
    build.normals = normals;
    assert_int_equal(lrcs_recipe_read(text, size, &work, &recipe, NULL), LRCS_OK);
    assert_int_equal(lrcs_scene_build(&recipe, models, &build, &work, &scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    uint64_t before = section[section_count - 1].hash;
    take(lrcs_scene_hash(&scene));
    for (uint32_t i = 0; i < poses; i += stride) {
        lrcs_pose pose;
        assert_int_equal(lrcs_pose_from_azel(41.3 * i, 60 - 25.1 * i, &pose), LRCS_OK);
        for (int method = LRCS_METHOD_ZBUFFER; method <= LRCS_METHOD_EXACT; method++) {
            run_one(name, 2 * i + (uint32_t)method - LRCS_METHOD_ZBUFFER, prepared, &pose, method,
                    &work, scene.facet_count);
        }
        digest_polygons(prepared, &pose, &work);
        if (normals == LRCS_NORMALS_FLAT) {
            digest_emulation(prepared, &pose, &work, scene.facet_count);
        }
    }
    if (!hashed) { /* libm placed the vertices */
        section[section_count - 1].hash = before;
    }
}

static void digest_boxes(void)
{
    section_start("boxes");
    run_scene("boxes", boxes, sizeof boxes - 1, NULL, LRCS_NORMALS_FLAT, 6, 1);
}

/* Shapes of every kind, and a cylinder with curved normals: sigma only. */
static void keep_shapes(void)
{
    static const char curved[] = "[[part]]\nname='can'\nfile='can.obj'\n";
    size_t size = file_load("examples/satellite.toml");
    run_scene("satellite", bytes, size, NULL, LRCS_NORMALS_FLAT, 3, 0);

    lrcs_work work = lrcs_work_make(memory, MEMORY / 2);
    lrcs_shape can = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2};
    lrcs_divisions divisions = {24, 1, 0};
    lrcs_mesh mesh;
    assert_int_equal(lrcs_shape_mesh(&can, &divisions, &work, &mesh, NULL), LRCS_OK);
    run_scene("curved", curved, sizeof curved - 1, &mesh, LRCS_NORMALS_SMOOTH, 3, 0);
}

static void keep_closed_forms(void)
{
    static const lrcs_brdf brdf[] = {{1, 0.25, 0.2, 0.5}, {3, 0.1, 0.02, 2}, {0, 0.3, 0, 7}};
    uint32_t number = 0;
    for (int kind = 0; kind < LRCS_SHAPE_KINDS; kind++) {
        lrcs_shape shape = {.kind = kind, .size = {1, 1.5, 2}, .radius = 0.5};
        shape.length = kind >= LRCS_SHAPE_CYLINDER ? 1.25 : 0;
        shape.radius2 = kind == LRCS_SHAPE_FRUSTUM ? 0.75 : 0;
        if (kind == LRCS_SHAPE_PLATE) {
            shape.size[2] = 0;
        }
        if (kind >= LRCS_SHAPE_DISC && kind != LRCS_SHAPE_BOX) {
            memset(shape.size, 0, sizeof shape.size);
        } else {
            shape.radius = 0;
        }
        for (int b = 0; b < 3; b++) {
            for (uint32_t deg = 0; deg <= 180; deg += 20 * stride) {
                lrcs_aspect aspect = {.deg = deg};
                lrcs_closed_form closed;
                assert_int_equal(lrcs_closed_eval(&shape, &brdf[b], &aspect, &closed), LRCS_OK);
                keep_sigma("closed", number++, closed.sigma_m2, closed.bound_m2);
            }
        }
    }
}

/* --- comparison ------------------------------------------------------------------------------- */

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double from_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void digest_print(void)
{
    for (size_t i = 0; i < section_count; i++) {
        printf("hash %s %016" PRIx64 "\n", section[i].name, section[i].hash);
    }
    for (size_t i = 0; i < sigma_count; i++) {
        printf("sigma %s %016" PRIx64 " %016" PRIx64 "\n", sigma[i].name, bits_of(sigma[i].value),
               bits_of(sigma[i].bound));
    }
}

/* How far apart in units of the last place; both are positive or zero. */
static uint64_t ulps_between(double a, double b)
{
    uint64_t x = bits_of(a);
    uint64_t y = bits_of(b);
    return x > y ? x - y : y - x;
}

static int digest_compare(FILE *reference)
{
    int bad = 0;
    uint64_t most = 0;
    size_t same = 0;
    char name[48];
    uint64_t first;
    uint64_t second;
    for (size_t i = 0; i < section_count; i++) {
        if (fscanf(reference, " hash %47s %" SCNx64, name, &first) != 2 ||
            strcmp(name, section[i].name) != 0 || first != section[i].hash) {
            printf("DIFFERS: hash of %s\n", section[i].name);
            bad = 1;
        }
    }
    for (size_t i = 0; i < sigma_count; i++) {
        const digest_sigma *s = &sigma[i];
        if (fscanf(reference, " sigma %47s %" SCNx64 " %" SCNx64, name, &first, &second) != 3 ||
            strcmp(name, s->name) != 0) {
            printf("DIFFERS: no reference for sigma of %s\n", s->name);
            return 1;
        }
        double value = from_bits(first);
        uint64_t ulps = ulps_between(value, s->value);
        if (!(fabs(value - s->value) <= from_bits(second) + s->bound) || ulps > SIGMA_ULPS) {
            printf("DIFFERS: sigma of %s: %.17g, elsewhere %.17g, bounds %.3g, %.3g\n", s->name,
                   s->value, value, s->bound, from_bits(second));
            bad = 1;
        }
        most = ulps > most ? ulps : most;
        same += ulps == 0;
    }
    printf("%zu hashes, %zu values of sigma: %zu the same, all within %" PRIu64 " ulp\n",
           section_count, sigma_count, same, most);
    return bad;
}

static int compared;
static const char *reference_name;

static void everything_is_the_same_everywhere(void **state)
{
    (void)state;
    digest_readers();
    digest_decimals();
    digest_predicates();
    digest_poses();
    digest_materials();
    digest_contacts();
    digest_boxes();
    keep_shapes();
    keep_closed_forms();
    if (!reference_name) {
        digest_print();
        return;
    }
    FILE *reference = fopen(reference_name, "r");
    assert_non_null(reference);
    compared = digest_compare(reference);
    fclose(reference);
    assert_int_equal(compared, 0);
}

int main(int count, char **word)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(everything_is_the_same_everywhere)};
    unsigned long given = count > 1 ? strtoul(word[1], NULL, 10) : 1;
    stride = given > 0 ? (uint32_t)given : 1;
    reference_name = count > 2 ? word[2] : NULL;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
