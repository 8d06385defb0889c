#include "chainmail/body.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>

#include "api/access.h"
#include "body/body_view.h"
#include "mesh/parameters.h"
#include "mesh/surface.h"

namespace chainmail::api {

// Public headers cannot include the table of parameters, so its defaults are repeated there.
static_assert(softness_of(LinkSoftness()) == inner::LinkSoftness());
static_assert(int(EnergyKind::isotropic) == int(inner::EnergyKind::isotropic) &&
              int(EnergyKind::axial) == int(inner::EnergyKind::axial) &&
              int(EnergyKind::corotated) == int(inner::EnergyKind::corotated) &&
              int(EnergyKind::material) == int(inner::EnergyKind::material));
static_assert(Elasticity().young == parameters::young.default_value &&
              Elasticity().poisson == parameters::poisson.default_value &&
              Elasticity().control_points[0] == ElasticOptions::control_points &&
              Elasticity().control_points[1] == ElasticOptions::control_points &&
              Elasticity().control_points[2] == ElasticOptions::control_points &&
              Elasticity().iterations == parameters::iterations.default_value &&
              Elasticity().gent_limit == parameters::gent_limit.default_value &&
              Elasticity().fung_exponent == parameters::fung_exponent.default_value &&
              Elasticity().thickness == parameters::thickness.default_value);
static_assert(int(StrainLaw::neo_hookean) == int(inner::StrainLaw::Kind::neo_hookean) &&
              int(StrainLaw::gent) == int(inner::StrainLaw::Kind::gent) &&
              int(StrainLaw::fung) == int(inner::StrainLaw::Kind::fung));

namespace {

inner::Snapshot snapshot_of(const inner::Body& body) {
  return body.snapshot(body.is_at_rest() ? ElementBlocks(body.mesh().element_count()) : every_block(body.mesh()));
}

constexpr std::array link_softness_values{&LinkSoftness::compression, &LinkSoftness::stretch,
                                          &LinkSoftness::shear,       &LinkSoftness::lateral,
                                          &LinkSoftness::stiffness,   &LinkSoftness::exponent};
static_assert(link_softness_values.size() == inner::softness_numbers.size());

/// Copies x, y and z of each element, from positions that are stored as they are. This takes a quarter of the time of
/// the general way.
template <class View>
void copy_stored(const View& view, const inner::Mesh& mesh, double* out) {
  for (ElementId e = 0; e < mesh.element_count(); ++e, out += 3) {
    if constexpr (View::Dimension < 3) {
      std::copy_n(mesh.origin.data(), 3, out);
    }
    for (int k = 0; k < View::Dimension; ++k) {
      out[View::Dimension == 3 ? k : mesh.axes[std::size_t(k)]] = double(view.positions[e][k]);
    }
  }
}

/// Throws Error with the number of the link.
void check_own(LinkId link, const LinkSoftness& softness) {
  try {
    inner::check(softness_of(softness));
  } catch (const inner::Error& error) {
    throw Error("link " + std::to_string(link) + ", " + error.where(), error.problem(), error.remedy());
  }
}

std::vector<LinkId> unique_links(const inner::Mesh& mesh, std::vector<LinkId> links) {
  check_link_ids(mesh, links);
  std::ranges::sort(links);
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

}  // namespace

std::span<const SoftnessNumber> softness_numbers() {
  static const auto numbers = [] {
    std::array<SoftnessNumber, link_softness_values.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const inner::Parameter& one = *inner::softness_numbers[i].parameter;
      all[i] = {one.name, one.unit, one.help, one.lowest, one.highest, link_softness_values[i]};
    }
    return all;
  }();
  return numbers;
}

const Mesh& Snapshot::mesh() const { return impl_->mesh; }

bool Snapshot::operator==(const Snapshot& other) const {
  return impl_->mesh == other.impl_->mesh && impl_->precision == other.impl_->precision &&
         impl_->snapshot == other.impl_->snapshot;
}

Body::Body(const Mesh& mesh, Precision precision) {
  guarded([&] { inner::check(precision_of(precision), *Access::pointer(mesh)); });
  impl_ = guarded([&] {
    return std::make_unique<Impl>(Impl{
        mesh,
        std::make_unique<inner::Deformer>(Access::pointer(mesh), Algorithm::natural_queue, precision_of(precision))});
  });
  Softness softness = standard_softness();
  softness.links = Access::impl(mesh).softness;
  impl_->body().set_softness(softness);
}

Body::Body(const Body& other) : Body(other.mesh(), other.precision()) {
  inner::Body& from = other.impl_->body();
  inner::Body& body = impl_->body();
  body.work_in_axes(from.works_in_axes());
  body.store_displacements(from.stores_displacements());
  body.set_softness(from.shared_softness());
  body.set_elastic(from.elastic());
  body.cut(from.cuts().links());
  body.pin({from.pins().begin(), from.pins().end()});
  if (!from.is_at_rest()) {
    body.restore(snapshot_of(from), every_block(body.mesh()));
  }
  body.reach() = from.reach();
  impl_->solver->set_last_handle(other.impl_->solver->last_handle());
  impl_->solver->hold(other.impl_->solver->held());
}
Body::Body(Body&& other) noexcept = default;
Body& Body::operator=(const Body& other) {
  Body copy(other);
  std::swap(impl_, copy.impl_);
  return *this;
}
Body& Body::operator=(Body&& other) noexcept = default;
Body::~Body() = default;

const Mesh& Body::mesh() const { return impl_->mesh; }

Precision Body::precision() const {
  return impl_->body().precision() == inner::Precision::single_precision ? Precision::single_precision
                                                                         : Precision::double_precision;
}

Vector3 Body::position(ElementId element) const {
  const inner::Body& body = impl_->body();
  check_id(body.mesh(), element);
  return vector_of(inner::point_of(body.mesh(), body.positions(), element));
}

std::vector<double> Body::positions() const { return positions_of(impl_->body().mesh(), impl_->body().positions()); }

void Body::copy_positions(std::span<double> out) const {
  const inner::Mesh& mesh = impl_->body().mesh();
  if (out.size() != std::size_t{3} * mesh.element_count()) {
    throw Error("positions", "the array has " + std::to_string(out.size()) + " numbers",
                "use one of " + std::to_string(std::size_t{3} * mesh.element_count()));
  }
  inner::Body& body = impl_->body();
  if (!body.stores_displacements() && !body.region_axes().is_turned()) {
    body.with_view([&](const auto& view) { copy_stored(view, mesh, out.data()); });
    return;
  }
  const PositionView positions = body.positions();
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    std::ranges::copy(inner::point_of(mesh, positions, e), out.begin() + std::ptrdiff_t(3) * e);
  }
}

