#include "coupling/reduction/parts/part_interface.h"

#include "fem/values/available_memory.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

bool has_one_bit(std::uint64_t bits)
{
  return (bits & (bits - 1)) == 0;
}

} // namespace

PartInterface::PartInterface(const fem::CellParts &parts, const std::vector<int> &mechanism)
    : parts_(parts.n_coordinates(), 0), place_(parts.n_coordinates(), -1)
{
  if (parts.size() > most_parts)
    throw std::invalid_argument("parts: " + std::to_string(parts.size()) + " are more than " +
                                std::to_string(most_parts) + ", the most that are joined at once");
  std::vector<int> sizes;
  for (int p = 0; p < parts.size(); ++p)
  {
    const std::vector<int> own = parts.coordinates(p);
    for (const int i : own)
      parts_[i] |= std::uint64_t(1) << p;
    sizes.push_back(int(own.size()));
  }
  for (const int i : mechanism)
    place_[i] = 0;
  n_held_.assign(parts.size(), 0);
  for (std::size_t i = 0; i < parts_.size(); ++i)
  {
    if (place_[i] < 0 && has_one_bit(parts_[i]))
      continue;
    place_[i] = size();
    coordinates_.push_back(int(i));
    for (int p = 0; p < parts.size(); ++p)
      n_held_[p] += int(parts_[i] >> p & 1);
  }
  for (int p = 0; p < parts.size(); ++p)
    n_interior_.push_back(sizes[p] - n_held_[p]);
}

std::vector<int> PartInterface::held(const std::vector<int> &coordinates) const
{
  std::vector<int> result;
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    if (place_[coordinates[k]] >= 0)
      result.push_back(int(k));
  return result;
}

std::vector<int> PartInterface::places(const std::vector<int> &coordinates, int first_mode, int n_modes) const
{
  std::vector<int> result;
  for (const int i : coordinates)
    if (place_[i] >= 0)
      result.push_back(place_[i]);
  for (int j = 0; j < n_modes; ++j)
    result.push_back(first_mode + j);
  return result;
}

