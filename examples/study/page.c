/* SPDX-License-Identifier: MIT */
/* The study as a page: what is asked, the laws, plots and tables, and how the numbers were made. It
   decides the words and their order; numbers come from tables and laws. */
#include "study.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))

/* ---- what is asked ---- */

static const char page_head[] =
    "# What the laser radar cross-section of simple bodies depends on\n"
    "\n"
    "Written by `make study`. It asks the questions of Y. Han et al., *Analysis of influential "
    "factors on a space\n"
    "target's laser radar cross-section*, Opt. Laser Technol. 56 (2014) 151-157, doi\n"
    "10.1016/j.optlastec.2013.08.007: how the shape, size and surface of a cube, a cylinder and a "
    "cone, purely diffuse,\n"
    "purely specular or mixed, influence the monostatic cross-section sigma. The questions are the "
    "paper's; dimensions,\n"
    "materials and numbers are this study's own, and a disc and a sphere stand beside the three "
    "bodies where a law needs\n"
    "them.\n"
    "\n"
    "## What is computed\n"
    "\n"
    "    sigma = 4 pi * integral of f_r(theta) cos^2(theta) dA over the lit surface             "
    "m^2\n"
    "    f_r(theta) = A / cos^6(theta) exp(-tan^2(theta) / s^2) + B cos^m(theta)                "
    "1/sr\n"
    "\n"
    "with theta the angle between the surface's normal and the line of sight; A and B are the "
    "glint and diffuse amplitudes, s\n"
    "the rms surface slope, m the diffusivity. The model is incoherent and in the far field: no "
    "speckle, interreflection,\n"
    "polarisation or diffraction. dBsm is 10 log10(sigma / 1 m²).\n"
    "\n";

static void page_surfaces(const study_job *job, FILE *out)
{
    const lrcs_brdf *brdf = &job->brdf;
    fprintf(out,
            "| surface | A (1/sr) | B (1/sr) | s | m |\n|---|---|---|---|---|\n"
            "| purely diffuse | 0 | %.5g | - | %.5g |\n| purely specular | %.5g | 0 | %.5g | - |\n"
            "| mixed | %.5g | %.5g | %.5g | %.5g |\n\n",
            brdf->B, brdf->m, brdf->A, brdf->s, brdf->A, brdf->B, brdf->s, brdf->m);
}

static void dimensions_row(const char *name, const lrcs_shape *shape, FILE *out)
{
    fprintf(out, "| %s |", name);
    if (shape->kind == LRCS_SHAPE_BOX) {
        fprintf(out, " side %.5g |\n", shape->size[0]);
    } else if (shape->kind == LRCS_SHAPE_CONE) {
        double height = shape->radius / tan(shape->half_angle_deg * LRCS_PI / 180.0);
        fprintf(out, " base radius %.5g, height %.5g, half-angle %g deg |\n", shape->radius, height,
                shape->half_angle_deg);
    } else if (shape->kind == LRCS_SHAPE_CYLINDER && shape->length > 0.0) {
        fprintf(out, " radius %.5g, length %.5g |\n", shape->radius, shape->length);
    } else {
        fprintf(out, " radius %.5g%s |\n", shape->radius,
                shape->kind == LRCS_SHAPE_CYLINDER ? ", both faces" : "");
    }
}

static void page_bodies(FILE *out)
{
    fputs("Closed bodies seen from outside. The aspect is the angle between the line of sight and "
          "the axis: 0 deg is\n"
          "face-on for disc and cube, end-on for the cylinder, nose-on for the cone, whose base is "
          "seen face-on at 180 deg;\n"
          "the cube turns about one of its edges' directions. Lengths in m.\n"
          "\n"
          "| body | equal surface, 6 m² |\n|---|---|\n",
          out);
    for (int kind = 0; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_body(kind);
        dimensions_row(study_name(kind), &shape, out);
    }
    fputs("\n| body | equal projected area, 1 m² at 90 deg |\n|---|---|\n", out);
    for (int kind = STUDY_CUBE; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_silhouette(kind);
        dimensions_row(study_name(kind), &shape, out);
    }
    fputc('\n', out);
}

/* ---- laws ---- */

static void page_law(const study_law *law, uint32_t number, FILE *out)
{
    char limits[64];
    study_limits(law, limits);
    fprintf(out, "### %lu. %c%s: %s\n\n%s\n\n*Range:* %s\n\n", (unsigned long)number,
            law->name[0] >= 'a' ? law->name[0] - 'a' + 'A' : law->name[0], law->name + 1,
            study_holds(law) ? "holds" : "not supported", law->text, law->range);
    fprintf(out, "*Support:* %s, to be %s. Of %d comparison%s the closest to its limits gave %.9g",
            law->quantity, limits, law->checks, law->checks == 1 ? "" : "s", law->worst.value);
    if (law->worst.bound > 0.0) {
        fprintf(out, ", %s %.1e", law->estimate ? "error estimated at" : "bound", law->worst.bound);
    }
    fputs(".\n\n", out);
}

