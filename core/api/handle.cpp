#include "chainmail/handle.h"

#include <numbers>
#include <utility>

#include "api/access.h"

namespace chainmail::api {
namespace {

Pose pose_of(const inner::Pose& pose) {
  const double angle = pose.rotation.norm();
  if (angle == 0) {
    return {vector_of(pose.pivot), {}};
  }
  return {vector_of(pose.pivot), {vector_of(pose.rotation / angle), angle * (180 / std::numbers::pi)}};
}

}  // namespace

Handle::Handle(const Body& body, const std::vector<ElementId>& elements)
    : impl_(guarded([&] {
        const inner::Body& impl = Access::body(body);
        return std::make_unique<Impl>(Impl{inner::Handle(impl, elements), body.mesh()});
      })) {}

Handle::Handle(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Handle::Handle(const Handle& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Handle::Handle(Handle&& other) noexcept = default;
Handle& Handle::operator=(const Handle& other) {
  impl_ = std::make_unique<Impl>(*other.impl_);  // this one may have been moved from
  return *this;
}
Handle& Handle::operator=(Handle&& other) noexcept = default;
Handle::~Handle() = default;

const Mesh& Handle::mesh() const { return impl_->mesh; }
std::span<const ElementId> Handle::elements() const { return impl_->handle.elements(); }
Pose Handle::grabbed() const { return pose_of(impl_->handle.grabbed()); }
Pose Handle::pose() const { return pose_of(impl_->handle.pose()); }

Pose Handle::after(const Motion& motion) const {
  return {vector_of(impl_->handle.grabbed().pivot + point_of(motion.by)), motion.rotation};
}

void check(const Rotation& rotation, const Mesh& mesh) {
  guarded([&] { inner::check(rotation_of(rotation), *Access::pointer(mesh)); });
}

}  // namespace chainmail::api
