#pragma once

#include "apps/analysis/analyses.h"
#include "apps/analysis/frf/response_search.h"
#include "apps/output/report/stability_report.h"
#include "apps/output/values/state_space_model.h"
#include "apps/python/python_frame.h"
#include "apps/python/python_result.h"
#include "apps/scene/variant.h"
#include "apps/sizing/size_search.h"

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::python
{

/// Options of a run.
struct RunChoice
{
  /// Names of signals, or their paths, "slide.displacement"; none: all signals of the scene.
  std::optional<std::vector<std::string>> signals{};
  bool                                    history = true;  ///< false: only their extremes
  bool                                    lean    = false; ///< no energy balance and no pictures, as in studies
  apps::OptionTexts                       options{};       ///< of analyses, {"--sensitivities", {"all"}}
  pybind11::object                        progress = pybind11::none();
};

struct SizeChoice
{
  double      tolerance = 0.;  ///< relative
  std::string outputs{};       ///< "F_P.max,F_P.min"
  double      max_cpu    = 0.; ///< [s]; 0: unlimited
  bool        exhaustive = false;
};

/**
 * A scene as data: keys can be read and set, then the scene is computed.  After a change the scene is read again;
 * frames are reduced once and stored in memory for all scenes of the process (apps::ReducedFrameStore).
 *
 * Wrong input throws std::invalid_argument, a failed computation std::runtime_error.  Computations release the
 * interpreter lock.
 */
class PythonScene
{
public:
  static PythonScene of_file(const std::string &path);
  /// @param folder  base of relative paths
  static PythonScene of_text(const std::string &text, const std::string &folder);
  static PythonScene of_values(const pybind11::dict &values, const std::string &folder);

  /// Sets one key, "parameters.c_P".  @throws std::invalid_argument for a parameter that the scene does not have
  void set(const std::string &key, pybind11::handle value);
  /// Sets several keys of a table, "body.crank", which is created if necessary; as if the original scene had them.
  void                     add(const std::string &table, const pybind11::dict &entries);
  pybind11::object         get(const std::string &key) const; ///< @throws pybind11::key_error
  pybind11::object         values() const;                    ///< all, as a dict
  std::string              name() const;
  std::vector<std::string> signals() const;
  std::vector<std::string> check() const; ///< warnings
  std::vector<std::string> words() const; ///< summary of the scene as understood, one fact per line

  /// @throws pybind11::error_already_set ComputationFailed, KeyboardInterrupt: with the results so far in `result`
  std::shared_ptr<PythonResult>    run(const RunChoice &choice) const;
  std::shared_ptr<PythonResult>    modes(const apps::OptionTexts &options, pybind11::object progress) const;
  std::shared_ptr<PythonFrame>     frame() const; ///< reduced
  std::shared_ptr<PythonFullFrame> full_frame() const;
  apps::StabilityStudy             stability(double step) const;
  /// The search, and this scene with the chosen sizes.
  std::pair<apps::SizeResult, PythonScene> size(const SizeChoice &choice) const;
  std::shared_ptr<apps::StateSpaceModel>   state_space(const apps::FrfOptions &options) const;
  /// @param options  strings by the names of options, "--from"
  std::shared_ptr<PythonResult> analyse(const std::string &analysis, const apps::OptionTexts &options,
                                        pybind11::object progress) const;

private:
  explicit PythonScene(apps::Variant variant) : variant_(std::move(variant)) {}

  apps::Scene                    scene() const { return variant_.scene(); }
  apps::Scene                    scene_with(const std::vector<std::string> &signals) const;
  std::shared_ptr<apps::Session> session(apps::Scene scene, const apps::Watch &watch) const;

  apps::Variant variant_;
};

} // namespace gestell::python
