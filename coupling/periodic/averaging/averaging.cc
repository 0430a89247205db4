#include "coupling/periodic/averaging/averaging.h"

#include "coupling/periodic/averaging/slow_flow.h"
#include "coupling/periodic/harmonic/harmonic_balance_method.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

class AveragingMethod final : public PeriodicMethod
{
public:
  std::string name() const override { return "averaging"; }
  std::string meaning() const override
  {
    return "slow flow of one mode with the describing functions of the elements (Bogoliubov, Mitropolsky 1961): quick, "
           "first order";
  }
  std::string refuses(const PeriodicProblem &problem) const override;
  bool        integrates() const override { return false; }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;

private:
  static PeriodicSolution solution_of(const PeriodicProblem &problem, SlowFlow &flow, double a,
                                      const PeriodicOptions &options);
  static std::string      left_out(const PeriodicProblem &problem, const PeriodicSolution &solution,
                                   const PeriodicOptions &options);
  static FourierSeries    series_of(const PeriodicProblem &problem, SlowFlow &flow, double a, double period);
};

std::string AveragingMethod::refuses(const PeriodicProblem &problem) const
{
  try
  {
    SlowFlow flow(problem);
    return "";
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
}

/// Where nothing depends on the time, at the phase that is asked for, rising.
FourierSeries AveragingMethod::series_of(const PeriodicProblem &problem, SlowFlow &flow, double a, double period)
{
  const bool    free     = flow.load_omega() == 0.;
  const int     harmonic = free ? 1 : int(std::lround(flow.load_omega() * period / (2. * M_PI)));
  FourierSeries series;
  series.omega = 2. * M_PI / period;
  series.begin = problem.begin;
  Complex z    = flow.steady(a);
  if (free && problem.period_is_unknown())
  {
    const double x = (problem.phase_value - flow.mean()[problem.phase]) / (a * flow.shape()[problem.phase]);
    if (!(std::abs(x) <= 1.))
      throw std::invalid_argument(
          "averaging: the motion never reaches the value of the phase condition; set it to the mean of the coordinate");
    const double side = (flow.shape()[problem.phase] > 0.) != problem.phase_falls ? 1. : -1.;
    z                 = a * std::exp(Complex(0., -side * std::acos(x) - series.omega * problem.begin));
  }
  const auto n                = flow.shape().size();
  series.ramp                 = VectorXd::Zero(n);
  series.cosine               = MatrixXd::Zero(n, harmonic + 1);
  series.sine                 = series.cosine;
  series.cosine.col(0)        = flow.mean();
  series.cosine.col(harmonic) = z.real() * flow.shape();
  series.sine.col(harmonic)   = -z.imag() * flow.shape();
  return series;
}

PeriodicSolution AveragingMethod::solution_of(const PeriodicProblem &problem, SlowFlow &flow, double a,
                                              const PeriodicOptions &options)
{
  const Eigen::Vector2cd exponents = flow.eigenvalues(a);
  const SlowFlow::Rates  rates     = flow.at(a);
  PeriodicSolution       solution;
  solution.begin  = problem.begin;
  solution.period = flow.load_omega() > 0. ? problem.period : 2. * M_PI / rates.omega;
  solution.ratio  = problem.ratio;
  solution.turn   = VectorXd::Zero(flow.shape().size());
  solution.series = series_of(problem, flow, a, solution.period);
  VectorXd acceleration;
  solution.series->at(problem.begin, solution.q, solution.v, acceleration);
  solution.multipliers = (solution.period * exponents).array().exp();
  if (std::abs(solution.multipliers[0]) < std::abs(solution.multipliers[1]))
    std::swap(solution.multipliers[0], solution.multipliers[1]);
  solution.trivial_multiplier = flow.load_omega() == 0.;
  solution.method             = "averaging";
  solution.integration        = options.integration;
  std::ostringstream note;
  note.precision(2);
  note << "first order in the frequency shift of the mode by the elements, here "
       << std::abs(rates.omega / flow.omega_0() - 1.) << " of it; multipliers are those of this mode";
  solution.notes.push_back(note.str());
  solution.notes.push_back(left_out(problem, solution, options));
  return solution;
}

/// Coefficients of exp(i h omega (t - t_0)); zero beyond those of the series.
VectorXcd coefficients(const FourierSeries &series, int h)
{
  if (h > series.harmonics())
    return VectorXcd::Zero(series.ramp.size());
  VectorXcd c(series.ramp.size());
  c.real() = 0.5 * series.cosine.col(h);
  c.imag() = -0.5 * series.sine.col(h);
  return c * std::polar(1., h * series.omega * series.begin);
}

/// |a - b| / |a| over a period, means left out, of the coordinate that moves most in its unit.
double distance_of(const FourierSeries &a, const FourierSeries &b)
{
  VectorXd apart = VectorXd::Zero(a.ramp.size()), size = apart;
  for (int h = 1; h <= std::max(a.harmonics(), b.harmonics()); ++h)
  {
    const VectorXcd x = coefficients(a, h);
    apart += (x - coefficients(b, h)).cwiseAbs2();
    size += x.cwiseAbs2();
  }
  Eigen::Index widest;
  size.maxCoeff(&widest);
  return std::sqrt(apart[widest] / size[widest]);
}

/// How far harmonic balance with three times the harmonics is from it.
std::string AveragingMethod::left_out(const PeriodicProblem &problem, const PeriodicSolution &solution,
                                      const PeriodicOptions &options)
{
  std::ostringstream note;
  note.precision(2);
  try
  {
    const int             H        = 3 * solution.series->harmonics();
    const PeriodicOptions few      = with_harmonics(options, H);
    const auto            balanced = [&](double period) {
      return harmonic_balance_method().solve(problem, {solution.q, solution.v, period}, few).front();
    };
    PeriodicSolution other;
    try
    {
      other = balanced(solution.period);
    }
    catch (const std::exception &) // of its resonance
    {
      if (!problem.period_is_unknown() || problem.interrupted())
        throw;
      constexpr double beside_resonance = 1.03; // times the period: an undamped base has no response at its resonance
      other                             = balanced(beside_resonance * solution.period);
    }
    constexpr double far_away = 0.5; // of the amplitude: another motion, as the period differs by 3 % only
    if (const double apart = distance_of(*solution.series, *other.series); apart <= far_away)
    {
      note << "harmonic balance with " << H << " harmonics differs from it by " << apart << " of its amplitude";
      if (problem.period_is_unknown())
        note << " and by " << std::abs(other.period / solution.period - 1.) << " of its period";
      return note.str();
    }
    note << "harmonic balance with " << H << " harmonics leads to another solution from here";
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const std::exception &) // a law that harmonic balance does not take, or no motion
  {
    note << "harmonic balance finds no solution near it";
  }
  note << ": the error of averaging is unknown; use --check shooting";
  return note.str();
}

std::vector<PeriodicSolution> AveragingMethod::solve(const PeriodicProblem &problem, const PeriodicGuess &,
                                                     const PeriodicOptions &options) const
{
  SlowFlow                      flow(problem);
  std::vector<PeriodicSolution> found;
  for (const double a : flow.amplitudes())
    found.push_back(solution_of(problem, flow, a, options));
  if (found.empty())
  {
    std::ostringstream message;
    message << "averaging: the mode of " << flow.omega_0() / (2. * M_PI)
            << " Hz has no steady amplitude; use settling to see the motion";
    throw NoPeriodicMotion(message.str());
  }
  return found;
}

} // namespace

const PeriodicMethod &averaging_method()
{
  static const AveragingMethod method;
  return method;
}

} // namespace gestell::coupling
