#include "apps/command_line/standard_streams.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

extern "C" void go_on(int) {} // a handler, not SIG_IGN: programs that are started do not inherit it

bool has_reader(int file)
{
  pollfd polled{file, POLLOUT, 0};
  return poll(&polled, 1, 0) < 0 || !(polled.revents & POLLERR);
}

} // namespace

void secure_standard_streams()
{
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) < 0 && errno == EBADF)
      open("/dev/null", file == STDERR_FILENO ? O_WRONLY : O_RDONLY); // gets the lowest number, this one
  std::signal(SIGPIPE, go_on);
}

std::string standard_output_failure()
{
  errno = 0;
  std::cout.flush();
  if (std::cout || !has_reader(STDOUT_FILENO))
    return "";
  const std::string reason = errno != 0 ? std::strerror(errno) : "an earlier part of it was lost";
  return "standard output: cannot be written (" + reason + "); results in a folder are complete";
}

} // namespace gestell::apps
