#pragma once

#include "apps/fmu/fmu_interface.h"
#include "coupling/simulation/stepped_run.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Resources of an FMU in addition to its scene: resources/fmu.toml.
struct FmuResources
{
  std::string           guid;
  std::set<std::string> frozen; ///< parameters on which the reduced frame depends

  std::string         text() const;
  static FmuResources read(const std::filesystem::path &folder);
};

/// A state of an FmuModel as a value.
struct FmuState
{
  std::string                           guid; ///< of the FMU of this state
  std::vector<double>                   parameters, inputs, rates, since;
  std::optional<coupling::SteppedState> motion; ///< none: not started

  std::string bytes() const;
  /// @throws std::invalid_argument if the bytes are not a state, or its motion is not finite
  static FmuState of_bytes(const std::string &bytes);
};

/**
 * The machine of a scene with an available frame, coupled with other programs: parameters are set before it starts,
 * inputs between steps.
 *
 * Throws std::invalid_argument for wrong input, ConvergenceFailure if the computation fails.
 */
class FmuModel
{
public:
  /// @param folder  with scene.toml, fmu.toml and the files that they name
  explicit FmuModel(const std::filesystem::path &folder);

  const FmuInterface &interface() const { return interface_; }
  const FmuResources &resources() const { return resources_; }
  const Scene        &scene() const { return scene_; }

  double parameter(std::size_t i) const { return parameters_[i]; }
  void   set_parameter(std::size_t i, double value); ///< @throws if it has started
  double input(std::size_t i) const;                 ///< present value
  void   set_input(std::size_t i, double value);     ///< constant, unless its rate is set at the same instant
  void   set_input_rate(std::size_t i, double rate);
  double output(std::size_t i); ///< at time(); starts the machine

  void start(); ///< once; later calls have no effect
  bool started() const { return run_ != nullptr; }
  void forget_start() { run_.reset(); } ///< the next start uses all values set until then
  void reset();
  /// @param t  must be time()
  void        step(double t, double length);
  double      time() const; ///< [s]; before the start that of the beginning of the run
  std::string ended() const;
  void        verify() const;                                                      ///< @throws as in SteppedRun
  std::string finish(const std::string &failure = "", const std::string &id = ""); ///< as SteppedRun::finish()
  std::vector<coupling::Finding> take_findings();                                  ///< since the last call
  std::vector<coupling::Event>   take_events();                                    ///< since the last call
  FmuState                       state();
  void                           require_own(const FmuState &state) const; ///< @throws if the state is from another FMU
  void                           restore(const FmuState &state);           ///< a state of this FMU

private:
  void build();
  bool apply_inputs();

  std::filesystem::path                             folder_;
  SceneNode                                         root_;
  FmuResources                                      resources_;
  Scene                                             scene_;
  FmuInterface                                      interface_;
  std::vector<double>                               parameters_, inputs_, rates_, since_;
  std::vector<std::pair<std::string, InputHandles>> handles_;
  std::optional<coupling::Machine>                  machine_;
  std::unique_ptr<coupling::SteppedRun>             run_;
};

} // namespace gestell::apps
