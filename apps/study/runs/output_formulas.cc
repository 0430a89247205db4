#include "apps/study/runs/output_formulas.h"

#include "apps/scene/file/scene_override.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/tokens.h"
#include "apps/study/file/unit_quantity.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

bool is_letter(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Where the entry that begins at `at` ends: parts of letters, digits and spaces in quotes, with dots between.
std::size_t entry_end(const std::string &text, std::size_t at)
{
  while (at < text.size())
  {
    if (text[at] == '"' || text[at] == '\'')
      at = std::min(text.find(text[at], at + 1), text.size() - 1) + 1;
    else
      while (at < text.size() && is_letter(text[at]))
        ++at;
    if (at + 1 >= text.size() || text[at] != '.' ||
        !(is_letter(text[at + 1]) || text[at + 1] == '"' || text[at + 1] == '\''))
      return at;
    ++at;
  }
  return at;
}

/// The table whose entry begins at `at`, or "".
std::string table_at(const std::string &text, std::size_t at)
{
  if (at > 0 && (is_letter(text[at - 1]) || text[at - 1] == '.'))
    return "";
  for (const std::string &table : answer_entry::tables())
    if (text.compare(at, table.size() + 1, table + '.') == 0)
      return table;
  return "";
}

bool is_unit(const std::string &name)
{
  try
  {
    parse_quantity("1 " + name, [](const std::string &) { return std::optional<Quantity>(); });
    return true;
  }
  catch (const std::invalid_argument &)
  {
    return false;
  }
}

/// What an expression of these quantities is in, whatever their values.
Quantity unit_alone(const std::string &text, const NameLookup &look_up, const std::vector<std::string> &names)
{
  std::vector<Variable> variables;
  std::set<std::string> among;
  for (const Token &token : tokens_of(text))
    if (token.kind == Token::name && !is_reserved_name(token.text) && among.insert(token.text).second)
      if (const auto known = look_up(token.text); known && known->checked)
        variables.push_back({token.text, "of the study", known->dimension, known->counts});
  if (variables.size() > mechanism::Formula::max_variables)
    return {1., {}, false, Counts::nothing};
  const auto others = [&](const std::string &name)
  {
    const bool varies =
        std::any_of(variables.begin(), variables.end(), [&](const Variable &one) { return one.name == name; });
    return varies ? std::nullopt : look_up(name);
  };
  const Expression e = parse_expression(text, variables, others, names);
  return {1., e.dimension, e.checked, e.counts};
}

std::string unit_of(const Quantity &quantity)
{
  static const std::vector<std::pair<Kind, std::string>> names = {{kind::force, "N"},
                                                                  {kind::torque, "N m"},
                                                                  {kind::stiffness, "N/m"},
                                                                  {kind::damping, "N s/m"},
                                                                  {kind::pressure, "Pa"}};
  if (!quantity.checked || equal(quantity.dimension, {}))
    return "";
  for (const auto &[kind, name] : names)
    if (equal(kind.dimension, quantity.dimension))
      return name;
  return describe(quantity.dimension);
}

} // namespace

/// What is known while the outputs of a run are computed.
struct OutputFormulas::Known
{
  const Parameters               &parameters;
  const Eigen::VectorXd          &levels;
  std::vector<AnswerValue>        entries;
  bool                            units_alone = false;
  std::map<std::size_t, Quantity> outputs{};
  std::vector<std::size_t>        open{};
};

OutputFormulas::OutputFormulas(const StudyFile &study, const Scene &scene, const Parameters &parameters)
    : variables_(study.variables), outputs_(study.outputs)
{
  for (const OutputRequest &output : outputs_)
    formulas_.push_back(formula_of(output));
  for (const Entry &entry : entries_)
    try
    {
      answer_entry::check(entry.segments, scene);
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(entry.place + ": " + error.what());
    }
  for (const Entry &entry : entries_)
    if (entry.segments.front() == "signals" &&
        std::find(signals_.begin(), signals_.end(), entry.segments[1]) == signals_.end())
      signals_.push_back(entry.segments[1]);
  check_names(parameters);
}

/// Every name in a formula is known; its value waits for a run.
void OutputFormulas::check_names(const Parameters &parameters) const
{
  std::vector<std::string> names = all_names(parameters);
  for (const Entry &entry : entries_)
    names.push_back(entry.name);
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    const std::string place = outputs_[i].place.text() + ": outputs." + outputs_[i].name + ": ";
    try
    {
      for (const Token &token : tokens_of(formulas_[i].text))
        if (token.kind == Token::name && !is_reserved_name(token.text) && !is_unit(token.text) &&
            std::find(names.begin(), names.end(), token.text) == names.end())
          throw std::invalid_argument("there is no '" + token.text + "'" + character(token.place) +
                                      " among outputs, variables and "
                                      "parameters" +
                                      suggestion(token.text, all_names(parameters)) + "; entries of a run begin with " +
                                      listed(answer_entry::tables()));
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(place + with_entries(error.what()));
    }
  }
}

