// Walls of a solid swept through their thickness.

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/curved_sides.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesher.h"
#include "fem/values/vector3.h"
#include "tests/support/cad_samples.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

namespace
{

namespace occ = gmsh::model::occ;

/// Joins all solids drawn so far.
void unite()
{
  gmsh::vectorpair solids, result;
  occ::synchronize();
  gmsh::model::getEntities(solids, 3);
  std::vector<gmsh::vectorpair> map;
  occ::fuse({solids.front()}, {solids.begin() + 1, solids.end()}, result, map);
}

/// Two plates of 8 mm at right angles, in mm.
void angle()
{
  occ::addBox(0., 0., 0., 400., 80., 8.);
  occ::addBox(0., 0., 0., 400., 8., 80.);
  unite();
}
constexpr double angle_volume = 1e-9 * 400. * (80. * 8. + 72. * 8.);

/// A plate of 400 x 200 x 8 mm with holes of 60 and 24 mm.
void bored_plate()
{
  occ::addBox(0., 0., 0., 400., 200., 8.);
  gmsh::vectorpair              result;
  std::vector<gmsh::vectorpair> map;
  const int                     wide = occ::addCylinder(100., 100., -1., 0., 0., 10., 30.);
  const int                     slim = occ::addCylinder(300., 60., -1., 0., 0., 10., 12.);
  occ::cut({{3, 1}}, {{3, wide}, {3, slim}}, result, map);
}

/// Of regular polygons of 16 sides in place of the circles.
constexpr double bored_volume()
{
  const double polygon = 8. * 0.3826834323650898; // n / 2 sin(2 pi / n), n = 16
  return 1e-9 * 8. * (400. * 200. - polygon * (30. * 30. + 12. * 12.));
}

void turn()
{
  gmsh::vectorpair solids;
  occ::synchronize();
  gmsh::model::getEntities(solids, 3);
  occ::rotate(solids, 10., 20., 30., 1., 2., 3., 0.7);
}

FrameSpecification swept(const std::string &cad, double size)
{
  FrameSpecification s = specification(cad, size);
  s.mesh.plates        = Plates::swept;
  return s;
}

double largest_side(const Mesh &mesh)
{
  double largest = 0.;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (const auto &[a, b] : cell_shape(mesh.kind(cell)).edges)
      largest = std::max(largest, norm(mesh.points[mesh.corners(cell)[b]] - mesh.points[mesh.corners(cell)[a]]));
  return largest;
}

TEST(SweptPlates, KnowNoAxesButTheirOwn)
{
  const Mesh straight = make_mesh(swept(draw("angle.step", angle), 0.1));
  const Mesh turned   = make_mesh(swept(draw("turned.step", [] { angle(), turn(); }), 0.1));
  EXPECT_EQ(turned.hexahedra.size(), straight.hexahedra.size());
  EXPECT_EQ(turned.points.size(), straight.points.size());
  EXPECT_NEAR(curved_volume(turned), angle_volume, 1e-9 * angle_volume); // a STEP file has some ten digits
}

TEST(SweptPlates, AreNarrowerAlongEdgesThanTheyAreThick)
{
  const Mesh mesh = make_mesh(swept(draw("angle.step", angle), 0.2));
  double     next = 1.; // cell to the end at x = 0
  for (const Point3 &p : mesh.points)
    if (p[0] > 1e-9)
      next = std::min(next, p[0]);
  EXPECT_NEAR(next, 0.7 * 8e-3, 1e-9);
}

TEST(SweptPlates, TakeTheCutsOfARibOnlyWhereTheyHangTogether)
{
  // Two separate plates: the rib on one does not divide the other.
  const auto plates = [](bool rib)
  {
    return [rib]
    {
      occ::addBox(0., 0., 0., 400., 100., 8.);
      occ::addBox(0., 0., 50., 400., 100., 8.);
      if (rib)
      {
        occ::addBox(150., 0., 8., 8., 100., 20.);
        gmsh::vectorpair              result;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, 1}}, {{3, 3}}, result, map);
      }
    };
  };
  FrameSpecification plain  = swept(draw("plates.step", plates(false)), 0.1),
                     ribbed = swept(draw("ribbed.step", plates(true)), 0.1);
  plain.mesh.bodies = ribbed.mesh.bodies = 2;
  const auto above                       = [](const Mesh &mesh)
  { return std::count_if(mesh.points.begin(), mesh.points.end(), [](const Point3 &p) { return p[2] > 0.045; }); };
  EXPECT_EQ(above(make_mesh(ribbed)), above(make_mesh(plain)));
  EXPECT_GT(make_mesh(ribbed).points.size(), make_mesh(plain).points.size());
}

