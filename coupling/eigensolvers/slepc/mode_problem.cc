#include "coupling/eigensolvers/slepc/mode_problem.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gestell::coupling
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

ModeProblem::ModeProblem(std::shared_ptr<const InverseStiffness> inverse, const Eigen::SparseMatrix<double> &M,
                         const Eigen::SparseMatrix<double> *C)
    : inverse_(std::move(inverse)), M_(M), C_(C)
{
  const std::vector<int> &held = inverse_->held();
  for (int i = 0; i < inverse_->owned(); ++i)
    if (!std::binary_search(held.begin(), held.end(), i))
      free_.push_back(i);
}

void ModeProblem::solve(const Eigen::Ref<const MatrixXd> &F, Eigen::Ref<MatrixXd> X) const
{
  MatrixXd all           = MatrixXd::Zero(coordinates(), F.cols());
  all(free_, Eigen::all) = F;
  inverse_->solve_columns(all);
  X = all(free_, Eigen::all);
}

void ModeProblem::multiply(const Eigen::SparseMatrix<double> &A, const double *x, double *y) const
{
  MatrixXd motion  = MatrixXd::Zero(coordinates(), 1);
  motion(free_, 0) = Eigen::Map<const VectorXd>(x, rows());
  inverse_->complete(motion);
  MatrixXd load = A.transpose() * motion; // A is symmetric, and its columns are read faster than they are written
  inverse_->add_up(load);
  Eigen::Map<VectorXd>(y, rows()) = load(free_, 0);
}

void ModeProblem::stiffness_times(const double *x, double *y) const
{
  if (!C_)
    throw std::invalid_argument("this eigensolver needs products with the stiffness matrix, which exist only if it is "
                                "set by reduction.eigensolver or -reduction_eps_type");
  multiply(*C_, x, y);
}

} // namespace gestell::coupling
