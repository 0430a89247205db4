#pragma once

#include "apps/output/charts/chart_axis.h"
#include "apps/study/values/study_table.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{

/// A variable or an output as pictures show it: its values times `factor` in `unit`.
struct ShownAxis
{
  std::string name{};
  double      factor = 1.;
  std::string unit{};

  std::string head() const { return unit.empty() ? name : name + " [" + unit + "]"; }
  double      shown(double value) const { return factor * value; }
  std::string text(double value, int digits = 4) const { return short_text(factor * value, digits); }
  std::string text_with_unit(double value) const { return unit.empty() ? text(value) : text(value) + " " + unit; }
};

ShownAxis shown_axis(const std::string &name, const std::string &unit, double magnitude);
ShownAxis shown_axis(const StudyVariable &variable);
ShownAxis shown_axis(const StudyOutput &output, double magnitude);

/// The largest size of finite values.
double magnitude_of(const Eigen::VectorXd &values);

/// A linear axis from one physical value to another, in the unit of the reader.
ChartAxis chart_axis(const ShownAxis &axis, double from, double to);

} // namespace gestell::apps
