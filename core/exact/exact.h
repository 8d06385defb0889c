#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "body/body_view.h"
#include "body/method.h"
#include "chainmail/replay.h"
#include "exact/handle_regions.h"

namespace chainmail {

/// A handle of many elements, in displacements from rest. Each element is at the handle's displacement, which is that
/// of its pivot, plus an offset of its own. A translation keeps the offsets; a rotation changes them.
///
/// It begins with the positions that the elements have at that time. They differ from those of the pose if something
/// else than this handle has moved them: the restoration of validity, relaxation or another handle. Then the pivot is
/// their mean.
template <class Scalar, int Dimension>
class RigidHandle {
 public:
  using View = BodyView<Scalar, Dimension>;
  using Offset = Position<Scalar, Dimension>;

  [[gnu::noinline]] void begin(const View& body, const Handle& handle) {
    mesh_ = body.mesh;
    pose_ = handle.pose();
    offsets_.clear();
    arms_.clear();
    for (const ElementId element : handle.elements()) {
      double absolute[Dimension];
      for (int k = 0; k < Dimension; ++k) {
        absolute[k] = body.absolute(element, k);
      }
      offsets_.push_back(body.positions[element]);
      arms_.push_back(mesh_->to_point(absolute));
    }
    take_pivot();
    for (Point& arm : arms_) {
      arm -= pose_.pivot;
    }
  }

  /// Returns the displacement of the handle at a pose.
  Offset at(const Pose& pose) const {
    Offset at{};
    for (int k = 0; k < Dimension; ++k) {
      const int axis = mesh_->axes[std::size_t(k)];
      at[k] = static_cast<Scalar>(pose.pivot[axis] - pose_.pivot[axis]);
    }
    return at;
  }

  /// Returns the position of the pivot (mesh units) while the handle is at a displacement.
  Point pivot_at(const Offset& at) const {
    Point pivot = pose_.pivot;
    for (int k = 0; k < Dimension; ++k) {
      pivot[mesh_->axes[std::size_t(k)]] += double(at[k]);
    }
    return pivot;
  }

  /// Returns the offset of each element after a rotation, measured from the grab.
  [[gnu::noinline]] std::vector<Offset> offsets(const Point& rotation) const {
    const Eigen::Matrix3d turn = turn_between(pose_.rotation, rotation);
    std::vector<Offset> offsets = offsets_;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const Point displacement = turn * arms_[i];
      for (int k = 0; k < Dimension; ++k) {
        offsets[i][k] += static_cast<Scalar>(displacement[mesh_->axes[std::size_t(k)]]);
      }
    }
    return offsets;
  }

 private:
  /// Sets the pivot to the mean of the positions, unless it is that up to rounding.
  void take_pivot() {
    Point mean = Point::Zero();
    double size = 0;
    for (const Point& position : arms_) {
      mean += position / double(arms_.size());
      size = std::max(size, position.template lpNorm<Eigen::Infinity>());
    }
    const double rounding = 64 * std::numeric_limits<Scalar>::epsilon() * size;
    if ((mean - pose_.pivot).template lpNorm<Eigen::Infinity>() > rounding) {
      pose_.pivot = mean;
    }
  }

  const Mesh* mesh_ = nullptr;
  Pose pose_;                    // at the beginning
  std::vector<Offset> offsets_;  // at the beginning, when the handle's displacement is 0
  std::vector<Point> arms_;      // from the pivot to each element at the beginning (mesh units)
};

/// Returns the remark about a rotation that stopped at an angle (radians).
inline std::string stopped_at(double angle) {
  char text[96];
  std::snprintf(text, sizeof text, "stopped at %.3g degrees by links outside the handle, or by pins",
                angle * (180 / std::numbers::pi));
  return text;
}

/// A row of a trace, and how far its element moved.
struct MovedRow {
  double way;
  TraceRow row;
};

/// Appends rows to a trace, the largest move first, ties by id.
inline void write_sorted(std::vector<MovedRow>& rows, Trace& trace) {
  std::sort(rows.begin(), rows.end(), [](const MovedRow& a, const MovedRow& b) {
    return a.way != b.way ? a.way > b.way : a.row.element < b.row.element;
  });
  for (const MovedRow& row : rows) {
    trace.push_back(row.row);
  }
}

/// Exact ChainMail: moves every element, on every axis, as little as any valid answer to the move can.
///
/// HandleRegions computes the region about the handle in which each element may lie. A pass clamps each element into
/// its own region, like a neighbour of the handle. No element waits for another one, so no order changes a bit of the
/// answer, and no rounding adds up along the links.
template <class Scalar, int Dimension, class Schedule = AdaptiveSchedule<Scalar>>
class ExactPropagation {
 public:
  using State = BodyView<Scalar, Dimension>;
  using Reach = HandleReach<Scalar, Dimension>;

