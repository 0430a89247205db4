#pragma once

#include "apps/analysis/command_option.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result_file.h"
#include "apps/session/run_part.h"
#include "apps/session/session.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

enum class AnalysisOutcome
{
  done,
  interrupted, ///< as warnings say; what is known by then is in the answer
  failed       ///< it has no answer, as a warning says; the command fails
};

/// One computation of an analysis: its options, and what it makes of them.  Of a run it can be a part, too.
class Analysis : public RunPart
{
public:
  /// Bound to its members, which hold the defaults; they are options of the command line and keywords of Python.
  virtual std::vector<CommandOption> options() { return {}; }
  /// Of another command: by an option of it, or by a table of the scene.
  virtual bool requested(const Scene &) const { return true; }
  /// What can be known before anything is computed.
  /// @throws std::invalid_argument: which option, the value, and what is needed
  virtual void                     check(Session &) {}
  virtual std::vector<std::string> reads() const { return {}; }  ///< files, which no result may replace
  virtual std::vector<std::string> writes() const { return {}; } ///< files that write() makes

  /// Adds its answer, and warnings, to a result that has the model and its modes, or the run; nothing where the answer
  /// was found as a part of the run.
  virtual AnalysisOutcome compute(Session &, Result &) const { return AnalysisOutcome::done; }
  /// Files that only the command makes; returns a line that says so.
  virtual std::string write(Session &, OwnFolder &) const { return ""; }
};

/// An analysis as it is registered, in analyses.cc: a command, an addition to another one, or both.
struct AnalysisEntry
{
  std::string              name;
  std::string              does; ///< as the command `gestell NAME`; empty: it is none
  std::vector<std::string> examples;
  std::vector<ResultFile>  files;

  std::function<std::unique_ptr<Analysis>()>     begin;
  std::function<std::shared_ptr<const Answer>()> nothing; ///< without values: its members are listed by the reference
  std::string                                    of{};    ///< command whose result it adds to; empty: none

  bool is_command() const { return !does.empty(); }
};

} // namespace gestell::apps
