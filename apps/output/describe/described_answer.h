#pragma once

#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_schema.h"
#include "apps/output/describe/member_list.h"
#include "apps/output/values/answer.h"

namespace gestell::apps
{

/// An answer by describe_answer(visitor, value), which lists its members of summary.json; for sources alone, as Json
/// is.
template <class Value>
class DescribedAnswer : public AnswerWith<Value>
{
public:
  using AnswerWith<Value>::AnswerWith;

  void describe(JsonMembers &v) const override { describe_answer(v, this->value); }
  void describe(SchemaMembers &v) const override { describe_answer(v, this->value); }
  void describe(MemberList &v) const override { describe_answer(v, this->value); }
};

} // namespace gestell::apps
