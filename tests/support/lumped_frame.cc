#include "tests/support/lumped_frame.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace gestell::tests
{
namespace
{

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

std::string format(const char *form, double x)
{
  char text[64];
  std::snprintf(text, sizeof text, form, x);
  return text;
}

std::string right(const std::string &text, std::size_t width)
{
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

std::string left(const std::string &text, std::size_t width)
{
  return text + std::string(text.size() < width ? width - text.size() : 0, ' ');
}

Matrix3d cross_matrix(const Vector3d &a)
{
  Matrix3d A;
  A << 0., -a[2], a[1], a[2], 0., -a[0], -a[1], a[0], 0.;
  return A;
}

/// Motion of a point fastened to a node by an arm: u + w x arm, w.
MatrixXd motion_at(const Vector3d &arm)
{
  MatrixXd G               = MatrixXd::Identity(6, 6);
  G.topRightCorner<3, 3>() = -cross_matrix(arm);
  return G;
}

/// "-1.2345+5" in eight columns, Nastran's short form.
std::string short_value(double x)
{
  for (int digits = 5; digits >= 0; --digits)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.*e", digits, x);
    const std::string whole(text);
    const auto        e        = whole.find('e');
    const int         exponent = std::stoi(whole.substr(e + 1));
    const std::string result   = whole.substr(0, e) + (exponent < 0 ? "-" : "+") + std::to_string(std::abs(exponent));
    if (result.size() <= 8)
      return result;
  }
  return "0.";
}

} // namespace

LumpedFrame LumpedFrame::in_units(double length, double mass_unit) const
{
  LumpedFrame     file = *this;
  Eigen::VectorXd s(M.rows()); // q_SI = s q_file
  for (Eigen::Index i = 0; i < s.size(); ++i)
  {
    const int direction = rows[std::size_t(i)].second;
    s[i]                = direction == 0 ? length * std::sqrt(mass_unit) : direction <= 3 ? length : 1.;
  }
  const double energy = mass_unit * length * length; // of the unit, over s^2
  file.M              = s.asDiagonal() * M * s.asDiagonal() / energy;
  file.C              = s.asDiagonal() * C * s.asDiagonal() / energy;
  for (auto &[number, x] : file.nodes)
    for (double &coordinate : x)
      coordinate /= length;
  return file;
}

LumpedFrame lumped_frame(bool grounded)
{
  LumpedFrame frame;
  frame.nodes = {{11, {0., 0., 0.}}, {12, {1.2, 0.1, 0.}}, {23, {0.2, 0.9, 0.3}}, {7, {0.4, 0.3, 1.5}}};
  const int n = 24;
  frame.M     = MatrixXd::Zero(n, n);
  frame.C     = MatrixXd::Zero(n, n);
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 6; ++d)
    {
      const double mass             = 20. + 10. * a;
      frame.M(6 * a + d, 6 * a + d) = d < 3 ? mass : (0.4 + 0.1 * d) * (1. + a);
      frame.rows.emplace_back(frame.nodes[std::size_t(a)].first, d + 1);
      frame.mass += d == 0 ? mass : 0.;
    }
  const auto place = [&](int a) { return Vector3d(frame.nodes[std::size_t(a)].second.data()); };
  MatrixXd   springs(6, 6);
  springs = Eigen::Matrix<double, 6, 1>(4e6, 3e6, 5e6, 2e5, 3e5, 1e5).asDiagonal();
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b)
    {
      const Vector3d middle  = (place(a) + place(b)) / 2.;
      MatrixXd       G       = MatrixXd::Zero(6, n);
      G.middleCols(6 * a, 6) = motion_at(middle - place(a));
      G.middleCols(6 * b, 6) = -motion_at(middle - place(b));
      frame.C += (1. + 0.2 * a + 0.3 * b) * G.transpose() * springs * G;
    }
  if (grounded)
    frame.C.bottomRightCorner(6, 6) += 2. * springs;
  return frame;
}

