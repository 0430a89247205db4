#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A question of an engineer, and the command that answers it.
struct Question
{
  std::string asks;    ///< "Which natural frequencies and mode shapes?"
  std::string command; ///< "modes SCENE"
};

/// All of them, by subject; to add one, write its line.
const std::vector<Question> &questions();

/// As a table of Markdown.
std::string question_table();
/// For a terminal; only those that contain every word of `words`.
std::string question_lines(const std::string &words = "");

} // namespace gestell::apps
