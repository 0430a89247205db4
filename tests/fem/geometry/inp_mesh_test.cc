// Meshes of Abaqus and CalculiX, and what is wrong with meshes: each is told with its place and the way out.

#include "fem/geometry/inp/inp_file.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesher.h"
#include "fem/values/vector3.h"
#include "tests/support/cad_samples.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace
{

/// Nodes of the cube [x, x + 1] x [0, 1]^2, numbered from `first` by bits of x, y, z.
std::string nodes_of_cube(int first, double x)
{
  std::ostringstream text;
  text << "*NODE\n";
  for (int i = 0; i < 8; ++i)
    text << first + i << ", " << x + (i & 1) << ", " << (i >> 1 & 1) << ", " << (i >> 2) << "\n";
  return text.str();
}

/// Its six tetrahedra along the diagonal from bit pattern 0 to 7.
std::string cells_of_cube(int first_cell, int first_node, const std::string &set)
{
  std::ostringstream text;
  text << "*ELEMENT, TYPE=C3D4, ELSET=" << set << "\n";
  const int paths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
  for (int c = 0; c < 6; ++c)
    text << first_cell + c << ", " << first_node << ", " << first_node + paths[c][0] << ", " << first_node + paths[c][1]
         << ", " << first_node + 7 << "\n";
  return text.str();
}

std::string cube()
{
  return "** a cube\n*HEADING\n a cube\n" + nodes_of_cube(1, 0.) + cells_of_cube(1, 1, "Block") +
         "*NSET, NSET=Foot\n1, 2,\n3, 4\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=steel\n*MATERIAL, NAME=steel\n*ELASTIC\n"
         "210000, 0.3\n";
}

std::string inp_refusal(const std::string &text)
{
  return refusal(specification(write_text("mesh.inp", text), 0.));
}

TEST(InpMesh, IsTakenWithItsSolidsAndItsNodeSetsAsSurfaces)
{
  FrameSpecification s = specification(write_text("cube.inp", cube()), 0.);
  s.surfaces["foot"]   = group("FOOT");
  s.surfaces["right"]  = plane({1., 0., 0.}, {1., 0., 0.}); // surfaces come from the skin's sharp edges
  const Mesh mesh      = make_mesh(s);
  EXPECT_NEAR(volume_of_cells(mesh), 1., 1e-14);
  EXPECT_EQ(mesh.solids, std::vector<std::string>{"BLOCK"});
  EXPECT_NEAR(norm(area_vector(mesh, "foot") - Vector3{0., 0., -1.}), 0., 1e-14);
  EXPECT_NEAR(norm(area_vector(mesh, "right") - Vector3{1., 0., 0.}), 0., 1e-14);
}

TEST(InpMesh, InMillimetresIsScaledByItsUnit)
{
  std::string text = nodes_of_cube(1, 0.) + cells_of_cube(1, 1, "A");
  for (const std::string from : {", 1"}) // 1 becomes 1000
    for (std::size_t at = text.find(from + "\n"); at < text.find("*ELEMENT"); at = text.find(from + "\n", at + 6))
      text.replace(at, from.size(), ", 1.0D3");
  FrameSpecification s = specification(write_text("mm.inp", text), 0.);
  s.unit               = 1e-3;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 1e-6, 1e-18); // 1 mm x 1 mm x 1 m
}

TEST(InpMesh, TakesSurfacesOfElementSides)
{
  // Side S1 of a tetrahedron has its first three nodes: 1, 2, 4 and 1, 3, 4 are the bottom.
  const std::string  surface = "*ELSET, ELSET=LOW, GENERATE\n1, 3, 2\n*SURFACE, NAME=bottom, TYPE=ELEMENT\nLOW, S1\n";
  FrameSpecification s       = specification(write_text("cube.inp", cube() + surface), 0.);
  s.surfaces["bottom"]       = group("BOTTOM");
  EXPECT_NEAR(norm(area_vector(make_mesh(s), "bottom") - Vector3{0., 0., -1.}), 0., 1e-14);
  for (const std::string kind : {"NSET", "ELSET"}) // which would take all memory
    EXPECT_THAT(inp_refusal(cube() + "*" + kind + ", " + kind + "=ALL, GENERATE\n1, 18446744073709551615\n"),
                AllOf(HasSubstr("mesh.inp:"), HasSubstr("GENERATE from 1 to 18446744073709551615 names more"),
                      HasSubstr(kind == "NSET" ? "nodes than the 8 there are" : "elements than the 6 there are")));
  EXPECT_THAT(inp_refusal(cube() + "*NSET, NSET=ALL, GENERATE\n8, 1\n"), HasSubstr("from 8 to 1"));
  EXPECT_THAT(inp_refusal(cube() + "*SURFACE, NAME=X\n1, S5\n"), HasSubstr("S5 is not a side of element 1"));
}

