#include "apps/output/tables/summary_json.h"

#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_schema.h"
#include "apps/output/values/result_description.h"

namespace gestell::apps
{

std::string summary_json(const Result &result)
{
  return json_text(described_json(result));
}

std::vector<MemberLine> summary_members(const Result &all)
{
  std::vector<MemberLine> lines;
  MemberList              members{lines};
  describe(members, all);
  return lines;
}

std::string summary_schema(const Result &all)
{
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "summary.json of gestell"}};
  schema.update(object_schema(all));
  return json_text(schema);
}

} // namespace gestell::apps
