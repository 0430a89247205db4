#pragma once

#include "apps/scene/file/parameters.h"
#include "apps/study/file/study_file.h"
#include "apps/study/runs/answer_entries.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// The outputs of a study, read from the answer of a run: entries of it, and formulas of entries, other outputs,
/// variables and parameters.
class OutputFormulas
{
public:
  /// @throws std::invalid_argument for an invalid formula, and for results that no run of this scene has
  OutputFormulas(const StudyFile &study, const Scene &scene, const Parameters &parameters);

  const std::vector<std::string> &signals() const { return signals_; }   ///< that are read, each once
  bool                            reads(const std::string &table) const; ///< such as "energy"

  /// One an output.
  /// @throws std::invalid_argument for an entry that the run does not have, with the place of its output
  std::vector<AnswerValue> of(const Result &result, const Parameters &parameters, const Eigen::VectorXd &levels) const;

  // The same in two steps, for derivatives.
  std::vector<AnswerValue> entries_of(const Result &result) const;
  std::vector<AnswerValue> values_of(const std::vector<AnswerValue> &entries, const Parameters &parameters,
                                     const Eigen::VectorXd &levels) const;
  /// Refuses formulas that make no sense whatever the numbers are, such as sums of forces and masses.
  /// @throws std::invalid_argument with the place of the output
  void check_units(const std::vector<AnswerValue> &entries, const Parameters &parameters,
                   const Eigen::VectorXd &levels) const;
  /// Of each entry, "signals", "F_P", "max".
  std::vector<std::vector<std::string>> paths() const;

private:
  struct Entry
  {
    std::string              name; ///< that stands for it in formulas
    std::vector<std::string> segments;
    std::string              place;
  };
  struct Formula
  {
    std::string text;        ///< with the names of entries in their places
    int         single = -1; ///< it is this entry alone
  };
  struct Known;

  Formula                  formula_of(const OutputRequest &output);
  int                      entry_of(const std::vector<std::string> &segments, const OutputRequest &output);
  std::vector<AnswerValue> values_of(Known known) const;
  Quantity                 quantity_of(std::size_t output, Known &known) const;
  void                     check_names(const Parameters &parameters) const;
  std::string              with_entries(std::string text) const;
  std::vector<std::string> all_names(const Parameters &parameters) const;

  std::vector<VariableRequest> variables_;
  std::vector<OutputRequest>   outputs_;
  std::vector<Formula>         formulas_;
  std::vector<Entry>           entries_;
  std::vector<std::string>     signals_;
};

} // namespace gestell::apps
