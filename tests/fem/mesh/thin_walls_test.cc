// Coarse meshes of thin curved walls, and what follows if gmsh fails.

#include "fem/mesh/curved_walls.h"
#include "fem/mesh/gmsh_child.h"
#include "fem/mesh/mesher.h"
#include "fem/mesh/watched_meshing.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"
#include "tests/support/thin_frames.h"

#include <gmock/gmock.h>
#include <gmsh.h>

#include <csignal>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace
{

/// A tube along z; gmsh's model holds its surfaces, of which the outer and the inner one are curved.
void draw_tube(double outer_radius, double inner_radius, double length)
{
  namespace occ = gmsh::model::occ;
  gmsh::vectorpair              left;
  std::vector<gmsh::vectorpair> map;
  occ::addCylinder(0., 0., 0., 0., 0., length, outer_radius, 1);
  occ::addCylinder(0., 0., 0., 0., 0., length, inner_radius, 2);
  occ::cut({{3, 1}}, {{3, 2}}, left, map);
  occ::synchronize();
}

/// sqrt(2 R d), the smaller one of both radii.
TEST(ThinWalls, HaveTheSizeThatAQuarterOfTheirThicknessAllows)
{
  const GmshSession session;
  draw_tube(60., 52., 400.);
  const FaceSizes sizes = sizes_by_walls(100.);
  ASSERT_EQ(sizes.size(), 2u);
  for (const auto &[face, size] : sizes)
    EXPECT_NEAR(size, std::sqrt(2. * 52. * 8.), 1e-6);
  EXPECT_TRUE(sizes_by_walls(28.).empty()) << "below it no size is needed";
}

/// A side of length l leaves the face by l^2/(8 R): of 160 mm, those of 12 around, by 10 mm, of 40 mm by 0.7 mm.
TEST(ThinWalls, ThatTrianglesCutThroughAreFound)
{
  const GmshSession session;
  draw_tube(305., 300., 900.);
  gmsh::option::setNumber("Mesh.MinimumCircleNodes", elements_around_circle);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 400.);
  gmsh::model::mesh::generate(2);
  EXPECT_EQ(faces_that_cut_walls().size(), 2u);
  gmsh::model::mesh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 40.);
  gmsh::model::mesh::generate(2);
  EXPECT_TRUE(faces_that_cut_walls().empty());
}

/// Without sizes for the tube gmsh's surfaces cross each other at this size.
TEST(ThinWalls, OfATubeOnAPlateAreMeshedWithCellsOfSevenTimesTheirThickness)
{
  const ThinFrame      frame  = thin_frames().front();
  const GeometryReport report = report_geometry(specification(draw("tube.step", frame.draw), 0.1));
  const double         tube = M_PI * (0.06 * 0.06 - 0.052 * 0.052) * 0.4, plate = 0.6 * 0.4 * 0.015;
  EXPECT_NEAR(report.volume, plate + tube, 0.0451 * tube) << "12 sides to a circle at least";
  EXPECT_THAT(report.statements, ::testing::Contains(HasSubstr("would cut through their thin walls")));
  EXPECT_TRUE(report.notes.empty());
}

/// Stands for a mesh.
struct Made
{
  double                   size = 0.;
  std::vector<std::string> notes{};
};

template <typename Archive>
void exchange(Archive &archive, Made &made)
{
  archive(made.size, made.notes);
}

Made made(const MeshAttempt &attempt, double largest_that_works)
{
  if (attempt.specification.mesh.size > largest_that_works)
    throw NotMeshed("gmsh cannot mesh it");
  return {attempt.specification.mesh.size};
}

FrameSpecification some_frame()
{
  return specification(draw("box.step", [] { gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.); }), 0.09);
}

TEST(MeshAttempts, FallBackToASizeThatWorksAndNoteIt)
{
  const Made mesh = meshed_in_child<Made>(
      some_frame(), {}, [](const MeshAttempt &attempt, const ChildProgress &) { return made(attempt, 0.05); });
  EXPECT_NEAR(mesh.size, 0.04, 1e-12);
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_THAT(mesh.notes[0], AllOf(HasSubstr("size = 40 mm"), HasSubstr("gmsh cannot mesh it")));
}

TEST(MeshAttempts, OutliveAFaultOfGmsh)
{
  const Made mesh = meshed_in_child<Made>(some_frame(), {},
                                          [](const MeshAttempt &attempt, const ChildProgress &progress)
                                          {
                                            progress(mesh_phase::surfaces, -1.);
                                            if (attempt.walls == WallSizes::where_needed)
                                              std::raise(SIGSEGV);
                                            return made(attempt, 1.);
                                          });
  EXPECT_NEAR(mesh.size, 0.09, 1e-12);
  EXPECT_THAT(mesh.notes.at(0), AllOf(HasSubstr("curved faces sized by the thickness"), HasSubstr("signal 11")));
}

TEST(MeshAttempts, ReportTheFirstFailureIfNoneSucceeds)
{
  const auto failure = [](double works, const char *refused)
  {
    return gestell::tests::refusal(
        [&]
        {
          meshed_in_child<Made>(some_frame(), {},
                                [&](const MeshAttempt &attempt, const ChildProgress &)
                                {
                                  if (*refused && attempt.specification.mesh.size < 0.05)
                                    throw std::invalid_argument(refused);
                                  return made(attempt, works);
                                });
        });
  };
  EXPECT_THAT(failure(0., ""), AllOf(HasSubstr("gmsh cannot mesh it"), HasSubstr("8/27")));
  EXPECT_THAT(failure(0., "too many cells"),
              AllOf(HasSubstr("gmsh cannot mesh it"), HasSubstr("size = 40 mm"), HasSubstr("too many cells")));
}

/// The triangles of the tube, as coarse as these sizes make them, cross; a box beside it is sound.
TEST(Mesher, NamesTheSolidThatCannotBeMeshed)
{
  const GmshSession session;
  draw_tube(305., 300., 900.);
  const int box = gmsh::model::occ::addBox(400., 0., 0., 100., 100., 100.);
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 400.);
  gmsh::option::setNumber("Mesh.MinimumCircleNodes", elements_around_circle);
  CadModel model;
  for (const int tag : {1, box})
  {
    model.solids.push_back(measured_solid(tag, 1.));
    model.solids.back().tag  = tag;
    model.solids.back().name = tag == box ? "block" : "shell";
  }
  gmsh::model::mesh::generate(2);
  FrameSpecification frame;
  frame.place = "scene.toml:3: frame";
  EXPECT_THAT(
      gestell::tests::refusal([&] { mesh_volumes(model, frame, session); }),
      AllOf(HasSubstr("gmsh cannot mesh its solid \"shell\""), Not(HasSubstr("block")), HasSubstr("mesh.size")));
}

} // namespace
