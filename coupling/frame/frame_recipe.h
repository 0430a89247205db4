#pragma once

#include "coupling/frame/reduction_options.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// One input of a frame: "mesh.size" = "0.08", "source 1" = SHA-256 of the file's bytes.
struct Ingredient
{
  std::string name, value;
};

/**
 * All inputs of a reduced frame, in a fixed order: the bytes of its files, every value of specification and options,
 * and the sources of the program that makes it.  Equal recipes mean equal frames.
 *
 * Locations (file:line for messages), paths and the order of surfaces in a scene are not included; numbers are included
 * with all digits. A gmsh script (.geo) includes the files it names, recursively, and missing files by name. If more
 * than files determines the frame (computed names, the environment, the time), an ingredient states it, and the frame
 * is not stored in a cache.
 */
using Recipe = std::vector<Ingredient>;

/// @throws std::invalid_argument if a file cannot be read.
Recipe recipe_of(const fem::FrameSpecification &frame, const ReductionOptions &options);
/// The same for a frame that is given by matrices.
Recipe recipe_of(const fem::FrameMatrices &frame, const ReductionOptions &options);

/// SHA-256 of the sources that make a frame and of the versions of gmsh, deal.II and OpenCASCADE, in hexadecimal.
std::string sources_of_frames();

/// Text form of a recipe for parse_recipe(), for any names and values.
std::string text_of(const Recipe &recipe);
/// @throws std::runtime_error if the text is not one of text_of().
Recipe parse_recipe(const std::string &text);

/// Key of a reduced frame: SHA-256 of text_of(recipe), in hexadecimal.
std::string content_key(const Recipe &recipe);

/// Why equal recipes of this kind need not mean equal frames, SourceFiles::beyond; "": they do.
std::string beyond_the_files(const Recipe &recipe);

/// Differences of two recipes; "" for a missing ingredient.
struct Difference
{
  std::string name, first, second;
};
std::vector<Difference> differences(const Recipe &first, const Recipe &second);

} // namespace gestell::coupling
