// Stresses of a reduced frame against those of the full one.

#include "coupling/frame/stress_field.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/LU>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>

namespace gestell
{
namespace
{

using coupling::ReducedFrame;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A short column, clamped below, with a node that is tied to its top and one that takes the mean of a side.
fem::FrameMatrices column()
{
  auto specification       = test::free_steel();
  specification.stress     = true;
  specification.supports   = {test::clamped("floor", {"z0"})};
  specification.interfaces = {test::interface("top", {"z1"}, fem::InterfaceCoupling::rigid)};
  return fem::discretise(test::box_mesh({{2, 2, 4}}, {{0.4, 0.3, 1.2}}, 0.2), specification);
}

/// A block with a load inside: a surface of which only the mean is an interface.
fem::FrameMatrices loaded_block()
{
  auto specification       = test::free_steel();
  specification.stress     = true;
  specification.supports   = {test::clamped("floor", {"z0"})};
  specification.interfaces = {test::interface("load", {"z1"}, fem::InterfaceCoupling::average)};
  return fem::discretise(test::box_mesh({{2, 1, 1}}, {{0.8, 0.4, 0.3}}, 0.2), specification);
}

/// The block in hexahedra.
fem::FrameMatrices loaded_bricks()
{
  auto specification       = test::free_steel();
  specification.stress     = true;
  specification.supports   = {test::clamped("floor", {"z0"})};
  specification.interfaces = {test::interface("load", {"z1"}, fem::InterfaceCoupling::average)};
  return fem::discretise(test::brick_mesh({{2, 1, 1}}, {{0.8, 0.4, 0.3}}, 0.2), specification);
}

ReducedFrame reduced_with(const fem::FrameMatrices &frame, int modes)
{
  coupling::ReductionOptions options;
  options.n_modes = modes;
  return coupling::reduce_frame(frame, options);
}

/// Largest difference over the largest stress.  Columns in single precision are rounded to 6e-8; stresses of unit
/// motions of an interface cancel to some tenths of a percent of themselves.
double stress_error(const VectorXd &found, const VectorXd &exact)
{
  return (found - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

VectorXd flat(const coupling::StressField &field)
{
  return Eigen::Map<const VectorXd>(field.components.data(), field.components.size());
}

/// Static stress of the reduced frame under forces F on its interface and an acceleration field g.
VectorXd reduced_static_stress(const ReducedFrame &frame, const VectorXd &F, const Eigen::Vector3d &g)
{
  VectorXd f = frame.translations_load * g;
  f.head(F.size()) += F;
  const VectorXd p = frame.C.lu().solve(f);
  return flat(coupling::stress_field(frame.stress, coupling::stress_state(frame.stress, p, {g[0], g[1], g[2]})));
}

VectorXd full_static_stress(const fem::FrameMatrices &frame, const VectorXd &F, const Eigen::Vector3d &g)
{
  VectorXd   f  = frame.acceleration_load * g;
  const auto q1 = frame.interface_coordinates();
  for (std::size_t i = 0; i < q1.size(); ++i)
    f[q1[i]] += F[Eigen::Index(i)];
  return fem::stresses(frame.stress, test::statics(frame, f), fem::StressOf::mean);
}

TEST(ReducedStress, OfStaticLoadsIsThatOfTheFullFrameWithAnyNumberOfModes)
{
  VectorXd F(6);
  F << 3e4, -1e4, -8e4, 2e3, 5e3, -1e3;
  const Eigen::Vector3d g(1., -2., -9.81);
  for (const auto &frame : {column(), loaded_block(), loaded_bricks()})
    for (const int modes : {0, 5})
    {
      const ReducedFrame small = reduced_with(frame, modes);
      EXPECT_LT(stress_error(reduced_static_stress(small, F, Eigen::Vector3d::Zero()),
                             full_static_stress(frame, F, Eigen::Vector3d::Zero())),
                1e-5)
          << modes << " modes, forces at the interface";
      EXPECT_LT(stress_error(reduced_static_stress(small, VectorXd::Zero(6), g),
                             full_static_stress(frame, VectorXd::Zero(6), g)),
                1e-5)
          << modes << " modes, weight: the part of the omitted modes is added";
    }
}

TEST(ReducedStress, OfAVibrationHasTheErrorOfTheOmittedModes)
{
  // A mode of fixed-interface frequency omega_j that is omitted lacks the share omega^2 / omega_j^2 of the
  // inertia load.  Many are omitted, and short waves stress more than they move: a few times the first share.
  const auto   frame = column();
  const double omega = 2. * M_PI * 300.;
  const auto   q1    = frame.interface_coordinates();
  VectorXd     f     = VectorXd::Zero(frame.C.rows());
  f[q1[0]]           = 1e4;
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> full(
      Eigen::SparseMatrix<double>(frame.C - omega * omega * frame.M));
  const VectorXd exact = fem::stresses(frame.stress, full.solve(f), fem::StressOf::mean);

  double last = 1e9;
  for (const int modes : {2, 8, 30})
  {
    const ReducedFrame small = reduced_with(frame, modes);
    const VectorXd     p =
        MatrixXd(small.C - omega * omega * small.M).lu().solve(VectorXd(1e4 * VectorXd::Unit(small.C.rows(), 0)));
    const double err = stress_error(
        flat(coupling::stress_field(small.stress, coupling::stress_state(small.stress, p, {0., 0., 0.}))), exact);
    EXPECT_LT(err, 5. * std::pow(omega / small.omega0[modes - 1], 2)) << modes << " modes";
    EXPECT_LT(err, last);
    last = err;
  }
}

/// Histories [steps x points] of sigma_xx by Newmark's method (average acceleration), M q'' + B q' + C q = f(t) from
/// rest.
template <typename Matrix, typename Factor>
MatrixXd stress_histories(const Matrix &M, const Matrix &B, const Matrix &C, const VectorXd &load,
                          const std::vector<fem::FrameOutput> &outputs, int steps, double h)
{
  const auto force = [](double t)
  { return std::pow(std::sin(M_PI_2 * std::min(1., t / 4e-3)), 2) * (1. + 0.5 * std::sin(2. * M_PI * 90. * t)); };
  const Factor factor(Matrix(M + 0.5 * h * B + 0.25 * h * h * C));
  const Factor mass{Matrix(M)};
  VectorXd     q = VectorXd::Zero(load.size()), v = q, a = mass.solve(VectorXd(force(0.) * load));
  MatrixXd     rows(load.size(), Eigen::Index(outputs.size())), result(steps, rows.cols());
  for (std::size_t k = 0; k < outputs.size(); ++k)
    rows.col(Eigen::Index(k)) = outputs[k].on_q;
  for (int step = 0; step < steps; ++step)
  {
    const VectorXd q_0 = q + h * v + 0.25 * h * h * a, v_0 = v + 0.5 * h * a;
    a                = factor.solve(VectorXd(force((step + 1) * h) * load - B * v_0 - C * q_0));
    q                = q_0 + 0.25 * h * h * a;
    v                = v_0 + 0.5 * h * a;
    result.row(step) = q.transpose() * rows;
  }
  return result;
}

/// A bar of hexahedra loaded at its free end within 4 ms, with ten points an element and more from its ends.  The error
/// budget is the difference to twice the modes, at least eight more: as errors fall with the square of the number of
/// modes, it is 1 - (6/14)^2 = 1/1.22 of the error.
TEST(ReducedStress, OfAReducedFrameHasHistoriesWithinTheErrorBudgetOfTheFullFrame)
{
  auto specification               = test::free_steel();
  specification.supports           = {test::clamped("wall", {"x0"})};
  specification.interfaces         = {test::interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  specification.rayleigh_stiffness = 2e-5;
  for (const double x : {0.4, 0.7, 1., 1.3, 1.6})
    for (const double z : {0., 0.25})
      specification.stress_points.push_back(
          {"p" + std::to_string(specification.stress_points.size()), {x, 0.1, z}, {}, ""});
  auto       frame = fem::discretise(test::brick_mesh({{10, 1, 1}}, {{2., 0.2, 0.25}}), specification);
  const auto q1    = frame.interface_coordinates();
  VectorXd   F     = VectorXd::Zero(Eigen::Index(q1.size()));
  F.head<3>() << 6e3, 4e3, -2e4;
  const auto only_along = [](std::vector<fem::FrameOutput> outputs)
  {
    outputs.erase(std::remove_if(outputs.begin(), outputs.end(),
                                 [](const fem::FrameOutput &output) {
                                   return output.name.rfind("stress.", 0) != 0 ||
                                          output.name.substr(output.name.size() - 2) != "xx";
                                 }),
                  outputs.end());
    return outputs;
  };
  using Sparse           = Eigen::SparseMatrix<double>;
  constexpr int    steps = 1500;
  constexpr double h     = 2e-5;
  VectorXd         load  = VectorXd::Zero(frame.C.rows());
  for (std::size_t i = 0; i < q1.size(); ++i)
    load[q1[i]] = F[Eigen::Index(i)];
  const MatrixXd full = stress_histories<Sparse, Eigen::SparseLU<Sparse>>(frame.M, frame.B, frame.C, load,
                                                                          only_along(frame.outputs), steps, h);
  ASSERT_EQ(full.cols(), 10);
  const auto with = [&](int modes)
  {
    const ReducedFrame small = reduced_with(frame, modes);
    VectorXd           f     = VectorXd::Zero(small.C.rows());
    f.head(F.size())         = F;
    return stress_histories<MatrixXd, Eigen::PartialPivLU<MatrixXd>>(small.M, small.B, small.C, f,
                                                                     only_along(small.outputs), steps, h);
  };
  const MatrixXd few = with(6), more = with(14);
  for (Eigen::Index k = 0; k < full.cols(); ++k)
  {
    const double error  = (few - full).col(k).cwiseAbs().maxCoeff();
    const double budget = (few - more).col(k).cwiseAbs().maxCoeff();
    EXPECT_LE(error, 1.3 * budget) << k;
    EXPECT_LT(error, 0.1 * full.col(k).cwiseAbs().maxCoeff()) << k;
  }
  EXPECT_LT((more - full).cwiseAbs().maxCoeff(), 0.5 * (few - full).cwiseAbs().maxCoeff());
}

TEST(ReducedStress, IsThereOnlyIfItIsAskedFor)
{
  auto specification       = test::free_steel();
  specification.supports   = {test::clamped("floor", {"z0"})};
  specification.interfaces = {test::interface("top", {"z1"}, fem::InterfaceCoupling::rigid)};
  const auto small = reduced_with(fem::discretise(test::box_mesh({{1, 1, 2}}, {{1., 1., 2.}}), specification), 2);
  EXPECT_TRUE(small.stress.empty());
  EXPECT_EQ(small.stress.mean.size() + small.stress.deviation.size(), 0);
}

} // namespace
} // namespace gestell
