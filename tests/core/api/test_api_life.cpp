#include <QtTest>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <set>

#include "core/api/api_support.h"
#include "program.h"
#include "property.h"

namespace chainmail::test_api_life {

namespace {

/// Does something with a deformer and its handle. Returns what the deformer says; positions are compared apart.
using Action = std::function<std::string(cm::Deformer&, std::optional<cm::Handle>&)>;

std::string outcome_of(const Action& action, cm::Deformer& deformer, std::optional<cm::Handle>& handle) {
  try {
    return action(deformer, handle);
  } catch (const cm::Error& error) {
    return error.what();
  }
}

/// Largest difference of positions that two answers of a method to one state may have, in sizes of the object.
double tolerance_of(const std::string& method) {
  for (const char* follows_path :
       {"neo-hookean", "corotational", "arap", "xpbd", "projective", "quasi-newton", "neo-hookean-xpbd"}) {
    if (method == follows_path) {
      return std::numeric_limits<double>::infinity();  // far from rest, there are several answers
    }
  }
  const bool elastic = cm::method_info(method).family == cm::MethodFamily::elastic;
  return elastic ? 1e-5 : method == "exact" ? 1e-12 : 0;
}

std::string text_of(const cm::Deformer& deformer, const cm::MoveResult& result) {
  const bool counts = tolerance_of(deformer.method()) == 0;
  return (counts ? std::to_string(result.checked) + " " + std::to_string(result.moved) + " " : std::string()) +
         (result.stopped ? "stopped " : "") + result.remark.substr(0, 25);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

double size_of(const std::vector<double>& positions) {
  return largest_difference(positions, std::vector<double>(positions.size(), 0));
}

/// Draws actions. Their numbers are drawn at once, so that an action does the same to two deformers.
class Actions {
 public:
  Actions(const cm::Mesh& mesh, std::uint64_t seed) : mesh_(mesh), random_(seed) {
    for (const cm::MethodInfo& one : cm::methods()) {
      if (cm::refusal(one.name, mesh).empty()) {
        methods_.push_back(one.name);
      }
    }
  }

  Action draw() {
    const int kind = int(below(10));
    return kind < 4 ? move() : kind < 5 ? grab() : kind < 6 ? change_of_deformer() : change_of_body();
  }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  double fraction() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  cm::Vector3 vector() {
    return {3 * fraction() - 1.5, 3 * fraction() - 1.5, mesh_.space_dimension() == 2 ? 0 : 3 * fraction() - 1.5};
  }
  template <class Id>
  std::vector<Id> some(std::size_t count) {
    std::set<Id> ids;
    for (std::size_t i = 0; i <= below(3); ++i) {
      ids.insert(Id(below(count)));
    }
    return {ids.begin(), ids.end()};
  }

  Action grab() {
    return [elements = some<cm::ElementId>(mesh_.element_count())](cm::Deformer& one, auto& handle) {
      handle.emplace(one.grab(elements));
      return std::string();
    };
  }

  Action move() {
    const cm::Rotation turn{{0, 0, 1}, below(2) == 0 ? 0.0 : 20 * fraction()};
    return [motion = cm::Motion{vector(), turn}](cm::Deformer& one, auto& handle) {
      if (!handle) {
        handle.emplace(one.grab({0}));
      }
      return text_of(one, one.move(*handle, handle->after(motion)));
    };
  }

  Action change_of_deformer() {
    const std::string method = methods_[below(methods_.size())];
    const int threads = 1 + int(below(2)), kind = int(below(5));
    return [=](cm::Deformer& one, auto& handle) {
      if (kind == 0) {
        one.set_threads(threads);
      } else if (kind == 1) {
        one.release();
        handle.reset();
      } else if (kind == 2) {
        one.body().reset();
        handle.reset();  // it moves its elements from where they were grabbed
      } else {
        one.set_method(method);
      }
      return one.method();
    };
  }

  Action change_of_body() {
    const auto links = some<cm::LinkId>(mesh_.link_count());
    const auto elements = some<cm::ElementId>(mesh_.element_count());
    const double value = fraction();
    const cm::LinkSoftness softness{0.5 + value / 2, 1 + value, value / 3, value, 1 + value, -1};
    const auto energy = cm::EnergyKind(below(3));
    const std::array<std::function<void(cm::Body&)>, 11> changes{
        [=](cm::Body& body) { body.cut(links); },
        [](cm::Body& body) { body.uncut(body.cuts()); },
        [=](cm::Body& body) { body.pin(elements); },
        [](cm::Body& body) {
          body.unpin({body.pins().begin(), body.pins().end()});
        },
        [=](cm::Body& body) { body.set_softness(softness); },
        [=](cm::Body& body) { body.set_softness(links, softness); },
        [=](cm::Body& body) { body.clear_softness(links); },
        [=](cm::Body& body) { body.set_energy(energy); },
        [=](cm::Body& body) {
          body.set_frame({{0, 0, 1}, 40 * value});
        },
        [](cm::Body& body) { body.set_frame_of_object(); },
        [=](cm::Body& body) {
          body.set_elasticity({1 + value, 0.45 * value, {3, 4, 2}, 2000});
        }};
    return [change = changes[below(changes.size())]](cm::Deformer& one, auto&) {
      change(one.body());
      return std::string();
    };
  }

  cm::Mesh mesh_;
  std::mt19937_64 random_;
  std::vector<std::string> methods_;
};

}  // namespace

/// A deformer that goes through a long random life moves as a new one that was made from its body.
class ApiLifeTest : public QObject {
  Q_OBJECT

