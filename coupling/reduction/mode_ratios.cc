#include "coupling/reduction/mode_ratios.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/system/dense_solvers.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// Of its frequency: farther away is another mode.  A model with half the stiffness of a foundation has 1 - 1/sqrt(2) =
/// 29 % less (the press of `gestell new press`: 2.00 in place of 2.82 Hz), and other errors shift a mode less.
constexpr double near_measured = 0.3;

/// A mode of the frame that may be the measured one.
struct Candidate
{
  int    mode; ///< elastic, from 0
  double hz, distance, mac;
};

/// Index of the point of the frame nearest to each measured point; none if one of them is off the frame.
std::optional<std::vector<Eigen::Index>> nearest_points(const fem::NamedRatio &measured, const ModesAtPoints &frame)
{
  if (frame.points.empty() || frame.shapes.rows() != 3 * Eigen::Index(frame.points.size()))
    return {};
  const Eigen::Map<const Eigen::Matrix3Xd> points(frame.points.front().data(), 3, Eigen::Index(frame.points.size()));
  constexpr double                         on_frame = 0.02; // of its size: paths of sensors are measured by hand
  const double                             size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  std::vector<Eigen::Index>                found;
  for (const auto &point : measured.points)
  {
    Eigen::Index best = 0;
    const double off =
        std::sqrt((points.colwise() - Eigen::Vector3d(point.data())).colwise().squaredNorm().minCoeff(&best));
    if (off > on_frame * size)
      return {};
    found.push_back(best);
  }
  return found;
}

double mac(const Eigen::VectorXcd &a, const VectorXd &b)
{
  const double size = a.squaredNorm() * b.squaredNorm();
  return size > 0. ? std::norm(a.dot(b.cast<std::complex<double>>())) / size : 0.;
}

/// The elastic modes near the measured frequency, with their MAC if it can be known; else nan.
std::vector<Candidate> candidates_of(const fem::NamedRatio &measured, const ModesAtPoints &frame)
{
  const auto                points = measured.shape.size() > 0 ? nearest_points(measured, frame) : std::nullopt;
  std::vector<Candidate>    found;
  std::vector<Eigen::Index> values; // that were measured
  for (Eigen::Index i = 0; points && i < measured.shape.size(); ++i)
    if (measured.shape[i] != 0.)
      values.push_back(i);
  for (Eigen::Index j = 0, elastic = 0; j < frame.omega.size(); ++j)
  {
    if (frame.omega[j] <= 0.)
      continue;
    const double hz = frame.omega[j] / two_pi;
    Candidate    own{int(elastic++), hz, std::abs(hz / measured.from - 1.), std::numeric_limits<double>::quiet_NaN()};
    if (own.distance > near_measured)
      continue;
    if (points)
    {
      VectorXd b(Eigen::Index(values.size()));
      for (std::size_t i = 0; i < values.size(); ++i)
        b[Eigen::Index(i)] = frame.shapes(3 * (*points)[std::size_t(values[i] / 3)] + values[i] % 3, j);
      own.mac = mac(measured.shape(values), b);
    }
    found.push_back(own);
  }
  if (values.size() < found.size()) // such shapes tell nothing apart
    for (Candidate &own : found)
      own.mac = std::numeric_limits<double>::quiet_NaN();
  return found;
}

std::string words(const Candidate &own)
{
  return "mode " + std::to_string(own.mode + 1) + ", " + rounded(own.hz) + " Hz" +
         (std::isnan(own.mac) ? "" : ", MAC " + rounded(own.mac, 2));
}

std::string words(const fem::NamedRatio &measured)
{
  return "the measured mode of " + rounded(measured.from) + " Hz";
}

[[noreturn]] void refuse(const fem::NamedRatio &one, const std::string &reason)
{
  throw std::invalid_argument((one.place.empty() ? std::string("damping") : one.place) + ": " + reason);
}

