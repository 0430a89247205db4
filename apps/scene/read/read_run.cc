#include "apps/scene/read/read_run.h"

#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::apps
{
namespace
{

using coupling::ForceRule;
using coupling::Method;

constexpr int highest_order = 5, collocation_order = 4; // of bdf with a tolerance, and of exact, where none is given

struct MethodName
{
  const char *name;
  Method      method;
};
constexpr MethodName method_names[] = {{"bdf", Method::bdf},
                                       {"newmark", Method::newmark},
                                       {"wilson", Method::wilson},
                                       {"hht", Method::hht},
                                       {"generalised-alpha", Method::generalised_alpha},
                                       {"central-difference", Method::central_difference},
                                       {"exact", Method::exact}};

/// Keys that not every method has.
struct MethodKey
{
  const char         *key;
  std::vector<Method> methods;
};
const std::vector<MethodKey> &method_keys()
{
  static const std::vector<MethodKey> keys = {
      {"order", {Method::bdf, Method::exact}},
      {"tolerance", {Method::bdf, Method::exact}},
      {"beta", {Method::newmark}},
      {"gamma", {Method::newmark}},
      {"theta", {Method::wilson}},
      {"alpha", {Method::hht}},
      {"rho_inf", {Method::generalised_alpha}},
      {"force", {Method::exact}},
  };
  return keys;
}

std::string name_of(Method method)
{
  for (const MethodName &known : method_names)
    if (known.method == method)
      return known.name;
  return "";
}

Method read_method(const SceneTable &run)
{
  const std::string chosen = run.choice("method");
  for (const MethodName &known : method_names)
    if (chosen == known.name)
      return known.method;
  return Method::bdf;
}

void refuse_keys_of_other_methods(const SceneTable &run, Method method)
{
  for (const MethodKey &known : method_keys())
  {
    if (!run.has(known.key) || std::find(known.methods.begin(), known.methods.end(), method) != known.methods.end())
      continue;
    std::vector<std::string> owners;
    for (const Method owner : known.methods)
      owners.push_back(name_of(owner));
    throw run.error(known.key, "is a key of " + listed(owners) + ", but the method is '" + name_of(method) +
                                   "'; leave it out or choose another method");
  }
}

/// Heads what check_method() says against a parameter with the place of its key.
void check_parameters(const SceneTable &run, const coupling::MethodOptions &method)
{
  try
  {
    coupling::check_method(method);
  }
  catch (const std::invalid_argument &error)
  {
    const std::string message = error.what();
    for (const MethodKey &known : method_keys())
      if (run.has(known.key) && message.find(std::string(": ") + known.key + " ") != std::string::npos)
        throw run.error(known.key, message);
    throw run.error(message);
  }
}

ForceRule read_force(const SceneTable &run)
{
  const std::string rule = run.choice("force");
  return rule == "average" ? ForceRule::average : rule == "linear" ? ForceRule::linear : ForceRule::collocation;
}

coupling::MethodOptions read_method_options(const SceneTable &run)
{
  coupling::MethodOptions o;
  o.method = read_method(run);
  refuse_keys_of_other_methods(run, o.method);
  if (run.has("tolerance"))
    o.tolerance = run.value("tolerance");
  if (o.tolerance > 0.)
    o.step = run.value_or("step", 0.); // the largest one
  else
  {
    if (!run.has("step") && (o.method == Method::bdf || o.method == Method::exact))
      throw run.error("needs 'step', the fixed step such as \"10 us\", or 'tolerance' such as 1e-6, by which the step "
                      "is controlled");
    if (!run.has("step"))
      throw run.error("needs 'step', the fixed step such as \"10 us\": the method '" + name_of(o.method) +
                      "' does not control it, and that of a former method went with it");
    o.step = run.value("step");
  }
  if (o.method == Method::exact)
  {
    o.force = read_force(run);
    if (o.force != ForceRule::collocation && run.has("order"))
      throw run.error("order", "goes with force = \"collocation\"; the other rules are of second order");
  }
  const int own_order = o.method == Method::exact ? collocation_order : o.tolerance > 0. ? highest_order : o.order;
  o.order             = run.integer("order", own_order);
  o.beta              = run.value("beta");
  o.gamma             = run.value("gamma");
  o.theta             = run.value("theta");
  o.alpha             = run.value("alpha");
  o.rho_inf           = run.value("rho_inf");
  o.max_halvings      = run.whole("max_halvings");
  if (o.max_halvings < 0 || o.max_halvings > 40)
    throw run.error("max_halvings", "needs a number from 0 to 40");
  o.newton.tolerance = run.value("newton_tolerance");
  if (run.has("newton_tolerance"))
    o.newton.share_of_error = 0.;
  check_parameters(run, o);
  return o;
}

} // namespace

const std::vector<Key> &run_keys()
{
  const coupling::RunOptions    run;
  const coupling::MethodOptions own;
  std::vector<std::string>      methods;
  for (const MethodName &known : method_names)
    methods.emplace_back(known.name);
  static const std::vector<Key> keys = {
      key::choice("method", methods, true, "integrator"),
      key::number("step", kind::time,
                  "fixed step; with `tolerance` the largest step, by default a fiftieth of the run and an eighth of "
                  "the shortest period of a load")
          .above_zero()
          .by_default("by `tolerance`"),
      key::number("tolerance", kind::number,
                  "of the local error, relative to the motion, 1e-13 and above: the step is controlled; 0: it is not. "
                  "`bdf` and `exact` with `\"collocation\"`")
          .from_zero()
          .by_default("fixed step"),
      key::number("begin", kind::time, "time of the start").by_default(0.),
      key::number("end", kind::time, "time of the end, at which the last step is cut"),
      key::truth("events", run.events,
                 "contacts, fracture, sticking and other switches are located to rounding and the integration restarts "
                 "there with full order; `false`: it goes over them and tells them afterwards. Not with dry friction, "
                 "which may then hold more than its limit: a warning says so"),
      key::plain("order", Key::Form::whole, "of `bdf`, 1 to 6; of `exact` with `\"collocation\"`, 2, 4, 6 or 8")
          .by_default("2, with `tolerance` 5; of `exact` 4"),
      key::number("beta", kind::number, "of `newmark`").by_default(own.beta),
      key::number("gamma", kind::number, "of `newmark`").by_default(own.gamma),
      key::number("theta", kind::number, "of `wilson`, 1 or more").by_default(own.theta),
      key::number("alpha", kind::number, "of `hht`, -1/3 to 0").by_default(own.alpha),
      key::number("rho_inf", kind::number, "of `generalised-alpha`, 0 to 1").by_default(own.rho_inf),
      key::choice("force", {"collocation", "average", "linear"}, true, "forces of elements over a step of `exact`"),
      key::truth("force_unstable", run.force_unstable, "runs although a mode grows with this method and step"),
      key::plain("max_halvings", Key::Form::whole,
                 "how often the step is halved where Newton's iteration fails, 0 to 40")
          .by_default(own.max_halvings),
      key::number("newton_tolerance", kind::number,
                  "relative, 1e-13 and above; `bdf` with a `tolerance` chooses its own. Where it is not given, fixed "
                  "steps of `bdf` leave up to 1e-3 of the local error of the step, and `exact` of order 6 and 8 meets "
                  "forces so much closer that its own error stands out")
          .above_zero()
          .by_default(own.newton.tolerance),
      key::truth("energy", run.energy, "keep the energy balance; costs a few products with M, B, C in every step")};
  return keys;
}

std::string seconds(double t)
{
  std::ostringstream text;
  text << t << " s";
  return text.str();
}

RunRequest read_run(const SceneTable &scene)
{
  RunRequest run;
  run.place = scene.place();
  if (!scene.has("run"))
    return run; // modes and reduce need none; require_run() tells those who do
  const SceneTable table = scene.table("run").declared(run_keys());
  run.place              = table.place();
  auto &o                = run.options;
  run.given              = true;
  o.method               = read_method_options(table);
  o.begin                = table.value("begin");
  o.end                  = table.value("end");
  if (o.end <= o.begin)
    throw table.error("end", "must lie after 'begin' (" + seconds(o.begin) + "), got " + seconds(o.end));
  if (o.method.step > o.end - o.begin)
    throw table.error("step", "is longer than the run itself, " + seconds(o.end - o.begin));
  o.events         = table.truth("events");
  o.force_unstable = table.truth("force_unstable");
  o.energy         = table.truth("energy");
  return run;
}

} // namespace gestell::apps