  /// Moves a handle. The state must be valid, except for links inside a handle of many. On axes on which pins stop it,
  /// the handle moves as far as they allow. A rotation ends where the handle would contradict itself, or pins, through
  /// links outside it. `move` gets the pose that was reached. `moved` receives the elements that moved, without the
  /// handle. `trace`, if given, receives the same elements, the largest move first, ties by id.
  /// The pass may use `threads`; their number does not change a bit of the answer, but the order in `moved`.
  PassCount propagate(State& body, HandleMove& move, std::vector<ElementId>& moved, Trace* trace, int threads = 1) {
    remark_.clear();
    visits_ = 0;
    ThreadTeam team(threads);
    const Reach reach =
        move.handle.has_one() ? extend_one(body, move, threads, team) : extend_many(body, move, threads, team);
    if (trace != nullptr) {
      write_trace(body, reach, *trace);
    }
    this->move(body, reach, moved, team);
    drop_idle_regions(moved.size());
    const bool stopped = std::find(reach.stopped, reach.stopped + Dimension, true) != reach.stopped + Dimension;
    return {moved.size(), moved.size(), stopped || !remark_.empty(), visits_};
  }

  /// Prepares the first move of an element: computes the regions of all elements. They are used if that move, too,
  /// would have computed them all, so no bit depends on them. Throws Cancelled.
  void prepare(const State& body, const Handle& handle, int threads, const Progress& progress) {
    const Basis wanted = basis_of(body, handle, threads);
    if (prepared_for_ == wanted || is_made_for(body, handle, threads)) {
      return;
    }
    prepared_for_ = {};  // until all is done
    prepared_.begin(body, handle.elements(), {}, threads);
    ThreadTeam team(threads);
    prepared_.extend_everywhere(body, team, progress);
    prepared_for_ = wanted;
  }

  /// Reason why the last pass did not reach its rotation. Usually empty.
  const std::string& remark() const { return remark_; }

 private:
  using Offset = Position<Scalar, Dimension>;

  /// What regions depend on.
  struct Basis {
    Revisions revisions;
    ElementId first = no_element;  // of the handle
    std::uint64_t grab = 0;        // of a handle of many
    int threads = 0;
    bool operator==(const Basis&) const = default;
  };

  /// The offsets of a handle of many come from positions.
  [[gnu::noinline]] static Basis basis_of(const BodyLinks& body, const Handle& handle, int threads) {
    Revisions now = body.revisions().only({&Revisions::cuts, &Revisions::pins, &Revisions::softness});
    now.positions = handle.has_one() ? 0 : body.revisions().positions;
    return {now, handle.elements()[0], handle.grab(), threads};
  }
  bool is_made_for(const State& body, const Handle& handle, int threads) const {
    return basis_of(body, handle, threads) == made_for_ && is_where_it_was(body, handle);
  }

  void begin_one(const State& body, const Handle& handle, const Reach& reach, int threads) {
    if (is_made_for(body, handle, threads)) {
      return;
    }
    offsets_.clear();
    const Basis wanted = basis_of(body, handle, threads);
    if (prepared_for_ == wanted && prepared_.moves_all(body, reach)) {
      regions_.swap(prepared_);
      prepared_for_ = {};
    } else {
      regions_.begin(body, handle.elements(), offsets_, threads);
    }
    threads_ = threads;
    made_for_ = wanted;
  }

  void begin_many(const State& body, const Handle& handle, int threads) {
    if (is_made_for(body, handle, threads)) {
      return;
    }
    shape_.begin(body, handle);
    offsets_ = shape_.offsets(rotation_ = handle.pose().rotation);
    std::fill_n(at_.at, Dimension, Scalar{0});
    threads_ = threads;
    regions_.begin(body, handle.elements(), offsets_, threads);
    made_for_ = basis_of(body, handle, threads);
  }

