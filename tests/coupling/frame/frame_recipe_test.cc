#include "coupling/frame/frame_recipe.h"

#include "tests/support/frame_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using test::FrameFolder;

template <typename Frame>
std::string key_of(const Frame &frame, const coupling::ReductionOptions &options)
{
  return coupling::content_key(coupling::recipe_of(frame, options));
}

class ContentKey : public FrameFolder
{
protected:
  fem::FrameSpecification    frame;
  coupling::ReductionOptions options;
  void                       SetUp() override
  {
    FrameFolder::SetUp();
    frame.cad = (folder / "frame.step").string();
    std::ofstream(frame.cad) << "ISO-10303-21;";
    frame.material         = {210e9, 0.3, 7850., "scene.toml:3"};
    frame.surfaces["feet"] = {};
    frame.supports = {{"feet", {"feet"}, fem::SupportKind::clamped, {true, true, true}, {}, {}, "scene.toml:9"}};
  }
};

TEST_F(ContentKey, IsAHexadecimalNumberOf256Bits)
{
  const std::string key = key_of(frame, options);
  EXPECT_EQ(key.size(), 64u);
  EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST_F(ContentKey, ForgetsPlacesAndPaths)
{
  const std::string key  = key_of(frame, options);
  auto              same = frame;
  same.place = same.material.place = same.supports[0].place = "elsewhere.toml:1";
  same.cad                                                  = (folder / "copy.step").string();
  fs::copy_file(frame.cad, same.cad);
  auto same_options    = options;
  same_options.place   = "elsewhere.toml:2";
  same_options.n_modes = -7; // as automatic as -1
  EXPECT_EQ(key_of(same, same_options), key);
}

TEST_F(ContentKey, ChangesWithEveryValue)
{
  std::vector<std::string> keys{key_of(frame, options)};
  const auto               with = [&](auto change)
  {
    auto other         = frame;
    auto other_options = options;
    change(other, other_options);
    keys.push_back(key_of(other, other_options));
  };
  using Frame   = fem::FrameSpecification;
  using Options = coupling::ReductionOptions;
  with([](Frame &f, Options &) { f.material.E *= 1. + 1e-15; });
  with([](Frame &f, Options &) { f.material.nu = 0.31; });
  with([](Frame &f, Options &) { f.material.rho = 7851.; });
  with([](Frame &f, Options &) { f.modal_damping_ratio = 0.02; });
  with([](Frame &f, Options &) { f.unit = 1e-3; });
  with([](Frame &f, Options &) { f.mesh.size = 0.08; });
  with([](Frame &f, Options &) { f.mesh.surface_size["feet"] = 0.05; });
  with([](Frame &f, Options &) { f.surfaces["feet"].faces = 4; });
  with([](Frame &f, Options &) { f.surfaces["feet"].plane = {{0., 0., -1.}, {0., 0., 0.}}; });
  with([](Frame &f, Options &) { f.surfaces["feet"].cylinder = {{0., 0., -1.}, {0., 0., 0.}, 0.1}; });
  with([](Frame &f, Options &) { f.supports[0].held[1] = false; });
  with([](Frame &f, Options &) { f.supports[0].kind = fem::SupportKind::foundation; });
  with([](Frame &f, Options &) { f.supports[0].stiffness[2] = 1e6; });
  with([](Frame &f, Options &) { f.interfaces.push_back({"a", {"feet"}, fem::InterfaceCoupling::rigid, {}, ""}); });
  with([](Frame &f, Options &) { f.interfaces.push_back({"a", {"feet"}, fem::InterfaceCoupling::average, {}, ""}); });
  with([](Frame &f, Options &) { f.cuts.push_back({"c", {0., 0., 1.}, {0., 0., 1.}, ""}); });
  with([](Frame &f, Options &) { f.rayleigh_mass = 2.; });
  with([](Frame &f, Options &) { f.rayleigh_stiffness = 1e-5; });
  with([](Frame &f, Options &) { f.mesh.max_cells = 1e6; });
  with([](Frame &f, Options &) { f.mesh.gap = 1e-4; });
  with([](Frame &f, Options &) { f.mesh.bodies = 2; });
  with([](Frame &f, Options &) { f.mesh.defeature = 1e-3; });
  with([](Frame &f, Options &) { f.mesh.overlaps = fem::Overlaps::once; });
  with([](Frame &f, Options &) { f.mesh.curved = true; });
  with([](Frame &f, Options &) { f.surfaces["feet"].plane = {{0., 0., -1.}, {0., 0., 1.}}; });
  with([](Frame &f, Options &) { f.surfaces["feet"].box = {{0., 0., -1.}, {0., 0., 1.}}; });
  with([](Frame &f, Options &) { f.surfaces["feet"].group = "feet"; });
  with([](Frame &f, Options &) { f.surfaces["feet"].tolerance = 1e-3; });
  with([](Frame &f, Options &) { f.surfaces["table"] = {}; });
  with([](Frame &f, Options &) { f.supports[0].name = "table"; });
  with([](Frame &f, Options &) { f.supports[0].surfaces.push_back("table"); });
  with([](Frame &f, Options &) { f.supports[0].damping[1] = 1e3; });
  with([](Frame &f, Options &) { f.supports.push_back(f.supports[0]); });
  with(
      [](Frame &f, Options &) {
        f.interfaces.push_back({"a", {"feet"}, fem::InterfaceCoupling::rigid, fem::Vector3{}, ""});
      });
  with([](Frame &f, Options &) { f.cuts.push_back({"d", {0., 0., 1.}, {0., 0., 1.}, ""}); });
  with([](Frame &f, Options &) { f.material.name = "another"; });
  with([](Frame &f, Options &) { f.materials = {{"rib*", f.material}}; });
  with([](Frame &f, Options &) { f.modal_damping_ratio.by_mode = {0.01}; });
  with([](Frame &f, Options &) { f.modal_damping_ratio.by_frequency = {{10., 0.01}}; });
  with([](Frame &f, Options &) { f.supports[0].per_area[1] = true; });
  with([](Frame &f, Options &) { std::swap(f.supports[0].axes[0], f.supports[0].axes[1]); });
  with(
      [](Frame &f, Options &) {
        f.interfaces.push_back({"a", {"feet"}, fem::InterfaceCoupling::rigid, {}, "", 0.01});
      });
  with(
      [](Frame &f, Options &)
      {
        f.masses.emplace_back();
        f.masses.back().name = "motor";
        f.masses.back().mass = 100.;
      });
  with([](Frame &, Options &o) { o.n_modes = 12; });
  with([](Frame &, Options &o) { o.method = "free-interface"; });
  with(
      [](Frame &, Options &o)
      {
        o.n_modes   = 12;
        o.frequency = 100.; // what the frame says of its limits
      });
  with([](Frame &, Options &o) { o.tolerance = 0.02; });
  with([](Frame &, Options &o) { o.frequency = 100.; });
  std::ofstream(frame.cad, std::ios::app) << " ";
  keys.push_back(key_of(frame, options));
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(keys[i], keys[j]) << i << " and " << j;
}

TEST_F(ContentKey, OfMatricesChangesWithEveryValue)
{
  using Frame = fem::FrameMatrices;
  Frame matrices;
  matrices.M            = Eigen::Matrix3d(Eigen::Vector3d(1., 2., 3.).asDiagonal()).sparseView();
  matrices.B            = matrices.M;
  matrices.C            = 4. * matrices.M;
  matrices.translations = Eigen::MatrixXd::Zero(3, 3);
  std::vector<std::string> keys{key_of(matrices, options)};
  const auto               with = [&](auto change)
  {
    auto other = matrices;
    change(other);
    keys.push_back(key_of(other, options));
  };
  with([](Frame &f) { f.M.coeffRef(0, 0) += 1e-15; });
  with([](Frame &f) { f.M.coeffRef(0, 1) = 0.; });
  with([](Frame &f) { f.B.coeffRef(0, 0) = 2.; });
  with([](Frame &f) { f.C.coeffRef(0, 0) = 2.; });
  with([](Frame &f) { f.modal_damping_ratio = 0.02; });
  with([](Frame &f) { f.modal_damping.Z = Eigen::MatrixXd::Ones(3, 1); });
  with([](Frame &f) { f.modal_damping.d = Eigen::VectorXd::Ones(1); });
  with([](Frame &f) { f.interfaces = {{"top", {}, {0, -1, -1, -1, -1, -1}, {1., 1., 1., 1., 1., 1.}}}; });
  with([](Frame &f) { f.interfaces = {{"top", {}, {0, -1, -1, -1, -1, -1}, {-1., 1., 1., 1., 1., 1.}}}; });
  with([](Frame &f) { f.translations(2, 2) = 1.; });
  with([](Frame &f) { f.acceleration_load = Eigen::MatrixXd::Ones(3, 3); });
  with([](Frame &f) { f.rigid_motions = Eigen::MatrixXd::Ones(3, 6); });
  with([](Frame &f) { f.centre[1] = 1.; });
  with([](Frame &f) { f.outputs = {{"cut.a", "N", Eigen::VectorXd::Ones(3), Eigen::VectorXd::Zero(3)}}; });
  with([](Frame &f) { f.picture.points = {{0., 0., 1.}}; });
  with([](Frame &f) { f.picture.displacement.resize(3, 3); });
  with([](Frame &f) { f.mass = 6.; });
  with([](Frame &f) { f.n_cells = 6; });
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(keys[i], keys[j]) << i << " and " << j;
}

TEST(Recipe, ComesBackFromItsText)
{
  const coupling::Recipe recipe{{"a", "1"}, {"b=c\n3 4 d", ""}, {"", "\n\n"}};
  const std::string      text = coupling::text_of(recipe);
  EXPECT_EQ(coupling::text_of(coupling::parse_recipe(text)), text);
  for (const std::string broken : {"x", "1 1 a=1", "1 99999999999999999999 a=1\n", "9 1 a=1\n", "1 1 a:1\n"})
    EXPECT_THROW(coupling::parse_recipe(broken), std::runtime_error) << broken;
}

TEST(Recipe, DifferencesNameWhatIsOtherOrMissing)
{
  const auto found = coupling::differences({{"a", "1"}, {"b", "2"}, {"c", "3"}}, {{"a", "1"}, {"c", "4"}, {"d", "5"}});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name + found[0].first + found[0].second, "b2");
  EXPECT_EQ(found[1].name + found[1].first + found[1].second, "c34");
  EXPECT_EQ(found[2].name + found[2].first + found[2].second, "d5");
}

