// Faces of a frame as `gestell mesh -o` shows them, and the selectors that mean one face each.

#include "apps/output/faces/faces_page.h"
#include "apps/scene/scene.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_report.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using coupling::MeshReport;
using testing::HasSubstr;

fem::FrameSpecification frame_of(const std::string &file, double unit)
{
  fem::FrameSpecification frame;
  frame.cad       = GESTELL_SOURCE_DIR "/meshes/" + file;
  frame.unit      = unit;
  frame.mesh.size = 0.6;
  frame.material  = {210e9, 0.3, 7850., "test"};
  return frame;
}

/// A scene whose frame names every face by the selector that is told of it.
std::string scene_with(const fem::FrameSpecification &frame, const MeshReport &report)
{
  std::string text = "name = \"faces\"\n[frame]\ncad = \"" + frame.cad + "\"\nmesh = { size = 0.6 }\n";
  if (frame.unit > 0.)
    text += "unit = " + std::to_string(frame.unit) + "\n";
  for (const coupling::SurfaceReport &face : report.surfaces)
    text += apps::face_entry(face);
  return text + "[frame.interface.any]\nsurfaces = [\"face " + std::to_string(report.surfaces.front().tag) + "\"]\n";
}

struct Sample
{
  const char *file;
  double      unit;
};

class SelectorsOfFaces : public testing::TestWithParam<Sample>
{
};

TEST_P(SelectorsOfFaces, MeanEachItsFaceAloneInTheWordsOfAScene)
{
  setenv("GESTELL_PLUGIN_DIR", GESTELL_BINARY_DIR "/bin", 1);
  const auto       frame  = frame_of(GetParam().file, GetParam().unit);
  const MeshReport report = coupling::frame_service().mesh(frame, {});
  ASSERT_GT(report.surfaces.size(), 40u);

  const Folder      folder("faces");
  const std::string file  = folder.file("scene.toml", scene_with(frame, report));
  const apps::Scene scene = apps::read_scene(file.substr(1, file.size() - 2), {});
  // by the names of surfaces that each face bears in the report of a frame with these selectors
  const MeshReport named = coupling::frame_service().mesh(scene.frame.geometry, {});
  ASSERT_EQ(named.surfaces.size(), report.surfaces.size());
  for (std::size_t i = 0; i < report.surfaces.size(); ++i)
  {
    const std::string own = "face " + std::to_string(report.surfaces[i].tag), before = report.surfaces[i].name;
    EXPECT_EQ(named.surfaces[i].name, before.empty() ? own : before + ", " + own);
    EXPECT_TRUE(report.surfaces[i].found_with.empty()) << own;
  }
}

TEST(FacesPage, OpensWithoutANetworkInLessThanFiveMegabytes)
{
  const Folder folder("faces_page");
  expect_answer(gestell("mesh '" GESTELL_SOURCE_DIR "/meshes/crane_chassis.step' --size '0.6 m'" + folder.option()), 0,
                {"faces.html", "faces.vtp"});
  const std::string page = read(folder.results() / "faces.html");
  EXPECT_LT(page.size(), 5000000u);
  EXPECT_EQ(count(page, "src="), 0);
  EXPECT_EQ(count(page, "http"), 0);
  EXPECT_THAT(page, HasSubstr("the file's unit of length is mm"));
  EXPECT_GT(std::filesystem::file_size(folder.results() / "faces.vtp"), 10000u);
}

TEST(FacesPage, IsRefusedBeforeAMeshWhereItCannotBeWritten)
{
  const Folder      folder("faces_refused");
  const std::string file = folder.file("taken", "");
  expect_answer(gestell("mesh '" GESTELL_SOURCE_DIR "/meshes/press_frame.step' --quiet -o " + file), 2,
                {"this is a file, not a folder"});
}

INSTANTIATE_TEST_SUITE_P(Frames, SelectorsOfFaces,
                         testing::Values(Sample{"press_frame.step", 0.}, Sample{"crane_chassis.step", 0.},
                                         Sample{"ladder_chassis.geo", 1e-3}),
                         [](const auto &info)
                         {
                           const std::string file = info.param.file;
                           return file.substr(0, file.find('.'));
                         });

} // namespace
} // namespace gestell::tests
