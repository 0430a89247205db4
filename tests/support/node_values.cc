#include "tests/support/node_values.h"

#include <sstream>

namespace gestell::tests
{

using apps::SceneNode;
using Type = SceneNode::Type;

namespace
{

std::string digits(double x)
{
  std::ostringstream text;
  text.precision(17);
  text << x;
  return text.str();
}

bool is_number(const SceneNode &value)
{
  return value.type == Type::integer || value.type == Type::real;
}

bool is_zero(const SceneNode &value)
{
  return is_number(value) && value.number == 0.;
}

} // namespace

SceneNode text_node(const std::string &text)
{
  SceneNode node;
  node.type = Type::text;
  node.text = text;
  return node;
}

SceneNode number_node(double value)
{
  SceneNode node;
  node.type   = Type::real;
  node.number = value;
  node.text   = digits(value);
  return node;
}

SceneNode array_node(std::vector<SceneNode> elements)
{
  SceneNode array;
  array.type     = Type::array;
  array.elements = std::move(elements);
  return array;
}

SceneNode weighted_sum(const std::vector<std::pair<double, SceneNode>> &terms, const std::string &unit, double constant)
{
  std::string text;
  const auto  add = [&text](const std::string &term) { text += (text.empty() ? "" : " + ") + term; };
  for (const auto &[weight, value] : terms)
    if (weight != 0. && !is_zero(value))
      add(digits(weight) + "*(" + value.text + (is_number(value) ? unit : "") + ")");
  if (constant != 0.)
    add("(" + digits(constant) + unit + ")");
  return text.empty() ? number_node(0.) : text_node(text);
}

SceneNode transformed_matrix(const SceneNode &matrix, const Eigen::MatrixXd &T, const std::string &unit)
{
  const auto             n = T.rows();
  std::vector<SceneNode> rows;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    std::vector<SceneNode> row;
    for (Eigen::Index j = 0; j < n; ++j)
    {
      std::vector<std::pair<double, SceneNode>> terms;
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index l = 0; l < n; ++l)
          if (const double weight = T(i, k) * T(j, l); weight != 0.)
            terms.emplace_back(weight, matrix.elements.at(std::size_t(k)).elements.at(std::size_t(l)));
      row.push_back(weighted_sum(terms, unit));
    }
    rows.push_back(array_node(row));
  }
  SceneNode result = array_node(rows);
  put_at(result, matrix);
  return result;
}

void put_at(SceneNode &value, const SceneNode &as)
{
  value.place  = as.place;
  value.folder = as.folder;
  for (SceneNode &element : value.elements)
    put_at(element, as);
}

SceneNode &table_of(SceneNode &parent, const std::string &key)
{
  if (!parent.find(key))
  {
    SceneNode table;
    put_at(table, parent);
    parent.entries.emplace_back(key, table);
  }
  return *parent.find(key);
}

} // namespace gestell::tests
