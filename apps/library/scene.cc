#include "apps/library/scene.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/result_folder.h"
#include "apps/output/folder_lock.h"
#include "apps/scene/file/extending_scene.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"
#include "apps/scene/file/user_value.h"
#include "apps/session/checkpoint/input_files.h"
#include "apps/session/session.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <filesystem>

namespace gestell
{

namespace fs = std::filesystem;

struct Run::Parts
{
  std::shared_ptr<apps::Session> session; ///< to which the result refers
  apps::Result                   result;
  std::map<std::string, Peak>    peaks{};
  std::vector<Event>             events{};
  std::vector<std::string>       warnings{};
  std::vector<double>            times{};
};

struct Scene::Parts : apps::Variant
{
};

namespace
{

std::vector<double> column(const coupling::RunResult &run, std::size_t number)
{
  std::vector<double> values;
  for (std::size_t at = number; at < run.rows.size(); at += run.columns.size())
    values.push_back(run.rows[at]);
  return values;
}

} // namespace

const std::map<std::string, Peak> &Run::peaks() const
{
  return parts_->peaks;
}

const std::vector<Event> &Run::events() const
{
  return parts_->events;
}

const std::vector<std::string> &Run::warnings() const
{
  return parts_->warnings;
}

const std::string &Run::failure() const
{
  return parts_->result.run->failure;
}

const std::vector<double> &Run::times() const
{
  return parts_->times;
}

std::vector<double> Run::history(const std::string &signal) const
{
  const auto &columns = parts_->result.run->columns;
  const auto  found   = std::find(columns.begin(), columns.end(), signal);
  if (found == columns.end())
    throw std::invalid_argument("the run has no signal '" + signal + "'" + suggestion(signal, columns));
  return column(*parts_->result.run, std::size_t(found - columns.begin()));
}

void Run::save(const std::string &folder) const
{
  apps::require_writable(folder);
  const apps::FolderLock held(folder);
  const apps::Request   &requested = parts_->result.requested;
  apps::prepare_folder(folder, apps::input_files(requested.file, requested.set));
  apps::write_results(folder, parts_->result);
}

Scene::Scene(const std::string &file) : parts_(new Parts{apps::Variant::of_file(file)}) {}

Scene Scene::of_text(const std::string &text, const std::string &folder)
{
  const fs::path path = (fs::absolute(folder) / "scene").lexically_normal();
  const auto     own  = apps::parse_toml_text(text, "scene", path.parent_path().string());
  return Scene(std::shared_ptr<Parts>(new Parts{{apps::with_extended(own, path.string()), path.string()}}));
}

Scene &Scene::set(const std::string &key, const std::string &value)
{
  auto changed = std::make_shared<Parts>(*parts_);
  changed->set(key + "=" + value);
  parts_ = std::move(changed);
  return *this;
}

Scene &Scene::set(const std::string &key, double value)
{
  std::string text = exact_text(value);
  if (text.find_first_of(".en") == std::string::npos)
    text += ".0";
  return set(key, text);
}

Scene &Scene::set(const std::string &key, const Law &law)
{
  using mechanism::Numbers;
  auto functions = std::make_shared<mechanism::UserLaw>();
  if (law.force)
    functions->force = [f = law.force](Numbers x, Numbers, double *y, int)
    { y[0] = f(x.begin[0], x.begin[1], x.begin[2]); };
  if (law.derivative)
    functions->derivative = [f = law.derivative](Numbers x, Numbers, double *y, int)
    { std::copy_n(f(x.begin[0], x.begin[1], x.begin[2]).begin(), 2, y); };
  auto value  = std::make_shared<apps::UserValue>();
  value->mark = "<function of C++>";
  value->law  = functions;
  apps::SceneNode node;
  node.type  = apps::SceneNode::Type::function;
  node.place = {"scene[\"" + key + "\"]", 0};
  node.text  = value->mark;
  node.user  = value;

  auto changed = std::make_shared<Parts>(*parts_);
  apps::apply_override(changed->root, key, node);
  changed->changes.push_back(key + "=" + apps::written_value(node));
  parts_ = std::move(changed);
  return *this;
}

Run Scene::run() const
{
  auto session = std::make_shared<apps::Session>(*parts_);
  session->check_run();
  auto        parts = std::make_shared<Run::Parts>(Run::Parts{session, apps::complete_run(*session)});
  const auto &run   = *parts->result.run;
  for (const coupling::SignalSummary &s : run.signals)
    parts->peaks[s.name] = {s.unit, s.min, s.t_min, s.max, s.t_max, s.final};
  for (const coupling::Event &event : run.events)
    parts->events.push_back({event.t, event.name, event.kind});
  parts->warnings = apps::all_warnings(parts->result);
  if (!run.columns.empty())
    parts->times = column(run, 0);
  return Run(std::move(parts));
}

Modes Scene::modes() const
{
  const apps::Result result = apps::Session(*parts_).modes();
  Modes              modes;
  modes.coordinates = result.coordinate_names;
  for (const coupling::Mode &mode : result.coupled_modes)
  {
    modes.frequencies_hz.push_back(mode.frequency_hz);
    modes.damping_ratios.push_back(mode.damping_ratio);
    modes.shapes.emplace_back(mode.shape.data(), mode.shape.data() + mode.shape.size());
  }
  return modes;
}

} // namespace gestell
