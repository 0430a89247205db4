#include "apps/atlas/trials.h"

#include "coupling/integration/events/motion.h"
#include "mechanism/elements/cubic_spring.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

coupling::Machine trial_frame(const std::vector<TrialMass> &masses)
{
  coupling::MachineModel model;
  for (std::size_t i = 0; i < masses.size(); ++i)
  {
    const auto &[omega, zeta, mass] = masses[i];
    const std::string       number  = std::to_string(i);
    const coupling::Measure u       = {{model.add_slider("x" + number, {1., 0., 0.}, mass, "ground"), 1.}};
    if (omega > 0.)
      model.add_linear("spring " + number, u, {mass * omega * omega, 2. * zeta * omega * mass, 0., 0.}, "N");
  }
  coupling::Machine machine(std::move(model));
  return machine;
}

coupling::Machine contact_oscillator(double omega)
{
  coupling::MachineModel  model;
  const coupling::Measure u = {{model.add_slider("x0", {1., 0., 0.}, 1., "ground"), 1.}};

  mechanism::CubicSpring::Parameters spring;
  spring.stiffness = omega * omega;
  model.attach("contact", std::make_shared<mechanism::CubicSpring>(spring), {u});
  coupling::Machine machine(std::move(model));
  return machine;
}

Eigen::MatrixXd step_through(coupling::Machine &machine, const coupling::MethodOptions &options, int n_steps)
{
  const int       n = machine.size();
  Eigen::MatrixXd x(n_steps + 1, n);

  coupling::Motion motion(machine, coupling::make_integrator(machine, options));
  motion.begin(0., Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n), {false});
  x.row(0).setOnes();
  for (int k = 1; k <= n_steps; ++k)
  {
    motion.advance();
    x.row(k) = motion.integrator().instant().q.transpose();
  }
  return x;
}

double measured_growth(const Eigen::VectorXd &x)
{
  const Eigen::Index last = x.size() - 2, first = last / 2, middle = (first + last) / 2;
  const auto         single = [&](Eigen::Index a, Eigen::Index b)
  { return std::pow(std::abs(x[b] / x[a]), 1. / static_cast<double>(b - a)); };
  const auto pair = [&](Eigen::Index a, Eigen::Index b)
  {
    const auto D = [&](Eigen::Index n) { return std::abs(1. - x[n + 1] / x[n] * (x[n - 1] / x[n])); };
    // D_b / D_a without squares, which would overflow
    return std::pow(std::abs(x[b] / x[a]) * std::sqrt(D(b) / D(a)), 1. / static_cast<double>(b - a));
  };
  const double of_one = std::abs(single(first, middle) - single(middle, last));
  const double of_two = std::abs(pair(first, middle) - pair(middle, last));
  return of_one < of_two || !std::isfinite(of_two) ? single(first, last) : pair(first, last);
}

int steps_to_see(double growth)
{
  return static_cast<int>(std::clamp(300. / std::abs(std::log(growth)), 40., 20000.));
}

} // namespace gestell::apps
