#pragma once

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

/// Numbers too many for summary.json, which Python gets as an array.
struct NamedArray
{
  std::vector<std::string>          name; ///< a word, or the words of a tuple
  std::vector<std::complex<double>> values;
  bool                              real = false;
};

/// What an analysis found, as a result carries it: the writers of results know nothing else of it.
class Answer
{
public:
  virtual ~Answer() = default;

  /// Members of summary.json and its schema: describe_answer(visitor, value).
  virtual void describe(JsonMembers &v) const   = 0;
  virtual void describe(SchemaMembers &v) const = 0;

  /// What is read of it, on the page of the report and in a terminal.
  virtual std::vector<Section> sections(const Result &result) const = 0;
  /// "Frequency responses", which the first sentence of a report says were computed; empty: of a run.
  virtual std::string             subject() const { return ""; }
  virtual std::vector<NamedArray> arrays() const { return {}; }
};

using Answers = std::vector<std::shared_ptr<const Answer>>;

/// The value of an answer.
template <class Value>
class AnswerWith : public Answer
{
public:
  explicit AnswerWith(Value found) : value(std::move(found)) {}

  const Value value;
};

/// Null: there is no answer of this kind.
template <class Value>
const Value *answer_in(const Answers &answers)
{
  for (const auto &answer : answers)
    if (const auto *found = dynamic_cast<const AnswerWith<Value> *>(answer.get()))
      return &found->value;
  return nullptr;
}

} // namespace gestell::apps
