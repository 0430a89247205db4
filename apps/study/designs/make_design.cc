#include "apps/study/designs/make_design.h"

#include "apps/study/designs/response_designs.h"
#include "apps/study/designs/space_filling.h"

#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Place of a word among names.  @throws std::invalid_argument if it is none of them
std::size_t place_among(const std::vector<std::string> &names, const std::string &word, const std::string &what)
{
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end())
    throw std::invalid_argument("study: " + what + " \"" + word + "\" does not exist" + suggestion(word, names));
  return static_cast<std::size_t>(found - names.begin());
}

/// Sizes are judged before a point is made.
void require_few(const char *what, int requested)
{
  if (requested > most_runs)
    throw std::invalid_argument("study: " + std::string(what) + " is " + std::to_string(requested) +
                                "; the limit is a million runs");
}

Design listed_design(const DesignRequest &request, const std::vector<StudyVariable> &variables)
{
  if (request.list.rows() == 0)
    throw std::invalid_argument("study: design list: it has no runs");
  if (!request.list.allFinite())
    throw std::invalid_argument("study: design list: a value is not a number");
  Design design;
  design.type   = "list";
  design.points = coded_points(request.list, variables);
  return design;
}

Design factorial_design(const DesignRequest &request, const std::vector<StudyVariable> &variables)
{
  std::vector<std::vector<double>> levels;
  for (const auto &variable : variables)
  {
    levels.push_back(variable.levels.empty() ? even_levels(request.levels == 0 ? 2 : request.levels) : variable.levels);
    if (!variable.levels.empty())
      for (double &level : levels.back())
        level = variable.coded(level);
  }
  return full_factorial(levels);
}

Design composite_design(const DesignRequest &request, int n_variables)
{
  const std::string star = request.star.empty() ? star_names().front() : request.star;
  const auto        kind = static_cast<Star>(place_among(star_names(), star, "distance of star points"));
  return central_composite(n_variables,
                           request.alpha ? *request.alpha : star_distance(kind, n_variables, request.centre_points),
                           request.centre_points);
}

} // namespace

const std::vector<std::string> &design_types()
{
  static const std::vector<std::string> types = {"list",        "full factorial",  "central composite",
                                                 "Box-Behnken", "Latin hypercube", "Sobol"};
  return types;
}

const std::vector<std::string> &star_names()
{
  static const std::vector<std::string> names = {"rotatable", "face-centred", "orthogonal", "spherical"};
  return names; // in the order of Star
}

Design make_design(const DesignRequest &request, const std::vector<StudyVariable> &variables)
{
  if (variables.empty())
    throw std::invalid_argument("study: there are no variables; give one at least");
  for (const auto &variable : variables)
    check_variable(variable);

  require_few("design.runs", request.runs);
  require_few("design.levels", request.levels);
  require_few("design.centre_points", request.centre_points);
  const int k = static_cast<int>(variables.size());
  switch (place_among(design_types(), request.type, "design"))
  {
  case 0:
    return listed_design(request, variables);
  case 1:
    return factorial_design(request, variables);
  case 2:
    return composite_design(request, k);
  case 3:
    return box_behnken(k, request.centre_points);
  case 4:
    return latin_hypercube(k, request.runs, request.seed);
  default:
    return sobol_points(k, request.runs, request.seed);
  }
}

} // namespace gestell::apps
