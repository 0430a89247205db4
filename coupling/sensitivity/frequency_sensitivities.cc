#include "coupling/sensitivity/frequency_sensitivities.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double meet = 1e-7; ///< relative difference of frequencies whose shapes are not told apart
constexpr double rest = 1e-6; ///< of the highest frequency: it is zero

struct Matrices
{
  MatrixXd M, K, G;
};

Matrices matrices(const LinearisedAt &at)
{
  const Machine &machine = *at.machine;
  Matrices       found;
  MatrixXd       B;
  engaged_matrices(machine, at.q, *at.open, found.K, B);
  found.M = dense_mass(machine);
  found.K += dense_stiffness(machine);
  const VectorXd zero = VectorXd::Zero(machine.size());
  LocalState     local;
  local.resize(machine);
  machine.gather(0., at.q, zero, zero, local);
  found.G.setZero(machine.joints().n_rows(), machine.size());
  if (machine.joints().n_rows() > 0)
  {
    local.lambda = multipliers_at_rest(machine, at.q, local);
    ConstraintJacobian G(machine.joints().blocks());
    VectorXd           g(machine.joints().n_rows());
    machine.joints().constraints(local, g, G);
    found.G = joint_jacobian(machine, G);
  }
  found.K += geometric_stiffness(machine, local);
  return found;
}

bool stands_alone(const std::vector<Mode> &modes, std::size_t j)
{
  const double f = modes[j].frequency_hz;
  for (const std::size_t other : {j - 1, j + 1})
    if (other < modes.size() && std::abs(modes[other].frequency_hz - f) <= meet * f)
      return false;
  return f > rest * modes.back().frequency_hz;
}

} // namespace

MatrixXd frequency_sensitivities(const LinearisedAt &at, const std::vector<Mode> &modes,
                                 const std::vector<FrequencyTwins> &twins)
{
  MatrixXd found =
      MatrixXd::Constant(Index(modes.size()), Index(twins.size()), std::numeric_limits<double>::quiet_NaN());
  const Matrices     own     = matrices(at);
  const bool         jointed = own.G.rows() > 0;
  LeastSquaresSolver joints;
  if (jointed)
    joints = LeastSquaresSolver(MatrixXd(own.G.transpose()));
  std::vector<VectorXd> mu(modes.size());
  for (std::size_t j = 0; j < modes.size() && jointed; ++j)
  {
    const double   omega = 2. * M_PI * modes[j].frequency_hz;
    const VectorXd left  = omega * omega * (own.M * modes[j].shape) - own.K * modes[j].shape;
    mu[j]                = joints.solve(left);
  }
  for (std::size_t k = 0; k < twins.size(); ++k)
  {
    const Matrices below = matrices(twins[k].minus), above = matrices(twins[k].plus);
    const double   quotient = 0.5 / twins[k].step;
    for (std::size_t j = 0; j < modes.size(); ++j)
    {
      if (!stands_alone(modes, j))
        continue;
      const VectorXd &v     = modes[j].shape;
      const double    omega = 2. * M_PI * modes[j].frequency_hz;
      double          slope = v.dot((above.K - below.K) * v) - omega * omega * v.dot((above.M - below.M) * v);
      if (jointed)
        slope += 2. * mu[j].dot((above.G - below.G) * v);
      found(Index(j), Index(k)) = quotient * slope / (4. * M_PI * omega);
    }
  }
  return found;
}

} // namespace gestell::coupling
