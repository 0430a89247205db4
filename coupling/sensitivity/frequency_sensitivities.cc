#include "coupling/sensitivity/frequency_sensitivities.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/local_stiffness.h"
#include "coupling/modes/energy_shares.h"

#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double amount_of(const Measure &u, const VectorXd &v)
{
  double sum = 0.;
  for (const auto &[i, weight] : u)
    sum += weight * v[i];
  return sum;
}

struct Matrices
{
  MatrixXd                    M, K, G;
  MatrixXd                    frame, of_measures; ///< K = frame + linear springs + W of_measures W^T
  std::vector<LinearSpring>   springs;
  Eigen::SparseMatrix<double> W;

  /// w^T K v, of springs and elements by what they are compressed: where a motion moves their ends nearly alike, it is
  /// not what is left of the large terms of K, and quotients of it do not lose their digits.
  double stiffness(const VectorXd &w, const VectorXd &v) const
  {
    const Index n   = frame.rows();
    double      sum = w.head(n).dot(frame * v.head(n)) + (W.transpose() * w).dot(of_measures * (W.transpose() * v));
    for (const LinearSpring &spring : springs)
      sum += amount_of(spring.displacement, w) * amount_of(spring.force, v);
    return sum;
  }
};

Matrices matrices(const LinearisedAt &at)
{
  const Machine &machine = *at.machine;
  Matrices       found;
  found.M             = dense_mass(machine);
  found.springs       = linear_springs(machine.model());
  found.W             = machine.forces().directions();
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
  found.of_measures = stiffness_of_measures(machine, local, *at.open);
  found.K           = dense_stiffness(machine) + found.W * found.of_measures * found.W.transpose();
  if (const ReducedFrame *frame = machine.model().reduced_frame())
    found.frame = frame->C;
  return found;
}

/// Mean of M, K and G.
Matrices mean(const Matrices &a, const Matrices &b)
{
  return {0.5 * (a.M + b.M), 0.5 * (a.K + b.K), 0.5 * (a.G + b.G), {}, {}, {}, {}};
}

/// A mode with its left eigenvector and the constraint forces of joints for both.
struct TwoSidedMode
{
  VectorXd v, w, mu, mu_w;
};

/// Left eigenvector by inverse iteration in the motions Z that the joints leave free.
VectorXd left_vector(const Matrices &own, const MatrixXd &Z, const VectorXd &v, double square)
{
  constexpr double nearby     = 1e-8; // of omega^2: nearer than any other frequency, and regular
  constexpr int    iterations = 4;    // from the right vector
  const MatrixXd   A          = Z.transpose() * (own.K.transpose() - (1. + nearby) * square * own.M) * Z,
                 M            = Z.transpose() * own.M;
  VectorXd w                  = v;
  for (int i = 0; i < iterations; ++i)
  {
    w = Z * lu_solution(A, MatrixXd(M * w));
    w /= w.norm();
  }
  return w / w.dot(own.M * v);
}

/// Modes that have derivatives; others are left empty.
std::vector<TwoSidedMode> pairs_of(const Matrices &own, const std::vector<Mode> &modes)
{
  constexpr double rounding = 1e-12; // difference from the transpose, of the largest entry
  const bool       follows = (own.K - own.K.transpose()).cwiseAbs().maxCoeff() > rounding * own.K.cwiseAbs().maxCoeff();
  const bool       jointed = own.G.rows() > 0;
  const LeastSquaresSolver  joints = jointed ? LeastSquaresSolver(MatrixXd(own.G.transpose())) : LeastSquaresSolver();
  const MatrixXd            Z      = !follows  ? MatrixXd()
                                     : jointed ? LeastSquaresSolver(own.G).null_space()
                                               : MatrixXd::Identity(own.K.rows(), own.K.rows());
  std::vector<TwoSidedMode> pairs(modes.size());
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    if (!without_derivative(modes, j).empty())
      continue;
    const double  omega = 2. * M_PI * modes[j].frequency_hz, square = omega * omega;
    TwoSidedMode &pair = pairs[j];
    pair.v             = modes[j].shape;
    pair.w             = follows ? left_vector(own, Z, pair.v, square) : pair.v;
    if (!jointed)
      continue;
    pair.mu   = joints.solve(VectorXd(square * (own.M * pair.v) - own.K * pair.v));
    pair.mu_w = follows ? joints.solve(VectorXd(square * (own.M * pair.w) - own.K.transpose() * pair.w)) : pair.mu;
  }
  return pairs;
}

} // namespace

std::string without_derivative(const std::vector<Mode> &modes, std::size_t j)
{
  const double f = modes[j].frequency_hz;
  if (modes[j].growth > 0. && f == 0.)
    return "the motion grows without oscillation";
  if (f == 0.)
    return "it is a free motion with frequency zero";
  if (modes[j].growth != 0.) // its partner may be no longer among them
    return "the mode flutters";
  constexpr double rest = 1e-6; // of the highest frequency: its square is rounding of the largest
  if (f <= rest * modes.back().frequency_hz)
    return "the frequency is zero compared with the highest one";
  constexpr double meet = 1e-7; // relative difference of frequencies below which their shapes are not unique
  for (const std::size_t other : {j - 1, j + 1})
    if (other < modes.size() && std::abs(modes[other].frequency_hz - f) <= meet * f)
      return "mode " + std::to_string(other + 1) + " has the same frequency";
  return "";
}

MatrixXd frequency_sensitivities(const std::vector<Mode> &modes, const std::vector<FrequencyTwins> &twins)
{
  MatrixXd found =
      MatrixXd::Constant(Index(modes.size()), Index(twins.size()), std::numeric_limits<double>::quiet_NaN());
  std::vector<TwoSidedMode> pairs;
  for (std::size_t k = 0; k < twins.size(); ++k)
  {
    const Matrices below = matrices(twins[k].minus), above = matrices(twins[k].plus);
    const double   quotient = 0.5 / twins[k].step;
    if (k == 0)
      pairs = pairs_of(mean(below, above), modes);
    for (std::size_t j = 0; j < modes.size(); ++j)
    {
      const auto &[v, w, mu, mu_w] = pairs[j];
      if (v.size() == 0)
        continue;
      const double omega = 2. * M_PI * modes[j].frequency_hz;
      double slope = above.stiffness(w, v) - below.stiffness(w, v) - omega * omega * w.dot((above.M - below.M) * v);
      if (mu.size() > 0)
        slope += mu.dot((above.G - below.G) * w) + mu_w.dot((above.G - below.G) * v);
      found(Index(j), Index(k)) = quotient * slope / (4. * M_PI * omega);
    }
  }
  return found;
}

} // namespace gestell::coupling
