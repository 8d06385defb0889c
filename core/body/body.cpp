#include "body/body.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "body/body_view.h"

namespace chainmail {
namespace {

std::vector<ElementId> sorted(std::span<const ElementId> elements) {
  std::vector<ElementId> result(elements.begin(), elements.end());
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

ElementBlocks all_blocks(const Mesh& mesh) {
  ElementBlocks all(mesh.element_count());
  all.insert_all();
  return all;
}

/// Moves a run of elements to rest.
template <class View>
[[gnu::noinline]] void put_to_rest(const View& body, ElementId first, ElementId end) {
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < View::Dimension; ++k) {
      body.set_position(e, k, body.mesh->rest[std::size_t{e} * View::Dimension + k]);
    }
  }
}

/// Returns what must be added to a stored coordinate in order to store it the other way. −0 changes no number.
template <class View>
double shift_of(const View& body, bool from_rest, ElementId element, int k) {
  const double rest = body.mesh->rest[std::size_t{element} * View::Dimension + k];
  return from_rest == body.from_rest ? -0.0 : from_rest ? rest : -rest;
}

/// Converts the coordinates of a block from one set of axes to another.
std::vector<double> turned(const Mesh& mesh, std::vector<double> held, const RegionAxes& from, const RegionAxes& to) {
  for (std::size_t at = 0; at < held.size(); at += std::size_t(mesh.space_dimension)) {
    turn_into_world(mesh, from, held.data() + at);
    turn_into_axes(mesh, to, held.data() + at);
  }
  return held;
}

AxisTurn turn_into_world_of(const Mesh& mesh, const RegionAxes& axes) {
  AxisTurn turn{mesh.space_dimension, {}};
  for (std::size_t row = 0; row < std::size_t(mesh.space_dimension); ++row) {
    for (std::size_t column = 0; column < std::size_t(mesh.space_dimension); ++column) {
      turn.rows[row][column] = axes.matrix()(mesh.axes[row], mesh.axes[column]);
    }
  }
  return turn;
}

/// Returns the displacements from rest, in the coordinates of the body's axes.
constexpr auto displacements_in_view = []<class View>(const View& view) {
  std::vector<double> result(view.mesh->rest.size());
  for (std::size_t at = 0; at < result.size(); ++at) {
    const double stored = view.positions[at / View::Dimension][int(at % View::Dimension)];
    result[at] = view.from_rest ? stored : stored - view.mesh->rest[at];
  }
  return result;
};

/// Restores a run of elements from the coordinates of a block.
template <class View>
[[gnu::noinline]] void restore_block(const View& body, const std::vector<double>& held, ElementId first, ElementId end,
                                     bool from_rest) {
  auto one = held.begin();
  for (ElementId e = first; e < end; ++e) {
    for (int k = 0; k < View::Dimension; ++k, ++one) {
      body.positions[e][k] = static_cast<typename View::Scalar>(*one + shift_of(body, from_rest, e, k));
    }
  }
}

}  // namespace

Body::AnyTyped Body::make_typed(Precision precision, int dimension) {
  const bool single = precision == Precision::single_precision;
  switch (dimension) {
    case 1:
      return single ? AnyTyped(Typed<float, 1>()) : Typed<double, 1>();
    case 2:
      return single ? AnyTyped(Typed<float, 2>()) : Typed<double, 2>();
    default:
      return single ? AnyTyped(Typed<float, 3>()) : Typed<double, 3>();
  }
}

Body::Body(MeshPointer mesh, Precision precision)
    : mesh_(std::move(mesh)),
      stored_mesh_(mesh_),
      precision_(precision),
      cuts_(mesh_),
      typed_(make_typed(precision, mesh_->space_dimension)),
      updates_(mesh_->element_count()) {
  std::visit([this](auto& typed) { typed.positions.resize(mesh_->element_count()); }, typed_);
  with_view([this](const auto& view) { put_to_rest(view, 0, mesh_->element_count()); });
  set_softness(Softness());
}

void Body::cut(std::span<const LinkId> links) {
  for (const LinkId link : links) {
    cuts_.cut(link);
  }
  ++revisions_.cuts;
}

void Body::uncut(std::span<const LinkId> links) {
  for (const LinkId link : links) {
    cuts_.uncut(link);
  }
  ++revisions_.cuts;
  ++revisions_.restored;
}

void Body::pin(std::span<const ElementId> elements) {
  std::vector<ElementId> all;
  std::ranges::set_union(pins_, sorted(elements), std::back_inserter(all));
  set_pins(std::move(all));
}

