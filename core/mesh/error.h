#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace chainmail {

/// The one exception for errors from outside: files, arguments and values.
class Error : public std::runtime_error {
 public:
  Error(const std::string& where, const std::string& problem, const std::string& remedy)
      : std::runtime_error(where + ": " + problem + "; " + remedy), where_(where), rest_(problem, remedy) {}

  const std::string& where() const { return where_; }
  const std::string& problem() const { return rest_.first; }
  const std::string& remedy() const { return rest_.second; }
  /// Returns the same error with another WHERE.
  Error at(const std::string& where) const { return {where, rest_.first, rest_.second}; }

 private:
  std::string where_;
  std::pair<std::string, std::string> rest_;  // the problem and the remedy
};

/// Returns one sentence about the exception that is being handled: where, what is wrong, and what to do. Call it in a
/// catch block. An Error brings its own text; for anything else, `where` names what failed. Never throws: if there is
/// no memory for the sentence, it returns a few words.
std::string failure_sentence(std::string_view where) noexcept;

}  // namespace chainmail
