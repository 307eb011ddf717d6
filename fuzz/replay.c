/* SPDX-License-Identifier: MIT */
/* Feeds files, or all files in folders, to a target: for compilers without libFuzzer, and to look at a finding again.
 *
 *   replay.TARGET.VARIANT FILE|FOLDER...
 *
 * With GJK_FUZZ_PRINT set, the case each file stands for is printed before it is tried. */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_BYTES 65536

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static int replayed;

static int replay_file(const char *path)
{
    static uint8_t bytes[MOST_BYTES];
    uint8_t *copy;
    size_t count;
    FILE *f = fopen(path, "rb");
    if (!f) {
        perror(path);
        return 1;
    }
    count = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    copy = malloc(count ? count : 1); /* its own block: reading beyond it is seen by the sanitizers */
    if (!copy) {
        return 1;
    }
    memcpy(copy, bytes, count);
    fprintf(stderr, "%s\n", path);
    LLVMFuzzerTestOneInput(copy, count);
    free(copy);
    replayed++;
    return 0;
}

static int replay(const char *path)
{
    char inside[4096];
    const struct dirent *entry;
    int failed = 0;
    DIR *folder = opendir(path);
    if (!folder) {
        return replay_file(path);
    }
    while ((entry = readdir(folder)) != NULL) {
        if (entry->d_name[0] != '.') {
            int length = snprintf(inside, sizeof inside, "%s/%s", path, entry->d_name);
            failed |= length < 0 || (size_t)length >= sizeof inside || replay_file(inside);
        }
    }
    closedir(folder);
    return failed;
}

int main(int argc, char **argv)
{
    int failed = 0;
    for (int i = 1; i < argc; i++) {
        failed |= replay(argv[i]);
    }
    printf("%d inputs hold\n", replayed);
    return failed || replayed == 0;
}
