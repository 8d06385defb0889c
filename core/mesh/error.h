#pragma once

#include <stdexcept>
#include <string>

namespace chainmail {

/// The one exception of the edges: files, arguments and values from outside.
///
/// Its text reads `WHERE: what is wrong; what to do`, in one line, where WHERE is
/// `file:line`, an option or an element.
class Error : public std::runtime_error {
 public:
  Error(const std::string& where, const std::string& problem, const std::string& remedy)
      : std::runtime_error(where + ": " + problem + "; " + remedy) {}
};

}  // namespace chainmail
