// What an FMU and its export refuse, and what they say.

#include "tests/apps/fmu/exported_fmu.h"
#include "tests/support/test.h"

namespace gestell::tests
{

TEST(FmuExport, TakesFilesThatKeysNameAndNoOthers)
{
  const Folder folder("fmu_files");
  const auto   nearby = [&](const std::string &name, const std::string &text) { std::ofstream(folder / name) << text; };
  nearby("secret.txt", "not for others");
  nearby("m.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 3\n");
  nearby("c.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 2e5\n");
  std::string text = "description = \"secret.txt\"\n" + oscillator("one", 2., 800., 0.) +
                     "[frame]\nmass = \"m.mtx\"\nstiffness = \"c.mtx\"\n"
                     "[frame.interface.end]\nrows = { ux = 1 }\n";
  const Exported    slider(folder, "slider", folder.file("one.toml", text));
  const auto        resources = slider.fmu->folder() / "resources";
  const std::string carried   = read(resources / "scene.toml");
  EXPECT_THAT(carried, testing::HasSubstr("description = \"secret.txt\""));
  int files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(resources / "files"))
  {
    EXPECT_EQ(entry.path().extension(), ".mtx") << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 2);
  EXPECT_EQ(slider.fmu->head().at("description"), "secret.txt");
  FmuInstance one(*slider.fmu);
  EXPECT_EQ(one.start(), fmi2OK) << one.last_message();
}

TEST(Fmu, SaysWhatIsWrong)
{
  const Folder   folder("fmu_wrong");
  const Exported press(folder, "press", scene("press_minimal.toml"), "--inputs F=slide");
  const Fmu     &fmu = *press.fmu;
  FmuInstance    one(fmu);
  const auto     says = [&](fmi2Status status, const std::string &part)
  {
    EXPECT_EQ(status, fmi2Error);
    EXPECT_THAT(one.last_message(), testing::HasSubstr(part));
  };
  says(one.step(0., 1e-3), "is not for an FMU before its initialisation");
  says(one.set("F_P", 1.), "'F_P' is an output");
  says(one.set("c_P", std::nan("")), "needs a finite number");
  says(one.get_reference(9999), "there is no variable with the value reference 9999; valid: 0 to");
  EXPECT_EQ(one.set("l", 0.05), fmi2OK); // a rod shorter than its crank
  says(one.start(), "element.rod");
  EXPECT_EQ(one.reset(), fmi2OK);
  ASSERT_EQ(one.start(), fmi2OK) << one.last_message();
  EXPECT_EQ(one.step(0., 1e-3), fmi2OK);
  says(one.step(0., 1e-3), "the step begins at 0 s, but the machine is at 0.001 s");
  says(one.step(1e-3, -1e-3), "its length must be above zero");
  says(one.set("c_P", 1e9), "'c_P' is fixed once the machine has started");
  fmi2FMUstate none = nullptr;
  says(one.from_bytes("gestell", none), "not a state of an FMU");
  EXPECT_EQ(one.step(1e-3, 1e-3), fmi2OK); // and it goes on
  EXPECT_EQ(one.terminate(), fmi2OK);
  says(one.step(2e-3, 1e-3), "after its end");
}

TEST(Fmu, RefusesDamagedResources)
{
  const Folder   folder("fmu_damaged");
  const Exported press(folder, "press", scene("press_minimal.toml"));
  const Fmu     &fmu      = *press.fmu;
  const auto     resource = fmu.folder() / "resources";
  const auto     refused  = [&](const FmuInstance &instance, const std::string &part)
  {
    EXPECT_FALSE(instance.alive());
    EXPECT_THAT(instance.last_message(), testing::HasSubstr(part));
  };
  refused(FmuInstance(fmu, "one", "{other}"), "they belong to different FMUs");
  refused(FmuInstance(fmu, "one", "", "file:///nowhere"), "there is no scene.toml in /nowhere");
  refused(FmuInstance(fmu, "one", "", "https://example.org/x"), "only file:// can be read");
  const std::string text = read(resource / "scene.toml");
  std::ofstream(resource / "scene.toml") << text.substr(0, text.size() / 2);
  refused(FmuInstance(fmu), "scene.toml");
  std::ofstream(resource / "scene.toml") << text;
  std::ofstream(resource / "fmu.toml") << "guid = 1\n";
  refused(FmuInstance(fmu), "it was changed after gestell export");
}

TEST(FmuExport, RefusesOddInputWithTheWayOut)
{
  const Folder folder("fmu_odd");
  const auto   refused = [&](const std::string &arguments, const std::vector<std::string> &words)
  {
    expect_answer(gestell("export " + arguments + " --fmu '" + (folder / "x.fmu").string() + "'"), 2, words);
    EXPECT_FALSE(std::filesystem::exists(folder / "x.fmu"));
  };
  refused(scene("press_minimal.toml") + " --inputs slid", {"--inputs slid", "there is no marker 'slid'", "'slide'"});
  refused(scene("press_minimal.toml") + " --inputs frame.crwn.uz", {"frame.crwn", "crown"});
  refused(scene("press_minimal.toml") + " --inputs F_P=slide", {"scene.toml: 'F_P' is an input and a signal"});
  refused(scene("press_minimal.toml") + " --set start.rule='periodic'",
          {"an FMU does not search for periodic solutions"});
  refused(scene("press_minimal.toml") + " --set 'element.rod.length=60 mm'", {"element.rod"});
  refused(scene("press_minimal.toml") + " --inputs frame.crown.rx", {"acts on a DOF that does not exist"});
  refused(scene("press_minimal.toml") + " --inputs F=slide,F=crank", {"there is an input 'F' already"});
  refused(scene("press_minimal.toml") + " -o somewhere", {"use one of the two options"});
  const std::string file = folder.file("file", "");
  expect_answer(
      gestell("export " + scene("press_minimal.toml") + " --fmu " + file.substr(0, file.size() - 1) + "/x.fmu'"), 2,
      {"file"});
}

} // namespace gestell::tests
