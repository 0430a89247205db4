#include "apps/study/results/study_analysis.h"

#include "apps/output/folder/own_folder.h"
#include "apps/study/optimum/side_by_side.h"
#include "apps/version.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// The user does not want to wait for the rest.
struct StudyInterrupted : std::runtime_error
{
  StudyInterrupted() : std::runtime_error("study: interrupted") {}
};

std::string place_of(const StudyFile &study, const std::string &table)
{
  const SceneNode *node = study.root.find(table);
  return (node ? node->place : study.root.place).text() + ": " + table + ": ";
}

/// Those of the outputs that were asked for.
std::vector<ResponseSurface> chosen(const std::vector<ResponseSurface> &surfaces, const std::vector<std::string> &names)
{
  std::vector<ResponseSurface> some;
  for (const ResponseSurface &surface : surfaces)
    if (surface.is_fitted() &&
        (names.empty() || std::find(names.begin(), names.end(), surface.output.name) != names.end()))
      some.push_back(surface);
  return some;
}

/// Surfaces that hold for the runs they went through, and for no other.
void warn_of_poor_fits(StudyFindings &findings)
{
  constexpr double least_told = 0.5; ///< of the variance of runs that are left out of the fit
  for (const ResponseSurface &surface : findings.surfaces)
    if (surface.changes() && surface.quality.predicted_r2 < least_told)
      findings.warnings.push_back("the surface of " + surface.output.name + " predicts runs outside its fit " +
                                  (surface.quality.predicted_r2 > 0. ? "badly" : "no better than their mean") +
                                  " (predicted R2 " + short_text(surface.quality.predicted_r2, 2) +
                                  "); narrow the ranges, make more runs, or search with runs instead of surfaces");
}

/// The run of the design at the middle of all ranges.
std::optional<Eigen::VectorXd> middle_run(const StudyTable &table)
{
  const Eigen::MatrixXd coded = table.coded();
  for (const int run : table.usable_runs())
    if (coded.row(run).cwiseAbs().maxCoeff() < same_level)
      return table.values.row(run).transpose();
  return std::nullopt;
}

} // namespace

void check_analysis(const AnalysisRequest &request, const StudyFile &study, const StudyPoints &points)
{
  if (!request.needs_surfaces())
    return;
  std::vector<std::string> names;
  for (const VariableRequest &variable : study.variables)
    names.push_back(variable.variable.name);
  try
  {
    const Eigen::MatrixXd &coded = points.design.points;
    fit_surface(coded, coded.rowwise().squaredNorm(), {}, names, request.surface->options);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(place_of(study, study.root.find("surface") ? "surface" : "optimise") + error.what());
  }
}

StudyAnalysis::StudyAnalysis(const StudyFile &study, const AnalysisRequest &request, StudyRunner &runner,
                             const StudyCall &call)
    : study_(study), request_(request), runner_(runner), stop_(*call.stop), text_(study),
      file_(call.folder / "optimum_runs.csv"), variables_(study.values()), jobs_(call.jobs)
{
}

void StudyAnalysis::go_on() const
{
  if (stop_)
    throw StudyInterrupted();
}

/// The page of a run whose results were kept, from the folder of the study; "" if there is none.
std::string StudyAnalysis::link_of(int number) const
{
  const std::filesystem::path page = std::filesystem::path(run_folder(number)) / "report.html";
  return study_.keep && std::filesystem::exists(file_.parent_path() / page) ? page.generic_string() : "";
}

int StudyAnalysis::next_number()
{
  const std::lock_guard<std::mutex> alone(mutex_);
  return ++number_;
}

void StudyAnalysis::keep_row(const RunRow &row, const Eigen::VectorXd &levels)
{
  const std::lock_guard<std::mutex> alone(mutex_);
  if (!rows_)
  {
    OwnFolder folder(file_.parent_path());
    folder.claim(file_.filename().string());
    folder.remove(file_.filename().string());
    rows_ = std::make_unique<RowsFile>(file_);
  }
  rows_->append(text_.head(row.units), text_.line(row, levels));
}