TEST(InpMesh, OfSolidSectionsNamesSolidsByThem)
{
  std::string text = nodes_of_cube(1, 0.) + cells_of_cube(1, 1, "ALL") +
                     "*ELSET, ELSET=HALF, GENERATE\n1, 3\n*ELSET, ELSET=REST\n4, 5, 6\n"
                     "*SOLID SECTION, ELSET=HALF, MATERIAL=A\n*SOLID SECTION, ELSET=REST, MATERIAL=B\n";
  const Mesh mesh = make_mesh(specification(write_text("two.inp", text), 0.));
  EXPECT_EQ(mesh.solids, (std::vector<std::string>{"HALF", "REST"}));
}

TEST(InpMesh, OfQuadraticTetrahedraComesInTheOrderOfGmsh)
{
  // Corners 1-4; in Abaqus node 9 stands between corners 2 and 4, node 10 between 3 and 4; in gmsh it is the reverse.
  const std::string text = "*Node\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.5,.5,0\n7,0,.5,0\n8,0,0,.5\n"
                           "9,.5,0,.5\n10,0,.5,.5\n*Element, type=C3D10\n1, 1,2,3,4,5,6,7,\n8,9,10\n";
  const std::string path = write_text("quadratic.inp", text);
  const InpMesh     mesh = read_inp({path, 0., "here"});
  ASSERT_EQ(mesh.elements.size(), 1u);
  EXPECT_EQ(mesh.elements[0].nodes, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8, 10, 9}));
  EXPECT_NEAR(volume_of_cells(make_mesh(specification(path, 0.))), 1. / 6., 1e-15);
}

/// Two tetrahedra with a curved edge between corners 2 and 3, their middle nodes in the order given for each.
std::string curved_tetrahedra(const std::array<std::string, 2> &middles)
{
  return "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,.5,0,0\n6,.6,.6,0\n7,0,.5,0\n8,0,0,.5\n9,.5,0,.5\n10,0,.5,.5\n"
         "11,0,0,-1\n12,0,0,-.5\n13,.5,0,-.5\n14,0,.5,-.5\n*ELEMENT, TYPE=C3D10, ELSET=UP\n1, 1,2,3,4," +
         middles[0] + "\n*ELEMENT, TYPE=C3D10, ELSET=DOWN\n2, 1,3,2,11," + middles[1] + "\n";
}

TEST(InpMesh, WithMiddleNodesInTheOrderOfAnotherProgramTakesThemForTheEdgesTheyLieOn)
{
  const std::array<std::string, 2> of_abaqus = {"5,6,7,8,9,10", "7,6,5,12,14,13"},
                                   of_gmsh   = {"5,6,7,8,10,9", "7,6,5,12,13,14"};
  const auto report_of                       = [](const std::string &text)
  { return report_geometry(specification(write_text("middles.inp", text), 0.)); };
  const GeometryReport right = report_of(curved_tetrahedra(of_abaqus)), other = report_of(curved_tetrahedra(of_gmsh));
  EXPECT_GT(right.volume, 1.1 / 3.); // of straight tetrahedra it is 1/3
  EXPECT_EQ(other.volume, right.volume);
  EXPECT_THAT(other.notes, ElementsAre(HasSubstr("not in the order of Abaqus")));
  EXPECT_TRUE(right.notes.empty());
  EXPECT_NEAR(right.solids.at(0).volume + right.solids.at(1).volume, right.volume, 1e-15);
  EXPECT_THAT(inp_refusal(curved_tetrahedra({of_abaqus[0], of_gmsh[1]})),
              AllOf(HasSubstr("middle nodes of element 2"), HasSubstr("any order common to all elements")));
}

TEST(InpMesh, TellsTheKeywordsThatAreNotRead)
{
  const std::string path = write_text("steps.inp", cube() + "*BOUNDARY\nFOOT, 1, 3\n*STEP\n*STATIC\n*END STEP\n");
  EXPECT_THAT(read_inp({path, 0., "here"}).notes,
              ElementsAre("*BOUNDARY, *ELASTIC, *END STEP, *MATERIAL, *STATIC, *STEP are not read: the file gives the "
                          "mesh, the scene gives material, supports and loads"));
}

