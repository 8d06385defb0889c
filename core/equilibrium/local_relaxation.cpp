#include "equilibrium/local_relaxation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "body/body_view.h"
#include "elastic/simplices.h"
#include "equilibrium/link_energy.h"

namespace chainmail {
namespace {

// Iterations over all elements of smaller objects are fast.
constexpr std::size_t worth_cells = 20'000;
// Volumes of larger objects are not finite (mesh units).
constexpr double largest_extent = 1e100;
// Valid regions from these numbers on hardly bind.
constexpr double open_stretch = 3, open_shear = 2;
// So few cuts are followed: the cells about them stay fine. To know more saves more than new cubes cost.
constexpr LinkId most_followed = 500;
// The error of a twin of half the resolution is four times as large, so the difference is three times the error.
constexpr double per_error = 3;

/// True if cubes must know all cuts; otherwise they know none. It does not matter when they are built.
bool must_know(const Cuts& cuts) { return cuts.count() > most_followed; }

LocalResolution resolution_of(const LocalRelaxation::Options& options, double extent, double factor) {
  return {options.theta * factor, std::max(2.0, options.widest * extent) * factor, options.tolerance * factor};
}

}  // namespace

bool LocalRelaxation::is_for(const Body& body) {
  const Mesh& mesh = body.mesh();
  const Softness& softness = body.softness();
  const std::size_t cells = mesh.has_cells() ? mesh.tetrahedra.size() + mesh.hexahedra.size() : mesh.element_count();
  return mesh.space_dimension == 3 && has_solid_cells(mesh) && cells >= worth_cells &&
         (mesh.box[1] - mesh.box[0]).maxCoeff() < largest_extent && softness.energy == EnergyKind::material &&
         softness.links.empty() && softness.global.compression <= 0 && softness.global.stretch >= open_stretch &&
         softness.global.shear >= open_shear && body.elastic().law.kind == StrainLaw::Kind::neo_hookean;
}

LocalRelaxation::LocalRelaxation(const Body& body, const Options& options, const Progress& progress)
    : options_(options),
      mesh_(body.stored_mesh()),
      space_(mesh_, must_know(body.cuts()) ? body.cuts() : Cuts(), progress),
      fixed_(space_),
      minimum_(space_, fixed_, resolution_of(options, space_.extent(), 1)),
      known_cuts_(must_know(body.cuts()) ? body.cuts().links() : std::vector<LinkId>()),
      is_gone_(space_.tetrahedra().size(), 0) {
  if (options.has_twin) {
    twin_.emplace(space_, fixed_, resolution_of(options, space_.extent(), 2));
  }
}

bool LocalRelaxation::fits(const Body& body) const {
  if (!is_of(body)) {
    return false;
  }
  const std::vector<LinkId> now = body.cuts().links();
  if (has_begun_ && !starts_anew_) {  // the handle moves
    return std::ranges::includes(now, known_cuts_);
  }
  return must_know(body.cuts()) ? now == known_cuts_ : known_cuts_.empty();
}

void LocalRelaxation::follow(const Body& body, std::span<const ElementId> held) {
  const Revisions& now = body.revisions();
  const bool is_new = !has_begun_;
  const auto each = [&](auto act) {
    act(minimum_);
    if (twin_) {
      act(*twin_);
    }
  };
  if (is_new || now.elastic != seen_.elastic) {
    const Lame lame = chainmail::lame({1, body.elastic().material.poisson});
    each([&](LocalMinimum& one) { one.set_lame(lame); });
  }
  if (is_new || now.cuts != seen_.cuts) {
    const std::vector<ElementId> changed = follow_cuts(body);
    each([&](LocalMinimum& one) { one.set_gone(&is_gone_, &boxes_, changed); });
  }
  starts_anew_ = starts_anew_ || is_new || now.positions != seen_.positions;
  const bool is_another = is_new || now.pins != seen_.pins || !std::ranges::equal(held, fixed_.held());
  if (is_another) {
    starts_anew_ = starts_anew_ || now.relaxed != seen_.relaxed;
    fixed_.set(body.pins(), held);
    each([](LocalMinimum& one) { one.follow_fixed(); });
  }
  const bool pins_stay = has_begun_ && now.only({&Revisions::pins, &Revisions::positions}) ==
                                           seen_.only({&Revisions::pins, &Revisions::positions});
  read_fixed(body, pins_stay && !is_another ? fixed_.held() : fixed_.elements());
  has_begun_ = true;
  seen_ = now;
}

void LocalRelaxation::read(const PositionView& positions, ElementId element, Doubles4& displacement) const {
  for (int k = 0; k < 3; ++k) {
    displacement[k] = (positions(element, k) - mesh_->rest[std::size_t{element} * 3 + std::size_t(k)]) / space_.unit();
  }
}

void LocalRelaxation::read_fixed(const Body& body, std::span<const ElementId> elements) {
  const PositionView positions = body.stored_positions();
  double square = 0;
  for (const ElementId e : elements) {
    Doubles4 displacement{};
    read(positions, e, displacement);
    fixed_.move(e, displacement);
    square = std::max(square, fixed_.is_held(e) ? square_of(displacement) : 0);
  }
  size_ = std::sqrt(square);
}

/// Finds the tetrahedra at links that are cut or were restored: their centres are near the links. Returns the corners
/// of those that changed. Costs as much as there are cuts.
std::vector<ElementId> LocalRelaxation::follow_cuts(const Body& body) {
  std::vector<LinkId> now = body.cuts().links(), links;
  std::ranges::set_union(cut_links_, now, std::back_inserter(links));
  cut_links_ = std::move(now);
  const CubeSpace::Level& level = space_.level(1);
  std::vector<std::uint32_t> cubes;
  for (const LinkId link : links) {
    const CubeSpace::Place at = space_.place_of(space_.point(mesh_->links[link][0]));
    const int reach = space_.reach();
    for (int z = -reach; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          cubes.push_back(level.find({at[0] + x, at[1] + y, at[2] + z}));
        }
      }
    }
  }
  std::ranges::sort(cubes);
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  std::erase(cubes, CubeSpace::none);
  boxes_.clear();
  std::vector<ElementId> changed;
  for (const std::uint32_t c : cubes) {
    bool any = false;
    for (std::uint32_t i = level.cubes[c].tetrahedron; i < level.cubes[c + 1].tetrahedron; ++i) {
      const std::uint32_t t = space_.sorted_tetrahedra()[i];
      const std::uint8_t is = space_.is_gone(t, body.cuts()) ? 1 : 0;
      if (std::exchange(is_gone_[t], is) != is) {
        std::ranges::copy(space_.tetrahedra()[t], std::back_inserter(changed));
      }
      any = any || is != 0;
    }
    if (any) {
      const auto& at = level.cubes[c].at;
      const Point low = 2 * Point(at[0], at[1], at[2]);
      boxes_.push_back({low, low + Point::Constant(2)});
    }
  }
  return changed;
}