  /// True if nothing has moved an element of a handle of many since the last pass. Relaxation may, after a release.
  bool is_where_it_was(const State& body, const Handle& handle) const {
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      for (int k = 0; k < Dimension; ++k) {
        if (body.positions[handle.elements()[i]][k] != at_[k] + offsets_[i][k]) {
          return false;
        }
      }
    }
    return true;
  }

  void extend(const State& body, Reach& reach, ThreadTeam& team) {
    const std::uint64_t before = regions_.visits();
    regions_.extend(body, reach, team);
    visits_ += regions_.visits() - before;
  }

  Reach extend_one(const State& body, HandleMove& move, int threads, ThreadTeam& team) {
    const ElementId element = move.handle.elements()[0];
    Reach reach(body.positions[element], stored_target(body, element, move.pose.pivot).at);
    begin_one(body, move.handle, reach, threads);
    extend(body, reach, team);
    for (int k = 0; k < Dimension; ++k) {
      if (reach.stopped[k]) {
        move.pose.pivot[body.mesh->axes[std::size_t(k)]] = body.origin(element, k) + double(reach.to[k]);
      }
    }
    return reach;
  }

  [[gnu::noinline]] Reach extend_many(const State& body, HandleMove& move, int threads, ThreadTeam& team) {
    begin_many(body, move.handle, threads);
    const Pose target = move.pose;
    const Offset to = shape_.at(target);
    std::optional<Offset> turned;
    if (target.rotation != rotation_) {
      turned = turn(body, move.handle, target.rotation, to, team);
    }
    Reach reach = turned ? Reach(*turned) : Reach(at_, to.at);
    if (turned) {
      for (int k = 0; k < Dimension; ++k) {
        reach.stopped[k] = (*turned)[k] != to[k];
      }
    } else {
      extend(body, reach, team);
    }
    std::copy_n(reach.to, Dimension, at_.at);
    if (at_ != to) {
      move.pose.pivot = shape_.pivot_at(at_);
    }
    move.pose.rotation = rotation_;
    return reach;
  }

  /// Finds regions for a rotation of the handle, or for the furthest possible one. Returns where the handle is then, as
  /// near to `to` as pins allow; nothing if it cannot rotate. The regions are those of rotation_ in either case.
  std::optional<Offset> turn(const State& body, const Handle& handle, const Point& target, const Offset& to,
                             ThreadTeam& team) {
    const Point from = rotation_;
    auto reached = try_rotation(body, handle, target, to, team);
    if (reached) {
      return reached;
    }
    double possible = 0, impossible = 1;
    const double angle = angle_between(from, target);
    while ((impossible - possible) * angle > finest_angle) {
      const double fraction = (possible + impossible) / 2;
      (try_rotation(body, handle, rotation_between(from, target, fraction), to, team) ? possible : impossible) =
          fraction;
    }
    reached = try_rotation(body, handle, rotation_between(from, target, possible), to, team);
    remark_ = stopped_at(rotation_.norm());
    return possible > 0 ? reached : std::nullopt;
  }

  [[gnu::noinline]] std::optional<Offset> try_rotation(const State& body, const Handle& handle, const Point& rotation,
                                                       const Offset& target, ThreadTeam& team) {
    Offset to = target;
    rotation_ = rotation;
    offsets_ = shape_.offsets(rotation);
    regions_.begin(body, handle.elements(), offsets_, threads_);
    for (int i = 0; i < max_corrections; ++i) {
      Reach reach(to);
      extend(body, reach, team);
      if (!regions_.hold(body, to)) {
        break;
      }
    }
    double size = 0;
    for (int k = 0; k < Dimension; ++k) {
      size = std::max({size, std::abs(double(to[k])), std::abs(double(offsets_.front()[k]))});
    }
    // The same tolerance as for the links of a state that is taken to be valid.
    const double tolerance = 8 * std::numeric_limits<Scalar>::epsilon() * size;
    return regions_.agree(body, to, static_cast<Scalar>(tolerance)) ? std::optional(to) : std::nullopt;
  }

  static constexpr double finest_angle = 1e-6;  // radians
  // Of the position of a rotated handle, as the search finds more pins.
  static constexpr int max_corrections = 8;

  /// A drag that reached far and then moves little would still clamp all elements that it reached. So the regions are
  /// dropped after enough idle passes to pay for a new search.
  void drop_idle_regions(std::size_t moved) {
    const std::size_t known = regions_.known() - offsets_.size();
    idle_passes_ = moved < known / 4 ? idle_passes_ + 1 : 0;
    if (idle_passes_ == max_idle_passes) {
      made_for_ = {};
      idle_passes_ = 0;
    }
  }

  static constexpr int max_idle_passes = 16;  // a search costs 12 to 18 later passes, see tests/bench/README.md

  /// Elements of one partition, clamped by one thread.
  struct Piece {
    std::span<const ElementId> elements;
    const Region<Scalar, Dimension>* regions;
    ElementId* moved;       // where the elements that move are listed
    std::size_t count = 0;  // of these
  };

  void move(State& body, const Reach& reach, std::vector<ElementId>& moved, ThreadTeam& team) {
    moved.resize(regions_.known());
    pieces_.clear();
    ElementId* to = moved.data();
    const auto partitions = regions_.partitions();
    // Neighbours on a cache line belong to one partition. A single partition is cut in as few places as possible.
    const std::size_t per_partition = partitions.size() > 1 ? 1 : static_cast<std::size_t>(threads_);
    for (const auto& partition : partitions) {
      const std::size_t size = partition.elements().size(), piece = std::max(size / per_partition + 1, min_for_thread);
      for (std::size_t i = partition.handle_size(), end = 0; i < size; i = end) {
        end = std::min(size, i + piece);
        pieces_.push_back({partition.elements().subspan(i, end - i), partition.regions().data() + i, to});
        to += end - i;
      }
    }
    if (pieces_.size() > 1 && moved.size() >= 2 * min_for_thread) {
      team.call_helpers();
    }
    team.run(pieces_.size(), [&](std::size_t i) { clamp(body, reach, pieces_[i]); });
    std::size_t count = 0;
    for (const Piece& piece : pieces_) {
      if (piece.moved != moved.data() + count) {
        std::copy_n(piece.moved, piece.count, moved.data() + count);
      }
      count += piece.count;
    }
    moved.resize(count);
    const auto handle = regions_.handle();
    std::copy_n(reach.to, Dimension, body.positions[handle[0]].at);
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      for (int k = 0; k < Dimension; ++k) {
        body.positions[handle[i]][k] = reach.to[k] + offsets_[i][k];
      }
    }
  }

  static void clamp(const State& body, const Reach& reach, Piece& piece) {
    const ElementId* const elements = piece.elements.data();
    const std::size_t size = piece.elements.size();
    const Region<Scalar, Dimension>* const regions = piece.regions;
    auto* const positions = body.positions.data();
    ElementId* const moved = piece.moved;
    const Reach to = reach;  // so that no write seems to change it
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
      __builtin_prefetch(&positions[elements[std::min(i + fetched_ahead, size - 1)]], 1);
      auto& position = positions[elements[i]];
      const auto next = clamped(position, to.low, to.high, regions[i]);
      if (next != position) {
        position = next;
        moved[count++] = elements[i];
      }
    }
    piece.count = count;
  }

  // Elements that a thread must have to clamp before it pays.
  static constexpr std::size_t min_for_thread = 16'384;

  [[gnu::noinline]] void write_trace(const State& body, const Reach& reach, Trace& trace) const {
    std::vector<MovedRow> rows;
    for (const auto& partition : regions_.partitions()) {
      for (std::size_t i = partition.handle_size(); i < partition.elements().size(); ++i) {
        add_row(body, reach, partition.elements()[i], partition.regions()[i], rows);
      }
    }
    write_sorted(rows, trace);
  }

  void add_row(const State& body, const Reach& reach, ElementId element, const Region<Scalar, Dimension>& region,
               std::vector<MovedRow>& rows) const {
    const auto next = clamped(body.positions[element], reach.low, reach.high, region);
    double ways[Dimension];
    for (int k = 0; k < Dimension; ++k) {
      ways[k] = std::abs(double(next[k]) - double(body.positions[element][k]));
    }
    const double* furthest = std::max_element(ways, ways + Dimension);
    if (*furthest > 0) {
      const auto k = static_cast<int>(furthest - ways);
      rows.push_back(
          {*furthest, {element, binding_neighbour(body, element, k, next[k] > body.positions[element][k]), true}});
    }
  }

  /// Returns the neighbour with the lowest id on the shortest path to the element, along an axis, up or down. The
  /// region of a link seen from its other end is mirrored, to the bit.
  ElementId binding_neighbour(const State& body, ElementId element, int k, bool up) const {
    const auto& to = *regions_.find(element);
    ElementId binding = no_element;
    body.for_each_neighbour(element, [&](ElementId neighbour, EntryId entry) {
      const auto* from = regions_.find(neighbour);
      const auto& link = body.regions[entry];
      if (from != nullptr &&
          (up ? from->low[k] - link.high[k] == to.low[k] : from->high[k] - link.low[k] == to.high[k])) {
        binding = std::min(binding, neighbour);
      }
    });
    return binding;
  }

  Offset at_{};  // of a handle of many: its displacement after the last pass
  HandleRegions<Scalar, Dimension, Schedule> regions_;
  HandleRegions<Scalar, Dimension, Schedule> prepared_;  // of all elements, for the first move of an element
  Basis prepared_for_;
  Basis made_for_;
  int threads_ = 1;                       // the regions were made with
  std::vector<Piece> pieces_;             // of this pass
  RigidHandle<Scalar, Dimension> shape_;  // of a handle of many; the members below too
  std::vector<Offset> offsets_;           // for rotation_; empty for a handle of one
  Point rotation_ = Point::Zero();
  std::string remark_;
  std::uint64_t visits_ = 0;  // in this pass
  int idle_passes_ = 0;       // passes in a row that moved few of the known elements
};

}  // namespace chainmail
