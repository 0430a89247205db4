#include "coupling/reduced_frame_file.h"

#include "coupling/content_key.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using coupling::content_key;
using coupling::ReducedFrame;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ReducedFrame some_frame()
{
  ReducedFrame frame;
  frame.M                 = MatrixXd::Random(5, 5);
  frame.B                 = MatrixXd::Random(5, 5) / 3.;
  frame.C                 = MatrixXd::Random(5, 5) * 1e9;
  frame.n_interface       = 3;
  frame.omega0            = VectorXd::LinSpaced(2, 100. / 7., 300.);
  frame.interfaces        = {{"crown", {0., 0.1, 2.4}, {0, 1, 2, -1, -1, -1}, {1., -1., 1., 1., 1., 1.}}};
  frame.translations_load = MatrixXd::Random(5, 3);
  frame.total_mass        = Eigen::Matrix3d::Identity() * 1e4 / 3.;
  frame.outputs           = {{"support.feet.z", "N", VectorXd::Random(5), VectorXd::Random(5)}};
  frame.points            = {{0., 0., 0.}, {1., 0., 1. / 3.}, {0., 1., 0.}};
  frame.triangles         = {{0, 1, 2}};
  frame.displacement      = Eigen::MatrixXf::Random(9, 5);
  frame.n_full            = 150000;
  frame.n_cells           = 25000;
  frame.mass              = 10270.5;
  frame.frequencies_hz    = VectorXd::Random(5);
  frame.frequency_error   = VectorXd::Random(5) / 7.;
  frame.static_residual   = 0.1;
  frame.notes             = {"a note", ""};
  frame.stress.point      = {0, 1, 2, 1};
  frame.stress.triangles  = {{0, 1, 2}, {0, 3, 2}};
  frame.stress.rigid      = {"support feet", "interface crown"};
  frame.stress.beside     = {-1, 0, 1, -1};
  frame.stress.mean       = Eigen::MatrixXf::Random(24, 8);
  frame.stress.deviation  = Eigen::MatrixXf::Random(24, 8);
  return frame;
}

class ReducedFrameFile : public ::testing::Test
{
protected:
  fs::path    folder = fs::temp_directory_path() / ("gestell_cache_" + std::to_string(getpid()));
  std::string file   = (folder / "below" / "frame.h5").string();
  void        SetUp() override
  {
    fs::create_directories(folder);
    setenv("GESTELL_CACHE", folder.c_str(), 1);
  }
  void TearDown() override
  {
    unsetenv("GESTELL_CACHE");
    fs::remove_all(folder);
  }
  static std::string bytes(const std::string &name)
  {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(ReducedFrameFile, ComesBackBitByBit)
{
  const ReducedFrame frame = some_frame();
  coupling::write_reduced_frame(file, frame);
  const ReducedFrame back = coupling::read_reduced_frame(file);

  EXPECT_EQ(back.M, frame.M);
  EXPECT_EQ(back.B, frame.B);
  EXPECT_EQ(back.C, frame.C);
  EXPECT_EQ(back.n_interface, frame.n_interface);
  EXPECT_EQ(back.omega0, frame.omega0);
  ASSERT_EQ(back.interfaces.size(), 1u);
  EXPECT_EQ(back.interfaces[0].name, "crown");
  EXPECT_EQ(back.interfaces[0].position, frame.interfaces[0].position);
  EXPECT_EQ(back.interfaces[0].coordinate, frame.interfaces[0].coordinate);
  EXPECT_EQ(back.interfaces[0].sign, frame.interfaces[0].sign);
  EXPECT_EQ(back.translations_load, frame.translations_load);
  EXPECT_EQ(back.total_mass, frame.total_mass);
  ASSERT_EQ(back.outputs.size(), 1u);
  EXPECT_EQ(back.outputs[0].name, "support.feet.z");
  EXPECT_EQ(back.outputs[0].unit, "N");
  EXPECT_EQ(back.outputs[0].on_q, frame.outputs[0].on_q);
  EXPECT_EQ(back.outputs[0].on_v, frame.outputs[0].on_v);
  EXPECT_EQ(back.points, frame.points);
  EXPECT_EQ(back.triangles, frame.triangles);
  EXPECT_EQ(back.displacement, frame.displacement);
  EXPECT_EQ(back.stress.point, frame.stress.point);
  EXPECT_EQ(back.stress.triangles, frame.stress.triangles);
  EXPECT_EQ(back.stress.rigid, frame.stress.rigid);
  EXPECT_EQ(back.stress.beside, frame.stress.beside);
  EXPECT_EQ(back.stress.mean, frame.stress.mean);
  EXPECT_EQ(back.stress.deviation, frame.stress.deviation);
  EXPECT_EQ(back.n_full, frame.n_full);
  EXPECT_EQ(back.n_cells, frame.n_cells);
  EXPECT_EQ(back.mass, frame.mass);
  EXPECT_EQ(back.frequencies_hz, frame.frequencies_hz);
  EXPECT_EQ(back.frequency_error, frame.frequency_error);
  EXPECT_EQ(back.static_residual, frame.static_residual);
  EXPECT_EQ(back.notes, frame.notes);
}

TEST_F(ReducedFrameFile, EqualFramesGiveEqualFiles)
{
  const ReducedFrame frame = some_frame();
  coupling::write_reduced_frame(file, frame, "key");
  const std::string first = bytes(file);
  coupling::write_reduced_frame(file, frame, "key");
  EXPECT_EQ(bytes(file), first);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "below"), {}), 1); // nothing is left beside it
}

