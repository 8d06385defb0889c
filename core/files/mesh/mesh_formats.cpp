#include "files/mesh/mesh_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::array formats{
    MeshFormatInfo{MeshFormat::obj, "Wavefront OBJ", ".obj", true, true, true, "surfaces and lines"},
    MeshFormatInfo{MeshFormat::ply, "Stanford PLY", ".ply", true, true, true, "surfaces; links along no face as edges"},
    MeshFormatInfo{MeshFormat::vtu, "ParaView", ".vtu", false, true, true,
                   "all cells, with displacement and violation as fields"},
    MeshFormatInfo{MeshFormat::msh, "Gmsh", ".msh", true, true, true,
                   "lines, triangles, quadrangles, tetrahedra and hexahedra"},
    MeshFormatInfo{MeshFormat::vtk, "legacy VTK", ".vtk", true, false, true, "lines, surfaces and volumes"},
    MeshFormatInfo{MeshFormat::medit, "Medit", ".mesh", true, false, true, "lines, surfaces and volumes"},
    MeshFormatInfo{MeshFormat::off, "OFF", ".off", true, false, true, "surfaces"},
    MeshFormatInfo{MeshFormat::stl, "STL", ".stl", true, false, true, "surfaces, triangle by triangle"},
    MeshFormatInfo{MeshFormat::tetgen, "TetGen", ".node .ele", true, false, true, "tetrahedra, in a pair of files"},
    MeshFormatInfo{MeshFormat::nrrd, "NRRD", ".nrrd .nhdr", true, false, true, "volumes of voxels"},
    MeshFormatInfo{MeshFormat::metaimage, "MetaImage", ".mha .mhd", true, false, true, "volumes of voxels"},
    MeshFormatInfo{MeshFormat::dat, "Links of a lattice", ".dat", true, true, false,
                   "the links of a line, a grid or a block, as in Dean's thesis"},
    MeshFormatInfo{MeshFormat::csv, "Table of positions", ".csv", false, true, true, "a row id,x,y,z an element"},
};

/// Calls visit(ending) for each of a format's endings.
template <class Visit>
void for_each_ending(const MeshFormatInfo& format, Visit visit) {
  std::string_view rest = format.endings;
  for (std::string_view ending = take_word(rest); !ending.empty(); ending = take_word(rest)) {
    visit(ending);
  }
}

bool has_ending(const MeshFormatInfo& format, std::string_view wanted) {
  bool found = false;
  for_each_ending(format, [&](std::string_view ending) { found |= ending == wanted; });
  return found;
}

std::string small_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Why a file of this ending is not for this use.
std::string refusal(const std::string& ending, const MeshFormatInfo* format, FormatUse use) {
  if (ending.empty()) {
    return "its name has no ending";
  }
  if (format == nullptr) {
    return "the ending " + printable(ending) + " is not known";
  }
  return "a " + ending + " file " +
         (use == FormatUse::read ? "is written, not opened"
          : format->writes       ? "holds no positions"
                                 : "is opened, not written");
}

}  // namespace

std::span<const MeshFormatInfo> mesh_formats() { return formats; }

const MeshFormatInfo& info(MeshFormat format) {
  return *std::find_if(formats.begin(), formats.end(), [&](const auto& one) { return one.format == format; });
}

std::string mesh_endings(FormatUse use, std::string_view last) {
  std::vector<std::string_view> endings;
  for (const MeshFormatInfo& format : formats) {
    if (format.allows(use)) {
      for_each_ending(format, [&](std::string_view ending) { endings.push_back(ending); });
    }
  }
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i) {
    text += i == 0 ? "" : i + 1 == endings.size() ? " " + std::string(last) + " " : ", ";
    text += endings[i];
  }
  return text;
}

std::string mesh_formats_help(FormatUse use) {
  std::string text;
  for (const MeshFormatInfo& format : formats) {
    if (format.allows(use)) {
      text +=
          "  " + std::string(format.endings) + ", " + std::string(format.name) + ": " + std::string(format.help) + "\n";
    }
  }
  return text;
}

MeshFormat mesh_format(const std::filesystem::path& path, FormatUse use) {
  const std::string ending = small_ending(path);
  const auto found =
      std::find_if(formats.begin(), formats.end(), [&](const auto& format) { return has_ending(format, ending); });
  if (found != formats.end() && found->allows(use)) {
    return found->format;
  }
  throw Error(shown(path), refusal(ending, found == formats.end() ? nullptr : &*found, use),
              use == FormatUse::read    ? "meshes are " + mesh_endings(use)
              : use == FormatUse::write ? "meshes are written as " + mesh_endings(use)
                                        : "positions are written as " + mesh_endings(use));
}

}  // namespace chainmail
