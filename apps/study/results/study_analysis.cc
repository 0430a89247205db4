#include "apps/study/results/study_analysis.h"

#include "apps/version.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{
namespace
{

constexpr double quotient_step = 0.01; ///< of coded variables, for differences of runs

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
    if (names.empty() || std::find(names.begin(), names.end(), surface.output.name) != names.end())
      some.push_back(surface);
  return some;
}

/// The run of the design at the middle of all ranges.
std::optional<Eigen::VectorXd> middle_run(const StudyTable &table)
{
  const Eigen::MatrixXd coded = table.coded();
  for (const int run : table.usable_runs())
    if (coded.row(run).cwiseAbs().maxCoeff() < 1e-9)
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
                             const std::filesystem::path &folder, const std::atomic<bool> &stop)
    : study_(study), request_(request), runner_(runner), stop_(stop), text_(study), file_(folder / "optimum_runs.csv"),
      variables_(study.values())
{
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
  if (!rows_)
  {
    std::filesystem::remove(file_);
    rows_ = std::make_unique<RowsFile>(file_, text_);
  }
  const auto            n      = Eigen::Index(study_.outputs.size());
  const Eigen::VectorXd levels = levels_at(xi);
  const RunRow          row    = runner_.run(++number_, levels, &stop_, derivatives);
  if (derivatives && row.status == RunStatus::failed)
  {
    --number_; // it is made again without derivatives
    return {};
  }
  if (row.status != RunStatus::waiting)
    rows_->append(text_.line(row, levels));
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
    Eigen::VectorXd beside = xi;
    beside[i] += xi[i] > 0. ? -quotient_step : quotient_step;
    point.derivatives.col(i) = (values_at(beside, nullptr) - point.values) / (beside[i] - xi[i]);
  }
  return point;
}

StudyOptimum StudyAnalysis::optimum_of(const StudyAnswer &answer, const OutputModel &surfaces)
{
  const OptimiseRequest &asked   = *request_.optimise;
  const bool             runs    = asked.on == AnalysisOn::runs;
  OptimumOptions         options = asked.options;
  options.stop                   = &stop_;
  const OutputModel model =
      runs ? [this](const Eigen::VectorXd &xi, Derivatives derivatives) { return run_at(xi, derivatives); } : surfaces;
  StudyOptimum optimum;
  optimum.source  = runs ? "runs" : "surface";
  optimum.task    = asked.task;
  optimum.found   = find_optimum(model, asked.task, options);
  optimum.nominal = middle_run(answer.table);
  if (!runs && asked.verify && !stop_)
    if (const Eigen::VectorXd values = run_at(optimum.found.coded, Derivatives::none).values; values.allFinite())
      optimum.verified = values;
  if (!optimum.nominal && asked.verify && !stop_)
    optimum.nominal = run_at(Eigen::VectorXd::Zero(optimum.found.coded.size()), Derivatives::none).values;
  return optimum;
}

RobustResult StudyAnalysis::robust_at(const Eigen::VectorXd &nominal, const StudyTable &table,
                                      const OutputModel &surfaces)
{
  const RobustRequest &asked = *request_.optimise->robust;
  const auto          &task  = request_.optimise->task;
  if (asked.on == AnalysisOn::surface)
    return robust_on(surfaces, nominal, variables_, table.outputs, asked.draws, asked.seed, task.limits);
  const Eigen::MatrixXd points  = scattered_points(nominal, variables_, asked.draws, asked.seed);
  constexpr double      not_run = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd       values  = Eigen::MatrixXd::Constant(points.rows(), Eigen::Index(table.outputs.size()), not_run);
  for (Eigen::Index i = 0; i < points.rows() && !stop_; ++i)
    values.row(i) = run_at(points.row(i).transpose(), Derivatives::none).values.transpose();
  RobustResult result = robust_figures(values, table.outputs, task.limits);
  result.source       = "runs";
  result.nominal      = nominal;
  result.seed         = asked.seed;
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
  number_              = answer.table.n_runs();
  if (request_.choose)
    findings.choice = choose_row(answer.table, *request_.choose);
  OutputModel model;
  if (request_.needs_surfaces())
  {
    const auto surfaces = fit_surfaces(answer.table, request_.surface->options);
    findings.surfaces   = chosen(surfaces, request_.surface->outputs);
    model               = model_of(surfaces);
  }
  if (!request_.optimise)
    return findings;
  findings.optimum = optimum_of(answer, model);
  if (by_differences_)
    findings.warnings.push_back(
        "the search on runs took derivatives from differences of runs, for outputs or variables "
        "of this study have no sensitivities");
  findings.front_task = request_.optimise->task;
  if (request_.optimise->pareto > 0)
    findings.front = pareto_front(model, request_.optimise->task, {request_.optimise->pareto, 4096, 1});
  if (request_.optimise->robust && !stop_)
    findings.robust.push_back(robust_at(findings.optimum->found.coded, answer.table, model));
  return findings;
}

} // namespace gestell::apps
