/* SPDX-License-Identifier: MIT */
/* Computes normals at the corners of facets from vertex normals and smoothing groups. It decides
   what the data of a file mean, and which facets are curved. It does not integrate over them.

   If the file gives a vertex normal for a corner, it is used. It is placed by the inverse transpose
   of the linear map, so that outward normals stay outward even if the map contains a reflection.
   Otherwise, if the facet is in a smoothing group, the corner gets the mean of the normals of all
   facets that share its vertex and one of its groups. Vertices are the same if their indices are;
   equal positions do not suffice. The normals are weighted with the facets' angles at the vertex,
   so that the mean does not depend on the triangulation of flat polygons. All other corners get the
   facet's own normal.

   The winding decides which side is the front. If all the vertex normals of a facet point behind
   it, the file gives them for the other side, and they are reversed. Any other normal that does not
   point to the front is replaced by the facet's own; this happens where two opposite facets share
   vertices, and at corners for which no normal is suitable.

   Only + - * / and sqrt are used on normals, so they are the same on every machine. */
#include "scene/build/smooth.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/vec3.h"
#include "base/work.h"
#include "optics/aliasing.h"

/* A facet is flat if its normals differ from its own by no more than this. */
#define SMOOTH_FLAT 0x1p-40
/* If the sum of normals is shorter than this times the sum of weights, they cancel, and there is no
   mean. */
#define SMOOTH_CANCEL 0x1p-20

/* The number of different sets of groups whose means are kept while a vertex is processed. */
#define SMOOTH_SETS 32u

typedef struct smooth_job {
    const lrcs_mesh *mesh;
    const lrcsi_placer *placer;
    lrcs_scene *scene;
    uint32_t base;    /* the mesh's first vertex in the scene */
    uint32_t first;   /* its first facet */
    lrcs_point *unit; /* facet: its own unit normal; zero if degenerate */
    uint32_t *start;  /* vertex: the index of its first corner in `corner` */
    uint32_t *corner; /* corners, each as 3 facet + k, sorted by vertex */
    lrcs_point *mean; /* corner 3 facet + k: the mean normal of its groups, or zero */
} smooth_job;

/* Normalises a vector of any finite length: divided by the largest component first, its square
   neither overflows nor underflows. Returns 0 if the length is zero. */
static int make_unit(double v[3])
{
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    for (int k = 0; k < 3 && largest > 0.0; k++) {
        v[k] /= largest;
    }
    return lrcsi_length_normalise(v);
}

/* The angle between two unit vectors, rad. It is halved until its 64th part is left, by formulas
   for the tangent; seven terms of the arc tangent then suffice (tan(pi/64) < 0.05, so that the
   eighth term is below 1e-19). */
static double angle_of(const double a[3], const double b[3])
{
    double c[3];
    lrcsi_vec3_cross(a, b, c);
    double size = lrcsi_length(c);
    double dot = lrcsi_vec3_dot(a, b);
    double whole = sqrt(size * size + dot * dot);
    /* The tangent of half the angle, by that of two formulas which does not cancel. */
    double t = dot >= 0.0 ? size / (whole + dot) : (whole - dot) / size;
    if (!(t < 0x1p60)) {
        return LRCS_PI;
    }
    for (int i = 0; i < 5; i++) {
        t = t / (1.0 + sqrt(1.0 + t * t));
    }
    double q = t * t;
    double sum = 0.0;
    for (int k = 13; k >= 1; k -= 2) {
        sum = 1.0 / k - q * sum;
    }
    return 64.0 * t * sum;
}

static const double *placed_corner(const smooth_job *job, uint32_t facet, uint32_t k)
{
    return job->scene->vertex[job->scene->facet[job->first + facet].corner[k % 3]].x;
}

/* The unit vector along the side of a facet from corner k to corner k + by. */
static int side_of(const smooth_job *job, uint32_t facet, uint32_t k, uint32_t by, double v[3])
{
    const double *from = placed_corner(job, facet, k);
    const double *to = placed_corner(job, facet, k + by);
    lrcsi_vec3_between(from, to, v);
    return make_unit(v);
}

/* --- smoothing groups ------------------------------------------------------------------------- */