TEST(SweptPlates, WithBoresAreSweptAroundThem)
{
  FrameSpecification s = swept(draw("bored.step", bored_plate), 0.1);
  s.surfaces = {{"bore", cylinder({0., 0., 1.}, {0.1, 0.1, 0.}, 0.03)}, {"top", plane({0., 0., 1.}, {0., 0., 0.008})}};
  const Mesh mesh = make_mesh(s);
  EXPECT_TRUE(mesh.cells.empty());
  EXPECT_NEAR(curved_volume(mesh), bored_volume(), 1e-9 * bored_volume());
  EXPECT_NEAR(area_vector(mesh, "top")[2], bored_volume() / 8e-3, 1e-9);
  EXPECT_EQ(mesh.surfaces.at("bore").size(), 2u * 16u); // triangles, two to a side
  for (const int t : mesh.surfaces.at("bore"))
    for (const int point : mesh.skin[t])
      EXPECT_NEAR(std::hypot(mesh.points[point][0] - 0.1, mesh.points[point][1] - 0.1), 0.03, 1e-9);
}

TEST(SweptPlates, HaveCellsThatDoNotFold)
{
  const Mesh mesh = make_mesh(swept(draw("bored_turned.step", [] { bored_plate(), turn(); }), 0.1));
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    ASSERT_GT(corner_quality(mesh, cell), 0.1);
}

TEST(SweptPlates, HaveTheVolumeOfTheSolidAndItsFacesAsTheFileHasThem)
{
  FrameSpecification s = swept(draw("angle.step", angle), 0.1);
  s.surfaces           = {{"foot", plane({0., 0., -1.}, {0., 0., 0.})}, {"end", plane({1., 0., 0.}, {0.4, 0., 0.})}};
  const Mesh mesh      = make_mesh(s);
  EXPECT_TRUE(mesh.cells.empty());
  EXPECT_FALSE(mesh.hexahedra.empty());
  EXPECT_NEAR(curved_volume(mesh), angle_volume, 1e-12 * angle_volume);
  EXPECT_LE(largest_side(mesh), 0.1 * (1. + 1e-9));
  EXPECT_NEAR(area_vector(mesh, "foot")[2], -0.4 * 0.08, 1e-12);
  EXPECT_NEAR(area_vector(mesh, "end")[0], angle_volume / 0.4, 1e-12);
}

TEST(SweptPlates, AreFinerOnSurfacesWithASize)
{
  FrameSpecification s = swept(draw("angle.step", angle), 0.2);
  s.surfaces           = {{"foot", plane({0., 0., -1.}, {0., 0., 0.})}};
  s.mesh.surface_size  = {{"foot", 0.02}};
  EXPECT_LE(largest_side(make_mesh(s)), 0.072); // x as on the foot; up the other plate without
}

TEST(SweptPlates, KeepTheirSolidsApart)
{
  FrameSpecification s    = swept(draw("two.step",
                                       []
                                       {
                                      occ::addBox(0., 0., 0., 400., 80., 8.);
                                      occ::addBox(100., 0., 8., 100., 80., 20.);
                                    }),
                                  0.1);
  const Mesh         mesh = make_mesh(s);
  ASSERT_EQ(mesh.solids.size(), 2u);
  double     of[2]  = {0., 0.};
  const auto pieces = tetrahedra_of(mesh);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    of[mesh.cell_solid[i / 6]] += six_volumes(mesh, pieces[i]) / 6.;
  EXPECT_NEAR(of[0], 1e-9 * 400. * 80. * 8., 1e-15);
  EXPECT_NEAR(of[1], 1e-9 * 100. * 80. * 20., 1e-15);
}

