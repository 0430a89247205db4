#include "apps/scene/file/universal_file.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/number_text.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Lines between two markers -1; the first line identifies the data set.
struct DataSet
{
  std::string              file, kind;
  int                      line = 0; ///< line in the file at which its records begin
  std::vector<std::string> records;

  [[noreturn]] void refuse(std::size_t record, const std::string &reason) const
  {
    throw std::invalid_argument(file + ":" + std::to_string(line + int(record)) + ": data set " + kind + ": " + reason);
  }
};

std::vector<DataSet> data_sets(const std::string &file)
{
  std::ifstream in(file);
  if (!in)
    throw std::invalid_argument(file + ": cannot be read; check the path and its permissions");
  std::vector<DataSet> sets;
  bool                 inside = false;
  int                  number = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (line.find('\0') != std::string::npos)
      throw std::invalid_argument(
          file + ":" + std::to_string(number) +
          ": contains a zero byte; only ASCII universal files can be read, so export the file in ASCII");
    const std::string text = trimmed(line);
    if (text == "-1")
    {
      inside = !inside;
      if (inside)
        sets.push_back({file, "", 0, {}});
    }
    else if (inside && sets.back().kind.empty())
    {
      sets.back().kind = text.substr(0, text.find(' '));
      sets.back().line = number + 1;
    }
    else if (inside)
      sets.back().records.push_back(line);
  }
  if (inside)
    throw std::invalid_argument(file + ":" + std::to_string(number) + ": ends within data set " + sets.back().kind +
                                "; its last line must be -1");
  return sets;
}

/// The numbers of records from `first` on; Fortran leaves no blank before a minus and writes D for E.
std::vector<double> numbers(const DataSet &set, std::size_t first, std::size_t last)
{
  std::vector<double> found;
  for (std::size_t i = first; i < std::min(last, set.records.size()); ++i)
  {
    std::string text = set.records[i];
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
    const char *at = text.c_str();
    for (const char *end = nullptr;; at = end)
    {
      double value = 0.;
      end          = coupling::read_number(at, value);
      if (end == at)
        break;
      if (!std::isfinite(value))
        set.refuse(i, "a value is not finite");
      found.push_back(value);
    }
    if (!trimmed(std::string(at)).empty())
      set.refuse(i, "got '" + trimmed(std::string(at)).substr(0, 20) + "'; a number is needed");
  }
  return found;
}

/// The first number of a record, as a whole one.
int first_number(const DataSet &set, std::size_t record)
{
  return int(std::strtol(set.records[record].c_str(), nullptr, 10));
}

/// An integer that encodes a choice; -1: none.
int whole(double number)
{
  return number >= 0. && number <= 1e6 && number == std::floor(number) ? int(number) : -1;
}

/// Number of time derivatives, from the type of the ordinate's numerator: 8 displacement, 11 velocity, 12 acceleration.
int derivatives_of(int data_type)
{
  return data_type == 8 ? 0 : data_type == 11 ? 1 : data_type == 12 ? 2 : -1;
}

UniversalFunction function_of(const DataSet &set)
{
  constexpr int n_head = 11; // records before the numbers
  if (set.records.size() <= n_head)
    set.refuse(set.records.size(), "ends before its numbers; it needs eleven header lines");
  const std::vector<double> form = numbers(set, 6, 7);
  if (form.size() < 5)
    set.refuse(6, "needs data type, number of points, spacing, first abscissa and its increment");
  const int  type = whole(form[0]), spacing = whole(form[2]);
  const bool is_complex = type == 5 || type == 6;
  if (!is_complex && type != 2 && type != 4)
    set.refuse(6, "data type is " + std::to_string(type) + "; 2 or 4 (real), 5 or 6 (complex) are known");
  if (!(form[1] >= 1.) || !(form[1] <= 1e8) || (spacing != 0 && spacing != 1))
    set.refuse(6, "the number of points must be above zero and the spacing 0 (uneven) or 1 (even)");
  constexpr int frequency_axis = 18; // data set 58, record 8: abscissa is frequency
  if (const int axis = first_number(set, 7); axis != frequency_axis)
    set.refuse(7, "its abscissa is of type " + std::to_string(axis) + "; a frequency response needs 18 (frequency)");
  const std::size_t count = std::size_t(form[1]), first = spacing == 0 ? 1 : 0, width = first + (is_complex ? 2 : 1);
  const std::vector<double> values = numbers(set, n_head, set.records.size());
  if (values.size() != count * width)
    set.refuse(n_head, "has " + std::to_string(values.size()) + " numbers; " + std::to_string(count) + " points need " +
                           std::to_string(count * width));
  UniversalFunction function;
  function.name        = trimmed(set.records[0]);
  function.line        = set.line;
  function.is_complex  = is_complex;
  function.derivatives = derivatives_of(first_number(set, 8));
  for (std::size_t i = 0; i < count; ++i)
  {
    const double *at = values.data() + i * width;
    function.abscissa.push_back(spacing == 0 ? at[0] : form[3] + double(i) * form[4]);
    function.values.emplace_back(at[first], is_complex ? at[first + 1] : 0.);
    if (i > 0 && !(function.abscissa[i] > function.abscissa[i - 1]))
      set.refuse(n_head, "its frequencies must ascend");
    if (!std::isfinite(function.abscissa[i]))
      set.refuse(6, "a frequency is not finite; check the first one and the increment");
  }
  return function;
}

