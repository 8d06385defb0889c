#include "files/import/handover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "files/text/text.h"

namespace chainmail {
namespace {

constexpr std::uint64_t mark = 0x31'6c'69'61'6d'63'6e'69;  // "incmail1": no other output begins like this
constexpr std::size_t longest_text = 10'000;

class Encoder {
 public:
  explicit Encoder(std::uint64_t kind) {
    put(mark);
    put(kind);
  }

  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put_all(std::span(&value, 1));
  }
  template <class Range>
  void put_all(const Range& range) {
    const auto bytes = std::as_bytes(std::span(range));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  template <class... Vectors>
  void put_sizes(const Vectors&... vectors) {
    (put(std::uint64_t{vectors.size()}), ...);
  }

  void put_text(const std::string& text) {
    put(std::uint64_t{std::min(text.size(), longest_text)});
    put_all(std::span(text).first(std::min(text.size(), longest_text)));
  }

  void operator()(const ImportedMesh& mesh) {
    const MeshParts& parts = mesh.parts;
    put(mesh.unused);
    put(mesh.divided);
    put_sizes(parts.rest, parts.links, parts.triangles, parts.polygons, parts.tetrahedra, parts.hexahedra);
    for (const Point& point : parts.rest) {
      put(std::array{point.x(), point.y(), point.z()});
    }
    put_all(parts.links);
    put_all(parts.triangles);
    put_all(parts.polygons);
    put_all(parts.tetrahedra);
    put_all(parts.hexahedra);
  }
  void operator()(const Volume& volume) {
    put(volume.size);
    put(volume.merged);
    for (const Point& point : {volume.spacing, volume.origin, Point(volume.lowest, volume.step, 0)}) {
      put(std::array{point.x(), point.y(), point.z()});
    }
    put_all(std::span(volume.axes.data(), 9));
    put_all(volume.densities);
  }
  void operator()(const Refusal& refusal) {
    put_text(refusal.problem);
    put_text(refusal.remedy);
  }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Decoder {
 public:
  Decoder(std::span<const std::byte> bytes, const std::filesystem::path& path) : rest_(bytes), path_(path) {}

  Imported decode() {
    if (take<std::uint64_t>() != mark) {
      damaged();
    }
    const auto kind = take<std::uint64_t>();
    Imported imported = kind == 0 ? Imported(take_mesh()) : kind == 1 ? Imported(take_volume()) : take_refusal(kind);
    if (!rest_.empty()) {
      damaged();
    }
    return imported;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw Error(shown(path_), problem, remedy);
  }
  [[noreturn]] void damaged() const { throw damaged_answer(path_); }

  template <class Value>
  Value take() {
    Value value;
    if (rest_.size() < sizeof(Value)) {
      damaged();
    }
    std::memcpy(&value, rest_.data(), sizeof(Value));
    rest_ = rest_.subspan(sizeof(Value));
    return value;
  }
  template <class Value>
  std::vector<Value> take_all(std::uint64_t count) {
    if (count > rest_.size() / sizeof(Value)) {
      damaged();
    }
    std::vector<Value> values(count);
    if (count > 0) {
      std::memcpy(values.data(), rest_.data(), count * sizeof(Value));
    }
    rest_ = rest_.subspan(count * sizeof(Value));
    return values;
  }
  template <std::size_t Size>
  std::vector<std::array<ElementId, Size>> take_groups(std::uint64_t count, std::uint64_t elements) {
    auto groups = take_all<std::array<ElementId, Size>>(count);
    for (const auto& group : groups) {
      if (std::any_of(group.begin(), group.end(), [&](ElementId e) { return e >= elements; })) {
        damaged();
      }
    }
    return groups;
  }
  Point take_point() {
    const auto [x, y, z] = take<std::array<double, 3>>();
    return {x, y, z};
  }

  ImportedMesh take_mesh();
  void take_rest(MeshParts& parts, std::uint64_t count);
  void check_polygons(const MeshParts& parts) const;
  Volume take_volume();
  Refusal take_refusal(std::uint64_t kind);
  std::string take_text();

  std::span<const std::byte> rest_;
  const std::filesystem::path& path_;
};

void Decoder::take_rest(MeshParts& parts, std::uint64_t count) {
  if (count > element_limit) {
    fail("there are more than " + std::to_string(element_limit) + " points", "use a smaller mesh");
  }
  const auto positions = take_all<std::array<double, 3>>(count);
  parts.rest.reserve(count);
  for (const auto& [x, y, z] : positions) {
    if (!(std::max({std::abs(x), std::abs(y), std::abs(z)}) <= coordinate_limit) || std::isnan(x + y + z)) {
      fail("point " + std::to_string(parts.rest.size()) + " has a coordinate that is not a number, or is beyond 1e100",
           "give finite coordinates");
    }
    parts.rest.emplace_back(x, y, z);
  }
}

void Decoder::check_polygons(const MeshParts& parts) const {
  const auto& all = parts.polygons;
  for (std::size_t i = 0; i < all.size(); i += all[i] + 1) {
    const bool fits = all[i] >= 3 && all[i] < all.size() - i;
    if (!fits || std::any_of(&all[i] + 1, &all[i] + 1 + all[i], [&](auto e) { return e >= parts.rest.size(); })) {
      damaged();
    }
  }
}

ImportedMesh Decoder::take_mesh() {
  ImportedMesh mesh;
  mesh.unused = take<std::uint64_t>();
  mesh.divided = take<std::uint64_t>();
  const auto [points, links, triangles, polygons, tetrahedra, hexahedra] = take<std::array<std::uint64_t, 6>>();
  take_rest(mesh.parts, points);
  mesh.parts.links = take_groups<2>(links, points);
  mesh.parts.triangles = take_groups<3>(triangles, points);
  mesh.parts.polygons = take_all<ElementId>(polygons);
  check_polygons(mesh.parts);
  mesh.parts.tetrahedra = take_groups<4>(tetrahedra, points);
  mesh.parts.hexahedra = take_groups<8>(hexahedra, points);
  return mesh;
}

Volume Decoder::take_volume() {
  Volume volume;
  volume.size = take<std::array<std::uint32_t, 3>>();
  volume.merged = take<std::uint32_t>();
  volume.spacing = take_point();
  volume.origin = take_point();
  const Point range = take_point();
  for (Eigen::Index k = 0; k < 3; ++k) {
    volume.axes.col(k) = take_point();
  }
  volume.lowest = range[0];
  volume.step = range[1];
  const double voxels = double(volume.size[0]) * volume.size[1] * volume.size[2];
  const double farthest = volume.origin.cwiseAbs().maxCoeff() + 4 * volume.spacing.maxCoeff() * 4294967296.0;
  if (!(voxels >= 1 && voxels <= double(limits::voxels_in_memory)) || !volume.spacing.allFinite() ||
      !(volume.spacing.minCoeff() > 0) || !are_axes(volume.axes) || !(farthest <= coordinate_limit) ||
      !volume.origin.allFinite() || !std::isfinite(volume.lowest + volume.step * max_density_steps) ||
      !(volume.step >= 0) || volume.merged == 0 || volume.merged > limits::voxels) {
    damaged();
  }
  volume.densities = take_all<std::uint16_t>(volume.voxel_count());
  return volume;
}

Refusal Decoder::take_refusal(std::uint64_t kind) {
  if (kind != 2) {
    damaged();
  }
  Refusal refusal{take_text(), take_text()};
  if (refusal.problem.empty() || refusal.remedy.empty()) {
    damaged();
  }
  return refusal;
}

std::string Decoder::take_text() {
  const auto size = take<std::uint64_t>();
  if (size > longest_text) {
    damaged();
  }
  const auto letters = take_all<char>(size);
  return printable({letters.data(), letters.size()});
}

}  // namespace

std::vector<std::byte> encode_imported(const Imported& imported) {
  Encoder encoder(imported.index());
  std::visit(encoder, imported);
  return encoder.take();
}

Error damaged_answer(const std::filesystem::path& path) {
  return {shown(path), "the answer of the import program is damaged", "open it again, or convert it to another format"};
}

Imported decode_imported(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  return Decoder(bytes, path).decode();
}

}  // namespace chainmail
