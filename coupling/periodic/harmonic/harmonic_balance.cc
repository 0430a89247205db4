#include "coupling/periodic/harmonic/harmonic_balance.h"

#include <cmath>
#include <complex>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Place of cos h (of sin h with sine = 1) among c_0, c_1, s_1, ...
int place_of(int h, int sine)
{
  return h == 0 ? 0 : 2 * h - 1 + sine;
}

} // namespace

HarmonicBalance::HarmonicBalance(const PeriodicProblem &problem, int harmonics, int samples)
    : problem_(problem), base_(problem_), n_u_(base_.n_measures()), n_free_(base_.n_free()), period_(problem.period)
{
  set_harmonics(harmonics, samples);
}

void HarmonicBalance::set_harmonics(int harmonics, int samples)
{
  if (harmonics < 1)
    throw std::invalid_argument("harmonic balance: " + std::to_string(harmonics) + " harmonics; at least 1 is needed");
  forces_.reset(); // gives back what elements remember, before another begins
  forces_    = std::make_unique<HarmonicForces>(problem_, harmonics, samples);
  harmonics_ = harmonics;
  size_      = first_free() + n_free_ + (problem_.period_is_unknown() ? 1 : 0);
  formed_    = 0.;
}

void HarmonicBalance::require_load() const
{
  if (const int load = largest_load(); load > harmonics_)
    throw std::invalid_argument("harmonic balance: " + std::to_string(harmonics_) +
                                " harmonics would omit a load of harmonic " + std::to_string(load) +
                                " of the period; request at least " + std::to_string(load) +
                                " harmonics, or omit their number");
}

void HarmonicBalance::set_period(double period)
{
  period_ = period;
}

/// Forms R_h for the period of z, unless they are there.
void HarmonicBalance::use(const VectorXd &z)
{
  if (problem_.period_is_unknown() && z.size() > 0)
    period_ = z[size_ - 1];
  const double omega  = 2. * M_PI / period_;
  const auto   slopes = problem_.period_is_unknown() ? BaseResponse::Slopes::with : BaseResponse::Slopes::none;
  if (omega == formed_)
    return;
  base_.form(omega, harmonics_, slopes);
  formed_             = omega;
  formed_with_slopes_ = problem_.period_is_unknown();
}

MatrixXcd HarmonicBalance::coefficients_of(const VectorXd &z) const
{
  MatrixXcd u(n_u_, harmonics_ + 1);
  u.col(0) = z.head(n_u_).cast<Complex>();
  for (int h = 1; h <= harmonics_; ++h)
  {
    u.col(h).real() = 0.5 * z.segment(n_u_ * place_of(h, 0), n_u_);
    u.col(h).imag() = -0.5 * z.segment(n_u_ * place_of(h, 1), n_u_);
  }
  return u;
}

void HarmonicBalance::put(int h, const VectorXcd &u, VectorXd &z) const
{
  if (h == 0)
  {
    z.head(n_u_) = u.real().head(n_u_);
    return;
  }
  z.segment(n_u_ * place_of(h, 0), n_u_) = 2. * u.real().head(n_u_);
  z.segment(n_u_ * place_of(h, 1), n_u_) = -2. * u.imag().head(n_u_);
}

VectorXd HarmonicBalance::linear_start()
{
  VectorXd z = VectorXd::Zero(size_);
  if (problem_.period_is_unknown())
    z[size_ - 1] = period_;
  use(z);
  for (int h = 0; h <= harmonics_; ++h)
    put(h, base_.u0(h), z);
  return z;
}

VectorXd HarmonicBalance::filled_up(const VectorXd &z, int harmonics) const
{
  const int n                       = n_u_ * (2 * harmonics + 1);
  VectorXd  filled                  = VectorXd::Zero(size_);
  filled.head(n)                    = z.head(n);
  filled.tail(size_ - first_free()) = z.tail(z.size() - n);
  return filled;
}

