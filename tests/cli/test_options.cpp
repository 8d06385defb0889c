#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <thread>
#include <vector>

#include "cli/chainmail_program.h"
#include "program.h"

namespace chainmail::test_options {

using namespace chainmail::test;

namespace {

// The table

/// A way to use a subcommand: arguments with which it takes milliseconds, inputs first.
struct Setting {
  const char* name;
  const char* line;
  int together;  // options in one run: more of them need fewer runs, and hide more of each other's effects;
                 // 1: each alone, 0: only refusals
};
constexpr Setting settings[]{
    {"generate", "generate grid 3x3 -o a.obj", 2},
    {"convert", "convert cloth.obj -o a.vtu", 2},
    {"fill", "fill closed.off -o a.vtu", 2},
    {"repair", "repair broken.off -o a.vtu --json a.json", 2},
    {"simplify", "simplify seam.obj -o a.vtu --elements 31", 2},
    {"info", "info cloth.obj --json a.json", 2},
    {"deform", "deform block.vtu --algorithm natural-queue --relax 1 --by 1:0.3 --json a.json --positions a.csv", 5},
    {"calibrate", "calibrate cloth.obj --pins left --evaluations 1 --drags 1 --json a.json -o p.json", 3},
    {"ramp", "ramp --largest 16 --budget 3600 --algorithms exact --json a.json", 2},
    {"exact", "compare cloth.obj --algorithms natural-queue,exact --relax 0,3 --repetitions 1 -o out", 4},
    {"physics",
     "compare cloth.obj --against physics --pins left --algorithms natural-queue,ffd,xpbd --relax 0,3 --repetitions 1 "
     "-o out",
     5},
    {"refined",  // takes a second
     "compare cloth.obj --against physics --pins left --algorithms natural-queue --relax 0 --repetitions 1 -o out", 1},
    {"suite", "compare --suite --experiments refinement --algorithms exact --repetitions 1 -o out", 8},
    {"judge", "compare case.json answer.json --judge", 2},
    {"merge", "compare none.json --merge -o out", 0},  // test_suite.cpp runs it
    {"cases", "compare --cases -o out", 0},            // it takes minutes
    {"completion", "completion bash", 2},
};

/// What an option does. To add an option, add a row.
struct Row {
  const char* settings;  // that take it
  const char* option;
  const char* right;    // its value; "" for none; or several arguments, if it needs others beside it
  const char* wrong;    // values that are refused before an input is opened, between bars; "" if there is none
  const char* with;     // arguments without which it has no effect
  const char* changes;  // parts of the result that may change; one of them does, in one of its settings; or why nothing
};
constexpr Row rows[]{
    {"convert info repair deform", "--size", "6x2", "4x0|4|4x3x1x1", "grid.dat", "mesh object motion energy"},
    {"calibrate", "--size", "4x3", "4x0", "grid.dat", "nothing: the file has this size"},
    {"convert info repair deform calibrate", "--spacing", "2", "0", "grid.dat", "mesh object motion energy"},
    {"convert info repair deform calibrate", "--threshold", "15", "x", "voxels.mha",
     "mesh object pins before after motion energy drags figures"},
    {"convert info repair deform calibrate", "--voxels", "2", "0", "voxels.mha",
     "mesh object pins before after motion energy drags figures"},
    {"convert info repair deform calibrate", "--density-softness", "off", "half", "voxels.mha", "motion energy"},
    {"convert info repair deform calibrate", "--data-outside", "allow", "maybe", "voxels.mha",
     "nothing: all data is in the file"},
    {"convert info deform calibrate", "--weld", "0.1", "-1", "near.obj",
     "mesh object pins motion energy drags figures"},
    {"simplify", "--weld", "0.1", "-1", "", "mesh"},
    {"generate", "--spacing", "2", "0", "", "mesh"},
    {"generate", "--space", "3", "4", "", "mesh"},
    {"generate", "-o", "b.obj", "none/a.obj", "", "files"},
    {"convert", "-o", "b.vtu", "none/a.obj", "", "files"},
    {"fill", "--edge", "0.7", "0", "", "mesh"},
    {"fill", "-o", "b.vtu", "none/a.vtu", "", "files"},
    {"repair", "--weld", "0", "-1", "--cells", "mesh after duplicate_vertices"},
    {"repair", "--loose", "", "", "--cells", "mesh after loose_points"},
    {"repair", "--holes", "", "", "broken.off --cells", "mesh after holes hole_edges"},
    {"repair", "--cells", "", "", "turned.mesh --loose", "mesh inverted_cells"},
    {"repair", "--json", "b.json", "none/a.json", "", "files"},
    {"repair", "-o", "b.vtu", "none/a.obj", "", "files"},
    {"simplify", "--elements", "30", "0", "", "mesh"},
    {"simplify", "-o", "b.vtu", "none/a.obj", "", "files"},
    {"info", "--json", "b.json", "none/a.json", "", "files"},
    {"deform", "--algorithm", "exact", "best", "", "algorithm motion energy"},
    {"deform", "--compression", "0.9", "1.1|-0.1", "", "motion energy"},
    {"deform", "--stretch", "1.1", "0.9", "", "motion energy"},
    {"deform", "--shear", "0.2", "-1", "", "motion energy"},
    {"deform", "--lateral", "0.5", "-0.1", "", "motion energy"},
    {"deform", "--stiffness", "2", "0", "", "motion energy"},
    {"deform", "--exponent", "1", "5|-4.1", "", "motion energy"},
    {"deform", "--energy", "axial", "elastic", "", "motion energy"},
    {"deform", "--frame", "z:45", "sideways", "", "motion energy"},
    {"deform", "--softness", "soft.csv", "none.csv", "", "motion energy"},
    {"deform", "--relax", "5", "-1|x", "", "motion energy"},
    {"deform", "--relaxation", "link", "none", "", "motion energy"},
    {"deform", "--relax-step", "0.5", "0|1.5", "", "motion energy"},
    {"deform", "--relax-until", "0.5", "-1", "--relaxation equilibrium --relax 200", "motion energy"},
    {"deform", "--local", "on", "maybe", "--relaxation equilibrium --relax 200", "nothing: the object is small"},
    {"deform", "--precision", "float", "half", "", "motion energy"},
    {"deform", "--young", "2", "0", "", "energy"},
    {"deform", "--poisson", "0.4", "0.5", "", "motion energy"},
    {"deform", "--material", "gent", "rubber", "", "motion energy"},
    {"deform", "--gent-limit", "3", "0", "--material gent", "motion energy"},
    {"deform", "--fung-exponent", "0.2", "-1", "--material fung", "motion energy"},
    {"deform", "--thickness", "0.1", "0", "cloth.obj --space 3 --relaxation equilibrium --relax 20 --by 1:0,0,0.1",
     "motion energy"},
    {"deform", "--lattice", "2", "0", "--algorithm ffd", "motion energy"},
    {"deform", "--iterations", "2", "0", "block.vtu --algorithm xpbd --pin left", "motion energy"},
    {"deform", "--space", "3", "4|0", "cloth.obj", "motion energy"},
    // A split after a move meets other cells.
    {"deform", "--move", "4:-0.5,0.3", "0:x", "", "motion energy object"},
    {"deform", "--by", "7:-0.3,0.2", "0:x", "", "motion energy object"},
    {"deform", "--grab", "--grab 4,7 --by 0.2,0.3", "roof", "", "motion energy object"},
    {"deform", "--rotate", "--grab 4,7 --rotate z:30", "z:x", "", "motion energy object"},
    {"deform", "--cut", "0-1", "0", "", "motion energy"},
    // Across the block at rest, then where a relaxation without pins takes it.
    {"deform", "--split", "--split 3,0.5,0;-3,0.5,0;-3,-0.2,0;3,-0.2,0 --along 0,0,1", "0,0;1,x|0,0;", "block.vtu",
     "motion energy object"},
    {"deform", "--along", "--split 3,0.5;-1,0.5 --along 0.2,0.1,1", "x|0,0,1", "cloth.obj", "motion energy object"},
    {"deform", "--pin", "2", "roof", "", "motion energy"},
    {"deform", "--steps", "3", "0|1.5|-1|1e3", "", "motion energy"},
    {"deform", "--script", "moves.json", "none.json", "", "motion energy object"},
    {"deform", "--positions", "b.csv", "none/a.csv", "", "files"},
    {"deform", "--trace", "t.csv", "none/t.csv", "", "files"},
    {"deform", "--json", "b.json", "none/a.json", "", "files"},
    {"calibrate", "--space", "2", "4", "", "nothing: the default"},
    {"calibrate", "--young", "2", "0", "", "young"},
    {"calibrate", "--poisson", "0.4", "0.5", "", "poisson figures presets"},
    {"calibrate", "--pins", "bottom", "roof", "", "pins drags figures"},
    {"calibrate", "--algorithm", "exact", "fem", "", "contestants figures"},
    {"calibrate", "--relaxation", "mean", "none", "", "relaxation figures"},
    {"calibrate", "--energy", "axial", "elastic", "", "energy figures"},
    {"calibrate", "--drags", "2", "0", "", "drags contestants figures"},
    {"calibrate", "--seed", "7", "-1", "", "seed drags figures"},
    {"calibrate", "--evaluations", "3", "0", "", "evaluations figures"},
    {"calibrate", "--name", "felt", " ", "", "presets"},
    {"calibrate", "-o", "q.json", "none/p.json", "", "files"},
    {"calibrate", "--json", "b.json", "none/a.json", "", "files"},
    {"ramp", "--algorithms", "spiral", "best", "", "contestants figures"},
    {"ramp", "--seed", "7", "-1", "", "seed figures"},
    {"ramp", "--budget", "4000", "0", "", "budget"},
    {"ramp", "--largest", "25", "15", "", "largest object pins drags contestants figures"},
    {"ramp", "--precision", "double", "half", "", "precision figures"},
    {"ramp", "--compression", "0.9", "1.1", "", "compression figures"},
    {"ramp", "--stretch", "1.1", "0.9", "", "stretch figures"},
    {"ramp", "--shear", "0.2", "-1", "", "shear figures"},
    {"ramp", "--json", "b.json", "none/a.json", "", "files"},
    {"ramp", "--csv", "a.csv", "none/a.csv", "", "files"},
    {"ramp", "--svg", "a.svg", "none/a.svg", "", "files"},
    {"exact", "--against", "exact", "chance", "", "nothing: the default"},
    {"physics", "--against", "physics", "chance", "", "nothing: the setting has it"},
    {"exact physics", "--algorithms", "spiral", "best", "", "contestants repetitions figures files"},
    {"exact physics", "--relax", "2", "-1", "", "contestants repetitions figures files"},
    {"exact physics", "--relaxation", "link", "none", "", "relaxation figures"},
    {"exact physics", "--relax-step", "0.5", "0", "", "relax_step figures"},
    {"exact physics", "--precision", "double", "half", "", "precision figures"},
    {"exact physics suite", "--repetitions", "2", "0", "", "repetitions"},
    {"exact physics", "--quick", "", "", "", "drags contestants repetitions figures files"},
    {"exact physics", "--compression", "0.9", "1.1", "", "drags figures"},
    {"exact physics", "--stretch", "1.1", "0.9", "", "drags figures"},
    {"exact physics", "--shear", "0.2", "-1", "", "drags figures"},
    {"exact physics", "--lateral", "0.5", "-0.1", "", "figures"},
    {"exact physics", "--stiffness", "2", "0", "", "figures"},
    {"exact physics", "--exponent", "1", "5", "", "figures"},
    {"exact physics", "--energy", "axial", "elastic", "", "figures"},
    {"exact physics", "--frame", "z:45", "sideways", "", "drags figures"},
    {"exact physics", "--preset", "preset.json", "none", "", "drags figures"},
    {"exact physics", "-o", "other", "cloth.obj/out", "", "files"},
    {"exact physics", "--pins", "bottom", "roof", "", "pins drags figures"},
    {"exact physics", "--young", "2", "0", "", "young"},
    {"exact physics", "--poisson", "0.4", "0.5", "", "poisson figures"},
    {"exact physics", "--lattice", "2", "0", "", "lattice figures"},
    {"exact physics", "--iterations", "2", "0", "", "iterations repetitions figures"},
    {"exact", "--moves", "moves.json", "none.json", "", "drags contestants repetitions figures files"},
    {"physics", "--material", "gent", "rubber", "", "object figures"},
    {"physics", "--gent-limit", "3", "0", "--material gent", "object figures"},
    {"physics", "--fung-exponent", "0.2", "-1", "--material fung", "object figures"},
    {"refined", "--reference", "refined", "best", "", "object drags contestants repetitions figures files"},
    {"physics", "--reference", "same-cells", "best", "", "nothing: the default"},
    {"physics", "--handles", "2", "4", "", "drags contestants repetitions figures"},
    {"physics", "--grow", "1e-9", "-1", "", "object pins drags contestants repetitions figures files"},
    {"physics", "--calibrated", "on", "maybe", "", "object contestants repetitions figures"},
    {"suite", "--algorithms", "spiral", "best", "", "contestants repetitions figures files"},
    {"suite", "--calibrated", "off", "maybe", "", "nothing: the experiment calibrates nobody"},
    {"suite", "--shard", "1/1", "2/1", "", "nothing: one shard is all"},
    {"suite", "--experiments", "refinement", "none", "", "nothing: the setting has it"},
    {"suite", "--suite", "", "", "", "nothing: the setting has it"},
    {"suite", "-o", "other", "case.json/out", "", "files"},
    {"judge", "--judge", "", "", "", "nothing: the setting has it"},
    {"merge", "--merge", "", "", "", "nothing: the setting has it"},
    {"merge cases", "-o", "other", "", "", "nothing: the setting does not run"},
    {"cases", "--cases", "", "", "", "nothing: the setting has it"},
};

/// Actions of `deform`, which may be given several times.
const QStringList actions{"--move", "--by", "--grab", "--rotate", "--cut", "--split", "--along", "--pin"};

/// A surface with a duplicate corner, a loose point, a hole and a fin.
constexpr const char* broken =
    "OFF\n11 11 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n0 0 0\n7 7 7\n3 3 0\n"
    "3 0 2 1\n3 8 3 2\n3 0 1 5\n3 8 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n3 1 2 10\n";
/// Two cells, one of them inside out.
constexpr const char* turned =
    "MeshVersionFormatted 2 Dimension 3 Vertices 5 0 0 0 1 1 0 0 1 0 1 0 1 0 0 1 1 1 1 1 1 Tetrahedra 2 1 2 3 4 1 "
    "2 3 5 4 1 End";
constexpr const char* closed = "OFF\n4 4 0\n0 0 0\n3 0 0\n0 3 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
/// Two strips whose borders are 0.05 apart.
constexpr const char* near =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\nv 0 1.05 0\nv 1 1.05 0\nv 2 1.05 0\n"
    "v 3 1.05 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\nv 3 2 0\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
    "f 9 10 14\nf 9 14 13\nf 10 11 15\nf 10 15 14\nf 11 12 16\nf 11 16 15\n";
/// Two sheets of 5 by 4 elements whose borders are 0.05 apart.
QByteArray seam() {
  QByteArray corners, faces;
  for (int i = 0; i < 40; ++i) {
    const int row = i / 5, column = i % 5;
    corners += "v " + QByteArray::number(column) + ' ' + QByteArray::number(row < 4 ? row : row - 0.95) + " 0\n";
    if (column < 4 && row % 4 < 3) {
      for (const auto& [a, b, c] : {std::array{1, 2, 7}, std::array{1, 7, 6}}) {
        faces +=
            "f " + QByteArray::number(i + a) + ' ' + QByteArray::number(i + b) + ' ' + QByteArray::number(i + c) + '\n';
      }
    }
  }
  return corners + faces;
}
constexpr const char* moves =
    R"({"version": 1, "commands": [{"do": "pin", "elements": [0, 3, 6]}, {"do": "grab", "element": 4},
        {"do": "drag", "target": [0.4, 0.3, 0]}]})";
