#pragma once

#include "apps/analysis/analysis.h"
#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_schema.h"
#include "apps/output/report/section.h"
#include "apps/output/values/result.h"

namespace gestell::apps
{

/// Default for a value without such a function.
template <class Value>
std::string subject_of(const Value &)
{
  return "";
}
template <class Value>
Headline headline_of(const Value &)
{
  return {};
}
template <class Value>
std::vector<NamedArray> arrays_of(const Value &)
{
  return {};
}

/**
 * An answer defined by functions next to its value: describe_answer(visitor, value), sections_of(result, value), and
 * optionally subject_of(value), headline_of(value), arrays_of(value), see Answer.  Include this header in .cc files
 * only, as Json.
 */
template <class Value>
class DescribedAnswer final : public AnswerWith<Value>
{
public:
  using AnswerWith<Value>::AnswerWith;

  void                    describe(JsonMembers &v) const override { describe_answer(v, this->value); }
  void                    describe(SchemaMembers &v) const override { describe_answer(v, this->value); }
  std::vector<Section>    sections(const Result &result) const override { return sections_of(result, this->value); }
  std::string             subject() const override { return subject_of(this->value); }
  Headline                headline() const override { return headline_of(this->value); }
  std::vector<NamedArray> arrays() const override { return arrays_of(this->value); }
};

template <class Value>
std::shared_ptr<const Answer> as_answer(Value found)
{
  return std::make_shared<DescribedAnswer<Value>>(std::move(found));
}

/// The content of a file of an answer; "" without the answer.
template <class Value, auto content>
std::string content_of(const Result &result)
{
  const Value *found = answer_in<Value>(result.answers);
  return found ? std::string(content(*found)) : "";
}

/// @tparam Own    an Analysis
/// @tparam Value  of its answer
template <class Own, class Value>
AnalysisEntry analysis_entry(const std::string &name, const std::string &does, const std::vector<std::string> &examples,
                             const std::vector<ResultFile> &files, const std::string &of = "")
{
  return {name,
          does,
          examples,
          files,
          [] { return std::make_unique<Own>(); },
          [] { return as_answer(Value()); },
          of,
          of == "run" ? "integration" : ""};
}

} // namespace gestell::apps
