// The library as a Python module, `import drape`: scenes come from files, text or dicts, simulations step with the GIL
// released, and positions, velocities, normals and pictures are NumPy arrays on the library's own memory.
#include "module.h"

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "actions.h"
#include "drape/ensemble.h"
#include "output/frame_writer.h"
#include "run/run_statistics.h"

namespace drape::python {

namespace {

/// Returns {"/solver/substeps": 40} as `--set` has it.
std::vector<std::string> override_texts(const py::dict& overrides) {
    const py::object dumps = py::module_::import("json").attr("dumps");
    std::vector<std::string> texts;
    for (const auto& [pointer, value] : overrides)
        texts.push_back(py::cast<std::string>(pointer) + "=" + py::cast<std::string>(dumps(value)));
    return texts;
}

Scene scene_of(SceneResult result, const std::vector<std::string>& overrides, const std::string& folder = {}) {
    if (!result.scene) throw SceneFailure(std::move(result));
    Scene scene{*result.scene, resolved_scene(result.text, overrides, folder), std::move(result.text), overrides, {},
                folder};
    for (const SceneError& warning : result.warnings) scene.warnings.push_back(warning.text());
    return scene;
}

Scene parse(const py::object& source, const py::dict& overrides) {
    const bool is_text = py::isinstance<py::str>(source);
    const py::object text = is_text ? source : py::module_::import("json").attr("dumps")(source);
    const std::vector<std::string> texts = override_texts(overrides);
    SceneResult result = read_scene_text(py::cast<std::string>(text), is_text ? "text" : "dict", texts);
    result.text = py::cast<std::string>(text);
    return scene_of(std::move(result), texts);
}

Scene load(const py::object& path, const py::dict& overrides) {
    const std::vector<std::string> texts = override_texts(overrides);
    const std::string name = py::cast<std::string>(py::module_::import("os").attr("fspath")(path));
    return scene_of(read_scene(name, texts), texts, scene_folder(name));
}

}  // namespace

Scene any_scene(const py::object& source) {
    if (py::isinstance<Scene>(source)) return py::cast<Scene>(source);
    return py::isinstance<py::dict>(source) ? parse(source, {}) : load(source, {});
}

Scene changed(const Scene& scene, const py::dict& overrides) {
    std::vector<std::string> texts = scene.overrides;
    for (std::string& text : override_texts(overrides)) texts.push_back(std::move(text));
    SceneResult result = read_scene_text(scene.source, "scene", texts, scene.folder);
    result.text = scene.source;
    return scene_of(std::move(result), texts, scene.folder);
}

PictureView picture_view(const std::string& name, std::optional<double> range) {
    for (const auto& [spelt, kind] : view_spellings)
        if (spelt == name) {
            const PictureView view{kind, range.value_or(0)};
            if (range && !(view.range > 0 && view.shows_strain()))
                throw py::value_error("view_range is a strain above 0, for the views stretch, warp and weft");
            return view;
        }
    throw py::value_error("view is none of shaded, stretch, warp, weft, wire, normals: '" + name + "'");
}

std::size_t cloth_number(const SceneDescription& scene, const py::object& which) {
    const std::vector<Cloth>& cloths = scene.cloths;
    if (py::isinstance<py::str>(which)) {
        const auto found = std::ranges::find(cloths, py::cast<std::string>(which), &Cloth::name);
        if (found == cloths.end()) throw py::key_error(py::cast<std::string>(which));
        return static_cast<std::size_t>(found - cloths.begin());
    }
    const auto number = py::cast<std::size_t>(which);
    if (number >= cloths.size()) throw py::index_error("no such cloth");
    return number;
}

py::dict body_arrays(const std::vector<std::vector<BodyState>>& members, bool many) {
    py::dict all;
    const auto add = [&](const char* name, std::size_t width, const auto& number) {
        std::vector<std::size_t> shape{members.size(), members.front().size()};
        if (!many) shape.erase(shape.begin());
        if (width > 1) shape.push_back(width);
        py::array_t<double> array(shape);
        double* to = array.mutable_data();
        for (const std::vector<BodyState>& bodies : members)
            for (const BodyState& body : bodies)
                for (std::size_t k = 0; k < width; ++k) *to++ = number(body, k);
        all[name] = array;
    };
    const auto add_vector = [&](const char* name, auto BodyState::*what) {
        add(name, (BodyState().*what).size(), [what](const BodyState& body, std::size_t k) { return (body.*what)[k]; });
    };
    const auto add_number = [&](const char* name, auto BodyState::*what) {
        add(name, 1, [what](const BodyState& body, std::size_t) { return static_cast<double>(body.*what); });
    };
    add_number("collider", &BodyState::collider);
    add_vector("position", &BodyState::position);
    add_vector("turn", &BodyState::turn);
    add_vector("velocity", &BodyState::velocity);
    add_vector("angular_velocity", &BodyState::angular_velocity);
    add_vector("momentum", &BodyState::momentum);
    add_vector("angular_momentum", &BodyState::angular_momentum);
    add_number("kinetic_energy", &BodyState::kinetic_energy);
    add_number("potential_energy", &BodyState::potential_energy);
    return all;
}

py::dict state_dict(const SimulationState& state) {
    py::dict parts;
    for (const auto& [name, bytes] : state)
        parts[py::str(name)] = py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return parts;
}

SimulationState state_of(const py::dict& parts) {
    SimulationState state;
    for (const auto& [name, text] : py::cast<std::map<std::string, std::string>>(parts)) {
        const auto bytes = std::as_bytes(std::span(text));
        state[name].assign(bytes.begin(), bytes.end());
    }
    return state;
}

namespace {

struct Options {
    std::string device;
    bool draw, layers, normals, validate, keep_failed;
    std::string view;
    std::optional<double> view_range;
    std::optional<std::array<std::uint32_t, 2>> size;
    EnsembleControls controls;
};

class PySimulation {
  public:
    PySimulation(const Scene& scene, const Options& options)
        : draws_(options.draw), has_normals_(options.normals), hands_(options.controls.hands.size()), source_(scene) {
        SceneDescription description = scene.description;
        if (options.size) description.image.size = *options.size;
        SimulationOptions wanted;
        wanted.draw = options.draw;
        wanted.layers = options.layers;
        wanted.view = picture_view(options.view, options.view_range);
        wanted.velocities = true;
        wanted.normals = options.normals;
        wanted.keep_promises = !options.keep_failed;
        wanted.controls = options.controls;
        const py::gil_scoped_release released;
        device_.emplace(options.device, validation_if(options.validate));
        simulation_.emplace(description, wanted, *device_);
    }

