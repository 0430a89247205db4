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

constexpr double two_pi              = 2. * M_PI;
constexpr double commensurate        = 1e-9; ///< of a frequency of the load with a harmonic, relative
constexpr double no_response         = 1e-8; ///< |s - lambda|/|s| below which the response has no digits left
constexpr double no_stiffness_turned = 1e-9; ///< |C turn| against |C| |turn|, term by term

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

/// Shares c_1, c_2 of the two products of a block in R(s), and their slopes over s; what is singular at s = 0 is zero.
struct BlockShares
{
  Complex c[2] = {0., 0.}, slope[2] = {0., 0.};
};

BlockShares shares_at(const ModalBlock &block, Complex s)
{
  BlockShares shares;
  if (block.kind == ModalBlock::oscillating)
  {
    const Complex a = s - block.s, determinant = a * a + block.w * block.w;
    shares.c[0]     = a / determinant;
    shares.c[1]     = block.w / determinant;
    shares.slope[0] = (block.w * block.w - a * a) / (determinant * determinant);
    shares.slope[1] = -2. * a * block.w / (determinant * determinant);
    return shares;
  }
  if (block.kind == ModalBlock::free)
  {
    if (s == 0.)
      return shares;
    shares.c[0]     = 1. / s;
    shares.c[1]     = 1. / (s * s);
    shares.slope[0] = -1. / (s * s);
    shares.slope[1] = -2. / (s * s * s);
    return shares;
  }
  const double eigenvalues[] = {block.s, block.w};
  for (int k = 0; k < 2; ++k)
    if (const Complex a = s - eigenvalues[k]; a != 0.)
    {
      shares.c[k]     = 1. / a;
      shares.slope[k] = -1. / (a * a);
    }
  return shares;
}

/// The two products of read (r_1, r_2) and put (p_1, p_2) that BlockShares weighs.
void products_of(const ModalBlock &block, double r_1, double r_2, double p_1, double p_2, double &first, double &second)
{
  if (block.kind == ModalBlock::oscillating)
  {
    first  = r_1 * p_1 + r_2 * p_2;
    second = r_2 * p_1 - r_1 * p_2;
  }
  else if (block.kind == ModalBlock::free)
  {
    first  = r_1 * p_1 + r_2 * p_2;
    second = r_1 * p_2;
  }
  else
  {
    first  = r_1 * p_1;
    second = r_2 * p_2;
  }
}

} // namespace

BaseResponse::BaseResponse(const PeriodicProblem &problem)
    : modes_(modes_for_harmonics(*problem.system)), begin_(problem.begin)
{
  const MatrixXd W     = MatrixXd(problem.system->forces().directions());
  const auto     modal = 2 * Eigen::Index(modes_.n_modal);
  n_u_                 = int(W.cols());
  n_rows_              = n_u_ + (problem.period_is_unknown() ? 1 : 0);
  read_.resize(modal, n_rows_);
  read_.leftCols(n_u_) = (W.transpose() * modes_.Q.leftCols(modal)).transpose();
  if (problem.period_is_unknown())
    read_.col(n_u_) = modes_.Q.row(problem.phase).head(modal).transpose();
  put_ = modes_.G * W;
  check_turn(problem);
  gather_loads(problem);
  gather_free_motions();
  fill_products();
}

