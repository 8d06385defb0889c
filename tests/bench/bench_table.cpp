// Shows results and their limits as a table: bench_table RESULTS [--markdown].

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contestants.h"
#include "bench/results.h"

namespace chainmail::bench {
namespace {

using nlohmann::json;

enum class Limit { none, at_most, at_least };

struct Row {
  std::string what;
  double value = 0;
  double lower = 0, upper = 0;  // quartiles over the runs
  Limit limit = Limit::none;
  double bound = 0;

  /// True if the quartile on the side of the limit meets it.
  bool met() const { return limit == Limit::none || (limit == Limit::at_most ? upper <= bound : lower >= bound); }
};

/// A figure of "ratios". It is shown only if it was measured.
struct Figure {
  const char* what;
  const char* place;  // a JSON pointer
  Limit limit;
  double bound;
};

constexpr Figure figures[] = {
    {"time of a textbook Natural Queue / ours, later passes, 64²", "/vs_textbook", Limit::none, 0},
    {"time of a textbook Natural Queue / ours, first pass, 64²", "/vs_textbook_first", Limit::none, 0},
    {"time of Natural Queue as in the thesis / ours, 64²", "/vs_2004", Limit::none, 0},
    {"Natural Queue, later passes: time / time to touch its data once, grid 1024²", "/vs_floor/grid1024",
     Limit::at_most, 3},
    {"Natural Queue, later passes: time / time to touch its data once, block 100³", "/vs_floor/block100",
     Limit::at_most, 3},
    {"Exact, later passes: time / time to touch its data once, grid 1024²", "/vs_floor_exact/grid1024", Limit::at_most,
     2},
    {"Exact, later passes: time / time to touch its data once, block 100³", "/vs_floor_exact/block100", Limit::at_most,
     2},
    {"time per element, grid 2048² / grid 64²", "/growth/per_element", Limit::at_most, 2},
    {"time of a local pass, grid 2048² / grid 64²", "/growth/local", Limit::at_most, 1.5},
    {"Natural Queue, first passes: ns per element, grid 1024²", "/first_pass/natural_queue/grid1024", Limit::none, 0},
    {"Natural Queue, first passes: ns per element, block 100³", "/first_pass/natural_queue/block100", Limit::none, 0},
    {"Exact, first passes: ns per element, grid 1024²", "/first_pass/exact/grid1024", Limit::none, 0},
    {"Exact, first passes: ns per element, block 100³", "/first_pass/exact/block100", Limit::none, 0},
    {"Natural Queue, first passes: time per element, grid 1024² / grid 256²", "/first_pass/natural_queue/plane",
     Limit::at_most, 1.8},
    {"Natural Queue, first passes: time per element, block 100³ / block 40³", "/first_pass/natural_queue/space",
     Limit::at_most, 1.8},
    {"Exact, first passes: time per element, grid 1024² / grid 256²", "/first_pass/exact/plane", Limit::at_most, 1.8},
    {"Exact, first passes: time per element, block 100³ / block 40³", "/first_pass/exact/space", Limit::at_most, 1.8},
    {"time of Exact / Natural Queue, first passes, uniform softness", "/exact_over_nq/first/uniform", Limit::at_most,
     1.5},
    {"time of Exact / Natural Queue, first passes, jittered", "/exact_over_nq/first/jittered", Limit::at_most, 2},
    {"time of Exact / Natural Queue, first passes, softness per link", "/exact_over_nq/first/mixed", Limit::at_most, 5},
    {"time of Exact / Natural Queue, later passes, uniform softness", "/exact_over_nq/later/uniform", Limit::at_most,
     2},
    {"time of Exact / Natural Queue, later passes, jittered", "/exact_over_nq/later/jittered", Limit::at_most, 3},
    {"time of Exact / Natural Queue, later passes, softness per link", "/exact_over_nq/later/mixed", Limit::at_most, 8},
    {"equilibrium, no region binds: iterations to 1 %, cloth 512² / 32²", "/equilibrium/iterations/plane/free",
     Limit::at_most, 1.5},
    {"equilibrium, no region binds: iterations to 1 %, tetra 40³ / 10³", "/equilibrium/iterations/space/free",
     Limit::at_most, 1.5},
    {"equilibrium, regions bind: iterations to 1 %, cloth 512² / 32²", "/equilibrium/iterations/plane/binding",
     Limit::at_most, 1.5},
    {"equilibrium, regions bind: iterations to 1 %, tetra 40³ / 10³", "/equilibrium/iterations/space/binding",
     Limit::at_most, 1.5},
    {"equilibrium, no region binds: seconds to 1 % per 100,000 elements, cloth 128²",
     "/equilibrium/seconds_at_100000/plane/free", Limit::at_most, 0.3},
    {"equilibrium, no region binds: seconds to 1 % per 100,000 elements, tetra 20³",
     "/equilibrium/seconds_at_100000/space/free", Limit::at_most, 1.2},
    {"equilibrium, regions bind: seconds to 1 % per 100,000 elements, cloth 128²",
     "/equilibrium/seconds_at_100000/plane/binding", Limit::at_most, 1.5},
    {"equilibrium, regions bind: seconds to 1 % per 100,000 elements, tetra 20³",
     "/equilibrium/seconds_at_100000/space/binding", Limit::at_most, 6},
    {"time of sweeps to 1 % / time of the equilibrium, cloth 128² (5,000 sweeps at most)", "/equilibrium/over_sweeps",
     Limit::at_least, 200},
    {"equilibrium, 8 ms per frame: distance behind it after a drag, cloth 224²", "/equilibrium/lag/plane",
     Limit::at_most, 0.1},
    {"equilibrium, 8 ms per frame: the same where regions bind", "/equilibrium/lag/plane_binding", Limit::at_most, 0.1},
    {"equilibrium, 8 ms per frame: the same, tetra 37³", "/equilibrium/lag/space", Limit::at_most, 0.1},
    {"move after a cut: time of linear FEM / of the equilibrium, cloth 45²", "/equilibrium/after_cut/sheet45",
     Limit::none, 0},
    {"move after a cut: time of linear FEM / of the equilibrium, cloth 141²", "/equilibrium/after_cut/sheet141",
     Limit::none, 0},
    {"move after a cut: time of linear FEM / of the equilibrium, tetra 13³", "/equilibrium/after_cut/block13",
     Limit::none, 0},
    {"move after a cut: time of linear FEM / of the equilibrium, tetra 27³", "/equilibrium/after_cut/block27",
     Limit::none, 0},
    {"Exact, first passes: time on one thread / on two, grid 64²", "/threads/first/grid64", Limit::at_least, 0.95},
    {"Exact, later passes: time on one thread / on two, grid 64²", "/threads/later/grid64", Limit::at_least, 0.95},
    {"Exact, first passes: time on one thread / on two, grid 1000²", "/threads/first/grid1000", Limit::at_least, 1.7},
    {"Exact, later passes: time on one thread / on two, grid 1000²", "/threads/later/grid1000", Limit::at_least, 1.7},
    {"Exact, first passes: time on one thread / on two, block 100³", "/threads/first/block100", Limit::at_least, 1.7},
    {"Exact, later passes: time on one thread / on two, block 100³", "/threads/later/block100", Limit::at_least, 1.7},
    {"Exact, first passes: time on one thread / on two, jittered tetra 60³", "/threads/first/jittered_tetra60",
     Limit::none, 0},
    {"Exact, later passes: time on one thread / on two, jittered tetra 60³", "/threads/later/jittered_tetra60",
     Limit::none, 0},
    {"relaxation sweeps: ns per visit, grid 256²", "/sweep_ns/grid256", Limit::at_most, 15},
    {"relaxation sweeps: ns per visit, tetra 60³", "/sweep_ns/tetra60", Limit::at_most, 15},
    {"plane scene / the same in space: time", "/plane/time", Limit::at_most, 0.75},
    {"plane scene / the same in space: resident bytes", "/plane/bytes", Limit::at_most, 0.65},
    {"hand-like drags on 1024², Natural Queue: ns per moved element", "/hand_like/natural_queue/ns_per_moved",
     Limit::none, 0},
    {"hand-like drags on 1024², Natural Queue: worst pass (ms)", "/hand_like/natural_queue/worst_ms", Limit::none, 0},
    {"hand-like drags on 1024², Exact: ns per moved element", "/hand_like/exact/ns_per_moved", Limit::none, 0},
    {"hand-like drags on 1024², Exact: worst pass (ms)", "/hand_like/exact/worst_ms", Limit::none, 0},
    {"resident bytes per element, both panels", "/bytes_per_element", Limit::at_most, 150},
    {"allocations per pass", "/allocations_per_pass", Limit::at_most, 0},
    {"speed of a panel with a second one running / alone", "/two_panels", Limit::at_least, 0.85},
    {"press to frame after a hover, grid 1000², Generalized (ms)", "/grab_to_frame_ms/generalized", Limit::at_most, 16},
    {"press to frame after a hover, grid 1000², Spiral (ms)", "/grab_to_frame_ms/spiral", Limit::at_most, 16},
    {"press to frame after a hover, grid 1000², Natural Queue (ms)", "/grab_to_frame_ms/natural-queue", Limit::at_most,
     16},
    {"press to frame after a hover, grid 1000², Enhanced (ms)", "/grab_to_frame_ms/enhanced", Limit::at_most, 16},
    {"press to frame after a hover, grid 1000², 3D ChainMail (ms)", "/grab_to_frame_ms/original", Limit::at_most, 16},
    {"press to frame after a hover, grid 1000², Exact (ms)", "/grab_to_frame_ms/exact", Limit::at_most, 16},
    {"ten million in a plane: open to the first picture (ms)", "/ten_million/plane/open_ms", Limit::none, 0},
    {"ten million in a plane: local pass, Natural Queue (ms)", "/ten_million/plane/local_pass_ms", Limit::none, 0},
    {"ten million in a plane: whole-body pass, Natural Queue (ms)", "/ten_million/plane/whole_pass_ms", Limit::at_most,
     60},
    {"ten million in a plane: longest event of the GUI thread without drawing (ms)",
     "/ten_million/plane/gui_longest_ms", Limit::at_most, 8},
    {"ten million in a plane: resident bytes per element, window and both panels",
     "/ten_million/plane/bytes_per_element", Limit::none, 0},
    {"ten million in a plane: save (ms)", "/ten_million/plane/save_ms", Limit::none, 0},
    {"ten million in space: open to the first picture (ms)", "/ten_million/space/open_ms", Limit::none, 0},
    {"ten million in space: local pass, Natural Queue (ms)", "/ten_million/space/local_pass_ms", Limit::none, 0},
    {"ten million in space: whole-body pass, Natural Queue (ms)", "/ten_million/space/whole_pass_ms", Limit::none, 0},
    {"ten million in space: longest event of the GUI thread without drawing (ms)", "/ten_million/space/gui_longest_ms",
     Limit::at_most, 8},
    {"ten million in space: resident bytes per element, window and both panels", "/ten_million/space/bytes_per_element",
     Limit::none, 0},
    {"ten million in space: save (ms)", "/ten_million/space/save_ms", Limit::none, 0},
    {"window: GUI thread per frame without painting, local drag on 1024² (ms)", "/window/gui_ms", Limit::at_most, 1},
    {"window: painting per frame in the same drag (ms)", "/window/painting_ms", Limit::none, 0},
    {"window: idle, share of a core", "/window/idle_cpu", Limit::at_most, 0.01},
    {"window: start to first frame (ms)", "/window/first_frame_ms", Limit::none, 0},
    {"Python: a move within the regions of 1,000 elements (µs)", "/python/move_us", Limit::at_most, 5},
    {"Python: copy of a million positions (ms)", "/python/million_positions_ms", Limit::at_most, 10},
    {"window: open 1024² elements (ms)", "/window/open_ms", Limit::none, 0},
    {"window: save 1024² elements (ms)", "/window/save_ms", Limit::none, 0},
    {"window: open 100,000 triangles to the complete picture (ms)", "/window/surface_complete_ms", Limit::none, 0},
    {"window: time per picture, drag on 100,000 triangles (ms)", "/window/surface_frame_ms", Limit::none, 0},
};

std::vector<Row> rows_of(const json& all) {
  std::vector<Row> rows;
  for (const Figure& figure : figures) {
    if (const json::json_pointer place(figure.place); all["ratios"].contains(place)) {
      const json& quartiles = all["quartiles"][figure.place];
      rows.push_back({figure.what, all["ratios"][place].get<double>(), quartiles[0].get<double>(),
                      quartiles[1].get<double>(), figure.limit, figure.bound});
    }
  }
  return rows;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value >= 100 ? "%.0f" : value >= 0.1 ? "%.2f" : "%.3g", value);
  return text;
}

std::string limit(const Row& row) {
  return row.limit == Limit::none ? "" : (row.limit == Limit::at_most ? "≤ " : "≥ ") + number(row.bound);
}

/// Prints cells in columns or as Markdown. The first row is the header.
void print(const std::vector<std::vector<std::string>>& table, bool markdown) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::string line = markdown ? "|" : "";
    for (std::size_t k = 0; k < table[i].size(); ++k) {
      const std::string& cell = table[i][k];
      // Counts characters, not bytes: only the first byte of each UTF-8 character counts.
      std::size_t width = 0;
      for (const char byte : cell) {
        width += (static_cast<unsigned char>(byte) & 0xC0) != 0x80 ? 1 : 0;
      }
      const std::size_t room = k == 0 ? 72 : 18;
      line += markdown ? " " + cell + " |" : cell + std::string(room > width ? room - width : 1, ' ');
    }
    std::printf("%s\n", line.c_str());
    if (markdown && i == 0) {
      std::string rule = "|---|";
      for (std::size_t k = 1; k < table[i].size(); ++k) {
        rule += "---:|";
      }
      std::printf("%s\n", rule.c_str());
    }
  }
  std::printf("\n");
}

