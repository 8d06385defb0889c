// A method of your own: the neighbours follow the handle ring by ring, and each element only looks at the first sponsor
// that reaches it. It is registered, then compared with Natural Queue ChainMail, which works in the same order.
#include <chainmail/chainmail.h>
#include <chainmail/report/run/compare.h>
#include <chainmail/solver/custom_method.h>

#include <iostream>
#include <numeric>
#include <vector>

namespace cm = chainmail;

class Rings : public cm::CustomMethod {
 public:
  std::uint64_t answer(cm::MovingBody& body, const cm::MovedHandle& handle) override {
    is_done_.assign(body.mesh().element_count(), false);
    ring_.assign(handle.elements.begin(), handle.elements.end());
    for (const cm::ElementId element : ring_) {
      is_done_[element] = true;
    }
    std::uint64_t checked = 0;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const cm::ElementId sponsor = ring_[i];
      for (const cm::ElementId element : body.neighbours(sponsor)) {
        if (!is_done_[element] && !body.is_fixed(element)) {
          is_done_[element] = true;
          ++checked;
          if (body.clamp(element, sponsor)) {
            ring_.push_back(element);  // its neighbours are next
          }
        }
      }
    }
    return checked;
  }

 private:
  std::vector<bool> is_done_;
  std::vector<cm::ElementId> ring_;
};

int main() {
  const cm::Algorithm rings =
      cm::register_method({.name = "rings", .label = "Rings", .source = "this example", .summary = "ring by ring"},
                          [] { return std::make_unique<Rings>(); });

  // One half of the sheet is almost rigid: what reaches an element first need not be what pulls it most.
  cm::Body sheet(cm::generate({cm::MeshKind::cloth, {16, 16, 1}}), cm::Precision::double_precision);
  std::vector<cm::LinkId> stiff(sheet.mesh().link_count() / 2);
  std::iota(stiff.begin(), stiff.end(), 0);
  cm::Softness softness;
  softness.links.set(stiff, {.compression = 0.99, .stretch = 1.01, .shear = 0.01});
  sheet.set_softness(softness);

  cm::report::Case object = cm::report::case_of(sheet, "sheet");
  object.drags = {cm::report::drag_along("pull", sheet, {100}, {{{-2, -1, 0}}, {{-5, -3, 0}}})};
  cm::report::CompareOptions options;
  options.algorithms = {rings, cm::Algorithm::natural_queue};
  options.sweeps = {0};
  options.repetitions = 3;
  const cm::report::Results results = cm::report::compare({object}, options);
  for (const cm::report::Row& row : results.rows) {
    std::cout << label(row.contestant) << ": RMS distance to Exact ChainMail "
              << *row[cm::report::figures::exact_distance_rms] << "\n";
  }
  return 0;
}