Eigen::VectorXd StudyAnalysis::levels_at(const Eigen::VectorXd &xi) const
{
  Eigen::VectorXd levels(xi.size());
  for (Eigen::Index i = 0; i < xi.size(); ++i)
    levels[i] = variables_[std::size_t(i)].physical(xi[i]);
  return levels;
}

Eigen::VectorXd StudyAnalysis::values_at(const Eigen::VectorXd &xi, Eigen::MatrixXd *derivatives)
{
  go_on();
  const auto            n      = Eigen::Index(study_.outputs.size());
  const Eigen::VectorXd levels = levels_at(xi);
  const RunRow          row    = server_->run(next_number(), levels, derivatives);
  if (row.status == RunStatus::waiting)
    throw StudyInterrupted();
  if (derivatives && row.status == RunStatus::failed)
    return {}; // it is made again without derivatives
  keep_row(row, levels);
  return row.status == RunStatus::done ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(row.values.data(), n))
                                       : Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
}

/// Outputs of a run, nan of one that fails; derivatives by its sensitivities, or where it has none by differences of
/// runs, one more a variable, inside the ranges.
OutputPoint StudyAnalysis::run_at(const Eigen::VectorXd &xi, Derivatives derivatives)
{
  OutputPoint point;
  if (derivatives == Derivatives::wanted)
  {
    point.values = values_at(xi, &point.derivatives);
    if (point.values.size() > 0 && point.derivatives.size() > 0)
    {
      for (Eigen::Index i = 0; i < xi.size(); ++i)
        point.derivatives.col(i) *= variables_[std::size_t(i)].half_range(); // by coded values
      return point;
    }
  }
  if (point.values.size() == 0)
    point.values = values_at(xi, nullptr);
  if (derivatives == Derivatives::none)
    return point;
  by_differences_ = true;
  point.derivatives.resize(point.values.size(), xi.size());
  for (Eigen::Index i = 0; i < xi.size(); ++i)
  {
    Eigen::VectorXd nearby = xi;
    // of coded variables, for differences of runs: far above what runs scatter by, far below the box
    constexpr double quotient_step = 0.01;
    nearby[i] += xi[i] > 0. ? -quotient_step : quotient_step;
    point.derivatives.col(i) = (values_at(nearby, nullptr) - point.values) / (nearby[i] - xi[i]);
  }
  return point;
}

StudyOptimum StudyAnalysis::optimum_of(const StudyAnswer &answer, const OutputModel &surfaces)
{
  const OptimiseRequest &requested = *request_.optimise;
  const bool             runs      = requested.on == AnalysisOn::runs;
  OptimumOptions         options   = requested.options;
  options.side_by_side             = runs ? jobs_ : 1;
  const OutputModel model =
      runs ? [this](const Eigen::VectorXd &xi, Derivatives derivatives) { return run_at(xi, derivatives); } : surfaces;
  StudyOptimum optimum;
  optimum.source = runs ? "runs" : "surface";
  optimum.task   = requested.task;
  optimum.found  = find_optimum(model, requested.task, options);
  go_on();
  optimum.nominal = middle_run(answer.table);
  if (!runs && requested.verify)
    if (const Eigen::VectorXd values = run_at(optimum.found.coded, Derivatives::none).values; values.allFinite())
    {
      optimum.verified = values;
      optimum.link     = link_of(number_);
    }
  if (!optimum.nominal && requested.verify)
    optimum.nominal = run_at(Eigen::VectorXd::Zero(optimum.found.coded.size()), Derivatives::none).values;
  return optimum;
}

