// The parts of the Python module share these.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "drape/simulation.h"

namespace drape::python {

namespace py = pybind11;

/// A scene, its JSON with every default, and what it was read from: changes are made to that, since what is written out
/// there has precedence over what other keys stand for, such as a fabric.
struct Scene {
    SceneDescription description;
    std::string json;
    std::string source;
    std::vector<std::string> overrides;
    std::vector<std::string> warnings;
    std::string folder;  ///< in which it looks for files that it names; empty: the working directory
};

/// Takes a Scene as it is, parses a dict, and loads a path.
Scene any_scene(const py::object& source);
/// Changes a scene: {'/json/pointer': value}.
Scene changed(const Scene& scene, const py::dict& overrides);
/// Finds one of the kinds of view by its name, with a range above 0 or none.
PictureView picture_view(const std::string& name, std::optional<double> range);
/// Finds a cloth by number or by name.
std::size_t cloth_number(const SceneDescription& scene, const py::object& which);

/// Returns a read-only view of the library's memory, which lives as long as `owner`.
template <class T>
py::array view(const T* data, const std::vector<py::ssize_t>& shape, const std::vector<py::ssize_t>& strides,
               const py::object& owner) {
    py::array array(py::dtype::of<T>(), shape, strides, data, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// Returns the numbers of bodies by name: float64 [member, body, ...], or of one scene, [body, ...].
py::dict body_arrays(const std::vector<std::vector<BodyState>>& members, bool many);

/// Saved states as dicts of bytes.
py::dict state_dict(const SimulationState& state);
SimulationState state_of(const py::dict& parts);

/// Defines Ensemble.
void define_ensemble(py::module_& module);
/// Defines the exceptions.
void translate_errors(py::module_& module);

}  // namespace drape::python
