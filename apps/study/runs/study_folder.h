#pragma once

#include "apps/study/runs/rows_file.h"
#include "apps/study/runs/study_record.h"

#include <filesystem>
#include <vector>

namespace gestell::apps
{

/// A part of a study: runs whose number leaves the remainder `part` - 1 by `of`.
struct StudyShare
{
  int  part = 1, of = 1;
  bool together = false; ///< one call makes all of them, as mpirun does

  bool is_whole() const { return of == 1; }
  bool has(int run) const { return (run - 1) % of == part - 1; }
};

/// "3/10".  @throws std::invalid_argument
StudyShare share_of(const std::string &text);

/**
 * The folder of a study: runs.csv, rows of shares beside it until a call without --share merges them, and study.json,
 * which tells what the rows hang on.
 */
class StudyFolder
{
public:
  /// @param levels  runs x variables
  StudyFolder(const std::filesystem::path &folder, const StudyRecord &record, const RowsText &text,
              const Eigen::MatrixXd &levels)
      : folder_(folder), record_(record), text_(text), levels_(levels)
  {
  }

  enum class Begin
  {
    anew,
    resumed ///< --resume
  };

  /**
   * Makes the folder ready for rows of this share.
   *
   * @return rows that are there already
   * @throws std::invalid_argument for rows of another study, of a study that was changed since (with what was), of an
   * unfinished one where `begin` is anew, of a share that has rows already, and for a share by itself of a study that
   * is finished
   */
  std::vector<RunRow> open(Begin begin, const StudyShare &share);

  /// Units of the outputs, that an earlier call learned; empty: none has.
  const std::vector<std::string> &units() const { return record_.units; }
  void                            keep_units(const std::vector<std::string> &units);

  /// Rows of a share go into a file of its own.
  static std::string    name_of(const StudyShare &share);
  std::filesystem::path rows_file(const StudyShare &share) const { return folder_ / name_of(share); }
  /// All rows of all shares, in the order of runs.
  std::vector<RunRow> rows() const;
  /// Makes one runs.csv of the rows, and removes those of shares.
  void merge(const std::vector<RunRow> &rows);

private:
  std::vector<RunRow>                begun_anew();
  void                               enter_own(const std::string &rows) const;
  bool                               begins_anew(Begin begin, const StudyShare &share) const;
  std::vector<std::filesystem::path> share_files() const;
  void                               refuse_other_study() const;
  void                               refuse_changes() const;

  std::filesystem::path folder_;
  StudyRecord           record_;
  const RowsText       &text_;
  Eigen::MatrixXd       levels_;
};

} // namespace gestell::apps
