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

/// What the resources of an FMU say beside their scene: resources/fmu.toml.
struct FmuResources
{
  std::string           guid;
  std::set<std::string> frozen; ///< parameters that the reduced frame depends on

  std::string         text() const;
  static FmuResources read(const std::filesystem::path &folder);
};

/// A state of an FmuModel as a value.
struct FmuState
{
  std::string                           guid; ///< of the FMU whose state it is
  std::vector<double>                   parameters, inputs, rates, since;
  std::optional<coupling::SteppedState> motion; ///< none: not started

  std::string bytes() const;
  /// @throws std::invalid_argument if they are none, or a motion in them is not finite
  static FmuState of_bytes(const std::string &bytes);
};

/**
 * The machine of a scene whose frame is at hand, coupled with others: parameters are set before it starts, inputs
 * between steps.
 *
 * Throws std::invalid_argument for wrong input, ConvergenceFailure where the computation fails.
 */
class FmuModel
{
public:
  /// @param folder  with scene.toml, fmu.toml and what they name
  explicit FmuModel(const std::filesystem::path &folder);

  const FmuInterface &interface() const { return interface_; }
  const FmuResources &resources() const { return resources_; }
  const Scene        &scene() const { return scene_; }

  double parameter(std::size_t i) const { return parameters_[i]; }
  void   set_parameter(std::size_t i, double value); ///< @throws if it has started
  double input(std::size_t i) const;                 ///< as it is now
  void   set_input(std::size_t i, double value);     ///< held, unless its rate is set at the same instant
  void   set_input_rate(std::size_t i, double rate);
  double output(std::size_t i); ///< at time(); starts the machine

  void start(); ///< once; later calls do nothing
  bool started() const { return run_ != nullptr; }
  void forget_start() { run_.reset(); } ///< it starts again, with what is set until then
  void reset();
  /// @param t  must be time()
  void        step(double t, double length);
  double      time() const; ///< [s]; before the start where the run begins
  std::string ended() const;
  void        verify() const;                                                      ///< @throws as SteppedRun::verify()
  std::string finish(const std::string &failure = "", const std::string &id = ""); ///< as SteppedRun::finish()
  std::vector<coupling::Finding> take_findings();                                  ///< since they were taken last
  std::vector<coupling::Event>   take_events();                                    ///< likewise
  FmuState                       state();
  void                           require_own(const FmuState &state) const; ///< @throws if it is of another FMU
  void                           restore(const FmuState &state);           ///< one of its own

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
