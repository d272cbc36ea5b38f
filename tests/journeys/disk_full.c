// A disk that is full while the file named by RRP_FULL exists: whoever is started with this library before all others
// (LD_PRELOAD) cannot write to any other file of that folder then. Standard streams and sockets go on. If that file has a
// number in it, so many bytes of each file still find room: a disk that is full fills what it has before it says so. What
// stands in a file that ends with .reserve can be written over, as its blocks are there.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static long room(const char *mark) {
    FILE *file = fopen(mark, "r");
    long bytes = 0;
    if (file && fscanf(file, "%ld", &bytes) != 1) bytes = 0;
    if (file) fclose(file);
    return bytes;
}

// Whether a file has no room for bytes up to `end`.
static int full(int file, off64_t end) {
    const char *mark = getenv("RRP_FULL");
    if (file <= 2 || !mark || access(mark, F_OK) != 0 || end <= room(mark)) return 0;
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    size_t folder = strrchr(mark, '/') - mark + 1;
    if (length < 0) return 0;
    path[length] = 0;
    struct stat about;
    if (length > 8 && strcmp(path + length - 8, ".reserve") == 0 && fstat(file, &about) == 0 && end <= about.st_size) return 0;
    return strncmp(path, mark, folder) == 0;
}

static ssize_t refuse(void) {
    errno = ENOSPC;
    return -1;
}

ssize_t write(int file, const void *bytes, size_t length) {
    static ssize_t (*really)(int, const void *, size_t);
    if (!really) really = dlsym(RTLD_NEXT, "write");
    struct stat about;
    off64_t here = lseek(file, 0, SEEK_CUR);
    if (fcntl(file, F_GETFL) & O_APPEND && fstat(file, &about) == 0) here = about.st_size;
    return full(file, here + (off64_t)length) ? refuse() : really(file, bytes, length);
}

ssize_t pwrite(int file, const void *bytes, size_t length, off_t at) {
    static ssize_t (*really)(int, const void *, size_t, off_t);
    if (!really) really = dlsym(RTLD_NEXT, "pwrite");
    return full(file, at + (off64_t)length) ? refuse() : really(file, bytes, length, at);
}

ssize_t pwrite64(int file, const void *bytes, size_t length, off64_t at) {
    static ssize_t (*really)(int, const void *, size_t, off64_t);
    if (!really) really = dlsym(RTLD_NEXT, "pwrite64");
    return full(file, at + (off64_t)length) ? refuse() : really(file, bytes, length, at);
}
