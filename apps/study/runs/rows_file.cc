#include "apps/study/runs/rows_file.h"

#include "apps/output/text/csv.h"
#include "apps/scene/file/csv_file.h"
#include "coupling/frame/atomic_file.h"
#include "coupling/frame/number_in_file.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <sys/file.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

constexpr auto failed_word = "failed: ";

/// In quotes where it must be; on one line.
std::string cell(std::string text)
{
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return csv_field(text);
}

double number_of(const std::string &text)
{
  double            value = 0.;
  const char *const end   = coupling::read_number(text.c_str(), value);
  if (text.empty())
    return std::numeric_limits<double>::quiet_NaN();
  if (*end != '\0')
    throw std::invalid_argument("'" + text + "' is not a number");
  return value;
}

int whole_number(const std::string &text)
{
  const double value = number_of(text);
  if (!(value >= 0. && value <= std::numeric_limits<int>::max() && value == std::floor(value)))
    throw std::invalid_argument("'" + text + "' is not the number of a run");
  return int(value);
}

std::string number_cell(double value)
{
  return std::isfinite(value) ? exact_text(value) : "";
}

} // namespace

std::string RowsText::head(const std::vector<std::string> &units) const
{
  std::string line = "run,status";
  for (const VariableRequest &request : variables_)
    line += ',' + cell(request.variable.head());
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    line += ',' + cell(StudyOutput{outputs_[i].name, i < units.size() ? units[i] : ""}.head());
  return line + ",cpu_s\n";
}

bool RowsText::is_head(const std::string &line) const
{
  const auto names = [](const std::string &head)
  {
    std::vector<std::string> cells = csv_cells(head);
    for (std::string &name : cells)
      name.resize(std::min(name.size(), name.find(" [")));
    return cells;
  };
  const std::string own = head();
  return names(line) == names(own.substr(0, own.size() - 1));
}

std::string RowsText::line(const RunRow &row, const Eigen::VectorXd &levels) const
{
  std::string line = std::to_string(row.run) + ',';
  line += row.status == RunStatus::done ? "done" : cell(failed_word + row.message);
  for (std::size_t i = 0; i < variables_.size(); ++i)
    line += ',' + (variables_[i].variable.words.empty() ? number_cell(levels[Eigen::Index(i)])
                                                        : cell(variables_[i].text(levels[Eigen::Index(i)])));
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    line += ',' + (row.values.empty() ? "" : number_cell(row.values[i]));
  return line + ',' + rounded(row.cpu_s) + '\n';
}

RunRow RowsText::row(const std::string &line) const
{
  const std::vector<std::string> cells    = csv_cells(line);
  const std::size_t              expected = 3 + variables_.size() + outputs_.size();
  if (cells.size() != expected)
    throw std::invalid_argument("has " + std::to_string(cells.size()) + " cells instead of " +
                                std::to_string(expected));
  RunRow row;
  row.run    = whole_number(cells[0]);
  row.status = cells[1] == "done" ? RunStatus::done : RunStatus::failed;
  if (row.status == RunStatus::failed)
    row.message = cells[1].substr(std::min(cells[1].size(), std::string(failed_word).size()));
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    row.values.push_back(number_of(cells[2 + variables_.size() + i]));
  row.cpu_s = number_of(cells.back());
  return row;
}

std::vector<RunRow> read_rows(const std::filesystem::path &file, const RowsText &text)
{
  std::ifstream       in(file);
  std::vector<RunRow> rows;
  std::string         line;
  for (int number = 1; std::getline(in, line); ++number)
  {
    if (in.eof()) // its end was not written
      break;
    const std::string place = file.string() + ":" + std::to_string(number) + ": ";
    if (number == 1 && !text.is_head(line))
      throw std::invalid_argument(place + "has other columns than this study: " + line +
                                  "; use a separate folder for each study (-o)");
    try
    {
      if (number > 1)
        rows.push_back(text.row(line));
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(place + error.what() + "; remove the line to repeat its run");
    }
  }
  return rows;
}

RowsFile::RowsFile(const std::filesystem::path &file) : path_(file)
{
  file_ = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw coupling::WriteFailure(file.string(), std::error_code(errno, std::generic_category()));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0)
  {
    close(file_);
    throw std::invalid_argument(
        file.string() +
        ": another gestell study is writing it; use a separate folder for each study (-o), or wait until it ends");
  }
  std::ifstream in(file);
  std::string   line;
  off_t         whole = 0;
  while (std::getline(in, line) && !in.eof())
    whole += off_t(line.size()) + 1;
  if (ftruncate(file_, whole) != 0 || lseek(file_, 0, SEEK_END) < 0)
    throw coupling::WriteFailure(file.string(), std::error_code(errno, std::generic_category()));
}

RowsFile::~RowsFile()
{
  close(file_);
}

void RowsFile::append(const std::string &head, const std::string &line)
{
  if (lseek(file_, 0, SEEK_CUR) == 0)
    write_line(head);
  write_line(line);
}

void RowsFile::write_line(const std::string &line)
{
  const off_t before = lseek(file_, 0, SEEK_CUR);
  for (std::size_t done = 0; done < line.size();)
  {
    const ssize_t n = write(file_, line.data() + done, line.size() - done);
    if (n < 0 && errno != EINTR)
    {
      const std::error_code reason(errno, std::generic_category());
      if (ftruncate(file_, before) == 0) // else the line without an end is passed over
        lseek(file_, before, SEEK_SET);
      throw coupling::WriteFailure(path_.string(), reason);
    }
    done += std::size_t(std::max<ssize_t>(n, 0));
  }
}

} // namespace gestell::apps
