#include "apps/verify/case_run.h"

#include "apps/output/folder/own_folder.h"
#include "apps/output/result_files.h"
#include "apps/output/text/csv.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/verify/integrator_maps.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Further settings of a computation, each taken once.
class CaseRequest
{
public:
  explicit CaseRequest(const ReferenceCase &one) : case_(one) {}

  std::string text(const std::string &key, const std::string &otherwise = "")
  {
    names_.push_back(key);
    for (const auto &[name, value] : case_.requested)
      if (name == key)
        return value;
    return otherwise;
  }
  std::vector<std::string> texts(const std::string &key) ///< parted by commas
  {
    std::vector<std::string> texts;
    std::istringstream       all(text(key));
    for (std::string one; std::getline(all, one, ',');)
      texts.push_back(one);
    return texts;
  }
  int number(const std::string &key, int otherwise)
  {
    double value = 0.;
    return is_number(text(key), value) ? static_cast<int>(value) : otherwise;
  }
  void finish() const
  {
    for (const auto &[name, value] : case_.requested)
      if (std::find(names_.begin(), names_.end(), name) == names_.end())
        throw std::invalid_argument(case_.place + ": 'with' has an entry '" + name + "' that \"" + case_.compute +
                                    "\" does not take" + suggestion(name, names_));
  }

private:
  const ReferenceCase     &case_;
  std::vector<std::string> names_;
};

Result modes(Session &session, CaseRequest &requested)
{
  ModesOptions options;
  options.along         = requested.text("along");
  options.from          = requested.text("from");
  options.to            = requested.text("to");
  options.positions     = requested.number("positions", options.positions);
  options.configuration = requested.text("configuration", options.configuration);
  requested.finish();
  return session.modes(options);
}

Result responses(Session &session, CaseRequest &requested)
{
  FrfOptions options;
  options.from    = requested.texts("from");
  options.to      = requested.texts("to");
  options.kind    = requested.text("kind", options.kind);
  options.at      = requested.text("at", options.at);
  options.lowest  = requested.text("lowest");
  options.highest = requested.text("highest");
  options.points  = requested.number("points", options.points);
  options.spacing = requested.text("spacing", options.spacing);
  requested.finish();
  return session.frequency_response(options);
}

Result periodic(Session &session, CaseRequest &requested)
{
  PeriodicRequest request;
  request.method    = requested.text("method");
  request.period    = requested.text("period");
  request.ratio     = requested.number("ratio", request.ratio);
  request.harmonics = requested.number("harmonics", request.harmonics);
  request.lead_in   = requested.number("lead_in", request.lead_in);
  request.along     = requested.text("along");
  request.from      = requested.text("from");
  request.to        = requested.text("to");
  request.points    = requested.number("points", request.points);
  requested.finish();
  return session.periodic(request);
}

Result run(Session &session, CaseRequest &requested)
{
  requested.finish();
  Result result = session.run();
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
  static const std::vector<Computation> all = {
      {"run", run}, {"modes", modes}, {"frf", responses}, {"periodic", periodic}};
  return all;
}

std::string events(const coupling::RunResult &run)
{
  std::string text = "t [s],name,kind\n";
  for (const auto &event : run.events)
    text += exact_text(event.t) + ',' + csv_field(event.name) + ',' + csv_field(event.kind) + '\n';
  return text;
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
  const SceneNode root = read_scene_file(one.scene, set);
  parameters_          = Parameters(root.find("parameters"));
  Session     session(one.scene, set, fem::Scripts::harmless, {{}, interruption});
  CaseRequest requested(one);
  for (const Computation &computation : scene_computations())
    if (computation.name == one.compute)
      result_ = computation.compute(session, requested);
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
  throw std::invalid_argument("'" + case_->compute + "' leaves no table '" + name + "'" + suggestion(name, names));
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
                                ", what it is compared with in " + unit);
  return own.value;
}

} // namespace gestell::apps
