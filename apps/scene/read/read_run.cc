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
  std::vector<std::string> valid;
  for (const MethodName &known : method_names)
    valid.emplace_back(known.name);
  const std::string chosen = run.choice("method", valid, "bdf");
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
  const std::string rule = run.choice("force", {"average", "linear", "collocation"}, "collocation");
  return rule == "average" ? ForceRule::average : rule == "linear" ? ForceRule::linear : ForceRule::collocation;
}

coupling::MethodOptions read_method_options(const SceneTable &run)
{
  coupling::MethodOptions o;
  o.method = read_method(run);
  refuse_keys_of_other_methods(run, o.method);
  if (run.has("tolerance"))
    o.tolerance = run.not_negative("tolerance", kind::number);
  if (o.tolerance > 0.)
    o.step = run.positive("step", kind::time, 0.); // the largest one
  else
  {
    if (!run.has("step") && (o.method == Method::bdf || o.method == Method::exact))
      throw run.error("needs 'step', the fixed step such as \"10 us\", or 'tolerance' such as 1e-6, by which the step "
                      "is controlled");
    if (!run.has("step"))
      throw run.error("needs 'step', the fixed step such as \"10 us\": the method '" + name_of(o.method) +
                      "' does not control it, and that of a former method went with it");
    o.step = run.positive("step", kind::time);
  }
  if (o.method == Method::exact)
  {
    o.force = read_force(run);
    if (o.force != ForceRule::collocation && run.has("order"))
      throw run.error("order", "goes with force = \"collocation\"; the other rules are of second order");
  }
  const int own_order = o.method == Method::exact ? collocation_order : o.tolerance > 0. ? highest_order : o.order;
  o.order             = run.integer("order", own_order);
  o.beta              = run.number("beta", kind::number, o.beta);
  o.gamma             = run.number("gamma", kind::number, o.gamma);
  o.theta             = run.number("theta", kind::number, o.theta);
  o.alpha             = run.number("alpha", kind::number, o.alpha);
  o.rho_inf           = run.number("rho_inf", kind::number, o.rho_inf);
  o.max_halvings      = run.integer("max_halvings", o.max_halvings);
  if (o.max_halvings < 0 || o.max_halvings > 40)
    throw run.error("max_halvings", "needs a number from 0 to 40");
  o.newton.tolerance = run.positive("newton_tolerance", kind::number, o.newton.tolerance);
  if (run.has("newton_tolerance"))
    o.newton.share_of_error = 0.;
  check_parameters(run, o);
  return o;
}

} // namespace

std::string seconds(double t)
{
  std::ostringstream text;
  text << t << " s";
  return text.str();
}

RunRequest read_run(const SceneTable &scene)
{
  RunRequest run;
  run.place        = scene.place();
  const auto table = scene.optional_table("run");
  if (!table)
    return run; // modes and reduce need none; require_run() tells those who do
  run.place = table->place();
  auto &o   = run.options;
  run.given = true;
  o.method  = read_method_options(*table);
  o.begin   = table->number("begin", kind::time, 0.);
  o.end     = table->number("end", kind::time);
  if (o.end <= o.begin)
    throw table->error("end", "must lie after 'begin' (" + seconds(o.begin) + "), got " + seconds(o.end));
  if (o.method.step > o.end - o.begin)
    throw table->error("step", "is longer than the run itself, " + seconds(o.end - o.begin));
  o.events         = table->boolean("events", o.events);
  o.force_unstable = table->boolean("force_unstable", o.force_unstable);
  o.energy         = table->boolean("energy", o.energy);
  return run;
}

} // namespace gestell::apps
