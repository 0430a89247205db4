// Meshes of CAD models: volume, skin, surfaces, sizes.

#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/mesher.h"
#include "fem/mesh/watched_meshing.h"
#include "fem/values/vector3.h"
#include "tests/support/cad_samples.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;

namespace
{

/// Gauss:  V = 1/3 of the integral of x.n over the skin, exact for plane triangles.
double volume_of_skin(const Mesh &mesh)
{
  double V = 0.;
  for (const auto &[a, b, c] : mesh.skin)
    V += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6.;
  return V;
}

double longest_edge(const Mesh &mesh, const std::string &surface)
{
  double longest = 0.;
  for (const int t : mesh.surfaces.at(surface))
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, norm(mesh.points[mesh.skin[t][i]] - mesh.points[mesh.skin[t][(i + 1) % 3]]));
  return longest;
}

FrameSpecification press(double size)
{
  FrameSpecification s = specification(press_frame(), size);
  s.surfaces           = {{"crown bearing front", cylinder({0., 1., 0.}, {0., -0.52, 2.56}, 0.12)},
                          {"crown bearing rear", cylinder({0., 1., 0.}, {0., 0.52, 2.56}, 0.12)},
                          {"guides left", plane({1., 0., 0.}, {-0.48, 0., 1.78}, 2)},
                          {"guides right", plane({-1., 0., 0.}, {0.48, 0., 1.78}, 2)},
                          {"table", plane({0., 0., 1.}, {0., 0., 0.9}, 3)},
                          {"feet", plane({0., 0., -1.}, {0., 0., 0.}, 4)}};
  return s;
}

TEST(BoxMesh, CellsFillTheBoxInMetresAndItsSkinEnclosesThem)
{
  FrameSpecification s =
      specification(draw("box.step", [] { gmsh::model::occ::addBox(0., 0., 0., 1200., 500., 300.); }), 0.1);
  s.surfaces      = {{"end", plane({-1., 0., 0.}, {0., 0., 0.})}, {"top", plane({0., 0., 2.}, {0.1, 0.2, 0.3})}};
  const Mesh mesh = make_mesh(s);
  EXPECT_NEAR(volume_of_cells(mesh), 1.2 * 0.5 * 0.3, 1e-12);
  for (const auto &cell : mesh.cells)
    ASSERT_GT(six_volumes(mesh, cell), 0.);
  Vector3 sum{}; // the skin is closed
  for (const auto &[a, b, c] : mesh.skin)
    sum = sum + cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
  EXPECT_NEAR(norm(sum), 0., 1e-12);
  EXPECT_NEAR(volume_of_skin(mesh), volume_of_cells(mesh), 1e-12);
  // area times outward normal
  EXPECT_NEAR(norm(area_vector(mesh, "end") - Vector3{-0.15, 0., 0.}), 0., 1e-12);
  EXPECT_NEAR(norm(area_vector(mesh, "top") - Vector3{0., 0., 0.6}), 0., 1e-12);
}

/// A disc of radius 0.5 m and 0.1 m thick with so many sides.
std::string disc_of_sides(int n)
{
  return draw("disc.step",
              [n]
              {
                namespace occ = gmsh::model::occ;
                std::vector<int> points, sides;
                for (int i = 0; i < n; ++i)
                  points.push_back(
                      occ::addPoint(500. * std::cos(2. * M_PI * i / n), 500. * std::sin(2. * M_PI * i / n), 0.));
                for (int i = 0; i < n; ++i)
                  sides.push_back(occ::addLine(points[i], points[(i + 1) % n]));
                gmsh::vectorpair solid;
                occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(sides)})}}, 0., 0., 100., solid);
              });
}

/// Rings of elements around the rim, each 1 + size_growth times the one outside it, hold fewer than 1 / size_growth
/// times the elements of the rim; without them the size holds.
TEST(ManyShortEdges, AroundADiscDoNotMakeItsInsideFine)
{
  const int            n      = 120;
  const GeometryReport report = report_geometry(specification(disc_of_sides(n), 0.2));
  const double         side = 2. * 0.5 * std::sin(M_PI / n), prisms = 0.1 / side; // elements through the thickness
  EXPECT_LT(report.n_cells, report.expected_cells + 10. * n * prisms / size_growth);
  EXPECT_NEAR(report.volume, 0.1 * 0.5 * n * 0.25 * std::sin(2. * M_PI / n), 1e-9);
  EXPECT_GT(report.worst_quality, 0.1);
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(),
                          [](const std::string &note)
                          { return note.find("elements grow from them to the size") != std::string::npos; }));
}

