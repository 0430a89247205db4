#include "coupling/modes/operating_point.h"

#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/system/turning_forces.h"
#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// Only the blocks of the joints: the stiffness of elements follows from the derivatives of their forces.
Eigen::MatrixXd stiffness_of_joints(const Machine &machine, const LocalState &local)
{
  if (machine.joints().n_rows() == 0)
    return {};
  Eigen::MatrixXd all, K;
  machine.geometric(local, all);
  K.setZero(all.rows(), all.cols());
  for (const ConstraintBlock &block : machine.joints().blocks())
  {
    const int first = block.first_measure, n = block.n_measures;
    K.block(first, first, n, n) = all.block(first, first, n, n);
  }
  return K;
}

/// An element that may be open, linearised at the point.
struct Contact
{
  const std::string &name;
  int                first;      ///< of its measures
  double             size;       ///< of a large motion of them
  Eigen::MatrixXd    open, more; ///< stiffness when it is open, and what it has more when it is closed
  Eigen::MatrixXd    here;       ///< -dp/du
};

template <typename Look>
void for_contacts(const Machine &machine, const LocalState &local, const Look &look)
{
  const auto      n_u   = local.u.size();
  Eigen::VectorXd p     = Eigen::VectorXd::Zero(n_u);
  Eigen::MatrixXd dp    = Eigen::MatrixXd::Zero(n_u, n_u);
  Eigen::MatrixXd dp_dv = dp;
  linearise(machine.forces(), local, p, dp, dp_dv);
  int first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K, open = K, open_D = K;
    engaged(*placement.element, local.u.data() + first, K.data(), D.data());
    open_branch(*placement.element, local.u.data() + first, open.data(), open_D.data());
    K -= open;
    if (!K.isZero(0.))
      look(Contact{placement.name, first, measure_size(machine.model(), placement), open, K,
                   -dp.block(first, first, k, k)});
    first += k;
  }
}

/// Sorts the elements that may be open: their dp/du is between those of the open and the closed branch, and closer to
/// one of them.
void tell_contacts(const Machine &machine, MachinePoint &at)
{
  for_contacts(machine, at.point.local,
               [&](const Contact &contact)
               {
                 // share of the stiffness of a closed element that distinguishes it from an open one
                 constexpr double least_contact = 1e-6;
                 const bool       is_closed     = (contact.here - contact.open).cwiseProduct(contact.more).sum() >
                                        least_contact * contact.more.squaredNorm();
                 (is_closed ? at.closed : at.open).push_back(contact.name);
               });
}

/// Whether the force of a measure has one slope dp/du at the point and on both sides of it, laws following the motion
/// itself.
bool is_smooth(const Machine &machine, const LocalState &local, int measure, double size, double slope)
{
  LocalState      nearby = local;
  Eigen::VectorXd here = local.p, there = local.p;
  machine.forces().force(nearby, here);
  double slopes[2];
  for (const int side : {0, 1})
  {
    constexpr double beside_point = 1e-9; // of a large motion, to both sides of a contact that is about to touch
    const double     way          = (side == 0 ? -beside_point : beside_point) * size;
    nearby.u[measure]             = local.u[measure] + way;
    machine.forces().force(nearby, there);
    slopes[side] = (there[measure] - here[measure]) / way;
  }
  const double largest = std::max({std::abs(slopes[0]), std::abs(slopes[1]), std::abs(slope)});
  // difference of two slopes, relative to the largest: far above their errors, far below that of a contact
  constexpr double another_slope = 0.01;
  return std::abs(slopes[0] - slope) <= another_slope * largest &&
         std::abs(slopes[1] - slope) <= another_slope * largest;
}

/// Names of elements that may be open and are about to touch.
void tell_touching(Machine &machine, MachinePoint &at)
{
  const LocalState &local = at.point.local;
  for_contacts(machine, local,
               [&](const Contact &contact)
               {
                 machine.events().follow_history(false);
                 bool smooth = true;
                 for (int i = 0; i < contact.more.rows() && smooth; ++i)
                   smooth = contact.more(i, i) == 0. ||
                            is_smooth(machine, local, contact.first + i, contact.size, -contact.here(i, i));
                 machine.events().follow_history(true);
                 if (!smooth)
                   at.touching.push_back(contact.name);
               });
}

/// A derivative, with an estimate of its error.
struct Slope
{
  double value, error;
};

/**
 * f'(0) by central quotients with falling steps, extrapolated: the entry of Neville's table that differs least from
 * those it is made of.
 *
 * Source: C. J. F. Ridders, Accurate computation of F'(x) and F'(x)F''(x), Advances in Engineering Software 4 (1982),
 * 75-76.
 */
