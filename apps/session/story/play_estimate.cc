#include "apps/session/story/play_estimate.h"

#include "apps/session/history_rows.h"
#include "coupling/periodic/averaging/describing_function.h"
#include "fem/values/two_pi.h"
#include "mechanism/facets.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

/// An element with play, where the modes are found.
struct PlayedElement
{
  const coupling::ElementPlacement *placement;
  int                               first;  ///< of its measures in u
  std::size_t                       signal; ///< of its deflection, also its index in the element
  Eigen::MatrixXd                   K;      ///< engaged [k x k]
};

Eigen::MatrixXd moved_measures(const coupling::Machine &machine, const PlayedElement &played, const Result &result)
{
  Eigen::MatrixXd V(machine.size(), Eigen::Index(result.coupled_modes.size()));
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
    V.col(Eigen::Index(j)) = result.coupled_modes[j].shape;
  return (machine.forces().directions().transpose() * V).middleRows(played.first, played.K.rows());
}

bool opens(const mechanism::Element &element, const double *u, Eigen::MatrixXd &K)
{
  const int k       = element.n_measures();
  K                 = Eigen::MatrixXd::Zero(k, k);
  Eigen::MatrixXd D = K, open = K;
  mechanism::engaged(element, u, K.data(), D.data());
  mechanism::open_branch(element, u, open.data(), D.data());
  return element.force_law() && element.branches() && !K.isZero(0.) && open.isZero(0.);
}

std::vector<PlayedElement> played_elements(const std::vector<coupling::Signal> &signals,
                                           const coupling::Machine &machine, const Eigen::VectorXd &u)
{
  std::vector<PlayedElement> found;
  const auto                &elements = machine.model().elements();
  int                        first    = 0;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    Eigen::MatrixXd K;
    const auto      own = std::find_if(signals.begin(), signals.end(),
                                       [&](const coupling::Signal &signal)
                                       { return signal.element == int(e) && (signal.unit == "m" || signal.unit == "rad"); });
    if (own != signals.end() && opens(*elements[e].element, u.data() + first, K))
      found.push_back({&elements[e], first, std::size_t(own - signals.begin()), K});
    first += elements[e].element->n_measures();
  }
  return found;
}

/// The deflection in the signal for measures u [k] at rest.
double deflection(const PlayedElement &played, const coupling::Signal &signal, const Eigen::VectorXd &u)
{
  const Eigen::VectorXd        zero = Eigen::VectorXd::Zero(u.size());
  const mechanism::LocalMotion motion{0., u.data(), zero.data(), zero.data()};
  const auto                   history = mechanism::started(*played.placement->element, motion);
  return signal.scale * played.placement->element->quantity(signal.quantity, motion, history.data()) + signal.offset;
}

/// d(deflection)/d(x) along u + x d; nan where the deflection is bent over the amplitude, as the distance of a pin that
/// may touch all round.
double deflection_rate(const PlayedElement &played, const coupling::Signal &signal, const Eigen::VectorXd &u,
                       const Eigen::VectorXd &d, double amplitude)
{
  constexpr double step = 1e-7; // [m, rad] of a difference quotient: 1e-16 / 1e-7 is the rounding of its slope
  const double     at = deflection(played, signal, u), x = step / d.norm();
  const double     rate = (deflection(played, signal, u + x * d) - at) / x, far = amplitude / std::abs(rate);
  const double up = deflection(played, signal, u + far * d) - at, down = deflection(played, signal, u - far * d) - at;
  constexpr double bent = 0.05; // of its way, that a deflection may deviate from a straight one
  return std::abs(up + down) <= bent * std::abs(up - down) ? rate : std::numeric_limits<double>::quiet_NaN();
}

/// k_eq over the engaged stiffness for the amplitude A [m] of the deflection about its mean; nan: it has none.
double stiffness_share(const coupling::Machine &machine, const PlayedElement &played, const coupling::Signal &signal,
                       const Eigen::VectorXd &u, const Eigen::VectorXd &d, const PlayEstimate &cycle)
{
  const auto            k    = d.size();
  const Eigen::VectorXd own  = u.segment(played.first, k);
  const double          rate = deflection_rate(played, signal, own, d, cycle.amplitude);
  if (!std::isfinite(rate) || rate == 0.)
    return std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd u_0 = u, direction = Eigen::VectorXd::Zero(u.size());
  u_0.segment(played.first, k) += (cycle.mean - deflection(played, signal, own)) / rate * d;
  direction.segment(played.first, k) = d;
  coupling::DescribedForces forces(machine, direction);
  const double              omega = two_pi * cycle.closed_hz;
  return forces.at(u_0, cycle.amplitude / std::abs(rate), omega).stiffness / d.dot(played.K * d);
}

