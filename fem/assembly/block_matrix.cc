#include "fem/assembly/block_matrix.h"

#include "fem/parallel/petsc_session.h"

#include <cassert>
#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::fem
{

namespace
{

void check(PetscErrorCode code)
{
  if (code != 0)
    throw std::runtime_error("BlockMatrix: PETSc reports error " + std::to_string(code) + "; memory may have run out.");
}

/// Elements of all lists, one after the other.
struct Elements
{
  std::vector<const int *> nodes;
  std::vector<int>         n_nodes;

  explicit Elements(const std::vector<NodeLists> &lists)
  {
    for (const NodeLists &list : lists)
      for (std::size_t i = 0; i < list.n_cells; ++i)
      {
        nodes.push_back(list.nodes + i * list.n_nodes);
        n_nodes.push_back(list.n_nodes);
      }
  }
};

/// Number of different partners of each node, itself included.
std::vector<int> partners(int n_nodes, const Elements &elements)
{
  std::vector<int> first(n_nodes + 1, 0); // elements at a node, as compressed lists
  const auto       for_each = [&](const auto &visit)
  {
    for (std::size_t element = 0; element < elements.nodes.size(); ++element)
      for (int k = 0; k < elements.n_nodes[element]; ++k)
        visit(element, elements.nodes[element][k]);
  };
  for_each([&](std::size_t, int node) { ++first[node + 1]; });
  for (int i = 0; i < n_nodes; ++i)
    first[i + 1] += first[i];
  std::vector<int> at(first.back()), next(first.begin(), first.end() - 1);
  for_each([&](std::size_t element, int node) { at[next[node]++] = static_cast<int>(element); });

  std::vector<int> count(n_nodes, 0), visited(n_nodes, -1);
  for (int node = 0; node < n_nodes; ++node)
    for (int i = first[node]; i < first[node + 1]; ++i)
      for (int k = 0; k < elements.n_nodes[at[i]]; ++k)
        if (const int other = elements.nodes[at[i]][k]; visited[other] != node)
        {
          visited[other] = node;
          ++count[node];
        }
  return count;
}

} // namespace

BlockMatrix::BlockMatrix(int block_size, int n_nodes, const std::vector<NodeLists> &elements)
    : block_size_(block_size), n_nodes_(n_nodes)
{
  petsc_session();
  const std::vector<int> count = partners(n_nodes, Elements(elements));
  const int              size  = block_size * n_nodes;
  check(MatCreateSeqBAIJ(PETSC_COMM_SELF, block_size, size, size, 0, count.data(), &matrix_));
  check(MatSetOption(matrix_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
}

BlockMatrix::~BlockMatrix()
{
  if (matrix_ != nullptr)
    MatDestroy(&matrix_);
}

BlockMatrix::BlockMatrix(BlockMatrix &&other) noexcept
    : block_size_(other.block_size_), n_nodes_(other.n_nodes_), matrix_(std::exchange(other.matrix_, nullptr))
{
}

void BlockMatrix::add(const int *nodes, int n, const double *values)
{
  check(MatSetValuesBlocked(matrix_, n, nodes, n, nodes, values, ADD_VALUES));
}

void BlockMatrix::add_block(int row, int column, const double *values)
{
  check(MatSetValuesBlocked(matrix_, 1, &row, 1, &column, values, ADD_VALUES));
}

void BlockMatrix::finish()
{
  check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
}

BlockMatrix::Rows BlockMatrix::rows() const
{
  Rows         rows{};
  PetscInt     n      = 0;
  PetscBool    done   = PETSC_FALSE;
  PetscScalar *values = nullptr;
  check(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_TRUE, &n, &rows.begin, &rows.columns, &done));
  check(MatSeqBAIJGetArray(matrix_, &values));
  assert(done == PETSC_TRUE && n == n_nodes_);
  rows.values = values;
  check(MatSeqBAIJRestoreArray(matrix_, &values));
  return rows;
}

} // namespace gestell::fem
