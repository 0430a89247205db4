// What shells and man are told of the command line.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// What bash proposes for the last of the words.
std::string proposed(const Folder &folder, const std::string &words)
{
  const std::string script = "eval \"$('" GESTELL_BINARY_DIR "/bin/gestell' --completion bash)\"\nCOMP_WORDS=(" +
                             words + ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_gestell\necho \"${COMPREPLY[*]}\"\n";
  return shell("bash " + folder.file("complete.sh", script)).text;
}

TEST(Completion, ProposesCommandsOptionsChoicesAndInputs)
{
  const Folder folder("completion");
  EXPECT_EQ(proposed(folder, "gestell pe"), "periodic\n");
  EXPECT_EQ(proposed(folder, "gestell run --sens"), "--sensitivities\n");
  EXPECT_EQ(proposed(folder, "gestell frf x.toml --spacing l"), "log linear\n");
  EXPECT_EQ(proposed(folder, "gestell new cr"), "crane\n");
  EXPECT_EQ(proposed(folder, "gestell help frame.supp"), "frame.support\n");
  folder.file("one.toml", "");
  folder.file("two.step", "");
  const std::string here = std::filesystem::path(folder / "").string();
  EXPECT_EQ(proposed(folder, "gestell run " + here + "o"), here + "one.toml\n");
  EXPECT_EQ(proposed(folder, "gestell mesh " + here + "t"), here + "two.step\n");
}

TEST(Completion, OfAShellThatIsNotKnownIsRefused)
{
  expect_answer(gestell("--completion fish"), 2, {"'bash' and 'zsh'"});
  expect_answer(gestell("--completion zsh"), 0, {"#compdef gestell", "'--sensitivities["});
}

// Every command stands in it with its own options.
TEST(ManPage, ReportsAllThatHelpReports)
{
  const std::string page = gestell("--man").text;
  for (const char *part : {".TH GESTELL 1", "gestell periodic", "\\-\\-sensitivities", ".SH EXIT STATUS", "[KIND]"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("\n'"), std::string::npos); // would be a request
}

} // namespace
} // namespace gestell::tests