/* Sorts the corners by vertex, by a counting sort. */
static void corners_by_vertex(smooth_job *job)
{
    uint32_t vertices = job->mesh->vertex_count;
    uint32_t corners = 3 * job->mesh->facet_count; /* lrcsi_smooth_run ensures it */
    memset(job->start, 0, ((size_t)vertices + 2) * sizeof *job->start);
    for (uint32_t i = 0; i < corners; i++) {
        const lrcs_facet *facet = &job->scene->facet[job->first + i / 3];
        job->start[facet->corner[i % 3] - job->base + 2]++;
    }
    for (uint32_t v = 0; v < vertices; v++) {
        job->start[v + 2] += job->start[v + 1];
    }
    for (uint32_t i = 0; i < corners; i++) {
        const lrcs_facet *facet = &job->scene->facet[job->first + i / 3];
        job->corner[job->start[facet->corner[i % 3] - job->base + 1]++] = i;
    }
}

/* The mean normal at a vertex of the facets that share one of the groups; zero if it cancels. */
static lrcs_point group_mean(const smooth_job *job, uint32_t vertex, uint32_t groups)
{
    lrcs_point mean = {{0.0, 0.0, 0.0}};
    double weight = 0.0;
    for (uint32_t i = job->start[vertex]; i < job->start[vertex + 1]; i++) {
        uint32_t facet = job->corner[i] / 3;
        uint32_t k = job->corner[i] % 3;
        double u[3];
        double v[3];
        if ((job->mesh->facet_smooth[facet] & groups) == 0 || !side_of(job, facet, k, 1, u) ||
            !side_of(job, facet, k, 2, v)) {
            continue;
        }
        double angle = angle_of(u, v);
        weight += angle;
        for (int j = 0; j < 3; j++) {
            mean.x[j] += angle * job->unit[facet].x[j];
        }
    }
    if (lrcsi_length(mean.x) > SMOOTH_CANCEL * weight) {
        make_unit(mean.x);
    } else {
        memset(&mean, 0, sizeof mean);
    }
    return mean;
}

/* The means of all corners at one vertex. Corners with the same set of groups have the same mean,
   which is computed once unless there are more than SMOOTH_SETS sets. */
static void vertex_means(smooth_job *job, uint32_t vertex)
{
    uint32_t known[SMOOTH_SETS];
    lrcs_point mean[SMOOTH_SETS];
    uint32_t count = 0;
    for (uint32_t i = job->start[vertex]; i < job->start[vertex + 1]; i++) {
        uint32_t groups = job->mesh->facet_smooth[job->corner[i] / 3];
        uint32_t at = 0;
        while (at < count && known[at] != groups) {
            at++;
        }
        lrcs_point found = at < count ? mean[at] : group_mean(job, vertex, groups);
        if (at == count && count < SMOOTH_SETS) {
            known[count] = groups;
            mean[count++] = found;
        }
        job->mean[job->corner[i]] = found;
    }
}

/* --- vertex normals --------------------------------------------------------------------------- */

/* The file's normal of a corner, placed; returns 0 if it has none. */
static int given_normal(const smooth_job *job, uint32_t facet, uint32_t k, double n[3])
{
    if (!job->mesh->facet_normal) {
        return 0;
    }
    uint32_t stored = job->placer->reflects ? (3 - k) % 3 : k; /* build.c reversed the winding */
    uint32_t index = job->mesh->facet_normal[facet].corner[stored];
    if (index == LRCS_NONE) {
        return 0;
    }
    memcpy(n, job->mesh->normal[index].x, 3 * sizeof *n);
    if (!make_unit(n)) {
        return 0;
    }
    lrcsi_placer_normal(job->placer, n);
    return make_unit(n);
}

/* --- facets ----------------------------------------------------------------------------------- */

/* A facet's three normals. Returns 0 if all are the facet's own. */
static int facet_normals(const smooth_job *job, uint32_t facet, lrcs_point n[3])
{
    const double *own = job->unit[facet].x;
    int given[3];
    int back = 0;
    int count = 0;
    for (uint32_t k = 0; k < 3; k++) {
        given[k] = given_normal(job, facet, k, n[k].x);
        count += given[k];
        back += given[k] && lrcsi_vec3_dot(n[k].x, own) < 0.0;
    }
    int curved = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double *x = n[k].x;
        if (!given[k]) {
            n[k] = job->mean[3 * facet + k];
        }
        for (int i = 0; i < 3 && given[k] && back == count; i++) {
            x[i] = -x[i];
        }
        if (!(lrcsi_vec3_dot(x, own) > 0.0)) {
            memcpy(x, own, 3 * sizeof *x);
        }
        const double difference[3] = {x[0] - own[0], x[1] - own[1], x[2] - own[2]};
        curved |= lrcsi_length(difference) > SMOOTH_FLAT;
    }
    return curved;
}