VectorXd HarmonicBalance::start_through(const VectorXd &q, const VectorXd &v)
{
  VectorXd       z     = linear_start();
  const double   omega = 2. * M_PI / period_;
  const VectorXd ramp  = problem_.turn.size() ? VectorXd(problem_.turn / period_) : VectorXd::Zero(v.size());
  FourierSeries  motion;
  motion.omega  = omega;
  motion.begin  = problem_.begin;
  motion.ramp   = ramp;
  motion.cosine = MatrixXd::Zero(q.size(), 2);
  motion.sine   = motion.cosine;
  // in the time from t_0, as pack() would turn it; what turns is at rest in its mean
  const MatrixXcd linear = displacements(z);
  const VectorXd  mean   = linear.col(0).real();
  VectorXd        cosine = q - mean;
  for (Eigen::Index i = 0; i < ramp.size(); ++i)
    if (ramp[i] != 0.)
    {
      motion.cosine(i, 0) = q[i];
      cosine[i]           = 0.;
    }
    else
      motion.cosine(i, 0) = mean[i];
  const VectorXd sine  = (v - ramp) / omega;
  const double   angle = omega * problem_.begin;
  motion.cosine.col(1) = std::cos(angle) * cosine - std::sin(angle) * sine;
  motion.sine.col(1)   = std::sin(angle) * cosine + std::cos(angle) * sine;
  VectorXd start       = pack(motion);
  if (problem_.period_is_unknown())
    start[size_ - 1] = period_;
  return start;
}

VectorXd HarmonicBalance::pack(const FourierSeries &motion) const
{
  const Eigen::SparseMatrix<double> &W = problem_.system->forces().directions();
  VectorXd                           z = VectorXd::Zero(size_);
  for (int h = 0; h <= std::min(harmonics_, motion.harmonics()); ++h)
  {
    VectorXcd q(motion.cosine.rows());
    q.real() = motion.cosine.col(h);
    q.imag() = -motion.sine.col(h);
    q *= std::exp(Complex(0., h * motion.omega * motion.begin)) * (h == 0 ? 1. : 0.5);
    put(h, W.transpose() * q, z);
  }
  z.segment(first_free(), n_free_) = base_.mean_of_free(motion.cosine.col(0));
  if (problem_.period_is_unknown())
    z[size_ - 1] = 2. * M_PI / motion.omega;
  return z;
}

void HarmonicBalance::balance(const VectorXd &z, VectorXd &r) const
{
  VectorXd moved = z;
  double   phase = -problem_.phase_value;
  for (int h = 0; h <= harmonics_; ++h)
  {
    VectorXcd u = base_.R(h) * forces_->forces().col(h) + base_.u0(h);
    if (h == 0)
      u += base_.free_columns() * free_of(z);
    put(h, u, moved);
    if (problem_.period_is_unknown())
      phase += (h == 0 ? 1. : 2.) * u[n_u_].real();
  }
  r                                = z - moved;
  r.segment(first_free(), n_free_) = base_.free_rows() * forces_->forces().col(0).real() + base_.free_loads();
  if (problem_.period_is_unknown())
    r[size_ - 1] = phase;
}

void HarmonicBalance::residual(const VectorXd &z, VectorXd &r)
{
  use(z);
  forces_->evaluate(coefficients_of(z), 2. * M_PI / period_, HarmonicForces::With::forces);
  balance(z, r);
}

void HarmonicBalance::linearise(const VectorXd &z, VectorXd &r, MatrixXd &J)
{
  use(z);
  const auto with = problem_.period_is_unknown() ? HarmonicForces::With::slope : HarmonicForces::With::derivatives;
  forces_->evaluate(coefficients_of(z), 2. * M_PI / period_, with);
  balance(z, r);
  J.setZero(size_, size_);
  J.topLeftCorner(first_free(), first_free()).setIdentity();
  J.block(0, first_free(), n_u_, n_free_) = -base_.free_columns().topRows(n_u_);
  if (problem_.period_is_unknown())
  {
    J.block(size_ - 1, first_free(), 1, n_free_) = base_.free_columns().row(n_u_);
    J.col(size_ - 1)                             = -2. * M_PI / (period_ * period_) * omega_slope();
  }
  for (const ForceBlock &block : problem_.system->forces().blocks())
    fill_block(block, J);
}

