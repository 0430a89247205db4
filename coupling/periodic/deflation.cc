#include "coupling/periodic/deflation.h"

#include <algorithm>

namespace gestell::coupling
{

double Deflation::factor(const Eigen::VectorXd &z, Eigen::VectorXd &slope) const
{
  constexpr double least  = 1e-24; // of the size squared
  double           factor = 1.;
  slope.setZero(z.size());
  for (const Eigen::VectorXd &known : known_)
  {
    const Eigen::VectorXd away   = z - known;
    const double          square = std::max(away.squaredNorm(), least * size_ * size_), part = size_ * size_ / square;
    factor *= part + 1.;
    slope -= 2. * part / ((part + 1.) * square) * away;
  }
  return factor;
}

} // namespace gestell::coupling