TEST(ManyShortEdges, ThatTheSizeAsksForAreNotReported)
{
  const GeometryReport report = report_geometry(specification(disc_of_sides(120), 0.04));
  EXPECT_TRUE(report.notes.empty()) << report.notes[0];
}

TEST(Circles, HaveTwelveElementsAtLeast)
{
  const std::string cad             = draw("bore.step",
                                           []
                                           {
                                 namespace occ = gmsh::model::occ;
                                 gmsh::vectorpair              left;
                                 std::vector<gmsh::vectorpair> map;
                                 occ::addBox(-500., -500., 0., 1000., 1000., 100., 1);
                                 occ::addCylinder(0., 0., -1., 0., 0., 200., 50., 2);
                                 occ::cut({{3, 1}}, {{3, 2}}, left, map);
                               });
  const double      sides_of_twelve = 0.1 * 0.5 * 12. * 0.05 * 0.05 * std::sin(2. * M_PI / 12.); // of six: 0.87 of it
  EXPECT_NEAR((0.1 - report_geometry(specification(cad, 0.1)).volume) / sides_of_twelve, 1., 0.03);
}

TEST(BoxMesh, UnitOverridesTheMillimetreOfAStepFile)
{
  FrameSpecification s = specification(draw("box.step", [] { gmsh::model::occ::addBox(0., 0., 0., 2., 1., 1.); }), 0.5);
  s.unit               = 1.;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 2., 1e-12);
}

TEST(BoxMesh, PlaneThatTheFileCallsASplineIsFoundAsAPlane)
{
  const std::string  cad = draw("dilated.step",
                                []
                                {
                                 const int box = gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.);
                                 gmsh::model::occ::dilate({{3, box}}, 0., 0., 0., 2., 1., 1.);
                               });
  FrameSpecification s   = specification(cad, 0.05);
  s.surfaces             = {{"end", plane({1., 0., 0.}, {0.2, 0., 0.})}};
  EXPECT_NEAR(norm(area_vector(make_mesh(s), "end") - Vector3{0.01, 0., 0.}), 0., 1e-12);
}

TEST(TwoSolids, WithACommonFaceAreOneMeshWhoseSkinLeavesThatFaceOut)
{
  const std::string cad =
      write_text("two.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
                            "Box(2) = {1, 0, 0, 2, 1, 1};\nCoherence;\n"
                            "Physical Volume(\"short\") = {1};\nPhysical Volume(\"long\") = {2};\n");
  const Mesh mesh = make_mesh(specification(cad, 0.4));
  ASSERT_EQ(mesh.solids, (std::vector<std::string>{"short", "long"}));
  double V[2] = {0., 0.};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    V[mesh.cell_solid[c]] += six_volumes(mesh, mesh.cells[c]) / 6.;
  EXPECT_NEAR(V[0], 1., 1e-12);
  EXPECT_NEAR(V[1], 2., 1e-12);
  EXPECT_NEAR(volume_of_skin(mesh), 3., 1e-12);
  for (const auto &[a, b, c] : mesh.skin)
    EXPECT_FALSE(mesh.points[a][0] == 1. && mesh.points[b][0] == 1. && mesh.points[c][0] == 1.);
}

TEST(MeshFile, KeepsItsGroupsAndAnswersSelectorsByItsTriangles)
{
  const std::string cad =
      draw("tube.msh",
           []
           {
             namespace occ                       = gmsh::model::occ;
             const int                     block = occ::addBox(0., 0., 0., 400., 400., 200.);
             const int                     hole  = occ::addCylinder(200., 200., 0., 0., 0., 200., 100.);
             gmsh::vectorpair              solid;
             std::vector<gmsh::vectorpair> map;
             occ::cut({{3, block}}, {{3, hole}}, solid, map);
             occ::synchronize();
             gmsh::vectorpair faces;
             gmsh::model::getEntitiesInBoundingBox(-1., -1., -1., 401., 401., 1., faces, 2);
             gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {faces.at(0).second}), "bottom");
             gmsh::option::setNumber("Mesh.SaveAll", 1);
             gmsh::option::setNumber("Mesh.MeshSizeMax", 50.);
             gmsh::model::mesh::generate(3);
           });
  FrameSpecification s = specification(cad, 0.);
  s.unit               = 1e-3;
  s.surfaces           = {{"bore", cylinder({0., 0., 1.}, {0.2, 0.2, 0.}, 0.1)},
                          {"bottom", group("bottom")},
                          {"top", plane({0., 0., 1.}, {0., 0., 0.2})}};
  const Mesh mesh      = make_mesh(s);
  EXPECT_NEAR(volume_of_skin(mesh), volume_of_cells(mesh), 1e-12);
  EXPECT_LT(area_vector(mesh, "bottom")[2], -0.12); // 0.16 m^2 less the hole
  EXPECT_NEAR(norm(area_vector(mesh, "bottom") + area_vector(mesh, "top")), 0., 1e-12);
  EXPECT_NEAR(norm(area_vector(mesh, "bore")), 0., 1e-12); // closed around the axis
  for (const int t : mesh.surfaces.at("bore"))
    for (const int point : mesh.skin[t])
      EXPECT_NEAR(std::hypot(mesh.points[point][0] - 0.2, mesh.points[point][1] - 0.2), 0.1, 1e-9);
}

