#include "apps/cli/export_frame.h"

#include "apps/output/folder/own_folder.h"
#include "apps/scene/file/written_text.h"
#include "coupling/exchange/dmig.h"
#include "coupling/frame/matrix_market.h"
#include "coupling/frame/petsc_binary.h"
#include "coupling/reduction/dense_frame.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

const char *const motion_names[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

/// Files of one export.
class Export
{
public:
  Export(const std::string &folder, MatrixFormat format, const std::string &remark)
      : folder_(folder), format_(format), remark_(remark)
  {
  }

  /// Writes a matrix; returns the name of its file.
  std::string matrix(const std::string &name, const Eigen::MatrixXd &A, bool symmetric)
  {
    const bool        petsc = format_ == MatrixFormat::petsc;
    const std::string file  = name + (petsc ? ".petsc" : ".mtx");
    const std::string place = claim(file);
    if (petsc)
      coupling::write_petsc_matrix(place, A);
    else if (symmetric)
      coupling::write_matrix_market(place, A.sparseView(0., 0.), coupling::Symmetry::symmetric, remark_);
    else
      coupling::write_matrix_market(place, A, remark_);
    return file;
  }

  /// Writes frame.pch.
  void cards(const std::map<std::string, Eigen::MatrixXd> &matrices, const std::vector<coupling::RowLabel> &rows,
             const coupling::NodePlaces &places, const std::string &remark)
  {
    coupling::write_dmig(claim("frame.pch"), matrices, rows, places, remark);
  }

  void text(const std::string &file, const std::string &content)
  {
    files_.push_back((folder_.path() / file).string());
    folder_.write(file, content);
  }

  void remove(const std::string &file) { folder_.remove(file); }

  const std::vector<std::string> &files() const { return files_; }

private:
  std::string claim(const std::string &file)
  {
    files_.push_back(folder_.claim(file).string());
    return files_.back();
  }

  OwnFolder                folder_;
  MatrixFormat             format_;
  std::string              remark_;
  std::vector<std::string> files_;
};

using Labels = std::vector<coupling::RowLabel>;

/// The first power of ten, 1000 at least, above the numbers of the interfaces.
long first_scalar_point(const coupling::ReducedFrame &frame)
{
  long first = 1000;
  while (first <= long(frame.interfaces.size()))
    first *= 10;
  return first + 1;
}

/// Label of every row on the Nastran cards.
Labels labels_of(const coupling::ReducedFrame &frame)
{
  Labels labels(std::size_t(frame.M.rows()));
  for (std::size_t i = 0; i < frame.interfaces.size(); ++i)
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = frame.interfaces[i].coordinate[motion]; row >= 0)
        labels[std::size_t(row)] = {long(i + 1), motion + 1};
  long point = first_scalar_point(frame);
  for (coupling::RowLabel &label : labels)
    if (label.component == 0)
      label.node = point++;
  return labels;
}

/// The same frame with rows in the order of `labels`, motions of interfaces along the axes.
coupling::ReducedFrame in_order_of(const Labels &labels, coupling::ReducedFrame frame)
{
  const auto      n = Eigen::Index(labels.size());
  Labels          sorted(labels);
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n); // q = P q_new
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> place = places_of(labels, sorted);
  for (Eigen::Index i = 0; i < n; ++i)
    P(i, place[std::size_t(i)]) = 1.;
  for (fem::Interface &interface : frame.interfaces)
  {
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = interface.coordinate[motion]; row >= 0)
        P(row, place[std::size_t(row)]) = interface.sign[motion];
    interface.sign = {1., 1., 1., 1., 1., 1.};
    interface.renumber([&](int row) { return place[std::size_t(row)]; });
  }
  for (Eigen::MatrixXd *A : {&frame.M, &frame.B, &frame.C})
    *A = Eigen::MatrixXd(P.transpose() * *A * P);
  frame.translations_load = Eigen::MatrixXd(P.transpose() * frame.translations_load);
  if (frame.displacement.size() > 0)
    frame.displacement = (frame.displacement.cast<double>() * P).cast<float>();
  for (fem::FrameOutput &output : frame.outputs)
  {
    output.on_q = Eigen::VectorXd(P.transpose() * output.on_q);
    output.on_v = Eigen::VectorXd(P.transpose() * output.on_v);
    if (output.on_a.size() > 0)
      output.on_a = Eigen::VectorXd(P.transpose() * output.on_a);
  }
  return frame;
}

/// Nodes of the interfaces by the numbers on the cards.
std::string numbered_table(const coupling::ReducedFrame &frame)
{
  std::ostringstream out;
  out << "name, node, x, y, z\n";
  for (std::size_t i = 0; i < frame.interfaces.size(); ++i)
  {
    out << written_text(frame.interfaces[i].name) << ", " << i + 1;
    for (const double x : frame.interfaces[i].position)
      out << ", " << exact_text(x);
    out << '\n';
  }
  return out.str();
}

/// frame.pch and nodes.csv; returns the keys that take them back.
std::string write_cards(Export &files, const coupling::ReducedFrame &frame, const Labels &labels,
                        const std::string &remark)
{
  coupling::NodePlaces places;
  for (std::size_t i = 0; i < frame.interfaces.size(); ++i)
    places[long(i + 1)] = frame.interfaces[i].position;
  const bool                             is_damped = !frame.B.isZero(0.);
  std::map<std::string, Eigen::MatrixXd> matrices  = {{"KAAX", frame.C}, {"MAAX", frame.M}};
  if (is_damped)
    matrices["BAAX"] = frame.B;
  files.cards(matrices, labels, places, remark);
  files.text("nodes.csv", numbered_table(frame));
  std::string keys = "mass = \"frame.pch\"\nstiffness = \"frame.pch\"\nnodes = \"nodes.csv\"\n";
  return !is_damped ? keys : keys + "damping = \"frame.pch\"\n";
}