TEST(InpMesh, OfSeveralKindsOfCellsIsRefusedWithTheNumberOfEach)
{
  const std::string brick = nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=C3D8R\n1, 1,2,4,3,5,6,8,7\n";
  EXPECT_THAT(inp_refusal(brick + nodes_of_cube(9, 1.) + cells_of_cube(2, 9, "A") +
                          "*ELEMENT, TYPE=C3D6\n8, 1,2,3,5,6,7\n*SURFACE, NAME=X\n8, S5\n*ELEMENT, TYPE=C3D5\n9, "
                          "1,2,4,3,5\n"),
              AllOf(StartsWith("scene.toml:3: frame: "),
                    HasSubstr("mesh.inp holds 6 tetrahedra, 1 pyramids, 1 prisms "
                              "(wedges) and 1 hexahedra, but a mesh must consist of"),
                    HasSubstr("Abaqus: C3D10")));
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=C3D5\n1, 1,2,4,3,5\n"),
              AllOf(HasSubstr("holds 1 pyramids, but"), HasSubstr("Mesh it with tetrahedra only")));
}

/// Lower half of the cube along the diagonal of x and y, corners 1 2 4 and 5 6 8, with its middle nodes.
std::string quadratic_prism(double bulge)
{
  std::ostringstream text;
  text << "*NODE\n9, .5," << -bulge << ",0\n10, 1,.5,0\n11, .5,.5,0\n12, .5,0,1\n13, 1,.5,1\n14, .5,.5,1\n"
       << "15, 0,0,.5\n16, 1,0,.5\n17, 1,1,.5\n*ELEMENT, TYPE=C3D15, ELSET=A\n1, "
          "1,2,4,5,6,8,9,10,11,12,13,14,15,16,17\n";
  return nodes_of_cube(1, 0.) + text.str();
}

TEST(InpMesh, OfPrismsIsTakenLinearOrQuadraticWithTheirFacesAsSurfaces)
{
  const std::string both = quadratic_prism(0.) +
                           "*ELEMENT, TYPE=C3D6, ELSET=B\n2, 1,4,3,5,8,7\n*SURFACE, NAME=TOP\n1, S2\n2, S2\n"
                           "*SURFACE, NAME=FRONT\n1, S3\n";
  FrameSpecification s = specification(write_text("prisms.inp", both), 0.);
  s.surfaces["top"]    = group("TOP");
  s.surfaces["front"]  = group("FRONT");
  const Mesh mesh      = make_mesh(s);
  EXPECT_EQ(mesh.prisms.size(), 2u);
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_TRUE(mesh.notes.empty());
  EXPECT_NEAR(norm(area_vector(mesh, "top") - Vector3{0., 0., 1.}), 0., 1e-14);
  EXPECT_NEAR(norm(area_vector(mesh, "front") - Vector3{0., -1., 0.}), 0., 1e-14);
  const FrameSpecification one =
      specification(write_text("one.inp", quadratic_prism(0.) + "*ELEMENT, TYPE=C3D6, ELSET=A\n2, 1,4,3,5,8,7\n"), 0.);
  EXPECT_EQ(make_mesh(one).prisms.size(), 2u);
  EXPECT_THAT(report_geometry(one).notes, Contains(HasSubstr("with and without middle nodes")));
  const Mesh bulged = make_mesh(specification(write_text("bulged.inp", quadratic_prism(0.05)), 0.));
  EXPECT_THAT(bulged.notes, Contains(AllOf(HasSubstr("straight edges"), HasSubstr("up to 50 mm"))));
}

TEST(InpMesh, TakesTetrahedraUponPrismsButNotUponTheirQuadrilaterals)
{
  const std::string prism = nodes_of_cube(1, 0.) +
                            "*NODE\n9, .5,.2,2\n10, .5,-1,.5\n*ELEMENT, TYPE=C3D6\n1, 1,2,4,5,6,8\n"
                            "*ELEMENT, TYPE=C3D4\n2, 5,6,8,9\n";
  const Mesh mesh = make_mesh(specification(write_text("upon.inp", prism), 0.));
  EXPECT_EQ(mesh.prisms.size(), 1u);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.skin.size(), 10u) << "a triangle and three quadrilaterals of the prism, three of the tetrahedron";
  EXPECT_THAT(inp_refusal(prism + "3, 1,2,6,10\n"), AllOf(HasSubstr("1 triangles of cells are on quadrilaterals"),
                                                          HasSubstr("displacements would be discontinuous")));
}