LumpedFrame craig_bampton_frame(const LumpedFrame &whole, int n_modes)
{
  const int      n1 = 12, n2 = int(whole.M.rows()) - n1;
  const MatrixXd C22 = whole.C.bottomRightCorner(n2, n2), M22 = whole.M.bottomRightCorner(n2, n2);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(C22, M22);
  MatrixXd                                                 T = MatrixXd::Zero(n1 + n2, n1 + n_modes);
  T.topLeftCorner(n1, n1).setIdentity();
  T.bottomLeftCorner(n2, n1)       = -C22.llt().solve(whole.C.bottomLeftCorner(n2, n1));
  T.bottomRightCorner(n2, n_modes) = modes.eigenvectors().leftCols(n_modes);
  LumpedFrame reduced;
  reduced.M     = T.transpose() * whole.M * T;
  reduced.C     = T.transpose() * whole.C * T;
  reduced.rows  = {whole.rows.begin(), whole.rows.begin() + n1};
  reduced.nodes = {whole.nodes.begin(), whole.nodes.begin() + 2};
  reduced.mass  = whole.mass;
  for (int j = 0; j < n_modes; ++j)
    reduced.rows.emplace_back(1001 + j, 0);
  return reduced;
}

std::string dmig_text(const std::string &name, const MatrixXd &A, const std::vector<FileRow> &rows, CardFields fields)
{
  const auto line = [&](const std::string &head, const std::vector<std::string> &items)
  {
    std::string       text  = fields == CardFields::free_ ? head : left(head, 8);
    const std::size_t width = fields == CardFields::large ? 16 : 8;
    for (const std::string &item : items)
      text += fields == CardFields::free_ ? "," + item : left(item, width);
    return text + "\n";
  };
  const bool        large = fields == CardFields::large;
  const std::string head = large ? "DMIG*" : "DMIG", more = large ? "*" : "";
  std::string       text = line(head, {name, "0", "6", "2"});
  for (Eigen::Index j = 0; j < A.cols(); ++j)
  {
    std::vector<std::string> entries;
    for (Eigen::Index i = j; i < A.rows(); ++i)
      if (A(i, j) != 0.)
      {
        const std::string value = fields == CardFields::small_ ? short_value(A(i, j))
                                  : large                      ? format("%.9E", A(i, j))
                                                               : format("%.17g", A(i, j));
        entries.insert(entries.end(),
                       {std::to_string(rows[i].first), std::to_string(rows[i].second), value, std::string()});
      }
    if (entries.empty())
      continue;
    std::vector<std::string> items = {name, std::to_string(rows[j].first), std::to_string(rows[j].second), ""};
    std::size_t              at    = 0;
    if (!large)
      for (; at < 4; ++at)
        items.push_back(entries[at]);
    text += line(head, items);
    for (const std::size_t step = large ? 4 : 8; at < entries.size(); at += step)
      text += line(more, {entries.begin() + long(at), entries.begin() + long(std::min(at + step, entries.size()))});
  }
  return text;
}

std::string grid_text(const LumpedFrame &frame)
{
  std::string text;
  for (const auto &[number, x] : frame.nodes)
    text += "GRID," + std::to_string(number) + ",," + format("%.10g", x[0]) + "," + format("%.10g", x[1]) + "," +
            format("%.10g", x[2]) + "\n";
  return text;
}

std::string indexed_text(const MatrixXd &A)
{
  std::string text;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i <= j; ++i)
      text += std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + format("%20.13e", A(i, j)) + "\n";
  return text;
}

std::string dof_text(const std::vector<FileRow> &rows)
{
  std::string text;
  for (const auto &[node, direction] : rows)
    text += std::to_string(node) + "." + std::to_string(direction) + "\n";
  return text;
}

std::string mapping_text(const std::vector<FileRow> &rows)
{
  const char *const motions[] = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};
  std::string       text      = "    Matrix Eqn          Node    DOF\n";
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += right(std::to_string(i + 1), 14) + right(std::to_string(rows[i].first), 14) + "    " +
            motions[rows[i].second - 1] + "\n";
  return text;
}

std::string inp_text(const LumpedFrame &frame)
{
  std::string text = "** a model\n*HEADING\nmodel\n*NODE, NSET=NALL\n";
  for (const auto &[number, x] : frame.nodes)
    text += std::to_string(number) + ", " + format("%.10g", x[0]) + ", " + format("%.10g", x[1]) + ", " +
            format("%.10g", x[2]) + "\n";
  return text + "*ELEMENT, TYPE=C3D8\n1,2,3\n";
}