/// Frequency [Hz] of the machine with the element's stiffness times kappa: of the mode most like mode j.
double softened_hz(const Result &result, const Eigen::MatrixXd &K_modes, double kappa, int j)
{
  Eigen::MatrixXd A = (kappa - 1.) * K_modes;
  for (std::size_t i = 0; i < result.coupled_modes.size(); ++i)
    A(Eigen::Index(i), Eigen::Index(i)) += std::pow(two_pi * result.coupled_modes[i].frequency_hz, 2);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (A + A.transpose()));
  Eigen::Index                                         nearest;
  solver.eigenvectors().row(j).cwiseAbs().maxCoeff(&nearest);
  return std::sqrt(std::max(0., solver.eigenvalues()[nearest])) / two_pi;
}

/// Whether the force of the element changes its sign between the two ends of a cycle's deflection: an element that is
/// loaded on one side only does not cross its clearance.
bool crosses(const PlayedElement &played, const coupling::Signal &signal, const Eigen::VectorXd &u,
             const Eigen::VectorXd &d, const PlayEstimate &cycle)
{
  const Eigen::VectorXd own = u.segment(played.first, d.size()), zero = Eigen::VectorXd::Zero(d.size());
  const double at = deflection(played, signal, own), rate = deflection_rate(played, signal, own, d, cycle.amplitude);
  const auto   force_at = [&](double s)
  {
    const Eigen::VectorXd        moved = own + (s - at) / rate * d;
    const mechanism::LocalMotion motion{0., moved.data(), zero.data(), zero.data()};
    const auto                   history = mechanism::started(*played.placement->element, motion);
    Eigen::VectorXd              p(d.size());
    played.placement->element->force_law()->force(motion, history.data(), p.data());
    return p.dot(d);
  };
  return force_at(cycle.mean - cycle.amplitude) * force_at(cycle.mean + cycle.amplitude) < 0.;
}

/// Whether rows are dense enough for the amplitude of a cycle.
bool fine_rows(const HistoryRows &rows, double begin, double end)
{
  double widest = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows.t(i) > begin && rows.t(i - 1) < end)
      widest = std::max(widest, rows.t(i) - rows.t(i - 1));
  constexpr double coarsest_cycle = 0.05; // distance of rows, of a cycle: extremes to 0.05^2 pi^2 / 2 = 1.2 %
  return widest <= coarsest_cycle * (end - begin);
}

double range_between(const HistoryRows &rows, std::size_t signal, double begin, double end, double *middle = nullptr)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows.t(i) >= begin && rows.t(i) <= end)
    {
      low  = std::min(low, rows.at(i, signal + 1));
      high = std::max(high, rows.at(i, signal + 1));
    }
  if (middle)
    *middle = 0.5 * (high + low);
  return high - low;
}

/// The deflection in the first row after an instant.
double deflection_at(const HistoryRows &rows, std::size_t signal, double t)
{
  std::size_t i = 0;
  while (i + 1 < rows.size() && rows.t(i) < t)
    ++i;
  return rows.at(i, signal + 1);
}

/// Whether two events of one kind are the starts of two cycles: at the same deflection, not on the other side of the
/// clearance.
bool same_side(const HistoryRows &rows, std::size_t signal, double begin, double end)
{
  const double     moved      = deflection_at(rows, signal, end) - deflection_at(rows, signal, begin);
  constexpr double same_place = 0.1; // of the range of a cycle: a passage from the other side is off by half of it
  return std::abs(moved) < same_place * range_between(rows, signal, begin, end);
}

/// The kind of its events that repeats first; empty: none does.
std::string repeated_kind(const coupling::RunResult &run, const std::string &element)
{
  for (std::size_t e = 0; e < run.events.size(); ++e)
    for (std::size_t f = e + 1; f < run.events.size(); ++f)
      if (run.events[e].name == element && run.events[f].name == element && run.events[f].kind == run.events[e].kind)
        return run.events[e].kind;
  return "";
}