StoredPositions Body::stored_positions() const {
  inner::Body& body = impl_->body();
  if (body.stores_displacements()) {
    throw Error("stored positions", "the body stores displacements from rest, not positions",
                "use positions(), which copies");
  }
  if (body.region_axes().is_turned()) {
    throw Error("stored positions", "the body stores coordinates along turned axes", "use positions(), which copies");
  }
  return body.with_view([&]<class View>(const View& view) {
    return StoredPositions{view.positions[0].at, precision(), View::Dimension,
                           sizeof(std::remove_reference_t<decltype(view.positions[0])>)};
  });
}

bool Body::keeps_stored_positions(std::string_view method) const {
  const inner::Body& body = impl_->body();
  const AlgorithmInfo& next = info(algorithm_of(method));
  const bool works_in_axes = next.family() == Family::chainmail;
  return inner::stores_displacements(next, body) == body.stores_displacements() &&
         (works_in_axes == body.works_in_axes() || !body.softness().axes.is_turned());
}

void Body::set_positions(std::span<const double> positions) {
  inner::Body& body = impl_->body();
  body.set_positions(active_coordinates_of(body.mesh(), positions, position_limit(body.precision())));
  impl_->forget_handle();
}

void Body::reset() {
  impl_->body().reset();
  impl_->forget_handle();
}

Snapshot Body::snapshot() const {
  const inner::Body& body = impl_->body();
  return Access::make<Snapshot>(snapshot_of(body), impl_->mesh, body.precision());
}

void Body::restore(const Snapshot& snapshot) {
  inner::Body& body = impl_->body();
  const auto& [positions, mesh, precision] = Access::impl(snapshot);
  if (!(mesh == impl_->mesh) || precision != body.precision()) {
    throw Error("snapshot", "it is of another mesh or precision", "restore it into a body of the same mesh");
  }
  body.restore(positions, every_block(body.mesh()));
  impl_->forget_handle();
}

void Body::cut(const std::vector<LinkId>& links) {
  guarded([&] { impl_->solver->cut(links); });
}

void Body::cut(ElementId a, ElementId b) {
  const auto link = impl_->mesh.find_link(a, b);
  if (!link) {
    throw Error("elements " + std::to_string(a) + " and " + std::to_string(b), "they are not linked",
                "use the two ends of a link");
  }
  cut({*link});
}

void Body::uncut(const std::vector<LinkId>& links) {
  guarded([&] { impl_->solver->uncut(links); });
}

std::vector<LinkId> Body::cuts() const { return impl_->body().cuts().links(); }

bool Body::is_cut(LinkId link) const {
  check_link_ids(impl_->body().mesh(), std::span(&link, 1));
  return impl_->body().cuts().is_cut(link);
}

void Body::pin(const std::vector<ElementId>& elements) {
  guarded([&] { impl_->solver->pin(elements); });
}

void Body::unpin(const std::vector<ElementId>& elements) {
  guarded([&] { impl_->solver->unpin(elements); });
}

std::span<const ElementId> Body::pins() const { return impl_->body().pins(); }

bool Body::is_pinned(ElementId element) const {
  check_id(impl_->body().mesh(), element);
  return impl_->body().is_pinned(element);
}