/// A ramp needs no force of the base where C turn = 0.
void BaseResponse::check_turn(const PeriodicProblem &problem) const
{
  MatrixXd M, B, C;
  if (problem.turn.size() == 0 || problem.turn.isZero(0.) || !problem.system->linear().dense_matrices(M, B, C))
    return;
  const VectorXd force = C * problem.turn, terms = C.cwiseAbs() * problem.turn.cwiseAbs();
  for (Eigen::Index i = 0; i < force.size(); ++i)
    if (std::abs(force[i]) > no_stiffness_turned * terms[i])
      refuse_harmonics("a motion that turns in every period stretches a linear spring at " +
                       problem.system->linear().coordinate_name(int(i)) + "; what turns must be free of the base");
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
    const double periods = harmonic.omega * problem.period / two_pi, whole = std::round(periods);
    if (!(whole >= 1.) || std::abs(periods - whole) > commensurate * whole || problem.period_is_unknown())
    {
      std::ostringstream message;
      message.precision(12);
      message << "the load of " << harmonic.omega / two_pi << " Hz has " << periods << " periods in the period of "
              << problem.period << " s; a whole number is needed: give another period";
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
    free_columns_.col(k) = read_.row(free_[k].unknown).transpose();
}

/// The first products of all blocks, then the second ones.  Those of modes that no damping couples have no first ones.
void BaseResponse::fill_products()
{
  const int n_b = modes_.n_modal;
  products_.resize(Eigen::Index(n_rows_) * n_u_, 2 * n_b);
  for (int b = 0; b < n_b; ++b)
    for (int j = 0; j < n_u_; ++j)
      for (int i = 0; i < n_rows_; ++i)
        products_of(modes_.blocks[b], read_(2 * b, i), read_(2 * b + 1, i), put_(2 * b, j), put_(2 * b + 1, j),
                    products_(i + n_rows_ * j, b), products_(i + n_rows_ * j, n_b + b));
  if (products_.leftCols(n_b).isZero(0.))
    products_ = MatrixXd(products_.rightCols(n_b));
  s_.resize(n_b);
  w_.resize(n_b);
  for (int b = 0; b < n_b; ++b)
  {
    const ModalBlock &block = modes_.blocks[b];
    s_[b]                   = block.s;
    w_[b]                   = block.w;
    if (block.kind != ModalBlock::oscillating)
      others_.push_back(b);
  }
}

/// Of all blocks at s = i h omega, real and imaginary parts; at once where they oscillate.
void BaseResponse::fill_shares(int h)
{
  const Eigen::Index   n_b = w_.size(), rest = products_.cols() - n_b;
  const double         Omega = h * omega_;
  const Eigen::ArrayXd x = s_ * s_ + (w_ - Omega) * (w_ + Omega), y = -2. * Omega * s_;
  const Eigen::ArrayXd inverse = (x * x + y * y).inverse(); // 1/det = (x - i y) inverse
  auto                 real = shares_.col(h), imaginary = shares_.col(harmonics_ + 1 + h);
  if (rest > 0)
  {
    real.head(rest)      = ((Omega * y - s_ * x) * inverse).matrix();
    imaginary.head(rest) = ((Omega * x + s_ * y) * inverse).matrix();
  }
  real.tail(n_b)      = (w_ * x * inverse).matrix();
  imaginary.tail(n_b) = (-w_ * y * inverse).matrix();
  for (const int b : others_)
  {
    const BlockShares shares = shares_at(modes_.blocks[b], Complex(0., Omega));
    for (int k = rest > 0 ? 0 : 1; k < 2; ++k)
    {
      real[k == 0 ? b : rest + b]      = shares.c[k].real();
      imaginary[k == 0 ? b : rest + b] = shares.c[k].imag();
    }
  }
}

/// d/domega of the shares.
void BaseResponse::fill_share_slopes(int h)
{
  const Eigen::Index n_b = w_.size(), rest = products_.cols() - n_b;
  for (Eigen::Index b = 0; b < n_b; ++b)
  {
    const BlockShares shares = shares_at(modes_.blocks[b], Complex(0., h * omega_));
    for (int k = rest > 0 ? 0 : 1; k < 2; ++k)
    {
      const Complex      slope               = Complex(0., h) * shares.slope[k];
      const Eigen::Index row                 = k == 0 ? b : rest + b;
      shares_(row, 2 * (harmonics_ + 1) + h) = slope.real();
      shares_(row, 3 * (harmonics_ + 1) + h) = slope.imag();
    }
  }
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
  const int n_h = harmonics + 1;
  shares_.resize(products_.cols(), (slopes == Slopes::with ? 4 : 2) * n_h);
  for (int h = 0; h < n_h; ++h)
  {
    fill_shares(h);
    if (slopes == Slopes::with)
      fill_share_slopes(h);
  }
  table_.noalias() = products_ * shares_.leftCols(2 * n_h);
  if (slopes == Slopes::with)
    slope_.noalias() = products_ * shares_.rightCols(2 * n_h);
  form_forced(slopes);
}

void BaseResponse::check_resonance() const
{
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block = modes_.blocks[b];
    if (block.kind != ModalBlock::oscillating)
      continue;
    const double h = std::round(std::abs(block.w) / omega_);
    if (h < 1. || h > harmonics_ || std::hypot(block.s, std::abs(block.w) - h * omega_) > no_response * h * omega_)
      continue;
    std::ostringstream message;
    message << "an undamped mode at " << std::abs(block.w) / two_pi << " Hz stands at harmonic " << h
            << " of the period, where the base system has no response; give it damping, or take shooting";
    refuse_harmonics(message.str());
  }
}

