#include "apps/study/file/read_analysis.h"

#include "apps/scene/file/scene_table.h"
#include "apps/study/file/study_keys.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

int at_least(const SceneTable &table, const std::string &key, int least, int otherwise)
{
  const int value = table.has(key) ? table.whole(key) : otherwise;
  if (value < least)
    throw table.error(key, "needs an integer from " + std::to_string(least) + ", got " + std::to_string(value));
  return value;
}

int output_named(const StudyFile &study, const SceneTable &table, const std::string &name)
{
  std::vector<std::string> names;
  for (const OutputRequest &output : study.outputs)
    names.push_back(output.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw table.error("there is no output '" + name + "'" + suggestion(name, names));
  return int(found - names.begin());
}

/// Surfaces and searches go between the levels of a variable.
void refuse_stepped_variables(const StudyFile &study, const SceneTable &table, const std::string &asks)
{
  for (const VariableRequest &variable : study.variables)
    if (variable.variable.stepped)
      throw table.error("variable " + variable.variable.name + " has " + (variable.files.empty() ? "text" : "files") +
                        " as levels, which cannot be interpolated; remove it from the study, or remove " + asks);
}

SurfaceRequest read_surface(const StudyFile &study, const SceneTable &table)
{
  SurfaceRequest request;
  request.options.order = surface_order(table.choice("order"));
  request.options.level = table.value("confidence");
  if (!(request.options.level > 0. && request.options.level < 1.))
    throw table.error("confidence", "needs a number above 0 and below 1, such as 0.95 or \"95 %\", got " +
                                        short_text(request.options.level));
  refuse_stepped_variables(study, table, "[surface]");
  if (table.has("outputs"))
    request.outputs = table.texts("outputs");
  for (const std::string &name : request.outputs)
    output_named(study, table, name);
  return request;
}

/// SI value of an entry that is to be in the unit of an output.
double claimed(const SceneTable &table, const std::string &key, int output, OutputClaims &claims)
{
  const Quantity value = table.quantity(key);
  claims.values.push_back({output, value, table.error(key, "").what()});
  return value.value;
}

void read_goals(const StudyFile &study, const SceneTable &table, std::vector<Goal> &goals, OutputClaims &claims)
{
  std::vector<SummedGoal> sum;
  for (const SceneTable &given : table.tables("goals"))
  {
    const SceneTable goal = given.declared(study_goal_keys());
    Goal             read;
    read.output = output_named(study, given, given.name());
    read.sense  = goal.choice("sense") == "maximise" ? Sense::maximise : Sense::minimise;
    read.weight = goal.value("weight");
    read.scale  = goal.has("scale") ? claimed(goal, "scale", read.output, claims) : 1.;
    sum.push_back({read.output, goal.has("scale"), given.error("").what()});
    if (!(read.scale > 0.))
      throw goal.error("scale", "needs a value above 0, got " + short_text(read.scale));
    goals.push_back(read);
  }
  if (goals.empty())
    throw table.error("goals", "needs a goal, such as goals = { F_max = { weight = 1, scale = \"100 kN\" } }");
  claims.sums.push_back(sum);
}

void read_limits(const StudyFile &study, const SceneTable &table, std::vector<Limit> &limits, OutputClaims &claims)
{
  for (const SceneTable &given : table.tables("limits"))
  {
    const SceneTable limit = given.declared(study_limit_keys());
    Limit            read;
    read.output = output_named(study, given, given.name());
    if (limit.has("least"))
      read.least = claimed(limit, "least", read.output, claims);
    if (limit.has("most"))
      read.most = claimed(limit, "most", read.output, claims);
    if (!limit.has("least") && !limit.has("most"))
      throw limit.error("needs 'least' or 'most'");
    if (!(read.least < read.most))
      throw limit.error("most",
                        "needs a value above 'least' = " + short_text(read.least) + ", got " + short_text(read.most));
    limits.push_back(read);
  }
}

RobustRequest read_robust(const StudyFile &study, const SceneTable &table)
{
  RobustRequest request;
  request.on               = table.choice("on") == "runs" ? AnalysisOn::runs : AnalysisOn::surface;
  constexpr int drawn_runs = 100; // standard deviation to 7 %, 1 / sqrt(2 n)
  request.draws            = at_least(table, "draws", 2, request.on == AnalysisOn::runs ? drawn_runs : request.draws);
  request.seed             = std::uint64_t(at_least(table, "seed", 0, 1));
  if (std::none_of(study.variables.begin(), study.variables.end(),
                   [](const VariableRequest &variable) { return variable.variable.scatter != Scatter::none; }))
    throw table.error("no variable scatters; give one scatter = \"normal\" and its width");
  return request;
}

OptimiseRequest read_optimise(const StudyFile &study, const SceneTable &table, OutputClaims &claims)
{
  OptimiseRequest request;
  const auto      n = Eigen::Index(study.variables.size());
  request.on        = table.choice("on") == "runs" ? AnalysisOn::runs : AnalysisOn::surface;
  request.task.low  = Eigen::VectorXd::Constant(n, -1.);
  request.task.high = Eigen::VectorXd::Constant(n, 1.);
  read_goals(study, table, request.task.goals, claims);
  read_limits(study, table, request.task.limits, claims);
  OptimumOptions &options     = request.options;
  const bool      runs        = request.on == AnalysisOn::runs;
  options.method              = search_method(table.choice("method"));
  options.starts              = at_least(table, "starts", 1, options.starts);
  options.seed                = std::uint64_t(at_least(table, "seed", 0, 1));
  constexpr int searched_runs = 60; // a search with a few variables ends within so many
  options.most_evaluations    = at_least(table, "most_runs", 2, runs ? searched_runs : options.most_evaluations);
  options.tolerance           = runs ? 1e-3 : options.tolerance;
  request.verify              = table.truth("verify");
  request.pareto              = table.has("pareto") ? at_least(table, "pareto", 2, 0) : 0;
  if (request.pareto > 0 && request.task.goals.size() < 2)
    throw table.error("pareto", "a front needs two goals or more");
  if (const auto robust = table.optional_table("robust"))
    request.robust = read_robust(study, *robust);
  refuse_stepped_variables(study, table, "[optimise]");
  return request;
}

RowChoiceTask read_choose(const StudyFile &study, const SceneTable &table, OutputClaims &claims)
{
  RowChoiceTask task;
  read_goals(study, table, task.goals, claims);
  read_limits(study, table, task.limits, claims);
  if (table.has("over"))
    task.over = output_named(study, table, table.text("over"));
  std::vector<std::string> names;
  for (const VariableRequest &request : study.variables)
    names.push_back(request.variable.name);
  if (table.has("by"))
    for (const std::string &name : table.texts("by"))
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end())
        throw table.error("by", "there is no variable '" + name + "'" + suggestion(name, names));
      task.by.push_back(int(found - names.begin()));
    }
  return task;
}

