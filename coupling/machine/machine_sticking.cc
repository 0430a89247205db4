#include "coupling/machine/machine_parts.h"

#include <algorithm>
#include <set>

namespace gestell::coupling
{

namespace
{

/// The space spanned by rows of velocities, all of the same length; orthonormal.
class Span
{
public:
  /// Returns false if the span already contains the row.
  bool add(const Eigen::VectorXd &row)
  {
    const Eigen::VectorXd rest = rest_of(row);
    if (!(rest.norm() > dependent))
      return false;
    rows_.push_back(rest.normalized());
    return true;
  }
  bool contains(const Eigen::VectorXd &row, double share = dependent) const { return !(rest_of(row).norm() > share); }

  static constexpr double dependent = 1e-7; ///< share of a row below which it is rounding

private:
  Eigen::VectorXd rest_of(const Eigen::VectorXd &row) const
  {
    Eigen::VectorXd rest = row.normalized();
    for (int pass = 0; pass < 2; ++pass) // the second takes what rounding left
      for (const Eigen::VectorXd &own : rows_)
        rest -= own.dot(rest) * own;
    return rest;
  }

  std::vector<Eigen::VectorXd> rows_;
};

/// Rows of velocities over the coordinates that joints and sticking measures move.
class MotionRows
{
public:
  explicit MotionRows(const MachineParts &parts) : parts_(parts)
  {
    double rate = 0.;
    for (const ConstraintBlock &block : parts.joint_blocks)
      for (int k = 0; k < block.n_measures; ++k)
        touch(block.first_measure + k);
    for (const MachineParts::PlacedElement &part : parts.placed)
      if (part.stop >= 0 || part.sticks(parts.history_of(part), rate))
        touch(part.first_measure);
  }

  Eigen::VectorXd of(const MachineParts::PlacedElement &part) const
  {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(Eigen::Index(places_.size()));
    add(1., part.first_measure, row);
    return row;
  }

  /// Motions prescribed by ideal joints.
  Span of_joints(const LocalState &state) const
  {
    Span            span;
    double          G[MachineParts::max_measures * MachineParts::max_measures], g[MachineParts::max_measures];
    Eigen::VectorXd row(places_.size());
    for (std::size_t i = 0; i < parts_.joints.size(); ++i)
    {
      const MachineParts::PlacedElement &part  = parts_.placed[parts_.joints[i]];
      const ConstraintBlock             &block = parts_.joint_blocks[i];
      part.joint->constraint(part.motion(state, parts_.by_history), parts_.history_of(part), g, G);
      for (int r = 0; r < block.n_rows; ++r)
      {
        row.setZero();
        for (int k = 0; k < block.n_measures; ++k)
          add(G[r + block.n_rows * k], block.first_measure + k, row);
        span.add(row);
      }
    }
    return span;
  }

private:
  void touch(int measure)
  {
    for (Eigen::SparseMatrix<double>::InnerIterator it(parts_.W, measure); it; ++it)
      places_.emplace(int(it.row()), int(places_.size()));
  }
  void add(double factor, int measure, Eigen::VectorXd &row) const
  {
    for (Eigen::SparseMatrix<double>::InnerIterator it(parts_.W, measure); it; ++it)
      row[places_.at(int(it.row()))] += factor * it.value();
  }

  const MachineParts &parts_;
  std::map<int, int>  places_;
};

} // namespace

/**
 * Several sticking joints may constrain the same motion: the first one sticks.  Others that it stops are marked, so
 * that their guards are ignored: they keep sliding friction, or (at a start at rest) have none.  If joints alone
 * prescribe the motion, no friction can stick, in a joint or elsewhere: an element that comes to rest slides in the
 * other direction.  Source: docs/theory/contact.md (6).
 */
void MachineParts::find_stopped(const LocalState &state)
{
  double rate = 0.;
  if (std::none_of(placed.begin(), placed.end(),
                   [&](const PlacedElement &part)
                   { return part.stop >= 0 || (part.came != 0 && part.sticks(history_of(part), rate)); }))
    return;
  const MotionRows rows(*this);
  Span             span    = rows.of_joints(state);
  constexpr int    forward = 0, backward = 1; // Guards of a sticking element: it starts to slip.
  const auto       slide_on = [&](const PlacedElement &part, double came)
  { part.branches->transition(came > 0. ? backward : forward, part.motion(state, by_history), history_of(part)); };
  // Near a dead point joints alone stop a motion, and sticking would require an arbitrary force.
  const auto by_joints = [joints_alone = span](const Eigen::VectorXd &own) { return joints_alone.contains(own, 1e-3); };
  for (const PlacedElement &part : placed)
    if (part.stop < 0 && part.sticks(history_of(part), rate))
    {
      const Eigen::VectorXd own = rows.of(part);
      if (part.came != 0 && by_joints(own))
        slide_on(part, part.came);
      else
        span.add(own);
    }
  for (const bool before : {true, false}) // elements that stuck before continue to stick
    for (PlacedElement &part : placed)
    {
      if (part.stop < 0 || part.holds != before || !part.sticks(history_of(part), rate))
        continue;
      const Eigen::VectorXd own = rows.of(part);
      history[part.stop]        = 0.;
      if (by_joints(own))
        slide_on(part, history[part.stop + 1]);
      else if (!span.add(own))
        history[part.stop] = 1.;
    }
  for (const PlacedElement &part : placed)
    if (part.stop >= 0 && !part.sticks(history_of(part), rate))
    {
      const Eigen::VectorXd own = rows.of(part);
      history[part.stop]        = !by_joints(own) && span.contains(own) ? 1. : 0.;
    }
}

/**
 * Rates of measures whose directions are combinations of sticking ones, w = W_H c: w . q' = c . rates.  The motion has
 * these rates up to the residual of an iteration, whose sign must not trigger a guard.  Elements that would start to
 * stick too are omitted: how they would share the force is undefined, which the step reports.
 */
void MachineParts::find_held_too()
{
  held_too.clear();
  if (held.empty())
    return;
  std::set<int> sticking;
  for (const HeldMeasure &h : held)
    sticking.insert(h.measure);
  for (const PlacedGuard &own : guards)
    if (own.guard.kind == "stick")
      sticking.insert(placed[own.element].first_measure);
  std::map<Eigen::Index, Eigen::Index> places; // of the coordinates that they move
  for (const HeldMeasure &h : held)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, h.measure); it; ++it)
      places.emplace(it.row(), Eigen::Index(places.size()));
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(Eigen::Index(places.size()), Eigen::Index(held.size()));
  Eigen::VectorXd rates(columns.cols()), w(columns.rows());
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
  {
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, held[i].measure); it; ++it)
      columns(places.at(it.row()), i) = it.value();
    rates[i] = held[i].rate;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  for (int j = 0; j < W.cols(); ++j)
  {
    bool others = sticking.count(j) > 0;
    w.setZero();
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it && !others; ++it)
      if (const auto place = places.find(it.row()); place != places.end())
        w[place->second] = it.value();
      else
        others = it.value() != 0.;
    if (others)
      continue;
    const Eigen::VectorXd c = qr.solve(w);
    if ((columns * c - w).norm() <= Span::dependent * w.norm())
      held_too.push_back({j, rates.dot(c)});
  }
}

} // namespace gestell::coupling
