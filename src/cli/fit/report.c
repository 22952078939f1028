/* SPDX-License-Identifier: MIT */
/* The output of lrcs fit in numbers and words: the table with a material line to copy, JSON, and
   CSV of the residuals. */
#include "cli/fit/fit.h"

#include <math.h>
#include <string.h>

#define REPORT_LINES_MOST 12u /* number of outliers listed in the table */

/* Beyond this correlation, parameters can compensate for each other. */
#define REPORT_TRADE 0.95

static const char *const report_name[LRCS_FIT_PARAMETERS] = {"A", "B", "s", "m"};

typedef struct report_statement {
    char text[256];
} report_statement;

int cli_fit_undetermined(const lrcs_fit *fit)
{
    int open = 0;
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        open += fit->parameter[p].verdict != LRCS_FIT_DETERMINED;
    }
    return open;
}

/* The sentence of the verdict; if readings do not reach far enough, it states how far they
   reach. */
static report_statement statement_make(const lrcs_fit *fit, int parameter)
{
    report_statement statement = {""};
    int verdict = fit->parameter[parameter].verdict;
    int reach =
        verdict == LRCS_FIT_AT_MOST || verdict == LRCS_FIT_AT_LEAST || verdict == LRCS_FIT_FREE;
    lrcs_host_append(statement.text, sizeof statement.text, "%s",
                     lrcs_fit_verdict_text(parameter, verdict));
    if (reach) {
        lrcs_host_append(statement.text, sizeof statement.text, " (readings from %.4g to %.4g deg)",
                         fit->least_deg, fit->most_deg);
    }
    return statement;
}

/* ---- the table ---- */

/* Prints a number right-aligned, or a word if there is no number. */
static void cell_print(double value, int width, const char *none)
{
    if (value < HUGE_VAL) {
        printf("  %*.6g", width, value);
    } else {
        printf("  %*s", width, none);
    }
}

static void statements_print(const lrcs_fit *fit)
{
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        if (fit->parameter[p].verdict != LRCS_FIT_DETERMINED) {
            report_statement statement = statement_make(fit, p);
            printf("%s %s\n", report_name[p], statement.text);
        }
    }
    if (cli_fit_undetermined(fit) == 0) {
        printf("all four parameters are determined\n");
    }
    if (fit->angles < LRCS_FIT_PARAMETERS) {
        printf("only %lu different angles for four parameters\n", (unsigned long)fit->angles);
    }
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        for (int q = 0; q < p; q++) {
            if (fabs(fit->correlation[p][q]) > REPORT_TRADE) {
                printf("%s and %s trade against each other: correlation %.3f\n", report_name[q],
                       report_name[p], fit->correlation[p][q]);
            }
        }
    }
}

/* Prints a name between quotes, of a shell or a scene file; a character that would end them becomes
   '?'. */
static void name_print(const char *name, char quote)
{
    for (; *name; name++) {
        putchar(*name == quote || *name == '\\' ? '?' : CLI_PLAIN(*name));
    }
}

/* Below this share of a value its error is not passed on: the value has six digits. */
#define REPORT_ERROR_LEAST 5e-7

/* The standard error that is written for a scene file: 0 if there is none, as for a term left
   out. */
static double error_of(const lrcs_fit *fit, int p)
{
    const lrcs_fit_parameter *one = &fit->parameter[p];
    int known = one->error < HUGE_VAL && one->error > REPORT_ERROR_LEAST * one->value;
    return known && one->value > 0.0 ? one->error : 0.0;
}

static void material_print(const fit_material *material)
{
    const lrcs_fit *fit = &material->fit;
    const double value[] = {fit->brdf.A, fit->brdf.B, fit->brdf.s, fit->brdf.m};
    int stated = 0;
    printf("\n--material '");
    name_print(material->name, '\'');
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        printf("%s%.6g", p == 0 ? "=" : ",", value[p]);
        if (error_of(fit, p) > 0.0) {
            printf("+-%.3g", error_of(fit, p));
            stated++;
        }
    }
    printf("'\n\n[[material]]\nname = \"");
    name_print(material->name, '"');
    putchar('"');
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        printf("\n%s = %.6g", report_name[p], value[p]);
    }
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        if (error_of(fit, p) > 0.0) {
            printf("\n%s_error = %.3g", report_name[p], error_of(fit, p));
        }
    }
    for (int p = 0; p < LRCS_FIT_PARAMETERS && stated > 1; p++) {
        for (int q = p + 1; q < LRCS_FIT_PARAMETERS; q++) {
            int both = error_of(fit, p) > 0.0 && error_of(fit, q) > 0.0;
            printf("%s%.15g", p == 0 && q == 1 ? "\ncorrelation = [" : ", ",
                   both ? fit->correlation[p][q] : 0.0);
        }
    }
    printf("%s", stated > 1 ? "] # of AB, As, Am, Bs, Bm, sm\n" : "\n");
}