std::string nblock_text(const LumpedFrame &frame)
{
  std::string text = "/PREP7\nNBLOCK,6,SOLID,      23,       4\n(3i9,6e21.13e3)\n";
  for (const auto &[number, x] : frame.nodes)
  {
    text += right(std::to_string(number), 9) + right("0", 9) + right("0", 9);
    for (const double coordinate : x)
      text += right(format("%.13E", coordinate), 21);
    text += "\n";
  }
  return text + "N,R5.3,LOC,       -1,\n";
}

std::string node_table_text(const LumpedFrame &frame, const std::string &unit, bool named)
{
  std::string text = "name,node,x [" + unit + "],y [" + unit + "],z [" + unit + "]\n";
  for (const auto &[number, x] : frame.nodes)
    text += (named ? "n" + std::to_string(number) : "") + "," + std::to_string(number) + "," + format("%.10g", x[0]) +
            "," + format("%.10g", x[1]) + "," + format("%.10g", x[2]) + "\n";
  return text;
}

std::string element_matrix_text(const std::vector<std::pair<std::string, MatrixXd>> &matrices,
                                const std::vector<FileRow> &rows, bool by_direction)
{
  std::string text = "**\n** GENERATION OF SUBSTRUCTURE\n*USER ELEMENT,NODES=" +
                     right(std::to_string(by_direction ? rows.size() : rows.size() / 6), 11) +
                     ",LINEAR\n** ELEMENT NODES\n";
  std::string directions;
  for (std::size_t i = 0; i < rows.size(); i += by_direction ? 1 : 6)
  {
    text += (i % 6 == 0 ? "**" : "") + right(std::to_string(rows[i].first), 10) + ",";
    text += by_direction && i % 6 != 5 ? "" : "\n";
    if (by_direction)
      directions += (i > 0 ? std::to_string(i + 1) + ", " : "") + std::to_string(rows[i].second) + "\n";
  }
  text += by_direction ? directions : "1, 2, 3, 4, 5, 6\n";
  for (const auto &[type, A] : matrices)
  {
    text += "*MATRIX,TYPE=" + type + "\n";
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        text += right(format("%.13E", A(i, j)), 20) + (j % 4 == 3 || j == i ? ",\n" : ",");
  }
  return text;
}

std::string harwell_boeing_text(const MatrixXd &A, bool symmetric)
{
  std::string pointers, indices, values;
  int         count = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j)
  {
    pointers += right(std::to_string(count + 1), 14) + "\n";
    for (Eigen::Index i = symmetric ? j : 0; i < A.rows(); ++i)
      if (A(i, j) != 0.)
      {
        ++count;
        indices += right(std::to_string(i + 1), 14) + "\n";
        std::string value      = format("%.15E", A(i, j));
        value[value.find('E')] = 'D';
        values += right(value, 25) + "\n";
      }
  }
  pointers += right(std::to_string(count + 1), 14) + "\n";
  const auto n = std::to_string(A.rows()), entries = std::to_string(count);
  return left("frame", 72) + left("FRAME", 8) + "\n" + right("1", 14) + right(std::to_string(A.rows() + 1), 14) +
         right(entries, 14) + right(entries, 14) + right("0", 14) + "\n" + (symmetric ? "RSA" : "RUA") +
         std::string(11, ' ') + right(n, 14) + right(n, 14) + right(entries, 14) + right("0", 14) + "\n" +
         left("(1I14)", 16) + left("(1I14)", 16) + left("(1D25.15)", 20) + "\n" + pointers + indices + values;
}

std::string matrix_market_text(const MatrixXd &A)
{
  std::string text =
      "%%MatrixMarket matrix array real general\n" + std::to_string(A.rows()) + " " + std::to_string(A.cols()) + "\n";
  for (Eigen::Index j = 0; j < A.cols(); ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      text += format("%.17g", A(i, j)) + "\n";
  return text;
}

} // namespace gestell::tests
