// One mesh cut into parts against the same frame in one piece.

#include "coupling/algebra/dense_modes.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/reduction/parts/parted_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/frame_folder.h"
#include "tests/support/refusal.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cstdlib>
#include <set>

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

ReducedFrame reduced_in_parts(const CutCase &frame, int n_parts, const coupling::ReductionOptions &options = {},
                              int at_once = 1)
{
  const fem::Discretisation of = fem::discretise_for_parts(frame.mesh, frame.specification);
  return reduce_in_parts(of.matrices, of.mesh_error->parts(n_parts, frame.specification.place), options,
                         {frame.specification.rayleigh_mass, frame.specification.rayleigh_stiffness,
                          frame.specification.place, at_once})
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

/// Parts are kept in a cache of their own.
class FrameInParts : public FrameFolder
{
protected:
  std::set<std::string> files() const
  {
    std::set<std::string> found;
    for (const auto &entry : std::filesystem::directory_iterator(folder))
      if (entry.is_regular_file())
        found.insert(entry.path().filename().string());
    return found;
  }
  void empty_cache() const
  {
    for (const std::string &name : files())
      std::filesystem::remove(folder / name);
  }
  /// Remembers the files by a second name.
  void mark_files() const
  {
    std::filesystem::create_directories(folder / "marked");
    for (const std::string &name : files())
      std::filesystem::create_hard_link(folder / name, folder / "marked" / name);
  }
  /// Number of files that have not been written since.
  int n_marked() const
  {
    int count = 0;
    for (const std::string &name : files())
      count += std::filesystem::exists(folder / "marked" / name) &&
               std::filesystem::equivalent(folder / name, folder / "marked" / name);
    return count;
  }
};

void expect_equal(const ReducedFrame &a, const ReducedFrame &b)
{
  EXPECT_EQ(a.M, b.M);
  EXPECT_EQ(a.B, b.B);
  EXPECT_EQ(a.C, b.C);
  EXPECT_EQ(a.frequencies_hz, b.frequencies_hz);
  EXPECT_EQ(a.translations_load, b.translations_load);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.stress.mean, b.stress.mean);
  EXPECT_EQ(a.statements, b.statements);
}

TEST_F(FrameInParts, IsTheSameSideBySideAndInOneProcess)
{
  for (const CutCase &frame : {cut_cases().front(), cut_cases().back()})
  {
    SCOPED_TRACE(frame.name);
    const ReducedFrame in_turn = reduced_in_parts(frame, 5);
    EXPECT_EQ(files().size(), 5u);
    empty_cache();
    expect_equal(reduced_in_parts(frame, 5, {}, 3), in_turn);
    empty_cache();
    setenv("GESTELL_ONE_PROCESS", "1", 1);
    expect_equal(reduced_in_parts(frame, 5), in_turn);
    unsetenv("GESTELL_ONE_PROCESS");
    empty_cache();
  }
}

TEST_F(FrameInParts, HasTheDampingOfMeasuredShapes)
{
  CutCase               frame    = cut_cases().front();
  const ReducedFrame    undamped = reduced_in_parts(frame, 3);
  const auto            own      = coupling::dense_modes(undamped.C, undamped.M, coupling::cancelled_by_reduction);
  const double          hz       = 1.1 * own.omega[2] / (2. * M_PI);
  const Eigen::VectorXd shape    = undamped.displacement.cast<double>() * own.V.col(2);
  frame.specification.modal_damping_ratio       = 0.03;
  frame.specification.modal_damping_ratio.named = {
      {0.01, -1, hz, hz, undamped.points, shape.cast<std::complex<double>>()}};
  const ReducedFrame damped = reduced_in_parts(frame, 3);
  EXPECT_THAT(damped.statements, ::testing::Contains(::testing::HasSubstr("MAC 1 of the frame, ratio 1 %")));
  const Eigen::VectorXd dampers = (own.V.transpose() * damped.B * own.V).diagonal();
  for (const int j : {0, 1, 2, 3})
    EXPECT_NEAR(dampers[j], 2. * (j == 2 ? 0.01 : 0.03) * own.omega[j], 1e-6 * own.omega[j]) << j;
}