/// Before hours of runs, not after them.
void refuse_few_runs(const StudyFile &study, const SceneNode &node, const SurfaceOptions &options, int n_runs)
{
  const auto needed = surface_terms(int(study.variables.size()), options.order).size();
  if (std::size_t(n_runs) < needed)
    node.place.fail("surface: a surface of order \"" + order_word(options.order) + "\" in " +
                    std::to_string(study.variables.size()) + " variables has " + std::to_string(needed) +
                    " coefficients, but the design has " + std::to_string(n_runs) +
                    " runs; use a larger design, or order = \"linear\"");
}

} // namespace

bool AnalysisRequest::needs_surfaces() const
{
  return surface || (optimise && (optimise->on == AnalysisOn::surface || optimise->pareto > 0 ||
                                  (optimise->robust && optimise->robust->on == AnalysisOn::surface)));
}

int AnalysisRequest::most_side_by_side(int jobs) const
{
  if (!optimise)
    return 1;
  const int searches = optimise->on == AnalysisOn::runs ? optimise->options.starts : 1;
  const int draws    = optimise->robust && optimise->robust->on == AnalysisOn::runs ? optimise->robust->draws : 1;
  return std::min(jobs, std::max(searches, draws));
}

AnalysisRequest read_analysis(const StudyFile &study, int n_runs)
{
  const Parameters none;
  AnalysisRequest  request;
  const SceneNode *surface = study.root.find("surface"), *optimise = study.root.find("optimise");
  if (surface)
  {
    const SceneTable table = SceneTable(*surface, none, "surface").declared(study_surface_keys());
    request.surface        = read_surface(study, table);
    table.finish();
  }
  if (optimise)
  {
    const SceneTable table = SceneTable(*optimise, none, "optimise").declared(study_optimise_keys());
    request.optimise       = read_optimise(study, table, request.claims);
    table.finish();
  }
  if (const SceneNode *choose = study.root.find("choose"))
  {
    const SceneTable table = SceneTable(*choose, none, "choose").declared(study_choose_keys());
    request.choose         = read_choose(study, table, request.claims);
    table.finish();
  }
  if (request.needs_surfaces())
  {
    if (!request.surface)
      request.surface.emplace();
    refuse_few_runs(study, surface ? *surface : *optimise, request.surface->options, n_runs);
  }
  return request;
}

} // namespace gestell::apps
