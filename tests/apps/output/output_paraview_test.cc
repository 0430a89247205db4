#include "apps/output/paraview/paraview.h"
#include "tests/support/output_example.h"

#include "apps/output/paraview/face_surface.h"
#include "tests/support/test.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <fstream>
#include <random>
#include <regex>

using namespace gestell::apps;
namespace fs = std::filesystem;

namespace
{

void write_paraview(const fs::path &folder, const Result &result, std::vector<std::string> &names)
{
  OwnFolder own(folder);
  for (const auto &series : paraview_series())
    series(own, result, names);
}

class ParaviewFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(GESTELL_BINARY_DIR) / "test-output" /
             (std::string("paraview-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  vtkPolyData *read(const std::string &file)
  {
    reader->SetFileName((folder / file).c_str());
    reader->Update();
    return reader->GetOutput();
  }

  /// (time, part, file) of each data set of a collection.
  std::vector<std::tuple<double, int, std::string>> data_sets(const std::string &pvd) const
  {
    std::ifstream     file(folder / pvd);
    std::stringstream content;
    content << file.rdbuf();
    const std::string text = content.str();
    const std::regex  entry("timestep=\"([^\"]*)\" part=\"([^\"]*)\" file=\"([^\"]*)\"( name=\"[^\"]*\")?/>");

    std::vector<std::tuple<double, int, std::string>> sets;
    for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it)
      sets.emplace_back(std::stod((*it)[1]), std::stoi((*it)[2]), (*it)[3]);
    return sets;
  }

  fs::path                     folder;
  vtkNew<vtkXMLPolyDataReader> reader;
  std::vector<std::string>     names;
};

} // namespace

