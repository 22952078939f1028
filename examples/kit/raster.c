/* SPDX-License-Identifier: MIT */
/* A small independent implementation that takes part in the conformance kit: it draws, tests
   depths, shades and sums, as a GPU would. It is written from the kit's README.md alone and uses
   nothing of lrcs.

     lrcs vectors kit
     cc -O2 -o raster examples/kit/raster.c -lm
     ./raster kit 512 >theirs.csv
     lrcs compare kit theirs.csv --pixels 512

   raster KIT N [MISTAKE] [items=DIR]: N x N pixels, 0: no raster, whole facets (tiers 1 and 2).
   With a MISTAKE it is wrong on purpose, so that lrcs compare can be tested:
     shadows backs hand mirror winding farthest frame degrees tan radians 4pi cos pixel colour glint
     depth fight float
   and several at once, shadows+cos. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI   3.14159265358979323846
#define MOST 65536 /* vertices or facets */
#define NONE UINT32_MAX

typedef struct material {
    char name[32];
    double A, B, s, m;
    int two_sided;
} material;

static material materials[64];
static int material_count;
static double vertex[MOST][3], seen[MOST][3]; /* body frame; observation frame */
static int facet[MOST][3], assigned[MOST];
static int vertex_count, facet_count;
static const char *mistake = "none";

static const char *const mistakes[] = {"none",    "shadows",  "backs", "hand",    "mirror",
                                       "winding", "farthest", "frame", "degrees", "tan",
                                       "radians", "4pi",      "cos",   "pixel",   "colour",
                                       "glint",   "depth",    "fight", "float"};

/* Is every word between the '+' a mistake? */
static int are_mistakes(const char *words)
{
    size_t known = 0, count = sizeof mistakes / sizeof mistakes[0];
    size_t length = strcspn(words, "+");
    while (known < count &&
           (strlen(mistakes[known]) != length || strncmp(mistakes[known], words, length) != 0)) {
        known++;
    }
    return known < count && (words[length] == '\0' || are_mistakes(words + length + 1));
}

static int is(const char *name)
{
    return strstr(mistake, name) != NULL;
}

/* Rounds a number to the precision in which the code works. */
static double keep(double x)
{
    return is("float") ? (double)(float)x : x;
}

static FILE *open_file(const char *folder, const char *name, const char *ending)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s%s", folder, name, ending);
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(1);
    }
    return file;
}

static void read_materials(const char *kit)
{
    char line[512];
    FILE *file = open_file(kit, "materials", ".csv");
    while (material_count < 64 && fgets(line, sizeof line, file)) {
        material *m = &materials[material_count];
        material_count += sscanf(line, "%31[^,],%lf,%lf,%lf,%lf,%d", m->name, &m->A, &m->B, &m->s,
                                 &m->m, &m->two_sided) == 6;
    }
    fclose(file);
}

static int find_material(const char *name)
{
    int i = 0;
    while (i < material_count - 1 && strcmp(materials[i].name, name) != 0) {
        i++;
    }
    return i;
}

static void read_scene(const char *kit, const char *name)
{
    char line[512];
    char word[64];
    int wear = 0;
    FILE *file = open_file(kit, name, ".obj");
    vertex_count = facet_count = 0;
    while (vertex_count < MOST && facet_count < MOST && fgets(line, sizeof line, file)) {
        double *v = vertex[vertex_count];
        int *f = facet[facet_count];
        if (sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]) == 3) {
            v[1] = is("mirror") ? -v[1] : v[1];
            vertex_count++;
        } else if (sscanf(line, "usemtl %63s", word) == 1) {
            wear = find_material(word);
        } else if (sscanf(line, "f %d %d %d", &f[0], &f[1], &f[2]) == 3) {
            assigned[facet_count++] = wear;
        }
    }
    fclose(file);
}

/* The attitude as a matrix, body to observation; its last row is s_hat. */
static void make_attitude(const double q[4], const double azel[2], double R[3][3])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    const double M[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                            {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                            {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            R[i][k] = keep(is("frame") ? M[k][i] : M[i][k]);
        }
        R[i][0] = is("hand") ? -R[i][0] : R[i][0];
    }
    if (is("radians")) { /* should be pi / 180 times these */
        double a = azel[0], e = azel[1];
        const double A[3][3] = {{-sin(a), cos(a), 0},
                                {-sin(e) * cos(a), -sin(e) * sin(a), cos(e)},
                                {cos(e) * cos(a), cos(e) * sin(a), sin(e)}};
        memcpy(R, A, sizeof A);
    }
}