RobustResult StudyAnalysis::robust_at_optimum(const StudyFindings &findings, const OutputModel &surfaces)
{
  const Eigen::VectorXd &nominal   = findings.optimum->found.coded;
  const StudyTable      &table     = findings.table;
  const RobustRequest   &requested = *request_.optimise->robust;
  const auto            &task      = request_.optimise->task;
  if (requested.on == AnalysisOn::surface)
    return robust_on(surfaces, nominal, variables_, table.outputs, requested.draws, requested.seed, task.limits);
  const Eigen::MatrixXd points  = scattered_points(nominal, variables_, requested.draws, requested.seed);
  constexpr double      not_run = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd       values  = Eigen::MatrixXd::Constant(points.rows(), Eigen::Index(table.outputs.size()), not_run);
  side_by_side(int(points.rows()), jobs_,
               [&](int i) { values.row(i) = run_at(points.row(i).transpose(), Derivatives::none).values.transpose(); });
  const StudyOptimum &optimum = *findings.optimum;
  RobustResult        result  = robust_figures(values, table.outputs, task.limits,
                                       optimum.source == "runs" ? optimum.found.values
                                               : optimum.verified       ? *optimum.verified
                                                                        : run_at(nominal, Derivatives::none).values);
  result.source               = "runs";
  result.nominal              = nominal;
  result.seed                 = requested.seed;
  return result;
}

StudyFindings StudyAnalysis::of(const StudyAnswer &answer)
{
  StudyFindings findings;
  findings.name        = study_.name;
  findings.description = study_.description;
  findings.scene       = std::filesystem::path(study_.scene).filename().string();
  findings.version     = version;
  findings.design      = answer.design;
  findings.table       = answer.table;
  for (int run = 0; run < findings.table.n_runs(); ++run)
    findings.table.runs[std::size_t(run)].link = link_of(run + 1);
  number_ = answer.table.n_runs();
  server_ = std::make_unique<RunServer>(runner_, text_, request_.most_side_by_side(jobs_), stop_);
  try
  {
    find(answer, findings);
  }
  catch (const StudyInterrupted &)
  {
    findings.warnings.push_back("interrupted: results are incomplete; completed runs are in " +
                                file_.filename().string());
  }
  if (by_differences_)
    findings.warnings.push_back("the search with runs used difference quotients, because outputs or variables of this "
                                "study have no sensitivities");
  return findings;
}

/// The output that a search on surfaces asks for in vain, or "".
std::string StudyAnalysis::lacking_surface(const std::vector<ResponseSurface> &surfaces) const
{
  const OptimiseRequest &requested = *request_.optimise;
  if (requested.on == AnalysisOn::runs && requested.pareto == 0)
    return "";
  std::vector<int> outputs;
  for (const Goal &goal : requested.task.goals)
    outputs.push_back(goal.output);
  for (const Limit &limit : requested.task.limits)
    outputs.push_back(limit.output);
  for (const int output : outputs)
    if (!surfaces[std::size_t(output)].is_fitted())
      return surfaces[std::size_t(output)].output.name;
  return "";
}

void StudyAnalysis::find(const StudyAnswer &answer, StudyFindings &findings)
{
  if (request_.choose)
    findings.choice = choose_row(answer.table, *request_.choose);
  OutputModel                  model;
  std::vector<ResponseSurface> surfaces;
  if (request_.needs_surfaces())
  {
    std::vector<std::string> without;
    surfaces = fit_surfaces(answer.table, request_.surface->options, &without);
    findings.warnings.insert(findings.warnings.end(), without.begin(), without.end());
    findings.surfaces = chosen(surfaces, request_.surface->outputs);
    warn_of_poor_fits(findings);
    model = [this, fitted = model_of(surfaces)](const Eigen::VectorXd &xi, Derivatives derivatives)
    {
      go_on();
      return fitted(xi, derivatives);
    };
  }
  if (!request_.optimise)
    return;
  if (const std::string lacking = lacking_surface(surfaces); !lacking.empty())
  {
    findings.warnings.push_back("no optimum was computed: output " + lacking +
                                ", which is a goal or has a limit, has no surface");
    return;
  }
  findings.optimum    = optimum_of(answer, model);
  findings.front_task = request_.optimise->task;
  if (request_.optimise->pareto > 0)
  {
    findings.front = pareto_front(model, request_.optimise->task, {request_.optimise->pareto, 4096, 1});
    if (findings.front.empty())
      findings.warnings.push_back("there is no Pareto front: none of the examined points satisfies all limits; widen "
                                  "the limits or the ranges of the variables");
  }
  if (request_.optimise->robust)
    findings.robust.push_back(robust_at_optimum(findings, model));
}

} // namespace gestell::apps
