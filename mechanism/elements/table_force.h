#pragma once

#include "mechanism/differentiable_element.h"

namespace gestell::mechanism
{

/**
 * Force given by a table over time, displacement or rate; linear between its rows, constant beyond its ends.
 *
 * Measure u [m or rad]; x = t, u or u'.  Between successive rows (x_i, F_i) and (x_j, F_j)
 *
 *     p = F_i + (F_j - F_i) (x - x_i) / (x_j - x_i)        [N or N m]
 *
 * so +F acts on u.  Two rows with the same x are a jump.  At a corner or a jump of the force the next segment begins:
 * events "next_segment" and, if x can decrease, "previous_segment".
 *
 * Over the displacement it is conservative, with the energy E(u) = -integral of F from the first row.  Over time or
 * rate its work is input, negative if it brakes.  A falling jump over the rate, like that of dry friction, keeps the
 * rate there and chatters; use CoulombFriction for sticking.
 */
class TableForce : public DifferentiableElement<TableForce, 1, Branches, Structure>
{
public:
  enum class Against
  {
    time,
    displacement,
    rate
  };

  struct Row
  {
    double x;     ///< [s], [m or rad], [m/s or rad/s]
    double force; ///< F [N or N m]
  };

  struct Parameters
  {
    Against          against = Against::time;
    std::vector<Row> rows; ///< two or more, x not falling, at most two with the same x
  };

  explicit TableForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number   x = against_ == Against::time ? Number(m.t) : against_ == Against::rate ? m.v[0] : m.u[0];
    const Segment &s = m.by_history ? segments_[segment_of(history)] : segments_[segment_at(value(x))];
    p[0]             = s.force + s.slope * (x - s.x);
  }

  /// The steepest restoring segment.
  void stiffest(const double *u, double *K, double *D) const override;

  /// history: active segment, 0 before the first corner.
  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  Work                  work() const override;
  int                   n_guards(const double *history) const override;
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  /// F = force + slope (x - x0), with the energy E at x0 of a table over the displacement.
  struct Segment
  {
    double x, force, slope, energy;
  };

  static std::size_t segment_of(const double *history) { return static_cast<std::size_t>(history[0]); }
  std::size_t        segment_at(double x) const; ///< at a corner the following one
  double             abscissa(const LocalMotion &motion) const;
  bool               ends(std::size_t segment) const { return segment < corners_.size(); }
  bool               goes_back(std::size_t segment) const { return segment > 0 && against_ != Against::time; }

  Against              against_;
  std::vector<double>  corners_;  ///< ascending
  std::vector<Segment> segments_; ///< one more than corners
};

} // namespace gestell::mechanism
