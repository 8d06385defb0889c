#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "files/formats/vtk_cells.h"
#include "files/import/program/tasks.h"
#include "files/text/limits.h"
#include "files/text/number_type.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr std::array xml_types{
    number_type<std::int8_t>("Int8"),     number_type<std::uint8_t>("UInt8"),   number_type<std::int16_t>("Int16"),
    number_type<std::uint16_t>("UInt16"), number_type<std::int32_t>("Int32"),   number_type<std::uint32_t>("UInt32"),
    number_type<std::int64_t>("Int64"),   number_type<std::uint64_t>("UInt64"), number_type<float>("Float32"),
    number_type<double>("Float64"),
};

[[noreturn]] void refuse_damaged(const std::string& what) { refuse(what, "export it again"); }

const NumberType& type_named(std::string_view name) {
  const NumberType* type = find_number_type(xml_types, name);
  if (type == nullptr) {
    refuse("numbers of type " + in_quotes(name) + " are not known", "save it with Float64 and Int64");
  }
  return *type;
}

/// Decodes base64, also of several texts that follow each other, each with its own padding.
std::string decoded(std::string_view text) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> value{};
  value.fill(-1);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    value[static_cast<unsigned char>(digits[i])] = int(i);
  }
  std::string bytes;
  std::uint32_t group = 0;
  int count = 0, padding = 0;
  for (const char character : text) {
    const int digit = value[static_cast<unsigned char>(character)];
    if (digit < 0 && character != '=') {
      continue;  // blanks and line ends
    }
    padding += character == '=' ? 1 : 0;
    group = group << 6U | std::uint32_t(std::max(digit, 0));
    if (++count == 4) {
      for (int i = 0; i < 3 - std::min(padding, 2); ++i) {
        bytes.push_back(static_cast<char>(group >> (16U - 8U * unsigned(i))));
      }
      group = 0;
      count = padding = 0;
    }
  }
  return bytes;
}

/// A file of VTK's XML formats (Schroeder, Martin and Lorensen 2006).
class VtkXml {
 public:
  explicit VtkXml(std::string bytes) : bytes_(std::move(bytes)) { parse(); }

  ImportedMesh read() {
    ImportedMesh mesh;
    const std::string_view type = root_.attribute("type").value();
    if (type != "UnstructuredGrid" && type != "PolyData") {
      refuse("a dataset " + in_quotes(type) + " is not supported", "save it as an unstructured grid");
    }
    for (const pugi::xml_node piece : root_.child(root_.attribute("type").value()).children("Piece")) {
      read_piece(piece, mesh);
    }
    return mesh;
  }

 private:
  void parse();
  void read_piece(pugi::xml_node piece, ImportedMesh& mesh);
  void read_points(pugi::xml_node piece, ImportedMesh& mesh);
  CellRows read_rows(pugi::xml_node cells, std::uint64_t first_point) const;
  std::vector<double> numbers(pugi::xml_node array) const;
  std::vector<double> text_numbers(std::string_view text) const;
  std::vector<double> binary_numbers(pugi::xml_node array, const NumberType& type) const;
  std::string plain_bytes(std::string_view bytes) const;
  std::string unpacked(std::string_view bytes, const NumberType& size) const;
  std::uint64_t size_at(std::string_view bytes, std::size_t index) const;

