#include "apps/verify/judge.h"

#include "apps/scene/language/parse_quantity.h"
#include "apps/verify/case_run.h"
#include "coupling/plugin/frame_service_loader.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Numbers side by side, of one column.
struct Pairs
{
  std::vector<double> obtained{}, expected{};
  int                 n_left = 0, n_words = 0;

  void add(double o, double e)
  {
    obtained.push_back(o);
    expected.push_back(e);
  }
};

/// Words must be the same; numbers go into the pairs.
void compare_cells(const std::string &obtained, const std::string &expected, const std::string &where, Pairs &pairs)
{
  double o = 0., e = 0.;
  if (expected.empty())
    ++pairs.n_left;
  else if (is_number(obtained, o) && is_number(expected, e))
    pairs.add(o, e);
  else if (obtained == expected)
    ++pairs.n_words;
  else
    throw std::runtime_error(where + ": obtained " + (obtained.empty() ? "nothing" : '\'' + obtained + '\'') +
                             ", expected '" + expected + "'");
}

/// An expected cell in the words of the own table.
std::string in_own_words(const Check &check, const std::string &column, const std::string &expected)
{
  const auto words = check.words.find(column);
  if (words == check.words.end())
    return expected;
  const auto word = words->second.find(expected);
  return word == words->second.end() ? expected : word->second;
}

std::vector<std::string> key_of(const DataTable &table, std::size_t row, const std::vector<std::string> &columns)
{
  std::vector<std::string> key;
  for (const std::string &column : columns)
    key.push_back(table.rows[row][table.column(column)]);
  return key;
}

/// The row of `obtained` that belongs to a row of `expected`.
std::size_t partner(const DataTable &obtained, const DataTable &expected, std::size_t row, const Check &check)
{
  if (check.at.empty())
    return row;
  std::vector<std::string> ours, theirs;
  for (const auto &[own, other] : check.at)
  {
    ours.push_back(own);
    theirs.push_back(other);
  }
  const auto wanted = key_of(expected, row, theirs);
  for (std::size_t i = 0; i < obtained.rows.size(); ++i)
  {
    const auto key = key_of(obtained, i, ours);
    if (std::equal(key.begin(), key.end(), wanted.begin(), same_cell))
      return i;
  }
  throw std::runtime_error(obtained.name + " has no row with " + ours.front() + " = " + wanted.front());
}

std::vector<Pairs> row_pairs(const CaseRun &run, const Check &check)
{
  const DataTable expected = run.expected_rows(check);
  const DataTable obtained = run.table(check.table, expected).chosen(check.rows);
  if (expected.rows.empty())
    throw std::invalid_argument("the expected table has no such rows");
  if (check.at.empty() && obtained.rows.size() != expected.rows.size())
    throw std::runtime_error(obtained.name + " has " + std::to_string(obtained.rows.size()) + " rows, expected are " +
                             std::to_string(expected.rows.size()));
  std::vector<Pairs> columns(check.columns.size());
  for (std::size_t row = 0; row < expected.rows.size(); ++row)
  {
    const auto &own = obtained.rows[partner(obtained, expected, row, check)];
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      const auto &[column, other] = check.columns[j];
      compare_cells(own[obtained.column(column)], in_own_words(check, column, expected.cell(row, other)),
                    column + ", row " + std::to_string(row + 1), columns[j]);
    }
  }
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (columns[j].expected.empty() && columns[j].n_words == 0)
      throw std::runtime_error("column '" + check.columns[j].second + "' of " + expected.name +
                               " has no value to compare");
  return columns;
}

double expected_value(const CaseRun &run, const Check &check, const std::string &unit)
{
  if (check.expected.column.empty())
    return run.expected(check.expected.formula, unit);
  const DataTable rows  = read_table(check.expected.table.file).chosen(check.expected.table.rows);
  double          value = 0.;
  if (rows.rows.size() != 1 || !is_number(rows.rows.front()[rows.column(check.expected.column)], value))
    throw std::invalid_argument("'expected' names " + count_text(rows.rows.size(), "row") + " of " + rows.name +
                                "; it needs one with a number");
  return value;
}

std::vector<Pairs> all_pairs(const CaseRun &run, const Check &check)
{
  if (check.value.empty())
    return row_pairs(run, check);
  const AnswerValue value = run.value(check.value);
  const double      plus  = check.plus.empty() ? 0. : run.expected(check.plus, value.unit);
  Pairs             pair;
  pair.add(value.value + plus, expected_value(run, check, value.unit));
  return {pair};
}

/// Deviation of a number; infinite for nan and for an infinite number compared with a finite one.
double miss(const Check &check, double obtained, double expected)
{
  if (obtained == expected)
    return 0.;
  const double difference = obtained - expected;
  if (std::isnan(difference))
    return INFINITY;
  return check.bound == Bound::none ? std::abs(difference)
                                    : std::max(0., check.bound == Bound::least ? -difference : difference);
}