int mode_of(const fem::NamedRatio &measured, const ModesAtPoints &frame, std::vector<std::string> &statements)
{
  const std::vector<Candidate> near = candidates_of(measured, frame);
  const bool shapes = std::any_of(near.begin(), near.end(), [](const Candidate &own) { return !std::isnan(own.mac); });
  const auto best   = std::max_element(near.begin(), near.end(),
                                       [&](const Candidate &a, const Candidate &b)
                                       { return shapes ? a.mac < b.mac : a.distance > b.distance; });
  constexpr double least_mac = 0.5; // those of one shape with orthogonal ones sum up to 1: above it there is one
  std::string      others;
  for (const Candidate &own : near)
    others += (others.empty() ? "" : "; ") + words(own);
  if (near.empty())
    refuse(measured, words(measured) + " matches no mode of the frame: no elastic mode is within " +
                         percent(near_measured) + " of it; correct the frame, or remove the measured mode");
  if (shapes && !(best->mac >= least_mac))
    refuse(measured, words(measured) + " matches no mode of the frame: a MAC of " + rounded(least_mac, 2) +
                         " is needed; candidates: " + others + "; correct the frame, or give the number of the mode");
  statements.push_back("damping: " + words(measured) + " is " + words(*best) + " of the frame, ratio " +
                       percent(measured.ratio));
  return best->mode;
}

/// A mode with a ratio of its own.
struct NamedMode
{
  Eigen::Index           mode; ///< in ascending order, with rigid-body modes
  int                    number;
  const fem::NamedRatio *ratio;
};

std::vector<NamedMode> named_modes(const fem::ModalRatios &ratios, const VectorXd &omega)
{
  std::vector<NamedMode> found;
  for (Eigen::Index j = 0, elastic = 0; j < omega.size(); ++j)
  {
    if (!(omega[j] > 0.))
      continue;
    const fem::NamedRatio *own = nullptr; // a number before an interval
    for (const fem::NamedRatio &one : ratios.named)
      if (one.mode == elastic || (!own && one.mode < 0 && two_pi * one.from <= omega[j] && omega[j] < two_pi * one.to))
        own = &one;
    if (own)
      found.push_back({j, int(elastic) + 1, own});
    ++elastic;
  }
  return found;
}

/// Symmetric damping between modes, B = G diag(lambda) G^T.
class DampingBetween
{
public:
  explicit DampingBetween(const MatrixXd &B)
  {
    const SymmetricEigenSolver solver(B);
    constexpr double           rounding = 1e-15; // of eigenvalues
    const VectorXd             size     = solver.eigenvalues().cwiseAbs();
    std::vector<Eigen::Index>  kept;
    for (Eigen::Index i = 0; i < size.size(); ++i)
      if (size[i] > rounding * size.maxCoeff())
        kept.push_back(i);
    lambda_ = solver.eigenvalues()(kept);
    G_      = solver.eigenvectors()(Eigen::all, kept);
  }

  /// The equation (10b) of mode j over s, with a share tau of B, and y: K y = 0 but for row j, y_j = 1.
  struct Equation
  {
    Complex          value, by_s; ///< and its derivative
    Eigen::VectorXcd y;
  };
  Equation of_mode(Eigen::Index j, const VectorXd &d, const VectorXd &omega, const Complex &s, double tau) const
  {
    const VectorXd   lambda  = tau * lambda_;
    Eigen::VectorXcd inverse = (s * s + s * d.array() + omega.array().square()).inverse();
    inverse[j]               = 0.;
    const Eigen::MatrixXcd G = G_.cast<Complex>();
    const Eigen::MatrixXcd E = MatrixXd::Identity(G.cols(), G.cols()), T = G.transpose() * (inverse.asDiagonal() * G);
    const Eigen::VectorXcd g = lambda.cwiseProduct(G_.row(j).transpose()).cast<Complex>();
    const Eigen::VectorXcd x = Eigen::PartialPivLU<Eigen::MatrixXcd>(E + s * (lambda.asDiagonal() * T)).solve(g);

    Equation result;
    result.y                       = -s * inverse.cwiseProduct(G * x);
    result.y[j]                    = 1.;
    const Eigen::VectorXcd z       = G.transpose() * result.y;
    const Complex          B       = (z.transpose() * (lambda.asDiagonal() * z)).value();
    const Complex          squares = (result.y.transpose() * result.y).value();
    const Complex          dampers = (result.y.transpose() * (d.asDiagonal() * result.y)).value();
    const Complex          b_jj    = (G_.row(j).cwiseAbs2() * lambda).value();
    result.value                   = s + d[j] + b_jj - s * (g.transpose() * (T * x)).value() + omega[j] * omega[j] / s;
    result.by_s                    = (2. * s * squares + B + dampers - result.value) / s;
    return result;
  }

private:
  VectorXd lambda_;
  MatrixXd G_;
};

