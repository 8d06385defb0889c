#include "solve/elastic_deformation.h"

#include <array>

#include "solve/body_view.h"

namespace chainmail {
namespace {

/// Appends the displacement of an element from rest (mesh units).
void append_displacement(const Body& body, ElementId element, std::vector<double>& to) {
  const Mesh& mesh = body.mesh();
  const PositionView positions = body.positions();
  for (int k = 0; k < mesh.space_dimension; ++k) {
    to.push_back(positions(element, k) -
                 mesh.rest[std::size_t{element} * std::size_t(mesh.space_dimension) + std::size_t(k)]);
  }
}

std::vector<double> displacements_of(const Body& body, std::span<const ElementId> elements) {
  std::vector<double> result;
  for (const ElementId element : elements) {
    append_displacement(body, element, result);
  }
  return result;
}

}  // namespace

PassCount ElasticDeformation::move(Body& body, const HandleMove& handle, PassOutput output) {
  std::array<double, 3> displacement{};
  body.with_view([&]<class View>(const View& view) {
    const auto target = stored_target(view, handle.element, handle.target);
    for (int k = 0; k < View::Dimension; ++k) {
      displacement[std::size_t(k)] =
          double(target[k]) - view.mesh->rest[std::size_t{handle.element} * View::Dimension + std::size_t(k)];
    }
  });
  prepare(body, output.progress);
  if (held_ != handle.element) {
    held_ = no_element;
    solver_->hold(handle.element, output.progress);
    held_ = handle.element;
  }
  solver_->move(std::span(displacement).first(std::size_t(body.mesh().space_dimension)), output.progress);
  return take_answer(body, handle.element, output.moved);
}

std::span<const double> ElasticDeformation::control_points(Body& body, const Progress& progress) {
  prepare(body, progress);
  return solver_->control_points();
}

PassCount ElasticDeformation::move_control_point(Body& body, std::size_t point, const Point& target,
                                                 PassOutput output) {
  prepare(body, output.progress);
  std::array<double, 3> to{};
  const auto dimension = std::size_t(body.mesh().space_dimension);
  for (std::size_t k = 0; k < dimension; ++k) {
    to[k] = target[body.mesh().axes[k]];
  }
  solver_->move_control_point(point, std::span(to).first(dimension));
  return take_answer(body, no_element, output.moved);
}

void ElasticDeformation::prepare(const Body& body, const Progress& progress) {
  const Revisions& now = body.revisions();
  const Conditions conditions{now.cuts, now.pins, now.elastic};
  const std::uint64_t positions = now.positions + now.relaxed;
  const bool knows_positions = solver_ && positions_ == positions;
  if (solver_ && conditions == made_for_ && (knows_positions || displacements_of(body, body.pins()) == pinned_)) {
    if (!knows_positions) {
      held_ = no_element;
      solver_->reset();
      body.is_at_rest() ? void() : take_positions(body);
      positions_ = positions;
    }
    return;
  }
  solver_.reset();
  held_ = no_element;
  pinned_ = displacements_of(body, body.pins());
  solver_ = make_elastic(
      method_, {body.mesh_pointer(), body.cuts(), {body.pins().begin(), body.pins().end()}, pinned_, body.elastic()},
      progress);
  made_for_ = conditions;
  positions_ = positions;
  take_positions(body);
}

void ElasticDeformation::take_positions(const Body& body) {
  std::vector<double> displacements;
  for (ElementId e = 0; e < body.mesh().element_count(); ++e) {
    append_displacement(body, e, displacements);
  }
  solver_->start_from(displacements);
}

/// Sets the position of every element, and collects those that moved.
PassCount ElasticDeformation::take_answer(Body& body, ElementId grabbed, std::vector<ElementId>& moved) const {
  const std::vector<double>& answer = solver_->displacements();
  moved.clear();
  body.with_view([&]<class View>(const View& view) {
    for (ElementId e = 0; e < view.mesh->element_count(); ++e) {
      const auto before = view.positions[e];
      for (int k = 0; k < View::Dimension && !view.pinned(e); ++k) {
        const std::size_t at = std::size_t{e} * View::Dimension + std::size_t(k);
        view.set_position(e, k, view.mesh->rest[at] + answer[at]);
      }
      if (e != grabbed && view.positions[e] != before) {
        moved.push_back(e);
      }
    }
  });
  return {body.mesh().element_count(), moved.size()};
}

}  // namespace chainmail
