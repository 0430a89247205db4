// Faces of a frame as `gestell mesh -o` shows them, and the selectors that mean one face each.

#include "apps/output/faces/faces_page.h"
#include "apps/scene/scene.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_report.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

#include <algorithm>
#include <map>

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

/// A scene whose frame has these surfaces.
std::string scene_with(const fem::FrameSpecification &frame, const MeshReport &report, const std::string &surfaces)
{
  std::string text = "name = \"faces\"\n[frame]\ncad = \"" + frame.cad + "\"\nmesh = { size = 0.6 }\n";
  if (frame.unit > 0.)
    text += "unit = " + std::to_string(frame.unit) + "\n";
  return text + surfaces + "[frame.interface.any]\nsurfaces = [\"face " + std::to_string(report.surfaces.front().tag) +
         "\"]\n";
}

/// Names of surfaces that each face bears in the report of a frame with these surfaces.
MeshReport named_by(const fem::FrameSpecification &frame, const MeshReport &report, const std::string &surfaces)
{
  const Folder      folder("faces");
  const std::string file  = folder.file("scene.toml", scene_with(frame, report, surfaces));
  const apps::Scene scene = apps::read_scene(file.substr(1, file.size() - 2), {});
  return coupling::frame_service().mesh(scene.frame.geometry, {});
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

  std::string surfaces;
  for (const coupling::SurfaceReport &face : report.surfaces)
    surfaces += apps::face_entry(face);
  const MeshReport named = named_by(frame, report, surfaces);
  ASSERT_EQ(named.surfaces.size(), report.surfaces.size());
  for (std::size_t i = 0; i < report.surfaces.size(); ++i)
  {
    const std::string own = "face " + std::to_string(report.surfaces[i].tag), before = report.surfaces[i].name;
    EXPECT_EQ(named.surfaces[i].name, before.empty() ? own : before + ", " + own);
    EXPECT_TRUE(report.surfaces[i].found_with.empty()) << own;
  }
}

/// A bore of several faces, and coaxial bores, by one entry each.
TEST_P(SelectorsOfFaces, OfBoresMeanAllTheirFaces)
{
  setenv("GESTELL_PLUGIN_DIR", GESTELL_BINARY_DIR "/bin", 1);
  const auto                              frame    = frame_of(GetParam().file, GetParam().unit);
  const MeshReport                        report   = coupling::frame_service().mesh(frame, {});
  std::string                             surfaces = apps::face_entry(report.surfaces.front());
  std::map<std::string, std::vector<int>> groups;
  for (const coupling::SurfaceReport &face : report.surfaces)
    for (const coupling::FaceGroup &group : face.groups)
    {
      EXPECT_GT(group.faces.size(), 1u);
      const std::string name = "group " + std::to_string(groups.size()) + ".";
      groups[name]           = group.faces;
      surfaces += "[frame.surface.\"" + name + "\"]\n" + group.selector;
    }
  if (GetParam().file == std::string("press_frame.step")) // front and rear bearing of the crankshaft
    EXPECT_FALSE(groups.empty());
  const MeshReport named = named_by(frame, report, surfaces);
  for (const auto &[name, faces] : groups)
    for (const coupling::SurfaceReport &face : named.surfaces)
      EXPECT_EQ(face.name.find(name) != std::string::npos, std::binary_search(faces.begin(), faces.end(), face.tag))
          << name << " face " << face.tag << ": " << face.name;
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
  EXPECT_THAT(page, HasSubstr("the file's length unit is mm"));
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
