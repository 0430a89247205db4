#include "apps/show/result_collections.h"
#include "fem/values/named_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path &file, const std::string &reason)
{
  throw std::invalid_argument(file.string() + ": " + reason);
}

std::string content_of(const fs::path &file)
{
  std::ifstream in(file, std::ios::binary);
  if (!in)
    refuse(file, "cannot be read; run the scene again");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool is_blank(char c)
{
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// "5" of `part="5"` in the text of an element; nothing if it has no such attribute.
std::optional<std::string> attribute(const std::string &element, const std::string &name)
{
  const auto behind_blanks = [&](std::size_t at)
  {
    while (at < element.size() && is_blank(element[at]))
      ++at;
    return at;
  };
  for (std::size_t at = element.find(name); at != std::string::npos; at = element.find(name, at + 1))
  {
    const std::size_t equals = behind_blanks(at + name.size());
    if (at == 0 || !is_blank(element[at - 1]) || element.compare(equals, 1, "=") != 0)
      continue;
    const std::size_t open = behind_blanks(equals + 1), close = element.find('"', open + 1);
    if (element.compare(open, 1, "\"") == 0 && close != std::string::npos)
      return element.substr(open + 1, close - open - 1);
  }
  return {};
}

/// All <DataSet ...> of a text.
std::vector<std::string> data_sets(const std::string &text)
{
  const std::string        begin = "<DataSet";
  std::vector<std::string> sets;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1))
  {
    const std::size_t end = text.find('>', at);
    if (end != std::string::npos && (is_blank(text[at + begin.size()]) || text[at + begin.size()] == '>'))
      sets.push_back(text.substr(at, end + 1 - at));
  }
  return sets;
}

double number_in(const fs::path &pvd, const std::string &element, const std::string &name)
{
  const auto   text  = attribute(element, name);
  char        *end   = nullptr;
  const double value = text ? std::strtod(text->c_str(), &end) : 0.;
  if (!text || text->empty() || *end != '\0' || !std::isfinite(value))
    refuse(pvd, "broken: a DataSet without a number " + name + ": " + element.substr(0, 80));
  return value;
}

fs::path file_in(const fs::path &pvd, const std::string &element)
{
  const auto name = attribute(element, "file");
  if (!name || name->empty())
    refuse(pvd, "broken: a DataSet without a file: " + element.substr(0, 80));
  const fs::path file = pvd.parent_path() / *name;
  if (!fs::is_regular_file(file))
    refuse(file, "named in " + pvd.filename().string() + ", is missing; run the scene again");
  return file;
}

std::vector<PictureFrame> collection_or_nothing(const fs::path &pvd)
{
  return fem::names_something(pvd) ? read_collection(pvd) : std::vector<PictureFrame>();
}

/// The picture nearest in time to the peak.
PictureSeries at_peak(const std::vector<PictureFrame> &motion, double t)
{
  const auto nearer = [&](const PictureFrame &a, const PictureFrame &b)
  { return std::abs(a.time - t) < std::abs(b.time - t); };
  return {"machine_peak",
          "Machine at the main peak, t = {t} s, displacements enlarged {times} times",
          {*std::min_element(motion.begin(), motion.end(), nearer)}};
}

void add_modes(const std::vector<PictureFrame> &modes, const std::string &name, const std::string &words,
               std::size_t most, std::vector<PictureSeries> &series)
{
  for (std::size_t j = 0; j < std::min(modes.size(), most); ++j)
    series.push_back({name + "_" + std::to_string(j + 1), words + " {t}: {frequency}", {modes[j]}, true});
}

void add_stresses(const std::vector<PictureFrame> &instants, std::vector<PictureSeries> &series)
{
  for (std::size_t k = 0; k < instants.size(); ++k)
    series.push_back({"stress_" + std::to_string(k + 1),
                      "Von Mises stress at t = {t} s, displacements enlarged {times} times",
                      {instants[k]}});
}

} // namespace

std::vector<PictureFrame> read_collection(const fs::path &pvd)
{
  const std::string text = content_of(pvd);
  if (text.find("<VTKFile") == std::string::npos || text.find("</VTKFile>") == std::string::npos)
    refuse(pvd, "is not a complete collection of VTK; run the scene again");
  std::map<double, std::map<double, fs::path>> frames; // by time, then part
  for (const std::string &set : data_sets(text))
  {
    const double time = number_in(pvd, set, "timestep"), part = number_in(pvd, set, "part");
    frames[time][part] = file_in(pvd, set);
  }
  if (frames.empty())
    refuse(pvd, "has no data set, because no body of the scene can be drawn; give bodies a 'size' or a 'radius' and "
                "run the scene again");
  std::vector<PictureFrame> list;
  for (const auto &[time, parts] : frames)
  {
    list.push_back({time, {}});
    for (const auto &part : parts)
      list.back().parts.push_back(part.second);
  }
  return list;
}

std::optional<double> peak_time(const fs::path &results)
{
  const fs::path file = results / "summary.json";
  if (!fem::names_something(file))
    return {};
  const auto summary = nlohmann::json::parse(content_of(file), nullptr, false);
  if (summary.is_discarded())
    refuse(file, "is not JSON; run the scene again");
  const auto peak = summary.find("main_peak");
  if (peak == summary.end() || !peak->is_object() || !peak->value("t", nlohmann::json()).is_number())
    return {};
  return peak->at("t").get<double>();
}

std::vector<PictureSeries> pictures_of(const fs::path &results, std::size_t most_modes)
{
  if (!fem::names_something(results) || !fs::is_directory(results))
    refuse(results, "is not a folder of results; name the folder that `gestell run` or `gestell modes` wrote");
  const auto motion = collection_or_nothing(results / "motion.pvd");

  const auto coupled = collection_or_nothing(results / "coupled_modes.pvd");

  std::vector<PictureSeries> series;
  if (!motion.empty())
    series.push_back({"machine", "Machine at t = {t} s", {motion.front()}, false, true});
  else if (!coupled.empty())
    series.push_back({"machine", "Machine in the configuration of the modes", {coupled.front()}, false, true});
  if (const auto t = peak_time(results); t && !motion.empty())
    series.push_back(at_peak(motion, *t));
  if (!motion.empty())
    series.push_back({"motion", "t = {t} s, displacements enlarged {times} times", motion});
  add_stresses(collection_or_nothing(results / "stress.pvd"), series);
  add_modes(coupled, "mode", "Coupled mode", most_modes, series);
  add_modes(collection_or_nothing(results / "frame_modes.pvd"), "frame_mode", "Mode of the frame", most_modes, series);
  if (series.empty())
    refuse(results, "contains no motion.pvd, coupled_modes.pvd or frame_modes.pvd; run the scene with "
                    "output.picture_step, or `gestell modes`");
  return series;
}

} // namespace gestell::apps
