#include "files/mesh/detect.h"

#include <algorithm>
#include <array>
#include <string>

#include "files/text/regular_file.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t looked_at = 512;  // bytes

/// How a file of a format begins, behind blank lines and comments.
struct Sign {
  std::string_view begins;
  MeshFormat format;
};

constexpr std::array signs{
    Sign{"ply\n", MeshFormat::ply},
    Sign{"ply\r", MeshFormat::ply},
    Sign{"OFF", MeshFormat::off},
    Sign{"COFF", MeshFormat::off},
    Sign{"NOFF", MeshFormat::off},
    Sign{"CNOFF", MeshFormat::off},
    Sign{"STOFF", MeshFormat::off},
    Sign{"solid ", MeshFormat::stl},
    Sign{"$MeshFormat", MeshFormat::msh},
    Sign{"$NOD", MeshFormat::msh},
    Sign{"MeshVersionFormatted", MeshFormat::medit},
    Sign{"NRRD000", MeshFormat::nrrd},
    Sign{"ObjectType", MeshFormat::metaimage},
    Sign{"NDims", MeshFormat::metaimage},
};
constexpr std::string_view vtk_comment = "# vtk DataFile";

}  // namespace

std::optional<MeshFormat> format_in(std::string_view beginning) {
  if (beginning.starts_with(vtk_comment)) {
    return MeshFormat::vtk;
  }
  for (;;) {
    beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
    if (!beginning.starts_with('#')) {
      break;
    }
    beginning.remove_prefix(std::min(beginning.find('\n'), beginning.size()));
  }
  const auto found =
      std::find_if(signs.begin(), signs.end(), [&](const Sign& sign) { return beginning.starts_with(sign.begins); });
  return found == signs.end() ? std::nullopt : std::optional(found->format);
}

MeshFormat detect_format(const std::filesystem::path& path) {
  std::array<char, looked_at> beginning{};
  const std::size_t got = RegularFile(path).read(beginning);
  if (got == 0) {
    throw Error(shown(path), "it is empty", "give a file that holds a mesh");
  }
  const auto found = format_in({beginning.data(), got});
  return found ? *found : mesh_format(path);
}

}  // namespace chainmail
