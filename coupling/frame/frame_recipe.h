#pragma once

#include "coupling/frame/reduction_options.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// One thing a frame is made from: "mesh.size" = "0.08", "source 1" = SHA-256 of the file's bytes.
struct Ingredient
{
  std::string name, value;
};

/**
 * All a reduced frame is made from, in a fixed order: the bytes of its files, every value of specification and options,
 * and the sources of the program that makes it.  Equal recipes mean equal frames.
 *
 * Places (file:line for messages), the path of a file and the order of surfaces in a scene do not count; every number
 * counts with all its digits.  With a script of gmsh (.geo) count the files it names, and those that these name; what
 * it names and is not there counts by its name.  Where more than files decides (names that are computed, the
 * environment, the time), an ingredient says so, and the frame is not kept in a cache.
 */
using Recipe = std::vector<Ingredient>;

/// @throws std::invalid_argument if a file cannot be read.
Recipe recipe_of(const fem::FrameSpecification &frame, const ReductionOptions &options);
/// The same for a frame that is given by matrices.
Recipe recipe_of(const fem::FrameMatrices &frame, const ReductionOptions &options);

/// A text that parse_recipe() reads back, whatever names and values hold.
std::string text_of(const Recipe &recipe);
/// @throws std::runtime_error if the text is not one of text_of().
Recipe parse_recipe(const std::string &text);

/// Key of a reduced frame: SHA-256 of text_of(recipe), in hexadecimal.
std::string content_key(const Recipe &recipe);

/// Why equal recipes of this kind need not mean equal frames, SourceFiles::beyond; "": they do.
std::string beyond_the_files(const Recipe &recipe);

/// Where two recipes differ; "" stands for an ingredient that one of them lacks.
struct Difference
{
  std::string name, first, second;
};
std::vector<Difference> differences(const Recipe &first, const Recipe &second);

} // namespace gestell::coupling
