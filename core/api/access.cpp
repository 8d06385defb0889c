#include "api/access.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "solver/algorithms.h"

namespace chainmail::api {
namespace {

[[noreturn]] void refuse_axis(const std::string& where, int axis) {
  const std::string name(1, "xyz"[axis]);
  throw Error(where, "the object does not extend along " + name,
              "leave " + name + " unchanged, or make the mesh with more space dimensions");
}

}  // namespace

Job::Job() : impl_(std::make_shared<Impl>()) {}

double Job::share() const { return impl_->state.share.load(); }

void Job::cancel() const {
  impl_->state.cancelled = true;
  impl_->stop.request_stop();
}

bool Job::is_cancelled() const { return impl_->state.cancelled; }

void refuse_without(const std::string& libraries, const std::string& where) {
  throw Error(where, "the library was built without " + libraries, "install them, and build it again");
}

std::string_view version() { return CHAINMAIL_VERSION; }

void check_id(const inner::Mesh& mesh, ElementId element) {
  guarded([&] { inner::check_element(mesh, element); });
}

void check_ids(const inner::Mesh& mesh, std::span<const ElementId> elements) {
  std::ranges::for_each(elements, [&](ElementId element) { check_id(mesh, element); });
}

void check_link_ids(const inner::Mesh& mesh, std::span<const LinkId> links) {
  guarded([&] { inner::check_links(mesh, links); });
}

void check_coordinates(const inner::Mesh& mesh, const std::string& where, const Vector3& vector, bool is_displacement) {
  const Point point = point_of(vector);
  if (!point.allFinite()) {
    throw Error(where, "a coordinate is not a finite number", "give numbers");
  }
  for (int k = 0; k < 3; ++k) {
    const bool stays = point[k] == 0 || (!is_displacement && point[k] == mesh.origin[k]);
    if (!stays && !mesh.has_axis(k)) {
      refuse_axis(where, k);
    }
  }
}

ElementBlocks every_block(const inner::Mesh& mesh) {
  ElementBlocks all(mesh.element_count());
  all.insert_all();
  return all;
}

OwnSoftness own_softness_of(std::vector<OwnSoftness::Entry> entries) {
  const auto numbers_of = [](const OwnSoftness::Entry& entry) {
    return std::bit_cast<std::array<double, inner::softness_numbers.size()>>(entry.second);
  };
  std::ranges::stable_sort(entries, {}, numbers_of);
  return OwnSoftness(entries.begin(), entries.end());
}

Algorithm algorithm_of(std::string_view name) {
  const auto algorithm = find_algorithm(name);
  if (!algorithm) {
    std::string names;
    for (const AlgorithmInfo& one : every_algorithm()) {
      names += (names.empty() ? "" : ", ") + std::string(one.offered_name());
    }
    throw Error("method '" + std::string(name.substr(0, 60)) + "'", "there is no such method", "use one of " + names);
  }
  return *algorithm;
}

std::vector<double> positions_of(const inner::Mesh& mesh, const PositionView& positions) {
  std::vector<double> all;
  all.reserve(std::size_t{3} * mesh.element_count());
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    const Point point = inner::point_of(mesh, positions, e);
    all.insert(all.end(), point.begin(), point.end());
  }
  return all;
}

std::vector<double> active_coordinates_of(const inner::Mesh& mesh, std::span<const double> positions, double limit) {
  if (positions.size() != std::size_t{3} * mesh.element_count()) {
    throw Error("positions",
                "there are " + std::to_string(positions.size()) + " numbers for " +
                    std::to_string(mesh.element_count()) + " elements",
                "give x, y and z for each element");
  }
  std::vector<double> coordinates;
  coordinates.reserve(mesh.rest.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const int k = int(i % 3);
    const std::string where = "positions, element " + std::to_string(i / 3);
    if (!(std::abs(positions[i]) <= limit)) {
      throw Error(where, "a coordinate is not finite or out of the range of the precision", "give smaller numbers");
    }
    if (mesh.has_axis(k)) {
      coordinates.push_back(positions[i]);
    } else if (positions[i] != mesh.origin[k]) {
      refuse_axis(where, k);
    }
  }
  return coordinates;
}

}  // namespace chainmail::api
