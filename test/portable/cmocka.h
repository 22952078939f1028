/* SPDX-License-Identifier: MIT */
/* What the core's tests use of cmocka, for machines that have none: the tests themselves run there
   unchanged. A failed check prints its place and leaves the test; the group goes on. Like cmocka's
   own, this header follows setjmp.h, stdarg.h, stddef.h and stdint.h. */
#ifndef TEST_PORTABLE_CMOCKA_H
#define TEST_PORTABLE_CMOCKA_H

#include <stdio.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*function)(void **state);
};

static jmp_buf cmocka_way_out;
enum { CMOCKA_FAILED = 1, CMOCKA_SKIPPED };

#define cmocka_unit_test(f) ((struct CMUnitTest){#f, (f)})
#define cmocka_run_group_tests(tests, setup, teardown)                                             \
    cmocka_run((tests), sizeof(tests) / sizeof *(tests))

static inline void _fail(const char *file, int line)
{
    fprintf(stderr, "%s:%d: error: failure\n", file, line);
    longjmp(cmocka_way_out, CMOCKA_FAILED);
}

static inline void cmocka_check(int holds, const char *what, const char *file, int line)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", what);
        _fail(file, line);
    }
}

static inline void cmocka_check_int(unsigned long long a, unsigned long long b, int same,
                                    const char *what, const char *file, int line)
{
    if ((a == b) != same) {
        fprintf(stderr, "%s: %#llx, %#llx\n", what, a, b);
        _fail(file, line);
    }
}

#define fail()             _fail(__FILE__, __LINE__)
#define fail_msg(...)      (fprintf(stderr, __VA_ARGS__), fputc('\n', stderr), fail())
#define skip()             longjmp(cmocka_way_out, CMOCKA_SKIPPED)
#define print_message      printf
#define assert_true(c)     cmocka_check((c) ? 1 : 0, #c, __FILE__, __LINE__)
#define assert_false(c)    cmocka_check((c) ? 0 : 1, "not " #c, __FILE__, __LINE__)
#define assert_null(p)     cmocka_check((p) == NULL, #p " == NULL", __FILE__, __LINE__)
#define assert_non_null(p) cmocka_check((p) != NULL, #p " != NULL", __FILE__, __LINE__)
#define assert_int_equal(a, b)                                                                     \
    cmocka_check_int((unsigned long long)(a), (unsigned long long)(b), 1, #a " == " #b, __FILE__,  \
                     __LINE__)
#define assert_int_not_equal(a, b)                                                                 \
    cmocka_check_int((unsigned long long)(a), (unsigned long long)(b), 0, #a " != " #b, __FILE__,  \
                     __LINE__)
#define assert_ptr_equal(a, b)                                                                     \
    cmocka_check((const void *)(a) == (const void *)(b), #a " == " #b, __FILE__, __LINE__)
#define assert_string_equal(a, b)                                                                  \
    cmocka_check(strcmp((a), (b)) == 0, #a " equals " #b, __FILE__, __LINE__)
#define assert_string_not_equal(a, b)                                                              \
    cmocka_check(strcmp((a), (b)) != 0, #a " differs from " #b, __FILE__, __LINE__)
#define assert_memory_equal(a, b, size)                                                            \
    cmocka_check(memcmp((a), (b), (size)) == 0, #a " has the bytes of " #b, __FILE__, __LINE__)

static inline int cmocka_run(const struct CMUnitTest *test, size_t count)
{
    static int failed;
    for (size_t i = 0; i < count; i++) {
        static void *state;
        switch (setjmp(cmocka_way_out)) {
        case 0:
            test[i].function(&state);
            printf("ok %s\n", test[i].name);
            break;
        case CMOCKA_SKIPPED:
            printf("ok %s # SKIP\n", test[i].name);
            break;
        default:
            printf("not ok %s\n", test[i].name);
            failed++;
        }
        fflush(stdout);
    }
    printf("1..%zu\n", count);
    return failed;
}

#endif
