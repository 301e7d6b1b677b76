// Ensembles in Python: members share dispatches, arrays are [member, row, column, 3] on the library's own memory.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "actions.h"
#include "run/run_statistics.h"

namespace drape::python {

namespace {

/// Returns the members' scenes: so many of the scene, or what each entry makes of it.
std::vector<Scene> scenes_of(const Scene& scene, const py::object& members) {
    std::vector<Scene> scenes;
    if (py::isinstance<py::int_>(members)) {
        const auto count = py::cast<py::ssize_t>(members);
        if (count < 1) throw py::value_error("members: expected at least one");
        scenes.assign(static_cast<std::size_t>(count), scene);
        return scenes;
    }
    for (const py::handle member : py::iter(members)) {
        const auto object = py::reinterpret_borrow<py::object>(member);
        if (py::isinstance<Scene>(object))
            scenes.push_back(py::cast<const Scene&>(object));
        else if (py::isinstance<py::dict>(object))
            scenes.push_back(changed(scene, py::cast<py::dict>(object)));
        else
            throw py::type_error("members: expected how many, or a list with a dict or a Scene for each");
    }
    return scenes;
}

class PyEnsemble {
  public:
    PyEnsemble(std::vector<Scene> scenes, const EnsembleOptions& options, const std::string& device, bool validate)
        : hand_count_(options.controls.hands.size()), scenes_(std::move(scenes)) {
        const py::gil_scoped_release released;
        std::vector<SceneDescription> all;
        for (const Scene& scene : scenes_) all.push_back(scene.description);
        device_.emplace(device, validation_if(validate));
        ensemble_.emplace(all, options, *device_);
    }
    Ensemble& ensemble() { return *ensemble_; }
    const Ensemble& ensemble() const { return *ensemble_; }
    const Device& device() const { return *device_; }

    void step(const Told& told) {
        const ToldActions actions(told, {ensemble_->size(), ensemble_->scene(0), hand_count_});
        const py::gil_scoped_release released;
        ensemble_->step(actions.actions());
    }

    /// Returns the scene of what a member was told so far.
    std::string scene_of(std::size_t member) const {
        const Scene& scene = scenes_.at(member);
        return scene_with_actions(scene.source, ensemble_->recorded(member), ensemble_->frame(member), scene.overrides,
                                  scene.folder);
    }

