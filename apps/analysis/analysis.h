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
  interrupted, ///< with a warning; the answer contains the results so far
  failed       ///< no answer, with a warning; the command fails
};

/// One computation of an analysis, with its options.  It can also be a part of a run.
class Analysis : public RunPart
{
public:
  /// Options bound to members, which hold the defaults; they become command-line options and Python keywords.
  virtual std::vector<CommandOption> options() { return {}; }
  /// Whether another command should include it, by an option of the command or a table of the scene.
  virtual bool requested(const Scene &) const { return true; }
  /// Checks everything that needs no computation.
  /// @throws std::invalid_argument with the option, its value and the requirement
  virtual void                     check(Session &) {}
  virtual std::vector<std::string> reads() const { return {}; }  ///< input files, which no result may replace
  virtual std::vector<std::string> writes() const { return {}; } ///< files that write() makes

  /// Adds its answer and warnings to a result that already has the model with modes, or the run; no effect if the
  /// answer was computed as a part of the run.
  virtual AnalysisOutcome compute(Session &, Result &) const { return AnalysisOutcome::done; }
  /// Writes files that only the command makes; returns a line about them.
  virtual std::string write(Session &, OwnFolder &) const { return ""; }
  /// Replaces an input of its command that is a result folder by the scene, its changes, and a folder for results.
  virtual void open(std::string &, std::vector<std::string> &, std::string &) {}
  virtual bool computes_run() const { return true; } ///< of an analysis of runs: false if it opened their results
};

/// Registration of an analysis in analyses.cc: as a command, as an addition to another command, or both.
struct AnalysisEntry
{
  std::string              name;
  std::string              does; ///< help text of the command `gestell NAME`; empty: not a command
  std::vector<std::string> examples;
  std::vector<ResultFile>  files;

  std::function<std::unique_ptr<Analysis>()>     begin;
  std::function<std::shared_ptr<const Answer>()> nothing; ///< an answer without values: the reference lists its members
  std::string                                    of{};    ///< command whose result it adds to; empty: none
  /// Phase from which it computes motions: an interruption keeps them, and they replace a run in the folder.  Empty: it
  /// computes none; an interruption ends its command.
  std::string motions{};

  bool is_command() const { return !does.empty(); }
};

} // namespace gestell::apps
