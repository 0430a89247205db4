#pragma once

#include <functional>
#include <string>
#include <vector>

#define GESTELL_SHOWN __attribute__((visibility("default")))

namespace gestell
{

/**
 * A user-defined second-order system, in any consistent units:
 *
 *     M q'' + B q' + C q = f(t) + W p(t, u, u'),     u = W^T q.
 *
 * Matrices are stored row by row.
 */
struct OwnSystem
{
  /// Forces p [n_u] at u, u' [n_u] with their derivatives [n_u x n_u]; all must be written.
  using Forces =
      std::function<void(double t, const double *u, const double *v, double *p, double *dp_du, double *dp_dv)>;
  /// f(t) [n], must be written.
  using Load = std::function<void(double t, double *f)>;

  int                 n = 0, n_u = 0; ///< coordinates, measures of the nonlinear forces
  std::vector<double> M, B, C;        ///< [n x n]; M regular
  std::vector<double> W;              ///< [n x n_u]
  Forces              forces{};       ///< none if n_u = 0
  Load                load{};         ///< may be empty
};

/// Integration method: `run.method` and its parameters in a scene, without events.
struct OwnMethod
{
  std::string name      = "bdf"; ///< "newmark", "hht", "generalised-alpha", "central-difference", "exact" ...
  int         order     = 2;
  double      step      = 0.; ///< [s] fixed; with a tolerance the largest step, 0: `end`
  double      tolerance = 0.; ///< of the local error; 0: fixed step
};

/// Motion at equally spaced times.
struct OwnMotion
{
  std::vector<double> t;
  std::vector<double> q, v; ///< [times x n], row by row
};

/// Integrates from q, v [n] at t = 0 to `end`, with a row every `output_step`, including the first and the last
/// instant.
/// @throws std::invalid_argument for wrong sizes and numbers out of range, std::runtime_error if the method fails
GESTELL_SHOWN OwnMotion integrate(const OwnSystem &system, const std::vector<double> &q, const std::vector<double> &v,
                                  const OwnMethod &method, double end, double output_step);

} // namespace gestell