/* f_r cos theta, 1/sr: what a fragment shader would write. */
static double shade(const material *m, double c)
{
    c = m->two_sided || is("backs") ? fabs(c) : c;
    if (c <= 0) {
        return 0;
    }
    double used = is("degrees") ? cos(acos(fmin(c, 1)) * 180 / PI) : c;
    if (is("glint")) {
        used = cos(floor(acos(fmin(c, 1)) * 36 / PI + 0.5) * PI / 36); /* steps of 5 deg */
    }
    double t2 = keep(1 / (used * used) - 1);
    if (is("tan")) {
        t2 = tan(acos(fmin(c, 1)) * 180 / PI) * tan(acos(fmin(c, 1)) * 180 / PI);
    }
    double f = keep(m->A * exp(-t2 / (m->s * m->s)) / pow(used, 6)) + keep(m->B * pow(used, m->m));
    f = used > 0 ? f : 0;
    f = is("cos") ? f : keep(f * c);
    return is("colour") ? floor(255 * fmin(f, 1) + 0.5) / 255 : f;
}

/* Twice the signed area of a, b, p in the view plane. */
static double turn(const double *a, const double *b, const double *p)
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

static double cosine(int i, const double s[3], double *area)
{
    const double *a = vertex[facet[i][0] - 1], *b = vertex[facet[i][1] - 1],
                 *c = vertex[facet[i][2] - 1];
    double n[3], length = 0, dot = 0;
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        n[k] = keep((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
        length += n[k] * n[k];
    }
    length = keep(sqrt(length));
    for (int k = 0; k < 3; k++) {
        dot += keep(n[k] / length * s[k]);
    }
    *area = keep(length / 2);
    return keep(is("winding") ? -dot : dot);
}

static double of3(double (*best)(double, double), const double *a, const double *b, const double *c,
                  int k)
{
    return best(a[k], best(b[k], c[k]));
}

/* Draws a facet over the pixels whose centres it covers; returns their number. A pixel gets the
   facet only if this is nearer by more than rounding errors: of coincident facets the one that was
   drawn first stays. */
static long draw(int i, const double window[3], int N, double *depth, uint32_t *item)
{
    const double *a = seen[facet[i][0] - 1];
    const double *b = seen[facet[i][1] - 1];
    const double *c = seen[facet[i][2] - 1];
    double step = window[2] / N, whole = turn(a, b, c);
    int x0 = (int)fmax((of3(fmin, a, b, c, 0) - window[0]) / step - 1, 0);
    int x1 = (int)fmin((of3(fmax, a, b, c, 0) - window[0]) / step + 1, N - 1);
    int y0 = (int)fmax((window[1] - of3(fmax, a, b, c, 1)) / step - 1, 0);
    int y1 = (int)fmin((window[1] - of3(fmin, a, b, c, 1)) / step + 1, N - 1);
    long count = 0;
    for (int y = y0; whole != 0 && y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            double p[2] = {window[0] + (x + 0.5) * step, window[1] - (y + 0.5) * step};
            double u = turn(b, c, p) / whole, v = turn(c, a, p) / whole, w = turn(a, b, p) / whole;
            if (u < 0 || v < 0 || w < 0) {
                continue;
            }
            double z = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
            z = is("depth") ? floor(z / (2 * window[2]) * 65536) * window[2] / 32768 : keep(z);
            z = is("farthest") ? -z : z;
            size_t at = (size_t)y * (size_t)N + (size_t)x;
            count++;
            if (z > depth[at] + (is("fight") ? 0 : 1e-14 * window[2])) {
                depth[at] = z;
                item[at] = (uint32_t)i;
            }
        }
    }
    return count;
}

/* The square that is drawn: the longer side of what is seen, centred. */
static void make_window(double window[3])
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < vertex_count; i++) {
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], seen[i][k]);
            high[k] = fmax(high[k], seen[i][k]);
        }
    }
    window[2] = fmax(high[0] - low[0], high[1] - low[1]);
    window[0] = (low[0] + high[0] - window[2]) / 2; /* left */
    window[1] = (low[1] + high[1] + window[2]) / 2; /* top */
}

/* sigma by pixels: fronts are drawn first, so that they have precedence over backs in the same
   place. */
