// Folders are rooms of a house: who may go where, and how many stand side by side.

#include "tests/architecture/room_graph.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::tests;

const std::vector<SourceFile> &folders_and_files()
{
  static const std::vector<SourceFile> files = read_source_tree(GESTELL_SOURCE_DIR);
  return files;
}

const RoomGraph &house()
{
  static const RoomGraph graph(folders_and_files(), {"fem", "mechanism", "coupling", "apps"});
  return graph;
}

std::string lines(const std::vector<std::string> &findings)
{
  return std::accumulate(findings.begin(), findings.end(), std::string(),
                         [](const std::string &text, const std::string &next) { return text + "\n  " + next; });
}

/// A room includes what stands before its folder, or beside it in its own.
const std::vector<std::vector<std::string>> directions = {
    {"fem/values", "fem/parallel", "fem/process", "fem/geometry", "fem/mesh", "fem/assembly", "fem/recovery"},
    {"mechanism/functions", "mechanism/measures", "mechanism/elements", "mechanism/joints"},
    {"coupling/integration/system", "coupling/integration/step", "coupling/integration/bdf",
     "coupling/integration/stability"},
    {"coupling/integration", "coupling/frame", "coupling/algebra", "coupling/eigensolvers", "coupling/factors",
     "coupling/reduction/shapes", "coupling/reduction/estimates", "coupling/reduction/methods", "coupling/reduction",
     "coupling/reduction/parts", "coupling/plugin/frame"},
    {"coupling/integration", "coupling/frame", "coupling/exchange", "coupling/algebra", "coupling/machine",
     "coupling/equilibrium", "coupling/modes", "coupling/simulation", "coupling/sensitivity"},
    {"apps/scene/language", "apps/scene/file", "apps/scene/read", "apps/scene/bodies", "apps/scene/elements",
     "apps/scene/joints", "apps/scene/build"},
    {"apps/scene", "apps/session", "apps/sizing", "apps/analysis", "apps/cli"},
    {"apps/study/values", "apps/study/designs", "apps/study/surface", "apps/study/optimum", "apps/study/report"},
    {"apps/output/text", "apps/output/describe", "apps/output/pictures", "apps/output/charts",
     "apps/output/interactive", "apps/output/report"},
};

} // namespace

TEST(RoomGraph, SeesAKnotAWayBackAndTheDepthOfAFolder)
{
  const std::vector<SourceFile> files = {{"fem/a/x.h", {"#include \"fem/a/y.h\""}},
                                         {"fem/a/y.h", {"// nothing"}},
                                         {"fem/a/y.cc", {"#include \"fem/a/y.h\"", "#include \"fem/b/z.h\""}},
                                         {"fem/b/z.h", {"#include \"fem/a/x.h\""}}};
  const RoomGraph               graph(files, {"fem"});

  EXPECT_EQ(graph.cycles().size(), 1u);
  EXPECT_EQ(graph.against({"fem/a", "fem/b"}), std::vector<std::string>{"fem/a/y -> fem/b/z"});
  EXPECT_EQ(graph.levels("fem/a"), 2);
  EXPECT_EQ(graph.folders().at("fem/a").size(), 2u);
}

TEST(Rooms, IncludeEachOtherInOneDirection)
{
  EXPECT_EQ(lines(house().cycles()), "");
}

TEST(Rooms, IncludeWhatStandsBeforeTheirFolder)
{
  for (const auto &order : directions)
    EXPECT_EQ(lines(house().against(order)), "") << order.back();
}

TEST(Folders, HoldNoMoreRoomsThanOneSeesAtAGlance)
{
  for (const auto &[folder, rooms] : house().folders())
    EXPECT_LE(rooms.size(), 26u) << folder;
}

TEST(Folders, AreNotDeep)
{
  for (const auto &[folder, rooms] : house().folders())
    EXPECT_LE(house().levels(folder), 6) << folder;
}

TEST(Folders, SayWhatTheyHold)
{
  for (const auto &entry : house().folders())
  {
    const std::string readme = entry.first + "/README.md";
    const auto        found  = std::find_if(folders_and_files().begin(), folders_and_files().end(),
                                            [&](const SourceFile &file) { return file.path == readme; });
    ASSERT_NE(found, folders_and_files().end()) << readme;
    EXPECT_LE(found->lines.size(), 20u) << readme;
  }
}

TEST(Libraries, AreIncludedWhereTheyBelong)
{
  const std::vector<std::string> sources = {"fem/", "mechanism/", "coupling/", "apps/"};

  EXPECT_EQ(lines(includes_matching(folders_and_files(), sources, {"fem/assembly/", "fem/recovery/", "fem/parallel/"},
                                    "deal\\.II/")),
            "");
  EXPECT_EQ(lines(includes_matching(folders_and_files(), sources, {"fem/geometry/", "fem/mesh/"}, "gmsh")), "");
  EXPECT_EQ(lines(includes_matching(folders_and_files(), {"apps/session/"}, {}, "iostream")), "");
  EXPECT_EQ(lines(includes_matching(folders_and_files(), sources, {"apps/python/"}, "pybind11/")), "");
  EXPECT_EQ(lines(includes_matching(folders_and_files(), sources, {"apps/output/exchange/"}, "matio\\.h|minizip/")),
            "");
}
