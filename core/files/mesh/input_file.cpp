#include "files/mesh/input_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "files/formats/bare_picture.h"
#include "files/mesh/mesh_formats.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr std::size_t sign_bytes = 512;  // bytes at the beginning of a file that are read to recognise its format

/// A file that people often have in place of a mesh.
struct Foreign {
  std::string_view sign;  // in lower case, if it is text
  const char* what;
  const char* remedy;
};

constexpr auto unpack = "unpack it first", as_utf8 = "save it as UTF-8", open_page = "download the file itself",
               not_picture = "use a mesh; the workbench opens PNG and JPEG pictures as sheets";

constexpr std::array foreigners{
    Foreign{"version https://git-lfs", "it is a pointer of Git LFS, not the file itself",
            "fetch it with 'git lfs pull'"},
    Foreign{"pk\x03\x04", "it is a ZIP archive", unpack},
    Foreign{"\x1f\x8b", "it is compressed by gzip", unpack},
    Foreign{"bzh", "it is compressed by bzip2", unpack},
    Foreign{"\xfd"
            "7zxz",
            "it is compressed by xz", unpack},
    Foreign{"7z\xbc\xaf", "it is a 7-Zip archive", unpack},
    Foreign{"rar!", "it is a RAR archive", unpack},
    Foreign{"\xff\xfe", "it is text in UTF-16", as_utf8},
    Foreign{"\xfe\xff", "it is text in UTF-16", as_utf8},
    Foreign{"<!doctype html", "it is a web page", open_page},
    Foreign{"<html", "it is a web page", open_page},
    Foreign{"<?xml", "it is XML", "save it as .vtu, OBJ or PLY"},
    Foreign{"\x89png", "it is a picture", not_picture},
    Foreign{"gif8", "it is a picture", not_picture},
    Foreign{"iso-10303-21", "it is a CAD model (STEP)",
            "divide its surface into triangles first, for example with Gmsh"},
    Foreign{"gltf", "it is a binary glTF scene", "save it as OBJ, PLY or STL"},
    Foreign{"%pdf", "it is a PDF document", "use a mesh"},
};

void refuse_foreign(std::string_view beginning, const std::filesystem::path& path) {
  beginning.remove_prefix(mark_length(beginning));
  beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
  for (const Foreign& one : foreigners) {
    if (lower_case(beginning.substr(0, one.sign.size())) == one.sign) {
      throw Error(shown(path), one.what, one.remedy);
    }
  }
}

const MeshFormat* find_by_sign(std::string_view beginning) {
  const auto has_sign = [beginning](const MeshFormat& format) {
    return std::any_of(format.signs.begin(), format.signs.end(),
                       [beginning](std::string_view sign) { return !sign.empty() && beginning.starts_with(sign); });
  };
  const auto formats = mesh_formats();
  const auto found = std::ranges::find_if(formats, has_sign);
  return found == formats.end() ? nullptr : &*found;
}

/// Passes over blank lines, comments, a byte order mark and the declaration of XML.
std::string_view without_comments(std::string_view beginning) {
  beginning.remove_prefix(mark_length(beginning));
  for (;;) {
    beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
    const char end = beginning.starts_with('#')                                     ? '\n'
                     : beginning.starts_with("<?") || beginning.starts_with("<!--") ? '>'
                                                                                    : '\0';
    if (end == '\0') {
      return beginning;
    }
    beginning.remove_prefix(std::min(beginning.find_first_of(end == '\n' ? "\r\n" : ">"), beginning.size() - 1) + 1);
  }
}

/// Returns the format of a mesh or a volume that begins so.
const MeshFormat& format_of(std::string_view beginning, const std::filesystem::path& path) {
  if (beginning.empty()) {
    throw Error(shown(path), "it is empty", "use a file that contains a mesh");
  }
  const MeshFormat* by_comment = find_by_sign(beginning);
  const MeshFormat* by_sign = by_comment != nullptr ? by_comment : find_by_sign(without_comments(beginning));
  if (by_sign == nullptr) {
    refuse_foreign(beginning, path);
  }
  return by_sign != nullptr ? *by_sign : mesh_format(path);
}

}  // namespace

InputFile open_file(const std::filesystem::path& path) {
  RegularFile file(path);
  std::array<char, sign_bytes> bytes{};
  const std::string_view beginning(bytes.data(), file.read_at(0, bytes));
  const std::string ending = lower_case(path.extension().string());
  if (ending == session_ending) {
    return {std::move(file), FileKind::session};
  }
  if (std::ranges::count(picture_endings, ending) > 0 || picture_format(beginning)) {
    return {std::move(file), FileKind::picture};
  }
  const MeshFormat& format = format_of(beginning, path);
  return {std::move(file), format.read_volume != nullptr ? FileKind::volume : FileKind::mesh, &format};
}

const MeshFormat& format_of(const InputFile& input) {
  if (input.kind == FileKind::picture) {
    throw Error(shown(input.file.path()), "it is a picture", not_picture);
  }
  return input.format != nullptr ? *input.format : mesh_format(input.file.path());
}

}  // namespace chainmail
