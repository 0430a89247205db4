#pragma once

#include "coupling/sensitivity/parameter_twins.h"
#include "coupling/simulation/trajectory.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Validity of derivatives of a motion.  A change dx of a parameter moves coordinate i of a body by s_i dx; if that
 * exceeds the whole travel of the coordinate in the run, the first order is not valid. Only coordinates with
 * considerable momentum, in the motion and in its derivative, are included. In chaotic or unstable motions s grows by
 * orders of magnitude.
 */
class Growth
{
public:
  /// @param mass  [n] diagonal of M
  Growth(const Machine &machine, const Eigen::VectorXd &mass, const Trajectory &trajectory,
         const std::vector<ParameterTwins> &twins);

  /// [s] a tenth of the run, after which growth is measured.
  double first_look() const { return first_; }
  void   look(double t, const Eigen::MatrixXd &s);

  /// For each parameter whose change by 1 % moves a coordinate by ten times its travel: the ratio, the growth of its
  /// derivative, and the valid change.
  std::vector<std::string> warnings() const;

private:
  struct Largest
  {
    double       ratio = 0., t = 0., early = 0.;
    Eigen::Index coordinate = 0;
  };

  const Machine                     &machine_;
  const std::vector<ParameterTwins> &twins_;
  double                             first_;
  Eigen::VectorXd                    root_mass_; ///< [n]
  Eigen::VectorXd                    way_;       ///< [n] range of q; zero: not included
  std::vector<Largest>               largest_;
};

} // namespace gestell::coupling
