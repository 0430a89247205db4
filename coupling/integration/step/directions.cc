#include "coupling/integration/step/directions.h"

namespace gestell::coupling
{

void take_measures(const Eigen::SparseMatrix<double> &W, const Eigen::VectorXd &x, Eigen::VectorXd &xi)
{
  const int    *begin = W.outerIndexPtr(), *coordinates = W.innerIndexPtr();
  const double *weights = W.valuePtr();
  for (int j = 0; j < W.cols(); ++j)
  {
    double sum = 0.;
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      sum += weights[k] * x[coordinates[k]];
    xi[j] = sum;
  }
}

void add_forces(const Eigen::SparseMatrix<double> &W, double factor, const Eigen::VectorXd &p, Eigen::VectorXd &f)
{
  const int    *begin = W.outerIndexPtr(), *coordinates = W.innerIndexPtr();
  const double *weights = W.valuePtr();
  for (int j = 0; j < W.cols(); ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      f[coordinates[k]] += weights[k] * (factor * p[j]);
}

} // namespace gestell::coupling
