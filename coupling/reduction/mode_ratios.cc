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
  const auto   points = measured.shape.size() > 0 ? nearest_points(measured, frame) : std::nullopt;
  const double within = points ? 0.3 : 0.2; // of the frequency: what differs more is another mode, or another frame
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
    if (own.distance > within)
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
    refuse(measured, words(measured) + " matches no mode of the frame: no elastic mode is near it; correct the frame, "
                                       "or remove the measured mode");
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

  /// s b^T K^-1 b, K = s^2 E + s (B + diag(d)) + diag(omega^2) of the modes other than j, b the entries of B to them.
  Complex effect_on(Eigen::Index j, const VectorXd &d, const VectorXd &omega, const Complex &s) const
  {
    Eigen::VectorXcd inverse  = (s * s + s * d.array() + omega.array().square()).inverse();
    inverse[j]                = 0.;
    const Eigen::MatrixXcd Gc = G_.cast<Complex>(), T = Gc.transpose() * (inverse.asDiagonal() * Gc);
    const Eigen::VectorXcd b = lambda_.cwiseProduct(G_.row(j).transpose()).cast<Complex>();
    const Eigen::MatrixXcd K = MatrixXd::Identity(T.rows(), T.cols()) + s * (lambda_.cast<Complex>().asDiagonal() * T);
    const Eigen::VectorXcd x = Eigen::PartialPivLU<Eigen::MatrixXcd>(K).solve(b);
    return s * (b.transpose() * (T * x)).value();
  }

private:
  VectorXd lambda_;
  MatrixXd G_;
};

/// d of the modes with ratios of their own, one after the other until they do not change.
void solve_named(const std::vector<NamedMode> &named, const VectorXd &omega, const MatrixXd &B, VectorXd &d)
{
  const DampingBetween between(B);
  constexpr int        most   = 100;
  constexpr double     end    = 1e-14; // of omega
  double               change = 1.;
  VectorXd             size   = omega; // |s|
  for (int i = 0; i < most && change > end; ++i)
  {
    change = 0.;
    for (const NamedMode &one : named)
    {
      const auto    j    = one.mode;
      const double  zeta = one.ratio->ratio, eta = std::sqrt(1. - zeta * zeta), square = omega[j] * omega[j];
      const Complex by   = between.effect_on(j, d, omega, size[j] * Complex(-zeta, eta));
      const double  half = 0.5 * by.imag() / eta;
      size[j]            = half + std::sqrt(half * half + square);
      const double next  = zeta * (size[j] + square / size[j]) - B(j, j) + by.real();
      change             = std::max(change, std::abs(next - d[j]) / omega[j]);
      d[j]               = next;
    }
  }
}

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
                        " and " + percent(one.ratio) +
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
  solve_named(named, omega, B, d);
  constexpr double rounding = 1e-12; // of omega
  for (const NamedMode &one : named)
  {
    const double zeta = one.ratio->ratio, missing = 0.5 * d[one.mode] / omega[one.mode];
    if (!(missing >= -rounding))
      refuse(*one.ratio, "mode " + std::to_string(one.number) + " of the frame, " + rounded(omega[one.mode] / two_pi) +
                             " Hz, has a ratio of " + percent(zeta) + ", but the dampers of the frame alone give it " +
                             percent(zeta - missing) + "; give at least this, or weaken the dampers of foundations");
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