void Body::unpin(std::span<const ElementId> elements) {
  std::vector<ElementId> left;
  std::ranges::set_difference(pins_, sorted(elements), std::back_inserter(left));
  set_pins(std::move(left));
}

void Body::set_pins(std::vector<ElementId> pins) {
  for (const ElementId pin : pins_) {
    updates_[pin] = 0;
  }
  pins_ = std::move(pins);
  for (const ElementId pin : pins_) {
    updates_[pin] = always;
  }
  ++revisions_.pins;
}

void Body::set_softness(std::shared_ptr<const Softness> softness) {
  const SoftnessChange change = softness_ ? change_of(*softness_, *softness) : SoftnessChange{true, true};
  if (works_in_axes_ && softness->axes.rotation() != region_axes_.rotation()) {
    store_in(softness->axes, *softness);
  } else if (change.regions) {
    std::visit([&](auto& typed) { typed.regions.set(*stored_mesh_, *softness, stores_displacements_); }, typed_);
  }
  softness_ = std::move(softness);
  revisions_.softness += change.regions ? 1 : 0;
  revisions_.energy += change.energy ? 1 : 0;
}

void Body::restore(const ObjectState& object) {
  if (object.softness != softness_ && *object.softness != *softness_) {
    set_softness(object.softness);
  }
  const std::vector<LinkId> present = cuts_.links();
  std::vector<LinkId> excess, missing;
  std::ranges::set_difference(present, object.cuts, std::back_inserter(excess));
  std::ranges::set_difference(object.cuts, present, std::back_inserter(missing));
  if (!excess.empty()) {
    uncut(excess);
  }
  if (!missing.empty()) {
    cut(missing);
  }
  if (object.pins != pins_) {
    set_pins(object.pins);
  }
}

void Body::set_elastic(const ElasticOptions& options) {
  elastic_ = options;
  ++revisions_.elastic;
}

PositionView Body::positions() const { return view_of_stored(*mesh_, turn()); }

PositionView Body::stored_positions() const { return view_of_stored(*stored_mesh_, nullptr); }

PositionView Body::view_of_stored(const Mesh& from_rest, const AxisTurn* turn) const {
  return std::visit(
      [&](const auto& typed) {
        return PositionView(typed.positions.data(), sizeof typed.positions[0], precision_,
                            stores_displacements_ ? &from_rest : nullptr, turn);
      },
      typed_);
}

void Body::work_in_axes(bool works) {
  const RegionAxes axes = works ? softness_->axes : RegionAxes();
  if (axes.rotation() != region_axes_.rotation()) {
    store_in(axes, *softness_);
  }
  works_in_axes_ = works;
}

void Body::store_in(const RegionAxes& axes, const Softness& softness) {
  const MeshPointer mesh = in_axes(mesh_, axes);
  const AxisTurn turn = turn_into_world_of(*mesh_, axes);
  const std::vector<double> away = turned(*mesh_, with_view(displacements_in_view), region_axes_, axes);
  std::visit([&](auto& typed) { typed.regions.set(*mesh, softness, stores_displacements_); }, typed_);
  // Nothing runs out of memory from here on.
  stored_mesh_ = mesh;
  region_axes_ = axes.is_turned() ? RegionAxes(AxesKind::given, axes.rotation()) : RegionAxes();
  turn_ = turn;
  with_view([&]<class View>(const View& view) {
    for (ElementId e = 0; e < mesh_->element_count(); ++e) {
      for (int k = 0; k < View::Dimension; ++k) {
        const std::size_t at = std::size_t{e} * View::Dimension + std::size_t(k);
        const double origin = view.from_rest ? 0 : view.mesh->rest[at];
        view.positions[e][k] = static_cast<typename View::Scalar>(is_at_rest_ ? origin : origin + away[at]);
      }
    }
  });
  note_positions_set(is_at_rest_);
}

template <class Out>
void Body::copy(ElementId first, std::span<Out> out) const {
  if (region_axes_.is_turned()) {
    const auto view = positions();
    const auto dimension = std::size_t(mesh_->space_dimension);
    for (std::size_t at = 0; at < out.size(); ++at) {
      out[at] = static_cast<Out>(view(static_cast<ElementId>(first + at / dimension), int(at % dimension)));
    }
    return;
  }
  std::visit(
      [&]<class Scalar, int Dimension>(const Typed<Scalar, Dimension>& typed) {
        for (std::size_t i = 0; i < out.size() / Dimension; ++i) {
          for (int k = 0; k < Dimension; ++k) {
            const double stored = typed.positions[first + i][k];
            const std::size_t at = (first + i) * Dimension + std::size_t(k);
            out[i * Dimension + std::size_t(k)] =
                static_cast<Out>(stores_displacements_ ? mesh_->rest[at] + stored : stored);
          }
        }
      },
      typed_);
}

