#include "coupling/periodic/period_search.h"

#include "coupling/periodic/period_flow.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int window_periods = 32, window_samples = 2048; ///< of the lowest frequency; 64 samples each

/// Samples of a window of the motion.
struct Window
{
  VectorXd          times;
  MatrixXd          q, v;  ///< [n x samples]
  std::vector<bool> holds; ///< whether a measure sticks there

  VectorXd middle() const { return 0.5 * (q.rowwise().maxCoeff() + q.rowwise().minCoeff()); }
  VectorXd excursion() const { return 0.5 * (q.rowwise().maxCoeff() - q.rowwise().minCoeff()); }
};

Window next_window(PeriodFlow &flow, PeriodicGuess &at, double length)
{
  Window window;
  window.times.resize(window_samples + 1);
  window.q.resize(at.q.size(), window_samples + 1);
  window.v.resize(at.q.size(), window_samples + 1);
  window.holds.assign(window_samples + 1, false);
  const LocalForces &forces = flow.system().forces();
  Index              k      = 0;
  flow.look_on(window_samples,
               [&](const OrbitPoint &point)
               {
                 window.times[k]              = point.t;
                 window.q.col(k)              = point.q;
                 window.v.col(k)              = point.v;
                 window.holds[std::size_t(k)] = !forces.held().empty();
                 ++k;
               });
  const PeriodPassage &passage = flow.pass(at.q, at.v, length, false);
  at.q                         = passage.q;
  at.v                         = passage.v;
  return window;
}

/// A period of the lowest frequency [s]; without any, 2 pi s: windows of a system in units of its own.
double slowest_period(const SecondOrderSystem &system)
{
  double omega = 0.;
  for (const SpectrumLine &line : system.linear().spectrum())
    if (line.omega > 0. && (omega == 0. || line.omega < omega))
      omega = line.omega;
  return omega > 0. ? 2. * M_PI / omega : 2. * M_PI;
}

/// Passages of a coordinate through a value, linear between samples.
std::vector<OrbitState> passages_through(const Window &window, Index coordinate, double value, bool falls)
{
  const double            direction = falls ? -1. : 1.;
  std::vector<OrbitState> passages;
  for (Index k = 0; k + 1 < window.times.size(); ++k)
  {
    const double a = direction * (window.q(coordinate, k) - value),
                 b = direction * (window.q(coordinate, k + 1) - value);
    if (!(a < 0.) || !(b >= 0.))
      continue;
    const double part = -a / (b - a);
    passages.push_back({window.times[k] + part * (window.times[k + 1] - window.times[k]),
                        window.q.col(k) + part * (window.q.col(k + 1) - window.q.col(k)),
                        window.v.col(k) + part * (window.v.col(k + 1) - window.v.col(k))});
  }
  return passages;
}

/// Passages after which the state comes back; of a motion that does not, 1.
std::size_t passages_of_a_period(const std::vector<OrbitState> &passages, const VectorXd &excursion,
                                 const VectorXd &fastest)
{
  const double  q_size = excursion.norm(), v_size = fastest.norm();
  constexpr int most_passages = 16; // of a coordinate through its middle in one period
  for (std::size_t m = 1; m <= most_passages && m < passages.size(); ++m)
  {
    const OrbitState &last = passages.back(), &before = passages[passages.size() - 1 - m];
    constexpr double  comes_back = 0.02; // distance of two states, of the largest excursions
    if ((last.q - before.q).norm() <= comes_back * q_size && (last.v - before.v).norm() <= comes_back * v_size)
      return m;
  }
  return 1;
}

} // namespace

std::vector<int> whole_ratios(const std::vector<double> &values, double tolerance)
{
  const double least =
      *std::min_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  constexpr int largest_ratio = 64; // of two frequencies: a longer common period is none that a run shows
  for (int base = 1; base <= largest_ratio; ++base)
  {
    std::vector<int> whole;
    for (const double value : values)
    {
      const double ratio = value / std::abs(least) * base, nearest = std::round(ratio);
      if (std::abs(ratio - nearest) > tolerance * std::abs(ratio))
        break;
      whole.push_back(int(nearest));
    }
    if (whole.size() == values.size())
      return whole;
  }
  return {};
}

