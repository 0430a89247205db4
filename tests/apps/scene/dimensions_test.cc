#include "apps/scene/scene.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace gestell::tests
{
namespace
{

const std::string script =
    "SetFactory(\"OpenCASCADE\");\n// plate = 5;\nwidth = 900;\nplate   = 80; // thickness\nhalf = width / 2;\n";

/// The script that a frame with these dimensions is made of.
std::string script_with(const std::string &dimensions, const std::string &text = script)
{
  const Folder folder("dimensions");
  setenv("GESTELL_CACHE", (folder / "cache").c_str(), 1);
  folder.file("frame.geo", text);
  folder.file("scene.toml",
              "[parameters]\nt = '70 mm'\n[frame]\ncad = 'frame.geo'\nunit = '1 mm'\nmesh = { size = '50 mm' }\n"
              "dimensions = " +
                  dimensions +
                  "\n[frame.surface.s]\nplane = { normal = [0, 0, 1], through = [0, 0, 0] }\n"
                  "[frame.interface.i]\nsurfaces = ['s']\n[reduction]\nmethod = 'craig-bampton'\n");
  return read(apps::read_scene((folder / "scene.toml").string(), {}, fem::Scripts::harmless).frame.geometry.cad);
}

TEST(Dimensions, TakeThePlacesOfThoseOfTheScriptInItsUnit)
{
  EXPECT_EQ(
      script_with("{ plate = 't', width = 1000 }"),
      "SetFactory(\"OpenCASCADE\");\n// plate = 5;\nwidth = 1000;\nplate   = 70; // thickness\nhalf = width / 2;\n");
}

TEST(Dimensions, AreRefusedWhereTheScriptHasNone)
{
  expect_refusal([] { script_with("{ plat = '70 mm' }"); },
                 "frame.dimensions.plat: the script has no line 'plat = ...;'; did you mean 'plate'?");
  expect_refusal([] { script_with("{ plate = '70 kg' }"); },
                 "needs a length such as \"70 mm\" or a plain number, got one in kg");
  expect_refusal([] { script_with("{ plate = 1 }", "Include \"other.geo\";\nplate = 2;\n"); },
                 "reads other files (Include)");
}

} // namespace
} // namespace gestell::tests
