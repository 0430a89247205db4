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
class Asked
{
public:
  explicit Asked(const ReferenceCase &one) : case_(one) {}

  std::string text(const std::string &key, const std::string &otherwise = "")
  {
    names_.push_back(key);
    for (const auto &[name, value] : case_.asked)
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
    for (const auto &[name, value] : case_.asked)
      if (std::find(names_.begin(), names_.end(), name) == names_.end())
        throw std::invalid_argument(case_.place + ": 'with' has an entry '" + name + "' that \"" + case_.compute +
                                    "\" does not take" + suggestion(name, names_));
  }

private:
  const ReferenceCase     &case_;
  std::vector<std::string> names_;
};

Result modes(Session &session, Asked &asked)
{
  ModesOptions options;
  options.along         = asked.text("along");
  options.from          = asked.text("from");
  options.to            = asked.text("to");
  options.positions     = asked.number("positions", options.positions);
  options.configuration = asked.text("configuration", options.configuration);
  asked.finish();
  return session.modes(options);
}

Result responses(Session &session, Asked &asked)
{
  FrfOptions options;
  options.from    = asked.texts("from");
  options.to      = asked.texts("to");
  options.kind    = asked.text("kind", options.kind);
  options.at      = asked.text("at", options.at);
  options.lowest  = asked.text("lowest");
  options.highest = asked.text("highest");
  options.points  = asked.number("points", options.points);
  options.spacing = asked.text("spacing", options.spacing);
  asked.finish();
  return session.frequency_response(options);
}

Result periodic(Session &session, Asked &asked)
{
  PeriodicRequest request;
  request.method    = asked.text("method");
  request.period    = asked.text("period");
  request.ratio     = asked.number("ratio", request.ratio);
  request.harmonics = asked.number("harmonics", request.harmonics);
  request.lead_in   = asked.number("lead_in", request.lead_in);
  request.along     = asked.text("along");
  request.from      = asked.text("from");
  request.to        = asked.text("to");
  request.points    = asked.number("points", request.points);
  asked.finish();
  return session.periodic(request);
}

Result run(Session &session, Asked &asked)
{
  asked.finish();
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
  Result (*compute)(Session &session, Asked &asked);
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

std::vector<std::string> computations()
{
  std::vector<std::string> names;
  for (const Computation &one : scene_computations())
    names.push_back(one.name);
  names.push_back("integrators");
  return names;
}

CaseRun::CaseRun(const ReferenceCase &one, const std::vector<std::string> &more, const std::atomic<bool> *interruption)
    : case_(&one)
{
  if (one.scene.empty())
    return;
  std::vector<std::string> set = one.set;
  set.insert(set.end(), more.begin(), more.end());
  const SceneNode root = read_scene_file(one.scene, set);
  parameters_          = Parameters(root.find("parameters"));
  Session session(one.scene, set, fem::Scripts::harmless, {{}, interruption});
  Asked   asked(one);
  for (const Computation &computation : scene_computations())
    if (computation.name == one.compute)
      result_ = computation.compute(session, asked);
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
