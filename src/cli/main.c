/* SPDX-License-Identifier: MIT */
#include <lrcs/lrcs.h>
#include <stdio.h>
int main(void)
{
    puts(lrcs_version());
    return 0;
}
