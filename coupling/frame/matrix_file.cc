#include "coupling/frame/matrix_file.h"

#include "coupling/frame/matrix_market.h"
#include "coupling/frame/petsc_binary.h"

namespace gestell::coupling
{

Eigen::SparseMatrix<double> read_matrix_file(const std::string &file, std::int64_t known_size)
{
  return is_petsc_file(file) ? read_petsc_matrix(file, known_size) : read_matrix_market(file, known_size);
}

} // namespace gestell::coupling
