#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace chainmail {

/// The one exception of the edges: files, arguments and values from outside.
///
/// Its text reads `WHERE: what is wrong; what to do`, in one line, where WHERE is
/// `file:line`, an option or an element.
class Error : public std::runtime_error {
 public:
  Error(const std::string& where, const std::string& problem, const std::string& remedy)
      : std::runtime_error(where + ": " + problem + "; " + remedy), where_(where), rest_(problem, remedy) {}

  const std::string& where() const { return where_; }
  const std::string& problem() const { return rest_.first; }
  const std::string& remedy() const { return rest_.second; }
  /// The same error, said of another place.
  Error at(const std::string& where) const { return {where, rest_.first, rest_.second}; }

 private:
  std::string where_;
  std::pair<std::string, std::string> rest_;  // what is wrong, what to do
};

}  // namespace chainmail
