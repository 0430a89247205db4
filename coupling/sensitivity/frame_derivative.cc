#include "coupling/sensitivity/frame_derivative.h"

#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void require_same_structure(const ReducedFrame &at, const ReducedFrame &other)
{
  bool same = other.n_interface == at.n_interface && other.M.rows() == at.M.rows() &&
              other.interfaces.size() == at.interfaces.size() && other.outputs.size() == at.outputs.size();
  for (std::size_t i = 0; same && i < at.interfaces.size(); ++i)
    same = other.interfaces[i].name == at.interfaces[i].name &&
           other.interfaces[i].coordinate == at.interfaces[i].coordinate;
  if (!same)
    throw std::invalid_argument("the frame at the other value has " + std::to_string(other.n_interface) +
                                " interface DOFs and " + std::to_string(other.M.rows() - other.n_interface) +
                                " modes, this one " + std::to_string(at.n_interface) + " and " +
                                std::to_string(at.M.rows() - at.n_interface) +
                                ": they cannot be compared; give the number of modes (reduction.modes)");
}

double distance_squared(const std::array<double, 3> &a, const std::array<double, 3> &b)
{
  double sum = 0.;
  for (int d = 0; d < 3; ++d)
    sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

std::size_t nearest(const ReducedFrame &frame, const std::array<double, 3> &to)
{
  std::size_t best     = 0;
  double      smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < frame.points.size(); ++i)
    if (const double distance = distance_squared(frame.points[i], to); distance < smallest)
    {
      best     = i;
      smallest = distance;
    }
  return best;
}

/// X of D± X = D; without a skin by the loads of the modes on the interface and in a field of acceleration.
MatrixXd nearest_combination(const ReducedFrame &at, const ReducedFrame &other)
{
  const Index n1 = at.n_interface, m = at.M.rows() - n1;
  if (at.points.empty() || other.points.empty())
  {
    MatrixXd own(n1 + 3, m), its(n1 + 3, m);
    own << at.M.topRightCorner(n1, m), at.translations_load.bottomRows(m).transpose();
    its << other.M.topRightCorner(n1, m), other.translations_load.bottomRows(m).transpose();
    return (own.cwiseProduct(its)).colwise().sum().cwiseSign().asDiagonal();
  }
  constexpr std::size_t most_points = 500; // of the skin for the comparison of shapes: many times the modes
  const std::size_t     n           = std::min(at.points.size(), most_points);
  MatrixXd              own = MatrixXd(Index(3 * n), m), its = own;
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t here = at.points.size() * i / n, there = nearest(other, at.points[here]);
    own.middleRows(Index(3 * i), 3) = at.displacement.block(Index(3 * here), n1, 3, m).cast<double>();
    its.middleRows(Index(3 * i), 3) = other.displacement.block(Index(3 * there), n1, 3, m).cast<double>();
  }
  return its.colPivHouseholderQr().solve(own);
}

/// diag(E, R)
MatrixXd turned(const ReducedFrame &at, const ReducedFrame &other)
{
  const Index n1 = at.n_interface, m = at.M.rows() - n1;
  MatrixXd    T = MatrixXd::Identity(at.M.rows(), at.M.rows());
  if (m == 0)
    return T;
  const Eigen::JacobiSVD<MatrixXd> svd(nearest_combination(at, other), Eigen::ComputeFullU | Eigen::ComputeFullV);
  constexpr double                 another = 0.5; // singular value below which a mode has no counterpart
  if (!(svd.singularValues().minCoeff() > another))
    throw std::invalid_argument("among the " + std::to_string(m) +
                                " modes of the frame are different at the other value, because their order changes; "
                                "use another number of modes (reduction.modes)");
  T.bottomRightCorner(m, m) = svd.matrixU() * svd.matrixV().transpose();
  return T;
}

VectorXd rows_turned(const MatrixXd &T, const VectorXd &row)
{
  return row.size() > 0 ? VectorXd(T.transpose() * row) : row;
}

