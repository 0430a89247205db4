#include "apps/cli/cache_commands.h"

#include "apps/cli/command_answers.h"
#include "apps/cli/json_answer.h"
#include "apps/session/prepared_machine.h"
#include "coupling/frame/cache_folder.h"
#include "coupling/frame/frame_cache.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <vector>

namespace gestell::apps
{

namespace
{

/// Formats as std::printf does.
template <typename... Parts>
std::string formatted(const char *format, const Parts &...parts)
{
  std::string text(std::size_t(std::snprintf(nullptr, 0, format, parts...)) + 1, '\0');
  std::snprintf(text.data(), text.size(), format, parts...);
  text.pop_back();
  return text;
}

using coupling::CacheEntry;

/// "12.4 MB"
std::string size_text(double bytes)
{
  const char *const units[] = {"B", "kB", "MB", "GB", "TB"};
  int               unit    = 0;
  for (; bytes >= 1000. && unit < 4; ++unit)
    bytes /= 1000.;
  char text[40];
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", bytes, units[unit]);
  return text;
}

std::string date_text(std::time_t time)
{
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", std::localtime(&time));
  return text;
}

std::string short_key(const std::string &key)
{
  return key.substr(0, 12);
}

/// A number with one of these units: "30 d" is 30 * 86400.
double amount(const std::string &option, const std::string &text, const std::map<std::string, double> &units)
{
  char        *end    = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string  unit(end);
  unit.erase(0, unit.find_first_not_of(' '));
  const auto found = units.find(unit);
  if (end == text.c_str() || found == units.end() || !(number >= 0.) || !std::isfinite(number))
  {
    std::string valid;
    for (const auto &[name, value] : units)
      valid += (valid.empty() ? "" : ", ") + name;
    throw std::invalid_argument(option + ": got '" + text +
                                "'; it needs a number of zero or more with one of the units " + valid);
  }
  return number * found->second;
}

const std::map<std::string, double> times{{"s", 1.}, {"min", 60.}, {"h", 3600.}, {"d", 86400.}, {"w", 7. * 86400.}};
const std::map<std::string, double> sizes{{"B", 1.}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}};

std::string origin_text(const coupling::FrameOrigin &origin)
{
  const auto name = [](const std::string &path) { return std::filesystem::path(path).filename().string(); };
  return name(origin.source) + " for " + origin.scene;
}

bool begins(const std::string &text, const std::string &part)
{
  return text.compare(0, part.size(), part) == 0;
}

/// "interface.2.coupling": a choice stored as a number in a recipe is shown by its name in scenes.
std::string choice_text(const std::string &name, const std::string &value)
{
  struct Choice
  {
    const char                 *begin, *end; ///< of the ingredient's name
    std::map<int, const char *> names;
  };
  using fem::InterfaceCoupling;
  const std::map<int, const char *> couplings{{int(InterfaceCoupling::rigid), "rigid"},
                                              {int(InterfaceCoupling::flexible), "flexible"},
                                              {int(InterfaceCoupling::average), "average"},
                                              {int(InterfaceCoupling::point), "point"},
                                              {int(InterfaceCoupling::node), "node"}};
  const std::vector<Choice>         choices{
      {"interface.", ".coupling", couplings},
      {"mass.", ".coupling", couplings},
      {"support.",
               ".kind",
               {{int(fem::SupportKind::clamped), "clamped"}, {int(fem::SupportKind::foundation), "foundation"}}},
      {"mesh.overlaps", "", {{int(fem::Overlaps::refused), "refused"}, {int(fem::Overlaps::once), "once"}}}};
  for (const Choice &choice : choices)
    if (const std::string end = choice.end; begins(name, choice.begin) && name.size() >= end.size() &&
                                            name.compare(name.size() - end.size(), end.size(), end) == 0)
      for (const auto &[number, called] : choice.names)
        if (value == std::to_string(number))
          return called;
  return value;
}

std::string ingredient_text(const std::string &name, const std::string &given)
{
  const std::string value = choice_text(name, given);
  return value.empty() ? "(none)" : value.size() > 48 ? value.substr(0, 12) + "..." : value;
}

void explain_miss(const std::vector<CacheEntry> &entries, const coupling::Recipe &recipe)
{
  const auto nearest = nearest_entry(entries, recipe);
  if (!nearest)
  {
    std::cout << "  the cache holds no other frame\n";
    return;
  }
  const auto different = differences(nearest->origin.recipe, recipe);
  std::cout << "  nearest: " << short_key(nearest->key) << ", " << origin_text(nearest->origin) << ", last used "
            << date_text(nearest->last_used) << "; it differs in\n";
  for (const auto &[name, kept, requested] : different)
    std::cout << "    " << name << ": cached " << ingredient_text(name, kept) << ", requested "
              << ingredient_text(name, requested) << '\n';
  if (different.empty())
    std::cout << "    the order of supports, interfaces or cuts\n";
}

CacheExplanation explained(const std::string &scene, const std::string &key, const coupling::Recipe &recipe,
                           const std::vector<CacheEntry> &entries, const std::string &defect)
{
  CacheExplanation found{scene, key, {}, defect};
  for (const CacheEntry &entry : entries)
    if (entry.key == key)
      found.own = entry;
  if (found.own && defect.empty())
    return found;
  found.nearest = nearest_entry(entries, recipe);
  if (found.nearest)
    found.differences = differences(found.nearest->origin.recipe, recipe);
  return found;
}

/// Ingredients in which the recipes of these frames differ, by name, in the order of the first frame.
std::vector<std::string> distinguishing(const std::vector<const CacheEntry *> &entries)
{
  std::vector<std::string> names;
  for (const CacheEntry *entry : entries)
    for (const auto &difference : coupling::differences(entries.front()->origin.recipe, entry->origin.recipe))
      if (std::find(names.begin(), names.end(), difference.name) == names.end())
        names.push_back(difference.name);
  return names;
}

/// "mesh.size 0.015, reduction.modes 13": the differences between frames with the same source.
std::string particulars(const CacheEntry &entry, const std::vector<CacheEntry> &entries)
{
  std::vector<const CacheEntry *> alike;
  for (const CacheEntry &other : entries)
    if (other.defect.empty() && origin_text(other.origin) == origin_text(entry.origin))
      alike.push_back(&other);
  std::string           text;
  const auto           &recipe           = entry.origin.recipe;
  const auto            names            = distinguishing(alike);
  constexpr std::size_t most_particulars = 6; // what fits one line
  const std::size_t     shown            = std::min(names.size(), most_particulars);
  for (std::size_t i = 0; i < shown; ++i)
  {
    const auto own =
        std::find_if(recipe.begin(), recipe.end(), [&](const auto &part) { return part.name == names[i]; });
    text += (i > 0 ? ", " : "") + names[i] + " " + ingredient_text(names[i], own == recipe.end() ? "" : own->value);
  }
  return text + (shown < names.size() ? ", and " + std::to_string(names.size() - shown) + " more" : "");
}

coupling::CacheCheck check_of(const ReduceCommandOptions &options)
{
  return options.check ? coupling::CacheCheck::contents : coupling::CacheCheck::heads;
}

} // namespace

