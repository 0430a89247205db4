#include "apps/cli/command_answers.h"

#include "apps/output/text/json.h"
#include "coupling/frame/cache_folder.h"
#include "coupling/modes/modes.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

Json to_json(const coupling::CacheEntry &entry)
{
  Json json = {{"key", entry.key}, {"file", entry.file}, {"bytes", entry.bytes}, {"last_used_s", entry.last_used}};
  if (!entry.defect.empty())
  {
    json["defect"] = entry.defect;
    return json;
  }
  json["source"]      = entry.origin.source;
  json["scene"]       = entry.origin.scene;
  json["coordinates"] = {{"full", entry.n_full}, {"interface", entry.n_interface}, {"modes", entry.n_modes}};
  return json;
}

Json to_json(const coupling::SurfaceReport &surface)
{
  return {{"tag", surface.tag},   {"name", surface.name},       {"kind", surface.kind},
          {"type", surface.type}, {"area_m2", surface.area},    {"min_m", surface.min},
          {"max_m", surface.max}, {"centre_m", surface.centre}, {"selector", surface.selector}};
}

/// Values of a point by the names of what they are of.
template <typename Named>
Json values_of(const std::vector<Named> &names, const Eigen::VectorXd &values)
{
  Json json = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    json[names[i].name] = values[Eigen::Index(i)];
  return json;
}

/// The word, for a variable with words as levels.
Json level_of(const StudyVariable &variable, double level)
{
  if (variable.words.empty())
    return level;
  const auto word = std::size_t(std::max(0., level));
  return word < variable.words.size() ? Json(variable.words[word]) : Json(level);
}

Json told_run(const StudyTable &table, int i)
{
  const StudyRun &run    = table.runs[std::size_t(i)];
  Json            levels = Json::object();
  for (std::size_t k = 0; k < table.variables.size(); ++k)
    levels[table.variables[k].name] = level_of(table.variables[k], table.levels(i, Eigen::Index(k)));
  Json json = {{"run", i + 1},
               {"status", run.status == RunStatus::done     ? "done"
                          : run.status == RunStatus::failed ? "failed"
                                                            : "waiting"},
               {"levels", levels}};
  if (run.status == RunStatus::done)
    json["outputs"] = values_of(table.outputs, table.values.row(i));
  if (run.status == RunStatus::failed)
    json["message"] = run.message;
  return json;
}

Json to_json(const StudyOptimum &optimum, const StudyTable &table)
{
  Eigen::VectorXd levels(Eigen::Index(table.variables.size()));
  for (Eigen::Index k = 0; k < levels.size(); ++k)
    levels[k] = table.variables[std::size_t(k)].physical(optimum.found.coded[k]);
  Json json = {{"searched_on", optimum.source},
               {"feasible", optimum.found.feasible},
               {"levels", values_of(table.variables, levels)},
               {"outputs", values_of(table.outputs, optimum.found.values)}};
  if (optimum.verified)
    json["verified"] = values_of(table.outputs, *optimum.verified);
  if (optimum.nominal)
    json["middle"] = values_of(table.outputs, *optimum.nominal);
  return json;
}

Json told_units(const StudyTable &table)
{
  Json units = Json::object();
  for (const StudyVariable &variable : table.variables)
    units[variable.name] = variable.unit;
  for (const StudyOutput &output : table.outputs)
    units[output.name] = output.unit;
  return units;
}

void add_findings(const StudyFindings &findings, Json &json)
{
  for (const ResponseSurface &surface : findings.surfaces)
    json["surfaces"][surface.output.name] = {{"r2", surface.quality.r2},
                                             {"adjusted_r2", surface.quality.adjusted_r2},
                                             {"predicted_r2", surface.quality.predicted_r2},
                                             {"standard_error", surface.quality.standard_error}};
  if (findings.choice)
    json["best_run"] = findings.choice->best < 0 ? Json() : Json(findings.choice->best + 1);
  if (findings.optimum)
    json["optimum"] = to_json(*findings.optimum, findings.table);
  for (const RobustResult &result : findings.robust)
    for (const RobustFigures &figures : result.figures)
      json["scatter"][figures.output.name] = {{"nominal", figures.nominal},
                                              {"mean", figures.mean},
                                              {"deviation", figures.deviation},
                                              {"min", figures.min},
                                              {"max", figures.max}};
  json["front_points"] = findings.front.size();
}

} // namespace

