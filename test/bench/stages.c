/* SPDX-License-Identifier: MIT */
/* The stages of a pose in the order in which lrcs_sigma_run takes them, each timed by itself. What
   comes out of them is not looked at. */
#include "bench/stages.h"

#include "base/work.h"
#include "integrate/plan.h"
#include "integrate/total.h"
#include "visibility/occlude.h"

/* A stage under way: when it began, and with how much memory in use. */
typedef struct bench_watch {
    bench_stages *stages;
    lrcs_work *work;
    int stage;
    size_t used;
    double start;
} bench_watch;

static bench_watch watch_start(bench_stages *stages, lrcs_work *work, int stage)
{
    work->peak = work->used;
    return (bench_watch){stages, work, stage, work->used, bench_now_ms()};
}

static void watch_stop(const bench_watch *w, int status)
{
    double ms = bench_now_ms() - w->start;
    size_t bytes = w->work->peak - w->used;
    bench_check(status, "a stage");
    bench_add(&w->stages->times[w->stage], ms);
    if (bytes > w->stages->bytes[w->stage]) {
        w->stages->bytes[w->stage] = bytes;
    }
}

/* A picture of the whole view; then what a pose takes instead, which draws only what matters. */
static void raster_run(lrcsi_contest *contest, int raster, lrcs_work *work, lrcsi_visible *visible,
                       bench_stages *stages)
{
    size_t mark = work->used;
    lrcsi_raster r;
    lrcsi_known known;
    bench_watch w = watch_start(stages, work, BENCH_RASTER + raster);
    watch_stop(&w, lrcsi_raster_make(contest->view, bench_raster_size(raster), work, &r));
    work->used = mark;
    w = watch_start(stages, work, BENCH_AREAS + raster);
    int status = lrcsi_visible_known(contest, work, &known);
    if (status == LRCS_OK) {
        status = lrcsi_visible_sampled(&known, bench_raster_size(raster), work, &r, visible);
    }
    watch_stop(&w, status);
    work->used = mark;
}

static void exact_run(lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible,
                      bench_stages *stages)
{
    uint32_t starved;
    lrcs_run_options options = lrcs_run_options_default();
    lrcsi_plan plan = lrcsi_plan_make(contest->view, &options);
    bench_watch w = watch_start(stages, work, BENCH_EXACT);
    watch_stop(&w, lrcsi_occlude_all(contest, work, visible, &starved));
    w = watch_start(stages, work, BENCH_SUM);
    lrcsi_total total = lrcsi_total_make(contest->view, &plan, visible, NULL, NULL, NULL);
    watch_stop(&w, total.diffuse >= 0 ? LRCS_OK : LRCS_E_NUMBER);
}

void bench_stages_run(const lrcs_prepared *prepared, const lrcs_pose *pose, int rasters,
                      lrcs_work *work, bench_stages *stages)
{
    size_t mark = work->used;
    lrcsi_view view;
    lrcsi_contest contest;
    lrcsi_visible *visible = lrcsi_work_take(work, prepared->scene->facet_count, sizeof *visible);
    bench_check(visible ? LRCS_OK : LRCS_E_MEMORY, "areas");
    bench_watch w = watch_start(stages, work, BENCH_CULL);
    watch_stop(&w, lrcsi_view_make(prepared, pose, work, &view));
    w = watch_start(stages, work, BENCH_CONTEST);
    watch_stop(&w, lrcsi_contest_make(&view, work, &contest));
    for (int raster = 0; raster < rasters; raster++) {
        raster_run(&contest, raster, work, visible, stages);
    }
    exact_run(&contest, work, visible, stages);
    stages->contested += contest.contested_count;
    stages->poses++;
    work->used = mark;
}