/// What the forces of one element do: -R_h dp_h in the rows of all measures, P_y dp_0 in those of the free motions.
void HarmonicBalance::fill_block(const ForceBlock &block, MatrixXd &J) const
{
  const int      k = block.n_measures, n_coefficients = 2 * harmonics_ + 1, from = block.first_measure;
  const double   omega = 2. * M_PI / period_;
  const MatrixXd rows  = base_.free_rows();
  MatrixXcd      dp(k, k * n_coefficients), du;
  for (int h = 0; h <= harmonics_; ++h)
  {
    for (const HarmonicForces::Derivative &d : forces_->derivatives())
    {
      if (d.i < from || d.i >= from + k)
        continue;
      const int i = d.i - from, j = d.j - from;
      dp(i, j) = d.at(h, 0.);
      for (int l = 1; l <= harmonics_; ++l)
      {
        const Complex plus = d.at(h - l, l * omega), minus = d.at(h + l, -l * omega);
        dp(i, k * place_of(l, 0) + j) = 0.5 * (plus + minus);
        dp(i, k * place_of(l, 1) + j) = Complex(0., -0.5) * (plus - minus);
      }
    }
    du.noalias() = base_.R(h).middleCols(from, k) * dp;
    for (int c = 0; c < n_coefficients; ++c)
      for (int j = 0; j < k; ++j)
      {
        const auto column = du.col(k * c + j);
        const int  at     = n_u_ * c + from + j;
        if (h == 0)
        {
          J.col(at).head(n_u_) -= column.real().head(n_u_);
          J.col(at).segment(first_free(), n_free_) += rows.middleCols(from, k) * dp.col(k * c + j).real();
        }
        else
        {
          J.col(at).segment(n_u_ * place_of(h, 0), n_u_) -= 2. * column.real().head(n_u_);
          J.col(at).segment(n_u_ * place_of(h, 1), n_u_) += 2. * column.imag().head(n_u_);
        }
        if (problem_.period_is_unknown())
          J(size_ - 1, at) += (h == 0 ? 1. : 2.) * column[n_u_].real();
      }
  }
}

/// dr/domega, with the slopes of R_h, u0_h and of the forces at hand.
VectorXd HarmonicBalance::omega_slope() const
{
  VectorXd r = VectorXd::Zero(size_), moved = r;
  double   phase = 0.;
  for (int h = 0; h <= harmonics_; ++h)
  {
    const VectorXcd u =
        base_.R_slope(h) * forces_->forces().col(h) + base_.R(h) * forces_->slope().col(h) + base_.u0_slope(h);
    put(h, u, moved);
    if (problem_.period_is_unknown())
      phase += (h == 0 ? 1. : 2.) * u[n_u_].real();
  }
  r.head(first_free()) = -moved.head(first_free());
  r.segment(first_free(), n_free_) =
      base_.free_loads_slope(forces_->forces().col(0).real()) + base_.free_rows() * forces_->slope().col(0).real();
  if (problem_.period_is_unknown())
    r[size_ - 1] = phase;
  return r;
}

VectorXd HarmonicBalance::period_slope(const VectorXd &z)
{
  use(z);
  if (!formed_with_slopes_)
    base_.form(formed_, harmonics_, BaseResponse::Slopes::with);
  formed_with_slopes_ = true;
  forces_->evaluate(coefficients_of(z), formed_, HarmonicForces::With::slope);
  return -2. * M_PI / (period_ * period_) * omega_slope();
}

VectorXd HarmonicBalance::scales(const VectorXd &z) const
{
  VectorXd amplitude = VectorXd::Zero(n_u_);
  for (int c = 0; c <= 2 * harmonics_; ++c)
    amplitude += z.segment(n_u_ * c, n_u_).cwiseAbs2();
  amplitude            = amplitude.cwiseSqrt();
  const double largest = n_u_ > 0 && amplitude.maxCoeff() > 0. ? amplitude.maxCoeff() : 1.;
  amplitude            = amplitude.unaryExpr([largest](double a) { return a > 1e-12 * largest ? a : largest; });
  VectorXd scale       = VectorXd::Constant(size_, largest);
  for (int c = 0; c <= 2 * harmonics_; ++c)
    scale.segment(n_u_ * c, n_u_) = amplitude;
  for (int k = 0; n_u_ > 0 && k < n_free_; ++k)
    if (const double reach = base_.free_columns().col(k).cwiseAbs().maxCoeff(); reach > 0.)
      scale[first_free() + k] = largest / reach;
  return scale;
}

VectorXd HarmonicBalance::scales_of_rounding(const VectorXd &z) const
{
  VectorXd scale = scales(z);
  if (n_u_ == 0 || problem_.turn.size() == 0)
    return scale;
  const VectorXd turns   = (problem_.system->forces().directions().transpose() * problem_.turn).cwiseAbs();
  const double   largest = scale.head(n_u_).maxCoeff();
  for (int c = 0; c <= 2 * harmonics_; ++c)
    scale.segment(n_u_ * c, n_u_) = scale.segment(n_u_ * c, n_u_).cwiseMax(turns);
  scale.tail(size_ - first_free()) *= scale.head(n_u_).maxCoeff() / largest;
  return scale;
}