/// d and |s| of the modes with ratios of their own by Newton's method, docs/theory/reduction.md (10b).
class NamedDampers
{
public:
  NamedDampers(const std::vector<NamedMode> &named, const VectorXd &omega, const MatrixXd &B, VectorXd d)
      : named_(named), omega_(omega), between_(B), d_(std::move(d)), size_(omega)
  {
  }

  /// From no damping between modes to all of it in steps that converge.
  /// @throws std::invalid_argument with the mode that has no solution
  VectorXd solve()
  {
    constexpr double least = 1. / 256.; // of the damping between modes: where steps become small there is no solution
    double           tau = 0., step = 1.;
    while (tau < 1.)
    {
      const VectorXd d = d_, size = size_;
      if (converges(tau + step))
      {
        tau += step;
        step = std::min(1. - tau, 2. * step);
        continue;
      }
      d_ = d, size_ = size;
      step *= 0.5;
      if (step < least)
        refuse_coupled();
    }
    return d_;
  }

private:
  bool converges(double tau)
  {
    constexpr int    most    = 30;
    constexpr double settled = 1e-13; // of omega: rounding
    for (int i = 0; i < most; ++i)
    {
      const double error = equations(tau);
      if (error <= settled)
        return distinct();
      const VectorXd change = Eigen::PartialPivLU<MatrixXd>(jacobian_).solve(-values_);
      if (!change.allFinite() || !is_closer(change, error, tau))
        return error <= rounding_ && distinct();
    }
    return false;
  }

  /// Whether each mode has a root of its own.
  bool distinct()
  {
    constexpr double apart = 1e-6; // of omega: far above the error of a root, far below the distance of two
    for (std::size_t k = 0; k < named_.size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        if (const auto i = named_[k].mode, j = named_[l].mode;
            std::abs(size_[i] - size_[j]) <= apart * omega_[i] &&
            std::abs(named_[k].ratio->ratio - named_[l].ratio->ratio) <= apart)
        {
          worst_ = Eigen::Index(k);
          return false;
        }
    return true;
  }

  /// Takes as much of the change as makes the error smaller.
  bool is_closer(const VectorXd &change, double error, double tau)
  {
    const VectorXd d = d_, size = size_;
    for (double part = 1.; part > 1e-3; part *= 0.5) // below it, it is not the curvature
    {
      for (std::size_t k = 0; k < named_.size(); ++k)
      {
        const Eigen::Index j = named_[k].mode;
        d_[j]                = d[j] + part * change[Eigen::Index(2 * k)];
        size_[j]             = size[j] + part * change[Eigen::Index(2 * k + 1)];
      }
      if (size_.minCoeff() >= 0. && equations(tau) < error)
        return true;
    }
    d_ = d, size_ = size;
    return false;
  }

  /// Values and derivatives of (10b); returns the largest error over omega.
  double equations(double tau)
  {
    const auto n = Eigen::Index(named_.size());
    values_.resize(2 * n);
    jacobian_.resize(2 * n, 2 * n);
    double largest = 0.;
    for (Eigen::Index k = 0; k < n; ++k)
    {
      const Eigen::Index j     = named_[std::size_t(k)].mode;
      const double       zeta  = named_[std::size_t(k)].ratio->ratio;
      const Complex      angle = Complex(-zeta, std::sqrt(1. - zeta * zeta));
      const auto         own   = between_.of_mode(j, d_, omega_, size_[j] * angle, tau);
      const auto         put   = [&](Eigen::Index column, const Complex &value)
      {
        jacobian_(2 * k, column)     = value.real();
        jacobian_(2 * k + 1, column) = value.imag();
      };
      values_.segment<2>(2 * k) << own.value.real(), own.value.imag();
      for (Eigen::Index l = 0; l < n; ++l)
      {
        const Complex y = own.y[named_[std::size_t(l)].mode];
        put(2 * l, y * y);
        put(2 * l + 1, l == k ? own.by_s * angle : 0.);
      }
      if (const double error = std::abs(own.value) / omega_[j]; !(error <= largest))
        largest = std::isfinite(error) ? error : std::numeric_limits<double>::infinity(), worst_ = k;
    }
    return largest;
  }

  [[noreturn]] void refuse_coupled() const
  {
    const NamedMode &one = named_[std::size_t(worst_)];
    refuse(*one.ratio, "mode " + std::to_string(one.number) + " of the frame, " + rounded(omega_[one.mode] / two_pi) +
                           " Hz, is coupled by dampers with modes of nearly the same frequency, so that no modal "
                           "damper gives it a ratio of " +
                           percent(one.ratio->ratio) + "; leave it out, or weaken the dampers of foundations");
  }

  static constexpr double       rounding_ = 1e-10; ///< of omega: accepted where Newton's method comes no closer
  const std::vector<NamedMode> &named_;
  const VectorXd               &omega_;
  DampingBetween                between_;
  VectorXd                      d_, size_;
  VectorXd                      values_;
  MatrixXd                      jacobian_;
  Eigen::Index                  worst_ = 0;
};

} // namespace

