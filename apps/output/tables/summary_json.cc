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

std::string summary_members(const Result &all)
{
  return member_rows(object_schema(all));
}

std::string summary_schema(const Result &all)
{
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "summary.json of gestell"}};
  schema.update(object_schema(all));
  return json_text(published(schema));
}

} // namespace gestell::apps
