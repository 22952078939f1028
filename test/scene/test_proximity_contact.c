/* SPDX-License-Identifier: MIT */
/* Contacts of walls with other solids: cylinders, cones, frusta and boxes at random places and
   angles, of which one pierces another. For each facet of the first one, the fraction of points
   that are inside the facets of the other and stand for points outside of its true solid, and the
   reverse, are sampled, and compared with what the pairs of the facet state. Inside the facets is
   behind all of them, inside the solid follows from its dimensions.
   Usage: test_proximity_contact [SCENES [SEED]]: as many more scenes. */
#include "scene/proximity_contact.h"

#include <stdlib.h>
#include <string.h>

#include "base/vec3.h"
#include "check.h"
#include "inside.h"
#include "mesh/shape/revolution.h"
#include "random.h"
#include "scene/prepare.h"

enum { WALL, OTHER, PARTS, SAMPLES = 5000 };

static unsigned char scene_area[1u << 22];
static unsigned char prepare_area[1u << 24];
static lrcs_scene scene;

static uint64_t state = 1;

static double uniform(double low, double high)
{
    return low + (high - low) * random_unit(&state);
}

static lrcs_shape random_shape(int kind)
{
    lrcs_shape shape = {.kind = kind};
    shape.radius = kind == LRCS_SHAPE_BOX ? 0 : uniform(0.3, 1);
    shape.radius2 = kind == LRCS_SHAPE_FRUSTUM ? uniform(0.3, 1) : 0;
    shape.length = kind == LRCS_SHAPE_BOX ? 0 : uniform(1, 3);
    for (int k = 0; k < 3 && kind == LRCS_SHAPE_BOX; k++) {
        shape.size[k] = uniform(0.5, 2);
    }
    return shape;
}

/* Axes from three random directions. */
static void random_turn(double rotate[3][3])
{
    double length;
    do {
        length = 0;
        for (int k = 0; k < 3; k++) {
            rotate[0][k] = uniform(-1, 1);
            rotate[2][k] = uniform(-1, 1);
            length += rotate[0][k] * rotate[0][k];
        }
        lrcsi_vec3_cross(rotate[2], rotate[0], rotate[1]);
    } while (length < 0.1 || lrcsi_vec3_dot(rotate[1], rotate[1]) < 0.1);
    lrcsi_vec3_cross(rotate[0], rotate[1], rotate[2]);
    for (int i = 0; i < 3; i++) {
        const double norm = sqrt(lrcsi_vec3_dot(rotate[i], rotate[i]));
        for (int k = 0; k < 3; k++) {
            rotate[i][k] /= norm;
        }
    }
}

static const lrcs_prepared *random_scene(double division)
{
    static const int kinds[] = {LRCS_SHAPE_CYLINDER, LRCS_SHAPE_CONE, LRCS_SHAPE_FRUSTUM,
                                LRCS_SHAPE_BOX};
    lrcs_recipe_part part[PARTS];
    const lrcs_recipe recipe = {.part = part, .part_count = PARTS};
    const lrcs_build_options options = {division, 4000, LRCS_NORMALS_FLAT, 1, division, NULL};
    const lrcs_prepared *prepared = NULL;
    const int wall = (int)(random_splitmix(&state) % 4);
    const int other = (int)(random_splitmix(&state) % (wall == 3 ? 3 : 4));
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
        part[i].shape = random_shape(kinds[i == WALL ? wall : other]);
        random_turn(part[i].place.rotate);
        for (int k = 0; k < 3; k++) {
            part[i].place.translate[k] = uniform(-0.5, 0.5);
        }
    }
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, &scene, NULL), LRCS_OK);
    work = lrcs_work_make(prepare_area, sizeof prepare_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    return prepared;
}

/* Scaled coordinates from those in the frame of a part, m. */
static void from_part(const lrcs_prepared *p, const lrcs_part *part, const double at[3],
                      double x[3])
{
    for (int k = 0; k < 3; k++) {
        x[k] = part->origin[k];
        for (int i = 0; i < 3; i++) {
            x[k] += at[i] * part->axis[i][k];
        }
        x[k] = ldexp(x[k], -p->exponent);
    }
}

/* The point of a straight wall that is mapped to a point of a facet: in a sector from azimuth -h to
   h the fraction of the chord is that of the angle; heights remain. */
static void map_to_wall(const lrcs_prepared *p, const lrcs_part *part, const double y[3],
                        double x[3])
{
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const double h = body.half;
    double at[3];
    to_part(p, part, y, at);
    const double azimuth = atan2(at[1], at[0]);
    const double middle = 2 * h * (floor(azimuth / (2 * h)) + 0.5);
    const double radius = true_radius(&part->shape, at[2]);
    const double chord = body.vertex_ratio * radius * sin(h); /* half of it */
    const double across = cos(middle) * at[1] - sin(middle) * at[0];
    const double angle = middle + h * (across / chord);
    at[0] = radius * cos(angle);
    at[1] = radius * sin(angle);
    from_part(p, part, at, x);
}

