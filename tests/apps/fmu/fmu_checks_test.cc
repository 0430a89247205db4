// Runs inside an FMU are checked as those of `gestell run`: the same findings, by the logger of the importer.

#include "tests/apps/fmu/exported_fmu.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace gestell::tests
{
namespace
{

/// What a run warns of and why it ended.
struct Checked
{
  std::vector<std::string> warnings{}, ids{};
  std::string              failure{};
};

/// Findings before a run, which its checks do not make.
bool of_the_scene(const std::string &id)
{
  return id.empty() || id == "scene" || id == "magnitude";
}

/// Findings of the run itself.
Checked checked_run(const Folder &folder, const std::string &scene)
{
  gestell("run " + scene + folder.option());
  const auto summary = nlohmann::json::parse(read(folder.results() / "summary.json"));
  Checked    run;
  for (const auto &finding : summary.at("findings"))
    if (const std::string id = finding.at("id"); finding.at("severity") == "warning" && !of_the_scene(id))
    {
      run.warnings.push_back(finding.at("text"));
      run.ids.push_back(id);
      EXPECT_THAT(summary.at("warnings"), testing::Contains(finding.at("text")));
    }
  if (const auto &failure = summary.at("outcome").at("failure"); failure.is_string())
    run.failure = failure;
  return run;
}

/// The same of an FMU that communicates every H up to `end`, and how many steps succeeded.
Checked checked_fmu(const Fmu &fmu, double H, int steps)
{
  FmuInstance instance(fmu);
  EXPECT_EQ(instance.start(), fmi2OK) << instance.last_message();
  Checked    found;
  fmi2Status status = fmi2OK;
  for (int i = 0; i < steps && status == fmi2OK; ++i)
    status = instance.step(i * H, H);
  if (status != fmi2OK)
  {
    EXPECT_EQ(status, fmi2Error);
    found.failure = instance.last_message();
  }
  else
  {
    EXPECT_EQ(instance.terminate(), fmi2OK);
  }
  for (const FmuMessage &message : instance.messages())
    if (message.category == "logStatusWarning")
    {
      EXPECT_EQ(message.status, fmi2Warning);
      found.warnings.push_back(message.text);
    }
  return found;
}

std::string run_of(const std::string &method, const std::string &step, const std::string &end,
                   const std::string &events = "true")
{
  return "[run]\nmethod = \"" + method + "\"\nstep = \"" + step + "\"\nend = \"" + end + "\"\nevents = " + events +
         "\n[output]\npicture_step = 0\n";
}

const std::string oscillation =
    slider_body("mass", "1 kg", "[1, 0, 0]") + slider_body("block", "1 t", "[1, 0, 0]") +
    element("spring", "spring-damper", {{"from", "mass"}, {"stiffness", "39.478 N/m"}}) +
    element("push", "formula force", {{"from", "block"}, {"force", "10 N*sin(2*pi*10 Hz*t + 1)"}}) +
    table("switch.far", {{"when", "mass.displacement"}, {"above", "5 m"}, {"tell", "push"}, {"order", "off"}}) +
    start("rule = 'given'\nq = { mass = '1 m' }") + "[output.signals]\nx = \"mass.displacement\"\n";

const std::string cylinder = slider_body("slide", "200 kg", "[1, 0, 0]") +
                             element("cylinder", "hydraulic cylinder",
                                     {{"from", "slide"},
                                      {"area_a", "20 cm^2"},
                                      {"area_b", "12 cm^2"},
                                      {"volume_a", "400 cm^3"},
                                      {"volume_b", "500 cm^3"},
                                      {"pressure_a", "10 bar"},
                                      {"pressure_b", "200 bar"},
                                      {"flow", "0"}}) +
                             element("weight", "force", {{"from", "slide"}, {"constant", "22 kN"}}) +
                             start("rule = 'given'\nv = { slide = '80 mm/s' }") +
                             "[output.signals]\nx = \"slide.displacement\"\n";

const std::string wheel = table("frame", {{"mass", "[[1, 0], [0, 1]]"}, {"stiffness", "[[1e4, 0], [0, 1e4]]"}}) +
                          table("frame.interface.seat", {{"rows", "{ rx = 1, rz = 2 }"}}) +
                          rotor_body("wheel", "0.5", "[0, 1, 0]", {{"on", "frame.seat"}}) +
                          start("v = { wheel = '50 rad/s' }") + "[output.signals]\nw = \"wheel.speed\"\n";

/// A mass between two stops: where steps go over the switch of stiffness, its energy comes from nowhere.
const std::string rattle = slider_body("mass", "1 kg", "[1, 0, 0]") +
                           element("stops", "clearance", {{"from", "mass"}, {"gap", "3.7 m"}, {"stiffness", "9 N/m"}}) +
                           start("rule = 'given'\nv = { mass = '1 m/s' }") +
                           "[output.signals]\nx = \"mass.displacement\"\n";

/// A ball that meets a wall after Hertz, which becomes too stiff for the step.
const std::string wall =
    slider_body("ball", "1 kg", "[1, 0, 0]") +
    element("wall", "stop", {{"from", "ball"}, {"gap", "0.1 m"}, {"stiffness", "1e10"}, {"exponent", "1.5"}}) +
    start("rule = 'given'\nv = { ball = '10 m/s' }") + "[output.signals]\nx = \"ball.displacement\"\n";

} // namespace

TEST(FmuChecks, WarnAsThoseOfARun)
{
  struct Case
  {
    const char *name;
    std::string scene;
    double      H; ///< [s]
    int         steps;
    std::string id;
  };
  const Case cases[] = {
      {"oscillation", oscillation + run_of("bdf", "20 ms", "10 s"), 0.25, 40,
       "energy-balance switch-never-thrown step-resolution"},
      {"inside", oscillation + run_of("bdf", "20 ms", "10 s"), 8e-3, 1250,
       "energy-balance switch-never-thrown step-resolution"},
      {"cylinder", cylinder + run_of("bdf", "10 us", "20 ms"), 1e-3, 20, "hydraulic-pressure"},
      {"wheel", wheel + run_of("bdf", "1 ms", "0.1 s"), 1e-2, 10, "gyroscopic-moments"},
  };
  for (const Case &one : cases)
  {
    SCOPED_TRACE(one.name);
    const Folder  folder(std::string("fmu_warned_") + one.name);
    const auto    scene = folder.file("scene.toml", one.scene);
    const Checked run   = checked_run(folder, scene);
    std::string   ids;
    for (const std::string &id : run.ids)
      ids += (ids.empty() ? "" : " ") + id;
    EXPECT_EQ(ids, one.id);
    EXPECT_EQ(run.failure, "");
    const Exported own(folder, "own", scene);
    const Checked  fmu = checked_fmu(*own.fmu, one.H, one.steps);
    EXPECT_EQ(fmu.failure, "");
    EXPECT_EQ(fmu.warnings, run.warnings);
  }
}

TEST(FmuChecks, EndAStepByTheReasonThatEndsARun)
{
  struct Case
  {
    const char *name;
    std::string scene;
    double      H; ///< [s]
    int         steps;
    const char *reason; ///< begins with it where numbers before it are those of an earlier instant
  };
  for (const Case &one :
       {Case{"rattle", rattle + run_of("newmark", "1 s", "4000 s", "false"), 4., 1000, "a spurious energy gain"},
        Case{"wall", wall + run_of("central-difference", "1 ms", "40 ms"), 2e-3, 20,
             "central differences is unstable"}})
  {
    SCOPED_TRACE(one.name);
    const Folder   folder(std::string("fmu_failed_") + one.name);
    const auto     scene = folder.file("scene.toml", one.scene);
    const Checked  run   = checked_run(folder, scene);
    const Exported own(folder, "own", scene);
    const auto     from = run.failure.find(one.reason);
    ASSERT_NE(from, std::string::npos) << run.failure;
    EXPECT_THAT(checked_fmu(*own.fmu, one.H, one.steps).failure, testing::HasSubstr(run.failure.substr(from)));
  }
}

} // namespace gestell::tests
