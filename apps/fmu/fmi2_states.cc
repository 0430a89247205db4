#include "apps/fmu/fmi2_component.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Phase = FmuComponent::Phase;

/// A state that the importer has saved.
struct KeptState
{
  FmuState state;
  Phase    phase;
  bool     stops;
  double   stop; ///< [s]
};

fmi2Status no_function(fmi2Component c, const char *function, const char *reason) noexcept
{
  return answered(c, function, always, [reason](FmuComponent &) -> fmi2Status { throw std::invalid_argument(reason); });
}

constexpr const char *never_pending = "a step is complete when fmi2DoStep returns; none is pending";

/// Phase and stop time, then the state.
std::string bytes_of(const KeptState &kept)
{
  std::string bytes{char('0' + int(kept.phase)), kept.stops ? '1' : '0'};
  bytes.append(reinterpret_cast<const char *>(&kept.stop), sizeof kept.stop);
  return bytes + kept.state.bytes();
}

KeptState kept_of(const std::string &bytes)
{
  constexpr std::size_t head_size = 2 + sizeof(double); // phase, flag and one number
  const int             phase     = bytes.size() < head_size ? -1 : bytes[0] - '0';
  if (phase < 0 || phase > int(Phase::terminated) || (bytes[1] != '0' && bytes[1] != '1'))
    throw std::invalid_argument("these bytes are not a state of an FMU of Gestell");
  KeptState kept{FmuState::of_bytes(bytes.substr(head_size)), Phase(phase), bytes[1] == '1', 0.};
  std::memcpy(&kept.stop, bytes.data() + 2, sizeof kept.stop);
  if (kept.stops && !std::isfinite(kept.stop))
    throw std::invalid_argument("the state contains a stop time that is not finite; its bytes are damaged");
  return kept;
}

} // namespace
} // namespace gestell::apps

using namespace gestell::apps;

FMI2_SHOWN fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
  return answered(
      c, "fmi2GetFMUstate", before_failure,
      [&](FmuComponent &own)
      {
        auto kept = std::make_unique<KeptState>(KeptState{own.model->state(), own.phase, own.stops, own.stop});
        delete static_cast<KeptState *>(*state);
        *state = kept.release();
        return fmi2OK;
      });
}

FMI2_SHOWN fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
  return answered(c, "fmi2SetFMUstate", always,
                  [&](FmuComponent &own)
                  {
                    if (!state)
                      throw std::invalid_argument("there is no state");
                    const auto &kept = *static_cast<const KeptState *>(state);
                    own.model->require_own(kept.state);
                    own.phase = Phase::failed; // until it is restored as a whole
                    own.model->restore(kept.state);
                    own.phase = kept.phase;
                    own.stops = kept.stops;
                    own.stop  = kept.stop;
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
  return answered(c, "fmi2FreeFMUstate", always,
                  [&](FmuComponent &)
                  {
                    if (state)
                    {
                      delete static_cast<KeptState *>(*state);
                      *state = nullptr;
                    }
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t *size)
{
  return answered(c, "fmi2SerializedFMUstateSize", always,
                  [&](FmuComponent &)
                  {
                    if (!state)
                      throw std::invalid_argument("there is no state");
                    *size = bytes_of(*static_cast<const KeptState *>(state)).size();
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], std::size_t size)
{
  return answered(c, "fmi2SerializeFMUstate", always,
                  [&](FmuComponent &)
                  {
                    if (!state)
                      throw std::invalid_argument("there is no state");
                    const std::string all = bytes_of(*static_cast<const KeptState *>(state));
                    if (size < all.size())
                      throw std::invalid_argument("the state takes " + std::to_string(all.size()) +
                                                  " bytes, but there is room for " + std::to_string(size));
                    std::memcpy(bytes, all.data(), all.size());
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size,
                                              fmi2FMUstate *state)
{
  return answered(c, "fmi2DeSerializeFMUstate", always,
                  [&](FmuComponent &)
                  {
                    *state = std::make_unique<KeptState>(kept_of(std::string(bytes, size))).release();
                    return fmi2OK;
                  });
}

// --- what the model description does not promise

FMI2_SHOWN fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference *, std::size_t,
                                                   const fmi2ValueReference *, std::size_t, const fmi2Real *,
                                                   fmi2Real *)
{
  return no_function(c, "fmi2GetDirectionalDerivative", "derivatives are not provided, as the model description says");
}

FMI2_SHOWN fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference *, std::size_t,
                                                   const fmi2Integer *, fmi2Real *)
{
  return no_function(c, "fmi2GetRealOutputDerivatives",
                     "derivatives of outputs are not provided, as the model description says");
}

FMI2_SHOWN fmi2Status fmi2CancelStep(fmi2Component c)
{
  return no_function(c, "fmi2CancelStep", never_pending);
}

FMI2_SHOWN fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind, fmi2Status *)
{
  return no_function(c, "fmi2GetStatus", never_pending);
}

FMI2_SHOWN fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer *)
{
  return no_function(c, "fmi2GetIntegerStatus", never_pending);
}

FMI2_SHOWN fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind, fmi2String *)
{
  return no_function(c, "fmi2GetStringStatus", never_pending);
}

FMI2_SHOWN fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
  return answered(c, "fmi2GetRealStatus", always,
                  [&](FmuComponent &own)
                  {
                    if (kind != fmi2LastSuccessfulTime)
                      throw std::invalid_argument("only fmi2LastSuccessfulTime is a real");
                    *value = own.model->time();
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
  return answered(c, "fmi2GetBooleanStatus", always,
                  [&](FmuComponent &own)
                  {
                    if (kind != fmi2Terminated)
                      throw std::invalid_argument("only fmi2Terminated is a boolean");
                    *value = !own.model->ended().empty();
                    return fmi2OK;
                  });
}
