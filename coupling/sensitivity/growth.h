#pragma once

#include "coupling/sensitivity/parameter_twins.h"
#include "coupling/simulation/trajectory.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * How far derivatives of a motion can be believed.  A change dx of a parameter moves coordinate i of a body by s_i dx;
 * where that is more than the whole way that the coordinate goes in the run, the motion is another one, and first order
 * says nothing.  Coordinates count that take part, by their momentum: in the motion and in its derivative.  Motions
 * that are chaotic or unstable let s grow by orders of magnitude.
 */
class Growth
{
public:
  /// @param mass  [n] diagonal of M
  Growth(const Machine &machine, const Eigen::VectorXd &mass, const Trajectory &trajectory,
         const std::vector<ParameterTwins> &twins);

  /// [s] a tenth of the run, from which growth is counted.
  double first_look() const { return first_; }
  void   look(double t, const Eigen::MatrixXd &s);

  /// For each parameter of which one percent moves a coordinate by ten times its way: by how much, how its derivative
  /// grew, and the change up to which it holds.
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
  Eigen::VectorXd                    way_;       ///< [n] largest less smallest q; zero: it does not count
  std::vector<Largest>               largest_;
};

} // namespace gestell::coupling
