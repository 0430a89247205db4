// The derivative of a reduced frame by the difference of two, whose modes have signs, order and combinations of their
// own.

#include "coupling/sensitivity/frame_derivative.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace
{

using namespace gestell::coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int n_1 = 2, m = 4, n = n_1 + m, n_points = 30;

MatrixXd pattern(int rows, int columns, double phase)
{
  MatrixXd A(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      A(i, j) = std::sin(1.3 * i * (j + 1) + 0.7 * j * j + phase);
  return A;
}

/// A frame whose matrices are linear in x, in the modes `turn` [m x m], orthogonal.
ReducedFrame frame_at(double x, const MatrixXd &turn)
{
  MatrixXd T                = MatrixXd::Identity(n, n);
  T.bottomRightCorner(m, m) = turn;
  MatrixXd coupling         = 0.2 * pattern(n_1, m, 0.) + 0.1 * x * pattern(n_1, m, 1.);
  MatrixXd M = MatrixXd::Identity(n, n), C = M;
  M.topLeftCorner(n_1, n_1)  = (3. + x) * MatrixXd::Identity(n_1, n_1);
  M.topRightCorner(n_1, m)   = coupling;
  M.bottomLeftCorner(m, n_1) = coupling.transpose();
  C.diagonal()               = (VectorXd(n) << 5., 7., 10. + x, 10., 30. - 2. * x, 80.).finished();
  ReducedFrame frame;
  frame.n_interface       = n_1;
  frame.M                 = T.transpose() * M * T;
  frame.C                 = T.transpose() * C * T;
  frame.B                 = 0.01 * frame.C;
  frame.translations_load = T.transpose() * pattern(n, 3, x);
  frame.interfaces        = {{"bearing", {0., 0., 1. + x}, {0, 1, -1, -1, -1, -1}}};
  frame.displacement      = (pattern(3 * n_points, n, 2.) * T).cast<float>();
  for (int i = 0; i < n_points; ++i)
    frame.points.push_back({0.1 * i, 0., 0.});
  gestell::fem::FrameOutput cut;
  cut.name      = "cut";
  cut.on_q      = T.transpose() * VectorXd(pattern(n, 1, 3.) * (1. + x));
  cut.on_v      = VectorXd::Zero(n);
  frame.outputs = {cut};
  return frame;
}

/// Signs, an exchange, and a turn of the two modes that nearly meet.
MatrixXd other_modes()
{
  MatrixXd turn = MatrixXd::Zero(m, m);
  turn(0, 0) = turn(1, 1) = std::cos(0.8);
  turn(0, 1)              = std::sin(0.8);
  turn(1, 0)              = -std::sin(0.8);
  turn(2, 3)              = -1.;
  turn(3, 2)              = 1.;
  return turn;
}

TEST(FrameDerivative, IsThatOfTheMatricesWhateverModesTheTwoFramesAreIn)
{
  const MatrixXd        same = MatrixXd::Identity(m, m);
  const ReducedFrame    at   = frame_at(0., same);
  const double          h    = 1e-3;
  const FrameDerivative found =
      frame_derivative(at, frame_at(-h, other_modes()), frame_at(h, -other_modes().transpose()), h);
  const ReducedFrame there = moved(at, found, 0.1), exact = frame_at(0.1, same);
  // Shapes in single precision: 1e-7, over h.
  EXPECT_LT((there.M - exact.M).norm(), 1e-4 * 0.1);
  EXPECT_LT((there.C - exact.C).norm(), 1e-4 * 0.1 * exact.C.norm());
  EXPECT_LT((there.outputs[0].on_q - exact.outputs[0].on_q).norm(), 1e-4 * 0.1);
  EXPECT_NEAR(there.interfaces[0].position[2], 1.1, 1e-12);
  EXPECT_LT(found.curvature, 1e-3);
}

TEST(FrameDerivative, HasACurvatureThatShowsScatterOfItsFrames)
{
  const MatrixXd same = MatrixXd::Identity(m, m);
  ReducedFrame   plus = frame_at(1e-3, same);
  plus.C(n_1, n_1) += 5e-3; // half of what the mode changes
  EXPECT_GT(frame_derivative(frame_at(0., same), frame_at(-1e-3, same), plus, 1e-3).curvature, 0.3);
}

TEST(FrameDerivative, IsRefusedWhereOtherModesAreKept)
{
  const MatrixXd     same  = MatrixXd::Identity(m, m);
  const ReducedFrame at    = frame_at(0., same);
  ReducedFrame       other = frame_at(1e-3, same);
  // The last mode has another shape, across all those of the frame.
  const Eigen::HouseholderQR<MatrixXd> qr(at.displacement.cast<double>());
  const MatrixXd                       Q = qr.householderQ();
  other.displacement.col(n - 1)          = (10. * Q.col(n + 3)).cast<float>();
  gestell::tests::expect_refusal([&] { frame_derivative(at, at, other, 1e-3); }, "modes of the frame are different");
  ReducedFrame fewer = at;
  fewer.M            = MatrixXd::Identity(n - 1, n - 1);
  gestell::tests::expect_refusal([&] { frame_derivative(at, at, fewer, 1e-3); }, "they cannot be compared");
}

} // namespace