TEST(InpMesh, OfHexahedraIsTaken)
{
  const std::string  text = nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=C3D8R\n1, 1,2,4,3,5,6,8,7\n";
  FrameSpecification s    = specification(write_text("brick.inp", text), 0.);
  s.surfaces["top"]       = plane({0., 0., 1.}, {0., 0., 1.});
  const Mesh mesh         = make_mesh(s);
  EXPECT_EQ(mesh.hexahedra.size(), 1u);
  EXPECT_NEAR(norm(area_vector(mesh, "top") - Vector3{0., 0., 1.}), 0., 1e-14);
}

/// A cube of 20 nodes as Abaqus orders them; node 9, on the edge from 1 to 2, is pushed out by `bulge`.
std::string quadratic_cube(double bulge)
{
  const double corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const int    edges[12][2]  = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::ostringstream text;
  text << "*NODE\n";
  for (int i = 0; i < 20; ++i)
  {
    text << i + 1;
    for (int d = 0; d < 3; ++d)
      text << ", "
           << (i < 8 ? corners[i][d] : 0.5 * (corners[edges[i - 8][0]][d] + corners[edges[i - 8][1]][d])) -
                  (i == 8 && d == 1 ? bulge : 0.);
    text << "\n";
  }
  text << "*ELEMENT, TYPE=C3D20R\n1";
  for (int i = 0; i < 20; ++i)
    text << (i == 15 ? ",\n" : ", ") << i + 1;
  return text.str() + "\n";
}

TEST(InpMesh, OfQuadraticHexahedraReportsHowFarTheirNodesLieBesideStraightEdges)
{
  FrameSpecification s        = specification(write_text("straight.inp", quadratic_cube(0.)), 0.);
  const Mesh         straight = make_mesh(s);
  EXPECT_EQ(straight.hexahedra.size(), 1u);
  EXPECT_TRUE(straight.notes.empty()) << straight.notes[0];
  s                 = specification(write_text("bulged.inp", quadratic_cube(0.05)), 0.);
  const Mesh bulged = make_mesh(s);
  EXPECT_EQ(bulged.points.size(), 8u);
  EXPECT_THAT(bulged.notes, Contains(AllOf(HasSubstr("straight edges"), HasSubstr("up to 50 mm"))));
}

TEST(Mesh, OfHexahedraCannotBeCurved)
{
  FrameSpecification s = specification(write_text("straight.inp", quadratic_cube(0.)), 0.);
  s.mesh.curved        = true;
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("curved = true"), HasSubstr("are hexahedra"), HasSubstr("remove curved")));
}

TEST(InpMesh, WrittenByGmshIsRead)
{
  const std::string  cad = draw("gmsh.inp",
                                []
                                {
                                 gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
                                 gmsh::model::occ::synchronize();
                                 gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
                                 gmsh::option::setNumber("Mesh.SaveAll", 1);
                                 gmsh::model::mesh::generate(3);
                               });
  FrameSpecification s   = specification(cad, 0.);
  s.surfaces["top"]      = plane({0., 0., 1.}, {0., 0., 1.});
  const Mesh mesh        = make_mesh(s);
  EXPECT_NEAR(volume_of_cells(mesh), 1., 1e-9);
  EXPECT_NEAR(norm(area_vector(mesh, "top") - Vector3{0., 0., 1.}), 0., 1e-9);
}

