/* SPDX-License-Identifier: MIT */
/* A fuzz target without libFuzzer: every file given, and MUTATIONS mutations of them from a fixed
   generator, the same on every machine. A target that finds something aborts.
   usage: fuzz_NAME MUTATIONS FILE... */
#include "fuzz.h"

#define MOST_BYTES 4096u
#define MOST_FILES 256

typedef struct replay_file {
    unsigned char bytes[MOST_BYTES];
    size_t size;
} replay_file;

static replay_file files[MOST_FILES];

/* Marsaglia (2003), xorshift64. */
static uint32_t replay_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (uint32_t)(*state >> 32);
}

/* In room of its own size, for tools that watch the heap. */
static void replay(const unsigned char *bytes, size_t size)
{
    unsigned char *copy = malloc(size > 0 ? size : 1);
    require(copy != NULL);
    memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

/* A few bytes at once: values that counts fear, bits, digits, pieces moved or doubled, an end. */
static void mutate(replay_file *file, uint64_t *state)
{
    static const unsigned char feared[8] = {0x00, 0x01, 0x7f, 0x80, 0xff, '-', '9', '\n'};
    for (uint32_t left = 1 + replay_random(state) % 4; left > 0 && file->size > 0; left--) {
        uint32_t value = replay_random(state);
        size_t at = replay_random(state) % file->size;
        size_t from = replay_random(state) % file->size;
        size_t more = file->size - (at > from ? at : from);
        switch (value % 5) {
        case 0:
            file->bytes[at] = feared[value >> 8 & 7];
            break;
        case 1:
            file->bytes[at] ^= (unsigned char)(1u << (value >> 8 & 7));
            break;
        case 2:
            file->bytes[at] = (unsigned char)(value >> 8);
            break;
        case 3:
            memmove(file->bytes + at, file->bytes + from, more < 16 ? more : 16);
            break;
        default:
            file->size = value >> 8 & 3 ? file->size : at;
        }
    }
}

static size_t replay_read(const char *path, replay_file *file)
{
    FILE *in = fopen(path, "rb");
    if (!in) {
        return 0;
    }
    file->size = fread(file->bytes, 1, MOST_BYTES, in);
    fclose(in);
    return file->size;
}

int main(int argc, char **argv)
{
    unsigned long mutations = argc > 1 ? strtoul(argv[1], NULL, 10) : 0;
    uint32_t count = 0;
    uint64_t state = 88172645463325252u;
    for (int i = 2; i < argc && count < MOST_FILES; i++) {
        if (replay_read(argv[i], &files[count]) == 0) {
            fprintf(stderr, "%s: nothing to read\n", argv[i]);
            return 1;
        }
        replay(files[count].bytes, files[count].size);
        count++;
    }
    for (unsigned long i = 0; i < mutations && count > 0; i++) {
        replay_file file = files[replay_random(&state) % count];
        mutate(&file, &state);
        replay(file.bytes, file.size);
    }
    return count == 0;
}
