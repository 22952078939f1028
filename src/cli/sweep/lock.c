/* SPDX-License-Identifier: MIT */
/* Ensures that only one sweep at a time writes a file. The lock is a POSIX lock (fcntl) on
   FILE.lock, which names its holder; it ends with its process, so that a file left by a crash locks
   nothing. If the file system does not support locks, there is none. */
#include "cli/sweep/sweep.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Reports the holder of the lock by the text that it wrote, "process PID on HOST". */
static void lock_refuse(const sweep_file *file, int descriptor)
{
    char holder[300];
    ssize_t size = pread(descriptor, holder, sizeof holder - 1, 0);
    holder[size > 0 ? size : 0] = '\0';
    holder[strcspn(holder, "\n")] = '\0';
    fprintf(stderr, "lrcs: %s: is being written by %s: wait for its end, or stop it\n", file->path,
            holder[0] ? holder : "another process");
}

/* 1 if locked; 0 if another process holds the lock; negative if locking failed, with the reason in
   errno. */
static int lock_try(int descriptor)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(descriptor, F_SETLK, &whole) == 0) {
        return 1;
    }
    return errno == EACCES || errno == EAGAIN ? 0 : -1;
}

/* 1 if the path still names the file that was opened; its last holder may have removed it. */
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
