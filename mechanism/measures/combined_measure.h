#pragma once

#include "mechanism/functions/position_function.h"
#include "mechanism/measures/relative_measure.h"

#include <memory>
#include <vector>

namespace gestell::mechanism
{

/**
 * A scalar of several motions of the machine, a weighted sum, optionally minus a position function:
 *
 *     s(u) = sum c_j y_j(u_j) - f(x(u_x)),     u = (u_1, u_2, ..., u_x)
 *     G    = (c_1 G_1, c_2 G_2, ..., -f' G_x),
 *     s''  = G u'' + sum c_j b_j - f' b_x - f'' x'^2.
 *
 * A screw is  along - pitch/2pi angle,  rolling  along - r angle,  a cam  lift - f(angle of the shaft).  Joints
 * prescribe its value, elements act on it; a spring in a cam drive acts on  lift - f.
 *
 * `history` [n_history()] is that of f, stored by the user of the measure.
 *
 * Source: docs/theory/position_functions.md (2).
 */
class CombinedMeasure
{
public:
  struct Term
  {
    double        weight = 1.; ///< c_j
    PlacedMeasure measure;     ///< y_j
  };
  using Value = RelativeMeasure::Value;

  static constexpr int max_measures = 2 * PlacedMeasure::max_measures;

  CombinedMeasure(const PlacedMeasure &measure); // NOLINT: a measure is the sum of one
  /// @throws std::invalid_argument without terms or for more measures than max_measures
  explicit CombinedMeasure(std::vector<Term> terms);
  /// @param x  argument of f
  CombinedMeasure(std::vector<Term> terms, const PlacedMeasure &x, std::shared_ptr<const PositionFunction> f);

  int   n_measures() const { return n_measures_; }
  Value evaluate(const double *u, const double *v, double *gradient, const double *history = nullptr) const;
  /// matrix += factor s''(u) [k x k, column major].
  void   add_curvature(const double *u, double factor, double *matrix, const double *history = nullptr) const;
  double size() const; ///< of the terms of s [m or rad]
  /// Whether it is an angle that jumps by 360 degrees at 180 degrees.
  bool wraps() const { return plain() && plain()->measure.wraps(); }
  /// The plain measure, if it is one, or null.
  const PlacedMeasure *plain() const;
  /// f'(x), 0 without f: -f' times the force on y acts on x.
  double slope(const double *u, const double *history = nullptr) const;

  // --- kinks of f as guards
  bool               has_function() const { return f_ != nullptr; }
  int                n_history() const { return f_ ? f_->n_history() : 0; }
  int                n_guards() const { return f_ ? f_->n_guards() : 0; }
  void               start(const double *u, const double *v, double *history) const;
  std::vector<Guard> guards(const double *history) const;
  void               guard_values(const double *u, const double *history, double *g) const;
  void               transition(int i, const double *u, const double *v, double *history) const;

private:
  /// x, x' and the index of its first measure in u; also its gradient.
  Value argument(const double *u, const double *v, double *gradient) const;
  int   first_of_x() const { return n_measures_ - x_.n_measures(); }

  std::vector<Term>                       terms_;
  PlacedMeasure                           x_; ///< without f of no measures
  std::shared_ptr<const PositionFunction> f_;
  int                                     n_measures_ = 0;
};

} // namespace gestell::mechanism
