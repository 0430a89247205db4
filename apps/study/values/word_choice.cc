#include "apps/study/values/word_choice.h"

#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{

std::size_t word_choice(const std::string &word, const std::vector<std::string> &words, const std::string &what)
{
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    throw std::invalid_argument("study: there is no " + what + " \"" + word + '"' + suggestion(word, words));
  return std::size_t(found - words.begin());
}

} // namespace gestell::apps