std::string cache_answer(const std::vector<coupling::CacheEntry> &entries)
{
  Json json = {{"folder", coupling::cache_folder()}, {"frames", Json::array()}};
  for (const coupling::CacheEntry &entry : entries)
    json["frames"].push_back(to_json(entry));
  return json_text(json);
}

std::string explanation_answer(const CacheExplanation &explanation)
{
  const bool used = explanation.own && explanation.defect.empty();
  Json       json = {{"scene", explanation.scene}, {"key", explanation.key}, {"in_cache", used}};
  if (explanation.own)
    json["frame"] = to_json(*explanation.own);
  if (!explanation.defect.empty())
    json["defect"] = explanation.defect;
  if (explanation.nearest)
    json["nearest"] = to_json(*explanation.nearest);
  for (const auto &[name, kept, requested] : explanation.differences)
    json["differences"][name] = {{"kept", kept}, {"asked", requested}};
  return json_text(json);
}

std::string frame_answer(const FrameAnswer &answer)
{
  const coupling::ReducedFrame &frame = answer.frame;
  Json                          modes = Json::array();
  for (Eigen::Index j = 0; j < frame.frequencies_hz.size(); ++j)
  {
    Json mode = {{"frequency_hz", frame.frequencies_hz[j]}};
    if (j < frame.frequency_error.size() && std::isfinite(frame.frequency_error[j]))
    {
      mode["refined_hz"]     = coupling::refined_hz(frame, j);
      mode["relative_error"] = frame.frequency_error[j];
    }
    modes.push_back(mode);
  }
  Json interfaces = Json::array();
  for (const fem::Interface &interface : frame.interfaces)
    interfaces.push_back({{"name", interface.name}, {"position_m", interface.position}});
  return json_text(
      {{"from_cache", answer.from_cache},
       {"coordinates", {{"full", frame.n_full}, {"interface", frame.n_interface}, {"modes", frame.omega0.size()}}},
       {"mass_kg", frame.mass},
       {"static_residual", frame.static_residual},
       {"frequency_limit_hz", frame.frequency_limit_hz},
       {"supported_modes", modes},
       {"interfaces", interfaces},
       {"notes", frame.all_notes()}});
}

std::string partition_answer(const Partition &partition)
{
  Json kept = Json::array(), idle = Json::array();
  for (const Partition::Row &row : partition.rows)
    kept.push_back({{"coordinate", row.coordinate}, {"reasons", row.reasons}});
  for (const Partition::Idle &interface : partition.superfluous)
    idle.push_back(interface.interface);
  return json_text({{"kept", kept},
                    {"inside", partition.n2},
                    {"modes", partition.n_modes},
                    {"free_motions", partition.n_free},
                    {"massless", partition.n_massless},
                    {"superfluous", idle},
                    {"only_read", partition.only_read}});
}

std::string mesh_answer(const coupling::MeshReport &report)
{
  Json solids = Json::array(), surfaces = Json::array();
  for (const coupling::SolidReport &solid : report.solids)
    solids.push_back({{"name", solid.name},
                      {"volume_m3", solid.volume},
                      {"mass_kg", solid.mass},
                      {"density_kg_m3", solid.density},
                      {"material", solid.material},
                      {"min_m", solid.min},
                      {"max_m", solid.max}});
  for (const coupling::SurfaceReport &surface : report.surfaces)
    surfaces.push_back(to_json(surface));
  return json_text({{"points", report.n_points},
                    {"cells", report.n_cells},
                    {"kind_of_cells", report.cells},
                    {"coordinates", report.n_coordinates},
                    {"size_m", report.size},
                    {"volume_m3", report.volume},
                    {"mass_kg", report.mass},
                    {"worst_quality", report.worst_quality},
                    {"mean_quality", report.mean_quality},
                    {"memory_bytes", report.memory},
                    {"available_memory_bytes", report.available_memory},
                    {"unit_m", report.unit.length},
                    {"features", report.features},
                    {"notes", report.notes},
                    {"statements", report.statements},
                    {"solids", solids},
                    {"surfaces", surfaces}});
}

std::string study_answer(const StudyAnswer &answer, const StudyFindings *findings)
{
  Json runs = Json::array();
  for (int i = 0; i < answer.table.n_runs(); ++i)
    runs.push_back(told_run(answer.table, i));
  Json json = {{"made", answer.n_made},
               {"failed", answer.n_failed()},
               {"complete", answer.complete()},
               {"units", told_units(answer.table)},
               {"runs", runs}};
  if (findings)
    add_findings(*findings, json);
  return json_text(json);
}

} // namespace gestell::apps
