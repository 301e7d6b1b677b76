#include "actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace drape::python {

namespace {

/// Reads arrays of one shape or another.
class Reader {
  public:
    explicit Reader(const Listeners& to) : members_(to.members), count_(to.members.value_or(1)) {}

    /// Returns [member, count] numbers, or with `width` [member, count, width], whose entries may have 3 of 6: what an
    /// entry lacks, turns, is 0.
    std::vector<double> numbers(const Numbers& array, const char* name, std::size_t count,
                                std::size_t width = 1) const {
        const std::size_t last = width > 1 ? extent(array, array.ndim() - 1) : 1;
        if (!is(array, count, width > 1) || (last != 3 && last != width))
            refuse(name, count, width == 1 ? "" : width == 3 ? ", 3" : ", 3 or 6");
        if (last == width) return {array.data(), array.data() + array.size()};
        std::vector<double> all(count_ * count * width);
        for (std::size_t k = 0; k < count_ * count; ++k)
            std::copy_n(array.data() + last * k, last, all.begin() + static_cast<std::ptrdiff_t>(width * k));
        return all;
    }

    std::vector<std::uint8_t> choices(const Choices& array, const char* name, std::size_t count) const {
        if (!is(array, count, false)) refuse(name, count, "");
        return {array.data(), array.data() + array.size()};
    }

    /// Returns first column, first row, last column, last row, which are the same in entries of 2.
    std::vector<std::int32_t> places(const Places& array, std::size_t count) const {
        const std::size_t last = extent(array, array.ndim() - 1);
        if (!is(array, count, true) || (last != 2 && last != 4)) refuse("grasps", count, ", 2 or 4");
        std::vector<std::int32_t> all;
        for (std::size_t k = 0; k < count_ * count; ++k)
            for (std::size_t i = 0; i < 4; ++i) {
                const std::int64_t number = array.data()[last * k + i % last];
                all.push_back(number == static_cast<std::int32_t>(number) ? static_cast<std::int32_t>(number)
                                                                          : INT32_MAX);
            }
        return all;
    }

  private:
    static std::size_t extent(const py::array& array, py::ssize_t axis) {
        return axis >= 0 && axis < array.ndim() ? static_cast<std::size_t>(array.shape(axis)) : 0;
    }
    /// Whether the axes are those of members, where there are some, of `count`, and one of entries where they have one.
    bool is(const py::array& array, std::size_t count, bool has_entries) const {
        const py::ssize_t first = members_ ? 1 : 0;
        return array.ndim() == first + (has_entries ? 2 : 1) && (!members_ || extent(array, 0) == *members_) &&
               extent(array, first) == count;
    }
    [[noreturn]] void refuse(const char* name, std::size_t count, const char* entries) const {
        throw ActionError(fmt::format("actions: {}: expected an array [{}{}{}]", name,
                                      members_ ? fmt::format("{}, ", *members_) : "", count, entries),
                          0);
    }

    std::optional<std::size_t> members_;
    std::size_t count_;
};

}  // namespace

ToldActions::ToldActions(const Told& told, const Listeners& to) {
    const Reader reader(to);
    std::size_t pins = 0, loads = 0;
    for (const Cloth& cloth : to.scene.cloths) {
        pins += cloth.pins.size();
        loads += cloth.loads.size();
    }
    const auto bodies = static_cast<std::size_t>(
        std::ranges::count_if(to.scene.colliders, [](const Collider& each) { return each.mass.has_value(); }));
    if (told.wind) wind_ = reader.numbers(*told.wind, "wind", 3);
    if (told.gravity) gravity_ = reader.numbers(*told.gravity, "gravity", 3);
    if (told.pins) pins_ = reader.numbers(*told.pins, "pins", pins, 6);
    if (told.colliders) colliders_ = reader.numbers(*told.colliders, "colliders", to.scene.colliders.size(), 6);
    if (told.hands) hands_ = reader.numbers(*told.hands, "hands", to.hands, 6);
    if (told.loads) loads_ = reader.numbers(*told.loads, "loads", loads, 3);
    if (told.body_forces) forces_ = reader.numbers(*told.body_forces, "body_forces", bodies, 6);
    if (told.body_impulses) impulses_ = reader.numbers(*told.body_impulses, "body_impulses", bodies, 6);
    if (told.body_velocities) velocities_ = reader.numbers(*told.body_velocities, "body_velocities", bodies, 6);
    if (told.body_sets) sets_ = reader.choices(*told.body_sets, "body_sets", bodies);
    if (told.holds) holds_ = reader.choices(*told.holds, "holds", pins);
    if (told.grasps) grasps_ = reader.places(*told.grasps, to.hands);
}

EnsembleActions ToldActions::actions() const {
    return {wind_,   pins_,  colliders_, holds_,    gravity_,    hands_,
            grasps_, loads_, forces_,    impulses_, velocities_, sets_};
}

EnsembleControls controls_of(const std::vector<std::string>& names, const SceneDescription& scene,
                             const py::object& hands) {
    EnsembleControls controls;
    if (py::isinstance<py::int_>(hands))
        controls.hands.assign(py::cast<std::size_t>(hands), 0);
    else
        for (const py::handle cloth : py::iter(hands))
            controls.hands.push_back(cloth_number(scene, py::reinterpret_borrow<py::object>(cloth)));
    for (const std::string& name : names) {
        const auto* const found =
            std::ranges::find(control_spellings, name, [](const auto& each) { return each.name; });
        if (found == std::end(control_spellings))
            throw py::value_error("controls are wind, pins, colliders, holds, gravity, loads and bodies, not '" + name +
                                  "'");
        controls.*found->value = true;
    }
    return controls;
}

}  // namespace drape::python
