#pragma once

#include "coupling/frame/reduced_frame.h"
#include "tests/support/test.h"

#include <unistd.h>

namespace gestell::test
{

/// A frame with something in every part.
inline coupling::ReducedFrame some_frame()
{
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  coupling::ReducedFrame frame;
  frame.M                 = MatrixXd::Random(5, 5);
  frame.B                 = MatrixXd::Random(5, 5) / 3.;
  frame.C                 = MatrixXd::Random(5, 5) * 1e9;
  frame.n_interface       = 3;
  frame.omega0            = VectorXd::LinSpaced(2, 100. / 7., 300.);
  frame.interfaces        = {{"crown", {0., 0.1, 2.4}, {0, 1, 2, -1, -1, -1}, {1., -1., 1., 1., 1., 1.}}};
  frame.translations_load = MatrixXd::Random(5, 3);
  frame.outputs      = {{"support.feet.z", "N", VectorXd::Random(5), VectorXd::Random(5), Eigen::Vector3d::Random()}};
  frame.points       = {{0., 0., 0.}, {1., 0., 1. / 3.}, {0., 1., 0.}};
  frame.triangles    = {{0, 1, 2}};
  frame.displacement = Eigen::MatrixXf::Random(9, 5);
  frame.n_full       = 150000;
  frame.n_cells      = 25000;
  frame.mass         = 10270.5;
  frame.frequency_limit_hz = 1. / 3.;
  frame.frequencies_hz     = VectorXd::Random(5);
  frame.frequency_error    = VectorXd::Random(5) / 7.;
  frame.static_residual    = 0.1;
  frame.facts.parts        = {{"column", "steel", 10.}, {"motor", "", 1. / 3.}};
  frame.facts.whole.centre = {0.1, 0.2, 1. / 3.};
  frame.facts.free_motions = {"translation along x"};
  frame.facts.buckling_factor = 4. / 3.;
  frame.notes              = {"a note", ""};
  frame.statements         = {"a fact"};
  frame.stress.point       = {0, 1, 2, 1};
  frame.stress.triangles   = {{0, 1, 2}, {0, 3, 2}};
  frame.stress.rigid       = {"support feet", "interface crown"};
  frame.stress.nearby      = {-1, 0, 1, -1};
  frame.stress.mean        = Eigen::MatrixXf::Random(24, 8);
  frame.stress.deviation   = Eigen::MatrixXf::Random(24, 8);
  return frame;
}

inline std::string bytes(const std::string &name)
{
  std::ifstream in(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An empty folder that is the cache and vanishes with the test.
class FrameFolder : public ::testing::Test
{
protected:
  std::filesystem::path folder = std::filesystem::temp_directory_path() / ("gestell_cache_" + std::to_string(getpid()));
  void                  SetUp() override
  {
    std::filesystem::create_directories(folder);
    setenv("GESTELL_CACHE", folder.c_str(), 1);
  }
  void TearDown() override
  {
    unsetenv("GESTELL_CACHE");
    std::filesystem::remove_all(folder);
  }
};

} // namespace gestell::test
