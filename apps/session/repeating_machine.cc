#include "apps/session/repeating_machine.h"

#include "apps/session/option_value.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
using coupling::BodyKind;
using Eigen::VectorXd;

constexpr int    largest_ratio = 64;   ///< of frequencies or speeds that have a common period
constexpr double equal_ratio   = 1e-9; ///< of frequencies
constexpr double equal_speeds  = 1e-2; ///< of speeds at the start, which elastic shafts let differ a little
constexpr double no_stiffness  = 1e-9; ///< of what turns, against the largest stiffness of the coordinate
constexpr double same_force    = 1e-9; ///< of forces a period later, against the largest change

/// Angles [rad] of rotors.  Planar bodies may turn round or swing, which the model does not say: they are left out.
std::vector<int> turning_coordinates(const coupling::Machine &machine)
{
  std::vector<int> angles;
  for (const coupling::Body &body : machine.model().bodies())
    if (body.kind == BodyKind::rotor)
      angles.push_back(body.coordinate);
  return angles;
}

/// Least whole numbers p_i in the ratio of the values, within `tolerance`; empty: there are none.
std::vector<int> whole_ratios(const std::vector<double> &values, double tolerance)
{
  const double least =
      *std::min_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
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

std::vector<double> load_frequencies(const coupling::Machine &machine)
{
  std::vector<double> omega;
  for (const auto &harmonic : machine.linear().excitation().harmonics())
    omega.push_back(harmonic.omega);
  return omega;
}

/// 2 pi over the largest common divisor of the frequencies [rad/s].
double common_period(const std::vector<double> &omega, const Scene &scene)
{
  const std::vector<int> whole = whole_ratios(omega, equal_ratio);
  if (!whole.empty())
    return 2. * M_PI * whole[0] / omega[0];
  std::ostringstream text;
  text << scene.file << ": the loads have no common period; their frequencies are";
  for (const double w : omega)
    text << ' ' << short_text(w / (2. * M_PI), 8) << " Hz";
  text << ": make them commensurate (ratios of whole numbers up to " << largest_ratio
       << "), or look at the spectra of a run instead";
  throw std::invalid_argument(text.str());
}

/// Names of the elements whose force depends explicitly on the time, measures and rates kept as in the state.
std::vector<std::string> told_by_time(const coupling::Machine &machine, const coupling::InitialState &start,
                                      double span, double period)
{
  constexpr int        probes = 7;
  coupling::LocalState state;
  state.resize(machine);
  state.u           = machine.forces().directions().transpose() * start.q;
  state.v           = machine.forces().directions().transpose() * start.v;
  const auto blocks = machine.forces().blocks();
  const auto forces = [&](double t)
  {
    state.t    = t;
    VectorXd p = VectorXd::Zero(state.u.size());
    machine.forces().force(state, p);
    return p;
  };
  const VectorXd p_0     = forces(start.t);
  VectorXd       changes = VectorXd::Zero(p_0.size()), differs = changes;
  for (int k = 1; k <= probes; ++k)
  {
    const double   t = start.t + span * (k - 0.37) / probes;
    const VectorXd p = forces(t);
    changes          = changes.cwiseMax((p - p_0).cwiseAbs());
    differs = differs.cwiseMax(period > 0. ? VectorXd((forces(t + period) - p).cwiseAbs()) : VectorXd(changes));
  }
  std::vector<std::string> names;
  std::size_t              b = 0;
  for (const coupling::ElementPlacement &placement : machine.model().elements())
  {
    if (placement.element->ideal_joint() || b >= blocks.size())
      continue;
    const auto   of     = [&](const VectorXd &x) { return x.segment(blocks[b].first_measure, blocks[b].n_measures); };
    const double change = of(changes).maxCoeff();
    if (change > 0. && of(differs).maxCoeff() > same_force * change)
      names.push_back(placement.name);
    ++b;
  }
  return names;
}

/// Whole turns [rad] in the ratio of the speeds at the start, of angles that turn without stiffness; zero: nothing
/// does.
VectorXd turns_of(const coupling::Machine &machine, const coupling::InitialState &start)
{
  VectorXd            turn = VectorXd::Zero(machine.size());
  std::vector<int>    angles;
  std::vector<double> speeds;
  for (const int i : turning_coordinates(machine))
    if (start.v[i] != 0.)
    {
      angles.push_back(i);
      speeds.push_back(start.v[i]);
    }
  if (angles.empty())
    return turn;
  const std::vector<int> whole = whole_ratios(speeds, equal_speeds);
  if (whole.empty())
    return turn;
  for (std::size_t k = 0; k < angles.size(); ++k)
    turn[angles[k]] = 2. * M_PI * whole[k];
  VectorXd held(turn.size());
  machine.linear().stiffness_times(turn, held);
  Eigen::MatrixXd M, B, C;
  double          largest = 0.;
  if (machine.linear().dense_matrices(M, B, C))
    for (const int i : angles)
      largest = std::max(largest, C.row(i).cwiseAbs().maxCoeff());
  if (held.cwiseAbs().maxCoeff() > no_stiffness * largest)
    turn.setZero();
  return turn;
}

/// The turning angle that needs longest for a turn.
int slowest_of(const VectorXd &turn)
{
  int slowest = -1;
  for (Eigen::Index i = 0; i < turn.size(); ++i)
    if (turn[i] != 0. && (slowest < 0 || std::abs(turn[i]) < std::abs(turn[slowest])))
      slowest = int(i);
  return slowest;
}

std::string joined(const std::vector<std::string> &names)
{
  std::string all;
  for (const std::string &name : names)
    all += (all.empty() ? "'" : ", '") + name + "'";
  return all;
}

double asked_period(const PeriodicRequest &request)
{
  if (request.period.empty())
    return 0.;
  const double period = option_value("--period", request.period, kind::time);
  if (period > 0.)
    return period;
  throw std::invalid_argument("--period " + request.period + ": a period is a time above zero, such as \"0.2 s\"");
}

} // namespace

