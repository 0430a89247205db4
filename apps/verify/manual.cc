#include "apps/verify/manual.h"

#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>

namespace gestell::apps
{
namespace
{

using EachCheck = std::function<void(const CaseFile &file, const ReferenceCase &one, const Check &check,
                                     const CheckOutcome &outcome)>;

void for_each_check(const Verification &all, const EachCheck &take)
{
  for (const VerifiedFile &file : all.files)
    for (std::size_t i = 0; i < file.file.cases.size(); ++i)
      for (std::size_t j = 0; j < file.file.cases[i].checks.size(); ++j)
        take(file.file, file.file.cases[i], file.file.cases[i].checks[j], file.outcomes[i].checks[j]);
}

std::string file_name(const std::string &path)
{
  return std::filesystem::path(path).filename().string();
}

/// The compared value, "signals.F.max" or "history.csv: x, v".
std::string compared(const Check &check)
{
  if (!check.value.empty())
    return check.value + (check.plus.empty() ? "" : " + " + check.plus);
  std::string text;
  for (const auto &[own, other] : check.columns)
    text += (text.empty() ? check.table + ": " : ", ") + own;
  return text;
}

std::string expected_in(const Check &check)
{
  return check.expected.formula.empty() ? file_name(check.expected.table.file) : check.expected.formula;
}

std::string data_of(const ReferenceCase &one)
{
  std::string text = one.scene.empty() ? "the integrators alone" : file_name(one.scene);
  for (const std::string &entry : one.set)
    text += ", " + entry;
  if (one.compute != "run" && !one.scene.empty())
    text += "; " + one.compute;
  for (const auto &[key, value] : one.requested)
    text += ", " + key + " " + value;
  if (!one.refined.empty())
  {
    text += "; " + one.refined;
    for (const std::string &value : one.refinements)
      text += (value == one.refinements.front() ? " = " : ", ") + value;
  }
  return text;
}

/// Source and tolerance of an expected value.
std::string provenance(const Check &check)
{
  std::string text = check.source;
  if (check.bound != Bound::none)
    text += std::string(", ") + (check.bound == Bound::least ? "a lower" : "an upper") + " bound";
  return text + "; allowed: " + check.because;
}

/// The formula or file of an expected value; "" for a plain number, which the table shows.
std::string formula_of(const Check &check)
{
  const std::string text = expected_in(check);
  char             *end  = nullptr;
  std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size() ? "" : text;
}

/// Compared values with one formula.
struct ExpectedNames
{
  std::string formula, names;
};

void add_name(std::vector<ExpectedNames> &expected, const Check &check)
{
  const std::string formula = formula_of(check), name = compared(check);
  const auto        same = std::find_if(expected.begin(), expected.end(),
                                        [&](const ExpectedNames &other) { return other.formula == formula; });
  if (same == expected.end())
    expected.push_back({formula, name});
  else if (same->names.find(name) == std::string::npos)
    same->names += ", " + name;
}

/// One note for all checks with the same source and tolerance.
std::vector<std::string> notes_of(const ReferenceCase &one)
{
  std::vector<std::pair<std::string, std::vector<ExpectedNames>>> notes; ///< by provenance
  for (const Check &check : one.checks)
  {
    const std::string from = provenance(check);
    auto same = std::find_if(notes.begin(), notes.end(), [&](const auto &note) { return note.first == from; });
    if (same == notes.end())
      same = notes.insert(notes.end(), {from, {}});
    add_name(same->second, check);
  }
  std::vector<std::string> lines;
  for (const auto &[from, expected] : notes)
  {
    std::string line;
    if (notes.size() > 1 || expected.size() > 1 || !expected[0].formula.empty()) // else the table has the names
      for (const ExpectedNames &each : expected)
        line += (line.empty() ? "" : "; ") + each.names + (each.formula.empty() ? "" : " by " + each.formula);
    lines.push_back(line + (line.empty() ? "" : ": ") + from + ".");
  }
  for (const auto &[method, why] : one.methods_left_out)
    lines.push_back("Not in the table: " + method + ", " + why + ".");
  return lines;
}

std::string name_with_count(const Check &check, const CheckOutcome &outcome)
{
  std::string text = check.name;
  if (check.order > 0.)
    text += ", order of the error";
  else if (outcome.n_numbers > 1)
    text += ", " + std::to_string(outcome.n_numbers) + " numbers";
  if (outcome.n_words > 0)
    text += ", " + count_text(static_cast<std::size_t>(outcome.n_words), "word");
  if (outcome.n_left > 0)
    text += " (" + std::to_string(outcome.n_left) + " expected without a value)";
  return text;
}

std::string verdict(const CheckOutcome &outcome)
{
  return outcome.passed ? "passed" : outcome.failure.empty() ? "failed" : "failed: " + outcome.failure;
}

std::string case_section(const ReferenceCase &one, const CaseOutcome &outcome)
{
  HtmlTable   table({"compared", "#expected", "#obtained", "#error", "#allowed", "verdict"});
  std::string notes;
  for (std::size_t j = 0; j < one.checks.size(); ++j)
  {
    const Check        &check = one.checks[j];
    const CheckOutcome &out   = outcome.checks[j];
    table.add({name_with_count(check, out), out.expected, out.obtained, short_text(out.error, 3),
               short_text(out.allowed, 3), peak(verdict(out), !out.passed)});
  }
  for (const std::string &note : notes_of(one))
    notes += "<li>" + escape_xml(note) + "</li>\n";
  return "<h3>" + escape_xml(one.name) + "</h3>\n<p>" + escape_xml(one.states) +
         (one.equation.empty() ? "" : " <span class=\"soft\">" + escape_xml(one.equation) + "</span>") +
         "</p>\n<p class=\"soft\">" + escape_xml(data_of(one)) + "; " + short_text(outcome.cpu_s, 2) + " s</p>\n" +
         table.html() + "<ul class=\"soft\">\n" + notes + "</ul>\n";
}

std::string summary_table(const Verification &all)
{
  HtmlTable table({"file", "#cases", "#checks", "#failed"});
  for (const VerifiedFile &file : all.files)
  {
    int checks = 0, failed = 0;
    for (const CaseOutcome &outcome : file.outcomes)
      for (const CheckOutcome &check : outcome.checks)
      {
        ++checks;
        failed += !check.passed;
      }
    table.add({file.file.title, std::to_string(file.file.cases.size()), std::to_string(checks),
               peak(std::to_string(failed), failed > 0)});
  }
  return table.html();
}

std::string left_out_page(const Verification &all)
{
  HtmlTable table({"file of reference values", "reason why no case uses it"});
  for (const VerifiedFile &file : all.files)
    for (const auto &[name, why] : file.file.left_out)
      table.add({name, why});
  return table.is_empty() ? "" : table.html();
}

/// A text in a cell of a table of Markdown.
std::string cell(std::string text)
{
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

/// One row: a line in each cell for each check.
std::string row_in_document(const ReferenceCase &one, const CaseOutcome &outcome)
{
  std::string names, expected, obtained, errors, allowed;
  for (std::size_t j = 0; j < one.checks.size(); ++j)
  {
    const CheckOutcome &out = outcome.checks[j];
    const std::string   end = j + 1 < one.checks.size() ? "<br>" : "";
    names += cell(name_with_count(one.checks[j], out)) + end;
    expected += out.expected + end;
    obtained += out.obtained + end;
    errors += short_text(out.error, 2) + end;
    allowed += short_text(out.allowed, 2) + (out.passed ? "" : " " + cell(verdict(out))) + end;
  }
  return "| " + cell(one.name) + " | " + names + " | " + expected + " | " + obtained + " | " + errors + " | " +
         allowed + " |\n";
}

/// One item for each case: statement, equation, scene, and the source of its expected values.
std::string item_in_document(const ReferenceCase &one)
{
  std::string text = "- **" + one.name + "**. " + one.states + (one.equation.empty() ? "" : " " + one.equation + ".") +
                     " `" + data_of(one) + "`.";
  for (const std::string &note : notes_of(one))
    text += " " + note;
  return text + "\n";
}

std::string file_in_document(const VerifiedFile &file)
{
  std::string rows, items;
  for (std::size_t i = 0; i < file.file.cases.size(); ++i)
  {
    rows += row_in_document(file.file.cases[i], file.outcomes[i]);
    items += item_in_document(file.file.cases[i]);
  }
  return "## " + file.file.title + "\n\n" + (file.file.lead.empty() ? "" : file.file.lead + "\n\n") +
         "| case | compared | expected | obtained | error | allowed |\n|---|---|--:|--:|--:|--:|\n" + rows + "\n" +
         items + "\n";
}

} // namespace

int Verification::n_cases() const
{
  int n = 0;
  for (const VerifiedFile &file : files)
    n += static_cast<int>(file.file.cases.size());
  return n;
}

int Verification::n_checks() const
{
  int n = 0;
  for_each_check(*this, [&](const auto &, const auto &, const auto &, const auto &) { ++n; });
  return n;
}

int Verification::n_failed() const
{
  int n = 0;
  for_each_check(*this,
                 [&](const auto &, const auto &, const auto &, const CheckOutcome &outcome) { n += !outcome.passed; });
  return n;
}

std::string verdict_text(const Verification &all)
{
  const int failed = all.n_failed();
  return count_text(static_cast<std::size_t>(all.n_cases()), "case") + ", " +
         count_text(static_cast<std::size_t>(all.n_checks()), "check") + ": " +
         (failed == 0 ? std::string("all passed") : std::to_string(failed) + " failed") +
         (all.n_skipped == 0 ? ""
                             : "; " + count_text(static_cast<std::size_t>(all.n_skipped), "long case") +
                                   " omitted; --all includes them");
}

std::string outcome_line(const Check &check, const CheckOutcome &outcome)
{
  if (!outcome.failure.empty())
    return check.name + ": failed: " + outcome.failure;
  return check.name + ": expected " + outcome.expected + ", obtained " + outcome.obtained + ", error " +
         short_text(outcome.error, 3) + " of " + short_text(outcome.allowed, 3) + " allowed" +
         (outcome.passed ? "" : ": failed");
}

std::string verification_page(const Verification &all)
{
  std::string body = summary_table(all);
  for (std::size_t k = 0; k < all.files.size(); ++k)
  {
    const VerifiedFile &file = all.files[k];
    std::string         text = "<p>" + escape_xml(file.file.lead) + "</p>\n";
    for (std::size_t i = 0; i < file.file.cases.size(); ++i)
      text += case_section(file.file.cases[i], file.outcomes[i]);
    body += section("file" + std::to_string(k + 1), file.file.title, text);
  }
  body += section("not-covered", "Not covered", left_out_page(all));
  return page_html({"Verification of Gestell", verdict_text(all), body,
                    "gestell " + all.version + (all.commit.empty() ? "" : " (" + all.commit + ")"), "", ""});
}

std::string verification_document(const Verification &all)
{
  std::string text =
      "# Verification\n\nReference cases shipped with the program, computed by `gestell verify --all`: " +
      verdict_text(all) +
      ".\nExpected values come from closed forms or from independent computations, never from Gestell. For a "
      "table,\nthe pair of numbers with the largest share of the tolerance is listed. The list after each table gives "
      "scene, formula and tolerance.\n"
      "This page is written by `gestell verify --all --renew docs`.\n\n";
  for (const VerifiedFile &file : all.files)
    text += file_in_document(file);
  std::string rows;
  for (const VerifiedFile &file : all.files)
    for (const auto &[name, why] : file.file.left_out)
      rows += "| `" + name + "` | " + cell(why) + " |\n";
  return rows.empty()
             ? text
             : text + "## Not covered\n\n| file of reference values | reason why no case uses it |\n|---|---|\n" + rows;
}

CsvTable verification_csv(const Verification &all)
{
  CsvTable csv({"file", "case", "check", "compared", "expected", "obtained", "error", "allowed", "numbers", "passed",
                "source", "failure"});
  for_each_check(all,
                 [&](const CaseFile &file, const ReferenceCase &one, const Check &check, const CheckOutcome &out)
                 {
                   csv.add(file_name(file.path), one.name, check.name, compared(check), out.expected, out.obtained,
                           out.error, out.allowed, out.n_numbers, out.passed ? "yes" : "no", check.source, out.failure);
                 });
  return csv;
}

} // namespace gestell::apps