Slope extrapolated_slope(const std::function<double(double)> &f, double first_step)
{
  constexpr int                                  levels = 9;  // finest = 2^8
  constexpr double                               ratio  = 2.; // of the steps of an extrapolation
  std::array<std::array<double, levels>, levels> table{};
  Slope                                          best{0., std::numeric_limits<double>::infinity()};
  double                                         h = first_step;
  for (int k = 0; k < levels; ++k, h /= ratio)
  {
    table[k][0]   = (f(h) - f(-h)) / (2. * h);
    double factor = 1.;
    for (int m = 1; m <= k; ++m)
    {
      factor *= ratio * ratio;
      table[k][m] = table[k][m - 1] + (table[k][m - 1] - table[k - 1][m - 1]) / (factor - 1.);
      const double error =
          std::max(std::abs(table[k][m] - table[k][m - 1]), std::abs(table[k][m] - table[k - 1][m - 1]));
      if (error < best.error)
        best = {table[k][m], error};
    }
  }
  return best;
}

constexpr double first_way = 1e-4; ///< first step, of a large motion; of rates and accelerations ten and a hundred
                                   ///< times as large, with such a motion in a second
constexpr double smooth = 1e-5;    ///< error of a slope relative to the largest of its kind; above it is a kink

/// Whether the slope of f jumps at 0: second differences over h fall with the step where f is smooth.
bool has_kink(const std::function<double(double)> &f, double first_step)
{
  const auto       jump   = [&](double h) { return std::abs(f(h) - 2. * f(0.) + f(-h)) / h; };
  constexpr double finest = 256.; // first step over the last one, 2^8
  const double     small = first_step / finest, last = jump(small);
  constexpr double no_jump = 1e-9; // second difference relative to the values, up to which it is rounding
  return last > 0.3 * jump(first_step) && last > no_jump * (std::abs(f(small)) + std::abs(f(-small))) / small;
}

/// Slopes of a signal in the numbers of a vector.
class SignalSlopes
{
public:
  SignalSlopes(const Machine &machine, const Signal &signal, const MachinePoint &at)
      : machine_(machine), signal_(signal), q_(at.state.q), v_(at.state.v), a_(at.a), local_(at.point.local)
  {
  }

  Eigen::VectorXd &q() { return q_; }
  Eigen::VectorXd &v() { return v_; }
  LocalState      &local() { return local_; }

  /// d signal / d x_i at indices first, first + 1 ... of x, a vector of this motion; zero elsewhere.
  /// @param way    first step, of the larger of |x_i| and its size
  /// @param sizes  of the numbers there
  Eigen::VectorXd find(Eigen::VectorXd &x, Eigen::Index first, double way, const Eigen::VectorXd &sizes)
  {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(x.size());
    double          largest = 0., worst = 0.;
    bool            kink = false;
    for (Eigen::Index i = first; i < first + sizes.size(); ++i)
    {
      const double there = x[i], first_step = way * std::max(sizes[i - first], std::abs(there));
      const auto   moved = [&](double d)
      {
        x[i] = there + d;
        return value();
      };
      const Slope slope         = extrapolated_slope(moved, first_step);
      kink                      = kink || has_kink(moved, first_step);
      x[i]                      = there;
      weights[i]                = slope.value;
      largest                   = std::max(largest, std::abs(slope.value));
      constexpr double rounding = 1e-12; // relative error of values in quotients with the smallest step
      worst                     = std::max(worst, slope.error - rounding * std::abs(value()) / first_step);
    }
    if (kink || worst > smooth * largest)
      throw std::invalid_argument("\"" + signal_.name +
                                  "\" has a kink at the operating point, so it has no linear response; choose another "
                                  "operating point or another signal");
    return weights;
  }

private:
  double value() const { return machine_.evaluate(signal_, q_, v_, a_, local_); }

  const Machine  &machine_;
  const Signal   &signal_;
  Eigen::VectorXd q_, v_, a_;
  LocalState      local_;
};

void add_quantity(const Machine &machine, const Signal &signal, const MachinePoint &at, LinearAnswer &answer)
{
  const auto  &elements = machine.model().elements();
  Eigen::Index first    = 0;
  for (int e = 0; e < signal.element; ++e)
    first += elements[e].element->n_measures();
  const Eigen::Index k = elements[signal.element].element->n_measures();
  const auto        &W = machine.forces().directions();
  Signal             quantity;
  quantity.name     = signal.name;
  quantity.element  = signal.element;
  quantity.quantity = signal.quantity;
  quantity.scale    = signal.scale;
  SignalSlopes          slopes(machine, quantity, at);
  LocalState           &local = slopes.local();
  const Eigen::VectorXd sizes = Eigen::VectorXd::Constant(k, measure_size(machine.model(), elements[signal.element]));
  answer.q += W * slopes.find(local.u, first, first_way, sizes);
  answer.v += W * slopes.find(local.v, first, 10. * first_way, sizes);
  answer.a += W * slopes.find(local.a, first, 100. * first_way, sizes);
  // Quantities are linear in forces of any size.
  answer.p      = slopes.find(local.p, first, first_way, Eigen::VectorXd::Ones(k));
  answer.lambda = slopes.find(local.lambda, 0, first_way, Eigen::VectorXd::Ones(local.lambda.size()));
}

