#pragma once

#include <string>

namespace gestell::apps
{

/// Pieces of the report's page; texts are HTML already.
std::string section(const std::string &id, const std::string &title, const std::string &content); ///< "" if empty
std::string figure(const std::string &svg, const std::string &caption = "");
std::string cell(const std::string &text, const char *kind = ""); ///< of a table, kind a class: "n" for numbers
std::string number_cell(double x, int digits = 4);

} // namespace gestell::apps
