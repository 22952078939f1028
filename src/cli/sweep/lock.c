/* SPDX-License-Identifier: MIT */
/* One sweep at a time writes a file. The lock is POSIX's (fcntl) on FILE.lock, which says who holds
   it; it ends with its process, so that a file left behind by a crash locks nothing. Where the file
   system knows no locks there is none. */
#include "cli/sweep/sweep.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* "process PID on HOST", as its holder wrote it, in words. */
static void lock_refuse(const sweep_file *file, int descriptor)
{
    char holder[300];
    ssize_t size = pread(descriptor, holder, sizeof holder - 1, 0);
    holder[size > 0 ? size : 0] = '\0';
    holder[strcspn(holder, "\n")] = '\0';
    fprintf(stderr, "lrcs: %s: is being written by %s: wait for its end, or stop it\n", file->path,
            holder[0] ? holder : "another process");
}

/* 1: locked; 0: another process holds it; negative: no lock to be had, errno says why. */
static int lock_try(int descriptor)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(descriptor, F_SETLK, &whole) == 0) {
        return 1;
    }
    return errno == EACCES || errno == EAGAIN ? 0 : -1;
}

/* Does the path still name the file that was opened? Its last holder may have removed it. */
static int lock_is_there(const sweep_file *file, int descriptor)
{
    struct stat held;
    struct stat named;
    return fstat(descriptor, &held) == 0 && stat(file->lock_path, &named) == 0 &&
           held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

int cli_lock_take(sweep_file *file)
{
    char holder[300];
    char host[256] = "";
    for (;;) {
        int descriptor = open(file->lock_path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            fprintf(stderr, "lrcs: %s: cannot write: %s\n", file->lock_path, strerror(errno));
            return CLI_FAILED;
        }
        int locked = lock_try(descriptor);
        if (locked > 0 && !lock_is_there(file, descriptor)) {
            close(descriptor);
            continue;
        }
        if (locked == 0) {
            lock_refuse(file, descriptor);
            close(descriptor);
            return CLI_FAILED;
        }
        file->lock = descriptor;
        break;
    }
    gethostname(host, sizeof host - 1);
    int size = snprintf(holder, sizeof holder, "process %ld on %s\n", (long)getpid(), host);
    if (ftruncate(file->lock, 0) != 0 || pwrite(file->lock, holder, (size_t)size, 0) != size) {
        fprintf(stderr, "lrcs: %s: cannot write: %s\n", file->lock_path, strerror(errno));
        cli_lock_drop(file);
        return CLI_FAILED;
    }
    return 0;
}

void cli_lock_drop(sweep_file *file)
{
    if (file->lock >= 0) {
        unlink(file->lock_path); /* before another process can hold it */
        close(file->lock);
    }
    file->lock = -1;
}
