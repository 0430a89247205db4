#include "apps/cli/chart_methods.h"

#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::ForceRule;
using coupling::Method;
using coupling::MethodOptions;
using peers::PeerKind;
using peers::PeerSolver;

/// Beyond this size a dense Jacobian takes minutes and shows nothing new.
constexpr int largest_dense = 120;

enum class Control
{
  step,
  tolerance
};

ChartMethod own(const std::string &key, const std::string &family, Control control, const MethodOptions &options)
{
  ChartMethod method;
  method.key        = key;
  method.controlled = control == Control::tolerance;
  method.name       = coupling::method_name(options) + (method.controlled ? ", controlled" : "");
  method.family     = family;
  method.own        = options;
  return method;
}

ChartMethod peer(const std::string &key, const std::string &family, PeerKind kind, int order,
                 PeerSolver solver = PeerSolver::condensed)
{
  ChartMethod        method;
  peers::PeerOptions options;
  options.kind      = kind;
  options.order     = order;
  options.solver    = solver;
  method.key        = key;
  method.name       = peers::peer_name(options);
  method.family     = family;
  method.controlled = true;
  method.peer       = options;
  return method;
}

MethodOptions of(Method method, int order = 2, ForceRule force = ForceRule::collocation)
{
  MethodOptions options;
  options.method = method;
  options.order  = order;
  options.force  = force;
  return options;
}

void add_peers(std::vector<ChartMethod> &methods)
{
  methods.push_back(peer("cvode-2", "CVODE", PeerKind::cvode_bdf, 2));
  methods.push_back(peer("cvode-3", "CVODE", PeerKind::cvode_bdf, 3));
  methods.push_back(peer("cvode-5", "CVODE", PeerKind::cvode_bdf, 5));
  methods.push_back(peer("cvode-adams", "CVODE", PeerKind::cvode_adams, 12));
  methods.push_back(peer("cvode-5-dense", "CVODE", PeerKind::cvode_bdf, 5, PeerSolver::dense));
  methods.push_back(peer("ida-2", "IDA", PeerKind::ida, 2));
  methods.push_back(peer("ida-5", "IDA", PeerKind::ida, 5));
  methods.push_back(peer("ida-5-dense", "IDA", PeerKind::ida, 5, PeerSolver::dense));
  methods.push_back(peer("arkode-3", "ARKODE", PeerKind::explicit_rk, 3));
  methods.push_back(peer("arkode-4", "ARKODE", PeerKind::explicit_rk, 4));
  methods.push_back(peer("arkode-5", "ARKODE", PeerKind::explicit_rk, 5));
  methods.push_back(peer("arkode-6", "ARKODE", PeerKind::explicit_rk, 6));
  methods.push_back(peer("arkode-8", "ARKODE", PeerKind::explicit_rk, 8));
  if (!peers::petsc_available())
    return;
  methods.push_back(peer("petsc-bdf-2", "PETSc", PeerKind::petsc_bdf, 2));
  methods.push_back(peer("petsc-bdf-5", "PETSc", PeerKind::petsc_bdf, 5));
  methods.push_back(peer("petsc-alpha2", "PETSc", PeerKind::petsc_alpha, 2));
  methods.back().controlled = false;
}

bool matches(const std::string &key, const std::string &wanted)
{
  if (!wanted.empty() && wanted.back() == '*')
    return key.compare(0, wanted.size() - 1, wanted, 0, wanted.size() - 1) == 0;
  return key == wanted;
}

} // namespace

std::vector<ChartMethod> chart_methods()
{
  std::vector<ChartMethod> methods;
  for (const int order : {1, 2, 3, 4, 5, 6})
    methods.push_back(own("bdf-" + std::to_string(order), "BDF", Control::step, of(Method::bdf, order)));
  for (const int order : {2, 5})
    methods.push_back(
        own("bdf-" + std::to_string(order) + "-controlled", "BDF", Control::tolerance, of(Method::bdf, order)));
  methods.push_back(own("newmark", "Newmark", Control::step, of(Method::newmark)));
  methods.push_back(own("hht", "Newmark", Control::step, of(Method::hht)));
  methods.push_back(own("generalised-alpha", "Newmark", Control::step, of(Method::generalised_alpha)));
  methods.push_back(own("wilson", "Newmark", Control::step, of(Method::wilson)));
  methods.push_back(own("central-difference", "Newmark", Control::step, of(Method::central_difference)));
  methods.push_back(own("exact-average", "exact", Control::step, of(Method::exact, 2, ForceRule::average)));
  methods.push_back(own("exact-linear", "exact", Control::step, of(Method::exact, 2, ForceRule::linear)));
  for (const int order : {2, 4, 6, 8})
    methods.push_back(own("exact-" + std::to_string(order), "exact", Control::step, of(Method::exact, order)));
  for (const int order : {2, 4, 6, 8})
    methods.push_back(
        own("exact-" + std::to_string(order) + "-controlled", "exact", Control::tolerance, of(Method::exact, order)));
  if (peers::peers_available())
    add_peers(methods);
  return methods;
}

