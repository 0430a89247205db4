// Sides that follow the geometry: areas, volumes and stiffness converge faster; folded cells are straightened.

#include "fem/assembly/elasticity.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/surface_patch.h"
#include "fem/mesh/curved_sides.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

namespace
{

const double pi = std::acos(-1.);

/// A tube of radii 30 and 50 mm, 40 mm long.
std::string tube()
{
  return draw("tube.step",
              []
              {
                gmsh::vectorpair              bored;
                std::vector<gmsh::vectorpair> map;
                gmsh::model::occ::addCylinder(0., 0., 0., 0., 0., 40., 50., 1);
                gmsh::model::occ::addCylinder(0., 0., 0., 0., 0., 40., 30., 2);
                gmsh::model::occ::cut({{3, 1}}, {{3, 2}}, bored, map);
              });
}

Mesh mesh_of_tube(double size, bool curved)
{
  FrameSpecification s = specification(tube(), size);
  s.mesh.curved        = curved;
  s.surfaces["bore"]   = cylinder({0., 0., 1.}, {0., 0., 0.}, 0.03);
  return make_mesh(s);
}

double mass_of(const QuadraticMesh &mesh, double rho)
{
  CellValues values(mesh, CellPoints::rule);
  double     mass = 0.;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    mass += mass_matrix(values.of(cell), rho).sum();
  return mass;
}

TEST(CurvedSides, GiveVolumeMassAndAreaOfATubeToFourthOrder)
{
  const double volume = pi * (0.05 * 0.05 - 0.03 * 0.03) * 0.04, area = 2. * pi * 0.03 * 0.04;
  double       error_of_volume[2], error_of_area[2];
  const double sizes[2] = {0.01, 0.005}; // above, curvature sets the size
  for (int i = 0; i < 2; ++i)
  {
    const Mesh          mesh      = mesh_of_tube(sizes[i], true);
    const QuadraticMesh quadratic = quadratic_mesh(mesh);
    const SurfacePatch  bore      = surface_patch(mesh, quadratic, {"bore"}, "bore", "here");
    error_of_volume[i]            = std::abs(curved_volume(mesh) / volume - 1.);
    error_of_area[i]              = std::abs(bore.area / area - 1.);
    EXPECT_NEAR(mass_of(quadratic, 1.), curved_volume(mesh), 1e-12 * volume);
    EXPECT_NEAR(bore.centroid.norm(), 0.02, 1e-5);
  }
  EXPECT_LT(error_of_volume[1], 1e-4);
  EXPECT_LT(error_of_area[1], 1e-4);
  // An arc of n sides through middles is off by the fourth power of the size; free meshes halve unevenly.
  EXPECT_GT(error_of_volume[0] / error_of_volume[1], 8.);
  EXPECT_GT(error_of_area[0] / error_of_area[1], 8.);

  const double straight = std::abs(curved_volume(mesh_of_tube(sizes[0], false)) / volume - 1.);
  EXPECT_GT(straight, 10. * error_of_volume[0]); // of second order
}

/// The cavity of a ball in a block, in cells as long as its radius; a shaft.  (Both circles of a tube miss nearly the
/// same.)
TEST(CurvedSides, MassThatStraightSidesAddOrMissIsNotedWithTheRemedy)
{
  const std::string  block = draw("cavity.step",
                                  []
                                  {
                                   gmsh::vectorpair              hollow;
                                   std::vector<gmsh::vectorpair> map;
                                   gmsh::model::occ::addBox(-50., -50., -50., 100., 100., 100., 1);
                                   gmsh::model::occ::addSphere(0., 0., 0., 40., 2);
                                   gmsh::model::occ::cut({{3, 1}}, {{3, 2}}, hollow, map);
                                 });
  FrameSpecification s     = specification(block, 0.04);
  const Mesh         rough = make_mesh(s);
  const double       share = curved_volume(rough) / (1e-3 - 4. / 3. * pi * 0.04 * 0.04 * 0.04) - 1.;
  EXPECT_GT(share, 0.01) << "the test needs a coarse mesh";
  EXPECT_THAT(rough.notes, Contains(AllOf(HasSubstr(text(100. * share) + " % more mass than the geometry"),
                                          HasSubstr("curved = true"))));
  s.mesh.curved = true;
  EXPECT_THAT(make_mesh(s).notes, Not(Contains(HasSubstr("mass than the geometry"))));

  const std::string shaft = draw("shaft.step", [] { gmsh::model::occ::addCylinder(0., 0., 0., 0., 0., 40., 30., 1); });
  EXPECT_THAT(make_mesh(specification(shaft, 0.02)).notes, Contains(HasSubstr("less mass than the geometry")));
}

TEST(CurvedSides, KeepRigidMotionsFreeOfEnergy)
{
  const QuadraticMesh mesh = quadratic_mesh(mesh_of_tube(0.02, true));
  const Material      steel{210e9, 0.3, 7850., "", ""};
  CellValues          values(mesh, CellPoints::rule);
  ASSERT_FALSE(mesh.curved.empty());
  for (int cell = 0; cell < mesh.n_cells(); cell += 7)
  {
    const Eigen::MatrixXd C = stiffness_matrix(values.of(cell), steel);
    Eigen::VectorXd       u(30);
    for (int a = 0; a < 10; ++a) // a turn about the z axis and a motion along it
    {
      const Point3 &x     = mesh.points[mesh.cells[cell][a]];
      u.segment<3>(3 * a) = Eigen::Vector3d(-x[1], x[0], 0.05);
    }
    EXPECT_LT((C * u).cwiseAbs().maxCoeff(), 1e-12 * C.cwiseAbs().maxCoeff());
  }
}

TEST(CurvedSides, ThatWouldFoldCellsAreStraightened)
{
  Mesh mesh;
  mesh.points          = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 0.1}};
  mesh.cells           = {{0, 1, 2, 3}};
  mesh.middles[{0, 1}] = {0.5, 0., 0.005}; // the cell is 0.05 high there
  unfold(mesh);
  EXPECT_TRUE(mesh.notes.empty());
  EXPECT_EQ(mesh.middles.size(), 1u);
  mesh.middles[{0, 1}] = {0.5, 0., 0.2};
  unfold(mesh);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("1 of")));
  const double left = mesh.middles.empty() ? 0. : mesh.middles.at({0, 1})[2];
  EXPECT_LT(left, 0.1);
  EXPECT_GT(curved_volume(mesh), 0.);
}