/* What was fitted: the readings with the lines of the outliers, the unit, the residuals. */
static void readings_print(const fit_job *job, const fit_material *material)
{
    const lrcs_fit *fit = &material->fit;
    const char *with = job->options.cosine ? " cos(theta)" : "";
    const char *why = job->noise_asked ? "as asked" : "the likelier one";
    uint32_t named = 0;
    uint32_t outliers = material->count - fit->kept;
    printf("readings   %lu from %.6g to %.6g deg, outliers set aside: %lu",
           (unsigned long)material->count, fit->least_deg, fit->most_deg, (unsigned long)outliers);
    for (uint32_t i = 0; i < material->count && named < REPORT_LINES_MOST; i++) {
        if (material->point[i].outlier) {
            printf("\n           line %lu: %.6g at %.6g deg", (unsigned long)material->line[i],
                   material->reading[i].value, material->reading[i].angle_deg);
            named++;
        }
    }
    printf("%s\n", named < outliers ? "\n           ..." : "");
    if (job->panel > 0.0) {
        printf("unit       relative to a Lambert panel of reflectance %.6g: f_r%s = %.6g value, "
               "1/sr\n",
               job->panel, with, job->options.unit);
    } else {
        printf("unit       value = f_r%s, 1/sr\n", with);
    }
    printf("residuals  rms %.4g 1/sr; noise model: ", fit->rms);
    switch (material->noise) {
    case LRCS_FIT_GIVEN:
        printf("given: reduced chi-square %.4g\n", fit->noise * fit->noise);
        break;
    case LRCS_FIT_WEIGHTED:
        printf("by weight\n");
        break;
    case LRCS_FIT_RELATIVE:
        printf("relative (%s), %.3g %% per reading\n", why, 100.0 * fit->noise);
        break;
    default:
        printf("the same for all (%s), %.4g 1/sr per reading\n", why, fit->noise);
    }
}

void cli_fit_table(const fit_job *job)
{
    for (uint32_t i = 0; i < job->materials; i++) {
        const fit_material *material = &job->material[i];
        printf("%smaterial   ", i ? "\n\n" : "");
        cli_column(material->name, 0);
        putchar('\n');
        readings_print(job, material);
        printf("\n%8s  %12s  %12s  %12s  %12s\n", "", "value", "std error", "low, 95 %",
               "high, 95 %");
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            const lrcs_fit_parameter *one = &material->fit.parameter[p];
            printf("%s %-6s", report_name[p], p < LRCS_FIT_S ? "1/sr" : "");
            cell_print(one->value, 12, "");
            cell_print(one->error, 12, "-");
            cell_print(one->low, 12, "");
            cell_print(one->high, 12, "no limit");
            putchar('\n');
        }
        putchar('\n');
        statements_print(&material->fit);
        material_print(material);
    }
}

/* ---- CSV ---- */

void cli_fit_csv(FILE *out, const void *context)
{
    const fit_job *job = context;
    fputs("material,line,angle_deg,value,fitted,residual,standard,outlier\n", out);
    for (uint32_t i = 0; i < job->materials; i++) {
        const fit_material *material = &job->material[i];
        for (uint32_t k = 0; k < material->count; k++) {
            const lrcs_fit_reading *reading = &material->reading[k];
            const lrcs_fit_point *point = &material->point[k];
            const double value[] = {reading->angle_deg, reading->value, point->fitted,
                                    point->residual, point->standard};
            lrcs_host_csv_text(out, material->name, ",;\"\r\n");
            fprintf(out, ",%lu", (unsigned long)material->line[k]);
            for (size_t c = 0; c < sizeof value / sizeof value[0]; c++) {
                lrcs_host_number_put(out, ",", value[c]);
            }
            fprintf(out, ",%d\n", point->outlier);
        }
    }
}

/* ---- JSON ---- */

static void material_json(const fit_material *material, lrcs_host_json *json)
{
    const lrcs_fit *fit = &material->fit;
    static const char *const noise[] = {"absolute", "relative", "given", "weighted"};
    int given = material->noise == LRCS_FIT_GIVEN;
    lrcs_host_json_put(json, "{\nmaterial=%s parameters={\n", material->name);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        const lrcs_fit_parameter *one = &fit->parameter[p];
        report_statement statement = statement_make(fit, p);
        lrcs_host_json_begin(json, report_name[p], LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_put(json, "value=%g std_error=%g low=%g high=%g determined=%d statement=%s}",
                           one->value, one->error, one->low, one->high,
                           one->verdict == LRCS_FIT_DETERMINED, statement.text);
    }
    lrcs_host_json_put(json, "} all_determined=%d correlation=[\n", cli_fit_undetermined(fit) == 0);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        lrcs_host_json_numbers(json, NULL, fit->correlation[p], LRCS_FIT_PARAMETERS);
    }
    lrcs_host_json_put(json, "] readings=%u kept=%u outlier_lines=[", material->count, fit->kept);
    for (uint32_t i = 0; i < material->count; i++) {
        if (material->point[i].outlier) {
            lrcs_host_json_count(json, NULL, material->line[i]);
        }
    }
    lrcs_host_json_put(
        json, "] least_deg=%g most_deg=%g rms_per_sr=%g errors=%s noise=%g reduced_chi2=%g}",
        fit->least_deg, fit->most_deg, fit->rms, noise[material->noise], fit->noise,
        given ? fit->noise * fit->noise : (double)NAN);
}

void cli_fit_json(const fit_job *job)
{
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_put(&json, "{\n");
    cli_version_json(&json);
    cli_operand_json(job->args, &json);
    lrcs_host_json_put(&json, "unit_per_sr=%g cosine=%d fits=[\n", job->options.unit,
                       job->options.cosine);
    for (uint32_t i = 0; i < job->materials; i++) {
        material_json(&job->material[i], &json);
    }
    lrcs_host_json_put(&json, "] notices=[\n");
    cli_notices_json(&job->readings.notices, &json);
    lrcs_host_json_put(&json, "]");
    cli_options_json(job->args, &json);
    lrcs_host_json_put(&json, "}");
}