TEST(InpMesh, WithWhatIsNotReadIsRefusedWithItsLine)
{
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=B31\n1, 1, 2\n"),
              AllOf(StartsWith("scene.toml:3: frame"), HasSubstr("mesh.inp:10"), HasSubstr("B31"), HasSubstr("C3D10")));
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 99\n"), HasSubstr("has node 99"));
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3\n"),
              AllOf(HasSubstr("has 3 nodes, 4 are needed"), HasSubstr("truncated")));
  EXPECT_THAT(inp_refusal(cube() + "*NODE\n1, 0, 0, 0\n"), HasSubstr("node 1 is defined twice"));
  EXPECT_THAT(inp_refusal(cube() + cells_of_cube(6, 1, "A")), HasSubstr("element 6 is defined twice"));
  EXPECT_THAT(inp_refusal(cube() + "*SHELL SECTION, ELSET=A\n1.\n"), HasSubstr("only solid elements are read"));
  EXPECT_THAT(inp_refusal(cube() + "*PART, NAME=A\n*END PART\n*PART, NAME=B\n"), HasSubstr("several parts"));
  EXPECT_THAT(inp_refusal("1, 2, 3\n"), HasSubstr("not an Abaqus input file"));
  EXPECT_THAT(inp_refusal("*NODE\n1, zero, 0, 0\n"), HasSubstr("\"zero\" is not a coordinate"));
  EXPECT_THAT(inp_refusal("*NODE\n1, 0, NaN, 0\n"), HasSubstr("\"NaN\" is not a coordinate"));
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.)), HasSubstr("no tetrahedra"));
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + "*ELEMENT, TYPE=S4, ELSET=A\n1, 1,2,4,3\n2, 5,6,8,7\n"),
              AllOf(HasSubstr("no tetrahedra"), HasSubstr("model a plate as a solid")));
}

TEST(InpMesh, TakesLinesOfOtherFiles)
{
  const auto data_of = [](const std::string &block) { return block.substr(block.find('\n') + 1); };
  write_text("nodes.inc", data_of(nodes_of_cube(1, 0.)));
  write_text("cells.inc", data_of(cells_of_cube(1, 1, "A")));
  const std::string by_input =
      write_text("input.inp", "*NODE, NSET=ALL, INPUT=nodes.inc\n*ELEMENT, INPUT=cells.inc, TYPE=C3D4, ELSET=A\n");
  const std::string by_include =
      write_text("include.inp", "*NODE, NSET=ALL\n*INCLUDE, INPUT=nodes.inc\n9, 1, 1, 2\n"
                                "*ELEMENT, TYPE=C3D4,\nELSET=A\n*INCLUDE, INPUT=cells.inc\n");
  for (const std::string &path : {by_input, by_include})
  {
    const InpMesh     mesh    = read_inp({path, 0., "here"});
    const std::size_t n_nodes = path == by_include ? 9 : 8; // the data line after the include belongs to *NODE
    EXPECT_EQ(mesh.numbers.size(), n_nodes) << path;
    ASSERT_EQ(mesh.elements.size(), 1u) << path;
    EXPECT_EQ(mesh.elements[0].solid, "A");
    EXPECT_EQ(mesh.elements[0].numbers.size(), 6u);
    EXPECT_EQ(mesh.node_sets.at("ALL").size(), n_nodes);
  }
  write_text("circle.inc", "*INCLUDE, INPUT=circle.inc\n");
  EXPECT_THAT(inp_refusal(cube() + "*INCLUDE, INPUT=circle.inc\n"),
              AllOf(HasSubstr("circle.inc:1"), HasSubstr("includes itself")));
  EXPECT_THAT(inp_refusal("*NODE, INPUT=absent.inc\n"),
              AllOf(HasSubstr("mesh.inp:1"), HasSubstr("absent.inc\" cannot be")));
  write_text("bad.inc", "** nodes\n7, zero\n");
  EXPECT_THAT(inp_refusal("*NODE, INPUT=bad.inc\n"), HasSubstr("bad.inc:2"));
}

TEST(InpMesh, WhoseKeywordsChangeItsMeaningIsRefusedWithTheWayOut)
{
  for (const std::string keyword : {"NGEN", "NFILL, NSET=A", "NCOPY, CHANGE NUMBER=8, OLD SET=FOOT", "NMAP",
                                    "ELGEN, ELSET=A", "ELCOPY, SHIFT NODES=8", "IMPORT"})
    EXPECT_THAT(
        inp_refusal(cube() + "*" + keyword + "\n1, 2\n"),
        AllOf(HasSubstr("mesh.inp:27: *" + keyword.substr(0, keyword.find(','))), HasSubstr("write the mesh flat")))
        << keyword;
  for (const std::string system : {"C", "s"})
    EXPECT_THAT(inp_refusal("*NODE, SYSTEM=" + system + "\n1, 1, 90, 0\n"),
                AllOf(HasSubstr("mesh.inp:1"), HasSubstr("SYSTEM="), HasSubstr("give x, y, z")));
  EXPECT_THAT(inp_refusal("*SYSTEM\n1, 0, 0, 1, 1, 0\n" + cube()),
              AllOf(HasSubstr("mesh.inp:2"), HasSubstr("*SYSTEM")));
  EXPECT_THAT(inp_refusal(cube() + "*IMPERFECTION, FILE=old\n1, 0.1\n"),
              HasSubstr("write nodes in their final position"));
  EXPECT_THAT(inp_refusal(cube() + "*NSET, NSET=B, ELSET=BLOCK\n"), HasSubstr("list the nodes"));
  EXPECT_THAT(inp_refusal(cube() + "*SURFACE, NAME=B, COMBINE=UNION\nC, D\n"), HasSubstr("list the sides"));
  // A system without axes is that of the whole, R its coordinates.
  std::string plain = cube();
  plain.replace(plain.find("*NODE\n"), 6, "*SYSTEM\n*NODE, SYSTEM=R\n");
  EXPECT_EQ(read_inp({write_text("plain.inp", plain), 0., "here"}).numbers.size(), 8u);
}

