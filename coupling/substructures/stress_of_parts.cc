#include "coupling/substructures/stress_of_parts.h"

#include <Eigen/LU>

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index six = fem::stress_components;
using Matrix6       = Eigen::Matrix<double, six, six>;

/// Q sigma Q^T of the six components.
Matrix6 turned_components(const Eigen::Matrix3d &Q)
{
  constexpr int axis[six][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  Matrix6       R;
  for (Index c = 0; c < six; ++c)
  {
    Eigen::Matrix3d unit         = Eigen::Matrix3d::Zero();
    unit(axis[c][0], axis[c][1]) = 1.;
    unit(axis[c][1], axis[c][0]) = 1.;
    const Eigen::Matrix3d turned = Q * unit * Q.transpose();
    for (Index r = 0; r < six; ++r)
      R(r, c) = turned(axis[r][0], axis[r][1]);
  }
  return R;
}

/// R_point A B for every point, A in single precision; in double precision terms of rigid motions cancel.
Eigen::MatrixXf turned(const Matrix6 &R, const Eigen::MatrixXf &A, const MatrixXd &B)
{
  Eigen::MatrixXf result(A.rows(), B.cols());
  for (Index row = 0; row < A.rows(); row += six)
    result.middleRows<six>(row) = (R * A.middleRows<six>(row).cast<double>() * B).cast<float>();
  return result;
}

/// diag(A, B)
MatrixXd beside(const MatrixXd &A, const MatrixXd &B)
{
  MatrixXd both                              = MatrixXd::Zero(A.rows() + B.rows(), A.cols() + B.cols());
  both.topLeftCorner(A.rows(), A.cols())     = A;
  both.bottomRightCorner(B.rows(), B.cols()) = B;
  return both;
}

} // namespace

void turn_stress(ReducedStress &stress, const Eigen::Matrix3d &Q, const MatrixXd &S)
{
  if (stress.empty())
    return;
  const Matrix6  R = turned_components(Q);
  const MatrixXd B = beside(S, Q.transpose());
  stress.mean      = turned(R, stress.mean, B);
  stress.deviation = turned(R, stress.deviation, B);
  if (Q.determinant() < 0.)
    for (auto &triangle : stress.triangles)
      std::swap(triangle[1], triangle[2]);
}

fem::StressRecovery stress_of_parts(const std::vector<ReducedFrame> &parts, const FrameOfParts &description,
                                    const PartUnion &all, const MatrixXd &G)
{
  fem::StressRecovery whole;
  if (std::any_of(parts.begin(), parts.end(), [](const ReducedFrame &part) { return part.stress.empty(); }))
    return whole;
  Index rows = 0;
  for (const ReducedFrame &part : parts)
    rows += part.stress.mean.rows();
  whole.mean_by_state.resize(rows, G.cols() + 3);
  whole.deviation_by_state.resize(rows, G.cols() + 3);
  int points = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const ReducedStress &own   = parts[i].stress;
    const int            first = int(whole.point.size()), rigid = int(whole.rigid.size());
    const MatrixXd       B  = beside(G.middleRows(all.first[i], parts[i].M.rows()), Eigen::Matrix3d::Identity());
    const auto           to = [&](Eigen::MatrixXf &rows_of_all, const Eigen::MatrixXf &rows_of_part)
    { rows_of_all.middleRows(six * first, rows_of_part.rows()) = turned(Matrix6::Identity(), rows_of_part, B); };
    to(whole.mean_by_state, own.mean);
    to(whole.deviation_by_state, own.deviation);
    for (const int point : own.point)
      whole.point.push_back(point + points);
    for (const auto &[a, b, c] : own.triangles)
      whole.triangles.push_back({a + first, b + first, c + first});
    for (const int nearby : own.nearby)
      whole.nearby.push_back(nearby < 0 ? -1 : nearby + rigid);
    for (const std::string &name : own.rigid)
      whole.rigid.push_back(description.parts[i].name + ": " + name);
    points += int(parts[i].points.size());
  }
  return whole;
}

} // namespace gestell::coupling