/// The frame in the coordinates of another.
ReducedFrame in_coordinates_of(const ReducedFrame &at, const ReducedFrame &frame)
{
  require_same_structure(at, frame);
  const MatrixXd T = turned(at, frame);
  ReducedFrame   same;
  same.interfaces        = frame.interfaces;
  same.outputs           = frame.outputs;
  same.M                 = T.transpose() * frame.M * T;
  same.B                 = T.transpose() * frame.B * T;
  same.C                 = T.transpose() * frame.C * T;
  same.translations_load = T.transpose() * frame.translations_load;
  for (fem::FrameOutput &output : same.outputs)
    for (VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      *row = rows_turned(T, *row);
  return same;
}

/// Squares of all entries, each by the size of its row and column.
double size_of(const MatrixXd &A, const MatrixXd &scale)
{
  const VectorXd by = scale.diagonal().cwiseAbs().cwiseSqrt().unaryExpr([](double d) { return d > 0. ? 1. / d : 0.; });
  return (by.asDiagonal() * A * by.asDiagonal()).squaredNorm();
}

VectorXd difference(const VectorXd &minus, const VectorXd &plus, double step)
{
  return minus.size() == plus.size() ? VectorXd((plus - minus) / (2. * step)) : VectorXd();
}

} // namespace

FrameDerivative frame_derivative(const ReducedFrame &at, const ReducedFrame &minus, const ReducedFrame &plus,
                                 double step)
{
  const ReducedFrame below = in_coordinates_of(at, minus), above = in_coordinates_of(at, plus);
  const double       quotient = 0.5 / step;
  FrameDerivative    found;
  double             first = 0., second = 0.;
  for (const auto &[to, F] :
       {std::pair(&FrameDerivative::M, &ReducedFrame::M), std::pair(&FrameDerivative::B, &ReducedFrame::B),
        std::pair(&FrameDerivative::C, &ReducedFrame::C)})
  {
    const MatrixXd change = above.*F - below.*F;
    found.*to             = quotient * 0.5 * (change + change.transpose());
    first += size_of(change, at.*F);
    second += size_of(above.*F - 2. * (at.*F) + below.*F, at.*F);
  }
  found.curvature         = first > 0. ? std::sqrt(second / first) : 0.;
  found.translations_load = quotient * (above.translations_load - below.translations_load);
  for (std::size_t i = 0; i < at.outputs.size(); ++i)
  {
    const fem::FrameOutput &low = below.outputs[i], &high = above.outputs[i];
    fem::FrameOutput        row;
    row.on_q               = difference(low.on_q, high.on_q, step);
    row.on_v               = difference(low.on_v, high.on_v, step);
    row.on_a               = difference(low.on_a, high.on_a, step);
    row.under_acceleration = quotient * (high.under_acceleration - low.under_acceleration);
    row.constant           = quotient * (high.constant - low.constant);
    found.outputs.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < at.interfaces.size(); ++i)
  {
    const auto &low = below.interfaces[i].position, &high = above.interfaces[i].position;
    found.positions.push_back(
        {quotient * (high[0] - low[0]), quotient * (high[1] - low[1]), quotient * (high[2] - low[2])});
  }
  return found;
}

ReducedFrame moved(const ReducedFrame &frame, const FrameDerivative &derivative, double by)
{
  ReducedFrame there = frame;
  there.modal        = false;
  there.M += by * derivative.M;
  there.B += by * derivative.B;
  there.C += by * derivative.C;
  there.translations_load += by * derivative.translations_load;
  for (std::size_t i = 0; i < there.outputs.size(); ++i)
  {
    fem::FrameOutput       &output = there.outputs[i];
    const fem::FrameOutput &change = derivative.outputs[i];
    for (VectorXd fem::FrameOutput::*row : {&fem::FrameOutput::on_q, &fem::FrameOutput::on_v, &fem::FrameOutput::on_a})
      if ((output.*row).size() > 0 && (change.*row).size() > 0)
        output.*row += by * (change.*row);
    output.under_acceleration += by * change.under_acceleration;
    output.constant += by * change.constant;
  }
  for (std::size_t i = 0; i < there.interfaces.size(); ++i)
    for (int d = 0; d < 3; ++d)
      there.interfaces[i].position[d] += by * derivative.positions[i][d];
  return there;
}

} // namespace gestell::coupling
