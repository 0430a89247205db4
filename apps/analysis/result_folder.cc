#include "apps/analysis/result_folder.h"

#include "apps/analysis/result_files.h"
#include "apps/output/folder/writing.h"
#include "apps/output/paraview/paraview.h"
#include "apps/output/report/report.h"
#include "apps/output/report/section.h"
#include "apps/output/tables/summary_json.h"
#include "apps/output/text/csv.h"
#include "apps/output/text/number_rows.h"
#include "apps/session/phase_times.h"
#include "coupling/frame/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <set>
#include <stdexcept>

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

[[noreturn]] void refuse(const fs::path &folder, const std::string &reason)
{
  throw std::invalid_argument("result folder " + folder.string() + ": " + reason +
                              "; name a folder that can be written with -o DIR.");
}

/// Rejects a file in place of a folder.
void require_folder(const fs::path &folder)
{
  std::error_code error;
  if (folder.empty())
    refuse(folder, "the name is empty");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse(folder, "this is a file, not a folder");
}

[[noreturn]] void refuse_unwritable(const fs::path &folder, const std::error_code &failure)
{
  std::error_code none;
  refuse(folder, std::string("it cannot be ") + (fs::exists(folder, none) ? "written (" : "created (") +
                     failure.message() + ")");
}

/// The report of a run would replace that of a study.
void require_no_study(const fs::path &folder)
{
  if (OwnFolder(folder).owns("study.json"))
    refuse(folder, "it contains a study, whose report would be overwritten");
}

const char *const complete = "summary.json"; ///< the first to be removed and the last to be written

bool is_full(const std::error_code &error)
{
  return error == std::errc::no_space_on_device || error == std::errc::io_error ||
         error == std::error_code(EDQUOT, std::generic_category());
}

const char *const history = "history.csv";

/// The longest table, in pieces: as a text it would take as much memory as the file.
void write_history(Writing &writing, const coupling::RunResult &run)
{
  if (run.columns.empty())
    return;
  writing.together(
      [&](OwnFolder &folder, std::vector<std::string> &names)
      {
        names.push_back(history);
        coupling::AtomicFile file(folder.claim(history).string());
        file.stream() << std::string(CsvTable(heads_of(run.columns, run.units)));
        write_number_rows(run.rows, run.columns.size(),
                          [&](const char *piece, std::size_t length)
                          { file.stream().write(piece, std::streamsize(length)); });
        file.finish();
      });
}

/// Writes files of one function each, if the result has data for them; not the history.
/// @param folder  a Writing or an OwnFolder
template <typename Folder>
void write_tables(Folder &folder, const Result &result)
{
  for (const ResultFile &file : result_files())
  {
    if (const std::string content = file.content && file.name != history ? file.content(result) : ""; !content.empty())
      folder.write(file.name, content);
    if (file.several)
      for (const auto &[name, content] : file.several(result))
        folder.write(name, content);
  }
}

void write_report(Writing &writing, const Result &result)
{
  const Report report = make_report(result);
  writing.write("report.html", report.html);
  for (const auto &[name, svg] : report.charts)
    writing.write("charts/" + name + ".svg", svg);
}

void write_all(const Result &result, Writing &writing)
{
  constexpr std::size_t for_warnings  = 16384; // each is written twice
  Result                with_warnings = result;
  PhaseTimes            phases;
  if (const std::string warning = lacks_for_paraview(); !warning.empty())
    with_warnings.warnings.push_back(warning);
  phases.begin("tables");
  writing.keep_room(complete, summary_json(with_warnings).size() + for_warnings);
  if (result.run)
    write_history(writing, *result.run);
  write_tables(writing, result);
  phases.begin("report");
  write_report(writing, with_warnings);
  phases.begin("ParaView files");
  for (const auto &series : paraview_series())
    writing.together([&](OwnFolder &folder, std::vector<std::string> &names) { series(folder, result, names); });
  phases.end();
  with_warnings.warnings.insert(with_warnings.warnings.end(), writing.failures().begin(), writing.failures().end());
  with_warnings.wall_s.insert(with_warnings.wall_s.end(), phases.seconds().begin(), phases.seconds().end());
  writing.give_room_back();
  writing.write(complete, summary_json(with_warnings));
}

/// Names without folders of files and of those that they link to.
std::set<fs::path> file_names(const std::vector<fs::path> &files)
{
  std::set<fs::path> names;
  std::error_code    none;
  for (const fs::path &file : files)
    names.insert({file.filename(), fs::weakly_canonical(file, none).filename()});
  return names;
}

} // namespace

bool incomplete(const fs::path &folder)
{
  return !fs::exists(folder / complete) &&
         std::any_of(result_files().begin(), result_files().end(),
                     [&](const ResultFile &file) { return fs::exists(folder / file.name); });
}

std::string incomplete_words(const fs::path &folder)
{
  return folder.string() + " contains no " + complete +
         ": a run ended before it had written all results; files that exist are complete, others are missing. Run it "
         "again";
}

void require_writable(const fs::path &folder)
{
  require_folder(folder);
  // Missing folders are created together with their contents: other processes may create and remove the same folders.
  std::error_code failure;
  // while other processes create and remove the folder; each attempt succeeds if no other process interferes
  constexpr int most_looks = 1000;
  for (int tries = 0; tries < most_looks; ++tries)
    if (failure = probe(folder); failure != std::errc::no_such_file_or_directory)
      break;
  if (failure)
    refuse_unwritable(folder, failure);
}

void require_room(const fs::path &folder, const std::vector<std::string> &more, const std::vector<fs::path> &inputs)
{
  require_writable(folder);
  std::vector<std::string> names = result_names();
  names.insert(names.end(), more.begin(), more.end());
  OwnFolder(folder).require_free(names, inputs);
  require_no_study(folder);
}

void prepare_folder(const fs::path &folder, const std::vector<fs::path> &inputs)
{
  require_folder(folder);
  if (const std::error_code failure = probe(folder); failure && !is_full(failure))
    refuse_unwritable(folder, failure);
  require_no_study(folder);
  OwnFolder own(folder);
  own.require_free(result_names(), inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !is_full(error))
    refuse(folder, "it cannot be created (" + error.message() + ")");
  try
  {
    own.remove(complete);
    const std::set<fs::path> kept = file_names(inputs);
    own.remove_all(
        [&](const std::string &name)
        { return is_result(name) && !(kept.count(fs::path(name).filename()) > 0 && own.is_any_of(name, inputs)); });
  }
  catch (const fs::filesystem_error &problem)
  {
    refuse(folder, "results of an earlier run cannot be removed (" + std::string(problem.what()) + ")");
  }
}

std::vector<std::string> write_results(const fs::path &folder, const Result &result)
{
  return write_or_rescue(folder, [&](Writing &writing) { write_all(result, writing); });
}

void write_modes(const fs::path &folder, const Result &result)
{
  OwnFolder                own(folder);
  std::vector<std::string> names;
  write_tables(own, result); // without a run no history
  for (const auto &series : paraview_series())
    series(own, result, names);
  Pictures pictures;
  for (const auto &answer : result.answers)
    for (const Section &section : answer->sections(result))
      section_html(section, pictures);
  for (const auto &[name, svg] : pictures)
    own.write("charts/" + name + ".svg", svg);
}

} // namespace gestell::apps