std::vector<ChartMethod> choose_methods(const std::vector<std::string> &keys, PeerChoice with_peers, int n_coordinates)
{
  const std::vector<ChartMethod> all = chart_methods();
  std::vector<std::string>       known;
  for (const ChartMethod &method : all)
    known.push_back(method.key);
  for (const std::string &key : keys)
  {
    bool found = false;
    for (const std::string &other : known)
      found = found || matches(other, key);
    if (!found)
      throw std::invalid_argument("--methods: there is no method \"" + key + "\"" + suggestion(key, known));
  }

  std::vector<ChartMethod> chosen;
  for (const ChartMethod &method : all)
  {
    bool wanted = false;
    for (const std::string &key : keys)
      wanted = wanted || matches(method.key, key);
    if (keys.empty())
    {
      // First order, what is unstable at every useful step, and peers that are never best, only when asked for.
      const bool odd = !method.peer && method.own.method == Method::bdf && !method.controlled && method.own.order != 2;
      const bool dense = method.peer && method.peer->solver == PeerSolver::dense && n_coordinates > largest_dense;
      wanted           = !odd && !dense && method.key != "cvode-3" && method.key != "arkode-6" &&
               !(method.peer && with_peers == PeerChoice::without);
    }
    if (wanted)
      chosen.push_back(method);
  }
  return chosen;
}

std::vector<std::string> quick_methods(PeerChoice with_peers)
{
  std::vector<std::string> keys = {"bdf-2",         "bdf-2-controlled", "newmark",           "generalised-alpha",
                                   "exact-average", "exact-6",          "exact-6-controlled"};
  if (peers::peers_available() && with_peers == PeerChoice::with)
    keys.insert(keys.end(), {"cvode-2", "cvode-5", "ida-5", "arkode-5"});
  return keys;
}

bool locates_events(const ChartMethod &method)
{
  return !method.peer || (method.peer->kind != PeerKind::petsc_bdf && method.peer->kind != PeerKind::petsc_alpha);
}

std::string scene_settings(const ChartMethod &method, double value, bool events)
{
  const MethodOptions &o = method.own;
  std::string          text;
  const auto           line = [&text](const std::string &key, const std::string &entry)
  { text += key + std::string(key.size() < 9 ? 9 - key.size() : 0, ' ') + " = " + entry + "\n"; };
  switch (o.method)
  {
  case Method::bdf:
    line("method", "\"bdf\"");
    line("order", std::to_string(o.order));
    break;
  case Method::newmark:
    line("method", "\"newmark\"");
    line("beta", exact_text(o.beta));
    line("gamma", exact_text(o.gamma));
    break;
  case Method::wilson:
    line("method", "\"wilson\"");
    line("theta", exact_text(o.theta));
    break;
  case Method::hht:
    line("method", "\"hht\"");
    line("alpha", exact_text(o.alpha));
    break;
  case Method::generalised_alpha:
    line("method", "\"generalised-alpha\"");
    line("rho_inf", exact_text(o.rho_inf));
    break;
  case Method::central_difference:
    line("method", "\"central-difference\"");
    break;
  case Method::exact:
    line("method", "\"exact\"");
    line("force", o.force == ForceRule::average  ? "\"average\""
                  : o.force == ForceRule::linear ? "\"linear\""
                                                 : "\"collocation\"");
    if (o.force == ForceRule::collocation)
      line("order", std::to_string(o.order));
    break;
  }
  line(method.controlled ? "tolerance" : "step", exact_text(value));
  line("events", events ? "true" : "false");
  return text;
}

} // namespace gestell::apps