TEST_F(FrameInParts, TakesPartsThatAreDoneFromTheCache)
{
  const CutCase      frame = cut_cases().front();
  const ReducedFrame first = reduced_in_parts(frame, 4);
  const auto         all   = files();
  ASSERT_EQ(all.size(), 4u);
  mark_files();
  expect_equal(reduced_in_parts(frame, 4, {}, 2), first);
  EXPECT_EQ(files(), all);
  EXPECT_EQ(n_marked(), 4);

  const auto entries = coupling::cache_entries(coupling::CacheCheck::contents);
  ASSERT_EQ(entries.size(), 4u);
  for (const coupling::CacheEntry &entry : entries)
  {
    EXPECT_EQ(entry.defect, "");
    EXPECT_TRUE(entry.is_part);
    EXPECT_EQ(entry.n_modes, 40);
    EXPECT_EQ(entry.origin.scene, frame.specification.place);
  }
  EXPECT_FALSE(coupling::nearest_entry(entries, {})) << "a part is not a frame";

  // interrupted before the last one, and a damaged one: these two are made again
  std::filesystem::remove(folder / *all.begin());
  std::filesystem::resize_file(folder / *all.rbegin(), 1000);
  expect_equal(reduced_in_parts(frame, 4), first);
  EXPECT_EQ(files(), all);
  EXPECT_EQ(n_marked(), 2);

  coupling::ReductionOptions other; // of the joined parts only
  other.method = "guyan";
  reduced_in_parts(frame, 4, other);
  EXPECT_EQ(files(), all);
  CutCase changed                      = frame; // at one end
  changed.specification.masses[0].mass = 41.;
  reduced_in_parts(changed, 4);
  EXPECT_EQ(files().size(), 5u);
}

TEST_F(FrameInParts, ReducesWithoutACacheThatCanBeWritten)
{
  const CutCase      frame = cut_cases().front();
  const ReducedFrame kept  = reduced_in_parts(frame, 3);
  setenv("GESTELL_CACHE", "/proc/none", 1);
  expect_equal(reduced_in_parts(frame, 3), kept);
}

TEST_F(FrameInParts, EndsWithTheMessageOfAPartThatFails)
{
  CutCase loose = cut_cases().front();
  loose.specification.supports.clear();
  loose.specification.masses.clear();
  loose.specification.cuts.clear();
  // an unconstrained body beside it
  const fem::Mesh other = loose.mesh;
  const int       n     = int(other.points.size());
  for (fem::Point3 point : other.points)
  {
    point[1] += 10.;
    loose.mesh.points.push_back(point);
  }
  for (auto cell : other.cells)
  {
    for (int &node : cell)
      node += n;
    loose.mesh.cells.push_back(cell);
    loose.mesh.cell_solid.push_back(other.cell_solid.front());
  }
  for (auto triangle : other.skin)
  {
    for (int &node : triangle)
      node += n;
    loose.mesh.skin.push_back(triangle);
  }
  for (const int at_once : {1, 2})
    expect_refusal([&] { reduced_in_parts(loose, 2, {}, at_once); }, "moves freely although its interface is fixed");
}

TEST_F(FrameInParts, HasTheFrequenciesStaticsAndOutputsOfTheWhole)
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

TEST_F(FrameInParts, FloatsAsTheWholeDoes)
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

TEST_F(FrameInParts, RefusesMorePartsThanMakeSense)
{
  const CutCase frame = cut_cases().front();
  expect_refusal([&] { reduced_in_parts(frame, 40); }, "interface DOFs between them; use fewer parts");
  const fem::Discretisation of = fem::discretise_for_parts(frame.mesh, frame.specification);
  expect_refusal([&] { of.mesh_error->parts(100000, "scene.toml:2: frame"); },
                 "scene.toml:2: frame: parts = 100000, but the frame has only 576 cells");
}

} // namespace
} // namespace gestell::test
