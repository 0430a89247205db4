#include "coupling/periodic/harmonic/base_response.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double two_pi = 2. * M_PI; ///< here, as periodic solvers know no fem

[[noreturn]] void refuse_harmonics(const std::string &reason)
{
  throw std::invalid_argument("harmonic balance: " + reason);
}

ModalBlocks modes_for_harmonics(const SecondOrderSystem &system)
{
  try
  {
    return modal_blocks(system);
  }
  catch (const std::invalid_argument &error)
  {
    const std::string text = error.what(), prefix = "exact propagation: ";
    refuse_harmonics(text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text);
  }
}

/// Measures, and the coordinate of the phase behind them [n x n_rows].
MatrixXd rows_of(const PeriodicProblem &problem)
{
  const MatrixXd W = MatrixXd(problem.system->forces().directions());
  if (!problem.period_is_unknown())
    return W;
  MatrixXd rows(W.rows(), W.cols() + 1);
  rows << W, VectorXd::Unit(W.rows(), problem.phase);
  return rows;
}

} // namespace

BaseResponse::BaseResponse(const PeriodicProblem &problem)
    : modes_(modes_for_harmonics(*problem.system)),
      base_(modes_, rows_of(problem), MatrixXd(problem.system->forces().directions())), n_u_(int(base_.put().cols())),
      n_rows_(int(base_.read().cols())), begin_(problem.begin)
{
  check_turn(problem);
  gather_loads(problem);
  gather_free_motions();
}

/// A ramp needs no force of the base where C turn = 0.
void BaseResponse::check_turn(const PeriodicProblem &problem) const
{
  MatrixXd M, B, C;
  if (problem.turn.size() == 0 || problem.turn.isZero(0.) || !problem.system->linear().dense_matrices(M, B, C))
    return;
  const VectorXd   force = C * problem.turn, terms = C.cwiseAbs() * problem.turn.cwiseAbs();
  constexpr double no_stiffness_turned = 1e-9; // |C turn| against |C| |turn|, term by term
  for (Eigen::Index i = 0; i < force.size(); ++i)
    if (std::abs(force[i]) > no_stiffness_turned * terms[i])
      refuse_harmonics("a motion that rotates in every period stretches a linear spring at " +
                       problem.system->linear().coordinate_name(int(i)) +
                       "; rotating coordinates must have no linear springs");
}

void BaseResponse::gather_loads(const PeriodicProblem &problem)
{
  const Excitation &load = problem.system->linear().excitation();
  const VectorXd    turn = problem.turn.size() ? problem.turn : VectorXd::Zero(problem.system->linear().size());
  constant_              = modes_.G * load.constant();
  // x = s (t - t_0) + c + series, s = from_q turn/T, c = from_v turn/T leaves Lambda c - s to the series
  const VectorXd c = modes_.from_v * turn / two_pi;
  turning_         = -modes_.from_q * turn / two_pi;
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block = modes_.blocks[b];
    const double      c_1 = c[2 * b], c_2 = c[2 * b + 1];
    turning_[2 * b] += block.kind == ModalBlock::free ? c_2 : block.s * c_1;
    if (block.kind == ModalBlock::decaying)
      turning_[2 * b + 1] += block.w * c_2;
    else if (block.kind == ModalBlock::oscillating)
    {
      turning_[2 * b] -= block.w * c_2;
      turning_[2 * b + 1] += block.w * c_1 + block.s * c_2;
    }
  }
  for (const Excitation::Harmonic &harmonic : load.harmonics())
  {
    const double     periods = harmonic.omega * problem.period / two_pi, whole = std::round(periods);
    constexpr double commensurate = 1e-9; // of a frequency of the load with a harmonic, relative
    if (!(whole >= 1.) || std::abs(periods - whole) > commensurate * whole || problem.period_is_unknown())
    {
      std::ostringstream message;
      message.precision(12);
      message << "the load of " << harmonic.omega / two_pi << " Hz has " << periods << " periods in the period of "
              << problem.period << " s; an integer is needed: give another period";
      refuse_harmonics(message.str());
    }
    VectorXcd force = VectorXcd::Zero(modes_.G.cols());
    for (const Excitation::Entry &entry : harmonic.load)
      force[entry.coordinate] += Complex(entry.cosine, -entry.sine) / 2.;
    loads_.push_back({int(whole), modes_.G * force});
  }
}

void BaseResponse::gather_free_motions()
{
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block = modes_.blocks[b];
    if (block.kind == ModalBlock::free)
      free_.push_back({2 * b, 2 * b + 1, 2});
    if (block.kind == ModalBlock::decaying && block.s == 0.)
      free_.push_back({2 * b, 2 * b, 1});
    if (block.kind == ModalBlock::decaying && block.w == 0.)
      free_.push_back({2 * b + 1, 2 * b + 1, 1});
  }
  free_columns_.resize(n_rows_, n_free());
  for (int k = 0; k < n_free(); ++k)
    free_columns_.col(k) = base_.read().row(free_[k].unknown).transpose();
}

