#pragma once

#include "apps/study/optimum/optimum_task.h"
#include "apps/study/optimum/output_model.h"

#include <cstdint>

namespace gestell::apps
{

/**
 * Points about a nominal one as the variables scatter (study_variable.h), at random: n rows of coded values.  The
 * points of a longer set begin with those of a shorter one.
 * @throws std::invalid_argument if no variable scatters, or n < 2
 */
Eigen::MatrixXd scattered_points(const Eigen::VectorXd &nominal, const std::vector<StudyVariable> &variables, int n,
                                 std::uint64_t seed);

/// A quantile with the interval that holds the true one in 95 % of all samples.
struct Quantile
{
  double share = 0.5;
  double value = 0.;
  double low = 0., high = 0.; ///< -+ infinite where the sample is too small to tell
};

/// What scatter makes of an output; errors are standard errors of the sample.
struct RobustFigures
{
  StudyOutput           output{};
  double                nominal = 0.; ///< without scatter
  double                mean = 0., mean_error = 0.;
  double                deviation = 0., deviation_error = 0.;
  double                min = 0., max = 0.;
  std::vector<Quantile> quantiles{}; ///< of 1, 5, 50, 95 and 99 %
};

struct RobustResult
{
  std::string                source{};              ///< "surface" or "runs"
  Eigen::VectorXd            nominal{};             ///< coded
  int                        draws = 0, failed = 0; ///< failed ones are left out of all figures but the last
  std::uint64_t              seed    = 0;
  double                     outside = 0.; ///< share of draws outside -1 ... 1, where a surface extrapolates
  std::vector<RobustFigures> figures{};
  double                     kept = 1., kept_error = 0.; ///< share of draws that keep all limits; a failed one does not
};

/**
 * Figures of a sample of outputs [draws x outputs]:
 *
 *     error of the mean = s / sqrt(n),      error of s = sqrt((m4 - s^4 (n - 3)/(n - 1)) / n) / (2 s)
 *
 * and quantiles by order statistics, whose intervals need no law of distribution.  Outputs that no draw has a value of
 * are left out.
 * @param undisturbed  outputs without scatter; empty: not known
 * @throws std::invalid_argument if fewer than two draws have finite values
 * Source: Conover, Practical Nonparametric Statistics, 3.2; docs/theory/response_surfaces.md (13) and (14)
 */
RobustResult robust_figures(const Eigen::MatrixXd &values, const std::vector<StudyOutput> &outputs,
                            const std::vector<Limit> &limits = {}, const Eigen::VectorXd &undisturbed = {});

/// The figures of scattered_points on a model; nominal, seed and the share outside are filled in, the source is
/// "surface".
RobustResult robust_on(const OutputModel &model, const Eigen::VectorXd &nominal,
                       const std::vector<StudyVariable> &variables, const std::vector<StudyOutput> &outputs, int draws,
                       std::uint64_t seed, const std::vector<Limit> &limits = {});

} // namespace gestell::apps
