#pragma once

#include "apps/study/file/study_file.h"
#include "apps/study/runs/run_row.h"

#include <filesystem>

namespace gestell::apps
{

/// The table of a study's runs as text: run, status, variables, outputs, cpu_s; with units of variables and outputs in
/// the head, "rod [kN/mm]".
class RowsText
{
public:
  explicit RowsText(const StudyFile &study) : variables_(study.variables), outputs_(study.outputs) {}

  /// @param units  of the outputs; empty: not known yet
  std::string head(const std::vector<std::string> &units = {}) const;
  /// Whether this is the head of such a table, with or without units.
  bool is_head(const std::string &line) const;
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
  explicit RowsFile(const std::filesystem::path &file);
  ~RowsFile();
  RowsFile(const RowsFile &) = delete;
  /// @param head  line above the first row
  void append(const std::string &head, const std::string &line);

private:
  void write_line(const std::string &line);

  std::filesystem::path path_;
  int                   file_ = -1;
};

} // namespace gestell::apps
