#pragma once

#include "apps/study/file/study_file.h"
#include "apps/study/runs/run_row.h"

#include <filesystem>

namespace gestell::apps
{

/// The table of a study's runs as text: run, status, variables, outputs, cpu_s.
class RowsText
{
public:
  explicit RowsText(const StudyFile &study) : variables_(study.variables), outputs_(study.outputs) {}

  std::string head() const;
  /// With the end of the line.
  std::string line(const RunRow &row, const Eigen::VectorXd &levels) const;
  /// @throws std::invalid_argument without a place
  RunRow row(const std::string &line) const;

private:
  std::vector<VariableRequest> variables_;
  std::vector<OutputRequest>   outputs_;
};

/// The rows of a file, a last line that was not written to its end left out; none if there is no file.
/// @throws std::invalid_argument with file and line
std::vector<RunRow> read_rows(const std::filesystem::path &file, const RowsText &text);

/// A file that grows by a row as each run ends.
class RowsFile
{
public:
  /// Goes on with a file that is there, from the end of its last whole line.
  /// @throws std::runtime_error if it cannot be written; std::invalid_argument if another process writes it
  RowsFile(const std::filesystem::path &file, const RowsText &text);
  ~RowsFile();
  RowsFile(const RowsFile &) = delete;
  void append(const std::string &line);

private:
  std::filesystem::path path_;
  int                   file_ = -1;
};

} // namespace gestell::apps
