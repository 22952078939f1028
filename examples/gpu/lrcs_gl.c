/* SPDX-License-Identifier: MIT */
/* The paper's method on a GPU: draw the facets, let the depth test decide what is seen, shade every
   pixel with f_r cos(theta), add the pixels up. It takes part in the conformance kit:

     cc -O2 lrcs_gl.c gl.c kit.c -o lrcs_gl -lEGL -lm      (Debian: libegl-dev, libgl1-mesa-dri)
     lrcs vectors kit
     ./lrcs_gl kit > gl.csv
     lrcs compare kit gl.csv

   usage: lrcs_gl KIT [N [FACETS.csv]]
   N x N pixels, 512 if not given; sigma of every case on stdout, the visible area of every facet in
   FACETS.csv. Exit 77 if there is no OpenGL 3.3. The method is in the two shaders,
   in draw and in sigma_of; nothing of lrcs is linked. */
#include "gl.h"
#include "kit.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define NO_FACET 0xffffffffu
#define FOUR_PI  12.566370614359172954

/* A corner as it is uploaded. Every corner of a facet has the facet's own normal and material. */
typedef struct corner {
    float place[3]; /* about the scene's centre, in units of its reach */
    float normal[3];
    float brdf[4]; /* A, B, s, m */
    float two_sided;
} corner;

static const char vertex_shader[] =
    "#version 330 core\n"
    "layout(location = 0) in vec3 place;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec4 brdf_in;\n"
    "layout(location = 3) in float two_sided_in;\n"
    "uniform mat3 turn;\n"  /* body to observation frame: z to the laser */
    "uniform vec3 scale;\n" /* to the clip cube: the raster's square, near and far */
    "uniform vec3 move;\n"
    "flat out vec3 n;\n"
    "flat out vec4 brdf;\n"
    "flat out float two_sided;\n"
    "void main()\n"
    "{\n"
    "    gl_Position = vec4(scale * (turn * place) + move, 1.0);\n"
    "    n = turn * normal;\n"
    "    brdf = brdf_in;\n"
    "    two_sided = two_sided_in;\n"
    "}\n";

/* The tangent comes from the normal's components: 1 / c^2 - 1 would lose a narrow glint to
   cancellation. Beyond x = 9 the glint is 0 in float, and must not become 0 / 0. */
static const char fragment_shader[] =
    "#version 330 core\n"
    "flat in vec3 n;\n"
    "flat in vec4 brdf;\n"
    "flat in float two_sided;\n"
    "layout(location = 0) out uint item;\n"
    "layout(location = 1) out float shade;\n"
    "void main()\n"
    "{\n"
    "    float c = n.z / length(n);\n"
    "    c = two_sided > 0.0 ? abs(c) : c;\n"
    "    item = uint(gl_PrimitiveID);\n"
    "    shade = 0.0;\n"
    "    if (c > 0.0) {\n"
    "        float x = length(n.xy) / (abs(n.z) * brdf.z);\n"
    "        float glint = x < 9.0 ? brdf.x * exp(-x * x) / (c * c * c * c * c) : 0.0;\n"
    "        shade = glint + brdf.y * pow(c, brdf.w) * c;\n"
    "    }\n"
    "}\n";

/* --- corners ---------------------------------------------------------------------------------- */

static void fail(const char *what)
{
    fprintf(stderr, "lrcs_gl: %s\n", what);
    exit(1);
}

static void layout_make(void)
{
    static const struct {
        GLint count;
        size_t offset;
    } part[4] = {{3, offsetof(corner, place)},
                 {3, offsetof(corner, normal)},
                 {4, offsetof(corner, brdf)},
                 {1, offsetof(corner, two_sided)}};
    GLuint array;
    GLuint buffer;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    for (GLuint i = 0; i < 4; i++) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, part[i].count, GL_FLOAT, GL_FALSE, sizeof(corner),
                              (const void *)part[i].offset);
    }
}

/* The position of the scene. The centre of its box is subtracted in double precision before
   anything is rounded to float, so that a scene far from the origin loses no accuracy. */
typedef struct body {
    double centre[3], reach;
} body;

