#pragma once

#include "apps/fmu/fmi2_types.h"
#include "apps/fmu/fmu_model.h"

#include <memory>
#include <set>
#include <string>

#define FMI2_SHOWN extern "C" __attribute__((visibility("default")))

namespace gestell::apps
{

/// One instance of the FMU, for its importer.
struct FmuComponent
{
  enum class Phase
  {
    instantiated,
    initialising,
    stepping,
    terminated,
    failed
  };

  std::string               name;
  fmi2CallbackFunctions     callbacks{};
  bool                      logging = false;
  std::set<std::string>     categories{}; ///< empty: all
  std::unique_ptr<FmuModel> model{};
  Phase                     phase = Phase::instantiated;
  double                    stop  = 0.; ///< [s] limit of all steps; 0: not given
  bool                      stops = false;

  void log(fmi2Status status, const std::string &category, const std::string &message) const;
  void tell_findings(); ///< also events of the model
};

/// Phases in which a function may be called.
inline constexpr auto before_failure = {FmuComponent::Phase::instantiated, FmuComponent::Phase::initialising,
                                        FmuComponent::Phase::stepping, FmuComponent::Phase::terminated};
inline constexpr auto always         = {FmuComponent::Phase::instantiated, FmuComponent::Phase::initialising,
                                        FmuComponent::Phase::stepping, FmuComponent::Phase::terminated,
                                        FmuComponent::Phase::failed};

/// A component of the importer; null if it is not one.
inline FmuComponent *component_of(fmi2Component component)
{
  return static_cast<FmuComponent *>(component);
}

/// Calls f, which returns a status; exceptions become a status with the message logged.
/// @param within  names of phases in which the function may be called
template <typename F>
fmi2Status answered(fmi2Component c, const char *function, std::initializer_list<FmuComponent::Phase> within,
                    F f) noexcept
{
  FmuComponent *const component = component_of(c);
  if (!component)
    return fmi2Error;
  const auto failed = [&](fmi2Status status, const std::string &message)
  {
    if (status == fmi2Fatal)
      component->phase = FmuComponent::Phase::failed;
    component->log(status, "logStatusError", std::string(function) + ": " + message);
    return status;
  };
  try
  {
    try
    {
      for (const FmuComponent::Phase phase : within)
        if (phase == component->phase)
          return f(*component);
      static const char *const names[] = {"before its initialisation", "in its initialisation", "while it steps",
                                          "after its end", "after a failure"};
      return failed(fmi2Error, std::string("is not for an FMU ") + names[int(component->phase)] +
                                   (component->phase == FmuComponent::Phase::failed ? "; reset it" : ""));
    }
    catch (const std::bad_alloc &)
    {
      return failed(fmi2Fatal, "out of memory");
    }
    catch (const std::exception &error)
    {
      return failed(fmi2Error, error.what());
    }
  }
  catch (...)
  {
    return fmi2Fatal;
  }
}

} // namespace gestell::apps