/// A frame whose file names others.
class ContentKeyOfSeveralFiles : public ContentKey
{
protected:
  void write(const std::string &name, const std::string &text)
  {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }

  void read_from(const std::string &name)
  {
    frame.cad = (folder / name).string();
    key       = key_of(frame, options);
    EXPECT_FALSE(changes());
  }

  bool changes()
  {
    const std::string before = key;
    key                      = key_of(frame, options);
    return key != before;
  }

private:
  std::string key;
};

TEST_F(ContentKeyOfSeveralFiles, ChangesWithEveryFileThatAScriptNames)
{
  for (const std::string script : {"press.geo", "PRESS.GEO"})
  {
    write(script, "Include \"parts/feet.geo\";\nv() = ShapeFromFile(\"column.step\");\nMerge \"absent.step\";\n");
    write("parts/feet.geo", "Include \"sizes.inc\"; Include \"../press.geo\";\n"); // from its own folder; a circle ends
    write("parts/sizes.inc", "h = 1;\n");
    write("column.step", "one");
    write("sizes.inc", "of another folder");
    fs::remove(folder / "absent.step");
    read_from(script);
    write("parts/sizes.inc", "h = 2;\n");
    EXPECT_TRUE(changes());
    write("column.step", "two");
    EXPECT_TRUE(changes());
    write("absent.step", ""); // now it is there
    EXPECT_TRUE(changes());
    write("sizes.inc", "that no file names");
    EXPECT_FALSE(changes());
  }
}

