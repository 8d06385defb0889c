#include "files/session/object_json.h"

#include <algorithm>

#include "files/text/described_json.h"
#include "files/text/text.h"

namespace chainmail {

ObjectFields ObjectFields::at(const std::string& part) const {
  ObjectFields fields = *this;
  fields.say_at(where() + ": " + part);
  return fields;
}

void ObjectFields::check_element(std::uint64_t id, std::uint64_t count, const std::string& key) const {
  if (id >= count) {
    fail("'" + key + "' names element " + std::to_string(id) + ", which does not exist",
         "ids run from 0 to " + std::to_string(count - 1));
  }
}

const PackedArray& ObjectFields::elements(const Json& object, const std::string& key, std::uint64_t count,
                                          std::initializer_list<std::size_t> widths) const {
  const PackedArray& array = packed(object, key, widths);
  const auto beyond = std::ranges::find_if(array.ids, [count](ElementId id) { return id >= count; });
  if (beyond != array.ids.end()) {
    check_element(*beyond, count, key);
  }
  return array;
}

LinkId ObjectFields::link(const Mesh& mesh, ElementId a, ElementId b) const {
  const auto found = find_link(mesh, a, b);
  if (!found) {
    fail("the elements " + std::to_string(a) + " and " + std::to_string(b) + " are not linked",
         "give the two ends of a link");
  }
  return *found;
}

Algorithm ObjectFields::algorithm(const Json& name) const {
  const auto found = name.is_string() ? find_algorithm(name.get<std::string>()) : std::nullopt;
  if (!found) {
    fail("the algorithm " + text_of(name) + " is not known", "use one that 'chainmail deform --help' lists");
  }
  return *found;
}

Softness ObjectFields::softness(const Json& object, const Mesh& mesh, EnergyKind energy,
                                std::optional<RegionAxes>& principal) const {
  Softness result{read_members<LinkSoftness>(*this, object), {}, energy, axes(object, mesh, principal)};
  if (object.contains("energy")) {
    result.energy = here([&] { return energy_kind_of(text(object, "energy")); });
  }
  return result;
}

RegionAxes ObjectFields::axes(const Json& object, const Mesh& mesh, std::optional<RegionAxes>& principal) const {
  if (!object.contains("frame")) {
    return {};
  }
  const Json& axes = this->object(object, "frame");
  check_keys(axes, {"kind", "rotation"});
  const auto kind = AxesKind(choice(member(axes, "kind"), "kind", axes_kinds));
  if (kind == AxesKind::axes) {
    return {};
  }
  if (kind == AxesKind::object && !axes.contains("rotation")) {
    if (!principal) {
      principal = principal_axes(mesh).axes;
    }
    return *principal;
  }
  RegionAxes result(kind, point(axes, "rotation"));
  here([&] { check(result, mesh); });
  return result;
}

void ObjectFields::add_own(OwnSoftness& all, const Mesh& mesh, std::span<const ElementId> ends,
                           std::span<const double> numbers) const {
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    const LinkId link = this->link(mesh, ends[i], ends[i + 1]);
    if (all.contains(link)) {
      fail("the link " + std::to_string(ends[i]) + "-" + std::to_string(ends[i + 1]) + " is given twice",
           "remove one of them");
    }
    LinkSoftness own;
    const std::size_t in_row = 2 * numbers.size() / ends.size();
    for (std::size_t k = 0; k < in_row; ++k) {
      own.*softness_numbers[k].value = numbers[i / 2 * in_row + k];
    }
    here([&] { check(own); });
    all.set(link, own);
  }
}

std::vector<std::string> softness_keys(const std::vector<std::string>& others) {
  std::vector<std::string> keys = keys_of<LinkSoftness>();
  keys.insert(keys.end(), {"energy", "frame"});
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

void add_softness(nlohmann::ordered_json& object, const Softness& softness) {
  add_members(object, softness.global);
  object["energy"] = info(softness.energy).name;
  if (const RegionAxes& axes = softness.axes; axes.kind() != AxesKind::axes) {
    const Point& turn = axes.rotation();
    object["frame"] = {{"kind", axes_kinds[std::size_t(axes.kind())]}, {"rotation", {turn.x(), turn.y(), turn.z()}}};
  }
}

}  // namespace chainmail