constexpr const char* preset =
    R"({"version": 1, "presets": [{"name": "felt", "compression": 0.7, "stretch": 1.3, "shear": 0.2, "lateral": 1,
        "stiffness": 1, "exponent": -1}]})";

QByteArray voxels() {
  return "ObjectType = Image\nNDims = 3\nDimSize = 8 8 4\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" +
         QByteArray("\x0a\x14\x1e\x28\x32\x3c\x46\x50").repeated(32);
}

/// Writes the inputs of all settings.
void write_inputs(const Program& program) {
  for (const char* line :
       {"generate tetra 3x2x2 -o block.vtu", "generate grid 4x3 -o grid.dat", "generate cloth 3x3 -o cloth.obj"}) {
    QCOMPARE(program.run(line).code, 0);
  }
  program.write("broken.off", broken);
  program.write("closed.off", closed);
  program.write("near.obj", near);
  program.write("seam.obj", seam());
  program.write("turned.mesh", turned);
  program.write("moves.json", moves);
  program.write("preset.json", preset);
  program.write("soft.csv", "0,1,0.9,1.1,0.1\n");
  program.write("voxels.mha", voxels());
  QFile file(sourceFile("tests/peers/bar-bend.json"));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QByteArray text = file.readAll();
  program.write("case.json", text);
  const QJsonObject peer = QJsonDocument::fromJson(text).object();
  program.write("answer.json", QJsonDocument(QJsonObject{{"kind", "chainmail answer"},
                                                         {"schema_version", 1},
                                                         {"solver", "perfect"},
                                                         {"case", peer["name"]},
                                                         {"positions", peer["reference"]}})
                                   .toJson());
}

