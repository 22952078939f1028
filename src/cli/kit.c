/* SPDX-License-Identifier: MIT */
/* What writing a kit and judging by it share: its paths, its poses, its scenes as the engine reads
   them back. vectors/ writes kits, compare/ judges by them. */
#include "cli/kit.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

int cli_kit_path(char path[KIT_PATH], const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int size = vsnprintf(path, KIT_PATH, format, list);
    va_end(list);
    if (size < 0 || (unsigned)size >= KIT_PATH) {
        return cli_fail("a path of more than %u bytes", KIT_PATH);
    }
    return 0;
}

int cli_kit_pose(const double quaternion[4], const double direction[3], lrcs_pose *pose)
{
    lrcs_pose turned;
    lrcs_pose aimed;
    int status = lrcs_pose_from_quaternion(quaternion, &turned);
    status = status == LRCS_OK ? lrcs_pose_from_direction(direction, &aimed) : status;
    if (status == LRCS_OK) {
        memcpy(pose->direction, aimed.direction, sizeof pose->direction);
        memcpy(pose->R, turned.R, sizeof pose->R);
    }
    return status;
}

double cli_kit_outline(const lrcs_scene *scene, uint32_t facet, const lrcs_pose *pose)
{
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        const double *a = scene->vertex[scene->facet[facet].corner[k]].x;
        const double *b = scene->vertex[scene->facet[facet].corner[(k + 1) % 3]].x;
        double side[2] = {0.0, 0.0};
        for (int i = 0; i < 3; i++) {
            side[0] += pose->R[0][i] * (b[i] - a[i]);
            side[1] += pose->R[1][i] * (b[i] - a[i]);
        }
        length += hypot(side[0], side[1]);
    }
    return length;
}

int cli_kit_scene(const char *folder, const char *name, const lrcs_binding *binding, uint32_t count,
                  lrcs_host_scene *scene)
{
    lrcs_host_error error;
    lrcs_host_options options = lrcs_host_options_default();
    char path[KIT_PATH];
    memset(scene, 0, sizeof *scene);
    options.binding = binding;
    options.binding_count = count;
    if (cli_kit_path(path, "%s/scenes/%s.obj", folder, name) != 0) {
        return CLI_FAILED;
    }
    if (lrcs_host_scene_read(path, &options, scene, &error) != LRCS_OK ||
        lrcs_host_scene_prepare(scene, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    return 0;
}
