/* SPDX-License-Identifier: MIT */
/* The built-in scene: examples/satellite.toml, byte for byte, embedded by the Makefile. */
#ifndef LRCSI_HOST_DEMO_H
#define LRCSI_HOST_DEMO_H

#include <stddef.h>

const char *lrcsi_host_demo(size_t *size);

#endif