LocalRelaxation::Result LocalRelaxation::update(Body& body, std::span<const ElementId> held) {
  follow(body, held);
  LocalMinimum::Read start;
  if (std::exchange(starts_anew_, false)) {
    start = [&, positions = body.stored_positions()](ElementId e, Doubles4& at) { read(positions, e, at); };
  }
  Result result;
  result.iterations = minimum_.move(size_, options_.max_iterations, start);
  if (twin_) {
    twin_->move(size_, options_.max_iterations, start);
    result.estimate = difference() / per_error;
  }
  write_to(body, false);
  result.nodes = minimum_.levels().unknown_count();
  result.tetrahedra = minimum_.levels().tetrahedron_count();
  result.distance = minimum_.distance();
  result.least_ratio = minimum_.least_ratio();
  return result;
}

void LocalRelaxation::write_to(Body& body, bool everything) {
  body.with_view([&]<class View>(const View& view) {
    if constexpr (View::Dimension == 3) {
      write(view, everything);
    }
  });
  if (!moved_.empty()) {
    body.note_relaxation();
    seen_ = body.revisions();
  }
}

template <class View>
void LocalRelaxation::write_element(const View& view, ElementId element, const double* rest,
                                    const Doubles4& displacement) {
  if (fixed_.is_fixed(element)) {
    return;
  }
  for (int k = 0; k < 3; ++k) {
    const double moved = space_.unit() * displacement[k];
    view.positions[element][k] = static_cast<typename View::Scalar>(view.from_rest ? moved : rest[k] + moved);
  }
  moved_.push_back(element);
}

