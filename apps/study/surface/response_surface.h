#pragma once

#include "apps/study/surface/surface_term.h"
#include "apps/study/values/study_table.h"

namespace gestell::apps
{

/// How well a surface tells the runs it was fitted to, and others.  nan where there is nothing to tell it by.
struct FitQuality
{
  double r2             = 0.; ///< 1 - SSE / SST
  double adjusted_r2    = 0.; ///< 1 - (SSE / (n - p)) / (SST / (n - 1))
  double predicted_r2   = 0.; ///< 1 - PRESS / SST
  double standard_error = 0.; ///< sigma = sqrt(SSE / (n - p)), in the unit of the output
  double press          = 0.; ///< sum of squared differences to runs that were left out of the fit
  int    n_runs = 0, n_coefficients = 0;

  // Lack of fit against pure error, of runs at the same point.
  int    pure_error_dof      = 0;
  double pure_error          = 0.; ///< sum of squares about the mean of each point; 0 if runs repeat exactly
  double lack_of_fit         = 0.; ///< sum of squares, SSE - pure error
  int    lack_of_fit_dof     = 0;
  double lack_of_fit_F       = 0.; ///< ratio of mean squares; infinite where runs repeat exactly
  double lack_of_fit_p_value = 0.; ///< of an F as large by chance
};

/**
 * Polynomial of an output in coded variables, with the statistics of its fit:
 *
 *     y(xi) = sum_j b_j t_j(xi),      t_j = 1, xi_i, xi_i^2, xi_i xi_l.
 */
struct ResponseSurface
{
  StudyOutput              output{};
  std::vector<std::string> variables{};
  SurfaceOrder             order = SurfaceOrder::quadratic;
  std::vector<SurfaceTerm> terms{};
  Eigen::VectorXd          coefficients{};    ///< b, in the unit of the output
  Eigen::VectorXd          standard_errors{}; ///< of b; nan if there are as many coefficients as runs
  double                   level = 0.95;      ///< of confidence
  Eigen::VectorXd          confidence{};      ///< half widths of the intervals of b, Student's t
  Eigen::MatrixXd          inverse_normal{};  ///< (X^T X)^-1
  FitQuality               quality{};

  // By run of the fit.
  std::vector<int> runs{}; ///< their rows in the table of the study
  Eigen::VectorXd  computed{}, fitted{};
  Eigen::VectorXd  leverage{}; ///< h_ii, of 0 to 1; 1: the surface goes through this run whatever it says
  Eigen::VectorXd  left_out{}; ///< what the surface of all other runs says; nan where h_ii = 1

  bool            is_fitted() const { return coefficients.size() > 0; } ///< else it has no values
  bool            changes() const;                                      ///< whether runs differ by more than rounding
  double          value(const Eigen::VectorXd &xi) const;
  Eigen::VectorXd gradient(const Eigen::VectorXd &xi) const;
  /// Standard error of the fitted mean: sigma sqrt(t^T (X^T X)^-1 t).
  double standard_error(const Eigen::VectorXd &xi) const;

  std::string term_name(int j) const { return apps::term_name(terms[j], variables); }
};

struct SurfaceOptions
{
  SurfaceOrder order = SurfaceOrder::quadratic;
  double       level = 0.95; ///< of confidence, between 0 and 1
};

/**
 * The surface of y [runs] at coded points [runs x variables] by least squares.
 * @throws std::invalid_argument for fewer runs than coefficients, a singular design (with the terms it confounds),
 * values that are not finite, a level outside (0, 1) Source: Myers, Montgomery & Anderson-Cook, Response Surface
 * Methodology, ch. 2; docs/theory/response_surfaces.md (1) to (8)
 */
ResponseSurface fit_surface(const Eigen::MatrixXd &coded, const Eigen::VectorXd &y, const StudyOutput &output,
                            const std::vector<std::string> &variables, const SurfaceOptions &options = {});

/// One surface per output, of the runs that have a value of it; is_fitted() is false where those are too few.
/// @param without  becomes why surfaces are not fitted, one line each; may be null
/// @throws std::invalid_argument as fit_surface where no output has a surface, telling how many runs have failed
std::vector<ResponseSurface> fit_surfaces(const StudyTable &table, const SurfaceOptions &options = {},
                                          std::vector<std::string> *without = nullptr);

} // namespace gestell::apps
