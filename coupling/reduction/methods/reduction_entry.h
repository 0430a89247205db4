#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace gestell::fem
{
struct FrameMatrices;
}

namespace gestell::coupling
{

struct InterfaceStatics;
struct ReductionOptions;
struct ReductionSpace;

/// A reduction method with its name in scenes.
struct ReductionEntry
{
  enum class Makes
  {
    reduced_frame,
    no_frame,        ///< the machine uses the full one
    modes_of_machine ///< the machine with the full frame is represented by its modes
  };

  std::string              name;  ///< reduction.method = "guyan"
  std::string              title; ///< one clause
  std::vector<std::string> keys;  ///< of [reduction], in addition to `method`
  Makes                    makes = Makes::reduced_frame;

  bool takes(const std::string &key) const { return std::find(keys.begin(), keys.end(), key) != keys.end(); }
};

/// Computes T with its known structure.  Statics are consumed: their basis moves to the space, their factor is freed.
using BasisFunction = ReductionSpace(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                     InterfaceStatics &statics);

} // namespace gestell::coupling
