#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "chainmail/mesh.h"

namespace chainmail::api {

/// What kind of model a method is.
enum class MethodFamily {
  chainmail,  ///< Links with valid regions: fast, uses softness, may be relaxed.
  elastic     ///< Elasticity or free-form deformation: prepares once, answers with an equilibrium, ignores softness.
};

/// What is known about a method.
struct MethodInfo {
  std::string name = {};     ///< Its name for Deformer, compare() and calibrate(), like `natural-queue`.
  std::string label = {};    ///< Its title in reports, like `Natural Queue ChainMail`.
  std::string source = {};   ///< Publication: author and year.
  std::string summary = {};  ///< One sentence about how it works.
  MethodFamily family = MethodFamily::chainmail;  ///< Kind of model.
  bool needs_grid = false;                        ///< True if it works only on lattices with links along the axes.
  bool needs_pins = false;                        ///< True if it has no answer without pinned elements.
  bool holds_links = false;                       ///< True if no link is violated after a move.
  bool is_registered = false;                     ///< True if a program registered it (register_method()).
};

/// Returns all methods: the ChainMail family, with registered methods at its end, then the methods that it is compared
/// with. Built in are generalized (Li and Brodlie 2003), spiral and natural-queue (Dean 2004), enhanced (Schill et al.
/// 1998), 3d (Frisken-Gibson 1997), exact (this project), fem (Bro-Nielsen and Cotin 1996), neo-hookean (Bonet and Wood
/// 1997), bem (James and Pai 1999), ffd (Sederberg and Parry 1986; Hsu et al. 1992), corotational (Mueller and Gross
/// 2004; Sifakis and Barbic 2012), arap (Sorkine and Alexa 2007; Chao et al. 2010), xpbd (Macklin et al. 2016,
/// 2019), projective (Bouaziz et al. 2014), quasi-newton (Liu et al. 2017; Smith et al. 2018) and neo-hookean-xpbd
/// (Macklin and Mueller 2021; Ton-That et al. 2023).
std::vector<MethodInfo> methods();

/// Returns what is known about a method. Throws Error, with all names, if there is none with this name.
MethodInfo method_info(std::string_view name);

/// Throws Error, with the reason, if a method does not work on a mesh or does not exist. Whether the pins suffice is
/// found by the first move.
void check_method(std::string_view method, const Mesh& mesh);
/// Returns that reason as one sentence; empty if there is none. Throws Error for an unknown name.
std::string refusal(std::string_view method, const Mesh& mesh);

}  // namespace chainmail::api