TEST(CurvedSides, ThatAreOnlyHalvedCountOnce)
{
  Mesh mesh;
  mesh.points          = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 0.1}, {0., 0., -5.}};
  mesh.cells           = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  mesh.middles[{0, 1}] = {0.5, 0., 0.04}; // half of it does not fold the cell
  mesh.middles[{2, 4}] = {0., 0.5, -2.51};
  unfold(mesh);
  EXPECT_EQ(mesh.middles.size(), 2u);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("1 of 2 curved edges are straightened")));
}

TEST(QuadraticMeshFile, KeepsItsCurvedSides)
{
  for (const double version : {2.2, 4.1})
  {
    const std::string cad    = draw("tube.msh",
                                    [version]
                                    {
                                   gmsh::vectorpair              bored;
                                   std::vector<gmsh::vectorpair> map;
                                   gmsh::model::occ::addCylinder(0., 0., 0., 0., 0., 0.04, 0.05, 1);
                                   gmsh::model::occ::addCylinder(0., 0., 0., 0., 0., 0.04, 0.03, 2);
                                   gmsh::model::occ::cut({{3, 1}}, {{3, 2}}, bored, map);
                                   gmsh::model::occ::synchronize();
                                   gmsh::option::setNumber("Mesh.MeshSizeMax", 0.01);
                                   gmsh::option::setNumber("Mesh.MshFileVersion", version);
                                   gmsh::model::mesh::generate(3);
                                   gmsh::model::mesh::setOrder(2);
                                 });
    const double      volume = pi * (0.05 * 0.05 - 0.03 * 0.03) * 0.04;
    const Mesh        mesh   = make_mesh(specification(cad, 0.));
    EXPECT_NEAR(curved_volume(mesh), volume, 1e-4 * volume) << version;
    EXPECT_FALSE(mesh.middles.empty());
    for (const std::string &note : mesh.notes)
      EXPECT_THAT(note, ::testing::Not(HasSubstr("not part of a cell")));
  }
}

} // namespace
