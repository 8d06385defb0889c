#pragma once

#include <random>
#include <sstream>

#include "files/session/session.h"
#include "files/support.h"

namespace chainmail::test {

inline std::string session_text(const Session& session) {
  std::ostringstream out;
  write_session(out, session);
  return out.str();
}

/// Numbers that need many digits: the limits of float, and random bits between them.
inline std::vector<double> odd_floats(std::size_t count, std::uint64_t seed) {
  std::vector<double> result{-0.0, 0.1F, 1.0F / 3, 1e-45F, -1.17549435e-38F, 2e37F, 16777217.0F, 9007199791611905.0F};
  std::mt19937_64 random(seed);
  while (result.size() < count) {
    const auto bits = static_cast<std::uint32_t>(random());
    float number = 0;
    std::memcpy(&number, &bits, sizeof number);
    if (std::abs(number) < 2e37F) {
      result.push_back(number);
    }
  }
  result.resize(count);
  return result;
}

/// Returns an object that uses all features, on a mesh of 9 elements or more.
inline Session session_on(const MeshPointer& mesh) {
  Session session;
  session.name = "an \"object\" ∆";
  session.mesh = mesh;
  session.cuts = {0, 3};
  session.pins = {1, 8};
  session.softness = std::make_shared<const Softness>(Softness{
      {0.1, 1.0 / 0.3, 1e-300, 2.0 / 3, 3.5, -0.75}, {{2, {0, 1, 7, 0.3, 1e-9, 2.5}}, {4, {}}}, EnergyKind::corotated});
  session.relaxation = {true, 1.0 / 3, RelaxationScheme::link};
  session.elastic = {{2.5, 1.0 / 3}, {2, 5, 8}, 70, {StrainLaw::Kind::gent, 1.5, 0.25}};
  const auto dimension = static_cast<std::size_t>(mesh->space_dimension);
  std::vector<double> one{1.0 / 3, -0.0, 1e300};
  one.resize(dimension);
  const auto single = Precision::single_precision, twice = Precision::double_precision;
  session.panels = {
      {Algorithm::exact, single, snapshot_of({true, {0, 2, 5, 9}, odd_floats(6 * dimension, 5)}, *mesh, single)},
      {Algorithm::spiral, twice, snapshot_of({false, {3, 4}, one}, *mesh, twice)},
      {Algorithm::generalized, single, {}}};
  session.moves = {commands::Cut{{0, 3}}, commands::Pin{{1, 8}}, commands::Grab{2}, commands::Drag{{0.1, 1.0 / 3, 0}},
                   commands::Release{}};
  session.moves_done = 4;
  session.ui = R"({"cameras":[{"yaw":0.1}]})";
  return session;
}

}  // namespace chainmail::test