double common_period(const std::vector<double> &omega)
{
  constexpr double       equal_frequencies = 1e-9; // relative: rounding of numbers that were written with ten digits
  const std::vector<int> whole             = whole_ratios(omega, equal_frequencies);
  return whole.empty() ? 0. : 2. * M_PI * whole[0] / omega[0];
}

VectorXd advance_of(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                    double begin, double time, const std::atomic<bool> *stop)
{
  PeriodicProblem problem;
  problem.stop   = stop;
  problem.system = &system;
  problem.begin  = begin;
  problem.period = time;
  problem.turn   = VectorXd::Zero(from.q.size());
  problem.most_steps *= 10; // of several periods
  PeriodFlow    flow(problem, integration);
  VectorXd      before = from.q, on = VectorXd::Ones(from.q.size()), back = on;
  constexpr int turn_samples = 256; // of a period: what goes back for less does not go back
  flow.look_on(turn_samples,
               [&](const OrbitPoint &point)
               {
                 for (Index i = 0; i < before.size(); ++i)
                   if (const double way = point.q[i] - before[i]; way != 0.)
                     (way > 0. ? back : on)[i] = 0.;
                 before = point.q;
               });
  const VectorXd way = flow.pass(from.q, from.v, time, false).q - from.q;
  // On all the time, or back all the time.
  return way.cwiseProduct(on.cwiseMax(back));
}

namespace
{

/// A motion that is followed window by window until its size stays.
class FreeMotion
{
public:
  FreeMotion(const PeriodicProblem &problem, const MethodOptions &integration, const PeriodicGuess &from)
      : flow_(problem, integration), at_(from), length_(window_periods * problem.period)
  {
  }

  /// @throws NoPeriodicMotion if it comes to rest, or its size never stays
  void follow();
  /// The last rising passages of the coordinate that moves most are a period apart.
  bool is_oscillation(FreeOscillation &found) const;
  /// A longer window from there.
  void lengthen();
  /// A motion from there, in all excursions by `part` larger.
  void enlarge(double part);

  VectorXd excursion() const { return window_.excursion(); }
  bool     pushed() const { return pushed_; }

private:
  bool     sticks_rising(Index phase) const;
  VectorXd speeds() const { return window_.v.rowwise().norm() / std::sqrt(double(window_samples)); }

