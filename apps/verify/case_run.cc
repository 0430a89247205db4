#include "apps/verify/case_run.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/result_files.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/text/csv.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/verify/data_table.h"
#include "coupling/integration/stability/overshoot.h"
#include "coupling/integration/stability/stability.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::MethodOptions;
using Cells = std::vector<std::string>;

/// A row of the expected table, by columns.
struct MapRow
{
  const DataTable &table;
  std::size_t      i;

  const std::string &text(const std::string &column) const { return table.rows[i][table.column(column)]; }
  double             number(const std::string &column) const
  {
    double value = 0.;
    if (!is_number(text(column), value))
      throw std::invalid_argument(table.name + ": column '" + column + "' holds '" + text(column) +
                                  "', which is not a number");
    return value;
  }
  coupling::TestOscillator oscillator() const { return {number("zeta"), number("omega_h")}; }
};

Cells radius(const MethodOptions &method, const MapRow &row)
{
  return {exact_text(coupling::spectral_radius(method, row.oscillator()))};
}

Cells period_and_damping(const MethodOptions &method, const MapRow &row)
{
  const auto step = coupling::step_properties(method, row.oscillator());
  if (std::isnan(step.period_elongation))
    return {"overdamped", "overdamped"};
  return {exact_text(step.period_elongation), exact_text(step.numerical_damping)};
}

/// How many rows above have the same method and damping.
std::size_t rank_of(const MapRow &row)
{
  std::size_t rank = 0;
  for (std::size_t j = 0; j < row.i; ++j)
    rank += row.text("method") == MapRow{row.table, j}.text("method") &&
            row.text("zeta") == MapRow{row.table, j}.text("zeta");
  return rank;
}

Cells interval(const MethodOptions &method, const MapRow &row)
{
  const auto        intervals = coupling::unstable_intervals(method, row.number("zeta"));
  const std::size_t rank      = rank_of(row);
  if (rank >= intervals.size())
    return {"none", "none"};
  return {exact_text(intervals[rank].from), exact_text(intervals[rank].to)};
}

Cells overshooting(const MethodOptions &method, const MapRow &row)
{
  const auto start =
      row.text("start") == "x0=1,v0=0" ? coupling::OscillatorStart::displaced : coupling::OscillatorStart::moving;
  const auto most = coupling::overshoot(method, {0., row.number("omega_h")}, start, coupling::FirstSteps::order_ramp);
  return {exact_text(most.displacement), exact_text(most.velocity)};
}

struct Map
{
  std::string              name;
  std::vector<std::string> columns;
  Cells (*cells)(const MethodOptions &method, const MapRow &row);
};

const std::vector<Map> &maps()
{
  static const std::vector<Map> all = {
      {"spectral radius", {"spectral radius"}, radius},
      {"period and damping", {"period elongation", "numerical damping"}, period_and_damping},
      {"unstable intervals", {"from", "to"}, interval},
      {"overshoot", {"displacement", "velocity"}, overshooting}};
  return all;
}

const Map &map_of(const std::string &name)
{
  std::vector<std::string> names;
  for (const Map &map : maps())
  {
    if (map.name == name)
      return map;
    names.push_back(map.name);
  }
  throw std::invalid_argument("there is no map '" + name + "' of integrators" + suggestion(name, names));
}

/**
 * Results of a method for the oscillator x'' + 2 zeta omega x' + omega^2 x = 0, for every row of `expected` with its
 * columns method, zeta, omega_h, start.
 *
 * @param name  "spectral radius", "period and damping", "unstable intervals" (from the column `zeta`), "overshoot"
 * @throws std::invalid_argument for another name, or a row of a method that is not among `methods`
 */
DataTable integrator_map(const std::string &name, const DataTable &expected,
                         const std::map<std::string, coupling::MethodOptions> &methods)
{
  const Map &map = map_of(name);
  DataTable  table{name, map.columns, {}};
  for (std::size_t i = 0; i < expected.rows.size(); ++i)
  {
    const MapRow row{expected, i};
    const auto   method = methods.find(row.text("method"));
    if (method == methods.end())
      throw std::invalid_argument(expected.name + " has a method '" + row.text("method") +
                                  "' that is not in 'methods'; add it there, or to 'methods_left_out' with the reason");
    table.rows.push_back(map.cells(method->second, row));
  }
  return table;
}

/// Further settings of a computation, each taken once.
class CaseRequest
{
public:
  explicit CaseRequest(const ReferenceCase &one) : case_(one) {}

  std::string text(const std::string &key)
  {
    names_.push_back(key);
    for (const auto &[name, value] : case_.requested)
      if (name == key)
        return value;
    return "";
  }
  std::vector<std::string> texts(const std::string &key) ///< parted by commas
  {
    std::vector<std::string> texts;
    std::istringstream       all(text(key));
    for (std::string one; std::getline(all, one, ',');)
      texts.push_back(one);
    return texts;
  }
  void finish() const
  {
    for (const auto &[name, value] : case_.requested)
      if (std::find(names_.begin(), names_.end(), name) == names_.end())
        throw std::invalid_argument(case_.place + ": 'with' has a key '" + name + "' that \"" + case_.compute +
                                    "\" does not accept" + suggestion(name, names_));
  }

private:
  const ReferenceCase     &case_;
  std::vector<std::string> names_;
};

