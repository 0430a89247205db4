#include "coupling/exchange/bulk_cards.h"

#include <algorithm>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// columns of Nastran's cards, in small fields of 8 and large ones of 16
constexpr std::size_t name_width = 8, small_width = 8, small_fields = 8, large_width = 16, large_fields = 4;

bool is_remark(std::string_view line)
{
  const std::string_view text = trimmed(line);
  return text.empty() || text[0] == '$';
}

/// The first field, without blanks.
std::string_view first_field(std::string_view line)
{
  return trimmed(line.substr(0, std::min({line.find_first_of(",\t"), name_width, line.size()})));
}

/// Whether the line continues the card before: its first field is blank, or begins with + or *.
bool is_continuation(std::string_view line)
{
  const std::string_view first = first_field(line);
  return first.empty() || first[0] == '+' || first[0] == '*';
}

} // namespace

BulkCards::BulkCards(TextFile &file, std::set<std::string> wanted) : file_(file), wanted_(std::move(wanted))
{
  while (file_.next())
    if (begins(trimmed(file_.line()), "BEGIN") && capitals(file_.line()).find("BULK") != std::string::npos)
      return;
  file_.restart(); // only bulk data, as in a punch file
}

bool BulkCards::take_line()
{
  if (ended_)
    return false;
  while (file_.next())
  {
    if (is_remark(file_.line()))
      continue;
    ended_ = begins(file_.line(), "ENDDATA");
    return !ended_;
  }
  ended_ = true;
  return false;
}

void BulkCards::add_fields()
{
  std::string_view line   = file_.line();
  line                    = line.substr(0, line.find('$'));
  const bool        large = first_field(line).find('*') != std::string_view::npos;
  const std::size_t count = large ? large_fields : small_fields, first = fields_.size();
  if (const auto comma = line.find(','); comma != std::string_view::npos)
    for (std::size_t at = comma; at != std::string_view::npos;)
    {
      const std::size_t      end  = line.find(',', at + 1);
      const std::string_view text = trimmed(line.substr(at + 1, end == std::string_view::npos ? end : end - at - 1));
      at                          = end;
      if (fields_.size() < first + count)
        fields_.push_back(text);
      else if (!text.empty() && text[0] != '+' && text[0] != '*') // a mark of the continuation
        file_.fail("a line has " + std::to_string(count) + " fields after its name, and '" + std::string(text) +
                   "' is one more; write it in a line that begins with a comma");
    }
  else
  {
    if (line.find('\t') != std::string_view::npos)
      file_.fail("columns cannot be inferred from tabs; write blanks or commas");
    const std::size_t width = large ? large_width : small_width;
    for (std::size_t i = 0, at = name_width; i < count && at < line.size(); ++i, at += width)
      fields_.push_back(trimmed(line.substr(at, width)));
  }
  fields_.resize(first + count);
  lines_.resize(fields_.size(), file_.number());
}

bool BulkCards::next()
{
  while (has_line_ || take_line())
  {
    has_line_        = false;
    std::string name = capitals(first_field(file_.line()));
    if (!name.empty() && name.back() == '*')
      name.pop_back();
    name_ = std::string(trimmed(name));
    if (is_continuation(file_.line()) || wanted_.count(name_) == 0)
      continue;
    line_ = file_.number();
    fields_.clear();
    lines_.clear();
    add_fields();
    while ((has_line_ = take_line()) && is_continuation(file_.line()))
      add_fields();
    return true;
  }
  return false;
}

} // namespace gestell::coupling