// Results

/// The parts of JSON outputs by the paths of their members; the first expression that matches decides. An empty part
/// is not compared: times, and what tells about the run or is derived from other parts.
const QList<std::pair<QRegularExpression, QString>>& parts_by_path() {
  static const QList<std::pair<QRegularExpression, QString>> all = [] {
    QList<std::pair<QRegularExpression, QString>> list;
    for (const auto& [paths, part] : std::initializer_list<std::pair<const char*, const char*>>{
             {"ms_per_move[.]repetitions$", "repetitions"},
             {"_ms|ms_per|milliseconds|seconds$|p99|real_time|growth$|bytes|notes|description", ""},
             {"^(origin|figures|kind|schema_version|runs|sizes|algorithms|version|stopped)", ""},
             {"^objects[.]drags[.]contestants([.]algorithm)?$", "contestants"},
             {"^(displacement|violation|shape|passes|equilibrium|cells|parts|volume|worst_quality)", "motion"},
             {"^objects[.](drags[.])?contestants|residual|[.]reference", "figures"},
             {"^(objects[.])?drags", "drags"},
             {"^objects[.]pins", "pins"},
             {"^(objects|bounds|elements|links|triangles|tetrahedra|hexahedra|mean_link_length|object_dimension|"
              "space_dimension|components|joined|left_out|flaws|defects|read_as)",
              "object"},
             {"^(compression|stretch|shear|lateral|stiffness|exponent|sweeps|presets[.](?!name))", "figures"}}) {
      list.append({QRegularExpression(paths), part});
    }
    return list;
  }();
  return all;
}

