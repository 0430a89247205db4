#pragma once

#include "apps/study/values/design.h"

#include <cstdint>
#include <optional>

namespace gestell::apps
{

/// A design as a study file asks for it.  What a type does not take must be left as it is.
struct DesignRequest
{
  std::string           type{};     ///< one of design_types()
  int                   runs   = 0; ///< of a Latin hypercube or Sobol points
  int                   levels = 0; ///< of a full factorial design, where a variable has no levels of its own; 0: two
  int                   centre_points = 0;
  std::string           star{};  ///< rotatable, face-centred, orthogonal or spherical; empty: alpha, or rotatable
  std::optional<double> alpha{}; ///< of star points, instead of `star`
  std::uint64_t         seed = 0;
  Eigen::MatrixXd       list{}; ///< of a list: runs x variables, physical
};

/// The names of all types: list, full factorial, central composite, Box-Behnken, Latin hypercube, Sobol.
const std::vector<std::string> &design_types();

/// The names of the distances of star points.
const std::vector<std::string> &star_names();

/// How many coefficients a full quadratic surface of k variables has: (k + 1)(k + 2) / 2.
inline int quadratic_coefficients(int n_variables)
{
  return (n_variables + 1) * (n_variables + 2) / 2;
}

/// @throws std::invalid_argument for a type that does not exist (nearest named), sizes it does not take, or wrong
/// variables
Design make_design(const DesignRequest &request, const std::vector<StudyVariable> &variables);

} // namespace gestell::apps
