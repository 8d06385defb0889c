#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace chainmail {

struct Mesh;

/// How much material each link stands for: the volume of the cells at the link (their area, if they are faces), divided
/// by the mean of this over the links. A link at the boundary has fewer cells than one inside. A link without a cell,
/// and every link of a mesh without cells, counts as 1.
///
/// Springs with stiffnesses in proportion to this are close to an elastic solid (Van Gelder 1998).
class LinkShares {
 public:
  /// Returns the shares, in the order of links; empty if all are 1. They are computed on the first call, which takes
  /// about 0.5 µs per link. Safe to call from several threads.
  const std::vector<float>& of(const Mesh& mesh) const;

 private:
  struct Cache {
    /// Not std::call_once: an exception through it ends the program where little memory is left (glibc 2.36).
    std::mutex mutex;
    bool is_filled = false;
    std::vector<float> shares;
  };

  std::shared_ptr<Cache> cache_ = std::make_shared<Cache>();
};

}  // namespace chainmail