QString part_of(const QString& path) {
  for (const auto& [paths, part] : parts_by_path()) {
    if (paths.match(path).hasMatch()) {
      return part;
    }
  }
  const bool is_last = path.startsWith("options.") || path.startsWith("after.defects.");
  return is_last ? path.section('.', -1) : path.section('.', 0, 0);
}

using Parts = std::map<QString, QStringList>;

/// Adds all values with their paths to their parts. Numbers are rounded, because the unit of a force changes the last
/// digits of an answer.
void add_parts(Parts& parts, const QString& path, const QJsonValue& value) {
  const auto add = [&](const QString& text) {
    if (const QString part = part_of(path); !part.isEmpty()) {
      parts[part].append(path + '=' + text);
    }
  };
  if (value.isObject()) {
    const QJsonObject object = value.toObject();
    for (auto member = object.begin(); member != object.end(); ++member) {
      add_parts(parts, path.isEmpty() ? member.key() : path + '.' + member.key(), member.value());
    }
  } else if (value.isArray()) {
    add(QString("%1 values").arg(value.toArray().size()));
    for (const QJsonValue one : value.toArray()) {
      add_parts(parts, path, one);
    }
  } else {
    add(value.isDouble() ? QString::number(value.toDouble(), 'f', 6) : value.toVariant().toString());
  }
}

