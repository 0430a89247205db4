#pragma once

#include "apps/study/values/study_variable.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

constexpr double same_level = 1e-9; ///< coded values nearer than this differ by rounding alone
constexpr double most_runs  = 1e6;  ///< of a study: twelve days at one a second

/// The points of a study in coded values (study_variable.h).
struct Design
{
  std::string     type{};             ///< as the study file names it, such as "central composite"
  Eigen::MatrixXd points{};           ///< runs x variables, coded
  int             centre_points = 0;  ///< the last rows of `points`
  double          alpha         = 0.; ///< of star points; 0: there are none

  int n_runs() const { return static_cast<int>(points.rows()); }
  int n_variables() const { return static_cast<int>(points.cols()); }
};

/// Physical values of coded points and back, both runs x variables.
/// @throws std::invalid_argument if there is not one variable per column
Eigen::MatrixXd physical_points(const Eigen::MatrixXd &coded, const std::vector<StudyVariable> &variables);
Eigen::MatrixXd coded_points(const Eigen::MatrixXd &physical, const std::vector<StudyVariable> &variables);

} // namespace gestell::apps
