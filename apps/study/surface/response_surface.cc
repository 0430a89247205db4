#include "apps/study/surface/response_surface.h"

#include "apps/study/surface/least_squares.h"
#include "fem/values/number_text.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double quotient_or_nan(double a, double b)
{
  return b > 0. ? a / b : not_a_number;
}

Eigen::VectorXd terms_at(const ResponseSurface &surface, const Eigen::VectorXd &xi)
{
  Eigen::VectorXd t(static_cast<Eigen::Index>(surface.terms.size()));
  for (Eigen::Index j = 0; j < t.size(); ++j)
    t(j) = surface.terms[j].value(xi);
  return t;
}

/// Runs at the same point, by its levels in steps of `same_level`.
std::map<std::vector<long long>, std::vector<Eigen::Index>> runs_by_point(const Eigen::MatrixXd &coded)
{
  std::map<std::vector<long long>, std::vector<Eigen::Index>> points;
  for (Eigen::Index run = 0; run < coded.rows(); ++run)
  {
    std::vector<long long> point;
    for (Eigen::Index j = 0; j < coded.cols(); ++j)
      point.push_back(std::llround(coded(run, j) / same_level));
    points[point].push_back(run);
  }
  return points;
}

void add_pure_error(const Eigen::MatrixXd &coded, const Eigen::VectorXd &y, FitQuality &quality)
{
  for (const auto &[point, runs] : runs_by_point(coded))
  {
    const Eigen::VectorXd repeated = y(runs);
    quality.pure_error += (repeated.array() - repeated.mean()).square().sum();
    quality.pure_error_dof += static_cast<int>(runs.size()) - 1;
  }
  constexpr double exact_repeating = 1e-24; // of the sum of squares: repeated runs that differ by rounding alone
  if (quality.pure_error <= exact_repeating * y.squaredNorm())
    quality.pure_error = 0.;
}

void judge_lack_of_fit(double sse, FitQuality &quality)
{
  quality.lack_of_fit         = std::max(0., sse - quality.pure_error);
  quality.lack_of_fit_dof     = quality.n_runs - quality.n_coefficients - quality.pure_error_dof;
  quality.lack_of_fit_F       = not_a_number;
  quality.lack_of_fit_p_value = not_a_number;
  if (quality.pure_error_dof < 1 || quality.lack_of_fit_dof < 1)
    return;
  quality.lack_of_fit_F =
      (quality.lack_of_fit / quality.lack_of_fit_dof) / (quality.pure_error / quality.pure_error_dof);
  if (std::isinf(quality.lack_of_fit_F))
    quality.lack_of_fit_p_value = 0.;
  else if (!std::isnan(quality.lack_of_fit_F))
    quality.lack_of_fit_p_value = boost::math::cdf(boost::math::complement(
        boost::math::fisher_f(quality.lack_of_fit_dof, quality.pure_error_dof), quality.lack_of_fit_F));
}

/// What the surface of all other runs says at each run: y_i - e_i / (1 - h_ii).
Eigen::VectorXd leave_one_out(const Eigen::VectorXd &y, const Eigen::VectorXd &fitted, const Eigen::VectorXd &leverage)
{
  Eigen::VectorXd  left_out(y.size());
  constexpr double full_leverage = 1e-10; // 1 - h_ii below it is rounding
  for (Eigen::Index i = 0; i < y.size(); ++i)
    left_out(i) = 1. - leverage(i) > full_leverage ? y(i) - (y(i) - fitted(i)) / (1. - leverage(i)) : not_a_number;
  return left_out;
}

void judge_fit(const Eigen::MatrixXd &coded, ResponseSurface &surface)
{
  const Eigen::VectorXd &y = surface.computed;
  FitQuality            &q = surface.quality;
  q.n_runs                 = static_cast<int>(y.size());
  q.n_coefficients         = static_cast<int>(surface.terms.size());
  const int    dof         = q.n_runs - q.n_coefficients;
  const double sst = (y.array() - y.mean()).square().sum(), sse = (y - surface.fitted).squaredNorm();
  q.press          = (y - surface.left_out).squaredNorm();
  q.r2             = 1. - quotient_or_nan(sse, sst);
  q.predicted_r2   = 1. - quotient_or_nan(q.press, sst);
  q.standard_error = dof > 0 ? std::sqrt(sse / dof) : not_a_number;
  q.adjusted_r2    = dof > 0 ? 1. - quotient_or_nan(sse / dof, sst / (q.n_runs - 1)) : not_a_number;
  add_pure_error(coded, y, q);
  judge_lack_of_fit(sse, q);
}

void judge_coefficients(ResponseSurface &surface)
{
  const int    dof = surface.quality.n_runs - surface.quality.n_coefficients;
  const double t =
      dof > 0 ? boost::math::quantile(boost::math::students_t(dof), 0.5 + 0.5 * surface.level) : not_a_number;
  surface.standard_errors = surface.quality.standard_error * surface.inverse_normal.diagonal().cwiseSqrt();
  surface.confidence      = t * surface.standard_errors;
}

