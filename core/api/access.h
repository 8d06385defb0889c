#pragma once

#include <bit>
#include <memory>
#include <span>
#include <sstream>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "body/handle.h"
#include "chainmail/chainmail.h"
#include "files/text/outputs.h"
#include "measure/reference_solution.h"
#include "mesh/error.h"
#include "mesh/progress.h"
#include "solver/deformer.h"

namespace chainmail::api {

/// The solver library behind the interface. Both have types of the same name, like Mesh.
namespace inner = ::chainmail;

struct Job::Impl {
  JobState state;
  std::stop_source stop;
};

struct Mesh::Impl {
  MeshPointer mesh;
  OwnSoftness softness;  // of links that a file makes stiffer
  std::string remark;    // about the file
};

struct Snapshot::Impl {
  inner::Snapshot snapshot;
  Mesh mesh;
  inner::Precision precision;
};

/// A body is the body of a solver, so that a Deformer need not copy it. Without a Deformer, the solver is idle.
struct Body::Impl {
  Mesh mesh;
  std::unique_ptr<inner::Deformer> solver;

  inner::Body& body() { return solver->body(); }
  const inner::Body& body() const { return solver->body(); }
  /// Sets a softness. If the energy changes, relaxation visits all elements again.
  void set_softness(const inner::Softness& softness) {
    const std::uint64_t before = body().revisions().energy;
    body().set_softness(softness);
    if (body().revisions().energy != before && !body().is_at_rest()) {
      solver->wake_all();
    }
  }
  /// Call this after positions were set.
  void forget_handle() {
    solver->release();
    solver->set_last_handle({});
  }
};

struct Handle::Impl {
  inner::Handle handle;
  Mesh mesh;
};

struct ReferenceSolution::Impl {
  MeshPointer mesh;
  inner::ReferenceSolution reference;
};

/// Returns all blocks of elements: what a snapshot of the whole object has.
ElementBlocks every_block(const inner::Mesh& mesh);

/// Leads from the types of the interface to what is behind them.
struct Access {
  static Mesh mesh(MeshPointer mesh, OwnSoftness softness = {}, std::string remark = {}) {
    return make<Mesh>(std::move(mesh), std::move(softness), std::move(remark));
  }
  static const Mesh::Impl& impl(const Mesh& mesh) { return *mesh.impl_; }
  static const MeshPointer& pointer(const Mesh& mesh) { return mesh.impl_->mesh; }
  static Body::Impl& impl(Body& body) { return *body.impl_; }
  static const Body::Impl& impl(const Body& body) { return *body.impl_; }
  static const inner::Body& body(const Body& body) { return body.impl_->solver->body(); }
  static Handle::Impl& impl(Handle& handle) { return *handle.impl_; }
  static const Handle::Impl& impl(const Handle& handle) { return *handle.impl_; }
  static Handle handle(inner::Handle handle, Mesh mesh) {
    return Handle(std::make_unique<Handle::Impl>(Handle::Impl{std::move(handle), std::move(mesh)}));
  }
  static const ReferenceSolution::Impl& impl(const ReferenceSolution& one) { return *one.impl_; }
  static const Snapshot::Impl& impl(const Snapshot& one) { return *one.impl_; }
  /// Makes a type of the interface that shares what is behind it.
  template <class Public, class... Parts>
  static Public make(Parts&&... parts) {
    using Impl = typename Public::Impl;
    return Public(std::make_shared<const Impl>(Impl{std::forward<Parts>(parts)...}));
  }
  using MovingState = MovingBody::Impl;
  static MovingBody moving(MovingState& impl) { return MovingBody(impl); }

  static Progress progress(const Job& job) { return Progress(job.impl_->state); }
  static std::stop_token stop(const Job& job) { return job.impl_->stop.get_token(); }
};

/// Runs work behind the interface: its exceptions become those of the interface.
template <class Work>
decltype(auto) guarded(Work work) {
  try {
    return work();
  } catch (const inner::WriteFailure& error) {
    throw WriteFailure(error.where(), error.problem(), error.remedy());
  } catch (const inner::Error& error) {
    throw Error(error.where(), error.problem(), error.remedy());
  } catch (const inner::Cancelled&) {
    throw Cancelled();
  }
}

inline Vector3 vector_of(const Point& point) { return {point.x(), point.y(), point.z()}; }
inline Point point_of(const Vector3& vector) { return {vector.x, vector.y, vector.z}; }
inline inner::Precision precision_of(Precision precision) {
  return precision == Precision::single_precision ? inner::Precision::single_precision
                                                  : inner::Precision::double_precision;
}
inline inner::RelaxationScheme scheme_of(RelaxationScheme scheme) {
  static_assert(int(RelaxationScheme::equilibrium) == int(inner::RelaxationScheme::equilibrium));
  static_assert(inner::relaxation_schemes.size() == 3);
  return inner::RelaxationScheme(int(scheme));
}
/// Both have the same numbers in the same order: see the assertion in body.cpp.
constexpr inner::LinkSoftness softness_of(const LinkSoftness& softness) {
  return std::bit_cast<inner::LinkSoftness>(softness);
}
constexpr LinkSoftness softness_of(const inner::LinkSoftness& softness) {
  return std::bit_cast<LinkSoftness>(softness);
}
inline inner::EnergyKind energy_of(EnergyKind kind) { return static_cast<inner::EnergyKind>(kind); }
inline EnergyKind energy_of(inner::EnergyKind kind) { return static_cast<EnergyKind>(kind); }
inline ElasticOptions elastic_options_of(const Elasticity& one) {
  return {{one.young, one.poisson},
          one.control_points,
          one.iterations,
          {inner::StrainLaw::Kind(one.law), one.gent_limit, one.fung_exponent},
          one.thickness};
}
inline inner::Rotation rotation_of(const Rotation& rotation) { return {point_of(rotation.axis), rotation.degrees}; }

/// Returns what write(stream) writes.
template <class Write>
std::string written(Write write) {
  std::ostringstream out;
  write(out);
  return std::move(out).str();
}

/// Throws Error: a part of the library was not built, for want of these libraries.
[[noreturn]] void refuse_without(const std::string& libraries, const std::string& where);

// These functions throw Error about an argument.
void check_id(const inner::Mesh& mesh, ElementId element);
void check_ids(const inner::Mesh& mesh, std::span<const ElementId> elements);
void check_link_ids(const inner::Mesh& mesh, std::span<const LinkId> links);
/// On axes that do not exist, a coordinate must be 0 or, unless it is a displacement, that of the object.
void check_coordinates(const inner::Mesh& mesh, const std::string& where, const Vector3& vector, bool is_displacement);
/// Returns the softness of single links, in groups: a link whose softness others share costs four bytes.
OwnSoftness own_softness_of(std::vector<OwnSoftness::Entry> entries);
/// Returns the algorithm with this name; names all of them otherwise.
Algorithm algorithm_of(std::string_view name);

/// Returns the positions of a view: x, y, z for each element.
std::vector<double> positions_of(const inner::Mesh& mesh, const PositionView& positions);
/// Returns positions, x, y, z for each element, without the coordinates that do not exist. Throws Error if there are
/// not as many as the mesh has, or if one is not finite, beyond the limit, or on an axis that does not exist.
std::vector<double> active_coordinates_of(const inner::Mesh& mesh, std::span<const double> positions, double limit);

}  // namespace chainmail::api
