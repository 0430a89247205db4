#include "coupling/dense_matrices.h"
#include "coupling/simulation.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Closed elements linearised at q: g + J dq = 0, and the acceleration of the closure along v, v^T g'' v.
struct Closures
{
  Eigen::VectorXd g, curvature; // [n_c]
  Eigen::MatrixXd J;            // [n_c x n]
};

Closures closures(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const auto                  &W = machine.directions();
  const Eigen::VectorXd        u = W.transpose() * q, u_rate = W.transpose() * v;
  std::vector<double>          values, curvatures;
  std::vector<Eigen::VectorXd> rows;
  int                          first = 0;
  for (const ElementPlacement &placement : machine.elements())
  {
    const int           k = placement.element->n_measures();
    std::vector<double> gradient(k);
    double              g, curvature;
    if (placement.element->closure(u.data() + first, u_rate.data() + first, g, gradient.data(), curvature))
    {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(machine.size());
      for (int j = 0; j < k; ++j)
        row += gradient[j] * Eigen::VectorXd(W.col(first + j));
      rows.push_back(row);
      values.push_back(g);
      curvatures.push_back(curvature);
    }
    first += k;
  }
  Closures result;
  result.g         = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  result.curvature = Eigen::Map<Eigen::VectorXd>(curvatures.data(), static_cast<Eigen::Index>(curvatures.size()));
  result.J.resize(static_cast<Eigen::Index>(rows.size()), machine.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    result.J.row(static_cast<Eigen::Index>(i)) = rows[i];
  return result;
}

std::vector<int> slider_coordinates(const Machine &machine)
{
  std::vector<int> sliders;
  for (const Body &body : machine.bodies())
    if (body.kind == BodyKind::slider)
      sliders.push_back(body.coordinate);
  return sliders;
}

/// Least change of the sliders alone that satisfies J x = b.
Eigen::VectorXd slider_solution(const Eigen::MatrixXd &J, const Eigen::VectorXd &b, const std::vector<int> &sliders)
{
  Eigen::VectorXd x = Eigen::VectorXd::Zero(J.cols());
  if (sliders.empty() || J.rows() == 0)
    return x;
  const Eigen::MatrixXd own   = J(Eigen::all, sliders);
  const Eigen::VectorXd least = own.completeOrthogonalDecomposition().solve(b);
  x(sliders)                  = least;
  return x;
}

/// Stiffness of the engaged elements, W K W^T.
Eigen::MatrixXd engaged_stiffness(const Machine &machine, const Eigen::VectorXd &q)
{
  Eigen::MatrixXd damping;
  Eigen::MatrixXd stiffness;
  engaged_matrices(machine, q, {}, stiffness, damping);
  return stiffness;
}

} // namespace

InitialState steady_start(Machine &machine, const SteadyStart &start)
{
  const int              n       = machine.size();
  const std::vector<int> sliders = slider_coordinates(machine);
  InitialState           state;
  state.q = Eigen::VectorXd::Zero(n);
  state.v = Eigen::VectorXd::Zero(n);

  // Given angles; other rotors stand in line with the first one given.
  std::vector<bool> given(n, false);
  for (const Body &body : machine.bodies())
    if (body.kind == BodyKind::rotor && !start.angles.empty())
      state.q[body.coordinate] = start.angles.front().second;
  for (const auto &[name, angle] : start.angles)
  {
    given[machine.body(name).coordinate]   = true;
    state.q[machine.body(name).coordinate] = angle;
  }
  for (const auto &[name, speed] : start.speeds)
    state.v[machine.body(name).coordinate] = speed;
  const int  driver  = start.driver.empty() ? -1 : machine.body(start.driver).coordinate;
  const long n_given = std::count(given.begin(), given.end(), true);
  if (n_given != (driver >= 0 ? 1 : 0))
    throw std::invalid_argument("start: " + std::to_string(n_given) + " angles are given and " +
                                (driver >= 0 ? "one driver" : "no driver") +
                                "; each given angle replaces the balance of one driver, so give one of both, or none");

  // Kinematics of the closed chain: the frame rests, rotors turn as given, sliders follow.
  for (int i = 0; i < 20; ++i)
  {
    const Closures chain = closures(machine, state.q, state.v);
    state.q += slider_solution(chain.J, -chain.g, sliders);
  }
  Closures chain = closures(machine, state.q, state.v);
  state.v += slider_solution(chain.J, -chain.J * state.v, sliders);
  chain                              = closures(machine, state.q, state.v);
  const Eigen::VectorXd acceleration = slider_solution(chain.J, -chain.curvature, sliders);

  // Equilibrium with the inertia of that motion; engaged stiffness as Newton matrix carries it through the play.
  std::vector<int> unknown, equations;
  for (int i = 0; i < n; ++i)
  {
    if (!given[i])
      unknown.push_back(i);
    if (i != driver)
      equations.push_back(i);
  }
  Eigen::VectorXd load, product(n), constant(n);
  machine.excitation(0., load);
  constant = load;
  machine.mass_times(acceleration, product);
  constant -= product;
  machine.damping_times(state.v, product);
  constant -= product;
  const Eigen::MatrixXd stiffness = dense_stiffness(machine);

  LocalState      local;
  Eigen::VectorXd p(machine.directions().cols()), residual;
  double          size = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 1000; ++iteration)
  {
    machine.gather(0., state.q, state.v, acceleration, local);
    machine.start(local);
    machine.local_force(local, p);
    residual                      = constant + machine.directions() * p - stiffness * state.q;
    const Eigen::MatrixXd tangent = stiffness + engaged_stiffness(machine, state.q);
    const Eigen::MatrixXd matrix  = tangent(equations, unknown);
    const Eigen::VectorXd balance = residual(equations);
    const Eigen::VectorXd change  = matrix.fullPivLu().solve(balance);
    state.q(unknown) += change;
    const double size_before = size;
    size                     = change.norm();
    if (!std::isfinite(size))
      break;
    // Rounding ends the decrease.
    if (size <= 1e-11 * (1. + state.q.norm()) && size >= 0.3 * size_before)
      return state;
  }
  std::ostringstream message;
  message << "start: no equilibrium was found; the last correction was " << size
          << " (m or rad). Is every slider and rotor held by an element, and the frame by its supports?";
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling
