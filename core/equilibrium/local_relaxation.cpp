#include "equilibrium/local_relaxation.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>

#include "body/body_view.h"
#include "elastic/simplices.h"
#include "equilibrium/link_energy.h"

namespace chainmail {
namespace {

// The error of a twin of half the resolution is four times as large, so the difference is three times the error.
constexpr double per_error = 3;

double thread_milliseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

LocalResolution resolution_of(const LocalRelaxation::Options& options, double extent, double factor) {
  return {options.theta * factor, std::max(2.0, options.widest * extent) * factor, options.tolerance * factor};
}

}  // namespace

bool LocalRelaxation::is_for(const Body& body) {
  return body.mesh().space_dimension == 3 && has_solid_cells(body.mesh()) &&
         body.softness().energy == EnergyKind::material && body.elastic().law.kind == StrainLaw::Kind::neo_hookean;
}

LocalRelaxation::LocalRelaxation(const Body& body, const Options& options, const Progress& progress)
    : options_(options),
      mesh_(body.stored_mesh()),
      space_(mesh_, Cuts(), progress),
      fixed_(space_),
      minimum_(space_, fixed_, resolution_of(options, space_.extent(), 1)),
      is_gone_(space_.tetrahedra().size(), 0),
      written_(std::size_t(space_.top()) + 1) {
  if (options.has_twin) {
    twin_.emplace(space_, fixed_, resolution_of(options, space_.extent(), 2));
  }
  std::array<Floats4, 8> never;
  never.fill(Floats4{} + std::numeric_limits<float>::quiet_NaN());
  for (int l = 1; l <= space_.top(); ++l) {
    written_[std::size_t(l)].assign(space_.level(l).parts.size(), never);
  }
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
    follow_cuts(body);
    each([&](LocalMinimum& one) { one.set_gone(&is_gone_, &boxes_); });
  }
  if (is_new || now.positions != seen_.positions) {
    each([](LocalMinimum& one) { one.forget(); });
  }
  const bool is_another = is_new || now.pins != seen_.pins || !std::ranges::equal(held, fixed_.held());
  if (is_another) {
    fixed_.set(body.pins(), held);
    each([](LocalMinimum& one) { one.follow_fixed(); });
  }
  const bool pins_stay = has_begun_ && now.only({&Revisions::pins, &Revisions::positions}) ==
                                           seen_.only({&Revisions::pins, &Revisions::positions});
  read_fixed(body, pins_stay && !is_another ? fixed_.held() : fixed_.elements());
  has_begun_ = true;
  seen_ = now;
}

void LocalRelaxation::read_fixed(const Body& body, std::span<const ElementId> elements) {
  const PositionView positions = body.stored_positions();
  double square = 0;
  for (const ElementId e : elements) {
    Doubles4 displacement{};
    for (int k = 0; k < 3; ++k) {
      displacement[k] = (positions(e, k) - mesh_->rest[std::size_t{e} * 3 + std::size_t(k)]) / space_.unit();
    }
    fixed_.move(e, displacement);
    square = std::max(square, fixed_.is_held(e) ? square_of(displacement) : 0);
  }
  size_ = std::sqrt(square);
}

/// Finds the tetrahedra at links that were cut or restored: their centres are near the links.
void LocalRelaxation::follow_cuts(const Body& body) {
  std::vector<LinkId> now = body.cuts().links(), changed;
  std::ranges::set_symmetric_difference(cut_links_, now, std::back_inserter(changed));
  cut_links_ = std::move(now);
  const CubeSpace::Level& level = space_.level(1);
  std::vector<std::uint32_t> cubes;
  for (const LinkId link : changed) {
    if (space_.home(mesh_->links[link][0]) == CubeSpace::none) {
      continue;
    }
    const CubeSpace::Point3 point = space_.point(mesh_->links[link][0]);
    CubeSpace::Place low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::max(0, int(std::floor(point[k] / 2)) - space_.reach());
      high[k] = std::min(level.size[k] - 1, int(std::floor(point[k] / 2)) + space_.reach());
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          cubes.push_back(level.find({x, y, z}));
        }
      }
    }
  }
  std::ranges::sort(cubes);
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  if (!cubes.empty() && cubes.back() == CubeSpace::none) {
    cubes.pop_back();
  }
  for (const std::uint32_t c : cubes) {
    for (std::uint32_t i = level.cubes[c].tetrahedron; i < level.cubes[c + 1].tetrahedron; ++i) {
      const std::uint32_t t = space_.sorted_tetrahedra()[i];
      is_gone_[t] = space_.is_gone(t, body.cuts()) ? 1 : 0;
    }
  }
  boxes_.clear();
  if (cut_links_.empty()) {
    return;
  }
  for (std::uint32_t c = 0; c < level.cube_count(); ++c) {
    for (std::uint32_t i = level.cubes[c].tetrahedron; i < level.cubes[c + 1].tetrahedron; ++i) {
      if (is_gone_[space_.sorted_tetrahedra()[i]] != 0) {
        const auto& at = level.cubes[c].at;
        LocalMinimum::Box box;
        for (std::size_t k = 0; k < 3; ++k) {
          box[0][k] = 2.0 * at[k];
          box[1][k] = 2.0 * at[k] + 2;
        }
        boxes_.push_back(box);
        break;
      }
    }
  }
}