/// A message with the entries as the study writes them.
std::string OutputFormulas::with_entries(std::string text) const
{
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) // ..._12 before ..._1
    for (std::size_t at; (at = text.find(entry->name)) != std::string::npos;)
    {
      std::string path;
      for (const std::string &segment : entry->segments)
        path += (path.empty() ? "" : ".") + written_key(segment);
      text.replace(at, entry->name.size(), path);
    }
  return text;
}

std::vector<std::string> OutputFormulas::all_names(const Parameters &parameters) const
{
  std::vector<std::string> names = parameters.names();
  for (const OutputRequest &other : outputs_)
    names.push_back(other.name);
  for (const VariableRequest &request : variables_)
    if (request.variable.words.empty())
      names.push_back(request.variable.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool OutputFormulas::reads(const std::string &table) const
{
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry &entry) { return entry.segments.front() == table; });
}

int OutputFormulas::entry_of(const std::vector<std::string> &segments, const OutputRequest &output)
{
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry &entry) { return entry.segments == segments; });
  if (found != entries_.end())
    return int(found - entries_.begin());
  entries_.push_back({"answer_entry_" + std::to_string(entries_.size() + 1), segments,
                      output.place.text() + ": outputs." + output.name});
  return int(entries_.size()) - 1;
}

OutputFormulas::Formula OutputFormulas::formula_of(const OutputRequest &output)
{
  const std::string &text = output.formula;
  Formula            formula;
  for (std::size_t at = 0; at < text.size();)
  {
    if (table_at(text, at).empty())
    {
      formula.text += text[at++];
      continue;
    }
    const std::size_t end   = entry_end(text, at);
    const int         entry = entry_of(key_segments(text.substr(at, end - at), output.place), output);
    if (at == 0 && end == text.size())
      formula.single = entry;
    formula.text += entries_[std::size_t(entry)].name;
    at = end;
  }
  return formula;
}

Quantity OutputFormulas::quantity_of(std::size_t output, Known &known) const
{
  if (const auto found = known.outputs.find(output); found != known.outputs.end())
    return found->second;
  if (std::find(known.open.begin(), known.open.end(), output) != known.open.end())
    throw std::invalid_argument("depends on itself");
  known.open.push_back(output);
  const std::vector<std::string> names   = all_names(known.parameters);
  const auto                     look_up = [&](const std::string &name) -> std::optional<Quantity>
  {
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (entries_[i].name == name)
        return quantity_in_unit(known.entries[i].value, known.entries[i].unit);
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      if (outputs_[i].name == name)
        return quantity_of(i, known);
    for (std::size_t i = 0; i < variables_.size(); ++i)
      if (variables_[i].variable.name == name && variables_[i].variable.words.empty())
        return quantity_in_unit(known.levels[Eigen::Index(i)], variables_[i].variable.unit);
    return known.parameters.find(name);
  };
  const Quantity quantity = known.units_alone ? unit_alone(formulas_[output].text, look_up, names)
                                              : parse_quantity(formulas_[output].text, look_up, names);
  known.open.pop_back();
  return known.outputs[output] = quantity;
}

std::vector<AnswerValue> OutputFormulas::of(const Result &result, const Parameters &parameters,
                                            const Eigen::VectorXd &levels) const
{
  return values_of(entries_of(result), parameters, levels);
}

std::vector<std::vector<std::string>> OutputFormulas::paths() const
{
  std::vector<std::vector<std::string>> paths;
  for (const Entry &entry : entries_)
    paths.push_back(entry.segments);
  return paths;
}

std::vector<AnswerValue> OutputFormulas::entries_of(const Result &result) const
{
  std::vector<AnswerValue> entries;
  for (const Entry &entry : entries_)
    try
    {
      entries.push_back(answer_entry::value(entry.segments, result));
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(entry.place + ": " + error.what());
    }
  return entries;
}

std::vector<AnswerValue> OutputFormulas::values_of(const std::vector<AnswerValue> &entries,
                                                   const Parameters &parameters, const Eigen::VectorXd &levels) const
{
  return values_of(Known{parameters, levels, entries});
}

void OutputFormulas::check_units(const std::vector<AnswerValue> &entries, const Parameters &parameters,
                                 const Eigen::VectorXd &levels) const
{
  values_of(Known{parameters, levels, entries, true});
}

std::vector<AnswerValue> OutputFormulas::values_of(Known known) const
{
  std::vector<AnswerValue> values;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    try
    {
      if (formulas_[i].single >= 0)
      {
        values.push_back(known.entries[std::size_t(formulas_[i].single)]);
        continue;
      }
      known.open.clear();
      const Quantity quantity = quantity_of(i, known);
      values.push_back({quantity.value, unit_of(quantity)});
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(outputs_[i].place.text() + ": outputs." + outputs_[i].name + ": " +
                                  with_entries(error.what()));
    }
  return values;
}

} // namespace gestell::apps
