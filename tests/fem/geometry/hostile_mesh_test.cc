// Meshes that nobody means well with: short files that ask for much, numbers that are none.

#include "fem/geometry/inp/inp_file.h"
#include "fem/mesh/measure_body.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace
{

const std::string tetrahedron = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
                                "*ELEMENT, TYPE=C3D4, ELSET=BLOCK\n1, 1, 2, 3, 4\n";

std::string mesh_refusal(const std::string &text)
{
  return refusal(specification(write_text("mesh.inp", text), 0.));
}

InpMesh read_back(const std::string &text)
{
  return read_inp({write_text("read.inp", text), 0., "here"});
}

TEST(InpSets, ThatNameThemselvesAreRefusedWithTheRing)
{
  EXPECT_THAT(mesh_refusal(tetrahedron + "*NSET, NSET=A\n1, A\n"),
              AllOf(HasSubstr("mesh.inp"), HasSubstr("\"A\" names \"A\"")));
  EXPECT_THAT(mesh_refusal(tetrahedron + "*NSET, NSET=A\nB\n*NSET, NSET=B\nC\n*NSET, NSET=C\n2, B\n"),
              HasSubstr("\"B\" names \"C\" names \"B\""));
  EXPECT_THAT(mesh_refusal(tetrahedron + "*ELSET, ELSET=A\nA\n*SOLID SECTION, ELSET=A\n"),
              HasSubstr("\"A\" names \"A\""));
}

/// Sets S0 ... S(n - 1), each of which names the next, so often; the last has node 3.
std::string chain(int n, int often)
{
  std::ostringstream text;
  for (int k = 0; k + 1 < n; ++k)
  {
    text << "*NSET, NSET=S" << k << "\n";
    for (int i = 0; i < often; ++i)
      text << "S" << k + 1 << ",\n";
  }
  text << "*NSET, NSET=S" << n - 1 << "\n3\n";
  return text.str();
}

TEST(InpSets, ThatNameOthersHaveAllTheirNumbersHoweverDeep)
{
  EXPECT_THAT(read_back(tetrahedron + chain(100, 1)).node_sets.at("S0"), ElementsAre(3u));
  EXPECT_THAT(mesh_refusal(tetrahedron + chain(1000, 1)), HasSubstr("more than 200 levels deep"));
}

TEST(InpSets, ThatNameOthersTwiceAreResolvedOnce)
{
  EXPECT_THAT(read_back(tetrahedron + chain(100, 2)).node_sets.at("S0"), ElementsAre(3u)); // 2^99 ways
}

TEST(InpSets, OfMoreMembersThanAFileCanMeanAreRefused)
{
  std::ostringstream text;
  for (int node = 1; node <= 2000; ++node)
    text << (node == 1 ? "*NODE\n" : "") << node << ", " << node << ", 0, 0\n";
  for (int set = 0; set < 700; ++set) // 700 times 2000
    text << "*NSET, NSET=S" << set << ", GENERATE\n1, 2000\n";
  EXPECT_THAT(mesh_refusal(text.str()), HasSubstr("more than 1200000 nodes in total"));
}

TEST(InpMesh, TakesNumbersThatLieFarApartAndNoneThatNoProgramHas)
{
  std::string text = tetrahedron;
  for (std::size_t at = text.find("4"); at != std::string::npos; at = text.find("4", at + 10))
    if (text[at - 1] == '\n' || text[at - 1] == ' ')
      text.replace(at, 1, "2000000000");
  EXPECT_EQ(make_mesh(specification(write_text("far.inp", text), 0.)).n_cells(), 1) << text;
  EXPECT_THAT(mesh_refusal("*NODE\n5000000000, 0, 0, 0\n"), AllOf(HasSubstr("mesh.inp:2"), HasSubstr("5000000000")));
}

TEST(InpMesh, WithALineThatIsNoneIsRefused)
{
  EXPECT_THAT(mesh_refusal(tetrahedron + "*NSET, NSET=A\n" + std::string(1000001, '1') + "\n"),
              AllOf(HasSubstr("mesh.inp:9"), HasSubstr("1000001 characters")));
}

TEST(InpMesh, OfBytesThatAreNotTextIsRefusedWithTheLine)
{
  EXPECT_THAT(mesh_refusal(tetrahedron + std::string("2, 1, \0\0\0, 4\n", 13)),
              AllOf(HasSubstr("mesh.inp:8"), HasSubstr("not text"), HasSubstr("UTF-16")));
  std::string wide = "\xFF\xFE";
  for (const char c : tetrahedron)
    wide += {c, '\0'};
  EXPECT_THAT(mesh_refusal(wide), AllOf(HasSubstr("mesh.inp:1"), HasSubstr("UTF-16")));
}

enum class Cells
{
  tetrahedra,
  prisms,
  hexahedra
};

std::string box_by_gmsh(const std::string &file, Cells cells = Cells::tetrahedra)
{
  return read_text(draw(file,
                        [cells]
                        {
                          namespace occ = gmsh::model::occ;
                          gmsh::vectorpair swept;
                          occ::addRectangle(0., 0., 0., 1., 1.);
                          if (cells == Cells::tetrahedra)
                            occ::extrude({{2, 1}}, 0., 0., 1., swept);
                          else
                            occ::extrude({{2, 1}}, 0., 0., 1., swept, {4}, {}, true);
                          occ::synchronize();
                          if (cells == Cells::hexahedra)
                          {
                            gmsh::model::mesh::setTransfiniteSurface(1);
                            gmsh::model::mesh::setRecombine(2, 1);
                          }
                          gmsh::option::setNumber("Mesh.MeshSizeMax", 0.3);
                          gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
                          gmsh::option::setNumber("Mesh.SaveAll", 1);
                          gmsh::model::mesh::generate(3);
                        }));
}

/// Without the first `n` lines behind the one that begins with this.
std::string without_lines(const std::string &text, const std::string &begin, int n)
{
  const std::size_t from = text.find('\n', text.find(begin)) + 1;
  std::size_t       to   = from;
  for (int i = 0; i < n; ++i)
    to = text.find('\n', to) + 1;
  return text.substr(0, from) + text.substr(to);
}

/// What is noted of the mesh of a file with this text.
std::string notes_of(const std::string &file, const std::string &text)
{
  FrameSpecification frame = specification(write_text(file, text), 0.);
  frame.mesh.bodies        = 0;
  std::string all;
  for (const std::string &note : make_mesh(frame).notes)
    all += note + "\n";
  return all;
}

// The triangles around the box stand before its cells.
TEST(InpMesh, WithoutItsLastCellsIsReportedByTheSurfaceThatLostThem)
{
  const std::string whole = box_by_gmsh("whole.inp");
  EXPECT_THAT(notes_of("mesh.inp", whole), Not(HasSubstr("truncated")));
  EXPECT_THAT(notes_of("mesh.inp", without_lines(whole, "*ELEMENT, type=C3D4", 200)),
              AllOf(HasSubstr("surface \"SURFACE"), HasSubstr("truncated")));
}

/// Whether a line of a .msh file is a cell at node 1, a corner of the box; such cells have sides on its surfaces.
bool is_cell_at_corner(const std::string &line, int n_nodes)
{
  std::istringstream     words(line);
  const std::vector<int> numbers{std::istream_iterator<int>(words), {}}; // number, kind, 2, two tags, nodes
  return int(numbers.size()) == 5 + n_nodes && std::count(numbers.begin() + 5, numbers.end(), 1) > 0;
}

TEST(MshMesh, WithoutSomeOfItsCellsIsReportedByTheSurfaceThatLostThem)
{
  const std::pair<Cells, int> kinds[] = {{Cells::tetrahedra, 4}, {Cells::prisms, 6}, {Cells::hexahedra, 8}};
  for (const auto &[cells, n_nodes] : kinds)
  {
    SCOPED_TRACE(n_nodes);
    const std::string whole = box_by_gmsh("whole.msh", cells);
    EXPECT_THAT(notes_of("mesh.msh", whole), Not(HasSubstr("truncated")));
    std::istringstream lines(whole);
    std::string        line, cut;
    int                n_left_out = 0;
    for (bool elements = false; std::getline(lines, line); elements |= line == "$Elements")
      if (elements && is_cell_at_corner(line, n_nodes))
        ++n_left_out;
      else
        cut += line + "\n";
    const std::size_t count = cut.find("$Elements\n") + 10;
    cut.replace(count, cut.find('\n', count) - count, std::to_string(std::stoi(cut.substr(count)) - n_left_out));
    EXPECT_GE(n_left_out, 1);
    EXPECT_THAT(notes_of("mesh.msh", cut), AllOf(HasSubstr("lie on no cell"), HasSubstr("truncated")));
  }
}

TEST(InpMesh, WithFilesThatAreIncludedWithoutEndIsRefused)
{
  for (int k = 0; k < 30; ++k)
  {
    const std::string next = "*INCLUDE, INPUT=twice" + std::to_string(k + 1) + ".inc\n";
    write_text("twice" + std::to_string(k) + ".inc", next + next);
  }
  write_text("twice30.inc", "** nothing\n");
  EXPECT_THAT(mesh_refusal(tetrahedron + "*INCLUDE, INPUT=twice0.inc\n"),
              HasSubstr("more than 10000 times")); // of 2^31
  for (int k = 0; k < 120; ++k)
    write_text("chain" + std::to_string(k) + ".inc", "*INCLUDE, INPUT=chain" + std::to_string(k + 1) + ".inc\n");
  write_text("chain120.inc", "** nothing\n");
  EXPECT_THAT(mesh_refusal(tetrahedron + "*INCLUDE, INPUT=chain0.inc\n"), HasSubstr("more than 100 levels deep"));
}

TEST(GeoScript, WithLongChainsOfIncludesIsRefused)
{
  for (int k = 0; k < 100; ++k)
    write_text("chain" + std::to_string(k) + ".geo", "Include \"chain" + std::to_string(k + 1) + ".geo\";\n");
  write_text("chain100.geo", "x = 1;\n");
  EXPECT_THAT(refusal(specification(write_text("frame.geo", "Include \"chain0.geo\";\n"), 0.5)),
              AllOf(HasSubstr("chain49.geo:1"), HasSubstr("included more than 50 levels deep")));
}

/// A mesh of gmsh in its format 2.2: nodes of the unit cube by bits of x, y, z, and one cell.
std::string msh(const std::string &last_x, const std::string &cell)
{
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (int i = 0; i < 8; ++i)
    text << i + 1 << ' ' << (i == 7 ? last_x : std::to_string(i & 1)) << ' ' << (i >> 1 & 1) << ' ' << (i >> 2) << "\n";
  text << "$EndNodes\n$Elements\n1\n1 " << cell << "\n$EndElements\n";
  return text.str();
}

const std::vector<std::string> cells = {"4 2 1 1 1 2 3 8",         // tetrahedron
                                        "6 2 1 1 1 2 4 5 6 8",     // prism
                                        "5 2 1 1 1 2 4 3 5 6 8 7", // hexahedron
                                        "17 2 1 1 1 2 4 3 5 6 8 7 1 3 5 2 6 4 8 7 5 6 8 7"};

TEST(MshMesh, WithCoordinatesThatAreNotNumbersIsRefusedForEveryKindOfCells)
{
  for (const std::string &cell : cells)
    for (const std::string x : {"nan", "inf", "-inf", "1e400"})
    {
      FrameSpecification frame = specification(write_text("wild.msh", msh(x, cell)), 0.);
      EXPECT_THAT(refusal(frame), HasSubstr("wild.msh")) << cell << ", x = " << x;
      EXPECT_NE(gestell::tests::refusal([&] { inspect_geometry(frame); }), "") << cell << ", x = " << x;
      EXPECT_NE(gestell::tests::refusal([&] { measure_part({frame.cad, 1., "body"}); }), "") << cell << ", x = " << x;
    }
}

TEST(MshMesh, OfOneSoundCellIsTaken)
{
  for (std::size_t kind = 0; kind < 3; ++kind)
  {
    FrameSpecification frame = specification(write_text("sound.msh", msh("1", cells[kind])), 0.);
    EXPECT_EQ(make_mesh(frame).n_cells(), 1) << cells[kind];
    EXPECT_GT(inspect_geometry(frame).volume, 0.);
  }
}

TEST(MshMesh, WithCornersUponEachOtherIsRefusedByTheLookToo)
{
  for (const std::string cell : {"6 2 1 1 1 2 4 5 6 6", "5 2 1 1 1 2 4 3 5 6 8 8", "5 2 1 1 1 1 1 1 5 5 5 5"})
  {
    FrameSpecification frame = specification(write_text("flat.msh", msh("1", cell)), 0.);
    EXPECT_NE(refusal(frame), "") << cell;
    EXPECT_NE(gestell::tests::refusal([&] { inspect_geometry(frame); }), "") << cell;
  }
}

/// A closed surface of triangles in STL's binary form.
std::string binary_stl(float x)
{
  const float                             corners[4][3] = {{0, 0, 0}, {x, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<std::array<int, 3>, 4> triangles     = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::string                             bytes(80, ' ');
  const auto add = [&](const auto &value) { bytes.append(reinterpret_cast<const char *>(&value), sizeof value); };
  add(std::uint32_t(triangles.size()));
  for (const auto &triangle : triangles)
  {
    add(std::array<float, 3>{});
    for (const int corner : triangle)
      add(corners[corner]);
    add(std::uint16_t(0));
  }
  return bytes;
}

TEST(StlSurface, WithCoordinatesThatAreNotNumbersIsRefused)
{
  const auto measured = [](float x) { return measure_part({write_text("part.stl", binary_stl(x)), 1., "body"}); };
  EXPECT_NEAR(measured(1.f).volume, 1. / 6., 1e-12);
  for (const float x : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f})
    EXPECT_NE(gestell::tests::refusal([&] { measured(x); }), "") << x;
}

TEST(GeoScript, OfLengthsThatAreNotNumbersIsRefused)
{
  for (const std::string length : {"1e400", "0/0", "Log(-1)", "1e200"})
    EXPECT_THAT(
        refusal(specification(
            write_text("wild.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, " + length + ", 1, 1};\n"), 0.5)),
        HasSubstr("wild.geo"))
        << length;
}

} // namespace
