#include "apps/output/pictures/skin_picture.h"
#include "apps/output/report/report.h"
#include "apps/output/report/stress_report.h"
#include "apps/output/tables/summary_json.h"
#include "tests/support/output_example.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gestell::apps;

namespace
{

bool holds(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

const std::string *chart(const Report &report, const std::string &name)
{
  for (const auto &[known, svg] : report.charts)
    if (known == name)
      return &svg;
  return nullptr;
}

TEST(StressOutput, StandsInTheSummaryOnlyWhereItWasAskedFor)
{
  const Result result = with_stress(example_result());
  const auto   json   = summary_json(result);
  EXPECT_TRUE(holds(json, "\"label\": \"largest F_P\""));
  EXPECT_TRUE(holds(json, "\"beside\": \"support feet\""));
  EXPECT_FALSE(holds(summary_json(example_result()), "\"stress\""));
  EXPECT_FALSE(holds(make_report(example_result()).html, "id=\"stress\""));
}

TEST(StressOutput, TellsBothPlacesAndTheDoubtInTheReport)
{
  const Report report = make_report(with_stress(example_result()));
  EXPECT_TRUE(holds(report.html, "<section id=\"stress\""));
  EXPECT_TRUE(holds(report.html, "href=\"#stress\""));
  EXPECT_TRUE(holds(report.html, "beside support feet"));
  EXPECT_TRUE(holds(report.html, "largest F_P"));
  EXPECT_TRUE(holds(report.html, "<th class=\"n\">elements disagree"));
  EXPECT_TRUE(holds(report.html, "too coarse")) << "the disagreement is above 10 %";
  const std::string *svg = chart(report, "stress-1");
  ASSERT_NE(svg, nullptr);
  EXPECT_TRUE(holds(*svg, "<circle class=\"mark\"")) << "the peak is ringed";
  EXPECT_TRUE(holds(*svg, ">80<")) << "the bar ends at the largest value away from rigid surfaces [MPa]";
}

} // namespace