HarmonicBalance::LeftOut HarmonicBalance::left_out(const VectorXd &z)
{
  if (n_u_ == 0)
    return {};
  VectorXd r;
  residual(z, r);
  const VectorXd scale = scales(z);
  const int      above = std::min(samples() / 4, 4 * harmonics_ + 8);
  base_.form(2. * M_PI / period_, above, BaseResponse::Slopes::none);
  formed_                    = 0.;
  VectorXd   sum             = VectorXd::Zero(n_u_);
  MatrixXcd  u               = MatrixXcd::Zero(n_u_, above + 1);
  const auto here            = coefficients_of(z);
  u.leftCols(harmonics_ + 1) = here;
  for (int h = harmonics_ + 1; h <= above; ++h)
  {
    u.col(h) = (base_.R(h) * forces_->forces().col(h) + base_.u0(h)).head(n_u_);
    sum += 4. * u.col(h).cwiseAbs2();
  }
  const MatrixXcd errors  = forces_->sampling_errors();
  VectorXd        sampled = VectorXd::Zero(n_u_);
  for (int h = 0; h <= harmonics_; ++h)
  {
    const VectorXd square = (h == 0 ? 1. : 4.) * (base_.R(h) * errors.col(h)).head(n_u_).cwiseAbs2();
    sum += square;
    sampled += square;
  }
  LeftOut          left{sum.cwiseSqrt().cwiseQuotient(scale.head(n_u_)).maxCoeff(), 0.,
               sampled.cwiseSqrt().cwiseQuotient(scale.head(n_u_)).maxCoeff()};
  const VectorXd   ranges = forces_->ranges(), changes = forces_->changes(here, u, 2. * M_PI / period_);
  constexpr double negligible_force = 1e-6; // range of a force, of the largest: its error is not looked at
  const double     least            = negligible_force * ranges.maxCoeff();
  for (int i = 0; i < n_u_; ++i)
    if (ranges[i] > least)
      left.forces = std::max(left.forces, changes[i] / ranges[i]);
  return left;
}

HarmonicForces::Memory HarmonicBalance::memory(const VectorXd &z)
{
  use(z);
  return forces_->memory(coefficients_of(z), 2. * M_PI / period_);
}

/// q_h [n x (H + 1)], coefficients of exp(i h omega (t - t_0)).
MatrixXcd HarmonicBalance::displacements(const VectorXd &z)
{
  VectorXd r;
  residual(z, r);
  MatrixXcd q(problem_.system->linear().size(), harmonics_ + 1);
  for (int h = 0; h <= harmonics_; ++h)
    q.col(h) = base_.displacement(h, forces_->forces().col(h), free_of(z));
  return q;
}

FourierSeries HarmonicBalance::series(const VectorXd &z)
{
  const MatrixXcd q = displacements(z);
  FourierSeries   motion;
  motion.omega = 2. * M_PI / period_;
  motion.begin = problem_.begin;
  motion.ramp  = VectorXd::Zero(q.rows());
  if (problem_.turn.size() > 0)
    motion.ramp = problem_.turn / period_;
  motion.cosine.resize(q.rows(), q.cols());
  motion.sine.resize(q.rows(), q.cols());
  for (int h = 0; h <= harmonics_; ++h)
  {
    const VectorXcd turned = q.col(h) * std::exp(Complex(0., -h * motion.omega * motion.begin));
    motion.cosine.col(h)   = (h == 0 ? 1. : 2.) * turned.real();
    motion.sine.col(h)     = (h == 0 ? 0. : -2.) * turned.imag();
  }
  return motion;
}

void HarmonicBalance::state_at_begin(const VectorXd &z, VectorXd &q, VectorXd &v)
{
  const MatrixXcd c = displacements(z);
  q                 = c.col(0).real();
  v                 = VectorXd::Zero(q.size());
  if (problem_.turn.size() > 0)
    v = problem_.turn / period_;
  for (int h = 1; h <= harmonics_; ++h)
  {
    q += 2. * c.col(h).real();
    v -= 2. * h * 2. * M_PI / period_ * c.col(h).imag();
  }
}

void require_unknowns(const PeriodicProblem &problem, int harmonics)
{
  constexpr int most_asked = 8000; // Newton's matrix and its factor take 1 GB
  const auto    n_u        = std::max<Eigen::Index>(1, problem.system->forces().directions().cols());
  const double  n          = double(n_u) * (2. * harmonics + 1.);
  if (n <= most_asked)
    return;
  std::ostringstream text;
  text << "harmonic balance: " << harmonics << " harmonics of " << n_u << " measures are " << n << " unknowns; at most "
       << most_asked << " are possible: request at most " << (most_asked / n_u - 1) / 2 << " harmonics";
  throw std::invalid_argument(text.str());
}

} // namespace gestell::coupling