/// A pin in a bore of the plate has a mesh of its own, with the area of its circle.
TEST(SweptPlates, MayHaveASolidInAHole)
{
  const auto plugged = []
  {
    occ::addBox(0., 0., 0., 400., 200., 8.);
    const int                     pin = occ::addCylinder(100., 100., 0., 0., 0., 8., 30.);
    gmsh::vectorpair              result;
    std::vector<gmsh::vectorpair> map;
    occ::fragment({{3, 1}}, {{3, pin}}, result, map);
  };
  const Mesh mesh = make_mesh(swept(draw("plugged.step", plugged), 0.1));
  ASSERT_EQ(mesh.solids.size(), 2u);
  EXPECT_TRUE(mesh.only_tetrahedra() == false && mesh.cells.empty());
  EXPECT_EQ(mesh.ties.size(), 1u);
  const double polygon = 8. * 0.3826834323650898 * 30. * 30., circle = M_PI * 30. * 30.;
  const double volume = 1e-9 * 8. * (400. * 200. - polygon + circle);
  EXPECT_NEAR(curved_volume(mesh), volume, 1e-5 * volume);
}

TEST(SweptPlates, HaveBoresThroughSeveralSolids)
{
  // The region around the bore takes all of the upper solid; the section of the lower one has the area of the circle.
  const double volume = 1e-9 * 10. * (1e4 + 3600. - (8. * 0.3826834323650898 + M_PI) * 15. * 15.);
  const Mesh   mesh   = make_mesh(swept(draw("stacked.step",
                                             []
                                             {
                                           occ::addBox(0., 0., 0., 100., 100., 10.);
                                           occ::addBox(20., 20., 10., 60., 60., 10.);
                                           gmsh::vectorpair              result;
                                           std::vector<gmsh::vectorpair> map;
                                           const int bore = occ::addCylinder(50., 50., -5., 0., 0., 40., 15.);
                                           occ::cut({{3, 1}, {3, 2}}, {{3, bore}}, result, map);
                                         }),
                                        0.05));
  EXPECT_EQ(mesh.solids.size(), 2u);
  EXPECT_TRUE(mesh.cells.empty()) << mesh.notes.front();
  EXPECT_NEAR(curved_volume(mesh), volume, 1e-6 * volume);
}

TEST(SweptPlates, GoThroughTheThicknessInLayers)
{
  FrameSpecification s = swept(draw("angle.step", angle), 0.1);
  s.mesh.layers        = 2;
  std::vector<double> z;
  for (const Point3 &p : make_mesh(s).points)
    if (p[2] < 8e-3 - 1e-9 && p[2] > 1e-9)
      z.push_back(p[2]);
  ASSERT_FALSE(z.empty());
  for (const double level : z)
    EXPECT_NEAR(level, 4e-3, 1e-12);
}

TEST(SweptPlates, BecomeTetrahedraWhereAFaceIsOblique)
{
  FrameSpecification s    = swept(draw("wedge.step",
                                       []
                                       {
                                      angle();
                                      occ::addWedge(100., 0., 0., 40., 60., 60., -1, 0.);
                                      unite();
                                    }),
                                  0.05);
  const Mesh         mesh = make_mesh(s);
  EXPECT_TRUE(mesh.only_tetrahedra());
  EXPECT_THAT(mesh.notes, Contains(AllOf(HasSubstr("plates are meshed with tetrahedra instead of swept"),
                                         HasSubstr("face "), HasSubstr("normal"))));
}

TEST(SweptPlates, ReportWhatWasFound)
{
  FrameSpecification   s      = swept(draw("bored.step", bored_plate), 0.);
  const GeometryReport report = report_geometry(s);
  EXPECT_THAT(report.statements, Contains(AllOf(HasSubstr("plates are meshed by sweeping: 1 wall, 8 mm thick"),
                                                HasSubstr("2 regions around holes"))));
  EXPECT_EQ(report.n_of_kind[0], 0u);
  EXPECT_GT(report.n_of_kind[1], 0u);
}

} // namespace