fem::ModalRatios matched(fem::ModalRatios ratios, const ModesAtPoints &modes, std::vector<std::string> &statements)
{
  const auto elastic = (modes.omega.array() > 0.).count();
  for (std::size_t i = 0; i < ratios.named.size(); ++i)
  {
    fem::NamedRatio &one = ratios.named[i];
    if (one.is_measured())
      one.mode = mode_of(one, modes, statements);
    const auto inside =
        (modes.omega.array() > 0. && modes.omega.array() >= two_pi * one.from && modes.omega.array() < two_pi * one.to)
            .count();
    if (one.mode < 0 && inside == 0)
      refuse(one, "no elastic mode of the frame has a frequency from " + rounded(one.from) + " to " + rounded(one.to) +
                      " Hz; `gestell modes` prints them");
    if (one.mode >= elastic)
      refuse(one, "is of mode " + std::to_string(one.mode + 1) + ", but the model of the frame has " +
                      std::to_string(elastic) + " elastic modes; give a lower number, or increase reduction.modes");
    for (std::size_t other = 0; other < i && one.mode >= 0; ++other)
      if (ratios.named[other].mode == one.mode)
        refuse(one, "mode " + std::to_string(one.mode + 1) + " has two ratios, " + percent(ratios.named[other].ratio) +
                        (ratios.named[other].place.empty() ? "" : " (" + ratios.named[other].place + ")") + " and " +
                        percent(one.ratio) +
                        "; leave one out, or give measured modes the numbers of the frame's in a column `mode`");
  }
  return ratios;
}

VectorXd modal_dampers(const fem::ModalRatios &ratios, const VectorXd &omega, const MatrixXd &B)
{
  VectorXd   d     = ratios.modal_dampers(omega);
  const auto named = named_modes(ratios, omega);
  if (named.empty() || B.isZero(0.))
    return d;
  d                         = NamedDampers(named, omega, B, std::move(d)).solve();
  constexpr double rounding = 1e-12; // of omega
  for (const NamedMode &one : named)
  {
    const double zeta = one.ratio->ratio, missing = 0.5 * d[one.mode] / omega[one.mode];
    if (!(missing >= -rounding))
      refuse(*one.ratio, "mode " + std::to_string(one.number) + " of the frame, " + rounded(omega[one.mode] / two_pi) +
                             " Hz, has a ratio of " + percent(zeta) +
                             ", but the dampers of the frame alone give it "
                             "about " +
                             percent(zeta - missing) + "; give a larger ratio, or weaken the dampers of foundations");
    d[one.mode] = std::max(d[one.mode], 0.);
  }
  return d;
}

void add_modal_damping(ReducedFrame &frame, const fem::ModalRatios &ratios)
{
  if (!ratios.any())
    return;
  const DenseModes own = dense_modes(frame.C, frame.M, cancelled_by_reduction, frame.n_rigid());
  ModesAtPoints    modes{own.omega, frame.points};
  if (frame.displacement.rows() > 0)
    modes.shapes = frame.displacement.cast<double>() * own.V;
  const VectorXd d =
      modal_dampers(matched(ratios, modes, frame.statements), own.omega, own.V.transpose() * frame.B * own.V);
  const MatrixXd Z = frame.M * own.V;
  frame.B += Z * d.asDiagonal() * Z.transpose();
  for (fem::FrameOutput &output : frame.outputs) // like inertia, these forces act on masses
    if (output.on_a.size() > 0)
      output.on_v += Z * d.cwiseProduct(own.V.transpose() * output.on_a);
}

} // namespace gestell::coupling
