#pragma once

#include "apps/output/values/along_result.h"
#include "apps/output/values/periodic_result.h"
#include "apps/output/values/result.h"

#include <pybind11/pybind11.h>

namespace gestell::python
{

/// Results other than runs, as dicts of arrays, strings and numbers in SI, or as JSON; gestell.py defines their names.
pybind11::dict periodic_values(const apps::PeriodicResult &found);
pybind11::dict along_values(const apps::AlongResult &along);
std::string    size_values(const apps::SizeResult &found);

} // namespace gestell::python