struct Result {
  Outcome outcome;
  QStringList files;  // new ones
  Parts parts;

  bool is_refused() const { return outcome.code == 2 && is_one_sentence(outcome) && files.isEmpty(); }
};

/// Runs the program in a folder with the inputs, and reads and removes what it writes.
class Runner {
 public:
  Runner() {
    write_inputs(program_);
    inputs_ = program_.files();
  }

  Result run(const QStringList& line) const {
    Result result{program_.run(line), {}, {}};
    for (const QString& name : program_.files()) {
      if (!inputs_.contains(name)) {
        result.files.append(name);
      }
    }
    std::stable_partition(result.files.begin(), result.files.end(),
                          [](const QString& name) { return name.endsWith(".json"); });
    for (const QString& name : QStringList(result.files)) {
      take(result, name);
    }
    for (const QString& name : result.files) {
      result.parts["files"].append(name);
    }
    return result;
  }

 private:
  void take(Result& result, const QString& name) const {
    if (const QDir folder(program_.path(name)); folder.exists()) {
      result.files.append(folder.entryList(QDir::Files));
      add_parts(result.parts, {}, program_.json(name + "/report.json"));
      QVERIFY(QDir(folder).removeRecursively());
      return;
    }
    const QByteArray text = program_.read(name);
    if (name.endsWith(".json")) {
      add_parts(result.parts, {}, QJsonDocument::fromJson(text).object());
    } else if (text.startsWith("id,")) {
      result.parts["motion"].append(text);
    } else if (name.endsWith(".obj") || name.endsWith(".vtu")) {
      result.parts["mesh"].append(text);
    }
    QVERIFY(QFile::remove(program_.path(name)));
  }

  Program program_;
  QStringList inputs_;
};

/// Runs the program on all cores. What was run is not run again.
class Runs {
 public:
  using Job = std::function<QString(Runs&, const Runner&)>;  // returns what is wrong

  Runs() : runners_(std::max(2U, std::thread::hardware_concurrency())) {}

  const Result& get(const Runner& runner, const QStringList& line) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto found = results_.find(line); found != results_.end()) {
        return found->second;
      }
    }
    Result result = runner.run(line);
    const std::lock_guard lock(mutex_);
    return results_.emplace(line, std::move(result)).first->second;  // which stays where it is
  }

  /// Runs all jobs and returns what is wrong.
  QString run(const std::vector<Job>& jobs) {
    QStringList wrong;
    std::size_t next = 0;
    {
      std::vector<std::jthread> threads;
      for (const Runner& runner : runners_) {
        threads.emplace_back([&] {
          for (std::unique_lock lock(mutex_); next < jobs.size();) {
            const Job& job = jobs[next++];
            lock.unlock();
            const QString one = job(*this, runner);
            lock.lock();
            if (!one.isEmpty()) {
              wrong.append(one);
            }
          }
        });
      }
    }
    return wrong.join('\n');
  }

 private:
  std::vector<Runner> runners_;
  std::mutex mutex_;
  std::map<QStringList, Result> results_;
};

