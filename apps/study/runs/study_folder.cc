#include "apps/study/runs/study_folder.h"

#include "apps/output/folder/own_folder.h"
#include "apps/output/text/write_file.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

/// Rows below the head.
std::size_t n_lines(const fs::path &file)
{
  std::ifstream in(file);
  std::string   line;
  std::size_t   n = 0;
  while (std::getline(in, line) && !in.eof())
    ++n;
  return n > 0 ? n - 1 : 0;
}

bool is_share_file(const fs::path &file)
{
  return file.filename().string().rfind("runs_share_", 0) == 0 && file.extension() == ".csv";
}

} // namespace

StudyShare share_of(const std::string &text)
{
  StudyShare        share;
  std::size_t       end = 0;
  const std::size_t bar = text.find('/');
  try
  {
    if (bar == std::string::npos)
      throw std::invalid_argument("");
    share.part = std::stoi(text.substr(0, bar), &end);
    if (end != bar)
      throw std::invalid_argument("");
    share.of = std::stoi(text.substr(bar + 1), &end);
    if (end + bar + 1 != text.size() || share.part < 1 || share.of < share.part)
      throw std::invalid_argument("");
  }
  catch (const std::logic_error &)
  {
    throw std::invalid_argument("--share " + text +
                                ": needs part/number of parts, such as 3/10, with 1 <= part <= number");
  }
  return share;
}

std::string StudyFolder::name_of(const StudyShare &share)
{
  return share.is_whole() ? std::string("runs.csv")
                          : "runs_share_" + std::to_string(share.part) + "_of_" + std::to_string(share.of) + ".csv";
}

std::vector<fs::path> StudyFolder::share_files() const
{
  std::vector<fs::path> files;
  std::error_code       none;
  for (const auto &entry : fs::directory_iterator(folder_, none))
    if (is_share_file(entry.path()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<RunRow> StudyFolder::rows() const
{
  std::vector<fs::path> files = share_files();
  files.push_back(folder_ / "runs.csv");
  std::map<int, RunRow> rows;
  for (const fs::path &file : files)
    for (RunRow &row : read_rows(file, text_))
      if (row.run >= 1 && row.run <= levels_.rows())
        rows[row.run] = std::move(row);
  std::vector<RunRow> sorted;
  for (auto &[run, row] : rows)
    sorted.push_back(std::move(row));
  return sorted;
}

void StudyFolder::refuse_other_study() const
{
  const auto before = read_record(folder_ / "study.json");
  if (!before && fs::exists(folder_ / "runs.csv"))
    throw std::invalid_argument(
        folder_.string() + ": contains a runs.csv without the study.json of its study; name another folder with -o");
  if (before && before->study != record_.study)
    throw std::invalid_argument(folder_.string() + ": contains rows of the study '" + before->study +
                                "', but this study is '" + record_.study +
                                "'; use a separate folder for each study (-o)");
}

void StudyFolder::refuse_changes() const
{
  const auto before = read_record(folder_ / "study.json");
  if (!before)
    return;
  const auto changes = differences(*before, record_);
  if (changes.empty())
    return;
  std::string           text;
  constexpr std::size_t most_listed = 5; // lines of a message
  for (std::size_t i = 0; i < std::min(most_listed, changes.size()); ++i)
    text += "\n  " + changes[i];
  if (changes.size() > most_listed)
    text += "\n  and " + std::to_string(changes.size() - most_listed) + " further ones";
  throw std::invalid_argument(folder_.string() + ": its rows were computed before the study was changed:" + text +
                              "\n  undo the change, or name another folder with -o");
}

/// In the list of what is ours, before the files appear.
void StudyFolder::enter_own(const std::string &rows) const
{
  OwnFolder own(folder_);
  own.adopt("study.json");
  own.adopt(rows);
}

std::vector<RunRow> StudyFolder::begun_anew()
{
  const auto        before = read_record(folder_ / "study.json");
  const std::size_t there  = n_lines(folder_ / "runs.csv");
  if (before && there > 0 && int(there) < before->n_runs)
    throw std::invalid_argument(folder_.string() + ": contains " + std::to_string(there) + " of " +
                                std::to_string(before->n_runs) +
                                " rows of this study; continue with --resume, or remove runs.csv to start again");
  fs::create_directories(folder_);
  enter_own("runs.csv");
  fs::remove(folder_ / "runs.csv");
  write_record(folder_ / "study.json", record_);
  return {};
}

/// Without --resume: a call that makes all runs, where no rows of shares wait to be merged.
bool StudyFolder::begins_anew(Begin begin, const StudyShare &share) const
{
  if (begin == Begin::resumed || !share_files().empty())
    return false;
  const std::size_t there = n_lines(folder_ / "runs.csv");
  if (!share.is_whole() && !share.together && there > 0)
    throw std::invalid_argument(folder_.string() + ": contains " + std::to_string(there) +
                                " rows of this study; complete them with --resume, or remove runs.csv to start again");
  return share.is_whole() || (share.together && there > 0);
}

std::vector<RunRow> StudyFolder::open(Begin begin, const StudyShare &share)
{
  refuse_other_study();
  if (begins_anew(begin, share))
    return begun_anew();
  const bool shares = !share_files().empty();
  if (shares || n_lines(folder_ / "runs.csv") > 0)
    refuse_changes();
  if (begin == Begin::anew && !share.is_whole() && n_lines(rows_file(share)) > 0)
    throw std::invalid_argument(rows_file(share).string() +
                                ": already contains rows of this share; continue with --resume, or remove it");
  std::vector<RunRow> known = rows();
  fs::create_directories(folder_);
  enter_own(name_of(share));
  if (const auto before = read_record(folder_ / "study.json"); before && differences(*before, record_).empty())
    record_.units = before->units;
  write_record(folder_ / "study.json", record_);
  if (share.is_whole() && shares)
    merge(known);
  return known;
}

void StudyFolder::keep_units(const std::vector<std::string> &units)
{
  record_.units = units;
  write_record(folder_ / "study.json", record_);
}

void StudyFolder::merge(const std::vector<RunRow> &rows)
{
  std::string text = text_.head(record_.units);
  for (const RunRow &row : rows)
    text += text_.line(row, levels_.row(row.run - 1).transpose());
  write_file(folder_ / "runs.csv", text);
  for (const fs::path &file : share_files())
    fs::remove(file);
}

} // namespace gestell::apps
