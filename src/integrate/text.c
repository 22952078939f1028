/* SPDX-License-Identifier: MIT */
/* Names and sentences for methods, what is accepted, effects, flags and notices. */
#include <lrcs/run.h>

#include <string.h>

const char *lrcs_method_text(int method)
{
    static const char *const text[] = {"auto", "facet", "zbuffer", "exact", "closed"};
    return method >= 0 && method <= LRCS_METHOD_CLOSED ? text[method] : NULL;
}

int lrcs_method_find(const char *name)
{
    for (int method = 0; method <= LRCS_METHOD_EXACT; method++) {
        if (strcmp(name, lrcs_method_text(method)) == 0) {
            return method;
        }
    }
    return LRCS_E_NAME;
}

const char *lrcs_accept_text(int accept)
{
    static const char *const text[] = {"bound", "estimate", "any"};
    return accept >= 0 && accept <= LRCS_ACCEPT_ANY ? text[accept] : NULL;
}

int lrcs_accept_find(const char *name)
{
    for (int accept = 0; accept <= LRCS_ACCEPT_ANY; accept++) {
        if (strcmp(name, lrcs_accept_text(accept)) == 0) {
            return accept;
        }
    }
    return LRCS_E_NAME;
}

const char *lrcs_progress_text(int stage)
{
    static const char *const text[] = {"view", "classification", "visibility", "integration"};
    return stage >= 0 && stage <= LRCS_PROGRESS_INTEGRATE ? text[stage] : NULL;
}

const char *lrcs_effect_text(int effect)
{
    static const char *const text[LRCS_EFFECTS] = {
        "self_shadowing", "back_face_casters", "glint",        "diffuse",
        "curved_normals", "two_sided",         "articulation", "closed_forms"};
    return effect >= 0 && effect < LRCS_EFFECTS ? text[effect] : NULL;
}

const char *lrcs_flag_text(int bit)
{
    switch (bit) {
    case LRCS_FLAG_TOLERANCE_NOT_MET:
        return "tolerance_not_met";
    case LRCS_FLAG_MEMORY_FALLBACK:
        return "memory_fallback";
    case LRCS_FLAG_DEPTH_UNDECIDED:
        return "depth_undecided";
    case LRCS_FLAG_STEPS_SPENT:
        return "steps_spent";
    case LRCS_FLAG_ACCEPTED_BY_ESTIMATE:
        return "accepted_by_estimate";
    case LRCS_FLAG_ACCEPTED_UNJUDGED:
        return "accepted_unjudged";
    default:
        return "unknown_flag";
    }
}

const char *lrcs_notice_text(int bit)
{
    switch (bit) {
    case LRCS_NOTICE_BACK_SIDES_VISIBLE:
        return "back sides of one-sided facets are visible: the mesh is open or inverted; they "
               "contribute nothing";
    case LRCS_NOTICE_TESSELLATION_UNKNOWN:
        return "no bound is known for facets in the place of a curved shape (it is as small as the "
               "rounding errors of its position, its placement is not a rotation, or back-face "
               "casters are left out): the bound refers to the facets, not to the true shape";
    default:
        return "unknown notice";
    }
}
