#include "apps/scene/read/frame/read_damping.h"

#include "apps/scene/file/csv_file.h"
#include "apps/scene/file/expected_values.h"
#include "apps/scene/file/universal_file.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace gestell::apps
{
namespace
{

void check_ratio(const SceneTable &table, double zeta)
{
  if (zeta < 0.)
    throw table.error("ratio", "needs damping ratios of zero or more");
  if (zeta >= 1.)
    throw table.error("ratio", "a damping ratio of 1 or more leaves no vibration; steel frames have 0.01 to 0.03");
  if (const std::string words = unexpected_words("ratio of damping", kind::number, zeta); !words.empty())
    table.warn("ratio", words + ", percent are written \"0.5 %\"");
}

/// A measured mode, with the place of its row in the file.
void check_measured(const fem::NamedRatio &mode)
{
  if (!(mode.ratio >= 0.) || mode.ratio >= 1.)
    throw std::invalid_argument(mode.place + ": the damping ratio is " + short_text(mode.ratio) +
                                "; it needs 0 or more, and less than 1 (a share: 0.01, not percent)");
  if (mode.mode < 0 && !(mode.from > 0.))
    throw std::invalid_argument(mode.place + ": the frequency is " + short_text(mode.from) +
                                " Hz; a measured mode needs one above zero");
}

/// Columns frequency, ratio, and perhaps mode, the number of the frame's.
std::vector<fem::NamedRatio> measured_in_table(const std::string &name)
{
  const CsvFile file   = read_csv(name);
  const auto    column = [&](const std::string &word)
  {
    const auto found = std::find_if(file.head.begin(), file.head.end(),
                                    [&](const std::string &cell) { return cell.substr(0, word.size()) == word; });
    return found == file.head.end() ? -1 : int(found - file.head.begin());
  };
  const int hz = column("frequency"), ratio = column("ratio"), number = column("mode");
  if (ratio < 0 || (hz < 0 && number < 0))
    throw std::invalid_argument(file.place(file.head_number) +
                                "needs the columns \"ratio\" and \"frequency [Hz]\" or \"mode\"");
  std::vector<fem::NamedRatio> modes;
  for (const CsvFile::Line &line : file.lines)
  {
    fem::NamedRatio mode;
    mode.place = name + ":" + std::to_string(line.number);
    mode.ratio = file.number(line, std::size_t(ratio));
    if (number >= 0 && !line.cells[std::size_t(number)].empty())
      mode.mode = file.integer(line, std::size_t(number)) - 1;
    else if (hz >= 0)
      mode.from = mode.to = file.number(line, std::size_t(hz));
    if (number >= 0 && mode.mode < 0 && !(mode.from > 0.))
      throw std::invalid_argument(mode.place + ": modes are numbered from 1");
    modes.push_back(std::move(mode));
  }
  return modes;
}

std::vector<fem::NamedRatio> measured_in_universal_file(const std::string &name)
{
  std::vector<fem::NamedRatio> modes;
  for (UniversalMode &one : read_universal_modes(name))
  {
    fem::NamedRatio mode;
    mode.place = name + ":" + std::to_string(one.line);
    mode.ratio = one.zeta;
    mode.from = mode.to = one.hz;
    mode.points         = std::move(one.points);
    if (!mode.points.empty())
      mode.shape = Eigen::Map<const Eigen::VectorXcd>(one.shape.data(), Eigen::Index(one.shape.size()));
    modes.push_back(std::move(mode));
  }
  return modes;
}

/// One row of `modes`: of a number, an interval, or those of a file.
std::vector<fem::NamedRatio> read_named(const SceneTable &row)
{
  const bool number = row.has("mode"), interval = row.has("from") || row.has("to"), file = row.has("file");
  if (int(number) + int(interval) + int(file) != 1)
    throw row.error("needs either `mode`, or `from` and `to`, or `file`");
  if (file)
  {
    if (row.has("ratio"))
      throw row.error("ratio", "is read from the file; remove it here");
    const std::string name = row.file("file"), ending = std::filesystem::path(name).extension().string();
    auto              modes = ending == ".csv" ? measured_in_table(name) : measured_in_universal_file(name);
    if (modes.empty())
      throw row.error("file", "contains no modes; add a row for each mode");
    std::for_each(modes.begin(), modes.end(), check_measured);
    return modes;
  }
  fem::NamedRatio one;
  one.place = row.place();
  row.demand({"ratio"});
  one.ratio = row.value("ratio");
  check_ratio(row, one.ratio);
  if (number)
  {
    one.mode = row.whole("mode") - 1;
    if (one.mode < 0)
      throw row.error("mode", "is " + std::to_string(one.mode + 1) + "; the first elastic mode of the frame is 1");
    return {one};
  }
  row.demand({"from", "to"});
  one.from = row.value("from");
  one.to   = row.value("to");
  if (!(one.from >= 0.) || !(one.to > one.from))
    throw row.error("to", "must lie above `from`, and both at zero or above");
  return {one};
}

void read_modes(const SceneTable &damping, fem::ModalRatios &ratios)
{
  const auto rows = damping.table_array("modes");
  if (rows.empty())
    throw damping.error("modes", "is empty; give rows such as { mode = 1, ratio = 0.012 }, or leave it out");
  for (const SceneTable &row : rows)
    for (const fem::NamedRatio &one : read_named(row))
    {
      for (const fem::NamedRatio &other : ratios.named)
        if (one.mode >= 0 && other.mode == one.mode)
          throw std::invalid_argument(one.place + ": gives mode " + std::to_string(one.mode + 1) +
                                      " a second ratio, after " + other.place + "; leave one of them out");
        else if (one.from < one.to && other.from < other.to && one.from < other.to && other.from < one.to)
          throw row.error("covers frequencies from " + short_text(std::max(one.from, other.from)) + " to " +
                          short_text(std::min(one.to, other.to)) +
                          " Hz that another row covers as well; let one end where the other begins");
      ratios.named.push_back(one);
    }
}

fem::ModalRatios read_ratios(const SceneTable &damping)
{
  fem::ModalRatios ratios;
  if (damping.has("modes"))
    read_modes(damping, ratios);
  if (damping.has("modes") && !damping.has("ratio"))
    return ratios;
  if (damping.is_matrix("ratio"))
    for (const auto &[hz, zeta] : damping.pairs("ratio", kind::frequency, kind::number))
    {
      if (!(hz > (ratios.by_frequency.empty() ? 0. : ratios.by_frequency.back().first)))
        throw damping.error("ratio", "needs frequencies above zero in ascending order");
      ratios.by_frequency.emplace_back(hz, zeta);
      check_ratio(damping, zeta);
    }
  else if (damping.is_array("ratio"))
  {
    const std::vector<double> list = damping.numbers("ratio", kind::number);
    if (list.empty())
      throw damping.error("ratio", "is empty; give one number for all modes, or one for each of the lowest");
    for (const double zeta : list)
      check_ratio(damping, zeta);
    if (list.size() > 1 && !ratios.named.empty())
      throw damping.error("modes", "names modes, and so does the list `ratio`; give all of them here, and one `ratio` "
                                   "for the others");
    for (std::size_t i = 0; i + 1 < list.size(); ++i)
    {
      ratios.named.push_back({list[i], int(i)});
      ratios.named.back().place = damping.place("ratio");
    }
    ratios.constant = list.back();
  }
  else
  {
    ratios.constant = damping.value("ratio");
    check_ratio(damping, ratios.constant);
  }
  return ratios;
}

/// zeta = (alpha / omega + beta omega) / 2 at two frequencies.
void read_rayleigh(const SceneTable &damping, FrameDamping &result)
{
  const auto pairs = damping.table_array("rayleigh");
  if (pairs.size() != 2)
    throw damping.error("rayleigh", "has " + std::to_string(pairs.size()) +
                                        " pairs; it needs two, [{ frequency = \"20 Hz\", ratio = 0.01 }, { ... }]");
  double omega[2], zeta[2];
  for (int i = 0; i < 2; ++i)
  {
    omega[i] = 2. * M_PI * pairs[i].value("frequency");
    zeta[i]  = pairs[i].value("ratio");
    check_ratio(pairs[i], zeta[i]);
  }
  if (!(omega[1] > omega[0]))
    throw pairs[1].error("frequency", "must be above that of the first pair");
  const double squares = omega[1] * omega[1] - omega[0] * omega[0];
  result.beta          = 2. * (zeta[1] * omega[1] - zeta[0] * omega[0]) / squares;
  result.alpha         = 2. * omega[0] * omega[1] * (zeta[0] * omega[1] - zeta[1] * omega[0]) / squares;
  if (result.alpha < 0. || result.beta < 0.)
    throw damping.error("rayleigh", "would amplify some vibrations, because the two damping ratios differ by a larger "
                                    "factor than their frequencies; use damping ratios closer to each other");
}

} // namespace

const std::vector<Key> &damping_keys()
{
  static const std::vector<Key> keys = {
      key::number("ratio", kind::number,
                  "damping ratio of all elastic modes of the supported frame, dampers in addition; `[0.01, 0.02]`: of "
                  "the first, dampers included as in `modes`, and of the second and all higher modes; `[[\"20 Hz\", "
                  "0.01], [\"90 Hz\", 0.02]]`: over frequency, linear between the rows, constant beyond")
          .also({Key::Form::numbers, Key::Form::matrix})
          .by_default("`rayleigh`, or zero for modes not listed in `modes`"),
      key::composed(
          "modes", Key::Form::tables, kind::number,
          {key::plain("mode", Key::Form::whole, "number of an elastic mode of the supported frame, from 1")
               .by_default(""),
           key::number("from", kind::frequency, "lower end of a frequency interval, instead of `mode`").by_default(""),
           key::number("to", kind::frequency, "its upper end").by_default(""),
           key::plain("file", Key::Form::file,
                      "measured modes, instead of `mode` and `from`: CSV with the columns `frequency [Hz]`, `ratio` "
                      "and perhaps "
                      "`mode`, or a universal file with data sets 55")
               .by_default(""),
           key::number("ratio", kind::number, "damping ratio").by_default("of the file")},
          "damping ratios of single modes of the supported frame, dampers of its supports included; all other modes "
          "have `ratio` in addition to their dampers; exact in `gestell modes`. `mode` has priority over an interval. "
          "Measured modes without a number get the mode of the frame within 30 % of their frequency with the most "
          "similar shape (MAC), or without shapes with the nearest frequency")
          .by_default("none"),
      key::composed("rayleigh", Key::Form::tables, kind::number,
                    {key::number("frequency", kind::frequency, "frequency of a pair").above_zero(),
                     key::number("ratio", kind::number, "damping ratio at this frequency")},
                    "two pairs that determine B = αM + βC, proportional to mass and stiffness of the solids; modes "
                    "below and above both frequencies are damped more. With clamped supports, steps with many modes "
                    "are cheaper than for `ratio`")
          .by_default("`ratio`")};
  return keys;
}

FrameDamping read_damping(const SceneTable &any)
{
  const SceneTable damping = any.declared(damping_keys());
  FrameDamping     result;
  if (!damping.has("rayleigh"))
    result.ratios = read_ratios(damping);
  else if (damping.has("ratio") || damping.has("modes"))
    throw damping.error("rayleigh", "defines the damping of all modes, as `ratio` and `modes` do; remove one of them");
  else
    read_rayleigh(damping, result);
  return result;
}

} // namespace gestell::apps