/// Settings are options of the analysis, by their names.
void take_options(Analysis &analysis, CaseRequest &requested)
{
  for (const CommandOption &option : analysis.options())
    if (const auto texts = requested.texts(option.key()); !option.writes && !texts.empty())
      option.set(texts);
}

Result modes(Session &session, CaseRequest &requested)
{
  const Analyses more = analyses_of("modes");
  for (const auto &analysis : more)
    take_options(*analysis, requested);
  requested.finish();
  check_all(more, session);
  Result result = session.modes();
  add_answers(more, session, result);
  return result;
}

Result analysed(const AnalysisEntry &entry, Session &session, CaseRequest &requested)
{
  const auto analysis = entry.begin();
  take_options(*analysis, requested);
  requested.finish();
  analysis->check(session);
  AnalysisOutcome outcome = AnalysisOutcome::done;
  Result          result  = computed(entry, *analysis, session, outcome);
  if (outcome != AnalysisOutcome::done)
    throw std::runtime_error(failure_of(result));
  return result;
}

Result run(Session &session, CaseRequest &requested)
{
  requested.finish();
  Result result = complete_run(session);
  if (!result.run->failure.empty())
    throw std::runtime_error(result.run->failure);
  if (result.run->interrupted)
    throw std::runtime_error("interrupted");
  return result;
}

struct Computation
{
  std::string name;
  Result (*compute)(Session &session, CaseRequest &requested);
};

const std::vector<Computation> &scene_computations()
{
  static const std::vector<Computation> all = {{"run", run}, {"modes", modes}};
  return all;
}

CsvTable events(const coupling::RunResult &run)
{
  CsvTable csv({"t [s]", "name", "kind"});
  for (const auto &event : run.events)
    csv.add(event.t, event.name, event.kind);
  return csv;
}

std::vector<std::string> segments_of(const std::string &entry)
{
  std::vector<std::string> segments(1);
  for (const char c : entry)
    if (c == '.')
      segments.emplace_back();
    else
      segments.back() += c;
  return segments;
}

} // namespace

CaseRun::CaseRun(const ReferenceCase &one, const std::vector<std::string> &more, const std::atomic<bool> *interruption)
    : case_(&one)
{
  if (one.scene.empty())
    return;
  std::vector<std::string> set = one.set;
  set.insert(set.end(), more.begin(), more.end());
  Session session(one.scene, set, fem::Scripts::harmless, {{}, interruption});
  parameters_ = Parameters(session.variant().root.find("parameters"));
  CaseRequest requested(one);
  for (const Computation &computation : scene_computations())
    if (computation.name == one.compute)
      result_ = computation.compute(session, requested);
  for (const AnalysisEntry &entry : analyses())
    if (entry.is_command() && entry.name == one.compute)
      result_ = analysed(entry, session, requested);
}

AnswerValue CaseRun::value(const std::string &entry) const
{
  return answer_entry::value(segments_of(entry), result_);
}

DataTable CaseRun::expected_rows(const Check &check) const
{
  const DataTable all  = read_table(check.expected.table.file);
  DataTable       rows = all.chosen(check.expected.table.rows);
  for (const auto &[method, why] : case_->methods_left_out)
  {
    if (all.chosen({{"method", method}}).rows.empty())
      throw std::invalid_argument("'methods_left_out' names '" + method + "', which " + all.name + " does not hold");
    rows = rows.without("method", method);
  }
  return rows;
}

DataTable CaseRun::table(const std::string &name, const DataTable &expected) const
{
  if (case_->scene.empty())
    return integrator_map(name, expected, case_->methods);
  if (name == "events" && result_.run)
    return table_of(name, events(*result_.run));
  std::vector<std::string> names{"events"};
  for (const ResultFile &file : result_files())
  {
    names.push_back(file.name);
    if (file.several && has_form(name, file.name))
      for (const auto &[one, text] : file.several(result_))
        if (one == name)
          return table_of(name, text);
    if (file.content && file.name == name)
      if (const std::string text = file.content(result_); !text.empty())
        return table_of(name, text);
  }
  throw std::invalid_argument("'" + case_->compute + "' writes no table '" + name + "'" + suggestion(name, names));
}

double CaseRun::expected(const std::string &formula, const std::string &unit) const
{
  const Quantity own = parse_quantity(
      formula, [this](const std::string &name) { return parameters_.find(name); }, parameters_.names());
  if (!own.checked || equal(own.dimension, {0., 0., 0.}) || unit.empty())
    return own.value;
  const Quantity needed = parse_quantity("1 " + unit, [](const std::string &) { return std::optional<Quantity>(); });
  if (!equal(own.dimension, needed.dimension))
    throw std::invalid_argument("\"" + formula + "\" is in " + describe(own.dimension) +
                                ", but the compared value is in " + unit);
  return own.value;
}

} // namespace gestell::apps