  std::string bytes_;
  std::string_view appended_;  // behind the underscore
  bool is_appended_raw_ = false, is_packed_ = false, big_endian_ = false;
  const NumberType* size_type_ = nullptr;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

/// Raw bytes at the end of a file are no XML, so what is before them is parsed without them.
void VtkXml::parse() {
  const std::string_view all = bytes_;
  const std::size_t behind = std::min(all.find("<AppendedData"), all.size());
  std::string text(all.substr(0, behind));
  if (behind < all.size()) {
    const std::size_t open = all.find('>', behind), begin = all.find('_', std::min(open, all.size()));
    if (begin == std::string_view::npos) {
      refuse_damaged("its appended data do not begin");
    }
    appended_ = all.substr(begin + 1);
    is_appended_raw_ = all.substr(behind, open - behind).find("raw") != std::string_view::npos;
    text += "</VTKFile>";
  }
  if (const auto result = document_.load_buffer(text.data(), text.size()); !result) {
    const auto line = 1 + std::count(text.begin(), text.begin() + result.offset, '\n');
    refuse_damaged("its XML is damaged at line " + std::to_string(line) + " (" + printable(result.description()) + ")");
  }
  root_ = document_.child("VTKFile");
  const std::string_view compressor = root_.attribute("compressor").value();
  if (!root_ || (!compressor.empty() && compressor != "vtkZLibDataCompressor")) {
    refuse(root_ ? "its data are compressed by " + in_quotes(compressor) : "it is not a file of VTK",
           "save it uncompressed, or compressed by zlib");
  }
  is_packed_ = !compressor.empty();
  big_endian_ = std::string_view(root_.attribute("byte_order").value()) == "BigEndian";
  size_type_ = &type_named(root_.attribute("header_type").as_string("UInt32"));
}

void VtkXml::read_piece(pugi::xml_node piece, ImportedMesh& mesh) {
  const std::uint64_t first = mesh.parts.rest.size();
  read_points(piece, mesh);
  VtkCells into(mesh);
  if (const auto cells = piece.child("Cells")) {
    const CellRows rows = read_rows(cells, first);
    const auto types = numbers(cells.find_child_by_attribute("DataArray", "Name", "types"));
    if (types.size() != rows.count()) {
      refuse_damaged("there are " + std::to_string(types.size()) + " types for " + std::to_string(rows.count()) +
                     " cells");
    }
    for (std::size_t i = 0; i < rows.count(); ++i) {
      into.add(rows[i], int(std::clamp(types[i], 0.0, 1000.0)));
    }
  }
  static constexpr std::array<std::pair<const char*, int>, 3> kinds{
      {{"Lines", VtkCells::lines}, {"Strips", VtkCells::strip}, {"Polys", VtkCells::polygon}}};
  for (const auto& [name, type] : kinds) {
    if (const auto cells = piece.child(name)) {
      const CellRows rows = read_rows(cells, first);
      for (std::size_t i = 0; i < rows.count(); ++i) {
        into.add(rows[i], type);
      }
    }
  }
}

void VtkXml::read_points(pugi::xml_node piece, ImportedMesh& mesh) {
  const auto places = numbers(piece.child("Points").child("DataArray"));
  if (places.size() % 3 != 0 || mesh.parts.rest.size() + places.size() / 3 > element_limit) {
    refuse("its points have not 3 coordinates each, or are more than " + std::to_string(element_limit),
           "use a smaller mesh, or export it again");
  }
  for (std::size_t i = 0; i < places.size(); i += 3) {
    mesh.parts.rest.emplace_back(places[i], places[i + 1], places[i + 2]);
  }
}

CellRows VtkXml::read_rows(pugi::xml_node cells, std::uint64_t first_point) const {
  const auto whole = [](double number) {
    if (!(number >= 0 && number <= 1e15)) {
      refuse_damaged("a number of its cells is not a whole number from 0");
    }
    return static_cast<std::uint64_t>(number);
  };
  CellRows rows;
  for (const double id : numbers(cells.find_child_by_attribute("DataArray", "Name", "connectivity"))) {
    rows.ids.push_back(first_point + whole(id));
  }
  for (const double end : numbers(cells.find_child_by_attribute("DataArray", "Name", "offsets"))) {
    rows.first.push_back(whole(end));
  }
  if (!std::is_sorted(rows.first.begin(), rows.first.end()) || rows.first.back() != rows.ids.size()) {
    refuse_damaged("its offsets do not match its corners");
  }
  return rows;
}

std::vector<double> VtkXml::numbers(pugi::xml_node array) const {
  if (!array) {
    return {};
  }
  const std::string_view format = array.attribute("format").as_string("ascii");
  return format == "ascii" ? text_numbers(array.text().get())
                           : binary_numbers(array, type_named(array.attribute("type").value()));
}

std::vector<double> VtkXml::text_numbers(std::string_view text) const {
  std::vector<double> result;
  Lines lines(text);
  while (lines.next()) {
    std::string_view rest = lines.line();
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const auto number = parse_number(word);
      if (!number) {
        refuse(in_quotes(word) + " is not a number", number_remedy(word));
      }
      result.push_back(*number);
    }
  }
  return result;
}

