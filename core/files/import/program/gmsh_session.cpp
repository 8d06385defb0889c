#include "files/import/program/gmsh_session.h"

#include <gmsh.h>

#include <algorithm>
#include <string_view>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::import {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);  // without the user's own options
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::logger::start();
}

void GmshSession::open(const std::filesystem::path& path) const {
  const auto fail = [&path] {
    std::string why = gmsh_complaint();
    const std::string copy = path.string();  // the user knows the file by another name
    for (std::size_t at = 0; (at = why.find(copy)) != std::string::npos;) {
      why.replace(at, copy.size(), "the file");
    }
    throw Error("", "Gmsh cannot read it (" + why + ")", "export it again, or in another format");
  };
  try {
    gmsh::open(path.string());
  } catch (...) {  // Gmsh throws numbers, strings and exceptions
    fail();
  }
  if (gmsh_complaint() != "it does not say why") {
    fail();
  }
}

std::string gmsh_complaint() {
  static constexpr std::string_view error = "Error: ";
  static constexpr std::size_t longest = 150;
  std::vector<std::string> messages;
  gmsh::logger::get(messages);
  const auto found = std::find_if(messages.begin(), messages.end(), [](auto& one) { return one.starts_with(error); });
  return found == messages.end() ? "it does not say why" : printable(found->substr(error.size(), longest));
}

}  // namespace chainmail::import
