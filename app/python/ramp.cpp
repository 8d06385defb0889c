#include "chainmail/ramp.h"

#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/long_work.h"
#include "python/module.h"
#include "python/table.h"
#include "python/words.h"

namespace chainmail::python {
namespace {

void put(Table& table, const api::RampSize& size) {
  table.put("width", size.width);
  table.put("elements", size.elements);
  table.put("links", size.links);
  table.put("method", size.method);
  table.put("passes", size.passes);
  table.put("median_ms", size.median_ms);
  table.put("p99_ms", size.p99_ms);
  table.put("mean_moved", size.mean_moved);
  table.put("repeated", size.repeated);
  table.put("real_time", size.real_time);
}

void put(Table& table, const api::RampMethod& method) {
  table.put("method", method.method);
  table.put("largest_width", method.largest_width);
  table.put("lost", method.lost);
  table.put("growth_exponent", method.growth_exponent);
}

template <class Row>
py::dict columns_of(const std::vector<Row>& rows) {
  Table table;
  for (const Row& row : rows) {
    put(table, row);
  }
  return table.columns();
}

py::dict named(const api::Ramp& ramp) {
  py::dict result;
  result["sizes"] = columns_of(ramp.sizes);
  result["methods"] = columns_of(ramp.methods);
  result["seconds"] = ramp.seconds;
  return result;
}

}  // namespace

void add_ramp(py::module_& module) {
  const api::RampOptions defaults;
  module.def(
      "ramp",
      [](const py::sequence& methods, std::uint64_t seed, double budget, std::uint64_t largest, int drags, int moves,
         const std::string& precision, const api::LinkSoftness& softness, const std::optional<api::Job>& job,
         const py::object& progress) {
        const api::RampOptions options{list_of<std::string>(methods, "methods"),
                                       seed,
                                       budget,
                                       largest,
                                       drags,
                                       moves,
                                       precision_of(precision),
                                       softness};
        const api::Job watched = job.value_or(api::Job());
        return named(run_long(watched, progress, [&] { return api::ramp(options, watched); }));
      },
      py::arg("methods") = py::list(), py::kw_only(), py::arg("seed") = defaults.seed,
      py::arg("budget") = defaults.budget, py::arg("largest") = defaults.largest, py::arg("drags") = defaults.drags,
      py::arg("moves") = defaults.moves, py::arg("precision") = "float", py::arg("softness") = api::LinkSoftness(),
      py::arg("job") = py::none(), py::arg("progress") = py::none(),
      "Finds the largest square grid on which each method runs in real time (Dean 2004, chapter 6).\n\n"
      "Grids grow from 4 x 4 up to `largest` elements. At each size, all methods run the same drags. A method stops "
      "when\n"
      "the 99th percentile of its pass times exceeds the `budget` (s) in two attempts. `methods` are names; default: "
      "the\n"
      "ChainMail family. `progress` is called with the share of the largest grid, 0 to 1.\n\n"
      "Returns a dictionary: `sizes` and `methods`, which are dictionaries of columns for pandas.DataFrame, and "
      "`seconds`.\n"
      "The columns of `sizes` are width, elements, links, method, passes, median_ms, p99_ms, mean_moved, repeated and\n"
      "real_time; those of `methods` are method, largest_width (None: never in real time), lost (False: there was no\n"
      "next size) and growth_exponent of the median. Raises Error for an unknown method or an option out of its "
      "range;\n"
      "and Cancelled.");
}

}  // namespace chainmail::python