TEST(PressFrame, IsOneSolidOfTenTonsWhoseSurfacesAreFoundInTheExpectedNumber)
{
  const GeometryReport report = report_geometry(press(0.08));
  ASSERT_EQ(report.solids.size(), 1u);
  EXPECT_NEAR(report.solids[0].volume * 7850., 10270., 5.);
  EXPECT_EQ(report.surfaces.at("crown bearing front").size(), 1u);
  EXPECT_EQ(report.surfaces.at("crown bearing rear").size(), 1u);
  EXPECT_NE(report.surfaces.at("crown bearing front"), report.surfaces.at("crown bearing rear"));
  EXPECT_EQ(report.surfaces.at("table").size(), 3u);
  EXPECT_EQ(report.surfaces.at("feet").size(), 4u);
  EXPECT_GT(report.n_coordinates, 100000);
  EXPECT_LT(report.n_coordinates, 160000);
  EXPECT_GT(report.worst_quality, 0.15); // gmsh alone leaves slivers of 0.06
}

TEST(PressFrame, SkinEnclosesTheCellsAndItsPlanesHaveTheirCadArea)
{
  const Mesh   mesh = make_mesh(press(0.1));
  const double V    = volume_of_cells(mesh);
  EXPECT_NEAR(volume_of_skin(mesh), V, 1e-10 * V);
  EXPECT_NEAR(norm(area_vector(mesh, "feet") - Vector3{0., 0., -4 * 0.32 * 0.30}), 0., 1e-10);
  EXPECT_NEAR(norm(area_vector(mesh, "guides left") - Vector3{2 * 0.14 * 0.68, 0., 0.}), 0., 1e-10);
}

TEST(PressFrame, MeshIsFineOnTheBearingsAndCoarseElsewhere)
{
  FrameSpecification s                   = press(0.1);
  const std::size_t  n_coarse            = make_mesh(s).cells.size();
  s.mesh.surface_size["crown bearing *"] = 0.03;
  const Mesh mesh                        = make_mesh(s);
  EXPECT_LT(longest_edge(mesh, "crown bearing front"), 1.6 * 0.03); // a Delaunay mesh keeps edges below sqrt(2) size
  EXPECT_LT(longest_edge(mesh, "crown bearing rear"), 1.6 * 0.03);
  EXPECT_GT(longest_edge(mesh, "feet"), 0.07);
  EXPECT_GT(mesh.cells.size(), n_coarse);
  EXPECT_LT(mesh.cells.size(), 2 * n_coarse);
}

TEST(PressFrame, EqualInputGivesAnEqualMesh)
{
  const Mesh a = make_mesh(press(0.1)), b = make_mesh(press(0.1));
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.skin, b.skin);
  EXPECT_EQ(a.surfaces, b.surfaces);
}

TEST(PressFrame, HasTheExpectedNumberOfCellsWithinAFactorOfOneAndAHalf)
{
  for (const double size : {0.12, 0.08})
  {
    const GeometryReport report = report_geometry(press(size));
    CadModel             model;
    model.solids          = report.solids;
    model.faces           = report.faces;
    const double expected = expected_cells(model, size, {}, {});
    EXPECT_LT(report.n_cells, 1.5 * expected) << size;
    EXPECT_GT(report.n_cells, expected / 1.5) << size;
  }
}

