#include "coupling/exchange/labelled_matrix.h"

#include "coupling/exchange/text_file.h"

#include <algorithm>
#include <tuple>

namespace gestell::coupling
{

namespace
{

std::string name_of_row(const std::vector<RowLabel> &rows, int i)
{
  return rows.empty() ? std::to_string(i + 1) : "(" + text_of(rows[std::size_t(i)]) + ")";
}

/// Refuses a second entry at the same row and column; in files of one triangle also at exchanged row and column.
void refuse_repeated(const TextFile &file, std::vector<FileEntry> &entries, Triangles triangles,
                     const std::vector<RowLabel> &rows)
{
  if (triangles == Triangles::one)
    for (FileEntry &entry : entries)
      if (entry.row < entry.column)
        std::swap(entry.row, entry.column);
  const auto in_order = [](const FileEntry &a, const FileEntry &b)
  { return std::tie(a.column, a.row, a.line) < std::tie(b.column, b.row, b.line); };
  if (!std::is_sorted(entries.begin(), entries.end(), in_order))
    std::sort(entries.begin(), entries.end(), in_order);
  const auto twice =
      std::adjacent_find(entries.begin(), entries.end(),
                         [](const FileEntry &a, const FileEntry &b) { return a.column == b.column && a.row == b.row; });
  if (twice == entries.end())
    return;
  const FileEntry &again = *std::next(twice);
  file.fail_at(again.line, "the entry of row " + name_of_row(rows, again.row) + " and column " +
                               name_of_row(rows, again.column) + " is a duplicate; the first is in line " +
                               std::to_string(twice->line) +
                               (triangles == Triangles::one ? ". A symmetric matrix gives each pair once" : "") +
                               "; duplicates are not added, write each entry once");
}

} // namespace

bool RowLabel::operator<(const RowLabel &other) const
{
  return std::tuple(component == 0, node, component) < std::tuple(other.component == 0, other.node, other.component);
}

std::string text_of(const RowLabel &row)
{
  static const char *const motions[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
  return row.component == 0 ? "point " + std::to_string(row.node)
                            : "node " + std::to_string(row.node) + ", " + motions[row.component - 1];
}

Eigen::SparseMatrix<double> assembled(const TextFile &file, std::vector<FileEntry> entries, int n, Triangles triangles,
                                      const std::vector<RowLabel> &rows)
{
  refuse_repeated(file, entries, triangles, rows);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size() * (triangles == Triangles::one ? 2 : 1));
  for (const FileEntry &entry : entries)
    if (entry.value != 0.)
    {
      triplets.emplace_back(entry.row, entry.column, entry.value);
      if (triangles == Triangles::one && entry.row != entry.column)
        triplets.emplace_back(entry.column, entry.row, entry.value);
    }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

std::vector<int> places_of(const std::vector<RowLabel> &from, const std::vector<RowLabel> &in)
{
  std::map<RowLabel, int> place;
  for (std::size_t i = 0; i < in.size(); ++i)
    place.emplace(in[i], int(i));
  std::vector<int> places;
  for (const RowLabel &row : from)
  {
    const auto found = place.find(row);
    places.push_back(found == place.end() ? -1 : found->second);
  }
  return places;
}

Eigen::SparseMatrix<double> spread(const LabelledMatrix &matrix, const std::vector<RowLabel> &rows)
{
  if (matrix.rows == rows)
    return matrix.A;
  const std::vector<int>              place = places_of(matrix.rows, rows);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(std::size_t(matrix.A.nonZeros()));
  for (int j = 0; j < matrix.A.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator a(matrix.A, j); a; ++a)
      entries.emplace_back(place[std::size_t(a.row())], place[std::size_t(j)], a.value());
  Eigen::SparseMatrix<double> A(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

} // namespace gestell::coupling
