#pragma once

#include "apps/session/session.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <string>

namespace gestell::python
{

/**
 * Calls a Python callable with the phase and its completed share (negative: unknown), at most ten times per second.  An
 * exception of the callable ends the computation, which then raises it.
 */
class CallbackProgress
{
public:
  /// @param call       called with phase and share; None: progress is not reported
  /// @param requested  flag of Ctrl-C
  CallbackProgress(pybind11::object call, const std::atomic<bool> &requested)
      : call_(std::move(call)), requested_(requested)
  {
  }

  apps::Watch watch();
  void        raise(); ///< rethrows the exception of the callable, if any; needs the interpreter lock

private:
  void tell(const std::string &phase, double share);

  pybind11::object                      call_;
  const std::atomic<bool>              &requested_;
  std::atomic<bool>                     stop_{false}; ///< requested by Ctrl-C or by the callable
  pybind11::object                      raised_;
  std::string                           phase_;
  std::chrono::steady_clock::time_point reported_{};
};

} // namespace gestell::python