/* Samples a facet: which fractions of its points are gained and lost, by multiples of two
   irrational numbers. */
static void sample_facet(const lrcs_prepared *p, uint32_t f, double fraction[2])
{
    const lrcs_part *wall = &scene.part[WALL];
    const lrcs_part *other = &scene.part[OTHER];
    int count[2] = {0, 0};
    for (int n = 0; n < SAMPLES; n++) {
        double a = fmod(0.5 + n * 0.7548776662466927, 1);
        double b = fmod(0.5 + n * 0.5698402909980532, 1);
        double y[3];
        double x[3];
        if (a + b > 1) {
            a = 1 - a;
            b = 1 - b;
        }
        for (int i = 0; i < 3; i++) {
            y[i] = x[i] = a * lrcsi_prepared_corner(p, f, 0)[i] +
                          b * lrcsi_prepared_corner(p, f, 1)[i] +
                          (1 - a - b) * lrcsi_prepared_corner(p, f, 2)[i];
        }
        if (scene.facet_smooth[f] != 0) {
            map_to_wall(p, wall, y, x);
        }
        const int in_facets = is_in_facets(p, other, y);
        const int in_shape = is_in_shape(p, other, x);
        count[0] += in_facets && !in_shape;
        count[1] += !in_facets && in_shape;
    }
    for (int i = 0; i < 2; i++) {
        fraction[i] = (double)count[i] / SAMPLES;
    }
}

/* What the pairs of the facets of the first part state, and what is sampled, in all: gain and loss;
   the facets with any. */
typedef struct contact_sums {
    double sampled[2], stated[2], before[2];
    int facets;
} contact_sums;

static void compare_scene(const lrcs_prepared *p, contact_sums *sums)
{
    const lrcs_part *wall = &scene.part[WALL];
    for (uint32_t f = wall->first_facet; f < wall->first_facet + wall->facet_count; f++) {
        const double area = p->normal[f].length;
        double stated[2] = {0, 0};
        double before[2] = {0, 0};
        double sampled[2];
        if (wall->kind != LRCS_SHAPE_BOX && scene.facet_smooth[f] == 0) {
            continue; /* the ends of the wall: their map is another one */
        }
        for (size_t i = 0; i < p->proximity.count; i++) {
            const lrcsi_proximity_pair *pair = &p->proximity.pair[i];
            if (pair->facet == f) {
                check_most((double)pair->gain_fraction, (double)pair->back_fraction);
                check_most((double)pair->loss_fraction, (double)pair->front_fraction);
                stated[0] += (double)pair->gain_fraction;
                stated[1] += (double)pair->loss_fraction;
                before[0] += (double)pair->back_fraction;
                before[1] += (double)pair->front_fraction;
            }
        }
        if (!(stated[0] + stated[1] > 0)) {
            continue;
        }
        sums->facets++;
        sample_facet(p, f, sampled);
        for (int i = 0; i < 2; i++) {
            check_most(sampled[i], stated[i] + (4 + 2 * sqrt(stated[i] * SAMPLES)) / SAMPLES);
            sums->sampled[i] += area * sampled[i];
            sums->stated[i] += area * stated[i];
            sums->before[i] += area * before[i];
        }
    }
}

static void compare_scenes(int scenes, contact_sums *sums)
{
    for (int i = 0; i < scenes; i++) {
        compare_scene(random_scene(pow(10, uniform(-3, -1))), sums);
    }
}

static void contacts_change_no_more_than_their_fractions(void **unused)
{
    (void)unused;
    contact_sums sums = {.facets = 0};
    compare_scenes(10, &sums);
    assert_true(sums.facets > 100);
    for (int i = 0; i < 2; i++) { /* the bound is not much larger, and less than all of the band */
        check_most(sums.sampled[i], sums.stated[i]);
        check_most(sums.stated[i], 8 * sums.sampled[i]);
        check_most(sums.stated[i], 0.6 * sums.before[i]);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_change_no_more_than_their_fractions),
    };
    if (argc > 1) {
        contact_sums sums = {.facets = 0};
        state = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
        compare_scenes(atoi(argv[1]), &sums);
        printf("%d facets; gained %.3g, at most %.3g (the band %.3g); lost %.3g, at most %.3g "
               "(%.3g)\n",
               sums.facets, sums.sampled[0], sums.stated[0], sums.before[0], sums.sampled[1],
               sums.stated[1], sums.before[1]);
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
