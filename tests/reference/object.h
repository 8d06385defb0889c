#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <list>
#include <utility>

#include "mesh/mesh.h"

/// ChainMail written literally from Dean 2004, sections 3.1, 4.1 and 4.2, with lists and linear searches. It is slow on
/// purpose, and shares no code with the solvers: of core it uses only the mesh. It gives the expected results of tests,
/// and the 2004 baseline of the benchmarks.
namespace reference {

using chainmail::ElementId;
using chainmail::MeshPointer;

/// Compression, stretch and shear factors of a link, relative to its rest vector.
struct Factors {
  double compression = 0.8;
  double stretch = 1.2;
  double shear = 0.1;
};
/// The factors of the link between two elements; the smaller id comes first.
using FactorsOfLink = std::function<Factors(ElementId, ElementId)>;

/// Thesis 4.2: Element = { identifier, original position, current position, processing state, list of
/// neighbours }. Only the first space_dimension coordinates exist.
template <class Scalar>
struct Element {
  ElementId identifier;
  std::array<double, 3> original_position;
  std::array<Scalar, 3> current_position;
  bool updated;
  std::list<ElementId> neighbours;
};

/// Thesis 4.2: Softness_Data = { sponsor, neighbour, valid region }, the region relative to the sponsor.
template <class Scalar>
struct SoftnessData {
  ElementId sponsor;
  ElementId neighbour;
  std::array<Scalar, 3> low;
  std::array<Scalar, 3> high;
};

/// Thesis 4.2: Object = { list of element, list of softness properties, …, space dimension, … }.
template <class Scalar>
class Object {
 public:
  Object(MeshPointer mesh, const FactorsOfLink& factors) : space_dimension(mesh->space_dimension), mesh_(mesh) {
    for (ElementId i = 0; i < mesh->element_count(); ++i) {
      const auto row = mesh->neighbours_of(i);
      Element<Scalar> element{i, {}, {}, false, {row.begin(), row.end()}};
      for (int k = 0; k < space_dimension; ++k) {
        element.original_position[k] = mesh->rest[std::size_t{i} * space_dimension + k];
        element.current_position[k] = static_cast<Scalar>(element.original_position[k]);
      }
      elements.push_back(element);
    }
    construct_softness(factors);
  }

  /// Computes the valid regions "when the object is constructed" (thesis 4.2), or when the softness changes.
  void construct_softness(const FactorsOfLink& factors) {
    softness.clear();
    for (ElementId i = 0; i < mesh_->element_count(); ++i) {
      for (const ElementId j : mesh_->neighbours_of(i)) {
        softness.push_back(valid_region(i, j, factors(std::min(i, j), std::max(i, j))));
      }
    }
  }

  /// "A search of all the elements in the list would need to be carried out" (thesis 4.4).
  Element<Scalar>& element(ElementId identifier) {
    return *std::find_if(elements.begin(), elements.end(),
                         [identifier](const auto& one) { return one.identifier == identifier; });
  }

  const SoftnessData<Scalar>& softness_of(ElementId sponsor, ElementId neighbour) const {
    return *std::find_if(softness.begin(), softness.end(), [sponsor, neighbour](const auto& one) {
      return one.sponsor == sponsor && one.neighbour == neighbour;
    });
  }

  /// Cuts a link: removes it from the lists of neighbours (thesis 4.4, enhancement 4).
  void cut(ElementId a, ElementId b) {
    element(a).neighbours.remove(b);
    element(b).neighbours.remove(a);
  }

  /// Restores a link, with each end at its original place in the list of neighbours.
  void uncut(ElementId a, ElementId b) {
    list_again(a, b);
    list_again(b, a);
  }

  const chainmail::Mesh& mesh() const { return *mesh_; }

  int space_dimension;
  std::list<Element<Scalar>> elements;
  std::list<SoftnessData<Scalar>> softness;

 private:
  void list_again(ElementId at, ElementId neighbour) {
    const std::list<ElementId> listed = element(at).neighbours;
    element(at).neighbours.clear();
    for (const ElementId one : mesh_->neighbours_of(at)) {
      if (one == neighbour || std::find(listed.begin(), listed.end(), one) != listed.end()) {
        element(at).neighbours.push_back(one);
      }
    }
  }

  /// Bounds of the valid region, computed in double and rounded once. The formula of the thesis alone would invert the
  /// regions of links that run left or down; min and max correct this.
  SoftnessData<Scalar> valid_region(ElementId sponsor, ElementId neighbour, const Factors& factors) {
    const auto& from = element(sponsor).original_position;
    const auto& to = element(neighbour).original_position;
    SoftnessData<Scalar> data{sponsor, neighbour, {}, {}};
    for (int k = 0; k < space_dimension; ++k) {
      const double along = to[k] - from[k];
      double across = 0;
      for (int j = 0; j < space_dimension; ++j) {
        if (j != k) {
          across += std::fabs(to[j] - from[j]);
        }
      }
      const double shortest = along * factors.compression;
      const double longest = along * factors.stretch;
      const double lean = across * factors.shear;
      data.low[k] = static_cast<Scalar>((shortest < longest ? shortest : longest) - lean);
      data.high[k] = static_cast<Scalar>((shortest < longest ? longest : shortest) + lean);
    }
    return data;
  }

  MeshPointer mesh_;
};

}  // namespace reference