QStringList changed(const Result& one, const Result& other) {
  QStringList names;
  for (const auto* parts : {&one.parts, &other.parts}) {
    for (const auto& [name, values] : *parts) {
      const auto in_one = one.parts.find(name), in_other = other.parts.find(name);
      const bool is_same =
          in_one != one.parts.end() && in_other != other.parts.end() && in_one->second == in_other->second;
      if (!is_same && !names.contains(name)) {
        names.append(name);
      }
    }
  }
  return names;
}

// Arguments

struct Argument {
  QString option;  // empty for an input
  QString value;

  bool excludes(const Argument& other) const { return option == other.option && !actions.contains(option); }
};
using Arguments = QList<Argument>;

Arguments arguments_in(const QString& line) {
  Arguments all;
  for (const QString& word : line.split(' ', Qt::SkipEmptyParts)) {
    if (word.startsWith('-')) {
      all.append({word, {}});
    } else if (!all.isEmpty() && !all.back().option.isEmpty() && all.back().value.isEmpty()) {
      all.back().value = word;
    } else {
      all.append({{}, word});
    }
  }
  return all;
}

bool is_excluded(const Argument& one, const Arguments& by) {
  return std::ranges::any_of(by, [&](const Argument& other) { return other.excludes(one); });
}

/// Adds arguments unless others exclude them.
void add(Arguments& all, const Arguments& more) {
  const Arguments before = all;
  std::ranges::copy_if(more, std::back_inserter(all), [&](const Argument& one) { return !is_excluded(one, before); });
}

Arguments own_of(const Row& row, const QString& value) {
  return value.contains(row.option) ? arguments_in(value) : Arguments{{row.option, value}};
}

/// Returns a line of a setting, with options. An option takes the place of the one that it excludes.
QStringList line_of(const Setting& setting, const Arguments& options) {
  const Arguments usual = arguments_in(QString(setting.line).section(' ', 1));
  QStringList inputs, rest;
  const auto append = [&](const Argument& one) {
    (one.option.isEmpty() ? inputs : rest)
        .append(one.option.isEmpty() ? QStringList{one.value} : QStringList{one.option});
    if (!one.option.isEmpty() && !one.value.isEmpty()) {
      rest.append(one.value);
    }
  };
  std::ranges::for_each(options, append);
  for (const Argument& one : usual) {
    if (!is_excluded(one, options)) {
      append(one);
    }
  }
  return QStringList{QString(setting.line).section(' ', 0, 0)} + inputs + rest;
}

using Rows = QList<const Row*>;

/// Returns a line with what all these rows need, and with the options of some of them.
QStringList line_of(const Setting& setting, const Rows& all, const Rows& some) {
  Arguments needed, given;
  for (const Row* row : some) {
    add(given, own_of(*row, row->right));
  }
  for (const Row* row : all) {
    Arguments more = arguments_in(row->with);
    erase_if(more, [&](const Argument& one) { return is_excluded(one, given); });
    add(needed, more);
  }
  return line_of(setting, needed + given);
}

QStringList words_of(const char* text) { return QString(text).split(' ', Qt::SkipEmptyParts); }

Rows rows_of(const Setting& setting) {
  Rows found;
  for (const Row& row : rows) {
    if (words_of(row.settings).contains(setting.name)) {
      found.append(&row);
    }
  }
  return found;
}

/// True if two options need different values of a third one, or different inputs. They may be refused together.
bool conflict(const Row& one, const Row& other) {
  const Arguments a = arguments_in(one.with) + own_of(one, one.right),
                  b = arguments_in(other.with) + own_of(other, other.right);
  return std::ranges::any_of(a, [&](const Argument& mine) {
    return std::ranges::any_of(
        b, [&](const Argument& theirs) { return mine.excludes(theirs) && mine.value != theirs.value; });
  });
}

/// Returns sets of options that have each pair at least once. Those of a conflict are alone.
QList<Rows> covering_sets(const Setting& setting) {
  using Pair = std::pair<const Row*, const Row*>;
  const Rows all = rows_of(setting);
  QList<Rows> sets;
  std::set<Pair> left, conflicts;
  for (const Row* one : all) {
    for (const Row* other : all) {
      if (one < other) {
        (conflict(*one, *other) ? conflicts : left).emplace(one, other);
      }
    }
  }
  for (const auto& [one, other] : conflicts) {
    sets.append(Rows{one, other});
  }
  const auto gain = [&](const Rows& set, const Row* more) {
    const auto count = [&](const std::set<Pair>& pairs) {
      return std::ranges::count_if(set, [&](const Row* one) { return pairs.contains(std::minmax(one, more)); });
    };
    return set.contains(more) || count(conflicts) > 0 ? 0 : count(left);
  };
  while (!left.empty()) {
    Rows set{left.begin()->first, left.begin()->second};
    while (set.size() < setting.together) {
      const Row* best = *std::ranges::max_element(all, {}, [&](const Row* more) { return gain(set, more); });
      if (gain(set, best) == 0) {
        break;
      }
      set.append(best);
    }
    std::erase_if(left, [&](const Pair& pair) { return set.contains(pair.first) && set.contains(pair.second); });
    sets.append(set);
  }
  return sets;
}