static void page_laws(const study_job *job, FILE *out)
{
    fprintf(
        out,
        "## General laws\n"
        "\n"
        "Each law is a set of comparisons between values of sigma computed in this run. It holds "
        "where every one of them is\n"
        "true for all values that the bounds allow; *= 1* means equal to within the bound, itself "
        "below 1e-9. %lu of "
        "%lu hold.\n"
        "\n",
        (unsigned long)study_held(job), (unsigned long)job->laws);
    for (uint32_t i = 0; i < job->laws; i++) {
        page_law(&job->law[i], i + 1, out);
    }
}

/* ---- plots and tables ---- */

/* Rounded up: a tenth more is no less in two digits. */
static void page_source(const study_table *table, FILE *out)
{
    fprintf(out, "*%s: [%s.csv](%s.csv); %s at most %.1e of the value", table->maker, table->stem,
            table->stem, table->estimate ? "error estimated at" : "bound", 1.1 * table->relative);
    if (table->floor > 0.0) {
        fprintf(out, " where that is above %g dBsm", study_dbsm(table->floor));
    }
    fputs(".*\n\n", out);
}

static void page_figure(const study_table *table, FILE *out)
{
    fprintf(out, "![%s](%s.svg)\n\n", table->title, table->stem);
    if (table->polar) {
        fprintf(out, "![%s, polar](%s-polar.svg)\n\n", table->title, table->stem);
    }
    page_source(table, out);
}

static void page_table(const study_table *table, FILE *out)
{
    fprintf(out, "%s:\n\n| %s |", table->title, table->x_name ? table->x_name : table->x_id);
    for (uint32_t c = 0; c < table->columns; c++) {
        fprintf(out, " %s |", table->column[c].name);
    }
    fputs("\n|---|", out);
    for (uint32_t c = 0; c < table->columns; c++) {
        fputs("---:|", out);
    }
    for (uint32_t r = 0; r < table->rows; r++) {
        if (table->row_name[r]) {
            fprintf(out, "\n| %s |", table->row_name[r]);
        } else {
            fprintf(out, "\n| %g |", table->x[r]);
        }
        for (uint32_t c = 0; c < table->columns; c++) {
            fprintf(out, " %.5g |", table->column[c].value[r]);
        }
    }
    fputs("\n\n", out);
    page_source(table, out);
}

/* A section: what to see, then its plots and tables. */
typedef struct page_section {
    const char *text;
    const char *stem[4];
} page_section;

static const page_section page_sections[] = {
    {"## Attitude and shape at equal surface\n"
     "\n"
     "Diffuse bodies turn with little change; a cone seen nose-on is the exception, since all of "
     "its wall is tilted. Specular\n"
     "bodies show a spike wherever a flat face is seen along its normal (disc 0 and 180 deg, cube "
     "0, 90 and 180, cylinder's\n"
     "ends 0 and 180, cone's base 180) and a lower, wider band where a curved wall is (cylinder "
     "90, "
     "cone 60 deg); between\n"
     "these nothing returns but the far flanks. On a mixed surface the glints stand on the diffuse "
     "floor.\n"
     "\n",
     {"attitude-diffuse", "attitude-glint", "attitude-mixed", "equal-surface"}},
    {"## Kind of surface\n"
     "\n"
     "The same bodies, each with the three kinds of surface: the mixed curve is the sum of the "
     "other "
     "two.\n"
     "\n",
     {"surface-cube", "surface-cylinder", "surface-cone"}},
    {"## Shape at equal projected area\n\n", {"equal-projected-area"}},
    {"## Size\n\n", {"size"}},
    {"## A and B\n"
     "\n"
     "A cylinder: its end is seen along its normal at 0 deg, its wall at 90. A lifts the glints "
     "alone, B the floor between.\n"
     "\n",
     {"influence-A", "influence-B"}},
    {"## s\n"
     "\n"
     "The end's spike keeps its height and widens; the wall's band widens and rises.\n"
     "\n",
     {"influence-s", "glint-peak", "glint-widening", "glint-width"}},
    {"## m\n\n", {"influence-m", "diffuse-m", "diffuse-width"}},
    {"## Means over all attitudes\n\n", {"attitude-mean", "glint-share"}},
    {"## The engine beside the closed forms\n\n", {"engine"}}};

static const char page_end[] =
    "## How to trust it\n"
    "\n"
    "Closed forms are those of `lrcs shape`, each value with a proved bound; laws carry these "
    "bounds "
    "through ratios and sums,\n"
    "rounding included. Half-power angles lie between two angles that enclose one for certain. "
    "Means "
    "over attitudes are\n"
    "Gauss-Legendre quadratures, of closed forms or, for the scene with shadows, of runs of the "
    "engine; their error is\n"
    "estimated from half as many panels, which is no bound. The material is an example, not a "
    "measured one. The laws are about\n"
    "this model; whether a paint follows it is outside every bound.\n";

void study_page(const study_job *job, FILE *out)
{
    fputs(page_head, out);
    page_surfaces(job, out);
    page_bodies(out);
    page_laws(job, out);
    for (size_t i = 0; i < COUNT_OF(page_sections); i++) {
        fputs(page_sections[i].text, out);
        for (int k = 0; k < 4 && page_sections[i].stem[k]; k++) {
            const study_table *table = study_find(job, page_sections[i].stem[k]);
            if (table->chart != STUDY_NO_CHART) {
                page_figure(table, out);
            } else {
                page_table(table, out);
            }
        }
    }
    fputs(page_end, out);
}