TEST_F(ReducedFrameFile, DamagedFilesAreRefused)
{
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
  coupling::write_reduced_frame(file, some_frame());
  const std::string whole = bytes(file);
  for (const std::size_t length : {std::size_t(0), std::size_t(100), whole.size() / 2, whole.size() - 1})
  {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument) << length << " bytes";
  }
  std::ofstream(file) << "[frame]\n";
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
}

TEST_F(ReducedFrameFile, PartsThatDoNotFitAreRefused)
{
  ReducedFrame frame = some_frame();
  frame.n_interface  = 4;
  coupling::write_reduced_frame(file, frame);
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
  frame                             = some_frame();
  frame.interfaces[0].coordinate[2] = 4;
  coupling::write_reduced_frame(file, frame);
  EXPECT_THROW(coupling::read_reduced_frame(file), std::invalid_argument);
}

TEST_F(ReducedFrameFile, CacheFindsAFrameByItsKeyAlone)
{
  std::string note;
  EXPECT_FALSE(coupling::find_in_cache("abc", note));
  EXPECT_EQ(note, "");
  EXPECT_EQ(coupling::keep_in_cache("abc", some_frame()), "");
  EXPECT_TRUE(coupling::find_in_cache("abc", note));
  EXPECT_EQ(note, "");

  fs::rename(coupling::cache_file("abc"), coupling::cache_file("def")); // by someone who tidies up
  EXPECT_FALSE(coupling::find_in_cache("def", note));
  EXPECT_NE(note, "");
}

TEST_F(ReducedFrameFile, ADamagedOrReadOnlyCacheIsToldAndDoesNoHarm)
{
  std::string note;
  coupling::keep_in_cache("abc", some_frame());
  fs::resize_file(coupling::cache_file("abc"), 1000);
  EXPECT_FALSE(coupling::find_in_cache("abc", note));
  EXPECT_NE(note.find("reduced anew"), std::string::npos) << note;

  std::ofstream(folder / "file") << "no folder";
  setenv("GESTELL_CACHE", (folder / "file").c_str(), 1);
  EXPECT_NE(coupling::keep_in_cache("abc", some_frame()), "");
}

