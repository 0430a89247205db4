#pragma once

#include "apps/scene/file/expected_values.h"
#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/resumable_run.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Compares the results of a run with plausible ranges: elastic deformation of elements, travel of springs, contacts
 * that never closed, slip of motors, rim speeds, speeds and displacements of bodies. Ranges with their reasons:
 * docs/reference/scene/magnitudes.md.
 */
class RunMagnitudes
{
public:
  /// @param machine  the simulated machine
  /// @param small    its companion with few coordinates, from which masses and stiffnesses are taken
  RunMagnitudes(const Scene &scene, const coupling::Machine &machine, const coupling::Machine &small);

  coupling::WatchedSignals &signals() { return signals_; } ///< the run must record these

  /// After that run: values outside their range.
  std::vector<UnexpectedValue> unexpected(const coupling::RunResult &run) const;

private:
  enum class Kind
  {
    deformation, ///< force; scale: stiffness
    travel,      ///< displacement of a spring; scale: limit of the plausible range
    contact,     ///< force
    slip,        ///< scale: breakdown slip
    turning,     ///< speed of a rotor; scale: radius
    yielding,    ///< displacement of an interface
    speed,
    way
  };
  struct Watched
  {
    Kind        kind;
    std::string object;
    double      scale;
  };

  void   watch(Kind kind, const std::string &object, const std::string &path, double scale = 0.);
  void   watch_elements(const coupling::Machine &small);
  void   watch_springs();
  void   watch_bodies();
  void   watch_frame(const coupling::MachineModel &small);
  double size_of(const std::string &element) const;
  bool   acted(const Watched &watched, const coupling::WatchedValue &value, const coupling::RunResult &run) const;

  std::optional<UnexpectedValue> judged(const Watched &watched, const std::string &unit,
                                        const coupling::WatchedValue &value, const coupling::RunResult &run) const;
  std::optional<UnexpectedValue> judged_slip(const Watched &watched, const coupling::WatchedValue &value) const;
  bool                           commanded(const std::string &element) const;

  const Scene                  &scene_;
  const coupling::MachineModel &machine_;
  double                        size_; ///< [m] of the machine; 0: unknown
  std::vector<Watched>          watched_;
  coupling::WatchedSignals      signals_;
};

} // namespace gestell::apps
