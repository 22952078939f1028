/* SPDX-License-Identifier: MIT */
/* Files: read whole, written whole or not at all. */
#include <lrcs/host.h>

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "check.h"

static char folder[64];

static int folder_make(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lrcs-test-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int folder_remove(void **state)
{
    (void)state;
    return rmdir(folder); /* fails where a test left anything behind */
}

static const char *inside(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int entries(void)
{
    DIR *dir = opendir(folder);
    int count = 0;
    while (readdir(dir)) {
        count++;
    }
    closedir(dir);
    return count - 2;
}

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void check_holds(const char *path, const char *text)
{
    lrcs_host_file file;
    assert_int_equal(lrcs_host_file_read(path, &file, NULL), LRCS_OK);
    assert_int_equal(file.size, strlen(text));
    assert_memory_equal(file.bytes, text, file.size);
    lrcs_host_file_free(&file);
}

static void a_file_is_read_whole(void **state)
{
    (void)state;
    const char *path = inside("a");
    put(path, "some bytes");
    check_holds(path, "some bytes");
    put(path, "");
    check_holds(path, "");
    remove(path);
}

static void a_missing_file_and_a_folder_say_why(void **state)
{
    (void)state;
    lrcs_host_file file = {NULL, 7};
    lrcs_host_error error;
    assert_int_equal(lrcs_host_file_read(inside("none"), &file, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "none: cannot open: No such file"));
    assert_int_equal(file.size, 7);
    assert_int_equal(lrcs_host_file_read(folder, &file, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "Is a directory"));
}

static void an_output_shows_only_when_complete(void **state)
{
    (void)state;
    const char *path = inside("out");
    lrcs_host_output out;
    put(path, "old");
    assert_int_equal(lrcs_host_output_open(path, &out, NULL), LRCS_OK);
    fputs("new", out.stream);
    fflush(out.stream);
    check_holds(path, "old");
    assert_int_equal(lrcs_host_output_close(&out, 1, NULL), LRCS_OK);
    check_holds(path, "new");
    assert_int_equal(entries(), 1);
    remove(path);
}

static void a_dropped_output_leaves_nothing(void **state)
{
    (void)state;
    lrcs_host_output out;
    assert_int_equal(lrcs_host_output_open(inside("out"), &out, NULL), LRCS_OK);
    fputs("half", out.stream);
    assert_int_equal(lrcs_host_output_close(&out, 0, NULL), LRCS_OK);
    assert_int_equal(entries(), 0);
}

static void a_link_is_written_through(void **state)
{
    (void)state;
    char target[128];
    struct stat about;
    lrcs_host_output out;
    strcpy(target, inside("target"));
    put(target, "old");
    assert_int_equal(symlink(target, inside("link")), 0);
    assert_int_equal(lrcs_host_output_open(inside("link"), &out, NULL), LRCS_OK);
    fputs("new", out.stream);
    assert_int_equal(lrcs_host_output_close(&out, 1, NULL), LRCS_OK);
    check_holds(target, "new");
    assert_int_equal(lstat(inside("link"), &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    remove(inside("link"));
    remove(target);
}

static void a_folder_that_is_not_there_is_an_error(void **state)
{
    (void)state;
    lrcs_host_output out;
    lrcs_host_error error;
    assert_int_equal(lrcs_host_output_open(inside("no/out"), &out, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "no/out: cannot write: No such file"));
    assert_int_equal(lrcs_host_output_open(folder, &out, &error), LRCS_E_SYSTEM);
    assert_null(out.stream);
}

static void a_full_device_is_an_error_and_stays_a_device(void **state)
{
    (void)state;
    struct stat about;
    lrcs_host_output out;
    lrcs_host_error error;
    if (stat("/dev/full", &about) != 0) {
        print_message("no /dev/full here: skipped\n");
        skip();
    }
    assert_int_equal(lrcs_host_output_open("/dev/full", &out, &error), LRCS_OK);
    fputs("bytes", out.stream);
    assert_int_equal(lrcs_host_output_close(&out, 1, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "No space left"));
    assert_int_equal(stat("/dev/full", &about), 0);
    assert_true(S_ISCHR(about.st_mode));
}

/* Files may not grow beyond `size` bytes, as if the disk were full. Returns the limit before. */
static rlim_t disk_limit(rlim_t size)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    rlim_t before = limit.rlim_cur;
    limit.rlim_cur = size;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    return before;
}

/* What fits the stream's buffer fails when it is closed, what does not when it is written. */
static void a_full_disk_leaves_the_old_file_and_nothing_else(void **state)
{
    (void)state;
    lrcs_host_output out;
    lrcs_host_error error;
    signal(SIGXFSZ, SIG_IGN);
    put(inside("out"), "old");
    static const int sizes[] = {100, 1000000};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(lrcs_host_output_open(inside("out"), &out, &error), LRCS_OK);
        rlim_t before = disk_limit(64);
        for (int i = 0; i < sizes[k]; i++) {
            putc('n', out.stream);
        }
        int status = lrcs_host_output_close(&out, 1, &error);
        disk_limit(before);
        assert_int_equal(status, LRCS_E_SYSTEM);
        assert_non_null(strstr(error.text, "out: cannot write: File too large"));
        assert_null(out.stream);
        check_holds(inside("out"), "old");
        assert_int_equal(entries(), 1);
    }
    signal(SIGXFSZ, SIG_DFL);
    remove(inside("out"));
}

static void a_name_that_became_a_folder_is_an_error(void **state)
{
    (void)state;
    lrcs_host_output out;
    lrcs_host_error error;
    assert_int_equal(lrcs_host_output_open(inside("out"), &out, &error), LRCS_OK);
    fputs("new", out.stream);
    assert_int_equal(mkdir(inside("out"), 0777), 0);
    assert_int_equal(lrcs_host_output_close(&out, 1, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "out: cannot write: Is a directory"));
    assert_int_equal(entries(), 1);
    assert_int_equal(rmdir(inside("out")), 0);
}

static void a_file_whose_bytes_cannot_be_read_is_an_error(void **state)
{
    (void)state;
    lrcs_host_file file = {NULL, 7};
    lrcs_host_error error;
    if (access("/proc/self/mem", R_OK) != 0) {
        print_message("no /proc/self/mem here: skipped\n");
        skip();
    }
    /* nothing is mapped at address 0 */
    assert_int_equal(lrcs_host_file_read("/proc/self/mem", &file, &error), LRCS_E_SYSTEM);
    assert_non_null(strstr(error.text, "/proc/self/mem: cannot read: Input/output error"));
    assert_true(!file.bytes && file.size == 7);
}

/* More bytes than the system says beforehand: files of /proc have a size of 0. */
static void a_file_is_read_to_its_end_whatever_its_stated_size(void **state)
{
    (void)state;
    lrcs_host_file file;
    struct stat about;
    if (stat("/proc/self/maps", &about) != 0 || about.st_size != 0) {
        print_message("no /proc/self/maps here: skipped\n");
        skip();
    }
    assert_int_equal(lrcs_host_file_read("/proc/self/maps", &file, NULL), LRCS_OK);
    assert_true(file.size > 100 && file.bytes[file.size - 1] == '\n');
    lrcs_host_file_free(&file);
}

/* The lowest descriptor that is free. */
static int descriptor_next(void)
{
    int next = dup(0);
    close(next);
    return next;
}

static void outputs_leave_no_descriptor_open(void **state)
{
    (void)state;
    lrcs_host_output out;
    lrcs_host_error error;
    int next = descriptor_next();
    assert_int_equal(lrcs_host_output_open(inside("no/out"), &out, &error), LRCS_E_SYSTEM);
    assert_int_equal(lrcs_host_output_open(inside("out"), &out, &error), LRCS_OK);
    assert_int_equal(lrcs_host_output_close(&out, 0, &error), LRCS_OK);
    assert_int_equal(lrcs_host_output_close(&out, 1, &error), LRCS_OK); /* closed already */
    assert_int_equal(descriptor_next(), next);
    assert_int_equal(entries(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_read_whole),
        cmocka_unit_test(a_missing_file_and_a_folder_say_why),
        cmocka_unit_test(an_output_shows_only_when_complete),
        cmocka_unit_test(a_dropped_output_leaves_nothing),
        cmocka_unit_test(a_link_is_written_through),
        cmocka_unit_test(a_folder_that_is_not_there_is_an_error),
        cmocka_unit_test(a_full_device_is_an_error_and_stays_a_device),
        cmocka_unit_test(a_full_disk_leaves_the_old_file_and_nothing_else),
        cmocka_unit_test(a_name_that_became_a_folder_is_an_error),
        cmocka_unit_test(a_file_whose_bytes_cannot_be_read_is_an_error),
        cmocka_unit_test(a_file_is_read_to_its_end_whatever_its_stated_size),
        cmocka_unit_test(outputs_leave_no_descriptor_open),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