/// ds/dq [n] of a measure: its rate g . q' at unit velocities.
Eigen::VectorXd gradient(const Machine &machine, const Signal &signal, const MachinePoint &at)
{
  Signal rate   = signal;
  rate.quantity = 1;
  rate.on_q.clear();
  Eigen::VectorXd g = Eigen::VectorXd::Zero(at.state.q.size()), unit = g;
  for (const auto &[i, weight] : signal.on_q) // the coordinates it depends on
  {
    unit[i] = 1.;
    g[i]    = machine.evaluate(rate, at.state.q, unit, at.point.local);
    unit[i] = 0.;
  }
  return g;
}

/// s = s(q),  s' = g . q',  s'' = g . q'' + q' . g' q',  g = ds/dq.
void add_measure(const Machine &machine, const Signal &signal, const MachinePoint &at, LinearAnswer &answer)
{
  Eigen::VectorXd *const by_derivative[] = {&answer.q, &answer.v, &answer.a};
  *by_derivative[signal.quantity] += gradient(machine, signal, at);
  if (signal.quantity == 0 || (at.state.v.isZero(0.) && (signal.quantity == 1 || at.a.isZero(0.))))
    return;
  SignalSlopes          slopes(machine, signal, at);
  const Eigen::VectorXd sizes = coordinate_sizes(machine);
  answer.q += slopes.find(slopes.q(), 0, first_way, sizes);
  if (signal.quantity == 2)
    answer.v += slopes.find(slopes.v(), 0, 10. * first_way, sizes);
}

void add(const Measure &weights, double scale, Eigen::VectorXd &to)
{
  for (const auto &[i, weight] : weights)
    to[i] += scale * weight;
}

} // namespace

MachinePoint machine_point(Machine &machine, const InitialState &state)
{
  MachinePoint at;
  at.state          = state;
  at.a              = Eigen::VectorXd::Zero(machine.size());
  LocalState &local = at.point.local;
  local.resize(machine);
  machine.gather(state.t, state.q, state.v, at.a, local);
  machine.events().follow_history(true);
  machine.events().start(local);
  std::optional<ConsistentStart> start;
  try
  {
    start.emplace(machine, "frequency response");
  }
  catch (const std::invalid_argument &)
  {
    // a coordinate has no mass: its acceleration is unknown
  }
  if (start)
  {
    IntegrationWork work;
    start->solve(state.q, state.v, at.a, local, work);
  }
  else if (machine.joints().n_rows() == 0)
    machine.forces().force(local, local.p);
  at.point.joint_stiffness = stiffness_of_joints(machine, local);
  tell_contacts(machine, at);
  tell_touching(machine, at);
  return at;
}

LinearAnswer linear_signal(const Machine &machine, const Signal &signal, const MachinePoint &at)
{
  if (signal.computed)
    throw std::invalid_argument("the signal \"" + signal.name +
                                "\" is a function of the calling program, which has no linear form; name the signals "
                                "it is computed from");
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  LinearAnswer          answer{zero, zero, zero, {}, {}};
  add(signal.on_q, signal.scale, answer.q);
  add(signal.on_v, signal.scale, answer.v);
  add(signal.on_a, signal.scale, answer.a);
  if (signal.measure >= 0)
    add_measure(machine, signal, at, answer);
  if (signal.element >= 0)
    add_quantity(machine, signal, at, answer);
  return answer;
}

Eigen::VectorXd force_along(const Machine &machine, const Signal &signal, const MachinePoint &at)
{
  const LinearAnswer answer = linear_signal(machine, signal, at);
  const bool only_q = answer.v.isZero(0.) && answer.a.isZero(0.) && answer.p.isZero(0.) && answer.lambda.isZero(0.);
  if ((signal.unit != "m" && signal.unit != "rad") || !only_q)
    throw std::invalid_argument("\"" + signal.name + "\" has the unit [" + signal.unit +
                                "] and is not a displacement or an angle that a force could act along; choose a "
                                "displacement [m] or an angle [rad]");
  if (answer.q.isZero(0.))
    throw std::invalid_argument(
        "\"" + signal.name +
        "\" does not move with any coordinate of the machine, so no force can act along it; choose another one");
  return answer.q;
}

} // namespace gestell::coupling