TEST_F(ReducedFrameFile, CacheFolderFollowsTheEnvironment)
{
  EXPECT_EQ(coupling::cache_folder(), folder.string());
  unsetenv("GESTELL_CACHE");
  setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(coupling::cache_folder(), "/somewhere/gestell");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/of/somebody", 1);
  EXPECT_EQ(coupling::cache_folder(), "/of/somebody/.cache/gestell");
}

TEST_F(ReducedFrameFile, HoldsNoPhysicalCoordinatesBehindTheInterface)
{
  auto frame  = some_frame();
  frame.modal = false;
  EXPECT_THROW(coupling::write_reduced_frame(file, frame), std::invalid_argument);
}

class ContentKey : public ReducedFrameFile
{
protected:
  fem::FrameSpecification    frame;
  coupling::ReductionOptions options;
  void                       SetUp() override
  {
    ReducedFrameFile::SetUp();
    frame.cad = (folder / "frame.step").string();
    std::ofstream(frame.cad) << "ISO-10303-21;";
    frame.material         = {210e9, 0.3, 7850., "scene.toml:3"};
    frame.surfaces["feet"] = {};
    frame.supports = {{"feet", {"feet"}, fem::SupportKind::clamped, {true, true, true}, {}, {}, "scene.toml:9"}};
  }
};

TEST_F(ContentKey, IsAHexadecimalNumberOf256Bits)
{
  const std::string key = content_key(frame, options);
  EXPECT_EQ(key.size(), 64u);
  EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST_F(ContentKey, ForgetsPlacesAndPaths)
{
  const std::string key  = content_key(frame, options);
  auto              same = frame;
  same.place = same.material.place = same.supports[0].place = "elsewhere.toml:1";
  same.cad                                                  = (folder / "copy.step").string();
  fs::copy_file(frame.cad, same.cad);
  auto same_options    = options;
  same_options.place   = "elsewhere.toml:2";
  same_options.n_modes = -7; // as automatic as -1
  EXPECT_EQ(content_key(same, same_options), key);
}

TEST_F(ContentKey, ChangesWithEveryValue)
{
  std::vector<std::string> keys{content_key(frame, options)};
  const auto               with = [&](auto change)
  {
    auto other         = frame;
    auto other_options = options;
    change(other, other_options);
    keys.push_back(content_key(other, other_options));
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
  with([](Frame &, Options &o) { o.n_modes = 12; });
  with([](Frame &, Options &o) { o.tolerance = 0.02; });
  with([](Frame &, Options &o) { o.frequency = 100.; });
  std::ofstream(frame.cad, std::ios::app) << " ";
  keys.push_back(content_key(frame, options));
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(keys[i], keys[j]) << i << " and " << j;
}

TEST_F(ContentKey, ChangesWithEveryFileThatAScriptNames)
{
  const auto write = [&](const std::string &name, const std::string &text)
  {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  frame.cad = (folder / "press.geo").string();
  write("press.geo", "Include \"parts/feet.geo\";\nv() = ShapeFromFile(\"column.step\");\nMerge \"absent.step\";\n");
  write("parts/feet.geo", "Include \"sizes.inc\"; Include \"../press.geo\";\n"); // from its own folder; a circle ends
  write("parts/sizes.inc", "h = 1;\n");
  write("column.step", "one");
  write("sizes.inc", "of another folder");

  std::string key     = content_key(frame, options);
  const auto  changes = [&]
  {
    const std::string before = key;
    key                      = content_key(frame, options);
    return key != before;
  };
  EXPECT_FALSE(changes());
  write("parts/sizes.inc", "h = 2;\n");
  EXPECT_TRUE(changes());
  write("column.step", "two");
  EXPECT_TRUE(changes());
  write("absent.step", ""); // now it is there
  EXPECT_TRUE(changes());
  write("sizes.inc", "that no file names");
  EXPECT_FALSE(changes());
}

TEST_F(ContentKey, OfAMissingFileIsRefused)
{
  frame.cad = (folder / "absent.step").string();
  EXPECT_THROW(content_key(frame, options), std::invalid_argument);
}

} // namespace
} // namespace gestell
