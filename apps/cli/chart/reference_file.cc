#include "apps/cli/chart/reference_file.h"

#include "apps/scene/file/csv_file.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

CsvFile table_of(const std::string &path)
{
  try
  {
    return read_csv(path);
  }
  catch (const std::invalid_argument &refused)
  {
    throw std::invalid_argument(std::string("--reference: ") + refused.what());
  }
}

} // namespace

ReferenceFile::ReferenceFile(const std::string &file_path) : path(file_path)
{
  const CsvFile table  = table_of(path);
  const auto    refuse = [&](int line, const std::string &reason)
  { throw std::invalid_argument("--reference: " + table.place(line) + reason); };
  for (const std::string &head : table.head)
    names_.push_back(trimmed(head.substr(0, head.find('['))));
  if (names_.size() < 2 || names_.front() != "t")
    refuse(table.head_number, "the header must name t and at least one signal, such as \"t [s],F_P [N]\"");
  columns_.resize(names_.size());
  for (const CsvFile::Line &line : table.lines)
  {
    for (std::size_t i = 0; i < names_.size(); ++i)
      try
      {
        columns_[i].push_back(table.number(line, i));
      }
      catch (const std::invalid_argument &refused)
      {
        throw std::invalid_argument(std::string("--reference: ") + refused.what());
      }
    if (const auto &t = columns_[0]; t.size() > 1 && !(t.back() > t[t.size() - 2]))
      refuse(line.number, "the times must ascend");
  }
  if (columns_[0].size() < 2)
    refuse(table.head_number, "two rows of numbers or more must follow");
  times = columns_[0];
}

bool ReferenceFile::has(const std::string &name) const
{
  return std::find(names_.begin() + 1, names_.end(), name) != names_.end();
}

const std::vector<double> &ReferenceFile::column(const std::string &name) const
{
  return columns_[std::size_t(std::find(names_.begin(), names_.end(), name) - names_.begin())];
}

} // namespace gestell::apps
