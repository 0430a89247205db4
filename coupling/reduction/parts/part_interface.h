#pragma once

#include "coupling/reduction/parts/condensed_part.h"
#include "fem/assembly/cell_parts.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace gestell::coupling
{

/// The coordinates of a frame that belong to several parts or to the mechanism: first coordinates of the joined parts.
class PartInterface
{
public:
  static constexpr int most_parts = 64;

  /// @param mechanism  coordinates of the interfaces of the frame.
  PartInterface(const fem::CellParts &parts, const std::vector<int> &mechanism);

  int                     size() const { return int(coordinates_.size()); }
  const std::vector<int> &coordinates() const { return coordinates_; } ///< of the frame, ascending
  int                     place(int coordinate) const { return place_[coordinate]; }
  std::uint64_t           parts_at(int place) const { return parts_[coordinates_[place]]; } ///< bit p: part p has it
  int                     n_held(int part) const { return n_held_[part]; }
  int                     n_interior(int part) const { return n_interior_[part]; }

  /// Those of a part's coordinates that are the interface, as its own numbers, ascending.
  std::vector<int> held(const std::vector<int> &coordinates) const;
  /// Coordinates of the joined parts: of a part's interface, then of its modes.
  std::vector<int> places(const std::vector<int> &coordinates, int first_mode, int n_modes) const;
  /// The entries of A for which `part` is the first part with both coordinates, in its coordinates.
  Eigen::SparseMatrix<double> share(const Eigen::SparseMatrix<double> &A, int part,
                                    const std::vector<int> &coordinates) const;

private:
  std::vector<std::uint64_t> parts_; // of every coordinate of the frame
  std::vector<int>           place_, coordinates_, n_held_, n_interior_;
};

/// Pairs of interface coordinates that have a part in common: entries of the matrices of the joined parts.
double common_pairs(const PartInterface &interface);

/// C, M and B of the joined parts, dense between the interface coordinates of a part, its modes, and both.
class JoinedSums
{
public:
  /// @param first_modes  coordinate of the first mode of each part.
  /// @param n            coordinates.
  JoinedSums(const PartInterface &interface, const std::vector<int> &first_modes, int n);

  /// @param places  coordinates of the part: PartInterface::places().
  void add(const CondensedPart &part, const std::vector<int> &places);
  /// Moves the sums to the matrices of a frame, with B = alpha M + beta C + dampers.
  void give(fem::FrameMatrices &joined, double alpha, double beta);

private:
  Eigen::SparseMatrix<double> C_, M_, B_; // of one pattern; B empty without dampers
};

} // namespace gestell::coupling
