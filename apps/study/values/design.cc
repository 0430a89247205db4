#include "apps/study/values/design.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

void check_columns(const Eigen::MatrixXd &points, const std::vector<StudyVariable> &variables)
{
  if (points.cols() != static_cast<Eigen::Index>(variables.size()))
    throw std::invalid_argument("study: points have " + std::to_string(points.cols()) + " columns for " +
                                std::to_string(variables.size()) + " variables");
}

} // namespace

Eigen::MatrixXd physical_points(const Eigen::MatrixXd &coded, const std::vector<StudyVariable> &variables)
{
  check_columns(coded, variables);
  Eigen::MatrixXd physical(coded.rows(), coded.cols());
  for (Eigen::Index j = 0; j < coded.cols(); ++j)
    physical.col(j) = coded.col(j).unaryExpr([&](double xi) { return variables[j].physical(xi); });
  return physical;
}

Eigen::MatrixXd coded_points(const Eigen::MatrixXd &physical, const std::vector<StudyVariable> &variables)
{
  check_columns(physical, variables);
  Eigen::MatrixXd coded(physical.rows(), physical.cols());
  for (Eigen::Index j = 0; j < physical.cols(); ++j)
    coded.col(j) = physical.col(j).unaryExpr([&](double x) { return variables[j].coded(x); });
  return coded;
}

} // namespace gestell::apps
