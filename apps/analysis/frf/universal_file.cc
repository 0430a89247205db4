#include "apps/analysis/frf/universal_file.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
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

} // namespace

std::vector<UniversalFunction> read_universal_functions(const std::string &file)
{
  std::vector<UniversalFunction> functions;
  constexpr int                  si_units = 1; // data set 164, record 1: SI
  for (const DataSet &set : data_sets(file))
    if (set.kind == "58b")
      set.refuse(0, "is binary; export the file in ASCII");
    else if (set.kind == "164" && !set.records.empty() && first_number(set, 0) != si_units)
      set.refuse(0,
                 "the unit code is " + std::to_string(first_number(set, 0)) + "; export the file in SI units (code 1)");
    else if (set.kind == "58")
      functions.push_back(function_of(set));
  if (functions.empty())
    throw std::invalid_argument(file + ": contains no data set 58 (frequency response functions)");
  return functions;
}

} // namespace gestell::apps
