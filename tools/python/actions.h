// What Python tells members in a step, as arrays.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

#include "drape/ensemble.h"
#include "module.h"

namespace drape::python {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Choices = py::array_t<bool, py::array::c_style | py::array::forcecast>;
using Places = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// The arguments of Ensemble.step() and Simulation.act().
struct Told {
    std::optional<Numbers> wind, pins, colliders, gravity, hands, loads, body_forces, body_impulses, body_velocities;
    std::optional<Choices> holds, body_sets;
    std::optional<Places> grasps;
};

/// Those who are told.
struct Listeners {
    std::optional<std::size_t> members;  ///< nothing: a simulation, whose arrays have no axis of members
    const SceneDescription& scene;       ///< of the first
    std::size_t hands;
};

/// The actions that arrays tell. Throws ActionError where one has another shape.
class ToldActions {
  public:
    ToldActions(const Told& told, const Listeners& to);
    EnsembleActions actions() const;

  private:
    std::vector<double> wind_, gravity_, pins_, colliders_, hands_, loads_, forces_, impulses_, velocities_;
    std::vector<std::uint8_t> holds_, sets_;
    std::vector<std::int32_t> grasps_;
};

/// Returns the controls of these names, and those of as many hands of the first cloth, or of one for each cloth.
EnsembleControls controls_of(const std::vector<std::string>& names, const SceneDescription& scene,
                             const py::object& hands);

/// Defines a method that is told by keyword: `tell(self, told)`.
template <class Self, class Tell>
void define_told(py::class_<Self>& type, const char* name, const Tell& tell, const char* help) {
    const auto none = py::none();
    type.def(
        name,
        [tell](Self& self, const std::optional<Numbers>& wind, const std::optional<Numbers>& pins,
               const std::optional<Numbers>& colliders, const std::optional<Choices>& holds,
               const std::optional<Numbers>& gravity, const std::optional<Numbers>& hands,
               const std::optional<Places>& grasps, const std::optional<Numbers>& loads,
               const std::optional<Numbers>& body_forces, const std::optional<Numbers>& body_impulses,
               const std::optional<Numbers>& body_velocities, const std::optional<Choices>& body_sets) {
            tell(self, Told{wind, pins, colliders, gravity, hands, loads, body_forces, body_impulses, body_velocities,
                            holds, body_sets, grasps});
        },
        py::kw_only(), py::arg("wind") = none, py::arg("pins") = none, py::arg("colliders") = none,
        py::arg("holds") = none, py::arg("gravity") = none, py::arg("hands") = none, py::arg("grasps") = none,
        py::arg("loads") = none, py::arg("body_forces") = none, py::arg("body_impulses") = none,
        py::arg("body_velocities") = none, py::arg("body_sets") = none, help);
}

}  // namespace drape::python