/// Interfaces with their rows, then the points of the skin.
std::string node_table(const coupling::ReducedFrame &frame)
{
  std::ostringstream out;
  out << "name, x, y, z, ux, uy, uz, rx, ry, rz\n";
  for (const auto &interface : frame.interfaces)
  {
    out << written_text(interface.name);
    for (const double x : interface.position)
      out << ", " << exact_text(x);
    for (int motion = 0; motion < 6; ++motion)
    {
      out << ", ";
      if (const int i = interface.coordinate[motion]; i >= 0)
        out << (interface.sign[motion] < 0. ? -(i + 1) : i + 1);
    }
    out << '\n';
  }
  for (const auto &point : frame.points)
  {
    for (const double x : point)
      out << ", " << exact_text(x);
    out << ", , , , , , \n";
  }
  return out.str();
}

std::string triangle_table(const coupling::ReducedFrame &frame)
{
  const auto         first = frame.interfaces.size() + 1;
  std::ostringstream out;
  out << "node, node, node\n";
  for (const auto &[a, b, c] : frame.triangles)
    out << first + std::size_t(a) << ", " << first + std::size_t(b) << ", " << first + std::size_t(c) << '\n';
  return out.str();
}

Eigen::MatrixXd node_displacements(const coupling::ReducedFrame &frame)
{
  const auto      first = Eigen::Index(3 * frame.interfaces.size());
  Eigen::MatrixXd A     = Eigen::MatrixXd::Zero(first + frame.displacement.rows(), frame.M.cols());
  for (std::size_t i = 0; i < frame.interfaces.size(); ++i)
    for (int d = 0; d < 3; ++d)
      if (const int row = frame.interfaces[i].coordinate[d]; row >= 0)
        A(Eigen::Index(3 * i) + d, row) = frame.interfaces[i].sign[d];
  A.bottomRows(frame.displacement.rows()) = frame.displacement.cast<double>();
  return A;
}

std::string row_text(const Eigen::VectorXd &row)
{
  std::string text = "[";
  for (Eigen::Index i = 0; i < row.size(); ++i)
    text += (i > 0 ? ", " : "") + exact_text(row[i]);
  return text + "]";
}

std::string output_table(const fem::FrameOutput &output)
{
  return "\n[frame." + output.name + "]\nstiffness_row = " + row_text(output.on_q) +
         "\ndamping_row = " + row_text(output.on_v) +
         (output.on_a.size() > 0 ? "\ninertia_row = " + row_text(output.on_a) : "") +
         "\nacceleration_row = " + row_text(output.under_acceleration) + "\n";
}

} // namespace

MatrixFormat matrix_format(const std::string &name)
{
  if (name == "matrix-market")
    return MatrixFormat::matrix_market;
  if (name == "petsc")
    return MatrixFormat::petsc;
  if (name == "dmig")
    return MatrixFormat::dmig;
  throw std::invalid_argument("--export: got '" + name + "'; valid: matrix-market, petsc, dmig");
}

std::vector<std::string> exported_names(MatrixFormat format)
{
  std::vector<std::string> names = {"frame.toml", "nodes.csv", "triangles.csv"};
  if (format == MatrixFormat::dmig)
    names.push_back("frame.pch");
  for (const char *const matrix : {"mass", "damping", "stiffness", "translations", "node_displacements"})
    names.push_back(matrix + std::string(format == MatrixFormat::petsc ? ".petsc" : ".mtx"));
  return names;
}

std::vector<std::string> export_frame(const std::string &folder, const coupling::ReducedFrame &given,
                                      MatrixFormat format, const std::string &remark)
{
  const char *const whole = "frame.toml"; // written last: without it the export is incomplete
  Export            files(folder, format, remark);
  files.remove(whole);
  std::string scene = "# " + remark + "\n# Paths are relative to the scene that takes this table.\n[frame]\n";
  const auto  add   = [&](const std::string &key, const Eigen::MatrixXd &A, bool symmetric = false)
  { scene += key + " = " + written_text(files.matrix(key, A, symmetric)) + '\n'; };
  const bool on_cards = format == MatrixFormat::dmig;
  const auto labels   = on_cards ? labels_of(given) : Labels{};
  const auto frame    = on_cards ? in_order_of(labels, given) : given;
  if (on_cards)
  {
    Labels sorted(labels);
    std::sort(sorted.begin(), sorted.end());
    scene += write_cards(files, frame, sorted, remark);
  }
  else
  {
    add("mass", frame.M, true);
    add("damping", frame.B, true);
    add("stiffness", frame.C, true);
  }
  add("translations", coupling::unit_translations(frame));
  if (frame.mass > 0.)
    scene += "total_mass = " + exact_text(frame.mass) + '\n';
  if (!on_cards)
  {
    files.text("nodes.csv", node_table(frame));
    scene += "nodes = \"nodes.csv\"\n";
  }
  if (!frame.points.empty() && !on_cards)
  {
    files.text("triangles.csv", triangle_table(frame));
    scene += "triangles = \"triangles.csv\"\n";
    add("node_displacements", node_displacements(frame));
  }
  for (const auto &output : frame.outputs)
    scene += output_table(output);
  files.text(whole, scene);
  return files.files();
}

} // namespace gestell::apps
