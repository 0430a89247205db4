#include "apps/python/callback_progress.h"

namespace gestell::python
{
apps::Watch CallbackProgress::watch()
{
  if (call_.is_none())
    return {{}, &requested_};
  return {[this](const std::string &phase, double share) { tell(phase, share); }, &stop_};
}

void CallbackProgress::tell(const std::string &phase, double share)
{
  if (requested_)
    stop_ = true;
  const auto                          now = std::chrono::steady_clock::now();
  constexpr std::chrono::milliseconds between_calls{100}; // a person sees ten changes a second as steady
  if (stop_ || (phase == phase_ && now - reported_ < between_calls))
    return;
  reported_ = now;
  phase_    = phase;
  const pybind11::gil_scoped_acquire locked;
  try
  {
    call_(phase, share);
  }
  catch (pybind11::error_already_set &error)
  {
    raised_ = error.value();
    stop_   = true;
  }
}

void CallbackProgress::raise()
{
  if (!raised_)
    return;
  PyErr_SetObject(pybind11::type::handle_of(raised_).ptr(), raised_.ptr());
  throw pybind11::error_already_set();
}

} // namespace gestell::python
