#include "apps/scene/read/read_run.h"

#include "coupling/integration/integration_methods.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <sstream>

namespace gestell::apps
{
namespace
{

using coupling::IntegrationMethod;
using coupling::MethodOptions;
using coupling::MethodParameter;

constexpr auto method_in_modes = "central-difference"; ///< of a superposition, unless another is given

/// Keys that not every method has.
std::vector<std::string> own_keys(const IntegrationMethod &method)
{
  std::vector<std::string> keys;
  if (method.takes_order())
    keys.emplace_back("order");
  if (method.can_control_error())
    keys.emplace_back("tolerance");
  for (const MethodParameter &parameter : method.parameters())
    keys.push_back(parameter.name);
  return keys;
}

bool has_key(const IntegrationMethod &method, const std::string &key)
{
  const std::vector<std::string> keys = own_keys(method);
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

const IntegrationMethod &read_method(const SceneTable &run, bool in_modes)
{
  if (in_modes && !run.has("method"))
    return coupling::integration_method(method_in_modes);
  return coupling::integration_method(run.choice("method"));
}

void refuse_keys_of_other_methods(const SceneTable &run, const IntegrationMethod &method)
{
  for (const IntegrationMethod *other : coupling::integration_methods())
    for (const std::string &key : own_keys(*other))
    {
      if (!run.has(key) || has_key(method, key))
        continue;
      std::vector<std::string> owners;
      for (const IntegrationMethod *owner : coupling::integration_methods())
        if (has_key(*owner, key))
          owners.push_back(owner->name());
      throw run.error(key, "is a key of " + listed(owners) + ", but the method is '" + method.name() +
                               "'; remove it or choose another method");
    }
}

/// Reports errors of check_method() at the key of the parameter.
void check_parameters(const SceneTable &run, const MethodOptions &method)
{
  try
  {
    coupling::check_method(method);
  }
  catch (const std::invalid_argument &error)
  {
    const std::string message = error.what();
    for (const std::string &key : own_keys(coupling::method_of(method)))
      if (run.has(key) && message.find(": " + key + " ") != std::string::npos)
        throw run.error(key, message);
    throw run.error(message);
  }
}

void read_parameters(const SceneTable &run, const IntegrationMethod &method, MethodOptions &o)
{
  for (const MethodParameter &parameter : method.parameters())
    if (!run.has(parameter.name)) // each method has a default of its own
      continue;
    else if (parameter.choices.empty())
      o.set(parameter.name, run.value(parameter.name));
    else
      o.set(parameter.name, run.choice(parameter.name));
  const int order = method.default_order(o);
  if (method.takes_order() && order == 0 && run.has("order"))
    throw run.error("order", "needs force = \"collocation\"; the other rules are of second order");
  o.order = run.integer("order", order > 0 ? order : o.order);
}

/// A fixed step, or the largest one where a tolerance is given.
void read_steps(const SceneTable &run, const IntegrationMethod &method, MethodOptions &o)
{
  if (run.has("tolerance"))
    o.tolerance = run.value("tolerance");
  if (coupling::controlled(o))
  {
    o.step = run.value_or("step", 0.);
    return;
  }
  if (!run.has("step") && method.can_control_error())
    throw run.error("needs 'step', a fixed step such as \"10 us\", or 'tolerance' such as 1e-6 for step control");
  if (!run.has("step"))
    throw run.error("needs 'step', a fixed step such as \"10 us\": the method '" + method.name() +
                    "' has no step control, and the step of the replaced method was removed with it");
  o.step = run.value("step");
}

MethodOptions read_method_options(const SceneTable &run, bool in_modes)
{
  MethodOptions            o;
  const IntegrationMethod &method = read_method(run, in_modes);
  o.method                        = method.name();
  refuse_keys_of_other_methods(run, method);
  constexpr double provisional_step = 1e-6; // of the run, until the modes are known
  if (in_modes && !run.has("step") && !run.has("tolerance") && !method.can_control_error())
    o.step = provisional_step * (run.value("end") - run.value("begin"));
  else
    read_steps(run, method, o);
  read_parameters(run, method, o);
  run.fill(o);
  if (o.max_halvings < 0 || o.max_halvings > 40)
    throw run.error("max_halvings", "needs a number from 0 to 40");
  o.newton.tolerance = run.value("newton_tolerance");
  if (run.has("newton_tolerance"))
    o.newton.share_of_error = 0.;
  check_parameters(run, o);
  return o;
}

std::vector<std::string> method_names()
{
  std::vector<std::string> names;
  for (const IntegrationMethod *method : coupling::integration_methods())
    names.push_back(method->name());
  return names;
}

/// Keys that only one method has.
std::vector<Key> parameter_keys()
{
  std::vector<Key> keys;
  for (const IntegrationMethod *method : coupling::integration_methods())
    for (const MethodParameter &parameter : method->parameters())
    {
      const std::string of = "for `" + method->name() + "`: " + parameter.meaning;
      if (parameter.choices.empty())
        keys.push_back(
            key::number(parameter.name, kind::number, of + ", " + parameter.range).by_default(parameter.fallback));
      else
        keys.push_back(key::choice(parameter.name, parameter.choices, true, of));
    }
  return keys;
}

} // namespace

const std::vector<Key> &run_keys()
{
  using Run    = coupling::RunOptions;
  using Method = coupling::MethodOptions;
  const Run                     run;
  const Method                  own;
  static const std::vector<Key> keys = joined(
      {{key::choice("method", method_names(), true,
                    "integrator; with `reduction.method = \"modal\"` the default is `central-difference`"),
        key::number("step", kind::time,
                    "fixed step; with `tolerance` the largest step, by default at most 1/50 of the run and 1/8 of the "
                    "shortest load period. Central differences with `reduction.method = \"modal\"` use a quarter of "
                    "their stability limit")
            .above_zero()
            .by_default("by `tolerance`"),
        key::number("tolerance", kind::number,
                    "tolerance of the local error, relative to the motion, at least 1e-13: the step is controlled; 0: "
                    "fixed step. For `bdf`, and `exact` with `\"collocation\"`")
            .from_zero()
            .by_default("fixed step"),
        key::number("begin", kind::time, "start time").by_default(&Run::begin),
        key::number("end", kind::time, "end time; the last step is shortened to it").into(&Run::end),
        key::truth("events", run.events,
                   "contacts, fracture, sticking and other events are located to rounding, and the integration "
                   "restarts there at full order. `false`: events are not located but listed after the step; with dry "
                   "friction, which may then exceed its limit, a warning is printed")
            .into(&Run::events),
        key::plain("order", Key::Form::whole, "order: `bdf` 1 to 6; `exact` with `\"collocation\"` 2, 4, 6 or 8")
            .by_default("2, with `tolerance` 5; for `exact` 4")},
       parameter_keys(),
       {key::truth("force_unstable", run.force_unstable, "run even if the method is unstable for a mode at this step")
            .into(&Run::force_unstable),
        key::plain("max_halvings", Key::Form::whole,
                   "maximum number of step halvings after a failed Newton iteration, 0 to 40")
            .by_default(&Method::max_halvings),
        key::number("newton_tolerance", kind::number,
                    "relative tolerance of the Newton iteration, at least 1e-13; `bdf` with a `tolerance` chooses its "
                    "own. Without it, fixed steps of `bdf` iterate to 1e-3 of the local error of the step, and `exact` "
                    "of order 6 and 8 iterates until the error of the iteration is below that of the method")
            .above_zero()
            .by_default(own.newton.tolerance),
        key::truth("energy", run.energy,
                   "compute the energy balance, at the cost of a few products with M, B, C in every step")
            .into(&Run::energy)}});
  return keys;
}

std::string seconds(double t)
{
  std::ostringstream text;
  text << t << " s";
  return text.str();
}

RunRequest read_run(const SceneTable &scene, bool in_modes)
{
  RunRequest run;
  run.place = scene.place();
  if (!scene.has("run"))
    return run; // modes and reduce need no run; require_run() refuses it for analyses that do
  const SceneTable table = scene.table("run").declared(run_keys());
  run.place              = table.place();
  auto &o                = run.options;
  run.given              = true;
  table.fill(o);
  o.method       = read_method_options(table, in_modes);
  run.step_given = !in_modes || table.has("step") || table.has("tolerance");
  if (o.end <= o.begin)
    throw table.error("end", "must be after 'begin' (" + seconds(o.begin) + "), got " + seconds(o.end));
  if (o.method.step > o.end - o.begin)
    throw table.error("step", "is longer than the run, " + seconds(o.end - o.begin));
  return run;
}

} // namespace gestell::apps
