#include "tests/support/scene_text.h"

#include "apps/scene/build/build_machine.h"
#include "tests/support/test.h"

namespace gestell::test
{

SceneFolder::SceneFolder()
{
  std::string pattern = (std::filesystem::temp_directory_path() / "gestell_scene_XXXXXX").string();
  folder_             = ::mkdtemp(pattern.data());
}

SceneFolder::~SceneFolder()
{
  std::filesystem::remove_all(folder_);
}

std::string SceneFolder::write(const std::string &name, const std::string &text) const
{
  std::filesystem::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name) << text;
  return path(name);
}

std::string quoted(std::string text)
{
  std::replace(text.begin(), text.end(), '\'', '"');
  return text;
}

std::string with(std::string text, const std::string &piece, const std::string &replacement)
{
  const auto found = text.find(quoted(piece));
  if (found == std::string::npos)
    throw std::logic_error("the scene has no \"" + piece + "\"");
  return text.replace(found, piece.size(), quoted(replacement));
}

namespace
{

std::string write_scene(const SceneFolder &folder, const std::string &text)
{
  folder.write("frame.step", "ISO-10303-21;");
  return folder.write("scene.toml", text);
}

} // namespace

apps::Scene scene_of(const std::string &text, const std::vector<std::string> &overrides)
{
  const SceneFolder folder;
  return apps::read_scene(write_scene(folder, text), overrides);
}

std::string small_scene()
{
  return R"(name    = "small"
gravity = [0, 0, -9.81]

[parameters]
mass_of_slide = "3200 kg"
stroke        = "2*radius"
radius        = "80 mm"

[frame]
mass      = [["9.5 t", 0], [0, "13 t"]]
stiffness = [["3200 kN/mm", "-3200 kN/mm"], ["-3200 kN/mm", "3620 kN/mm"]]
damping   = [["200 kN s/m", "-200 kN s/m"], ["-200 kN s/m", "800 kN s/m"]]
[frame.interface.crown]
rows = { "-uz" = 1 }
[frame.interface.table]
rows = { "-uz" = 2 }
[frame.cut.columns]
stiffness_row = ["-3200 kN/mm", "3200 kN/mm"]

[body.crank]
type    = "rotor"
axis    = [0, 1, 0]
on      = "frame.crown"
inertia = "250 kg m^2"
[body.slide]
type = "slider"
axis = [0, 0, -1]
mass = "mass_of_slide"

[element.rod]
type         = "connecting rod"
from         = "crank"
to           = "slide"
crank_radius = "radius"
length       = "800 mm"
stiffness    = "900 kN/mm"
[element.spring]
type      = "spring-damper"
from      = "slide"
to        = "frame.table"
stiffness = "20 N/mm"
[element.motor]
type              = "asynchronous motor"
on                = "crank"
breakdown_torque  = "240 N m"
breakdown_slip    = 0.15
synchronous_speed = "1500 1/min"
ratio             = 49

[start]
q = { crank = "120 deg", "frame.crown.uz" = "-0.6 mm" }
v = { crank = "30 1/min" }
[modes]
at   = { crank = "160 deg" }
open = ["rod"]
[run]
step = "10 us"
end  = "0.1 s"
[output.signals]
F_P = "rod.force"
x1  = "-frame.crown.uz"
)";
}

std::string small_scene(const std::string &piece, const std::string &replacement)
{
  return with(small_scene(), piece, replacement);
}

std::string complaint(const std::string &text, const std::vector<std::string> &overrides)
{
  const SceneFolder folder;
  const auto        path = write_scene(folder, text);
  try
  {
    apps::check_scene(apps::read_scene(path, overrides));
  }
  catch (const std::invalid_argument &e)
  {
    std::string       message = e.what();
    const std::string prefix  = path.substr(0, path.size() - std::string("scene.toml").size());
    for (auto i = message.find(prefix); i != std::string::npos; i = message.find(prefix))
      message.erase(i, prefix.size());
    return message;
  }
  return "";
}

std::string cad_scene(const std::string &piece, const std::string &replacement)
{
  return with(R"([frame]
cad      = "frame.step"
mesh     = { size = "60 mm", "bearing *" = "30 mm" }
material = "steel"
damping  = { ratio = 0.02 }
[frame.surface."bearing left"]
cylinder = { axis = [0, 1, 0], through = [0, 0, "2.4 m"], radius = "120 mm" }
[frame.surface."bearing right"]
cylinder = { axis = [0, 1, 0], through = [0, 0, "2.4 m"], radius = "120 mm" }
[frame.surface.feet]
plane = { normal = [0, 0, -2], through = [0, 0, 0] }
faces = "any"
[frame.support.feet]
surface    = "feet"
foundation = { stiffness = "420 kN/mm", damping = [1, 2, 3] }
[frame.interface.crown]
surfaces = ["bearing left", "bearing right"]
[frame.cut.columns]
plane = { normal = [0, 0, 1], through = [0, 0, "1.4 m"] }
)",
              piece, replacement);
}

} // namespace gestell::test
