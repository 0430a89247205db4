#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gestell::fem
{

/// A word of gmsh's language of scripts; of a text without its quotes.
struct GeoToken
{
  enum class Kind
  {
    word,
    number,
    text,
    sign
  };
  Kind        kind;
  std::string text;
  int         line; ///< from 1

  bool is(const std::string &what) const { return kind != Kind::text && text == what; }
};

/// Called with a line and what is wrong there; throws.
using RefuseLine = std::function<void(int line, const std::string &what)>;

/**
 * The tokens of a script, without blanks and comments, as gmsh's own scanner (Parser/Gmsh.l of 4.8) finds them.
 *
 * Refused is what its scanner reads in one way and, where it skips (a condition that is false, the body of a macro), in
 * another: texts over several lines, longer than a thousand bytes, or with a word that ends a block.
 */
std::vector<GeoToken> geo_tokens(const std::string &script, const RefuseLine &refuse);

/// A script of these tokens, each in its line, that is scanned in one way alone.
std::string geo_text(const std::vector<GeoToken> &tokens);

/// Whether gmsh reads the file as a mesh (Common/OpenFile.cpp of 4.8); what begins otherwise it runs as a script.
bool begins_as_mesh(const std::string &file);

} // namespace gestell::fem
