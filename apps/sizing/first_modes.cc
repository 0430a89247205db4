#include "apps/sizing/first_modes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

namespace
{

/// Columns of p, then three of an acceleration field, to which the static part of the modes after column n is added.
void keep_columns(Eigen::MatrixXf &rows, Eigen::Index n, const Eigen::MatrixXd &statics)
{
  const Eigen::Index left = statics.rows();
  Eigen::MatrixXf    kept(rows.rows(), n + 3);
  kept << rows.leftCols(n), rows.rightCols(3) + rows.middleCols(n, left) * statics.cast<float>();
  rows = std::move(kept);
}

/// Whether (7a) of docs/theory/reduction.md balances the forces: only then all of them have a row on accelerations.
bool is_balanced(const std::vector<fem::FrameOutput> &outputs)
{
  return std::none_of(outputs.begin(), outputs.end(),
                      [](const fem::FrameOutput &output) { return output.unit != "Pa" && output.on_a.size() == 0; });
}

/// The modes after coordinate n answer inertia and damping statically: (7a) for the first n coordinates.
void balance_without(fem::FrameOutput &output, const coupling::ReducedFrame &frame, Eigen::Index n)
{
  const Eigen::Index    left = frame.M.rows() - n;
  const Eigen::VectorXd s    = output.on_q.tail(left).cwiseQuotient(frame.omega0.tail(left).cwiseAbs2());
  output.on_a.head(n) -= frame.M.topRightCorner(n, left) * s;
  output.on_v.head(n) -= frame.B.topRightCorner(n, left) * s; // B with ratios, whose forces act on masses
}

} // namespace

coupling::ReducedFrame with_first_modes(coupling::ReducedFrame frame, int n_modes)
{
  const Eigen::Index all = frame.M.rows(), n = frame.n_interface + n_modes, left = all - n;
  if (left < 0 || !frame.modal || frame.omega0.size() != all - frame.n_interface)
    throw std::invalid_argument("a frame of " + std::to_string(frame.omega0.size()) + " modes has no first " +
                                std::to_string(n_modes));
  // [left x 3] deflection of the truncated modes under a unit field
  const Eigen::MatrixXd statics =
      frame.omega0.tail(left).cwiseAbs2().cwiseInverse().asDiagonal() * frame.translations_load.bottomRows(left);
  if (is_balanced(frame.outputs))
    for (fem::FrameOutput &output : frame.outputs)
      if (output.on_a.size() > 0)
        balance_without(output, frame, n);
  for (Eigen::MatrixXd *A : {&frame.M, &frame.B, &frame.C})
    *A = A->topLeftCorner(n, n).eval();
  frame.translations_load = frame.translations_load.topRows(n).eval();
  for (fem::FrameOutput &output : frame.outputs)
  {
    output.under_acceleration += statics.transpose() * output.on_q.tail(left);
    for (Eigen::VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = row->head(n).eval();
  }
  if (frame.displacement.cols() > 0)
    frame.displacement = frame.displacement.leftCols(n).eval();
  if (!frame.stress.empty())
    for (Eigen::MatrixXf *rows : {&frame.stress.mean, &frame.stress.deviation})
      keep_columns(*rows, n, statics);
  frame.omega0        = frame.omega0.head(n_modes).eval();
  frame.n_fixed_modes = n_modes;
  for (Eigen::VectorXd *known : {&frame.frequencies_hz, &frame.frequency_error})
    *known = known->head(std::min(n, known->size())).eval();
  frame.left_out.resize(0, 0);
  return frame;
}

} // namespace gestell::apps
