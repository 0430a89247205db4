#include "coupling/reduction/parts/part_file.h"

#include "coupling/frame/checksummed_file.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/frame/hdf5_file.h"
#include "coupling/frame/sha256.h"
#include "coupling/frame/tried_file.h"
#include "fem/values/two_pi.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd number(double x)
{
  return MatrixXd::Constant(1, 1, x);
}

/// The lower triangle, column by column.
MatrixXd packed(const MatrixXd &A)
{
  const Index n = A.rows();
  MatrixXd    result(n * (n + 1) / 2, 1);
  for (Index j = 0, at = 0; j < n; at += n - j, ++j)
    result.col(0).segment(at, n - j) = A.col(j).tail(n - j);
  return result;
}

MatrixXd unpacked(const MatrixXd &packed, Index n)
{
  if (packed.size() != n * (n + 1) / 2)
    throw std::runtime_error("a part of the frame has a matrix of a wrong size");
  MatrixXd A = MatrixXd::Zero(n, n);
  for (Index j = 0, at = 0; j < n; at += n - j, ++j)
    A.col(j).tail(n - j) = packed.col(0).segment(at, n - j);
  return A;
}

/// All that determines the condensed part.
Recipe recipe_of(PartOfFrame &part, const PartModes &modes)
{
  fem::FrameMatrices frame;
  ReductionOptions   options;
  options.n_modes   = modes.least;
  options.frequency = modes.hertz;
  const auto swap   = [&]
  {
    frame.M.swap(part.sums.M);
    frame.C.swap(part.sums.C);
    frame.B.swap(part.damping);
  };
  swap();
  frame.acceleration_load = part.load;
  frame.outputs           = part.forces;
  Recipe recipe           = coupling::recipe_of(frame, options);
  swap();
  recipe.push_back(
      {"interface of the part", Sha256().update(part.held.data(), sizeof(int) * part.held.size()).hexadecimal()});
  if (!part.forces.empty()) // their damping contains alpha M u'
    recipe.push_back({"mass-proportional damping", Sha256().update(&part.alpha, sizeof part.alpha).hexadecimal()});
  return recipe;
}

/// The bytes of its file; the largest matrices go as soon as they are in it.
std::string image_of(CondensedPart part, const FrameOrigin &origin)
{
  const auto alone = hdf5_alone();
  Hdf5File   image;
  image.write("made_from", text_of(origin.recipe)); // the first six are those of every file in the cache
  image.write("scene", origin.scene);
  image.write("source", origin.source);
  image.write("n_full", number(double(part.V.rows())));
  image.write("n_interface", number(double(part.C.rows())));
  image.write("omega0", MatrixXd(part.omega));
  image.write("sigma", number(part.sigma));
  image.write("M_1V", part.M_1V);
  image.write("damping", part.damping);
  image.write("load", part.load);
  image.write("forces", part.forces);
  const auto move = [&](const std::string &name, MatrixXd &A)
  {
    image.write(name, A);
    A.resize(0, 0);
  };
  move("V", part.V);
  part.C = packed(part.C);
  part.M = packed(part.M);
  move("C", part.C);
  move("M", part.M);
  return image.image();
}

} // namespace

std::string stored_part(PartOfFrame part, const PartModes &modes, const std::string &place, const std::string &folder)
{
  const FrameOrigin origin{recipe_of(part, modes), place, part.name};
  const std::string key = content_key(origin.recipe);
  if (std::string known = find_part_in_cache(key); !known.empty())
    return known;
  int n_modes = modes.least;
  if (modes.hertz > 0.)
    n_modes = std::max(n_modes, modes_below(part, two_pi * modes.hertz) + 1);
  n_modes = std::min(n_modes, int(part.sums.M.rows()) - int(part.held.size()));

  const std::string image = image_of(condense(std::move(part), n_modes), origin);
  const auto        write = [&](const std::string &file) { write_sealed(file, title_of_parts, image); };
  if (keep_part_in_cache(key, write).empty())
    return cache_file(key);
  std::string file = folder + "/" + key + ".h5";
  write(file);
  return file;
}

CondensedPart read_part(const std::string &name, PartContent content)
{
  const auto     alone = hdf5_alone();
  const Hdf5File file(name);
  CondensedPart  part;
  part.omega = file.read_vector("omega0");
  part.sigma = file.read_number("sigma");
  if (content == PartContent::modes)
    part.V = file.read_matrix("V");
  if (content != PartContent::sums)
    return part;
  const Index n1 = Index(file.read_number("n_interface"));
  part.C         = unpacked(file.read_matrix("C"), n1);
  part.M         = unpacked(file.read_matrix("M"), n1);
  part.M_1V      = file.read_matrix("M_1V");
  part.damping   = file.read_matrix("damping");
  part.load      = file.read_matrix("load");
  part.forces    = file.read_matrix("forces");
  return part;
}

} // namespace gestell::coupling