std::string range(double lower, double upper) { return number(lower) + " to " + number(upper); }

void print_figures(const json& all, bool markdown) {
  std::vector<std::vector<std::string>> table{{"figure", "median", "quartiles", "limit", ""}};
  for (const Row& row : rows_of(all)) {
    table.push_back({row.what, number(row.value), range(row.lower, row.upper), limit(row),
                     row.limit == Limit::none ? ""
                     : row.met()              ? "met"
                                              : "not met"});
  }
  print(table, markdown);
}

void print_bullet(const json& all, bool markdown) {
  const json meshes = all["ratios"].value("vs_bullet", json::object());
  for (const auto& [mesh, contestants] : meshes.items()) {
    std::vector<std::vector<std::string>> table{
        {mesh + ", bottom pinned, top pulled and held", "ms per frame", "frames", "follow-through", "relative error"}};
    for (const auto& [name, of] : contestants.items()) {
      const bool is_reference = !of.contains("ms");
      table.push_back({name, is_reference ? "" : number(of["ms"]),
                       is_reference ? "" : std::to_string(of["frames"].get<int>()),
                       number(100 * of["follow"].get<double>()) + " %", is_reference ? "0" : number(of["relative"])});
    }
    print(table, markdown);
  }
}

void print_runs(const json& all, bool markdown) {
  std::vector<std::vector<std::string>> table{
      {"drag, mesh, algorithm", "elements", "moved", "ms per pass", "quartiles", "ns per moved element"}};
  for (const json& run : all["runs"]) {
    table.push_back({run["name"].get<std::string>() + ", " + run["mesh"].get<std::string>() + ", " +
                         run["algorithm"].get<std::string>(),
                     std::to_string(run["elements"].get<std::uint64_t>()),
                     number(std::round(run["moved"].get<double>())), number(run["ms"]),
                     range(run["ms_quartiles"][0], run["ms_quartiles"][1]), number(run["ns_per_moved"])});
  }
  print(table, markdown);
}

}  // namespace
}  // namespace chainmail::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "bench_table: name the file of results, as in: bench_table build/bench.json --markdown\n");
    return 2;
  }
  const nlohmann::json all = chainmail::bench::Results(argv[1]).all();
  const bool markdown = argc > 2 && std::string_view(argv[2]) == "--markdown";
  std::printf("%s\n\n", all["machine"].get<std::string>().c_str());
  chainmail::bench::print_runs(all, markdown);
  chainmail::bench::print_bullet(all, markdown);
  chainmail::bench::print_figures(all, markdown);
}
