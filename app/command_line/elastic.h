#pragma once

#include "command_line/common.h"
#include "elastic/material.h"

namespace chainmail::command_line {

/// What methods of elasticity and free-form deformation go by, as options.
struct ElasticArguments {
  CLI::Option *young = nullptr, *poisson = nullptr, *lattice = nullptr;
};
ElasticArguments add_elastic(CLI::App& app);
/// The same without free-form deformation's.
ElasticArguments add_material(CLI::App& app);
/// Throws Error, naming the option, where they are out of range.
ElasticOptions elastic_of(const ElasticArguments& arguments);

/// The elements that a word names to be pinned: `boundary`, or a layer as `bottom`. Nothing where it is no such word.
/// Throws Error, naming the option, where the object has none.
std::optional<std::vector<ElementId>> pins_by_name(const std::string& where, const std::string& word, const Mesh& mesh);
/// The value of `--pins`: such a word, or ids parted by commas; ascending. Throws Error where nothing is named;
/// `object` is how that calls it.
std::vector<ElementId> pins_of(const CLI::Option* pins, const std::string& object, const Mesh& mesh);
CLI::Option* add_pins(CLI::App& app);
/// All such words, as a help text parts them.
std::string pin_names();

}  // namespace chainmail::command_line
