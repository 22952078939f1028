/* SPDX-License-Identifier: MIT */
/* A fuzz target without libFuzzer: it runs every seed, and MUTATIONS mutations of them from a fixed
   generator, the same on every machine. A target that finds a fault aborts. Seeds are kept packed:
   one seed a line, in base64 (pack.sh writes them). With `unpack` it writes each seed to a file of
   its own, as libFuzzer expects.
   usage: fuzz_NAME MUTATIONS SEEDS
          fuzz_NAME unpack FOLDER SEEDS */
#include "fuzz.h"
#include "random.h"

#define MOST_BYTES 4096u
#define MOST_SEEDS 256u

typedef struct replay_seed {
    unsigned char bytes[MOST_BYTES];
    size_t size;
} replay_seed;

static replay_seed seeds[MOST_SEEDS];

static uint32_t replay_random(uint64_t *state)
{
    return (uint32_t)(random_xorshift(state) >> 32);
}

/* Runs the target on a copy in a heap block of exactly its size, so that memory checkers see any
   access beyond it. */
static void replay(const unsigned char *bytes, size_t size)
{
    unsigned char *copy = malloc(size > 0 ? size : 1);
    require(copy != NULL);
    memcpy(copy, bytes, size);
    LLVMFuzzerTestOneInput(copy, size);
    free(copy);
}

/* Changes a few bytes: to values that are boundary cases of counts and of numbers in text, by one
   bit, to any value; or copies a piece to another place; or cuts the end off. */
static void mutate(replay_seed *seed, uint64_t *state)
{
    static const unsigned char boundary[8] = {0x00, 0x01, 0x7f, 0x80, 0xff, '-', '9', '\n'};
    for (uint32_t left = 1 + replay_random(state) % 4; left > 0 && seed->size > 0; left--) {
        uint32_t value = replay_random(state);
        size_t at = replay_random(state) % seed->size;
        size_t from = replay_random(state) % seed->size;
        size_t more = seed->size - (at > from ? at : from);
        switch (value % 5) {
        case 0:
            seed->bytes[at] = boundary[value >> 8 & 7];
            break;
        case 1:
            seed->bytes[at] ^= (unsigned char)(1u << (value >> 8 & 7));
            break;
        case 2:
            seed->bytes[at] = (unsigned char)(value >> 8);
            break;
        case 3:
            memmove(seed->bytes + at, seed->bytes + from, more < 16 ? more : 16);
            break;
        default:
            seed->size = value >> 8 & 3 ? seed->size : at;
        }
    }
}

/* Decodes base64 up to the end of the line. Returns 0 if the line is not a seed. */
static int seed_read(const char *line, replay_seed *seed)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t bits = 0;
    int count = 0; /* of bits read and not yet stored: the low ones of `bits` */
    seed->size = 0;
    for (; seed->size < MOST_BYTES && *line != '\0' && *line != '\n' && *line != '='; line++) {
        const char *digit = strchr(digits, *line);
        if (!digit) {
            return 0;
        }
        bits = bits << 6 | (uint32_t)(digit - digits);
        count += 6;
        if (count >= 8) {
            count -= 8;
            seed->bytes[seed->size++] = (unsigned char)(bits >> count);
        }
    }
    line += strspn(line, "=");
    return seed->size > 0 && (*line == '\n' || *line == '\0');
}

/* How many seeds the file at path holds; 0, with a message, where it cannot be read. */
static uint32_t seeds_read(const char *path)
{
    static char line[2 * MOST_BYTES + 2];
    uint32_t count = 0;
    FILE *in = fopen(path, "r");
    while (in && count < MOST_SEEDS && fgets(line, sizeof line, in)) {
        if (!seed_read(line, &seeds[count])) {
            fprintf(stderr, "%s:%u: expected base64\n", path, (unsigned)count + 1);
            count = 0;
            break;
        }
        count++;
    }
    if (in) {
        fclose(in);
    } else {
        fprintf(stderr, "%s: cannot be read\n", path);
    }
    return count;
}

static int unpack(const char *folder, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%03u", folder, (unsigned)i);
        FILE *out = fopen(path, "wb");
        if (!out || fwrite(seeds[i].bytes, 1, seeds[i].size, out) != seeds[i].size || fclose(out)) {
            fprintf(stderr, "%s: cannot be written\n", path);
            return 1;
        }
    }
    return 0;
}

int main(int argc, char **argv)
{
    int unpacks = argc == 4 && strcmp(argv[1], "unpack") == 0;
    if (argc != 3 && !unpacks) {
        fprintf(stderr, "usage: %s MUTATIONS SEEDS, or: %s unpack FOLDER SEEDS\n", argv[0],
                argv[0]);
        return 2;
    }
    uint32_t count = seeds_read(argv[argc - 1]);
    if (count == 0 || unpacks) {
        return count == 0 || unpack(argv[2], count);
    }
    for (uint32_t i = 0; i < count; i++) {
        replay(seeds[i].bytes, seeds[i].size);
    }
    uint64_t state = 88172645463325252u;
    for (unsigned long left = strtoul(argv[1], NULL, 10); left > 0; left--) {
        replay_seed seed = seeds[replay_random(&state) % count];
        mutate(&seed, &state);
        replay(seed.bytes, seed.size);
    }
    return 0;
}
