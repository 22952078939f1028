/* SPDX-License-Identifier: MIT */
/* Holds the built-in scene, as bytes that the Makefile generates. */
#include "host/scene/demo.h"

static const char demo_text[] = {
#include "demo.inc"
};

const char *lrcsi_host_demo(size_t *size)
{
    *size = sizeof demo_text;
    return demo_text;
}