static body body_make(const kit *k)
{
    body b = {.reach = 0};
    for (int j = 0; j < 3; j++) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (int f = 0; f < k->facets; f++) {
            for (int i = 0; i < 3; i++) {
                low = fmin(low, k->facet[f].corner[i][j]);
                high = fmax(high, k->facet[f].corner[i][j]);
            }
        }
        b.centre[j] = 0.5 * (low + high);
        b.reach = fmax(b.reach, 0.5 * (high - low));
    }
    return b;
}

static void facet_normal(const kit_facet *f, float out[3])
{
    double n[3];
    for (int j = 0; j < 3; j++) {
        int k = (j + 1) % 3;
        int l = (j + 2) % 3;
        n[j] = (f->corner[1][k] - f->corner[0][k]) * (f->corner[2][l] - f->corner[0][l]) -
               (f->corner[1][l] - f->corner[0][l]) * (f->corner[2][k] - f->corner[0][k]);
    }
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int j = 0; j < 3; j++) {
        out[j] = (float)(n[j] / length);
    }
}

static void scene_upload(const kit *k, const body *b)
{
    corner *all = calloc((size_t)k->facets * 3, sizeof *all);
    if (!all) {
        fail("out of memory");
    }
    for (int i = 0; i < 3 * k->facets; i++) {
        const kit_facet *f = &k->facet[i / 3];
        const kit_material *m = f->material;
        for (int j = 0; j < 3; j++) {
            all[i].place[j] = (float)((f->corner[i % 3][j] - b->centre[j]) / b->reach);
        }
        facet_normal(f, all[i].normal);
        all[i].brdf[0] = (float)m->A;
        all[i].brdf[1] = (float)m->B;
        all[i].brdf[2] = m->A > 0 ? (float)m->s : 1.0f; /* no glint, no slope to divide by */
        all[i].brdf[3] = (float)m->m;
        all[i].two_sided = m->two_sided ? 1.0f : 0.0f;
    }
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(sizeof *all * 3 * (size_t)k->facets), all,
                 GL_STATIC_DRAW);
    free(all);
}

/* --- one case --------------------------------------------------------------------------------- */

static void rotation(const double q[4], double R[3][3])
{
    double w = q[0];
    double x = q[1];
    double y = q[2];
    double z = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(R, rows, sizeof rows);
}

/* The near and far ends of the scene, about its centre. */
static void depth_range(const kit *k, const body *b, const double axis[3], double *far,
                        double *near)
{
    *far = HUGE_VAL;
    *near = -HUGE_VAL;
    for (int i = 0; i < 3 * k->facets; i++) {
        const double *p = k->facet[i / 3].corner[i % 3];
        double z = 0;
        for (int j = 0; j < 3; j++) {
            z += axis[j] * (p[j] - b->centre[j]);
        }
        *far = fmin(*far, z);
        *near = fmax(*near, z);
    }
}

/* The square of the case fills the raster; in depth there is a small margin at both ends. */
static void pose_upload(const kit *k, const kit_case *c, const body *b, GLuint program)
{
    double R[3][3];
    double far;
    double near;
    rotation(c->quaternion, R);
    depth_range(k, b, R[2], &far, &near);
    const double middle[3] = {c->left + 0.5 * c->side, c->top - 0.5 * c->side, 0};
    const double half[3] = {0.5 * c->side, 0.5 * c->side, -(0.5 * (near - far) + c->side / 128)};
    float turn[9];
    float scale[3];
    float move[3];
    for (int i = 0; i < 3; i++) {
        double at = -middle[i];
        for (int j = 0; j < 3; j++) {
            turn[3 * i + j] = (float)R[i][j];
            at += R[i][j] * b->centre[j];
        }
        scale[i] = (float)(b->reach / half[i]);
        move[i] = (float)((i == 2 ? -0.5 * (near + far) : at) / half[i]);
    }
    glUniformMatrix3fv(glGetUniformLocation(program, "turn"), 1, GL_TRUE, turn);
    glUniform3fv(glGetUniformLocation(program, "scale"), 1, scale);
    glUniform3fv(glGetUniformLocation(program, "move"), 1, move);
}

/* Backs hide what is behind them too; but a front in the same plane is seen instead of a back
   (panels often consist of two faces in one place). Therefore fronts are drawn first, and backs
   slightly behind their true position: rounding makes the depths of two triangles in one plane
   differ. */