TEST(InpMesh, ReportsTiesItLeavesOut)
{
  const std::string path = write_text("tied.inp", cube() + "*TIE, NAME=T\nA, B\n*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n");
  EXPECT_THAT(read_inp({path, 0., "here"}).notes,
              AllOf(Contains(HasSubstr("*TIE is ignored")), Contains(HasSubstr("*EQUATION is ignored"))));
}

TEST(Mesh, WithANodeMovedThroughItsNeighboursIsRefused)
{
  // The middle node of a cube of twelve tetrahedra, moved outside.
  std::string text        = nodes_of_cube(1, 0.) + "9, 0.5, 0.5, 3\n*ELEMENT, TYPE=C3D4\n";
  int         cell        = 0;
  const int   faces[6][4] = {{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}};
  for (const auto &[a, b, c, d] : faces)
    for (const auto &[i, j, k] : {std::array<int, 3>{a, b, c}, std::array<int, 3>{a, c, d}})
      text += std::to_string(++cell) + ", " + std::to_string(i) + ", " + std::to_string(j) + ", " + std::to_string(k) +
              ", 9\n";
  EXPECT_THAT(inp_refusal(text), AllOf(HasSubstr("turned inside out"), HasSubstr("negative Jacobian")));
}

TEST(Mesh, WithABrickThatIsThereTwiceIsRefused)
{
  const std::string brick = "1, 2, 4, 3, 5, 6, 8, 7\n";
  const std::string cells = "*ELEMENT, TYPE=C3D8\n1, " + brick;
  EXPECT_EQ(inp_refusal(nodes_of_cube(1, 0.) + cells), "");
  EXPECT_THAT(inp_refusal(nodes_of_cube(1, 0.) + cells + "2, " + brick),
              HasSubstr("6 pairs of neighbouring cells lie on the same side of their common face"));
}

TEST(Mesh, WithAFlatCellIsRefused)
{
  const std::string text = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,1,1,0\n*ELEMENT, TYPE=C3D4\n1, 1,2,3,4\n";
  EXPECT_THAT(inp_refusal(text),
              AllOf(HasSubstr("flat cell"), HasSubstr("repair it in the program that made the mesh")));
}

TEST(Mesh, WhoseBodiesLieUponEachOthersNodesIsRefusedOrMerged)
{
  const std::string text =
      nodes_of_cube(1, 0.) + nodes_of_cube(11, 1.) + cells_of_cube(1, 1, "A") + cells_of_cube(11, 11, "B");
  EXPECT_THAT(inp_refusal(text),
              AllOf(HasSubstr("2 bodies"), HasSubstr("4 nodes coincide with others"), HasSubstr("mesh.gap")));
  FrameSpecification s = specification(write_text("two.inp", text), 0.);
  s.mesh.gap           = 1e-6;
  const Mesh merged    = make_mesh(s);
  EXPECT_EQ(merged.points.size(), 12u);
  EXPECT_NEAR(volume_of_cells(merged), 2., 1e-14);
  EXPECT_THAT(merged.statements, Contains(HasSubstr("4 nodes are merged with another node")));
  s.mesh.gap    = 0.;
  s.mesh.bodies = 2;
  EXPECT_EQ(make_mesh(s).points.size(), 16u);
}

TEST(Mesh, WithNodesNoCellUsesReportsThem)
{
  const std::string text = cube() + "*NODE\n77, 5, 5, 5\n";
  const Mesh        mesh = make_mesh(specification(write_text("unused.inp", text), 0.));
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("1 nodes of the file are not part of a cell")));
}

} // namespace