std::vector<double> VtkXml::binary_numbers(pugi::xml_node array, const NumberType& type) const {
  const bool is_appended = std::string_view(array.attribute("format").value()) == "appended";
  std::string_view source = is_appended ? appended_ : std::string_view(array.text().get());
  if (is_appended) {
    source.remove_prefix(std::min<std::size_t>(array.attribute("offset").as_ullong(), source.size()));
  }
  const std::string bytes = is_appended && is_appended_raw_ ? plain_bytes(source) : plain_bytes(decoded(source));
  std::vector<double> result(bytes.size() / type.bytes);
  type.read(bytes.data(), big_endian_, result);
  return result;
}

std::uint64_t VtkXml::size_at(std::string_view bytes, std::size_t index) const {
  if (bytes.size() / size_type_->bytes <= index) {
    refuse_damaged("its data end too early");
  }
  return static_cast<std::uint64_t>(size_type_->read(bytes.data() + index * size_type_->bytes, big_endian_));
}

/// Returns the data behind their sizes.
std::string VtkXml::plain_bytes(std::string_view bytes) const {
  if (is_packed_) {
    return unpacked(bytes, *size_type_);
  }
  const std::uint64_t size = size_at(bytes, 0);
  if (size > bytes.size() - size_type_->bytes) {
    refuse_damaged("its data end too early");
  }
  return std::string(bytes.substr(size_type_->bytes, size));
}

/// The sizes are the number of blocks, their size unpacked, that of the last one if it is smaller, and the size of each
/// one packed.
std::string VtkXml::unpacked(std::string_view bytes, const NumberType& size) const {
  const std::uint64_t blocks = size_at(bytes, 0), full = blocks > 0 ? size_at(bytes, 1) : 0,
                      partial = blocks > 0 ? size_at(bytes, 2) : 0, last = partial > 0 ? partial : full;
  const std::uint64_t most = limits::compression_ratio * bytes.size();  // of all blocks together
  if (blocks > 0 && (blocks > bytes.size() || last > most || (blocks > 1 && full > (most - last) / (blocks - 1)))) {
    refuse_damaged("its data are compressed too much, or damaged");
  }
  std::string result;
  std::size_t at = size.bytes * (blocks > 0 ? 3 + blocks : 1);
  for (std::uint64_t block = 0; block < blocks; ++block) {
    const std::uint64_t packed = size_at(bytes, 3 + block);
    const std::uint64_t wanted = block + 1 == blocks ? last : full;
    if (at > bytes.size() || packed > bytes.size() - at) {
      refuse_damaged("its data end too early");
    }
    const std::size_t before = result.size();
    result.resize(before + wanted);
    uLongf got = wanted;
    if (uncompress(reinterpret_cast<Bytef*>(result.data() + before), &got,
                   reinterpret_cast<const Bytef*>(bytes.data() + at), packed) != Z_OK ||
        got != wanted) {
      refuse_damaged("its compressed data are damaged");
    }
    at += packed;
  }
  return result;
}

}  // namespace

ImportedMesh read_vtk_xml(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return VtkXml(std::string(std::istreambuf_iterator<char>(file), {})).read();
}

}  // namespace chainmail::import