    bool step() {
        const py::gil_scoped_release released;
        const bool stepped = simulation_->step();
        has_frame_ = has_frame_ || stepped;
        return stepped;
    }

    void act(const Told& told) { simulation_->act(ToldActions(told, {std::nullopt, scene(), hands_}).actions()); }
    /// Returns the scene of what it was told so far.
    std::string told_scene() const {
        const std::uint32_t next = simulation_->next_frame();
        return scene_with_actions(source_.source, simulation_->recorded(), next > 0 ? next - 1 : 0, source_.overrides,
                                  source_.folder);
    }

    const FinishedFrame& frame() const {
        if (!has_frame_) throw py::value_error("there is no frame yet: call step() first");
        return simulation_->frame();
    }
    const SceneDescription& scene() const { return simulation_->scene(); }
    const Simulation& simulation() const { return *simulation_; }
    Simulation& simulation() { return *simulation_; }
    const Device& device() const { return *device_; }
    bool draws() const { return draws_; }
    bool has_normals() const { return has_normals_; }

    std::size_t cloth(const py::object& which) const { return cloth_number(scene(), which); }

  private:
    bool draws_, has_normals_, has_frame_ = false;
    std::size_t hands_;
    Scene source_;
    std::optional<Device> device_;
    std::optional<Simulation> simulation_;
};

using Arrays = std::vector<std::span<const float>>;

/// Returns the first numbers of each particle's four, float32 [row, column, width].
py::array vectors(const py::object& owner, const py::object& which, Arrays FinishedFrame::*what, py::ssize_t width) {
    const auto& self = py::cast<const PySimulation&>(owner);
    const bool is_field = what == &FinishedFrame::tensions || what == &FinishedFrame::contact_forces;
    if (is_field && !self.scene().force_fields)
        throw py::value_error("no tensions and contact forces: the scene does not say \"forces\": \"fields\"");
    if (what == &FinishedFrame::normals && !self.has_normals())
        throw py::value_error("no normals: the simulation was made without normals=True");
    const std::size_t cloth = self.cloth(which);
    const auto& [columns, rows] = self.scene().cloths[cloth].grid;
    const auto pitch = static_cast<py::ssize_t>(4 * sizeof(float));
    return view((self.frame().*what)[cloth].data(), {rows, columns, width}, {columns * pitch, pitch, sizeof(float)},
                owner);
}

py::array picture(const py::object& owner) {
    const auto& self = py::cast<const PySimulation&>(owner);
    if (!self.draws()) throw py::value_error("no pictures: the simulation was made without draw=True");
    const auto& [width, height] = self.scene().image.size;
    return view(self.frame().rgba.data(), {height, width, 4}, {py::ssize_t{4} * width, 4, 1}, owner);
}

/// Returns what is seen at each pixel, by the layers' names; the normals, which have another type there, are copied.
py::dict layers(const py::object& owner) {
    const auto& self = py::cast<const PySimulation&>(owner);
    const std::span<const LayerPixel> pixels = self.frame().layers;
    if (pixels.empty()) throw py::value_error("no layers: the simulation was made without layers=True");
    const auto& [width, height] = self.scene().image.size;
    const auto pitch = static_cast<py::ssize_t>(sizeof(LayerPixel));
    const auto seen = [&, width = width, height = height](const auto& first) {
        return view(&first, {height, width}, {width * pitch, pitch}, owner);
    };
    py::array_t<float> normals({height, width, 3u});
    float* to = normals.mutable_data();
    for (const LayerPixel& pixel : pixels)
        for (const std::int16_t part : pixel.normal) *to++ = static_cast<float>(part) / 32767;
    py::dict all;
    all["depth"] = seen(pixels[0].depth);
    all["normal"] = normals;
    all["id"] = seen(pixels[0].id);
    all["strain"] = seen(pixels[0].strain);
    return all;
}

py::array_t<std::int32_t> faces(const PySimulation& self, const py::object& which) {
    const std::vector<std::uint32_t> corners = self.simulation().triangles(self.cloth(which));
    py::array_t<std::int32_t> array({corners.size() / 3, std::size_t{3}});
    std::ranges::copy(corners, array.mutable_data());
    return array;
}

py::array_t<std::uint8_t> springs(const PySimulation& self, const py::object& which) {
    const std::size_t cloth = self.cloth(which);
    const auto& [columns, rows] = self.scene().cloths[cloth].grid;
    py::array_t<std::uint8_t> array({rows, columns});
    std::ranges::copy(self.simulation().spring_bits(cloth), array.mutable_data());
    return array;
}

py::array_t<float> uv(const PySimulation& self, const py::object& which) {
    const Cloth& cloth = self.scene().cloths[self.cloth(which)];
    WrittenCloth written;
    written.columns = cloth.grid[0], written.rows = cloth.grid[1];
    written.size = cloth.size, written.panel = cloth.panel;
    py::array_t<float> array({cloth.grid[1], cloth.grid[0], 2u});
    float* to = array.mutable_data();
    for (std::size_t particle = 0; particle < std::size_t{cloth.grid[0]} * cloth.grid[1]; ++particle, to += 2)
        std::ranges::copy(written.uv(particle), to);
    return array;
}

void define_scene(py::module_& module) {
    py::class_<Scene>(module, "Scene", "A scene that can be run. Made by load() and parse().")
        .def_property_readonly("name", [](const Scene& scene) { return scene.description.name; })
        .def_property_readonly("fps", [](const Scene& scene) { return scene.description.time.fps; })
        .def_property_readonly("frame_count", [](const Scene& scene) { return scene.description.time.frame_count; })
        .def_property_readonly(
            "cloths",
            [](const Scene& scene) {
                std::vector<std::string> names;
                for (const Cloth& cloth : scene.description.cloths) names.push_back(cloth.name);
                return names;
            },
            "Names, in order.")
        .def_readonly("warnings", &Scene::warnings, "Each with its place.")
        .def(
            "to_dict", [](const Scene& scene) { return py::module_::import("json").attr("loads")(scene.json); },
            "The scene with every default written out, to change and parse() again.")
        .def("__repr__", [](const Scene& scene) { return "<drape.Scene '" + scene.description.name + "'>"; });
    module.def("load", &load, py::arg("path"), py::arg("overrides") = py::dict(),
               "Reads a scene file. overrides: {'/json/pointer': value}, as --set.");
    module.def("parse", &parse, py::arg("source"), py::arg("overrides") = py::dict(),
               "A scene from a dict, or from the text of a scene file.");
}

std::unique_ptr<PySimulation> make_simulation(const py::object& scene, std::string device, bool draw, std::string shown,
                                              std::optional<double> view_range,
                                              std::optional<std::array<std::uint32_t, 2>> size, bool layers,
                                              bool normals, bool validate, bool keep_failed,
                                              const std::vector<std::string>& controls, const py::object& hands) {
    const Scene made = any_scene(scene);
    const Options options{std::move(device),
                          draw,
                          layers,
                          normals,
                          validate,
                          keep_failed,
                          std::move(shown),
                          view_range,
                          size,
                          controls_of(controls, made.description, hands)};
    return std::make_unique<PySimulation>(made, options);
}

void define_arrays(py::class_<PySimulation>& simulation) {
    const auto which = py::arg("cloth") = 0;
    const auto add = [&](const char* name, Arrays FinishedFrame::*what, const char* help, py::ssize_t width = 3) {
        simulation.def(
            name, [=](const py::object& self, const py::object& cloth) { return vectors(self, cloth, what, width); },
            which, help);
    };
    add("positions", &FinishedFrame::positions,
        "float32 [row, column, 3], m. No copy: read-only, and the next step() changes what is in it. It keeps the "
        "simulation alive. cloth: number or name.");
    add("velocities", &FinishedFrame::velocities, "float32 [row, column, 3], m/s, at the frame's end; as positions.");
    add("normals", &FinishedFrame::normals, "float32 [row, column, 3], unit, of the front; as positions.");
    add("tensions", &FinishedFrame::tensions,
        "float32 [row, column, 4], N: what the springs to the right (column + 1), down (row + 1), down right and down "
        "left bear, pulled above 0; needs \"forces\": \"fields\" in the scene; as positions.",
        4);
    add("contact_forces", &FinishedFrame::contact_forces,
        "float32 [row, column, 3], N: the mean force of contact with colliders and cloth in the frame; needs "
        "\"forces\": "
        "\"fields\"; as positions.");
    simulation
        .def("picture", &picture,
             "uint8 [height, width, 4], sRGB and 255, rows from the top; needs draw=True. No copy, as positions.")
        .def("layers", &layers,
             "What is seen at the centre of each pixel, rows from the top; needs layers=True. A dict of arrays [row, "
             "column]: depth (float32, m along the camera's axis; infinity: nothing), id (uint16: 0 nothing, from 1 on "
             "the cloths, after them the colliders, 65535 a pole, rail, knob or blade), strain (float32, of the most "
             "stretched spring of cloth) and normal (float32 [row, column, 3], of the side in view, in the world). No "
             "copies but of normal, as positions.")
        .def(
            "bodies", [](const PySimulation& self) { return body_arrays({self.frame().bodies}, false); },
            "A dict of float64 arrays [body, ...] of the colliders with a mass: collider (its number), position (m, of "
            "its shape's centre), turn (unit quaternion x y z w), velocity (m/s, of its centre of mass), "
            "angular_velocity (rad/s), momentum, angular_momentum (about the origin), kinetic_energy and "
            "potential_energy (J). Copies.")
        .def("faces", &faces, which,
             "int32 [face, 3]: particles (row * columns + column) of the triangles that no cut has split so far.")
        .def(
            "springs", &springs, which,
            "uint8 [row, column]: which springs are there, uncut and untorn: bits 1, 2, 4 and 8 for those of tensions.")
        .def("uv", &uv, which, "float32 [row, column, 2]: texture coordinates.");
}

void define_facts(py::class_<PySimulation>& simulation) {
    simulation
        .def_property_readonly("cloths",
                               [](const PySimulation& self) {
                                   std::vector<std::string> names;
                                   for (const Cloth& cloth : self.scene().cloths) names.push_back(cloth.name);
                                   return names;
                               })
        .def_property_readonly("method", [](const PySimulation& self) { return self.simulation().facts().method; })
        .def_property_readonly("device", [](const PySimulation& self) { return self.device().info().name; })
        .def_property_readonly("validation_count",
                               [](const PySimulation& self) { return self.device().validation_count(); });
}

void define_states(py::class_<PySimulation>& simulation) {
    simulation.def_property_readonly("can_save", [](const PySimulation& self) { return self.simulation().can_save(); })
        .def(
            "save", [](const PySimulation& self) { return state_dict(self.simulation().save()); },
            "What the next frames depend on: a dict of bytes, for restore() of a simulation of the same scene.")
        .def("restore", [](PySimulation& self, const py::dict& state) { self.simulation().restore(state_of(state)); })
        .def(
            "save_scene",
            [](const PySimulation& self, const py::object& path) {
                py::module_::import("pathlib").attr("Path")(path).attr("write_text")(self.told_scene());
            },
            py::arg("path"), "Writes a scene file that is told what act() told, and so has the same bits.");
}

void define_simulation(py::module_& module) {
    py::class_<PySimulation> simulation(module, "Simulation", "A scene on a device, frame by frame.");
    simulation
        .def(
            py::init(&make_simulation), py::arg("scene"), py::kw_only(), py::arg("device") = "",
            py::arg("draw") = false, py::arg("view") = "shaded", py::arg("view_range") = py::none(),
            py::arg("size") = py::none(), py::arg("layers") = false, py::arg("normals") = false,
            py::arg("validate") = false, py::arg("keep_failed") = false,
            py::arg("controls") = std::vector<std::string>(), py::arg("hands") = 0,
            "scene: a Scene, a path or a dict. device: index, part of the name, UUID or 'cpu'; '' is what the "
            "environment variable DRAPE_DEVICE says, else the best there is. draw: pictures, of size (width, height), "
            "showing view (shaded, stretch, warp, weft, wire, normals; view_range: strain at the end of the colours). "
            "layers: layers() of that size are wanted. normals: normals() are wanted. validate: Vulkan's validation "
            "layer, messages on stderr. "
            "keep_failed: go on after a frame that is no result. controls, hands: what act() may tell, as Ensemble has "
            "them.")
        .def("step", &PySimulation::step,
             "Computes the next frame, the first time frame 0, the start; False after the last. Other Python threads "
             "run meanwhile.")
        .def("__iter__", [](const py::object& self) { return self; })
        .def("__next__",
             [](const py::object& self) {
                 if (!py::cast<PySimulation&>(self).step()) throw py::stop_iteration();
                 return self;
             })
        .def_property_readonly("frame", [](const PySimulation& self) { return self.frame().frame; })
        .def_property_readonly(
            "time", [](const PySimulation& self) { return self.frame().frame / self.scene().time.fps; }, "s")
        .def_property_readonly(
            "statistics", [](const PySimulation& self) { return frame_values(self.scene(), self.frame()); },
            "A dict of the frame's numbers, named as in manifest.json: strains, stretch errors, energies (J), ...")
        .def_property_readonly(
            "failure",
            [](const PySimulation& self) {
                const auto& failure = self.frame().failure;
                return failure ? std::optional(failure->reason) : std::nullopt;
            },
            "Why the frame is no result, or None; with keep_failed.");
    define_told(
        simulation, "act", [](PySimulation& self, const Told& told) { self.act(told); },
        "Tells what holds from the next frame on (from frame 1, if there was no step yet); arrays as those of "
        "Ensemble.step, without the axis of members: wind [3], pins [pin, 3 or 6] and so on. Needs controls or hands. "
        "What is not given stays as it is. Raises ActionError, and then nothing has changed.");
    define_facts(simulation);
    define_states(simulation);
    define_arrays(simulation);
}

}  // namespace

}  // namespace drape::python

PYBIND11_MODULE(drape, module) {
    module.doc() = "Cloth simulation on the GPU: scenes in, arrays and pictures out.";
    drape::python::translate_errors(module);
    drape::python::define_scene(module);
    drape::python::define_simulation(module);
    drape::python::define_ensemble(module);
    module.def("devices", [] {
        std::vector<std::string> names;
        for (const drape::DeviceInfo& device : drape::Device::list()) names.push_back(device.name);
        return names;
    });
}
