#include "apps/output/exchange/state_space_files.h"

#include "apps/output/exchange/mat_file.h"
#include "coupling/frame/atomic_file.h"
#include "coupling/frame/matrix_market.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{
namespace
{

using NamedMatrices = std::vector<std::pair<std::string, const Eigen::MatrixXd *>>;

NamedMatrices matrices_of(const coupling::StateSpace &system)
{
  return {{"A", &system.A}, {"B", &system.B}, {"C", &system.C}, {"D", &system.D}, {"Z", &system.Z}};
}

std::vector<std::pair<std::string, const std::vector<std::string> *>> names_of(const StateSpaceModel &model)
{
  return {{"states", &model.states},
          {"inputs", &model.inputs},
          {"outputs", &model.outputs},
          {"coordinates", &model.coordinates}};
}

std::vector<std::string> write_matrix_market(OwnFolder &folder, const StateSpaceModel &model)
{
  std::vector<std::string> files;
  for (const auto &[name, matrix] : matrices_of(model.system))
  {
    files.push_back("state_space_" + name + ".mtx");
    coupling::write_matrix_market(folder.claim(files.back()).string(), *matrix,
                                  model.scene + " linearised at " + model.at + ", x' = A x + B u, y = C x + D u");
  }
  files.push_back("state_space.csv");
  coupling::AtomicFile table(folder.claim(files.back()).string());
  table.stream() << "kind, number, name\n";
  for (const auto &[kind, names] : names_of(model))
    for (std::size_t i = 0; i < names->size(); ++i)
      table.stream() << kind << ", " << i + 1 << ", \"" << (*names)[i] << "\"\n";
  table.finish();
  return files;
}

std::vector<std::string> write_mat(OwnFolder &folder, const StateSpaceModel &model)
{
  const std::string name = "state_space.mat";
  MatFile           file(folder.claim(name), "Gestell: " + model.scene + " linearised at " + model.at);
  for (const auto &[matrix_name, matrix] : matrices_of(model.system))
    file.add(matrix_name, *matrix);
  for (const auto &[kind, names] : names_of(model))
    file.add(kind, *names);
  file.finish();
  return {name};
}

} // namespace

const std::vector<std::string> &exchange_formats()
{
  static const std::vector<std::string> formats = MatFile::available()
                                                      ? std::vector<std::string>{"mat", "matrix-market"}
                                                      : std::vector<std::string>{"matrix-market"};
  return formats;
}

std::vector<std::string> state_space_files(const std::string &format)
{
  return format == "mat" ? std::vector<std::string>{"state_space.mat"}
                         : std::vector<std::string>{"state_space_*.mtx", "state_space.csv"};
}

std::vector<std::string> write_state_space(OwnFolder &folder, const StateSpaceModel &model, const std::string &format)
{
  const auto &known = exchange_formats();
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw std::invalid_argument("--export: there is no format '" + format + "'" + suggestion(format, known));
  return format == "mat" ? write_mat(folder, model) : write_matrix_market(folder, model);
}

} // namespace gestell::apps
