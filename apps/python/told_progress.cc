#include "apps/python/told_progress.h"

namespace gestell::python
{
namespace
{
constexpr std::chrono::milliseconds between_calls{100};
} // namespace

apps::Watch ToldProgress::watch()
{
  if (call_.is_none())
    return {{}, &asked_};
  return {[this](const std::string &phase, double share) { tell(phase, share); }, &stop_};
}

void ToldProgress::tell(const std::string &phase, double share)
{
  if (asked_)
    stop_ = true;
  const auto now = std::chrono::steady_clock::now();
  if (stop_ || (phase == phase_ && now - told_ < between_calls))
    return;
  told_  = now;
  phase_ = phase;
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

void ToldProgress::raise()
{
  if (!raised_)
    return;
  PyErr_SetObject(pybind11::type::handle_of(raised_).ptr(), raised_.ptr());
  throw pybind11::error_already_set();
}

} // namespace gestell::python
