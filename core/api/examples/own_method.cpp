// A method of your own: the neighbours follow the handle ring by ring, and each element only looks at the first sponsor
// that reaches it. It is registered, then compared with Natural Queue ChainMail, which works in the same order.
#include <chainmail/chainmail.h>

#include <iostream>
#include <vector>

namespace cm = chainmail::api;

class Rings : public cm::Method {
 public:
  std::uint64_t move(cm::MovingBody& body, const cm::HandleMove& move) override {
    is_done_.assign(body.mesh().element_count(), false);
    ring_.assign(move.elements.begin(), move.elements.end());
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
  cm::register_method({.name = "rings", .label = "Rings", .source = "this example", .summary = "ring by ring"},
                      [] { return std::make_unique<Rings>(); });

  // One half of the sheet is almost rigid: what reaches an element first need not be what pulls it most.
  cm::Body sheet(cm::make_cloth(16, 16));
  std::vector<cm::LinkId> stiff;
  for (cm::LinkId link = 0; link < sheet.mesh().link_count() / 2; ++link) {
    stiff.push_back(link);
  }
  sheet.set_softness(stiff, {.compression = 0.99, .stretch = 1.01, .shear = 0.01});

  const cm::Drag drag{.name = "pull", .elements = {100}, .path = {{{-2, -1, 0}, {}}, {{-5, -3, 0}, {}}}};
  cm::CompareOptions options;
  options.methods = {"rings", "natural-queue"};
  options.repetitions = 3;
  for (const cm::ComparisonRow& row : cm::compare(sheet, {drag}, options).rows()) {
    std::cout << row.label << ": RMS distance to Exact ChainMail " << row.to_exact->rms << "\n";
  }
  return 0;
}
