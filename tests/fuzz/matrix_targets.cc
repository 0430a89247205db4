#include "tests/fuzz/target.h"

#include "coupling/exchange/dmig.h"
#include "coupling/exchange/element_matrix.h"
#include "coupling/exchange/harwell_boeing.h"
#include "coupling/exchange/indexed_matrix.h"
#include "coupling/exchange/matrices_of_file.h"
#include "coupling/exchange/node_places.h"
#include "coupling/exchange/row_table.h"
#include "coupling/frame/matrix_market.h"
#include "coupling/frame/petsc_binary.h"

#include <cmath>

namespace gestell::fuzz
{
namespace
{

using namespace gestell::coupling;

void require_finite(const Eigen::SparseMatrix<double> &A)
{
  for (int j = 0; j < A.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator a(A, j); a; ++a)
    {
      promise(a.row() >= 0 && a.row() < A.rows(), "an entry lies outside of its matrix");
      promise(std::isfinite(a.value()), "an entry of a matrix is not finite");
    }
}

void require_fitting(const LabelledMatrix &matrix)
{
  promise(matrix.A.rows() == matrix.A.cols(), "a matrix of a frame is not square");
  promise(matrix.rows.empty() || Eigen::Index(matrix.rows.size()) == matrix.A.rows(), "rows without a name");
  require_finite(matrix.A);
}

void require_fitting(const std::map<std::string, LabelledMatrix> &matrices)
{
  for (const auto &[name, matrix] : matrices)
    require_fitting(matrix);
}

void matrix_market(const std::string &bytes)
{
  require_finite(read_matrix_market(file_of("fed.mtx", bytes)));
}

void petsc(const std::string &bytes)
{
  const std::string file = file_of("fed.petsc", bytes);
  is_petsc_file(file);
  require_finite(read_petsc_matrix(file));
}

void dmig(const std::string &bytes)
{
  require_fitting(read_dmig(file_of("fed.pch", bytes)));
}

void calculix(const std::string &bytes)
{
  require_fitting(read_indexed_matrix(file_of("fed.sti", bytes)));
}

void substructure(const std::string &bytes)
{
  require_fitting(read_element_matrices(file_of("fed.mtx", bytes)));
}

void harwell_boeing(const std::string &bytes)
{
  require_fitting(read_harwell_boeing(file_of("fed.hb", bytes)));
}

/// Whatever the file is taken for.
void any_matrix(const std::string &bytes)
{
  const std::string file     = file_of("fed.matrix", bytes);
  const auto        matrices = matrices_of_file(file);
  for (const auto &[name, matrix] : matrices)
    require_finite(matrix.A);
  matrix_for(matrices, MatrixRole::stiffness, "", file);
}

void rows(const std::string &bytes)
{
  for (const RowLabel &row : read_row_table(file_of("fed.dof", bytes)))
    text_of(row);
}

void nodes(const std::string &bytes)
{
  std::set<long> wanted;
  for (long node = 1; node < 100; ++node)
    wanted.insert(node);
  const ModelNodes found = read_model_nodes(file_of("fed.bdf", bytes), wanted);
  for (const auto &[node, x] : found.places)
    promise(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]), "a node without a finite place");
  for (const auto &[node, axes] : found.axes)
    promise(axes.allFinite(), "axes of a node are not finite");
}

} // namespace

std::vector<Target> matrix_targets()
{
  return {{"matrix_market", matrix_market},
          {"petsc", petsc},
          {"dmig", dmig},
          {"calculix", calculix},
          {"substructure", substructure},
          {"harwell_boeing", harwell_boeing},
          {"any_matrix", any_matrix},
          {"rows", rows},
          {"nodes", nodes}};
}

} // namespace gestell::fuzz