static double sigma_raster(const double s[3], int N, double *depth, uint32_t *item)
{
    double window[3];
    make_window(window);
    double side = is("pixel") ? window[2] / (N - 1) : window[2] / N;
    double sum = 0, area;
    static double value[MOST]; /* f_r cos theta of each facet */
    for (size_t at = 0; at < (size_t)N * (size_t)N; at++) {
        depth[at] = -HUGE_VAL;
        item[at] = NONE;
    }
    for (int backs = 0; backs < 2; backs++) {
        for (int i = 0; i < facet_count; i++) {
            double c = cosine(i, s, &area);
            if ((c <= 0) == backs) {
                long count = draw(i, window, N, depth, item);
                value[i] = shade(&materials[assigned[i]], c);
                sum += is("shadows") ? (double)count * value[i] : 0;
            }
        }
    }
    for (size_t at = 0; at < (size_t)N * (size_t)N && !is("shadows"); at++) {
        if (item[at] != NONE) {
            sum = keep(sum + value[item[at]]);
        }
    }
    return sum * side * side;
}

/* sigma by facets, of bodies that do not shadow themselves: projected area is area times cos. */
static double sigma_facets(const double s[3])
{
    double sum = 0, area;
    for (int i = 0; i < facet_count; i++) {
        double c = cosine(i, s, &area);
        sum = keep(sum + keep(shade(&materials[assigned[i]], c) * area * fabs(c)));
    }
    return sum;
}

static void write_item(const char *folder, const char *scene, const char *attitude, int N,
                       const uint32_t *item)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.%s.item.u32", folder, scene, attitude);
    FILE *file = fopen(path, "wb");
    for (size_t at = 0; file && at < (size_t)N * (size_t)N; at++) {
        for (int k = 0; k < 32; k += 8) {
            putc((int)(item[at] >> k & 255), file);
        }
    }
    if (!file || fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}

int main(int count, char **word)
{
    char line[2048], scene[32], attitude[32], path[64];
    int tier, N = count > 2 ? atoi(word[2]) : -1, images;
    double q[4], azel[2], R[3][3];
    if (N < 0 || N > 8192) {
        fprintf(stderr, "usage: raster KIT N [MISTAKE] [items=DIR]\n");
        return 2;
    }
    const char *items = strncmp(word[count - 1], "items=", 6) == 0 ? word[count - 1] + 6 : NULL;
    mistake = count > 3 && (!items || count > 4) ? word[3] : "none";
    if (!are_mistakes(mistake)) {
        fprintf(stderr, "raster: no mistake of mine is called %s; these are:", mistake);
        for (size_t i = 0; i < sizeof mistakes / sizeof mistakes[0]; i++) {
            fprintf(stderr, " %s", mistakes[i]);
        }
        fputc('\n', stderr);
        return 2;
    }
    double *depth = malloc(((size_t)N * (size_t)N + 1) * sizeof *depth);
    uint32_t *item = malloc(((size_t)N * (size_t)N + 1) * sizeof *item);
    FILE *cases = open_file(word[1], "cases", ".csv");
    read_materials(word[1]);
    puts("scene,attitude,sigma_m2");
    while (depth && item && fgets(line, sizeof line, cases)) {
        if (sscanf(line,
                   "%31[^,],%31[^,],%d,%lf,%lf,%lf,%lf,%*f,%*f,%*f,%lf,%lf,%*f,%*f,%*f,%*f,%*f,"
                   "%*f,%*f,%*f,%*f,%*f,%d",
                   scene, attitude, &tier, &q[0], &q[1], &q[2], &q[3], &azel[0], &azel[1],
                   &images) != 10 ||
            (N == 0 && tier > 2)) {
            continue; /* the names of the columns, or not for us */
        }
        snprintf(path, sizeof path, "scenes/%s", scene);
        read_scene(word[1], path);
        make_attitude(q, azel, R);
        for (int i = 0; i < vertex_count; i++) {
            for (int k = 0; k < 3; k++) {
                const double *v = vertex[i];
                seen[i][k] = keep(R[k][0] * v[0] + R[k][1] * v[1] + R[k][2] * v[2]);
            }
        }
        double sigma = N > 0 ? sigma_raster(R[2], N, depth, item) : sigma_facets(R[2]);
        printf("%s,%s,%.17g\n", scene, attitude, sigma * (is("4pi") ? 1 : 4 * PI));
        if (items && images == N) {
            write_item(items, scene, attitude, N, item);
        }
    }
    fclose(cases);
    free(depth);
    free(item);
    return 0;
}
