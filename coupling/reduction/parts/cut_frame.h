#pragma once

#include "coupling/reduction/parts/condensed_part.h"
#include "coupling/reduction/parts/part_interface.h"
#include "coupling/reduction/parts/parts_call.h"
#include "fem/process/side_by_side.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

/// A cut frame and the parts of its matrices. Refers to its arguments.
class CutFrame
{
public:
  /// @param frame  M, B, C without the sums over cells.
  CutFrame(const fem::FrameMatrices &frame, const fem::CellParts &parts, const PartsCall &call);

  int                  size() const { return parts_.size(); }
  std::vector<int>     coordinates(int p) const { return parts_.coordinates(p); }
  const PartInterface &interface() const { return interface_; }
  std::string          name(int p) const { return "part " + std::to_string(p + 1) + " of " + std::to_string(size()); }
  PartOfFrame          part(int p) const;
  /// Positions in force_outputs() of those with an entry within a part.
  std::vector<std::size_t> forces(int p) const;

private:
  fem::PartMatrices sums(int p) const;

  const fem::FrameMatrices   &frame_;
  const fem::CellParts       &parts_;
  const PartsCall            &call_;
  PartInterface               interface_;
  Eigen::SparseMatrix<double> damping_; // beside alpha M + beta C
  std::vector<std::size_t>    forces_;  // among the outputs of the frame
};

/// Calls work(p) for every part in a process of its own, whose memory goes back to the system.
template <typename Value, typename Work, typename Take>
void for_each_part(const CutFrame &cut, const PartsCall &call, const std::string &phase, const Work &work,
                   const Take &take)
{
  std::mutex mutex;
  const int  at_once = fem::in_one_process() ? 1 : std::min(call.at_once, cut.size());
  fem::side_by_side(cut.size(), at_once, call.progress,
                    [&](int p, const Progress &progress)
                    {
                      fem::ChildTask task;
                      task.head                               = call.place;
                      task.phase                              = "start";
                      task.alone                              = !fem::in_one_process();
                      task.library                            = "the reduction";
                      task.way_out                            = "use more parts, or a larger mesh.size";
                      Value                             value = fem::in_child<Value>(task, progress,
                                                         [&](const Progress &report)
                                                         {
                                                           if (report)
                                                             report(phase + cut.name(p), -1.);
                                                           return work(p);
                                                         });
                      const std::lock_guard<std::mutex> alone(mutex);
                      take(p, std::move(value));
                    });
}

} // namespace gestell::coupling