double load_period(const Scene &scene, const coupling::Machine &machine)
{
  const std::vector<double> omega = load_frequencies(machine);
  return omega.empty() ? 0. : common_period(omega, scene);
}

RepeatingMachine repeating_machine(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &start,
                                   const PeriodicRequest &request)
{
  RepeatingMachine           repeating;
  coupling::PeriodicProblem &problem = repeating.problem;
  problem.system                     = &machine;
  problem.begin                      = start.t;
  problem.ratio                      = request.ratio;
  problem.turn                       = turns_of(machine, start);
  problem.period                     = asked_period(request);
  const std::vector<double> omega    = load_frequencies(machine);
  const int                 turning  = slowest_of(problem.turn);
  if (problem.period > 0.)
    repeating.reason = "the period is given";
  else if (!omega.empty())
  {
    problem.period   = common_period(omega, scene);
    repeating.reason = omega.size() == 1 ? "the period is that of the load" : "the period is common to all loads";
  }
  else if (turning >= 0)
  {
    problem.period      = problem.turn[turning] / start.v[turning];
    problem.phase       = turning;
    problem.phase_value = start.q[turning];
    repeating.reason    = "the machine comes round with " + machine.coordinate_name(turning) +
                       "; the speed is that at which motor and resistance balance";
  }
  if (problem.period > 0. && !problem.period_is_unknown() && turning >= 0)
  {
    // What turns comes round a whole number of times in the period of the loads, or not at all.
    const double turns = start.v[turning] * problem.period / problem.turn[turning];
    if (std::abs(turns - std::round(turns)) > equal_speeds * std::abs(turns) || std::round(turns) == 0.)
      throw std::invalid_argument(scene.file + ": " + machine.coordinate_name(turning) + " turns " +
                                  short_text(turns, 6) + " times in the period of " + short_text(problem.period, 8) +
                                  " s; load and turning must be commensurate: give --period, or change the speed");
    problem.turn *= std::round(turns);
  }
  const double span = problem.period > 0. ? problem.period : 1.;
  if (const auto names = told_by_time(machine, start, span, problem.period); !names.empty())
    throw std::invalid_argument(scene.file + ": the force of " + joined(names) + " depends on the time" +
                                (problem.period > 0.
                                     ? " and does not repeat after " + short_text(problem.period, 8) + " s"
                                     : ", and no period can be told from it") +
                                ": give --period \"... s\", or a load with harmonics whose frequencies tell it");
  if (!(problem.period > 0.))
    throw std::invalid_argument(scene.file +
                                ": nothing tells the period: no load oscillates, and no angle turns freely "
                                "at the start; give --period, a load with harmonics, or a speed in [start]");
  problem.period *= request.ratio;
  problem.turn *= request.ratio;
  return repeating;
}

} // namespace gestell::apps
