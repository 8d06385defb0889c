#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "chainmail/error.h"
#include "chainmail/state.h"

namespace chainmail::api {

/// Reads the values of a state, which may come from outside. Throws Error for one that is missing or of another type.
/// Arrays are moved out: read each of them once.
class StateFields {
 public:
  /// `kind` is the name of the object in errors.
  StateFields(const std::string& kind, State state) : where_("state of a " + kind), state_(std::move(state)) {}

  const std::string& where() const { return where_; }

  bool flag(std::string_view name) { return value<bool>(name); }
  const std::string& text(std::string_view name) { return value<std::string>(name); }
  std::vector<std::uint32_t> ids(std::string_view name) { return std::move(value<std::vector<std::uint32_t>>(name)); }
  /// Returns a whole number from `lowest` to `highest`.
  std::int64_t whole(std::string_view name, std::int64_t lowest, std::int64_t highest) {
    const auto number = value<std::int64_t>(name);
    if (number < lowest || number > highest) {
      refuse(name);
    }
    return number;
  }
  double real(std::string_view name) {
    const auto* const whole = std::get_if<std::int64_t>(&any(name));
    return whole != nullptr ? double(*whole) : value<double>(name);
  }
  std::vector<double> reals(std::string_view name) {
    const auto* const whole = std::get_if<std::vector<std::uint32_t>>(&any(name));
    return whole != nullptr ? std::vector<double>(whole->begin(), whole->end())
                            : std::move(value<std::vector<double>>(name));
  }
  template <std::size_t Size>
  std::array<double, Size> row(std::string_view name) {
    const std::vector<double> all = reals(name);
    if (all.size() != Size) {
      refuse(name);
    }
    std::array<double, Size> numbers{};
    std::copy(all.begin(), all.end(), numbers.begin());
    return numbers;
  }
  /// Returns the position of a word among `count` ones; `word_at(i)` is one of them.
  template <class WordAt>
  std::size_t word(std::string_view name, std::size_t count, WordAt word_at) {
    const std::string& given = text(name);
    for (std::size_t i = 0; i < count; ++i) {
      if (given == word_at(i)) {
        return i;
      }
    }
    refuse(name);
  }

  [[noreturn]] void refuse(std::string_view name) const {
    throw Error(where_, "its part '" + std::string(name) + "' is missing or damaged", "save the object again");
  }

 private:
  StateValue& any(std::string_view name) {
    const auto found = state_.find(name);
    if (found == state_.end()) {
      refuse(name);
    }
    return found->second;
  }
  template <class Value>
  Value& value(std::string_view name) {
    auto* const found = std::get_if<Value>(&any(name));
    if (found == nullptr) {
      refuse(name);
    }
    return *found;
  }

  std::string where_;
  State state_;
};

}  // namespace chainmail::api