template <class View>
void LocalRelaxation::write_leaf(const View& view, int l, std::uint32_t cube, bool everything) {
  const auto begin = everything ? &CubeSpace::Cube::element : &CubeSpace::Cube::skin;
  const CubeSpace::Level& level = space_.level(l);
  const LocalLevels::Level& in_use = minimum_.levels().level(l);
  const CubeSpace::Cube& of = level.cubes[cube];
  const bool is_alone = level.cubes[cube + 1].part == of.part + 1;
  std::uint32_t part = CubeSpace::none;
  std::array<Doubles4, 8> corner{};
  for (std::uint32_t i = of.*begin; i < level.cubes[cube + 1].*begin; ++i) {
    const ElementId e = everything ? space_.sorted_elements()[i] : space_.sorted_skin()[i];
    const double* rest = everything ? mesh_->rest.data() + std::size_t{e} * 3 : space_.rest_of_skin()[i].data();
    if (const std::uint32_t own = is_alone ? of.part : space_.ancestor(space_.home(e), l); own != part) {
      part = own;
      for (std::size_t k = 0; k < 8; ++k) {
        corner[k] = minimum_.displacement(in_use.point[minimum_.levels().find(l, level.parts[part].corner[k])]);
      }
    }
    const auto at = space_.interpolate(space_.point_of(rest), l, of);
    const Doubles4 displacement = at.weight[0] * corner[at.corner[0]] + at.weight[1] * corner[at.corner[1]] +
                                  at.weight[2] * corner[at.corner[2]] + at.weight[3] * corner[at.corner[3]];
    write_element(view, e, rest, displacement);
  }
}

template <class View>
void LocalRelaxation::write(const View& view, bool everything) {
  moved_.clear();
  const LocalLevels& levels = minimum_.levels();
  const LocalLevels::Level& fine = levels.level(0);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (fine.hangs[i] == 0) {
      const ElementId e = fine.node[i];
      write_element(view, e, mesh_->rest.data() + std::size_t{e} * 3, minimum_.displacement(fine.point[i]));
    }
  }
  const auto begin = everything ? &CubeSpace::Cube::element : &CubeSpace::Cube::skin;
  for (int l = 1; l <= levels.top(); ++l) {
    const CubeSpace::Level& level = space_.level(l);
    for (const std::uint32_t c : levels.cubes(l)) {
      if (!levels.is_divided(l, c) && level.cubes[c].*begin != level.cubes[c + 1].*begin) {
        write_leaf(view, l, c, everything);
      }
    }
  }
}

/// Returns the difference from the twin: root mean square, relative to the displacements, over the twin's leaves by
/// volume. They are as fine or coarser, so that their corners are here, too.
double LocalRelaxation::difference() const {
  const LocalLevels &here = minimum_.levels(), &there = twin_->levels();
  const auto values = minimum_.displacements();
  double apart = 0, all = 0;
  for (int l = 1; l <= there.top(); ++l) {
    const CubeSpace::Level& level = space_.level(l);
    for (const std::uint32_t c : there.cubes(l)) {
      for (std::uint32_t p = level.cubes[c].part; !there.is_divided(l, c) && p < level.cubes[c + 1].part; ++p) {
        const double volume = level.parts[p].all();
        for (const std::uint32_t node : level.parts[p].corner) {
          if (const std::uint32_t own = here.find(l, node); own != CubeSpace::none) {
            const Doubles4 displacement = values[std::size_t(l)][own];
            apart += volume * square_of(displacement - twin_->displacement(there.level(l).point[there.find(l, node)]));
            all += volume * square_of(displacement);
          }
        }
      }
    }
  }
  return all > 0 ? std::sqrt(apart / all) : 0;
}

}  // namespace chainmail
