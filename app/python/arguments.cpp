#include "python/arguments.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace chainmail::python {
namespace {

template <class Rows>
Words named(const char* name, const Rows& rows) {
  Words words{name, {}};
  std::ranges::transform(rows, std::back_inserter(words.all), [](const auto& row) { return row.name; });
  return words;
}

}  // namespace

template <>
const Words& words<Precision>() {
  static const Words all{"precision", {"float", "double"}};
  return all;
}

template <>
const Words& words<RelaxationScheme>() {
  static const Words all = named("scheme", relaxation_schemes);
  return all;
}

template <>
const Words& words<EnergyKind>() {
  static const Words all = named("energy", energy_kinds());
  return all;
}

std::size_t index_of(const Words& words, std::string_view word) {
  const auto& all = words.all;
  const auto found = std::ranges::find(all, word);
  if (found == all.end()) {
    std::string list;
    for (std::size_t i = 0; i < all.size(); ++i) {
      list += (i == 0 ? "" : i + 1 == all.size() ? " or " : ", ") + std::string(all[i]);
    }
    throw Error(words.name + (" '" + std::string(word.substr(0, 60))) + "'", "there is no such value", "use " + list);
  }
  return std::size_t(found - all.begin());
}

}  // namespace chainmail::python
