#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Codes of the languages of headings, column heads and captions: "en", "de".
const std::vector<std::string> &page_languages();

/// The language of all pages and pictures that this process makes from now on, like a locale; "en" at first.
/// @throws std::invalid_argument for a code that is not one of page_languages()
void choose_page_language(const std::string &code);

/**
 * A finished page or picture with its headings, column heads, captions, and titles and axes of charts in the chosen
 * language; sentences, names and numbers stay.
 *
 * The texts are those of the elements h2, h3, th, figcaption, summary, a, span, strong and, in pictures, text and title,
 * and the titles and labels in the data of charts.  The dictionary german.tsv translates a text as a whole; '*' stands
 * for any part, which is kept, and a unit in brackets at the end need not be listed.  Other texts stay.
 */
std::string in_page_language(std::string page);

} // namespace gestell::apps
