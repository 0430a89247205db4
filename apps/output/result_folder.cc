#include "apps/output/result_folder.h"

#include "apps/output/paraview/paraview.h"
#include "apps/output/report/comparison_report.h"
#include "apps/output/report/frequency_response_report.h"
#include "apps/output/report/modes_along_report.h"
#include "apps/output/report/report.h"
#include "apps/output/result_files.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/text/write_file.h"
#include "coupling/frame/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
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

constexpr int     most_looks = 1000;           ///< while others make and remove the place
const char *const complete   = "summary.json"; ///< the first to be removed and the last to be written

template <typename Chosen>
void remove_files(const fs::path &folder, const Chosen &chosen)
{
  std::vector<fs::path> old;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder))
    if (chosen(entry.path()) || coupling::abandoned(entry.path().string()))
      old.push_back(entry.path());
  for (const fs::path &path : old)
    fs::remove(path);
}

void remove_earlier_results(const fs::path &folder)
{
  fs::remove(folder / complete);
  for (const ResultFile &file : result_files())
    fs::remove(folder / file.name);
  remove_files(folder,
               [](const fs::path &path)
               {
                 return std::any_of(result_files().begin(), result_files().end(),
                                    [&](const ResultFile &file) { return file.has_name(path.filename().string()); });
               });
  for (const ResultFile &file : result_files())
    if (const fs::path inner = folder / file.folder; !file.folder.empty() && fs::is_directory(inner))
    {
      remove_files(inner, [&](const fs::path &path) { return path.extension() == file.ending; });
      if (fs::is_empty(inner))
        fs::remove(inner);
    }
}

/// Writes and removes a file in the folder; why that failed, or nothing.
std::string probe(const fs::path &folder)
{
  const fs::path path     = folder / ".gestell-probe";
  errno                   = 0;
  const bool      written = static_cast<bool>(std::ofstream(path) << "probe" << std::flush);
  const int       reason  = errno;
  std::error_code error;
  fs::remove(path, error);
  return written ? "" : std::strerror(reason);
}

/// Files that one function each makes, where the result has something for them.
template <typename Write>
void write_tables(const Write &write, const Result &result)
{
  for (const ResultFile &file : result_files())
  {
    if (const std::string content = file.content ? file.content(result) : ""; !content.empty())
      write(file.name, content);
    if (file.several)
      for (const auto &[name, content] : file.several(result))
        write(name, content);
  }
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
  return folder.string() + " holds no " + complete +
         ": a run ended before its results were whole; files that are there are whole, others are missing. Run it "
         "again";
}

void require_writable(const fs::path &folder)
{
  if (folder.empty())
    refuse(folder, "the name is empty");
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse(folder, "this is a file, not a folder");

  // What is missing is made when there is something to put into it: others may be at the same place, and take away what
  // they made there.
  std::string failure;
  for (int tries = 0; tries < most_looks; ++tries)
  {
    fs::path there = fs::absolute(folder).lexically_normal();
    while (!fs::exists(there, error) && there.has_relative_path())
      there = there.parent_path();
    failure = fs::is_directory(there, error) ? probe(there) : "Not a directory";
    if (failure.empty() || fs::exists(there, error))
      break;
  }
  if (!failure.empty())
    refuse(folder,
           std::string("it cannot be ") + (fs::exists(folder, error) ? "written (" : "created (") + failure + ")");
}

void prepare_folder(const fs::path &folder)
{
  require_writable(folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    refuse(folder, "it cannot be created (" + error.message() + ")");
  try
  {
    remove_earlier_results(folder);
  }
  catch (const fs::filesystem_error &problem)
  {
    refuse(folder, "results of an earlier run cannot be removed (" + std::string(problem.what()) + ")");
  }
}

std::vector<std::string> write_results(const fs::path &folder, const Result &result)
{
  std::vector<std::string> names;
  const auto               write = [&](const std::string &name, const std::string &content)
  {
    write_file(folder / name, content);
    names.push_back(name);
  };

  write_tables(write, result);
  Result told = result;
  for (const std::string &warning : write_paraview(folder, result, names))
    told.warnings.push_back(warning);
  const Report report = make_report(told);
  for (const auto &[name, svg] : report.charts)
    write("charts/" + name + ".svg", svg);
  write("report.html", report.html);
  write(complete, summary_json(told));
  return names;
}

void write_modes(const fs::path &folder, const Result &result)
{
  std::vector<std::string> names;
  write_paraview(folder, result, names);
  write_tables([&](const std::string &name, const std::string &content) { write_file(folder / name, content); },
               result); // without a run no history
  const auto write_pictures = [&](const Pictures &pictures)
  {
    for (const auto &[name, svg] : pictures)
      write_file(folder / "charts" / (name + ".svg"), svg);
  };
  if (result.along)
    write_pictures(along_pictures(*result.along));
  if (result.compared_shapes)
  {
    Pictures pictures;
    compared_modes_section(result, pictures);
    write_pictures(pictures);
  }
  if (result.frf)
    write_pictures(frequency_response_pictures(*result.frf));
}

} // namespace gestell::apps
