#pragma once

#include "coupling/sensitivity/run_sensitivities.h"
#include "coupling/simulation/simulation.h"

#include <functional>
#include <list>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// A machine, where it starts and what is told of it, for values of its parameters.
struct Made
{
  Machine             machine;
  InitialState        initial;
  std::vector<Signal> signals;
};
using Maker = std::function<Made(const Eigen::VectorXd &parameters)>;

/// A run with its derivatives by all parameters.
struct Differentiated
{
  RunResult        run;
  RunSensitivities found;

  const OutputDerivatives &operator[](const std::string &output) const
  {
    for (const OutputDerivatives &one : found.outputs)
      if (one.output == output)
        return one;
    throw std::out_of_range(output);
  }
};

/// Machines a millionth below and above each value.
struct Twins
{
  std::list<Made>             made;
  std::vector<ParameterTwins> twins;

  Twins(const Maker &make, const Eigen::VectorXd &x, double end)
  {
    for (Eigen::Index k = 0; k < x.size(); ++k)
    {
      ParameterTwins pair{"x" + std::to_string(k), "", x[k], 1e-6 * std::abs(x[k]), {}, {}};
      for (const double sign : {-1., 1.})
      {
        Eigen::VectorXd there = x;
        there[k] += sign * pair.step;
        made.push_back(make(there));
        (sign < 0. ? pair.minus : pair.plus) =
            MachineTwin{&made.back().machine, made.back().initial, made.back().signals, end};
      }
      twins.push_back(std::move(pair));
    }
  }
};

inline Differentiated differentiated(const Maker &make, const Eigen::VectorXd &x, const RunOptions &options)
{
  Made       own = make(x);
  Twins      twins(make, x, options.end);
  Trajectory trajectory;
  RunResult  run   = simulate(own.machine, own.initial, options, own.signals, {}, nullptr, &trajectory);
  auto       found = run_sensitivities({own.machine, own.signals, options, run, trajectory, twins.twins});
  return {std::move(run), std::move(found)};
}

} // namespace gestell::coupling