void list_cache(const ReduceCommandOptions &options)
{
  const auto     entries = coupling::cache_entries(check_of(options));
  std::uintmax_t bytes   = 0;
  for (const CacheEntry &entry : entries)
    bytes += entry.bytes;
  if (answers_in_json())
    answer_with(cache_answer(entries));
  std::cout << coupling::cache_folder() << ": " << count_text(entries.size(), "file") << ", "
            << size_text(double(bytes)) << '\n';
  if (entries.empty())
    return;
  std::cout << formatted("  %-12s  %-16s  %9s  %-26s  %s\n", "key", "last used", "size", "DOFs", "made from");
  for (const CacheEntry &entry : entries)
  {
    const std::string coordinates = std::to_string(entry.n_full) + " -> " + std::to_string(entry.n_interface) + " + " +
                                    std::to_string(entry.n_modes) + " modes";
    const bool good = entry.defect.empty();
    std::cout << formatted("  %-12s  %-16s  %9s  %-26s  %s\n", short_key(entry.key).c_str(),
                           date_text(entry.last_used).c_str(), size_text(double(entry.bytes)).c_str(),
                           good ? coordinates.c_str() : "-",
                           good ? origin_text(entry.origin).c_str() : ("unusable: " + entry.defect).c_str());
    if (const std::string own = good ? particulars(entry, entries) : ""; !own.empty())
      std::cout << formatted("  %-12s  %s\n", "", own.c_str());
  }
  if (options.check)
  {
    const auto n_bad =
        std::count_if(entries.begin(), entries.end(), [](const CacheEntry &entry) { return !entry.defect.empty(); });
    std::cout << formatted(
        "checked: %s read whole, against checksum and key; %s\n", count_text(entries.size(), "file").c_str(),
        n_bad == 0 ? "all can be used"
                   : (std::to_string(n_bad) + " cannot be used, --prune --check removes such files").c_str());
  }
  std::cout.flush();
}

void explain_cache(const Scene &scene)
{
  const auto        recipe  = frame_origin(scene).recipe;
  const std::string key     = coupling::content_key(recipe);
  const auto        entries = coupling::cache_entries();
  const auto        own     = std::find_if(entries.begin(), entries.end(), [&](const auto &e) { return e.key == key; });
  const std::string defect  = own == entries.end() ? "" : coupling::content_defect(*own);
  if (answers_in_json())
    answer_with(explanation_answer(explained(scene.file, key, recipe, entries, defect)));
  std::cout << scene.file << ": frame " << short_key(key);
  if (own == entries.end())
    std::cout << " is not in the cache " << coupling::cache_folder() << "; it would be made\n";
  else if (!defect.empty())
    std::cout << " would be reduced again: " << own->file << ' ' << defect << '\n';
  else
  {
    std::cout << " is in the cache and would be used\n  " << own->file << ", " << size_text(double(own->bytes))
              << ", last used " << date_text(own->last_used) << "\n  " << own->n_full << " DOFs -> " << own->n_interface
              << " interface + " << own->n_modes << " modes, " << origin_text(own->origin) << '\n';
    return;
  }
  explain_miss(entries, recipe);
}

void prune_cache(const ReduceCommandOptions &options)
{
  const double oldest  = options.older_than.empty() ? HUGE_VAL : amount("--older-than", options.older_than, times);
  const double largest = options.larger_than.empty() ? HUGE_VAL : amount("--larger-than", options.larger_than, sizes);
  const auto   now     = std::time(nullptr);
  std::size_t  removed = 0;
  double       bytes   = 0.;
  for (const CacheEntry &entry : coupling::cache_entries(check_of(options)))
  {
    const bool goes = options.all || !entry.defect.empty() || std::difftime(now, entry.last_used) > oldest ||
                      double(entry.bytes) > largest;
    if (!goes)
      continue;
    if (const std::string reason = remove_entry(entry); !reason.empty())
    {
      std::cout << reason << '\n';
      continue;
    }
    ++removed;
    bytes += double(entry.bytes);
  }
  std::cout << coupling::cache_folder() << ": removed " << count_text(removed, "file") << ", " << size_text(bytes)
            << std::endl;
}

} // namespace gestell::apps