void check_fit(const Eigen::MatrixXd &coded, const Eigen::VectorXd &y, const StudyOutput &output,
               const std::vector<std::string> &variables, double level)
{
  if (coded.rows() != y.size() || coded.cols() != static_cast<Eigen::Index>(variables.size()))
    throw std::invalid_argument("study: surface of " + output.name + ": points and values differ in size");
  if (!coded.allFinite() || !y.allFinite())
    throw std::invalid_argument("study: surface of " + output.name + ": a run has no finite value");
  if (!(level > 0. && level < 1.))
    throw std::invalid_argument("study: surface: confidence is " + short_text(level) +
                                "; it must be between 0 and 1, such as 0.95");
}

std::vector<std::string> names_of(const std::vector<StudyVariable> &variables)
{
  std::vector<std::string> names;
  for (const auto &variable : variables)
    names.push_back(variable.name);
  return names;
}

ResponseSurface fit_by(const LeastSquares &squares, const ResponseSurface &model, const Eigen::MatrixXd &coded,
                       const Eigen::MatrixXd &X)
{
  ResponseSurface surface = model;
  surface.coefficients    = squares.solve(surface.computed);
  surface.fitted          = X * surface.coefficients;
  surface.leverage        = squares.leverage();
  surface.inverse_normal  = squares.inverse_normal();
  surface.left_out        = leave_one_out(surface.computed, surface.fitted, surface.leverage);
  judge_fit(coded, surface);
  judge_coefficients(surface);
  return surface;
}

std::vector<std::string> names_of_terms(const ResponseSurface &model)
{
  std::vector<std::string> names;
  for (const auto &term : model.terms)
    names.push_back(term_name(term, model.variables));
  return names;
}

ResponseSurface unfitted(const StudyOutput &output, const std::vector<std::string> &variables,
                         const SurfaceOptions &options, const Eigen::VectorXd &y)
{
  ResponseSurface model;
  model.output    = output;
  model.variables = variables;
  model.order     = options.order;
  model.level     = options.level;
  model.terms     = surface_terms(static_cast<int>(variables.size()), options.order);
  model.computed  = y;
  return model;
}

/// Why a fit has fewer runs than the design.
std::string missing_text(const StudyTable &table, std::size_t n_with)
{
  const int failed = table.n_runs() - table.n_done(), valueless = table.n_done() - int(n_with);
  if (failed + valueless == 0)
    return "";
  return " (" + std::to_string(failed) + " of " + count_text(table.n_runs(), "run") + " failed or are pending" +
         (valueless > 0 ? ", " + std::to_string(valueless) + " have no value of it)" : ")");
}

} // namespace

bool ResponseSurface::changes() const
{
  constexpr double rounding = 1e-9; // of the largest value: chosen; noise of runs
  return computed.size() > 0 && computed.maxCoeff() - computed.minCoeff() > rounding * computed.cwiseAbs().maxCoeff();
}

double ResponseSurface::value(const Eigen::VectorXd &xi) const
{
  if (!is_fitted())
    return not_a_number;
  return terms_at(*this, xi).dot(coefficients);
}

Eigen::VectorXd ResponseSurface::gradient(const Eigen::VectorXd &xi) const
{
  if (!is_fitted())
    return Eigen::VectorXd::Constant(xi.size(), not_a_number);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(xi.size());
  for (std::size_t j = 0; j < terms.size(); ++j)
    terms[j].add_gradient(xi, coefficients(static_cast<Eigen::Index>(j)), sum);
  return sum;
}

double ResponseSurface::standard_error(const Eigen::VectorXd &xi) const
{
  const Eigen::VectorXd t = terms_at(*this, xi);
  return quality.standard_error * std::sqrt(t.dot(inverse_normal * t));
}

ResponseSurface fit_surface(const Eigen::MatrixXd &coded, const Eigen::VectorXd &y, const StudyOutput &output,
                            const std::vector<std::string> &variables, const SurfaceOptions &options)
{
  check_fit(coded, y, output, variables, options.level);
  const ResponseSurface model = unfitted(output, variables, options, y);
  const Eigen::MatrixXd X     = model_matrix(coded, model.terms);
  return fit_by(LeastSquares(X, names_of_terms(model)), model, coded, X);
}

std::vector<ResponseSurface> fit_surfaces(const StudyTable &table, const SurfaceOptions &options,
                                          std::vector<std::string> *without)
{
  const Eigen::MatrixXd        coded     = table.coded();
  const auto                   variables = names_of(table.variables);
  std::vector<ResponseSurface> surfaces;
  std::vector<std::string>     reasons;
  for (std::size_t i = 0; i < table.outputs.size(); ++i)
  {
    const std::vector<int> runs   = table.runs_with(int(i));
    const Eigen::VectorXd  values = table.values.col(Eigen::Index(i))(runs);
    try
    {
      surfaces.push_back(fit_surface(coded(runs, Eigen::all), values, table.outputs[i], variables, options));
      surfaces.back().runs = runs;
    }
    catch (const std::invalid_argument &error)
    {
      surfaces.push_back(unfitted(table.outputs[i], variables, options, values));
      reasons.push_back("output " + table.outputs[i].name + " has no surface: " + error.what() +
                        missing_text(table, runs.size()));
    }
  }
  if (reasons.size() == table.outputs.size() && !reasons.empty())
    throw std::invalid_argument(reasons.front());
  if (without)
    *without = reasons;
  return surfaces;
}

} // namespace gestell::apps
