#pragma once

#include "apps/analysis/command_option.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result_file.h"
#include "apps/session/session.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

/// One computation of an analysis: its options, and what it makes of them.
class Analysis
{
public:
  virtual ~Analysis() = default;

  /// Bound to its members, which hold the defaults; they are options of the command line and keywords of Python.
  virtual std::vector<CommandOption> options() { return {}; }
  /// Of an option of another command: whether it was given.
  virtual bool requested() const { return true; }
  /// What can be known before anything is computed.
  /// @throws std::invalid_argument: which option, the value, and what is needed
  virtual void                     check(Session &) {}
  virtual std::vector<std::string> reads() const { return {}; }  ///< files, which no result may replace
  virtual std::vector<std::string> writes() const { return {}; } ///< files that write() makes

  /// Adds its answer, and warnings, to a result that has the model and its modes, or the run.
  /// @return false: it has none, as a warning says
  virtual bool compute(Session &session, Result &result) const = 0;
  /// Files that only the command makes; returns a line that says so.
  virtual std::string write(Session &, OwnFolder &) const { return ""; }
};

/// An analysis as it is registered, in analyses.cc.
struct AnalysisEntry
{
  std::string              name; ///< of its command, `gestell NAME`, unless it belongs to another one
  std::string              does;
  std::vector<std::string> examples;
  std::vector<ResultFile>  files;

  std::function<std::unique_ptr<Analysis>()>     begin;
  std::function<std::shared_ptr<const Answer>()> nothing; ///< without values: its members are listed by the reference
  std::string                                    of{};    ///< command whose result it adds to, with options there
};

} // namespace gestell::apps