// Checks. They return what is wrong.

QString told(const QStringList& line, const QString& wrong, const Result& result) {
  return "chainmail " + line.join(' ') + ": " + wrong + ' ' + QString::fromUtf8(result.outcome.error).trimmed();
}

QString check_alone(Runs& runs, const Runner& runner, const Setting& setting, const Row& row) {
  const QStringList line = line_of(setting, {&row}, {&row});
  const Result &without = runs.get(runner, line_of(setting, {&row}, {})), &with = runs.get(runner, line);
  if (without.outcome.code != 0 || with.outcome.code != 0) {
    return told(line, "it does not work", with.outcome.code != 0 ? with : without);
  }
  for (const QString& part : changed(without, with)) {
    if (!words_of(row.changes).contains(part)) {
      return told(line, QString(row.option) + " also changes " + part, with);
    }
  }
  return {};
}

/// An option without any effect would pass the other checks.
QString check_effect(Runs& runs, const Runner& runner, const Row& row) {
  if (QString(row.changes).startsWith("nothing: ")) {
    return {};
  }
  const bool acts = std::ranges::any_of(settings, [&](const Setting& setting) {
    return words_of(row.settings).contains(setting.name) &&
           !changed(runs.get(runner, line_of(setting, {&row}, {})), runs.get(runner, line_of(setting, {&row}, {&row})))
                .isEmpty();
  });
  return acts ? QString() : QString(row.option) + " changes nothing";
}

/// The input does not exist, so a sentence about the option comes before all work.
QString check_wrong(Runs& runs, const Runner& runner, const Setting& setting, const Row& row, const QString& wrong) {
  Arguments given = own_of(row, wrong);
  Arguments needed = arguments_in(row.with);
  erase_if(needed, [&](const Argument& one) { return one.option.isEmpty() || is_excluded(one, given); });
  const bool has_mesh =
      std::ranges::count(arguments_in(QString(setting.line).section(' ', 1)), QString(), &Argument::option) == 1;
  const QStringList line = line_of(setting, (has_mesh ? Arguments{{{}, "none.obj"}} : Arguments()) + needed + given);
  const Result& result = runs.get(runner, line);
  const QString error = QString::fromUtf8(result.outcome.error);
  const bool is_about_it =
      error.startsWith(QString("chainmail: ") + row.option) || error.startsWith("chainmail: " + wrong + ": ");
  return result.is_refused() && is_about_it ? QString() : told(line, "it is not refused at once:", result);
}

bool names_any(const QString& error, const QStringList& line, const Rows& set) {
  return std::ranges::any_of(set, [&](const Row* row) { return error.contains(row->option); }) ||
         std::ranges::any_of(line, [&](const QString& word) {
           return error.startsWith("chainmail: " + word + (word.startsWith("--") ? " " : ": "));
         });
}

/// Nothing changes that no option may change; what only one may change is as with this option alone.
QString check_together(Runs& runs, const Runner& runner, const Setting& setting, const Rows& set) {
  const QStringList line = line_of(setting, set, set);
  const Result& result = runs.get(runner, line);
  if (set.size() == 2 && conflict(*set[0], *set[1])) {
    const QString error = QString::fromUtf8(result.outcome.error);
    const bool is_right = result.outcome.code == 0 || (result.is_refused() && names_any(error, line, set));
    return is_right ? QString() : told(line, "it is neither done nor refused in a sentence:", result);
  }
  const Result& without = runs.get(runner, line_of(setting, set, {}));
  if (result.outcome.code != 0 || without.outcome.code != 0) {
    return told(line, "it does not work", result.outcome.code != 0 ? result : without);
  }
  for (const QString& part : changed(without, result)) {
    Rows owners = set;
    erase_if(owners, [&](const Row* row) { return !words_of(row->changes).contains(part); });
    if (owners.isEmpty()) {
      return told(line, "it changes " + part, result);
    }
    if (owners.size() == 1 && changed(runs.get(runner, line_of(setting, set, owners)), result).contains(part)) {
      return told(line, part + " is not as with " + owners.front()->option + " alone", result);
    }
  }
  return {};
}

/// An option that a setting does not take is refused.
QString check_foreign(Runs& runs, const Runner& runner, const Setting& setting, const Row& row) {
  const QStringList line = line_of(setting, own_of(row, row.right));
  const Result& result = runs.get(runner, line);
  return result.is_refused() && result.outcome.error.contains(row.option) ? QString()
                                                                          : told(line, "it is not refused:", result);
}

