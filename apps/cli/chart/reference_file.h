#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table "t, name, name ..." with a header line; units in brackets after a name are ignored.
class ReferenceFile
{
public:
  /// @throws std::invalid_argument for a file that cannot be read, or is not a table of numbers with ascending times
  explicit ReferenceFile(const std::string &path);

  bool                       has(const std::string &name) const;
  const std::vector<double> &column(const std::string &name) const; ///< of a name in the table

  std::string         path;
  std::vector<double> times; ///< [s], two or more

private:
  std::vector<std::string>         names_;
  std::vector<std::vector<double>> columns_;
};

} // namespace gestell::apps
