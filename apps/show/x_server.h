#pragma once

#include <sys/types.h>

namespace gestell::apps
{

/// An X server without a screen (Xvfb), for VTK to draw on; DISPLAY names it while it lives.
class XServer
{
public:
  XServer(); ///< @throws std::invalid_argument if Xvfb is missing or does not start
  ~XServer();
  XServer(const XServer &)            = delete;
  XServer &operator=(const XServer &) = delete;

private:
  pid_t process_ = -1;
};

} // namespace gestell::apps
