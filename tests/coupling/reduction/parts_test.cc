// One mesh cut into parts against the same frame in one piece.

#include "coupling/reduction/parts/parted_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace gestell::test
{
namespace
{

using coupling::ReducedFrame;
using Eigen::MatrixXd;

struct CutCase
{
  std::string             name;
  fem::Mesh               mesh;
  fem::FrameSpecification specification;
};

/// A beam with a node at its end, a mass beside it and a plane through it.
CutCase loaded_beam(const std::string &name, fem::Mesh mesh, fem::InterfaceCoupling coupling, const fem::Support &foot)
{
  CutCase frame{name, std::move(mesh), free_steel()};
  frame.specification.supports   = {foot};
  frame.specification.interfaces = {interface("end", {"x1"}, coupling)};
  frame.specification.masses     = {{"motor", 40., Eigen::Matrix3d::Identity(), {}, "end", {}, {}, ""}};
  frame.specification.cuts       = {{"middle", {{1., 0., 0.}}, {{1., 0., 0.}}, ""}};
  frame.specification.stress     = true;
  frame.specification.place      = "scene.toml:2: frame";
  return frame;
}

CutCase turned_case(CutCase frame)
{
  const Eigen::Matrix3d Q    = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., -0.5).normalized()).matrix();
  const auto            turn = [&](std::array<double, 3> &x, const Eigen::Vector3d &by)
  { Eigen::Map<Eigen::Vector3d>(x.data()) = Q * Eigen::Map<Eigen::Vector3d>(x.data()).eval() + by; };
  const Eigen::Vector3d moved(3., 1., 2.);
  for (fem::Point3 &point : frame.mesh.points)
    turn(point, moved);
  turn(frame.specification.cuts[0].through, moved);
  turn(frame.specification.cuts[0].normal, Eigen::Vector3d::Zero());
  return frame;
}

std::vector<CutCase> cut_cases()
{
  const std::array<int, 3>    n{{24, 2, 2}};
  const std::array<double, 3> size{{2., 0.2, 0.1}};
  const auto                  rigid = fem::InterfaceCoupling::rigid, average = fem::InterfaceCoupling::average;
  const auto                  clamp       = clamped("foot", {"x0"});
  CutCase                     damped      = loaded_beam("on dampers", box_mesh(n, size, 0.2), average,
                                                        foundation("foot", {"x0"}, {{2e8, 3e8, 4e8}}, {{1e5, 2e5, 1e5}}));
  damped.specification.rayleigh_mass      = 3.;
  damped.specification.rayleigh_stiffness = 1e-5;
  return {loaded_beam("clamped", box_mesh(n, size, 0.2), rigid, clamp),
          turned_case(loaded_beam("turned", box_mesh(n, size, 0.2), rigid, clamp)),
          loaded_beam("of bricks", brick_mesh(n, size), average, clamp), std::move(damped)};
}

ReducedFrame reduced_in_parts(const CutCase &frame, int n_parts, const coupling::ReductionOptions &options = {})
{
  const fem::Discretisation of = fem::discretise_for_parts(frame.mesh, frame.specification);
  return reduce_in_parts(of.matrices, of.mesh_error->parts(n_parts, frame.specification.place),
                         frame.specification.rayleigh_mass, frame.specification.rayleigh_stiffness, options,
                         frame.specification.place, {})
      .frame;
}

const fem::FrameOutput &output_named(const ReducedFrame &frame, const std::string &name)
{
  return *std::find_if(frame.outputs.begin(), frame.outputs.end(),
                       [&](const fem::FrameOutput &output) { return output.name == name; });
}

TEST(CellParts, AddUpToTheWhole)
{
  for (const CutCase &frame : cut_cases())
  {
    SCOPED_TRACE(frame.name);
    const fem::FrameMatrices  whole = fem::discretise(frame.mesh, frame.specification);
    const fem::Discretisation of    = fem::discretise_for_parts(frame.mesh, frame.specification);
    const fem::CellParts      parts = of.mesh_error->parts(5, "");
    MatrixXd                  C = of.matrices.C, M = of.matrices.M;
    for (int p = 0; p < parts.size(); ++p)
    {
      const fem::PartMatrices part = parts.matrices(p);
      EXPECT_EQ(part.coordinates, parts.coordinates(p));
      C(part.coordinates, part.coordinates) += MatrixXd(part.C);
      M(part.coordinates, part.coordinates) += MatrixXd(part.M);
    }
    EXPECT_LT((C - MatrixXd(whole.C)).norm(), 1e-12 * C.norm());
    EXPECT_LT((M - MatrixXd(whole.M)).norm(), 1e-12 * M.norm());
  }
}

