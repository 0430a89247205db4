#include "coupling/algebra/node_ordering.h"

#include <algorithm>
#include <cstdint>
#include <new>

namespace gestell::coupling
{

namespace
{

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The rows of a column that are free; for a fixed column, the diagonal only.
class Partners
{
public:
  Partners(const SparseMatrix &A, const std::vector<char> &held) : A_(A), held_(held) {}

  template <typename Visit>
  void for_each(int column, const Visit &visit) const
  {
    if (is_held(column))
      return visit(column);
    const int *row = A_.innerIndexPtr() + A_.outerIndexPtr()[column];
    const int *end = A_.innerIndexPtr() + A_.outerIndexPtr()[column + 1];
    for (; row != end; ++row)
      if (!is_held(*row))
        visit(*row);
  }

  std::uint64_t hash(int column) const
  {
    std::uint64_t sum = 0;
    for_each(column, [&](int row) { sum += (std::uint64_t(row) + 1) * 0x9E3779B97F4A7C15u ^ std::uint64_t(row) << 7; });
    return sum;
  }

  bool same(int column, int other) const
  {
    if (is_held(column) || is_held(other))
      return false;
    const int *begin = A_.outerIndexPtr(), *rows = A_.innerIndexPtr();
    return begin[column + 1] - begin[column] == begin[other + 1] - begin[other] &&
           std::equal(rows + begin[column], rows + begin[column + 1], rows + begin[other]);
  }

private:
  bool is_held(int i) const { return !held_.empty() && held_[i]; }

  const SparseMatrix      &A_;
  const std::vector<char> &held_;
};

/// Group of every coordinate; groups are counted by their first one.
struct Groups
{
  std::vector<int> of, first;
  int              count() const { return int(first.size()); }
};

Groups groups_of(const Partners &partners, int n)
{
  std::vector<std::uint64_t> hash(n);
  for (int j = 0; j < n; ++j)
    hash[j] = partners.hash(j);
  Groups groups{std::vector<int>(n, -1), {}};
  for (int j = 0; j < n; ++j)
  {
    if (groups.of[j] >= 0)
      continue;
    groups.of[j] = groups.count();
    partners.for_each(j,
                      [&](int i)
                      {
                        if (i > j && groups.of[i] < 0 && hash[i] == hash[j] && partners.same(i, j))
                          groups.of[i] = groups.count();
                      });
    groups.first.push_back(j);
  }
  return groups;
}

/// The graph of the groups: lower triangle, by columns.
struct GroupGraph
{
  std::vector<int> begin{0}, rows;
};

GroupGraph graph_of(const Groups &groups, const Partners &partners)
{
  GroupGraph       graph;
  std::vector<int> visited(groups.count(), -1);
  for (int a = 0; a < groups.count(); ++a)
  {
    partners.for_each(groups.first[a],
                      [&](int i)
                      {
                        const int b = groups.of[i];
                        if (b >= a && visited[b] != a)
                          graph.rows.push_back(b);
                        visited[b] = a;
                      });
    std::sort(graph.rows.begin() + graph.begin.back(), graph.rows.end());
    graph.begin.push_back(int(graph.rows.size()));
  }
  return graph;
}

/// The pattern of a lower triangle for CHOLMOD.
cholmod_sparse view_of(std::size_t n, std::size_t entries, void *begin, void *rows, int index_type)
{
  cholmod_sparse view{};
  view.nrow   = n;
  view.ncol   = n;
  view.nzmax  = entries;
  view.p      = begin;
  view.i      = rows;
  view.stype  = -1;
  view.itype  = index_type;
  view.xtype  = CHOLMOD_PATTERN;
  view.dtype  = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

} // namespace

LowerPattern::LowerPattern(const SparseMatrix &A, const std::vector<char> &held)
{
  const int      n = int(A.cols());
  const Partners partners(A, held);
  rows_.reserve((A.nonZeros() + n) / 2);
  for (int j = 0; j < n; ++j)
  {
    rows_.push_back(j);
    partners.for_each(j,
                      [&](int i)
                      {
                        if (i > j)
                          rows_.push_back(i);
                      });
    begin_.push_back(SuiteSparse_long(rows_.size()));
  }
  view_ = view_of(n, rows_.size(), begin_.data(), rows_.data(), CHOLMOD_LONG);
}

cholmod_factor *LowerPattern::analysed(const std::vector<int> &order, cholmod_common &common)
{
  cholmod_l_start(&common);
  common.print              = 0;
  common.supernodal         = CHOLMOD_SUPERNODAL;
  common.nmethods           = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder          = 1;
  std::vector<SuiteSparse_long> given(order.begin(), order.end());
  return cholmod_l_analyze_p(&view_, given.data(), nullptr, 0, &common);
}

std::vector<int> node_ordering(const SparseMatrix &A, const std::vector<char> &held)
{
  const int        n = int(A.cols());
  const Partners   partners(A, held);
  const Groups     groups = groups_of(partners, n);
  GroupGraph       graph  = graph_of(groups, partners);
  std::vector<int> order_of_groups(groups.count());
  cholmod_sparse view = view_of(groups.count(), graph.rows.size(), graph.begin.data(), graph.rows.data(), CHOLMOD_INT);
  cholmod_common common;
  cholmod_start(&common);
  common.print       = 0;
  const bool ordered = groups.count() == 0 || cholmod_metis(&view, nullptr, 0, 0, order_of_groups.data(), &common);
  cholmod_finish(&common);
  if (!ordered)
    throw std::bad_alloc();

  std::vector<int> place(groups.count() + 1, 0), order(n); // members of the groups, in the order of these
  for (int j = 0; j < n; ++j)
    ++place[groups.of[j]];
  int next = 0;
  for (const int a : order_of_groups)
  {
    const int size = place[a];
    place[a]       = next;
    next += size;
  }
  for (int j = 0; j < n; ++j)
    order[place[groups.of[j]]++] = j;
  return order;
}

} // namespace gestell::coupling