int BaseResponse::largest_load() const
{
  int largest = 0;
  for (const Load &load : loads_)
    largest = std::max(largest, load.harmonic);
  return largest;
}

void BaseResponse::form(double omega, int harmonics, Slopes slopes)
{
  omega_     = omega;
  harmonics_ = harmonics;
  check_resonance();
  base_.tabulate(omega, harmonics, slopes);
  form_forced(slopes);
}

void BaseResponse::check_resonance() const
{
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block = modes_.blocks[b];
    if (block.kind != ModalBlock::oscillating)
      continue;
    const double     h           = std::round(std::abs(block.w) / omega_);
    constexpr double no_response = 1e-8; // |s - lambda|/|s| below which the response has no digits left
    if (h < 1. || h > harmonics_ || std::hypot(block.s, std::abs(block.w) - h * omega_) > no_response * h * omega_)
      continue;
    std::ostringstream message;
    message << "an undamped mode at " << std::abs(block.w) / two_pi << " Hz coincides with harmonic " << h
            << " of the period, where the base system has no response; give it damping, or use shooting";
    refuse_harmonics(message.str());
  }
}

/// (s - Lambda)^-1 g; what is singular at s = 0 is left out.
VectorXcd BaseResponse::solve(Complex s, const VectorXcd &g) const
{
  VectorXcd x = g;
  base_.divide(s, x);
  return x;
}

/// Put by the loads, with the phase they have at t_0.
VectorXcd BaseResponse::load_at(int h) const
{
  VectorXcd g = VectorXcd::Zero(base_.put().rows());
  if (h == 0)
    g.real() = constant_ + omega_ * turning_;
  for (const Load &load : loads_)
    if (load.harmonic == h)
      g += std::exp(Complex(0., h * omega_ * begin_)) * load.put;
  return g;
}

void BaseResponse::form_forced(Slopes slopes)
{
  forced_.assign(harmonics_ + 1, VectorXcd::Zero(n_rows_));
  forced_slope_ = forced_;
  for (int h = 0; h <= harmonics_; ++h)
  {
    bool loaded = h == 0;
    for (const Load &load : loads_)
      loaded = loaded || load.harmonic == h;
    if (!loaded)
      continue;
    const Complex   s(0., h * omega_);
    const VectorXcd g = load_at(h), x = solve(s, g);
    forced_[h] = base_.read().transpose() * x;
    if (slopes == Slopes::none)
      continue;
    const VectorXcd slope =
        h == 0 ? solve(s, turning_.cast<Complex>()) : VectorXcd(Complex(0., h) * (begin_ * x - solve(s, x)));
    forced_slope_[h] = base_.read().transpose() * slope;
  }
}

/// Divided by omega to the order of the motion, so that equations have the unit of y.
MatrixXd BaseResponse::free_rows() const
{
  MatrixXd rows(n_free(), n_u_);
  for (int k = 0; k < n_free(); ++k)
    rows.row(k) = base_.put().row(free_[k].equation) * std::pow(omega_, -free_[k].power);
  return rows;
}

VectorXd BaseResponse::free_loads() const
{
  VectorXd loads(n_free());
  for (int k = 0; k < n_free(); ++k)
    loads[k] =
        (constant_[free_[k].equation] + omega_ * turning_[free_[k].equation]) * std::pow(omega_, -free_[k].power);
  return loads;
}

VectorXd BaseResponse::free_loads_slope(const VectorXd &p) const
{
  const VectorXd balance = free_rows() * p + free_loads();
  VectorXd       slope(n_free());
  for (int k = 0; k < n_free(); ++k)
    slope[k] = turning_[free_[k].equation] * std::pow(omega_, -free_[k].power) - free_[k].power * balance[k] / omega_;
  return slope;
}

VectorXcd BaseResponse::displacement(int h, const VectorXcd &p, const VectorXd &y) const
{
  VectorXcd x = solve(Complex(0., h * omega_), base_.put() * p + load_at(h));
  if (h == 0)
    for (int k = 0; k < n_free(); ++k)
      x[free_[k].unknown] += y[k];
  return modes_.Q.leftCols(base_.put().rows()) * x;
}

VectorXd BaseResponse::mean_of_free(const VectorXd &q) const
{
  VectorXd y(n_free());
  for (int k = 0; k < n_free(); ++k)
    y[k] = modes_.from_q.row(free_[k].unknown).dot(q);
  return y;
}

} // namespace gestell::coupling
