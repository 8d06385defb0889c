// Every pair of features meets once: each object is also made another way, and must move alike.

#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <functional>
#include <map>
#include <numbers>

#include "core/families.h"
#include "core/simulations.h"
#include "files/mesh/open_mesh.h"
#include "files/support.h"
#include "program.h"

namespace chainmail::test_pairs {

using namespace chainmail::test;

namespace fs = std::filesystem;

namespace {

using Ends = std::array<ElementId, 2>;

/// An object and its move, in words that do not depend on the numbers of its links.
struct Scene {
  MeshPointer mesh;
  bool splits = false;
  std::vector<Ends> cuts;
  std::vector<ElementId> pins;
  LinkSoftness global;
  std::map<Ends, LinkSoftness> own;
  RegionAxes frame;
  std::vector<EnergyKind> energies{EnergyKind::isotropic};  // one after another
  std::vector<Algorithm> algorithms;                        // the last one moves
  std::vector<ElementId> handle{0};
  double degrees = 0;  // of the handle
  int sweeps = 0;
  std::vector<RelaxationScheme> schemes{RelaxationScheme::mean};  // one after another
  bool undoes = false;                                            // something else happens in between, and is undone
  double turned = 0;                                              // degrees by which the object and its move are turned
};

Eigen::Matrix3d turn_of(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Point::UnitZ()).toRotationMatrix();
}

/// Returns a mesh whose parts were changed.
MeshPointer changed(const Mesh& mesh, const std::function<void(MeshParts&)>& change) {
  MeshParts parts;
  for (ElementId e = 0; e < mesh.element_count(); ++e) {
    parts.rest.push_back(mesh.rest_position(e));
  }
  parts.links.assign(mesh.links.begin(), mesh.links.end());
  parts.triangles = mesh.triangles;
  parts.space_dimension = mesh.space_dimension;
  change(parts);
  return build_mesh(std::move(parts));
}

/// A sheet of triangles without symmetry.
MeshPointer sheet() {
  static const MeshPointer mesh = jittered_triangles(6, 5, 2);
  return mesh;
}
/// The same with links alone.
MeshPointer net() {
  static const MeshPointer mesh = changed(*sheet(), [](MeshParts& parts) { parts.triangles.clear(); });
  return mesh;
}

SplitPointer split_of(const MeshPointer& mesh) {
  std::array corners = sheet()->triangles[21];  // none of its sides is cut
  const auto [a, b, c] = corners;
  const auto found = std::ranges::find(mesh->triangles, corners);
  const auto triangle = std::uint32_t(found - mesh->triangles.begin());
  std::ranges::sort(corners);
  const ElementId p = mesh->element_count();
  return make_split(mesh, {{{corners, {0.25, 0.5}}}, {triangle}, {{a, b, p}, {b, c, p}, {c, a, p}}, {}, {}});
}

std::vector<LinkId> ids_of(const Mesh& mesh, const std::vector<Ends>& links) {
  std::vector<LinkId> ids;
  for (const auto& [a, b] : links) {
    if (const auto id = find_link(mesh, a, b)) {
      ids.push_back(*id);
    }
  }
  std::ranges::sort(ids);
  return ids;
}

Softness softness_of(const Scene& scene, const Mesh& mesh, EnergyKind energy) {
  Softness softness{scene.global, {}, energy, scene.frame};
  for (const auto& [ends, own] : scene.own) {
    softness.links.set(ids_of(mesh, {ends}).at(0), own);
  }
  return softness;
}

/// Makes the object, moves it, and returns the positions of its elements, turned back.
std::vector<Point> answer(const Scene& scene) {
  MeshPointer mesh = scene.mesh;
  Simulation simulation(mesh, scene.algorithms.front(), Precision::double_precision);
  for (const EnergyKind energy : scene.energies) {
    simulation.apply(commands::SetSoftness{softness_of(scene, *mesh, energy)});
  }
  if (scene.splits) {
    const SplitPointer split = split_of(mesh);
    simulation.apply(commands::Split{split});
    mesh = split->after();
  }
  simulation.apply(commands::Cut{ids_of(*mesh, scene.cuts)});
  for (const ElementId pin : scene.pins) {
    simulation.apply(commands::Pin{{pin}});
  }
  for (const Algorithm algorithm : scene.algorithms) {
    simulation.apply(commands::SetAlgorithm{algorithm});
  }
  if (scene.undoes) {
    simulation.apply(commands::KeepState{1});
    simulation.apply(commands::Uncut{ids_of(*mesh, scene.cuts)});
    simulation.apply(commands::SetSoftness{Softness{{0.5, 2, 1}, {}}});
    drag_by(simulation, mesh->element_count() - 2, Point(1, 2, 0));
    simulation.relax(2, {1, simulation.relaxation().scheme});
    simulation.apply(commands::RestoreState{1});
  }
  for (const RelaxationScheme scheme : scene.schemes) {
    simulation.apply(commands::SetRelaxation{false, 1, scheme});
  }
  simulation.apply(commands::Grab{scene.handle});
  for (const double share : {0.4, 1.0}) {
    const Point way = turn_of(scene.turned) * Point(-2.3, 1.4, 0) * share;
    simulation.apply(commands::Drag{way, Rotation{Point::UnitZ(), scene.degrees * share}, true});
  }
  simulation.relax(scene.sweeps, {0.75, simulation.relaxation().scheme});
  std::vector<Point> positions;
  for (ElementId e = 0; e < mesh->element_count(); ++e) {
    positions.push_back(turn_of(-scene.turned) * position_of(simulation, e));
  }
  return positions;
}

/// A feature: it is added to a scene, and the scene can then be made another way.
struct Feature {
  const char* name;
  std::function<void(Scene&)> add;
  std::function<void(Scene&)> other_way;
};

void turn_back(Scene& scene) {
  scene.turned = -20;
  scene.frame = {};
  scene.mesh = changed(*scene.mesh, [](MeshParts& parts) {
    for (Point& point : parts.rest) {
      point = turn_of(-20) * point;
    }
  });
}

bool is_cut(const Scene& scene, Ends link) {
  std::ranges::sort(link);
  return std::ranges::count(scene.cuts, link) != 0;
}

/// Faces at cut links go with them: methods of elasticity leave them out, too.
void leave_cut_links_out(Scene& scene) {
  scene.mesh = changed(*scene.mesh, [&scene](MeshParts& parts) {
    std::erase_if(parts.links, [&scene](Ends link) { return is_cut(scene, link); });
    std::erase_if(parts.triangles, [&scene](const auto& corners) {
      return is_cut(scene, {corners[0], corners[1]}) || is_cut(scene, {corners[1], corners[2]}) ||
             is_cut(scene, {corners[2], corners[0]});
    });
  });
  std::erase_if(scene.own, [&scene](const auto& one) { return std::ranges::count(scene.cuts, one.first) != 0; });
  scene.cuts.clear();
}

void split_before(Scene& scene) {
  if (std::exchange(scene.splits, false)) {
    scene.mesh = changed(*split_of(scene.mesh)->after(), [](MeshParts&) {});
  }
}

void give_all_links_their_own(Scene& scene) {
  split_before(scene);  // the new links have the global softness
  for (Ends link : scene.mesh->links) {
    std::ranges::sort(link);
    scene.own.emplace(link, scene.global);
  }
  scene.global = {0.3, 3, 2};
}

/// Each mesh goes through a format once, because the import program takes its time.
void save_and_open(Scene& scene, const std::string& ending) {
  static std::map<std::pair<MeshPointer, std::string>, MeshPointer> opened;
  MeshPointer& again = opened[{scene.mesh, ending}];
  if (!again) {
    const QTemporaryDir folder;
    const fs::path path = folder.filePath("scene").toStdString() + ending;
    save_mesh(path, {*scene.mesh, {}, rest_positions(*scene.mesh), {}});
    again = open_mesh(path).mesh;
  }
  scene.mesh = again;
}

Feature relaxed(const char* name, RelaxationScheme scheme) {
  return {name,
          [scheme](Scene& s) {
            s.sweeps = 4;
            s.schemes = {scheme};
          },
          [](Scene& s) {
            s.schemes.insert(s.schemes.begin(), {RelaxationScheme::equilibrium, RelaxationScheme::link});
          }};
}

/// What an object can have.
std::vector<Feature> object_features() {
  const auto cut = [](Scene& s) { s.cuts = {{0, 1}, {7, 8}, {14, 15}}; };
  const auto split = [](Scene& s) {
    s.splits = true;
    s.mesh = sheet();
  };
  const auto pin = [](Scene& s) { s.pins = {29, 12, 23}; };
  const auto soften_links = [](Scene& s) { s.own = {{{0, 1}, {1, 1, 0}}, {{7, 8}, {0.5, 1.5, 0.3}}}; };
  const auto soften = [](Scene& s) { s.global = {0.6, 1.4, 0.2}; };
  const auto turn = [](Scene& s) { s.frame = {AxesKind::given, Point(0, 0, 20 * std::numbers::pi / 180)}; };
  return {{"cut", cut, leave_cut_links_out},
          {"split", split, split_before},
          {"pin", pin, [](Scene& s) { std::ranges::reverse(s.pins); }},
          {"softness of links", soften_links, give_all_links_their_own},
          {"global softness", soften, give_all_links_their_own},
          {"turned regions", turn, turn_back}};
}

/// What can be done with it.
std::vector<Feature> move_features() {
  const auto nothing = [](Scene&) {};
  const auto grab_many = [](Scene& s) {
    s.handle = {1, 0, 6};
    s.degrees = 25;
  };
  const auto try_energies = [](Scene& s) {
    s.energies.insert(s.energies.begin(), {EnergyKind::axial, EnergyKind::isotropic});
  };
  const auto try_algorithms = [](Scene& s) {
    s.algorithms.insert(s.algorithms.begin(), {Algorithm::generalized, Algorithm::exact});
  };
  return {{"energy", [](Scene& s) { s.energies = {EnergyKind::corotated}; }, try_energies},
          {"handle of many", grab_many, [](Scene& s) { std::ranges::reverse(s.handle); }},
          relaxed("sweeps", RelaxationScheme::mean),
          relaxed("sweeps by links", RelaxationScheme::link),
          relaxed("equilibrium", RelaxationScheme::equilibrium),
          {"undo", nothing, [](Scene& s) { s.undoes = true; }},
          {"another algorithm before", nothing, try_algorithms}};
}

/// The formats that are read and written, and hold links.
std::vector<Feature> format_features() {
  std::vector<Feature> list;
  for (const char* ending : {".obj", ".ply", ".vtu", ".msh"}) {
    list.push_back({ending, [](Scene&) {}, [ending](Scene& s) { save_and_open(s, ending); }});
  }
  return list;
}

const std::vector<Feature>& features() {
  static const std::vector<Feature> all = [] {
    std::vector<Feature> list;
    for (const auto& group : {object_features(), move_features(), format_features()}) {
      list.insert(list.end(), group.begin(), group.end());
    }
    return list;
  }();
  return all;
}

bool is_elastic(const Scene& scene) { return info(scene.algorithms.back()).elastic.has_value(); }

/// Turned axes, relaxation and methods of elasticity round; all else is the same to the bit.
double tolerance_of(const Scene& scene) {
  return scene.frame.is_turned() || scene.sweeps > 0 || is_elastic(scene) ? 1e-7 : 0;
}

void compare(const Scene& scene, const Scene& other) {
  const auto expected = answer(scene), found = answer(other);
  QCOMPARE(found.size(), expected.size());
  for (std::size_t e = 0; e < found.size(); ++e) {
    QVERIFY2((found[e] - expected[e]).norm() <= tolerance_of(scene),
             qPrintable(QStringLiteral("element %1: %2").arg(e).arg((found[e] - expected[e]).norm())));
  }
}

}  // namespace

