// Small things of a drawing: told, and removed on request; cost judged before meshing.

#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace
{

/// A block of 100 x 100 x 20 mm with a bore of 2 mm, one of 40 mm, and a fillet of 1 mm at an edge.
std::string block_with_details()
{
  return draw("details.step",
              []
              {
                namespace occ = gmsh::model::occ;
                gmsh::vectorpair              bored, rounded;
                std::vector<gmsh::vectorpair> map;
                occ::addBox(0., 0., 0., 100., 100., 20., 1);
                occ::addCylinder(50., 50., 0., 0., 0., 20., 20., 2);
                occ::addCylinder(10., 10., 0., 0., 0., 20., 1., 3);
                occ::cut({{3, 1}}, {{3, 2}, {3, 3}}, bored, map);
                occ::synchronize();
                gmsh::vectorpair edges;
                gmsh::model::getEntitiesInBoundingBox(99., -1., 19., 101., 101., 21., edges, 1);
                occ::fillet({bored[0].second}, {edges.at(0).second}, {1.}, rounded);
              });
}

TEST(SmallFeatures, AreReportedWithTheirPlaceWhereTheyForceSmallElements)
{
  const GeometryReport report = report_geometry(specification(block_with_details(), 0.1));
  EXPECT_THAT(report.smallest, AllOf(HasSubstr("shortest edge"), HasSubstr("narrowest face")));
  EXPECT_THAT(report.notes, Contains(HasSubstr("mesh.defeature")));
}

TEST(SmallFeatures, AreRemovedOnRequestAndLargerOnesStay)
{
  FrameSpecification s        = specification(block_with_details(), 0.02);
  const std::size_t  n_before = report_geometry(s).faces.size();
  EXPECT_EQ(n_before, 9u); // six sides, two bores, the fillet
  s.mesh.defeature            = 3e-3;
  s.surfaces["bore"]          = cylinder({0., 0., 1.}, {0.05, 0.05, 0.}, 0.02);
  const GeometryReport report = report_geometry(s);
  EXPECT_EQ(report.faces.size(), 7u);
  ASSERT_EQ(report.solids.size(), 1u);
  const double whole = 0.1 * 0.1 * 0.02 - std::acos(-1.) * 0.02 * 0.02 * 0.02;
  EXPECT_NEAR(report.solids[0].volume, whole, 1e-9 * whole);
  EXPECT_THAT(report.notes, Contains(HasSubstr("mesh.defeature removed 2 of 9 faces; 0 small faces remain")));
}

TEST(SmallFeatures, ThatAreTheModelItselfAreNotRemoved)
{
  FrameSpecification s = specification(block_with_details(), 0.02);
  s.mesh.defeature     = 0.05; // the block is 20 mm thick
  EXPECT_THAT(refusal(s), StartsWith("scene.toml:4: frame.mesh: defeature = 0.05 m"));
}

TEST(SmallFeatures, OfAMeshCannotBeRemoved)
{
  const std::string  cad = draw("box.msh",
                                []
                                {
                                 gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
                                 gmsh::model::occ::synchronize();
                                 gmsh::model::mesh::generate(3);
                               });
  FrameSpecification s   = specification(cad, 0.);
  s.mesh.defeature       = 0.01;
  EXPECT_THAT(refusal(s), HasSubstr("is a mesh already"));
}

TEST(Memory, GrowsFasterThanTheNumberOfCoordinates)
{
  EXPECT_GT(reduction_memory(1e6, 0.1) / reduction_memory(5e5, 0.1), 2.);
  EXPECT_GT(reduction_memory(1e6, 0.3), 2. * reduction_memory(1e6, 0.1)) << "bodies take more than plates";
  EXPECT_NEAR(compactness(8., 24.), 1. / 3., 1e-12) << "of a cube";
  EXPECT_GT(available_memory(), 1e8); // of any machine that has come this far
}

TEST(Memory, IsNotTakenForLessThanWasMeasured)
{
  // docs/develop/benchmarks.md, 40 modes.  Of the press by a tenth more only: else small machines would refuse what
  // they can do.
  struct Measured
  {
    double coordinates, gib, volume, skin;
  };
  const double gib = 1024. * 1024. * 1024.;
  for (const auto &[n, measured, V, A] : {Measured{76332., 0.66, 1.3092, 35.10}, // press
                                          {153765., 1.20, 1.3092, 35.10},
                                          {974907., 8.86, 1.3092, 35.10}})
  {
    EXPECT_GE(reduction_memory(n, compactness(V, A)), measured * gib) << n;
    EXPECT_LE(reduction_memory(n, compactness(V, A)), 1.1 * measured * gib) << n;
  }
  for (const auto &[n, measured, V, A] : {Measured{102900., 0.75, 0.0345, 6.575}, // ladder chassis
                                          {98955., 1.41, 1., 6.},                 // cube
                                          {157260., 2.56, 1., 6.},
                                          {49155., 0.60, 0.4, 8.8},  // plate of 2 x 2 x 0.1 m
                                          {34488., 0.44, 0.2, 2.8}}) // of 1 x 1 x 0.2 m
  {
    EXPECT_GE(reduction_memory(n, compactness(V, A)), 0.95 * measured * gib) << n;
    EXPECT_LE(reduction_memory(n, compactness(V, A)), 1.5 * measured * gib) << n;
  }
}

TEST(Memory, OfAveragedSurfacesComesOnTop)
{
  // a plate of 2 x 2 x 0.05 m, free, 40 modes, one large face averaged; and with its edge averaged instead
  const double kappa = compactness(0.2, 8.4);
  for (const auto &[n, size, face, edge] :
       {std::array{72828., 0.05, 978424., 628732.}, {150207., 0.035, 1855840., 1115512.}})
  {
    const double more = reduction_memory(n, kappa, nodes_on(4., size)) - reduction_memory(n, kappa);
    EXPECT_NEAR(more, 1024. * (face - edge), 0.1 * more) << n;
    EXPECT_NEAR(reduction_memory(n, kappa, nodes_on(4., size)), 1024. * face, 0.2 * 1024. * face) << n;
  }
}

TEST(Memory, ThatIsNotThereIsReportedBeforeMeshing)
{
  const double gib = 1024. * 1024. * 1024.;
  EXPECT_NO_THROW(require_memory("", reduction_memory(1e5, 0.3), 64. * gib, "place", "advice"));
  EXPECT_NO_THROW(require_memory("", reduction_memory(1e9, 0.3), INFINITY, "place", "advice"));
  FrameSpecification s = specification(block_with_details(), 2e-5); // some 1e11 cells
  s.mesh.max_cells     = 1e15;
  EXPECT_THAT(refusal(s), AllOf(StartsWith("scene.toml:4: frame.mesh"), HasSubstr("reduction need about"),
                                HasSubstr("available are"), HasSubstr("Use size = ")));
}

} // namespace