static void draw(int facets)
{
    static const GLuint nobody[4] = {NO_FACET, 0, 0, 0};
    static const GLfloat dark[4] = {0, 0, 0, 0};
    static const GLfloat far = 1;
    glClearBufferuiv(GL_COLOR, 0, nobody);
    glClearBufferfv(GL_COLOR, 1, dark);
    glClearBufferfv(GL_DEPTH, 0, &far);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glDrawArrays(GL_TRIANGLES, 0, 3 * facets);
    glCullFace(GL_FRONT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1, 4);
    glDrawArrays(GL_TRIANGLES, 0, 3 * facets);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

/* What was drawn of a case. */
typedef struct pixels {
    GLsizei size;
    double area; /* of a pixel, m2 */
    uint32_t *item;
    float *shade;
} pixels;

static void read_back(pixels *p, const kit_case *c)
{
    p->area = (c->side / p->size) * (c->side / p->size);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, p->size, p->size, GL_RED_INTEGER, GL_UNSIGNED_INT, p->item);
    glReadBuffer(GL_COLOR_ATTACHMENT1);
    glReadPixels(0, 0, p->size, p->size, GL_RED, GL_FLOAT, p->shade);
}

/* sigma = 4 pi sum f_r cos(theta) * area of a pixel. The sum is a double: a float to which a
   million pixels are added one by one would lose far more accuracy than all other steps. */
static double sigma_of(const pixels *p)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)p->size * (size_t)p->size; i++) {
        sum += (double)p->shade[i];
    }
    return FOUR_PI * sum * p->area;
}

/* The item buffer, counted. */
static void facets_print(FILE *out, const pixels *p, const kit_case *c, int facets)
{
    uint32_t *count = calloc((size_t)facets + 1, sizeof *count);
    if (!count) {
        fail("out of memory");
    }
    for (size_t i = 0; i < (size_t)p->size * (size_t)p->size; i++) {
        count[p->item[i] < (uint32_t)facets ? p->item[i] : (uint32_t)facets]++;
    }
    for (int f = 0; f < facets; f++) {
        if (count[f] > 0) {
            fprintf(out, "%s,%s,%d,%.9g\n", c->scene, c->attitude, f, count[f] * p->area);
        }
    }
    free(count);
}

static void run(kit *k, pixels *p, FILE *facets)
{
    GLuint program = gl_program(vertex_shader, fragment_shader);
    body b = {.reach = 0};
    if (!program || !gl_target(p->size)) {
        fail("no program, or no buffers of this size and format");
    }
    glUseProgram(program);
    layout_make();
    printf("scene,attitude,sigma_m2\n");
    for (int i = 0; i < k->case_count; i++) {
        const kit_case *c = &k->cases[i];
        if (strcmp(k->scene, c->scene) != 0) {
            kit_scene(k, c->scene);
            b = body_make(k);
            scene_upload(k, &b);
        }
        pose_upload(k, c, &b, program);
        draw(k->facets);
        read_back(p, c);
        printf("%s,%s,%.9g\n", c->scene, c->attitude, sigma_of(p));
        if (facets) {
            facets_print(facets, p, c, k->facets);
        }
    }
}

int main(int count, char **word)
{
    pixels p = {.size = count > 2 ? atoi(word[2]) : 512};
    if (count < 2 || count > 4 || p.size < 1) {
        fail("usage: lrcs_gl KIT [N [FACETS.csv]]");
    }
    kit k = kit_read(word[1]);
    if (!gl_start()) {
        fprintf(stderr, "lrcs_gl: no OpenGL 3.3 to draw with\n");
        return 77;
    }
    fprintf(stderr, "lrcs_gl: %s\n", (const char *)glGetString(GL_RENDERER));
    p.item = malloc((size_t)p.size * (size_t)p.size * sizeof *p.item);
    p.shade = malloc((size_t)p.size * (size_t)p.size * sizeof *p.shade);
    FILE *facets = count > 3 ? fopen(word[3], "w") : NULL;
    if (!p.item || !p.shade || (count > 3 && !facets)) {
        fail("no memory, or no file");
    }
    if (facets) {
        fprintf(facets, "scene,attitude,facet,visible_area_m2\n");
    }
    run(&k, &p, facets);
    if (glGetError() != GL_NO_ERROR || (facets && fclose(facets) != 0)) {
        fail("OpenGL or the disk reports an error");
    }
    free(p.item);
    free(p.shade);
    free(k.cases);
    free(k.facet);
    return 0;
}
