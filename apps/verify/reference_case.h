#pragma once

#include "coupling/integration/method_options.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Words of what a case computes, each of them done by CaseRun.
inline std::vector<std::string> computations()
{
  return {"run", "modes", "frf", "periodic", "integrators"};
}

/// A table of a file, or rows of it.
struct TableChoice
{
  std::string                        file{}; ///< absolute path of a .csv, or name of a file of results
  std::map<std::string, std::string> rows{}; ///< cells that chosen rows have, by column
};

/// What a check expects: one number, a formula of the scene's parameters, or cells of a table.
struct Expectation
{
  std::string formula{}; ///< empty: a cell, or rows
  TableChoice table{};
  std::string column{}; ///< of a cell; empty: rows
};

enum class Bound
{
  none,
  least, ///< the expected value is a lower bound of the obtained one
  most   ///< an upper bound
};

/**
 * One comparison.  It holds where for every pair of numbers
 *
 *     |obtained - expected| <= absolute + relative scale,
 *
 * scale the largest magnitude expected of its column, or that of the number itself; of a bound the difference counts on
 * the wrong side alone.
 */
struct Check
{
  std::string                                      name{};
  std::string                                      value{};   ///< entry of the answer, "signals.F_P.max"; empty: rows
  std::string                                      table{};   ///< file of results or map whose rows are compared
  std::map<std::string, std::string>               rows{};    ///< of it that count
  std::vector<std::pair<std::string, std::string>> columns{}; ///< of it, and of the expected rows
  /// What an expected word of a column is called in the table: by column, then by expected word.
  std::map<std::string, std::map<std::string, std::string>> words{};
  std::vector<std::pair<std::string, std::string>> at{}; ///< columns by which rows belong together; none: in order
  Expectation                                      expected{};
  double                                           relative = 0., absolute = 0.;
  bool                                             each  = false; ///< relative to each number, not to the largest
  Bound                                            bound = Bound::none;
  double      order = 0.; ///< with which the error falls, see ReferenceCase::refined; 0: none
  std::string plus{};     ///< formula that is added to a value
  std::string because{};  ///< where the tolerance comes from
  std::string source{};   ///< of the expected value
  std::string place{};
};

/// A case of reference: what is computed and what must come out.
struct ReferenceCase
{
  std::string              name{}, states{}, equation{}; ///< sentence of theory, and where it stands
  std::string              scene{};                      ///< path; empty: of integrators alone
  std::vector<std::string> set{};
  std::string              compute = "run"; ///< a word of computations()
  bool                     is_long = false;
  std::vector<std::pair<std::string, std::string>> requested{}; ///< further settings of `compute`
  std::string              refined{}; ///< entry that takes `refinements`, as a check of an order asks
  std::vector<std::string> refinements{};
  std::map<std::string, coupling::MethodOptions>   methods{}; ///< of integrators, by the name in the expected table
  std::vector<std::pair<std::string, std::string>> methods_left_out{}; ///< of the expected table, and why
  std::vector<Check>                               checks{};
  std::string                                      place{};
};

struct CaseFile
{
  std::string                                      path{}, title{}, lead{};
  std::vector<ReferenceCase>                       cases{};
  std::vector<std::pair<std::string, std::string>> left_out{}; ///< reference files that no case reads, and why
};

} // namespace gestell::apps
