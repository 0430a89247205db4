#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * The coordinates N on which local forces act, and W_N [n_N x n_u], a few numbers per measure.  With few measures on
 * many coordinates the measures take the place of N, and W_N is the unit matrix.
 */
class LoadedCoordinates
{
public:
  struct Entry
  {
    int    place; ///< in N
    double weight;
  };
  struct Entries
  {
    const Entry *first, *last;
    const Entry *begin() const { return first; }
    const Entry *end() const { return last; }
  };

  explicit LoadedCoordinates(const Eigen::SparseMatrix<double> &W);

  int     size() const { return are_measures_ ? n_measures() : int(coordinates_.size()); }
  int     n_measures() const { return int(begin_.size()) - 1; }
  bool    are_measures() const { return are_measures_; }
  Entries of(int measure) const
  {
    return {entries_.data() + begin_[std::size_t(measure)], entries_.data() + begin_[std::size_t(measure) + 1]};
  }

  /// A unit force on place i, on all coordinates [n].
  Eigen::VectorXd unit_force(int i) const;
  /// The rows N of Y [n x n_N].
  Eigen::MatrixXd rows_of(const Eigen::MatrixXd &Y) const;

private:
  Eigen::SparseMatrix<double> W_;
  std::vector<int>            coordinates_;
  std::vector<Entry>          entries_;
  std::vector<int>            begin_; ///< [n_u + 1] of each measure in entries_
  bool                        are_measures_;
};

/**
 * The compliance of the measures over a step, S = W^T A^-1 W f [n_u x n_u], symmetric, for A and f of a StepForm.
 *
 * It is used as  S = W_N^T C W_N,  C = f (A^-1)_NN [n_N x n_N]: joints of bodies in space have several times as many
 * measures as these bodies have coordinates, and bodies between which A has no entries are separate blocks of C.  Each
 * column of C is used from its first to its last entry that is not zero.
 */
class Compliance
{
public:
  Compliance() = default;
  /// @param Y  f A^-1 of the columns N [n x n_N]
  Compliance(std::shared_ptr<const LoadedCoordinates> loaded, const Eigen::MatrixXd &Y);

  const LoadedCoordinates &loaded() const { return *loaded_; }

  /// W_N p, to which Y gives the motion of all coordinates.
  const Eigen::VectorXd &loads(const Eigen::VectorXd &p) const;
  /// u += W_N^T x: what the motion x [n_N] of these coordinates moves
  void add_moved(const Eigen::VectorXd &x, Eigen::VectorXd &u) const;
  /// u += S p
  void add_times(const Eigen::VectorXd &p, Eigen::VectorXd &u) const;
  /// Displacement S_jj of a measure by a unit force on it.
  double own(int measure) const;
  /// x [n_N] = C f for forces f on n of its places; zero outside `moved`.
  struct Range
  {
    int first, last; ///< last: behind the end
  };
  Range move(const int *places, int n, const double *f, double *x) const;
  /// Bounds of the terms in S p, |W_N^T| |C| |W_N| |p| [n_u].
  const Eigen::VectorXd &magnitudes(const Eigen::VectorXd &p) const;

  /// S; computed at the first call.
  const Eigen::MatrixXd &matrix() const;

private:
  std::shared_ptr<const LoadedCoordinates> loaded_;
  Eigen::MatrixXd                          C_;
  std::vector<Range>                       rows_;         ///< of every column
  mutable Eigen::VectorXd                  load_, moved_; ///< [n_N]
  mutable Eigen::VectorXd                  terms_;        ///< [n_u]
  mutable Eigen::MatrixXd                  S_;
};

} // namespace gestell::coupling