Eigen::MatrixXcd BaseResponse::matrix(const MatrixXd &table, int h) const
{
  MatrixXcd R(n_rows_, n_u_);
  R.real() = Eigen::Map<const MatrixXd>(table.col(h).data(), n_rows_, n_u_);
  R.imag() = Eigen::Map<const MatrixXd>(table.col(harmonics_ + 1 + h).data(), n_rows_, n_u_);
  return R;
}

/// (s - Lambda)^-1 g; what is singular at s = 0 is left out.
VectorXcd BaseResponse::solve(Complex s, const VectorXcd &g) const
{
  VectorXcd x(g.size());
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    const ModalBlock &block  = modes_.blocks[b];
    const BlockShares shares = shares_at(block, s);
    const Complex     g_1 = g[2 * b], g_2 = g[2 * b + 1];
    const Complex     second = block.kind == ModalBlock::decaying ? shares.c[1] : shares.c[0];
    x[2 * b]                 = shares.c[0] * g_1;
    x[2 * b + 1]             = second * g_2;
    if (block.kind == ModalBlock::oscillating)
      x[2 * b + 1] += shares.c[1] * g_1;
    if (block.kind != ModalBlock::decaying)
      x[2 * b] += (block.kind == ModalBlock::free ? 1. : -1.) * shares.c[1] * g_2;
  }
  return x;
}

/// Put by the loads, with the phase they have at t_0.
VectorXcd BaseResponse::load_at(int h) const
{
  VectorXcd g = VectorXcd::Zero(put_.rows());
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
    forced_[h] = read_.transpose() * x;
    if (slopes == Slopes::none)
      continue;
    const VectorXcd slope =
        h == 0 ? solve(s, turning_.cast<Complex>()) : VectorXcd(Complex(0., h) * (begin_ * x - solve(s, x)));
    forced_slope_[h] = read_.transpose() * slope;
  }
}

/// Divided by omega to the order of the motion, so that equations have the unit of y.
MatrixXd BaseResponse::free_rows() const
{
  MatrixXd rows(n_free(), n_u_);
  for (int k = 0; k < n_free(); ++k)
    rows.row(k) = put_.row(free_[k].equation) * std::pow(omega_, -free_[k].power);
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
  VectorXcd x = solve(Complex(0., h * omega_), put_ * p + load_at(h));
  if (h == 0)
    for (int k = 0; k < n_free(); ++k)
      x[free_[k].unknown] += y[k];
  return modes_.Q.leftCols(put_.rows()) * x;
}

VectorXd BaseResponse::mean_of_free(const VectorXd &q) const
{
  VectorXd y(n_free());
  for (int k = 0; k < n_free(); ++k)
    y[k] = modes_.from_q.row(free_[k].unknown).dot(q);
  return y;
}

} // namespace gestell::coupling