TEST_F(ContentKeyOfSeveralFiles, ChangesWithEveryFileThatAMeshOfAbaqusIncludes)
{
  for (const std::string mesh : {"frame.inp", "FRAME.INP"})
  {
    write(mesh, "** *INCLUDE, INPUT=comment.inc\n*include, input=parts/nodes.inc\n*ELEMENT, TYPE=C3D4,\n"
                "INPUT = \"the cells.inc\"\n*AMPLITUDE, INPUT=force.csv\n");
    write("parts/nodes.inc", "*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=more.inc\n*INCLUDE, INPUT=nodes.inc\n"); // a circle
    write("parts/more.inc", "2, 1, 0, 0\n");
    write("the cells.inc", "1, 1, 2, 3, 4\n");
    write("force.csv", "0, 1\n");
    write("comment.inc", "");
    read_from(mesh);
    write("parts/nodes.inc", "*NODE\n1, 0, 0, 1\n*INCLUDE, INPUT=more.inc\n");
    EXPECT_TRUE(changes());
    write("parts/more.inc", "2, 2, 0, 0\n");
    EXPECT_TRUE(changes());
    write("the cells.inc", "1, 1, 2, 4, 3\n");
    EXPECT_TRUE(changes());
    write("force.csv", "0, 2\n"); // of no matter for a mesh
    write("comment.inc", "1");
    EXPECT_FALSE(changes());
  }
}

TEST_F(ContentKey, OfAMissingFileIsRefused)
{
  frame.cad = (folder / "absent.step").string();
  EXPECT_THROW(key_of(frame, options), std::invalid_argument);
}

} // namespace
} // namespace gestell
