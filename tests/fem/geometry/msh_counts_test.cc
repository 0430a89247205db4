// What binary meshes of gmsh announce is compared with what follows before gmsh believes it.

#include "fem/geometry/msh_counts.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

#include <cstdint>

namespace gestell::fem
{
namespace
{

using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Kind
{
  int    order      = 1;
  bool   hexahedra  = false;
  bool   parametric = false;
  int    parts      = 0;
  double version    = 4.1;
};

std::ostream &operator<<(std::ostream &out, const Kind &kind)
{
  return out << "order " << kind.order << (kind.hexahedra ? ", hexahedra" : "")
             << (kind.parametric ? ", parametric" : "") << ", parts " << kind.parts;
}

/// A box, of tetrahedra with two sides that go over into each other, drawn by `draw()` so that gmsh is started and left
/// as it was.
std::string mesh_file(const std::string &name, const Kind &kind)
{
  return draw(name,
              [&]
              {
                gmsh::model::occ::addBox(0., 0., 0., 1., 0.5, 0.4);
                gmsh::model::occ::synchronize();
                gmsh::model::addPhysicalGroup(3, {1}, 7);
                gmsh::model::setPhysicalName(3, 7, "$Nodes of 3 $");
                gmsh::model::addPhysicalGroup(2, {1, 2}, 8);
                if (!kind.hexahedra)
                  gmsh::model::mesh::setPeriodic(2, {2}, {1}, {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
                gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
                gmsh::option::setNumber("Mesh.Algorithm", 6);
                gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", kind.hexahedra ? 2 : 0);
                gmsh::option::setNumber("Mesh.MshFileVersion", kind.version);
                gmsh::option::setNumber("Mesh.Binary", 1);
                gmsh::option::setNumber("Mesh.SaveAll", 1);
                gmsh::option::setNumber("Mesh.SaveParametric", kind.parametric);
                gmsh::model::mesh::generate(3);
                gmsh::model::mesh::setOrder(kind.order);
                gmsh::option::setNumber("Mesh.PartitionCreateGhostCells", 1);
                if (kind.parts > 0)
                  gmsh::model::mesh::partition(kind.parts);
              });
}

std::uint64_t number_in(const std::string &text, std::size_t at)
{
  std::uint64_t number = 0;
  std::memcpy(&number, &text[at], sizeof number);
  return number;
}

std::string with_number(std::string text, std::size_t at, std::uint64_t number)
{
  std::memcpy(&text[at], &number, sizeof number);
  return text;
}

std::string count_refusal(const std::string &text)
{
  return defect_of_counts(write_text("told.msh", text));
}

std::size_t after(const std::string &text, const std::string &section)
{
  return text.find("\n" + section + "\n") + section.size() + 2;
}

/// All that comes before is read as gmsh wrote it, else the sums of the elements would not be asked.
TEST(MshCounts, OfSoundMeshesPassAndAreReadToTheirEnd)
{
  for (const Kind &kind : {Kind{}, Kind{1, true}, Kind{2}, Kind{2, true}, Kind{3}, Kind{3, true}, Kind{1, false, true},
                           Kind{2, true, true}, Kind{1, false, false, 3}, Kind{1, true, true, 2}})
  {
    const std::string text = read_text(mesh_file("sound.msh", kind));
    EXPECT_EQ(count_refusal(text), "") << kind;
    const std::size_t   at       = after(text, "$Elements") + 8;
    const std::uint64_t elements = number_in(text, at);
    EXPECT_THAT(count_refusal(with_number(text, at, elements - 1)),
                HasSubstr("at byte " + std::to_string(at) + " it announces " + std::to_string(elements - 1) +
                          " elements, but its blocks hold " + std::to_string(elements)))
        << kind;
  }
}

TEST(MshCounts, OfOtherFormatsAreLeftToGmsh)
{
  EXPECT_EQ(defect_of_counts(mesh_file("older.msh", {1, false, false, 0, 2.2})), "");
  EXPECT_EQ(count_refusal("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 99999999999 1 1\n"), "");
  EXPECT_EQ(count_refusal(""), "");
  EXPECT_EQ(count_refusal("$MeshFormat"), "");
}

TEST(MshCounts, AreNotLookedForInComments)
{
  const std::string text = read_text(mesh_file("sound.msh", {}));
  const std::string said =
      "$Comments\nof the size of its $Nodes\n$Nodes\nand so on, and so on, and so on\n$EndComments\n";
  const std::size_t entities = text.find("$Entities\n");
  EXPECT_EQ(count_refusal(said + text), "");
  EXPECT_EQ(count_refusal(text.substr(0, entities) + said + text.substr(entities)), "");
  const std::size_t nodes = after(said + text, "$EndEntities") + std::strlen("$Nodes\n");
  EXPECT_THAT(count_refusal(with_number(said + text, nodes, ~std::uint64_t(0))), HasSubstr("blocks of nodes"));
}

struct Announced
{
  std::string   section;
  std::size_t   after; ///< the name of the section and its end of line [bytes]
  std::string   things;
  std::uint64_t bytes; ///< of one, at least
};

void expect_refused(const std::string &text, const Announced &one)
{
  const std::size_t at = after(text, one.section) + one.after;
  ASSERT_LT(number_in(text, at), 10000u) << one.section << one.after;
  const std::uint64_t left = text.size() - at - 8;
  for (const std::uint64_t number : {left / one.bytes + 1, ~std::uint64_t(0)})
    EXPECT_THAT(count_refusal(with_number(text, at, number)),
                HasSubstr("at byte " + std::to_string(at) + " it announces " + std::to_string(number) + " " +
                          one.things + ", of at least " + std::to_string(one.bytes) + " bytes each, but only " +
                          std::to_string(left) + " bytes follow"))
        << one.section << one.after;
}

TEST(MshCounts, OfMoreThanTheFileHoldsAreRefusedWithTheByte)
{
  const std::string text = read_text(mesh_file("sound.msh", {}));
  for (const Announced &one : std::vector<Announced>{{"$Entities", 0, "points", 36},
                                                     {"$Entities", 24, "volumes", 68},
                                                     {"$Nodes", 0, "blocks of nodes", 20},
                                                     {"$Nodes", 8, "nodes", 32},
                                                     {"$Nodes", 44, "nodes", 32}, // of the first block
                                                     {"$Elements", 0, "blocks of elements", 20},
                                                     {"$Elements", 8, "elements", 16},
                                                     {"$Elements", 44, "elements", 16}}) // a point of the first
    expect_refused(text, one);
  const std::string parts = read_text(mesh_file("parts.msh", {1, false, false, 3}));
  for (const Announced &one :
       std::vector<Announced>{{"$PartitionedEntities", 8, "ghost entities", 8}, {"$Nodes", 0, "blocks of nodes", 20}})
    expect_refused(parts, one);
}

// gmsh takes memory for what is announced, and writes what it reads.
TEST(MshCounts, OfFewerThanTheBlocksHoldAreRefused)
{
  const std::string   text  = read_text(mesh_file("sound.msh", {}));
  const std::size_t   at    = after(text, "$Nodes") + 8;
  const std::uint64_t nodes = number_in(text, at);
  EXPECT_THAT(
      count_refusal(with_number(text, at, nodes - 1)),
      HasSubstr("announces " + std::to_string(nodes - 1) + " nodes, but its blocks hold " + std::to_string(nodes)));
  EXPECT_EQ(count_refusal(with_number(text, at, nodes + 1)), ""); // as gmsh does of parts
}

// Another number than 1 behind the format says that all bytes are in the order of another processor.
TEST(MshCounts, InTheOrderOfAnotherProcessorAreReadSo)
{
  std::string       text = read_text(mesh_file("sound.msh", {}));
  const std::size_t one  = after(text, "4.1 1 8");
  text[one]              = '\3';
  EXPECT_THAT(count_refusal(text), HasSubstr("points"));

  const auto bytes = [](std::uint64_t number, std::size_t size)
  {
    std::string bytes(reinterpret_cast<const char *>(&number), size);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  const auto with_nodes = [&](std::uint64_t n)
  {
    std::string text = "$MeshFormat\n4.1 1 8\n" + bytes(1, 4) + "\n$EndMeshFormat\n$Nodes\n" + bytes(1, 8) +
                       bytes(n, 8) + bytes(1, 8) + bytes(1, 8) + bytes(0, 4) + bytes(1, 4) + bytes(0, 4) + bytes(1, 8) +
                       bytes(1, 8) + std::string(24, '\0') + "\n$EndNodes\n$Elements\n" + bytes(1, 8) + bytes(n, 8) +
                       bytes(1, 8) + bytes(1, 8) + bytes(0, 4) + bytes(1, 4) + bytes(15, 4) + bytes(1, 8) +
                       bytes(1, 8) + bytes(1, 8);
    return count_refusal(text + "\n$EndElements\n");
  };
  EXPECT_EQ(with_nodes(1), "");
  EXPECT_THAT(with_nodes(0), HasSubstr("announces 0 nodes, but its blocks hold 1"));
}

// Whatever stands in a file, it is judged or left to gmsh.
TEST(MshCounts, OfFilesCutAnywhereAreJudgedOrLeftToGmsh)
{
  const std::string text = read_text(mesh_file("sound.msh", {1, true, true, 2}));
  for (std::size_t length = 0; length < text.size(); length += 1 + text.size() / 500)
  {
    const std::string reported = count_refusal(text.substr(0, length));
    EXPECT_TRUE(reported.empty() || reported.find("is damaged: at byte ") == 0) << reported;
  }
}

} // namespace
} // namespace gestell::fem
