/* SPDX-License-Identifier: MIT */
/* The host layer: files, memory, notices, pictures and writers around the core. It may use the
   heap and stdio. It never prints on its own and never exits: an error is reported as a status and
   a sentence. Flight software does not need it: the core works without it. */
#ifndef LRCS_HOST_H
#define LRCS_HOST_H

#include <lrcs/chart.h>
#include <lrcs/file.h>
#include <lrcs/glint.h>
#include <lrcs/load.h>
#include <lrcs/readings.h>
#include <lrcs/write.h>

#endif
