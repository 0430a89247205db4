#pragma once

#include <Eigen/Core>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// A scene key by which outputs are differentiated.
struct SensitivityKey
{
  std::string key, unit; ///< "parameters.c_P", "kg/s^2"; empty: a plain number, in SI
  double      value = 0.;
  std::string frame{}; ///< method for the frame's part, if the key changes the frame; else empty
};

template <class Visitor>
void describe(Visitor &v, const SensitivityKey &x)
{
  v("key", x.key, "", "of the scene");
  v("value", x.value, x.unit, "value of the parameter");
  v("unit", x.unit, "", "unit of the parameter; empty: plain number in SI");
  v.maybe(!x.frame.empty(), "frame", x.frame, "", "method for the contribution of the frame");
}

/// A scalar result of the run with its derivatives.
struct SensitivityOutput
{
  std::string     output, unit; ///< "F_P.max", "N"
  std::string     note;         ///< for an event its description; or why there is no derivative
  double          value = 0.;
  Eigen::VectorXd derivative;      ///< with respect to every key [unit / unit of the key]; nan: there is none
  bool            is_zero = false; ///< zero up to rounding

  /// Relative change [%] of the output if a key increases by 1 %; nan if the output is zero.
  double percent(const SensitivityKey &key, Eigen::Index k) const
  {
    return is_zero ? std::numeric_limits<double>::quiet_NaN() : derivative[k] * key.value / value;
  }
};

/// Derivative with respect to one key.
struct Derivative
{
  std::string key{}, unit{};
  double      derivative = 0., percent = 0.;
};

template <class Visitor>
void describe(Visitor &v, const Derivative &x)
{
  v("key", x.key, "", "of the scene");
  v("derivative", x.derivative, x.unit, "derivative of the output by the parameter; null: none");
  v("unit", x.unit, "", "of the derivative");
  v("change_by_1_percent", x.percent, "%", "relative change of the output for a 1 % larger parameter");
}

/// An output with its derivatives, for JSON.
struct OutputDerivatives
{
  const SensitivityOutput *output = nullptr;
  std::vector<Derivative>  derivatives{};
};

/// Derivatives of the scalar results of a run.
struct SensitivityResult
{
  std::vector<SensitivityKey>    keys;
  std::vector<SensitivityOutput> outputs;
  std::string                    failure{};                  ///< why there are none although the run succeeded
  bool                           interrupted = false;        ///< some are missing
  long                           steps       = 0;            ///< of the variational equations
  double                         run_cpu_s = 0., cpu_s = 0.; ///< of the run, and of all derivatives
};

/// "N/(kg/s^2)"
inline std::string derivative_unit(const SensitivityOutput &output, const SensitivityKey &key)
{
  if (key.unit.empty())
    return output.unit;
  return (output.unit.empty() ? "1" : output.unit) + "/(" + key.unit + ')';
}

template <class Visitor>
void describe(Visitor &v, const OutputDerivatives &x)
{
  const SensitivityOutput output = x.output ? *x.output : SensitivityOutput();
  v("value", output.value, output.unit, "of the output");
  v("unit", output.unit, "", "of the output");
  v("derivatives", x.derivatives, "", "derivatives by each parameter");
  v.maybe(!output.note.empty(), "note", output.note, "",
          "change at an event, or the reason why there is no derivative");
}

template <class Visitor>
void describe(Visitor &v, const SensitivityResult &x)
{
  std::vector<std::pair<std::string, OutputDerivatives>> outputs;
  for (const SensitivityOutput &output : x.outputs)
  {
    outputs.push_back({output.output, {&output}});
    for (Eigen::Index k = 0; k < output.derivative.size(); ++k)
    {
      const SensitivityKey &key = x.keys[std::size_t(k)];
      outputs.back().second.derivatives.push_back(
          {key.key, derivative_unit(output, key), output.derivative[k], output.percent(key, k)});
    }
  }
  v("keys", x.keys, "", "parameters of the scene");
  v("outputs", outputs, "", "of the run");
  v.maybe(!x.failure.empty(), "failure", x.failure, "", "reason why there are no derivatives");
  v("steps", x.steps, "", "steps of the variational equations");
  v("cpu_s", std::vector<std::pair<std::string, double>>{{"run", x.run_cpu_s}, {"sensitivities", x.cpu_s}}, "s",
    "CPU time of the run and of all derivatives");
}

} // namespace gestell::apps
