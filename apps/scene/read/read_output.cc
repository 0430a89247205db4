#include "apps/scene/read/read_output.h"

#include "apps/scene/read/read_stress.h"

namespace gestell::apps
{

void read_output(const SceneTable &scene, Scene &result)
{
  coupling::RunOptions &run = result.run.options;
  // A hundred pictures by default: enough for a film, little enough for a disk.
  run.picture_step = (run.end - run.begin) / 100.;
  const auto table = scene.optional_table("output");
  if (!table)
    return;
  run.output_step  = table->positive("step", kind::time, 0.);
  run.picture_step = table->not_negative("picture_step", kind::time, run.picture_step);
  run.allow_large  = table->boolean("allow_large", run.allow_large);
  if (table->is_array("signals"))
    for (const auto &path : table->texts("signals"))
    {
      for (const SignalRequest &other : result.signals)
        if (other.name == path)
          throw table->error("signals", "'" + path + "' stands in the list twice");
      result.signals.push_back({path, path, table->place("signals"), ""});
    }
  else if (const auto signals = table->optional_table("signals"))
    for (const auto &name : signals->keys())
    {
      if (name.empty() || name.find_first_of(",\"\n[]") != std::string::npos || name == "t")
        throw signals->error(name,
                             "is no name for a signal: it heads a column of history.csv, so it must not be 't' or "
                             "contain commas, quotes or brackets");
      if (!signals->is_table(name))
      {
        result.signals.push_back({name, signals->text(name), signals->place(name), ""});
        continue;
      }
      const auto watched = signals->table(name);
      result.signals.push_back({name, watched.text("signal"), signals->place(name), watched.text("from")});
    }
  read_stress(*table, result);
}

} // namespace gestell::apps
