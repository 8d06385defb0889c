#include "files/mesh/mesh_formats.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "files/formats/dat.h"
#include "files/formats/medit.h"
#include "files/formats/metaimage.h"
#include "files/formats/msh.h"
#include "files/formats/obj.h"
#include "files/formats/off.h"
#include "files/formats/ply.h"
#include "files/formats/positions_csv.h"
#include "files/formats/stl.h"
#include "files/formats/tetgen.h"
#include "files/formats/vtk.h"
#include "files/formats/vtu.h"
#include "files/import/import_file.h"
#include "files/text/text.h"
#include "mesh/error.h"
#include "mesh/extra_row.h"

namespace chainmail {
namespace {

namespace fs = std::filesystem;

/// Reads a whole file, and its content with the reader of a format. Binary files need read_bytes.
template <auto Read, std::string (*Take)(RegularFile, const std::string&, const Progress&) = read_text>
ImportedMesh read_file(RegularFile file, const ReadOptions& /*options*/, const Progress& progress) {
  const fs::path path = file.path();
  return Read(Take(std::move(file), "a mesh", progress.part(0, 0.1)), path, progress.part(0.1, 1));
}

ImportedMesh read_dat_file(RegularFile file, const ReadOptions& options, const Progress& progress) {
  const fs::path path = file.path();
  return read_dat(read_text(std::move(file), "a mesh", progress.part(0, 0.1)), path, options, progress.part(0.1, 1));
}

constexpr std::array formats{
    MeshFormat{.name = "Wavefront OBJ",
               .endings = ".obj",
               .help = "surfaces and lines",
               .signs = {"v ", "o ", "g ", "mtllib ", "vn "},
               .read_mesh = read_file<read_obj>,
               .write = write_obj,
               .holds = MeshFormat::Holds::faces_and_links},
    MeshFormat{.name = "Stanford PLY",
               .endings = ".ply",
               .help = "surfaces; links along no face as edges",
               .signs = {"ply\n", "ply\r"},
               .read_mesh = read_file<read_ply, read_bytes>,
               .write = write_ply,
               .holds = MeshFormat::Holds::faces_and_links},
    MeshFormat{.name = "VTK XML",
               .endings = ".vtu .vtp",
               .help = "all cells; written with displacement and violation as fields, for ParaView",
               .signs = {"<VTKFile"},
               .read_mesh =
                   [](RegularFile file, const ReadOptions& options, const Progress& progress) {
                     return import_mesh("vtu", std::move(file), 1, progress, options.import_program);
                   },
               .write = write_vtu},
    MeshFormat{.name = "Gmsh",
               .endings = ".msh",
               .help = "lines, triangles, quadrangles, tetrahedra and hexahedra",
               .signs = {"$MeshFormat", "$NOD"},
               .read_mesh =
                   [](RegularFile file, const ReadOptions& options, const Progress& progress) {
                     return import_mesh("msh", std::move(file), 2, progress, options.import_program);
                   },
               .write = write_msh},
    MeshFormat{.name = "legacy VTK",
               .endings = ".vtk",
               .help = "lines, surfaces and volumes",
               .signs = {"# vtk DataFile"},
               .read_mesh = read_file<read_vtk, read_bytes>},
    MeshFormat{.name = "Medit",
               .endings = ".mesh",
               .help = "lines, surfaces and volumes",
               .signs = {"MeshVersionFormatted"},
               .read_mesh = read_file<read_medit>},
    MeshFormat{.name = "OFF",
               .endings = ".off",
               .help = "surfaces",
               .signs = {"OFF", "COFF", "NOFF", "CNOFF", "NCOFF", "STOFF", "nOFF"},
               .read_mesh = read_file<read_off>},
    MeshFormat{.name = "STL",
               .endings = ".stl",
               .help = "surfaces, triangle by triangle",
               .signs = {"solid "},
               .read_mesh = read_file<read_stl, read_bytes>,
               .write = write_stl,
               .holds = MeshFormat::Holds::faces},
    MeshFormat{.name = "TetGen",
               .endings = ".node .ele",
               .help = "tetrahedra, in a pair of files",
               .read_mesh = [](RegularFile file, const ReadOptions& /*options*/,
                               const Progress& progress) { return read_tetgen(std::move(file), progress); }},
    MeshFormat{.name = "NRRD",
               .endings = ".nrrd .nhdr",
               .help = "volumes of voxels",
               .signs = {"NRRD000"},
               .read_volume =
                   [](RegularFile file, const ReadOptions& options, const Progress& progress) {
                     return import_nrrd(std::move(file), options.data_outside, progress, options.import_program);
                   }},
    MeshFormat{.name = "MetaImage",
               .endings = ".mha .mhd",
               .help = "volumes of voxels",
               .signs = {"ObjectType", "NDims"},
               .read_volume =
                   [](RegularFile file, const ReadOptions& options, const Progress& progress) {
                     return read_metaimage(std::move(file), options.data_outside, progress);
                   }},
    MeshFormat{.name = "Links of a lattice",
               .endings = ".dat",
               .help = "the links of a line, a grid or a block, as in Dean's thesis",
               .read_mesh = read_dat_file,
               .write = write_dat,
               .holds_positions = false},
    MeshFormat{.name = "Table of positions",
               .endings = ".csv",
               .help = "one row id,x,y,z per element",
               .write = write_positions_csv},
};

std::vector<MeshFormat>& format_table() {
  static std::vector<MeshFormat> table(formats.begin(), formats.end());
  return table;
}

/// Calls visit(ending) for each ending of a format.
template <class Visit>
void for_each_ending(const MeshFormat& format, Visit visit) {
  std::string_view rest = format.endings;
  for (std::string_view ending = take_word(rest); !ending.empty(); ending = take_word(rest)) {
    visit(ending);
  }
}

const MeshFormat* find_by_ending(std::string_view wanted) {
  const auto has_ending = [wanted](const MeshFormat& format) {
    bool found = false;
    for_each_ending(format, [&](std::string_view ending) { found |= ending == wanted; });
    return found;
  };
  const auto all = mesh_formats();
  const auto found = std::ranges::find_if(all, has_ending);
  return found == all.end() ? nullptr : &*found;
}

/// Returns the reason why a file with this ending does not have this use. `format` is the format of the ending; null if
/// there is none.
std::string refusal(const std::string& ending, const MeshFormat* format, FormatUse use) {
  if (ending.empty()) {
    return "its name has no ending";
  }
  if (format == nullptr) {
    return "the ending " + printable(ending) + " is not known";
  }
  return "a " + ending + " file " +
         (use == FormatUse::read ? "can be written but not opened"
          : format->writes()     ? "contains no positions"
                                 : "can be opened but not written");
}

}  // namespace

std::span<const MeshFormat> mesh_formats() { return format_table(); }

/// For ExtraRow, in tests.
template <>
std::vector<MeshFormat>& table_of() {
  return format_table();
}

std::string mesh_endings(FormatUse use, std::string_view last) {
  std::vector<std::string_view> endings;
  for (const MeshFormat& format : mesh_formats()) {
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
  for (const MeshFormat& format : mesh_formats()) {
    if (format.allows(use)) {
      text +=
          "  " + std::string(format.endings) + ", " + std::string(format.name) + ": " + std::string(format.help) + "\n";
    }
  }
  return text;
}

void check_holds(const MeshFormat& format, const Mesh& mesh, const fs::path& path) {
  if (!format.holds_positions && !mesh.lattice) {
    throw Error(shown(path), "a .dat file can only store lattices, and this mesh has none", "save it as .obj");
  }
  const bool has_faces = !mesh.triangles.empty() || mesh.has_cells();
  if (format.holds == MeshFormat::Holds::faces && !has_faces) {
    throw Error(shown(path), "a .stl file has only faces, and this mesh has none", "save it as .obj");
  }
}

std::string lost_in(const MeshFormat& format, const Mesh& mesh) {
  const std::string name(format.name);
  switch (format.holds) {
    case MeshFormat::Holds::all:
      return {};
    case MeshFormat::Holds::faces_and_links:
      return mesh.has_cells() ? name + " has no cells: it gets their outer faces, and the links inside as lines" : "";
    case MeshFormat::Holds::faces:
      return name + (mesh.has_cells() ? " has neither cells nor links: it gets the outer faces of the cells"
                                      : " has no links: it gets the faces, divided into triangles");
  }
  return {};
}

const MeshFormat& mesh_format(const fs::path& path, FormatUse use) {
  const std::string ending = lower_case(path.extension().string());
  const MeshFormat* format = find_by_ending(ending);
  if (format != nullptr && format->allows(use)) {
    return *format;
  }
  throw Error(shown(path), refusal(ending, format, use),
              use == FormatUse::read    ? "open a mesh in one of these formats: " + mesh_endings(use)
              : use == FormatUse::write ? "write the mesh in one of these formats: " + mesh_endings(use)
                                        : "write positions in one of these formats: " + mesh_endings(use));
}

}  // namespace chainmail