  private:
    std::size_t hand_count_;
    std::vector<Scene> scenes_;  ///< of the members
    std::optional<Device> device_;
    std::optional<Ensemble> ensemble_;
};

py::array member_vectors(const py::object& owner, const py::object& which,
                         MemberArray (Ensemble::*what)(std::size_t) const, int numbers) {
    const Ensemble& self = py::cast<const PyEnsemble&>(owner).ensemble();
    const MemberArray array = (self.*what)(cloth_number(self.scene(0), which));
    const auto size = [](std::size_t count) { return static_cast<py::ssize_t>(count); };
    const py::ssize_t pitch = 4 * sizeof(float);
    return view(array.data, {size(array.members), size(array.rows), size(array.columns), numbers},
                {size(array.member_stride * sizeof(float)), size(array.columns) * pitch, pitch, sizeof(float)}, owner);
}

/// Returns the numbers of members: of all where `which` is None, of those where a mask is true, else it lists them.
std::vector<std::size_t> members_of(const Ensemble& ensemble, const py::object& which) {
    if (!which.is_none()) {
        const auto list = py::array::ensure(which);
        const bool is_list = list && list.ndim() == 1;
        std::vector<std::size_t> numbers;
        if (is_list && list.dtype().kind() == 'b') {
            if (static_cast<std::size_t>(list.size()) != ensemble.size())
                throw py::value_error(
                    fmt::format("members: a mask of {} for {} members", list.size(), ensemble.size()));
            const auto mask = py::cast<py::array_t<bool>>(list);
            for (py::ssize_t k = 0; k < list.size(); ++k)
                if (mask.at(k)) numbers.push_back(static_cast<std::size_t>(k));
            return numbers;
        }
        if (!is_list || (list.size() > 0 && list.dtype().kind() != 'i' && list.dtype().kind() != 'u'))
            throw py::type_error("members: expected a list of their numbers, or a mask with a bool for each");
        const auto given = py::cast<py::array_t<std::int64_t>>(list);
        for (py::ssize_t k = 0; k < list.size(); ++k) {
            if (given.at(k) < 0) throw py::index_error(fmt::format("members: there is none of number {}", given.at(k)));
            numbers.push_back(static_cast<std::size_t>(given.at(k)));
        }
        return numbers;
    }
    std::vector<std::size_t> all(ensemble.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return all;
}

void check_member(const Ensemble& ensemble, std::size_t member) {
    if (member >= ensemble.size()) throw py::index_error("no such member");
}

std::map<std::size_t, std::string> failures(const Ensemble& ensemble) {
    std::map<std::size_t, std::string> all;
    for (std::size_t k = 0; k < ensemble.size(); ++k)
        if (const auto& failure = ensemble.failure(k)) all[k] = failure->reason;
    return all;
}

py::dict statistics(const Ensemble& ensemble, std::size_t member) {
    check_member(ensemble, member);
    FinishedFrame frame;
    frame.frame = ensemble.frame(member);
    frame.statistics = ensemble.statistics(member);
    frame.effort = ensemble.effort(member);
    return py::cast(frame_values(ensemble.scene(member), frame));
}

py::array picture_of(const py::object& owner, std::size_t member) {
    auto& self = py::cast<PyEnsemble&>(owner);
    check_member(self.ensemble(), member);
    const auto& [width, height] = self.ensemble().scene(member).image.size;
    const auto bytes = self.ensemble().picture(member);
    return py::array_t<std::uint8_t>({py::ssize_t{height}, py::ssize_t{width}, py::ssize_t{4}}, bytes.data());
}

std::unique_ptr<PyEnsemble> make(const py::object& scene, const py::object& members, const std::string& device,
                                 bool normals, const std::vector<std::string>& controls, const py::object& hands,
                                 const std::string& shown, bool record, bool validate) {
    const Scene first = any_scene(scene);
    EnsembleOptions options;
    options.normals = normals;
    options.record = record;
    options.controls = controls_of(controls, first.description, hands);
    options.view = picture_view(shown, {});
    return std::make_unique<PyEnsemble>(scenes_of(first, members), options, device, validate);
}

void define_member_states(py::class_<PyEnsemble>& ensemble) {
    ensemble
        .def(
            "reset",
            [](PyEnsemble& self, const py::object& members) {
                self.ensemble().reset(members_of(self.ensemble(), members));
            },
            py::arg("members") = py::none(),
            "Takes members (their numbers, or a mask with a bool for each; None: all) back to frame 0.")
        .def(
            "save",
            [](const PyEnsemble& self, std::size_t member) {
                check_member(self.ensemble(), member);
                return state_dict(self.ensemble().save(member));
            },
            py::arg("member"), "What the member's next frames depend on: a dict of bytes, for restore().")
        .def(
            "restore",
            [](PyEnsemble& self, const py::object& members, const std::vector<py::dict>& states) {
                std::vector<SimulationState> all;
                for (const py::dict& state : states) all.push_back(state_of(state));
                self.ensemble().restore(members_of(self.ensemble(), members), all);
            },
            py::arg("members"), py::arg("states"), "Takes members to saved states, one for each; any member's.");
}

void define_member_arrays(py::class_<PyEnsemble>& ensemble) {
    const auto add = [&](const char* name, MemberArray (Ensemble::*what)(std::size_t) const, const char* help,
                         int numbers = 3) {
        ensemble.def(
            name,
            [what, numbers](const py::object& self, const py::object& cloth) {
                return member_vectors(self, cloth, what, numbers);
            },
            py::arg("cloth") = 0, help);
    };
    add("positions", &Ensemble::positions,
        "float32 [member, row, column, 3], m. No copy: read-only, and the next step() changes what is in it. cloth: "
        "number or name.");
    add("velocities", &Ensemble::velocities, "float32 [member, row, column, 3], m/s, at the frames' ends.");
    add("normals", &Ensemble::normals, "float32 [member, row, column, 3], unit, of the front; needs normals=True.");
    add("tensions", &Ensemble::tensions,
        "float32 [member, row, column, 4], N: what the springs to the right (column + 1), down (row + 1), down right "
        "and down left bear, pulled above 0; needs \"forces\": \"fields\" in the scenes.",
        4);
    add("contact_forces", &Ensemble::contact_forces,
        "float32 [member, row, column, 3], N: the mean force of contact with colliders and cloth in the frame; needs "
        "\"forces\": \"fields\".");
}

void define_member_facts(py::class_<PyEnsemble>& ensemble) {
    ensemble
        .def_property_readonly(
            "obstacle", [](const PyEnsemble& self) { return self.ensemble().sharing_obstacle(); },
            "Why members do not share dispatches and take longer; None: they do.")
        .def_property_readonly("pass_count", [](const PyEnsemble& self) { return self.ensemble().pass_count(); })
        .def_property_readonly(
            "device_ms", [](const PyEnsemble& self) { return self.ensemble().device_milliseconds(); },
            "Milliseconds that the device spent on the last step.")
        .def_property_readonly("device", [](const PyEnsemble& self) { return self.device().info().name; })
        .def_property_readonly("validation_count",
                               [](const PyEnsemble& self) { return self.device().validation_count(); });
    ensemble.def(
        "bodies",
        [](const PyEnsemble& self) {
            std::vector<std::vector<BodyState>> all;
            for (std::size_t k = 0; k < self.ensemble().size(); ++k) all.push_back(self.ensemble().bodies(k));
            return body_arrays(all, true);
        },
        "A dict of arrays [member, body, ...] of the colliders with a mass, as Simulation.bodies().");
}

void define_member_step(py::class_<PyEnsemble>& ensemble) {
    define_told(
        ensemble, "step", [](PyEnsemble& self, const Told& told) { self.step(told); },
        "Computes the next frame of every member. wind: [member, 3], m/s, during the step. pins: [member, pin, 3] "
        "or [..., 6]: m, and degrees about x, y, z, from where the scene has the pin, at the step's end. "
        "colliders: [member, collider, 3 or 6] likewise; planes, spheres, boxes, ellipsoids, capsules, meshes, in "
        "order. holds: bool [member, pin]: which pins hold; one that takes again has its particles where they are. "
        "gravity: [member, 3], m/s^2. hands: [member, hand, 3 or 6]: where they are at the step's end, m and "
        "degrees. grasps: int [member, hand, 2]: column and row of the particle that it holds, or [..., 4]: first "
        "and last column and row, in the order column, row, column, row; -1: none. loads: [member, load, 3]: N, of "
        "a load "
        "that presses Pa, 0, 0, during the step. body_forces: [member, body, 3 or 6]: N and N m on colliders with "
        "a "
        "mass, during the step. body_impulses: likewise N s and N m s at its start. body_velocities: m/s and rad/s "
        "at its start, of those bodies that body_sets, bool [member, body], names, or of all. "
        "What is not given stays as it is. Raises ActionError, and then no member went on.");
}

}  // namespace

void define_ensemble(py::module_& module) {
    py::class_<PyEnsemble> ensemble(module, "Ensemble", "Many scenes of one shape, simulated together.");
    ensemble
        .def(
            py::init(&make), py::arg("scene"), py::arg("members"), py::kw_only(), py::arg("device") = "",
            py::arg("normals") = false, py::arg("controls") = std::vector<std::string>(), py::arg("hands") = 0,
            py::arg("view") = "shaded", py::arg("record") = false, py::arg("validate") = false,
            "scene: a Scene, a path or a dict. members: how many of it, or a list with a dict {'/json/pointer': value} "
            "or a Scene for each; they differ in numbers, not in grids, pinned particles, kinds of colliders or the "
            "method. controls: what step() may be given: 'wind', 'pins', 'colliders', 'holds', 'gravity', 'loads', "
            "'bodies'. "
            "hands: how "
            "many "
            "hands take particles of the first cloth, or the cloth of each. record: whether save_scene() can write "
            "what members "
            "were told. All begin at frame 0.")
        .def("__len__", [](const PyEnsemble& self) { return self.ensemble().size(); })
        .def_property_readonly(
            "frames",
            [](const PyEnsemble& self) {
                py::array_t<std::uint32_t> all(static_cast<py::ssize_t>(self.ensemble().size()));
                for (std::size_t k = 0; k < self.ensemble().size(); ++k)
                    all.mutable_data()[k] = self.ensemble().frame(k);
                return all;
            },
            "uint32 [member]: the frame that each is at.")
        .def_property_readonly(
            "failures", [](const PyEnsemble& self) { return failures(self.ensemble()); },
            "{member: reason} of those whose frames are no results since they failed; the others go on.")
        .def(
            "statistics",
            [](const PyEnsemble& self, std::size_t member) { return statistics(self.ensemble(), member); },
            py::arg("member"), "A dict of the frame's numbers, as Simulation.statistics.")
        .def(
            "save_scene",
            [](const PyEnsemble& self, const py::object& path, std::size_t member) {
                check_member(self.ensemble(), member);
                py::module_::import("pathlib").attr("Path")(path).attr("write_text")(self.scene_of(member));
            },
            py::arg("path"), py::arg("member") = 0,
            "Writes a scene file that is told what the member was told since its start, and so has its bits. Needs "
            "record=True. Files that the member's scene names are looked for beside it.")
        .def("picture", &picture_of, py::arg("member"), "uint8 [height, width, 4], sRGB and 255: the member now.");
    define_member_step(ensemble);
    define_member_facts(ensemble);
    define_member_states(ensemble);
    define_member_arrays(ensemble);
}

}  // namespace drape::python
