#pragma once
// Methods, starts and runs in a line, for tests.

#include "coupling/simulation/simulation.h"

#include <map>
#include <string>
#include <utility>

namespace gestell::tests
{

/// The method of this name with its step [s], its order and the parameters of its own.
inline coupling::MethodOptions method(const std::string &name, double step, int order = 2,
                                      std::map<std::string, coupling::MethodValue> own = {})
{
  coupling::MethodOptions options;
  options.method = name;
  options.step   = step;
  options.order  = order;
  options.own    = std::move(own);
  return options;
}

inline coupling::MethodOptions bdf(int order, double step)
{
  return method("bdf", step, order);
}

/// The method with the error of its steps controlled.
inline coupling::MethodOptions controlled(coupling::MethodOptions options, double tolerance)
{
  options.tolerance = tolerance;
  return options;
}

/// A run from t = 0 to its end [s].
inline coupling::RunOptions run_of(coupling::MethodOptions options, double end)
{
  coupling::RunOptions run;
  run.method = std::move(options);
  run.end    = end;
  return run;
}

inline coupling::InitialState at_rest(const coupling::Machine &machine)
{
  return {0., Eigen::VectorXd::Zero(machine.size()), Eigen::VectorXd::Zero(machine.size())};
}

/// The start of a machine of one coordinate.
inline coupling::InitialState start(double q, double v)
{
  return {0., Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, v)};
}

/// A coordinate along x, and the deflection that it is.
inline coupling::Measure slider(coupling::MachineModel &model, const std::string &name, double mass)
{
  return {{model.add_slider(name, {1., 0., 0.}, mass, "ground"), 1.}};
}

/// A slider on a spring to the ground.
inline coupling::Machine spring_and_mass(double mass, double stiffness)
{
  coupling::MachineModel model;
  model.add_linear("spring", slider(model, "x", mass), {stiffness, 0., 0., 0.}, "N");
  return coupling::Machine(std::move(model));
}

} // namespace gestell::tests
