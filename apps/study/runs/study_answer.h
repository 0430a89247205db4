#pragma once

#include "apps/study/file/read_design.h"
#include "apps/study/runs/run_pool.h"
#include "apps/study/runs/study_folder.h"

namespace gestell::apps
{

/// How the runs of a study are to be made.
struct StudyCall
{
  std::filesystem::path                     folder{};
  fem::Scripts                              scripts = fem::Scripts::harmless;
  int                                       jobs    = 1;
  StudyFolder::Begin                        begin   = StudyFolder::Begin::anew;
  StudyShare                                share{};
  bool                                      waits_for_shares = false;   ///< others are being made; merges all
  const std::atomic<bool>                  *stop             = nullptr; ///< must not be null
  std::function<void(int done, int n_runs)> progress{};
  /// Hears the outputs with their units once a run has told them; what it throws ends the study.
  std::function<void(const std::vector<StudyOutput> &outputs)> learned{};
};

/// A study with all its rows, as far as they are made.
struct StudyAnswer
{
  StudyTable table{};
  Design     design{};
  int        n_made      = 0; ///< runs made by this call
  bool       interrupted = false;

  int  n_failed() const;
  bool complete() const; ///< every run is done or has failed
};

/// Makes the runs of a study that its folder does not hold yet.
/// @throws std::invalid_argument with place and remedy, before any run or at the first one
StudyAnswer make_study(const StudyFile &study, const StudyPoints &points, StudyRunner &runner, const StudyCall &call);

} // namespace gestell::apps