TEST_F(ParaviewFiles, MotionHoldsFrameAndMechanismAtEveryInstantWithTrueDisplacements)
{
  const Result result = example_result();
  EXPECT_TRUE(lacks_for_paraview().empty());
  write_paraview(folder, result, names);
  const auto sets = data_sets("motion.pvd");
  ASSERT_EQ(sets.size(), 6u);
  EXPECT_EQ(std::get<0>(sets[2]), 0.2);
  EXPECT_EQ(std::get<1>(sets[3]), 1);
  std::stringstream text;
  text << std::ifstream(folder / "motion.pvd").rdbuf();
  EXPECT_NE(text.str().find("mechanism_00000.vtp\" name=\"mechanism\"/>"), std::string::npos);

  vtkPolyData *frame = read(std::get<2>(sets[2]));
  ASSERT_EQ(frame->GetNumberOfPoints(), 8);
  ASSERT_EQ(frame->GetNumberOfPolys(), 12);
  auto *field = frame->GetPointData()->GetArray("displacement [m]");
  ASSERT_NE(field, nullptr);
  EXPECT_FLOAT_EQ(field->GetComponent(4, 0), 1e-4f); // the top sways
  EXPECT_FLOAT_EQ(field->GetComponent(0, 0), 0.f);
  EXPECT_FLOAT_EQ(field->GetComponent(0, 2), 2e-4f);

  vtkPolyData *mechanism = read(std::get<2>(sets[3]));
  EXPECT_GT(mechanism->GetNumberOfPolys(), 36 * 4);
  EXPECT_NE(mechanism->GetPointData()->GetArray("displacement [m]"), nullptr);
  for (const std::string &name : names)
    EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST_F(ParaviewFiles, FrameModesAreScaledToATwentiethOfTheFrame)
{
  const Result result = example_result();
  write_paraview(folder, result, names);
  const auto sets = data_sets("frame_modes.pvd");
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(std::get<0>(sets[1]), 2.);
  vtkPolyData *frame    = read(std::get<2>(sets[0]));
  const double diagonal = std::sqrt(1. + 1. + 4.);
  EXPECT_NEAR(frame->GetPointData()->GetArray("displacement [m]")->GetRange(-1)[1], 0.05 * diagonal, 1e-6);
  EXPECT_EQ(frame->GetFieldData()->GetArray("frequency [Hz]")->GetTuple1(0), 20.);
}

TEST_F(ParaviewFiles, AFrameWithoutSkinShowsItsInterfacesAsPoints)
{
  Result result = example_result();
  result.scenery.points.clear();
  result.scenery.triangles.clear();
  write_paraview(folder, result, names);
  vtkPolyData *frame = read(std::get<2>(data_sets("motion.pvd")[0]));
  ASSERT_EQ(frame->GetNumberOfPoints(), 1);
  EXPECT_EQ(frame->GetNumberOfVerts(), 1);
  EXPECT_FLOAT_EQ(frame->GetPointData()->GetArray("displacement [m]")->GetComponent(0, 0), 1e-4f);
}

TEST_F(ParaviewFiles, StressHoldsInvariantsAndComponentsAtEveryPoint)
{
  write_paraview(folder, with_stress(example_result()), names);
  const auto sets = data_sets("stress.pvd");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(std::get<0>(sets[0]), 0.2341);
  vtkPolyData *skin  = read(std::get<2>(sets[0]));
  auto        *field = skin->GetPointData();
  ASSERT_EQ(skin->GetNumberOfPoints(), 8);
  EXPECT_FLOAT_EQ(field->GetArray("von Mises stress [Pa]")->GetTuple1(7), 80e6f);
  EXPECT_FLOAT_EQ(field->GetArray("principal stresses [Pa]")->GetComponent(3, 0), 40e6f);
  EXPECT_FLOAT_EQ(field->GetArray("principal stresses [Pa]")->GetComponent(3, 2), 0.f);
  EXPECT_FLOAT_EQ(field->GetArray("first principal direction")->GetComponent(3, 2), 1.f);
  EXPECT_EQ(field->GetArray("stress xx yy zz xy yz xz [Pa]")->GetNumberOfComponents(), 6);
  EXPECT_FLOAT_EQ(field->GetArray("stress xx yy zz xy yz xz [Pa]")->GetComponent(3, 2), 40e6f);
  EXPECT_FLOAT_EQ(field->GetArray("displacement [m]")->GetComponent(5, 0), 1e-4f);
}

TEST_F(ParaviewFiles, CoupledModesMoveFrameAndBodiesTogetherTheLargestByATwentiethOfTheMachine)
{
  Result result   = example_result();
  result.modes_at = result.run->picture_states.front();
  result.coupled_modes.front().shape << 2e-2, 0., 0., 1e-2; // the top sways twice as far as the slide slides
  write_paraview(folder, result, names);
  EXPECT_FALSE(fs::exists(folder / "coupled_modes.pvd")); // of a run: its page shows them
  result.run.reset();
  write_paraview(folder, result, names);
  const auto sets = data_sets("coupled_modes.pvd");
  ASSERT_EQ(sets.size(), 2u);
  const auto largest = [](vtkPolyData *part)
  { return part->GetPointData()->GetArray("displacement [m]")->GetRange(-1)[1]; };
  vtkPolyData *frame = read(std::get<2>(sets[0]));
  const double sway  = largest(frame);
  EXPECT_FLOAT_EQ(frame->GetFieldData()->GetArray("frequency [Hz]")->GetTuple1(0), 11.58486756566711);
  EXPECT_NEAR(sway, 0.05 * std::sqrt(1. + 1. + 2.3 * 2.3), 0.01); // the crank stands out above the box
  vtkPolyData *mechanism = read(std::get<2>(sets[1]));
  EXPECT_NEAR(largest(mechanism), sway, 1e-5); // of the crank, which the top carries
  auto *names_of_bodies = vtkStringArray::SafeDownCast(mechanism->GetFieldData()->GetAbstractArray("body names"));
  ASSERT_NE(names_of_bodies, nullptr);
  EXPECT_EQ(names_of_bodies->GetValue(1), "slide");
  for (vtkIdType i = 0; i < mechanism->GetNumberOfCells(); ++i)
    if (mechanism->GetCellData()->GetArray("body")->GetTuple1(i) == 2)
    {
      EXPECT_NEAR(mechanism->GetPointData()
                      ->GetArray("displacement [m]")
                      ->GetComponent(mechanism->GetCell(i)->GetPointId(0), 2),
                  -0.5 * sway, 1e-5); // down, along its axis
    }
}

TEST_F(ParaviewFiles, VelocitiesAreThoseOfThePointsOfFrameAndBodies)
{
  Result result = example_result();
  for (int k = 0; k < 3; ++k)
    result.run->picture_velocities.push_back((Eigen::VectorXd(4) << 0.02, 0., 10., 0.5).finished());
  write_paraview(folder, result, names);
  const auto sets = data_sets("motion.pvd");
  EXPECT_FLOAT_EQ(read(std::get<2>(sets[0]))->GetPointData()->GetArray("velocity [m/s]")->GetComponent(4, 0), 0.02f);
  vtkPolyData *mechanism = read(std::get<2>(sets[1]));
  auto        *velocity  = mechanism->GetPointData()->GetArray("velocity [m/s]");
  ASSERT_NE(velocity, nullptr);
  double rim = 0.;
  for (vtkIdType i = 0; i < mechanism->GetNumberOfCells(); ++i)
  {
    const vtkIdType point = mechanism->GetCell(i)->GetPointId(0);
    const double    body  = mechanism->GetCellData()->GetArray("body")->GetTuple1(i);
    if (body == 1)
      rim = std::max(rim, std::abs(velocity->GetComponent(point, 2))); // omega r at the outermost point aside
    if (body == 2)
    {
      EXPECT_NEAR(velocity->GetComponent(point, 2), -0.5, 1e-6);
    }
  }
  EXPECT_NEAR(rim, 10. * 0.3, 0.1);
}

/// More on request: `output.allow_large`.
TEST_F(ParaviewFiles, MotionIsAHundredPicturesUnlessLargeResultsAreAllowed)
{
  Result                        result = example_result();
  gestell::coupling::RunResult &run    = *result.run;
  run.picture_times.clear();
  for (int k = 0; k < 250; ++k)
    run.picture_times.push_back(1e-3 * k);
  run.picture_states.assign(250, run.picture_states.front());
  result.requested.run = gestell::coupling::RunOptions();
  write_paraview(folder, result, names);
  const auto sets = data_sets("motion.pvd");
  ASSERT_EQ(sets.size(), 200u); // frame and mechanism
  EXPECT_EQ(std::get<0>(sets.front()), 0.);
  EXPECT_EQ(std::get<0>(sets.back()), 0.249);
  EXPECT_TRUE(fs::exists(folder / "motion/frame_00099.vtp"));

  result.requested.run->allow_large = true;
  write_paraview(folder, result, names);
  EXPECT_EQ(data_sets("motion.pvd").size(), 500u);
}

namespace
{

/// A skin of 40 000 points that are random, so that nothing is compressed: a picture takes more than 1.4 MB.
Result large_result()
{
  std::mt19937                          random(1);
  std::uniform_real_distribution<float> number;
  Result                                result = example_result();
  gestell::coupling::RunResult         &run    = *result.run;
  result.frame_modes.clear();
  result.scenery.points.clear();
  for (int i = 0; i < 40000; ++i)
    result.scenery.points.push_back({number(random), number(random), number(random)});
  result.scenery.triangles.assign(40000, {0, 1, 2});
  result.scenery.displacement = [=](const Eigen::VectorXd &p) mutable -> Eigen::VectorXd
  { return Eigen::VectorXd::NullaryExpr(120000, [&] { return p(0) + double(number(random)); }); };
  run.picture_times.clear();
  for (int k = 0; k < 60; ++k)
    run.picture_times.push_back(1e-3 * k);
  run.picture_states.assign(60, run.picture_states.front());
  run.picture_velocities.assign(60, Eigen::VectorXd::Zero(4));
  return result;
}

double bytes_in(const fs::path &folder)
{
  double bytes = 0.;
  for (const auto &file : fs::directory_iterator(folder))
    bytes += double(fs::file_size(file));
  return bytes;
}

} // namespace

TEST_F(ParaviewFiles, OfALargeFrameTakeAtMost20Megabytes)
{
  write_paraview(folder, large_result(), names);
  EXPECT_LT(bytes_in(folder / "motion"), 20e6);
  EXPECT_GT(bytes_in(folder / "motion"), 17.5e6); // one picture more would be too many
}

/// Other files of the run count: beside a history of 14 MB there is room for some forty pictures of 130 kB, beside one
/// of 30 MB only for a film of 24.
TEST_F(ParaviewFiles, LeaveRoomForTheOtherFilesOfTheRun)
{
  Result result = large_result();
  result.scenery.points.resize(4000);
  result.scenery.triangles.resize(4000);
  result.scenery.displacement = [](const Eigen::VectorXd &p) -> Eigen::VectorXd
  { return Eigen::VectorXd::LinSpaced(12000, p(0), 1.); };
  names = {"history.csv"};
  fs::create_directories(folder);
  std::ofstream(folder / "history.csv") << std::string(14000000, '0');
  write_paraview(folder, result, names);
  const double all = bytes_in(folder / "motion") + 14e6;
  EXPECT_LT(all, 20e6);
  EXPECT_GT(data_sets("motion.pvd").size(), 2u * 24u);

  std::ofstream(folder / "history.csv") << std::string(30000000, '0');
  names = {"history.csv"};
  write_paraview(folder, result, names);
  EXPECT_EQ(data_sets("motion.pvd").size(), 2u * 24u);
}

TEST_F(ParaviewFiles, NameTheBodiesAsTextAtPointsThatMoveWithThem)
{
  const Result result = example_result();
  write_paraview(folder, result, names);
  const auto sets = data_sets("names.pvd");
  ASSERT_EQ(sets.size(), result.run->picture_states.size());
  vtkPolyData *poly   = read(std::get<2>(sets[0]));
  auto        *bodies = vtkStringArray::SafeDownCast(poly->GetPointData()->GetAbstractArray("body"));
  ASSERT_NE(bodies, nullptr);
  ASSERT_EQ(bodies->GetNumberOfValues(), poly->GetNumberOfPoints());
  EXPECT_EQ(bodies->GetValue(0), "crank");
  EXPECT_EQ(poly->GetNumberOfVerts(), poly->GetNumberOfPoints());
  EXPECT_NE(poly->GetPointData()->GetArray("displacement [m]"), nullptr);
}

TEST_F(ParaviewFiles, TheMacroBeginsAtTheMainPeak)
{
  Result result = example_result();
  result.peak   = PeakState{"F_P", "N", 1e6, 0.21, result.run->picture_states[1]};
  write_paraview(folder, result, names);
  std::stringstream text;
  text << std::ifstream(folder / "view.py").rdbuf();
  EXPECT_NE(text.str().find("begin = 0.24 "), std::string::npos) << text.str(); // the first picture behind it
  EXPECT_NE(text.str().find("PVDReader"), std::string::npos);
}

TEST_F(ParaviewFiles, FacesBearTheirNumbersAndSelectors)
{
  gestell::coupling::MeshReport report;
  report.picture.points    = {{0., 0., 0.}, {1., 0., 0.}, {1., 1., 0.}, {0., 1., 0.}};
  report.picture.triangles = {{0, 1, 2}, {0, 2, 3}};
  report.picture.face      = {1, 0};
  for (const int tag : {7, 12})
    report.surfaces.push_back(
        {tag, "", "plane", "plane = { normal = [0, 0, 1], through = [0, 0, 0] }\n", 0.5, {}, {}, {}});
  EXPECT_EQ(write_face_surface(folder / "faces.vtp", report), "");
  vtkPolyData *skin = read("faces.vtp");
  EXPECT_EQ(skin->GetCellData()->GetArray("face")->GetTuple1(0), 12.);
  auto *selectors = vtkStringArray::SafeDownCast(skin->GetFieldData()->GetAbstractArray("selectors"));
  ASSERT_NE(selectors, nullptr);
  EXPECT_EQ(selectors->GetValue(0),
            "[frame.surface.\"face 7\"]\nplane = { normal = [0, 0, 1], through = [0, 0, 0] }\n");
}
