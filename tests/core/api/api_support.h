#pragma once

#include <chainmail/chainmail.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <vector>

namespace chainmail {

namespace cm = api;

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Returns the message of the error that an act throws. It must be one sentence: where, what, what to do.
template <class Act>
std::string refusal_of(Act act) {
  try {
    act();
  } catch (const cm::Error& error) {
    const std::string text = error.what();
    const bool is_sentence = !error.where().empty() && !error.problem().empty() && !error.remedy().empty() &&
                             text == error.where() + ": " + error.problem() + "; " + error.remedy() &&
                             text.find('\n') == std::string::npos;
    return is_sentence ? text : "not a sentence: " + text;
  }
  return "";
}

inline bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

inline bool same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}
inline cm::Mesh organ() { return cm::make_tetra(4, 3, 3); }

/// What a body contains, to see whether something changed.
struct State {
  explicit State(const cm::Body& body)
      : positions(body.positions()),
        cuts(body.cuts()),
        pins(body.pins().begin(), body.pins().end()),
        softness(body.softness()),
        elasticity(body.elasticity()),
        energy(body.energy()),
        frame(body.frame()) {
    for (cm::LinkId link = 0; link < body.mesh().link_count(); ++link) {
      softness_of_links.push_back(body.softness(link));
    }
  }
  bool operator==(const State&) const = default;

  std::vector<double> positions;
  std::vector<cm::LinkId> cuts;
  std::vector<cm::ElementId> pins;
  cm::LinkSoftness softness;
  cm::Elasticity elasticity;
  cm::EnergyKind energy;
  cm::Rotation frame;
  std::vector<cm::LinkSoftness> softness_of_links;
};
}  // namespace chainmail