/// The largest finite magnitude.
double scale_of(const std::vector<double> &numbers)
{
  double scale = 0.;
  for (const double x : numbers)
    if (std::isfinite(x))
      scale = std::max(scale, std::abs(x));
  return scale;
}

/// Tolerance of a number; for an infinite one only the absolute part.
double allowed_at(const Check &check, double expected, double scale)
{
  if (std::isinf(expected))
    return check.absolute;
  return check.absolute + check.relative * (check.each ? std::abs(expected) : scale);
}

/// The pair that uses most of what is allowed.
CheckOutcome worst(const std::vector<Pairs> &columns, const Check &check)
{
  CheckOutcome outcome;
  outcome.passed = true;
  double most    = -1.;
  for (const Pairs &column : columns)
  {
    const double scale = scale_of(column.expected);
    outcome.n_left += column.n_left;
    outcome.n_numbers += static_cast<int>(column.expected.size());
    outcome.n_words += column.n_words;
    for (std::size_t i = 0; i < column.expected.size(); ++i)
    {
      const double allowed = allowed_at(check, column.expected[i], scale);
      const double error   = miss(check, column.obtained[i], column.expected[i]);
      const double used    = allowed > 0. ? error / allowed : error > 0. ? INFINITY : 0.;
      outcome.passed       = outcome.passed && error <= allowed;
      if (used <= most)
        continue;
      most                       = used;
      outcome.error              = error;
      outcome.allowed            = allowed;
      constexpr int shown_digits = 10; // chosen
      outcome.expected           = short_text(column.expected[i], shown_digits);
      outcome.obtained           = short_text(column.obtained[i], shown_digits);
    }
  }
  if (outcome.n_numbers == 0)
    outcome.expected = outcome.obtained = "the same words";
  return outcome;
}

double size_of(const std::string &text)
{
  return parse_quantity(text, [](const std::string &) { return std::optional<Quantity>(); }).value;
}

/// Order from the errors e at h: log(e1/e2) / log(h1/h2) of the last two.
CheckOutcome order_of(const std::vector<CheckOutcome> &outcomes, const ReferenceCase &one, const Check &check)
{
  const std::size_t n     = outcomes.size();
  const double      ratio = size_of(one.refinements[n - 2]) / size_of(one.refinements[n - 1]);
  const double      order = std::log(outcomes[n - 2].error / outcomes[n - 1].error) / std::log(ratio);
  Pairs             pair;
  pair.add(order, check.order);
  CheckOutcome outcome = worst({pair}, check);
  outcome.n_numbers    = outcomes.back().n_numbers;
  return outcome;
}

CheckOutcome judged_check(const std::vector<CaseRun> &runs, const ReferenceCase &one, const Check &check)
{
  try
  {
    if (check.order == 0.)
      return worst(all_pairs(runs.back(), check), check);
    std::vector<CheckOutcome> outcomes;
    for (const CaseRun &run : runs)
      outcomes.push_back(worst(all_pairs(run, check), check));
    return order_of(outcomes, one, check);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(check.place + ": " + error.what());
  }
  catch (const std::exception &error)
  {
    CheckOutcome outcome;
    outcome.failure = error.what();
    return outcome;
  }
}

std::vector<CaseRun> runs_of(const ReferenceCase &one, const std::atomic<bool> *interruption)
{
  std::vector<CaseRun> runs;
  if (one.refined.empty())
    runs.emplace_back(one, std::vector<std::string>(), interruption);
  for (const std::string &value : one.refinements)
    runs.emplace_back(one, std::vector<std::string>{one.refined + "=\"" + value + '"'}, interruption);
  return runs;
}

CaseOutcome failed(const ReferenceCase &one, const std::string &why)
{
  CaseOutcome outcome;
  outcome.checks.resize(one.checks.size());
  for (CheckOutcome &check : outcome.checks)
    check.failure = why;
  return outcome;
}

} // namespace

bool CaseOutcome::passed() const
{
  return std::all_of(checks.begin(), checks.end(), [](const CheckOutcome &check) { return check.passed; });
}

CaseOutcome judged(const ReferenceCase &one, const std::atomic<bool> *interruption)
{
  CaseOutcome        outcome;
  const std::clock_t begin = std::clock();
  try
  {
    const std::vector<CaseRun> runs = runs_of(one, interruption);
    for (const Check &check : one.checks)
      outcome.checks.push_back(judged_check(runs, one, check));
  }
  catch (const std::invalid_argument &error)
  {
    if (coupling::has_frame_service())
      throw;
    outcome = failed(one, error.what()); // a build without finite elements refuses frames
  }
  catch (const std::exception &error)
  {
    outcome = failed(one, error.what());
  }
  outcome.cpu_s = double(std::clock() - begin) / CLOCKS_PER_SEC;
  return outcome;
}

} // namespace gestell::apps