void Body::set_softness(const LinkSoftness& softness) {
  guarded([&] { inner::check(softness_of(softness)); });
  Softness next = impl_->body().softness();
  next.global = softness_of(softness);
  impl_->set_softness(next);
}

void Body::set_softness(const std::vector<LinkId>& links, const LinkSoftness& softness) {
  const auto unique = unique_links(impl_->body().mesh(), links);
  guarded([&] { inner::check(softness_of(softness)); });
  Softness next = impl_->body().softness();
  next.links.set(unique, softness_of(softness));
  impl_->set_softness(next);
}

void Body::set_link_softness(const std::vector<LinkId>& links, std::span<const LinkSoftness> softness) {
  const inner::Mesh& mesh = impl_->body().mesh();
  check_link_ids(mesh, links);
  if (softness.size() != links.size()) {
    throw Error("softness",
                "there are " + std::to_string(softness.size()) + " for " + std::to_string(links.size()) + " links",
                "give one for each link");
  }
  Softness next = impl_->body().softness();
  std::vector<OwnSoftness::Entry> entries;
  entries.reserve(links.size() + next.links.size());
  std::vector<bool> is_new(mesh.link_count());
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (is_new[links[i]]) {
      throw Error("link " + std::to_string(links[i]), "it is given twice", "give each link once");
    }
    check_own(links[i], softness[i]);
    is_new[links[i]] = true;
    entries.emplace_back(links[i], softness_of(softness[i]));
  }
  std::ranges::copy_if(next.links, std::back_inserter(entries), [&](const auto& one) { return !is_new[one.first]; });
  next.links = own_softness_of(std::move(entries));
  impl_->set_softness(next);
}

void Body::clear_softness(const std::vector<LinkId>& links) {
  Softness next = impl_->body().softness();
  next.links.erase(unique_links(impl_->body().mesh(), links));
  impl_->set_softness(next);
}

LinkSoftness Body::softness() const { return softness_of(impl_->body().softness().global); }

LinkSoftness Body::softness(LinkId link) const {
  check_link_ids(impl_->body().mesh(), std::span(&link, 1));
  return softness_of(impl_->body().softness().of(link));
}

std::vector<LinkSoftness> Body::link_softness() const {
  const Softness& softness = impl_->body().softness();
  std::vector<LinkSoftness> all(impl_->body().mesh().link_count(), softness_of(softness.global));
  for (const auto& [link, own] : softness.links) {
    all[link] = softness_of(own);
  }
  return all;
}

void Body::set_energy(EnergyKind kind) {
  Softness next = impl_->body().softness();
  inner::set_energy(next, energy_of(kind));
  impl_->set_softness(next);
}

EnergyKind Body::energy() const { return energy_of(impl_->body().softness().energy); }

void Body::set_frame(const Rotation& rotation) {
  Softness next = impl_->body().softness();
  next.axes = RegionAxes(AxesKind::given, rotation_of(rotation).vector());
  try {
    inner::check(next.axes, impl_->body().mesh());
    inner::check(rotation_of(rotation), impl_->body().mesh());
  } catch (const inner::Error& error) {
    throw Error("rotation", error.problem(), error.remedy());
  }
  impl_->set_softness(next);
}

bool Body::set_frame_of_object() {
  const PrincipalAxes principal = principal_axes(impl_->body().mesh());
  Softness next = impl_->body().softness();
  next.axes = principal.axes;
  impl_->set_softness(next);
  return principal.are_unique;
}

Rotation Body::frame() const {
  const Point& turn = impl_->body().softness().axes.rotation();
  const double angle = turn.norm();
  return angle > 0 ? Rotation{vector_of(turn / angle), angle * 180 / std::numbers::pi} : Rotation();
}

std::vector<std::array<ElementId, 3>> Body::visible_triangles() const {
  const MeshPointer& mesh = Access::pointer(impl_->mesh);
  const Cuts& cuts = impl_->body().cuts();
  std::vector<std::array<ElementId, 3>> triangles;
  for (const auto& [a, b, c] : mesh->triangles) {
    if (!is_cut_between(*mesh, cuts, a, b) && !is_cut_between(*mesh, cuts, b, c) &&
        !is_cut_between(*mesh, cuts, c, a)) {
      triangles.push_back({a, b, c});
    }
  }
  const Surface surface(std::make_shared<const CellTable>(mesh), cuts);
  const std::vector<ElementId> corners = surface.triangles();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  return triangles;
}

void check(const Elasticity& elasticity) {
  guarded([&] { inner::check(elastic_options_of(elasticity)); });
}

void Body::set_elasticity(const Elasticity& elasticity) {
  check(elasticity);
  impl_->body().set_elastic(elastic_options_of(elasticity));
}

Elasticity Body::elasticity() const {
  const ElasticOptions& options = impl_->body().elastic();
  return {options.material.young,      options.material.poisson, options.lattice,           options.iterations,
          StrainLaw(options.law.kind), options.law.gent_limit,   options.law.fung_exponent, options.thickness};
}

}  // namespace chainmail::api
