#pragma once

#include "coupling/algebra/multifrontal.h"
#include "coupling/eigensolvers/block_lanczos.h"

#include <memory>
#include <string>

namespace gestell::coupling
{

/// What rounding in the factor of C - omega^2 M moves the square of each frequency by, per growth of rounding: E of
/// size growth * eps * diag(C) moves omega_j^2 by v_j^T E v_j.  @param stiffness  diagonal of C [n]
Eigen::VectorXd moved_by_rounding(const Eigen::MatrixXd &V, const Eigen::VectorXd &stiffness);

/// Growth up to which no mode passes the shift: none of those below it, and not the `next` one above, which is assumed
/// to be as sensitive as they are.
double largest_growth(const Eigen::VectorXd &omega, const Eigen::VectorXd &moved, double next, double shift);

/**
 * The requested number of lowest modes of a frame, with a proof of completeness. A Krylov search may miss a mode
 * without notice, above all a multiple one. The number of negative eigenvalues of C - omega^2 M is the number of modes
 * below omega (Sylvester's law of inertia). confirm() computes it in a gap above the requested modes; if modes are
 * missing, the search continues, orthogonal to the known modes, until all are found. Small frames are solved densely
 * for all modes.
 */
class SturmCheckedModes
{
public:
  static constexpr int dense_limit = 600; ///< coordinates up to which all modes are found densely

  virtual ~SturmCheckedModes() = default;

  /// Computes the lowest `count`, 0 <= count <= coordinates.
  /// @throws ConvergenceFailure with the number found.
  void find(int count);

  /// The lowest `count` of those found.
  LowestModes lowest(int count);

  /// The lowest `count`, complete below a gap: find(), finish() and confirm() until none is missing.
  /// @throws ConvergenceFailure as these do, and if some are missing in every round.
  LowestModes find_all(int count);

  /// Ends the search: frees the memory of the search and of the factor.
  void finish();

  /// After finish(): the modes requested last, and some more, up to a gap.  If dense, all modes.
  const LowestModes &found() const { return found_; }

  /// After finish(): frees the shapes of found(); if modes are missing, all are searched for again.
  void forget_shapes()
  {
    if (!dense_)
      found_.V.resize(0, 0);
  }

  /**
   * After finish(): whether no mode below the gap is missing.
   *
   * If not, the missing ones have been computed, and the frame's factor is available again; repeat all uses of the
   * modes, starting at find().
   *
   * @throws ConvergenceFailure if the inertia cannot be determined, or missing modes are not found.
   */
  bool confirm();

  /// The verification as a sentence; empty before confirm(), and if not needed.
  const std::string &statement() const { return statement_; }

  bool dense() const { return dense_; }

protected:
  /// @param kind   of modes, in messages
  /// @param dense  whether few coordinates are solved at once, by all()
  /// @param stiffness  diagonal of C [n]
  SturmCheckedModes(std::string kind, bool dense, const BlockLanczos::Options &options, Eigen::VectorXd stiffness);

private:
  virtual int                         n() const           = 0; ///< rows of the modes
  virtual LowestModes                 all() const         = 0; ///< modes, densely
  virtual void                        restore()           = 0; ///< data for search()
  virtual void                        release()           = 0; ///< its memory
  virtual Inertia                     below(double omega) = 0;
  virtual std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const = 0;

  Inertia count_in_gap(double &omega);
  void    look_for(const LowestModes &known, int count, int block);
  void    look_for_missing(int missing, int count, double omega);

  std::string                 kind_;
  BlockLanczos::Options       options_;
  int                         wanted_ = 0;
  bool                        dense_;
  Eigen::VectorXd             stiffness_; // diagonal of C
  LowestModes                 found_;
  Eigen::VectorXd             moved_; // of every found omega^2, by E = eps diag(C)
  ModeSearch::Gap             gap_{0., 0., 0};
  std::unique_ptr<ModeSearch> search_;
  std::string                 statement_;
};

} // namespace gestell::coupling