Sparse PartInterface::share(const Sparse &A, int part, const std::vector<int> &coordinates) const
{
  const std::uint64_t own = std::uint64_t(1) << part;
  std::vector<int>    number(parts_.size(), -1);
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    number[coordinates[k]] = int(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (const int j : coordinates)
    for (Sparse::InnerIterator a(A, j); a; ++a)
      if (const std::uint64_t both = parts_[j] & parts_[a.row()]; both == 0)
        throw std::logic_error("parts: coordinates " + std::to_string(j) + " and " + std::to_string(a.row()) +
                               " have a common entry but no common part");
      else if ((both & (~both + 1)) == own)
        entries.emplace_back(number[a.row()], number[j], a.value());
  Sparse result(Index(coordinates.size()), Index(coordinates.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

double common_pairs(const PartInterface &interface)
{
  std::map<std::uint64_t, double> counts;
  for (int i = 0; i < interface.size(); ++i)
    ++counts[interface.parts_at(i)];
  double pairs = 0.;
  for (const auto &[parts, count] : counts)
    for (const auto &[others, count_of_others] : counts)
      if (parts & others)
        pairs += count * count_of_others;
  return pairs;
}

JoinedSums::JoinedSums(const PartInterface &interface, const std::vector<int> &first_modes, int n)
{
  std::map<std::uint64_t, std::vector<int>> rows; // of a column in these parts
  const auto                                rows_of = [&](std::uint64_t parts) -> const std::vector<int> &
  {
    std::vector<int> &list = rows[parts];
    if (!list.empty())
      return list;
    for (int i = 0; i < interface.size(); ++i)
      if (interface.parts_at(i) & parts)
        list.push_back(i);
    for (std::size_t p = 0; p < first_modes.size(); ++p)
      if (parts >> p & 1)
        for (int j = first_modes[p], end = p + 1 < first_modes.size() ? first_modes[p + 1] : n; j < end; ++j)
          list.push_back(j);
    return list;
  };
  std::vector<std::uint64_t> parts_of_column(n);
  for (int i = 0; i < interface.size(); ++i)
    parts_of_column[i] = interface.parts_at(i);
  for (std::size_t p = 0; p < first_modes.size(); ++p)
    std::fill(parts_of_column.begin() + first_modes[p],
              p + 1 < first_modes.size() ? parts_of_column.begin() + first_modes[p + 1] : parts_of_column.end(),
              std::uint64_t(1) << p);
  C_.resize(n, n);
  double count = 0.;
  for (int j = 0; j < n; ++j)
  {
    count += double(rows_of(parts_of_column[j]).size());
    C_.outerIndexPtr()[j + 1] = int(std::min(count, 2147483647.));
  }
  const std::string what          = "parts: " + std::to_string(interface.size()) + " interface DOFs between the parts",
                    advice        = "Use fewer parts; bulky bodies need less memory in one piece (parts = 1).";
  constexpr double bytes_of_entry = 60.; // C, M, M in the order of the factor, the factor and its work space
  fem::require_available(what, bytes_of_entry * count, advice);
  if (count > 2147483646.)
    throw std::invalid_argument(what + " have more than 2^31 entries in their matrices. " + advice);
  C_.resizeNonZeros(Index(count));
  for (int j = 0; j < n; ++j)
  {
    const std::vector<int> &list = rows_of(parts_of_column[j]);
    std::copy(list.begin(), list.end(), C_.innerIndexPtr() + C_.outerIndexPtr()[j]);
  }
  std::fill_n(C_.valuePtr(), C_.nonZeros(), 0.);
  M_ = C_;
}

namespace
{

/// Adds value(i, j) to the entries of A at the coordinates `places` of a part.
template <typename Value>
void add_block(Sparse &A, const std::vector<int> &places, const Value &value)
{
  std::vector<int> at(A.rows());
  for (std::size_t j = 0; j < places.size(); ++j)
  {
    for (int k = A.outerIndexPtr()[places[j]]; k < A.outerIndexPtr()[places[j] + 1]; ++k)
      at[A.innerIndexPtr()[k]] = k;
    for (std::size_t i = 0; i < places.size(); ++i)
      A.valuePtr()[at[places[i]]] += value(Index(i), Index(j));
  }
}

} // namespace

void JoinedSums::add(const CondensedPart &part, const std::vector<int> &places)
{
  const Index n1 = part.C.rows();
  add_block(C_, places,
            [&](Index i, Index j)
            {
              if (i < n1 && j < n1)
                return part.C(std::max(i, j), std::min(i, j));
              return i == j ? part.omega[i - n1] * part.omega[i - n1] : 0.;
            });
  add_block(M_, places,
            [&](Index i, Index j)
            {
              if (i < n1 && j < n1)
                return part.M(std::max(i, j), std::min(i, j));
              if (i >= n1 && j >= n1)
                return i == j ? 1. : 0.;
              return i < n1 ? part.M_1V(i, j - n1) : part.M_1V(j, i - n1);
            });
  if (part.damping.size() == 0)
    return;
  if (B_.nonZeros() == 0)
  {
    B_ = C_;
    std::fill_n(B_.valuePtr(), B_.nonZeros(), 0.);
  }
  add_block(B_, places, [&](Index i, Index j) { return 0.5 * (part.damping(i, j) + part.damping(j, i)); });
}

void JoinedSums::give(fem::FrameMatrices &joined, double alpha, double beta)
{
  if (B_.nonZeros() == 0 && (alpha > 0. || beta > 0.))
  {
    B_ = C_;
    std::fill_n(B_.valuePtr(), B_.nonZeros(), 0.);
  }
  for (Index k = 0; k < B_.nonZeros(); ++k)
    B_.valuePtr()[k] += alpha * M_.valuePtr()[k] + beta * C_.valuePtr()[k];
  if (B_.nonZeros() == 0)
    B_.resize(C_.rows(), C_.cols());
  joined.C = std::move(C_);
  joined.M = std::move(M_);
  joined.B = std::move(B_);
}

} // namespace gestell::coupling
