#pragma once
// Calls of the program at the same time, and what each of them left.

#include "tests/support/program.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace gestell::tests
{

/// Calls of the program `at_once` at a time; %1 in the arguments is the number of the call, from 1 on.
inline std::vector<Answer> side_by_side(const Folder &folder, int n, int at_once, const std::string &arguments)
{
  std::string one = arguments;
  for (auto at = one.find("%1"); at != std::string::npos; at = one.find("%1", at))
    one.replace(at, 2, "$1");
  const std::string own    = (folder / "call").string();
  const std::string script = "#!/bin/sh\nGESTELL_CACHE='" + (folder / "cache").string() +
                             "' '" GESTELL_BINARY_DIR "/bin/gestell' " + one + " >" + own +
                             ".$1.text 2>&1\necho $? > " + own + ".$1.code\n";
  folder.file("call.sh", script);
  shell("seq 1 " + std::to_string(n) + " | xargs -P " + std::to_string(at_once) + " -n 1 sh " + own + ".sh");
  std::vector<Answer> answers;
  for (int i = 1; i <= n; ++i)
  {
    const std::string nearby = "call." + std::to_string(i), code = read(folder / (nearby + ".code"));
    answers.push_back({code.empty() ? -1 : std::stoi(code), read(folder / (nearby + ".text"))});
  }
  return answers;
}

/// How many of them ended with that exit code.
inline long ended_with(const std::vector<Answer> &answers, int exit_code)
{
  return std::count_if(answers.begin(), answers.end(), [&](const Answer &a) { return a.exit_code == exit_code; });
}

} // namespace gestell::tests