void require_si(const DataSet &set)
{
  constexpr int si_units = 1; // data set 164, record 1: SI
  if (set.kind == "164" && !set.records.empty() && first_number(set, 0) != si_units)
    set.refuse(0,
               "the unit code is " + std::to_string(first_number(set, 0)) + "; export the file in SI units (code 1)");
}

using Nodes = std::map<double, std::array<double, 3>>; ///< by their numbers

/// Nodes of a data set 15 (one record each) or 2411 (two).
void add_nodes(const DataSet &set, Nodes &nodes)
{
  const std::size_t records = set.kind == "15" ? 1 : 2;
  for (std::size_t i = 0; i + records <= set.records.size(); i += records)
  {
    const std::vector<double> node = numbers(set, i, i + records);
    if (node.size() != 7)
      set.refuse(i, "a node needs its number, three more integers and x, y, z; found " + std::to_string(node.size()) +
                        " numbers");
    nodes[node[0]] = {node[4], node[5], node[6]};
  }
}

/// Whether the data set holds a mode, which is stored in `mode`; data of other analyses are none.
bool is_mode(const DataSet &set, const Nodes &nodes, UniversalMode &mode)
{
  constexpr int n_head = 8; // records before the nodes
  if (set.records.size() < n_head)
    set.refuse(set.records.size(), "ends within its head; it needs eight lines before the nodes");
  const std::vector<double> form = numbers(set, 5, 6), head = numbers(set, 6, 7), real = numbers(set, 7, 8);
  if (form.size() < 6 || head.size() < 2)
    set.refuse(5, "needs six numbers that define its data, and two sizes in the next line");
  const int  analysis = whole(form[1]), width = whole(form[5]);
  const bool is_normal = analysis == 2, is_complex = analysis == 3 || analysis == 7; // eigenvalues
  if (!is_normal && !is_complex)
    return false;
  if (real.size() < (is_normal ? 3U : 2U) || width < 3)
    set.refuse(7, is_normal ? "a mode needs its frequency, modal mass and damping ratio, and three values per node"
                            : "a mode needs both parts of its eigenvalue, and three values per node");
  mode.line                        = set.line;
  mode.hz                          = is_normal ? real[0] : std::hypot(real[0], real[1]) / (2. * M_PI);
  mode.zeta                        = is_normal ? real[2] : -real[0] / std::hypot(real[0], real[1]);
  const std::size_t         parts  = whole(form[4]) == 5 || whole(form[4]) == 6 ? 2 : 1; // of a complex value
  const std::vector<double> values = numbers(set, n_head, set.records.size());
  const std::size_t         record = 1 + std::size_t(width) * parts;
  if (values.size() % record != 0)
    set.refuse(n_head, "has " + std::to_string(values.size()) + " numbers, but a node and its values take " +
                           std::to_string(record));
  for (std::size_t i = 0; i < values.size(); i += record)
  {
    const auto node = nodes.find(values[i]);
    if (!nodes.empty() && node == nodes.end())
      set.refuse(n_head, "node " + short_text(values[i], 10) + " has no coordinates in data sets 15 and 2411");
    for (std::size_t d = 0; d < 3; ++d)
      mode.shape.emplace_back(values[i + 1 + parts * d], parts == 2 ? values[i + 2 + parts * d] : 0.);
    if (node != nodes.end())
      mode.points.push_back(node->second);
  }
  return true;
}

} // namespace

std::vector<UniversalMode> read_universal_modes(const std::string &file)
{
  const std::vector<DataSet> sets = data_sets(file);
  Nodes                      nodes;
  std::vector<UniversalMode> modes;
  for (const DataSet &set : sets)
  {
    require_si(set);
    if (set.kind == "15" || set.kind == "2411")
      add_nodes(set, nodes);
  }
  for (const DataSet &set : sets)
    if (UniversalMode mode; set.kind == "55" && is_mode(set, nodes, mode))
      modes.push_back(std::move(mode));
  if (modes.empty())
    throw std::invalid_argument(file + ": contains no modes (data sets 55 of normal or complex modes)");
  return modes;
}

std::vector<UniversalFunction> read_universal_functions(const std::string &file)
{
  std::vector<UniversalFunction> functions;
  for (const DataSet &set : data_sets(file))
  {
    require_si(set);
    if (set.kind == "58b")
      set.refuse(0, "is binary; export the file in ASCII");
    if (set.kind == "58")
      functions.push_back(function_of(set));
  }
  if (functions.empty())
    throw std::invalid_argument(file + ": contains no data set 58 (frequency response functions)");
  return functions;
}

} // namespace gestell::apps