  PeriodFlow    flow_;
  PeriodicGuess at_;
  double        length_;
  Window        window_;
  bool          pushed_ = false;
};

void FreeMotion::follow()
{
  window_                  = next_window(flow_, at_, length_);
  constexpr double at_rest = 1e-6; // [m/s], [rad/s] slower than any machine swings: such a start is pushed
  if (speeds().norm() <= at_rest)
  {
    // [m/s], [rad/s] of what rests; the user is told, and may start it otherwise
    constexpr double push = 1e-3;
    at_.v.array() += push;
    pushed_ = true;
    window_ = next_window(flow_, at_, length_);
  }
  const double  first        = excursion().norm();
  double        largest      = first;
  constexpr int most_windows = 64; // of 32 periods each: a motion of 0.1 % damping has settled
  for (int w = 1; w < most_windows; ++w)
  {
    const VectorXd before      = excursion();
    window_                    = next_window(flow_, at_, length_);
    largest                    = std::max(largest, excursion().norm());
    constexpr double runs_away = 1e9; // of the excursions of the first window: no machine swings so
    if (!(excursion().norm() < runs_away * first))
      throw NoPeriodicMotion("the machine has no drive, and its oscillation grows without limit: it is unstable; add "
                             "an element that limits its motion, such as a stop or friction");
    constexpr double rests = 1e-6; // of the largest excursions since the start: what steps leave
    if (excursion().norm() <= rests * largest)
      throw NoPeriodicMotion("the machine has no drive: it comes to rest" +
                             std::string(pushed_ ? " after a disturbance of 0.001 m/s and rad/s" : "") +
                             "; give it a load with harmonics, a motor and a speed in [start], or a larger initial "
                             "state from which it keeps oscillating");
    constexpr double settled = 1e-3; // change of the largest excursions, of themselves
    if ((excursion() - before).norm() <= settled * excursion().norm())
      return;
  }
  std::ostringstream text;
  text << "the machine has no drive, and in " << most_windows * length_
       << " s from its initial state it neither comes to rest "
       << "nor to an oscillation of constant amplitude; give [start] closer to it, or a load with harmonics";
  throw NoPeriodicMotion(text.str());
}

/// Whether something sticks where the coordinate rises through its middle: a start there would stand between sticking
/// and sliding, and downwards it may not.
bool FreeMotion::sticks_rising(Index phase) const
{
  const double middle = window_.middle()[phase];
  for (Index k = 0; k + 1 < window_.times.size(); ++k)
    if (window_.q(phase, k) < middle && window_.q(phase, k + 1) >= middle &&
        (window_.holds[std::size_t(k)] || window_.holds[std::size_t(k) + 1]))
      return true;
  return false;
}

bool FreeMotion::is_oscillation(FreeOscillation &found) const
{
  Index phase = 0;
  speeds().maxCoeff(&phase);
  const double middle   = window_.middle()[phase];
  const bool   falls    = sticks_rising(phase);
  const auto   passages = passages_through(window_, phase, middle, falls);
  if (passages.size() < 2)
    return false;
  const std::size_t m    = passages_of_a_period(passages, excursion(), window_.v.rowwise().lpNorm<Eigen::Infinity>());
  const OrbitState &last = passages.back();
  found = {{last.q, last.v, last.t - passages[passages.size() - 1 - m].t}, int(phase), middle, falls, pushed_};
  found.at.q[phase] = middle;
  return true;
}

void FreeMotion::lengthen()
{
  constexpr double longer = 8.; // a window without two passages; three times in all
  length_ *= longer;
  window_ = next_window(flow_, at_, length_);
}

void FreeMotion::enlarge(double part)
{
  at_.q += part * (at_.q - window_.middle());
  at_.v *= 1. + part;
}

} // namespace

FreeOscillation free_oscillation(SecondOrderSystem &system, const MethodOptions &integration, const PeriodicGuess &from,
                                 double begin, const std::atomic<bool> *stop)
{
  PeriodicProblem problem;
  problem.system = &system;
  problem.begin  = begin;
  problem.period = slowest_period(system);
  problem.turn   = VectorXd::Zero(from.q.size());
  problem.stop   = stop;
  problem.most_steps *= 10; // of several periods
  FreeMotion      motion(problem, integration, from);
  FreeOscillation found;
  motion.follow();
  bool          swings            = motion.is_oscillation(found);
  constexpr int most_lengthenings = 3;                   // by 8 each: 500 times slower than the lowest frequency
  for (int k = 0; !swings && k < most_lengthenings; ++k) // as relaxation oscillations, far slower than their frequency
  {
    motion.lengthen();
    swings = motion.is_oscillation(found);
  }
  if (!swings)
    throw NoPeriodicMotion("the machine has no drive, and it moves on without oscillating; add a spring, or give it a "
                           "motor and a speed in [start]");
  const double     size   = motion.excursion().norm();
  constexpr double larger = 0.1; // share by which a motion is made larger, to see whether it comes back
  motion.enlarge(larger);
  motion.follow();
  if (std::abs(motion.excursion().norm() / size - 1.) > 0.5 * larger)
    throw NoPeriodicMotion("the machine has no drive, and the amplitude of its oscillation is that of its initial "
                           "state, as without damping; give it damping, or a load with harmonics");
  return found;
}

} // namespace gestell::coupling