TEST(CellQuality, OfABlockWithAMisplacedPointIsRepairedWithoutChangingTheBlock)
{
  Mesh mesh; // the cube [-1, 1]^3: six faces of two triangles, joined with a point inside
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
  mesh.points.push_back({0.999, 0.9, 0.9});
  for (const auto &[a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for (std::array<int, 4> cell : {std::array<int, 4>{a, b, c, 8}, std::array<int, 4>{a, c, d, 8}})
    {
      if (six_volumes(mesh, cell) < 0.)
        std::swap(cell[0], cell[1]);
      mesh.cells.push_back(cell);
    }
  const auto           corners = std::vector<Point3>(mesh.points.begin(), mesh.points.end() - 1);
  std::vector<Freedom> freedom(9);
  freedom[8] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};

  improve_quality(mesh, freedom);

  EXPECT_EQ(std::vector<Point3>(mesh.points.begin(), mesh.points.end() - 1), corners);
  EXPECT_NEAR(volume_of_cells(mesh), 8., 1e-12);
  for (const auto &cell : mesh.cells)
    EXPECT_GT(quality(mesh, cell), 0.3);
}

TEST(CellQuality, IsOneForTheRegularTetrahedronAndZeroForAFlatOne)
{
  Mesh mesh;
  mesh.points = {{1., 1., 1.}, {1., -1., -1.}, {-1., 1., -1.}, {-1., -1., 1.}, {0., 0., -1.}};
  EXPECT_NEAR(quality(mesh, {0, 1, 3, 2}), 1., 1e-14);
  mesh.points[0] = mesh.points[1] + mesh.points[2] - mesh.points[3];
  EXPECT_NEAR(quality(mesh, {0, 1, 3, 2}), 0., 1e-10);
}

double volume_in_gmsh()
{
  constexpr int            tetrahedron = 4;
  std::vector<std::size_t> tags, nodes, all;
  std::vector<double>      x, parameters;
  gmsh::model::mesh::getElementsByType(tetrahedron, tags, nodes);
  gmsh::model::mesh::getNodes(all, x, parameters);
  std::map<std::size_t, Vector3> point;
  for (std::size_t k = 0; k < all.size(); ++k)
    point[all[k]] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
  double V = 0.;
  for (std::size_t k = 0; k < nodes.size(); k += 4)
  {
    const auto edge = [&](int i) { return point.at(nodes[k + i]) - point.at(nodes[k]); };
    V += std::abs(dot(edge(1), cross(edge(2), edge(3)))) / 6.;
  }
  return V;
}

// No geometry is known that Delaunay's method of gmsh fails at and HXT does not; so the first attempt fails by order,
// with one of two solids meshed.
TEST(Mesher, TakesTheFastMethodWhereDelaunayFailsAndSaysSo)
{
  const GmshSession session;
  CadModel          model;
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
  gmsh::model::occ::addBox(2., 0., 0., 1., 1., 2.);
  gmsh::model::occ::synchronize();
  gmsh::model::mesh::generate(2);
  const auto fails = []
  {
    gmsh::model::mesh::generate(3);
    gmsh::model::mesh::clear({{3, 2}});
    throw std::runtime_error("PLC Error:  A segment and a facet intersect at point");
  };
  mesh_volumes(model, FrameSpecification(), session, fails);
  EXPECT_NEAR(volume_in_gmsh(), 3., 1e-12);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("Delaunay method cannot mesh the volume (PLC Error"), std::string::npos);
  EXPECT_NE(model.notes[0].find("HXT"), std::string::npos);

  double method;
  gmsh::option::getNumber("Mesh.Algorithm3D", method);
  EXPECT_EQ(method, 1.) << "the next mesh is Delaunay's again";
  gmsh::model::mesh::clear();
  gmsh::model::mesh::generate(2);
  mesh_volumes(model, FrameSpecification(), session);
  EXPECT_NEAR(volume_in_gmsh(), 3., 1e-12);
  EXPECT_EQ(model.notes.size(), 1u);
}

TEST(Mesher, MeshesTheSurfacesByAnotherMethodBeforeTheFastOne)
{
  const GmshSession session;
  CadModel          model;
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
  gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
  gmsh::model::occ::synchronize();
  gmsh::model::mesh::generate(2);
  std::vector<double> methods;
  const auto          fails_once = [&]
  {
    methods.emplace_back();
    gmsh::option::getNumber("Mesh.Algorithm", methods.back());
    if (methods.size() == 1u)
      throw std::runtime_error("Invalid boundary mesh (overlapping facets)");
    gmsh::model::mesh::generate(3);
  };
  mesh_volumes(model, FrameSpecification(), session, fails_once);
  EXPECT_EQ(methods.size(), 2u);
  EXPECT_EQ(methods.front(), methods.back()) << "the option is as before";
  EXPECT_NEAR(volume_in_gmsh(), 1., 1e-12);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("(Invalid boundary mesh (overlapping facets)); it succeeded after"), std::string::npos);
}

} // namespace
