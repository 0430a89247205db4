#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gestell::fem
{

/// A token of gmsh's script language; strings without quotes.
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

/// Called with a line and its error; throws.
using RefuseLine = std::function<void(int line, const std::string &what)>;

/**
 * The tokens of a script, without blanks and comments, as gmsh's own scanner (Parser/Gmsh.l of 4.8) finds them.
 *
 * Rejects text that the scanner reads differently when it skips (a false condition, the body of a macro): strings over
 * several lines, longer than a thousand bytes, or with a word that ends a block.
 */
std::vector<GeoToken> geo_tokens(const std::string &script, const RefuseLine &refuse);

/// A script of these tokens, on their lines, with an unambiguous scan.
std::string geo_text(const std::vector<GeoToken> &tokens);

/// Whether gmsh reads the file as a mesh (Common/OpenFile.cpp of 4.8); other contents are run as a script.
bool begins_as_mesh(const std::string &file);

} // namespace gestell::fem
