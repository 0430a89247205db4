#include "apps/show/x_server.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

constexpr int patience_ms = 20000;

/// The number of the display, which Xvfb writes once it serves; "" if it ends or keeps silent before.
std::string display_from(int pipe)
{
  std::string text;
  for (char c; text.find('\n') == std::string::npos;)
  {
    pollfd wait{pipe, POLLIN, 0};
    if (poll(&wait, 1, patience_ms) <= 0 || read(pipe, &c, 1) <= 0)
      return "";
    text += c;
  }
  return text.substr(0, text.find('\n'));
}

[[noreturn]] void become_server(int pipe)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM); // it never outlives the program
  setpgid(0, 0);                    // an interruption is for the program, which then ends it
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  const std::string number = std::to_string(pipe);
  execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
         static_cast<char *>(nullptr));
  _exit(127);
}

} // namespace

XServer::XServer()
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("show: no pipe to Xvfb");
  process_ = fork();
  if (process_ == 0)
  {
    close(ends[0]);
    become_server(ends[1]);
  }
  close(ends[1]);
  const std::string display = process_ > 0 ? display_from(ends[0]) : "";
  close(ends[0]);
  if (display.empty())
  {
    if (process_ > 0)
    {
      kill(process_, SIGTERM);
      waitpid(process_, nullptr, 0);
    }
    throw std::invalid_argument(
        "show: pictures are drawn on Xvfb, an X server without a screen, which is missing or does not start: install "
        "the package xvfb, or open motion.pvd in ParaView");
  }
  setenv("DISPLAY", (":" + display).c_str(), 1);
}

XServer::~XServer()
{
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

} // namespace gestell::apps
