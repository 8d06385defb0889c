#include "report/page/looks.h"

#include <algorithm>
#include <array>

namespace chainmail::report {
namespace {

/// In the order of every_algorithm. Shapes differ, so that no mark needs its colour; colours are of Okabe and Ito
/// (2008) as far as they reach, and differ in lightness from there on.
constexpr std::array looks{
    Look{"M-.9-.9H.9V.9H-.9Z", "#d55e00"},                                  // square
    Look{"M0-1.2L1.15.85H-1.15Z", "#56b4e9"},                               // triangle
    Look{"M-1 0A1 1 0 1 0 1 0A1 1 0 1 0-1 0Z", "#0072b2"},                  // circle
    Look{"M0 1.2L1.15-.85H-1.15Z", "#009e73"},                              // triangle on its tip
    Look{"M-.4-1.1H.4V-.4H1.1V.4H.4V1.1H-.4V.4H-1.1V-.4H-.4Z", "#cc79a7"},  // cross
    Look{"M0-1.4L1.1 0L0 1.4L-1.1 0Z", ""},                                 // diamond
    Look{"M-1.2-.55H1.2V.55H-1.2Z", "#b8a400"},                             // bar
    Look{"M0-1.4L.35-.45L1.33-.43L.56.17L.82 1.13L0 .58L-.82 1.13L-.56.17L-1.33-.43L-.35-.45Z", "#e69f00"},  // star
    Look{"M-1.1-.65L-.65-1.1L0-.45L.65-1.1L1.1-.65L.45 0L1.1.65L.65 1.1L0 .45L-.65 1.1L-1.1.65L-.45 0Z",
         "#882255"},                                            // cross of Saint Andrew
    Look{"M-.6-1.05H.6L1.2 0L.6 1.05H-.6L-1.2 0Z", "#5b4bb5"},  // hexagon
};

}  // namespace

std::size_t look_of(Algorithm algorithm) {
  const auto all = every_algorithm();
  return static_cast<std::size_t>(std::ranges::find(all, algorithm, &AlgorithmInfo::algorithm) - all.begin());
}

const Look& look_at(std::size_t place) { return looks[place % looks.size()]; }

}  // namespace chainmail::report
