#include "apps/cli/chart/chart_methods.h"

#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::ChartSetting;
using coupling::IntegrationMethod;
using coupling::MethodOptions;
using peers::PeerKind;
using peers::PeerSolver;

ChartMethod own(const IntegrationMethod &kind, const ChartSetting &setting)
{
  ChartMethod method;
  method.key        = setting.key;
  method.controlled = setting.controlled;
  method.name       = kind.label(setting.options) + (method.controlled ? ", controlled" : "");
  method.family     = kind.family();
  method.own        = setting.options;
  method.on_request = setting.on_request;
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

void add_peers(std::vector<ChartMethod> &methods)
{
  methods.push_back(peer("cvode-2", "CVODE", PeerKind::cvode_bdf, 2));
  methods.push_back(peer("cvode-3", "CVODE", PeerKind::cvode_bdf, 3));
  methods.back().on_request = true;
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
  methods.back().on_request = true;
  methods.push_back(peer("arkode-8", "ARKODE", PeerKind::explicit_rk, 8));
  if (!peers::petsc_available())
    return;
  methods.push_back(peer("petsc-bdf-2", "PETSc", PeerKind::petsc_bdf, 2));
  methods.push_back(peer("petsc-bdf-5", "PETSc", PeerKind::petsc_bdf, 5));
  methods.push_back(peer("petsc-alpha2", "PETSc", PeerKind::petsc_alpha, 2));
  methods.back().controlled = false;
}

std::string quoted(const std::string &text)
{
  return '"' + text + '"';
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
  for (const IntegrationMethod *kind : coupling::integration_methods())
    for (const ChartSetting &setting : kind->chart_settings())
      methods.push_back(own(*kind, setting));
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
      constexpr int largest_dense = 120; // Beyond this size a dense Jacobian takes minutes and shows nothing new.
      const bool    dense = method.peer && method.peer->solver == PeerSolver::dense && n_coordinates > largest_dense;
      wanted              = !method.on_request && !dense && !(method.peer && with_peers == PeerChoice::without);
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
  const MethodOptions     &o    = method.own;
  const IntegrationMethod &kind = coupling::method_of(o);
  std::string              text;
  const auto               line = [&text](const std::string &key, const std::string &entry)
  { text += key + std::string(key.size() < 9 ? 9 - key.size() : 0, ' ') + " = " + entry + "\n"; };
  line("method", quoted(kind.name()));
  for (const coupling::MethodParameter &parameter : kind.parameters())
    line(parameter.name, parameter.choices.empty() ? exact_text(kind.number(o, parameter.name))
                                                   : quoted(kind.choice(o, parameter.name)));
  if (kind.default_order(o) > 0)
    line("order", std::to_string(o.order));
  line(method.controlled ? "tolerance" : "step", exact_text(value));
  line("events", events ? "true" : "false");
  return text;
}

} // namespace gestell::apps
