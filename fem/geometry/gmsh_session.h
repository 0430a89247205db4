#pragma once

#include <functional>
#include <string>

namespace gestell::fem
{

/**
 * A silent gmsh to the end of the scope: no terminal output, no configuration files, one thread (equal
 * input, equal mesh), lengths of STEP files in metres.  gmsh is one per process: sessions do not overlap.
 *
 * Messages of gmsh and OpenCASCADE are collected and reported with our own messages.
 */
class GmshSession
{
public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession &)            = delete;
  GmshSession &operator=(const GmshSession &) = delete;

  /// Runs `action`; a failure of gmsh becomes std::invalid_argument "<head><message of gmsh><remedy>", other exceptions
  /// propagate.
  void run(const std::function<void()> &action, const std::string &head, const std::string &remedy) const;

  /// gmsh's errors so far in one line, "" if there were none.
  std::string errors() const;
};

} // namespace gestell::fem