void Body::copy_positions(ElementId first, std::span<float> out) const { copy(first, out); }
void Body::copy_positions(ElementId first, std::span<double> out) const { copy(first, out); }

void Body::set_positions(std::span<const double> in) {
  const std::vector<double> stored =
      region_axes_.is_turned() ? turned(*mesh_, {in.begin(), in.end()}, {}, region_axes_) : std::vector<double>();
  in = region_axes_.is_turned() ? std::span<const double>(stored) : in;
  with_view([in]<class View>(const View& view) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      view.set_position(static_cast<ElementId>(i / View::Dimension), int(i % View::Dimension), in[i]);
    }
  });
  note_positions_set(false);
}

void Body::reset() { reset(all_blocks(*mesh_)); }

void Body::reset(const ElementBlocks& away) {
  with_view([&](const auto& view) {
    away.for_each_run([&](ElementId first, ElementId end) { put_to_rest(view, first, end); });
  });
  note_positions_set(true);
}

Snapshot Body::snapshot() const {
  return snapshot(is_at_rest_ ? ElementBlocks(mesh_->element_count()) : all_blocks(*mesh_));
}

void Body::restore(const Snapshot& snapshot) { restore(snapshot, all_blocks(*mesh_)); }

Snapshot Body::snapshot(const ElementBlocks& away) const {
  Snapshot result;
  update(result, away, away);
  return result;
}

void Body::update(Snapshot& snapshot, const ElementBlocks& blocks, const ElementBlocks& away) const {
  snapshot.blocks.resize(away.block_count());
  snapshot.from_rest = stores_displacements_;
  snapshot.axes = region_axes_;
  std::visit(
      [&]<class Scalar, int Dimension>(const Typed<Scalar, Dimension>& typed) {
        blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
          snapshot.blocks[block].reset();
          if (away.contains_block(block)) {
            std::vector<double> held;
            held.reserve(std::size_t{end - first} * Dimension);
            for (ElementId e = first; e < end; ++e) {
              held.insert(held.end(), typed.positions[e].at, typed.positions[e].at + Dimension);
            }
            snapshot.blocks[block] = std::make_shared<const std::vector<double>>(std::move(held));
          }
        });
      },
      typed_);
}

void Body::restore(const Snapshot& snapshot, const ElementBlocks& blocks) {
  with_view([&](const auto& view) {
    blocks.for_each_block([&](std::size_t block, ElementId first, ElementId end) {
      const Snapshot::Block held = snapshot.blocks.empty() ? nullptr : snapshot.blocks[block];
      if (held != nullptr && snapshot.axes.rotation() == region_axes_.rotation()) {
        restore_block(view, *held, first, end, snapshot.from_rest);
      } else if (held != nullptr) {
        restore_block(view, turned(*mesh_, *held, snapshot.axes, region_axes_), first, end, snapshot.from_rest);
      } else {
        put_to_rest(view, first, end);
      }
    });
  });
  note_positions_set(snapshot.is_at_rest());
}

void Body::note_positions_set(bool at_rest) {
  is_at_rest_ = at_rest;
  ++revisions_.positions;
}

void Body::store_displacements(bool displacements) {
  if (displacements == stores_displacements_) {
    return;
  }
  std::visit(
      [&]<class Scalar, int Dimension>(Typed<Scalar, Dimension>& typed) {
        typed.regions.set(*stored_mesh_, *softness_, displacements);  // may run out of memory, so it comes first
        for (ElementId e = 0; e < mesh_->element_count(); ++e) {
          for (int k = 0; k < Dimension; ++k) {
            const double rest = stored_mesh_->rest[std::size_t{e} * Dimension + std::size_t(k)];
            Scalar& x = typed.positions[e][k];
            x = static_cast<Scalar>(displacements ? double(x) - rest : double(x) + rest);
          }
        }
        stores_displacements_ = displacements;
      },
      typed_);
  if (is_at_rest_) {  // restores digits that absolute positions lost by rounding
    with_view([this](const auto& view) { put_to_rest(view, 0, mesh_->element_count()); });
  }
}

std::uint32_t Body::begin_pass() {
  if (++pass_ == always) {
    for (auto& update : updates_) {
      update = update == always ? always : 0;
    }
    pass_ = 1;
  }
  return pass_;
}

}  // namespace chainmail
