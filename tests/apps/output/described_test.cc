// Members of results are listed once: JSON, its schema and the reference agree.

#include "apps/analysis/analyses.h"
#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_schema.h"
#include "apps/output/describe/described_table.h"
#include "apps/output/tables/summary_json.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

namespace gestell::apps
{
namespace
{

struct Inner
{
  double value = 2.5;
};

template <class Visitor>
void describe(Visitor &v, const Inner &x)
{
  v("value_hz", x.value, "Hz", "a frequency");
}

struct Outer
{
  int                                         number = 3;
  bool                                        flag   = true;
  std::string                                 text   = "a, b";
  std::optional<Inner>                        inner{};
  std::vector<Inner>                          list{{1.}, {std::numeric_limits<double>::quiet_NaN()}};
  std::vector<std::pair<std::string, double>> named{{"x", 1.}, {"y", 2.}};
};

template <class Visitor>
void describe(Visitor &v, const Outer &x)
{
  v("number", x.number, "", "a number");
  v("flag", x.flag, "", "a truth");
  v("text", x.text, "", "a text");
  v("inner", x.inner, "", "null: none");
  v("list", x.list, "", "values");
  v("named", x.named, "m", "by name");
  v.maybe(x.number > 3, "more", 1., "s", "above three");
}

TEST(Described, JsonHasEveryMemberNullWhereThereIsNothing)
{
  Outer outer;
  Json  json = Json::parse(json_text(described_json(outer)));
  EXPECT_EQ(json.dump(),
            R"({"number":3,"flag":true,"text":"a, b","inner":null,"list":[{"value_hz":1.0},{"value_hz":null}],)"
            R"("named":{"x":1.0,"y":2.0}})");
  outer.number = 4;
  outer.inner  = Inner();
  json         = described_json(outer);
  EXPECT_EQ(json["more"], 1.);
  EXPECT_EQ(json["inner"]["value_hz"], 2.5);
}

TEST(Described, TablesHaveAColumnForEachValue)
{
  Outer with, without;
  with.inner                 = Inner();
  with.number                = 4;
  const DescribedTable table = table_of(std::vector<Outer>{without, with});
  EXPECT_EQ(std::string(table.csv()), "number,flag,text,inner value [Hz],named x [m],named y [m],more [s]\n"
                                      "3,1,\"a, b\",,1,2,\n"
                                      "4,1,\"a, b\",2.5,1,2,1\n");
  EXPECT_NE(table.html().find("inner value [Hz]"), std::string::npos);
}

// A growth of 1.000067 per step would be 1 in five digits.
TEST(Described, NumbersNearOneAreReadByTheirDistanceFromOne)
{
  const std::string text = table_of(std::vector<Inner>{{1.0000672}, {2.1234567}}).terminal();
  EXPECT_EQ(text, "  value [Hz]\n   1.0000672\n      2.1235\n");
}

TEST(Described, ReferenceListsWhatIsInside)
{
  const Json schema = object_schema(Outer());
  EXPECT_EQ(member_rows(schema), "| `number` | integer |  | a number |\n"
                                 "| `flag` | boolean |  | a truth |\n"
                                 "| `text` | string |  | a text |\n"
                                 "| `inner` | object or null |  | null: none |\n"
                                 "| `inner.value_hz` | number | Hz | a frequency |\n"
                                 "| `list` | array of objects |  | values |\n"
                                 "| `list[].value_hz` | number | Hz | a frequency |\n"
                                 "| `named` | object | m | by name |\n"
                                 "| `more` | number, if any | s | above three |\n");
  EXPECT_EQ(published(schema).dump().find('~'), std::string::npos);
}

/// Whether a document has the members and types of a schema; else where it does not.
std::string departure(const Json &schema, const Json &value, const std::string &at)
{
  const Json &types = schema["type"];
  const auto  is    = [&](const std::string &type)
  {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "integer" ? value.is_number_integer()
           : type == "number"  ? value.is_number()
                               : value.is_null();
  };
  bool fits = types.is_string() && is(types);
  if (types.is_array())
    for (const Json &type : types)
      fits = fits || is(type);
  if (!fits)
    return at + " is no " + types.dump();
  if (value.is_object() && schema.contains("properties"))
  {
    for (const Json &name : schema["required"])
      if (!value.contains(name.get<std::string>()))
        return at + " lacks " + name.dump();
    for (const auto &[name, own] : value.items())
    {
      if (!schema["properties"].contains(name))
        return at + " has " + name + ", which the schema does not know";
      if (const std::string wrong = departure(schema["properties"][name], own, at + '.' + name); !wrong.empty())
        return wrong;
    }
  }
  if (value.is_object() && schema.contains("additionalProperties"))
    for (const auto &[name, own] : value.items())
      if (const std::string wrong = departure(schema["additionalProperties"], own, at + '.' + name); !wrong.empty())
        return wrong;
  if (value.is_array())
    for (const Json &own : value)
      if (const std::string wrong = departure(schema["items"], own, at + "[]"); !wrong.empty())
        return wrong;
  return "";
}

TEST(SummaryJson, FitsItsSchema)
{
  const Json schema = Json::parse(summary_schema(result_of_all_kinds()));
  EXPECT_EQ(departure(schema, Json::parse(summary_json(Result())), "summary"), "");
  EXPECT_EQ(departure(schema, Json::parse(summary_json(example_result())), "summary"), "");
  Json wrong        = Json::parse(summary_json(Result()));
  wrong["warnings"] = 1;
  EXPECT_EQ(departure(schema, wrong, "summary"), "summary.warnings is no \"array\"");
}

/// The first number with a decimal fraction that neither `units` nor a member `unit` beside it or above it gives a
/// unit.
std::string without_unit(const Json &schema, const Json &value, const Json &units, const std::string &at, bool known)
{
  known = known || units.contains(at) || (value.is_object() && value.contains("unit"));
  if (value.is_number_float())
    return known ? "" : at;
  for (const auto &[name, own] : value.items())
    if (own.is_structured() || own.is_number_float())
    {
      const bool        member = schema.contains("properties"), item = schema.contains("items");
      const Json       &inner = member ? schema["properties"][name] : schema[item ? "items" : "additionalProperties"];
      const std::string path  = at + (member ? (at.empty() ? "" : ".") + name : item ? "[]" : ".NAME");
      if (const std::string found = without_unit(inner, own, units, path, known); !found.empty())
        return found;
    }
  return "";
}

TEST(SummaryJson, HasTheUnitOfEveryNumber)
{
  const Json schema = Json::parse(summary_schema(result_of_all_kinds()));
  for (const Result &result : {Result(), example_result(), with_stress(example_result())})
  {
    const Json json = Json::parse(summary_json(result));
    EXPECT_EQ(without_unit(schema, json, json["units"], "", false), "");
  }
  const Json json = Json::parse(summary_json(with_stress(example_result()))), units = json["units"];
  EXPECT_EQ(units["signals.NAME.t_max"], "s");
  EXPECT_EQ(units["energy.residual"], "J");
  EXPECT_EQ(units["frequencies_hz"], "Hz");
  EXPECT_EQ(units["stress.instants[].largest.von_mises"], "Pa");
  EXPECT_FALSE(units.contains("periodic.solutions[].period")) << "of what this result does not have";
  EXPECT_EQ(json["signals"]["F_P"]["unit"], "N");
}

TEST(SummaryJson, EveryMemberHasAMeaning)
{
  EXPECT_EQ(summary_members(result_of_all_kinds()).find("|  |\n"), std::string::npos);
}

} // namespace
} // namespace gestell::apps
