#pragma once

#include "apps/session/session.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <string>

namespace gestell::python
{

/**
 * Tells a callable of Python the phase and the share of it that is done (negative: unknown), ten times a second at
 * most.  What it raises ends the computation, which then raises it.
 */
class CallbackProgress
{
public:
  /// @param call  called with phase and share; None: progress is not reported
  /// @param requested  of Ctrl-C
  CallbackProgress(pybind11::object call, const std::atomic<bool> &requested)
      : call_(std::move(call)), requested_(requested)
  {
  }

  apps::Watch watch();
  void        raise(); ///< what the callable raised, if it did; needs the lock of the interpreter

private:
  void tell(const std::string &phase, double share);

  pybind11::object                      call_;
  const std::atomic<bool>              &requested_;
  std::atomic<bool>                     stop_{false}; ///< asked for by Ctrl-C or by the callable
  pybind11::object                      raised_;
  std::string                           phase_;
  std::chrono::steady_clock::time_point reported_{};
};

} // namespace gestell::python
