#include "coupling/integration/integration_method.h"

#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

const std::vector<MethodParameter> &IntegrationMethod::parameters() const
{
  static const std::vector<MethodParameter> none;
  return none;
}

CharacteristicRoots IntegrationMethod::roots(const MethodOptions &options, const TestOscillator &oscillator) const
{
  return roots_of_matrix(amplification_matrix(options, oscillator));
}

std::vector<Eigen::Vector2d> IntegrationMethod::first_steps(const MethodOptions &options, const TestOscillator &o,
                                                            const Eigen::Vector2d &start, int n, FirstSteps) const
{
  const Eigen::MatrixXd A     = amplification_matrix(options, o);
  Eigen::VectorXd       state = Eigen::VectorXd::Zero(A.rows());
  state.head<2>()             = start;
  if (state.size() == 3)
    state[2] = -o.omega_h * o.omega_h * start[0] - 2. * o.zeta * o.omega_h * start[1];
  std::vector<Eigen::Vector2d> states;
  for (int step = 1; step <= n; ++step)
  {
    state = A * state;
    states.emplace_back(state[0], state[1]);
  }
  return states;
}

const MethodParameter &IntegrationMethod::parameter(const std::string &wanted) const
{
  for (const MethodParameter &known : parameters())
    if (known.name == wanted)
      return known;
  throw std::logic_error(name() + " has no parameter " + wanted);
}

double IntegrationMethod::number(const MethodOptions &options, const std::string &name) const
{
  const auto given = options.own.find(name);
  if (given == options.own.end())
    return parameter(name).fallback;
  if (const double *value = std::get_if<double>(&given->second))
    return *value;
  throw std::invalid_argument(this->name() + ": " + name + " is a string; it must be a number");
}

std::string IntegrationMethod::choice(const MethodOptions &options, const std::string &name) const
{
  const auto given = options.own.find(name);
  if (given == options.own.end())
    return parameter(name).choices.front();
  if (const std::string *value = std::get_if<std::string>(&given->second))
    return *value;
  throw std::invalid_argument(this->name() + ": " + name + " is a number; it must be a string");
}

MethodOptions IntegrationMethod::named() const
{
  MethodOptions options;
  options.method = name();
  return options;
}

void require_parameter(bool valid, const std::string &method, const std::string &parameter, double value,
                       const std::string &needed)
{
  if (valid)
    return;
  std::ostringstream message;
  message << method << ": " << parameter << " is " << value << "; it must be " << needed;
  throw std::invalid_argument(message.str());
}

} // namespace gestell::coupling
