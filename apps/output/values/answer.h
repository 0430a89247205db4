#pragma once

#include "apps/output/text/html.h"

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace gestell::apps
{

struct JsonMembers;
struct SchemaMembers;
struct Result;
struct Section;

/// An array too large for summary.json, which Python gets as an array.
struct NamedArray
{
  std::vector<std::string>          name; ///< a word, or the elements of a tuple
  std::vector<std::complex<double>> values;
  bool                              real = false;
};

/// Result of an analysis, as a Result stores it: the writers of results know only this interface.
class Answer
{
public:
  virtual ~Answer() = default;

  /// Members of summary.json and its schema: describe_answer(visitor, value).
  virtual void describe(JsonMembers &v) const   = 0;
  virtual void describe(SchemaMembers &v) const = 0;

  /// Sections for people, on the page of the report and in a terminal.
  virtual std::vector<Section> sections(const Result &result) const = 0;
  /// "Frequency responses": subject of the report's first sentence, "... were computed"; empty: the subject is the run.
  virtual std::string subject() const { return ""; }
  /// What the report begins with; empty: the subject, or the run.
  virtual Headline                headline() const { return {}; }
  virtual std::vector<NamedArray> arrays() const { return {}; }
};

using Answers = std::vector<std::shared_ptr<const Answer>>;

/// An answer with a value.
template <class Value>
class AnswerWith : public Answer
{
public:
  explicit AnswerWith(Value found) : value(std::move(found)) {}

  const Value value;
};

/// The answer of this type; null if there is none.
template <class Value>
const Value *answer_in(const Answers &answers)
{
  for (const auto &answer : answers)
    if (const auto *found = dynamic_cast<const AnswerWith<Value> *>(answer.get()))
      return &found->value;
  return nullptr;
}

} // namespace gestell::apps
