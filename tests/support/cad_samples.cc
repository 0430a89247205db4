#include "tests/support/cad_samples.h"

#include "tests/support/refusal.h"

#include "fem/geometry/gmsh_session.h"
#include "fem/mesh/mesher.h"
#include "tests/support/test.h"

#include <gmsh.h>

#include <Interface_Static.hxx>

namespace gestell::fem::test
{

std::string folder()
{
  const auto *test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto  path = std::filesystem::path(::testing::TempDir()) /
                    (std::string("gestell_") + test->test_suite_name() + "_" + test->name());
  std::filesystem::create_directories(path);
  return path.string();
}

std::string write_text(const std::string &name, const std::string &text)
{
  const std::string path = folder() + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string read_text(const std::string &path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string draw(const std::string &name, const std::function<void()> &draw)
{
  const GmshSession session;
  const std::string path = folder() + "/" + name;
  gmsh::option::setString("Geometry.OCCTargetUnit", ""); // else numbers are written as metres
  draw();
  gmsh::model::occ::synchronize();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM"); // reading left metres behind, for the whole process
  gmsh::write(path);
  return path;
}

std::string press_frame()
{
  return GESTELL_SOURCE_DIR "/meshes/press_frame.step";
}

FrameSpecification specification(const std::string &cad, double size)
{
  FrameSpecification s;
  s.cad        = cad;
  s.place      = "scene.toml:3: frame";
  s.mesh.size  = size;
  s.mesh.place = "scene.toml:4: frame.mesh";
  return s;
}

SurfaceSelector plane(Vector3 normal, Vector3 through, int faces)
{
  SurfaceSelector selector;
  selector.plane = SurfaceSelector::Plane{normal, through};
  selector.faces = faces;
  selector.place = "scene.toml:8: frame.surface";
  return selector;
}

SurfaceSelector cylinder(Vector3 axis, Vector3 through, double radius, int faces)
{
  SurfaceSelector selector;
  selector.cylinder = SurfaceSelector::Cylinder{axis, through, radius};
  selector.faces    = faces;
  selector.place    = "scene.toml:8: frame.surface";
  return selector;
}

SurfaceSelector group(const std::string &name, int faces)
{
  SurfaceSelector selector;
  selector.group = name;
  selector.faces = faces;
  selector.place = "scene.toml:8: frame.surface";
  return selector;
}

std::string refusal(const FrameSpecification &specification)
{
  return tests::refusal([&] { make_mesh(specification); });
}

} // namespace gestell::fem::test