LocalRelaxation::Result LocalRelaxation::update(Body& body, std::span<const ElementId> held) {
  const double start = thread_milliseconds();
  follow(body, held);
  Result result;
  result.iterations = minimum_.move(size_, options_.max_iterations);
  body.with_view([&]<class View>(const View& view) {
    if constexpr (View::Dimension == 3) {
      write(view, false);
    }
  });
  if (!moved_.empty()) {
    body.note_relaxation();
    seen_ = body.revisions();
  }
  result.moved = moved_;
  result.nodes = minimum_.levels().unknown_count();
  result.tetrahedra = minimum_.levels().tetrahedron_count();
  result.distance = minimum_.distance();
  result.least_ratio = minimum_.least_ratio();
  if (twin_) {
    const double own = thread_milliseconds();
    twin_->move(size_, options_.max_iterations);
    result.estimate = difference() / per_error;
    result.twin_milliseconds = thread_milliseconds() - own;
  }
  result.milliseconds = thread_milliseconds() - start;
  return result;
}

void LocalRelaxation::finish(Body& body) {
  body.with_view([&]<class View>(const View& view) {
    if constexpr (View::Dimension == 3) {
      write(view, true);
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

/// True if the corners of a part have moved since it was written, or it never was.
bool LocalRelaxation::is_stale(int l, std::uint32_t part) {
  const LocalLevels& levels = minimum_.levels();
  std::array<Floats4, 8> now;
  auto& was = written_[std::size_t(l)][part];
  const auto limit = float(options_.shows * options_.shows * size_ * size_);
  bool is_stale = false;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::uint32_t node = levels.find(l, space_.level(l).parts[part].corner[k]);
    now[k] = __builtin_convertvector(minimum_.displacement(levels.level(l).point[node]), Floats4);
    const Floats4 d = now[k] - was[k];
    is_stale = is_stale || !(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= limit);
  }
  if (is_stale) {
    was = now;
  }
  return is_stale;
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
      if (levels.is_divided(l, c) || level.cubes[c].*begin == level.cubes[c + 1].*begin) {
        continue;
      }
      bool stale = everything;
      for (std::uint32_t p = level.cubes[c].part; p < level.cubes[c + 1].part; ++p) {
        stale = is_stale(l, p) || stale;
      }
      if (stale) {
        write_leaf(view, l, c, everything);
      }
    }
  }
}

/// Returns the difference of the twin: root mean square, relative to the displacements, over the leaves by volume.
double LocalRelaxation::difference() const {
  const LocalLevels &here = minimum_.levels(), &there = twin_->levels();
  double apart = 0, all = 0;
  for (int l = 1; l <= here.top(); ++l) {
    const CubeSpace::Level& level = space_.level(l);
    for (const std::uint32_t c : here.cubes(l)) {
      if (here.is_divided(l, c)) {
        continue;
      }
      for (std::uint32_t p = level.cubes[c].part; p < level.cubes[c + 1].part; ++p) {
        // The corners, where the twin has them or interpolates them.
        int at = l;
        std::uint32_t own = p;
        while (at < here.top() &&
               !there.is_divided(at + 1, space_.level(at).cubes[space_.level(at).parts[own].cube].parent)) {
          own = space_.level(at++).parts[own].parent;
        }
        const CubeSpace::Level& of = space_.level(at);
        for (std::size_t k = 0; k < 8; ++k) {
          CubeSpace::Point3 point;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] = level.width * (level.cubes[c].at[axis] + int(k >> axis & 1));
          }
          const auto where = space_.interpolate(point, at, of.cubes[of.parts[own].cube]);
          Doubles4 other{};
          bool is_known = true;
          for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t node = there.find(at, of.parts[own].corner[where.corner[i]]);
            const std::uint32_t point_id = there.level(at).point[node];
            is_known = is_known && point_id != CubeSpace::none;
            if (is_known) {
              other += where.weight[i] * twin_->displacement(point_id);
            }
          }
          const std::uint32_t node = here.find(l, level.parts[p].corner[k]);
          const Doubles4 own_displacement = minimum_.displacement(here.level(l).point[node]);
          if (is_known) {
            const Doubles4 difference = own_displacement - other;
            apart += double(level.parts[p].all()) * square_of(difference);
            all += double(level.parts[p].all()) * square_of(own_displacement);
          }
        }
      }
    }
  }
  return all > 0 ? std::sqrt(apart / all) : 0;
}

}  // namespace chainmail
