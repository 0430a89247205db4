#include "apps/scene/read/read_output.h"

#include "apps/scene/read/read_stages.h"
#include "apps/scene/read/read_stress.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{

const std::vector<Key> &output_keys()
{
  static const std::vector<Key> keys = {
      key::map("signals", kind::number, {},
               "table `{ F_P = \"rod.force\", x1 = \"-frame.crown.uz\" }`; a leading minus turns the sign. `{ Q4 = { "
               "signal = "
               "\"cylinder.force\", from = \"limiter\" } }` counts extremes from the first event of that name on, its "
               "limit behind a jump included. Or an array of paths, which then are the names")
          .also({Key::Form::texts})
          .by_default("none"),
      key::number("step", kind::time, "between rows of `history.csv`, taken from the dense output where no step ends")
          .above_zero()
          .by_default("the fixed step; with a tolerance a two thousandth of the run"),
      key::number(
          "from", kind::time,
          "start of the window in which extremes, key numbers and spectra are taken; or `\"last period\"`, [see "
          "there](#a-window-for-results)")
          .also({Key::Form::text})
          .by_default("the start of the run"),
      key::number("picture_step", kind::time, "between pictures of the motion; 0: none")
          .from_zero()
          .by_default("a hundredth of the run"),
      key::truth("allow_large", coupling::RunOptions().allow_large,
                 "more than 1 GB of history and states, or 20 000 pictures, is refused without it"),
      key::table("stress", {}, "stresses, [see there](#stress)").by_default("none"),
      key::table("stages", {}, "parts of the run between events, [see there](#stages)").by_default("none")};
  return keys;
}

const std::vector<Key> &watched_signal_keys()
{
  static const std::vector<Key> keys = {key::plain("signal", Key::Form::text, "path of the signal, `\"rod.force\"`"),
                                        key::plain("from", Key::Form::text, "event from which on extremes count")};
  return keys;
}

static void read_window(const SceneTable &table, Scene &result)
{
  const std::string     last_period = "last period", text = table.is_text("from") ? table.text("from") : "";
  coupling::RunOptions &run = result.run.options;
  result.run.last_period    = text == last_period;
  if (result.run.last_period)
    return;
  if (!nearest_name(text, {last_period}).empty())
    throw table.error("from", "there is no '" + text + "'; did you mean '" + last_period + "'?");
  run.from = table.value_or("from", run.from);
  if (table.has("from") && run.from < run.begin)
    throw table.error("from", "is " + short_text(run.from) + " s, before the run begins at " + short_text(run.begin) +
                                  " s; give a time within the run, or leave it out for the whole run");
}

void read_output(const SceneTable &scene, Scene &result)
{
  coupling::RunOptions &run = result.run.options;
  // A hundred pictures by default: enough for a film, little enough for a disk.
  run.picture_step = (run.end - run.begin) / 100.;
  if (!scene.has("output"))
    return;
  const SceneTable table = scene.table("output").declared(output_keys());
  run.output_step        = table.value_or("step", 0.);
  run.picture_step       = table.value_or("picture_step", run.picture_step);
  run.allow_large        = table.truth("allow_large");
  read_window(table, result);
  if (table.is_array("signals"))
    for (const auto &path : table.texts("signals"))
    {
      for (const SignalRequest &other : result.signals)
        if (other.name == path)
          throw table.error("signals", "'" + path + "' stands in the list twice");
      result.signals.push_back({path, path, table.place("signals"), ""});
    }
  else if (const auto signals = table.optional_table("signals"))
    for (const auto &name : signals->keys())
    {
      if (name.empty() || name.find_first_of(",\"\n[]") != std::string::npos || name == "t")
        throw signals->error(name, "is no name for a signal: it heads a column of history.csv, so it must not be 't' "
                                   "or contain commas, quotes or brackets");
      if (!signals->is_table(name))
      {
        result.signals.push_back({name, signals->text(name), signals->place(name), ""});
        continue;
      }
      const auto watched = signals->table(name).declared(watched_signal_keys());
      result.signals.push_back({name, watched.text("signal"), signals->place(name), watched.text("from")});
    }
  read_stress(table, result);
  read_stages(table, result);
}

} // namespace gestell::apps
