/* SPDX-License-Identifier: BSD-3-Clause */
/* To be preloaded: below the folder $WRITE_FAULT_FOLDER, the shared file system fails as soon as the file
 * $WRITE_FAULT_WHEN exists. $WRITE_FAULT_ERROR says how: ENOSPC (what is written has no space) or ESTALE (what
 * was opened is stale, and nothing can be opened). Other calls than these are not looked at. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int is_below(const char* path)
{
  const char* folder = getenv("WRITE_FAULT_FOLDER");
  return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

static int has_begun(void)
{
  const char* when = getenv("WRITE_FAULT_WHEN");
  return when != NULL && syscall(SYS_access, when, F_OK) == 0;
}

static int is_stale(void)
{
  const char* error = getenv("WRITE_FAULT_ERROR");
  return error != NULL && strcmp(error, "ESTALE") == 0;
}

static int descriptor_is_below(int descriptor)
{
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size <= 0) return 0;
  path[size] = '\0';
  return is_below(path);
}

/* Whether a call on an open file shall fail; errno is set then. */
static int fails(int descriptor, int is_write)
{
  if (!is_write && !is_stale()) return 0;
  if (!has_begun() || !descriptor_is_below(descriptor)) return 0;
  errno = is_stale() ? ESTALE : ENOSPC;
  return 1;
}

static int open_fails(const char* path)
{
  char absolute[PATH_MAX];
  if (!is_stale() || !has_begun()) return 0;
  if (path[0] != '/' && getcwd(absolute, sizeof absolute) != NULL) {
    strncat(absolute, "/", sizeof absolute - strlen(absolute) - 1);
    strncat(absolute, path, sizeof absolute - strlen(absolute) - 1);
    path = absolute;
  }
  if (!is_below(path)) return 0;
  errno = ESTALE;
  return 1;
}

ssize_t write(int descriptor, const void* bytes, size_t size)
{
  return fails(descriptor, 1) ? -1 : REAL(write)(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count)
{
  return fails(descriptor, 1) ? -1 : REAL(writev)(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset)
{
  return fails(descriptor, 1) ? -1 : REAL(pwrite)(descriptor, bytes, size, offset);
}

ssize_t read(int descriptor, void* bytes, size_t size)
{
  return fails(descriptor, 0) ? -1 : REAL(read)(descriptor, bytes, size);
}

ssize_t pread(int descriptor, void* bytes, size_t size, off_t offset)
{
  return fails(descriptor, 0) ? -1 : REAL(pread)(descriptor, bytes, size, offset);
}

int fsync(int descriptor) { return fails(descriptor, 1) ? -1 : REAL(fsync)(descriptor); }

int open(const char* path, int flags, ...)
{
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_fails(path) ? -1 : REAL(open)(path, flags, mode);
}

/* What C++ streams open with. */
FILE* fopen64(const char* path, const char* mode)
{
  return open_fails(path) ? NULL : REAL(fopen64)(path, mode);
}

int rename(const char* from, const char* to)
{
  return open_fails(to) ? -1 : REAL(rename)(from, to);
}
