#include "tests/random_machines/train.h"

#include <vector>

namespace gestell::tests
{
namespace
{

using Matrix = std::vector<std::vector<double>>;

/// Sum of n outer products g g^T with weights from `least` to `most`, and a diagonal: positive definite.
Matrix random_matrix(Dice &dice, int n, double diagonal, double least, double most)
{
  Matrix A(n, std::vector<double>(n, 0.));
  for (int i = 0; i < n; ++i)
    A[i][i] = diagonal * dice.log_between(0.5, 2.);
  for (int k = 0; k < n; ++k)
  {
    std::vector<double> g(n, 0.);
    for (int i = 0, terms = 2 + dice.whole(3); i < terms; ++i)
      g[dice.whole(n)] += dice.between(-1., 1.);
    const double weight = dice.log_between(least, most);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        A[i][j] += weight * g[i] * g[j];
  }
  return A;
}

/// MatrixMarket, symmetric, eight digits: an entry and its mirror are the same text.
std::string market(const Matrix &A)
{
  const int   n     = int(A.size());
  int         count = 0;
  std::string rows;
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i)
      if (A[i][j] != 0.)
      {
        char value[32];
        std::snprintf(value, sizeof value, "%.8g", A[i][j]);
        rows += std::to_string(i + 1) + " " + std::to_string(j + 1) + " " + value + "\n";
        ++count;
      }
  return "%%MatrixMarket matrix coordinate real symmetric\n" + std::to_string(n) + " " + std::to_string(n) + " " +
         std::to_string(count) + "\n" + rows;
}

void damping(Draft &draft, const Scale &scale, int n)
{
  switch (draft.dice.whole(3))
  {
  case 0:
    return;
  case 1:
    draft.line("damping = { ratio = " + digits(draft.dice.log_between(0.003, 0.1)) + " }");
    break;
  default:
    draft.text("damping", "damping.mtx");
    draft.machine.files["damping.mtx"] =
        market(random_matrix(draft.dice, n, 0.01 * scale.damping(), 0.01 * scale.damping(), 0.3 * scale.damping()));
  }
  draft.machine.conservative = false;
}

} // namespace

/// Sliders or rotors and laws on a frame of random matrices.
void write_framed(Draft &draft)
{
  Dice       &dice  = draft.dice;
  const Scale scale = random_scale(dice, false);
  const int   n = 2 + dice.whole(20), points = 1 + dice.whole(std::min(n, 4));
  draft.machine.kind = "frame of matrices";
  set_times(draft, scale, 1.5, 8.);
  draft.table("frame");
  draft.text("mass", "mass.mtx");
  draft.text("stiffness", "stiffness.mtx");
  const double k                  = scale.stiffness();
  draft.machine.files["mass.mtx"] = market(random_matrix(dice, n, scale.mass, 0.05 * scale.mass, 0.5 * scale.mass));
  draft.machine.files["stiffness.mtx"] = market(random_matrix(dice, n, k, 0.3 * k, k * dice.log_between(1., 300.)));
  damping(draft, scale, n);
  Train train(draft, false, scale);
  for (int i = 0; i < points; ++i)
  {
    const std::string name = "p" + std::to_string(i + 1);
    draft.table("frame.interface." + name);
    draft.line("rows = { " + std::string(dice.chance(0.3) ? "\"-ux\"" : "ux") + " = " + std::to_string(i + 1) + " }");
    draft.line("position = " + vector_text(i, 0., 0.));
    draft.watch("frame." + name + ".ux");
    draft.watch("frame." + name + ".ux_rate");
  }
  for (int i = 0, bodies = dice.whole(4); i < bodies; ++i)
    train.add_body();
  for (int i = 0; i < points; ++i)
    train.add_point("frame.p" + std::to_string(i + 1), "direction = [1, 0, 0]");
  for (int i = 0; i < train.n_bodies(); ++i)
    add_spring(draft, train.link(i, train.n_bodies() + dice.whole(points)), train.stiffness(), train.damping());
  for (int i = 0, laws = dice.chance(0.1) ? 0 : 1 + dice.whole(3); i < laws; ++i)
    add_random_law(draft, train.random_link());
  train.start();
}

} // namespace gestell::tests
