// Shows results as a table beside their limits: bench_table RESULTS [--markdown].

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
  Limit limit = Limit::none;
  double bound = 0;

  bool met() const { return limit == Limit::none || (limit == Limit::at_most ? value <= bound : value >= bound); }
};

/// A figure of "ratios", where it was measured.
struct Figure {
  const char* what;
  const char* place;  // a JSON pointer
  Limit limit;
  double bound;
};

constexpr Figure figures[] = {
    {"2004's Natural Queue over today's, 64²", "/vs_2004", Limit::at_least, 300},
    {"Natural Queue over the memory's floor, grid 1024²", "/vs_floor/grid1024", Limit::at_most, 2.5},
    {"Natural Queue over the memory's floor, block 100³", "/vs_floor/block100", Limit::at_most, 2.5},
    {"an element's time, grid 2048² over 64²", "/growth/per_element", Limit::at_most, 2},
    {"a local pass, grid 2048² over 64²", "/growth/local", Limit::at_most, 1.5},
    {"Exact over Natural Queue, uniform softness", "/exact_over_nq/uniform", Limit::at_most, 2},
    {"Exact over Natural Queue, jittered", "/exact_over_nq/jittered", Limit::at_most, 3},
    {"Exact over Natural Queue, softness per link", "/exact_over_nq/mixed", Limit::at_most, 8},
    {"a plane scene over the same in space: time", "/plane/time", Limit::at_most, 0.75},
    {"a plane scene over the same in space: bytes", "/plane/bytes", Limit::at_most, 0.70},
    {"resident bytes an element, both panels", "/bytes_per_element", Limit::none, 0},
    {"allocations a pass", "/allocations_per_pass", Limit::at_most, 0},
    {"two panels on two cores, of the speed alone", "/two_panels", Limit::at_least, 0.85},
    {"window: GUI thread a frame, local drag on 1024² (ms)", "/window/gui_ms", Limit::at_most, 1},
    {"window: idle, share of a core", "/window/idle_cpu", Limit::at_most, 0.01},
    {"window: start to first frame (ms)", "/window/first_frame_ms", Limit::none, 0},
    {"window: open 1024² elements (ms)", "/window/open_ms", Limit::none, 0},
    {"window: save 1024² elements (ms)", "/window/save_ms", Limit::none, 0},
};

/// The time of one whole-body run over another's on the same mesh, where both were measured.
void add_ratio(std::vector<Row>& rows, const json& runs, const std::string& mesh, const std::string& one,
               const std::string& other, Drag drag = Drag::whole_body) {
  const auto ns = [&](const std::string& algorithm) {
    for (const json& run : runs) {
      if (run["name"] == name(drag) && run["mesh"] == mesh && run["algorithm"] == algorithm) {
        return run["ns_per_moved"].get<double>();
      }
    }
    return 0.0;
  };
  if (ns(other) > 0 && ns(one) > 0) {
    rows.push_back({one + " over " + other + ", " + (drag == Drag::whole_body ? "" : "mixed softness, ") + mesh,
                    ns(one) / ns(other)});
  }
}

std::vector<Row> rows_of(const json& all) {
  std::vector<Row> rows;
  for (const Figure& figure : figures) {
    if (const json::json_pointer place(figure.place); all["ratios"].contains(place)) {
      rows.push_back({figure.what, all["ratios"][place].get<double>(), figure.limit, figure.bound});
    }
  }
  for (const char* mesh : {"grid1024", "block100"}) {
    add_ratio(rows, all["runs"], mesh, names::without_replay, names::memory_floor);
    add_ratio(rows, all["runs"], mesh, names::exact, names::memory_floor);
  }
  for (const char* mesh : {"grid1024", "block100", "jittered_cloth512", "jittered_tetra60"}) {
    add_ratio(rows, all["runs"], mesh, names::exact_anew, names::without_replay);
  }
  for (const char* mesh : {"grid1024", "jittered_tetra60"}) {
    add_ratio(rows, all["runs"], mesh, names::exact_anew, names::without_replay, Drag::whole_body_mixed);
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

/// Cells in columns, or as Markdown: the first row is the head.
void print(const std::vector<std::vector<std::string>>& table, bool markdown) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::string line = markdown ? "|" : "";
    for (std::size_t k = 0; k < table[i].size(); ++k) {
      const std::string& cell = table[i][k];
      // As wide as it looks: of a letter's bytes in UTF-8 the first alone counts.
      std::size_t width = 0;
      for (const char byte : cell) {
        width += (static_cast<unsigned char>(byte) & 0xC0) != 0x80 ? 1 : 0;
      }
      const std::size_t room = k == 0 ? 66 : 16;
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

void print_figures(const json& all, bool markdown) {
  std::vector<std::vector<std::string>> table{{"figure", "measured", "limit", ""}};
  for (const Row& row : rows_of(all)) {
    table.push_back({row.what, number(row.value), limit(row),
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
        {mesh + ", a corner dragged for 60 frames", "ms a frame", "links off by (RMS)", "at most"}};
    for (const auto& [name, of] : contestants.items()) {
      table.push_back({name, number(of["ms"]), number(100 * of["stretch"].get<double>()) + " %",
                       number(100 * of["largest"].get<double>()) + " %"});
    }
    print(table, markdown);
  }
}

void print_runs(const json& all, bool markdown) {
  std::vector<std::vector<std::string>> table{
      {"drag, mesh, algorithm", "elements", "moved", "ms a pass", "ns a moved one"}};
  for (const json& run : all["runs"]) {
    table.push_back({run["name"].get<std::string>() + ", " + run["mesh"].get<std::string>() + ", " +
                         run["algorithm"].get<std::string>(),
                     std::to_string(run["elements"].get<std::uint64_t>()),
                     number(std::round(run["moved"].get<double>())), number(run["ms"]), number(run["ns_per_moved"])});
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
