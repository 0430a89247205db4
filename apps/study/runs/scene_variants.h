#pragma once

#include "apps/scene/file/parameters.h"
#include "apps/scene/variant.h"
#include "apps/study/file/study_file.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// The scene of a study at any values of its variables; its files are read once.
class SceneVariants
{
public:
  /// @throws std::invalid_argument for a key that the scene does not have, with the nearest one
  SceneVariants(const StudyFile &study, fem::Scripts scripts);

  /// @param levels  one a variable, in its unit; words by their number
  Variant at(const Eigen::VectorXd &levels) const;
  /// Parameters of that scene, for formulas.
  Parameters parameters_at(const Eigen::VectorXd &levels) const;
  /// All changes of the scene file: settings of the study, those of the command line, and the levels; each key once,
  /// none inside another's table.
  std::vector<SceneNode::Entry> changes_at(const Eigen::VectorXd &levels) const;
  /// The scene with the settings of the study, before any variable.
  const SceneNode &root() const { return scene_.root; }

  /// Tries the ends of each variable, and the smallest and largest of its levels, the others in their middles.
  /// @param levels  of all runs [runs x variables]
  /// @throws std::invalid_argument with the place of the variable, its value, and what the scene says against it
  void check_ranges(const Eigen::MatrixXd &levels) const;

  /// Sets a parameter that runs tell, in SI with its unit.
  /// @throws std::invalid_argument if the scene has no such parameter
  void set_measured(const RunParameter &measure, double value, const std::string &unit);
  /// [SI] as it is set now.
  double measured(const RunParameter &measure, const Eigen::VectorXd &levels) const;

  Eigen::VectorXd middle() const; ///< of all ranges; of words and files the first

private:
  void set(const std::string &key, const SceneNode &value);
  void check_measure(const RunParameter &measure) const;
  void check_key(const VariableRequest &request, const std::string &key) const;

  StudyFile                     study_;
  Variant                       scene_;    ///< with the settings, before any variable
  std::vector<SceneNode::Entry> settings_; ///< as changes_at()
};

} // namespace gestell::apps
