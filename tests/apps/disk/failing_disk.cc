// A disk that fails: loaded before the C library (LD_PRELOAD), makes one of the calls that change a file fail, or that
// and all behind it.
//
// GESTELL_DISK       what lies below this folder is meant
// GESTELL_DISK_CALL  number of the call that fails, from 1; 0: none, they are counted
// GESTELL_DISK_FULL  given: all behind it fail, too
// GESTELL_DISK_COUNT file of eight bytes, the number of calls so far, of all processes

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{

template <typename Function>
Function *next(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

std::atomic<long> *counter()
{
  static std::atomic<long> *const shared = []() -> std::atomic<long> *
  {
    const char *file = std::getenv("GESTELL_DISK_COUNT");
    const int   fd   = file ? next<int(const char *, int, ...)>("open")(file, O_RDWR) : -1;
    void       *at   = fd < 0 ? MAP_FAILED : mmap(nullptr, sizeof(long), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    return at == MAP_FAILED ? nullptr : static_cast<std::atomic<long> *>(at);
  }();
  return shared;
}

bool is_meant(const char *path)
{
  static const char *const folder = std::getenv("GESTELL_DISK");
  return folder && path && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

/// Whether the call fails that is made now.
bool fails(const char *path)
{
  if (!is_meant(path) || !counter())
    return false;
  static const long wanted = std::getenv("GESTELL_DISK_CALL") ? std::atol(std::getenv("GESTELL_DISK_CALL")) : 0;
  static const bool full   = std::getenv("GESTELL_DISK_FULL") != nullptr;
  const long        now    = ++*counter();
  const bool        failed = wanted > 0 && (now == wanted || (full && now > wanted));
  if (failed)
    errno = ENOSPC;
  return failed;
}

bool fails(int file)
{
  const int   kept = errno;
  char        link[64], path[4096];
  struct stat state;
  if (fstat(file, &state) != 0 || !S_ISREG(state.st_mode))
    return errno = kept, false;
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  errno           = kept;
  if (n <= 0)
    return false;
  path[n] = '\0';
  return fails(path);
}

bool fails(FILE *file)
{
  return file && fails(fileno(file));
}

bool changes(int flags)
{
  return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT);
}

bool changes(const char *mode)
{
  return std::strpbrk(mode, "wa+") != nullptr;
}

bool is_written(int file)
{
  const int kept = errno, flags = fcntl(file, F_GETFL);
  errno = kept;
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

mode_t mode_of(int flags, va_list arguments)
{
  return flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
}

} // namespace

extern "C"
{
#define GESTELL_OPEN(name)                                                                                             \
  int name(const char *path, int flags, ...)                                                                           \
  {                                                                                                                    \
    va_list arguments;                                                                                                 \
    va_start(arguments, flags);                                                                                        \
    const mode_t mode = mode_of(flags, arguments);                                                                     \
    va_end(arguments);                                                                                                 \
    return changes(flags) && fails(path) ? -1 : next<int(const char *, int, ...)>(#name)(path, flags, mode);           \
  }
  GESTELL_OPEN(open)
  GESTELL_OPEN(open64)

#define GESTELL_FOPEN(name)                                                                                            \
  FILE *name(const char *path, const char *mode)                                                                       \
  {                                                                                                                    \
    return changes(mode) && fails(path) ? nullptr : next<FILE *(const char *, const char *)>(#name)(path, mode);       \
  }
  GESTELL_FOPEN(fopen)
  GESTELL_FOPEN(fopen64)

  ssize_t write(int file, const void *bytes, size_t n)
  {
    return fails(file) ? -1 : next<ssize_t(int, const void *, size_t)>("write")(file, bytes, n);
  }

  ssize_t writev(int file, const struct iovec *parts, int n)
  {
    return fails(file) ? -1 : next<ssize_t(int, const struct iovec *, int)>("writev")(file, parts, n);
  }

  size_t fwrite(const void *bytes, size_t size, size_t n, FILE *file)
  {
    return fails(file) ? 0 : next<size_t(const void *, size_t, size_t, FILE *)>("fwrite")(bytes, size, n, file);
  }

  int close(int file)
  {
    const bool failed = is_written(file) && fails(file);
    const int  result = next<int(int)>("close")(file);
    return failed ? (errno = ENOSPC, -1) : result;
  }

  int fclose(FILE *file)
  {
    const bool failed = file && is_written(fileno(file)) && fails(file);
    const int  result = next<int(FILE *)>("fclose")(file);
    return failed ? (errno = ENOSPC, EOF) : result;
  }

  int rename(const char *from, const char *to)
  {
    return fails(to) ? -1 : next<int(const char *, const char *)>("rename")(from, to);
  }

  int mkdir(const char *path, mode_t mode)
  {
    return fails(path) ? -1 : next<int(const char *, mode_t)>("mkdir")(path, mode);
  }

  int ftruncate(int file, off_t size)
  {
    return fails(file) ? -1 : next<int(int, off_t)>("ftruncate")(file, size);
  }
}