std::vector<PlayEstimate> cycles_of(const coupling::RunResult &run, const PlayedElement &played)
{
  std::vector<PlayEstimate> cycles;
  const HistoryRows         rows(run);
  const std::string         kind   = repeated_kind(run, played.placement->name);
  double                    before = std::numeric_limits<double>::quiet_NaN();
  for (const coupling::Event &event : run.events)
  {
    constexpr std::size_t most_cycles = 8; // rows of a table; the first ones show the frequency after the impact
    if (cycles.size() == most_cycles || event.name != played.placement->name || event.kind != kind)
      continue;
    if (before < event.t && !same_side(rows, played.signal, before, event.t))
      continue;
    if (before < event.t && fine_rows(rows, before, event.t))
    {
      PlayEstimate cycle;
      cycle.element   = played.placement->name;
      cycle.begin     = before;
      cycle.end       = event.t;
      cycle.seen_hz   = 1. / (event.t - before);
      cycle.amplitude = 0.5 * range_between(rows, played.signal, before, event.t, &cycle.mean);
      cycles.push_back(cycle);
    }
    before = event.t;
  }
  return cycles;
}

std::string limits_of(const PlayEstimate &cycle, const PlayEstimate *next)
{
  std::string      limits;
  constexpr double mostly_open = 0.3; // kappa below which the motion is far from harmonic
  if (cycle.stiffness_share < mostly_open)
    limits = "mostly open, strongly anharmonic";
  constexpr double decays = 0.3; // share of the amplitude lost until the next cycle
  if (next && next->amplitude < (1. - decays) * cycle.amplitude)
    limits += (limits.empty() ? "" : "; ") + std::string("the amplitude decays fast");
  return limits;
}

/// The mode with the largest strain energy in the element, not the stiffest one; -1: none.
int strained_most(const Eigen::MatrixXd &K_modes, const Result &result)
{
  int    most  = -1;
  double share = 0.;
  for (Eigen::Index i = 0; i < K_modes.rows(); ++i)
    if (const double omega = two_pi * result.coupled_modes[std::size_t(i)].frequency_hz;
        omega > 0. && K_modes(i, i) / (omega * omega) > share)
    {
      share = K_modes(i, i) / (omega * omega);
      most  = int(i);
    }
  return most;
}

/// Common data of all cycles of an element.
struct ClosedMode
{
  int             mode;
  Eigen::MatrixXd K_modes; ///< V^T K_e V
  Eigen::VectorXd d;       ///< of the element's measures
};

void estimate(const coupling::Machine &machine, const PlayedElement &played, const coupling::Signal &signal,
              const Eigen::VectorXd &u, const ClosedMode &closed, const Result &result, PlayEstimate &cycle)
{
  cycle.signal          = signal.name;
  cycle.unit            = signal.unit;
  cycle.mode            = closed.mode;
  cycle.closed_hz       = result.coupled_modes[std::size_t(closed.mode)].frequency_hz;
  cycle.stiffness_share = stiffness_share(machine, played, signal, u, closed.d, cycle);
  if (std::isfinite(cycle.stiffness_share) && !crosses(played, signal, u, closed.d, cycle))
    cycle.stiffness_share = std::numeric_limits<double>::quiet_NaN();
  if (std::isfinite(cycle.stiffness_share))
    cycle.frequency_hz = softened_hz(result, closed.K_modes, cycle.stiffness_share, closed.mode);
}

} // namespace

std::vector<PlayEstimate> play_estimates(const std::vector<coupling::Signal> &signals, coupling::Machine &machine,
                                         const Eigen::VectorXd &q, const Result &result)
{
  const Eigen::VectorXd     u = machine.forces().directions().transpose() * q;
  std::vector<PlayEstimate> all;
  machine.events().follow_history(false); // laws by the motion, whatever branch the run ended in
  for (const PlayedElement &played : played_elements(signals, machine, u))
  {
    const Eigen::MatrixXd moved   = moved_measures(machine, played, result);
    const Eigen::MatrixXd K_modes = moved.transpose() * played.K * moved;
    const int             mode    = strained_most(K_modes, result);
    if (mode < 0)
      continue;
    std::vector<PlayEstimate> cycles = cycles_of(*result.run, played);
    for (PlayEstimate &cycle : cycles)
      estimate(machine, played, signals[played.signal], u, {mode, K_modes, moved.col(mode)}, result, cycle);
    cycles.erase(std::remove_if(cycles.begin(), cycles.end(),
                                [](const PlayEstimate &cycle) { return !std::isfinite(cycle.stiffness_share); }),
                 cycles.end());
    for (std::size_t c = 0; c < cycles.size(); ++c)
      cycles[c].limits = limits_of(cycles[c], c + 1 < cycles.size() ? &cycles[c + 1] : nullptr);
    all.insert(all.end(), cycles.begin(), cycles.end());
  }
  return all;
}

} // namespace gestell::apps
