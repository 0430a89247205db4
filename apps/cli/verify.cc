#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/interruption.h"
#include "apps/cli/results_path.h"
#include "apps/output/folder/writing.h"
#include "apps/output/text/write_file.h"
#include "apps/session/commit.h"
#include "apps/verify/manual.h"
#include "apps/verify/read_cases.h"
#include "apps/version.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"
#include "fem/values/temporary_directory.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

namespace fs = std::filesystem;

struct VerifyOptions
{
  std::vector<std::string> cases; ///< files of cases, or names of cases and files shipped
  std::string              folder = "results/verification", docs;
  bool                     all = false, list = false;
};

/// Frames are reduced from scratch, in a temporary cache.
class EmptyCache
{
public:
  EmptyCache() { setenv("GESTELL_CACHE", folder_.path().c_str(), 1); }

private:
  fem::TemporaryDirectory folder_;
};

bool is_file(const std::string &word)
{
  return fs::path(word).extension() == ".toml";
}

std::vector<CaseFile> asked_files(const VerifyOptions &requested)
{
  std::vector<CaseFile> files;
  for (const std::string &word : requested.cases)
    if (is_file(word))
      files.push_back(read_cases(word));
  if (files.size() == requested.cases.size() && !files.empty())
    return files;
  for (const std::string &file : case_files(shipped_cases()))
    files.push_back(read_cases(file));
  return files;
}

/// Keeps the cases that are named, by themselves or by their file.
void choose(std::vector<CaseFile> &files, const std::vector<std::string> &words)
{
  std::vector<std::string> names, known;
  std::copy_if(words.begin(), words.end(), std::back_inserter(names),
               [](const std::string &word) { return !is_file(word); });
  if (names.empty())
    return;
  std::vector<bool> found(names.size());
  const auto        is_named = [&](const std::string &name, const std::string &file)
  {
    known.insert(known.end(), {name, file});
    bool any = false;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name || names[i] == file)
        any = found[i] = true;
    return any;
  };
  for (CaseFile &file : files)
  {
    const std::string          own   = fs::path(file.path).stem().string();
    const bool                 typed = std::find(words.begin(), words.end(), file.path) != words.end();
    std::vector<ReferenceCase> kept;
    for (const ReferenceCase &one : file.cases)
      if (is_named(one.name, own) || typed)
        kept.push_back(one);
    file.cases = kept;
    file.left_out.clear();
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!found[i])
      throw std::invalid_argument("there is no case '" + names[i] + "'" + suggestion(names[i], known) +
                                  "; gestell verify --list names them");
  files.erase(std::remove_if(files.begin(), files.end(), [](const CaseFile &file) { return file.cases.empty(); }),
              files.end());
}

/// Long cases are run if they are named or all are requested.
int leave_long_ones(std::vector<CaseFile> &files, const VerifyOptions &requested)
{
  int n = 0;
  if (!requested.all && requested.cases.empty())
    for (CaseFile &file : files)
    {
      const auto begin =
          std::remove_if(file.cases.begin(), file.cases.end(), [](const ReferenceCase &one) { return one.is_long; });
      n += static_cast<int>(file.cases.end() - begin);
      file.cases.erase(begin, file.cases.end());
    }
  return n;
}

void list(const std::vector<CaseFile> &files)
{
  for (const CaseFile &file : files)
  {
    std::cout << fs::path(file.path).stem().string() << ": " << file.title << '\n';
    for (const ReferenceCase &one : file.cases)
      std::cout << "  " << one.name << (one.is_long ? "  (long)" : "") << '\n';
  }
}

void tell(const ReferenceCase &one, const CaseOutcome &outcome)
{
  std::cout << (outcome.passed() ? "passed  " : "FAILED  ") << one.name << " (" << short_text(outcome.cpu_s, 2)
            << " s)\n";
  for (std::size_t j = 0; j < one.checks.size(); ++j)
    if (!outcome.checks[j].passed)
      std::cout << "        " << outcome_line(one.checks[j], outcome.checks[j]) << '\n';
  std::cout.flush();
}

Verification computed(const std::vector<CaseFile> &files)
{
  EmptyCache   cache;
  Verification all;
  for (const CaseFile &file : files)
  {
    VerifiedFile &verified = all.files.emplace_back();
    verified.file          = file;
    for (const ReferenceCase &one : file.cases)
    {
      verified.outcomes.push_back(judged(one, &interruption()));
      if (interruption())
        throw std::runtime_error("nothing is written");
      tell(one, verified.outcomes.back());
    }
  }
  all.version = version;
  all.commit  = commit();
  return all;
}

int verify(const VerifyOptions &requested)
{
  std::vector<CaseFile> files = asked_files(requested);
  choose(files, requested.cases);
  if (requested.list)
  {
    list(files);
    return exit_done;
  }
  const fs::path    folder = requested.folder;
  const ResultsLock held(folder);
  OwnFolder(folder).require_free({"verification.html", "verification.md", "verification.csv"});
  if (!requested.docs.empty() && !fs::is_directory(requested.docs))
    throw std::invalid_argument("--renew: there is no folder '" + requested.docs +
                                "'; name the documentation folder docs");
  const int    n_skipped = leave_long_ones(files, requested);
  Verification all       = computed(files);
  all.n_skipped          = n_skipped;
  write_or_rescue(folder,
                  [&](Writing &writing)
                  {
                    writing.write("verification.csv", verification_csv(all));
                    writing.write("verification.md", verification_document(all));
                    writing.write("verification.html", verification_page(all));
                  });
  if (!requested.docs.empty())
    write_file(fs::path(requested.docs) / "trust/verification.md", verification_document(all));
  std::cout << verdict_text(all) << "\nmanual: " << (folder / "verification.html").string() << '\n';
  return all.n_failed() == 0 ? exit_done : exit_failed;
}

} // namespace

Command verify_command()
{
  const auto own = std::make_shared<VerifyOptions>();
  return {
      "verify",
      "compute reference cases and compare them with expected values",
      {"gestell verify --all", "gestell verify my_cases.toml",
       "gestell verify \"rod force after the snap-through shock\""},
      CommandInput::none,
      {{"CASE", &own->cases, "case files (.toml), or names of shipped cases and files (default: all except long ones)"},
       {"-o,--output", &own->folder, "folder for the manual (default results/verification)"},
       {"--all", &own->all, "include long cases"},
       {"--list", &own->list, "only list the cases"},
       {"--renew", &own->docs, "also write trust/verification.md in this documentation folder"}},
      [own](const CommonOptions &) { return verify(*own); }};
}

} // namespace gestell::apps
