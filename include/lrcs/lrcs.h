/* SPDX-License-Identifier: MIT */
/* lrcs: monostatic laser radar cross-section of a facet mesh, with a proved error bound. */
#ifndef LRCS_LRCS_H
#define LRCS_LRCS_H

#include <lrcs/brdf.h>
#include <lrcs/constant.h>
#include <lrcs/mesh.h>
#include <lrcs/options.h>
#include <lrcs/polygon.h>
#include <lrcs/pose.h>
#include <lrcs/prepare.h>
#include <lrcs/profile.h>
#include <lrcs/read.h>
#include <lrcs/recipe.h>
#include <lrcs/refine.h>
#include <lrcs/run.h>
#include <lrcs/scene.h>
#include <lrcs/shape.h>
#include <lrcs/status.h>
#include <lrcs/uncertainty.h>
#include <lrcs/work.h>

#endif