TEST(FrameInParts, HasTheFrequenciesStaticsAndOutputsOfTheWhole)
{
  coupling::ReductionOptions options;
  options.n_modes = 20;
  for (const CutCase &frame : cut_cases())
    for (const int n_parts : {2, 3, 5})
    {
      SCOPED_TRACE(frame.name + ", parts: " + std::to_string(n_parts));
      const ReducedFrame whole = coupling::reduce_frame(fem::discretise(frame.mesh, frame.specification), options);
      const ReducedFrame parts = reduced_in_parts(frame, n_parts, options);
      ASSERT_EQ(parts.M.rows(), whole.M.rows());
      EXPECT_EQ(parts.n_full, whole.n_full);
      for (int j = 0; j < 12; ++j)
      {
        EXPECT_GT(parts.frequencies_hz[j], (1. - 1e-5) * whole.frequencies_hz[j]) << j;
        EXPECT_LT(parts.frequencies_hz[j], (1. + 2e-3) * whole.frequencies_hz[j]) << j;
      }
      const MatrixXd C = whole.C.topLeftCorner(6, 6), B = whole.B.topLeftCorner(6, 6);
      EXPECT_LT((parts.C.topLeftCorner(6, 6) - C).norm(), 1e-8 * C.norm());
      EXPECT_LT((parts.M.topLeftCorner(6, 6) - whole.M.topLeftCorner(6, 6)).norm(), 1e-5 * whole.M.norm());
      EXPECT_LT((parts.B.topLeftCorner(6, 6) - B).norm(), 2e-4 * B.norm() + 1e-12);
      EXPECT_LT((parts.translations_load - whole.translations_load).topRows(6).norm(),
                1e-8 * whole.translations_load.norm());
      const Eigen::Vector3d g(1., -2., -9.81);
      for (const char *name : {"cut.middle", "support.foot.x", "support.foot.z"})
      {
        const auto force = [&](const ReducedFrame &of)
        {
          const fem::FrameOutput &output = output_named(of, name);
          return output.on_q.dot(of.C.ldlt().solve(of.translations_load * g)) + output.under_acceleration.dot(g);
        };
        EXPECT_NEAR(force(parts), force(whole), 1e-6 * std::abs(force(whole))) << name;
      }
      EXPECT_LT((parts.displacement.leftCols(6) - whole.displacement.leftCols(6)).norm(),
                1e-5 * whole.displacement.leftCols(6).norm());
      EXPECT_LT((parts.stress.mean.leftCols(6) - whole.stress.mean.leftCols(6)).norm(),
                1e-4 * whole.stress.mean.leftCols(6).norm());
      EXPECT_EQ(parts.statements.back().rfind("parts: " + std::to_string(n_parts), 0), 0u) << parts.statements.back();
    }
}

TEST(FrameInParts, FloatsAsTheWholeDoes)
{
  CutCase frame = cut_cases().front();
  frame.specification.supports.clear();
  coupling::ReductionOptions options;
  options.n_modes          = 12;
  const ReducedFrame whole = coupling::reduce_frame(fem::discretise(frame.mesh, frame.specification), options);
  const ReducedFrame parts = reduced_in_parts(frame, 3, options);
  EXPECT_EQ(parts.n_rigid(), 6);
  EXPECT_EQ(parts.facts.free_motions, whole.facts.free_motions);
  for (int j = 6; j < 14; ++j)
    EXPECT_NEAR(parts.frequencies_hz[j], whole.frequencies_hz[j], 1e-3 * whole.frequencies_hz[j]);
}

TEST(FrameInParts, RefusesMorePartsThanMakeSense)
{
  const CutCase frame = cut_cases().front();
  expect_refusal([&] { reduced_in_parts(frame, 40); }, "interface DOFs between them; use fewer parts");
  const fem::Discretisation of = fem::discretise_for_parts(frame.mesh, frame.specification);
  expect_refusal([&] { of.mesh_error->parts(100000, "scene.toml:2: frame"); },
                 "scene.toml:2: frame: parts = 100000, but the frame has only 576 cells");
}

} // namespace
} // namespace gestell::test