/// Returns the subcommands, and their options, as the program lists them for a shell.
std::map<QString, QStringList> options_of_program(const Program& program) {
  static const QRegularExpression command("__fish_use_subcommand -f -a (\\S+)"),
      option("__fish_seen_subcommand_from (\\S+)'(?: -s (\\S))?(?: -l (\\S+))?");
  std::map<QString, QStringList> all;
  for (const QString& line : QString::fromUtf8(program.run("completion fish").out).split('\n')) {
    if (const auto found = command.match(line); found.hasMatch()) {
      all[found.captured(1)];
    }
    const auto found = option.match(line);
    const QString name = found.captured(2).isEmpty() ? "--" + found.captured(3) : "-" + found.captured(2);
    if (found.hasMatch() && name != "-h" && name != "--") {
      all[found.captured(1)].append(name);
    }
  }
  return all;
}

bool is_of(const Setting& setting, const QString& command) {
  return QString(setting.line).section(' ', 0, 0) == command;
}

}  // namespace

/// Tests each option of each subcommand alone, and each pair of options once, against a table of what they change.
class OptionsTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { runs_ = std::make_unique<Runs>(); }
  void every_option_has_a_row();
  void an_option_changes_only_what_it_says();
  void wrong_values_are_refused_before_the_input_is_opened();
  void options_of_other_uses_are_refused();
  void pairs_have_the_effects_of_both();

 private:
  std::unique_ptr<Runs> runs_;
};

void OptionsTest::every_option_has_a_row() {
  const auto commands = options_of_program(Program());
  QVERIFY(commands.size() > 5);
  for (const auto& [command, options] : commands) {
    QStringList known;
    for (const Setting& setting : settings) {
      if (is_of(setting, command)) {
        known.append(setting.name);
        for (const Row* row : rows_of(setting)) {
          known.append(row->option);
        }
      }
    }
    QVERIFY2(!known.isEmpty(), qPrintable("chainmail " + command + " has no setting in tests/cli/test_options.cpp"));
    for (const QString& option : options) {
      QVERIFY2(known.contains(option),
               qPrintable("chainmail " + command + ' ' + option +
                          " has no row in tests/cli/test_options.cpp that says what it changes"));
    }
  }
}

void OptionsTest::an_option_changes_only_what_it_says() {
  std::vector<Runs::Job> jobs;
  for (const Setting& setting : settings) {
    for (const Row* row : setting.together > 0 ? rows_of(setting) : Rows()) {
      jobs.push_back([&setting, row](auto& runs, auto& runner) { return check_alone(runs, runner, setting, *row); });
    }
  }
  QString wrong = runs_->run(jobs);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
  jobs.clear();
  for (const Row& row : rows) {
    jobs.push_back([&row](auto& runs, auto& runner) { return check_effect(runs, runner, row); });
  }
  wrong = runs_->run(jobs);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

void OptionsTest::wrong_values_are_refused_before_the_input_is_opened() {
  std::vector<Runs::Job> jobs;
  for (const Setting& setting : settings) {
    for (const Row* row : rows_of(setting)) {
      for (const QString& one : QString(row->wrong).split('|', Qt::SkipEmptyParts)) {
        jobs.push_back(
            [&setting, row, one](auto& runs, auto& runner) { return check_wrong(runs, runner, setting, *row, one); });
      }
    }
  }
  const QString wrong = runs_->run(jobs);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

void OptionsTest::options_of_other_uses_are_refused() {
  std::vector<Runs::Job> jobs;
  for (const Setting& setting : settings) {
    QStringList taken;
    for (const Row* row : rows_of(setting)) {
      taken.append(row->option);
    }
    for (const Setting& other : setting.together == 1 ? std::span<const Setting>() : std::span(settings)) {
      for (const Row* row : is_of(other, QString(setting.line).section(' ', 0, 0)) ? rows_of(other) : Rows()) {
        if (!taken.contains(row->option)) {
          taken.append(row->option);
          jobs.push_back(
              [&setting, row](auto& runs, auto& runner) { return check_foreign(runs, runner, setting, *row); });
        }
      }
    }
  }
  const QString wrong = runs_->run(jobs);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

void OptionsTest::pairs_have_the_effects_of_both() {
  std::vector<Runs::Job> jobs;
  for (const Setting& setting : settings) {
    for (const Rows& set : setting.together > 1 ? covering_sets(setting) : QList<Rows>()) {
      jobs.push_back([&setting, set](auto& runs, auto& runner) { return check_together(runs, runner, setting, set); });
    }
  }
  const QString wrong = runs_->run(jobs);
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong));
}

CHAINMAIL_TEST(OptionsTest)

}  // namespace chainmail::test_options

#include "test_options.moc"