class PairsTest : public QObject {
  Q_OBJECT

 private slots:
  void they_move_alike_data();
  void they_move_alike();
};

void PairsTest::they_move_alike_data() {
  QTest::addColumn<std::size_t>("one");
  QTest::addColumn<std::size_t>("other");
  QTest::addColumn<Algorithm>("algorithm");
  for (std::size_t one = 0; one < features().size(); ++one) {
    for (std::size_t other = one + 1; other < features().size(); ++other) {
      for (const Algorithm algorithm :
           {Algorithm::generalized, Algorithm::spiral, Algorithm::natural_queue, Algorithm::enhanced, Algorithm::exact,
            Algorithm::linear_fem, Algorithm::corotational, Algorithm::arap}) {
        QTest::addRow("%s and %s: %s", features()[one].name, features()[other].name, info(algorithm).name.data())
            << one << other << algorithm;
      }
    }
  }
}

void PairsTest::they_move_alike() {
  QFETCH(std::size_t, one);
  QFETCH(std::size_t, other);
  QFETCH(Algorithm, algorithm);
  Scene scene;
  scene.algorithms = {algorithm};
  scene.mesh = is_elastic(scene) ? sheet() : net();
  if (is_elastic(scene)) {
    scene.pins = {25, 12, 23};
  }
  features()[one].add(scene);
  features()[other].add(scene);
  for (const auto& ways : {std::vector{one}, std::vector{other}, std::vector{one, other}}) {
    Scene again = scene;
    for (const std::size_t way : ways) {
      features()[way].other_way(again);
    }
    compare(scene, again);
  }
}

CHAINMAIL_TEST(PairsTest)

}  // namespace chainmail::test_pairs

#include "test_pairs.moc"