 private slots:
  void it_goes_on_as_a_new_one_data();
  void it_goes_on_as_a_new_one();
};

void ApiLifeTest::it_goes_on_as_a_new_one_data() {
  QTest::addColumn<cm::Mesh>("mesh");
  QTest::newRow("grid") << cm::make_grid(6, 5);
  QTest::newRow("cloth") << cm::make_cloth(5, 5);
  QTest::newRow("block") << cm::make_block(4, 3, 3);
  QTest::newRow("tetra") << organ();
}

void ApiLifeTest::it_goes_on_as_a_new_one() {
  QFETCH(cm::Mesh, mesh);
  const char* given = std::getenv("CHAINMAIL_LIFE_STEPS");
  const int steps = given == nullptr ? 500 : std::atoi(given);
  const auto seed = test::drawn_once.seed;
  qInfo("%d steps, seed %llu", steps, static_cast<unsigned long long>(seed));
  Actions actions(mesh, seed);
  cm::Deformer lived(mesh, "natural-queue");
  std::optional<cm::Handle> handle;
  for (int step = 0; step < steps; ++step) {
    if (step % 8 == 0) {
      lived.relax(2);  // alone, because the elements that wait for relaxation are not part of a body
    }
    cm::Deformer fresh(lived.body(), lived.method());
    std::optional<cm::Handle> again = handle;
    const double tolerance = tolerance_of(lived.method());
    const Action action = actions.draw();
    const std::string said = outcome_of(action, lived, handle), repeated = outcome_of(action, fresh, again);
    const QByteArray where = "step " + QByteArray::number(step) + " with " + QByteArray::fromStdString(lived.method()) +
                             ": " + QByteArray::fromStdString(said + " | " + repeated);
    QCOMPARE(fresh.method(), lived.method());
    if (std::isinf(tolerance)) {
      continue;
    }
    QVERIFY2(repeated == said, where);
    State one(lived.body()), other(fresh.body());
    QVERIFY2(largest_difference(one.positions, other.positions) <= tolerance * (1 + size_of(one.positions)), where);
    one.positions = other.positions;
    QVERIFY2(one == other, where);
    QVERIFY2(handle.has_value() == again.has_value(), where);
  }
}

CHAINMAIL_TEST(ApiLifeTest)

}  // namespace chainmail::test_api_life

#include "test_api_life.moc"
