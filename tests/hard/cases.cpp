#include <numbers>

#include "hard/meshes.h"
#include "hard/scene.h"

namespace chainmail::hard {
namespace {

constexpr LinkSoftness usual{0.8, 1.2, 0.1};

/// The moves of a case. It may also set the drift of the outcome.
using Act = std::function<void(Scene&, Outcome&)>;

Case make(const std::string& name, const MeshPointer& mesh, const LinkSoftness& softness, const Act& act) {
  return {name, mesh, [mesh, softness, act](const Contender& contender, Precision precision) {
            Scene scene(mesh, contender, precision, {softness, {}});
            Outcome drift;
            act(scene, drift);
            Outcome outcome = scene.outcome();
            outcome.drift = drift.drift;
            return outcome;
          }};
}

Act drag(ElementId element, const Point& by, int steps = 1) {
  return [=](Scene& scene, Outcome&) { scene.drag_by(element, by, steps); };
}

void add_softness(std::vector<Case>& all) {
  all.push_back(make("rigid (1, 1, 0) in loops", make_grid(20, 20), {1, 1, 0}, drag(210, Point(3, 2, 0), 3)));
  all.push_back(
      make("rigid triangles, jittered", test::jittered_triangles(16, 16, 1), {1, 1, 0}, drag(120, Point(3, 2, 0), 3)));
  all.push_back(make("compression 0", make_grid(20, 20), {0, 1.2, 0.1}, drag(0, Point(30, 25, 0), 5)));
  all.push_back(make("stretch 1e6", make_grid(20, 20), {0.8, 1e6, 0.1}, drag(0, Point(-1e8, 3, 0), 3)));
  all.push_back(
      make("softness changed under load", test::jittered_triangles(16, 16, 2), {0.2, 3, 1}, [](Scene& scene, Outcome&) {
        scene.drag_by(136, Point(9, -7, 0), 5);
        scene.set_softness({{0.95, 1.05, 0.02}, {}});
        scene.drag_by(136, Point(1, 1, 0));
      }));
}

void add_meshes(std::vector<Case>& all) {
  all.push_back(make("zero-length links, coincident elements", doubled_grid(12), usual, drag(150, Point(4, 3, 0), 3)));
  all.push_back(make("origin 1e7, spacing 1e-3", far_grid(20, 1e7, 1e-3), usual, drag(210, Point(0.006, 0.004, 0), 3)));
  all.push_back(make("spacings over 12 decades", decades_chain(), usual, drag(0, Point(-1e6, 0, 0), 3)));
  all.push_back(make("star of 100,000 neighbours", star(100'000), usual, drag(0, Point(3, -2, 1), 2)));
  all.push_back(make("complete graph of 300", complete_graph(300), usual, drag(7, Point(3, -2, 1), 2)));
  all.push_back(make("slivers, inverted tetrahedra", slivers(8), usual, drag(200, Point(4, -3, 2), 3)));
  all.push_back(make("disconnected parts", test::side_by_side(*make_grid(10, 10), *make_grid(10, 10), Point(30, 0, 0)),
                     usual, [](Scene& scene, Outcome& outcome) {
                       const auto before = scene.positions();
                       scene.drag_by(55, Point(60, 40, 0), 3);
                       auto after = scene.positions();
                       // The other part must not have moved: the drift is measured on it alone.
                       std::copy(before.begin(), before.begin() + 200, after.begin());
                       outcome.drift = distance_between(*make_grid(20, 10), before, after);
                     }));
}

void add_hands(std::vector<Case>& all) {
  all.push_back(make("handle at 1e30", make_grid(12, 12), usual, drag(78, Point(1e30, -1e30, 0))));
  all.push_back(make("the smallest move", make_grid(12, 12), usual, [](Scene& scene, Outcome& outcome) {
    const auto before = scene.positions();
    for (int i = 0; i < 100; ++i) {
      scene.drag_by(0, Point(1e-45, -1e-45, 0));
    }
    outcome.drift = distance_between(*make_grid(12, 12), before, scene.positions());
  }));
  all.push_back(make("cutting during a drag", make_grid(20, 20), usual, [](Scene& scene, Outcome&) {
    for (ElementId row = 0; row < 15; ++row) {
      scene.drag_by(210, Point(0.4, 0.2, 0));
      const LinkId link = *find_link(*make_grid(20, 20), row * 20 + 8, row * 20 + 9);
      scene.apply(commands::Cut{{link}});
    }
  }));
  all.push_back({"turned by 45°", turned_grid(),
                 [](const Contender& contender, Precision precision) { return turned(contender, precision); }});
}

void add_pins(std::vector<Case>& all) {
  all.push_back(make("everything else pinned", make_grid(12, 12), usual, [](Scene& scene, Outcome&) {
    std::vector<ElementId> others;
    for (ElementId e = 1; e < 144; ++e) {
      others.push_back(e);
    }
    scene.pin(others);
    scene.drag_by(0, Point(-3, -2, 0), 2);
  }));
  all.push_back(make("a border pinned, the handle far beyond", make_grid(12, 12), usual, [](Scene& scene, Outcome&) {
    std::vector<ElementId> border;
    for (ElementId row = 0; row < 12; ++row) {
      border.push_back(12 * row);
    }
    scene.pin(border);
    scene.drag_by(71, Point(1e6, 3, 0), 3);
  }));
  all.push_back(make("pins that contradict", make_grid(12, 12), {0.2, 3, 1}, [](Scene& scene, Outcome&) {
    scene.drag_by(143, Point(15, 15, 0));
    scene.pin({0, 143});
    scene.set_softness({usual, {}});
    scene.drag_by(70, Point(1, 0, 0));
  }));
}

void add_large(std::vector<Case>& all) {
  all.push_back(make("chain of 1,000,000", make_chain(1'000'000), usual, drag(0, Point(-3e5, 0, 0), 2)));
  all.push_back(make("1,000,000 tiny moves there and back", make_grid(8, 8), usual, [](Scene& scene, Outcome& outcome) {
    const Point home(3, 3, 0);  // of element 27
    const auto there_and_back = [&](int i) {
      const double turn = 2 * std::numbers::pi * (i % 100) / 100;
      scene.drag(27, home + 1e-3 * Point(std::cos(turn), std::sin(turn), 0));
      scene.drag(27, home);
    };
    scene.drag(27, home + Point(2, 1, 0));
    for (int i = 0; i < 100; ++i) {  // the first round may change the object: hysteresis, not drift
      there_and_back(i);
    }
    const auto before = scene.positions();
    for (int i = 0; i < 500'000; ++i) {
      there_and_back(i);
    }
    outcome.drift = distance_between(*make_grid(8, 8), before, scene.positions());
  }));
}

}  // namespace

std::vector<Case> cases(bool large) {
  std::vector<Case> all;
  add_softness(all);
  add_meshes(all);
  add_hands(all);
  add_pins(all);
  if (large) {
    add_large(all);
  }
  return all;
}

}  // namespace chainmail::hard