/* Are the normals to be used? With AUTO, only if the glint of the facet requires it; then `turn` is
   the largest angle between two of them. */
static int normals_needed(const smooth_job *job, uint32_t facet, const lrcs_point n[3],
                          const lrcs_build_options *options)
{
    const lrcs_scene *scene = job->scene;
    const lrcs_brdf *brdf = &scene->material[scene->facet_material[job->first + facet]].brdf;
    if (options->normals == LRCS_NORMALS_SMOOTH) {
        return 1;
    }
    double turn = 0.0;
    for (int k = 0; k < 3; k++) {
        turn = fmax(turn, angle_of(n[k].x, n[(k + 1) % 3].x));
    }
    return brdf->A > 0.0 && turn > 0.0 && lrcsi_aliasing_error(turn, brdf->s) > options->tolerance;
}

int lrcsi_smooth_given(const lrcs_mesh *mesh)
{
    for (uint32_t f = 0; f < mesh->facet_count; f++) {
        const uint32_t *n = mesh->facet_normal ? mesh->facet_normal[f].corner : NULL;
        if (mesh->facet_smooth[f] != 0 ||
            (n && (n[0] != LRCS_NONE || n[1] != LRCS_NONE || n[2] != LRCS_NONE))) {
            return 1;
        }
    }
    return 0;
}

const char *lrcs_normals_text(int normals)
{
    static const char *const text[] = {"flat", "auto", "smooth"};
    return normals >= 0 && normals <= LRCS_NORMALS_SMOOTH ? text[normals] : NULL;
}

int lrcs_normals_find(const char *name)
{
    for (int normals = 0; normals <= LRCS_NORMALS_SMOOTH; normals++) {
        if (strcmp(name, lrcs_normals_text(normals)) == 0) {
            return normals;
        }
    }
    return LRCS_E_NAME;
}

size_t lrcsi_smooth_need(const lrcs_mesh *mesh)
{
    size_t facets = mesh->facet_count;
    size_t need = lrcsi_work_bytes(facets, sizeof(lrcs_point));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 3 * sizeof(lrcs_point)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 3 * sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes((size_t)mesh->vertex_count + 2, sizeof(uint32_t)));
}

int lrcsi_smooth_run(const lrcs_mesh *mesh, const lrcsi_placer *placer,
                     const lrcs_build_options *options, lrcs_work *work, lrcs_scene *scene)
{
    size_t facets = mesh->facet_count;
    size_t mark = work->used;
    if (facets > UINT32_MAX / 3) {
        return LRCS_E_LIMIT;
    }
    smooth_job job = {.mesh = mesh, .placer = placer, .scene = scene};
    job.base = scene->vertex_count - mesh->vertex_count;
    job.first = scene->facet_count - mesh->facet_count;
    job.unit = lrcsi_work_take_zero(work, facets, sizeof *job.unit);
    job.mean = lrcsi_work_take_zero(work, facets, 3 * sizeof *job.mean);
    job.corner = lrcsi_work_take(work, facets, 3 * sizeof *job.corner);
    job.start = lrcsi_work_take(work, (size_t)mesh->vertex_count + 2, sizeof *job.start);
    if (!job.unit || !job.mean || !job.corner || !job.start) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    /* 1. every index of a normal is checked */
    for (uint32_t i = 0; mesh->facet_normal && i < 3 * mesh->facet_count; i++) {
        uint32_t index = mesh->facet_normal[i / 3].corner[i % 3];
        if (index != LRCS_NONE && index >= mesh->normal_count) {
            work->used = mark;
            return LRCS_E_INDEX;
        }
    }
    /* 2. the facets' own unit normals */
    for (uint32_t f = 0; f < mesh->facet_count; f++) {
        double u[3];
        double v[3];
        if (side_of(&job, f, 0, 1, u) && side_of(&job, f, 0, 2, v)) {
            lrcsi_vec3_cross(u, v, job.unit[f].x);
            make_unit(job.unit[f].x);
        }
    }
    /* 3. the means of smoothing groups, vertex by vertex */
    corners_by_vertex(&job);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        vertex_means(&job, v);
    }
    /* 4. three normals for each facet, or none */
    for (uint32_t f = 0; f < mesh->facet_count; f++) {
        lrcs_point *n = &scene->corner_normal[3 * ((size_t)job.first + f)];
        if (!facet_normals(&job, f, n) || !normals_needed(&job, f, n, options)) {
            memset(n, 0, 3 * sizeof *n);
        }
    }
    work->used = mark;
    return LRCS_OK;
}
