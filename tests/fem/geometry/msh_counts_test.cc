// What binary meshes of gmsh announce is compared with what follows before gmsh believes it.

#include "fem/geometry/msh_counts.h"
#include "tests/support/cad_samples.h"

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

namespace gestell::fem
{
namespace
{

using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A box of tetrahedra or hexahedra, drawn by `draw()` so that gmsh is started and left as it was.
std::string binary_mesh(const std::string &name, int order, bool hexahedra, bool parametric, double version = 4.1)
{
  return draw(name,
              [&]
              {
                gmsh::model::occ::addBox(0., 0., 0., 1., 0.5, 0.4);
                gmsh::model::occ::synchronize();
                gmsh::model::addPhysicalGroup(3, {1}, 7);
                gmsh::model::setPhysicalName(3, 7, "block");
                gmsh::model::addPhysicalGroup(2, {1, 2}, 8);
                gmsh::option::setNumber("Mesh.MeshSizeMax", 0.4);
                gmsh::option::setNumber("Mesh.Algorithm", 6);
                gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", hexahedra ? 2 : 0);
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::option::setNumber("Mesh.Binary", 1);
                gmsh::option::setNumber("Mesh.SaveAll", 1);
                gmsh::option::setNumber("Mesh.SaveParametric", parametric);
                gmsh::model::mesh::generate(3);
                gmsh::model::mesh::setOrder(order);
              });
}

std::string told_of(const std::string &file)
{
  std::string told;
  const auto  refuse = [&](const std::string &what) { throw std::invalid_argument(what); };
  try
  {
    check_msh_counts(file, refuse);
  }
  catch (const std::invalid_argument &refused)
  {
    told = refused.what();
  }
  return told;
}

std::string with_number(std::string text, std::size_t at, std::uint64_t number)
{
  std::memcpy(&text[at], &number, sizeof number);
  return text;
}

std::uint64_t number_in(const std::string &text, std::size_t at)
{
  std::uint64_t number = 0;
  std::memcpy(&number, &text[at], sizeof number);
  return number;
}

TEST(MshCounts, OfSoundMeshesPass)
{
  for (const bool parametric : {false, true})
    for (const bool hexahedra : {false, true})
      for (const int order : {1, 2, 3})
        EXPECT_EQ(told_of(binary_mesh("sound.msh", order, hexahedra, parametric)), "")
            << order << hexahedra << parametric;
  EXPECT_EQ(told_of(binary_mesh("older.msh", 1, false, false, 2.2)), "");
}

struct Announced
{
  std::string   section;
  std::size_t   behind; ///< the name of the section and its end of line [bytes]
  std::string   things;
  std::uint64_t bytes; ///< of one, at least
};

TEST(MshCounts, OfMoreThanTheFileHoldsAreRefusedWithTheByte)
{
  const std::string file = binary_mesh("sound.msh", 1, false, false), text = read_text(file);
  for (const Announced &one : std::vector<Announced>{{"$Entities\n", 0, "points", 36},
                                                     {"$Entities\n", 24, "volumes", 68},
                                                     {"$Nodes\n", 0, "blocks of nodes", 20},
                                                     {"$Nodes\n", 8, "nodes", 32},
                                                     {"$Nodes\n", 44, "nodes", 32}, // of the first block
                                                     {"$Elements\n", 0, "blocks of elements", 20},
                                                     {"$Elements\n", 8, "elements", 16},
                                                     {"$Elements\n", 44, "elements", 16}}) // a point of the first
  {
    const std::size_t at = text.find(one.section) + one.section.size() + one.behind;
    ASSERT_LT(number_in(text, at), 10000u) << one.section << one.behind;
    const std::uint64_t left = text.size() - at - 8;
    for (const std::uint64_t number : {left / one.bytes + 1, ~std::uint64_t(0)})
      EXPECT_THAT(told_of(write_text("damaged.msh", with_number(text, at, number))),
                  AllOf(HasSubstr("at byte " + std::to_string(at) + " it announces " + std::to_string(number) + " " +
                                  one.things + ", but only " + std::to_string(left) + " bytes follow")))
          << one.section << one.behind;
  }
}

// Whatever stands in a file, it is judged or left to gmsh.
TEST(MshCounts, OfFilesCutAnywhereAreJudgedOrLeftToGmsh)
{
  const std::string text = read_text(binary_mesh("sound.msh", 1, true, false));
  for (std::size_t length = 0; length < text.size(); length += 1 + text.size() / 500)
  {
    const std::string told = told_of(write_text("cut.msh", text.substr(0, length)));
    EXPECT_TRUE(told.empty() || told.find("is damaged: at byte ") == 0) << told;
  }
}

} // namespace
} // namespace gestell::fem
