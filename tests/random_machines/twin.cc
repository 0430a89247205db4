#include "tests/random_machines/twin.h"

#include <Eigen/Cholesky>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/generation/make_controlled.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include <algorithm>
#include <stdexcept>

namespace gestell::tests
{
namespace
{
constexpr long most_steps = 300000; ///< some ten seconds of CPU time
}

Twin::Measure Twin::add_coordinate(double q, double v, double size, double speed)
{
  if (n_coordinates() == Jet::most)
    throw std::length_error("a twin has more coordinates than a jet");
  q_.push_back(q);
  v_.push_back(v);
  size_.push_back(size);
  speed_.push_back(speed);
  return [i = q_.size() - 1](const Jet *x, const Jet &) { return x[i]; };
}

void Twin::add_inertia(double m, Measure a, Measure b)
{
  inertias_.push_back({m, std::move(a), std::move(b)});
}

void Twin::add_law(std::vector<Measure> u, Law law, std::vector<double> states, std::vector<double> sizes)
{
  loads_.push_back({std::move(u), std::move(law), int(z_.size()), int(states.size())});
  z_.insert(z_.end(), states.begin(), states.end());
  z_size_.insert(z_size_.end(), sizes.begin(), sizes.end());
}

void Twin::add_force(Measure u, std::function<double(double t, double u, double v)> force)
{
  add_law({std::move(u)}, [force = std::move(force)](const Seen &seen, double *F, double *)
          { F[0] = force(seen.t, seen.u[0], seen.v[0]); });
}

void Twin::tell(const std::string &signal, Measure s, Quantity quantity)
{
  names_.push_back(signal);
  reported_.push_back({std::move(s), quantity});
}

std::vector<Jet> Twin::coordinates(const State &y) const
{
  const std::size_t n = q_.size();
  std::vector<Jet>  q(std::max<std::size_t>(n, 1));
  for (std::size_t i = 0; i < n; ++i)
  {
    q[i].v    = y[i] * size_[i];
    q[i].d    = y[n + i] * speed_[i];
    q[i].g[i] = 1.;
  }
  return q;
}

Jet Twin::at_start(const Measure &s) const
{
  State y;
  for (std::size_t i = 0; i < q_.size(); ++i)
    y.push_back(q_[i] / size_[i]);
  for (std::size_t i = 0; i < q_.size(); ++i)
    y.push_back(v_[i] / speed_[i]);
  Jet time;
  time.d = 1.;
  return s(coordinates(y).data(), time);
}

std::vector<double> Twin::accelerations(const std::vector<Jet> &q, const State &y, State &dy, double t) const
{
  const int       n = n_coordinates();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd Q = Eigen::VectorXd::Zero(n);
  Jet             time(t);
  time.d              = 1.;
  const auto gradient = [n](const Jet &s) { return Eigen::Map<const Eigen::VectorXd>(s.g.data(), n); };
  for (const Inertia &inertia : inertias_)
  {
    const Jet  a = inertia.a(q.data(), time), b = inertia.b(q.data(), time);
    const auto G_a = gradient(a), G_b = gradient(b);
    M += 0.5 * inertia.m * (G_a * G_b.transpose() + G_b * G_a.transpose());
    Q -= 0.5 * inertia.m * (G_a * b.dd + G_b * a.dd);
  }
  for (const Load &load : loads_)
  {
    const std::size_t   k = load.u.size();
    std::vector<Jet>    s(k);
    std::vector<double> u(k), v(k), F(k, 0.), z(load.n_states), dz(load.n_states, 0.);
    for (std::size_t i = 0; i < k; ++i)
    {
      s[i] = load.u[i](q.data(), time);
      u[i] = s[i].v;
      v[i] = s[i].d;
    }
    for (int i = 0; i < load.n_states; ++i)
      z[i] = y[2 * n + load.first_state + i] * z_size_[load.first_state + i];
    load.law({t, u.data(), v.data(), z.data()}, F.data(), dz.data());
    for (std::size_t i = 0; i < k; ++i)
      Q += F[i] * gradient(s[i]);
    for (int i = 0; i < load.n_states; ++i)
      dy[2 * n + load.first_state + i] = dz[i] / z_size_[load.first_state + i];
  }
  const Eigen::VectorXd a = M.ldlt().solve(Q);
  return {a.data(), a.data() + n};
}

void Twin::rates(const State &y, State &dy, double t) const
{
  const std::size_t         n = q_.size();
  const std::vector<double> a = accelerations(coordinates(y), y, dy, t);
  for (std::size_t i = 0; i < n; ++i)
  {
    dy[i]     = y[n + i] * speed_[i] / size_[i];
    dy[n + i] = a[i] / speed_[i];
  }
}

void Twin::sample(const State &y, double t, std::vector<double> &rows) const
{
  State                     dy(y.size());
  const std::vector<Jet>    q = coordinates(y);
  const std::vector<double> a = accelerations(q, y, dy, t);
  Jet                       time(t);
  time.d = 1.;
  for (const Told &reported : reported_)
  {
    const Jet s            = reported.s(q.data(), time);
    double    acceleration = s.dd;
    for (std::size_t i = 0; i < a.size(); ++i)
      acceleration += s.g[i] * a[i];
    rows.push_back(reported.quantity == Quantity::value  ? s.v
                   : reported.quantity == Quantity::rate ? s.d
                                                         : acceleration);
  }
}

std::vector<double> Twin::history(double end, int n_rows, double tolerance) const
{
  namespace odeint       = boost::numeric::odeint;
  const auto        step = odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_cash_karp54<State>());
  const std::size_t n    = q_.size();
  State             y(2 * n + z_.size());
  for (std::size_t i = 0; i < n; ++i)
  {
    y[i]     = q_[i] / size_[i];
    y[n + i] = v_[i] / speed_[i];
  }
  for (std::size_t i = 0; i < z_.size(); ++i)
    y[2 * n + i] = z_[i] / z_size_[i];

  // What jumps does so at the end of a step, and is seen from the side of the step.
  std::vector<double> breaks = breaks_;
  std::sort(breaks.begin(), breaks.end());
  std::vector<double> rows;
  auto                stepper = step;
  double              t = 0., length = end / n_rows;
  long                steps = 0;
  sample(y, t, rows);
  for (int row = 1; row <= n_rows; ++row)
  {
    const double next = end * row / n_rows;
    while (t < next)
    {
      const auto   at   = std::upper_bound(breaks.begin(), breaks.end(), t);
      const double stop = at == breaks.end() ? next : std::min(*at, next);
      double       dt = std::min(length, stop - t), from = t;
      const bool   cut = dt < length;
      const auto   f   = [&](const State &x, State &dx, double time)
      { rates(x, dx, std::clamp(time, std::nextafter(from, stop), std::nextafter(stop, from))); };
      const auto result = stepper.try_step(f, y, t, dt);
      if (++steps > most_steps)
        return {};
      if (result == odeint::fail || !cut)
        length = dt;
      if (result == odeint::success && stop - t < 1e-12 * end)
        t = stop;
    }
    sample(y, t, rows);
  }
  return rows;
}

} // namespace gestell::tests
