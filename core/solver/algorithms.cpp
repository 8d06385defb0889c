#include "solver/algorithms.h"

#include <algorithm>
#include <string>
#include <vector>

#include "chainmail/follow_pass.h"
#include "chainmail/list_method.h"
#include "chainmail/waiting_list.h"
#include "elastic/methods.h"
#include "exact/exact_method.h"
#include "mesh/error.h"
#include "solver/elastic_deformation.h"

namespace chainmail {
namespace {

/// The table. To add an algorithm, add a constant to `enum class Algorithm` and an entry here, in its family.
///
/// Shapes differ, so that marks can be told apart without colour. The colours are the outcome of a search near those of
/// Okabe and Ito (2008). After the window has adapted them to text on a dark or light ground, any two differ by at
/// least 24 in CIELAB (CIE 1976), and by at least 9.5 for eyes without red or green cones, as Machado et al. (2009)
/// simulate them. Generalized ChainMail and linear FEM, which lessons compare, differ by at least 24 for these eyes,
/// too. The test window_comfort measures it.
std::vector<AlgorithmInfo> make_table() {
  return {
      {.algorithm = Algorithm::generalized,
       .name = "generalized",
       .label = "Generalized ChainMail",
       .source = "Li and Brodlie 2003; Dean 2004, 3.1",
       .summary = "candidates enter at the front of the list, all are admitted",
       .style = {"M-.9-.9H.9V.9H-.9Z", "#f76b20"},  // square
       .make = make_generalized,
       .history = follow_list<FrontList>},
      {.algorithm = Algorithm::spiral,
       .name = "spiral",
       .label = "Spiral",
       .source = "Dean 2004, 3.2",
       .summary = "candidates enter at the back of the list, all are admitted",
       .style = {"M0-1.2L1.15.85H-1.15Z", "#58b6dc"},  // triangle
       .make = make_list_method<SpiralList>,
       .history = follow_list<SpiralList>},
      {.algorithm = Algorithm::natural_queue,
       .name = "natural-queue",
       .label = "Natural Queue ChainMail",
       .source = "Dean 2004, 4.1",
       .summary = "candidates enter at the back, only those not yet updated are admitted",
       .style = {"M-1 0A1 1 0 1 0 1 0A1 1 0 1 0-1 0Z", "#006ce5"},  // circle
       .make = make_natural_queue,
       .history = follow_natural_queue},
      {.algorithm = Algorithm::enhanced,
       .name = "enhanced",
       .label = "Enhanced ChainMail",
       .source = "Schill et al. 1998",
       .summary = "the candidate with the largest violation is taken first",
       .style = {"M0 1.2L1.15-.85H-1.15Z", "#569585"},  // triangle on its tip
       .make = make_list_method<EnhancedList>,
       .history = follow_list<EnhancedList>},
      {.algorithm = Algorithm::chainmail_3d,
       .name = "original",
       .alias = "3d",
       .label = "3D ChainMail",
       .source = "Frisken-Gibson 1997; Dean 2004, 2.1",
       .summary = "one list per direction, on grids and blocks only",
       .style = {"M-.4-1.1H.4V-.4H1.1V.4H.4V1.1H-.4V.4H-1.1V-.4H-.4Z", "#ff7ad6"},  // cross
       .make = make_list_method<DirectionLists>,
       .history = follow_list<DirectionLists>,
       .needs_grid = true},
      {.algorithm = Algorithm::exact,
       .name = "exact",
       .label = "Exact ChainMail",
       .source = "this project",
       .summary = "every element moves as little as any valid answer allows",
       .style = {"M0-1.4L1.1 0L0 1.4L-1.1 0Z", ""},  // diamond
       .make = make_method<ExactMethod>,
       .holds_links = true,
       .from_rest = true},
      {.algorithm = Algorithm::linear_fem,
       .name = "fem",
       .label = "Linear FEM",
       .source = "Bro-Nielsen and Cotin 1996",
       .summary = "linear elasticity on the cells, for small deformations",
       .style = {"M-1.2-.55H1.2V.55H-1.2Z", "#07935b"},  // bar
       .make = make_elastic_method<Algorithm::linear_fem>,
       .elastic = ElasticMethod{linear_limit[3], [](const Mesh& mesh) { check_fem("linear FEM", mesh, linear_limit); },
                                make_linear_fem},
       .needs_pins = true},
      {.algorithm = Algorithm::neo_hookean,
       .name = "neo-hookean",
       .label = "Neo-Hookean FEM",
       .source = "Bonet and Wood 1997",
       .summary = "nonlinear elasticity on the cells: the reference solution",
       .style = {"M0-1.4L.35-.45L1.33-.43L.56.17L.82 1.13L0 .58L-.82 1.13L-.56.17L-1.33-.43L-.35-.45Z",
                 "#b99445"},  // star
       .make = make_elastic_method<Algorithm::neo_hookean>,
       .elastic = ElasticMethod{nonlinear_limit[3],
                                [](const Mesh& mesh) { check_fem("neo-Hookean FEM", mesh, nonlinear_limit); },
                                make_neo_hookean},
       .needs_pins = true},
      {.algorithm = Algorithm::boundary_elements,
       .name = "bem",
       .label = "BEM",
       .source = "James and Pai 1999",
       .summary = "linear elasticity on a closed surface of triangles",
       .style = {"M-1.1-.65L-.65-1.1L0-.45L.65-1.1L1.1-.65L.45 0L1.1.65L.65 1.1L0 .45L-.65 1.1L-1.1.65L-.45 0Z",
                 "#803d71"},  // diagonal cross
       .make = make_elastic_method<Algorithm::boundary_elements>,
       .elastic = ElasticMethod{boundary_inner_limit, check_boundary, make_boundary_elements},
       .needs_pins = true},
      {.algorithm = Algorithm::free_form,
       .name = "ffd",
       .label = "Free-form deformation",
       .source = "Sederberg and Parry 1986; Hsu et al. 1992",
       .summary = "a lattice of control points deforms space",
       .style = {"M-.6-1.05H.6L1.2 0L.6 1.05H-.6L-1.2 0Z", "#c559ff"},  // hexagon
       .make = make_elastic_method<Algorithm::free_form>,
       .elastic = ElasticMethod{0, [](const Mesh&) {}, make_free_form}},
      {.algorithm = Algorithm::corotational,
       .name = "corotational",
       .label = "Corotational FEM",
       .source = "Mueller and Gross 2004; Sifakis and Barbic 2012",
       .summary = "linear elasticity on the cells, in frames that turn with them",
       .style = {"M-.9-.9H.3V-.3H.9V.9H-.3V.3H-.9Z", "#de3867"},  // two squares that overlap
       .make = make_elastic_method<Algorithm::corotational>,
       .elastic = ElasticMethod{nonlinear_limit[3],
                                [](const Mesh& mesh) { check_fem("corotational FEM", mesh, nonlinear_limit); },
                                make_corotational},
       .needs_pins = true,
       .obeys_iterations = true},
      {.algorithm = Algorithm::arap,
       .name = "arap",
       .label = "ARAP",
       .source = "Sorkine and Alexa 2007; Chao et al. 2010",
       .summary = "every part turns as a rigid body would, as far as the others let it",
       .style = {"M0-1.2L1.15-.35L.7 1H-.7L-1.15-.35Z", "#7f3826"},  // pentagon
       .make = make_elastic_method<Algorithm::arap>,
       .elastic = ElasticMethod{edge_limit[3], [](const Mesh& mesh) { check_cells("ARAP", mesh); }, make_arap},
       .needs_pins = true,
       .obeys_iterations = true},
      {.algorithm = Algorithm::xpbd,
       .name = "xpbd",
       .label = "XPBD",
       .source = "Macklin et al. 2016, 2019",
       .summary = "springs and volumes as constraints that give way, in small steps of time",
       .style = {"M-1.2-.9H1.2L.35.9H-.35Z", "#ea00e2"},  // trapezium
       .make = make_elastic_method<Algorithm::xpbd>,
       .elastic = ElasticMethod{edge_limit[3], [](const Mesh& mesh) { check_cells("XPBD", mesh); }, make_xpbd},
       .needs_pins = true,
       .obeys_iterations = true},
      {.algorithm = Algorithm::projective,
       .name = "projective",
       .label = "Projective Dynamics",
       .source = "Bouaziz et al. 2014",
       .summary = "springs and turning cells, with one matrix for all iterations",
       .style = {"M-1 1V-1L1 1Z", "#399f00"},  // right triangle
       .make = make_elastic_method<Algorithm::projective>,
       .elastic = ElasticMethod{edge_limit[3], [](const Mesh& mesh) { check_cells("Projective Dynamics", mesh); },
                                make_projective},
       .needs_pins = true,
       .obeys_iterations = true},
      {.algorithm = Algorithm::quasi_newton,
       .name = "quasi-newton",
       .label = "Quasi-Newton FEM",
       .source = "Liu et al. 2017; Smith et al. 2018",
       .summary = "stable neo-Hookean cells, by L-BFGS with one matrix for all iterations",
       .style = {"M-1.1-.35H-.35V-1.1H.35V1.1H-.35V.35H-1.1Z", "#94b9ff"},  // a T that lies
       .make = make_elastic_method<Algorithm::quasi_newton>,
       .elastic =
           ElasticMethod{linear_limit[3], [](const Mesh& mesh) { check_fem("quasi-Newton FEM", mesh, linear_limit); },
                         make_quasi_newton},
       .needs_pins = true,
       .obeys_iterations = true},
      {.algorithm = Algorithm::neo_hookean_xpbd,
       .name = "neo-hookean-xpbd",
       .label = "Neo-Hookean XPBD",
       .source = "Macklin and Mueller 2021; Ton-That et al. 2023",
       .summary = "stable neo-Hookean cells as constraints that give way, in small steps of time",
       .style = {"M-1-1.1H1L-1 1.1H1Z", "#702890"},  // hourglass
       .make = make_elastic_method<Algorithm::neo_hookean_xpbd>,
       .elastic =
           ElasticMethod{edge_limit[3], [](const Mesh& mesh) { check_fem("neo-Hookean XPBD", mesh, edge_limit); },
                         make_neo_hookean_xpbd},
       .needs_pins = true,
       .obeys_iterations = true},
  };
}

std::vector<AlgorithmInfo>& algorithm_table() {
  static std::vector<AlgorithmInfo> table = make_table();
  return table;
}

/// Number of entries of the ChainMail family, which come first.
std::size_t family_size() {
  return static_cast<std::size_t>(std::ranges::count(algorithm_table(), Family::chainmail, &AlgorithmInfo::family));
}

/// Numbers of algorithms that are added while the program runs start here.
constexpr auto first_added = Algorithm(10'000);

/// Inserts an entry at the end of its family.
Algorithm insert(const AlgorithmInfo& entry) {
  auto& table = algorithm_table();
  const auto end = entry.family() == Family::chainmail ? table.begin() + std::ptrdiff_t(family_size()) : table.end();
  return table.insert(end, entry)->algorithm;
}

}  // namespace

std::span<const AlgorithmInfo> algorithms() { return every_algorithm().first(family_size()); }

std::span<const AlgorithmInfo> elastic_algorithms() { return every_algorithm().subspan(family_size()); }

std::span<const AlgorithmInfo> every_algorithm() { return algorithm_table(); }

const AlgorithmInfo& info(Algorithm algorithm) {
  return *std::ranges::find(algorithm_table(), algorithm, &AlgorithmInfo::algorithm);
}

std::optional<Algorithm> find_algorithm(std::string_view name) {
  const auto all = every_algorithm();
  const auto found = std::ranges::find_if(
      all, [name](const AlgorithmInfo& one) { return one.name == name || (!one.alias.empty() && one.alias == name); });
  return found == all.end() ? std::nullopt : std::optional(found->algorithm);
}

Algorithm algorithm_of(std::string_view name) {
  const auto algorithm = find_algorithm(name);
  if (!algorithm) {
    std::string names;
    for (const AlgorithmInfo& one : every_algorithm()) {
      names += (names.empty() ? "" : ", ") + std::string(one.offered_name());
    }
    throw Error("method '" + std::string(name.substr(0, 60)) + "'", "there is no such method", "use one of " + names);
  }
  return *algorithm;
}

WaitingHistory waiting_history(const RecordedPass& pass) {
  const auto find = info(pass.algorithm).history;
  return find == nullptr ? WaitingHistory() : find(pass);
}

bool fits(Algorithm algorithm, const Mesh& mesh) {
  try {
    check(algorithm, mesh);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void check(Algorithm algorithm, const Mesh& mesh) {
  const AlgorithmInfo& entry = info(algorithm);
  if (entry.needs_grid && !mesh.is_grid) {
    throw Error(std::string(entry.label), "it works only on grids, with links along the axes, and this mesh is not one",
                "choose another algorithm, or generate a grid or a block");
  }
  if (entry.elastic) {
    entry.elastic->check(mesh);
  }
}

std::optional<std::uint64_t> max_solid_elements(Algorithm method) {
  const std::uint64_t most = info(method).elastic.value().most_in_solids;
  return most > 0 ? std::optional(most) : std::nullopt;
}

std::unique_ptr<ElasticSolver> make_elastic(Algorithm method, const ElasticProblem& problem, const Progress& progress) {
  check(problem.options);
  check(method, *problem.mesh);
  return info(method).elastic.value().make(problem, progress);
}

Algorithm add_algorithm(AlgorithmInfo entry) {
  const auto last = std::ranges::max_element(algorithm_table(), {}, &AlgorithmInfo::algorithm);
  entry.algorithm = std::max(first_added, Algorithm(int(last->algorithm) + 1));
  return insert(entry);
}

ExtraAlgorithm::ExtraAlgorithm(const AlgorithmInfo& entry) : algorithm_(insert(entry)) {}

ExtraAlgorithm::~ExtraAlgorithm() {
  std::erase_if(algorithm_table(), [this](const AlgorithmInfo& one) { return one.algorithm == algorithm_; });
}

}  // namespace chainmail
