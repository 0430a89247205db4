#pragma once

#include "coupling/integration/method_options.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Kinds of computation of a case, executed by CaseRun.
inline std::vector<std::string> computations()
{
  return {"run", "modes", "frf", "periodic", "life", "integrators"};
}

/// A table of a file, or rows of it.
struct TableChoice
{
  std::string                        file{}; ///< absolute path of a .csv, or name of a result file
  std::map<std::string, std::string> rows{}; ///< cells of the selected rows, by column
};

/// Expected value of a check: a number, a formula of the scene's parameters, or cells of a table.
struct Expectation
{
  std::string formula{}; ///< empty: a cell, or rows
  TableChoice table{};
  std::string column{}; ///< of a cell; empty: rows
};

enum class Bound
{
  none,
  least, ///< the expected value is a lower bound
  most   ///< an upper bound
};

/**
 * One comparison.  It passes if for every pair of numbers
 *
 *     |obtained - expected| <= absolute + relative scale,
 *
 * where scale is the largest expected magnitude of the column, or that of the number itself; for a bound only a
 * violation counts as difference.
 */
struct Check
{
  std::string                                      name{};
  std::string                                      value{};   ///< path in the answer, "signals.F_P.max"; empty: rows
  std::string                                      table{};   ///< result file or map with the compared rows
  std::map<std::string, std::string>               rows{};    ///< cells of the compared rows
  std::vector<std::pair<std::string, std::string>> columns{}; ///< of it, and of the expected rows
  /// Translation of expected words to those in the table: by column, then by expected word.
  std::map<std::string, std::map<std::string, std::string>> words{};
  std::vector<std::pair<std::string, std::string>> at{}; ///< columns that identify corresponding rows; none: in order
  Expectation                                      expected{};
  double                                           relative = 0., absolute = 0.;
  bool                                             each  = false; ///< relative to each number, not to the largest
  Bound                                            bound = Bound::none;
  double      order = 0.; ///< expected order of the error, see ReferenceCase::refined; 0: none
  std::string plus{};     ///< formula added to the value
  std::string because{};  ///< reason for the tolerance
  std::string source{};   ///< of the expected value
  std::string place{};
};

/// A reference case: a computation and its expected results.
struct ReferenceCase
{
  std::string              name{}, states{}, equation{}; ///< statement of the theory, and its location
  std::string              scene{};                      ///< path; empty: only integrators
  std::vector<std::string> set{};
  std::string              compute = "run"; ///< a kind in computations()
  bool                     is_long = false;
  std::vector<std::pair<std::string, std::string>> requested{}; ///< further settings of `compute`
  std::string                                    refined{}; ///< key that is varied over `refinements` to check an order
  std::vector<std::string>                       refinements{};
  std::map<std::string, coupling::MethodOptions> methods{}; ///< for integrators, by the name in the expected table
  std::vector<std::pair<std::string, std::string>> methods_left_out{}; ///< of the expected table, with reasons
  std::vector<Check>                               checks{};
  std::string                                      place{};
};

struct CaseFile
{
  std::string                                      path{}, title{}, lead{};
  std::vector<ReferenceCase>                       cases{};
  std::vector<std::pair<std::string, std::string>> left_out{}; ///< reference files that no case reads, with reasons
};

} // namespace gestell::apps
