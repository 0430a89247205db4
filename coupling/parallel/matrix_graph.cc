#include "coupling/parallel/matrix_graph.h"

#include "coupling/parallel/petsc_objects.h"
#include "fem/parallel/ranks.h"

#include <metis.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace gestell::coupling
{

static_assert(std::is_same<idx_t, int>::value, "METIS must be built with 32-bit indices");

namespace
{

void require_success(int code)
{
  if (code == METIS_ERROR_MEMORY)
    throw std::bad_alloc();
  if (code != METIS_OK)
    throw std::runtime_error("MatrixGraph: METIS failed with error " + std::to_string(code));
}

/// Rows of this rank whose entries differ from those of the row before, and the rows of their entries.
struct Leaders
{
  std::vector<int> row, begin{0}, column;
};

Leaders leaders_of(Mat A, const std::vector<int> &held)
{
  const auto       is_held = [&](int row) { return std::binary_search(held.begin(), held.end(), row); };
  Leaders          leaders;
  std::vector<int> before;
  for_each_own_row(A, "MatrixGraph",
                   [&](PetscInt i, PetscInt count, const PetscInt *columns, const PetscScalar *)
                   {
                     if (!leaders.row.empty() && !is_held(i) && !is_held(i - 1) && int(before.size()) == count &&
                         std::equal(before.begin(), before.end(), columns))
                       return;
                     before.assign(columns, columns + count);
                     leaders.row.push_back(i);
                     if (!is_held(i))
                       std::remove_copy_if(columns, columns + count, std::back_inserter(leaders.column), is_held);
                     leaders.begin.push_back(int(leaders.column.size()));
                   });
  return leaders;
}

} // namespace

MatrixGraph::MatrixGraph(const Eigen::SparseMatrix<double> &A)
{
  const int        n     = int(A.cols());
  const int       *begin = A.outerIndexPtr(), *row = A.innerIndexPtr();
  std::vector<int> vertex(n);
  for (int i = 0; i < n; ++i)
  {
    if (i == 0 || begin[i + 1] - begin[i] != begin[i] - begin[i - 1] ||
        !std::equal(row + begin[i], row + begin[i + 1], row + begin[i - 1]))
      first_.push_back(i);
    vertex[i] = int(first_.size()) - 1;
  }
  first_.push_back(n);

  begin_.push_back(0);
  for (int v = 0; v < n_vertices(); ++v)
  {
    int last = -1;
    for (int k = begin[first_[v]]; k < begin[first_[v] + 1]; ++k)
      if (const int w = vertex[row[k]]; w != v && w != last)
        neighbour_.push_back(last = w);
    begin_.push_back(int(neighbour_.size()));
  }
}

MatrixGraph::MatrixGraph(const fem::Ranks &ranks, Mat A, const std::vector<int> &held)
{
  int n = 0;
  MatGetSize(A, &n, nullptr);
  Leaders own;
  ranks.agree([&] { own = leaders_of(A, held); });
  if (!ranks.first())
  {
    ranks.send(own.row, 0);
    ranks.send(own.begin, 0);
    ranks.send(own.column, 0);
    return;
  }
  std::vector<Leaders> all(ranks.size());
  all[0] = std::move(own);
  for (int other = 1; other < ranks.size(); ++other)
  {
    all[other].row    = ranks.receive<int>(other);
    all[other].begin  = ranks.receive<int>(other);
    all[other].column = ranks.receive<int>(other);
  }
  std::vector<int> vertex(n, -1);
  for (const Leaders &leaders : all)
    for (const int row : leaders.row)
    {
      vertex[row] = int(first_.size());
      first_.push_back(row);
    }
  first_.push_back(n);
  for (int i = 1; i < n; ++i)
    if (vertex[i] < 0)
      vertex[i] = vertex[i - 1];

  begin_.push_back(0);
  int v = 0;
  for (Leaders &leaders : all)
  {
    for (std::size_t k = 0; k < leaders.row.size(); ++k, ++v)
    {
      int last = -1;
      for (int e = leaders.begin[k]; e < leaders.begin[k + 1]; ++e)
        if (const int w = vertex[leaders.column[e]]; w != v && w != last)
          neighbour_.push_back(last = w);
      begin_.push_back(int(neighbour_.size()));
    }
    leaders = {};
  }
}

std::vector<int> MatrixGraph::parts(int parts) const
{
  int              count = n_vertices(), one = 1, cut = 0;
  std::vector<int> weight(count), of_vertex(count, 0), result(first_.back());
  for (int v = 0; v < count; ++v)
    weight[v] = first_[v + 1] - first_[v];
  if (parts > 1)
    require_success(METIS_PartGraphKway(&count, &one, const_cast<int *>(begin_.data()),
                                        const_cast<int *>(neighbour_.data()), weight.data(), nullptr, nullptr, &parts,
                                        nullptr, nullptr, nullptr, &cut, of_vertex.data()));
  for (int v = 0; v < count; ++v)
    std::fill(result.begin() + first_[v], result.begin() + first_[v + 1], of_vertex[v]);
  return result;
}

std::vector<int> MatrixGraph::elimination_places() const
{
  int              count = n_vertices();
  std::vector<int> weight(count), vertex_at(count), place_of(count), result(first_.back());
  for (int v = 0; v < count; ++v)
    weight[v] = first_[v + 1] - first_[v];
  require_success(METIS_NodeND(&count, const_cast<int *>(begin_.data()), const_cast<int *>(neighbour_.data()),
                               weight.data(), nullptr, vertex_at.data(), place_of.data()));
  int place = 0;
  for (const int v : vertex_at)
    for (int i = first_[v]; i < first_[v + 1]; ++i)
      result[i] = place++;
  return result;
}

} // namespace gestell::coupling
