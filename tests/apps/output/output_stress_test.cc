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
  EXPECT_TRUE(holds(report.html, "data-show=\"stress-1\"")) << "a picture of the instant";
  EXPECT_TRUE(holds(report.html, "\"mark\":7")) << "the peak, at the last corner, is ringed";
  EXPECT_TRUE(holds(report.html, "stress 0 to 80 MPa")) << "colours end at the largest value away from rigid surfaces";
}

} // namespace
