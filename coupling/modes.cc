#include "coupling/modes.h"

#include "coupling/dense_matrices.h"
#include "coupling/dense_modes.h"
#include "coupling/integration/consistent_start.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
constexpr double two_pi = 6.283185307179586;

/// Damped frequencies and ratios, from the quadratic eigenproblem in the undamped modes:
/// (s^2 E + s V^T B V + diag(omega^2)) y = 0; each undamped mode takes the vibrating solution in which it is largest.
void add_damping(const DenseModes &modes, const Eigen::MatrixXd &B, std::vector<Mode> &result)
{
  const int       p = static_cast<int>(modes.omega.size());
  Eigen::MatrixXd state(2 * p, 2 * p);
  state << Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd::Identity(p, p),
      Eigen::MatrixXd((-modes.omega.array().square()).matrix().asDiagonal()), -modes.V.transpose() * B * modes.V;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(state);
  const Eigen::VectorXcd                    s       = solver.eigenvalues();
  const Eigen::MatrixXcd                    vectors = solver.eigenvectors();
  std::vector<bool>                         taken(2 * p, false);
  for (std::size_t j = 0; j < result.size(); ++j)
  {
    int    best  = -1;
    double share = 0.;
    for (int k = 0; k < 2 * p; ++k)
    {
      if (taken[k] || s[k].imag() <= 1e-9 * std::abs(s[k]))
        continue;
      const auto   y   = vectors.col(k).head(p);
      const double own = std::norm(y[static_cast<Eigen::Index>(j)]) / y.squaredNorm();
      if (own > share)
      {
        share = own;
        best  = k;
      }
    }
    result[j].damping_ratio = std::numeric_limits<double>::quiet_NaN();
    if (best < 0 || share < 0.3)
      continue;
    taken[best]                   = true;
    result[j].damped_frequency_hz = s[best].imag() / two_pi;
    result[j].damping_ratio       = -s[best].real() / std::abs(s[best]);
  }
}

/// @param loads M R [n x 3], the load of a unit acceleration; the effective mass of a mode v is (v . load)^2.
std::vector<Mode> modes_of(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                           const Eigen::MatrixXd &loads, int n_modes, bool damped = true)
{
  if (M.rows() == 0) // everything is held
    return {};
  const DenseModes  modes = dense_modes(C, M);
  std::vector<Mode> result(std::min<Eigen::Index>(n_modes, modes.omega.size()));
  for (std::size_t j = 0; j < result.size(); ++j)
  {
    const Eigen::VectorXd v = modes.V.col(static_cast<Eigen::Index>(j));
    result[j].frequency_hz  = modes.omega[static_cast<Eigen::Index>(j)] / two_pi;
    result[j].shape         = v;
    for (int d = 0; d < 3; ++d)
      result[j].effective_mass[d] = std::pow(v.dot(loads.col(d)), 2);
  }
  if (damped)
    add_damping(modes, B, result);
  return result;
}

/// Multipliers of the joints as the machine moves on from rest.
Eigen::VectorXd multipliers_at_rest(const Machine &machine, const Eigen::VectorXd &q, LocalState &local)
{
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  Eigen::VectorXd       a    = zero;
  IntegrationWork       work;
  ConsistentStart(machine, "modes").solve(q, zero, a, local, work);
  return local.lambda;
}
} // namespace

std::vector<Mode> frame_modes(const Machine &machine, int n_modes)
{
  const ReducedFrame *frame = machine.reduced_frame();
  if (!frame)
    return {};
  return modes_of(frame->M, frame->B, frame->C, frame->translations_load, n_modes);
}

std::vector<Mode> linearised_modes(const Machine &machine, const Eigen::VectorXd &q, const Linearisation &linearisation,
                                   int n_modes)
{
  if (machine.full_frame())
    throw std::invalid_argument("modes: the machine has " + std::to_string(machine.size()) +
                                " coordinates; reduce the frame (reduction.method = \"craig-bampton\") for its modes");
  Eigen::MatrixXd K, B;
  engaged_matrices(machine, q, linearisation.open, K, B);
  K += dense_stiffness(machine);
  B += dense_damping(machine);

  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  LocalState            local;
  local.resize(machine);
  machine.gather(0., q, zero, zero, local);
  const bool jointed = machine.n_constraints() > 0;
  if (linearisation.geometric == GeometricStiffness::included)
  {
    if (jointed)
      local.lambda = linearisation.multipliers ? *linearisation.multipliers : multipliers_at_rest(machine, q, local);
    K += geometric_stiffness(machine, local, linearisation.acting);
  }
  if (!jointed && linearisation.fixed.empty())
    return modes_of(dense_mass(machine), B, K, machine.translation_loads(), n_modes, linearisation.damping);
  const Eigen::MatrixXd Z = free_motions(machine, local, linearisation.fixed);
  std::vector<Mode>     modes =
      modes_of(Z.transpose() * dense_mass(machine) * Z, Z.transpose() * B * Z, Z.transpose() * K * Z,
               Z.transpose() * machine.translation_loads(), n_modes, linearisation.damping);
  for (Mode &mode : modes)
    mode.shape = Z * mode.shape;
  return modes;
}

} // namespace gestell::coupling
